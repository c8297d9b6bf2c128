"""From line work and drives to a lane map (J 6.2)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ..progress import SILENT, Progress
from ..settings.roadmap import MapSettings
from ..wording import say
from .bound_sigmas import fill_heights_and_sigmas
from .given_bounds import rejoined
from .lanes.intersections import add_intersections
from .lanes.junctions import connect_by_drives
from .lanes.lane_assembly import add_section
from .lanes.lane_directions import give_directions, keeps_left
from .lanes.lane_strips import add_drives, lane_strips
from .lanes.movements import add_movements
from .lanes.narrow_places import narrow_places
from .lanes.road_axes import RoadAxis, add_speed_limits
from .lanes.section_preparation import prepared_sections
from .map_cleaning import clean_map
from .map_records import DrivenPath, Finding, MapArea, MapLine, VectorMap

STOP_REACH = 5.0
"""A lane ends at a stop line so near, m."""


def build_vector_map(lines: Sequence[MapLine], areas: Sequence[MapArea] = (), drives: Sequence[DrivenPath] = (),
                     settings: MapSettings | None = None, progress: Progress = SILENT,
                     axes: Sequence[RoadAxis] = ()) -> VectorMap:
    """Lanes with shared bounds, directions, neighbours, successors, stop lines and crosswalks.

    A lane is made only where two lines lie at a lane's width and a drive, an arrow, a stop line or a neighbouring lane
    shows its direction; road axes (`axes`) tell only where these do not. What is missing for a lane becomes a finding
    with its place.
    """
    settings = settings or MapSettings()
    lines = rejoined(lines)
    built = VectorMap()
    stops = [line.points for line in lines if line.kind == "stop line"]
    crosswalks = [area for area in areas if area.kind == "crosswalk"]
    arrows = [area for area in areas if area.kind.startswith("arrow")]
    progress.step(0.1)
    worked = []
    for section, near in prepared_sections(lines, areas, settings):
        strips = lane_strips(section, near, settings)
        add_drives(strips, section, drives, settings)
        built.findings += narrow_places(section, drives, settings)
        worked.append((section, strips, near))
        progress.check()
    built.left_hand = keeps_left(worked, settings)
    progress.step(0.7)
    built.findings += give_directions(worked, arrows, axes, built.left_hand)
    for section, strips, _ in worked:
        add_section(built, section, strips)
    if not drives:
        built.findings.append(_without_drives(lines))
    connect_by_drives(built, drives)
    if settings.infer_ways:
        add_movements(built, stops, crosswalks, settings.way_confidence)
    clean_map(built)
    _refer(built, stops, crosswalks)
    add_intersections(built)
    add_speed_limits(built, axes)
    _tell_open_ends(built)
    _tell_heights(built, fill_heights_and_sigmas(built, lines))
    progress.step(1.0)
    return built


def _without_drives(lines: Sequence[MapLine]) -> Finding:
    x, y = lines[0].points[0, :2] if len(lines) else (np.nan, np.nan)
    return Finding("no drive", say("No trajectory was given: only arrows and stop lines tell directions, and ways "
                                   "through junctions are inferred."), float(x), float(y))


def _refer(built: VectorMap, stops: Sequence[np.ndarray], crosswalks: Sequence[MapArea]) -> None:
    """Let lanes refer to the stop line at their end and to the crosswalks that they cross."""
    for stop in stops:
        line = shapely.LineString(stop[:, :2])
        referring = []
        for number, lane in enumerate(built.lanes):
            if lane.kind != "lane" or line.distance(shapely.Point(lane.centre[-1, :2])) > STOP_REACH:
                continue
            course = lane.centre[-1, :2] - lane.centre[-2, :2]
            ahead = lane.centre[-1, :2] + course / np.linalg.norm(course) * STOP_REACH
            back = lane.centre[-1, :2] - course / np.linalg.norm(course) * STOP_REACH
            if shapely.LineString([back, ahead]).intersects(line):
                referring.append(number)
        for number in referring:
            built.lanes[number].stop_lines.append(len(built.stop_lines))
        if not referring:
            x, y = stop[:, :2].mean(axis=0)
            built.findings.append(Finding("stop line without lane", say("No lane of the map ends at this stop line."),
                                          float(x), float(y)))
        built.stop_lines.append(stop)
    for area in crosswalks:
        for lane in built.lanes:
            if shapely.LineString(lane.centre[:, :2]).intersects(area.polygon):
                lane.crosswalks.append(len(built.crosswalks))
        built.crosswalks.append(area)


def _tell_heights(built: VectorMap, filled: int) -> None:
    """One finding where nodes have no height of their own."""
    if filled:
        far, number = max((sigma, number) for number, sigma in built.height_sigmas.items())
        x, y = built.nodes[number][:2]
        built.findings.append(Finding("height filled", say(
            "{filled} of {nodes_count} nodes have no measured height: theirs is taken from along the road (sigma up to "
            "{far:.2f} m).", filled=filled, nodes_count=len(built.nodes), far=far), float(x), float(y)))
    elif built.nodes and not built.has_heights():
        x, y = built.nodes[0][:2]
        built.findings.append(Finding("no height", say("No node has a height; give the marking lines a ground."),
                                      float(x), float(y)))


def _tell_open_ends(built: VectorMap) -> None:
    """Findings where a lane leads nowhere or comes from nowhere."""
    entered = {follower for lane in built.lanes for follower in lane.successors}
    for number, lane in enumerate(built.lanes):
        for missing, tip, text in ((not lane.successors, -1, say("No drive shows where this lane leads to.")),
                                   (number not in entered, 0, say("No drive shows where this lane comes from."))):
            if missing:
                x, y = lane.centre[tip, :2]
                built.findings.append(Finding("open end", text, float(x), float(y)))
