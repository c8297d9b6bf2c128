"""What a second witness beside the markings, the walls, says of a correction, and what follows where they disagree."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

import numpy as np

from ....estimation.chain import NodeChain, NodeCurve, smooth_between
from ....estimation.error_model import PITCH, PoseErrorModel
from ....estimation.held_observations import HeldObservations
from ....estimation.normal_equations import NormalEquations
from ....geometry.tolerances import LEAST_DIVISOR
from ....wording import mark, say
from ..records import WindowResults
from .patch_status import BRIDGED, MOST_SPAN, REGISTERED, evidence_spans, only_own_mode_fits
from .reference_steps import Adjusted, CorrectionStep
from .robust_fit import Fit
from .settings import CorrectionSettings

AGAINST_WALLS = mark("markings and walls disagree")
"""Kind of a step: where a stretch begins in which the markings lie elsewhere than the walls want them."""


@dataclass(frozen=True)
class SecondWitnessLimits:
    """Limits of second witness, each with its unit."""

    same: float = 25.0  # m of path within which a step belongs to markings that were led astray
    # Standard deviations and m from which markings count as led astray; standard deviations within which others
    # agree with the walls, and how many nodes must.
    astray: float = 5.0
    most_moved: float = 1.0
    agreeing: float = 3.0
    agreeing_nodes: int = 10
    reach: float = 30.0  # m of path beyond a stretch that are told with it: walls and markings are seen so far ahead
    rounds: int = 3  # in which the walls are matched anew
    weighings: int = 3  # in which leaning walls are weighed, and how far the pitch is off is found
    worse: tuple[float, ...] = (1.0, 1.5, 2.0, 3.0)  # times as far as stated that a pitch may be off


LIMITS = SecondWitnessLimits()


class Stretch(Protocol):
    """A stretch of chainage, m, whose markings lie by `change` (2,) m off where the walls want them; (2, 2)."""

    begin: float
    end: float
    change: np.ndarray
    covariance: np.ndarray


class Alone(Protocol):
    """The correction by the witness alone: (k, 2) m, (k, 2, 2)."""

    place: np.ndarray
    covariance: np.ndarray


class Upright(Protocol):
    """Walls that stand upright: what they say of the angles among some parameters, about a curve."""

    def about(self, curve: Callable, active: Sequence[int]) -> HeldObservations: ...


class Witness(Protocol):
    """Walls, as the adjustment sees them."""

    alone: bool
    course: Callable | None

    def among(self, spans: Callable[[np.ndarray], np.ndarray]) -> Witness: ...

    def about(self, curve: Callable, active: tuple[int, ...]) -> HeldObservations | None: ...

    def upright(self) -> Upright | None: ...

    def fitted(self, chain: NodeChain, model: PoseErrorModel, curve: Callable) -> Witness: ...

    def with_eaves(self, eaves: float) -> Witness: ...

    def stretches(self, curve: Callable) -> Sequence[Stretch]: ...

    def by_walls(self, chain: NodeChain, model: PoseErrorModel) -> Alone: ...


def settled_offset(chain: NodeChain, fit: Fit, model: PoseErrorModel, weight: np.ndarray) -> tuple[Fit, float]:
    """The fit with what the chain holds, at the most likely offset of it, and that offset, m.

    `weight` : (n,) of the markings' evidence.
    """
    settled = chain.settled(model, weight)
    return replace(fit, state=settled.state, covariance=settled.covariance), settled.offset


@dataclass(frozen=True)
class WitnessConflict:
    """Stretches of the path where markings and walls disagree."""

    stretches: Sequence[Stretch]

    def mask_and_variance(self, chainage: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mask (n,) of chainages in conflict, and the variance (n, 2, 2) m2 that it adds: either may be right."""
        against, variance = np.zeros(len(chainage), bool), np.zeros((len(chainage), 2, 2))
        for item in self.stretches:
            inside = (chainage >= item.begin - LIMITS.reach) & (chainage <= item.end + LIMITS.reach)
            variance[inside & ~against] = np.outer(item.change, item.change) + item.covariance
            against |= inside
        return against, variance

    def listed(self, chainage: np.ndarray, time: np.ndarray) -> list[CorrectionStep]:
        """One step for each stretch, where it begins; by the patches' chainages and times (n,)."""
        steps = []
        for item in self.stretches:
            size = float(np.hypot(*item.change))
            sigma = float(np.sqrt(item.change @ item.covariance @ item.change)) / max(size, LEAST_DIVISOR)
            begin = max(item.begin, float(chainage[0]))
            ends = np.clip([item.begin - LIMITS.reach, item.end + LIMITS.reach], chainage[0], chainage[-1])
            steps.append(CorrectionStep(begin, float(np.interp(begin, chainage, time)), *(-item.change).tolist(), sigma,
                                        AGAINST_WALLS, (float(ends[0]), float(ends[1]))))
        return steps


def without_astray(found: Adjusted, observations: HeldObservations, model: PoseErrorModel,
                   witness: Witness) -> Adjusted:
    """What was found without those markings that led it away from the walls by more than paint is ever moved.

    The walls decide where markings elsewhere agree with them: a slip by a dash, or chance where markings are bare, is
    no error of outlines. The steps into and out of it are none of the reference.
    """
    chain, fit = found.chain, found.fit
    alone = witness.by_walls(chain.with_held(observations), model)
    change = alone.place - fit.state[:, :2, 0]
    spread = alone.covariance + fit.covariance[:, (0, 2)][:, :, (0, 2)]
    square = np.einsum("ki,kij,kj->k", change, np.linalg.inv(spread), change)
    marked, disagreeing = chain.marked(fit.weight), square > LIMITS.agreeing**2
    away = marked & (square > LIMITS.astray**2) & (np.hypot(*change.T) > LIMITS.most_moved)
    # Where the walls know too little to show such a move, they agree with nothing.
    knowing = LIMITS.agreeing**2 * np.linalg.eigvalsh(spread)[:, -1] < LIMITS.most_moved**2
    if not away.any() or np.count_nonzero(marked & knowing & ~disagreeing) < LIMITS.agreeing_nodes:
        return found
    run = np.cumsum(np.concatenate([[0], np.abs(np.diff(disagreeing.astype(int)))]))
    astray = disagreeing & np.isin(run, run[away])
    places = chain.nodes[astray]
    steps = [step for step in found.steps if np.abs(places - step.begin).min() > LIMITS.same]
    near = np.abs(places[None] - 0.5 * (chain.nodes[1:] + chain.nodes[:-1])[:, None]).min(axis=1) <= LIMITS.same
    chain, weight = chain.with_fast(np.where(near, 0.0, chain.fast)), np.where(astray[chain.node], 0.0, fit.weight)
    state, covariance, _ = chain.solve(model, weight / fit.noise_factor)
    return replace(found, chain=chain, steps=steps,
                   fit=replace(fit, state=state, covariance=covariance, weight=weight))


def with_conflict(status: np.ndarray, reason: np.ndarray, against: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Statuses and reasons (n,) of patches: none is registered where markings and walls disagree."""
    status, reason = status.copy(), reason.copy()
    status[against & (status == REGISTERED)] = BRIDGED
    reason[against] = say("markings and walls disagree here")
    return status, reason


def wall_shares(by_paint: np.ndarray, by_walls: np.ndarray) -> np.ndarray:
    """(n,) 0 to 1, share of the walls in what both know of a place in plan, information (n, 2, 2) each."""
    paint, walls = (np.einsum("nii->n", part) for part in (by_paint, by_walls))
    return walls / np.maximum(paint + walls, LEAST_DIVISOR)


def where_walls_want_it(walls: Witness, chain: NodeChain, fit: Fit, model: PoseErrorModel, windows: WindowResults,
                        at_patches: np.ndarray, settings: CorrectionSettings) -> np.ndarray:
    """Mask (n,) of patches whose own position, and no other one of theirs, lies where the walls alone want it."""
    model, curve = model.scaled(fit.drift_factor).with_heading(fit.heading_factor), NodeCurve(chain, fit.state)
    walls = walls.fitted(chain, model, curve)
    wall_observations = None if walls.course is None else walls.about(walls.course, chain.normals.active)
    if wall_observations is None:
        return np.zeros(len(windows), bool)
    alone = walls.by_walls(chain.with_held(wall_observations), model)
    node = np.searchsorted(0.5 * (chain.nodes[1:] + chain.nodes[:-1]), at_patches)
    place = np.column_stack([np.interp(at_patches, chain.nodes, axis) for axis in alone.place.T])
    return only_own_mode_fits(windows, place, alone.covariance[node], settings)


def with_witness(walls: Witness, found: Adjusted, model: PoseErrorModel) -> tuple[Adjusted, WitnessConflict]:
    """What was found with what the walls say of it: where outlines want the survey."""
    walls, none = walls.fitted(found.chain, model, NodeCurve(found.chain, found.fit.state)), WitnessConflict(())
    wall_observations = None if walls.course is None else walls.about(walls.course, found.chain.normals.active)
    if wall_observations is not None and not walls.alone:
        found = without_astray(found, wall_observations, model, walls)
    if wall_observations is None:
        return found, none
    chain, fit = found.chain, found.fit
    conflict = none
    if not walls.alone:
        marked = walls.among(partial(_marked, chain, fit))
        conflict = WitnessConflict(marked.stretches(NodeCurve(chain, fit.state)))
    if walls.alone:
        silent = chain.normals.softened(np.zeros(len(fit.weight)))
        chain = chain.with_normals(replace(silent, present=np.zeros(len(fit.weight), bool)))
    for _ in range(LIMITS.rounds):
        chain = chain.with_held(wall_observations)
        fit, eaves = settled_offset(chain, fit, model, fit.weight / fit.noise_factor)
        walls = walls.with_eaves(eaves)
        wall_observations = walls.about(NodeCurve(chain, fit.state), chain.normals.active)
        if wall_observations is None:
            break
    return replace(found, chain=chain, fit=fit), conflict


def with_upright_walls(walls: Witness, found: Adjusted,
                       model: PoseErrorModel) -> tuple[Adjusted, PoseErrorModel]:
    """What was found with the pitch that walls across the street tell, and the model with a pitch as much off as shown.
    """
    chain, fit, upright = found.chain, found.fit, walls.upright()
    if upright is None or PITCH not in chain.normals.active:
        return found, model
    curve = _PitchedCurve(NodeCurve(chain, fit.state), chain.nodes, None)
    alone = chain.with_held(None).with_normals(NormalEquations.silent((PITCH,), chain.nodes))
    nothing = np.zeros(len(chain.nodes))
    for _ in range(LIMITS.weighings):
        leaning = alone.with_upright(upright.about(curve, (PITCH,)))
        shown = model.with_pitch(_shown_factor(leaning, model, nothing))
        curve = replace(curve, state=leaning.solve(shown, nothing)[0])
    chain = chain.with_upright(upright.about(curve, chain.normals.active))
    weight = fit.weight / fit.noise_factor
    if chain.held is not None:
        return replace(found, chain=chain, fit=settled_offset(chain, fit, shown, weight)[0]), shown
    state, covariance, _ = chain.solve(shown, weight)
    return replace(found, chain=chain, fit=replace(fit, state=state, covariance=covariance)), shown


def _shown_factor(leaning: NodeChain, model: PoseErrorModel, nothing: np.ndarray) -> float:
    """How many times as large as the model has it leaning walls show the pitch's error: the mean of what is possible.

    Each of `LIMITS.worse` counts by its likelihood (model averaging): one drive hardly tells them apart.
    """
    factors = np.array(LIMITS.worse)
    likelihood = np.array([leaning.solve(model.with_pitch(factor), nothing)[2] for factor in factors])
    share = np.exp(likelihood - likelihood.max())
    return float((share * factors).sum() / share.sum())


@dataclass(frozen=True)
class _PitchedCurve:
    """A correction with the pitch of states (k, 1, 2) at nodes (k,); without them as it is."""

    curve: Callable
    nodes: np.ndarray
    state: np.ndarray | None

    def __call__(self, path_parameter: np.ndarray) -> np.ndarray:
        correction = self.curve(path_parameter)
        if self.state is not None:
            correction[:, PITCH] = smooth_between(self.nodes, self.state, path_parameter)[:, 0]
        return correction


def _marked(chain: NodeChain, fit: Fit, path_parameter: np.ndarray) -> np.ndarray:
    """Mask (n,) of path parameters that markings hold: elsewhere walls contradict nothing but the drift's model."""
    return evidence_spans(chain.normals, fit.weight, path_parameter) <= MOST_SPAN
