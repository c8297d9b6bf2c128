"""Gain compensation of overlapping frames, so that they can be compared pixel by pixel.

Each frame gets a gain and an offset for each channel. They come from ground that two frames see: a line through the
values of both that is not drawn by vehicles and shadows that moved, then one adjustment over all pairs.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

from ...geometry.tolerances import SIGMA_OF_MAD

MIN_COMMON_SAMPLES = 200  # Pairs of frames with fewer samples in common give no line.
ROUNDS = 12
LOOSE = 1e-3  # weight that keeps frames without neighbours at gain 1 and offset 0
GAIN_LIMITS = (0.25, 4.0)


@dataclass(frozen=True)
class RadiometricSamples:
    """Values of ground points in the frames that see them.

    Attributes
    ----------
    frame, point : (n,) numbers of the frame and of the ground point.
    values : (n, bands), the frame's values there, floats.
    """

    frame: np.ndarray
    point: np.ndarray
    values: np.ndarray


@dataclass(frozen=True)
class GainCorrection:
    """Corrections of all frames: corrected value = gain * value + offset.

    Attributes
    ----------
    gain, offset : (frames, bands).
    """

    gain: np.ndarray
    offset: np.ndarray

    @classmethod
    def identity(cls, frames: int, bands: int) -> GainCorrection:
        """Corrections that leave every frame as it is."""
        return cls(np.ones((frames, bands)), np.zeros((frames, bands)))

    def apply(self, frame: int, image: np.ndarray, out: np.ndarray | None = None) -> np.ndarray:
        """Corrected float32 values of an image (..., bands) of a frame, in a contiguous array `out` where given."""
        # Whole rows at a time: numpy is slow along an axis of three.
        across = math.prod(image.shape[-2:]) // image.shape[-1]
        gain, offset = (np.tile(values[frame].astype(np.float32), across) for values in (self.gain, self.offset))
        out = np.empty(image.shape, np.float32) if out is None else out
        rows = out.reshape(-1, len(gain))
        np.multiply(image.reshape(-1, len(gain)), gain, out=rows)
        rows += offset
        return out


@dataclass(frozen=True)
class _Pair:
    """A line between the values of two frames: second = gain * first + offset, by band."""

    first: int
    second: int
    gain: np.ndarray
    offset: np.ndarray
    weight: float


def compensate_gains(samples: RadiometricSamples, frames: int) -> GainCorrection:
    """Gains and offsets that make overlapping frames agree.

    Over each group of frames that overlap, the gains' geometric mean stays 1 and the offsets' mean 0, so that the
    mosaic keeps the frames' own brightness. A frame without enough common ground stays as it is.

    Parameters
    ----------
    samples : at the same ground points in all frames; each frame and point at most once.
    frames : how many frames there are.
    """
    bands = samples.values.shape[1]
    pairs = _pairs(samples, frames)
    if not pairs:
        return GainCorrection.identity(frames, bands)
    gain, offset = np.empty((frames, bands)), np.empty((frames, bands))
    first, second = np.array([pair.first for pair in pairs]), np.array([pair.second for pair in pairs])
    weight = np.sqrt([pair.weight for pair in pairs])
    for band in range(bands):
        ratio = np.array([pair.gain[band] for pair in pairs])
        shift = np.array([pair.offset[band] for pair in pairs])
        # gain_first v + offset_first = gain_second (ratio v + shift) + offset_second for every v.
        logs = _adjust(first, second, np.log(ratio), weight, frames)
        gain[:, band] = np.clip(np.exp(logs), *GAIN_LIMITS)
        offset[:, band] = _adjust(first, second, gain[second, band] * shift, weight, frames)
    return GainCorrection(gain, offset)


def _adjust(first: Sequence[int], second: Sequence[int], difference: np.ndarray, weight: np.ndarray,
            frames: int) -> np.ndarray:
    """Values of all frames whose differences first - second come nearest to the given ones; their mean is 0."""
    rows = np.arange(len(first))
    ones = np.ones(len(first))
    design = scipy.sparse.csr_matrix((np.concatenate((ones, -ones)),
                                      (np.concatenate((rows, rows)), np.concatenate((first, second)))),
                                     shape=(len(first), frames))
    weighted = design.multiply((weight ** 2)[:, None]).tocsr()
    normal = (design.T @ weighted + LOOSE * scipy.sparse.identity(frames)).tocsc()
    return scipy.sparse.linalg.spsolve(normal, weighted.T @ difference)


def _pairs(samples: RadiometricSamples, frames: int) -> list[_Pair]:
    """A line for every pair of frames with enough common samples, in the order of the frames' numbers."""
    order = np.lexsort((samples.point, samples.frame))
    frame, point, values = samples.frame[order], samples.point[order], samples.values[order]
    starts = np.searchsorted(frame, np.arange(frames + 1))
    points = int(point.max()) + 1 if len(point) else 0
    seen = scipy.sparse.csr_matrix((np.ones(len(frame), np.int32), (frame, point)), shape=(frames, points))
    common = scipy.sparse.triu(seen @ seen.T, k=1).tocoo()
    enough = common.data >= MIN_COMMON_SAMPLES
    pairs = []
    for first, second in sorted(zip(common.row[enough].tolist(), common.col[enough].tolist())):
        a, b = slice(starts[first], starts[first + 1]), slice(starts[second], starts[second + 1])
        _, in_a, in_b = np.intersect1d(point[a], point[b], assume_unique=True, return_indices=True)
        lines = [robust_line(x, y) for x, y in zip(values[a][in_a].T, values[b][in_b].T)]
        gain, offset = (np.array(numbers) for numbers in zip(*lines))
        pairs.append(_Pair(first, second, gain, offset, float(len(in_a))))
    return pairs


def robust_line(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Gain and offset of y = gain x + offset, both with noise, (n,) each.

    The reduced major axis (gain = spread of y / spread of x) of the points near the line, found anew in each
    round with Tukey's weights: a plain least-squares line is flatter than the truth where x is noisy. Where the
    values hardly spread, only the level is compared: gain 1.
    """
    x, y = np.asarray(x, np.float64), np.asarray(y, np.float64)
    low, high = np.percentile(x, (10, 90)), np.percentile(y, (10, 90))
    spread_x, spread_y = low[1] - low[0], high[1] - high[0]
    if spread_x <= 0 or spread_y <= 0:
        return 1.0, float(np.median(y) - np.median(x))
    gain = float(np.clip(spread_y / spread_x, *GAIN_LIMITS))
    offset = float(np.median(y) - gain * np.median(x))
    for _ in range(ROUNDS):
        residual = y - gain * x - offset
        scale = max(SIGMA_OF_MAD * float(np.median(np.abs(residual))), 1e-6 * spread_y)
        weight = np.clip(1 - (residual / (4.7 * scale)) ** 2, 0, None) ** 2
        total = weight.sum()
        mean_x, mean_y = (weight @ x) / total, (weight @ y) / total
        variance_x, variance_y = weight @ (x - mean_x) ** 2, weight @ (y - mean_y) ** 2
        if variance_x <= 0 or variance_y <= 0:
            break
        gain = float(np.clip(np.sqrt(variance_y / variance_x), *GAIN_LIMITS))
        offset = float(mean_y - gain * mean_x)
    return gain, offset
