"""Ways through junctions against the painted arrows of a city: a part of the judge `lines`.

The truth is what the arrow before the stop line of a true lane allows, whether or not the program saw that arrow; lanes
of streets without arrows are not judged.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import shapely

from scripts.layers import read_layer
from urbanmap_qgis.roadmap.map_records import VectorMap

LEFT_WIDTH = 1.0
"""The painted arrow to the left is 1.28 m wide, the one straight on 0.7 m."""

BEFORE = 35.0
"""An arrow lies so near before the end of its lane, m."""

AT_END = 12.0
"""The end of a lane of the map lies so near to the end of the true one, m."""


def true_turns(city: Path) -> list[tuple[np.ndarray, np.ndarray, float, str]]:
    """End (2,), direction (2,), half width and turn that the last painted arrow tells, of each true lane with one."""
    lanes, (left, right) = read_layer(city / "truth/lanes.gpkg", "left", "right")
    shapes, (kinds,) = read_layer(city / "truth/markings.gpkg", "kind", layer="aerial")
    arrows = [shapely.force_2d(shape) for shape, kind in zip(shapes, kinds) if kind == "arrow"]
    middles = np.array([shapely.get_coordinates(shapely.centroid(arrow))[0] for arrow in arrows])
    told = []
    for lane, *sides in zip(lanes, left, right):
        ends = shapely.get_coordinates(lane)
        course = (ends[-1] - ends[0]) / np.linalg.norm(ends[-1] - ends[0])
        along, across = (middles - ends[-1]) @ course, (middles - ends[-1]) @ [-course[1], course[0]]
        of_it = np.flatnonzero((along < 0) & (along > -BEFORE) & (np.abs(across) < min(sides)))
        # Where arrows lie in an opposite lane's place nothing does: lanes of both directions have their own middle.
        if len(of_it):
            nearest = arrows[of_it[np.argmax(along[of_it])]]
            frame = shapely.get_coordinates(shapely.minimum_rotated_rectangle(nearest))
            narrow = np.linalg.norm(np.diff(frame, axis=0), axis=1)[:2].min()
            told.append((ends[-1], course, min(sides), "left" if narrow > LEFT_WIDTH else "straight"))
    return told


def lane_of(built: VectorMap, end: np.ndarray, course: np.ndarray, half: float) -> int:
    """The lane of the map that ends where a true lane does, -1 where none does."""
    for number, lane in enumerate(built.lanes):
        offset = lane.centre[-1, :2] - end
        direction = lane.centre[-1, :2] - lane.centre[-2, :2]
        if (lane.kind == "lane" and abs(offset @ course) < AT_END and abs(offset @ [-course[1], course[0]]) < half / 2
                and direction @ course > 0.9 * np.linalg.norm(direction)):
            return number
    return -1


def begins(built: VectorMap, end: np.ndarray, course: np.ndarray, half: float, turn: str) -> bool:
    """Whether the map has a lane that the movement leads into."""
    angle = np.radians(90.0) if turn == "left" else 0.0
    wanted = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) @ course
    for lane in built.lanes:
        offset, direction = lane.centre[0, :2] - end, lane.centre[1, :2] - lane.centre[0, :2]
        ahead, across = offset @ course, offset @ [-course[1], course[0]]
        beside = abs(across) < half if turn == "straight" else 0.0 < across < 35.0
        if (lane.kind == "lane" and 0.0 < ahead < 60.0 and beside
                and direction @ wanted > 0.9 * np.linalg.norm(direction)):
            return True
    return False


def movement_figures(built: VectorMap, city: Path) -> Counter:
    """Numbers of true movements, of those found, and of true and false ways by their evidence."""
    count: Counter = Counter()
    offered = Counter((round(one.x, 3), round(one.y, 3), one.text) for one in built.findings
                      if one.kind == "way possible")
    count["offered as findings"] = sum(offered.values())
    for end, course, half, turn in true_turns(city):
        number = lane_of(built, end, course, half)
        if number < 0:
            count["true movements, lane not in the map"] += 1
            continue
        ways = [built.lanes[way] for way in built.lanes[number].successors]
        there = begins(built, end, course, half, turn)
        found = any(way.kind != "virtual" or way.turn == turn for way in ways)
        count["true movements between lanes of the map"] += there
        count["of these found"] += there and found
        for way in ways:
            if way.kind == "virtual":
                count[f"{way.evidence}: {'true' if way.turn == turn else 'false'}"] += 1
    return count
