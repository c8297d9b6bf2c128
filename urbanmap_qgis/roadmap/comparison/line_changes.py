"""Changes of lines: stretches that moved, came, went, or were painted otherwise."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from scipy.ndimage import median_filter

from ...settings.roadmap import ComparisonSettings
from .comparison_records import ADDED, MOVED, REPAINTED, MapChange, MapNoise
from .cross_sections import STEP, LineMatches, LineSamples, crossings
from .difference_noise import difference_sigma
from .map_elements import LINE, MapElement

SMOOTH = 5.0  # A shift is the median over so much of the line, m.
TWIN = 0.10  # Lines so near to each other are one that is drawn twice, m.
DOUBLE = 0.60  # A line so near to a double one may be half of it, m.
COVER = 15.0  # A map shows a road where it has a line of its course so near, m.
SHARE = 0.8  # Of lines shorter than what is told, a change of this share is told.


def missing_lines(samples: LineSamples, matches: LineMatches, first: Sequence[MapElement], other: Sequence[MapElement],
                  area: shapely.Geometry | None) -> tuple[np.ndarray, np.ndarray]:
    """Samples (mask) that the other map lacks, and those that it lacks where it shows no road.

    Parameters
    ----------
    area : which both maps show; None takes where there is another line of about the same course.
    """
    lacking = (matches.other < 0) & (matches.nearest > TWIN) & (matches.doubled > TWIN)
    half = np.array([bool(one.double) for one in other])
    single = np.array([not one.double for one in first])
    at = np.flatnonzero(lacking)
    if half.any():
        sample, line, _ = crossings(samples.of(at), other, DOUBLE)
        beside = np.unique(sample[half[line]])
        lacking[at[beside[single[samples.line[at[beside]]]]]] = False
        at = np.flatnonzero(lacking)
    if area is None:
        shown = np.isin(np.arange(len(at)), crossings(samples.of(at), other, COVER)[0])
    else:
        shown = shapely.contains_xy(area, *samples.places[at].T)
    outside = np.zeros(len(lacking), bool)
    outside[at[~shown]] = True
    return lacking & ~outside, outside


def missing_changes(kind: str, samples: LineSamples, mask: np.ndarray, lines: Sequence[MapElement],
                    settings: ComparisonSettings, offset: np.ndarray) -> list[MapChange]:
    """Changes of kind `ADDED` or `REMOVED` where samples of one map are lacking in the other."""
    changes = []
    for run in told_runs(mask, samples, lines, settings):
        line = lines[samples.line[run[0]]]
        names = ("", line.words) if kind == ADDED else (line.words, "")
        ids = {"new_id" if kind == ADDED else "old_id": line.identifier}
        changes.append(MapChange(kind, LINE, *names, _stretch(samples, run) + (offset if kind == ADDED else 0.0),
                                 _length(samples, run, line), **ids))
    return changes


def moved_lines(samples: LineSamples, matches: LineMatches, old: Sequence[MapElement], new: Sequence[MapElement],
                noise: MapNoise, bend: np.ndarray, settings: ComparisonSettings,
                offset: np.ndarray) -> tuple[list[MapChange], np.ndarray, np.ndarray]:
    """Stretches that moved, the mask of their samples, and that of samples of which nothing can be said: where not even
    a shift as long as is looked for would be significant.

    Parameters
    ----------
    bend : (n,) what the points of both lines leave open, m.
    """
    sigma = difference_sigma(noise, np.array([one.sigma for one in old])[samples.line],
                             np.append([one.sigma for one in new], np.nan)[matches.other], bend)
    shift = np.full(len(bend), np.nan)
    for run in runs_of(matches.other >= 0, samples.line):
        shift[run] = median_filter(matches.across[run], max(int(SMOOTH / STEP) | 1, 1), mode="nearest")
    large = np.abs(shift) > np.maximum(noise.limit * sigma, settings.least_shift)
    changes, moved = [], np.zeros(len(bend), bool)
    for side in (1.0, -1.0):
        for run in told_runs(large & (side * shift > 0), samples, old, settings):
            line = old[samples.line[run[0]]]
            across, spread = float(np.mean(shift[run])), float(np.sqrt(np.mean(sigma[run] ** 2)))
            east, north = across * _mean_course(samples.normals[run])
            other = new[matches.other[run[len(run) // 2]]]
            places = _stretch(samples, run, np.nan_to_num(shift)[:, None] * samples.normals) + offset
            changes.append(MapChange(MOVED, LINE, line.words, other.words, places, _length(samples, run, line), east,
                                     north, np.nan, across, spread, float(np.mean(np.abs(shift[run]) / sigma[run])),
                                     line.identifier, other.identifier))
            moved[run] = True
    return changes, moved, ~(noise.limit * sigma < settings.reach)


def repainted_lines(samples: LineSamples, matches: LineMatches, old: Sequence[MapElement], new: Sequence[MapElement],
                    settings: ComparisonSettings, offset: np.ndarray) -> tuple[list[MapChange], np.ndarray]:
    """Stretches that another kind or colour was painted on, and the mask of their samples."""
    words: dict[tuple[str, str], int] = {}
    code = np.full(len(samples.line), -1)
    for pair in np.unique(np.column_stack([samples.line, matches.other])[matches.other >= 0], axis=0):
        before, after = old[pair[0]], new[pair[1]]
        if _differ(before, after):
            number = words.setdefault((before.words, after.words), len(words))
            code[(samples.line == pair[0]) & (matches.other == pair[1])] = number
    changes, mask = [], np.zeros(len(code), bool)
    for (before, after), number in words.items():
        for run in told_runs(code == number, samples, old, settings):
            line, other = old[samples.line[run[0]]], new[matches.other[run[len(run) // 2]]]
            changes.append(MapChange(REPAINTED, LINE, before, after, _stretch(samples, run) + offset,
                                     _length(samples, run, line), old_id=line.identifier, new_id=other.identifier))
            mask[run] = True
    return changes, mask


def _differ(before: MapElement, after: MapElement) -> bool:
    """Whether kind, colour or the second line differ, each as far as both maps tell it."""
    pairs = ((before.kind, after.kind), (before.colour, after.colour))
    doubled = before.double is not None and after.double is not None and before.double != after.double
    return doubled or any(a and b and a != b for a, b in pairs)


def runs_of(mask: np.ndarray, line: np.ndarray) -> list[np.ndarray]:
    """Indices of samples in a row, of one line, where a mask holds."""
    at = np.flatnonzero(mask)
    if not len(at):
        return []
    return np.split(at, np.flatnonzero((np.diff(at) > 1) | (np.diff(line[at]) != 0)) + 1)


def told_runs(mask: np.ndarray, samples: LineSamples, lines: Sequence[MapElement],
              settings: ComparisonSettings) -> list[np.ndarray]:
    """Those that are long enough to be told."""
    return [run for run in runs_of(mask, samples.line)
            if _length(samples, run, lines[samples.line[run[0]]]) >= min(
                settings.least_length, SHARE * lines[samples.line[run[0]]].plan.length)]


def _length(samples: LineSamples, run: np.ndarray, line: MapElement) -> float:
    """Length of a run, m; the whole line's where all of its samples are in it."""
    whole = line.plan.length
    return len(run) * whole / max(int(np.ceil(whole / STEP)), 1)


def _stretch(samples: LineSamples, run: np.ndarray, shifts: np.ndarray | float = 0.0) -> np.ndarray:
    """Places (n, 2) along a run of samples, two at least, m."""
    places = (samples.places + shifts)[run]
    if len(places) > 1:
        return places
    ahead = np.column_stack([samples.normals[run, 1], -samples.normals[run, 0]])
    return np.vstack([places - ahead * STEP / 4, places + ahead * STEP / 4])


def _mean_course(normals: np.ndarray) -> np.ndarray:
    mean = normals.mean(axis=0)
    size = np.linalg.norm(mean)
    return mean / size if size > 0 else mean
