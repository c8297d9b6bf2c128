"""Where reference and survey disagree: sharp steps of the correction, and steps that hide where there are no markings.

Paint that was laid anew after the flight, or a frame of the reference that is off, moves the correction within a few
metres; a trajectory drifts, and after an outage is fixed anew over 20 to 60 m. A step is told by the disturbance of the
drift that it needs (de Jong and Penzer 1998) and proved by an adjustment that may jump there. Two steps that undo each
other enclose markings that changed; of one alone nobody can say which side of it is right.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ....geometry.tolerances import LEAST_DIVISOR
from ....wording import mark, say
from .chain import NodeChain
from .error_model import PoseErrorModel
from .patch_status import BRIDGED, DISTRUSTED, REGISTERED
from .robust_fit import Fit

CHANGED, DISAGREEMENT, HIDDEN = mark("changed markings"), mark("reference and survey disagree"), mark("hidden step")
UNDECIDED = mark("step of the drive or of the reference")
"""Kinds of steps: an edge of markings that changed, one whose right side is not known, one without markings about, and
one that may as well be the drive's own."""

MOST_SHARP = 3.0
"""Standard deviations of a step beyond which it is believed: of one that hides, by the model alone."""

_SUSPECT, _PROVEN = 2.2, 4.5  # standard deviations of a step that is looked at, and that is proven
_LEAST = 0.06  # m: smaller steps are within what markings and their reference are off by
_APART = 25.0  # m of path, within which suspects are one step
_FREE = (0.1, 1.0)  # m, by which the error may jump at a suspect, at least and at most
_BESIDE = 20.0  # m to either side, whose evidence must bear the step out
_BORNE_OUT = 0.9  # of the evidence that a smooth correction believes there
_SHARP = 0.85  # of all evidence there: a sharp step meets 0.9 to 1.0 of it, a re-fix over 20 m 0.3 to 0.5
_LIKELIER = 5.0  # log-likelihood by which jumps must beat the drift that may change fast over 20 m
_SILENT, _SILENCE = 0.5, 12.0  # weight of evidence that is hardly believed; m of path of it that a step may explain
_AROUND = 60.0  # m to either side of such a silence, whose evidence a step there must make likelier
_EVERY = 3  # nodes between the places where it is looked for first
_USUAL = 0.4  # m, standard deviation of such a step
_MOST_OFF = 1.0  # m that it has at most: markings that lie farther off slipped, by a dash or so
_LEAST_KNOWN = 0.25  # 1 / m2: a jump known to less than 2 m tells nothing, and rounding spoils it
_PLAN = (0, 2)  # places of the errors east and north among a state's values
_UNDONE = 0.4  # of the smaller of two steps, that their sum has at most where they undo each other


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
    """

    place: float
    time: float
    east: float
    north: float
    sigma: float
    kind: str
    span: tuple[float, float] | None = None

    @property
    def size(self) -> float:
        """m."""
        return float(np.hypot(self.east, self.north))

    @property
    def direction(self) -> float:
        """Degrees clockwise from grid north."""
        return float(np.degrees(np.arctan2(self.east, self.north)) % 360.0)


@dataclass(frozen=True)
class NodeStep:
    """A step between two nodes: number of the first, change (2,) m, covariance (2, 2), and chi square of none."""

    node: int
    change: np.ndarray
    covariance: np.ndarray
    square: float

    @property
    def size(self) -> float:
        """m."""
        return float(np.hypot(*self.change))

    @property
    def sigma(self) -> float:
        """m, along the step."""
        unit = self.change / max(self.size, LEAST_DIVISOR)
        return float(np.sqrt(unit @ self.covariance @ unit))


def step_tests(chain: NodeChain, model: PoseErrorModel, fit: Fit, least_noise: float) -> list[NodeStep | None]:
    """What a jump in plan between each node and the next would be; None where there is no evidence on a side."""
    pull, spread = chain.disturbances(model, fit.weight / max(fit.found_noise, least_noise))
    pull, spread = pull[:, _PLAN], spread[:, _PLAN][:, :, _PLAN]
    sizes = np.linalg.eigvalsh(spread)
    tests: list[NodeStep | None] = [None] * len(pull)
    for k in np.flatnonzero(sizes[:, 0] > np.maximum(1e-6 * sizes[:, -1], _LEAST_KNOWN)):
        covariance = np.linalg.inv(spread[k])
        change = covariance @ pull[k]
        tests[k] = NodeStep(int(k), change, covariance, float(change @ pull[k]))
    return tests


def suspects(tests: Sequence[NodeStep | None], nodes: np.ndarray) -> list[NodeStep]:
    """The likeliest of the steps within every `_APART` m that a model without steps does not expect."""
    likely = sorted((item for item in tests if item is not None and item.square > _SUSPECT**2
                     and item.size > _LEAST), key=lambda item: -item.square)
    chosen: list[NodeStep] = []
    for item in likely:
        if all(abs(nodes[item.node] - nodes[other.node]) > _APART for other in chosen):
            chosen.append(item)
    return sorted(chosen, key=lambda item: item.node)


def with_free_steps(chain: NodeChain, steps: Sequence[NodeStep]) -> NodeChain:
    """The chain that may jump at the steps, and there alone of all places around."""
    fast, places = chain.fast.copy(), 0.5 * (chain.nodes[1:] + chain.nodes[:-1])
    for step in steps:
        fast[np.abs(places - places[step.node]) <= _APART] = 0.0
    fast[[step.node for step in steps]] = [np.clip(step.size, *_FREE) for step in steps]
    return chain.with_fast(fast)


def proven(steps: Sequence[NodeStep], chain: NodeChain, fit: Fit, smooth: tuple[NodeChain, Fit],
           model: PoseErrorModel) -> list[NodeStep]:
    """Those steps that the adjustment which may jump (`chain`, `fit`) needs, and that its evidence bears out."""
    firm = chain.with_fast(np.where(np.isin(np.arange(len(chain.fast)), [step.node for step in steps]), 0.0,
                                    chain.fast))
    tests, found = step_tests(firm, model, fit, fit.noise_factor), []
    for step in steps:
        test = tests[step.node]
        if test is None or test.square < _PROVEN**2 or test.size < _LEAST:
            continue
        near = np.abs(chain.normals.path_parameter - chain.nodes[step.node]) <= _BESIDE
        near &= chain.normals.present
        believed = fit.weight[near].sum()
        if believed >= max(_BORNE_OUT * smooth[1].weight[near].sum(), _SHARP * np.count_nonzero(near)):
            found.append(test)
    return found


def undone(steps: Sequence[NodeStep], nodes: np.ndarray) -> list[tuple[NodeStep, NodeStep]]:
    """Pairs of steps that follow each other and undo each other, about less path than lies outside up to the next."""
    pairs, number = [], 0
    ends = [nodes[0], *(nodes[step.node] for step in steps), nodes[-1]]
    while number < len(steps) - 1:
        first, second = steps[number], steps[number + 1]
        rest = float(np.hypot(*(first.change + second.change)))
        least = min(first.size, second.size)
        allowed = max(_UNDONE * least, min(MOST_SHARP * np.hypot(first.sigma, second.sigma), least))
        outside = ends[number + 1] - ends[number] + ends[number + 3] - ends[number + 2]
        if rest < allowed and ends[number + 2] - ends[number + 1] <= outside:
            pairs.append((first, second))
            number += 1
        number += 1
    return pairs


def either_side(steps: Sequence[NodeStep], nodes: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mask (n,) of path parameters beside a step of which nobody knows the right side; variance (n, 2, 2) m2 to add.

    Any of the stretches between the steps, all alike, may be the right one: a place is off by all steps up to it.
    """
    if not steps:
        return np.zeros(len(at), bool), np.zeros((len(at), 2, 2))
    places = [0.5 * (nodes[step.node] + nodes[step.node + 1]) for step in steps]
    offset, spread = (np.cumsum([np.zeros_like(parts[0]), *parts], axis=0) for parts in (
        [step.change for step in steps], [_bounded(step) for step in steps]))
    off = offset[:, None] - offset[None]
    variance = (off[..., :, None] * off[..., None, :] + np.abs(spread[:, None] - spread[None])).mean(axis=1)
    return np.ones(len(at), bool), variance[np.searchsorted(places, at)]


def _bounded(step: NodeStep) -> np.ndarray:
    """(2, 2) m2, covariance of a step that is about as large as it seems, however little is known of it."""
    size = max(step.size, _LEAST)
    return np.linalg.inv(np.linalg.inv(step.covariance) + np.eye(2) / size**2)


def hidden_steps(chain: NodeChain, model: PoseErrorModel, fit: Fit,
                 longest: float) -> list[tuple[float, float, NodeStep]]:
    """Stretches of more than `longest` m without markings: begin, end, and the step across each.

    The drift alone is to explain it: where the windows let the error change fast in a stretch, no marking shows how.
    """
    seen = chain.normals.path_parameter[chain.normals.present]
    gaps = [(begin, end) for begin, end in zip(seen[:-1], seen[1:]) if end - begin > longest]
    if not gaps:
        return []
    fast = chain.fast.copy()
    for begin, end in gaps:
        fast[(chain.nodes[1:] > begin) & (chain.nodes[:-1] < end)] = 0.0
    tests = step_tests(chain.with_fast(fast) if (fast != chain.fast).any() else chain, model, fit, 1.0)
    found = []
    for begin, end in gaps:
        inside = [tests[k] for k in range(len(tests)) if begin < chain.nodes[k] < end and tests[k] is not None]
        if inside:
            found.append((float(begin), float(end), max(inside, key=lambda item: item.square)))
    return found


@dataclass(frozen=True)
class Disagreements:
    """What was found and how the correction goes on with it.

    Attributes
    ----------
    chain, fit : the adjustment that jumps at `steps` and does without the markings between `changed` ones.
    steps : of which nobody knows the right side.
    changed : first and last of each stretch of changed markings.
    hidden : begin and end (path parameters) of stretches without evidence, and the step across each.
    undecided : steps of which nobody knows whether the drive or the reference has them.
    """

    chain: NodeChain
    fit: Fit
    steps: list[NodeStep]
    changed: list[tuple[NodeStep, NodeStep]]
    hidden: list[tuple[float, float, NodeStep]]
    undecided: Sequence[NodeStep] = ()

    @property
    def two_sided(self) -> list[NodeStep]:
        """All steps of which one side may be wrong, along the path."""
        return sorted([*self.steps, *self.undecided], key=lambda step: step.node)

    @property
    def all_steps(self) -> list[NodeStep]:
        """Those of which one side may be wrong, and the edges of changed markings."""
        return [*self.two_sided, *(step for pair in self.changed for step in pair)]

    def hides(self, step: NodeStep) -> bool:
        """Whether a step is believed to hide where no markings are; walls there change from building to building."""
        return step.square > (MOST_SHARP if self.chain.held is None else _PROVEN) ** 2

    def within_changed(self, at: np.ndarray) -> np.ndarray:
        """Mask (n,) of path parameters on changed markings."""
        return _between(self.changed, self.chain.nodes, at)

    def listed(self, chainage_of: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]) -> tuple[CorrectionStep, ...]:
        """All steps along the path; `chainage_of` gives chainages and times at path parameters."""
        nodes = self.chain.nodes

        def middle(step: NodeStep) -> float:
            return float(0.5 * (nodes[step.node] + nodes[step.node + 1]))

        rows: list[tuple] = [(middle(step), step, kind, None) for kind, steps in ((DISAGREEMENT, self.steps),
                                                                     (UNDECIDED, self.undecided)) for step in steps]
        for first, second in self.changed:
            rows += [(middle(first), first, CHANGED, (middle(first), middle(second))),
                     (middle(second), second, CHANGED, None)]
        rows += [(0.5 * (begin + end), step, HIDDEN, (begin, end)) for begin, end, step in self.hidden
                 if self.hides(step)]
        rows.sort(key=lambda item: item[0])
        chainage, time = chainage_of(np.array([item[0] for item in rows]))
        spans = [None if span is None else tuple(chainage_of(np.array(span))[0].tolist()) for *_, span in rows]
        return tuple(CorrectionStep(float(way), float(at), *step.change.tolist(), step.sigma, kind, span)
                     for way, at, (_, step, kind, _), span in zip(chainage, time, rows, spans))


Adjust = Callable[[NodeChain, Fit, np.ndarray], tuple[NodeChain, Fit]]
"""Adjusts a chain from a fit on, with how far the evidence at the nodes (k,) may be believed."""

Likelihood = Callable[[NodeChain, np.ndarray, PoseErrorModel], float]
"""Log-likelihood of a model with such evidence of a chain."""


def settle(chain: NodeChain, fit: Fit, model: PoseErrorModel, allowed: np.ndarray, adjust: Adjust,
           likelihood: Likelihood, longest: float, likeliest: Sequence[NodeStep] = ()) -> Disagreements:
    """The adjustment with its sharp steps found, and what cannot be decided told.

    Parameters
    ----------
    allowed : (k,) 0 to 1, how far the evidence at each node may be believed.
    longest : m without evidence beyond which a step may hide.
    likeliest : the likeliest steps instead of fast changes that may be steps.
    """
    silencing = silencing_steps(chain, model, fit, allowed, likelihood)
    likely = suspects([*step_tests(chain, model, fit, 1.0), *likeliest, *silencing], chain.nodes)
    gaps = hidden_steps(chain, model, fit, longest)
    likely = [step for step in likely if not any(begin < chain.nodes[step.node] < end for begin, end, _ in gaps)]
    steps: list[NodeStep] = []
    changed: list[tuple[NodeStep, NodeStep]] = []
    if likely:
        free = with_free_steps(chain, likely)
        jumped = adjust(free, fit, allowed)
        steps = proven(likely, *jumped, (chain, fit), model)
        slips = [step.node for step in silencing]
        steps = [step for step in steps if step.size < _MOST_OFF or step.node not in slips]
        if steps and not _likelier(jumped[0].with_fast(chain.fast), steps, allowed, partial(likelihood, model=model)):
            steps = []
        changed = undone(steps, chain.nodes)
        paired = [step.node for pair in changed for step in pair]
        steps = [step for step in steps if step.node not in paired]
        if changed or len(steps) not in (0, len(likely)):
            clear = _without_fast(chain, changed)
            left = np.where(_between(changed, chain.nodes, chain.nodes), 0.0, allowed)
            jumped = adjust(with_free_steps(clear, steps) if steps else clear, fit, left)
        if steps or changed:
            chain, fit = jumped
    return Disagreements(chain, fit, steps, changed, hidden_steps(chain, model, fit, longest))


def silencing_steps(chain: NodeChain, model: PoseErrorModel, fit: Fit, allowed: np.ndarray,
                    likelihood: Likelihood) -> list[NodeStep]:
    """Steps that explain why evidence is hardly believed: with one of them it need not, on either side.

    Evidence that slipped, or that moved between two places, stays silent on one side or the other of any one step.
    """
    silent = silences(chain, fit)
    if not silent:
        return []
    tests = step_tests(chain, model, replace(fit, weight=chain.normals.present.astype(float)), 1.0)
    found = []
    for begin, end in silent:
        node = _likeliest_node(begin, end, chain, model, allowed, likelihood)
        step = None if node is None else tests[node]
        if step is not None:
            found.append(replace(step, square=max(step.square, _PROVEN**2)))
    return found


def silences(chain: NodeChain, fit: Fit) -> list[tuple[float, float]]:
    """Path parameters between which no evidence is much believed although there is some, for a while."""
    present = chain.normals.present
    place, silent = chain.normals.path_parameter[present], fit.weight[present] < _SILENT
    change = np.flatnonzero(np.diff(np.concatenate([[0], silent.astype(int), [0]])))
    runs = [(float(place[first]), float(place[end - 1])) for first, end in zip(change[::2], change[1::2])]
    return [(begin, end) for begin, end in runs if end - begin >= _SILENCE]


def _likeliest_node(begin: float, end: float, chain: NodeChain, model: PoseErrorModel, allowed: np.ndarray,
                    likelihood: Likelihood) -> int | None:
    """Number of the node about a silence at which a step makes all evidence around likeliest; None if none does."""
    nodes = chain.nodes
    first, last = np.searchsorted(nodes, [begin - _AROUND, end + _AROUND])
    first, last = int(first), min(int(last), len(nodes) - 1)
    near = np.flatnonzero((nodes[first:last] >= begin - _APART) & (nodes[first:last] <= end + _APART))
    part, model, believed = chain.between(first, last), model.between(first, last), allowed[first:last + 1]
    still, number = part.fast.copy(), np.arange(last - first)
    still[near] = 0.0
    smooth = likelihood(part.hardened(), believed, model)

    def gain(*steps: int) -> float:
        jumping = part.with_fast(np.where(np.isin(number, steps), _USUAL, still))
        return likelihood(jumping.hardened(), believed, model) - smooth

    gains = {int(node): gain(node) for node in near[::_EVERY]}
    best = max(gains, key=gains.__getitem__)
    gains.update({int(node): gain(node) for node in near if 0 < abs(node - best) < _EVERY})
    best = max(gains, key=gains.__getitem__)
    edges = np.clip([np.searchsorted(nodes, begin, "right") - 2, np.searchsorted(nodes, end)], first, last - 1) - first
    # where a change of the silent piece alone is about as likely, it keeps no weight, and takes none from its sides
    surely = gains[best] > max(gain(*edges), 0.0) + _LIKELIER
    return first + best if surely else None


def _likelier(drifting: NodeChain, steps: Sequence[NodeStep], allowed: np.ndarray,
              likelihood: Callable[[NodeChain, np.ndarray], float]) -> bool:
    """Whether the steps make the survey likelier than the drift alone, which may change fast here and there."""
    jumping = with_free_steps(drifting, steps).hardened()
    gain = likelihood(jumping, allowed) - likelihood(drifting.hardened(), allowed)
    return gain > _LIKELIER


def _between(pairs: Sequence[tuple[NodeStep, NodeStep]], nodes: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Mask (n,) of path parameters between the steps of a pair."""
    inside = np.zeros(len(at), bool)
    for first, second in pairs:
        inside |= (at > nodes[first.node]) & (at < nodes[second.node + 1])
    return inside


def _without_fast(chain: NodeChain, pairs: Sequence[tuple[NodeStep, NodeStep]]) -> NodeChain:
    """The chain without fast changes in and about stretches of changed markings."""
    fast, places = chain.fast.copy(), 0.5 * (chain.nodes[1:] + chain.nodes[:-1])
    for first, second in pairs:
        fast[(places > chain.nodes[first.node] - _APART) & (places < chain.nodes[second.node] + _APART)] = 0.0
    return chain.with_fast(fast)


def hidden_factor(hidden: Sequence[tuple[float, float, NodeStep]], at: np.ndarray) -> np.ndarray:
    """(n,) by which the variance at path parameters without evidence grows: as their ends contradict the drift."""
    factor = np.ones(len(at))
    for begin, end, step in hidden:
        factor[(at > begin) & (at < end)] = max(step.square / len(_PLAN), 1.0)
    return factor


def with_disagreements(status: np.ndarray, reason: np.ndarray, found: Disagreements, at: np.ndarray,
                       beside: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Statuses and reasons (n,) of patches: none is registered where reference and survey disagree.

    `beside` : (n,) mask of those beside a step of which nobody knows the right side.
    """
    status, reason = status.copy(), reason.copy()
    changed = found.within_changed(at)
    for mask, why in ((beside, say("reference and survey disagree: one side of a step may be wrong")),
                      (changed, say("the markings here changed: reference and survey disagree"))):
        status[mask & (status == REGISTERED)] = BRIDGED
        reason[mask] = why
    for begin, end, step in found.hidden:
        if found.hides(step):
            inside = (at > begin) & (at < end)
            status[inside], reason[inside] = DISTRUSTED, say("a step of the error hides here, where no markings are")
    return status, reason
