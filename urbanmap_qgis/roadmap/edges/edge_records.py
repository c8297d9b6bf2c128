"""Edges of a road and how they are looked for: settings, points, candidates and results."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...wording import mark

POINT = np.dtype([("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("drive", "<u2")])
"""A laser point, m, and the number of the pass that measured it."""

KERB, LOWERED, BORDER, RAIL, WALL = "kerb", "lowered kerb", "road border", "guard rail", "wall"
MEASURED, DOUBTFUL = mark("measured"), mark("doubtful")


@dataclass(frozen=True)
class EdgeCandidates:
    """Places where an edge seems to pass, in arrays.

    Attributes
    ----------
    place : (n, 2) m.
    normal : (n, 2) unit vectors towards the higher side.
    height : (n,) m.
    score : (n,) weight.
    """

    place: np.ndarray
    normal: np.ndarray
    height: np.ndarray
    score: np.ndarray

    def __len__(self) -> int:
        return len(self.score)


@dataclass(frozen=True)
class Course:
    """Stations along an edge that was found: (n, 2) places and unit normals towards its higher side, each 0.5 m.

    `seen` (n,) tells where candidates support it; elsewhere it is drawn straight between two parts.
    """

    place: np.ndarray
    normal: np.ndarray
    seen: np.ndarray


@dataclass(frozen=True)
class RoadEdge:
    """An edge as it is delivered.

    Attributes
    ----------
    kind : `KERB`, `LOWERED`, `BORDER`, `RAIL` or `WALL`.
    foot, top : (n, 3) m; the line at the road and the one above it.
    height : median of top over foot, m.
    sigma, sigma_z : standard deviations across and in height, m.
    points : laser points that it is fitted to.
    passes : of the survey.
    completeness : share of its stations measured.
    chain : number that the parts of one edge share.
    gap : m to the next part of its chain, 0 where there is none.
    status : `MEASURED` or `DOUBTFUL`.
    reason : why.
    """

    kind: str
    foot: np.ndarray
    top: np.ndarray
    height: float
    sigma: float
    sigma_z: float
    points: int
    passes: int
    completeness: float
    chain: int
    gap: float
    status: str
    reason: str

    @property
    def length(self) -> float:
        """Of the foot line in plan, m."""
        return float(np.hypot(*np.diff(self.foot[:, :2], axis=0).T).sum())


def joined_candidates(parts: list[EdgeCandidates]) -> EdgeCandidates:
    """All candidates of some lists."""
    if not parts:
        return EdgeCandidates(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0), np.zeros(0))
    return EdgeCandidates(*(np.concatenate([getattr(part, name) for part in parts])
                        for name in ("place", "normal", "height", "score")))
