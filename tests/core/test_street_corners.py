"""Kerbs that turn round a corner: cut there, so that each street keeps its own lanes."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.roadmap.lanes.street_corners import cut_at_corners
from urbanmap_qgis.roadmap.map_records import DrivenPath, MapLine
from urbanmap_qgis.roadmap.vector_map import build_vector_map
from urbanmap_qgis.settings.roadmap import MapSettings


def straight(start, end, kind="solid"):
    """A level line with a station each half metre."""
    length = np.hypot(*(np.array(end, float) - start))
    share = np.linspace(0.0, 1.0, int(2 * length) + 1)[:, None]
    plan = (1 - share) * np.array(start, float) + share * np.array(end, float)
    return MapLine(np.column_stack([plan, np.zeros(len(plan))]), kind)


def round_corner(radius, arms=40.0):
    """A border along the x axis that turns north with a radius."""
    angle = np.arange(0.0, 90.1, 5.0)
    arc = np.column_stack([radius * np.sin(np.radians(angle)), radius * (1.0 - np.cos(np.radians(angle)))])
    west = straight([-arms, 0.0], [0.0, 0.0], "road border").points[:-1]
    north = straight(arc[-1], [radius, radius + arms], "road border").points[1:]
    return MapLine(np.vstack([west, np.column_stack([arc, np.zeros(len(arc))]), north]), "road border")


@pytest.mark.parametrize("radius", [0.5, 3.0, 8.0])
def test_a_corner_is_cut_in_its_middle(radius):
    border = round_corner(radius)
    one, other = cut_at_corners([border])
    assert one.points[-1] == pytest.approx(other.points[0])
    middle = radius * np.array([np.sin(np.pi / 4), 1.0 - np.cos(np.pi / 4)])
    assert np.hypot(*(one.points[-1, :2] - middle)) < 1.0
    length = sum(np.hypot(*np.diff(part.points[:, :2], axis=0).T).sum() for part in (one, other))
    assert length == pytest.approx(np.hypot(*np.diff(border.points[:, :2], axis=0).T).sum())


def test_bends_of_roads_and_paint_stay_whole():
    bend, short = round_corner(40.0), straight([0.0, 0.0], [5.0, 0.0], "road border")
    paint = MapLine(round_corner(3.0).points, "solid")
    assert [id(line) for line in cut_at_corners([bend, short, paint])] == [id(bend), id(short), id(paint)]


def test_a_kerb_round_the_corner_costs_neither_street_its_lanes():
    """The side street's lines lie beside the longer arm's kerb only through the corner that both share."""
    lines = [round_corner(3.0, 60.0),
             straight([-60.0, -1.0], [-8.0, -1.0]), straight([-60.0, -4.5], [-8.0, -4.5]),
             straight([4.0, 11.0], [4.0, 60.0]), straight([7.5, 11.0], [7.5, 60.0])]
    drives = [DrivenPath(np.array([[-60.0, -2.75, 0.0], [-8.0, -2.75, 0.0]])),
              DrivenPath(np.array([[5.75, 60.0, 0.0], [5.75, 11.0, 0.0]]))]
    built = build_vector_map(lines, (), drives, MapSettings(traffic="left"))
    length = {False: 0.0, True: 0.0}
    for lane in built.lanes:
        if lane.kind == "lane":
            extent = np.ptp(lane.centre[:, :2], axis=0)
            length[bool(extent[1] > extent[0])] += float(extent.max())
    assert length[False] > 45.0 and length[True] > 42.0
