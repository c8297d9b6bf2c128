"""Joining of raster regions into few level ones; the cost is the growth of the squared height errors."""

from __future__ import annotations

import heapq
from collections.abc import Collection

import numpy as np


class RegionGraph:
    """Regions of a label raster, their heights and their neighbours.

    Cost of a merge is the growth of the sum of squared distances from the regions' mean heights (Ward 1963),
    in m2 times cells. Regions are numbered 1..k as in the raster.

    Parameters
    ----------
    labels : (rows, columns) int, 0 = no region.
    height : (rows, columns) m, finite where there is a label.
    """

    def __init__(self, labels: np.ndarray, height: np.ndarray):
        k = int(labels.max(initial=0))
        self.size = k + 1
        use = labels > 0
        of_cell, z = labels[use], height[use]
        self.offset = float(z.mean()) if len(z) else 0.0
        z = z - self.offset
        self.area = np.bincount(labels.ravel(), minlength=k + 1).tolist()
        self.n = np.bincount(of_cell, minlength=k + 1).tolist()
        self.sum = np.bincount(of_cell, z, k + 1).tolist()
        self.squares = np.bincount(of_cell, z * z, k + 1).tolist()
        self.parent = list(range(k + 1))
        self.alive = [False] + [a > 0 for a in self.area[1:]]
        self.neighbours: list[dict[int, tuple[float, float]]] = [{} for _ in range(k + 1)]
        self._connect(labels, height)

    def _connect(self, labels: np.ndarray, height: np.ndarray) -> None:
        """Neighbours with the number of shared cell sides and the sum of height steps over them."""
        first = np.concatenate((labels[:, :-1].ravel(), labels[:-1].ravel()))
        second = np.concatenate((labels[:, 1:].ravel(), labels[1:].ravel()))
        step = np.concatenate((np.diff(height, axis=1).ravel(), np.diff(height, axis=0).ravel()))
        border = np.flatnonzero((first != second) & (first > 0) & (second > 0))
        first, second, step = first[border], second[border], np.abs(step[border])
        low, high = np.minimum(first, second), np.maximum(first, second)
        keys, index = np.unique(low.astype(np.int64) * self.size + high, return_inverse=True)
        sides = np.bincount(index, minlength=len(keys)).tolist()
        steps = np.bincount(index, step, len(keys)).tolist()
        for key, count, total in zip(keys.tolist(), sides, steps):
            a, b = divmod(key, self.size)
            self.neighbours[a][b] = self.neighbours[b][a] = (count, total)

    def regions(self) -> list[int]:
        """Numbers of the regions left."""
        return [r for r in range(1, self.size) if self.alive[r]]

    def mean(self, region: int) -> float:
        """Mean height of a region less the offset of the graph, m; 0 for a region without measured cells."""
        return self.sum[region] / self.n[region] if self.n[region] else 0.0

    def squared_error(self, region: int) -> float:
        """Sum of squared distances from the mean height, m2 times cells."""
        n = self.n[region]
        return max(self.squares[region] - self.sum[region] ** 2 / n, 0.0) if n else 0.0

    def cost(self, a: int, b: int) -> float:
        """Growth of the squared error if the two were one, m2 times cells."""
        na, nb = self.n[a], self.n[b]
        if not na or not nb:
            return 0.0
        return na * nb / (na + nb) * (self.sum[a] / na - self.sum[b] / nb) ** 2

    def step(self, a: int, b: int) -> float:
        """Mean height step over the boundary of two neighbours, m."""
        sides, total = self.neighbours[a][b]
        return total / sides

    def merge(self, keep: int, gone: int, with_heights: bool = True) -> None:
        """Join `gone` to `keep`; without its heights if they do not stand for the roof."""
        self.area[keep] += self.area[gone]
        if with_heights:
            self.n[keep] += self.n[gone]
            self.sum[keep] += self.sum[gone]
            self.squares[keep] += self.squares[gone]
        self.parent[gone] = keep
        self.alive[gone] = False
        mine = self.neighbours[keep]
        mine.pop(gone, None)
        for other, (sides, total) in self.neighbours[gone].items():
            theirs = self.neighbours[other]
            theirs.pop(gone, None)
            if other != keep:
                old = mine.get(other, (0, 0.0))
                mine[other] = theirs[keep] = (old[0] + sides, old[1] + total)
        self.neighbours[gone] = {}

    def lookup(self) -> np.ndarray:
        """(k + 1,) the region that each first region has ended in, 0 to 0."""
        result = np.arange(self.size)
        for r in range(1, self.size):
            root = r
            while self.parent[root] != root:
                root = self.parent[root]
            self.parent[r] = result[r] = root
        return result

    def absorb_small(self, smallest: float, height_limit: float,
                     narrow: Collection[int] = (), parapets: Collection[int] = ()) -> None:
        """Join regions of fewer than `smallest` cells to the neighbour closest in height, smallest first.

        The heights of a region that stands off by more than `height_limit` m are left out of the joined
        region. A small region without neighbours stays. Regions of `narrow` are joined whatever their size, and
        never take a wide one in: a ring of parapets may have more cells than the roof within. The heights of
        `parapets`, some of the narrow ones, are always left out.
        """
        queue = [(self.area[r], r) for r in self.regions() if self.area[r] < smallest or r in narrow]
        heapq.heapify(queue)
        while queue:
            area, r = heapq.heappop(queue)
            if not self.alive[r] or self.area[r] != area or not self.neighbours[r]:
                continue
            gap, _, best = min((abs(self.mean(r) - self.mean(o)), -self.neighbours[r][o][0], o)
                               for o in self.neighbours[r])
            takes = best not in narrow if r in narrow else self.area[best] >= area
            keep, gone = (best, r) if takes or self.area[best] >= area else (r, best)
            self.merge(keep, gone, with_heights=gone not in parapets and (gap <= height_limit or not self.n[gone]))
            if self.area[keep] < smallest:
                heapq.heappush(queue, (self.area[keep], keep))

    def merge_to_tolerance(self, rmse: float, distinct_step: float) -> None:
        """Join neighbours, cheapest first, as long as the root mean square error stays below `rmse` m.

        Two regions that are apart by a step of `distinct_step` m or more are never joined: a set-back or a plant room
        is a roof of its own however little it weighs in the mean. Small ones are joined before.
        """
        queue = [(self.cost(a, b), a, b) for a in self.regions() for b in self.neighbours[a] if a < b]
        heapq.heapify(queue)
        error = sum(self.squared_error(r) for r in self.regions())
        budget = rmse**2 * sum(self.n[r] for r in self.regions())
        while queue:
            cost, a, b = heapq.heappop(queue)
            if b not in self.neighbours[a] or cost != self.cost(a, b):
                continue  # outdated: one of the two has been joined since
            if error + cost > budget:
                break
            step = min(self.step(a, b), abs(self.mean(a) - self.mean(b)))
            if step >= distinct_step:
                continue
            error += cost
            self.merge(a, b)
            for other in self.neighbours[a]:
                low, high = min(a, other), max(a, other)
                heapq.heappush(queue, (self.cost(low, high), low, high))
