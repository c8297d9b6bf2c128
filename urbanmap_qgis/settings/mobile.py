"""Settings of mobile surveys: their markings, registration and adjustment."""

from __future__ import annotations

from .declaration import Settings, record, setting
from .terrain import ground_source_setting


@record(frozen=True)
class StrokeRules(Settings):
    """What of a survey's points is paint (J 3.2.3)."""

    block_size: float = setting(
        2.5, "Block size", "Side in metres of the block whose mean a marking exceeds.", "m", 0.5, 20.0, advanced=True)
    contrast: float = setting(
        0.35, "Contrast", "How much brighter than the ground a marking is, as a share of the ground's intensity.", "",
        0.05, 5.0, advanced=True)
    max_width: float = setting(
        0.8, "Maximum stroke width", "What is wider in both directions, in metres, is no marking but ground.", "m", 0.2,
        5.0, advanced=True)
    min_length: float = setting(
        0.4, "Minimum length", "Shorter pieces, in metres, are left out.", "m", 0.0, 10.0, advanced=True)


@record(frozen=True)
class ReachRules(Settings):
    """Which points are looked at."""

    max_range: float = setting(
        25.0, "Maximum range", "Points farther from the scanner, in metres, are left out. The range up to which the "
        "curve holds (R2) may be shorter.", "m", 1.0, 200.0, advanced=True)
    ground: str = ground_source_setting(advanced=True)


@record(frozen=True)
class WindowSettings(Settings):
    """Windows of a survey's markings, and how they are laid on the reference (J Table 3-2)."""

    patch_length: float = setting(0.5, "Patch length", "Length of path that counts as rigid.", "m", 0.1, 10.0)
    feature_grid: float = setting(
        1.0, "Feature grid", "Side of the cells in which markings are counted.", "m", 0.1, 10.0, advanced=True)
    feature_count: int = setting(
        400, "Feature count", "Cells with markings that a window should have. In space the paper's method counts "
        "marking points instead, 5 for each of these cells.", "cells", 1, 100000)
    ndt_grid: float = setting(
        1.0, "NDT grid", "Side of the cells of the normal distributions.", "m", 0.1, 10.0, advanced=True)
    iterations: int = setting(30, "Iterations", "Most steps of each adjustment.", "", 1, 1000, advanced=True)
    search: float = setting(
        4.0, "Maximum error", "How far off the survey may be in plan. Where the best place lies at the edge of it, or "
        "hardly beats others, twice as far is looked at. Wider than half the distance between dashes invites a slip by "
        "one dash.", "m", 0.5, 20.0, advanced=True)
    ground_sigma: float | None = setting(
        None, "Accuracy of the ground", "Standard deviation of the errors that neighbouring heights of the ground "
        "share; they must not turn the vehicle. By default found from how the ground bends against the survey.", "m",
        0.001, 10.0, advanced=True)


@record(frozen=True)
class WindowChoice(Settings):
    """What the method decides where it is not given: the length of the windows, and how they are thinned."""

    window_patches: int | None = setting(
        None, "Minimum window length", "Patches of the shortest window. By default 60; 30 with the paper's method in "
        "space.", "patches", 4, 400)
    max_window_patches: int | None = setting(
        None, "Maximum window length", "Patches of the longest window, which is used as it is even where it has too "
        "few markings. By default 200; no limit with the paper's method.", "patches", 4, 100000, advanced=True)
    subsampling: float | None = setting(
        None, "Subsampling", "One point is used in each cell of this side. By default 0.1 m; 0.3 m with the paper's "
        "method.", "m", 0.01, 2.0, advanced=True)


@record(frozen=True)
class TrustSettings(Settings):
    """How exact the reference is, and which patches are to be trusted."""

    reference_sigma: float = setting(
        0.005, "Accuracy of the reference", "Standard deviation of the error that all reference markings around a "
        "place share (orientation of the frames, for example): no survey can show it, so that it is part of every "
        "standard deviation. The default holds where the reference counts as true; otherwise give what control points "
        "say of it.", "m", 0.0, 10.0, advanced=True)
    trusted_sigma: float = setting(
        0.3, "Maximum trusted standard deviation", "A patch whose standard deviation in plan is larger is not to be "
        "trusted.", "m", 0.01, 100.0, advanced=True)


@record(frozen=True)
class ControlSettings(Settings):
    """What ties several drives beside the reference."""

    control_sigma: float = setting(
        0.02, "Accuracy of control in plan", "Standard deviation of control points and of their measurement in the "
        "survey.", "m", 0.001, 10.0)
    control_sigma_z: float = setting(0.03, "Accuracy of control in height", "The same in height.", "m", 0.001, 10.0)
    planes: bool = setting(
        True, "Ties by planes", "Facades and road that two drives saw tie them too, across the facades and in height. "
        "Markings alone carry no planes.", advanced=True)
