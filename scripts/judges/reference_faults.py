"""What registration makes of a wrong reference: road re-marked after the flight, a frame off, stretches without paint.

CITY is a sample city, GROUND the raster of “Surface and ground from ALS”. The reference is made of the true markings,
each 1.5 cm off and every twentieth left out, then wronged; the corrected trajectory is compared with the true one at
every patch. BUILDINGS are walls as a second witness: straight by themselves (own), official outlines (map), roof edges
(roofs), airborne laser points (als); or kerbs on lines of a map (kerbs). CACHE is a folder that keeps markings.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np
import shapely

from scripts.bench_table import print_table, table_lines
from scripts.judges.faults import (
    DrivenSurvey,
    Fault,
    Outcome,
    constant_fault,
    moved_walls,
    percent,
    read_survey,
    run,
    step_fault,
)
from scripts.layers import plans_of, read_layer
from urbanmap_qgis.facades.building_plans import building_plans, outline_edges
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.registration.correction.patch_status import DISTRUSTED, REGISTERED
from urbanmap_qgis.mobile.registration.correction.settings import CorrectionSettings
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.registration.walls.outline_walls import WallEdges
from urbanmap_qgis.mobile.registration.walls.survey_walls import walls_of
from urbanmap_qgis.mobile.registration.walls.witness import WallWitness
from urbanmap_qgis.mobile.trajectory import Trajectory, interpolate, path_chainage
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.roadmap.edges.kerb_witness import kerbs_of

WRONG = 0.1
"""m in plan: a registered patch that is farther off, and by more than three sigma, is a confident wrong answer."""

PLACE_SIGMA, LEFT_OUT = 0.015, 0.05
"""m, of each marking of the reference, and share of them that it has not."""

EAVES, OUTLINE_SIGMA = (0.3, 0.9), 0.05
"""m that roof edges stand out before the facades, and that an outline of them is off."""

KERB_SIGMA, KERB_PIECE = 0.05, 30.0
"""m that lines of kerbs are off across, piece by piece, and the length of a piece."""

REACH = 15.0
"""m to either side of the path: what belongs to a stretch of it."""


@dataclass(frozen=True)
class Marks:
    """Marking polygons (n,) and their kinds (n,)."""

    polygons: np.ndarray
    kind: np.ndarray

    def select(self, which: np.ndarray) -> Marks:
        """Some of them."""
        return Marks(self.polygons[which], self.kind[which])

    def moved(self, which: np.ndarray, shift: np.ndarray) -> Marks:
        """With some of them moved by (2,) m."""
        polygons = self.polygons.copy()
        polygons[which] = shapely.transform(polygons[which], lambda place: place + shift)
        return Marks(polygons, self.kind)

    def split(self, zone: shapely.Geometry) -> tuple[Marks, np.ndarray]:
        """Cut at the edge of a zone, and which lie within it."""
        parts, kinds, inside = [], [], []
        for geometries, within in ((shapely.intersection(self.polygons, zone), True),
                                   (shapely.difference(self.polygons, zone), False)):
            pieces, owner = shapely.get_parts(geometries, return_index=True)
            area = (shapely.get_type_id(pieces) == shapely.GeometryType.POLYGON) & (shapely.area(pieces) > 1e-3)
            parts.append(pieces[area])
            kinds.append(self.kind[owner[area]])
            inside.append(np.full(np.count_nonzero(area), within))
        return Marks(np.concatenate(parts), np.concatenate(kinds)), np.concatenate(inside)


@dataclass(frozen=True)
class Scene:
    """A survey and the markings of its reference."""

    survey: DrivenSurvey
    marks: Marks

    def stretch(self, begin: float, end: float) -> shapely.Geometry:
        """The ground beside the true path between two shares of its length."""
        true = self.survey.true
        way = path_chainage(true)
        some = (way >= begin * way[-1]) & (way <= end * way[-1])
        return shapely.buffer(shapely.LineString(true.place[some, :2][::20]), REACH, cap_style="flat")

    def about(self, share: float, length: float) -> tuple[float, float]:
        """Shares of the path between which `length` m of it about a share of it lie."""
        half = 0.5 * length / path_chainage(self.survey.true)[-1]
        return share - half, share + half

    def axes(self, share: float) -> np.ndarray:
        """(2, 2) unit vectors along and aside of the path at a share of it."""
        way = path_chainage(self.survey.true)
        heading = np.radians(self.survey.true.angles[np.searchsorted(way, share * way[-1]), 2])
        along = np.array([np.sin(heading), np.cos(heading)])
        return np.array([along, [along[1], -along[0]]])


def remarked(length: float, along: float, aside: float, at: float = 0.3) -> Callable[[Scene], Scene]:
    """Paint of `length` m about a share of the path lay elsewhere at the flight."""
    def change(scene: Scene) -> Scene:
        marks, inside = scene.marks.split(scene.stretch(*scene.about(at, length)))
        return replace(scene, marks=marks.moved(inside, np.array([along, aside]) @ scene.axes(at)))
    return change


def repainted(share: float, size: float) -> Callable[[Scene], Scene]:
    """So many of all markings, here and there, lay elsewhere at the flight, all by one shift."""
    def change(scene: Scene) -> Scene:
        chosen = np.random.default_rng(5).random(len(scene.marks.kind)) < share
        return replace(scene, marks=scene.marks.moved(chosen, size * np.array([0.6, 0.8])))
    return change


def frame_off(size: float, at: float = 0.35) -> Callable[[Scene], Scene]:
    """The reference beyond a share of the path comes from a frame that is off."""
    def change(scene: Scene) -> Scene:
        marks, inside = scene.marks.split(scene.stretch(at, 1.0))
        return replace(scene, marks=marks.moved(inside, size * np.array([0.6, 0.8]) @ scene.axes(at)))
    return change


def bare(length: float) -> Callable[[Scene], Scene]:
    """No reference in the middle."""
    def change(scene: Scene) -> Scene:
        marks, inside = scene.marks.split(scene.stretch(*scene.about(0.5, length)))
        return replace(scene, marks=marks.select(~inside))
    return change


def only(kinds: tuple[str, ...], off: float) -> Callable[[Scene], Scene]:
    """Lines of some kinds alone, in the reference and the survey, which is reported `off` m aside of the truth."""
    def change(scene: Scene) -> Scene:
        survey, marks = scene.survey, scene.marks.select(np.isin(scene.marks.kind, kinds))
        true, old = survey.true, survey.markings
        survey_marks = old.select(survey.reported.within(old.time) & true.within(old.time))
        near = interpolate(survey.reported, survey_marks.time).place - interpolate(true, survey_marks.time).place
        place = shapely.points(survey_marks.x - near[:, 0], survey_marks.y - near[:, 1])
        found, _ = shapely.STRtree(marks.polygons).query(place, predicate="dwithin", distance=0.15)
        kept = survey_marks.select(np.unique(found))
        moved = DrivenSurvey(survey.name, kept, survey.reported, true)
        little = interpolate(true, survey.reported.time, "hold").place - survey.reported.place
        target = survey.reported.place + 0.97 * little + np.append(off * scene.axes(0.3)[1], 0.0)
        return Scene(_reported_at(moved, target), marks)
    return change


def _reported_at(survey: DrivenSurvey, place: np.ndarray) -> DrivenSurvey:
    """The survey as if its trajectory had been reported at places (e, 3)."""
    reported, old = survey.reported, survey.markings
    shift = Trajectory(reported.time, place - reported.place, reported.angles)
    dx, dy, dz = interpolate(shift, old.time).place.T
    return replace(survey, reported=Trajectory(reported.time, place, reported.angles),
                   markings=replace(old, x=old.x + dx, y=old.y + dy, z=old.z + dz))


def height_step(size: float, length: float) -> Fault:
    """The reported height steps by `size` m within `length` m of path in the middle of the drive."""
    def change(chainage: np.ndarray, _trajectory: Trajectory) -> np.ndarray:
        made = np.zeros((len(chainage), 6))
        made[:, 2] = size * np.clip((chainage - 0.5 * chainage[-1]) / length + 0.5, 0.0, 1.0)
        return made
    return Fault(f"height step of {size:g} m in {length:g} m", change)


def middle_step(size: float, share: float = 0.0) -> Fault:
    """A re-fix of `size` m in 20 m, `share` m before the middle of the drive."""
    def change(chainage: np.ndarray, trajectory: Trajectory) -> np.ndarray:
        begin = 0.5 * chainage[-1] - share
        return step_fault(size, 20.0, share=begin / 190.0).change(chainage, trajectory)
    return Fault(f"step of {size:g} m", change)


NONE = constant_fault("as reported", (0, 0, 0, 0, 0, 0))
LINES = ("edge", "centre", "lane")


def unchanged(scene: Scene) -> Scene:
    """The reference as it is."""
    return scene


CASES: dict[str, list[tuple[str, Callable[[Scene], Scene], Fault]]] = {
    "none": [("no fault", unchanged, NONE)],
    "remarked": [("100 m re-marked 0.5 m aside", remarked(100, 0.0, 0.5), NONE),
                 ("40 m re-marked 0.5 m aside", remarked(40, 0.0, 0.5), NONE),
                 ("100 m re-marked 1 m along", remarked(100, 1.0, 0.0), NONE)],
    "repainted": [("60 % repainted by one shift", repainted(0.6, 0.5), NONE)],
    "f12": [("65 % of the reference 0.12 m off", frame_off(0.12), NONE)],
    "frame": [("65 % of the reference 0.36 m off", frame_off(0.36), NONE),
              ("65 % of the reference 0.12 m off", frame_off(0.12), NONE)],
    "half": [("half of the reference 0.36 m off", frame_off(0.36, 0.5), NONE)],
    "long": [("300 m bare", bare(300), NONE)],
    "b2": [("85 m bare, step of 2 m at its side", bare(85), middle_step(2.0, 25.0))],
    "bare": [("85 m bare", bare(85), NONE), ("85 m bare, step of 1 m", bare(85), middle_step(1.0)),
             ("85 m bare, step of 2 m at its side", bare(85), middle_step(2.0, 25.0))],
    "thin": [("lines alone, 0.3 m off", only(LINES, 0.3), NONE), ("lines alone, right", only(LINES, 0.0), NONE),
             ("edge lines alone, 0.3 m off", only(("edge", "centre"), 0.3), NONE)],
    "step": [("reference right, step of 1.5 m", unchanged, middle_step(1.5))],
    "height": [("height step of 0.5 m", unchanged, height_step(0.5, 20.0))],
}

HEADER = ("case", "city", "mean (m)", "max", "registered", "distrusted", "registered and wrong", "kept over 3 sigma",
          "median sigma (m)", "steps told", "CPU (ms/m)")
SIGMA_HEADER = ("case", "city", "within 1 / 2 sigma: east", "north", "up", "roll", "pitch", "heading",
                "pitch before (deg)", "after", "height after (m)")


def rows_of(case: str, city: str, made: Outcome | str) -> tuple[tuple, tuple]:
    """Figures of one run, in both tables."""
    if isinstance(made, str):
        return ((case, city, f"refused: {made[:50]}", *[""] * (len(HEADER) - 3)),
                (case, city, *[""] * (len(SIGMA_HEADER) - 2)))
    plan, kept, sure = made.plan, made.status != DISTRUSTED, made.status == REGISTERED
    ratio = np.abs(made.error) / made.sigma
    over = (ratio[:, :2] > 3).any(axis=1)
    sigma = np.hypot(made.sigma[:, 0], made.sigma[:, 1]) / np.sqrt(2)
    both = [f"{percent(ratio[kept, axis] < 1)} / {percent(ratio[kept, axis] < 2)}" for axis in range(6)]
    pitch = [float(np.abs(part[kept, 4]).mean()) for part in (made.before, made.error)] if kept.any() else ["", ""]
    return ((case, city, float(plan.mean()), float(plan.max()), percent(sure), percent(~kept),
             int((sure & over & (plan > WRONG)).sum()), int((kept & over).sum()), float(np.median(sigma)),
             made.told, f"{1000 * made.seconds / made.length:.0f}"),
            (case, city, *both, *pitch, float(np.abs(made.error[kept, 2]).mean()) if kept.any() else ""))


def read_marks(city: Path) -> Marks:
    """The markings at the flight, each a little off, some left out."""
    polygons, (kinds, private) = read_layer(city / "truth" / "markings.gpkg", "kind", "private", layer="aerial")
    public = np.array(private) == 0
    polygons, owner = shapely.get_parts(shapely.force_2d(polygons[public]), return_index=True)
    rng = np.random.default_rng(3)
    off = rng.normal(0.0, PLACE_SIGMA, (len(polygons), 2))
    marks = [shapely.transform(polygon, lambda place, by=by: place + by) for polygon, by in zip(polygons, off)]
    kept = rng.random(len(marks)) > LEFT_OUT
    return Marks(np.array(marks, dtype=object)[kept], np.array(kinds)[public][owner][kept])


def cached_survey(city: Path, name: str, cache: Path | None) -> DrivenSurvey:
    """The survey with its markings, which are kept in a folder for the next time."""
    if cache is None:
        return read_survey(city, name)
    file = cache / f"{city.name}_{name}.npz"
    if not file.is_file():
        made = read_survey(city, name).markings
        cache.mkdir(parents=True, exist_ok=True)
        np.savez(file, **{item.name: getattr(made, item.name) for item in fields(made)})
    with np.load(file) as stored:
        markings = MarkingPoints(**{item.name: stored[item.name] for item in fields(MarkingPoints)})
    reported, true = (read_trajectory(path, "").trajectory for path in (
        city / "mms" / f"{name}_trajectory.csv", city / "truth" / f"{name}_trajectory.csv"))
    return DrivenSurvey(name, markings, reported, true)


def buildings_of(city: Path, kind: str) -> np.ndarray:
    """Outlines of a city's buildings: "map" as an official map has them; "roofs" true ones grown by unlike eaves."""
    if kind == "map":
        return plans_of(city / "footprints" / "gsi_buildings.gpkg", "BldA")
    plans = plans_of(city / "truth" / "footprints.gpkg", "wall_footprints")
    rng = np.random.default_rng(7)
    eaves, off = rng.uniform(*EAVES, len(plans)), rng.normal(0.0, OUTLINE_SIGMA, (len(plans), 2))
    grown = shapely.buffer(plans, eaves, join_style="mitre")
    return np.array([shapely.transform(plan, lambda place, by=by: place + by) for plan, by in zip(grown, off)],
                    dtype=object)


def kerb_lines(city: Path) -> np.ndarray:
    """Lines (n,) of a city's true kerbs, each piece of them off by as much as a good map's."""
    kerbs = shapely.union_all(plans_of(city / "truth" / "edges.gpkg", "kerbs"))
    whole = shapely.line_merge(shapely.set_precision(kerbs, 1e-3))
    parts = shapely.segmentize(shapely.simplify(shapely.get_parts(whole), 0.03), KERB_PIECE)
    places, line = shapely.get_coordinates(parts, return_index=True)
    ends = np.stack([places[:-1], places[1:]], axis=1)[line[1:] == line[:-1]]
    along = ends[:, 1] - ends[:, 0]
    across = np.column_stack([-along[:, 1], along[:, 0]]) / np.hypot(*along.T)[:, None]
    off = np.random.default_rng(5).normal(0.0, KERB_SIGMA, len(ends))
    return shapely.linestrings(ends + (off[:, None] * across)[:, None])


def walls_near(city: Path, survey: DrivenSurvey, kind: str) -> WallWitness | None:
    """The survey's facades, with a city's outlines, laser points ("als") or ("own") neither; its kerbs of kind "kerbs",
    None of "none"."""
    if kind == "none":
        return None
    if kind == "kerbs":
        return kerbs_of([city / "mms" / f"{survey.name}.laz"], survey.reported, CorrectionSettings().time_weight,
                        kerb_lines(city))
    edges = None
    if kind not in ("own", "als"):
        plans = buildings_of(city, kind)
        plans = building_plans(plans, np.arange(len(plans))).plan
        edges = WallEdges.joined([outline_edges(plan) for plan in plans if plan is not None])
    begin = time.process_time()
    walls = walls_of([city / "mms" / f"{survey.name}.laz"], survey.reported, CorrectionSettings().time_weight, edges,
                     laser=[city / "als" / "als.laz"] if kind == "als" else None)
    spent = (time.process_time() - begin) / path_chainage(survey.reported)[-1]
    print(f"{len(walls.planes)} planes of facades, {1000 * spent:.1f} ms of CPU a metre", flush=True)
    return walls


def judge(city: Path, ground: Path, cases: tuple[str, ...] = tuple(CASES), survey: str = "survey_01",
          buildings: str = "none", cache: Path | None = None) -> None:
    """Print a row of both tables for each case, and the tables."""
    scene, rows, sigmas = Scene(cached_survey(city, survey, cache), read_marks(city)), [], []
    walls = walls_near(city, scene.survey, buildings)
    for title, change, fault in [item for kind in cases for item in CASES[kind]]:
        wrong = change(scene)
        made = "no marking of these kinds" if not len(wrong.marks.kind) else run(
            wrong.survey, fault, Reference.from_polygons(wrong.marks.polygons, ground),
            RegistrationSettings(three_d=True), moved_walls(walls, scene.survey.reported, wrong.survey.reported))
        for found, row in zip((rows, sigmas), rows_of(title, f"{city.name} {survey}", made)):
            found.append(row)
        print("\n".join([*table_lines(HEADER, rows[-1:])[2:], *table_lines(SIGMA_HEADER, sigmas[-1:])[2:]]), flush=True)
    print_table("Wrong references", HEADER, rows)
    print_table("Their sigmas", SIGMA_HEADER, sigmas)
