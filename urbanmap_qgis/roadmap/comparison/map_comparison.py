"""Two lane maps of one place compared."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...errors import InputError
from ...progress import SILENT, Progress
from ...settings.roadmap import ComparisonSettings
from ...wording import mark, say
from .area_changes import (
    REACH,
    PairDifferences,
    element_frames,
    element_pairs,
    pair_differences,
    paired_changes,
    single_changes,
)
from .comparison_records import ADDED, OFFSET, REMOVED, MapChange, MapComparison, MapNoise, MapOffset
from .cross_sections import LineMatches, LineSamples, line_matches, line_samples
from .difference_noise import FEWEST, FLOOR, SIGMAS, estimated_noise
from .line_changes import missing_changes, missing_lines, moved_lines, repainted_lines
from .map_elements import LINE, STOP_LINE, MapElement
from .map_offset import coarse_offset, line_blocks, robust_offset

ROUNDS = 3
"""The offset is found again with the matches that it gives, so many times."""

APART = 15.0
"""Maps of which nothing lies so near to the other do not overlap, m."""

DEFAULTS = ComparisonSettings()

PER_LINE = 5.0
"""Blocks of a line that count as one independent difference, at most."""


def compare_maps(old: Sequence[MapElement], new: Sequence[MapElement],
                 settings: ComparisonSettings = DEFAULTS, area: shapely.Geometry | None = None,
                 progress: Progress = SILENT) -> MapComparison:
    """Moved, added, removed and repainted elements of a new map against an old one, both in one projected CRS.

    Parameters
    ----------
    area : which both maps show; None takes it from the lines of each.

    Raises
    ------
    InputError : a map has no lines, or the maps do not overlap.
    """
    old_lines, new_lines = ([one for one in elements if one.element == LINE] for elements in (old, new))
    _refuse(old_lines, new_lines)
    samples = line_samples(old_lines)
    offset = _offset(old, new, samples, new_lines, settings, progress.part(0.0, 0.6))
    taken = np.array([offset.east, offset.north]) if offset.significant else np.zeros(2)
    shifted = [replace(one, points=one.points - taken) for one in new]
    lines = [one for one in shifted if one.element == LINE]
    matches = line_matches(samples, old_lines, lines, settings.reach)
    progress.step(0.7)
    new_samples = line_samples(lines)
    back = line_matches(new_samples, lines, old_lines, settings.reach)
    bend = np.hypot(samples.bend, new_samples.bend[cKDTree(new_samples.places).query(samples.places)[1]])
    noises = _noises(old, shifted, samples, matches, old_lines, lines, bend, settings)
    moved, shifts, blind = moved_lines(samples, matches, old_lines, lines, noises[LINE], bend, settings, taken)
    painted, repaints = repainted_lines(samples, matches, old_lines, lines, settings, taken)
    gone, beyond_old = missing_lines(samples, matches, old_lines, lines, area)
    come, beyond_new = missing_lines(new_samples, back, lines, old_lines, area)
    changes = [*_whole(offset), *moved, *painted,
               *missing_changes(ADDED, new_samples, come, lines, settings, taken),
               *missing_changes(REMOVED, samples, gone, old_lines, settings, taken)]
    counts = {}
    for element in REACH:
        found, counts[element] = _thing_changes(element, old, shifted, (old_lines, lines), noises, settings, area,
                                                taken)
        changes += found
    weights, new_weights = _lengths(samples, old_lines), _lengths(new_samples, lines)
    unjudged = (matches.other >= 0) & ~shifts & ~repaints & blind
    unchanged = (matches.other >= 0) & ~shifts & ~repaints & ~blind
    return MapComparison(changes, offset, noises, float(weights[~beyond_old].sum()), float(weights[unchanged].sum()),
                         float(weights[unjudged].sum()), float(weights[beyond_old].sum()),
                         float(new_weights[beyond_new].sum()), counts)


def _refuse(old: Sequence[MapElement], new: Sequence[MapElement]) -> None:
    for lines, text in ((old, say("The old map has no lines to compare.")),
                        (new, say("The new map has no lines to compare."))):
        if not lines:
            raise InputError(text + " " + say("Give a map with marking lines, road borders or other bounds on the "
                                              "ground; virtual ones are not compared."))
    shapes = [np.array([line.plan for line in lines], object) for lines in (old, new)]
    if not len(shapely.STRtree(shapes[0]).query(shapes[1], predicate="dwithin", distance=APART)[0]):
        extents = [", ".join(f"{value:.0f}" for value in shapely.total_bounds(one)) for one in shapes]
        raise InputError(say("The maps do not overlap: the old one lies within {old}, the new one within {new} (x and "
                             "y from, x and y to, m). Check that both are of one place and in one coordinate "
                             "reference system.", old=extents[0], new=extents[1]))


def _offset(old, new, samples: LineSamples, new_lines, settings: ComparisonSettings, progress: Progress) -> MapOffset:
    """The offset of the new map; directions that lines do not show are taken from stop lines, crosswalks, symbols."""
    old_lines = [one for one in old if one.element == LINE]
    estimate = coarse_offset(samples.places, line_samples(new_lines).places)
    found = MapOffset()
    for number in range(ROUNDS):
        shifted = [replace(one, points=one.points - estimate) for one in new]
        matches = line_matches(samples, old_lines, [one for one in shifted if one.element == LINE], settings.reach)
        _, across, normals, pairs = line_blocks(samples, matches)
        _, line, count = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
        rows, values, single = [normals], [across + normals @ estimate], 0
        for element in REACH:
            things = _thing_differences(element, old, shifted)
            directions = 1 if element == STOP_LINE else 2
            rows.append(things.axes[:, :directions].reshape(-1, 2))
            values.append(things.middles[:, :directions].reshape(-1) + rows[-1] @ estimate)
            single += len(values[-1])
        share = np.r_[1.0 / count[line.reshape(-1)], np.ones(single)]
        found = robust_offset(np.vstack(rows), np.concatenate(values), share, _independent(pairs) + single)
        estimate = np.array([found.east, found.north])
        progress.step((number + 1) / ROUNDS)
    return found


def _independent(pairs: np.ndarray) -> float:
    """How many independent differences blocks of pairs of lines give."""
    return max(float(len(np.unique(pairs, axis=0))), len(pairs) / PER_LINE)


def _thing_differences(element: str, old, new) -> PairDifferences:
    """Differences of elements of a kind."""
    before, after = ([one for one in elements if one.element == element] for elements in (old, new))
    frames = element_frames(before), element_frames(after)
    return pair_differences(*frames, element_pairs(*frames, REACH[element]))


def _noises(old, new, samples: LineSamples, matches: LineMatches, old_lines, lines, bend: np.ndarray,
            settings: ComparisonSettings) -> dict[str, MapNoise]:
    """Noise by kind of element; of stop lines, crosswalks and symbols along and across."""
    given = settings.old_sigma, settings.new_sigma
    middle, across, _, pairs = line_blocks(samples, matches)
    stated = [np.array([one.sigma for one in part])[pairs[:, k]] for k, part in enumerate((old_lines, lines))]
    noise = estimated_noise(across, *stated, bend[middle], given, _independent(pairs)) if len(across) else None
    noises = {LINE: noise or MapNoise(np.nan, np.nan, 1.0, SIGMAS, len(across), "unknown")}
    pooled, by_element = [], {}
    for element in REACH:
        things = _thing_differences(element, old, new)
        differences, pairs = things.middles, things.pairs
        sigmas = [np.array([one.sigma for one in part if one.element == element])[pairs[:, k]]
                  for k, part in enumerate((old, new))]
        pooled.append(differences.reshape(-1))
        for k, word in enumerate((mark("along"), mark("across"))):
            stated = sigmas if k == 0 or element != STOP_LINE else [np.full(len(pairs), np.nan)] * 2
            by_element[f"{element}, {word}"] = estimated_noise(differences[:, k], *stated, np.zeros(len(pairs)), given,
                                                               len(pairs)) if len(pairs) else None
    together = np.concatenate(pooled)
    unknown = np.full(len(together), np.nan)
    rest = estimated_noise(together, unknown, unknown, np.zeros(len(together)), (np.nan, np.nan), len(together) / 2)
    if rest is None:
        value = np.sqrt((noises[LINE].factor * np.nanmedian(_totals(noises[LINE], old_lines, lines))) ** 2 / 2)
        rest = MapNoise(value, value, 1.0, noises[LINE].limit, len(together), "all elements")
    rest = replace(rest, source="all elements")
    return noises | {name: one or rest for name, one in by_element.items()}


def _totals(noise: MapNoise, old_lines, lines) -> np.ndarray:
    """Typical sigma of differences between lines, m."""
    spread = [np.median(np.where(np.isfinite(stated), stated, value)) for stated, value in (
        (np.array([one.sigma for one in old_lines]), noise.old), (np.array([one.sigma for one in lines]), noise.new))]
    return np.array([np.hypot(*spread)])


def _thing_changes(element: str, old, new, lines, noises, settings: ComparisonSettings, area,
                   taken: np.ndarray) -> tuple[list[MapChange], int]:
    """Changes of stop lines, crosswalks or symbols, and how many are in both maps."""
    before, after = ([one for one in elements if one.element == element] for elements in (old, new))
    things = _thing_differences(element, old, new)
    pairs = things.pairs
    changes = paired_changes(before, after, things,
                             (noises[f"{element}, along"], noises[f"{element}, across"]), settings, taken)
    changes += single_changes(ADDED, after, element_frames(after), pairs[:, 1], lines[0], area, taken)
    changes += single_changes(REMOVED, before, element_frames(before), pairs[:, 0], lines[1], area, taken)
    return changes, len(pairs)


def _lengths(samples: LineSamples, lines: Sequence[MapElement]) -> np.ndarray:
    """Length that each sample stands for, m."""
    lengths = np.array([line.plan.length for line in lines])
    return (lengths / np.bincount(samples.line, minlength=len(lengths)))[samples.line]


def _whole(offset: MapOffset) -> list[MapChange]:
    """The offset as a change of the whole map."""
    if not offset.significant:
        return []
    shift = np.array([offset.east, offset.north])
    sigmas = np.nan_to_num([offset.sigma_east, offset.sigma_north])
    sigma = float(np.sqrt(np.sum((shift * sigmas) ** 2)) / np.hypot(*shift))
    return [MapChange(OFFSET, "", "", "", np.empty((0, 2)), np.nan, offset.east, offset.north, sigma=sigma,
                      significance=float(np.hypot(*shift) / max(sigma, FLOOR / FEWEST)))]
