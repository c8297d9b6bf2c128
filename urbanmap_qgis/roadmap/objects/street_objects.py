"""Street objects of a survey, tile by tile of the map (J 6.2, Z 4): stems, their axes, what hangs on them, kinds."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import open_cloud
from ...mobile.trajectory import Trajectory
from ...progress import SILENT, Progress
from ...settings.roadmap import ObjectSettings
from ...wording import say
from ..edges.edge_points import EdgePoints, EdgeTile, Reach
from ..edges.ground_profile import Heights, above_ground
from .axis_fit import fit_axis
from .hanging_parts import LIMITS as AROUND
from .hanging_parts import off_stem
from .lone_boards import lone_boards, stands_alone
from .low_objects import ends_as, low_objects
from .object_kind import Hung, hung_on
from .object_records import DOUBTFUL, MEASURED, OBJECT_POINT, POLE, SIGN, TREE, Board, Stem, StemAxis, StreetObject
from .stems import LIMITS as STEM_LIMITS
from .stems import find_stems
from .sweep_index import SweepIndex

DEFAULTS = ObjectSettings()
REACH = Reach(tile=40.0, margin=6.0, above=16.0)


@dataclass(frozen=True)
class StreetObjectLimits:
    """Limits of street objects, each with its unit."""

    lean: float = 0.004  # standard deviation of a stem's lean, m for each metre up
    hidden: float = 1.3  # m, more than a guard rail hides; stems that are seen from here on only have their foot hidden
    post: float = 1.4  # m; what is thin over less than this is no post, but may be the trunk of a tree
    few: int = 20  # points of a stem
    crowded: float = 0.5  # m beside a stem, where other things hide how thin it is
    crowd: float = 1.0  # points there, of those of the stem
    # Points that hang on it like a wall, for each of the stem: of what is one, and of what may be one.
    wall: float = 1.0
    walled: float = 0.2
    broken: float = 0.75  # share of its slabs in which a clear stem shows
    frame: float = 0.05  # m over and under a board, where its points pass for its post's
    bare: float = 0.6  # m of height that a post shows without its board, to be placed by that alone
    stem_reach: float = 1.5  # m in plan from the foot of a stem, within which all of it stands
    behind: float = 0.04  # m behind a board that hides its post, where that stands: half of what such posts measure
    post_in_width: float = 4.0  # of a board, over which its post is one standard deviation from its middle
    beside: float = 0.3  # m; what is low and stands closer to something tall is a part of that
    same: float = 0.5  # m; stems closer than this, over each other, are one thing
    second: float = 0.05  # likelihood from which a second kind is named


LIMITS = StreetObjectLimits()


@dataclass(frozen=True)
class ObjectsFound:
    """Objects and what they come from.

    Attributes
    ----------
    objects : in the order of the map's tiles.
    path_length : m driven.
    points_read, points_used : of the survey.
    """

    objects: list[StreetObject]
    path_length: float
    points_read: int
    points_used: int

    def number(self, kind: str) -> int:
        """How many objects are of a kind."""
        return sum(thing.kind == kind for thing in self.objects)


def street_objects(paths: Sequence[str | os.PathLike], trajectory: Trajectory, settings: ObjectSettings = DEFAULTS,
                   ground: Heights | None = None, progress: Progress = SILENT) -> ObjectsFound:
    """Find poles, lamp posts, signals, signs, trees, bollards and boxes along a drive.

    Parameters
    ----------
    paths : LAS or LAZ files with GPS times, in a projected CRS in metres, placed by `trajectory`.
    ground : heights (m) of the ground at places x, y; without it the ground is found among the points.

    Raises
    ------
    InsufficientDataError : no points beside the path.
    InputError : the files cannot be read.
    """
    objects: list[StreetObject] = []
    with PointBuckets(OBJECT_POINT) as buckets:
        survey = EdgePoints(open_cloud(paths), trajectory, settings.width, buckets, REACH)
        survey.read(progress.part(0.0, 0.4))
        local = None if ground is None else lambda x, y: ground(x + survey.corner[0], y + survey.corner[1])
        for tile in survey.tiles(progress.part(0.4, 1.0)):
            objects += _objects_of_tile(tile, above_ground(tile.points, local, shaded=True), survey, settings)
    return ObjectsFound(objects, float(survey.chainage[-1]), survey.read_points, survey.kept_points)


def _objects_of_tile(tile: EdgeTile, height: np.ndarray, survey: EdgePoints,
                     settings: ObjectSettings) -> list[StreetObject]:
    """Objects whose feet belong to a tile."""
    # Nothing here looks at what lies lower: most of a survey's points are the road's.
    over = np.flatnonzero(height > STEM_LIMITS.lowest)
    points, height = tile.points[over], height[over]
    place = np.column_stack([points[name] for name in "xyz"])
    index = SweepIndex(place[:, :2])
    where = _may_stand(place, tile, survey)
    boards = lone_boards(place, height, index, survey.body(points["time"]), where)
    low = low_objects(points, place, height, index, survey, where, settings.survey_sigma)
    found: list[StreetObject] = []
    for stem in find_stems(points, height, settings.max_diameter, where):
        seen_from = survey.body(points["time"][stem.rows])
        axis = fit_axis(place[stem.rows], seen_from)
        ground = float(np.median(place[stem.rows, 2] - height[stem.rows]))
        foot = axis.plan_at(ground)
        if not tile.owns(foot[None])[0] or not survey.within(foot[None])[0] or axis.diameter > settings.max_diameter:
            continue
        near = index.near(foot, AROUND.reach + 0.5)
        hung = hung_on(place[near], height[near], axis, stem, seen_from, boards)
        bare = _beside_board(place[stem.rows], hung[3])
        if bare is not None:
            axis = fit_axis(place[stem.rows[bare]], seen_from[bare])
            foot = axis.plan_at(ground)
            hung = hung_on(place[near], height[near], axis, stem, seen_from, boards)
        around = hung[0]
        short = stem.high - stem.low < LIMITS.post and not around.crown and not _under_board(stem, hung[3], ground)
        wall = around.straight and around.wall > LIMITS.wall * len(stem.rows)
        if short or wall or max(around.top, stem.high) < settings.min_height or (
                around.crown and any(ends_as(thing, stem, foot) for thing in low)):
            continue
        crowd = _crowd(place[near], height[near], stem, axis)
        found.append(_object(stem, axis, np.array([*foot, ground]), hung, crowd,
                             len(np.unique(points["drive"][stem.rows])), survey.corner, settings))
    found = _without_doubles(found)
    found += [_sign_without_post(board, place, height, survey.corner, settings) for board in boards
              if tile.owns(board.centre[None, :2])[0] and survey.within(board.centre[None, :2])[0]
              and all(np.linalg.norm(thing.board.centre - survey.corner - board.centre) > LIMITS.same
                      for thing in found if thing.board is not None)
              and stands_alone(place, height, board)]
    return found + [replace(thing, foot=thing.foot + survey.corner) for thing in low
                    if tile.owns(thing.foot[None, :2])[0] and survey.within(thing.foot[None, :2])[0]
                    and all(np.hypot(*(thing.foot + survey.corner - other.foot)[:2]) > LIMITS.beside
                            for other in found)]


def _sign_without_post(board: Board, place: np.ndarray, height: np.ndarray, corner: np.ndarray,
                       settings: ObjectSettings) -> StreetObject:
    """A sign of which the board alone shows: its post stands somewhere behind that."""
    towards = np.radians(board.azimuth)
    post = board.centre[:2] - LIMITS.behind * np.array([np.sin(towards), np.cos(towards)])
    near = np.argmin(np.hypot(*(place[:, :2] - post).T))
    foot = np.array([*post, place[near, 2] - height[near]])
    on = np.count_nonzero(np.linalg.norm(place - board.centre, axis=1) < board.height / 2.0)
    sigma = float(np.hypot(board.width / LIMITS.post_in_width, settings.survey_sigma))
    return StreetObject(SIGN, 0.3, foot + corner, float(board.centre[2] + board.height / 2.0 - foot[2]), None,
                        None, board.azimuth, None, None, replace(board, centre=board.centre + corner), sigma, int(on),
                        1, DOUBTFUL, say("its post is not seen"), None)


def _may_stand(place: np.ndarray, tile: EdgeTile, survey: EdgePoints) -> np.ndarray:
    """Mask (n,) of points that may be of a stem whose foot the tile owns, within the width of the path."""
    low, side = tile.low - LIMITS.stem_reach, int(np.ceil(tile.side + 2.0 * LIMITS.stem_reach))
    column, row = np.meshgrid(np.arange(side), np.arange(side), indexing="ij")
    middles = low + 0.5 + np.column_stack([column.ravel(), row.ravel()])
    beside = (survey.path_tree.query(middles)[0] < survey.width + LIMITS.stem_reach + 0.71).reshape(side, side)
    cells = np.floor(place[:, :2] - low).astype(np.int64)
    inside = ((cells >= 0) & (cells < side)).all(axis=1)
    inside[inside] = beside[tuple(cells[inside].T)]
    return inside


def _under_board(stem: Stem, board: Board | None, ground: float) -> bool:
    """Whether a stem shows bare under a board: a rail or a parked car may hide the rest of so short a post."""
    return bool(board is not None and len(stem.rows) >= LIMITS.few
                and board.centre[2] - board.height / 2.0 - ground - stem.low > LIMITS.bare)


def _beside_board(place: np.ndarray, board: Board | None) -> np.ndarray | None:
    """Rows of a stem's points (n, 3) over and under its board, whose points beside a thin post pass for the post's;
    None where there is no board, or too little of the post without it."""
    if board is None:
        return None
    rows = np.flatnonzero(np.abs(place[:, 2] - board.centre[2]) > board.height / 2.0 + LIMITS.frame)
    return rows if len(rows) >= LIMITS.few and np.ptp(place[rows, 2]) > LIMITS.bare else None


def _crowd(place: np.ndarray, height: np.ndarray, stem: Stem, axis: StemAxis) -> float:
    """Points close beside a stem at its own heights, for each of its own."""
    away = np.hypot(*(place[:, :2] - axis.plan_at(place[:, 2])).T)
    beside = (away > off_stem(axis)) & (away < axis.diameter / 2.0 + LIMITS.crowded)
    level = (height > stem.low) & (height < stem.high)
    return float(np.count_nonzero(beside & level) / len(stem.rows))


def _object(stem: Stem, axis: StemAxis, foot: np.ndarray, hung: Hung, crowd: float, passes: int,
            corner: np.ndarray, settings: ObjectSettings) -> StreetObject:
    around, kinds, thing, board = hung
    kind, *others = sorted(kinds, key=lambda kind: -kinds[kind])
    second = others[0] if others and kinds[others[0]] > LIMITS.second else ""
    lever = LIMITS.lean * (axis.middle[2] - foot[2])
    sigma = float(np.linalg.norm([np.sqrt(np.mean(axis.sigma**2)), lever, settings.survey_sigma]))
    reason = _doubt(stem, kind, crowd, around.wall)
    if not reason and board is not None and not board.whole:
        reason = say("half of its board may be hidden")
    top, crown = around.top, around.crown or None
    if board is not None and around.crown:
        # What hangs together with it there is the tree.
        reason = say("it stands in the crown of a tree")
        top, crown = float(board.centre[2] + board.height / 2.0 - foot[2]), None
    arm = thing is not None and kind != SIGN and thing.away > AROUND.arm
    towards = float(np.degrees(np.arctan2(*thing.middle[:2])) % 360.0) if arm else None
    return StreetObject(
        kind, kinds[kind], foot + corner, top, axis.diameter,
        float(np.degrees(np.arctan(np.hypot(*axis.lean)))), board.azimuth if board else towards, crown,
        (thing.away, float(thing.middle[2])) if arm else None,
        None if board is None else replace(board, centre=board.centre + corner),
        sigma, len(stem.rows), passes, DOUBTFUL if reason else MEASURED, reason,
        thing.sides[2] if arm else None, second)


def _doubt(stem: Stem, kind: str, crowd: float, wall: int) -> str:
    """Why an object is doubtful; "" where it is not."""
    if len(stem.rows) < LIMITS.few:
        return say("few points")
    if wall > LIMITS.walled * len(stem.rows):
        return say("it may be a part of a wall")
    if stem.low > LIMITS.hidden:
        return say("its foot is hidden")
    if kind != TREE and stem.filled < LIMITS.broken:
        return say("its stem is seen in parts")
    if kind == POLE and crowd > LIMITS.crowd:
        return say("other things stand close beside it")
    return ""


def _without_doubles(found: list[StreetObject]) -> list[StreetObject]:
    """One object for stems that stand over each other: the one with the most points."""
    single: list[int] = []
    for k in sorted(range(len(found)), key=lambda k: -found[k].points):
        if all(np.hypot(*(found[k].foot - found[other].foot)[:2]) > LIMITS.same for other in single):
            single.append(k)
    return [found[k] for k in sorted(single)]
