"""Settings of the map of localisation accuracy."""

from __future__ import annotations

from .declaration import Settings, record, setting


@record(frozen=True)
class ScannerSettings(Settings):
    """A laser scanner on the vehicle to be localised."""

    kind: str = setting(
        "2D", "Scanner", "Of the vehicle to be localised.", choices=("2D", "multi-layer"), alias="SCANNER")
    max_range: float = setting(60.0, "Range of the scanner", "Walls farther away are not seen.", "m", 2.0, 300.0)
    height: float = setting(2.0, "Height of the scanner", "Above the road.", "m", 0.1, 10.0, alias="SENSOR_HEIGHT")
    resolution: float = setting(
        0.5, "Angular resolution", "Between rays of a layer.", "degrees", 0.05, 5.0, alias="ANGLE_STEP", advanced=True)
    noise: float = setting(0.03, "Noise of ranges", "Standard deviation.", "m", 0.001, 1.0, advanced=True)
    layers: int = setting(16, "Layers", "Of a multi-layer scanner.", "", 2, 256, advanced=True)
    lowest: float = setting(-15.0, "Lowest layer", "Its elevation.", "degrees", -60.0, 60.0, advanced=True)
    highest: float = setting(15.0, "Highest layer", "Its elevation.", "degrees", -60.0, 80.0, advanced=True)
    hidden: float = setting(
        0.1, "Share of hidden rays", "Rays that end at vehicles, trees or people.", "", 0.0, 0.9, advanced=True)


@record(frozen=True)
class EvidenceSettings(Settings):
    """How scans, markings and satellites tell the place, and what is taken for good."""

    matcher: str = setting(
        "NDT", "Matching", "How scans are matched to the map.", choices=("NDT", "ICP"), alias="MATCHING")
    cell: float = setting(
        2.0, "Cells of the NDT", "Side of the cells of the normal distributions.", "m", 0.2, 10.0, advanced=True)
    common_sigma: float = setting(
        0.0, "Common sigma of a building", "Standard deviation of a displacement that all walls of a building share.",
        "m", 0.0, 5.0, advanced=True)
    start_sigma: float = setting(
        1.0, "Sigma before matching", "What is known before, of east and of north: a direction without evidence keeps "
        "it.", "m", 0.1, 10.0, advanced=True)
    start_heading: float = setting(
        2.0, "Sigma of the heading before matching", "Likewise.", "degrees", 0.1, 20.0, advanced=True)
    search: float = setting(
        15.0, "Search for repetitions", "Places that look alike are searched for within this distance; 0: not at all.",
        "m", 0.0, 40.0, advanced=True)
    marking_range: float = setting(
        25.0, "Range of markings", "Markings farther away are not seen.", "m", 2.0, 100.0, advanced=True)
    marking_view: float = setting(
        360.0, "View of markings", "Angle ahead in which markings are seen: 360 for the intensity of a scanner around, "
        "about 100 for a camera.", "degrees", 10.0, 360.0, advanced=True)
    detection: float = setting(
        0.8, "Detection rate of markings", "Share of the markings within sight that are found.", "", 0.05, 1.0,
        advanced=True)
    code_sigma: float = setting(
        2.0, "Sigma of satellite ranges", "Standard deviation of a code range at the zenith.", "m", 0.1, 50.0,
        advanced=True)
    nlos_share: float = setting(
        0.3, "Share of reflected signals", "Of the hidden satellites those that are received by reflection and used.",
        "", 0.0, 1.0, advanced=True)
    good: float = setting(
        0.3, "Limit of good", "Largest sigma of the weakest direction of a good place.", "m", 0.01, 10.0, advanced=True)
    usable: float = setting(1.0, "Limit of usable", "The same of a usable place.", "m", 0.01, 20.0, advanced=True)
    marking_common: float = setting(
        0.03, "Common sigma of markings", "Standard deviation of a displacement that the markings around a place "
        "share, such as that of the aerial block.", "m", 0.0, 2.0, advanced=True)
