"""The rules of the house, read from the sources: who may import whom, what an algorithm holds, one name a thing."""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter, defaultdict
from pathlib import Path

import pytest

from scripts import source_tree

pytestmark = pytest.mark.once

ROOT = Path(__file__).resolve().parents[2]
CORE = source_tree.CORE
BASE = {"errors", "progress", "execution", "dependencies", "sources", "wording", "settings"}

# From the ground up: a room imports from the floors below its own, never from its own floor's neighbours.
FLOORS = (BASE, {"geometry"}, {"estimation", "io"}, {"terrain", "citymodel", "tiling", "acceptance"},
          {"aerial", "mobile"}, {"buildings", "roadmap", "roadspace"}, {"facades", "imagery", "gnss"}, {"localisation"},
          {"job"}, {"samplecity"})

IMPORTS = {name: source_tree.own_imports(path) for name, path in source_tree.modules().items()}
STAGES = {name: path for name, path in source_tree.modules(source_tree.FACE).items()
          if path.parent.parent.name == source_tree.FACE and path.parent.name != "framework"
          and path.name != "__init__.py"}

# What an algorithm module may do with numpy and shapely: fill and pick columns, count, make points of coordinates,
# and sum up a column in one figure for the results.
TABLE_WORK = {"np": {"array", "asarray", "full", "zeros", "where", "isfinite", "isnan", "isin", "unique", "stack",
                     "int64", "float32", "nan", "median", "nanmean", "abs", "hypot", "meshgrid", "linalg.norm"},
              "shapely": {"points", "linestrings", "force_2d", "force_3d", "is_missing", "get_parts", "make_valid",
                          "total_bounds"}}
LONGEST_STAGE = 220  # lines
LONGEST_MODULE = 500
LONGEST_FUNCTION = 60
MODULES_OF_A_ROOM = 20
IMPORTS_OF_A_RECIPE = 15
LONG_RECIPES = {"urbanmap_qgis.mobile.registration.correction.adjustment": 18}  # not to grow


def room(name: str) -> str:
    """The core's room that a module belongs to: "io" for "urbanmap_qgis.io.raster"."""
    return name.split(".")[1] if "." in name else ""


def floor(name: str) -> int:
    return next(number for number, rooms in enumerate(FLOORS) if name in rooms)


def read(name: str) -> ast.Module:
    return source_tree.parsed(STAGES[name])


def used_of(tree: ast.AST, owner: str) -> set[str]:
    """What is used of a module known as `owner`: {"linalg.norm", "where"} of `np`."""
    chains = {ast.unparse(node) for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    plain = {chain for chain in chains if re.fullmatch(rf"{owner}(\.\w+)+", chain)}
    longest = {chain for chain in plain if not any(other.startswith(f"{chain}.") for other in plain)}
    return {chain.partition(".")[2] for chain in longest}


def test_every_room_has_its_floor():
    assert {room(name) for name in IMPORTS} - {""} == set().union(*FLOORS)


def test_imports_of_the_core_run_one_way():
    upwards = {(name, target) for name, targets in IMPORTS.items() for target in targets
               if room(name) != room(target) and not {room(name), room(target)} <= BASE
               and floor(room(target)) >= floor(room(name))}
    assert not upwards


def test_sample_city_shares_nothing_with_what_it_judges():
    used = {room(target) for name, targets in IMPORTS.items() if room(name) == "samplecity" for target in targets}
    assert used == {"samplecity", "errors", "progress", "execution", "wording"}


def test_nobody_but_the_sample_city_knows_it():
    assert not [name for name, targets in IMPORTS.items() if room(name) != "samplecity"
                and any(room(target) == "samplecity" for target in targets)]


def test_folders_have_no_circles():
    """Neither among the rooms nor among what any folder holds (each folder in it taken as one)."""
    folders = {name.rpartition(".")[0] for name in IMPORTS if "." in name}
    circles = {folder: source_tree.first_cycle(source_tree.folded(IMPORTS, folder)) for folder in folders}
    assert not source_tree.first_cycle(IMPORTS)
    assert not {folder: circle for folder, circle in circles.items() if circle}


def test_recipes_stay_readable():
    """A module that brings more of the others together than a reader keeps in mind: which steps are one?"""
    steps = {name: [target for target in targets if room(target) != "settings"] for name, targets in IMPORTS.items()}
    assert not {name: len(targets) for name, targets in steps.items()
                if len(targets) > LONG_RECIPES.get(name, IMPORTS_OF_A_RECIPE)}


def test_scripts_have_no_circles():
    imports = {name: source_tree.own_imports(path) for name, path in source_tree.modules("scripts").items()}
    assert len(imports) > 20
    assert not source_tree.first_cycle(imports)


def test_core_knows_no_qgis_and_imports_its_own_relatively():
    barred = {"qgis", "PyQt5", "PyQt6", "processing", CORE, source_tree.FACE}
    assert not {(name, word) for name, path in source_tree.modules().items()
                for _, word in source_tree.foreign_imports(source_tree.parsed(path)) if word in barred}


def test_face_imports_its_own_relatively_and_packages_in_the_run():
    for name, path in source_tree.modules(source_tree.FACE).items():
        tree = source_tree.parsed(path)
        foreign = list(source_tree.foreign_imports(tree))
        assert not {word for _, word in foreign} & {CORE, source_tree.FACE}, name
        at_head = {word for node, word in foreign if node in tree.body}
        assert not at_head - {"qgis", "processing"} - sys.stdlib_module_names, name


@pytest.mark.parametrize("name", sorted(STAGES))
def test_algorithm_modules_hold_no_mathematics(name):
    tree = read(name)
    foreign = {word for _, word in source_tree.foreign_imports(tree)}
    assert foreign <= {"qgis", "numpy", "shapely"} | (sys.stdlib_module_names - {"cmath", "statistics"})
    for owner, allowed in TABLE_WORK.items():
        assert used_of(tree, owner) <= allowed
    for node in ast.walk(tree):
        assert not (isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Pow, ast.MatMult))), node.lineno
        assert not isinstance(node, ast.While), node.lineno
    assert len(STAGES[name].read_text(encoding="utf-8").splitlines()) <= LONGEST_STAGE


@pytest.mark.parametrize("name", sorted(STAGES))
def test_algorithm_modules_import_the_core_in_the_run(name):
    """So that listing works while packages are missing."""
    heads = {node for node in read(name).body if isinstance(node, ast.ImportFrom) and node.level >= 3}
    assert {node.module for node in heads if not node.module.startswith(f"{CORE}.settings.")} <= {
        f"{CORE}.errors", f"{CORE}.progress", f"{CORE}.wording"}


def algorithms() -> dict[str, tuple[str, ast.ClassDef]]:
    """Id of each algorithm in the groups' folders, with its module and class."""
    found = {}
    for name in STAGES:
        for node in read(name).body:
            if isinstance(node, ast.ClassDef):
                for line in node.body:
                    if isinstance(line, ast.Assign) and ast.unparse(line.targets[0]) == "ID":
                        assert ast.literal_eval(line.value) not in found
                        found[ast.literal_eval(line.value)] = (name, node)
    return found


@pytest.mark.parametrize("identifier", sorted(algorithms()))
def test_algorithm_has_a_module_of_its_name_help_a_page_and_tests(identifier):
    name, node = algorithms()[identifier]
    assert name.rpartition(".")[2] == identifier
    assigned = {ast.unparse(line.targets[0]) for line in node.body if isinstance(line, ast.Assign)}
    assert assigned >= {"ID", "NAME", "HELP", "KEYWORDS"}
    assert re.search(rf"\b{identifier}\b", (ROOT / "README.md").read_text(encoding="utf-8"))
    tested = [path.name for folder in ("algorithms", "cli") for path in (ROOT / "tests" / folder).glob("test_*.py")
              if path.name not in {"test_provider.py", "test_cli_listing.py"}
              and re.search(rf"\b{identifier}\b", path.read_text(encoding="utf-8"))]
    assert tested


def test_layers_that_algorithms_write_have_a_style():
    """Every map layer; a table without geometry needs none."""
    plain = set()
    for name in STAGES:
        for node in ast.walk(read(name)):
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "self.write_layer":
                given = {word.arg for word in node.keywords}
                is_table = len(node.args) <= 6 and "geometries" not in given
                if not is_table and "style" not in given and len(node.args) < 9:
                    plain.add((name.rpartition(".")[2], ast.literal_eval(node.args[1])))
    assert not plain


@pytest.mark.parametrize("page", sorted((ROOT / "docs").glob("*.md")), ids=lambda page: page.stem)
def test_pages_say_papers_in_full_before_they_shorten_them(page):
    text = page.read_text(encoding="utf-8")
    for letter, author in (("J", "Javanmardi"), ("Z", "Shibasaki")):
        first = re.search(rf"\b{letter} (?:\d|eq|fig|table|chapter|is)|\b{letter}'s\b", text)
        assert not first or author in text[:first.start() + 60], f"{page.name}: {first.group()}"


def test_public_names_stand_for_one_thing():
    places = defaultdict(list)
    for name, path in source_tree.modules().items():
        for public in source_tree.public_names(path):
            places[public].append(name)
    assert not {public: found for public, found in places.items() if len(found) > 1}


@pytest.mark.parametrize("folder", [CORE, source_tree.FACE])
def test_rooms_stay_small(folder):
    """More modules in one folder than a reader takes in: which rooms are in there?"""
    held = Counter(path.parent.relative_to(ROOT).as_posix() for path in source_tree.modules(folder).values()
                   if path.name != "__init__.py")
    assert not {room: number for room, number in held.items() if number > MODULES_OF_A_ROOM}


def test_architecture_names_every_folder_of_the_core():
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    folders = {path.parent.relative_to(ROOT / CORE).parts for path in source_tree.modules().values()} - {()}
    rows = {line.split("|")[1].strip(" `/"): line for line in page.partition("## Inside the rooms")[2].splitlines()
            if line.startswith("| `")}
    assert {parts[0] for parts in folders if len(parts) == 1} <= set(re.findall(r"`(\w+)/`", page))
    assert not [parts for parts in folders if len(parts) > 1 and f"`{parts[-1]}/`" not in rows.get(parts[0], "")]


@pytest.mark.parametrize("folder", [CORE, source_tree.FACE])
def test_modules_and_functions_stay_short(folder):
    for name, path in source_tree.modules(folder).items():
        assert len(path.read_text(encoding="utf-8").splitlines()) <= LONGEST_MODULE, name
        for node in ast.walk(source_tree.parsed(path)):
            if isinstance(node, ast.FunctionDef) and node.name != "declare":
                assert node.end_lineno - node.lineno < LONGEST_FUNCTION, f"{name}.{node.name}"


def test_reader_of_sources_sees_what_it_should(tmp_path):
    """The rules above would hold of nothing if the reader were blind."""
    for place, text in {"a/__init__.py": "", "a/one.py": "from . import two\nimport a.deep.three\n",
                        "a/two.py": "from .deep.three import thing\n", "a/deep/__init__.py": "",
                        "a/deep/three.py": "def later():\n    from ..one import other\n"}.items():
        (tmp_path / place).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / place).write_text(text, encoding="utf-8")
    imports = {name: source_tree.own_imports(path, tmp_path) for name, path in
               source_tree.modules("a", tmp_path).items()}
    assert imports == {"a": set(), "a.one": {"a.two", "a.deep.three"}, "a.two": {"a.deep.three"}, "a.deep": set(),
                       "a.deep.three": {"a.one"}}
    assert source_tree.reachable(["a.two"], imports) == {"a.one", "a.two", "a.deep.three"}
    assert source_tree.first_cycle(imports) == ["a.deep.three", "a.one", "a.deep.three"]
    assert source_tree.folded(imports, "a") == {"a.one": {"a.two", "a.deep"}, "a.two": {"a.deep"},
                                                "a.deep": {"a.one"}}
    assert source_tree.first_cycle({"x": {"y"}, "y": set()}) == []


def test_the_text_of_a_fault_never_becomes_data():
    """Where any exception is caught so that one building or tile does not end the others, its text goes to the log."""
    spoken = set()
    for folder in (CORE, source_tree.FACE):
        for name, path in source_tree.modules(folder).items():
            for handler in ast.walk(source_tree.parsed(path)):
                if isinstance(handler, ast.ExceptHandler) and getattr(handler.type, "id", "") in ("Exception",
                                                                                                 "BaseException"):
                    spoken |= {(name, node.lineno) for node in ast.walk(handler)
                               if isinstance(node, (ast.FormattedValue, ast.Call)) and _says(node, handler.name)}
    assert not spoken


def _says(node: ast.AST, error: str | None) -> bool:
    """Whether a text is made of a caught exception: formatted, or by `str`, `repr` or `format`."""
    if isinstance(node, ast.FormattedValue):
        return isinstance(node.value, ast.Name) and node.value.id == error
    by = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
    return by in ("str", "repr", "format", "say") and any(isinstance(item, ast.Name) and item.id == error for item in [
        *node.args, *(keyword.value for keyword in node.keywords)])


def test_settings_need_no_packages():
    """They are read when the algorithms are listed, where packages may be missing."""
    records = {name: path for name, path in source_tree.modules().items() if room(name) == "settings"}
    assert len(records) > 2
    for name, path in records.items():
        assert not {word for _, word in source_tree.foreign_imports(source_tree.parsed(path))
                    } - sys.stdlib_module_names, name
        assert {room(target) for target in IMPORTS[name]} <= {"settings", "errors", "wording"}, name
