"""Settings of line scanners, line cameras and scanner calibration."""

from __future__ import annotations

from .declaration import Settings, record, setting

METHODS = ("drift", "paper")
"""Best estimate of a random-walk drift; all of Z 3 to the letter: sets of two pairs by eq. 13 to 17, eq. 8 and 9,
sampled heights, nothing left out as wrong."""


@record(frozen=True)
class ScanSettings(Settings):
    """What is placed, and how the files are read.

    Attributes
    ----------
    radians : angles in the files are radians, not degrees.
    """

    max_range: float = setting(
        0.0, "Maximum range", "Returns from farther away, in metres, are left out; 0 takes each scanner's own limit "
        "from the calibration.", "m", 0.0, advanced=True)
    min_range: float = setting(
        0.0, "Minimum range", "Nearer returns, in metres, are left out, such as those of the vehicle itself.", "m", 0.0,
        advanced=True)
    radians: bool = False


@record(frozen=True)
class TextureSettings(Settings):
    """How textures are made.

    Parameters
    ----------
    min_detail : pixels a metre below which an image shows too little of a place to be used.
    """

    resolution: float = setting(0.05, "Resolution", "Side of a pixel on the facade.", "m", 0.005, 1.0)
    max_range: float = setting(
        40.0, "Maximum range", "Line images are used up to this distance.", "m", 1.0, 200.0, alias="REACH",
        advanced=True)
    min_seen: float = setting(
        0.02, "Minimum share seen", "Facades of which images show less get no texture.", "", 0.0, 1.0, advanced=True)
    min_detail: float = 1.0


@record(frozen=True)
class BoresightSettings(Settings):
    """Prior standard deviations of the calibration and of the trajectories.

    Attributes
    ----------
    lever_arm : m.
    boresight : degrees.
    place, tilt, heading : m, degrees (tilt: roll and pitch), by which a pass as a whole differs from the mean of all
        passes; what they have in common is part of the boresight.
    place_walk, attitude_walk : m, degrees, from one node to the next.
    node_length : m of path.
    max_apart : m, that passes may lie from each other: planes are then paired wrongly too often.
    determined_angle, determined_arm : degrees, m, standard deviation up to which a value is called determined.
    """

    tilt: float = setting(
        0.03, "Difference of tilts", "Standard deviation by which roll and pitch of the trajectory differ from pass to "
        "pass.", "degrees", 0.001, 5.0, alias="TILT_SIGMA", advanced=True)
    heading: float = setting(
        0.1, "Difference of headings", "The same of the heading.", "degrees", 0.001, 5.0, alias="HEADING_SIGMA",
        advanced=True)
    lever_arm: float = 0.10
    boresight: float = 1.0
    place: float = 2.0
    place_walk: float = 0.15
    attitude_walk: float = 0.02
    node_length: float = 5.0
    max_apart: float = 0.3
    determined_angle: float = 0.05
    determined_arm: float = 0.03


@record(frozen=True)
class RectifySettings(Settings):
    """How a trajectory is rectified."""

    sensor_height: float | None = setting(
        None, "Height of the origin", "Height of the trajectory's origin above the ground, in metres. Without it the "
        "mean height stays as reported.", "m", -100.0, 100.0)
    method: str = setting(
        "drift", "Method", "Best estimate of the drift from all tie points; or the paper to the letter.",
        choices=METHODS, advanced=True)
    tie_sigma: float = setting(
        0.0, "Sigma of tie points", "Standard deviation of a tie point's coordinate in metres; 0 finds it from the tie "
        "points.", "m", 0.0, 100.0, advanced=True)
    heading_sigma: float = setting(
        0.5, "Expected error of the heading", "Standard deviation in degrees: what is known of the heading where the "
        "pairs of a set lie close together.", "degrees", 0.001, 45.0, advanced=True)
    keep_blunders: bool = setting(
        False, "Keep doubtful sets", "Use sets even though the other sets put them elsewhere.", advanced=True)
