"""What a vehicle measures with, and what is taken for good."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..settings.localisation import EvidenceSettings, ScannerSettings


@dataclass(frozen=True)
class VehicleScanner(ScannerSettings):
    """A laser scanner on a vehicle."""


    def elevations(self, most: int | None = None) -> np.ndarray:
        """Elevations of the layers, radians; at most so many of them, evenly taken."""
        if self.kind == "2D":
            return np.zeros(1)
        count = self.layers if most is None else min(most, self.layers)
        return np.radians(np.linspace(self.lowest, self.highest, count))


@dataclass(frozen=True)
class LocalisationSettings(EvidenceSettings):
    """Settings of the prediction.

    Parameters
    ----------
    scanner : see `VehicleScanner`.
    outliers : share of outliers that its mixture expects.
    alias_share : from this share of probability on a place counts as repeated.
    min_points : fewer points on walls are too few.
    marking_noise : of a measured point of a marking, m, at 10 m; it grows with the range.
    nlos_delay : their usual excess path, m.
    """

    scanner: VehicleScanner = field(default_factory=VehicleScanner)
    alias_share: float = 0.05
    min_points: int = 20
    marking_noise: float = 0.05
    nlos_delay: float = 15.0
    outliers: float = 0.3

    def prior(self) -> np.ndarray:
        """(3, 3) information of what is known before: east, north (1/m2), heading (1/rad2)."""
        sigma = np.array([self.start_sigma, self.start_sigma, np.radians(self.start_heading)])
        return np.diag(sigma ** -2.0)
