#!/usr/bin/env python3
"""Where the lanes of a city are lost, by length: each metre of a true lane that no right lane covers gets one cause.

    python3 scripts/evaluate_lane_losses.py CITY MARKINGS.gpkg GROUND.tif [--orthophoto TIF] [--points LAZ ...]
        [--drives CSV ...] [--edges GPKG ...]

CITY has truth/lanes.gpkg. MARKINGS, marking points, edges and drives are what the program made of it; without drives
the true trajectories are taken. A true lane counts where the orthophoto (else the ground) is known within 1 m, or
marking points within 6 m. Needs a Python that sees QGIS's GDAL.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
import shapely

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.evaluate_roadmap import measured_lines, sampled  # noqa: E402
from scripts.layers import read_layer  # noqa: E402
from urbanmap_qgis.io.raster import RasterSampler  # noqa: E402
from urbanmap_qgis.mobile.trajectory_files import read_trajectory  # noqa: E402
from urbanmap_qgis.roadmap.lanes.lane_strips import lane_strips  # noqa: E402
from urbanmap_qgis.roadmap.lanes.section_preparation import prepared_sections  # noqa: E402
from urbanmap_qgis.roadmap.map_records import DrivenPath, MapArea, MapLine, lines_of  # noqa: E402
from urbanmap_qgis.roadmap.vector_map import build_vector_map  # noqa: E402
from urbanmap_qgis.settings.roadmap import MapSettings  # noqa: E402

NEAR, FIT, ALONG = 0.12, 0.2, 6.0
"""A line lies at a true bound so near to it; a lane's bounds fit so well; paint so far along tells of a place, m."""


def side_places(points: np.ndarray, course: np.ndarray, left: float, right: float) -> np.ndarray:
    """Places (2, n, 2) of the true left and right bound beside points on a lane's middle."""
    plan = shapely.get_coordinates(points)
    across = np.array([-course[1], course[0]])
    return np.stack([plan + left * across, plan - right * across])


def along_paint(places: np.ndarray, course: np.ndarray, tree: shapely.STRtree) -> np.ndarray:
    """Whether paint lies within `ALONG` of each place (n, 2) along the course."""
    pieces = shapely.linestrings(np.stack([places - ALONG * course, places + ALONG * course], axis=1))
    hit = tree.query(pieces, predicate="dwithin", distance=NEAR)[0]
    return np.isin(np.arange(len(places)), hit)


class Losses:
    """Evidence and results about a city's lanes, and the cause of the loss of each place."""

    def __init__(self, paint, survey, work, built, sections):
        self.paint, self.survey = shapely.STRtree(paint), shapely.STRtree(survey)
        self.work = [line for line in work.lines if line.kind != "stop line"]
        self.lines = shapely.STRtree([line.plan for line in self.work])
        self.built = built
        self.areas = [built.area(number) for number in range(len(built.lanes))]
        self.lanes = shapely.STRtree(self.areas)
        self.sections = sections

    def right(self, points, course, beside) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Masks (n,): in a right lane, in a lane of the wrong direction, in one whose bounds lie elsewhere."""
        good, against, off = (np.zeros(len(points), bool) for _ in range(3))
        for point, number in zip(*self.lanes.query(points, predicate="within")):
            lane = self.built.lanes[number]
            if lane.kind != "lane":
                continue
            along = (lane.centre[-1, :2] - lane.centre[0, :2]) @ course > 0
            sides = [shapely.distance(points[point], shapely.LineString(self.built.coordinates(number, side)[:, :2]))
                     for side in (("left", "right") if along else ("right", "left"))]
            fits = np.abs(np.subtract(sides, beside)).max() < FIT
            good[point] |= along and fits
            against[point] |= not along and fits
            off[point] |= not fits
        return good, against, off

    def side_cause(self, places, course) -> np.ndarray:
        """What is missing at a true bound's places (n, 2); "" where a line lies there."""
        points = shapely.points(places)
        there = np.isin(np.arange(len(points)), self.lines.query(points, predicate="dwithin", distance=NEAR)[0])
        aerial, survey = (along_paint(places, course, tree) for tree in (self.paint, self.survey))
        return np.where(there, "", np.where(aerial, "paint in the mask, no line", np.where(
            survey, "paint in the survey, no line", "no paint found")))

    def in_strip(self, points) -> np.ndarray:
        """Whether the points (n,) lie in a strip of any section."""
        inside = np.zeros(len(points), bool)
        for section, strips in self.sections:
            chainage, offset = section.axis.local(shapely.get_coordinates(points))
            for strip in strips:
                right, left = section.tracks[strip.right], section.tracks[strip.left]
                inside |= ((chainage >= strip.start) & (chainage <= strip.end) & (offset > right.interpolate(chainage))
                           & (offset < left.interpolate(chainage)))
        return inside

    def causes(self, shape, left, right) -> np.ndarray:
        """The cause (n,) at places along a true lane; "" where it is right."""
        points, ends = sampled(shapely.force_2d(shape)), shapely.get_coordinates(shape)
        course = (ends[-1] - ends[0]) / np.linalg.norm(ends[-1] - ends[0])
        good, against, off = self.right(points, course, (left, right))
        places = side_places(points, course, left, right)
        sides = np.array([self.side_cause(one, course) for one in places])
        lacking = np.where(sides[0] != "", sides[0], sides[1])
        both = (sides != "").all(axis=0)
        cause = np.where(both, np.char.add("both sides: ", sides[0]), np.where(lacking != "", lacking, ""))
        strip = self.in_strip(points)
        lined = np.select([against, off, strip], ["direction wrong", "bounds of the lane lie elsewhere",
                                                  "strip there, no direction"], "lines on both sides, no strip")
        cause = np.where(lacking == "", lined, cause)
        cause = np.where((lacking != "") & (off | against), np.char.add(cause, ", lane elsewhere"), cause)
        return np.where(good, "", cause)


def main() -> None:
    """Print the table of one city."""
    parser = argparse.ArgumentParser()
    parser.add_argument("city", type=Path)
    parser.add_argument("markings")
    parser.add_argument("ground")
    parser.add_argument("--orthophoto")
    for name in ("points", "drives", "edges"):
        parser.add_argument(f"--{name}", nargs="*", default=[])
    given = parser.parse_args()
    started = time.process_time()
    work, paint, survey = measured_lines(given.markings, given.points, given.ground)
    lined = time.process_time()
    paths = given.drives or sorted((given.city / "truth").glob("survey_*_trajectory.csv"))
    drives = [DrivenPath(read_trajectory(Path(path)).trajectory.place) for path in paths]
    lines = [MapLine(line.points, line.kind, line.colour, line.width, line.sigma, line.chain, line.partner,
                     confidence=line.confidence, sigmas=line.sigmas)
             for line in work.lines]
    for path in given.edges:
        shapes, _ = read_layer(path)
        lines += lines_of(shapes, {}, None)
    areas = [MapArea(area.polygon, area.kind, area.heading) for area in work.areas]
    built = build_vector_map(lines, areas, drives)
    done = time.process_time()
    sections = [(section, lane_strips(section, near, MapSettings()))
                for section, near in prepared_sections(lines, areas, MapSettings())]
    print_table(given, Losses(paint, survey, work, built, sections))
    print(f"{'CPU s, lines':50s} {lined - started:.1f}\n{'CPU s, lanes':50s} {done - lined:.1f}")


def seen_by_anyone(given, places: np.ndarray, survey: shapely.STRtree) -> np.ndarray:
    """Whether an image shows what is within 1 m of places (n, 2), or a survey what is within `ALONG`."""
    seen = np.isin(np.arange(len(places)),
                   survey.query(shapely.points(places), predicate="dwithin", distance=ALONG)[0])
    with RasterSampler(given.orthophoto or given.ground) as raster:
        for step in np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)]):
            seen |= np.isfinite(raster.sample(*(places + step).T))
    return seen


def print_table(given, losses: Losses) -> None:
    """The table of causes by length, and the area beside true lanes."""
    shapes, (left, right) = read_layer(given.city / "truth/lanes.gpkg", "left", "right")
    total, inside = Counter(), 0.0
    for shape, *beside in zip(shapes, left, right):
        places = shapely.get_coordinates(sampled(shapely.force_2d(shape)))
        known = seen_by_anyone(given, places, losses.survey)
        causes = np.where(known, losses.causes(shape, *beside), "beyond the image")
        step = shape.length / len(causes)
        inside += known.sum() * step
        for cause in causes:
            total[str(cause)] += step
    length = sum(total.values())
    beyond = total.pop("beyond the image", 0.0)
    print(f"{'true lanes, m; of these beyond the image':50s} {length:.0f} {beyond:.0f}")
    print(f"{'lanes right by length: of all; within the image':50s} {total[''] / length:.3f} {total[''] / inside:.3f}")
    for cause, metres in total.most_common():
        print(f"{cause or 'right':50s} {metres:7.0f} m {metres / inside:6.1%}")
    made = shapely.union_all([area for area, lane in zip(losses.areas, losses.built.lanes) if lane.kind == "lane"])
    true = shapely.union_all(shapely.buffer(shapes, np.array(left) + 0.3, cap_style="square"))
    print(f"{'area of lanes beside true lanes, m2; share':50s} {made.difference(true).area:.0f} "
          f"{made.difference(true).area / max(made.area, 1e-9):.3f}")


if __name__ == "__main__":
    main()
