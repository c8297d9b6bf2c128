"""Settings of frames, orthophotos and the markings in them."""

from __future__ import annotations

from .declaration import Settings, record, setting


@record(frozen=True)
class OcclusionSettings(Settings):
    """What counts as a building."""

    threshold: float = setting(
        5.0, "Height threshold", "Surface higher than this above the ground, in metres, is masked: more than the "
        "highest vehicle.", "m", 0.1, 1000.0, alias="HEIGHT_THRESHOLD")
    low_parts: bool = setting(
        True, "Low parts of buildings", "Podiums and annexes lower than the threshold are masked too: higher than 2.5 "
        "m, wider than 4 m, within 15 m of something above the threshold.", advanced=True)
    steepen_walls: bool = setting(
        True, "Steep walls", "Walls drop from one cell of the surface to the next.", alias="STEEP_WALLS", advanced=True)
    shift_walls: bool = setting(
        True, "Walls at the cells' borders", "Walls stand at the border between a raised cell and a low one, not at "
        "the cells' centres.", advanced=True)


@record(frozen=True)
class BundleSettings(Settings):
    """What is known before.

    Attributes
    ----------
    shared : times these, of the errors that all frames share.
    own_scales : times these that are tried; how much of their errors the frames share is found from the points.
    """

    position: float = setting(
        0.3, "Accuracy of the projection centres", "Standard deviation of each frame's own error in metres; what all "
        "frames share may be ten times as large.", "m", 0.001, 100.0, alias="POSITION_SIGMA")
    angle: float = setting(
        0.05, "Accuracy of the angles", "The same of the angles.", "degrees", 0.0001, 10.0, alias="ANGLE_SIGMA")
    pixel: float = setting(
        0.5, "Accuracy of the measured places", "Standard deviation of a point's place in a frame.", "pixels", 0.01,
        20.0, alias="PIXEL_SIGMA", advanced=True)
    control: float = setting(
        0.02, "Accuracy of the control points", "Standard deviation of their coordinates in metres.", "m", 0.0001, 10.0,
        alias="CONTROL_SIGMA", advanced=True)
    shared: float = 10.0
    own_scales: tuple[float, ...] = (1.0, 0.2, 0.04)


@record(frozen=True)
class MarkingThreshold(Settings):
    """How much brighter than its surroundings paint is (J Table 3-2)."""

    block_size: float = setting(2.5, "Block size", "Side of the block over which the mean is taken.", "m", 0.5, 50.0)
    contrast: float = setting(
        17, "Contrast", "How much brighter than the mean paint is, in grey values of an image that goes from 0 to "
        "255 after the level adjustment, whatever its bit depth.", "grey values", 1.0, 200.0)


@record(frozen=True)
class PaintRules(Settings):
    """What of all that is bright enough is no paint."""

    max_width: float = setting(
        0.8, "Maximum stroke width", "What is wider than this in every direction is no paint.", "m", 0.1, 5.0,
        advanced=True)
    min_area: float = setting(
        0.06, "Minimum marking area", "Smaller pieces are left out.", "m2", 0.0, 100.0, advanced=True)
    min_confidence: float = setting(
        0.4, "Minimum confidence", "What is less likely paint than this, 0 to 1, is left out (parts of long pieces by "
        "themselves); at the default 60 to 85 % of the found area were paint on eight sunlit orthophotos. 0 keeps "
        "all. Where roads are given, paint is more likely.", "", 0.0, 1.0)
    fill_width: float = setting(
        1.5, "Width of filled paint", "Paint up to this width, such as arrow heads and letters, is filled between its "
        "edges; at most the maximum stroke width fills nothing.", "m", 0.0, 5.0, advanced=True)
