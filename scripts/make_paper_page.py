#!/usr/bin/env python3
"""Write docs/paper_steps.md: each step of the two papers, what runs it, and the tests that hold it.

    python3 scripts/make_paper_page.py

Steps and functions stand in scripts/paper_steps.toml. Tests name a step by `@pytest.mark.paper("J 3.2.2")`.
"""

from __future__ import annotations

import ast
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import tomllib

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "paper_steps.md"
STEPS = ROOT / "scripts" / "paper_steps.toml"

STATES = {"letter": "to the letter", "read": "to the letter, as read here", "differs": "otherwise",
          "missing": "missing", "none": "–"}

HEAD = """# The papers, step by step

Made by `scripts/make_paper_page.py` from `scripts/paper_steps.toml` and the marks of the tests. What each step brings,
and what the defaults do instead, is told in [The papers](papers.md).

{papers}

- *To the letter*: `METHOD=paper` does what the paper says.
- *To the letter, as read here*: the paper is silent, ambiguous or misprinted in something that has to be decided.
- *Otherwise*: the step is done in another way, also with `METHOD=paper`.
- *Missing*: not done.

A step without a test is held by none that names it; chains that run through it may still notice.
"""


@dataclass(frozen=True)
class Step:
    """A step of a paper.

    Attributes
    ----------
    place : section and equation.
    what : the step.
    state : a key of `STATES`.
    does : functions that run it, module:name within the core.
    says : how it is read, or how it differs.
    """

    place: str
    what: str
    state: str
    does: tuple[str, ...] = ()
    says: str = ""


def read_steps() -> list[Step]:
    """The steps in the order of the papers."""
    rows = tomllib.loads(STEPS.read_text(encoding="utf-8"))["step"]
    return [Step(**{**row, "does": tuple(row.get("does", ()))}) for row in rows]


@lru_cache
def references() -> dict[str, tuple[str, str]]:
    """Author and full reference (Markdown) of each paper, by its letter."""
    return {row["letter"]: (row["short"], row["reference"])
            for row in tomllib.loads(STEPS.read_text(encoding="utf-8"))["paper"]}


def marked_tests() -> dict[str, list[str]]:
    """Tests, file::name, by the place of the step that their mark names."""
    found: dict[str, list[str]] = {}
    for path in sorted((ROOT / "tests").rglob("test_*.py")):
        text = path.read_text(encoding="utf-8")
        if "mark.paper(" in text:
            for place, name in _marks(ast.parse(text)):
                found.setdefault(place, []).append(f"{path.stem}::{name}")
    return found


def _marks(tree: ast.Module) -> Iterator[tuple[str, str]]:
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            for mark in node.decorator_list:
                if isinstance(mark, ast.Call) and ast.unparse(mark.func) == "pytest.mark.paper":
                    yield from ((place.value, node.name) for place in mark.args)


def missing_functions(steps: list[Step]) -> list[str]:
    """Functions that the table names and the core has not."""
    return [function for step in steps for function in step.does if not _defined(function)]


def _defined(function: str) -> bool:
    module, name = function.split(":")
    path = ROOT / "urbanmap_qgis" / (module.replace(".", "/") + ".py")
    return path.is_file() and any(getattr(node, "name", None) == name
                                  for node in ast.parse(path.read_text(encoding="utf-8")).body)


def page() -> str:
    """The page as Markdown."""
    steps, tests = read_steps(), marked_tests()
    count = Counter(step.state for step in steps)
    papers = "\n".join(f"- {letter}: {full}." for letter, (_, full) in references().items())
    states = ", ".join(f"{count[key]} {name}" for key, name in STATES.items() if key != "none")
    lines = [HEAD.format(papers=papers), f"Steps: {states}.", ""]
    for paper, (title, _) in references().items():
        lines += [f"## {title}", "", "| section | step | here | function | held by |", "|---|---|---|---|---|"]
        lines += [_row(step, tests.get(step.place, [])) for step in steps if step.place.startswith(paper)]
        lines.append("")
    return "\n".join(lines).rstrip() + "\n"


def _row(step: Step, tests: list[str]) -> str:
    here = STATES[step.state] + (f": {step.says}" if step.says else "")
    held = "<br>".join(f"`{test}`" for test in tests) or ("no test" if step.does else "–")
    return f"| {step.place} | {step.what} | {here} | {'<br>'.join(f'`{name}`' for name in step.does) or '–'} | {held} |"


if __name__ == "__main__":
    absent = missing_functions(read_steps())
    if absent:
        sys.exit("Not in the core: " + ", ".join(absent))
    PAGE.write_text(page(), encoding="utf-8")
