"""What a vehicle measures with, and what is taken for good."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class VehicleScanner:
    """A laser scanner on a vehicle.

    Parameters
    ----------
    kind : "2D", one level layer, or "multi-layer".
    height : above the road, m.
    max_range : m.
    resolution : between rays of a layer, degrees.
    noise : standard deviation of a range, m.
    layers : of a multi-layer scanner.
    lowest, highest : their elevations, degrees.
    hidden : share of the rays that end at vehicles, trees or people.
    """

    kind: str = "2D"
    height: float = 2.0
    max_range: float = 60.0
    resolution: float = 0.5
    noise: float = 0.03
    layers: int = 16
    lowest: float = -15.0
    highest: float = 15.0
    hidden: float = 0.1

    def elevations(self, most: int | None = None) -> np.ndarray:
        """Elevations of the layers, radians; at most so many of them, evenly taken."""
        if self.kind == "2D":
            return np.zeros(1)
        count = self.layers if most is None else min(most, self.layers)
        return np.radians(np.linspace(self.lowest, self.highest, count))


@dataclass(frozen=True)
class LocalisationSettings:
    """Settings of the prediction.

    Parameters
    ----------
    scanner : see `VehicleScanner`.
    matcher : "NDT" weighs each wall with the variance of its cells, "ICP" all points alike.
    cell : side of the NDT's cells, m.
    outliers : share of outliers that its mixture expects.
    common_sigma : of a displacement that all walls of a building share, m.
    start_sigma : standard deviation of what is known before matching, each of east and north, m.
    start_heading : the same of the heading, degrees.
    search : alias places are looked for up to this distance, m; 0 for not at all.
    good, usable : largest standard deviation, m, of the weakest direction of a good and of a usable place.
    alias_share : from this share of probability on a place counts as repeated.
    min_points : fewer points on walls are too few.
    marking_range : markings farther away are not seen, m.
    marking_view : angle ahead in which they are, degrees.
    detection : share of the markings within sight that are found.
    marking_noise : of a measured point of a marking, m, at 10 m; it grows with the range.
    marking_common : standard deviation of a displacement that all markings around a place share, m.
    code_sigma : of a range to a satellite at the zenith, m.
    nlos_share : of the hidden satellites that are received by reflection and used.
    nlos_delay : their usual excess path, m.
    """

    scanner: VehicleScanner = field(default_factory=VehicleScanner)
    matcher: str = "NDT"
    cell: float = 2.0
    common_sigma: float = 0.0
    start_sigma: float = 1.0
    start_heading: float = 2.0
    search: float = 15.0
    good: float = 0.3
    usable: float = 1.0
    alias_share: float = 0.05
    min_points: int = 20
    marking_range: float = 25.0
    marking_view: float = 360.0
    detection: float = 0.8
    marking_noise: float = 0.05
    marking_common: float = 0.03
    code_sigma: float = 2.0
    nlos_share: float = 0.3
    nlos_delay: float = 15.0
    outliers: float = 0.3

    def prior(self) -> np.ndarray:
        """(3, 3) information of what is known before: east, north (1/m2), heading (1/rad2)."""
        sigma = np.array([self.start_sigma, self.start_sigma, np.radians(self.start_heading)])
        return np.diag(sigma ** -2.0)
