"""Single steps with known answers, each on what lies on either side of its decision."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import shapely

from urbanmap_qgis.aerial.orientation.cloud_control import CloudControl
from urbanmap_qgis.buildings.merging.wall_match import MeasuredWall, _new_line
from urbanmap_qgis.facades.standing_before import _post
from urbanmap_qgis.io.official import gsi_gml
from urbanmap_qgis.mobile.markings.marking_points import _grid
from urbanmap_qgis.roadmap.lanes import junctions, road_axes
from urbanmap_qgis.roadmap.lines import line_work
from urbanmap_qgis.samplecity.scene.paint import Paint


@pytest.mark.parametrize(("off", "gaps", "places"), [(1e-9, 0, 4), (1e-6, 1, 5)])
def test_a_ring_that_does_not_end_where_it_begins_is_closed(monkeypatch, off, gaps, places):
    """By less than the last digit of the file it is rounding; more is a gap, which is told."""
    line = [35.0, 139.0, 35.001, 139.0, 35.001, 139.001, 35.0 + off, 139.0]
    monkeypatch.setattr(gsi_gml, "_curves", lambda boundary, harvest: [list(line)])
    harvest = SimpleNamespace(gaps=[])
    ring = gsi_gml._ring(None, harvest)
    assert ring[:2] == ring[-2:] and len(harvest.gaps) == gaps and len(ring) == 2 * places


def test_paint_is_where_it_was_put_and_nowhere_beyond():
    marking = SimpleNamespace(wear=0.0, colour="white", plan=shapely.MultiPolygon([shapely.box(100, 200, 103, 201)]))
    paint = Paint([marking])
    x, y = np.array([(101, 200.5), (101, 100), (101, 900), (0, 200.5), (300, 200.5), (0, 0), (300, 0)], float).T
    assert paint.marking_at(x, y).tolist() == [0, -1, -1, -1, -1, -1, -1]


def test_half_a_metre_is_left_around_points():
    x, y = np.array([3.0, 17.2]), np.array([-5.1, 8.0])
    west, south, east, north = _grid(x, y).bounds
    assert -1.0 < west <= 2.5 and 17.7 <= east < 21.0 and -9.0 < south <= -5.6 and 8.5 <= north < 12.0


def test_errors_of_a_cloud_are_root_mean_squares():
    errors = np.array([[3.0, 4.0, 0.3], [np.nan, np.nan, 0.4], [30.0, 40.0, 9.0]])
    plan, height = CloudControl.rms(None, errors, np.array([True, True, False]))
    assert (plan, height) == pytest.approx((5.0, np.sqrt(0.125)))


@pytest.mark.parametrize(("low", "high", "stands"), [(0.0, 5.0, True), (3.0, 13.0, True), (8.0, 20.0, False)])
def test_a_narrow_wall_before_a_large_one_as_high_is_a_post(low, high, stands):
    """The large wall goes up to 9 m: more than half of a post's height must be before it."""
    walls = [SimpleNamespace(contour=SimpleNamespace(polygon=shapely.box(0, 0, size, 9))) for size in (0.2, 20.0)]
    seen = SimpleNamespace(left=np.array([5.0, 0.0]), right=np.array([5.2, 20.0]), low=np.array([low, 0.0]),
                           high=np.array([high, 9.0]))
    assert _post(walls, 0, np.array([1]), seen) == stands


@pytest.mark.parametrize(("ways", "found"), [((1, 1), True), ((1, -1), False), ((1, 0), False), ((1, None), False)])
def test_axes_that_differ_in_their_way_tell_nothing(monkeypatch, ways, found):
    """Two axes beside a strip that runs to the east; one of them alone may say its way."""
    monkeypatch.setattr(road_axes, "strip_middle", lambda section, strip: np.array([50.0, 0.0]))
    axis = SimpleNamespace(chainage=lambda place: place[:, 0], frame=lambda chainage: (None, np.array([[1.0, 0.0]])))
    lines = [shapely.LineString([(0, y), (100, y)]) for y in (0.5, -0.5)]
    axes = [SimpleNamespace(plan=line, oneway=way) for line, way in zip(lines, ways)]
    nearest, along = road_axes._nearest([None], SimpleNamespace(axis=axis), axes)
    assert (nearest is axes[0], along) == ((True, 1) if found else (False, 0))


@pytest.mark.parametrize(("colour", "width", "kind"), [("yellow", 0.3, "guiding strip"), ("yellow", 0.15, "solid"),
                                                       ("white", 0.3, "solid")])
def test_a_guiding_strip_is_yellow_and_wide(monkeypatch, colour, width, kind):
    monkeypatch.setattr(line_work, "_colour", lambda *_: colour)
    monkeypatch.setattr(line_work, "_piece", lambda line, section, start, end, name, *_: name)
    line = SimpleNamespace(chain=None, fit=SimpleNamespace(width=width),
                           sections=[SimpleNamespace(kind="solid", start=0.0, end=9.0)])
    assert line_work._sections_of([line], [], [], SimpleNamespace(guide_width=0.25)) == [kind]


@pytest.mark.parametrize("side", [0.5, -0.5])
def test_a_wall_measured_over_a_short_part_moves_the_edge_to_itself(side):
    """The edge runs to the east and looks south; half a metre of wall is parallel to it, outside or inside."""
    edge = SimpleNamespace(ends=np.array([[0.0, 0.0], [10.0, 0.0]]), length=10.0,
                           line=SimpleNamespace(along=np.array([1.0, 0.0]), outward=np.array([0.0, -1.0])))
    wall = MeasuredWall(0, np.array([4.0, -side]), np.array([0.0, -1.0]), -0.25, 0.25, 0.0, 3.0, 1.5, 0.02, 0.01, 0.0)
    line = _new_line(edge, wall, 0.05, 3.0)
    assert line.point == pytest.approx([0.0, -side])


@pytest.mark.parametrize(("degrees", "lanes"), [(30.0, [0]), (60.0, []), (180.0, [])])
def test_a_drive_runs_in_lanes_of_its_direction(degrees, lanes):
    """A lane 40 m wide to the east, driven through in steps of two metres at an angle."""
    turn = np.radians(degrees)
    places = np.column_stack([50.0 + np.arange(-9, 10) * 2 * np.cos(turn), np.arange(-9, 10) * 2 * np.sin(turn),
                              np.zeros(19)])
    centre = np.column_stack([np.arange(0, 101.0), np.zeros(101), np.zeros(101)])
    built = SimpleNamespace(lanes=[SimpleNamespace(centre=centre)])
    visits = junctions._visits(built, places, shapely.STRtree([shapely.box(0, -20, 100, 20)]))
    assert [visit.lane for visit in visits] == lanes
