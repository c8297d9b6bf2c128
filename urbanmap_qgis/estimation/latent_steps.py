"""Steps of a drive or of its reference as switched latent variables of one chain.

Evidence places the sum of a drive's error, which drifts, and of what its reference is off by, which stays but for steps
at a few places. A hypothesis is a profile of a change along the path: one sharp step, of a frame of the reference; one
spread over tens of metres, of a trajectory that is fixed anew; or a pair that undoes itself, of a stretch that was
marked anew. With the drive integrated out, the likelihood of all their sizes is one quadratic form, and that of each
hypothesis has a closed form (spike and slab: Mitchell and Beauchamp 1988). They are switched on one after the other
while one is likelier than none; what stays off goes into the covariance with its probability.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import logsumexp

from ..geometry.tolerances import LEAST_DIVISOR

REFERENCE, DRIVE, BLOCK = range(3)
"""Whose a change is: a step of the reference, one of the drive, a pair of the reference that undoes itself."""


@dataclass(frozen=True)
class LatentStepsLimits:
    """Limits of latent steps, each with its unit."""

    between: float = 500.0  # m of path between two steps of a reference, and between two new fixes of a drive
    block: float = 200.0  # m, mean length of a stretch that was marked anew
    shortest: float = 8.0  # m of path with evidence in such a stretch, and to either side of a reference's step
    # m, standard deviations of the sizes of a reference's changes and of a drive's, alike as likely
    reference: tuple[float, ...] = (0.1, 0.3, 1.0)
    stretch: tuple[float, ...] = (0.1, 0.3, 1.0, 5.0)  # of one that is elsewhere alone: matching slips by a dash, too
    drive: tuple[float, ...] = (0.5, 3.0)
    spread: tuple[float, ...] = (20.0, 60.0)  # m of path in which a drive is fixed anew
    farthest: float = 1.5  # times the largest of these, that a change has at most
    place: float = 25.0  # m about a step within which another is the same
    proof: float = 2.0  # standard deviations that a change has at least, once all are estimated together
    unseen: float = 0.2  # m, standard deviation of a step that stays off
    most: int = 12  # steps that are switched on at most


LIMITS = LatentStepsLimits()


@dataclass(frozen=True)
class StepEquations:
    """Log-likelihood b s - s' Q s / 2 of steps s (e, 2) m between e + 1 nodes, all else integrated out.

    Attributes
    ----------
    place : (e,) m, middles between the nodes.
    gap : (e,) m between them.
    gradient : (e, 2) b.
    information : (e, e, 2, 2) Q.
    seen : (e,) m of path with evidence before each place.
    beyond : (e,) m of it behind.
    """

    place: np.ndarray
    gap: np.ndarray
    seen: np.ndarray
    beyond: np.ndarray
    gradient: np.ndarray
    information: np.ndarray

    @property
    def own(self) -> np.ndarray:
        """(e, 2, 2) blocks of Q of each step alone."""
        each = np.arange(len(self.place))
        return self.information[each, each]

    def given(self, profile: np.ndarray, sigma: float) -> StepEquations:
        """The same with a step of a profile (e,) and standard deviation `sigma` m integrated out, too."""
        pull = profile @ self.gradient
        cross = np.einsum("e,efij->fij", profile, self.information)
        own = np.linalg.inv(np.einsum("f,fij->ij", profile, cross) + np.eye(2) / sigma**2)
        left = np.einsum("fji,jk->fik", cross, own)
        return replace(self, gradient=self.gradient - left @ pull,
                       information=self.information - np.einsum("eij,fjk->efik", left, cross))

    def sharp_or_spread(self, farthest: float = np.inf) -> list[tuple[int, np.ndarray, np.ndarray]]:
        """Kind, profiles (e, e) and log-odds over none (e,) of one change at each place, of every length.

        `farthest` : see `log_odds`.
        """
        prior = np.log(self.gap / LIMITS.between)
        sharp = log_odds(self.gradient, self.own, LIMITS.reference, farthest)
        found = [(REFERENCE, np.eye(len(self.place)), np.where(self.between_evidence(), prior + sharp, -np.inf))]
        for length in LIMITS.spread:
            share = (np.abs(self.place[:, None] - self.place) <= 0.5 * length) * self.gap
            share /= share.sum(axis=1, keepdims=True)
            own = np.einsum("ef,efij->eij", share, np.tensordot(share, self.information, axes=(1, 0)))
            found.append((DRIVE, share, prior - np.log(len(LIMITS.spread))
                          + log_odds(share @ self.gradient, own, LIMITS.drive, farthest)))
        return found

    def between_evidence(self) -> np.ndarray:
        """(e,) mask of places with evidence on both sides."""
        return np.minimum(self.seen, self.beyond) >= LIMITS.shortest

    def pairs(self) -> tuple[np.ndarray, np.ndarray]:
        """b (e, e, 2) and Q (e, e, 2, 2) of steps at one place that another one undoes."""
        own = self.own
        return (self.gradient[:, None] - self.gradient[None],
                own[:, None] + own[None] - self.information - np.swapaxes(self.information, 0, 1))

    def pair_odds(self, sigmas: Sequence[float]) -> np.ndarray:
        """(e, e) log-odds of a stretch marked anew between two places by some standard deviations, m.

        Minus infinity where there can be none.
        """
        place, prior = self.place, np.log(self.gap)
        length = place[None] - place[:, None]
        odds = log_odds(*self.pairs(), sigmas, LIMITS.farthest) - length / LIMITS.block
        odds += (prior - np.log(LIMITS.between))[:, None] + (prior - np.log(LIMITS.block))[None]
        ends, inside = self.between_evidence(), self.seen[None] - self.seen[:, None]
        return np.where((inside >= LIMITS.shortest) & ends & ends[:, None], odds, -np.inf)

    def near(self, number: int) -> np.ndarray:
        """(e,) mask of the places at which a step counts as the same."""
        return np.abs(self.place - self.place[number]) <= LIMITS.place


def log_odds(gradient: np.ndarray, information: np.ndarray, sigmas: Sequence[float],
             farthest: float) -> np.ndarray:
    """(...,) log-likelihood of a change with one of some standard deviations, m, over none, of b and Q of it.

    Minus infinity where it would be more than `farthest` times as large as the largest of them: evidence so far off has
    slipped, or is no paint.
    """
    each = []
    for sigma in sigmas:
        (a, b), (_, c) = np.moveaxis(information + np.eye(2) / sigma**2, (-2, -1), (0, 1))
        east, north = np.moveaxis(gradient, -1, 0)
        determinant = a * c - b * b
        change = np.stack([c * east - b * north, a * north - b * east]) / determinant
        each.append(0.5 * (change[0] * east + change[1] * north) - 0.5 * np.log(determinant * sigma**4))
    far = np.hypot(*change) > farthest * sigma
    return np.where(far, -np.inf, logsumexp(each, axis=0) - np.log(len(sigmas)))


def posterior_moments(gradient: np.ndarray, information: np.ndarray, sigma: float) -> tuple[np.ndarray, np.ndarray]:
    """Mean (..., 2) and covariance (..., 2, 2) of a change, of b and Q of it and its standard deviation before."""
    covariance = np.linalg.inv(information + np.eye(2) / sigma**2)
    return np.einsum("...ij,...j->...i", covariance, gradient), covariance


@dataclass(frozen=True)
class LatentStep:
    """A change that is switched on.

    Attributes
    ----------
    kind : REFERENCE, DRIVE or BLOCK, the likeliest.
    first, last : numbers of the steps between nodes at which it lies, or a pair begins and ends.
    profile : (e,) share of the change in each step.
    change, covariance : (2,) m, (2, 2) m2; of a pair's first step.
    by_reference : 0 to 1, that it is the reference's and not the drive's.
    """

    kind: int
    first: int
    last: int
    profile: np.ndarray
    change: np.ndarray
    covariance: np.ndarray
    by_reference: float = 1.0

    @property
    def prior_sigma(self) -> float:
        """m, before any evidence."""
        return max((LIMITS.reference, LIMITS.drive, LIMITS.stretch)[self.kind])

    @property
    def size(self) -> float:
        """m."""
        return float(np.hypot(*self.change))


def likeliest(equations: StepEquations) -> LatentStep | None:
    """The change that is likelier than none by most, wherever about its place it lies; None if none is."""
    paired, none = equations.pair_odds(LIMITS.stretch), np.zeros(2)
    best = [(-np.inf, LatentStep(REFERENCE, 0, 0, np.zeros(0), none, np.eye(2)))]
    for kind, profiles, odds in equations.sharp_or_spread(LIMITS.farthest):
        at = int(odds.argmax())
        best.append((float(logsumexp(odds[equations.near(at)])),
                     LatentStep(kind, at, at, profiles[at], none, np.eye(2))))
    if np.isfinite(paired).any():
        first, last = (int(number) for number in np.unravel_index(int(paired.argmax()), paired.shape))
        profile = np.eye(len(paired))[first] - np.eye(len(paired))[last]
        best.append((float(logsumexp(paired[np.ix_(equations.near(first), equations.near(last))])),
                     LatentStep(BLOCK, first, last, profile, none, np.eye(2))))
    odds, step = max(best, key=lambda item: item[0])
    return step if odds > 0.0 else None


def switched_on(equations: StepEquations, known: Sequence[LatentStep] = ()) -> list[LatentStep]:
    """The changes that make the evidence likelier one after the other beside `known` ones, with their sizes."""
    steps, left = list(known), equations
    for step in known:
        left = left.given(step.profile, step.prior_sigma)
    while len(steps) < LIMITS.most:
        step = likeliest(left)
        if step is None:
            break
        steps.append(step)
        left = left.given(step.profile, step.prior_sigma)
    found = estimated(equations, steps)
    proven = [step for step in found if step.change @ np.linalg.solve(step.covariance, step.change) > LIMITS.proof**2]
    found = found if len(proven) == len(found) else estimated(equations, proven)
    return merged(sorted(found, key=lambda step: step.first), equations)


def merged(steps: Sequence[LatentStep], equations: StepEquations) -> list[LatentStep]:
    """The changes (k,) along the path, those of one kind at one place as one: a step may lie between two nodes."""
    found: list[LatentStep] = []
    for step in steps:
        same = [number for number, other in enumerate(found) if other.kind == step.kind
                and equations.near(other.first)[step.first] and equations.near(other.last)[step.last]]
        if same:
            found[same[0]] = replace(found[same[0]], change=found[same[0]].change + step.change)
        else:
            found.append(step)
    return found


def estimated(equations: StepEquations, steps: Sequence[LatentStep]) -> list[LatentStep]:
    """The changes with their sizes, all estimated together, and whose each of them is by its shape."""
    found = []
    for number, step in enumerate(steps):
        left = equations
        for other in (*steps[:number], *steps[number + 1:]):
            left = left.given(other.profile, other.prior_sigma)
        own = np.einsum("e,efij,f->ij", step.profile, left.information, step.profile)
        change, covariance = posterior_moments(step.profile @ left.gradient, own, step.prior_sigma)
        odds = np.full(2, -np.inf)
        if step.kind != BLOCK:
            for kind, _, each in left.sharp_or_spread():
                odds[kind] = np.logaddexp(odds[kind], logsumexp(each[left.near(step.first)]))
        by_reference = 1.0 if step.kind == BLOCK else float(np.exp(odds[REFERENCE] - np.logaddexp(*odds)))
        found.append(replace(step, change=change, covariance=covariance, by_reference=by_reference))
    return found


@dataclass(frozen=True)
class UnseenSteps:
    """What steps of the reference that stay off would do, by their probability.

    Attributes
    ----------
    place : (e,) m.
    chance : (e,) how many times as likely a single one is there as none.
    expected : (e, 2, 2) m2, what it would add to a place beside it: either side is the right one.
    block : (e, 2, 2) m2, what stretches marked anew about each place add.
    median, largest : m, the size from which a single one is noticed, along the path; NaN where none would be.
    """

    place: np.ndarray
    chance: np.ndarray
    expected: np.ndarray
    block: np.ndarray
    median: float = np.nan
    largest: float = np.nan

    def variance(self, at: np.ndarray) -> np.ndarray:
        """(n, 2, 2) m2, that they add in plan at path parameters (n,): beyond the next changes of the reference
        another frame holds the place."""
        if not len(self.place):
            return np.zeros((len(at), 2, 2))
        ends = [np.searchsorted(self.place, at + reach) for reach in (-LIMITS.between, LIMITS.between)]
        chance, expected = (np.concatenate([np.zeros((1, *one.shape[1:])), np.cumsum(one, axis=0)]) for one in
                            (self.chance, self.chance[:, None, None] * self.expected))
        near = [one[ends[1]] - one[ends[0]] for one in (chance, expected)]
        inside = np.clip(np.searchsorted(self.place, at), 0, len(self.place) - 1)
        return near[1] / (1.0 + near[0])[:, None, None] + self.block[inside]

    def select(self, which: np.ndarray) -> UnseenSteps:
        """Some of the places."""
        return replace(self, place=self.place[which], chance=self.chance[which], expected=self.expected[which],
                       block=self.block[which])

    @classmethod
    def joined(cls, parts: Sequence[UnseenSteps]) -> UnseenSteps:
        """Of stretches that follow each other."""
        columns = [np.concatenate([getattr(part, name) for part in parts])
                   for name in ("place", "chance", "expected", "block")]
        return cls(*columns, float(np.nanmedian([part.median for part in parts])),
                   float(np.nanmax([part.largest for part in parts])))

    def followed(self, response: np.ndarray, at: np.ndarray) -> np.ndarray:
        """(n, 2, 2) m2, that they add at path parameters (n,), which follow the markings by `response` (n, 2, 2)."""
        return np.einsum("nij,njk,nlk->nil", response, self.variance(at), response)


def unseen_steps(equations: StepEquations, steps: Sequence[LatentStep]) -> UnseenSteps:
    """The steps of the reference that stay off beside those that are switched on."""
    for step in steps:
        equations = equations.given(step.profile, step.prior_sigma)
    single = log_odds(equations.gradient, equations.own, (LIMITS.unseen,), np.inf)
    single = np.where(equations.between_evidence(), single + np.log(equations.gap / LIMITS.between), -np.inf)
    paired = equations.pair_odds((LIMITS.unseen,))
    of_pairs = np.exp(np.minimum(paired, 0.0))
    of_pairs /= 1.0 + of_pairs.sum()
    change, covariance = posterior_moments(equations.gradient, equations.own, LIMITS.unseen)
    expected = 0.5 * (covariance + change[:, :, None] * change[:, None, :])
    change, covariance = posterior_moments(*equations.pairs(), LIMITS.unseen)
    block = of_pairs[..., None, None] * (covariance + change[..., :, None] * change[..., None, :])
    begun = np.cumsum(np.cumsum(block[:, ::-1], axis=1)[:, ::-1], axis=0)  # begins at or before, ends at or after
    each = np.arange(len(single))
    needed = 0.5 * np.log(np.linalg.det(np.eye(2) + LIMITS.unseen**2 * equations.own)) - np.log(
        equations.gap / LIMITS.between)
    noticed = np.sqrt(2.0 * needed / np.maximum(np.linalg.eigvalsh(equations.own)[:, 0], LEAST_DIVISOR))
    sizes = noticed[np.isfinite(single)] if np.isfinite(single).any() else np.full(1, np.nan)
    return UnseenSteps(equations.place, np.exp(np.minimum(single, 0.0)), expected, begun[each, each],
                       float(np.median(sizes)), float(sizes.max()))
