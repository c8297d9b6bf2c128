"""Whether walls stay straight under a correction: a jump of the correction that the drive did not make breaks them.

A wall that was seen over some way of the drive is one line. Where paint that was laid anew, or a frame that is off,
moves the correction by a step, the wall breaks there by as much, on both sides of the street alike; an error of the
trajectory that the correction takes out leaves it whole.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ....geometry.tolerances import LEAST_DIVISOR, SIGMA_OF_MAD


@dataclass(frozen=True)
class StraightnessLimits:
    """Limits of straightness, each with its unit."""

    # Planes of one wall follow each other within so many m, are parallel, and lie on one line to so many m.
    neighbour: float = 2.0
    parallel: float = 0.97
    on_line: float = 0.45
    fewest: int = 8  # planes of a wall
    every: float = 4.0  # m of path parameter between the places that are looked at
    around: float = 24.0  # m to either side whose planes count
    gap: float = 5.0  # m to either side that are left out: the correction bends there over some way
    piece: float = 4.0  # m of path parameter whose planes of a wall count as one
    sigma: float = 0.02  # m, of a piece of a wall at least: structure of facades
    pieces: int = 2  # of a wall before and after
    bend: float = 0.01  # m a m: by so much walls may turn against their direction, as the correction's drift does
    rounds: int = 4
    soft: float = 2.5  # standard deviations from which a wall loses weight
    walls: int = 2  # which must bear a jump out, each of them without the other ones
    proof: float = 4.5  # standard deviations of a jump that is believed, 3 without any one of its walls
    least: float = 0.06  # m
    # A wall that steps at a place of its own, whenever that was seen, is two buildings: places looked at every m, and
    # the log-likelihood by which one must beat a step at the jump's time.
    every_place: float = 0.5
    own_step: float = 4.5


LIMITS = StraightnessLimits()

_Jump = tuple[np.ndarray, np.ndarray, float]

_SHARE = 0.6  # of the jump's chi square that is left without any one wall


@dataclass(frozen=True)
class WallJump:
    """A jump of the correction against the walls: at a path parameter, change (2,) m with covariance (2, 2)."""

    path_parameter: float
    change: np.ndarray
    covariance: np.ndarray
    square: float


def own_walls(place: np.ndarray, normal: np.ndarray, height: np.ndarray) -> np.ndarray:
    """(n,) number of the wall that each plane belongs to, by planes alone: those that go on in one line are one wall.

    Parameters
    ----------
    place, normal : (n, 2) m in plan, unit vectors.
    height : (n,) m.
    """
    if not len(place):
        return np.zeros(0, int)
    one, other = cKDTree(np.column_stack([place, 0.5 * height])).query_pairs(LIMITS.neighbour, output_type="ndarray").T
    mean = normal[one] + normal[other]
    off = np.abs(((place[one] - place[other]) * mean).sum(axis=1)) / 2.0
    same = ((normal[one] * normal[other]).sum(axis=1) >= LIMITS.parallel) & (off <= LIMITS.on_line)
    ones = np.ones(np.count_nonzero(same))
    graph = coo_matrix((ones, (one[same], other[same])), shape=(len(place), len(place)))
    return connected_components(graph, directed=False)[1]


def wall_jumps(chainage: np.ndarray, path_parameter: np.ndarray, place: np.ndarray, normal: np.ndarray,
               wall: np.ndarray) -> list[WallJump]:
    """Jumps of a correction that walls contradict, the likeliest within every reach.

    Parameters
    ----------
    chainage, path_parameter : (n,) m, not falling, of planes that the correction has put at `place` (n, 2) m.
    normal : (n, 2) unit vectors.
    wall : (n,) number of the wall; below 0 for none.
    """
    if not len(place):
        return []
    found = []
    for at in np.arange(chainage[0] + LIMITS.gap, chainage[-1] - LIMITS.gap, LIMITS.every):
        part = slice(*np.searchsorted(chainage, [at - LIMITS.around, at + LIMITS.around]))
        jump = _jump_at(chainage[part] - at, place[part], normal[part], wall[part])
        if jump is not None:
            found.append((float(at), jump))
    chosen: list[tuple[float, _Jump]] = []
    for at, jump in sorted(found, key=lambda item: -item[1][2]):
        if all(abs(at - other) > LIMITS.around for other, _ in chosen):
            chosen.append((at, jump))
    # Where the vehicle waits at the jump, the middle of the wait.
    return [WallJump(float(np.interp([at - LIMITS.every, at + LIMITS.every], chainage, path_parameter).mean()), *jump)
            for at, jump in sorted(chosen, key=lambda item: item[0])]


def _jump_at(along: np.ndarray, place: np.ndarray, normal: np.ndarray, wall: np.ndarray) -> _Jump | None:
    """Change, covariance and chi square of the jump that all walls tell of `along` (n,) m from it, where it is proven.
    """
    far = (np.abs(along) >= LIMITS.gap) & (wall >= 0)
    rows = list(_walls(wall, far))
    evidence = [_wall_evidence(along[some], place[some], normal[some]) for some in rows]
    jump = _proven([item for item in evidence if item is not None])
    if jump is None:
        return None
    return _proven([item for item, some in zip(evidence, rows)
                    if item is not None and not _steps_itself(along[some], place[some], item[0])])


def _steps_itself(along: np.ndarray, place: np.ndarray, unit: np.ndarray) -> bool:
    """Whether a wall's planes, seen `along` (n,) m from a jump, step at a place of the wall and not at the jump's time.

    A scanner that looks ahead sees one place of a wall at many times, by its height.
    """
    off, way = place @ unit, place @ np.array([unit[1], -unit[0]])
    off, way = off - off.mean(), way - way.mean()
    places = np.arange(way.min(), way.max(), LIMITS.every_place)[1:]
    if not len(places):
        return False
    by_place = min(_lost(off, way, way > at) for at in places)
    return _lost(off, way, along > 0) - by_place > LIMITS.own_step


def _lost(off: np.ndarray, way: np.ndarray, after: np.ndarray) -> float:
    """Log-likelihood that planes `off` (n,) m at `way` (n,) m lose on a line that steps where `after` (n,) is true."""
    design = np.column_stack([np.ones(len(off)), way, after])
    left = off - design @ np.linalg.lstsq(design, off, rcond=None)[0]
    return 0.5 * float(np.minimum((left / LIMITS.sigma) ** 2, LIMITS.soft**2).sum())


def _proven(evidence: list[tuple[np.ndarray, float, float]]) -> _Jump | None:
    """Change, covariance and chi square of the jump that walls tell, where they prove it together and apart."""
    if len(evidence) < LIMITS.walls:
        return None
    unit, size, variance = (np.array(column) for column in zip(*evidence))
    weight = np.ones(len(size))
    for _ in range(LIMITS.rounds):
        change, covariance, square = _jump_of(unit, size, variance, weight)
        off = (size - unit @ change) ** 2 / variance
        weight = 1.0 / (1.0 + off / LIMITS.soft**2)
    if square < LIMITS.proof**2 or np.hypot(*change) < LIMITS.least:
        return None
    without = [_jump_of(unit, size, variance, np.where(np.arange(len(size)) == one, 0.0, weight))[2]
               for one in range(len(size))]
    if min(without) < max(9.0, (1.0 - _SHARE) * square / len(size)):
        return None
    return change, covariance, square


def _walls(wall: np.ndarray, far: np.ndarray) -> Iterator[np.ndarray]:
    """Rows of each wall."""
    rows = np.flatnonzero(far)
    rows = rows[np.argsort(wall[rows], kind="stable")]
    for some in np.split(rows, np.flatnonzero(np.diff(wall[rows])) + 1):
        if len(some) >= LIMITS.fewest:
            yield some


def _wall_evidence(along: np.ndarray, place: np.ndarray,
                   normal: np.ndarray) -> tuple[np.ndarray, float, float] | None:
    """A wall's direction (2,), its jump along it, m, and the variance of that; None where it does not reach over."""
    unit = normal.sum(axis=0) / max(float(np.hypot(*normal.sum(axis=0))), LEAST_DIVISOR)
    centre = place.mean(axis=0)
    off = (place - centre) @ unit
    way = (place - centre) @ np.array([unit[1], -unit[0]])
    number = np.floor(along / LIMITS.piece).astype(int)
    _, piece = np.unique(number, return_inverse=True)
    count = np.bincount(piece)
    mean_off, mean_way = _medians(off, piece), np.bincount(piece, way) / count
    after = np.bincount(piece, along > 0) / count > 0.5
    if min(np.count_nonzero(after), np.count_nonzero(~after)) < LIMITS.pieces:
        return None
    scatter = SIGMA_OF_MAD * np.median(np.abs(off - mean_off[piece]))
    variance = LIMITS.sigma**2 + scatter**2 / count
    design = np.column_stack([np.ones(len(count)), mean_way, after])
    prior = np.diag([0.0, 1.0 / LIMITS.bend**2, 1e-6])
    inverse = np.linalg.inv(design.T @ (design / variance[:, None]) + prior)
    solution = inverse @ (design.T @ (mean_off / variance))
    rest = (mean_off - design @ solution) ** 2 / variance
    return unit, float(solution[2]), float(inverse[2, 2] * max(rest.sum() / max(len(count) - 3, 1), 1.0))


def _medians(values: np.ndarray, group: np.ndarray) -> np.ndarray:
    """Median of the values (n,) of each group, from 0."""
    order = np.lexsort((values, group))
    ends = np.cumsum(np.bincount(group))
    first = np.concatenate([[0], ends[:-1]])
    ordered = values[order]
    return 0.5 * (ordered[(first + ends - 1) // 2] + ordered[(first + ends) // 2])


def _jump_of(unit: np.ndarray, size: np.ndarray, variance: np.ndarray,
             weight: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Jump (2,), covariance (2, 2) and chi square of what walls say; along what none says it is 0, and unknown."""
    share = weight / variance
    information = (unit * share[:, None]).T @ unit + np.eye(2)  # a metre where nothing is known
    covariance = np.linalg.inv(information)
    pull = (unit * share[:, None]).T @ size
    change = covariance @ pull
    return change, covariance, float(change @ pull)
