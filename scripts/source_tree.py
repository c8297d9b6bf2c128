"""What the sources say of themselves, read without importing them: modules, imports, names.

Used by the tests of the structure and the picture of the architecture.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CORE = "urbanmap_qgis"
FACE = "algorithms"


@cache
def parsed(path: Path) -> ast.Module:
    """Syntax tree of a source file."""
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


def modules(folder: str = CORE, root: Path = ROOT) -> dict[str, Path]:
    """Files below `folder` by dotted name ("urbanmap_qgis.io.raster"); a package's own file has the package's name."""
    files = {}
    for path in sorted((root / folder).rglob("*.py")):
        parts = path.relative_to(root).with_suffix("").parts
        files[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return files


def module_of(path: Path, root: Path = ROOT) -> str:
    """Dotted name of a source file."""
    return ".".join(path.relative_to(root).with_suffix("").parts)


def own_imports(path: Path, root: Path = ROOT) -> set[str]:
    """Dotted names of the plugin's own modules that a file imports, relatively or by their full name.

    A name imported from a package counts as that package's module where there is one, else as the package.
    """
    found = set()
    for node in ast.walk(parsed(path)):
        if isinstance(node, ast.ImportFrom):
            found.update(_from_targets(node, path, root))
        elif isinstance(node, ast.Import):
            found.update(name.name for name in node.names if _is_module(name.name, root))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and _is_named_module(node.value, root):
            found.add(node.value)  # importlib.import_module("urbanmap_qgis.samplecity.write")
    return found


def _from_targets(node: ast.ImportFrom, path: Path, root: Path) -> Iterator[str]:
    if node.level:
        base = [*path.relative_to(root).parts[:-node.level], *(node.module or "").split(".")]
    else:
        base = (node.module or "").split(".")
    package = ".".join(part for part in base if part)
    for name in node.names:
        module = f"{package}.{name.name}"
        if _is_module(module, root):
            yield module
        elif _is_module(package, root):
            yield package


def _is_module(name: str, root: Path) -> bool:
    path = root.joinpath(*name.split("."))
    return path.with_suffix(".py").is_file() or (path / "__init__.py").is_file()


def _is_named_module(text: str, root: Path) -> bool:
    return text.startswith(f"{CORE}.") and text.replace(".", "").isidentifier() and _is_module(text, root)


def foreign_imports(tree: ast.AST) -> Iterator[tuple[ast.stmt, str]]:
    """Statements that import by full name, with the first part of that name ("numpy")."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node, name.name.partition(".")[0]) for name in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield node, (node.module or "").partition(".")[0]


def public_names(path: Path) -> list[str]:
    """Classes and functions at the head level of a module whose names do not begin with an underscore."""
    return [node.name for node in parsed(path).body
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith("_")]


def reachable(start: Iterable[str], imports: Mapping[str, Iterable[str]]) -> set[str]:
    """Everything imported from `start`, directly and indirectly; modules without an entry import nothing."""
    seen, open_ = set(), list(start)
    while open_:
        name = open_.pop()
        if name not in seen:
            seen.add(name)
            open_.extend(imports.get(name, ()))
    return seen


def first_cycle(imports: Mapping[str, Iterable[str]]) -> list[str]:
    """A circle of imports, first name repeated at its end; empty where there is none."""
    done: set[str] = set()
    path: list[str] = []

    def visit(name: str) -> list[str]:
        if name in path:
            return [*path[path.index(name):], name]
        if name in done:
            return []
        path.append(name)
        for other in sorted(imports.get(name, ())):
            if found := visit(other):
                return found
        path.pop()
        done.add(name)
        return []

    for name in sorted(imports):
        if found := visit(name):
            return found
    return []


def folded(imports: Mapping[str, Iterable[str]], folder: str) -> dict[str, set[str]]:
    """Imports among the children of `folder` (its modules and the folders in it), each folder taken as one."""
    depth = len(folder.split(".")) + 1
    inside: dict[str, set[str]] = {}
    for name, others in imports.items():
        if name.startswith(f"{folder}."):
            child = ".".join(name.split(".")[:depth])
            targets = {".".join(other.split(".")[:depth]) for other in others if other.startswith(f"{folder}.")}
            inside.setdefault(child, set()).update(targets - {child})
    return inside
