"""The program stays within its budget (scripts/budget.py), and the counts behind it count what they say."""

from __future__ import annotations

import ast
import textwrap

import pytest

from scripts import budget

pytestmark = pytest.mark.once

SOURCE = textwrap.dedent('''
    """What is
    here."""
    from dataclasses import dataclass

    LENGTH = 2.5  # m
    AREA = -3 * 4.0
    PAIRS = (1, 2)

    # a remark
    @dataclass(frozen=True)
    class SlopeLimits:
        """How steep."""
        rise: float = 0.2
        steps: tuple = (1, 2)
        steep: bool = False
        name: str = ""

    @dataclass
    class Found:
        place: float

    def slope(rise):
        """Rise.

        Of what?"""
        return 0.5 * rise + 0.25 + 3 + """
        # no remark
        """
''').lstrip()


@pytest.fixture(scope="module")
def sizes():
    return budget.sizes()


@pytest.mark.parametrize("row", [row for row in budget.BUDGET if "toolbox" not in row])
def test_sources_stay_within_the_budget(row, sizes):
    assert sizes[row] <= budget.BUDGET[row]


def test_counts_of_a_source(tmp_path):
    (tmp_path / "source.py").write_text(SOURCE, encoding="utf-8")
    assert budget.code_lines(tmp_path / "source.py") == 17
    tree = ast.parse(SOURCE)
    assert budget.named_numbers(tree) == 4  # LENGTH, AREA, rise and steps
    assert budget.inline_floats(tree) == 1
    assert [node.name for node in budget.dataclasses_of(tree)] == ["SlopeLimits", "Found"]


def test_records_that_few_modules_name(tmp_path, monkeypatch):
    monkeypatch.setattr(budget.source_tree, "ROOT", tmp_path)
    texts = {"a": "@dataclass\nclass Plane:\n    x: int\n@dataclass\nclass Edge:\n    x: int\n",
             "b": "Plane, Edge\n@dataclass\nclass EdgeLimits:\n    x: int\n", "c": "Plane\n"}
    for name, text in texts.items():
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
    assert budget.lonely_records([tmp_path / "a.py", tmp_path / "b.py"], [tmp_path / "c.py"]) == ["a.py: Edge"]
