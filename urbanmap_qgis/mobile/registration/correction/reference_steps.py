"""Where the reference and the survey disagree, whose the steps are, and what that leaves unknown of every place.

A step of the reference shifts all markings behind it: of one alone nobody can say which side of it is right. Two that
undo each other enclose a stretch that was marked anew, or the only one that is right: the longer part is the likelier
one, as changes of a reference reach over some hundred metres, but the share of the path is no proof.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import expit, softmax

from ....estimation.chain import NodeChain
from ....estimation.error_model import PoseErrorModel
from ....estimation.latent_steps import (
    BLOCK,
    DRIVE,
    LIMITS,
    LatentStep,
    UnseenSteps,
    switched_on,
    unseen_steps,
)
from ....geometry.tolerances import LEAST_DIVISOR
from ....wording import mark, say
from .patch_status import BRIDGED, DISTRUSTED, REGISTERED, evidence_gaps
from .robust_fit import Fit
from .side_slip import SideSlip

CHANGED, DISAGREEMENT, HIDDEN = mark("changed markings"), mark("reference and survey disagree"), mark("hidden step")
UNDECIDED = mark("step of the drive or of the reference")
"""Kinds of steps: an edge of markings that changed, one whose right side is not known, one without markings about, and
one that may as well be the drive's own."""

SURE = 19.0 / 20.0
"""Probability from which one of two explanations is taken for the right one."""

_FREE = 0.1  # m, by which the error may jump at a step, at least
_BESIDE = 4.0  # m from a stretch without markings, within which a step may as well lie in it
_PIECE, _SHARED = 500, 100  # nodes of path that are looked at together, and those that two such pieces share


@dataclass(frozen=True)
class CorrectionStep:
    """A step of the correction.

    Attributes
    ----------
    place : m, chainage.
    time : s.
    east, north : m, by which the correction changes.
    sigma : m, of its size.
    kind : CHANGED, DISAGREEMENT, HIDDEN or UNDECIDED.
    span : m, chainages of the stretch that it is told of, which of changed markings the first edge has; None where
        there is no more than the place.
    probability : 0 to 1, that `kind` is right: of changed markings, that those within are wrong and not all others.
    """

    place: float
    time: float
    east: float
    north: float
    sigma: float
    kind: str
    span: tuple[float, float] | None = None
    probability: float = 1.0

    @property
    def size(self) -> float:
        """m."""
        return float(np.hypot(self.east, self.north))

    @property
    def direction(self) -> float:
        """Degrees clockwise from grid north."""
        return float(np.degrees(np.arctan2(self.east, self.north)) % 360.0)


@dataclass(frozen=True)
class PlacedStep:
    """A latent step of the whole path.

    Attributes
    ----------
    begin, end : m, path parameters where it lies, or a pair begins and ends; alike of a single one.
    kind, change, covariance, by_reference : see `LatentStep`.
    loose : (k - 1,) m2, by which the error may change in each step between the nodes, which lie at `places` m.
    """

    begin: float
    end: float
    kind: int
    change: np.ndarray
    covariance: np.ndarray
    by_reference: float
    loose: np.ndarray
    places: np.ndarray

    @property
    def sigma(self) -> float:
        """m, along the step."""
        unit = self.change / max(float(np.hypot(*self.change)), LEAST_DIVISOR)
        return float(np.sqrt(unit @ self.covariance @ unit))


def loose_changes(steps: Sequence[PlacedStep], count: int) -> np.ndarray:
    """(count,) m, by which the error may change in the steps between nodes, with steps along the path."""
    return np.sqrt(sum((step.loose for step in steps), np.zeros(count)))


def path_steps(chain: NodeChain, model: PoseErrorModel, weight: np.ndarray,
               axes: tuple[int, ...] = (0, 1),
               known: Sequence[PlacedStep] = ()) -> tuple[list[PlacedStep], UnseenSteps]:
    """The steps that a chain's evidence shows, weighted by `weight` (n,), and those of the reference that stay off.

    `known` ones are estimated with them, whatever this evidence alone says of them; but not those at the edge of a
    stretch without evidence, over which the windows bend.
    """
    gaps = evidence_gaps(chain.normals)
    known = [step for step in known if all(max(begin - step.end, step.begin - end) > LIMITS.place
                                           for begin, end in gaps)]
    count, found, unseen = len(chain.nodes) - 1, [], []
    for first in range(0, max(count - _SHARED, 1), _PIECE - _SHARED):
        last = min(first + _PIECE, count)
        part = (chain.node >= first) & (chain.node <= last)
        equations = chain.between(first, last).step_equations(model.between(first, last), weight[part], axes)
        low, high = first + 0.5 * _SHARED * (first > 0), last - 0.5 * _SHARED * (last < count)
        for step in found:  # what a pair that began before ends here is known
            if step.kind == BLOCK and equations.place[0] <= step.end <= equations.place[-1]:
                equations = equations.given(np.eye(last - first)[np.abs(equations.place - step.end).argmin()],
                                            max(LIMITS.reference))
        steps = switched_on(equations, [_latent(step, equations.place) for step in known
                                        if equations.place[0] <= step.begin and step.end <= equations.place[-1]])
        found += [_placed(step, equations.place, first, chain) for step in steps
                  if low <= first + step.first < high or count <= _PIECE]
        some = np.arange(int(low) - first, int(np.ceil(high)) - first)
        unseen.append(unseen_steps(equations, steps).select(some))
    return found, UnseenSteps.joined(unseen)


def _latent(step: PlacedStep, place: np.ndarray) -> LatentStep:
    """A step of the whole path on a piece of it, with the steps between its nodes at places (e,)."""
    begin, end = (int(np.abs(place - at).argmin()) for at in (step.begin, step.end))
    each, spread = np.eye(len(place)), np.interp(place, step.places, step.loose, 0.0, 0.0)
    profile = each[begin] - each[end] if step.kind == BLOCK else spread / max(spread.sum(), LEAST_DIVISOR)
    return LatentStep(step.kind, begin, end, profile, step.change, step.covariance, step.by_reference)


def _placed(step: LatentStep, place: np.ndarray, first: int, chain: NodeChain) -> PlacedStep:
    """A step of a piece of the path; one in a stretch without evidence may lie anywhere in it."""
    loose = np.zeros(len(chain.nodes) - 1)
    loose[first:first + len(place)] = np.abs(step.profile) * max(step.size, _FREE) ** 2
    begin, end = float(place[step.first]), float(place[step.last])
    for gap in evidence_gaps(chain.normals):
        if step.kind != BLOCK and gap[0] - _BESIDE < begin < gap[1] + _BESIDE:
            inside = np.clip(np.minimum(chain.nodes[1:], gap[1]) - np.maximum(chain.nodes[:-1], gap[0]), 0.0, None)
            begin = end = 0.5 * (gap[0] + gap[1])
            loose = inside / inside.sum() * max(step.size, _FREE) ** 2
    return PlacedStep(begin, end, step.kind, step.change, step.covariance, step.by_reference, loose,
                      0.5 * (chain.nodes[1:] + chain.nodes[:-1]))


@dataclass(frozen=True)
class Adjusted:
    """The adjustment so far: a chain that follows the markings over all steps, its fit, the steps and unseen ones."""

    chain: NodeChain
    fit: Fit
    steps: Sequence[PlacedStep]
    unseen: UnseenSteps

    @property
    def blocks(self) -> list[PlacedStep]:
        """Stretches that were marked anew."""
        return [step for step in self.steps if step.kind == BLOCK]

    @property
    def two_sided(self) -> list[PlacedStep]:
        """Single steps that may be the reference's, so that either side may be wrong."""
        return [step for step in self.steps if step.kind != BLOCK and step.by_reference > 1.0 - SURE]

    def judged(self, slip: SideSlip) -> Adjusted:
        """The same after what the trajectory's slip says of whose the single steps are."""
        half, steps = 0.5 * max(LIMITS.spread[0], LIMITS.place), []
        for step in self.steps:
            ends = [(begin, end) for begin, end, hides in self.hidden() if hides is step]
            begin, end = ends[0] if ends else (step.begin - half, step.end + half)
            steps.append(step if step.kind == BLOCK else replace(step, by_reference=slip.share_of_reference(
                step.by_reference, begin, end, step.change, step.covariance)))
        return replace(self, steps=steps)

    def of_drives(self) -> Adjusted:
        """The same where no step can be the reference's."""
        steps = [replace(step, kind=DRIVE, by_reference=0.0) for step in self.steps]
        none = replace(self.unseen, chance=0.0 * self.unseen.chance, block=0.0 * self.unseen.block)
        return replace(self, steps=steps, unseen=none)

    def hidden(self) -> list[tuple[float, float, PlacedStep]]:
        """Stretches without evidence with the steps that lie somewhere in them; walls there would show where."""
        if self.chain.held is not None:
            return []
        return [(begin, end, step) for begin, end in evidence_gaps(self.chain.normals)
                for step in self.steps if step.kind != BLOCK and begin < step.begin < end]

    def changes(self, at: np.ndarray) -> np.ndarray:
        """(n, 2) m, by which markings at path parameters (n,) lie elsewhere as they were painted anew."""
        return sum((_inside(step, at)[:, None] * step.change for step in self.blocks), np.zeros((len(at), 2)))

    def variance(self, at: np.ndarray) -> np.ndarray:
        """(n, 2, 2) m2, what is unknown of places as nobody knows whose the steps are, and which side is right."""
        added = _either_side(self.two_sided, self.chain.nodes, at)
        for step in self.blocks:
            added += self.outside_wrong(step) * np.outer(step.change, step.change)
            added += _inside(step, at)[:, None, None] * step.covariance
        return added

    def outside_wrong(self, step: PlacedStep) -> float:
        """Probability that a stretch is the only one that is right: the longer part the less likely.

        No reference is off by so much as matching may slip.
        """
        if np.hypot(*step.change) > LIMITS.farthest * max(LIMITS.reference):
            return 0.0
        length = self.chain.nodes[-1] - self.chain.nodes[0]
        return float(expit((2.0 * (step.end - step.begin) - length) / LIMITS.between))

    def statuses(self, status: np.ndarray, reason: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Statuses and reasons (n,) of patches: none is registered where reference and survey disagree."""
        status, reason = status.copy(), reason.copy()
        every = np.ones(len(at), bool)
        if self.two_sided:
            _bridge(status, reason, every, say("reference and survey disagree: one side of a step may be wrong"))
        for step in self.blocks:
            if self.outside_wrong(step) > 1.0 - SURE:
                _bridge(status, reason, every, say("reference and survey disagree: a stretch of the markings changed, "
                                                   "or all others did"))
            _bridge(status, reason, _inside(step, at), say("the markings here changed: reference and survey disagree"))
        for begin, end, _ in self.hidden():
            inside = (at > begin) & (at < end)
            status[inside], reason[inside] = DISTRUSTED, say("a step of the error hides here, where no markings are")
        return status, reason

    def listed(self, chainage_of: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]) -> tuple[CorrectionStep, ...]:
        """All steps along the path; `chainage_of` gives chainages and times at path parameters."""
        rows: list[tuple] = []
        for step in self.two_sided:
            sure = step.by_reference >= SURE
            rows.append((step.begin, step, DISAGREEMENT if sure else UNDECIDED, None, step.by_reference))
        for step in self.blocks:
            right = 1.0 - self.outside_wrong(step)
            rows.append((step.begin, step, CHANGED, (step.begin, step.end), right))
            rows.append((step.end, replace(step, change=-step.change), CHANGED, None, right))
        rows += [(0.5 * (begin + end), step, HIDDEN, (begin, end), 1.0) for begin, end, step in self.hidden()]
        rows.sort(key=lambda item: item[0])
        chainage, time = chainage_of(np.array([item[0] for item in rows]))
        spans = [None if item[3] is None else tuple(chainage_of(np.array(item[3]))[0].tolist()) for item in rows]
        return tuple(CorrectionStep(float(way), float(at), *step.change.tolist(), step.sigma, kind, span, probability)
                     for way, at, (_, step, kind, _, probability), span in zip(chainage, time, rows, spans))


def _inside(step: PlacedStep, at: np.ndarray) -> np.ndarray:
    """Mask (n,) of path parameters between the steps of a pair."""
    return (at > step.begin) & (at < step.end)


def _bridge(status: np.ndarray, reason: np.ndarray, mask: np.ndarray, why: str) -> None:
    """Patches of a mask (n,) are bridged, if they were registered, for a reason."""
    status[mask & (status == REGISTERED)] = BRIDGED
    reason[mask] = why


def _either_side(steps: list[PlacedStep], nodes: np.ndarray, at: np.ndarray) -> np.ndarray:
    """(n, 2, 2) m2 at path parameters (n,): any of the stretches between the steps may be the right one.

    The longer one is the likelier, see `Adjusted.outside_wrong`. A place is off by all steps up to it, each of which is
    the reference's with its probability.
    """
    if not steps:
        return np.zeros((len(at), 2, 2))
    share = np.array([step.by_reference for step in steps])
    change = np.array([step.change for step in steps])
    single = np.array([step.covariance for step in steps]) + change[:, :, None] * change[:, None, :]
    stretch = np.arange(len(steps) + 1)
    low, high = np.minimum(stretch[:, None], stretch), np.maximum(stretch[:, None], stretch)
    numbers = np.arange(len(steps))
    between = ((numbers >= low[..., None]) & (numbers < high[..., None])) * share  # (r, r, steps)
    mean = between @ change
    spread = np.einsum("rsj,jab->rsab", between, single) - np.einsum("rsj,ja,jb->rsab", between**2, change, change)
    right = softmax(np.diff([nodes[0], *(step.begin for step in steps), nodes[-1]]) / LIMITS.between)
    variance = np.einsum("rsab,s->rab", spread + mean[..., :, None] * mean[..., None, :], right)
    return variance[np.searchsorted([step.begin for step in steps], at)]


