"""What walls say of a correction: where the outlines want it.

Eaves, balconies and what an outline is off by stand between a facade and its outline: how far facades stand inside the
outlines in the mean is one unknown of the whole drive, by how much each building differs from it and each wall from its
building are unknowns too: the walls of a building share its eaves, and a wall tells of its place once however many
planes it has, but of how the correction changes along it by each of them. Their sizes are found from the walls alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ....estimation.chain import NodeChain, SettledChain, smooth_between
from ....estimation.error_model import PoseErrorModel
from ....estimation.held_observations import HeldObservations, OwnOffsets
from ....geometry.tolerances import SIGMA_OF_MAD
from .facade_planes import FacadePlanes
from .outline_walls import LIMITS as OUTLINES
from .outline_walls import MatchedWalls, WallEdges
from .stretches import ShiftedStretch, WallReadings, shifted_stretches
from .upright_walls import UprightWalls

Curve = Callable[[np.ndarray], np.ndarray]
"""Corrections (m, 6) at path parameters (m,)."""


@dataclass(frozen=True)
class WitnessLimits:
    """Limits of witness, each with its unit."""

    differ: tuple[float, float, float] = (0.05, 0.3, 0.6)  # m, by which single walls differ: least, at first, most
    floor: float = 0.03  # m, of any wall: structure of facades, roll and pitch
    soft: float = 2.5  # standard deviations from which a wall loses weight
    fewest: int = 6  # planes of a wall
    walls: int = 4  # from which their differences can be told
    rounds: int = 10  # at most, until the walls' own course moves by less than `settled` m
    settled: float = 0.02
    freedom: float = 1.25  # by which walls differ more than from a course that follows them
    piece: float = 10.0  # m of path whose planes of a wall are one observation
    # m, of buildings from the mean, and of walls from their building: at first, and at least
    sizes: tuple[float, float] = (0.3, 0.1)
    least: float = 0.03


LIMITS = WitnessLimits()


@dataclass(frozen=True)
class WallsAlone:
    """The correction by walls alone at the nodes: (k, 2) m in plan with covariances (k, 2, 2)."""

    place: np.ndarray
    covariance: np.ndarray


@dataclass(frozen=True)
class WallWitness:
    """The facades of a survey and the outlines that they may belong to.

    Attributes
    ----------
    planes : in the order driven.
    edges : None where no outlines are given: then walls tell the pitch alone.
    alone : whether markings give the start only, and walls the correction.
    eaves : m, by which facades stand inside the outlines in the mean, as taken at last.
    differ : m, standard deviation of single walls about it.
    sizes : m, by how much buildings differ from it, and walls from their building.
    course : the correction by the walls alone, once it is fitted.
    """

    planes: FacadePlanes
    edges: WallEdges | None = None
    alone: bool = False
    eaves: float = OUTLINES.inside[0]
    differ: float = LIMITS.differ[1]
    sizes: tuple[float, float] = LIMITS.sizes
    course: Curve | None = None

    def among(self, marked: Callable[[np.ndarray], np.ndarray]) -> WallWitness:
        """With the planes alone that were seen where a mask of path parameters (n,) is true."""
        return replace(self, planes=self.planes.select(marked(self.planes.path_parameter)))

    def matched(self, curve: Curve) -> MatchedWalls:
        """The planes that belong to outlines, as a curve places them."""
        edge, outside = self.edges.matched(self.planes.translated(curve), self.planes.normal, self.eaves)
        known = edge >= 0
        count = np.bincount(edge[known], minlength=len(self.edges))
        known[known] = count[edge[known]] >= LIMITS.fewest
        return MatchedWalls(self.planes.select(known), edge[known], self.edges.outward[edge[known]], outside[known])

    def about(self, curve: Curve, active: tuple[int, ...]) -> HeldObservations | None:
        """The walls' observations about a curve; None where no facade belongs to an outline."""
        if self.edges is None or not len((found := self.matched(curve)).planes):
            return None
        pieces = _WallPieces.of(found)
        sigma2 = self.differ**2 + LIMITS.floor**2 + self.edges.sigma[pieces.edge] ** 2
        trust = 1.0 / (1.0 + (pieces.middle + self.eaves) ** 2 / (LIMITS.soft**2 * sigma2)) ** 2
        weight = trust / (sigma2 * np.bincount(pieces.wall))
        rates = found.planes.rates(found.outward)
        rates[:, 3:] = 0.0  # an outline's direction is off by more than a heading is: it turns nobody
        rate = pieces.mean(rates[:, list(active)])
        value = pieces.mean((rates * curve(found.planes.path_parameter)).sum(axis=1))
        target = value - pieces.outside - self.eaves
        return HeldObservations(pieces.mean(found.planes.path_parameter), rate, target, weight[pieces.wall], self.eaves,
                                self.edges.inside, pieces.offsets(self.edges, self.sizes, trust))

    def upright(self) -> UprightWalls | None:
        """Walls across the street, which tell the pitch; None where none is seen."""
        return UprightWalls.among(self.planes)

    def fitted(self, chain: NodeChain, model: PoseErrorModel, curve: Curve) -> WallWitness:
        """With eaves and differences as the walls alone tell them, and the course that they want, from a curve on.

        Walls are matched anew about their own course until it stays: markings may have led the curve metres away.
        """
        witness, none, last = self, np.zeros(len(chain.normals.present)), None
        for _ in range(LIMITS.rounds):
            observations = witness.about(curve, chain.normals.active)
            if observations is None:
                return witness
            alone = chain.with_held(observations)
            settled = alone.settled(model, none)
            state, curve = settled.state, node_curve(chain, settled.state)
            witness = replace(witness.with_eaves(settled.offset), course=curve, sizes=_sizes(settled, observations))
            witness = replace(witness, differ=witness._differences(curve))
            if last is not None and np.abs(state - last)[:, :2, 0].max() < LIMITS.settled:
                break
            last = state
        return witness

    def _differences(self, curve: Curve) -> float:
        """m, standard deviation of single walls about the mean eaves; as before where walls are few."""
        _, _, middle = self.matched(curve).by_wall()
        if len(middle) < LIMITS.walls:
            return self.differ
        spread = LIMITS.freedom * SIGMA_OF_MAD * float(np.median(np.abs(middle - np.median(middle))))
        return float(np.clip(spread, LIMITS.differ[0], LIMITS.differ[2]))

    def with_eaves(self, eaves: float) -> WallWitness:
        """With other eaves."""
        return replace(self, eaves=float(np.clip(eaves, *self.edges.possible)))

    def stretches(self, curve: Curve) -> list[ShiftedStretch]:
        """Stretches whose outlines want a curve elsewhere."""
        found = self.matched(curve)
        wall, count, middle = found.by_wall()
        if not len(count):
            return []
        chainage = np.bincount(wall, found.planes.chainage) / count
        outward = np.column_stack([np.bincount(wall, axis) / count for axis in found.outward.T])
        order = np.argsort(chainage, kind="stable")
        edge = np.empty(len(count), int)
        edge[wall] = found.edge
        sigma = np.sqrt(self.differ**2 + LIMITS.floor**2 + self.edges.sigma[edge] ** 2)
        readings = WallReadings(chainage[order], outward[order], middle[order], sigma[order], self.edges.shared)
        return shifted_stretches(readings, self.edges.inside)

    def by_walls(self, chain: NodeChain, model: PoseErrorModel) -> WallsAlone:
        """The correction that the walls held by a chain give without any markings."""
        none = np.zeros(len(chain.normals.present))
        settled = chain.settled(model, none)
        return WallsAlone(settled.state[:, :2, 0], in_plan(settled.covariance))


def _sizes(settled: SettledChain, held: HeldObservations) -> tuple[float, float]:
    """m, by how much buildings and walls differ: of each the expected square, given all that was observed, is what was
    found and its variance (expectation and maximisation: Dempster, Laird and Rubin 1977). Walls that stand out count
    as little as they are believed.
    """
    square, found = settled.own**2 + settled.own_variance, []
    for level in range(2):
        mine = held.own.level == level
        share = held.own.precision[mine] / held.own.precision[mine].max()
        found.append(float(np.clip(np.sqrt((share * square[mine]).sum() / share.sum()), LIMITS.least,
                                   LIMITS.differ[2])))
    return found[0], found[1]


@dataclass(frozen=True)
class _WallPieces:
    """Planes of walls by pieces of the path, along it.

    Attributes
    ----------
    piece : (n,) number of each plane's piece.
    count : (p,) planes.
    outside : (p,) m, median of how far outside of the outline they lie.
    wall : (p,) number of the wall, from 0.
    edge, middle : (w,) of each wall, the number of its edge, and its planes' median place, m.
    """

    piece: np.ndarray
    count: np.ndarray
    outside: np.ndarray
    wall: np.ndarray
    edge: np.ndarray
    middle: np.ndarray

    @classmethod
    def of(cls, found: MatchedWalls) -> _WallPieces:
        """Those of planes along the path."""
        wall, _, middle = found.by_wall()
        part = (found.planes.path_parameter // LIMITS.piece).astype(np.int64)
        _, first, piece, count = np.unique(np.column_stack([part, wall]), axis=0, return_index=True,
                                           return_inverse=True, return_counts=True)
        along = np.argsort(np.bincount(piece.ravel(), found.planes.path_parameter) / count, kind="stable")
        place = np.empty(len(along), int)
        place[along] = np.arange(len(along))
        piece, first, count = place[piece.ravel()], first[along], count[along]
        order = np.lexsort((found.outside, piece))
        ends = np.cumsum(count)
        edge = np.empty(len(middle), int)
        edge[wall] = found.edge
        return cls(piece, count, found.outside[order][(2 * ends - count) // 2], wall[first], edge, middle)

    def mean(self, values: np.ndarray) -> np.ndarray:
        """(p, ...) of the planes' values (n, ...)."""
        flat = values.reshape(len(values), -1)
        made = np.column_stack([np.bincount(self.piece, axis) for axis in flat.T]) / self.count[:, None]
        return made.reshape(len(self.count), *values.shape[1:])

    def offsets(self, edges: WallEdges, sizes: tuple[float, float], trust: np.ndarray) -> OwnOffsets:
        """Of the edges' buildings and of walls that differ by `sizes` m, walls more where `trust` (w,) is less."""
        _, owner = np.unique(edges.building[self.edge], return_inverse=True)
        owner, buildings = owner.ravel(), int(owner.max()) + 1
        of_wall = trust / (sizes[1] ** 2 + edges.sigma[self.edge] ** 2)
        precision = np.concatenate([np.full(buildings, sizes[0] ** -2.0), of_wall])
        off = np.abs(self.outside - self.middle[self.wall])
        scatter = max(LIMITS.floor, SIGMA_OF_MAD * float(np.median(off)))
        weight = 1.0 / (scatter**2 * (1.0 + (off / (LIMITS.soft * scatter)) ** 2))
        return OwnOffsets(np.column_stack([owner[self.wall], buildings + self.wall]), precision,
                          np.repeat([0, 1], [buildings, len(trust)]), weight)


def in_plan(covariance: np.ndarray) -> np.ndarray:
    """(k, 2, 2) of the errors east and north, of nodes' covariances (k, 2 d, 2 d)."""
    return covariance[:, (0, 2)][:, :, (0, 2)]


def node_curve(chain: NodeChain, state: np.ndarray) -> Curve:
    """The correction along the path by the nodes' states (k, d, 2)."""
    def curve(path_parameter: np.ndarray) -> np.ndarray:
        correction = np.zeros((len(path_parameter), 6))
        correction[:, chain.normals.active] = smooth_between(chain.nodes, state, path_parameter)
        return correction
    return curve
