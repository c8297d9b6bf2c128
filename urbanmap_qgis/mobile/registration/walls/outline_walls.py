"""Outlines of buildings as walls, lines of a map as kerbs, and which of a survey's planes belong to which of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from .facade_planes import FacadePlanes


@dataclass(frozen=True)
class OutlineWallsLimits:
    """Limits of outline walls, each with its unit."""

    shortest: float = 1.5  # m: shorter edges are niches and pillars
    before: float = 0.9  # m outside the outline, at most, that a facade of it stands
    shared: float = 0.04  # m, that the outlines of a neighbourhood are off by alike
    behind: float = 1.7  # m inside of it: eaves, and what survey and outline are off by
    beyond: float = 0.3  # m past an edge's ends
    facing: float = 0.985  # cosine of the largest angle between a plane and its edge: 10 degrees
    twice: float = 0.8  # m across, at most, between two measurements of one wall
    # m, mean and standard deviation of how far facades stand inside outlines, and what is possible
    inside: tuple[float, float] = (0.3, 0.3)
    possible: tuple[float, float] = (-0.5, 1.2)


@dataclass(frozen=True)
class KerbLinesLimits:
    """Limits of lines of kerbs, each with its unit."""

    bend: float = 0.03  # m that vertices may lie beside a straight piece
    piece: float = 30.0  # m, at most, that are off by alike
    shared: float = 0.1  # m, that the lines of a neighbourhood are off by alike
    reach: tuple[float, float] = (1.2, 1.2)  # m outside and inside of a line, at most, that a kerb of it is found
    # m, the same as of outlines: maps draw the front or the back of the stones
    inside: tuple[float, float] = (0.0, 0.1)
    possible: tuple[float, float] = (-0.4, 0.4)


LIMITS = OutlineWallsLimits()
KERBS = KerbLinesLimits()


_COLUMNS = ("ends", "outward", "building", "sigma")
"""What `WallEdges` say of each edge."""


@dataclass(frozen=True)
class WallEdges:
    """Straight edges of buildings' outlines, or of kerbs.

    Attributes
    ----------
    ends : (k, 2, 2) m.
    outward : (k, 2) unit vectors.
    building : (k,) number of its building; each edge its own where none are given.
    sigma : (k,) m, of each edge's place across it beside what all walls differ by; 0 where none are given.
    shared : m, that all edges of a neighbourhood are off by alike.
    inside : m, mean and standard deviation of how far what the survey saw stands inside of them all.
    possible : m, least and most of it.
    reach : m outside and inside of an edge within which what belongs to it is looked for.
    """

    ends: np.ndarray
    outward: np.ndarray
    building: np.ndarray | None = None
    sigma: np.ndarray | None = None
    shared: float = LIMITS.shared
    inside: tuple[float, float] = LIMITS.inside
    possible: tuple[float, float] = LIMITS.possible
    reach: tuple[float, float] = (LIMITS.before, LIMITS.behind)

    def __post_init__(self) -> None:
        if self.building is None:
            object.__setattr__(self, "building", np.arange(len(self.ends)))
        if self.sigma is None:
            object.__setattr__(self, "sigma", np.zeros(len(self.ends)))

    def __len__(self) -> int:
        return len(self.ends)

    @classmethod
    def of(cls, ends: np.ndarray, outward: np.ndarray, building: np.ndarray | None = None) -> WallEdges:
        """Those of edges (m, 2, 2) with their outward directions (m, 2) that are long enough to be walls."""
        long = np.hypot(*(ends[:, 1] - ends[:, 0]).T) >= LIMITS.shortest
        return cls(ends[long], outward[long], None if building is None else building[long])

    @classmethod
    def joined(cls, parts: Sequence[tuple[np.ndarray, np.ndarray]]) -> WallEdges:
        """Those of several buildings: ends (m, 2, 2) and outward directions (m, 2) of each."""
        building = np.repeat(np.arange(len(parts)), [len(ends) for ends, _ in parts])
        return cls.of(*(np.concatenate(columns) for columns in zip(*parts)), building)

    @classmethod
    def of_kerbs(cls, lines: np.ndarray) -> WallEdges:
        """Those of lines (n,) in plan, with either side outside: no map tells which one is the road.

        What the lines of a neighbourhood are off by moves all that face alike: these share it (`building`).
        """
        merged = shapely.line_merge(shapely.union_all(shapely.force_2d(lines)))
        parts = shapely.segmentize(shapely.simplify(shapely.get_parts(merged), KERBS.bend), KERBS.piece)
        places, line = shapely.get_coordinates(parts, return_index=True)
        ends = np.stack([places[:-1], places[1:]], axis=1)[line[1:] == line[:-1]]
        along = ends[:, 1] - ends[:, 0]
        length = np.hypot(*along.T)
        ends, along = ends[length >= LIMITS.shortest], along[length >= LIMITS.shortest]
        left = np.column_stack([-along[:, 1], along[:, 0]]) / np.hypot(*along.T)[:, None]
        outward = np.concatenate([left, -left])
        return cls(np.concatenate([ends, ends]), outward, facing(outward), None, KERBS.shared, KERBS.inside,
                   KERBS.possible, KERBS.reach)

    def select(self, which: np.ndarray) -> WallEdges:
        """Some of them, by mask or index."""
        return replace(self, **{name: getattr(self, name)[which] for name in _COLUMNS})

    def with_others(self, others: Sequence[WallEdges]) -> WallEdges:
        """These and others of their kind, one after another."""
        return replace(self, **{name: np.concatenate([getattr(part, name) for part in (self, *others)])
                                for name in _COLUMNS})

    def on(self, other: WallEdges) -> np.ndarray:
        """Mask (k,) of edges whose middle lies on one of others that faces alike, as far as noise tells."""
        edge, _ = replace(other, reach=(LIMITS.twice, LIMITS.twice)).matched(self.ends.mean(axis=1), self.outward, 0.0)
        return edge >= 0

    def matched(self, place: np.ndarray, normal: np.ndarray, eaves: float) -> tuple[np.ndarray, np.ndarray]:
        """Number of each plane's edge, -1 for none, and how far outside of it the plane lies, m.

        Parameters
        ----------
        place, normal : (n, 2) m, and unit vectors outwards.
        eaves : m, by which facades usually stand inside the outlines; of several edges the one that fits it is taken.
        """
        edge, outside = np.full(len(place), -1), np.zeros(len(place))
        if not len(self) or not len(place):
            return edge, outside
        plane, near = shapely.STRtree(shapely.linestrings(self.ends)).query(
            shapely.points(place), predicate="dwithin", distance=max(self.reach))
        begin, along = self.ends[near, 0], self.ends[near, 1] - self.ends[near, 0]
        length = np.hypot(*along.T)
        from_begin = place[plane] - begin
        way = (from_begin * along).sum(axis=1) / length
        off = (from_begin * self.outward[near]).sum(axis=1)
        good = ((normal[plane] * self.outward[near]).sum(axis=1) >= LIMITS.facing) & (off <= self.reach[0])
        good &= (off >= -self.reach[1]) & (way >= -LIMITS.beyond) & (way <= length + LIMITS.beyond)
        plane, near, off = plane[good], near[good], off[good]
        order = np.argsort(-np.abs(off + eaves), kind="stable")  # the best last
        edge[plane[order]], outside[plane[order]] = near[order], off[order]
        return edge, outside


def facing(outward: np.ndarray) -> np.ndarray:
    """(n,) 0 to 7, the eighth of the horizon that directions (n, 2) point to."""
    return np.round(np.degrees(np.arctan2(*outward.T)) / 45.0).astype(int) % 8


@dataclass(frozen=True)
class MatchedWalls:
    """Planes that belong to edges.

    Attributes
    ----------
    planes : n of them.
    edge : (n,) number of the edge.
    outward : (n, 2).
    outside : (n,) m outside of the edge.
    """

    planes: FacadePlanes
    edge: np.ndarray
    outward: np.ndarray
    outside: np.ndarray

    def by_wall(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Number of each plane's wall (n,), from 0; of each wall, the planes (w,) and their median place (w,), m."""
        _, wall = np.unique(self.edge, return_inverse=True)
        count = np.bincount(wall)
        order = np.lexsort((self.outside, wall))
        ends = np.cumsum(count)
        return wall, count, self.outside[order][(2 * ends - count) // 2]
