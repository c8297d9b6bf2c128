"""Whose a fast change of the correction is: the drive's, the reference's, or either's.

A trajectory that is fixed anew spreads its change over 20 m and more, a reference steps at one place. Which of the two
makes the survey likelier is asked of the path around the change. Where neither does (the change lies where the vehicle
stands, or where markings are few), a slip of the trajectory aside shows that the change is the drive's. Without it
nobody knows, and neither side of the change is called registered. A stretch without markings that is long enough for a
fix to take place in it says nothing against one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from .chain import NodeChain
from .disagreements import Disagreements, NodeStep, settle, silences, step_tests
from .error_model import PoseErrorModel
from .error_steps import times_as_likely
from .patch_status import MOST_SPAN
from .robust_fit import Evaluate, Fit, adjusted_again, chain_likelihood
from .settings import CorrectionSettings
from .side_slip import SideSlip


@dataclass(frozen=True)
class FastChangeLimits:
    """Limits of fast changes, each with its unit."""

    around: float = 60.0  # m of path parameter to either side of a change that are asked
    beyond: int = 3  # nodes before and after a change at which a step may lie
    sure: float = 5.0  # log-likelihood by which one of two models must beat the other
    jump: float = 0.1  # m, least standard deviation of a step
    same: float = 25.0  # m of path parameter within which a step that was found is the change
    least: float = 0.1  # m: smaller changes leave nothing wrong that matters
    proof: float = 4.5  # standard deviations of a change across a stretch without markings
    fix: float = 20.0  # m driven, in which a trajectory can be fixed anew
    standing: float = 1.0  # s, that a stop lasts at least
    excluded: float = 3.0  # standard deviations beyond which both sides of a stretch deny a step
    slipped: float = 1.0  # m: markings that windows find farther off slipped, by a dash or so


LIMITS = FastChangeLimits()


LikelihoodOf = Callable[[NodeChain, np.ndarray, PoseErrorModel], float]
"""Log-likelihood of a model with a chain's evidence, believed so far at the nodes (k,)."""


@dataclass(frozen=True)
class FastChange:
    """A stretch in which the correction changes faster than drift.

    Attributes
    ----------
    begin, end : numbers of its first and last node.
    step : the likeliest sharp step instead of it.
    sharper, needed : log-likelihood of that step over the change spread over the stretch, and over drift alone.
    """

    begin: int
    end: int
    step: NodeStep
    sharper: float
    needed: float

    @property
    def spread(self) -> bool:
        """Whether it is spread over its stretch, as a drive's own change is."""
        return self.sharper < -LIMITS.sure

    def at_stake(self, step: NodeStep | None) -> NodeStep:
        """What either side may be off by: the step that the drift alone needs, or the whole change where it is more.

        Beside a stop the drift explains much of a step of the reference too.
        """
        if step is None:
            return self.step
        whole = self.step.change
        return replace(step, change=whole) if whole @ step.change > step.size**2 else step


def fast_changes(chain: NodeChain, fit: Fit, model: PoseErrorModel, allowed: np.ndarray,
                 likelihood: LikelihoodOf) -> list[FastChange]:
    """The stretches where a chain lets the error change fast, with what one sharp step would be in each.

    `allowed` : (k,) 0 to 1, how far the evidence at the nodes may be believed.
    """
    fast = np.flatnonzero(chain.fast > 0)
    if not len(fast):
        return []
    return [_change(chain, fit, model, allowed, likelihood, part)
            for part in np.split(fast, np.flatnonzero(np.diff(fast) > 1) + 1)]


def _change(chain: NodeChain, fit: Fit, model: PoseErrorModel, allowed: np.ndarray, likelihood: LikelihoodOf,
            part: np.ndarray) -> FastChange:
    """The change over steps `part` of the chain, by the path around it alone."""
    first, last = np.searchsorted(chain.nodes, chain.nodes[[part[0], part[-1]]] + LIMITS.around * np.array([-1, 1]))
    first, last = int(first), min(int(last), len(chain.nodes) - 1)
    near, model, believed = chain.between(first, last), model.between(first, last), allowed[first:last + 1]
    moved = fit.state[part + 1, :2, 0] - fit.state[part, :2, 0] - chain.stop_changes()[part, :2]
    change = moved.sum(axis=0)
    still = near.fast.copy()
    still[part - first] = 0.0
    places = np.arange(max(part[0] - LIMITS.beyond, first), min(part[-1] + LIMITS.beyond + 1, last)) - first

    def reached(place: int | None, fast: np.ndarray = still) -> float:
        fast = fast.copy()
        if place is not None:
            fast[place] = max(float(np.hypot(*change)), LIMITS.jump)
        return likelihood(near.with_fast(fast).hardened(), believed, model)

    likelihoods = np.array([reached(place) for place in places])
    best = int(likelihoods.argmax())
    step = NodeStep(int(places[best] + first), change, LIMITS.jump**2 * np.eye(2), LIMITS.proof**2)
    return FastChange(int(part[0]), int(part[-1]) + 1, step, float(likelihoods[best] - reached(None, near.fast)),
                      float(likelihoods[best] - reached(None)))


def with_steps(chain: NodeChain, fit: Fit, model: PoseErrorModel, allowed: np.ndarray, changes: list[FastChange],
               points: Evaluate | None, settings: CorrectionSettings) -> Disagreements:
    """The adjustment with its steps found; those fast changes are suspects that are not spread over their stretch.

    `allowed` : (k,) 0 to 1, how far the evidence at the nodes may be believed; `points` as in `adjust_correction`.
    """
    return settle(chain, fit, model, allowed,
                  partial(adjusted_again, points=points, model=model, settings=settings),
                  partial(chain_likelihood, settings=settings), MOST_SPAN,
                  [change.step for change in changes if not change.spread])


def with_undecided(found: Disagreements, changes: Sequence[FastChange], model: PoseErrorModel,
                   slip: SideSlip) -> Disagreements:
    """What was found, with the changes that may be the drive's or the reference's: no evidence tells which.

    Those that were found to be steps, that the trajectory's slip explains, or that have room enough for a fix where no
    markings are, are not among them.
    """
    chain, nodes = found.chain, found.chain.nodes
    known = [nodes[step.node] for step in (*found.steps, *(step for pair in found.changed for step in pair))]
    undecided: list[NodeStep] = []
    short = [gap for gap in found.hidden if slip.driven(*gap[:2]) < LIMITS.fix]
    long = [gap for gap in found.hidden if slip.driven(*gap[:2]) >= LIMITS.fix]
    for change in changes:
        begin, end = nodes[change.begin], nodes[change.end]
        room = any(begin < gap_end and gap_begin < end for gap_begin, gap_end, _ in long)
        if change.spread or room or change.needed < LIMITS.sure:
            continue
        fast = chain.fast.copy()
        fast[change.begin:change.end] = 0.0
        step = change.at_stake(step_tests(chain.with_fast(fast), model, found.fit, 1.0)[change.step.node])
        if step.size > LIMITS.least and not slip.explains(begin, end, step) and not _near(known, begin, end):
            undecided.append(step)
            known.append(nodes[step.node])
    for step in _at_stops(found, model):
        begin, end = nodes[step.node:step.node + 2]
        room = any(gap_begin < begin < gap_end for gap_begin, gap_end, _ in long)
        if not room and not slip.explains(begin, end, step) and not _near(known, begin, end):
            undecided.append(step)
            known.append(nodes[step.node])
    for begin, end, step in short:
        sure = step.square > LIMITS.proof**2 and step.size > LIMITS.least
        if sure and not slip.explains(begin, end, step) and not _near(known, begin, end):
            undecided.append(step)
    return replace(found, undecided=sorted(undecided, key=lambda step: step.node))


def _at_stops(found: Disagreements, model: PoseErrorModel) -> list[NodeStep]:
    """The likeliest step at each stop that the correction makes more of than its wandering there explains.

    What a standing vehicle's trajectory wanders is its own error: more can be a fault of either. Markings around few
    stops tell a change to 4.5 standard deviations, so that less has to do for a doubt: that a step of the reference
    makes what is seen as many times likelier as the drive has stops, as chance has as many tries (Bayes factor).
    """
    chain, likeliest = found.chain, []
    if chain.stopped.sum() < LIMITS.standing:
        return []
    tests = step_tests(chain, model, found.fit, 1.0)
    stops = np.flatnonzero(np.diff(np.concatenate([[0], (chain.stopped > 0).astype(int), [0]])))
    for first, end in zip(stops[::2], stops[1::2]):
        at_stop = [step for step in tests[first:end] if step is not None]
        if at_stop and chain.stopped[first:end].sum() >= LIMITS.standing:
            likeliest.append(max(at_stop, key=lambda item: item.square))
    return [step for step in likeliest if times_as_likely(step) > len(likeliest) and step.size > LIMITS.least]


def with_silences(found: Disagreements, model: PoseErrorModel, at_patches: np.ndarray,
                  windows_place: np.ndarray) -> Disagreements:
    """What was found, with the stretches whose markings the correction does not believe, although windows find them.

    They may belong to either side of a step of the reference where the sides leave room for one. Markings far off
    slipped; walls tell which markings are right.

    Parameters
    ----------
    windows_place : (n, 2) m, corrections in plan of the windows of patches at path parameters (n,); NaN for none.
    """
    chain, fit = found.chain, found.fit
    silent = silences(chain, fit) if chain.held is None else []
    if not silent:
        return found
    off = windows_place - chain.interpolate(fit.state, fit.covariance, at_patches)[0][:, :2]
    tests = step_tests(chain, model, fit, 1.0)
    known, steps = [chain.nodes[step.node] for step in found.two_sided], list(found.undecided)
    for begin, end in silent:
        offsets = off[(at_patches >= begin) & (at_patches <= end)]
        offsets = offsets[np.isfinite(offsets).all(axis=1)]
        if not len(offsets) or found.within_changed(np.array([0.5 * (begin + end)]))[0] or _near(known, begin, end):
            continue
        change = np.median(offsets, axis=0)
        around = [step for step in tests if step is not None and _near([chain.nodes[step.node]], begin, end)]
        if around and LIMITS.least < np.hypot(*change) < LIMITS.slipped:
            step = min(around, key=lambda item: _against(item, change))
            if _against(step, change) < LIMITS.excluded**2:
                steps.append(replace(step, change=change, square=LIMITS.proof**2))
    return replace(found, undecided=sorted(steps, key=lambda step: step.node))


def _against(step: NodeStep, change: np.ndarray) -> float:
    """Chi square of a step of the reference by a change (2,) m or its opposite, as both sides of a place see it."""
    known = np.linalg.inv(step.covariance)
    return min(float(off @ known @ off) for off in (step.change - change, step.change + change))


def _near(places: Sequence[float], begin: float, end: float) -> bool:
    """Whether one of the places lies on a stretch or beside it, m."""
    return any(begin - LIMITS.same <= place <= end + LIMITS.same for place in places)
