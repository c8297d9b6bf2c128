"""The adjustment in which evidence that contradicts the rest loses its weight, and the sizes that make it likeliest.

First by what the windows say, then by the points themselves, linearised about the curve found so far.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ....estimation.chain import NodeChain, NodeCurve
from ....estimation.error_model import PoseErrorModel
from ....estimation.normal_equations import NormalEquations
from ....geometry.tolerances import LEAST_DIVISOR
from ....progress import SILENT, Progress
from .settings import CorrectionSettings


@dataclass(frozen=True)
class RobustFitLimits:
    """Limits of robust fit, each with its unit."""

    passes: int = 6
    factors: tuple[float, ...] = (1.0, 2.0, 4.0, 8.0)
    factor_spread: float = 1.0  # how far from the expected drift, in powers of two, a survey's usually lies
    heading_factors: tuple[float, ...] = (5.0, 25.0)  # times the stated error of the heading that are tried
    # log-likelihood by which they must be better: 6 to 13 where paint was moved, 200 by 2 degrees
    heading_proof: float = 50.0
    most_own: float = 0.9  # of the information on its place that a block can have from itself
    weight_tolerance: float = 0.02
    region: int = 5  # pieces to either side that are a piece's region
    min_usual: float = 0.1  # reduced chi square of single pieces below which none is held against them
    min_noise: float = 0.3  # of the stated variance of the evidence, whatever the survey says
    min_blocks: int = 5  # from which the variance of the evidence can be told
    searched: tuple[int, ...] = (1,)  # rounds on the points in which the size of the drift is looked for again
    converged: float = 0.002  # m


LIMITS = RobustFitLimits()

Evaluate = Callable[[Callable[[np.ndarray], np.ndarray], float], NormalEquations]
"""Normal equations about a correction curve (corrections (m, 6) at path parameters (m,)), the reference blurred by so
many metres."""


@dataclass(frozen=True)
class Fit:
    """State of the adjustment: nodes' states (k, d, 2) and covariances, weights of the evidence, factors found.

    `noise_factor` is the one that the adjustment used, `found_noise` what the blocks' contradictions say.
    """

    state: np.ndarray
    covariance: np.ndarray
    weight: np.ndarray
    drift_factor: float
    noise_factor: float
    found_noise: float = 1.0
    heading_factor: float = 1.0


def robust_fit(chain: NodeChain, model: PoseErrorModel, allowed: np.ndarray, settings: CorrectionSettings,
                progress: Progress) -> Fit:
    """The adjustment with the size of drift that makes the survey likeliest, its gross blocks counted against it."""
    tried = []
    for number, factor in enumerate(LIMITS.factors):
        progress.step(number / len(LIMITS.factors))
        fit, likelihood = reweighted_fit(chain, model.scaled(factor), allowed, settings)
        tried.append((likelihood - 0.5 * (np.log2(factor) / LIMITS.factor_spread) ** 2, factor, fit))
    likelihood, factor, fit = max(tried, key=lambda entry: entry[0])
    return _with_likely_heading(chain, model, allowed, settings, likelihood, replace(fit, drift_factor=factor))


def _with_likely_heading(chain: NodeChain, model: PoseErrorModel, allowed: np.ndarray, settings: CorrectionSettings,
                         likelihood: float, fit: Fit) -> Fit:
    """The adjustment with a larger error of the heading, where this makes the survey much likelier.

    A misaligned unit explains evidence that a good one cannot; what leaves more of it unbelieved explains nothing.
    """
    best, present = likelihood, chain.normals.present
    for factor in LIMITS.heading_factors:
        other, reached = reweighted_fit(chain, model.scaled(fit.drift_factor).with_heading(factor), allowed, settings)
        reached -= 0.5 * (np.log2(fit.drift_factor) / LIMITS.factor_spread) ** 2 + LIMITS.heading_proof
        believed, before = (item.weight[present].mean() for item in (other, fit))
        if reached > best and believed > before - LIMITS.weight_tolerance:
            best, fit = reached, replace(other, drift_factor=fit.drift_factor, heading_factor=factor)
    return fit


def reweighted_fit(chain: NodeChain, model: PoseErrorModel, allowed: np.ndarray,
                    settings: CorrectionSettings) -> tuple[Fit, float]:
    """Adjustment in which blocks that contradict the rest lose their weight, and the log-likelihood of the model."""
    normals = chain.normals
    block = ((normals.path_parameter - normals.path_parameter[0]) / settings.block_length).astype(int)
    single, share, noise, found = allowed.copy(), np.ones(block.max() + 1), 1.0, 1.0
    weight = single
    for _ in range(LIMITS.passes):
        scaled = weight / noise
        state, spread, likelihood = chain.solve(model, scaled)
        value, covariance = chain.interpolate(state, spread, normals.path_parameter)
        test = _block_tests(normals, value, covariance, block, single, share, noise)
        single = _single_weights(normals.misfit(value), allowed, settings)
        share, found = _block_shares(test, noise, settings)
        noise_found = max(found, LIMITS.min_noise)
        last, weight = weight, single * share[block]
        steady = abs(noise_found / noise - 1.0) < LIMITS.weight_tolerance
        if steady and np.abs(weight - last).max() < LIMITS.weight_tolerance:
            break
        noise = noise_found
    likelihood -= chain.unconstrained_likelihood(scaled, allowed)
    return Fit(state, spread, weight, 1.0, noise, found), likelihood


def _single_weights(misfit: np.ndarray, allowed: np.ndarray, settings: CorrectionSettings) -> np.ndarray:
    """Weights (n,) of single pieces: those with a much larger misfit than the survey's usual one lose theirs.

    They lie on markings that are not the reference's: painted anew beside the old ones, or something else that shines.
    """
    counted = (allowed > 0) & (misfit > 0)
    if not counted.any():
        return allowed
    usual = max(float(np.median(misfit[counted])), LIMITS.min_usual)
    running = np.concatenate([np.zeros((1, 2)), np.cumsum(np.column_stack([misfit * counted, counted]), axis=0)])
    number = np.arange(len(misfit))
    total = running[np.minimum(number + LIMITS.region + 1, len(misfit))]
    total = total - running[np.maximum(number - LIMITS.region, 0)]
    around = total[:, 0] / np.maximum(total[:, 1], 1.0)
    regional = np.maximum(around / (settings.region * usual), 1.0)
    return allowed / (1.0 + misfit / (settings.single**2 * usual)) / regional


def _block_tests(normals: NormalEquations, value: np.ndarray, covariance: np.ndarray, block: np.ndarray,
                 single: np.ndarray, share: np.ndarray, noise: float) -> np.ndarray:
    """For each block (b,): how far its own observations in plan lie from what all others say, as a reduced chi square.

    `single` (n,) and `share` (b,) are the weights of pieces and blocks with which the values were found; NaN is given
    for a block without observations.
    """
    plan, count = normals.in_plan(), len(share)
    lean, information = np.zeros((count, len(plan))), np.zeros((count, len(plan), len(plan)))
    np.add.at(lean, block, normals.gradient_at(value)[:, plan] * (single / noise)[:, None])
    np.add.at(information, block, normals.information[:, plan][:, :, plan] * (single / noise)[:, None, None])
    covariance = covariance[:, plan][:, :, plan]
    ends = np.searchsorted(block, np.arange(count + 1))
    middle = np.minimum((ends[:-1] + ends[1:]) // 2, len(block) - 1)
    test = np.full(count, np.nan)
    told = np.flatnonzero(information.any(axis=(1, 2)))
    given, lean = information[told], lean[told, :, None]
    own = share[told, None, None] * given
    spread = _spread_of_others(covariance[middle[told]], own)
    disagreement = lean + own @ (spread @ lean)
    scatter = given + given @ spread @ given
    sizes, axes = np.linalg.eigh(0.5 * (scatter + np.swapaxes(scatter, 1, 2)))
    determined = sizes > 1e-8 * sizes.max(axis=1, keepdims=True)
    along = (np.swapaxes(axes, 1, 2) @ disagreement)[:, :, 0]
    square = np.where(determined, along ** 2 / np.where(determined, sizes, 1.0), 0.0)
    test[told] = square.sum(axis=1) / np.maximum(determined.sum(axis=1), 1)
    return test


def _spread_of_others(covariance: np.ndarray, block_information: np.ndarray) -> np.ndarray:
    """Covariances (b, p, p) that are left of blocks' places without their own information (b, p, p).

    A block is no rigid body: what its pieces say is not all said of its middle, so that the others' share has a floor.
    """
    root = np.linalg.cholesky(covariance)
    values, vectors = np.linalg.eigh(np.swapaxes(root, 1, 2) @ block_information @ root)
    axes = root @ vectors
    return (axes / (1.0 - np.clip(values, 0.0, LIMITS.most_own))[:, None, :]) @ np.swapaxes(axes, 1, 2)


def _block_shares(test: np.ndarray, noise: float, settings: CorrectionSettings) -> tuple[np.ndarray, float]:
    """Weights (b,) of blocks by their reduced chi square, and the factor of the observations' variance."""
    fair = test[np.isfinite(test)]
    if len(fair) >= LIMITS.min_blocks:  # the median, so that gross blocks do not raise it
        noise *= float(np.clip(np.median(fair) / 0.8, 0.1, 2.0))
    test = np.nan_to_num(test, nan=0.0)
    share = np.minimum(1.0, settings.gross**2 / 6.0 / np.maximum(test, LEAST_DIVISOR))
    return np.where(test > settings.gross**2 / 2.0, 0.0, share), noise


def onto_points(points: Evaluate, chain: NodeChain, fit: Fit, model: PoseErrorModel, allowed: np.ndarray,
                settings: CorrectionSettings, progress: Progress, search: bool = True) -> tuple[NodeChain, Fit]:
    """Gauss and Newton's method on the points' own normal equations, from the windows' correction.

    With `search` the size of the drift is looked for; otherwise the model is taken as it is.
    """
    for number, blur in enumerate(settings.blurs):
        progress.step(number / len(settings.blurs))
        last, normals = fit.state, points(NodeCurve(chain, fit.state), blur)
        chain = chain.with_normals(normals)
        trusted = np.interp(normals.path_parameter, chain.nodes, allowed) > 0.5
        if not (trusted & normals.present).any():
            trusted = np.ones(len(trusted), bool)
        if search and number in LIMITS.searched:
            fit = robust_fit(chain, model, trusted.astype(float), settings, SILENT)
        else:
            likely = model.scaled(fit.drift_factor).with_heading(fit.heading_factor) if search else model
            fit = replace(reweighted_fit(chain, likely, trusted.astype(float), settings)[0],
                          drift_factor=fit.drift_factor, heading_factor=fit.heading_factor)
        if blur == settings.blurs[-1] and np.abs(fit.state - last)[:, :2, 0].max() < LIMITS.converged:
            break
    return chain, fit
