"""Observations of single distances that keep their weights while the evidence of markings is weighed against itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class HeldObservations:
    """Distances rate . c = target with weights, of corrections c at path parameters, all moved by one common offset.

    Attributes
    ----------
    path_parameter : (n,) m, not falling.
    rate : (n, d) m for each of the chain's d parameters.
    target : (n,) m.
    weight : (n,) 1 / m2.
    offset : m, in all targets.
    offset_prior : m, (mean, standard deviation) before any observation.
    """

    path_parameter: np.ndarray
    rate: np.ndarray
    target: np.ndarray
    weight: np.ndarray
    offset: float
    offset_prior: tuple[float, float]

    def __len__(self) -> int:
        return len(self.target)

    def on_nodes(self, node: np.ndarray, ahead: np.ndarray, nodes: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Information (k, d, 2, d, 2), right side (k, d, 2) and pull of the offset (k, d, 2) of k nodes.

        `node`, `ahead` : (n,) the node next to each observation, and m that the observation lies ahead of it.
        """
        full = self.rate[:, :, None] * np.stack([np.ones(len(self)), ahead], axis=1)[:, None]
        size = full.shape[1]
        information, right, pull = np.zeros((nodes, size, 2, size, 2)), *np.zeros((2, nodes, size, 2))
        filled, first = np.unique(node, return_index=True)  # nodes grow along the path
        weighted = full * self.weight[:, None, None]
        for begin, end, at in zip(first, np.append(first[1:], len(node)), filled):
            some = slice(begin, end)
            information[at] = np.tensordot(full[some], weighted[some], axes=(0, 0))
            right[at], pull[at] = np.tensordot(self.target[some], weighted[some], axes=1), weighted[some].sum(axis=0)
        return information, right, pull

    def residual(self, value: np.ndarray) -> np.ndarray:
        """(n,) m, what corrections (n, d) leave."""
        return (self.rate * value).sum(axis=1) - self.target

    def plan_information(self, path_parameter: np.ndarray, extent: float | np.ndarray) -> np.ndarray:
        """(m, 2, 2) what the observations within `extent` m of path parameters (m,) know of the place in plan."""
        plan = self.rate[:, :2]
        product = plan[:, :, None] * plan[:, None, :] * self.weight[:, None, None]
        running = np.concatenate([np.zeros((1, 2, 2)), np.cumsum(product, axis=0)])
        low, high = (np.searchsorted(self.path_parameter, path_parameter + side) for side in (-extent, extent))
        return running[high] - running[low]
