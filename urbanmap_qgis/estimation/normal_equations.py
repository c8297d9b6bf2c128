"""Normal equations of each piece of the path, which add up."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..geometry.tolerances import LEAST_SQUARE

PLANE, SPACE = (0, 1, 5), (0, 1, 2, 3, 4, 5)
"""Parameters that are estimated in 2D and in 3D."""


@dataclass(frozen=True)
class NormalEquations:
    """Log-likelihood of corrections c of n pieces of path, off = c - place: gradient . off - off' information off / 2.

    Attributes
    ----------
    active : numbers of the d parameters (dx, dy, dz, droll, dpitch, dheading) that are estimated.
    path_parameter : (n,) m, of the pieces.
    place : (n, d).
    gradient : (n, d).
    information : (n, d, d).
    present : (n,) bool, whether the piece says anything.
    met : (n,) share of the points around that lie on reference markings; None where it is not known.
    three_d : whether height, roll and pitch are estimated.
    """

    active: tuple[int, ...]
    path_parameter: np.ndarray
    place: np.ndarray
    gradient: np.ndarray
    information: np.ndarray
    present: np.ndarray
    three_d: bool
    met: np.ndarray | None = None

    @classmethod
    def silent(cls, active: tuple[int, ...], path_parameter: np.ndarray) -> NormalEquations:
        """Of pieces that say nothing of some parameters."""
        n, d = len(path_parameter), len(active)
        return cls(active, path_parameter, *np.zeros((2, n, d)), np.zeros((n, d, d)), np.zeros(n, bool), True)

    @property
    def normal_vector(self) -> np.ndarray:
        """(n, d) gradient at no correction at all (the normal vector b)."""
        return self.gradient + np.einsum("nij,nj->ni", self.information, self.place)

    def gradient_at(self, value: np.ndarray) -> np.ndarray:
        """(n, d) gradient at corrections (n, d)."""
        return self.gradient - np.einsum("nij,nj->ni", self.information, value - self.place)

    def softened(self, share: np.ndarray) -> NormalEquations:
        """The same with the information of each piece times `share` (n,)."""
        return replace(self, gradient=self.gradient * share[:, None],
                       information=self.information * share[:, None, None])

    def select(self, which: np.ndarray) -> NormalEquations:
        """Those of some of the pieces, by mask."""
        return replace(self, path_parameter=self.path_parameter[which], place=self.place[which],
                       gradient=self.gradient[which], information=self.information[which],
                       present=self.present[which], met=None if self.met is None else self.met[which])

    def in_plan(self) -> list[int]:
        """Which of the d parameters move points in plan alone: dx, dy and dheading."""
        return [number for number, parameter in enumerate(self.active) if parameter in PLANE]

    def misfit(self, value: np.ndarray) -> np.ndarray:
        """(n,) reduced chi square in plan of corrections (n, d): how far each piece's observations lie from them."""
        plan = self.in_plan()
        sizes, axes = np.linalg.eigh(self.information[:, plan][:, :, plan])
        determined = sizes > 1e-3 * np.maximum(sizes[:, -1:], LEAST_SQUARE)
        along = np.einsum("nji,nj->ni", axes, self.gradient_at(value)[:, plan])
        pulls = np.where(determined, along**2, 0.0) / np.where(determined, sizes, 1.0)
        return pulls.sum(axis=1) / np.maximum(determined.sum(axis=1), 1)
