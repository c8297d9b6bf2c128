#!/usr/bin/env python3
"""Do the tests notice? Random small changes of the core, each in a copy of the checkout, and how many the tests catch.

    python3 scripts/mutation_trial.py --seed 1 --count 40 [--only geometry io] [--budget 40] [--slow] [--minutes 20]

One change at a time: an operator (+ and -, * and /, & and |, a sign), a comparison (turned to its opposite), a branch
(its condition negated, "and" and "or"), a constant (a whole number plus one, a decimal number doubled, True and False).
For each change those core tests run that enter the changed function (for a line outside functions: any function of its
module), fastest first, then the others of their files, to the first failure, as many as fit into the budget of seconds.
Which test enters which function is measured in a run of the core tests, kept in build/mutation and measured again for
tests that changed. Slow tests are left out; `--slow` then tries them, and them alone, on what has survived.

All goes in slices: outcomes are kept while core and tests are the same, and `--minutes` ends a slice; the same command
goes on.

The changes are drawn evenly from all places where one is possible, so that a seed always gives the same ones for the
same sources. Left out are texts, annotations, decorators and what is inside f-strings.
"""

from __future__ import annotations

import argparse
import ast
import copy
import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.source_tree import CORE, modules, own_imports, parsed  # noqa: E402

KEPT = ROOT / "build" / "mutation"
TESTS = "tests/core"
NOTICED = ("caught", "hangs")
KINDS = ("operator", "comparison", "branch", "constant")
COPIED = (CORE, "tests", "scripts", "algorithms", "resources", "docs")
COPIED_FILES = ("__init__.py", "metadata.txt", "pyproject.toml", "README.md", "requirements.txt", "Makefile")
QUICK, SLOW = "not slow", "slow"  # marks of tests
STRUCTURE = "test_structure.py"  # reads the sources and runs none
SLICE = 12  # test files that are measured in one run
START_SECONDS = 60.0  # of Python, the packages and what fixtures make anew

OPERATORS = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.FloorDiv: ast.Mult,
             ast.Mod: ast.Mult, ast.Pow: ast.Mult, ast.MatMult: ast.Mult, ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd,
             ast.LShift: ast.RShift, ast.RShift: ast.LShift, ast.BitXor: ast.BitOr}
OPPOSITES = {ast.Lt: ast.GtE, ast.GtE: ast.Lt, ast.Gt: ast.LtE, ast.LtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
             ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In}

# Loaded by pytest in the copy: tells which functions of the core each test enters, and how long it takes.
TRACER = '''
import json, os, sys, threading, time
from pathlib import Path

CORE = str(Path(__file__).parent / "urbanmap_qgis") + os.sep
entered, lasted, here, started, failed = {}, {}, set(), {}, set()

def on_call(frame, event, argument):
    code = frame.f_code
    if code.co_filename.startswith(CORE):
        here.add((code.co_filename[len(CORE):], code.co_firstlineno))

def pytest_collection_modifyitems(items):
    sys.settrace(on_call)
    threading.settrace(on_call)

def pytest_runtest_logstart(nodeid, location):
    here.clear()
    started[nodeid] = time.perf_counter()

def pytest_runtest_logreport(report):
    if report.failed:
        failed.add(report.nodeid)

def pytest_runtest_logfinish(nodeid, location):
    entered[nodeid] = sorted(here)
    lasted[nodeid] = time.perf_counter() - started[nodeid]

def pytest_sessionfinish(session):
    sys.settrace(None)
    threading.settrace(None)
    for nodeid in failed:
        entered.pop(nodeid, None)
    Path(os.environ["REACH_FILE"]).write_text(json.dumps(
        {"entered": entered, "lasted": lasted, "failed": sorted(failed)}))
'''


@dataclass(frozen=True)
class Change:
    """One change: bytes `begin` to `end` of the file of `module` become `text`; `function` is where it stands."""

    module: str
    function: str  # dotted name inside the module, "" outside functions
    kind: str
    line: int
    begin: int
    end: int
    old: str
    text: str


# What can be changed


def changes_of(module: str, path: Path) -> list[Change]:
    """All changes of one file that the trial may draw from."""
    source = path.read_bytes()
    starts = [0]
    for line in source.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    found = []
    for node, function in _places(parsed(path), ""):
        for kind, place, new in _variants(node):
            begin = starts[place.lineno - 1] + place.col_offset
            end = starts[place.end_lineno - 1] + place.end_col_offset
            text = ast.unparse(new) if isinstance(new, ast.stmt) else f"({ast.unparse(new)})"
            found.append(Change(module, function, kind, place.lineno, begin, end, ast.unparse(place), text))
    return found


def _places(node: ast.AST, function: str) -> Iterator[tuple[ast.AST, str]]:
    """Nodes of a tree with the function that they stand in, without those that are never changed."""
    if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
        own = f"{function}.{node.name}".lstrip(".")
        parts = [(part, own) for part in node.body]
        if isinstance(node, ast.FunctionDef):
            parts += [(part, function) for part in (*node.args.defaults, *node.args.kw_defaults) if part is not None]
    elif isinstance(node, ast.AnnAssign):
        parts = [(node.value, function)] if node.value is not None else []
    elif isinstance(node, (ast.JoinedStr, ast.Import, ast.ImportFrom)):
        return
    else:
        parts = [(part, function) for part in ast.iter_child_nodes(node)]
    for part, own in parts:
        yield part, own
        yield from _places(part, own)


def _variants(node: ast.AST) -> Iterator[tuple[str, ast.AST, ast.AST]]:
    """Kind of change, the node that it replaces and what replaces it."""
    if isinstance(node, (ast.BinOp, ast.AugAssign)) and type(node.op) in OPERATORS and not _is_text(node):
        yield "operator", node, _with(node, op=OPERATORS[type(node.op)]())
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.Invert)):
        yield "operator", node, node.operand
    elif isinstance(node, ast.Compare):
        yield "comparison", node, _with(node, ops=[OPPOSITES[type(node.ops[0])](), *node.ops[1:]])
    elif isinstance(node, ast.BoolOp):
        yield "branch", node, _with(node, op=ast.Or() if isinstance(node.op, ast.And) else ast.And())
    elif isinstance(node, ast.Constant) and isinstance(node.value, (bool, int, float)):
        yield "constant", node, ast.Constant(_other_value(node.value))
    if isinstance(node, (ast.If, ast.IfExp)):
        yield "branch", node.test, ast.UnaryOp(ast.Not(), node.test)


def _is_text(node: ast.BinOp | ast.AugAssign) -> bool:
    return any(isinstance(part, ast.JoinedStr) or (isinstance(part, ast.Constant) and isinstance(part.value, str))
               for part in ast.walk(node))


def _with(node: ast.AST, **fields) -> ast.AST:
    changed = copy.copy(node)
    for name, value in fields.items():
        setattr(changed, name, value)
    return changed


def _other_value(value: bool | int | float) -> bool | int | float:
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + 1
    return 2.0 * value if value else 1.0


# Which tests reach what


def copy_checkout(folder: Path) -> None:
    """What the core tests need of the checkout, with the sample cities made before."""
    for name in COPIED:
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in COPIED_FILES:
        shutil.copy2(ROOT / name, folder / name)
    cities = ROOT / "build" / "test_cities"
    if cities.is_dir():
        shutil.copytree(cities, folder / "build" / "test_cities", copy_function=os.link)


def pytest_in(folder: Path, arguments: list[str], limit: float | None = None, **variables: str) -> tuple[int, str]:
    """Exit status and output of pytest in a copy; raises `subprocess.TimeoutExpired` after `limit` seconds of work.

    What counts are the processor's seconds, as the machine may be busy; one that sleeps ends after ten times as long.
    """
    environment = dict(os.environ, PYTHONDONTWRITEBYTECODE="1", PYTHONPATH=str(folder), **variables)
    command = [sys.executable, "-m", "pytest", "-q", "--no-header", "-p", "no:cacheprovider", *arguments]
    if limit:
        command = ["prlimit", f"--cpu={round(limit)}:{round(limit) + 5}", *command]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False,
                          timeout=10 * limit if limit else None)
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        raise subprocess.TimeoutExpired(command, limit)
    return done.returncode, done.stdout + done.stderr


def measured_reach(folder: Path, marks: str, until: float) -> dict[str, dict]:
    """For each test file: hash, and for each of its tests with `marks` the functions that it enters and its seconds.

    Measured for the files that are new or changed since the last time, the others are taken as kept; all are measured
    when the core has other functions than then. Kept after every few files; ends the program after `until`.
    """
    kept_file = KEPT / f"reach_{core_functions(folder)}_{marks.replace(' ', '_')}.json"
    kept = json.loads(kept_file.read_text(encoding="utf-8")) if kept_file.is_file() else {}
    hashes = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in (folder / TESTS).glob("test_*.py")
              if path.name != STRUCTURE}
    reach = {name: entry for name, entry in kept.items() if hashes.get(name) == entry["hash"]}
    new = sorted(set(hashes) - set(reach))
    KEPT.mkdir(parents=True, exist_ok=True)
    for first in range(0, len(new), SLICE):
        if time.monotonic() > until:
            sys.exit(f"{len(new) - first} test files are left to measure: run the same command again.")
        names = new[first:first + SLICE]
        print(f"Measuring what {marks} tests reach, {first + len(names)} of {len(new)} files ...", flush=True)
        for name, tests in _reach_of(folder, names, marks).items():
            reach[name] = {"hash": hashes[name], "tests": tests}
        kept_file.write_text(json.dumps(reach), encoding="utf-8")
    return reach


def _reach_of(folder: Path, files: list[str], marks: str) -> dict[str, dict]:
    """Seconds and functions of each test with `marks` of some files, by file."""
    (folder / "reach_tracer.py").write_text(TRACER, encoding="utf-8")
    result = folder / "reach.json"
    result.unlink(missing_ok=True)
    _, said = pytest_in(folder, ["-p", "reach_tracer", "-m", marks, *(f"{TESTS}/{name}" for name in files)],
                        REACH_FILE=str(result))
    if not result.is_file():
        sys.exit(f"No test could be run:\n{said[-3000:]}")
    measured = json.loads(result.read_text(encoding="utf-8"))
    for test in measured["failed"]:
        print(f"Left out, it fails without any change: {test}", flush=True)
    names = {place: function_names(folder / CORE / place) for place in
             {place for calls in measured["entered"].values() for place, _ in calls}}
    found: dict[str, dict] = {name: {} for name in files}
    for test, calls in measured["entered"].items():
        functions = sorted({f"{place}:{names[place][line]}" for place, line in calls if line in names[place]})
        found[test.partition("::")[0].rpartition("/")[2]][test] = [measured["lasted"][test], functions]
    return found


def core_functions(folder: Path) -> str:
    """Hash of the names of all functions of the core."""
    names = sorted(f"{path.relative_to(folder)}:{name}" for path in (folder / CORE).rglob("*.py")
                   for name in function_names(path).values())
    return hashlib.sha256("\n".join(names).encode()).hexdigest()[:12]


def function_names(path: Path) -> dict[int, str]:
    """Dotted name of each function of a file by the line at which its code begins (its first decorator's)."""
    names = {}

    def visit(node: ast.AST, prefix: str) -> None:
        for child in ast.iter_child_nodes(node):
            own = prefix
            if isinstance(child, (ast.FunctionDef, ast.ClassDef)):
                own = f"{prefix}.{child.name}".lstrip(".")
                if isinstance(child, ast.FunctionDef):
                    names[min([child.lineno, *(mark.lineno for mark in child.decorator_list)])] = own
            visit(child, own)

    visit(ast.parse(path.read_bytes()), "")
    return names


def tests_of(change: Change, reach: dict[str, dict], users: dict[str, set[str]]) -> list[tuple[float, str]]:
    """Seconds and name of the tests that enter the changed function, the fastest first, then of those beside them.

    For a line outside functions (a constant of the module, a default, a field): those that enter any function of the
    module, or of the modules that import it.
    """
    place = f"{change.module.partition('.')[2].replace('.', '/')}.py"
    wanted = f"{place}:{change.function}"
    tests = [(seconds, test, functions) for entry in reach.values()
             for test, (seconds, functions) in entry["tests"].items()]
    found = [(seconds, test) for seconds, test, functions in tests if wanted in functions]
    if not found:
        places = {place, *(f"{user.partition('.')[2].replace('.', '/')}.py" for user in users.get(change.module, ()))}
        found = [(seconds, test) for seconds, test, functions in tests
                 if any(function.partition(":")[0] in places for function in functions)]
    # What fixtures of a file make counts for the first test that asks for them: the others see it as well.
    files = {test.partition("::")[0] for _, test in found}
    beside = {(seconds, test) for seconds, test, _ in tests if test.partition("::")[0] in files} - set(found)
    return sorted(found) + sorted(beside)


# The trial


def try_change(change: Change, folder: Path, tests: list[tuple[float, str]], budget: float) -> tuple[str, int]:
    """"caught", "hangs", "survived" or "not reached", and the number of tests chosen."""
    chosen, seconds = [], 0.0
    for lasted, test in tests:
        if chosen and seconds + lasted > budget:
            continue
        chosen.append(test)
        seconds += lasted
    if not chosen:
        return "not reached", 0
    path = folder / modules()[change.module].relative_to(ROOT)
    source = path.read_bytes()
    path.write_bytes(source[:change.begin] + change.text.encode() + source[change.end:])
    try:
        status, _ = pytest_in(folder, ["-x", *chosen], limit=3 * seconds + START_SECONDS)
    except subprocess.TimeoutExpired:
        return "hangs", len(chosen)  # that is noticed
    finally:
        path.write_bytes(source)
    return ("caught" if status else "survived"), len(chosen)


class Outcomes:
    """Outcomes of one seed, kept on the disk: those of the same core and tests are not tried again."""

    def __init__(self, folder: Path, seed: int):
        sources = sorted(path for place in (CORE, TESTS) for path in (folder / place).rglob("*.py"))
        state = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()[:12]
        self.file = KEPT / f"trial_{seed}_{state}.jsonl"
        lines = self.file.read_text(encoding="utf-8").splitlines() if self.file.is_file() else []
        self.known = {key: (outcome, tests) for key, outcome, tests in map(json.loads, lines)}

    def of(self, change: Change, marks: str) -> tuple[str, int] | None:
        """Outcome and number of tests of a change; None where it was not tried."""
        return self.known.get(self._key(change, marks))

    def add(self, change: Change, marks: str, outcome: tuple[str, int]) -> None:
        """Keep an outcome."""
        self.known[self._key(change, marks)] = outcome
        with self.file.open("a", encoding="utf-8") as file:
            file.write(json.dumps([self._key(change, marks), *outcome]) + "\n")

    @staticmethod
    def _key(change: Change, marks: str) -> str:
        return f"{change.module}:{change.begin}:{change.text}:{marks}"


def table(results: list[tuple[Change, str]]) -> str:
    """Counts by kind as Markdown."""
    caught, of = Counter(), Counter()
    for change, outcome in results:
        for row in (change.kind, "all", *(["all without constants"] if change.kind != "constant" else [])):
            of[row] += 1
            caught[row] += outcome in NOTICED
    rows = [f"| {row} | {caught[row]} | {of[row]} | {100 * caught[row] / of[row]:.0f} % |"
            for row in (*KINDS, "all without constants", "all") if of[row]]
    return "\n".join(["| kind | caught | of | share |", "|---|---|---|---|", *rows])


def drawn_changes(given: argparse.Namespace) -> tuple[list[Change], int]:
    """The changes that the seed draws, and of how many."""
    files = {name: path for name, path in modules().items() if path.name != "__init__.py"
             and (not given.only or name.split(".")[1] in given.only) and name.split(".")[1] not in given.without}
    possible = [change for name, path in files.items() for change in changes_of(name, path)
                if change.kind in given.kinds]
    return random.Random(given.seed).sample(possible, min(given.count, len(possible))), len(possible)


def trial(drawn: list[Change], folder: Path, given: argparse.Namespace, marks: str, until: float) -> list[str]:
    """Outcome of each change; with slow tests only what the others let through is tried."""
    users: dict[str, set[str]] = {}
    for name, path in modules().items():
        for other in own_imports(path):
            users.setdefault(other, set()).add(name)
    reach, outcomes, results = measured_reach(folder, marks, until), Outcomes(folder, given.seed), []
    for number, change in enumerate(drawn, 1):
        before = outcomes.of(change, QUICK) if marks == SLOW else None
        known = before if before and before[0] in NOTICED else outcomes.of(change, marks)
        if known is None:
            if time.monotonic() > until:
                sys.exit(f"{len(drawn) - number + 1} changes are left: run the same command again.")
            begun = time.perf_counter()
            known = try_change(change, folder, tests_of(change, reach, users), given.budget)
            outcomes.add(change, marks, known)
            print(f"{number:3d} {known[0]:11s} {change.kind:10s} {change.module.partition('.')[2]}:{change.line} "
                  f"{change.old} -> {change.text} ({known[1]} tests, {time.perf_counter() - begun:.0f} s)", flush=True)
        results.append(known[0])
    return results


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=40, help="number of changes")
    parser.add_argument("--only", nargs="+", default=[], metavar="ROOM", help="folders of the core, such as io")
    parser.add_argument("--without", nargs="+", default=[], metavar="ROOM", help="folders of the core to leave out")
    parser.add_argument("--kinds", nargs="+", default=KINDS, choices=KINDS)
    parser.add_argument("--budget", type=float, default=40.0, help="seconds of tests for one change")
    parser.add_argument("--slow", action="store_true", help="try slow tests on what has survived the others")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="of this slice")
    given = parser.parse_args()
    until = time.monotonic() + 60.0 * given.minutes
    drawn, of = drawn_changes(given)
    with tempfile.TemporaryDirectory(prefix="mutation_", dir=_same_disk()) as place:
        folder = Path(place) / "checkout"
        copy_checkout(folder)
        results = trial(drawn, folder, given, QUICK, until)
        if given.slow:
            results = trial(drawn, folder, given, SLOW, until)
    print(f"\nSeed {given.seed}, {len(drawn)} of {of} possible changes\n\n{table(list(zip(drawn, results)))}")
    for number, (change, outcome) in enumerate(zip(drawn, results), 1):
        if outcome not in NOTICED:
            print(f"{number:3d} {outcome:11s} {change.kind:10s} {change.module.partition('.')[2]}:{change.line} "
                  f"{change.old} -> {change.text}")


def _same_disk() -> Path:
    """A folder on the checkout's disk, so that the sample cities are linked, not copied."""
    KEPT.mkdir(parents=True, exist_ok=True)
    return KEPT


if __name__ == "__main__":
    main()
