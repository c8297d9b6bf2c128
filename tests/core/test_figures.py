"""The stored figures notice what they should, and bear roundings."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest
import shapely

from tests import figures


@dataclasses.dataclass
class Result:
    height: np.ndarray
    label: str
    shapes: list


@pytest.fixture
def made(tmp_path, monkeypatch):
    """A result whose figures are stored."""
    monkeypatch.setattr(figures, "FOLDER", tmp_path)
    monkeypatch.setenv("URBANMAP_NEW_FIGURES", "1")
    result = Result(np.linspace(20.0, 30.0, 500), "12 of 500 m", [shapely.box(-7000, -34000, -6990, -33990)] * 3)
    figures.stays("result", result)
    monkeypatch.delenv("URBANMAP_NEW_FIGURES")
    return result


def test_the_same_and_roundings_pass(made):
    figures.stays("result", made)
    figures.stays("result", dataclasses.replace(made, height=made.height + 1e-5))


@pytest.mark.parametrize("change", [
    {"height": np.linspace(20.0, 30.02, 500)}, {"height": np.linspace(20.0, 30.0, 499)},
    {"height": np.where(np.arange(500) == 7, np.nan, np.linspace(20.0, 30.0, 500))}, {"label": "13 of 500 m"},
    {"shapes": [shapely.box(-7000, -34000, -6990, -33990)] * 2},
    {"shapes": [shapely.box(-7000, -34000, -6989.9, -33990)] * 3}])
def test_changes_are_noticed(made, change):
    with pytest.raises(AssertionError):
        figures.stays("result", dataclasses.replace(made, **change))


def test_columns_of_coordinates_are_told_apart():
    """A centimetre in height is not lost beside the thousands of metres of a national grid."""
    places = np.column_stack([np.linspace(-7000, -6900, 50), np.linspace(-34000, -33900, 50), np.linspace(1, 1.2, 50)])
    before, after = ({place: figures.figures(values) for place, values in figures.arrays(array)}
                     for array in (places, places + np.array([0.0, 0.0, 0.01])))
    assert [figures.alike(before[place], after[place], figures.TOLERANCE) for place in sorted(before)] == [
        True, True, False]


def test_tables_and_texts(tmp_path):
    (tmp_path / "a1.csv").write_text("time,x,name\n1.5,2,b\n2.5,4,c7\n", encoding="utf-8")
    (tmp_path / "a2.csv").write_text("time,x,name\n3.5,6,d\n", encoding="utf-8")
    (tmp_path / "facts.json").write_text(json.dumps({"a": [1, -2.5e-3]}), encoding="utf-8")
    found = {place: list(map(float, values)) for place, values in figures.arrays(tmp_path)}
    assert found == {"a#.csv:time": [1.5, 2.5, 3.5], "a#.csv:x": [2.0, 4.0, 6.0], "a#.csv:name": [7.0],
                     "facts.json": [1.0, -0.0025]}
