"""Tags of Lanelet2 files: what each may be, what it is where nothing else is known, and who asks for it.

The writer takes its defaults from here, the check its allowed values. Sources: "Lanelet2" is the tagging
specification in the documentation of lanelet2_core (linestrings, lanelets and areas, regulatory elements); "Autoware"
are the vector map requirements of Autoware; "UrbanMap" are tags of our own that others read over.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

LINE_SUBTYPES: dict[str, tuple[str, ...]] = {
    "line_thin": ("solid", "solid_solid", "dashed", "dashed_solid", "solid_dashed"),
    "line_thick": ("solid", "solid_solid", "dashed", "dashed_solid", "solid_dashed"),
    "curbstone": ("high", "low"),
    "road_border": (), "guard_rail": (), "wall": (), "fence": (), "virtual": (), "stop_line": (),
    "pedestrian_marking": (), "bike_marking": (), "zebra_marking": (), "zig-zag": (), "keepout": (),
    "traffic_light": ("red_yellow_green", "red_green", "red_yellow", "red", "yellow", "white"),
    "traffic_sign": (), "rail": (), "lift_gate": (), "gate": (), "door": (), "trajectory": (), "jersey_barrier": (),
    "building": (), "arrow": (), "symbol": (), "line": (), "bump": (), "pole": (), "post": (), "unknown": (),
    "light_bulbs": (), "intersection_coordination": (), "centerline": (), "speed_bump": (), "parking_space": (),
    "parking_lot": (), "intersection_area": (), "detection_area": (), "no_stopping_area": (), "no_parking_area": (),
    "bus_stop_area": (), "hatched_road_markings": (), "crosswalk_polygon": (), "obstacle_polygon": (),
    "obstacle_removal_area": (), "no_obstacle_segmentation_area": (), "waypoints": (), "lane_divider": ()}
"""Types of linestrings and polygons with the subtypes of each that Lanelet2 lists; no list: none is checked."""

LANELET_SUBTYPES = ("road", "highway", "play_street", "emergency_lane", "bus_lane", "bicycle_lane", "exit", "walkway",
                    "shared_walkway", "crosswalk", "stairs", "road_shoulder", "pedestrian_lane", "private", "virtual")

VEHICLE_SUBTYPES = ("road", "highway", "play_street", "emergency_lane", "bus_lane", "bicycle_lane", "exit",
                    "road_shoulder", "private")
"""Lanelets on which vehicles drive by default."""

LANELET2_RULES = ("traffic_light", "traffic_sign", "speed_limit", "right_of_way", "all_way_stop")
"""Regulatory elements that the library itself can make."""

AUTOWARE_RULES = ("crosswalk", "detection_area", "no_stopping_area", "no_parking_area", "road_marking", "speed_bump",
                  "virtual_traffic_light", "bus_stop_area", "roundabout")
"""Regulatory elements that need Autoware's extension of the library."""

PARTICIPANTS = ("vehicle", "vehicle:car", "vehicle:car:electric", "vehicle:car:combustion", "vehicle:bus",
                "vehicle:truck", "vehicle:motorcycle", "vehicle:taxi", "vehicle:emergency", "bicycle", "pedestrian",
                "train", "tram")

FASTEST = 160.0
"""No road has a higher limit, km/h."""


@dataclass(frozen=True)
class TagRule:
    """What a tag of one kind of element may be.

    Attributes
    ----------
    element : "lanelet", "linestring", "regulatory element" or "point".
    key : of the tag.
    values : allowed ones; empty where any are.
    number : (lowest, highest) of a tag that is a number, or None.
    default : what the writer puts where nothing else is known; "" for none.
    source : who asks for it.
    """

    element: str
    key: str
    values: tuple[str, ...] = ()
    number: tuple[float, float] | None = None
    default: str = ""
    source: str = "Lanelet2"

    def allows(self, value: str) -> bool:
        """Whether a value is one of those allowed."""
        if self.number is None:
            return not self.values or value in self.values
        amount = as_number(value)
        return math.isfinite(amount) and self.number[0] <= amount <= self.number[1]


def as_number(value: str) -> float:
    """A tag as a number, NaN where it is none; units as in "40 km/h" are read over."""
    try:
        return float(value.split()[0])
    except (ValueError, IndexError):
        return math.nan


def speed_kmh(value: str) -> float:
    """A speed limit in km/h from "40", "40 km/h" or "30 mph"; NaN where it is none."""
    parts = value.split()
    units = {"": 1.0, "km/h": 1.0, "kmh": 1.0, "kph": 1.0, "mph": 1.609344, "m/s": 3.6, "mps": 3.6}
    unit = units.get(parts[1].lower() if len(parts) == 2 else "", math.nan) if len(parts) in (1, 2) else math.nan
    return as_number(value) * unit


YES_NO = ("yes", "no", "true", "false")

TAGS: tuple[TagRule, ...] = (
    TagRule("lanelet", "subtype", LANELET_SUBTYPES, default="road"),
    TagRule("lanelet", "location", ("urban", "nonurban", "private"), default="urban"),
    TagRule("lanelet", "one_way", YES_NO, default="yes"),
    TagRule("lanelet", "turn_direction", ("straight", "left", "right"), source="Autoware"),
    TagRule("lanelet", "turn_signal_distance", number=(0.0, 1000.0), source="Autoware"),
    *(TagRule("lanelet", f"participant:{name}", YES_NO) for name in PARTICIPANTS),
    TagRule("linestring", "type", tuple(LINE_SUBTYPES)),
    TagRule("linestring", "lane_change", YES_NO, default="no"),
    TagRule("linestring", "lane_change:left", YES_NO),
    TagRule("linestring", "lane_change:right", YES_NO),
    TagRule("linestring", "width", number=(0.0, 10.0)),
    TagRule("linestring", "sigma", number=(0.0, 100.0), source="UrbanMap"),
    TagRule("linestring", "unseen", number=(0.0, 1e5), source="UrbanMap"),
    TagRule("regulatory element", "subtype", (*LANELET2_RULES, *AUTOWARE_RULES)),
    TagRule("point", "ele_sigma", number=(0.0, 1000.0), source="UrbanMap"),
)


def tag_rule(element: str, key: str) -> TagRule | None:
    """The declaration of a tag, where there is one."""
    return _BY_KEY.get((element, key))


def defaults(element: str) -> dict[str, str]:
    """Tags with the value that each has where nothing else is known."""
    return {rule.key: rule.default for rule in TAGS if rule.element == element and rule.default}


_BY_KEY = {(rule.element, rule.key): rule for rule in TAGS}
