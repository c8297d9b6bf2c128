"""Markings measured in a true city and registered to the map by ICP: predicted against observed accuracy (J 6.2)."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...mobile.registration.matching.ndt_match import RigidMotion
from ...progress import SILENT, Progress
from ..accuracy_records import AccuracyMap
from ..evidence.marking_map import SAMPLE, MarkingMap, visible_markings
from ..localisation_settings import LocalisationSettings
from ..map_aliases import ScoreField
from .line_matches import LineMap
from .prediction_check import PredictionCheck, compared, ends_at_place


def check_marking_prediction(markings: MarkingMap, accuracy: AccuracyMap, settings: LocalisationSettings, every: int,
                             draws: int, seed: int, progress: Progress = SILENT) -> PredictionCheck:
    """Register simulated markings and compare their errors with the prediction by markings.

    Every draw has a true city of its own, the markings displaced by their sigmas and all of them together. Walls hide
    nothing. Parameters as of `prediction_check.check_prediction`.
    """
    rows = np.flatnonzero(np.isfinite(accuracy.by_source["markings"][:, 0, 0]))[::every]
    place, heading = accuracy.places.place[rows], accuracy.places.heading[rows]
    of, number, _ = visible_markings(markings, cKDTree(markings.xy), place, heading, None, settings)
    spread = float(np.hypot(np.hypot(markings.sigma.max(), settings.marking_common), settings.marking_noise))
    no_start = ScoreField(0.0, 0.0, np.zeros((1, 1), np.float32))
    lines = LineMap.of(no_start, markings.xy, markings.normal, spread, True)
    errors = np.zeros((len(rows), draws, 3))
    for draw in range(draws):
        rng = np.random.default_rng([seed, draw])
        moved = _displaced(markings, settings, rng)
        for row in range(len(rows)):
            progress.step((draw + row / len(rows)) / draws)
            measured = _measured(markings, moved, number[of == row], place[row, :2], settings, rng)
            start = np.array([*rng.normal(0.0, settings.start_sigma, 2),
                              np.radians(rng.normal(0.0, settings.start_heading))])
            errors[row, draw] = _error(measured, place[row, :2], lines, start)
    converged, nothing = ends_at_place(errors, accuracy.by_source["markings"][rows]), np.zeros(len(rows))
    return compared(rows, errors, nothing, nothing, accuracy, converged, source="markings")


def _displaced(markings: MarkingMap, settings: LocalisationSettings, rng: np.random.Generator) -> np.ndarray:
    """(m, 2) true places of the samples, m."""
    own = rng.normal(0.0, 1.0, (int(markings.marking.max()) + 1, 2))[markings.marking] * markings.sigma[:, None]
    return markings.xy + own + rng.normal(0.0, settings.marking_common, 2)


def _measured(markings: MarkingMap, true: np.ndarray, number: np.ndarray, place: np.ndarray,
              settings: LocalisationSettings, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (k, 2) from the place on those of the samples that are found, normals of their edges and sigmas, m."""
    share = settings.detection * np.minimum(markings.length[number] / SAMPLE, 1.0)
    number = number[rng.random(len(number)) < share]
    off, normal = true[number] - place, markings.normal[number]
    noise = settings.marking_noise * np.maximum(np.hypot(off[:, 0], off[:, 1]) / 10.0, 1.0)
    measured = off + (noise * rng.normal(size=len(number)))[:, None] * normal
    return measured, normal, np.hypot(markings.sigma[number], noise)


def _error(measured: tuple[np.ndarray, np.ndarray, np.ndarray], place: np.ndarray, lines: LineMap, start: np.ndarray
           ) -> np.ndarray:
    """East, north, m, and turn, rad, of the registered place when the search begins `start` (3,) beside it."""
    points, normal, sigma = measured
    c, s = np.cos(start[2]), np.sin(start[2])
    begin = RigidMotion(np.zeros(2), place + start[:2], np.array([[c, -s], [s, c]]))
    found = lines.registered(points, begin, normal, sigma)[0]
    return np.array([*(found.translation - place), np.arctan2(found.rotation[1, 0], found.rotation[0, 0])])
