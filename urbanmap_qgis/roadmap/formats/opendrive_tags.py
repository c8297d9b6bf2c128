"""Attributes of OpenDRIVE elements: what each may be, what it is where nothing else is known, in the file's order.

The writer makes its elements from here, and `drive_faults` holds files against it. Source: ASAM OpenDRIVE 1.7.0
(2021) and its XML schema, whose name of each element's type stands beside the element.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET  # nosec B405 # writes, reads nothing
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

ROAD_TYPE = "town"
"""Of all roads, as the lanelets' location is urban: nothing in paint and drives tells another."""

STOP_SIGN = ("DE", "294")
"""Country and type that readers of OpenDRIVE know a stop line by: sign 294 of the German catalogue."""

COLOURS = ("standard", "white", "yellow", "blue", "red", "green", "orange")

_YES_NO, _TRUE_FALSE, _ENDS = ("yes", "no"), ("true", "false"), ("start", "end")
_ROAD_TYPES = ("unknown", "rural", "motorway", "town", "lowSpeed", "pedestrian", "bicycle", "townExpressway",
               "townCollector", "townArterial", "townPrivate", "townLocal", "townPlayStreet")
_MARKS = ("none", "solid", "broken", "solid solid", "solid broken", "broken solid", "broken broken", "botts dots",
          "grass", "curb", "custom", "edge")
_FINITE, _POSITIVE = (-math.inf, math.inf), (0.0, math.inf)


@dataclass(frozen=True)
class DriveAttribute:
    """One attribute of an element.

    Attributes
    ----------
    name : in the file.
    values : allowed words; empty where any are.
    number : (lowest, highest) of a number, or None.
    default : what stands there where nothing is given; None for nothing.
    required : whether a file without it is wrong.
    """

    name: str
    values: tuple[str, ...] = ()
    number: tuple[float, float] | None = None
    default: str | float | int | None = None
    required: bool = True

    def allows(self, text: str) -> bool:
        """Whether a text is one of those allowed."""
        if self.number is None:
            return not self.values or text in self.values
        try:
            amount = float(text)
        except ValueError:
            return False
        return math.isfinite(amount) and self.number[0] <= amount <= self.number[1]


@dataclass(frozen=True)
class DriveElement:
    """An element: its type in the schema, and its attributes in the order of the file."""

    source: str
    attributes: tuple[DriveAttribute, ...] = ()


def _numbers(*names: str, number: tuple[float, float] = _FINITE) -> tuple[DriveAttribute, ...]:
    return tuple(DriveAttribute(name, number=number) for name in names)


_A = DriveAttribute
_LINKED = (_A("elementType", ("road", "junction")), _A("elementId"), _A("contactPoint", _ENDS, required=False))
_LANE = (_A("id", number=_FINITE), _A("type"), _A("level", _TRUE_FALSE, default="false"))
_SPEED = (_A("max", number=_POSITIVE), _A("unit", ("m/s", "mph", "km/h"), default="km/h"))
_CUBIC = _numbers("a", "b", "c", "d")

ELEMENTS: dict[str, DriveElement] = {
    "OpenDRIVE": DriveElement("OpenDRIVE"),
    "header": DriveElement("t_header", (
        _A("revMajor", ("1",), default=1), _A("revMinor", ("7",), default=7), _A("name", default="lane map"),
        _A("version", default="1"), *_numbers("north", "south", "east", "west"))),
    "geoReference": DriveElement("t_header_GeoReference"),
    "offset": DriveElement("t_header_Offset", (
        *_numbers("x", "y"), _A("z", number=_FINITE, default=0.0), _A("hdg", number=_FINITE, default=0.0))),
    "road": DriveElement("t_road", (
        _A("name", default=""), _A("length", number=_POSITIVE), _A("id"), _A("junction", number=(-1.0, math.inf)),
        _A("rule", ("RHT", "LHT")))),
    "road/link": DriveElement("t_road_link"),
    "road/link/predecessor": DriveElement("t_road_link_predecessorSuccessor", _LINKED),
    "road/link/successor": DriveElement("t_road_link_predecessorSuccessor", _LINKED),
    "type": DriveElement("t_road_type", (_A("s", number=_POSITIVE, default=0.0),
                                         _A("type", _ROAD_TYPES, default=ROAD_TYPE))),
    "type/speed": DriveElement("t_road_type_speed", _SPEED),
    "planView": DriveElement("t_road_planView"),
    "geometry": DriveElement("t_road_planView_geometry", (
        _A("s", number=_POSITIVE), *_numbers("x", "y", "hdg"), _A("length", number=_POSITIVE))),
    "line": DriveElement("t_road_planView_geometry_line"),
    "arc": DriveElement("t_road_planView_geometry_arc", _numbers("curvature")),
    "paramPoly3": DriveElement("t_road_planView_geometry_paramPoly3", (
        *_numbers("aU", "bU", "cU", "dU", "aV", "bV", "cV", "dV"),
        _A("pRange", ("arcLength", "normalized"), default="normalized"))),
    "elevationProfile": DriveElement("t_road_elevationProfile"),
    "elevation": DriveElement("t_road_elevationProfile_elevation", (_A("s", number=_POSITIVE), *_CUBIC)),
    "lanes": DriveElement("t_road_lanes"),
    "laneSection": DriveElement("t_road_lanes_laneSection", (_A("s", number=_POSITIVE, default=0.0),)),
    "left": DriveElement("t_road_lanes_laneSection_left"),
    "center": DriveElement("t_road_lanes_laneSection_center"),
    "right": DriveElement("t_road_lanes_laneSection_right"),
    "lane": DriveElement("t_road_lanes_laneSection_lr_lane", _LANE),
    "lane/link": DriveElement("t_road_lanes_laneSection_lcr_lane_link"),
    "lane/link/predecessor": DriveElement("t_road_lanes_laneSection_lcr_lane_link_predecessorSuccessor",
                                          _numbers("id")),
    "lane/link/successor": DriveElement("t_road_lanes_laneSection_lcr_lane_link_predecessorSuccessor",
                                        _numbers("id")),
    "width": DriveElement("t_road_lanes_laneSection_lr_lane_width", (_A("sOffset", number=_POSITIVE), *_CUBIC)),
    "roadMark": DriveElement("t_road_lanes_laneSection_lcr_lane_roadMark", (
        _A("sOffset", number=_POSITIVE, default=0.0), _A("type", _MARKS),
        _A("weight", ("standard", "bold"), required=False), _A("color", COLOURS, default="standard"),
        _A("width", number=_POSITIVE, required=False),
        _A("laneChange", ("increase", "decrease", "both", "none"), required=False))),
    "lane/speed": DriveElement("t_road_lanes_laneSection_lr_lane_speed", (
        _A("sOffset", number=_POSITIVE, default=0.0), *_SPEED)),
    "objects": DriveElement("t_road_objects"),
    "object": DriveElement("t_road_objects_object", (
        _A("id"), _A("type", default="crosswalk"), _A("subtype", required=False),
        _A("name", default="crosswalk"), _A("s", number=_POSITIVE),
        *_numbers("t"), _A("zOffset", number=_FINITE, default=0.0),
        _A("orientation", ("+", "-", "none"), default="none"),
        *(_A(name, number=_FINITE, default=0.0) for name in ("hdg", "pitch", "roll")),
        *(_A(name, number=_POSITIVE, required=False) for name in ("length", "width", "height", "radius")),
        _A("dynamic", _YES_NO, default="no"))),
    "repeat": DriveElement("t_road_objects_object_repeat", (
        _A("s", number=_POSITIVE), _A("length", number=_POSITIVE), _A("distance", number=_POSITIVE, default=0.0),
        *_numbers("tStart", "tEnd"), *_numbers("heightStart", "heightEnd", number=_POSITIVE),
        *_numbers("zOffsetStart", "zOffsetEnd"))),
    "outlines": DriveElement("t_road_objects_object_outlines"),
    "outline": DriveElement("t_road_objects_object_outlines_outline", (
        _A("id", number=_POSITIVE, default=0), _A("closed", _TRUE_FALSE, default="true"))),
    "cornerLocal": DriveElement("t_road_objects_object_outlines_outline_cornerLocal", (
        *_numbers("u", "v"), _A("z", number=_FINITE, default=0.0), _A("height", number=_POSITIVE, default=0.0),
        _A("id", number=_POSITIVE))),
    "signals": DriveElement("t_road_signals"),
    "signal": DriveElement("t_road_signals_signal", (
        _A("s", number=_POSITIVE), *_numbers("t"), _A("id"), _A("name", default="stop line"),
        _A("dynamic", _YES_NO, default="no"), _A("orientation", ("+", "-", "none")),
        _A("zOffset", number=_FINITE, default=0.0), _A("country", default=STOP_SIGN[0]),
        _A("type", default=STOP_SIGN[1]), _A("subtype", default="-1"), _A("value", number=_FINITE, default=-1.0),
        _A("height", number=_POSITIVE, default=0.0), _A("width", number=_POSITIVE, required=False),
        _A("hOffset", number=_FINITE, default=0.0))),
    "signalReference": DriveElement("t_road_signals_signalReference", (
        _A("s", number=_POSITIVE), *_numbers("t"), _A("id"), _A("orientation", ("+", "-", "none")))),
    "validity": DriveElement("t_road_objects_object_validity", _numbers("fromLane", "toLane")),
    "dependency": DriveElement("t_road_signals_signal_dependency", (_A("id"), _A("type"))),
    "positionInertial": DriveElement("t_road_signals_signal_positionInertial", _numbers("x", "y", "z", "hdg")),
    "junction": DriveElement("t_junction", (
        _A("id"), _A("name", default=""), _A("type", ("default", "virtual", "direct"), default="default"))),
    "connection": DriveElement("t_junction_connection", (
        _A("id"), _A("incomingRoad"), _A("connectingRoad"), _A("contactPoint", _ENDS, default="start"))),
    "laneLink": DriveElement("t_junction_connection_laneLink", _numbers("from", "to")),
}
"""By element; where one name stands for several, with the elements that it stands in before it."""


def drive_element(path: tuple[str, ...]) -> DriveElement | None:
    """The declaration of the element at the end of a path of names from the root, where there is one."""
    for names in (path[-3:], path[-2:], path[-1:]):
        if (found := ELEMENTS.get("/".join(names))) is not None:
            return found
    return None


class DriveNode(ET.Element):
    """An element of a file that is made: it knows where it stands, and its attributes follow the declaration."""

    def __init__(self, path: tuple[str, ...], given: dict):
        super().__init__(path[-1], drive_attributes(path, given))
        self.path = path

    def add(self, name: str, /, **given: str | float | int | None) -> DriveNode:
        """A new element in this one; attributes that are not given, or None, have their defaults (`from_`: "from")."""
        node = DriveNode((*self.path, name), {key.rstrip("_"): value for key, value in given.items()})
        self.append(node)
        return node


def drive_attributes(path: tuple[str, ...], given: dict) -> dict[str, str]:
    """Attributes of an element as the file has them, in its order: those given, else the defaults.

    Raises
    ------
    KeyError : the element or a given attribute is not declared.
    """
    declared = drive_element(path)
    if declared is None or set(given) - {one.name for one in declared.attributes}:
        raise KeyError(f"{'/'.join(path)}: {sorted(given)}")
    values = ((one.name, one.default if given.get(one.name) is None else given[one.name])
              for one in declared.attributes)
    return {name: _text(value) for name, value in values if value is not None}


def drive_faults(root: ET.Element) -> Iterator[str]:
    """What in a file is not as declared, as "road/lanes: text"; elements that nobody declared are read over."""
    open_: list[tuple[tuple[str, ...], ET.Element]] = [((root.tag,), root)]
    while open_:
        path, element = open_.pop()
        open_ += [((*path, child.tag), child) for child in element]
        declared = drive_element(path)
        for one in declared.attributes if declared else ():
            text = element.get(one.name)
            if text is None and one.required:
                yield f"{'/'.join(path)}: {one.name} is missing"
            elif text is not None and not one.allows(text):
                yield f"{'/'.join(path)}: {one.name} is {text}"


def _text(value: str | float | int) -> str:
    """A value as the file has it; more than 10 digits of a number would only be noise."""
    if isinstance(value, (str, int, np.integer)):
        return str(value)
    return f"{float(value):.10g}"
