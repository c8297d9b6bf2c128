"""Settings of the road map: lines, edges, objects, lanes and their comparison."""

from __future__ import annotations

from math import nan

from .declaration import Settings, record, setting


@record(frozen=True)
class LineSettings(Settings):
    """What counts as a line.

    Attributes
    ----------
    stop_width : narrower bars are no stop line, m.
    min_painted, min_length : paint of a line and its length with gaps, at least, m.
    guide_width : yellow lines so wide are guiding strips for the blind, m.
    """

    source_sigma: float = setting(
        0.02, "Standard deviation of the markings", "How well the places of the markings are known as a whole, in "
        "metres; it enters the lines' sigma.", "m", 0.0, 10.0, alias="SIGMA")
    min_length: float = setting(
        6.0, "Minimum line length", "Shorter lines are left out.", "m", 1.0, 1000.0, advanced=True)
    max_width: float = setting(
        0.5, "Maximum line width", "Wider strokes are no part of a line.", "m", 0.1, 5.0, advanced=True)
    stop_width: float = 0.28
    min_painted: float = 4.0
    guide_width: float = 0.26


@record(frozen=True)
class EdgeSettings(Settings):
    """How edges are looked for."""

    width: float = setting(15.0, "Half width", "Edges up to so far from the path, in metres.", "m", 3.0, 50.0)
    min_height: float = setting(
        0.03, "Lowest kerb", "Lower steps, in metres, are no kerbs; between two parts of a kerb they are its lowered "
        "places.", "m", 0.02, 0.2)
    max_height: float = setting(
        0.3, "Highest kerb", "Higher steps, in metres, are no kerbs.", "m", 0.1, 0.6, advanced=True)
    min_length: float = setting(
        3.0, "Minimum length", "Shorter edges, in metres, are left out.", "m", 1.0, 100.0, advanced=True)
    survey_sigma: float = setting(
        0.01, "Standard deviation of the survey", "How well the survey is placed as a whole, in metres; it enters the "
        "sigma of all edges.", "m", 0.0, 10.0, alias="SIGMA")


@record(frozen=True)
class ObjectSettings(Settings):
    """How objects are looked for."""

    width: float = setting(15.0, "Half width", "Objects up to so far from the path, in metres.", "m", 3.0, 50.0)
    min_height: float = setting(
        2.0, "Lowest object", "Lower posts, signs and trees, in metres, are left out; bollards and boxes have heights "
        "of their own.", "m", 1.5, 10.0)
    max_diameter: float = setting(
        0.6, "Thickest stem", "What is thicker, in metres, is no post or trunk.", "m", 0.1, 2.0, advanced=True)
    survey_sigma: float = setting(
        0.01, "Standard deviation of the survey", "How well the survey is placed as a whole, in metres; it enters the "
        "sigma of all objects.", "m", 0.0, 10.0, alias="SIGMA")


@record(frozen=True)
class MapSettings(Settings):
    """What counts as a lane.

    Attributes
    ----------
    min_length : of a lane, m.
    height_gap : lines whose heights differ by more do not belong together, m.
    """

    traffic: str = setting(
        "auto", "Side of the traffic", "Auto: the side that drives in both directions show, left where they do not.",
        choices=("auto", "left", "right"))
    min_width: float = setting(2.2, "Minimum lane width", "Narrower strips are no lanes.", "m", 1.0, 5.0, advanced=True)
    max_width: float = setting(5.0, "Maximum lane width", "Wider strips are no lanes.", "m", 2.0, 12.0, advanced=True)
    bridge: float = setting(
        30.0, "Longest unseen bound", "A bound is drawn through gaps of its line up to this length, which are told.",
        "m", 0.0, 500.0, advanced=True)
    infer_ways: bool = setting(
        True, "Ways that no drive shows", "Make virtual lanes through junctions also for the movements that arrows, or "
        "else the rule of the road, allow; their evidence says so. Without it only driven ways are made.",
        advanced=True)
    way_confidence: float = setting(
        0.9, "Confidence of inferred ways", "Inferred ways that are less sure to be allowed (0 to 1) are not made but "
        "told as findings. 0 makes all that the rule of the road allows.", "", 0.0, 1.0, advanced=True)
    min_length: float = 5.0
    height_gap: float = 2.5


@record(frozen=True)
class ComparisonSettings(Settings):
    """How two maps are compared.

    Attributes
    ----------
    old_sigma, new_sigma : of what states none in its map, m; NaN to estimate it from what did not change.
    """

    reach: float = setting(
        1.5, "Longest shift of a line", "A line farther off is another one: the old one was removed, the new one "
        "added.", "m", 0.1, 5.0, advanced=True)
    least_length: float = setting(
        3.0, "Shortest change of a line", "Shorter stretches of lines are not told.", "m", 0.5, 100.0, advanced=True)
    least_shift: float = setting(
        0.0, "Smallest shift", "Smaller shifts are not told, also where they are significant.", "m", 0.0, 5.0,
        advanced=True)
    old_sigma: float = nan
    new_sigma: float = nan
