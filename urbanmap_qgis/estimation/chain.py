"""The normal equations of the correction: nodes along the path, tied by how the error drifts, and the evidence."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from ..geometry.tolerances import LEAST_SQUARE
from .block_chain import ChainSolution, solve_chain
from .error_model import PoseErrorModel
from .gauss_markov import PathLinks
from .held_observations import HeldObservations, HeldSystem
from .latent_steps import StepEquations
from .normal_equations import NormalEquations

_SINGULAR = 1e-6  # ratio of information below which a direction is not observed
_NO_WEIGHT = 0.02  # weight that stands for evidence that is not believed at all


@dataclass(frozen=True)
class _Prior:
    """Normal equations of a model of the error without observations.

    Attributes
    ----------
    diagonal : (k, d, 2, d, 2).
    ahead : (k - 1, d, 2, d, 2) blocks.
    log_determinant : of its steps' precisions.
    right : (k, d, 2) right side, by what a standing vehicle's trajectory wanders.
    square : chi square of that against no change at all.
    """

    diagonal: np.ndarray
    ahead: np.ndarray
    log_determinant: float
    right: np.ndarray
    square: float


@dataclass(frozen=True)
class SettledChain:
    """The nodes with what is held, its offsets most likely.

    Attributes
    ----------
    state, covariance : (k, d, 2), (k, 2 d, 2 d) of the nodes.
    offset : m, the common one of all that is held.
    own, own_variance : (m,) m, m2, the other offsets (see `OwnOffsets`).
    """

    state: np.ndarray
    covariance: np.ndarray
    offset: float
    own: np.ndarray
    own_variance: np.ndarray


class NodeChain:
    """The normal equations: nodes along the path, the observations on the node next to each piece."""

    def __init__(self, normals: NormalEquations, nodes: np.ndarray, links: PathLinks,
                 fast: np.ndarray | float = 0.0, fast_up: np.ndarray | float = 0.0):
        self.nodes, self.links = nodes, links
        self.fast, self.fast_up = (np.broadcast_to(change, len(nodes) - 1) for change in (fast, fast_up))
        self.held: HeldObservations | None = None
        self._held_sums: tuple[np.ndarray, np.ndarray] | None = None
        self._upright_sums: tuple[np.ndarray, np.ndarray] | None = None
        self._start(normals)

    def _start(self, normals: NormalEquations) -> None:
        self.size, self.normals = len(normals.active), normals
        self._held: tuple[PoseErrorModel, _Prior] | None = None
        self.node, self.ahead = self._next_node(normals.path_parameter)

    def fast_near(self, path_parameter: np.ndarray, extent: float) -> np.ndarray:
        """Mask (n,) of path parameters within `extent` m of a place where the error changes fast."""
        places = 0.5 * (self.nodes[1:] + self.nodes[:-1])[self.fast > 0]
        ends = np.concatenate([[-np.inf], places, [np.inf]])
        number = np.searchsorted(places, path_parameter)
        return np.minimum(path_parameter - ends[number], ends[number + 1] - path_parameter) <= extent

    def with_normals(self, normals: NormalEquations) -> NodeChain:
        """The same nodes with other normal equations."""
        other = copy(self)
        other._start(normals)
        return other

    def with_fast(self, fast: np.ndarray, fast_up: np.ndarray | float = 0.0) -> NodeChain:
        """The same where the error changes fast elsewhere, (k - 1,) m in plan and in height."""
        other = copy(self)
        other.fast, other.fast_up, other._held = fast, np.broadcast_to(fast_up, len(fast)), None
        return other

    def between(self, first: int, last: int) -> NodeChain:
        """The nodes from one number to another alone, with the evidence next to them, and nothing held."""
        other, steps = copy(self), slice(first, last)
        other.nodes, other.links = self.nodes[first:last + 1], self.links.select(steps)
        other.fast, other.fast_up = self.fast[steps], self.fast_up[steps]
        other.held, other._held_sums, other._upright_sums = None, None, None
        other._start(self.normals.select((self.node >= first) & (self.node <= last)))
        return other

    def with_held(self, observations: HeldObservations | None) -> NodeChain:
        """The same with other observations beside its evidence that no weighing of it touches; None for none."""
        other = copy(self)
        other.held = observations
        other._held_sums = None if observations is None else observations.on_nodes(
            *self._next_node(observations.path_parameter), len(self.nodes))
        return other

    def with_upright(self, observations: HeldObservations) -> NodeChain:
        """The same with observations of angles beside all others, whose offset is none and which no weighing touches.
        """
        other = copy(self)
        other._upright_sums = observations.on_nodes(*self._next_node(observations.path_parameter), len(self.nodes))
        return other

    def _next_node(self, path_parameter: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Number of the nearest node of each reading, and how far ahead of it the reading is, m."""
        node = np.searchsorted(0.5 * (self.nodes[1:] + self.nodes[:-1]), path_parameter)
        return node, path_parameter - self.nodes[node]

    def marked(self, weight: np.ndarray) -> np.ndarray:
        """(k,) bool, nodes with evidence of some weight (n,) next to them."""
        return np.bincount(self.node, self.normals.present * weight, len(self.nodes)) > _NO_WEIGHT

    def solve(self, model: PoseErrorModel, weight: np.ndarray):
        """Most likely states (k, d, 2), their covariances, and the log-likelihood of the model."""
        solution, right, prior = self._solved(model, weight)
        k, d = len(self.nodes), self.size
        likelihood = 0.5 * (float((right.reshape(k, -1) * solution.state).sum()) + prior.log_determinant
                            - prior.square - solution.log_determinant)
        return solution.state.reshape(k, d, 2), solution.covariance, likelihood

    def _solved(self, model: PoseErrorModel, weight: np.ndarray) -> tuple[ChainSolution, np.ndarray, _Prior]:
        """The solution, the right side (k, d, 2) and the prior."""
        k, d = len(self.nodes), self.size
        diagonal, right, prior = self._equations(model, weight)
        if self._held_sums is not None:
            diagonal, right = diagonal + self._held_sums[0], right + self._held_sums[1]
        return solve_chain(diagonal.reshape(k, 2 * d, 2 * d), prior.ahead.reshape(k - 1, 2 * d, 2 * d),
                           right.reshape(k, 2 * d)), right, prior

    def _equations(self, model: PoseErrorModel, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray, _Prior]:
        """Blocks on the diagonal (k, d, 2, d, 2) and right side (k, d, 2) without what is held, and the prior."""
        prior = self._prior_of(model)
        diagonal, right = prior.diagonal.copy(), prior.right.copy()
        weighted = self.normals.information * weight[:, None, None]
        gradient = self.normals.normal_vector * weight[:, None]
        steps = np.stack([np.ones(len(self.ahead)), self.ahead], axis=1)
        filled, first = np.unique(self.node, return_index=True)  # nodes grow along the path
        right[filled] += np.add.reduceat(gradient[:, :, None] * steps[:, None], first, axis=0)
        products = weighted[:, :, None, :, None] * (steps[:, :, None] * steps[:, None])[:, None, :, None]
        diagonal[filled] += np.add.reduceat(products, first, axis=0)
        if self._upright_sums is not None:
            diagonal, right = diagonal + self._upright_sums[0], right + self._upright_sums[1]
        return diagonal, right, prior

    def settled(self, model: PoseErrorModel, weight: np.ndarray) -> SettledChain:
        """Most likely states with what is held, at the most likely offsets of it, which are unknown too."""
        made = self._held_system(model, weight).solved()
        return SettledChain(made.state.reshape(len(self.nodes), self.size, 2), made.covariance,
                            self.held.offset + made.offset[0], made.offset[1:], made.offset_variance[1:])

    def _held_system(self, model: PoseErrorModel, weight: np.ndarray) -> HeldSystem:
        """The equations with what is held and its offsets."""
        k, p = len(self.nodes), 2 * self.size
        diagonal, right, prior = self._equations(model, weight)
        equations = self.held.offset_equations(*self._next_node(self.held.path_parameter), k)
        return HeldSystem(diagonal.reshape(k, p, p), prior.ahead.reshape(k - 1, p, p), right.reshape(k, p), equations)

    def shift_response(self, model: PoseErrorModel, weight: np.ndarray, path_parameter: np.ndarray) -> np.ndarray:
        """(n, 2, 2) how far the place in plan at path parameters (n,) follows a shift in plan of all the evidence.

        All of it without held observations; with them what they leave: they stay, but for their offsets.
        """
        if self.held is None:
            return np.broadcast_to(np.eye(2), (len(path_parameter), 2, 2))
        k, d, sides = len(self.nodes), self.size, []
        for shift in np.eye(d)[:2]:
            bare = copy(self)
            bare.normals = replace(self.normals, gradient=np.zeros_like(self.normals.gradient),
                                   place=np.broadcast_to(shift, self.normals.place.shape))
            bare._held, bare.links = None, replace(self.links, moved=np.zeros_like(self.links.moved))
            bare._upright_sums = None
            sides.append(bare._equations(model, weight)[1].ravel())
        states = self._held_system(model, weight).response(np.column_stack(sides))
        followed = [smooth_between(self.nodes, states[..., axis].reshape(k, d, 2), path_parameter)[:, :2]
                    for axis in range(2)]
        return np.stack(followed, axis=2)

    def step_equations(self, model: PoseErrorModel, weight: np.ndarray,
                       axes: tuple[int, ...] = (0, 1)) -> StepEquations:
        """What the evidence says of steps of the two parameters `axes` between the nodes that no drift explains.

        A step shifts all the evidence behind it; what is held, and fast changes, do not count. With one of `axes` in
        height the other direction is without evidence.
        """
        bare = self.with_fast(np.zeros(len(self.nodes) - 1))
        k, p, e = len(self.nodes), 2 * self.size, len(self.nodes) - 1
        diagonal, right, prior = bare._equations(model, weight)
        information, pull = np.zeros((k, self.size, 2, 2)), np.zeros((k, 2))
        weighted = self.normals.information * weight[:, None, None]
        steps = np.stack([np.ones(len(self.ahead)), self.ahead], axis=1)
        for side, axis in enumerate(axes):
            np.add.at(information[..., side], self.node, weighted[:, :, axis, None] * steps[:, None])
            np.add.at(pull[:, side], self.node, self.normals.normal_vector[:, axis] * weight)
        shifted = np.zeros((k, p, e, 2))
        flat = information.reshape(k, p, 2)
        for number in range(e):
            shifted[number + 1:, :, number] = -flat[number + 1:]
        sides = np.concatenate([shifted.reshape(k, p, -1), right.reshape(k, p, 1)], axis=2)
        made = solve_chain(diagonal.reshape(k, p, p), prior.ahead.reshape(e, p, p), sides).state
        follows, state = made[..., :-1].reshape(k, p, e, 2), made[..., -1]
        own = np.zeros((k, 2, 2))
        for side in range(len(axes)):
            own[:, side, :len(axes)] = information[:, list(axes), 0, side]
        behind = np.arange(e)
        whole = _behind(own)[np.maximum(behind[:, None], behind)]
        left = _behind(np.einsum("kpq,kpfr->kfqr", flat, follows, optimize=True))
        gap = np.diff(self.nodes)
        marked = np.where(np.einsum("kii->k", own) > 0, gap.mean(), 0.0)
        return StepEquations(0.5 * (self.nodes[1:] + self.nodes[:-1]), gap, np.cumsum(marked)[:-1], _behind(marked),
                             _behind(pull - np.einsum("kpq,kp->kq", flat, state)), whole + left)

    def _prior_of(self, model: PoseErrorModel) -> _Prior:
        """What a model says of the nodes; held for the next call, as the same model is solved with many weights."""
        if self._held is not None and self._held[0] is model:
            return self._held[1]
        k, d = len(self.nodes), self.size
        diagonal, ahead = np.zeros((k, d, 2, d, 2)), np.zeros((k - 1, d, 2, d, 2))
        transition, precision = self._steps(model)
        axis = np.arange(d)
        carried = np.einsum("kdji,kdjl->kdil", transition, precision)  # F' P
        diagonal[1:, axis, :, axis, :] += np.moveaxis(precision, 1, 0)
        diagonal[:-1, axis, :, axis, :] += np.moveaxis(np.einsum("kdil,kdlm->kdim", carried, transition), 1, 0)
        ahead[:, axis, :, axis, :] -= np.moveaxis(carried, 1, 0)
        start = 1.0 / model.start(self.normals.active)
        diagonal[0, axis, 0, axis, 0] += start[:, 0]
        diagonal[0, axis, 1, axis, 1] += start[:, 1]
        determinant = float(np.log(np.linalg.det(precision)).sum() + np.log(start).sum())
        right, changes = np.zeros((k, d, 2)), self.stop_changes()
        right[1:] += precision[..., 0] * changes[:, :, None]
        right[:-1] -= carried[..., 0] * changes[:, :, None]
        square = float((precision[..., 0, 0] * changes**2).sum())
        self._held = model, _Prior(diagonal, ahead, determinant, right, square)
        return self._held[1]

    def _steps(self, model: PoseErrorModel) -> tuple[np.ndarray, np.ndarray]:
        """Transitions and precisions (k - 1, d, 2, 2) of a model between the nodes."""
        return model.steps(self.nodes, self.links, self.normals.active, self.fast, self.fast_up)

    def stop_changes(self) -> np.ndarray:
        """(k - 1, d) m, by which the correction changes between the nodes as the vehicle stands and is reported not to.
        """
        changes = np.zeros((len(self.nodes) - 1, self.size))
        for number, parameter in enumerate(self.normals.active):
            if parameter < 3:
                changes[:, number] = -self.links.moved[:, parameter]
        return changes

    def unconstrained_likelihood(self, weight: np.ndarray, allowed: np.ndarray) -> float:
        """Log-likelihood that the nodes would reach each on its own, with the densities that their weights stand for.

        With it likelihoods can be compared between models that weight the `allowed` (n,) evidence differently.
        """
        k, allowed = len(self.nodes), self.normals.present & (allowed > 0)
        information, gradient = np.zeros((k, self.size, self.size)), np.zeros((k, self.size))
        np.add.at(information, self.node, self.normals.information * weight[:, None, None])
        np.add.at(gradient, self.node, self.normals.normal_vector * weight[:, None])
        values, vectors = np.linalg.eigh(information)
        determined = values > _SINGULAR * np.maximum(values[:, -1:], LEAST_SQUARE)
        along = np.einsum("kji,kj->ki", vectors, gradient)
        best = 0.5 * (np.where(determined, along**2, 0.0) / np.where(determined, values, 1.0)).sum()
        count = np.bincount(self.node, allowed, k)
        mean = np.bincount(self.node, allowed * weight, k) / np.maximum(count, 1)
        rank = np.where(mean > 0, determined.sum(axis=1), self.size) * (count > 0)
        return float(best) - 0.5 * float((rank * np.log(np.maximum(mean, _NO_WEIGHT))).sum())

    def interpolate(self, state: np.ndarray, covariance: np.ndarray,
                    path_parameter: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Values (n, d) and covariances (n, d, d) at path parameters (n,)."""
        node, ahead = self._next_node(path_parameter)
        value = smooth_between(self.nodes, state, path_parameter)
        d = self.size
        blocks = covariance[node].reshape(-1, d, 2, d, 2)
        lever_arm = ahead[:, None, None]
        spread = (blocks[:, :, 0, :, 0] + lever_arm * (blocks[:, :, 0, :, 1] + blocks[:, :, 1, :, 0])
                  + lever_arm**2 * blocks[:, :, 1, :, 1])
        return value, spread


def _behind(values: np.ndarray) -> np.ndarray:
    """(k - 1, ...) sums of values (k, ...) of all nodes behind each step."""
    return np.cumsum(values[::-1], axis=0)[::-1][1:]


def nodes_along(path_parameter: np.ndarray, length: float) -> np.ndarray:
    """Path parameters at which the correction has nodes, at most `length` apart, at least two."""
    count = max(int(np.ceil((path_parameter[-1] - path_parameter[0]) / length)), 1)
    return np.linspace(path_parameter[0], path_parameter[-1], count + 1)


def smooth_between(nodes: np.ndarray, state: np.ndarray, path_parameter: np.ndarray) -> np.ndarray:
    """Values (m, d) at path parameters (m,): cubics that meet the nodes' values and rates."""
    step = np.clip(np.searchsorted(nodes, path_parameter, side="right") - 1, 0, len(nodes) - 2)
    length = (nodes[step + 1] - nodes[step])[:, None]
    t = np.clip((path_parameter - nodes[step])[:, None] / length, 0.0, 1.0)
    before, after = state[step], state[step + 1]
    return (before[:, :, 0] * (1 + 2 * t) * (1 - t) ** 2 + after[:, :, 0] * t**2 * (3 - 2 * t)
            + length * t * (1 - t) * (before[:, :, 1] * (1 - t) - after[:, :, 1] * t))


@dataclass(frozen=True)
class NodeCurve:
    """The correction (m, 6) at path parameters (m,)."""

    chain: NodeChain
    state: np.ndarray

    def __call__(self, path_parameter: np.ndarray) -> np.ndarray:
        correction = np.zeros((len(path_parameter), 6))
        correction[:, self.chain.normals.active] = smooth_between(self.chain.nodes, self.state, path_parameter)
        return correction
