"""What goes into the registration of windows and what comes out: settings, rows of results."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...errors import InputError
from ...settings.mobile import WindowSettings
from ...wording import say

REGISTERED, WEAK, AMBIGUOUS, NO_MARKINGS, NOT_CONVERGED = range(5)
"""Status of a window. WEAK: found, but badly determined in a direction (see the covariance) or with little overlap.
AMBIGUOUS: another place fits nearly as well (see the modes). NO_MARKINGS: too few points, or no reference there.
NOT_CONVERGED: the iteration did not converge. Corrections of the last two are not to be used."""

STATUS_NAMES = ("registered", "weak", "ambiguous", "no markings", "not converged")

_PAINTED = 0.1  # of the ground near markings
MODES = 3
"""Positions given for a window at most."""

CELLS = ("neighbours", "own", "closest")
"""Which normal distributions a point scores in."""


@dataclass(frozen=True)
class RegistrationSettings(WindowSettings):
    """Parameters, with the values of J Table 3-2 where it has them.

    Attributes
    ----------
    window_patches : patches of the smallest window (J: 60).
    max_window_patches : patches of the longest window, which is used as it is even where it has too few features; None
        sets no limit (J).
    feature_points : points that make a cell count (J: 5).
    window_points : marking points that a window should have, counted instead of cells (J chapter 4, which gives no
        number); None counts cells (J 3.2.4.2).
    extend_at_end : a window grows at its end only (J 3.2.4.2), not at both ends about its patch (J chapter 4).
    subsampling : m, one point a cell of this side (J chapter 4: 0.3).
    three_d : also height, roll and pitch, against the reference's heights (J chapter 4).
    ndt_levels : grids used one after another, in units of `ndt_grid` (J 3.2.4: one; chapter 4: 2.0 to 0.5 m).
    cells : the normal distributions that a point scores in: "neighbours", the 3 x 3 (x 3) cells around it; "own", its
        cell; "closest", the one with the closest mean (J eq. 11).
    start : find the start by correlation along the whole path, within `search` m. Without it windows start from the one
        before (J).
    refinement : sub-pixel adjustment to the reference's coverage after NDT.
    blurs : m, standard deviations of the Gaussians that the coverage is blurred by, one after another.
    height_sigma, height_robust : m, of a point's height over the reference's ground: its standard deviation, and the
        difference from which points lose their weight (Geman and McClure).
    shared_windows : windows are adjusted together about one smooth correction, so that drift within a window does not
        bend it. Without it each window is rigid and on its own (J).
    outlier_share : expected share of points that belong to no reference marking.
    reference_sigma : m, floor of the standard deviation in plan: what the reference itself is off by.
    reference_sigma_z : m, the same in height.
    """

    window_patches: int = 60
    max_window_patches: int | None = 200
    feature_points: int = 5
    window_points: int | None = None
    extend_at_end: bool = False
    subsampling: float = 0.1
    three_d: bool = False
    ndt_levels: tuple[float, ...] = (2.0, 1.0, 0.5)
    cells: str = "neighbours"
    start: bool = True
    refinement: bool = True
    blurs: tuple[float, ...] = (0.15, 0.0)
    height_sigma: float = 0.05
    height_robust: float = 0.15
    shared_windows: bool = True
    outlier_share: float = 0.35
    reference_sigma: float = 0.015
    reference_sigma_z: float = 0.015

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 0 < self.outlier_share < 1:
            raise InputError(say("The expected share of outliers must lie between 0 and 1."))
        if self.cells not in CELLS:
            raise InputError(say("Points score in the cells {cells}, not {cells_2}.", cells=", ".join(CELLS),
                                 cells_2=self.cells))
        if self.max_window_patches is not None and self.max_window_patches < self.window_patches:
            raise InputError(say("The longest window must not be shorter than the smallest one."))

    @property
    def background(self) -> float:
        """What stands for points off the markings beside the share of paint, 0 to 1, where they are."""
        return _PAINTED * self.outlier_share / (1.0 - self.outlier_share)

    @classmethod
    def paper(cls, **changes: object) -> RegistrationSettings:
        """The method to the letter: rigid windows, each started from the one before, the closest cell for each point.

        In plan (J 3.2.4): one grid, windows of 60 patches or more by occupied cells, which grow at their end. With
        `three_d` (J chapter 4): grids of 2, 1 and 0.5 m, windows of 30 patches or more by marking points, about
        their patch. J gives no number of points: that of 400 cells with 5 points each stands for it.
        """
        letter = cls(subsampling=0.3, ndt_levels=(1.0,), cells="closest", start=False, refinement=False,
                     shared_windows=False, max_window_patches=None, extend_at_end=True)
        if changes.get("three_d"):
            letter = replace(letter, ndt_levels=(2.0, 1.0, 0.5), window_patches=30, extend_at_end=False,
                             window_points=letter.feature_count * letter.feature_points)
        return replace(letter, **changes)


@dataclass(frozen=True)
class WindowResults:
    """One row a patch, in the order driven; every patch of the trajectory has its row.

    The correction of a row: T_corrected has place + (dx, dy, dz) and angles + (droll, dpitch, dheading); a point
    near the patch moves by T_corrected T_reported^-1 (map metres; degrees of the trajectory's own angles). In 2D the
    third to fifth are NaN.

    Neighbouring windows share most of their points: their errors are NOT independent. Whoever adjusts rows together
    must give a row the weight 1 / (`window_last` - `window_first` + 1), or take `information` and `gradient`, which
    are of the patch's own points only and do add up: near `linearised` the log-likelihood of a correction c is
    `gradient` . (c - linearised) - (c - linearised)' `information` (c - linearised) / 2 (thinned to independent
    evidence, without the floor of the reference).

    Attributes
    ----------
    time : (n,) s, at the patch's middle.
    chainage : (n,) m driven to the patch's middle.
    place : (n, 3) m.
    angles : (n, 3) degrees, of the reported trajectory there.
    correction : (n, 6) dx, dy, dz (m), droll, dpitch, dheading (degrees). NaN where there is none.
    covariance : (n, 6, 6) of the correction, m and degrees. NaN where there is none. Includes the floor of the
        reference, the drift within the window, contradictions within it, and other places that fit nearly as well.
    score : (n,) mean likelihood score of the window's points, 0 to 1.
    overlap : (n,) share of the window's points that lie on reference markings after the correction.
    window_first, window_last : (n,) numbers of the first and last patch of the window, both included.
    window_length : (n,) m.
    features : (n,) occupied cells, or marking points where these are counted.
    points : (n,) subsampled points in the window.
    alias_ratio : (n,) score of the second best place in plan to that of the best, within the search; 0 if alone.
    margin : (n,) by how much the best path through the whole survey beats the best through another position here
        (log-likelihood of independent evidence; below about 3 is no proof; inf if there is no other place).
    status : (n,) int8, see REGISTERED and its fellows.
    modes : (n, MODES, 2) dx, dy of the positions that fit, the row's own first; NaN where there are fewer.
    mode_scores : (n, MODES) log-likelihood of each (independent evidence of this window), own first.
    linearised : (n, 6).
    information : (n, 6, 6).
    gradient : (n, 6), see above; zeros where the patch has no points.
    three_d : whether height, roll and pitch were estimated.
    search : m, largest error east or north that was looked for.
    beyond : whether the best path of the start runs along the edge of it, so that the survey may lie farther off.
    spread : (n, 2, 2) m2, how far the place may be off as others fit nearly as well; None where it is not known.
    """

    time: np.ndarray
    chainage: np.ndarray
    place: np.ndarray
    angles: np.ndarray
    correction: np.ndarray
    covariance: np.ndarray
    score: np.ndarray
    overlap: np.ndarray
    window_first: np.ndarray
    window_last: np.ndarray
    window_length: np.ndarray
    features: np.ndarray
    points: np.ndarray
    alias_ratio: np.ndarray
    margin: np.ndarray
    status: np.ndarray
    modes: np.ndarray
    mode_scores: np.ndarray
    linearised: np.ndarray
    information: np.ndarray
    gradient: np.ndarray
    three_d: bool
    search: float = np.inf
    beyond: bool = False
    spread: np.ndarray | None = None

    def __len__(self) -> int:
        return len(self.time)

    @property
    def usable(self) -> np.ndarray:
        """(n,) bool: rows that carry a correction."""
        return np.isin(self.status, (REGISTERED, WEAK, AMBIGUOUS))

    def sigma(self) -> np.ndarray:
        """(n, 6) standard deviations of the correction, m and degrees."""
        return np.sqrt(np.einsum("nii->ni", self.covariance))
