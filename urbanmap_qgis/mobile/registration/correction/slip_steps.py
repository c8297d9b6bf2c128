"""Steps of the reference that the smooth drift hides: the correction bends aside over some way, the vehicle did not.

A decimetre between few markings is spread over tens of metres, so that nothing about it is sharp. Where the vehicle
headed is known better than that: correction and slip must go together.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ....geometry.tolerances import SIGMA_OF_MAD
from .disagreements import Disagreements, NodeStep
from .gauss_markov import StopMovement
from .side_slip import SideSlip


@dataclass(frozen=True)
class SlipStepLimits:
    """Limits of slip steps, each with its unit."""

    span: float = 40.0  # m of path over which a step may be spread
    every: float = 5.0  # m of path between the places that are looked at
    straight: float = 20.0  # degrees that the path turns by at most
    fewest: int = 20  # places from which the usual difference can be told
    proof: float = 4.5  # standard deviations
    least: float = 0.06  # m
    same: float = 40.0  # m of path within which two steps are one


LIMITS = SlipStepLimits()

Course = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
"""Corrections (n, 2) m in plan at path parameters (n,), and their covariances (n, 2, 2)."""


def slip_steps(slip: SideSlip, course: Course, stops: StopMovement, nodes: np.ndarray) -> list[NodeStep]:
    """Steps across the path by which a correction leaves the slip of its trajectory, the surest first.

    Parameters
    ----------
    stops : between the nodes (k,), path parameters.
    """
    length = slip.chainage[-1]
    middle = np.arange(0.5 * LIMITS.span, length - 0.5 * LIMITS.span, LIMITS.every)
    if len(middle) < LIMITS.fewest:
        return []
    rising = np.concatenate([[True], np.diff(slip.chainage) > 0])
    begin, centre, end = (np.interp(middle + side * LIMITS.span, slip.chainage[rising], slip.path_parameter[rising])
                          for side in (-0.5, 0.0, 0.5))
    heading = np.interp(centre, slip.path_parameter, slip.heading)
    right = np.column_stack([np.cos(heading), -np.sin(heading)])
    off, variance = _left_of_slip(slip, course, (begin, end), right)
    moved, loose = _standing(stops, nodes, begin, end)
    off = off + (right * moved).sum(axis=1)
    turned = np.abs(np.interp(end, slip.path_parameter, slip.heading)
                    - np.interp(begin, slip.path_parameter, slip.heading))
    straight = turned < np.radians(LIMITS.straight)
    if np.count_nonzero(straight) < LIMITS.fewest:
        return []
    usual = np.median(off[straight])
    scale = SIGMA_OF_MAD * np.median(np.abs(off[straight] - usual))
    off, sigma = off - usual, np.sqrt(np.maximum(variance, scale**2) + loose)
    likely = np.flatnonzero(straight & (np.abs(off) > np.maximum(LIMITS.proof * sigma, LIMITS.least)))
    chosen: list[int] = []
    for k in likely[np.argsort(-np.abs(off / sigma)[likely], kind="stable")]:
        if all(abs(middle[k] - middle[other]) > LIMITS.same for other in chosen):
            chosen.append(int(k))
    node = np.clip(np.searchsorted(nodes, centre) - 1, 0, len(nodes) - 2)
    return [NodeStep(int(node[k]), off[k] * right[k], sigma[k] ** 2 * np.eye(2), float((off[k] / sigma[k]) ** 2))
            for k in chosen]


def _left_of_slip(slip: SideSlip, course: Course, ends: tuple[np.ndarray, np.ndarray],
                  right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n,) m to the right, change of the correction between path parameters and the slip with it; variance m2."""
    (before, spread), (after, spread_after) = (course(at) for at in ends)
    slipped = np.interp(ends[1], slip.path_parameter, slip.slip) - np.interp(ends[0], slip.path_parameter, slip.slip)
    return ((right * (after - before)).sum(axis=1) + slipped,
            np.einsum("ni,nij,nj->n", right, spread + spread_after, right))


def _standing(stops: StopMovement, nodes: np.ndarray, begin: np.ndarray,
              end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n, 2) m that the place wandered in stops between path parameters, and the variance (n,) m2 of that."""
    moved, spread = (np.concatenate([np.zeros((1, part.shape[1])), np.cumsum(part, axis=0)])
                     for part in (stops.moved[:, :2], stops.variance[:, None]))
    change = [np.column_stack([np.interp(end, nodes, axis) - np.interp(begin, nodes, axis) for axis in part.T])
              for part in (moved, spread)]
    return change[0], change[1][:, 0]


def with_slip_steps(found: Disagreements, slip: SideSlip, course: Course) -> Disagreements:
    """What was found, with the steps that the slip of the trajectory denies; those known already stay as they are."""
    nodes, steps = found.chain.nodes, list(found.steps)
    known = [nodes[step.node] for step in (*steps, *(step for pair in found.changed for step in pair))]
    for step in slip_steps(slip, course, found.chain.stops, nodes):
        inside = any(begin <= nodes[step.node] <= end for begin, end, hidden in found.hidden if found.hides(hidden))
        if not inside and all(abs(nodes[step.node] - place) > LIMITS.same for place in known):
            steps.append(step)
    return replace(found, steps=sorted(steps, key=lambda step: step.node))
