"""Walls of all buildings from a mobile survey: points, planes, contours and what is known of each (J 5.7)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial

import numpy as np
import shapely

from ..execution import in_order
from ..io.points.pointcloud import PointCloud
from ..io.raster import RasterSampler
from ..mobile.trajectory import Trajectory
from ..progress import SILENT, Progress
from ..settings.facades import OUTERMOST, WallSettings
from ..wording import say
from .beam_checks import BeamFacts, check_beams, check_start
from .building_plans import BuildingPlans, outline_edges
from .facade_points import FRONT_CELL, FacadePoints, facade_points
from .laser_beams import LaserBeams, laser_beams
from .outermost_fronts import cut_behind_balconies
from .plane_fit import WallPlane
from .standing_before import BALCONY, RECESS, SETBACK, UNCLEAR, WALL, PlacedWall, kinds_of_walls
from .wall_contours import Contour, WallCoverage, in_plane, on_map, wall_contours, wall_coverage
from .wall_planes import edge_distance, wall_segments

OK, ROUGH, PARTLY, FEW, INSIDE, BEFORE, UNDECIDED = (
    "ok", "rough", "partly seen", "few points", "inside", "before the facade", "undecided")
"""Status of a wall: sound; its points scatter more than a flat wall's; less than half of it was seen; too few points
to trust it; inside the outline behind another wall, on a roof, or farther than outlines may be off: a setback or a room
seen through a window; a canopy, sign, balcony, garden wall, hoarding or post before the facade; it or a wall at another
depth is the facade."""

ROUGHEST = 0.05
HALF = 0.5
FEW_POINTS = 30
NONE = 10  # Fewer points than this are no wall.
DEEP = 1.0  # A wall deeper inside the outline than this, m, is one only where no other stands before it.
PODIUM = 8.0  # A wall inside the outline of which nothing up to this height was seen, m, stands on a roof.
OVERLAP = 0.3  # Distance (m) by which, and share of its area of which, a wall stands before another.
STEP = 0.5
# A wall from the ground up to this height, m, is that of a storey at least.
STOREY = 3.2
FLOOR = 2.2  # A wall from the ground up to this height, m, can be that of a ground floor.
FACING = 0.94
# Cosine of the maximum angle between a wall and the outline's edge that it belongs to: 15 degrees.
MIN_EDGE_COSINE = 0.966

DEFAULTS = WallSettings()

_BEFORE = 0.3


@dataclass(frozen=True, eq=False)
class FacadeWall:
    """One contour on one plane of a building.

    Attributes
    ----------
    building_id : the building.
    plane : its plane, the normal outwards.
    contour : polygon with z on the plane, counterclockwise seen from in front, holes are openings.
    points, openings, filled : see `Contour`.
    seen : of the whole plane's rectangle.
    edge : number of the outline edge it runs along, -1 for none.
    offset : distance outwards from that edge, m.
    status, note : in words.
    kind : wall, or what stands before the facade.
    """

    building_id: int
    plane: WallPlane
    contour: shapely.Polygon
    points: int
    openings: float
    filled: float
    seen: WallCoverage
    edge: int
    offset: float
    status: str
    note: str
    kind: str = WALL


@dataclass(frozen=True)
class WallCounts:
    """What became of the buildings: those near points, and with walls."""

    near: int
    with_walls: int


@dataclass(frozen=True, eq=False)
class _Piece:
    """A building to work on."""

    building_id: int
    plan: shapely.Geometry
    top: float
    points: FacadePoints
    beams: LaserBeams | None


def find_walls(cloud: PointCloud, plans: BuildingPlans, settings: WallSettings = DEFAULTS,
               ground: RasterSampler | None = None, executor: Executor | None = None,
               progress: Progress = SILENT, trajectory: Trajectory | None = None
               ) -> tuple[list[FacadeWall], WallCounts]:
    """Walls of buildings from a survey that lies on the map.

    Parameters
    ----------
    cloud : the survey.
    plans : the buildings, in its CRS.
    ground : heights of the ground, m.
    trajectory : of the vehicle, in the points' time, CRS and heights: tells what hid a wall and where beams went
        through it.

    Raises
    ------
    InputError : the trajectory is not that of the points.
    InsufficientDataError : no point lies near any building.
    """
    if trajectory is not None:
        check_start(cloud, trajectory)
    walls: list[FacadeWall] = []
    near = with_walls = 0
    with facade_points(cloud, plans, settings, ground, progress.part(0.0, 0.5)) as buildings:
        # A worker in another process cannot be asked to stop; between buildings it is.
        work = partial(_walls_of, settings=settings, check=progress if executor is None else None)
        counted = _pieces(buildings, plans, trajectory, progress.part(0.5, 1.0))
        for found in in_order(work, counted, executor, progress.check):
            progress.check()
            near += 1
            with_walls += bool(found)
            walls.extend(found)
    return walls, WallCounts(near, with_walls)


def _pieces(buildings: Iterator[tuple[int, FacadePoints]], plans: BuildingPlans, trajectory: Trajectory | None,
            progress: Progress) -> Iterator[_Piece]:
    facts: list[BeamFacts] = []
    for row, points in buildings:
        progress.step(row / len(plans))
        if points.kept_share < 1:
            progress.warn(say("Building {ids}: only {kept_share:.0f} % of its points were used, as there are more "
                              "than fit into memory.", ids=plans.ids[row], kept_share=100 * points.kept_share))
        beams = None
        if trajectory is not None:
            beams = laser_beams(points.front, points.front_time, trajectory, FRONT_CELL)
            facts.append(BeamFacts.of(beams, points))
        yield _Piece(int(plans.ids[row]), plans.plan[row], float(plans.top[row]), points, beams)
    if trajectory is not None:
        check_beams(facts, trajectory, progress)


def _walls_of(piece: _Piece, settings: WallSettings, check: Progress | None) -> list[FacadeWall]:
    """Walls of one building."""
    ends, outward = outline_edges(piece.plan)
    given = piece.points
    planes = []
    for segment in wall_segments(given.points, given.time, ends, outward, settings, check or SILENT):
        contours = wall_contours(segment.plane, given.points[segment.points], settings)
        contours = [contour for contour in contours if contour.points >= NONE]
        if contours:
            planes.append((segment.plane, contours))
    if not planes:
        return []
    placed, edges = _placed(piece, planes, ends, outward, settings)
    kinds = kinds_of_walls(placed, given.points)
    if settings.front == OUTERMOST:
        placed, edges, kinds = cut_behind_balconies(placed, edges, kinds)
    on_front = [one for one, (kind, _) in zip(placed, kinds)
                if kind in (WALL, UNCLEAR) or (kind == BALCONY and settings.front == OUTERMOST)]
    return [_described(piece, one, edge, kind, on_front, settings) for one, edge, kind in zip(placed, edges, kinds)]


def _placed(piece: _Piece, planes: Sequence[tuple[WallPlane, Sequence[Contour]]], ends: np.ndarray,
            outward: np.ndarray, settings: WallSettings) -> tuple[list[PlacedWall], list[int]]:
    """All contours of a building where they lie, and the number of the outline's edge of each."""
    given, placed, edges = piece.points, [], []
    for plane, contours in planes:
        edge, offset = _edge_of(plane, contours, ends, outward)
        known = np.isfinite(given.ground[0])
        ground = float(plane.point[2] - given.height(plane.point[None])[0]) if known else min(
            float(_heights(plane, contour.polygon).min()) for contour in contours)
        for contour in contours:
            facade = _depth(piece.plan, plane, contour.polygon) <= settings.reach
            placed.append(PlacedWall(plane, contour, offset, ends[edge] if edge >= 0 else None, facade, ground))
            edges.append(edge)
    return placed, edges


def _described(piece: _Piece, placed: PlacedWall, edge: int, kind: tuple[str, float], walls: Sequence[PlacedWall],
               settings: WallSettings) -> FacadeWall:
    """A contour with all that is known of it; `walls` are all of the building that may be facades."""
    plane, contour = placed.plane, placed.contour
    polygon = on_map(plane, contour.polygon)
    z = shapely.get_coordinates(polygon, include_z=True)[:, 2]
    foot, top = _span(piece, plane, z, settings.max_height)
    depth = _depth(piece.plan, plane, contour.polygon)
    if depth > 0 and edge >= 0:
        depth = max(depth, -placed.offset)  # near a corner another edge is nearer than its own
    heights = float(z.min()) - foot, float(z.max()) - foot
    inside = kind[0] in (SETBACK, RECESS) or _inside(piece, placed, depth, heights, walls, settings)
    if inside:
        foot = float(z.min())  # it stands on a roof
    seen = wall_coverage(plane, [contour], foot, top, piece.points.front, piece.beams)
    of_facade = (WALL, SETBACK, RECESS, UNCLEAR, *([BALCONY] if settings.front == OUTERMOST else []))
    standing = kind[0] not in of_facade
    status, note = _front_status(*kind) if standing or kind[0] == UNCLEAR else _status(
        plane, contour.points, seen, max(depth, _BEFORE) if inside else 0.0)
    return FacadeWall(piece.building_id, plane, polygon, contour.points, contour.openings, contour.filled,
                      seen, edge, placed.offset, status, note, kind[0])


def _inside(piece: _Piece, placed: PlacedWall, depth: float, heights: tuple[float, float],
            walls: Sequence[PlacedWall], settings: WallSettings) -> bool:
    """Whether a wall so deep inside the outline (m), its foot and top at heights above the ground (m), is no facade.

    What is seen from the ground up past a storey, with nothing before it but the ground, is one at any depth: the
    outline lacks a step that the building has.
    """
    if depth <= DEEP:
        return False
    (foot, top), hidden = heights, _behind_another(placed.plane, placed.contour, walls)
    if depth > settings.reach:
        return hidden or foot > DEEP or top < STOREY or not _free_ground(piece, placed, depth)
    return hidden or foot > PODIUM


def _free_ground(piece: _Piece, placed: PlacedWall, depth: float) -> bool:
    """Whether the ground was seen before a wall, between it and the outline, along half of its length."""
    given, plane = piece.points, placed.plane
    if not np.isfinite(given.ground[0]):
        return False
    left, _, right, _ = placed.contour.polygon.bounds
    away = plane.distance(given.points)
    near = given.points[(away > _BEFORE) & (away < depth) & (np.abs(given.height(given.points)) < STEP)]
    along = in_plane(plane, near)[:, 0]
    stretches = max(int(right - left), 1)
    seen = np.histogram(along, stretches, (left, right))[0] >= NONE
    return bool(seen.mean() > HALF)


def _front_status(kind: str, before: float) -> tuple[str, str]:
    """Status and reason of what stands before the facade, or may be it."""
    if kind == UNCLEAR:
        return UNDECIDED, say("a wall at another depth may be the facade as well: a hoarding, or a storey that "
                              "stands back")
    return BEFORE, say("{kind}, {before:.1f} m before the facade", kind=say(kind), before=before)


def _span(piece: _Piece, plane: WallPlane, z: np.ndarray, max_height: float) -> tuple[float, float]:
    """Heights between which a wall could have been seen, m."""
    given = piece.points
    if np.isfinite(given.ground[0]):
        foot = float(plane.point[2] - given.height(plane.point[None])[0])
        limit = foot + max_height
    else:
        foot, limit = float(z.min()), float(z.max())
    top = min(piece.top, limit) if np.isfinite(piece.top) else float(z.max())
    return min(foot, float(z.min())), max(top, float(z.min()) + 0.1)


def _edge_of(plane: WallPlane, contours: Sequence[Contour], ends: np.ndarray,
             outward: np.ndarray) -> tuple[int, float]:
    """Outline edge that a wall runs along: the nearest that faces as it does; and how far the wall stands before it."""
    facing = outward @ plane.normal[:2]
    parallel = np.flatnonzero(facing > MIN_EDGE_COSINE)
    if not len(parallel):
        return -1, float("nan")
    along = plane.axes[0][:2]
    spans = [contour.polygon.bounds[0::2] for contour in contours]
    places = np.concatenate([np.linspace(*span, 21) for span in spans])
    xy = plane.point[:2] + places[:, None] * along
    distance = edge_distance(xy, ends[parallel])
    edge = int(parallel[distance.mean(axis=0).argmin()])
    if np.median(edge_distance(xy, ends[edge:edge + 1])) > 3.0:
        return -1, float("nan")
    return edge, float(np.mean((xy - ends[edge, 0]) @ outward[edge]))


def _depth(plan: shapely.Geometry, plane: WallPlane, flat: shapely.Polygon) -> float:
    """How deep inside the plan the middle of a wall lies, m; 0 outside."""
    left, _, right, _ = flat.bounds
    middle = shapely.Point(plane.point[:2] + (left + right) / 2 * plane.axes[0][:2])
    return float(shapely.distance(middle, shapely.boundary(plan))) if shapely.contains(plan, middle) else 0.0


def _behind_another(plane: WallPlane, contour: Contour, walls: Sequence[PlacedWall]) -> bool:
    """Whether walls that face the same way stand before a good part of a wall, by its length and its height.

    An outline that is too large has its facade inside, and nothing stands before that but a canopy, a sign, a garden
    wall or a hoarding, which hide a strip of it. A room has the facade with its windows before it, a setback the wall
    of the storeys below: this counts as if it went on upwards.
    """
    extent = shapely.box(*contour.polygon.bounds)
    foot = float(_heights(plane, extent).min())
    ground = min((float(_heights(other.plane, other.contour.polygon).min()) for other in walls), default=foot)
    covered = []
    for other in walls:
        if other.plane.normal @ plane.normal < FACING:
            continue
        corners = shapely.get_coordinates(on_map(other.plane, shapely.box(*other.contour.polygon.bounds)),
                                          include_z=True)[:-1]
        if np.mean(plane.distance(corners)) > _BEFORE:
            flat, z = in_plane(plane, corners), corners[:, 2]
            (left, low), (right, high) = flat.min(axis=0), flat.max(axis=0)
            if z.min() < ground + 1.0 and z.max() > ground + FLOOR and foot > z.max() - STEP:
                high = extent.bounds[3]
            covered.append(shapely.intersection(shapely.box(left, low, right, high), extent))
    return bool(shapely.union_all(covered).area > OVERLAP * extent.area) if covered else False


def _heights(plane: WallPlane, flat: shapely.Polygon) -> np.ndarray:
    """Heights (n,) of the corners of a polygon in the plane, m."""
    return shapely.get_coordinates(on_map(plane, flat), include_z=True)[:, 2]


def _status(plane: WallPlane, points: int, seen: WallCoverage, depth: float) -> tuple[str, str]:
    """Status of a wall and the reason; `depth` is m inside the outline of what is no facade, else 0."""
    if points < FEW_POINTS:
        return FEW, say("only {points} points lie on it", points=points)
    if plane.rmse > ROUGHEST:
        return ROUGH, say("its points scatter by {rmse:.0f} cm: no flat wall, or drives that disagree",
                          rmse=100 * plane.rmse)
    if depth > 0:
        return INSIDE, say("it lies {depth:.1f} m inside the outline: a setback, or a room seen through a window",
                           depth=depth)
    if seen.coverage < HALF:
        return PARTLY, say("{coverage:.0f} % of it was seen; {why}", coverage=100 * seen.coverage, why=_why(seen))
    return OK, ""


def _why(seen: WallCoverage) -> str:
    """Why most of the rest of a wall was not seen."""
    if seen.through > max(seen.hidden, seen.unseen):
        return say("beams went through most of the rest: glass, or openings")
    if seen.hidden > seen.unseen:
        return say("something stands in front")
    return say("the survey did not see the rest")


WALL_COLUMNS = ("building_id", "wall_id", "status", "note", "area", "height", "length", "azimuth", "tilt", "normal_x",
                "normal_y", "normal_z", "points", "passes", "rmse", "sigma", "pass_spread", "coverage", "hidden",
                "unseen", "openings", "filled", "edge", "offset", "kind", "through")
"""Names of the columns of a layer of walls, in order."""


def wall_columns(walls: Sequence[FacadeWall]) -> dict[str, list]:
    """Columns of `WALL_COLUMNS`; walls are numbered within their building from 1, the largest plane first."""
    columns: dict[str, list] = {name: [] for name in WALL_COLUMNS}
    number: dict[int, int] = {}
    for wall in walls:
        number[wall.building_id] = number.get(wall.building_id, 0) + 1
        for name, value in _row(wall, number[wall.building_id]).items():
            columns[name].append(value)
    return columns


def _row(wall: FacadeWall, number: int) -> dict:
    plane, seen = wall.plane, wall.seen
    outer = in_plane(plane, shapely.get_coordinates(wall.contour.exterior, include_z=True))
    length, height = np.ptp(outer, axis=0)
    return {
        "building_id": wall.building_id, "wall_id": number, "status": wall.status, "note": wall.note,
        "area": contour_area(plane, wall.contour), "height": float(height), "length": float(length),
        "azimuth": float(np.degrees(np.arctan2(plane.normal[0], plane.normal[1])) % 360.0), "tilt": plane.tilt,
        "normal_x": float(plane.normal[0]), "normal_y": float(plane.normal[1]), "normal_z": float(plane.normal[2]),
        "points": wall.points, "passes": plane.passes, "rmse": plane.rmse, "sigma": plane.sigma,
        "pass_spread": plane.pass_spread, "coverage": seen.coverage, "hidden": seen.hidden, "unseen": seen.unseen,
        "openings": wall.openings, "filled": wall.filled, "edge": wall.edge if wall.edge >= 0 else None,
        "offset": wall.offset, "kind": wall.kind, "through": seen.through if np.isfinite(seen.through) else None,
    }


def contour_area(plane: WallPlane, contour: shapely.Polygon) -> float:
    """Area of a contour in its plane, m2."""
    flat = [in_plane(plane, shapely.get_coordinates(ring, include_z=True)) for ring in (
        contour.exterior, *contour.interiors)]
    return float(shapely.Polygon(flat[0], flat[1:]).area)
