"""Settings of signals among buildings, and of walls by their reflections (J 5.6)."""

from __future__ import annotations

from dataclasses import field

from .declaration import Settings, record, setting


@record(frozen=True)
class SignalSettings(Settings):
    """How observations are read and modelled.

    Parameters
    ----------
    systems : letters of the systems that are used.
    min_cn0 : weaker signals, in dB-Hz, are left out; signals without a strength are kept.
    lever_arm : antenna in the body, (forward, right, down) m from the trajectory's origin.
    max_gap : epochs in a gap of the trajectory longer than this, in seconds, are left out.
    humidity : relative humidity for the troposphere, 0 to 1.
    check_height : compare the heights with what the satellites say; raise where they differ by tens of metres.
    """

    elevation_mask: float = setting(
        10.0, "Elevation mask", "Satellites lower than this are left out.", "degrees", 0.0, 60.0)
    two_bands: bool = setting(
        True, "Ionosphere by two bands", "Measure the ionosphere where the receiver has codes on two bands; otherwise, "
        "or without them, the model that the satellites broadcast is taken.", advanced=True)
    systems: str = "GRECJ"
    min_cn0: float = 0.0
    lever_arm: tuple[float, float, float] = (0.0, 0.0, 0.0)
    max_gap: float = 5.0
    humidity: float = 0.7
    check_height: bool = True


@record(frozen=True)
class TraceSettings(Settings):
    """How signals are traced.

    Parameters
    ----------
    margin : walls may stand this far from where the model has them, m.
    edge_angle : degrees by which rays are rotated to test how sure their class is.
    diffraction : a signal less than this above its obstacle's edge may be diffracted over it: blocked for sure is only
        what is also blocked this many degrees higher and to the sides.
    """

    max_range: float = setting(
        150.0, "Maximum range of reflections", "Walls farther from the antenna than this reflect nothing that is "
        "received, m.", "m", 5.0, 1000.0, alias="FARTHEST", advanced=True)
    margin: float = 1.5
    edge_angle: float = 3.0
    diffraction: float = 6.0


@record(frozen=True)
class AdjustmentSettings(Settings):
    """How walls are adjusted.

    Parameters
    ----------
    block : signals of a satellite within this many seconds are one observation.
    max_offset : an offset beyond this is not believed, m.
    max_iterations : how often buildings are moved and signals traced again, at most.
    trace : how signals are traced.
    """

    min_passes: int = setting(
        3, "Minimum number of passes", "Walls seen in fewer observation files stay.", "", 1, 100, advanced=True)
    min_observations: int = setting(
        8, "Minimum number of observations", "Walls with fewer independent observations are not adjusted, at most "
        "likely.", "", 1, 10000, alias="MIN_VOTES", advanced=True)
    min_satellites: int = setting(
        4, "Minimum number of satellites", "Walls seen by fewer satellites are not adjusted, at most likely.", "", 1,
        100, advanced=True)
    max_sigma: float = setting(
        0.35, "Maximum sigma", "Walls whose offset has a larger standard deviation are not adjusted, at most likely.",
        "m", 0.05, 5.0, advanced=True)
    likely_sigma: float = setting(
        0.5, "Maximum sigma of likely walls", "Walls that are not adjusted are likely, and moved, up to this standard "
        "deviation; 0: they stay.", "m", 0.0, 5.0, advanced=True)
    prior_sigma: float = setting(
        1.0, "Expected offset", "How far walls are off before anything is measured (standard deviation).", "m", 0.05,
        5.0, advanced=True)
    block: float = 30.0
    max_offset: float = 3.0
    max_iterations: int = 4
    trace: TraceSettings = field(default_factory=TraceSettings)
