"""How large the program is, against the budget that it keeps: lines, numbers that steer results, records.

    .venv/bin/python scripts/budget.py

A count goes down by a question that is answered once instead of twice, not by longer lines, numbers in other places or
records under other names.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from scripts import source_tree

BUDGET = {  # to be lowered only
    "lines of the core": 111_300,
    "lines of code of the core": 73_980,
    "named numbers": 2_520,
    "numbers in functions": 2_000,
    "records that at most one other module names": 326,
    "lines of algorithms": 17_880,
    "lines of scripts": 12_850,
    "lines of tests": 59_500,
    "algorithms and models in the toolbox": 48,
}

FREE_FLOATS = {-1.0, 0.0, 0.5, 1.0, 2.0}
"""What no one would set otherwise: signs, halves, doubles."""

NOT_RECORDS = ("Limits", "Settings", "Parameters")
"""Ends of the names of dataclasses that hold what may be set, rather than what was found."""


def sizes() -> dict[str, int]:
    """Count of each row of the budget that the sources tell (all but the last, which QGIS tells)."""
    core = list(source_tree.modules().values())
    sources = {folder: source_tree.modules(folder).values() for folder in (source_tree.FACE, "scripts", "tests")}
    return {
        "lines of the core": lines(core),
        "lines of code of the core": sum(code_lines(path) for path in core),
        "named numbers": sum(named_numbers(source_tree.parsed(path)) for path in core),
        "numbers in functions": sum(inline_floats(source_tree.parsed(path)) for path in core),
        "records that at most one other module names": len(lonely_records(core, sources[source_tree.FACE])),
        **{f"lines of {folder}": lines(paths) for folder, paths in sources.items()},
    }


def lines(paths: Iterable[Path]) -> int:
    """Lines of all files together."""
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in paths)


def code_lines(path: Path) -> int:
    """Lines of a source that are not blank and not only docstring or comment."""
    docs, strings = set(), set()
    for node in ast.walk(source_tree.parsed(path)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node) is not None:
            docs.update(range(node.body[0].lineno, node.body[0].end_lineno + 1))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            strings.update(range(node.lineno + 1, node.end_lineno + 1))
    rows = ((number, row.strip()) for number, row in enumerate(path.read_text(encoding="utf-8").splitlines(), 1))
    return sum(bool(row) and number not in docs and (number in strings or row[0] != "#") for number, row in rows)


def named_numbers(tree: ast.Module) -> int:
    """Fields of dataclasses that have a number by default, and names at a module's head that stand for one number."""
    fields = [line.value for node in dataclasses_of(tree) for line in node.body if isinstance(line, ast.AnnAssign)]
    heads = [line.value for line in tree.body if isinstance(line, (ast.Assign, ast.AnnAssign))]
    return (sum(value is not None and any(map(is_number, ast.walk(value))) for value in fields)
            + sum(value is not None and is_sum_of_numbers(value) for value in heads))


def is_number(node: ast.AST) -> bool:
    """Whether a node is a number as written, True and False not among them."""
    return isinstance(node, ast.Constant) and type(node.value) in (int, float)


def is_sum_of_numbers(node: ast.AST) -> bool:
    """Whether an expression is one number, as written or worked out of numbers as written."""
    if isinstance(node, ast.UnaryOp):
        return is_sum_of_numbers(node.operand)
    if isinstance(node, ast.BinOp):
        return is_sum_of_numbers(node.left) and is_sum_of_numbers(node.right)
    return is_number(node)


def inline_floats(tree: ast.Module) -> int:
    """Floats written in functions, counted again in each function around them, besides `FREE_FLOATS`."""
    return sum(is_number(node) and isinstance(node.value, float) and node.value not in FREE_FLOATS
               for function in ast.walk(tree) if isinstance(function, ast.FunctionDef) for node in ast.walk(function))


def dataclasses_of(tree: ast.Module) -> Iterator[ast.ClassDef]:
    """Every dataclass of a module."""
    return (node for node in ast.walk(tree) if isinstance(node, ast.ClassDef)
            and any("dataclass" in ast.dump(decorator) for decorator in node.decorator_list))


def lonely_records(core: Iterable[Path], face: Iterable[Path]) -> list[str]:
    """Records of the core that no module, or only one other, names ("path: name"), all private ones among them."""
    words = {path: set(re.findall(r"\b[A-Z]\w+\b", path.read_text(encoding="utf-8"))) for path in (*core, *face)}
    return [f"{path.relative_to(source_tree.ROOT)}: {node.name}" for path in core
            for node in dataclasses_of(source_tree.parsed(path)) if not node.name.endswith(NOT_RECORDS)
            and sum(node.name in held for other, held in words.items() if other != path) <= 1]


if __name__ == "__main__":
    for row, size in sizes().items():
        print(f"{row:45}{size:>9,}{BUDGET[row]:>9,}{'  over' if size > BUDGET[row] else ''}")
