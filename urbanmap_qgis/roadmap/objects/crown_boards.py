"""Boards of signs that stand in the crown of a tree: a full, thin, upright face among leaves, close to its post."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

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
    cell: float = 0.12  # m, of a face
    taken: int = 7  # of a cell and the eight about it that hold points, where the cell is within a face
    cells: int = 4  # within a face, that hang together by their sides
    denser: float = 4.0  # than what lies before and behind it, for the same thickness
    flat: float = 0.02  # m, standard deviation of its points


LIMITS = CrownBoardLimits()


def face_in_crown(place: np.ndarray, axis: StemAxis) -> tuple[np.ndarray, np.ndarray] | None:
    """Rows of the points of a board and its unit normal (3,); None where there is none.

    Parameters
    ----------
    place : (n, 3) what hangs about the post, and the post itself, m.
    """
    offset = place[:, :2] - axis.plan_at(place[:, 2])
    near = np.flatnonzero(np.hypot(*offset.T) < LIMITS.reach)
    best: tuple[float, np.ndarray, np.ndarray] = (0.0, near[:0], np.zeros(3))
    for angle in np.radians(np.arange(0.0, 180.0, LIMITS.turn)):
        normal = np.array([np.cos(angle), np.sin(angle)])
        away = offset[near] @ normal
        flat = np.column_stack([offset[near] @ [-normal[1], normal[0]], place[near, 2]])
        for at in _fullest(away):
            rows = _full_part(flat, np.abs(away - at) < LIMITS.thin)
            if len(rows) > best[0]:
                best = float(len(rows)), near[rows], np.array([*normal, 0.0])
    return _checked(place, offset, near, best[1]) if len(best[1]) else None


def _fullest(away: np.ndarray) -> np.ndarray:
    """Distances from the axis of the two fullest layers, m, where these are fuller than leaves."""
    number = int(2 * LIMITS.off / LIMITS.layer)
    count, borders = np.histogram(away, number, (-LIMITS.off, LIMITS.off))
    wide = ndimage.uniform_filter1d(count.astype(float), 3, mode="constant")
    first = np.argsort(-wide, kind="stable")[:2]
    return (borders[:-1] + LIMITS.layer / 2.0)[first[wide[first] > LIMITS.fuller * wide.mean()]]


def _full_part(flat: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Rows of the largest part of a layer that is full everywhere and wider than a post; none if too small."""
    rows = np.flatnonzero(inside)
    if len(rows) < LIMITS.taken:
        return rows[:0]
    cells = np.floor(flat[rows] / LIMITS.cell).astype(np.int64)
    cells += 1 - cells.min(axis=0)
    taken = np.zeros(cells.max(axis=0) + 2, int)
    taken[tuple(cells.T)] = 1
    part = ndimage.label(ndimage.convolve(taken, np.ones((3, 3), int), mode="constant") >= LIMITS.taken)[0]
    sizes = np.bincount(part.ravel())[1:]
    if not len(sizes) or sizes.max() < LIMITS.cells:
        return rows[:0]
    face = ndimage.binary_dilation(part == 1 + int(np.argmax(sizes)), np.ones((3, 3), bool))
    return rows[face[tuple(cells.T)]]


def _checked(place: np.ndarray, offset: np.ndarray, near: np.ndarray,
             rows: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """The face by a plane of its own, where it is flat and thin: leaves go on before and behind any layer."""
    for _ in range(3):
        middle = place[rows].mean(axis=0)
        _, axes = np.linalg.eigh(np.cov((place[rows] - middle).T))
        normal = axes[:, 0]
        level = np.array([*normal[:2], 0.0]) / max(np.hypot(*normal[:2]), 1e-12)
        across = np.array([-level[1], level[0], 0.0])
        flat = (place[near] - middle) @ np.column_stack([across, [0.0, 0.0, 1.0]])
        away = (place[near] - middle) @ normal
        part = _full_part(flat, np.abs(away) < LIMITS.thin)
        if not len(part):
            return None
        rows = near[part]
    low, high = np.percentile(flat[part], [2, 98], axis=0)
    framed = ((flat >= low) & (flat <= high)).all(axis=1)
    on = np.count_nonzero(framed & (np.abs(away) < LIMITS.thin)) / (2.0 * LIMITS.thin)
    off = np.count_nonzero(framed & (np.abs(away) > LIMITS.beside[0]) & (np.abs(away) < LIMITS.beside[1])) / (
        2.0 * (LIMITS.beside[1] - LIMITS.beside[0]))
    covers = low[0] - LIMITS.off < (offset[rows] - (place[rows] - middle)[:, :2]).mean(axis=0) @ -across[:2] < (
        high[0] + LIMITS.off)
    if np.std(away[part]) > LIMITS.flat or on < LIMITS.denser * off or not covers:
        return None
    return rows, normal
