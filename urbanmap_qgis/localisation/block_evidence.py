"""What walls, markings and satellites tell of the places of a block, each on its own and together."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .accuracy_records import SOURCES, LocalisationMap
from .evidence.information import covariance, fused
from .evidence.marking_map import MarkingMap, marking_evidence, visible_markings
from .evidence.satellite_evidence import satellite_plan
from .evidence.wall_evidence import representation, walls_covariance
from .localisation_settings import LocalisationSettings
from .places.place_checks import sky_covered
from .places.road_places import RoadPlaces
from .prepared_map import PreparedMap
from .walls.wall_map import WallMap
from .walls.wall_scan import WallScan, scan_walls

_FIGURES = ("points", "walls", "covered", "sky_covered", "cell_rms", "two_surfaces", "satellites", "dilution",
            "samples", "other_level")


@dataclass
class BlockEvidence:
    """Evidence at n places, of which k can be told anything of.

    Attributes
    ----------
    places : all n.
    able : (k,) rows of those that can be told anything of.
    settings : of the vehicles.
    by_source : (n, 3, 3) covariance by source, NaN where it tells nothing; see `AccuracyMap`.
    figures : (n,) by name, NaN where not asked for; see `AccuracyMap`.
    scan : walls as seen from the k places; None without walls.
    seen : of each marking seen: which of the k places, number of the marking; None without markings.
    """

    places: RoadPlaces
    able: np.ndarray
    settings: LocalisationSettings
    by_source: dict[str, np.ndarray] = field(init=False)
    figures: dict[str, np.ndarray] = field(init=False)
    scan: WallScan | None = None
    seen: tuple[np.ndarray, np.ndarray] | None = None

    def __post_init__(self) -> None:
        count = len(self.places)
        self.by_source = {name: np.full((count, 3, 3), np.nan) for name in SOURCES}
        self.figures = {name: np.full(count, np.nan) for name in _FIGURES}

    @property
    def sensor(self) -> np.ndarray:
        """(k, 3) places of the scanner, m."""
        return np.nan_to_num(self.places.place[self.able]) + np.array([0.0, 0.0, self.settings.scanner.height])

    def look_at_walls(self, walls: WallMap, prepared: PreparedMap) -> None:
        """What a scanner tells by the walls."""
        able, sensor, count = self.able, self.sensor, len(self.able)
        scan = self.scan = scan_walls(walls, sensor, self.settings.scanner)
        points = np.bincount(scan.of, scan.weight * (1 - self.settings.scanner.hidden), count)
        found = walls_covariance(walls, scan, sensor, self.places.heading[able], prepared.cells, prepared.patterns,
                                self.settings)
        self.by_source["walls"][able] = found
        self.by_source["walls"][able[points < self.settings.min_points]] = np.nan
        self._keep(points=points, walls=_different_walls(walls, scan, count), covered=scan.covered,
                   sky_covered=sky_covered(walls, sensor))
        rms, surfaces = representation(walls, scan, sensor, prepared.cells, count)
        self._keep(cell_rms=rms, two_surfaces=surfaces)

    def look_at_markings(self, markings: MarkingMap, prepared: PreparedMap) -> None:
        """What a camera or a scanner tells by the markings that walls do not hide."""
        able = self.able
        place = self.places.place[able]
        of, number, other_level = visible_markings(markings, prepared.marking_tree, place, self.places.heading[able],
                                                   self.scan, self.settings)
        self.seen = of, number
        rows = marking_evidence(markings, of, number, place, self.settings)
        covariances = covariance(rows, len(able), self.settings.prior())
        has = np.bincount(rows.of, minlength=len(able)) > 0
        self.by_source["markings"][able[has]] = covariances[has]
        self._keep(samples=np.bincount(of, minlength=len(able)), other_level=other_level)

    def look_at_satellites(self, city: LocalisationMap) -> None:
        """What satellites between the walls tell."""
        times = city.sky.with_times(self.places.time[self.able])
        found = satellite_plan(city.walls, self.sensor, times, self.settings)
        self.by_source["satellites"][self.able, :2, :2] = found.covariance
        self._keep(satellites=found.satellites, dilution=found.dilution)

    def put_together(self) -> None:
        """All sources in one; of the satellites' positions the heading is what it was before."""
        prior = self.settings.prior()
        by_source = self.by_source
        parts = [by_source["walls"], by_source["markings"]]
        fixed = np.isfinite(by_source["satellites"][:, 0, 0])
        gained = np.zeros((len(fixed), 3, 3))
        gained[fixed, :2, :2] = np.linalg.inv(by_source["satellites"][fixed, :2, :2])
        some = np.isfinite(np.stack([part[:, 0, 0] for part in parts])).any(axis=0) | fixed
        parts = [np.where(np.isfinite(part), part, np.linalg.inv(prior)) for part in parts]
        by_source["together"][some] = fused([*parts, np.linalg.inv(gained + prior)], prior)[some]

    def _keep(self, **figures: np.ndarray) -> None:
        """Write figures of the places that can be told anything of."""
        for name, values in figures.items():
            self.figures[name][self.able] = values


def block_evidence(city: LocalisationMap, places: RoadPlaces, able: np.ndarray, prepared: PreparedMap,
                   settings: LocalisationSettings) -> BlockEvidence:
    """Evidence of all sources that a map has, at those of the places that can be told anything of."""
    evidence = BlockEvidence(places, able, settings)
    if city.walls is not None and len(able):
        evidence.look_at_walls(city.walls, prepared)
    if city.markings is not None and len(able):
        evidence.look_at_markings(city.markings, prepared)
    if city.sky is not None and city.walls is not None and len(able):
        evidence.look_at_satellites(city)
    evidence.put_together()
    return evidence


def _different_walls(walls: WallMap, scan: WallScan, count: int) -> np.ndarray:
    pairs = np.unique(scan.of * walls.walls.count + walls.walls.wall[scan.piece])
    return np.bincount(pairs // walls.walls.count, minlength=count)
