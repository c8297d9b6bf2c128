"""Lines and drives of roads that are laid out in a street's own frame, turned by an odd angle, for tests of the map."""

from __future__ import annotations

import numpy as np
import shapely

from urbanmap_qgis.roadmap.map_records import DrivenPath, MapArea, MapLine

EAST, NORTH = -7000.0, -34000.0
ANGLE = np.radians(17.0)


def place(points):
    """Points of the street's own frame as map coordinates with heights."""
    points = np.asarray(points, float)
    x, y = points[:, 0], points[:, 1]
    return np.column_stack([EAST + x * np.cos(ANGLE) - y * np.sin(ANGLE), NORTH + x * np.sin(ANGLE) + y * np.cos(ANGLE),
                            10.0 + 0.01 * x])


def line(y, x0, x1, kind="solid", colour="white", **more):
    return MapLine(place([(x, y) for x in np.arange(x0, x1 + 0.1, 5.0)]), kind, colour, **more)


def path_line(points, kind="solid", colour="white", **more):
    return MapLine(place(points), kind, colour, **more)


def drive(*points):
    fine = [np.linspace(a, b, 60)[:-1] for a, b in zip(np.array(points[:-1], float), np.array(points[1:], float))]
    return DrivenPath(place(np.vstack([*fine, points[-1:]])))


def avenue(x0, x1):
    """Two lanes each way: edges, dashed lane lines, a yellow centre line."""
    return [line(7.0, x0, x1), line(3.5, x0, x1, "dashed"), line(0.0, x0, x1, "solid", "yellow"),
            line(-3.5, x0, x1, "dashed"), line(-7.0, x0, x1)]


def stop(x, y0, y1):
    return MapLine(place([(x, y0), (x, y1)]), "stop line", "white", 0.45)


def zebra(x0, x1, y0, y1):
    """A crosswalk that traffic along the street's frame crosses."""
    ring = shapely.Polygon(place([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]))
    return MapArea(ring, "crosswalk", place([(1, 0)])[0, :2] - place([(0, 0)])[0, :2])


def arrow(x, y, kind="arrow straight", back=False):
    """An arrow on the road that is read along the street's frame, or against it."""
    ring = shapely.Polygon(place([(x - 2, y - 0.5), (x + 2, y - 0.5), (x + 2, y + 0.5), (x - 2, y + 0.5)]))
    heading = place([(1, 0)])[0, :2] - place([(0, 0)])[0, :2]
    return MapArea(ring, kind, -heading if back else heading)


def course(lane):
    """1 where a lane runs along the street's frame, -1 against it."""
    chord = lane.centre[-1, :2] - lane.centre[0, :2]
    return float(np.sign(chord @ [np.cos(ANGLE), np.sin(ANGLE)]))


def lane_at(built, x, y):
    """The number of the one lane at a place of the street's frame."""
    where = shapely.Point(place([(x, y)])[0, :2])
    (number,) = [k for k in range(len(built.lanes)) if built.area(k).contains(where)]
    return number
