"""A triangulated surface over a polygon, refined where it is farthest from its points (greedy insertion).

Source: Garland and Heckbert, "Fast polygonal approximation of terrains and height fields", 1995; edges are flipped by
Lawson's rule, those of the polygon never.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...geometry.triangulation import triangulate_face

_INSIDE = 1e-3
"""A point that has less of a triangle's corner than this lies on its side."""


class Tin:
    """Triangles over a polygon with heights.

    Parameters
    ----------
    xy, z : (k, 2) and (k,) corners of the polygon, m.
    rings : of their numbers, the outer one first.
    """

    def __init__(self, xy: np.ndarray, z: np.ndarray, rings: Sequence[Sequence[int]]):
        self.xy = [tuple(place) for place in np.asarray(xy, float).tolist()]
        self.z = np.asarray(z, float).tolist()
        flat = np.column_stack([xy, np.zeros(len(xy))])
        self.triangles: dict[int, tuple[int, int, int]] = {}
        self.beside: dict[tuple[int, int], int] = {}
        self._next = 0
        for triangle in triangulate_face(flat, [tuple(ring) for ring in rings]):
            self._add(triangle)
        self._legalise([edge for edge in self.beside if edge[::-1] in self.beside])

    def _add(self, triangle: tuple[int, int, int]) -> int:
        number, self._next = self._next, self._next + 1
        self.triangles[number] = triangle
        for a, b in zip(triangle, triangle[1:] + triangle[:1]):
            self.beside[a, b] = number
        return number

    def _remove(self, number: int) -> tuple[int, int, int]:
        triangle = self.triangles.pop(number)
        for a, b in zip(triangle, triangle[1:] + triangle[:1]):
            del self.beside[a, b]
        return triangle

    def refine(self, xy: np.ndarray, z: np.ndarray, tolerance: float, max_points: int) -> None:
        """Insert the farthest of points (n, 2), heights (n,), until all lie within `tolerance` (m); `max_points` at
        most."""
        owner = self.locate(xy, list(self.triangles))
        error = np.zeros(len(xy))
        inside = owner >= 0
        self._measure(xy, z, owner, error, np.flatnonzero(inside))
        for _ in range(max_points):
            worst = int(error.argmax()) if len(error) else -1
            if worst < 0 or error[worst] <= tolerance:
                return
            changed = self._insert(tuple(xy[worst].tolist()), float(z[worst]), int(owner[worst]))
            if changed is None:
                error[worst] = 0.0
                owner[worst] = -1
                continue
            old, new = changed
            members = np.flatnonzero(np.isin(owner, old))
            owner[members] = self.locate(xy[members], new)
            self._measure(xy, z, owner, error, members)
            error[worst], owner[worst] = 0.0, -1

    def _measure(self, xy: np.ndarray, z: np.ndarray, owner: np.ndarray, error: np.ndarray,
                 members: np.ndarray) -> None:
        error[members] = np.abs(z[members] - self.heights(xy[members], owner[members]))
        error[members[owner[members] < 0]] = 0.0

    def locate(self, xy: np.ndarray, among: Sequence[int]) -> np.ndarray:
        """Number of the triangle that holds each of places (n, 2), of those given; -1 for none."""
        owner = np.full(len(xy), -1, np.int64)
        best = np.full(len(xy), -1e-6)
        for number in among:
            share = self._shares(xy, self.triangles[number]).min(axis=1)
            better = share > best
            owner[better], best[better] = number, share[better]
        return owner

    def _shares(self, xy: np.ndarray, triangle: tuple[int, int, int]) -> np.ndarray:
        """Barycentric coordinates (n, 3) of places."""
        (ax, ay), (bx, by), (cx, cy) = (self.xy[corner] for corner in triangle)
        whole = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        x, y = xy[:, 0], xy[:, 1]
        u = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / whole
        v = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / whole
        return np.column_stack([u, v, 1 - u - v])

    def heights(self, xy: np.ndarray, owner: np.ndarray) -> np.ndarray:
        """Heights (n,) at places in known triangles, NaN without."""
        result = np.full(len(xy), np.nan)
        known = np.flatnonzero(owner >= 0)
        if not len(known):
            return result
        names, of = np.unique(owner[known], return_inverse=True)
        corners = np.array([self.triangles[number] for number in names.tolist()])[of]
        places, z = np.array(self.xy), np.array(self.z)
        a, b, c = (places[corners[:, k]] for k in range(3))
        p = xy[known]
        whole = _cross(b - a, c - a)
        u, v = _cross(b - p, c - p) / whole, _cross(c - p, a - p) / whole
        result[known] = u * z[corners[:, 0]] + v * z[corners[:, 1]] + (1 - u - v) * z[corners[:, 2]]
        return result

    def _insert(self, place: tuple[float, float], z: float, number: int) -> tuple[list[int], list[int]] | None:
        """Put a point into a triangle; which triangles went and came, None where it lies on the polygon's edge."""
        triangle = self.triangles[number]
        share = self._shares(np.array([place]), triangle)[0]
        low = int(share.argmin())
        side = triangle[(low + 1) % 3], triangle[(low + 2) % 3]
        on_side = share[low] < _INSIDE
        if on_side and side[::-1] not in self.beside:
            return None
        vertex = len(self.xy)
        self.xy.append(place)
        self.z.append(z)
        old, new = [number], []
        self._remove(number)
        if on_side:
            other = self.beside[side[::-1]]
            old.append(other)
            opposite = next(corner for corner in self._remove(other) if corner not in side)
            top = triangle[low]
            parts = [(top, side[0], vertex), (top, vertex, side[1]),
                     (opposite, side[1], vertex), (opposite, vertex, side[0])]
        else:
            a, b, c = triangle
            parts = [(a, b, vertex), (b, c, vertex), (c, a, vertex)]
        new = [self._add(part) for part in parts]
        gone, come = self._legalise([edge for part in parts for edge in zip(part, part[1:] + part[:1])
                                     if vertex not in edge])
        return (list(dict.fromkeys(old + gone)),
                [name for name in dict.fromkeys(new + come) if name in self.triangles])

    def _legalise(self, waiting: list[tuple[int, int]]) -> tuple[list[int], list[int]]:
        """Flip edges until none has a point in its circle; which triangles went and came."""
        gone, come = [], []
        while waiting:
            a, b = waiting.pop()
            one, two = self.beside.get((a, b)), self.beside.get((b, a))
            if one is None or two is None:
                continue
            c = next(corner for corner in self.triangles[one] if corner not in (a, b))
            d = next(corner for corner in self.triangles[two] if corner not in (a, b))
            if not self._in_circle(a, b, c, d) or not self._convex(a, d, b, c):
                continue
            self._remove(one)
            self._remove(two)
            gone += [one, two]
            come += [self._add((c, a, d)), self._add((d, b, c))]
            waiting += [(a, d), (d, b), (b, c), (c, a)]
        return gone, come

    def _in_circle(self, a: int, b: int, c: int, d: int) -> bool:
        """Whether d lies clearly in the circle through a, b, c (counterclockwise)."""
        dx, dy = self.xy[d]
        rows = [(x - dx, y - dy) for x, y in (self.xy[a], self.xy[b], self.xy[c])]
        (ax, ay), (bx, by), (cx, cy) = rows
        a2, b2, c2 = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
        size = max(a2, b2, c2)
        value = ax * (by * c2 - b2 * cy) - ay * (bx * c2 - b2 * cx) + a2 * (bx * cy - by * cx)
        return value > 1e-9 * size * size

    def _convex(self, *ring: int) -> bool:
        """Whether four corners turn left all the way round, none of them straight."""
        places = [self.xy[corner] for corner in ring]
        for k in range(4):
            (ax, ay), (bx, by), (cx, cy) = places[k - 2], places[k - 1], places[k]
            if (bx - ax) * (cy - by) - (by - ay) * (cx - bx) <= 1e-9:
                return False
        return True


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
