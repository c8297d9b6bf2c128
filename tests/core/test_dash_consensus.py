"""What lines of one town say of each other's dashes, and lines that are large because they are long."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.roadmap.lines.dash_consensus import with_common_patterns
from urbanmap_qgis.roadmap.lines.dash_pattern import Section
from urbanmap_qgis.roadmap.lines.strokes import polygon_strokes


def dashed(starts, lengths, period, dash):
    runs = np.column_stack([starts, np.add(starts, lengths)]).astype(float)
    return Section(runs[0, 0], runs[-1, 1], "dashed", runs, period, dash, 0.8)


def regular(count=6, period=7.5, dash=3.0):
    rng = np.random.default_rng(3)
    return dashed(np.arange(count) * period + rng.normal(0, 0.05, count), dash + rng.normal(0, 0.05, count), period,
                  dash)


WORN = dashed([0, 2.1, 7.5, 13.1, 14.5], [1.0, 4.3, 5.0, 0.6, 4.4], 5.3, 4.0)
"""A solid line with gaps worn into it, which a pattern of its own explained well enough."""


def test_worn_edge_is_solid_beside_regular_dashes():
    sections = with_common_patterns([[regular()], [WORN]])
    assert [one.kind for one in sections[0]] == ["dashed"] and [one.kind for one in sections[1]] == ["solid"]
    assert sections[0][0].period == pytest.approx(7.5) and len(sections[0][0].dashes) == 6
    assert (sections[1][0].start, sections[1][0].end) == (WORN.start, WORN.end)


def test_worn_edge_alone_is_solid_too():
    assert [one.kind for one in with_common_patterns([[WORN]])[0]] == ["solid"]


def test_line_that_is_solid_before_and_dashed_behind_is_cut_where_it_changes():
    starts, lengths = [0.0, 9.7, 12.0, 17.0, 24.5, 32.0, 39.5], [8.8, 1.8, 4.4, 3.0, 2.9, 3.1, 3.0]
    mixed = dashed(starts, lengths, 14.6, 8.0)
    found = with_common_patterns([[regular()], [mixed]])[1]
    assert [one.kind for one in found] == ["solid", "dashed"]
    assert found[1].dashes[:, 0].tolist() == starts[3:] and found[1].period == pytest.approx(7.5)


def test_worn_dash_in_step_stays_a_dash():
    starts, lengths = [0.0, 7.5, 15.4, 22.5, 30.0], [3.0, 3.0, 1.2, 3.0, 3.0]
    found = with_common_patterns([[dashed(starts, lengths, 7.5, 3.0)]])[0]
    assert [one.kind for one in found] == ["dashed"] and len(found[0].dashes) == 5


def test_solid_lines_and_two_dashes_stay_as_they_are():
    solid = Section(0.0, 50.0, "solid", np.array([[0.0, 50.0]]), np.nan, np.nan, 1.0)
    pair = dashed([0.0, 8.0], [3.0, 2.9], 8.0, 3.0)
    found = with_common_patterns([[solid], [pair]])
    assert [one.kind for one in found[0]] == ["solid"] and [one.kind for one in found[1]] == ["dashed"]


def test_long_curved_line_gives_its_stroke_and_a_bright_yard_none():
    turn = np.linspace(0.0, 1.05, 200)
    arc = shapely.LineString(400.0 * np.column_stack([np.sin(turn), 1.0 - np.cos(turn)]))
    longest = polygon_strokes(arc.buffer(0.075, cap_style="flat"))[0]
    assert longest.polygon == 0 and 400.0 * 1.05 * 0.15 > 60.0
    assert longest.length == pytest.approx(420.0, abs=1.0) and longest.width == pytest.approx(0.15, abs=0.02)
    yard = shapely.box(0, 0, 12, 10).difference(shapely.box(4, 4, 6, 6))
    assert polygon_strokes(yard) == []
