"""Predicted against observed accuracy: scans simulated at every k-th place and registered to the map (J 6.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import rankdata

from ...gnss.rays.tracing import WallObstacles
from ...gnss.rays.wall_faces import WallPieces
from ...progress import SILENT, Progress
from ..accuracy_map import APART
from ..accuracy_records import AccuracyMap
from ..ellipses import along_and_across, plan_ellipses
from ..localisation_settings import LocalisationSettings
from ..map_aliases import EVIDENCE_OF_CELL, STEP, alias_modes
from ..places.place_status import undetermined_directions
from ..prepared_map import field_of_walls
from ..start_basins import BESIDE
from ..walls.wall_map import WallMap
from .line_matches import LineMap, lines_of_walls
from .simulated_matches import MatchingMap, match_error, plan_matching_map, space_matching_map
from .simulated_scans import displaced, simulated_scans

ELLIPSE_95 = 5.991
"""95 % quantile of chi square with two degrees of freedom."""

_AZIMUTHS_PLAN, _AZIMUTHS_SPACE = 360, 120


@dataclass(frozen=True)
class PredictionCheck:
    """Observed errors at some places.

    Attributes
    ----------
    rows : (k,) of the places in the map of accuracy.
    errors : (k, draws, 3) east, north, m, and turn, rad, of each registration.
    observed, predicted : (k,) m, root mean square error in plan, and the one expected.
    observed_parts, predicted_parts : (k, 3) along, across (m), heading (degrees).
    within : (k,) share of the errors within the 95 % ellipse.
    hidden : (k,) share of the rays to walls that vehicles and trees stopped.
    elsewhere : (k,) share of the scans that fit another place within the search better than their own.
    rank : Spearman's coefficient of observed and predicted over all places; NaN with fewer than three.
    rank_in_street : median over the streets with eight places or more; NaN without one.
    inside : share of all errors within the 95 % ellipses.
    converged : (k, draws) whether a scan ends at the place, see `ends_at_place`.
    determined : (k,) whether walls tell of all directions in plan.
    rank_converged, inside_converged : the same of scans that converge at places with all directions determined.
    failures_ranked : probability that a scan there that does not converge has a larger predicted share of such scans
        than one that does (area under the ROC curve); NaN where none or all converge.
    """

    rows: np.ndarray
    errors: np.ndarray
    observed: np.ndarray
    predicted: np.ndarray
    observed_parts: np.ndarray
    predicted_parts: np.ndarray
    within: np.ndarray
    hidden: np.ndarray
    elsewhere: np.ndarray
    rank: float
    rank_in_street: float
    inside: float
    converged: np.ndarray
    determined: np.ndarray
    rank_converged: float
    inside_converged: float
    failures_ranked: float


def check_prediction(walls: WallMap, accuracy: AccuracyMap, settings: LocalisationSettings, every: int, draws: int,
                     seed: int, truth: WallPieces | None = None, progress: Progress = SILENT) -> PredictionCheck:
    """Register simulated scans and compare their errors with the prediction by walls.

    Parameters
    ----------
    every : k, of the places of which walls tell something.
    draws : scans a place.
    truth : walls of the true city; without it each draw has its own, the map displaced by its sigmas.
    """
    rows = np.flatnonzero(np.isfinite(accuracy.by_source["walls"][:, 0, 0]))[::every]
    sensor = accuracy.places.place[rows] + np.array([0.0, 0.0, settings.scanner.height])
    heading = accuracy.places.heading[rows]
    maps = _maps(walls, accuracy, rows, settings)
    errors, hidden, elsewhere = (np.zeros((len(rows), draws, *more)) for more in ((3,), (), ()))
    azimuths = _AZIMUTHS_PLAN if settings.scanner.kind == "2D" else _AZIMUTHS_SPACE
    for draw in range(draws):
        rng = np.random.default_rng([seed, draw])
        city = truth if truth is not None else displaced(walls.walls, walls.sigma, rng, settings.common_sigma)
        scans = simulated_scans(WallObstacles.of(city), sensor, heading, settings.scanner, azimuths, rng)
        for number, scan in enumerate(scans):
            progress.step((draw + number / len(scans)) / draws)
            points = _on_walls(scan.offset, settings) if settings.matcher == "ICP" else scan.offset
            errors[number, draw] = match_error(points, sensor[number], maps[number], settings, rng)
            hidden[number, draw] = scan.hidden
            elsewhere[number, draw] = _fits_elsewhere(maps[number], scan.offset, sensor[number], settings)
    expected = accuracy.by_source["walls"][rows]
    free = undetermined_directions(plan_ellipses(expected), settings)
    return compared(rows, errors, hidden.mean(axis=1), elsewhere.mean(axis=1), accuracy,
                    ends_at_place(errors, expected), free == 0)


def ends_at_place(errors: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """(k, draws) whether errors (k, draws, 3), m, are those of scans that end where they were taken.

    That is within the two cells that `start_basins.share_elsewhere` takes for the place, or within three sigmas of the
    weakest direction of the expected covariances (k, 3, 3): these cut off 1 % of normal errors at most.
    """
    return np.hypot(errors[:, :, 0], errors[:, :, 1]) <= np.maximum(BESIDE, 3 * plan_ellipses(expected).major)[:, None]


def _fits_elsewhere(city: MatchingMap | LineMap, scan: np.ndarray, sensor: np.ndarray, settings: LocalisationSettings
                    ) -> bool:
    """Whether another place than its own has more of the probability of a scan."""
    most = int(settings.search / STEP)
    if most < 1:
        return False
    surface = city.field.shifted(sensor[:2] + _on_walls(scan, settings)[:, :2], most)
    return bool(alias_modes(EVIDENCE_OF_CELL * surface, APART).share.sum() > 0.5)


def _on_walls(scan: np.ndarray, settings: LocalisationSettings) -> np.ndarray:
    """Points (m, 3) of a scan above the road."""
    return scan[scan[:, 2] > -0.8 * settings.scanner.height]


def _maps(walls: WallMap, accuracy: AccuracyMap, rows: np.ndarray, settings: LocalisationSettings
          ) -> list[MatchingMap | LineMap]:
    field = field_of_walls(walls, accuracy.places, settings)
    if settings.matcher == "ICP":
        return [lines_of_walls(walls, field, settings)] * len(rows)
    if settings.scanner.kind == "2D":
        return [plan_matching_map(walls, field, settings)] * len(rows)
    return [space_matching_map(walls, field, settings, place[:2], place[2]) for place in accuracy.places.place[rows]]


def compared(rows: np.ndarray, errors: np.ndarray, hidden: np.ndarray, elsewhere: np.ndarray, accuracy: AccuracyMap,
             converged: np.ndarray | None = None, determined: np.ndarray | None = None, source: str = "walls"
             ) -> PredictionCheck:
    """Observed errors (k, draws, 3) at rows of a map of accuracy against its prediction by a source.

    `converged` : (k, draws), by default all; `determined` : (k,), by default what the map says of all sources together.
    """
    converged = np.ones(errors.shape[:2], bool) if converged is None else converged
    determined = accuracy.undetermined[rows] == 0 if determined is None else determined
    expected = accuracy.by_source[source][rows]
    heading = accuracy.places.heading[rows]
    square = np.einsum("kdi,kdj->kij", errors, errors) / errors.shape[1]
    distance = np.einsum("kdi,kij,kdj->kd", errors[:, :, :2], np.linalg.inv(expected[:, :2, :2]), errors[:, :, :2])
    fits = distance <= ELLIPSE_95
    within = fits.mean(axis=1)
    observed, predicted = (np.sqrt(np.trace(each[:, :2, :2], axis1=1, axis2=2)) for each in (square, expected))
    parts = [np.column_stack([*along_and_across(each, heading), np.degrees(np.sqrt(each[:, 2, 2]))])
             for each in (square, expected)]
    street = accuracy.places.street[rows]
    ranks = [rank_agreement(observed[street == each], predicted[street == each]) for each in np.unique(street)
             if (street == each).sum() >= 8]
    return PredictionCheck(rows, errors, observed, predicted, *parts, within, hidden, elsewhere,
                           rank_agreement(observed, predicted), float(np.median(ranks)) if ranks else np.nan,
                           float(within.mean()) if len(rows) else np.nan,
                           *_of_converged(errors, fits, converged, determined, predicted, accuracy.elsewhere[rows]))


def _of_converged(errors: np.ndarray, fits: np.ndarray, converged: np.ndarray, determined: np.ndarray,
                  predicted: np.ndarray, chance: np.ndarray) -> tuple:
    """The last five figures of a `PredictionCheck`; `chance` (k,) that scans end elsewhere, as predicted."""
    counted = converged & determined[:, None]
    square = np.where(counted, (errors[:, :, :2] ** 2).sum(axis=2), 0.0).sum(axis=1)
    some = counted.any(axis=1)
    observed = np.sqrt(square[some] / counted[some].sum(axis=1))
    chance = np.broadcast_to(chance[:, None], converged.shape)
    known = determined[:, None] & np.isfinite(chance)
    return (converged, determined, rank_agreement(observed, predicted[some]),
            float(fits[counted].mean()) if counted.any() else np.nan,
            area_under_roc(chance[known], ~converged[known]))


def area_under_roc(score: np.ndarray, event: np.ndarray) -> float:
    """Probability that an event (n,) bool has a higher score (n,) than what is none; NaN without both."""
    events = int(event.sum())
    others = len(event) - events
    if not events or not others:
        return float("nan")
    return float((rankdata(score)[event].sum() - events * (events + 1) / 2) / (events * others))


def rank_agreement(one: np.ndarray, other: np.ndarray) -> float:
    """Spearman's rank correlation; NaN for fewer than three values or where one side does not vary."""
    if len(one) < 3 or np.ptp(one) == 0 or np.ptp(other) == 0:
        return float("nan")
    return float(np.corrcoef(rankdata(one), rankdata(other))[0, 1])
