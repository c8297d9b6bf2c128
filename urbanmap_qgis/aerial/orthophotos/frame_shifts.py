"""How far overlapping frames disagree on the ground: shows a bad orientation before the mosaic is trusted.

Patches with road markings (bright and narrow) that two frames see are compared by phase correlation. What stands on the
ground is displaced along the base of the two frames by its height (parallax), and that says nothing of the orientation:
only patches count where the surface shows bare ground. Where no surface tells, only what heights cannot explain counts.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from scipy.spatial import cKDTree

from ...geometry.grid import Grid
from ...geometry.tolerances import SIGMA_OF_MAD
from ...progress import SILENT, Progress
from ...wording import say
from .mosaic import GroundView, ViewSource, reaching, tiles

PATCH = 64  # Pixels, side of the patches compared.
TILES = 8
NARROW = 11  # pixels: wider things are no markings
CONTRAST = 0.12  # of the brightest: what a marking stands out by at least
MIN_BRIGHT_SHARE = 0.01
CLEAR_PEAK = 0.3
MIN_PATCHES = 5
MIN_REACH = 1  # patches, east or north, that all of them span: a thing smaller than a patch is no evidence
LEVEL_SHARE = 0.95  # of a patch on which nothing stands
# pixels: with a known base, and of orthophotos, in which heights lean anyhow
LEAST_SHIFT = 0.5
LEAST_SHIFT_UNKNOWN = 1.0
HEIGHTS = (-2.0, 300.0)  # m: what stands anywhere above the ground, or lies below it
GROUND_SIGMA = 0.1  # m, of the ground's height, the same under all patches
MAX_WARNINGS = 5
# pixels, and share of the patches with markings in both images, within which shifts agree where these show the same
# ground: chance gives one in 140 of the places in a patch. Sound frames .9, off by 3 m still .36, turned ones .05
AGREEMENT = 3.0
ALIKE_SHARE = 0.2
OVERLAP = 4  # patches overlap by half in both directions: so many of them speak of the same ground

NOT_ALIKE, APART = "not alike", "apart"


@dataclass(frozen=True)
class FrameShift:
    """The second frame's ground relative to the first's.

    Attributes
    ----------
    first, second : names.
    places : (n, 2) x and y of the middles of the patches that spoke, in the grid's system.
    vectors : (n, 2) east and north shift of each, m.
    parallax : (2,) east and north shift of what stands 1 m high, m; None where unknown.
    on_ground : whether a surface shows bare ground in all the patches.
    alike : whether the patches' shifts agree with one another; the vectors are NaN where they do not: the images show
        different things at the same places.
    """

    first: str
    second: str
    places: np.ndarray
    vectors: np.ndarray
    parallax: np.ndarray | None = None
    on_ground: bool = False
    alike: bool = True

    @property
    def patches(self) -> int:
        """How many patches spoke."""
        return len(self.vectors)

    @property
    def east(self) -> float:
        """m, median over the patches."""
        return float(np.median(self.vectors[:, 0]))

    @property
    def north(self) -> float:
        """m, median over the patches."""
        return float(np.median(self.vectors[:, 1]))

    @property
    def length(self) -> float:
        """m, of the median shift."""
        return float(np.hypot(self.east, self.north))

    @property
    def spread(self) -> float:
        """Standard deviation of one patch in east and in north, m, from the median absolute deviation."""
        return float(SIGMA_OF_MAD * np.median(np.abs(self.vectors - np.median(self.vectors, axis=0))))

    @property
    def sigma(self) -> float:
        """Standard deviation of the median shift in east and in north, m; of overlapping patches a fourth counts."""
        return _sigma_of_median(self.spread, self.patches)

    @property
    def explained(self) -> bool:
        """Whether part of the shift may be the height of what the patches show, which nothing tells."""
        if self.parallax is None or self.on_ground:
            return False
        height = float(np.median(self.vectors @ self.parallax)) / float(self.parallax @ self.parallax)
        return HEIGHTS[0] <= height <= HEIGHTS[1]

    @property
    def unexplained(self) -> tuple[float, float]:
        """Length of the shift that no height explains, and its standard deviation, m: across the base of the frames
        where heights are unknown, else the whole, of which the ground's own height makes the part along less sure."""
        if not self.explained:
            if self.parallax is None or not self.length:
                return self.length, self.sigma
            along = abs(self.parallax @ (self.east, self.north)) / self.length
            return self.length, float(np.hypot(self.sigma, GROUND_SIGMA * along))
        east, north = self.parallax / np.hypot(*self.parallax)
        across = self.vectors @ (-north, east)
        middle = np.median(across)
        spread = SIGMA_OF_MAD * float(np.median(np.abs(across - middle)))
        return float(abs(middle)), _sigma_of_median(spread, self.patches)


def _sigma_of_median(spread: float, patches: int) -> float:
    return float(np.sqrt(np.pi / 2) * spread / np.sqrt(max(patches / OVERLAP, 1)))


def shift_columns(shifts: Sequence[FrameShift], pixel: float) -> dict[str, np.ndarray]:
    """One row a patch for a layer, with the patch's own shift and that of its pair of frames.

    Parameters
    ----------
    pixel : of the mosaic, m: see `status_of`.

    Returns
    -------
    x, y; first, second.
    east, north, length, sigma : of the patch, m.
    pair_east, pair_north, pair_length, pair_sigma, patches : of the pair.
    status : see `status_of`.
    """
    count = [shift.patches for shift in shifts]
    columns = {"x": np.concatenate([shift.places[:, 0] for shift in shifts] or [np.zeros(0)]),
               "y": np.concatenate([shift.places[:, 1] for shift in shifts] or [np.zeros(0)])}
    for name in ("first", "second"):
        columns[name] = np.repeat(np.array([getattr(shift, name) for shift in shifts], object), count)
    vectors = np.concatenate([shift.vectors for shift in shifts] or [np.zeros((0, 2))])
    columns.update(east=vectors[:, 0], north=vectors[:, 1], length=np.hypot(*vectors.T))
    for name, value in (("sigma", "spread"), ("pair_east", "east"), ("pair_north", "north"),
                        ("pair_length", "length"), ("pair_sigma", "sigma")):
        columns[name] = np.repeat(np.array([getattr(shift, value) for shift in shifts], float), count)
    columns["patches"] = np.repeat(np.array(count, np.int64), count)
    columns["status"] = np.repeat(np.array([status_of(shift, pixel) for shift in shifts], object), count)
    return columns


def lie_apart(shift: FrameShift, pixel: float) -> bool:
    """Whether two frames lie more than half a pixel (orthophotos: a pixel) apart on the markings, surely so (three
    sigma), and no height of what the patches show explains it."""
    return _surely(*shift.unexplained, shift, pixel)


def status_of(shift: FrameShift, pixel: float) -> str:
    """"not alike"; "apart"; "height" where a shift as large may come from the height of what the patches show; or
    "agree"."""
    if not shift.alike:
        return NOT_ALIKE
    if lie_apart(shift, pixel):
        return APART
    return "height" if shift.explained and _surely(shift.length, shift.sigma, shift, pixel) else "agree"


def _surely(length: float, sigma: float, shift: FrameShift, pixel: float) -> bool:
    least = LEAST_SHIFT_UNKNOWN if shift.parallax is None else LEAST_SHIFT
    return length > max(least * pixel, 3 * sigma)


def unlike_images(shifts: Sequence[FrameShift]) -> list[str]:
    """Names of the images that are unlike all those that they were compared with; of two such alone, both."""
    alike = {name for shift in shifts if shift.alike for name in (shift.first, shift.second)}
    return list(dict.fromkeys(name for shift in shifts if not shift.alike for name in (shift.first, shift.second)
                              if name not in alike))


def warn_of_shifts(shifts: Sequence[FrameShift], pixel: float, progress: Progress) -> None:
    """Warn of images that show other things than those beside them, then of the pairs that are apart, the worst first;
    say where heights hide whether they are."""
    unlike = unlike_images(shifts)
    if unlike:
        progress.warn(say("Images that show other things than those that overlap them: {names}. Check that each has "
                          "its own orientation, in the right unit, and is not turned or mirrored.",
                          names=", ".join(unlike)))
    bad = sorted((shift for shift in shifts if lie_apart(shift, pixel)), key=lambda shift: -shift.unexplained[0])
    for shift in bad[:MAX_WARNINGS]:
        progress.warn(say("{first} and {second} lie {unexplained:.2f} m apart on the road markings {value}(east "
                          "{east:.2f}, north {north:.2f}, sigma {unexplained_2:.2f}; {patches} places): check their "
                          "orientation and the ground.", first=shift.first, second=shift.second,
                          unexplained=shift.unexplained[0], value=say("across their base ") if shift.explained else "",
                          east=shift.east, north=shift.north, unexplained_2=shift.unexplained[1],
                          patches=shift.patches))
    if len(bad) > MAX_WARNINGS:
        progress.warn(say("{bad_count} more pairs of images lie apart.", bad_count=len(bad) - MAX_WARNINGS))
    hidden = sum(status_of(shift, pixel) == "height" for shift in shifts)
    if hidden:
        progress.message(say("In {hidden} pairs of images the shift may come from the height of what stands on the "
                             "ground: a surface (DSM) would tell, here only shifts across their base were checked.",
                             hidden=hidden))


def frame_shifts(sources: Sequence[ViewSource], grid: Grid, progress: Progress = SILENT,
                 metres: float = 1.0) -> list[FrameShift]:
    """Shifts between all pairs of sources that share at least five patches with markings, not all at one place, in the
    sources' order; of pairs that show different things there, too.

    Looks at a few pieces of the grid, spread evenly.

    Parameters
    ----------
    metres : in a unit of the grid.
    """
    pieces = list(tiles(grid))
    pieces = [pieces[k] for k in np.unique(np.linspace(0, len(pieces) - 1, min(TILES, len(pieces))).astype(int))]
    found: dict[tuple[int, int], list[np.ndarray]] = defaultdict(list)
    for done, (_, _, tile) in enumerate(pieces):
        progress.step(done / len(pieces))
        views = [(number, source.view(tile)) for number, source in reaching(sources, tile)]
        marked = [(number, view, _markings(view)) for number, view in views if view is not None]
        level = next((view.level for _, view, _ in marked if view.level is not None), None)
        for k, (first, view, markings) in enumerate(marked):
            for second, other, its_markings in marked[k + 1:]:
                patches = _patch_shifts(markings, its_markings, view.seen & other.seen, level)
                # From columns and rows of the tile to the ground.
                found[first, second].append(
                    patches * (tile.cell, -tile.cell, tile.cell * metres, -tile.cell * metres, 1.0, 1.0)
                    + (tile.x_min, tile.y_max, 0.0, 0.0, 0.0, 0.0))
    result = []
    for (first, second), parts in sorted(found.items()):
        patches = np.concatenate(parts)
        clear = patches[patches[:, 5] > 0]
        if not _enough(patches, grid):
            continue
        if _agreeing(clear[:, 2:4], AGREEMENT * grid.cell * metres) < ALIKE_SHARE * len(patches):
            nothing = np.full((len(patches), 2), np.nan)
            result.append(FrameShift(sources[first].name, sources[second].name, patches[:, :2], nothing, alike=False))
        elif _enough(clear, grid):
            result.append(_pair(sources[first], sources[second], clear, grid))
    return result


def _agreeing(vectors: np.ndarray, tolerance: float) -> int:
    """How many of the shifts (n, 2) lie within a tolerance of that one which most others lie near."""
    tree = cKDTree(vectors)
    return int(tree.query_ball_point(vectors, tolerance, return_length=True).max(initial=0))


def _enough(patches: np.ndarray, grid: Grid) -> bool:
    """Whether there are enough patches, and not all at one place."""
    if len(patches) < MIN_PATCHES:
        return False
    return float(np.ptp(patches[:, :2], axis=0).max()) >= MIN_REACH * PATCH * grid.cell


def _pair(first: ViewSource, second: ViewSource, patches: np.ndarray, grid: Grid) -> FrameShift:
    """The shift of a pair from patches as `_patch_shifts` has them, in metres: of the level ones where they suffice."""
    level = patches[:, 4] > 0
    on_ground = _enough(patches[level], grid)
    if on_ground:
        patches = patches[level]
    places = patches[:, :2]
    leans = [source.lean(*places.T) for source in (first, second)]
    parallax = None
    if leans[0] is not None and leans[1] is not None:
        parallax = np.nanmedian(leans[1] - leans[0], axis=0)
        if not np.hypot(*parallax) > 0:  # taken from one place: heights do not matter
            parallax = None
    return FrameShift(first.name, second.name, places, patches[:, 2:4], parallax, on_ground)


def _markings(view: GroundView) -> np.ndarray:
    """What is brighter than its surroundings and narrow, as a share of the brightest, float32."""
    grey = view.values.mean(axis=-1)
    kernel = np.ones((NARROW, NARROW), np.uint8)
    return cv2.morphologyEx(grey, cv2.MORPH_TOPHAT, kernel) / max(grey.max(), 1.0)


def _patch_shifts(first: np.ndarray, second: np.ndarray, both: np.ndarray, level: np.ndarray | None) -> np.ndarray:
    """Middle (column, row; corners at whole numbers) and shift (columns, rows) of all patches with markings that both
    see, and whether (1, else 0) they are known to be level and the shift is clear, (n, 6)."""
    window = cv2.createHanningWindow((PATCH, PATCH), cv2.CV_32F)
    shifts = []
    for top in range(0, first.shape[0] - PATCH + 1, PATCH // 2):
        for left in range(0, first.shape[1] - PATCH + 1, PATCH // 2):
            part = slice(top, top + PATCH), slice(left, left + PATCH)
            if not both[part].all():
                continue
            a, b = first[part].copy(), second[part].copy()  # phaseCorrelate lays the window on what it is given
            if min((a > CONTRAST).mean(), (b > CONTRAST).mean()) < MIN_BRIGHT_SHARE:
                continue
            shift, peak = cv2.phaseCorrelate(a, b, window)
            flat = level is not None and level[part].mean() >= LEVEL_SHARE
            shifts.append((left + PATCH / 2, top + PATCH / 2, *shift, flat, peak > CLEAR_PEAK))
    return np.array(shifts, float).reshape(-1, 6)
