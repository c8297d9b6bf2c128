"""The map of localisation accuracy: what is to be expected at each place of a road from the map alone (J 6.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..progress import SILENT, Progress
from ..wording import mark
from .ellipses import PlanEllipse, along_and_across, plan_ellipses
from .evidence.information import covariance, fused
from .evidence.marking_map import MarkingMap, marking_evidence, visible_markings
from .evidence.satellite_evidence import SkyTimes, satellite_plan
from .evidence.wall_evidence import representation, walls_covariance
from .localisation_settings import LocalisationSettings
from .map_aliases import EVIDENCE_OF_CELL, NO_ALIAS, STEP, AliasModes, ScoreField, alias_modes
from .places.place_checks import refusals, sky_covered
from .places.place_status import SourceSigns, place_classes, place_words
from .places.road_places import RoadPlaces
from .walls.clutter import clutter_patterns
from .walls.wall_cells import PlanWallCells, pieces_at_height, wall_plan_cells, wall_points
from .walls.wall_map import WallMap
from .walls.wall_scan import AZIMUTHS, LAYERS, WallScan, scan_walls

BLOCK = 250
"""Places worked on at once: bounds the memory."""

SOURCES = (mark("walls"), mark("markings"), mark("satellites"), mark("together"))

_FIGURES = ("points", "walls", "covered", "sky_covered", "cell_rms", "two_surfaces", "satellites", "dilution",
            "samples", "other_level")

APART = 3.0
"""Another place is farther away than this, m."""


@dataclass(frozen=True)
class LocalisationMap:
    """What vehicles have on board.

    Attributes
    ----------
    walls : None where no buildings are used.
    markings : None likewise.
    sky : None without satellites.
    without_height : (k, 2) middles of buildings that have no heights and are left out, m.
    """

    walls: WallMap | None
    markings: MarkingMap | None = None
    sky: SkyTimes | None = None
    without_height: np.ndarray | None = None


@dataclass(frozen=True)
class AccuracyMap:
    """Predicted accuracy at n places.

    Attributes
    ----------
    places : with the heights that were used.
    sigma : by source ("walls", "markings", "satellites", "together"), (n, 3) standard deviations along and across the
        heading, m, and of the heading, degrees; NaN where the source tells nothing.
    covariance : (n, 3, 3) together, east, north (m2), turn (rad2).
    by_source : the same for each source.
    ellipse : of the plan, together.
    alias_shift : (n, 2) m to the likeliest other place, NaN without one.
    alias_share : (n,) probability of others.
    modes : for each place its other modes.
    points, walls : (n,) rays on walls and number of walls seen.
    covered : (n,) share of the horizon with a wall in range.
    sky_covered : (n,) share of the sky hidden by buildings.
    cell_rms : (n,) m.
    two_surfaces : (n,) share. See `wall_evidence.representation`.
    satellites, dilution : (n,) in line of sight, PDOP; NaN where not asked for.
    kind : (n,) class.
    status : (n,) in words.
    """

    places: RoadPlaces
    sigma: dict[str, np.ndarray]
    covariance: np.ndarray
    by_source: dict[str, np.ndarray]
    ellipse: PlanEllipse
    alias_shift: np.ndarray
    alias_share: np.ndarray
    modes: tuple[AliasModes, ...]
    points: np.ndarray
    walls: np.ndarray
    covered: np.ndarray
    sky_covered: np.ndarray
    cell_rms: np.ndarray
    two_surfaces: np.ndarray
    satellites: np.ndarray
    dilution: np.ndarray
    kind: np.ndarray
    status: np.ndarray


@dataclass(frozen=True)
class _Prepared:
    """What all blocks share."""

    cells: PlanWallCells | None
    patterns: np.ndarray | None
    wall_field: ScoreField | None
    marking_field: ScoreField | None
    marking_tree: cKDTree | None


def accuracy_map(city: LocalisationMap, places: RoadPlaces, settings: LocalisationSettings,
                 progress: Progress = SILENT) -> AccuracyMap:
    """Predict how accurately vehicles know their place.

    Places without evidence have NaN and a status with the reason, never a small sigma.
    """
    prepared = _prepared(city, places, settings)
    blocks = []
    for begin in range(0, len(places), BLOCK):
        progress.step(begin / len(places))
        blocks.append(_block(city, places.select(slice(begin, begin + BLOCK)), prepared, settings))
    progress.step(1.0)
    return _joined(blocks)


def field_of_walls(walls: WallMap, places: RoadPlaces, settings: LocalisationSettings) -> ScoreField:
    """Score of the walls around places, for shifts within the search and of the start."""
    points, _ = wall_points(walls.walls, pieces_at_height(walls.walls, settings.scanner.height))
    return ScoreField.of(points, _bounds(places, settings), max(float(np.median(walls.sigma)), STEP))


def _bounds(places: RoadPlaces, settings: LocalisationSettings) -> tuple[float, float, float, float]:
    reach = max(settings.scanner.max_range, settings.marking_range) + max(settings.search, 6 * settings.start_sigma)
    low, high = (end + side * (reach + 5.0) for end, side in ((places.place[:, :2].min(axis=0), -1),
                                                              (places.place[:, :2].max(axis=0), 1)))
    return (*low.tolist(), *high.tolist())


def _prepared(city: LocalisationMap, places: RoadPlaces, settings: LocalisationSettings) -> _Prepared:
    cells = patterns = wall_field = marking_field = tree = None
    if city.walls is not None:
        cells = wall_plan_cells(city.walls, settings.cell, settings.scanner.height)
        patterns = clutter_patterns(settings.scanner, settings.scanner.elevations(LAYERS), AZIMUTHS)
        if settings.search > 0:
            wall_field = field_of_walls(city.walls, places, settings)
    if city.markings is not None:
        tree = cKDTree(city.markings.xy)
        if settings.search > 0:
            marking_field = ScoreField.of(city.markings.xy, _bounds(places, settings), STEP / 2)
    return _Prepared(cells, patterns, wall_field, marking_field, tree)


def _block(city: LocalisationMap, places: RoadPlaces, prepared: _Prepared, settings: LocalisationSettings
           ) -> AccuracyMap:
    count = len(places)
    places, refused = refusals(city, places, settings)
    able = np.flatnonzero(refused == "")
    sensor = np.nan_to_num(places.place[able]) + np.array([0.0, 0.0, settings.scanner.height])
    by_source = {name: np.full((count, 3, 3), np.nan) for name in SOURCES}
    figures = {name: np.full(count, np.nan) for name in _FIGURES}
    scan = seen = None
    if city.walls is not None and len(able):
        scan = scan_walls(city.walls, sensor, settings.scanner)
        by_source["walls"][able] = walls_covariance(city.walls, scan, sensor, places.heading[able], prepared.cells,
                                                    prepared.patterns, settings)
        _wall_figures(city.walls, scan, sensor, able, prepared.cells, by_source, figures, settings)
    if city.markings is not None and len(able):
        seen = visible_markings(city.markings, prepared.marking_tree, places.place[able], places.heading[able], scan,
                                settings)
        rows = marking_evidence(city.markings, *seen[:2], places.place[able], settings)
        _put(by_source["markings"], able, rows, settings)
        figures["samples"][able] = np.bincount(seen[0], minlength=len(able))
        figures["other_level"][able] = seen[2]
    if city.sky is not None and city.walls is not None and len(able):
        _satellites(city, places.select(able), sensor, able, by_source, figures, settings)
    _together(by_source, settings.prior())
    modes = _aliases(prepared, places, sensor, able, scan, seen, city, settings)
    return _described(city, places, refused, by_source, figures, modes, settings)


def _wall_figures(walls: WallMap, scan: WallScan, sensor: np.ndarray, able: np.ndarray, cells: PlanWallCells,
                  by_source: dict, figures: dict, settings: LocalisationSettings) -> None:
    figures["points"][able] = np.bincount(scan.of, scan.weight * (1 - settings.scanner.hidden), len(able))
    figures["walls"][able] = _different_walls(walls, scan, len(able))
    figures["covered"][able] = scan.covered
    figures["sky_covered"][able] = sky_covered(walls, sensor)
    figures["cell_rms"][able], figures["two_surfaces"][able] = representation(walls, scan, sensor, cells, len(able))
    by_source["walls"][able[figures["points"][able] < settings.min_points]] = np.nan


def _together(by_source: dict, prior: np.ndarray) -> None:
    """All sources in one; of the satellites' positions the heading is what it was before."""
    parts = [by_source["walls"], by_source["markings"]]
    fixed = np.isfinite(by_source["satellites"][:, 0, 0])
    gained = np.zeros((len(fixed), 3, 3))
    gained[fixed, :2, :2] = np.linalg.inv(by_source["satellites"][fixed, :2, :2])
    some = np.isfinite(np.stack([part[:, 0, 0] for part in parts])).any(axis=0) | fixed
    parts = [np.where(np.isfinite(part), part, np.linalg.inv(prior)) for part in parts]
    by_source["together"][some] = fused([*parts, np.linalg.inv(gained + prior)], prior)[some]


def _put(target: np.ndarray, able: np.ndarray, rows, settings: LocalisationSettings) -> None:
    """Write the covariances of the places that have evidence at all."""
    covariances = covariance(rows, len(able), settings.prior())
    has = np.bincount(rows.of, minlength=len(able)) > 0
    target[able[has]] = covariances[has]


def _different_walls(walls: WallMap, scan: WallScan, count: int) -> np.ndarray:
    pairs = np.unique(scan.of * walls.walls.count + walls.walls.wall[scan.piece])
    return np.bincount(pairs // walls.walls.count, minlength=count)


def _satellites(city: LocalisationMap, places: RoadPlaces, antenna: np.ndarray, able: np.ndarray, by_source: dict,
                figures: dict, settings: LocalisationSettings) -> None:
    found = satellite_plan(city.walls, antenna, city.sky.with_times(places.time), settings)
    figures["satellites"][able], figures["dilution"][able] = found.satellites, found.dilution
    by_source["satellites"][able, :2, :2] = found.covariance


def _aliases(prepared: _Prepared, places: RoadPlaces, sensor: np.ndarray, able: np.ndarray, scan: WallScan | None, seen,
             city: LocalisationMap, settings: LocalisationSettings) -> list[AliasModes]:
    modes = [NO_ALIAS] * len(places)
    most = int(settings.search / STEP)
    if most < 1:
        return modes
    ends = np.searchsorted(scan.of, np.arange(len(able) + 1)) if scan is not None else None
    for number, row in enumerate(able):
        surface = np.zeros((2 * most + 1, 2 * most + 1))
        if scan is not None:
            of_place = slice(ends[number], ends[number + 1])
            surface += prepared.wall_field.shifted(sensor[number, :2] + scan.offset[of_place, :2], most)
        if seen is not None:
            surface += prepared.marking_field.shifted(city.markings.xy[seen[1][seen[0] == number]], most)
        if surface.any():
            modes[row] = alias_modes(EVIDENCE_OF_CELL * surface, APART)
    return modes


def _described(city: LocalisationMap, places: RoadPlaces, refused: np.ndarray, by_source: dict, figures: dict, modes,
               settings: LocalisationSettings) -> AccuracyMap:
    count = len(places)
    sigma = {}
    for name in SOURCES:
        along, across = along_and_across(by_source[name], places.heading)
        sigma[name] = np.column_stack([along, across, np.degrees(np.sqrt(by_source[name][:, 2, 2]))])
    ellipse = plan_ellipses(by_source["together"])
    # A place of which nothing can be said looks like no other.
    known = np.isfinite(ellipse.major)
    modes = [mode if known[row] else NO_ALIAS for row, mode in enumerate(modes)]
    share = np.array([mode.share.sum() for mode in modes]) if count else np.zeros(0)
    shift = np.array([mode.shift[0] if len(mode.share) else (np.nan, np.nan) for mode in modes]).reshape(count, 2)
    left = _left_out(city, places, settings)
    signs = SourceSigns(refused, np.nan_to_num(figures["points"]), np.nan_to_num(figures["walls"]), left,
                        city.walls is not None, city.markings is not None, city.sky is not None,
                        np.nan_to_num(figures["samples"]), np.nan_to_num(figures["other_level"]) > 0,
                        np.isfinite(by_source["satellites"][:, 0, 0]), share,
                        np.hypot(*shift.T))
    together = sigma["together"]
    return AccuracyMap(places, sigma, by_source["together"], by_source, ellipse, shift, share, tuple(modes),
                       figures["points"], figures["walls"], figures["covered"], figures["sky_covered"],
                       figures["cell_rms"], figures["two_surfaces"], figures["satellites"], figures["dilution"],
                       place_classes(ellipse, signs, settings),
                       place_words(together[:, 0], together[:, 1], signs, settings))


def _left_out(city: LocalisationMap, places: RoadPlaces, settings: LocalisationSettings) -> np.ndarray:
    """(n,) number of buildings without heights within range."""
    if city.without_height is None or not len(city.without_height):
        return np.zeros(len(places), int)
    return cKDTree(city.without_height).query_ball_point(places.place[:, :2], settings.scanner.max_range,
                                                         return_length=True)


def _joined(blocks: list[AccuracyMap]) -> AccuracyMap:
    def together(name: str):
        values = [getattr(block, name) for block in blocks]
        if isinstance(values[0], dict):
            return {key: np.concatenate([value[key] for value in values]) for key in values[0]}
        if isinstance(values[0], tuple):
            return tuple(item for value in values for item in value)
        if isinstance(values[0], np.ndarray):
            return np.concatenate(values)
        return type(values[0])(*(np.concatenate([getattr(value, field) for value in values])
                                 for field in type(values[0]).__dataclass_fields__))

    return AccuracyMap(*(together(name) for name in AccuracyMap.__dataclass_fields__))
