"""Tree crowns as sensors from above see them: ellipsoids of leaves with gaps."""

from __future__ import annotations

import numpy as np

from .model import Crowns
from .paint import value_noise

CROWN = 1 << 24
"""Labels of crowns start here; those of faces lie below."""


class Leaves:
    """Where rays meet the leaves of crowns. Places are local: relative to `origin` in plan."""

    def __init__(self, crowns: Crowns, origin: np.ndarray):
        self.centre = crowns.centre - [*origin, 0.0]
        self.radii = crowns.radii
        self.free_path = crowns.free_path

    def meet(self, crown: int, start: np.ndarray, ray: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Where rays start + t ray, all (..., 3), enter and leave a crown (t), and whether they meet a leaf in it.

        A ray that runs L m through the crown finds a gap with the chance exp(-L / free path); the gaps have a
        fixed place in the crown.
        """
        p = (start - self.centre[crown]) / self.radii[crown]
        d = ray / self.radii[crown]
        dd, pd = (d * d).sum(-1), (p * d).sum(-1)
        root = pd * pd - dd * ((p * p).sum(-1) - 1.0)
        half = np.sqrt(np.maximum(root, 0.0)) / dd
        enter, leave = -pd / dd - half, -pd / dd + half
        through = (leave - enter) * np.linalg.norm(ray, axis=-1)
        middle = start + (-pd / dd)[..., None] * ray
        noise = 0.5 * (value_noise(middle[..., 0], middle[..., 1], 0.25)
                       + value_noise(middle[..., 0], middle[..., 1], 0.7))
        chance = np.clip((noise - 0.2) / 0.6, 0.0, 1.0)
        return enter, leave, (root > 0) & (chance > np.exp(-through / self.free_path[crown]))

    def normal(self, crown: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Unit normals (n, 3) of the ellipsoids `crown` (n,) at the points (n, 3)."""
        outward = (points - self.centre[crown]) / self.radii[crown] ** 2
        return outward / np.linalg.norm(outward, axis=1, keepdims=True)
