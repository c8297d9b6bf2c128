"""Boards of signs that stand in the crown of a tree: a full, thin, upright face among leaves, close to its post."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

from ...geometry.linked_groups import linked_groups
from ...geometry.tolerances import LEAST_DIVISOR
from .object_records import StemAxis


@dataclass(frozen=True)
class CrownBoardLimits:
    """Limits of boards among leaves, each with its unit."""

    reach: float = 1.0  # m from the axis of the post, across
    off: float = 0.25  # m from the axis to the face
    turn: float = 9.0  # degrees from one direction that is tried to the next
    fuller: float = 1.5  # than the mean layer, that one with a board is
    layer: float = 0.02  # m, by which layers that are tried follow each other
    thin: float = 0.03  # m to either side of a face, that its points lie in
    beside: tuple[float, float] = (0.07, 0.16)  # m before and behind a face, where leaves would go on
    cell: tuple[float, ...] = (0.12, 0.18)  # m, of a face; the wider for faces of few points
    tall: float = 1.6  # m, height that a board has at most
    trunk: float = 0.2  # m, diameter from which a stem in leaves may be a trunk
    link: float = 1.25  # cells from point to point of a face
    taken: int = 7  # of a cell and the eight about it that hold points, where the cell is within a face
    cells: int = 4  # within a face, that hang together by their sides
    denser: float = 4.0  # than what lies before and behind it, for the same thickness
    shared: float = 0.5  # of a part in larger ones, from which it is another view of these
    tried: int = 4  # parts that are looked at, the largest first
    post: float = 0.1  # m to either side of the axis, where points may be the post's
    few: int = 8  # points beside it, and m that they spread across, which tell a plane
    narrow: float = 0.15
    flat: float = 0.02  # m, standard deviation of its points


LIMITS = CrownBoardLimits()

_IN_LAYER = np.zeros((3, 3, 3), bool)
_IN_LAYER[1] = ndimage.generate_binary_structure(2, 1)


def face_in_crown(place: np.ndarray, axis: StemAxis) -> tuple[np.ndarray, np.ndarray] | None:
    """Rows of the points of a board and its unit normal (3,); None where there is none.

    Parameters
    ----------
    place : (n, 3) what hangs about the post, and the post itself, m.
    """
    offset = place[:, :2] - axis.plan_at(place[:, 2])
    near = np.flatnonzero(np.hypot(*offset.T) < LIMITS.reach)
    angle = np.radians(np.arange(0.0, 180.0, LIMITS.turn))
    normal = np.column_stack([np.cos(angle), np.sin(angle)])
    away = normal @ offset[near].T
    layers = []
    for number, places in enumerate(_fullest(away)):
        across = offset[near] @ [-normal[number, 1], normal[number, 0]]
        layers += [_Layer(across, place[near, 2], np.flatnonzero(np.abs(away[number] - at) < LIMITS.thin))
                   for at in places]
    for cell in LIMITS.cell if axis.diameter < LIMITS.trunk else LIMITS.cell[:1]:
        for rows in _apart(_full_parts(layers, cell), len(near)):
            face = _checked(place, offset, near, near[rows], cell)
            if face is not None:
                return _whole(place, offset, near, *face, cell)
    return None


def face_at(place: np.ndarray, axis: StemAxis, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """As `face_in_crown`, for the one face in whose plane some `rows` (m,) of the points lie."""
    offset = place[:, :2] - axis.plan_at(place[:, 2])
    return _checked(place, offset, np.flatnonzero(np.hypot(*offset.T) < LIMITS.reach), rows, LIMITS.cell[0],
                    post=0.0)


def _whole(place: np.ndarray, offset: np.ndarray, near: np.ndarray, rows: np.ndarray, normal: np.ndarray,
           cell: float) -> tuple[np.ndarray, np.ndarray] | None:
    """A face with all that hangs together with it in its plane beside its post; as given where that is little, None
    where it goes on farther than boards do, as in dense leaves."""
    side = np.array([-normal[1], normal[0]]) / max(np.hypot(*normal[:2]), LEAST_DIVISOR)
    beside = near[(np.abs(offset[near] @ side) > LIMITS.post)
                  & (np.abs((place[near] - place[rows].mean(axis=0)) @ normal) < LIMITS.thin)]
    own = np.isin(beside, rows)
    if np.count_nonzero(own) < LIMITS.few:
        return rows, normal
    pairs = cKDTree(place[beside]).query_pairs(LIMITS.link * cell, output_type="ndarray")
    part = linked_groups(*pairs.T, len(beside))[1]
    whole = beside[np.isin(part, np.unique(part[own]))]
    return (whole, normal) if np.ptp(place[whole, 2]) < LIMITS.tall else None


def _apart(parts: list[np.ndarray], number: int) -> list[np.ndarray]:
    """The largest of some parts, of `number` rows, without those that are mostly in a larger one: a trunk or a wall
    beside a board may be larger than that."""
    first: list[np.ndarray] = []
    in_one = np.zeros(number, bool)
    for rows in sorted(parts, key=len, reverse=True):
        if np.mean(in_one[rows]) < LIMITS.shared:
            first.append(rows)
            in_one[rows] = True
        if len(first) == LIMITS.tried:
            break
    return first


def _fullest(away: np.ndarray) -> list[np.ndarray]:
    """Distances from the axis of the two fullest layers in each direction, m, where these are fuller than leaves.

    Parameters
    ----------
    away : (directions, n) of the points from the axis in each direction, m.
    """
    number = int(2 * LIMITS.off / LIMITS.layer)
    layer = np.floor((away + LIMITS.off) / LIMITS.layer).astype(np.int64)
    layer = np.where((layer >= 0) & (layer < number), layer, number) + (number + 1) * np.arange(len(away))[:, None]
    count = np.bincount(layer.ravel(), minlength=len(away) * (number + 1)).reshape(len(away), number + 1)[:, :number]
    wide = ndimage.uniform_filter1d(count.astype(float), 3, axis=1, mode="constant")
    first = np.argsort(-wide, axis=1, kind="stable")[:, :2]
    middle = (np.arange(number) + 0.5) * LIMITS.layer - LIMITS.off
    return [middle[two[row[two] > LIMITS.fuller * row.mean()]] for two, row in zip(first, wide)]


@dataclass(frozen=True)
class _Layer:
    """Points near an upright plane: places (n,) of all points `across` and `up` along it, m, and the `rows` (m,) of
    those that lie in it."""

    across: np.ndarray
    up: np.ndarray
    rows: np.ndarray


def _full_parts(layers: list[_Layer], cell: float) -> list[np.ndarray]:
    """Rows of the largest part of each layer that is full everywhere and wider than a post; none if too small."""
    layers = [layer for layer in layers if len(layer.rows) >= LIMITS.taken]
    if not layers:
        return []
    cells = np.column_stack([np.floor(np.concatenate([getattr(layer, name)[layer.rows] for layer in layers])
                                      / cell).astype(np.int64) for name in ("across", "up")])
    cells += 1 - cells.min(axis=0)
    ends = np.cumsum([len(layer.rows) for layer in layers])
    number = np.repeat(np.arange(len(layers)), np.diff(ends, prepend=0))
    taken = np.zeros((len(layers), *(cells.max(axis=0) + 2)), np.int8)
    taken[number, cells[:, 0], cells[:, 1]] = 1
    in_rows = taken[:, :-2] + taken[:, 1:-1] + taken[:, 2:]
    full = np.zeros(taken.shape, bool)
    full[:, 1:-1, 1:-1] = in_rows[:, :, :-2] + in_rows[:, :, 1:-1] + in_rows[:, :, 2:] >= LIMITS.taken
    part, count = ndimage.label(full, _IN_LAYER)
    sizes = np.bincount(part.ravel(), minlength=count + 1)
    at = np.flatnonzero(full)
    layer_of = np.zeros(count + 1, np.int64)
    layer_of[part.ravel()[at]] = at // (full.shape[1] * full.shape[2])
    found = []
    for k, (layer, rows) in enumerate(zip(layers, np.split(cells, ends[:-1]))):
        own = 1 + np.flatnonzero(layer_of[1:] == k)
        largest = own[np.argmax(sizes[own])] if len(own) else 0
        if largest and sizes[largest] >= LIMITS.cells:
            face = ndimage.binary_dilation(part[k] == largest, np.ones((3, 3), bool))
            found.append(layer.rows[face[tuple(rows.T)]])
    return found


def plane_beside_post(place: np.ndarray, offset: np.ndarray,
                      post: float = LIMITS.post) -> tuple[np.ndarray, np.ndarray]:
    """Middle (3,) and unit normal (3,) of a board's face: by its points to either side of its post, as the post's own
    lie behind the face and turn it where half of that shows; by all where there are few others.

    Parameters
    ----------
    place : (n, 3) its points, m.
    offset : (n, 2) of these from the axis of the post, m.
    post : m to either side of that, where points may be its own.
    """
    for _ in range(3):
        middle = place.mean(axis=0)
        normal = np.linalg.eigh(np.cov((place - middle).T))[1][:, 0]
        across = offset @ np.array([-normal[1], normal[0]]) / max(np.hypot(*normal[:2]), LEAST_DIVISOR)
        aside = np.abs(across) > post
        if aside.all() or np.count_nonzero(aside) < LIMITS.few or np.ptp(across[aside]) < LIMITS.narrow:
            break
        place, offset = place[aside], offset[aside]
    return middle, normal


def _checked(place: np.ndarray, offset: np.ndarray, near: np.ndarray,
             rows: np.ndarray, cell: float, post: float = LIMITS.post) -> tuple[np.ndarray, np.ndarray] | None:
    """The face by a plane of its own, where it is flat and thin: leaves go on before and behind any layer."""
    for _ in range(3):
        middle, normal = plane_beside_post(place[rows], offset[rows], post)
        level = np.array([*normal[:2], 0.0]) / max(np.hypot(*normal[:2]), LEAST_DIVISOR)
        across = np.array([-level[1], level[0], 0.0])
        flat = (place[near] - middle) @ np.column_stack([across, [0.0, 0.0, 1.0]])
        away = (place[near] - middle) @ normal
        parts = _full_parts([_Layer(*flat.T, np.flatnonzero(np.abs(away) < LIMITS.thin))], cell)
        if not parts:
            return None
        part = parts[0]
        rows = near[part]
    low, high = np.percentile(flat[part], [2, 98], axis=0)
    # The post's own points, before or behind which no leaves are, make no face.
    framed = ((flat >= low) & (flat <= high)).all(axis=1) & (np.abs(offset[near] @ across[:2]) >= post)
    on = np.count_nonzero(framed & (np.abs(away) < LIMITS.thin)) / (2.0 * LIMITS.thin)
    off = np.count_nonzero(framed & (np.abs(away) > LIMITS.beside[0]) & (np.abs(away) < LIMITS.beside[1])) / (
        2.0 * (LIMITS.beside[1] - LIMITS.beside[0]))
    covers = low[0] - LIMITS.off < (offset[rows] - (place[rows] - middle)[:, :2]).mean(axis=0) @ -across[:2] < (
        high[0] + LIMITS.off)
    if np.std(away[part]) > LIMITS.flat or on < LIMITS.denser * off or not covers:
        return None
    return rows, normal
