"""Fans of rays among upright walls: of an azimuth all elevations are followed at once (J 6.2).

Seen from a place a piece of wall covers the azimuths between those of its ends. A ray of the plan meets it at one
distance whatever its elevation, which only tells the height there: several layers cost one search.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from .wall_faces import WallPieces

_TESTED = 50_000
"""Pieces of wall looked at from places at once: what is known of so many stays near the processor."""

_TOUCH = 1e-6
"""Rays so near to the ends of a piece are tested too, in steps between azimuths."""

_LEAST = 1e-9
"""A wall nearer than this, m, is the one that the ray begins on."""


@dataclass(frozen=True)
class RayFan:
    """Rays around a place.

    Attributes
    ----------
    azimuths : number of them, evenly from north.
    elevation : (l,) radians, none of them upright.
    length : of the rays, m.
    """

    azimuths: int
    elevation: np.ndarray
    length: float


@dataclass(frozen=True)
class FanObstacles:
    """Walls as fans of rays meet them.

    Attributes
    ----------
    walls : the pieces.
    tree : of their lines in plan.
    line : (6, pieces) start, share of the length for each metre along (two each), metres east and north to its end.
    height : (4, pieces) lower edge at the start and its rise to the end, upper edge likewise.
    """

    walls: WallPieces
    tree: shapely.STRtree
    line: np.ndarray
    height: np.ndarray

    @classmethod
    def of(cls, walls: WallPieces) -> FanObstacles:
        """Walls made ready."""
        edge = walls.end - walls.start
        share = edge / np.einsum("ij,ij->i", edge, edge)[:, None]
        heights = []
        for each in (walls.low, walls.top):
            known = np.isfinite(each[:, 0])
            heights += [each[:, 0], np.where(known, each[:, 1], 0.0) - np.where(known, each[:, 0], 0.0)]
        lines = shapely.linestrings(np.stack([walls.start, walls.end], axis=1))
        return cls(walls, shapely.STRtree(lines), np.concatenate([walls.start.T, share.T, edge.T]), np.stack(heights))

    def first_hits(self, place: np.ndarray, fan: RayFan) -> tuple[np.ndarray, np.ndarray]:
        """The first wall that stops each ray of the fans around places (n, 3), m.

        Returns
        -------
        piece : (n, azimuths, l) number of the piece, -1 where the ray is free.
        distance : (n, azimuths, l) m in plan, inf where it is free.
        """
        shape = (len(place), fan.azimuths, len(fan.elevation))
        piece, distance = np.full(shape, -1), np.full(shape, np.inf)
        x, y = place[:, 0], place[:, 1]
        of, near = self.tree.query(shapely.box(x - fan.length, y - fan.length, x + fan.length, y + fan.length))
        begins = np.searchsorted(of, np.arange(len(place) + 1))
        begin = 0
        while begin < len(place):
            end = max(int(np.searchsorted(begins, begins[begin] + _TESTED, side="right")) - 1, begin + 1)
            rows, some = slice(begins[begin], begins[end]), slice(begin, end)
            met = self._met(place[some], of[rows] - begin, near[rows], fan)
            self._nearest(piece[some], distance[some], place[some, 2], met, fan)
            begin = end
        return piece, distance

    def _met(self, place: np.ndarray, of: np.ndarray, near: np.ndarray, fan: RayFan) -> tuple[np.ndarray, ...]:
        """Rays in plan that meet walls: row of the place, ray, piece, m to it and share of the piece's length there."""
        x, y, share_x, share_y, east, north = (values[near] for values in self.line)
        x -= place[of, 0]
        y -= place[of, 1]
        step = 2 * np.pi / fan.azimuths
        one, other = np.arctan2(x, y), np.arctan2(x + east, y + north)
        width = (other - one + np.pi) % (2 * np.pi) - np.pi
        low = np.where(width < 0, other, one) / step
        first = np.ceil(low - _TOUCH).astype(np.int64)
        count = np.maximum(np.floor(low + np.abs(width) / step + _TOUCH).astype(np.int64) - first + 1, 0)
        pair = np.repeat(np.arange(len(near)), count)
        ray = (np.arange(len(pair)) + np.repeat(first - np.cumsum(count) + count, count)) % fan.azimuths
        angle = np.arange(fan.azimuths) * step
        sine, cosine = np.sin(angle)[ray], np.cos(angle)[ray]
        # Cross products of the ray and the piece: where both lines meet.
        with np.errstate(divide="ignore", invalid="ignore"):
            at = (x * north - y * east)[pair] / (sine * north[pair] - cosine * east[pair])
            share = (at * sine - x[pair]) * share_x[pair] + (at * cosine - y[pair]) * share_y[pair]
        hit = np.flatnonzero((at > _LEAST) & (at < fan.length) & (share >= 0) & (share <= 1))
        pair = pair[hit]
        return of[pair], ray[hit], near[pair], at[hit], share[hit]

    def _nearest(self, piece: np.ndarray, distance: np.ndarray, foot: np.ndarray, met: tuple[np.ndarray, ...],
                 fan: RayFan) -> None:
        """Write the nearest of the walls that are met, layer by layer; `foot` (n,) heights of the places, m."""
        # The nearest is written last.
        order = np.argsort(-met[3])
        row, ray, member, at, share = (values[order] for values in met)
        low, rise, top, top_rise = (values[member] for values in self.height)
        low, top, start = low + rise * share, top + top_rise * share, foot[row]
        for layer, elevation in enumerate(fan.elevation):
            z = start + at * np.tan(elevation)
            hit = np.flatnonzero((z >= low) & (z <= top) & (at < fan.length * np.cos(elevation)))
            piece[row[hit], ray[hit], layer], distance[row[hit], ray[hit], layer] = member[hit], at[hit]
