"""Walls in airborne laser points: where these step from a roof to the ground beside a facade that a survey saw.

The survey says where a facade stands to a few metres, which way it faces and how high it reaches. Of the airborne
points beside it those above most of what the survey saw lie on the building and the others before it, so that the step
between both is the wall at its own height: a canopy or a podium in front of a tower is none of it. The step's place is
the mean of its likelihood; airborne points come in lines, those of a line err together, and between the last line of
the roof and the first before it nothing is known.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.spatial import cKDTree
from scipy.special import ndtr

from ....errors import InsufficientDataError
from ....geometry.tolerances import LEAST_DIVISOR
from ....io.points.pointcloud import PointCloud, iter_chunks, open_cloud, valid_points
from ....progress import SILENT, Progress
from ....wording import say
from .facade_planes import FacadePlanes, own_walls
from .outline_walls import WallEdges, facing


@dataclass(frozen=True)
class LaserWallsLimits:
    """Limits of laser walls, each with its unit."""

    piece: float = 16.0  # m of a facade, at most, whose step is looked for together
    fewest: tuple[int, int] = (6, 12)  # planes of the survey and airborne points over them
    beyond: float = 0.3  # m past the outermost planes of a piece
    across: float = 3.0  # m to either side of the facade, as reported
    margin: float = 0.4  # m at either end of that, in which no step is looked for
    step: float = 0.02  # m between the places that are tried
    upper: float = 0.7  # share of the survey's planes that lie below the height that parts roof and ground
    noise: tuple[float, ...] = (0.08, 0.14, 0.25)  # m, standard deviations of the airborne points in plan
    hits: tuple[float, ...] = (0.0, 0.1, 0.3, 1.0)  # points on a metre of wall, in those of a m2 of roof
    other: float = 0.03  # share of points that are not what they seem: crowns, holes
    line: float = 0.1  # m: cells by which lines of points are told from single ones
    mode: float = 0.6  # m from the likeliest place that belong to it
    surer: float = 3.0  # log-likelihood of it over any other place
    beside: tuple[float, float] = (0.2, 1.2)  # m from a step, by whose points it is judged
    contrast: float = 0.7  # least difference of the roof's shares of points there
    quantile: float = 0.03  # of points that lie beyond the end of roof or ground
    smear: float = 3.0  # standard deviations by which noise narrows the gap between two lines of points
    most: float = 0.2  # m, standard deviation
    cell: float = 8.0  # m: cells with facades and those around them are read
    shared: float = 0.1  # m, that a strip is off by in plan: walls cannot contradict markings by less


LIMITS = LaserWallsLimits()


@dataclass(frozen=True)
class StepAcross:
    """A step: place and standard deviation, m; log-likelihood over any other place; contrast, 0 to 1."""

    place: float
    sigma: float
    surer: float
    contrast: float

    @property
    def clear(self) -> bool:
        """Whether it can be a wall."""
        return self.surer > LIMITS.surer and self.contrast > LIMITS.contrast and self.sigma < LIMITS.most


def laser_walls(planes: FacadePlanes, paths: Sequence[str | os.PathLike] | PointCloud,
                progress: Progress = SILENT) -> WallEdges:
    """The walls that airborne points show beside a survey's facades.

    What a strip is off by moves all walls that face alike: these share what they differ by (`building`).

    Raises
    ------
    InsufficientDataError : there is none.
    """
    points = _beside(paths if isinstance(paths, PointCloud) else open_cloud(paths), planes, progress)
    tree, found = cKDTree(points[:, :2]), []
    for rows in _pieces(planes):
        edge = _edge(planes.select(rows), points, tree)
        if edge is not None:
            found.append(edge)
    if not found:
        raise InsufficientDataError(say("The airborne laser points show no wall where the survey saw facades: check "
                                        "that both lie in one place and have one height system."))
    ends, outward, sigma = (np.array(column) for column in zip(*found))
    return WallEdges(ends, outward, facing(outward), sigma, LIMITS.shared)


def step_across(high: np.ndarray, low: np.ndarray) -> StepAcross:
    """The step between roof and ground.

    Parameters
    ----------
    high, low : (n,), (m,) m outwards across the wall, of the points over and under its height.
    """
    grid = np.arange(LIMITS.margin - LIMITS.across, LIMITS.across - LIMITS.margin, LIMITS.step)
    alike = _err_together(high)
    ways = list(product(LIMITS.noise, LIMITS.hits))
    tried = [_likelihood(grid, high, low, *way) / alike for way in ways]
    chosen = int(np.argmax([values.max() for values in tried]))
    likelihood, noise = tried[chosen], ways[chosen][0]
    best = int(np.argmax(likelihood))
    near = np.abs(grid - grid[best]) < LIMITS.mode
    weight = np.where(near, np.exp(likelihood - likelihood[best]), 0.0)
    place = float((weight * grid).sum() / weight.sum())
    variance = float((weight * (grid - place) ** 2).sum() / weight.sum())
    gap = max(0.0, _gap(high, low, place) + LIMITS.smear * noise * (1.0 - 1.0 / alike))
    return StepAcross(place, float(np.sqrt(variance + gap**2 / 12.0)),
                      float(likelihood[best] - likelihood[~near].max()), _contrast(high, low, place))


def _likelihood(grid: np.ndarray, high: np.ndarray, low: np.ndarray, noise: float, hits: float) -> np.ndarray:
    """(g,) log-likelihood of a step at each place: where the roof's points end, and of which kind each point is."""
    off = (grid[:, None] - high) / noise
    on_roof = ndtr(off)
    on_wall = np.exp(-0.5 * off**2) / (noise * np.sqrt(2.0 * np.pi))
    density = on_roof + hits * on_wall + LIMITS.other
    area = grid + LIMITS.across + hits + LIMITS.other * 2.0 * LIMITS.across
    ends = np.log(density).sum(axis=1) - len(high) * np.log(area)
    before = ndtr((low - grid[:, None]) / noise)
    kinds = sum(np.log(LIMITS.other + (1.0 - 2.0 * LIMITS.other) * part).sum(axis=1) for part in (on_roof, before))
    return ends + kinds


def _err_together(high: np.ndarray) -> float:
    """How many points of the roof err together: variance over mean of their numbers in strips along the wall."""
    inner = np.quantile(high, 0.85) - 2.0 * LIMITS.line
    count, _ = np.histogram(high, np.arange(-LIMITS.across, inner, LIMITS.line))
    return max(1.0, float(count.var() / max(count.mean(), LEAST_DIVISOR))) if len(count) > 1 else 1.0


def _gap(high: np.ndarray, low: np.ndarray, place: float) -> float:
    """m between the roof's last points and the first before it: the wall may stand anywhere there. Below 0: overlap."""
    inner, outer = LIMITS.beside
    last = high[(high > place - outer) & (high < place + inner)]
    first = low[(low > place - inner) & (low < place + outer)]
    if not len(last) or not len(first):
        return outer - inner
    return float(np.quantile(first, LIMITS.quantile) - np.quantile(last, 1.0 - LIMITS.quantile))


def _contrast(high: np.ndarray, low: np.ndarray, place: float) -> float:
    """Share of the roof's points behind the step less that before it."""
    shares = []
    for side in (-1.0, 1.0):
        roof, ground = (np.count_nonzero((side * (part - place) > LIMITS.beside[0])
                                         & (side * (part - place) < LIMITS.beside[1])) for part in (high, low))
        shares.append(roof / max(roof + ground, 1))
    return shares[0] - shares[1]


def _pieces(planes: FacadePlanes) -> Iterator[np.ndarray]:
    """Indices of the planes of every piece of a facade."""
    place = planes.place[:, :2]
    wall = own_walls(place, planes.normal, planes.place[:, 2])
    order = np.argsort(wall, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(wall[order])) + 1):
        if len(rows) < LIMITS.fewest[0]:
            continue
        along = place[rows] @ _aside(planes.normal[rows].mean(axis=0))
        along = along - along.min()
        number = int(np.ceil(max(along.max(), LEAST_DIVISOR) / LIMITS.piece))
        piece = np.minimum((along / max(along.max(), LEAST_DIVISOR) * number).astype(int), number - 1)
        for one in range(number):
            if np.count_nonzero(piece == one) >= LIMITS.fewest[0]:
                yield rows[piece == one]


def _aside(normal: np.ndarray) -> np.ndarray:
    """(2,) unit vector along a wall with a normal (2,)."""
    return np.array([-normal[1], normal[0]]) / max(np.hypot(*normal), LEAST_DIVISOR)


def _edge(piece: FacadePlanes, points: np.ndarray, tree: cKDTree) -> tuple[np.ndarray, np.ndarray, float] | None:
    """Ends (2, 2), outward direction (2,) and standard deviation, m, of the wall at a piece; None without a clear step.
    """
    along = _aside(piece.normal.mean(axis=0))
    outward = np.array([along[1], -along[0]])
    place = piece.place[:, :2]
    centre = place.mean(axis=0)
    centre = centre + np.median((place - centre) @ outward) * outward
    way = (place - centre) @ along
    begin, end = way.min() - LIMITS.beyond, way.max() + LIMITS.beyond
    near = points[tree.query_ball_point(centre, np.hypot(LIMITS.across, max(-begin, end)))]
    across, aside = (near[:, :2] - centre) @ outward, (near[:, :2] - centre) @ along
    some = (np.abs(across) < LIMITS.across) & (aside > begin) & (aside < end)
    high = near[some, 2] > np.quantile(piece.place[:, 2], LIMITS.upper)
    if np.count_nonzero(high) < LIMITS.fewest[1]:
        return None
    step = step_across(across[some][high], across[some][~high])
    if not step.clear:
        return None
    middle = centre + step.place * outward
    return np.array([middle + begin * along, middle + end * along]), outward, step.sigma


def _beside(cloud: PointCloud, planes: FacadePlanes, progress: Progress) -> np.ndarray:
    """(n, 3) the points near facades."""
    origin = planes.place[:, :2].min(axis=0)
    cells = np.floor((planes.place[:, :2] - origin) / LIMITS.cell).astype(np.int64) + 1
    wanted = np.zeros(cells.max(axis=0) + 2, bool)
    for shift in product((-1, 0, 1), repeat=2):
        wanted[tuple((cells + shift).T)] = True
    found = [np.zeros((0, 3))]
    for chunk in iter_chunks(cloud, progress):
        x, y = np.asarray(chunk.x), np.asarray(chunk.y)
        cell = np.floor((np.column_stack([x, y]) - origin) / LIMITS.cell) + 1
        keep = ((cell >= 0) & (cell < wanted.shape)).all(axis=1) & valid_points(chunk)
        keep[keep] = wanted[tuple(cell[keep].astype(np.int64).T)]
        found.append(np.column_stack([x[keep], y[keep], np.asarray(chunk.z)[keep]]))
    return np.concatenate(found)
