"""Measured edges of a crossing of known measures: stations each half metre along kerbs 0.15 m high."""

from __future__ import annotations

import numpy as np
import shapely

from urbanmap_qgis.roadspace.survey.area_records import EdgeLine

HALF_EAST, HALF_NORTH, RADIUS, REACH = 6.0, 4.0, 3.0, 40.0
"""Half widths of the road to the east and of the one to the north, radius of the corners, length of the arms, m."""

HEIGHT, PAVEMENT, SLOPE = 0.15, 2.5, 0.01
"""Of the kerbs and the sidewalks, m; the road rises so much for each metre to the east."""


def road_height(x, y):
    """Height of the carriageway."""
    return 10.0 + SLOPE * np.asarray(x, float) + 0.0 * np.asarray(y, float)


def edge(points, height=HEIGHT, chain=0, gap=0.0, sigma=0.01):
    """An edge with stations each half metre along a line (n, 2)."""
    line = shapely.linestrings(points)
    marks = np.linspace(0.0, line.length, int(np.ceil(line.length / 0.5)) + 1)
    places = shapely.get_coordinates(shapely.line_interpolate_point(line, marks))
    foot = np.column_stack([places, road_height(*places.T)])
    return EdgeLine(foot, foot + np.array([0.0, 0.0, height]), height, sigma, 0.005, chain, gap)


def corner_line(east, north):
    """The kerb line (n, 2) round one corner of the crossing, from the arm to the east or west to the other one."""
    angle = np.linspace(0.0, np.pi / 2.0, 13)
    x = HALF_NORTH + RADIUS - RADIUS * np.sin(angle)
    y = HALF_EAST + RADIUS - RADIUS * np.cos(angle)
    arc = np.column_stack([x, y])
    whole = np.vstack([[REACH, HALF_EAST], arc, [HALF_NORTH, REACH]])
    return whole * (east, north)


def crossing():
    """All kerbs of the crossing."""
    return [edge(corner_line(east, north), chain=number)
            for number, (east, north) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1)))]


def carriageway():
    """The surface between them."""
    corners = [corner_line(1, 1), corner_line(-1, 1)[::-1], corner_line(-1, -1), corner_line(1, -1)[::-1]]
    return shapely.Polygon(np.vstack(corners))


def official():
    """The surface up to the outer borders of the sidewalks, beyond the arms' ends, too."""
    east = shapely.box(-60.0, -HALF_EAST - PAVEMENT, 60.0, HALF_EAST + PAVEMENT)
    north = shapely.box(-HALF_NORTH - PAVEMENT, -60.0, HALF_NORTH + PAVEMENT, 60.0)
    return shapely.union(east, north)
