"""The map of localisation accuracy: what is to be expected at each place of a road from the map alone (J 6.2)."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..progress import SILENT, Progress
from .accuracy_records import SOURCES, AccuracyMap, LocalisationMap, joined_blocks
from .block_evidence import BlockEvidence, block_evidence
from .ellipses import along_and_across, plan_ellipses
from .localisation_settings import LocalisationSettings
from .map_aliases import EVIDENCE_OF_CELL, NO_ALIAS, STEP, AliasModes, alias_modes
from .places.place_checks import refusals
from .places.place_status import SourceSigns, place_classes, place_words, undetermined_directions
from .places.road_places import RoadPlaces
from .prepared_map import PreparedMap, prepared_map
from .start_basins import share_elsewhere

BLOCK = 250
"""Places worked on at once: bounds the memory."""

APART = 3.0
"""Another place is farther away than this, m."""


def accuracy_map(city: LocalisationMap, places: RoadPlaces, settings: LocalisationSettings,
                 progress: Progress = SILENT) -> AccuracyMap:
    """Predict how accurately vehicles know their place.

    Places without evidence have NaN and a status with the reason, never a small sigma.
    """
    prepared = prepared_map(city, places, settings)
    blocks = []
    for begin in range(0, len(places), BLOCK):
        progress.step(begin / len(places))
        blocks.append(_block(city, places.select(slice(begin, begin + BLOCK)), prepared, settings))
    progress.step(1.0)
    return joined_blocks(blocks)


def _block(city: LocalisationMap, places: RoadPlaces, prepared: PreparedMap, settings: LocalisationSettings
           ) -> AccuracyMap:
    """Accuracy at some of the places."""
    places, refused = refusals(city, places, settings)
    evidence = block_evidence(city, places, np.flatnonzero(refused == ""), prepared, settings)
    modes, elsewhere = _aliases(evidence, prepared, city)
    return _described(city, evidence, refused, modes, elsewhere)


def _aliases(evidence: BlockEvidence, prepared: PreparedMap, city: LocalisationMap
             ) -> tuple[list[AliasModes], np.ndarray]:
    """Other places that look like each place, and the share of searches (n,) that end beside it."""
    modes, scan, seen = [NO_ALIAS] * len(evidence.places), evidence.scan, evidence.seen
    elsewhere = np.full(len(modes), np.nan)
    most = int(evidence.settings.search / STEP)
    if most < 1:
        return modes, elsewhere
    sensor = evidence.sensor
    ends = np.searchsorted(scan.of, np.arange(len(evidence.able) + 1)) if scan is not None else None
    for number, row in enumerate(evidence.able):
        surface = np.zeros((2 * most + 1, 2 * most + 1))
        if scan is not None:
            of_place = slice(ends[number], ends[number + 1])
            surface += prepared.wall_field.shifted(sensor[number, :2] + scan.offset[of_place], most)
        if seen is not None:
            surface += prepared.marking_field.shifted(city.markings.xy[seen[1][seen[0] == number]], most)
        if surface.any():
            modes[row] = alias_modes(EVIDENCE_OF_CELL * surface, APART)
            elsewhere[row] = share_elsewhere(surface, evidence.settings.start_sigma)
    return modes, elsewhere


def _described(city: LocalisationMap, evidence: BlockEvidence, refused: np.ndarray, modes: list[AliasModes],
               elsewhere: np.ndarray) -> AccuracyMap:
    """The evidence as standard deviations, ellipses, classes and words."""
    places, settings, by_source, figures = evidence.places, evidence.settings, evidence.by_source, evidence.figures
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
    together, free = sigma["together"], undetermined_directions(ellipse, settings)
    return AccuracyMap(places, sigma, by_source["together"], by_source, ellipse, shift, share, tuple(modes),
                       np.where(free == 0, elsewhere, np.nan), free,
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


