"""A road model of the levels 2 to 3.3 from a survey: carriageways, cuts, areas, heights and steps one after another.

Source: Project PLATEAU, standard product specification of 3D city models 5.0, 4.3.1.3 and 4.3.1.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...errors import InputError
from ...progress import SILENT, Progress
from ...wording import say
from ..road_records import RoadFinding
from .area_heights import EdgeHeights, Heights, raised_areas
from .area_records import CROSSING, ISLAND, LEVELS, STEPS, WITH_LANES, EdgeLine, SurveyedRoads
from .carriageways import Carriageways, carriageways_between
from .given_roads import laid_on_kerbs
from .road_areas import road_areas
from .stop_cuts import CutJunctions, junction_cuts


@dataclass(frozen=True, eq=False)
class SurveyInputs:
    """What a survey gives besides the edges: surfaces of given roads up to the sidewalks' outer borders, lanes (plan
    polygons), stop lines (plan lines), and heights of the ground; each may be missing."""

    official: Sequence[shapely.Polygon] = ()
    lanes: Sequence[shapely.Polygon] = ()
    stops: Sequence[shapely.LineString] = ()
    ground: Heights | None = None


def surveyed_roads(edges: Sequence[EdgeLine], level: str, inputs: SurveyInputs | None = None,
                   progress: Progress = SILENT) -> SurveyedRoads:
    """Make a road model of a level from measured edges.

    Raises
    ------
    InputError : there is no such level, no edge, no height for a level that has them, or the edges enclose nothing.
    """
    if level not in LEVELS:
        raise InputError(say("There is no level {level}: choose one of {levels}.", level=level,
                             levels=", ".join(LEVELS)))
    inputs = inputs or SurveyInputs()
    if level != "2" and edges and not any(np.isfinite(edge.foot[:, 2]).any() for edge in edges):
        raise InputError(say("The edges have no heights, of which this level of detail is made: give the lines of "
                             "“Road edges” as they were made, or choose level 2."))
    ways = carriageways_between(edges, inputs.lanes)
    progress.step(0.2)
    fine = level in WITH_LANES
    # Where one edge was seen, lanes make the other side: its shape tells of no junction.
    cuts = [junction_cuts(polygon, inputs.stops if fine else (), _islands(polygon)) if number < ways.between
            else CutJunctions((), ()) for number, polygon in enumerate(ways.polygons)]
    progress.step(0.5)
    places = cKDTree(np.concatenate([edge.plan for edge in edges]))
    sigmas = np.concatenate([np.full(len(edge.plan), edge.sigma) for edge in edges])
    official, moved = laid_on_kerbs(inputs.official, ways.measured)
    pieces, areas, findings = road_areas(ways, cuts, official, inputs.lanes if fine else (),
                                         lambda place: sigmas[places.query(place)[1]])
    progress.step(0.8)
    areas, steps = raised_areas(areas, EdgeHeights.of([*edges, *ways.continued]), level, inputs.ground)
    findings = [*ways.findings, *moved, *findings, *_missing(ways, cuts, areas, inputs, level)]
    return SurveyedRoads(level, tuple(pieces), tuple(areas), tuple(steps), tuple(findings))


def _islands(polygon: shapely.Polygon, widest: float = 12.0) -> list[shapely.Polygon]:
    """Holes that are too narrow for a block of houses: roads run on both sides of them, but they are one."""
    holes = [shapely.Polygon(ring) for ring in polygon.interiors]
    return [hole for hole in holes if 2.0 * hole.area / hole.length < widest / 2.0]


def _missing(ways: Carriageways, cuts: Sequence[CutJunctions], areas: Sequence, inputs: SurveyInputs,
             level: str) -> list[RoadFinding]:
    """What was not there to be made, with its place."""
    found = []
    x, y = shapely.get_coordinates(shapely.point_on_surface(ways.polygons[0]))[0]
    if not inputs.official:
        found.append(RoadFinding("no sidewalks", say(
            "No surfaces of roads were given: where sidewalks end is not known, and none is made."), x, y))
    if level in WITH_LANES and not inputs.lanes:
        found.append(RoadFinding("no lanes", say("No lanes were given: carriageways are not divided."), x, y))
    if level in WITH_LANES:
        found += [RoadFinding("no stop line", say(
            "There is no stop line in this arm: its junction is cut at the corners."), *one.line.mean(axis=0).tolist())
            for group in cuts for one in group.cuts if not one.at_stop_line]
    if level in STEPS:
        found += [RoadFinding("island's height", say(
            "The top of this island was not measured apart from its kerb."),
            *shapely.get_coordinates(shapely.point_on_surface(area.polygon))[0].tolist())
            for area in areas if area.kind == ISLAND and inputs.ground is None]
    found += [RoadFinding("end of the survey", say("The survey ends here; the road goes on."),
                          *end.mean(axis=0).tolist()) for end in ways.ends]
    if not any(area.kind == CROSSING for area in areas) and any(group.junctions for group in cuts):
        found.append(RoadFinding("junction not cut", say("Roads meet here, but nothing tells where to cut them."),
                                 x, y))
    return found
