#!/usr/bin/env python3
"""Draw a street without paint before and after its registration by walls, and where markings changed after the flight.

    python3 scripts/draw_witness.py --city FOLDER GROUND [--survey survey_01] [--cache FOLDER] witness.jpg

FOLDER is a sample city, GROUND the raster of “Surface and ground from ALS”; walls are those of its airborne points. The
cases are those of `evaluate_reference_faults.py`.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import shapely
from evaluate_reference_faults import Scene, bare, cached_survey, read_marks, remarked, walls_near

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from urbanmap_qgis.mobile.registration.disagreement_areas import area_table
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.registered_survey import RegisteredSurvey
from urbanmap_qgis.mobile.registration.run import RegistrationRun
from urbanmap_qgis.mobile.registration.stage import register_markings
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.registration.walls.witness import WallWitness
from urbanmap_qgis.mobile.trajectory import Trajectory, interpolate, move_points, path_chainage

SCALE, FINER = 9.0, 2
"""Pixels a metre, and by how much finer is drawn than written."""

EXTENT = (44.0, 28.0)
"""m along and across the street."""

GROUND, TRUE, POINTS, WALLS, FLIGHT, AREA = ((250, 250, 250), (205, 205, 205), (180, 90, 20), (60, 140, 30),
                                             (20, 120, 230), (170, 170, 255))


@dataclass(frozen=True)
class View:
    """A picture (h, w, 3) of the ground about a place (2,) m, with the street along `along` (2,) to the right."""

    picture: np.ndarray
    centre: np.ndarray
    along: np.ndarray

    @classmethod
    def about(cls, true: Trajectory, share: float) -> View:
        """About a share of a drive."""
        way = path_chainage(true)
        place = np.column_stack([np.interp(share * way[-1] + side, way, axis) for side in (-3.0, 3.0)
                                 for axis in true.place[:, :2].T]).reshape(2, 2)
        along = (place[1] - place[0]) / np.hypot(*(place[1] - place[0]))
        size = [int(side * SCALE * FINER) for side in EXTENT]
        return cls(np.full((size[1], size[0], 3), GROUND, np.uint8), place.mean(axis=0), along)

    def pixels(self, place: np.ndarray) -> np.ndarray:
        """(n, 2) whole pixels of places (n, 2) m."""
        off = place[:, :2] - self.centre
        across = np.array([self.along[1], -self.along[0]])
        middle = np.array(self.picture.shape[1::-1]) / 2.0
        return np.round(middle + SCALE * FINER * np.column_stack([off @ self.along, off @ across])).astype(int)

    def fill(self, polygons: np.ndarray, colour: tuple[int, int, int], edge: int = 0) -> None:
        """Polygons, or their edges alone, `edge` pixels wide."""
        for polygon in shapely.get_parts(polygons):
            ring = self.pixels(shapely.get_coordinates(polygon.exterior)).astype(np.int32)
            if edge:
                cv2.polylines(self.picture, [ring], True, colour, edge * FINER, cv2.LINE_AA)
            else:
                cv2.fillPoly(self.picture, [ring], colour, cv2.LINE_AA)

    def dots(self, place: np.ndarray, colour: tuple[int, int, int], size: int = 1) -> None:
        """Points (n, 2)."""
        for x, y in self.pixels(place):
            cv2.circle(self.picture, (int(x), int(y)), size, colour, -1, cv2.LINE_AA)

    def finished(self, title: str) -> np.ndarray:
        """The picture as it is written, with its title."""
        small = cv2.resize(self.picture, None, fx=1 / FINER, fy=1 / FINER, interpolation=cv2.INTER_AREA)
        head = np.full((26, small.shape[1], 3), 255, np.uint8)
        cv2.putText(head, title, (4, 18), cv2.FONT_HERSHEY_SIMPLEX, 0.4, (40, 40, 40), 1, cv2.LINE_AA)
        return np.vstack([head, small])


def seen(points: np.ndarray, time: np.ndarray, before: Trajectory, after: Trajectory) -> np.ndarray:
    """Points (n, 3) that a trajectory placed, as another one does."""
    return move_points(points, time, before, after)


def street(scene: Scene, made: RegisteredSurvey, walls: WallWitness, after: Trajectory, title: str,
           share: float) -> np.ndarray:
    """The paint and facades of the survey by a trajectory, on what is there."""
    reported, old = scene.survey.reported, made.markings
    view = View.about(scene.survey.true, share)
    view.fill(scene.marks.polygons, TRUE)
    for begin, end in walls.edges.ends:
        ends = view.pixels(np.array([begin, end]))
        cv2.line(view.picture, *(tuple(int(v) for v in one) for one in ends), WALLS, 2 * FINER, cv2.LINE_AA)
    time = np.interp(walls.planes.chainage, path_chainage(reported), reported.time)
    view.dots(seen(walls.planes.place, time, reported, after), (60, 60, 60), 3)
    view.dots(seen(np.column_stack([old.x, old.y, old.z]), old.time, reported, after), POINTS)
    error = interpolate(after, made.correction.time, "hold").place - interpolate(
        scene.survey.true, made.correction.time, "hold").place
    near = np.abs(made.correction.chainage - share * made.correction.chainage[-1]) < EXTENT[0] / 2.0
    off = np.hypot(*error[near, :2].T).mean()
    return view.finished(f"{title}: {off:.2f} m off here")


def changed(scene: Scene, wrong: Scene, made: RegisteredSurvey, share: float) -> np.ndarray:
    """The layer of changed markings over paint of the flight and of the drive."""
    view = View.about(scene.survey.true, share)
    columns, areas = area_table(made)
    view.fill(areas, AREA)
    view.fill(wrong.marks.polygons, FLIGHT, 1)
    old = made.markings
    view.dots(seen(np.column_stack([old.x, old.y, old.z]), old.time, scene.survey.reported, made.trajectory), POINTS)
    told = "; ".join(f"{begin:.0f} to {end:.0f} m: {size:.2f} m" for begin, end, size in zip(
        columns["begin"], columns["end"], columns["size"]))
    return view.finished(f"Re-marked 0.5 m aside: {told}")


def main() -> int:
    """Draw."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--city", nargs=2, type=Path, required=True, metavar=("FOLDER", "GROUND"))
    parser.add_argument("--survey", default="survey_01")
    parser.add_argument("--cache", type=Path, help="folder that keeps extracted markings")
    parser.add_argument("output", type=Path, help="picture to write")
    given = parser.parse_args()
    city, ground = given.city
    scene = Scene(cached_survey(city, given.survey, given.cache), read_marks(city))
    survey, run, found = scene.survey, RegistrationRun(RegistrationSettings(three_d=True)), []
    walls = walls_near(city, survey, "als")
    without, wrong = bare(300.0)(scene), remarked(100.0, 0.0, 0.5)(scene)
    made = register_markings(survey.markings, survey.reported, Reference.from_polygons(without.marks.polygons, ground),
                             run, walls=walls)
    for title, trajectory in (("As reported", survey.reported), ("Registered by walls", made.trajectory)):
        found.append(street(scene, made, walls, trajectory, f"No paint for 300 m. {title}", 0.42))
    made = register_markings(survey.markings, survey.reported, Reference.from_polygons(wrong.marks.polygons, ground),
                             run)
    found.append(changed(scene, wrong, made, 0.3 - 50.0 / path_chainage(survey.true)[-1]))
    cv2.imwrite(str(given.output), np.vstack(found), [cv2.IMWRITE_JPEG_QUALITY, 60])
    return 0


if __name__ == "__main__":
    sys.exit(main())
