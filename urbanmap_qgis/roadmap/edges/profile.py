"""The profile across an edge at one station: lines on both sides, the face between them, foot and top."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import SIGMA_OF_MAD

HALF_LENGTH = 0.4
"""m along the edge to either side of a station whose points belong to its profile."""

BESIDE = 0.14  # m about the edge that belong to neither side
# m across to either side, points that each side must have within them, and m about the edge that belong to
# neither: the nearest reach that holds enough is taken.
REACHES = ((0.7, 12, BESIDE), (1.2, 8, BESIDE), (2.0, 4, BESIDE))
NARROW = (0.7, 4, 0.05)  # The same for a top of which a rail or a wall leaves a hand's breadth.
FACE = 0.35  # m about the edge in which its face lies
FEWEST = 4  # points of a side
SLOPE_SIGMA = 0.05  # of a side, where too few points tell it
NOISE = 0.006  # m, least noise of a height or of a place on the face
MARGIN = 0.2  # share of the height at foot and top where points may belong to the sides
FACE_POINTS = 4
FACE_LEAN = 1.0  # standard deviation of m across for each m of height
FLUSH = 0.02  # m; a lower step does not tell where it is
ROUGH = 0.03  # m; what scatters more is no made surface
# m from the edge within which both sides must show
NEAREST = 0.6
NEAREST_FLUSH = 0.35

FAR_REACH = 2.0


@dataclass(frozen=True)
class Profile:
    """A profile as fitted.

    Attributes
    ----------
    foot, top : m across from the station, towards the higher side.
    z_foot, z_top : m.
    sigma, sigma_z : standard deviations of the place of the face and of the heights, m; sigma NaN where the step is too
        low to tell its place.
    points : used.
    """

    foot: float
    top: float
    z_foot: float
    z_top: float
    sigma: float
    sigma_z: float
    points: int

    @property
    def height(self) -> float:
        """Of the step, m."""
        return self.z_top - self.z_foot


@dataclass(frozen=True)
class _Line:
    """Height = z + slope (a - middle) with the noise of a point and the covariance's parts."""

    z: float
    slope: float
    middle: float
    noise: float
    number: int
    spread: float
    nearest: float

    def height(self, a: float) -> float:
        return self.z + self.slope * (a - self.middle)

    def sigma(self, a: float) -> float:
        return float(self.noise * np.sqrt(1.0 / self.number + (a - self.middle)**2 / self.spread))


def fit_edge_profile(a: np.ndarray, z: np.ndarray) -> Profile | None:
    """Fit one pass's points about a station; None where one of the sides was not measured.

    Parameters
    ----------
    a : (n,) m across, towards the higher side.
    z : (n,) m.
    """
    edge = 0.0
    profile = None
    for _ in range(3):
        low, high = _line(a - edge, z, -1), _line(a - edge, z, 1)
        if low is None or high is None:
            return None
        profile = _face(a - edge, z, low, high)
        if profile is None:
            return None
        moved = 0.5 * (profile.foot + profile.top)
        profile = Profile(profile.foot + edge, profile.top + edge, profile.z_foot, profile.z_top, profile.sigma,
                          profile.sigma_z, profile.points)
        if np.isnan(profile.sigma) or abs(moved) < 0.01 or abs(edge + moved) > FACE:
            break
        edge += moved
    return profile


def _line(a: np.ndarray, z: np.ndarray, side: int) -> _Line | None:
    """Robust line of one side (-1 the lower one)."""
    for reach, enough, beside in (*REACHES, NARROW):
        rows = np.flatnonzero((side * a > beside) & (side * a < reach))
        if len(rows) >= enough:
            break
    else:
        return None
    a, z = a[rows], z[rows]
    keep = np.abs(z - np.median(z)) < 0.15
    line = None
    for _ in range(3):
        if np.count_nonzero(keep) < FEWEST:
            return None
        mean_a, mean_z = a[keep].mean(), z[keep].mean()
        spread = float(((a[keep] - mean_a)**2).sum()) + (0.01 / SLOPE_SIGMA)**2
        slope = float(((a[keep] - mean_a) * (z[keep] - mean_z)).sum() / spread)
        off = z - mean_z - slope * (a - mean_a)
        noise = max(SIGMA_OF_MAD * float(np.median(np.abs(off[keep]))), NOISE)
        line = _Line(float(mean_z), slope, float(mean_a), noise, int(np.count_nonzero(keep)), spread,
                     float(np.sort(np.abs(a[keep]))[FEWEST // 2]))
        inliers = np.abs(off) < 3.0 * noise
        if np.array_equal(inliers, keep):
            break
        keep = inliers
    return line if line.noise <= ROUGH and line.nearest <= NEAREST else None


def _face(a: np.ndarray, z: np.ndarray, low: _Line, high: _Line) -> Profile | None:
    """Foot, top and place of the face between two sides; None where these are too far apart to tell of a low step."""
    step = high.height(0.0) - low.height(0.0)
    sigma_z = float(np.hypot(low.sigma(0.0), high.sigma(0.0)))
    number = low.number + high.number
    if step < max(FLUSH, 3.0 * sigma_z):
        if max(low.nearest, high.nearest) > NEAREST_FLUSH or sigma_z > 0.5 * FLUSH:
            return None
        return Profile(0.0, 0.0, low.height(0.0), high.height(0.0), np.nan, sigma_z, number)
    near = np.abs(a) < FACE
    margin = max(MARGIN * step, 2.0 * NOISE)
    above, below = z - low.z - low.slope * (a - low.middle), high.z + high.slope * (a - high.middle) - z
    face = near & (above > margin) & (below > margin)
    if np.count_nonzero(face) >= FACE_POINTS:
        return _on_face(a[face], (above - 0.5 * step)[face], step, low, high, number)
    edge, sigma = _change(a[near], above[near]**2, below[near]**2, max(low.noise, high.noise))
    return Profile(edge, edge, low.height(edge), high.height(edge), sigma, sigma_z, number)


def _on_face(a: np.ndarray, up: np.ndarray, step: float, low: _Line, high: _Line, number: int) -> Profile:
    """The face as a line a = edge + lean * up, `up` (n,) counted from the middle of the step."""
    keep = np.abs(a - np.median(a)) < max(0.05, 3.0 * SIGMA_OF_MAD * float(np.median(np.abs(a - np.median(a)))))
    a, up = a[keep], up[keep]
    spread = float(((up - up.mean())**2).sum()) + (NOISE / FACE_LEAN)**2
    lean = float(np.clip(((up - up.mean()) * (a - a.mean())).sum() / spread, 0.0, 3.0))
    edge = float(a.mean() - lean * up.mean())
    off = a - edge - lean * up
    noise = max(float(np.sqrt((off**2).sum() / max(len(a) - 2, 1))), NOISE)
    sigma = noise * float(np.sqrt(1.0 / len(a) + up.mean()**2 / spread))
    foot, top = edge - 0.5 * lean * step, edge + 0.5 * lean * step
    return Profile(foot, top, low.height(foot), high.height(top), sigma,
                   float(np.hypot(low.sigma(foot), high.sigma(top))), number + len(a))


def _change(a: np.ndarray, off_low: np.ndarray, off_high: np.ndarray, noise: float) -> tuple[float, float]:
    """Place where the lower side gives way to the higher one, and its standard deviation, from squared misfits.

    Where scan lines run along the edge, or it hides its face, a gap without points is all that shows: the edge is
    anywhere in it.
    """
    order = np.argsort(a)
    return most_likely_change(a[order], 0.5 * off_low[order] / noise**2, 0.5 * off_high[order] / noise**2, FACE)


def most_likely_change(a: np.ndarray, before: np.ndarray, after: np.ndarray, reach: float) -> tuple[float, float]:
    """Place (m) at which one description of points gives way to another, and its standard deviation.

    Parameters
    ----------
    a : (n,) places in increasing order, within `reach` m of 0.
    before, after : (n,) negative log likelihood of each point by the description that holds before the change, and by
        that after it.
    """
    borders = np.concatenate([[-reach], a, [reach]])
    cost = np.concatenate([[0.0], np.cumsum(before)]) + np.concatenate([[0.0], np.cumsum(after[::-1])])[::-1]
    gap = np.diff(borders)
    likely = np.exp(cost.min() - cost) * gap
    middle = 0.5 * (borders[1:] + borders[:-1])
    total = max(float(likely.sum()), 1e-300)
    edge = float((likely * middle).sum() / total)
    spread = float((likely * ((middle - edge)**2 + gap**2 / 12.0)).sum() / total)
    return edge, max(float(np.sqrt(spread)), NOISE)
