"""Tables of the pages: each begins with the words of its columns, and every row has all of them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]
RULE = re.compile(r"\|[\s:|-]*---[\s:|-]*\|\s*")


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def tables(text: str) -> list[list[list[str]]]:
    """Rows of cells of each table: the heading first, without the rule below it."""
    lines = text.splitlines()
    found = []
    for row, line in enumerate(lines):
        if RULE.fullmatch(line):
            after = next((n for n in range(row + 1, len(lines)) if not lines[n].startswith("|")), len(lines))
            found.append([cells(lines[row - 1]), *map(cells, lines[row + 1:after])])
    return found


def test_tables_are_told_from_text():
    page = "| a | b |\n|---|---|\n| 1 | 2 |\ntext\n| c \\| d |\n|---|\n"
    assert tables(page) == [[["a", "b"], ["1", "2"]], [["c \\| d"]]]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_tables_have_a_heading_and_whole_rows(page):
    for heading, *rows in tables(page.read_text(encoding="utf-8")):
        assert rows, heading
        assert {len(row) for row in rows} == {len(heading)}, heading
        # A heading may hold values of one setting ("NDT grid (m) | 0.5 | 1"), but it is none of its table's rows.
        assert heading[0] != rows[0][0] or not heading[0], f"the heading looks like a row: {heading}"
