"""Reads back the geometry of an OpenDRIVE file from its text alone, for tests: nothing of the writer is used."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field


@dataclass
class ReadRoad:
    """A road: its element, its lanes by id, and its length."""

    element: ET.Element
    lanes: dict[int, ET.Element] = field(default_factory=dict)

    @property
    def length(self) -> float:
        return float(self.element.get("length"))

    def axis(self, s: float) -> tuple[float, float, float]:
        """x, y and heading of the reference line at s."""
        held = [one for one in self.element.iter("geometry") if float(one.get("s")) <= s + 1e-9]
        geometry = held[-1]
        ds = s - float(geometry.get("s"))
        x, y, heading, length = (float(geometry.get(name)) for name in ("x", "y", "hdg", "length"))
        shape = geometry[0]
        if shape.tag == "line":
            u, v, turn = ds, 0.0, 0.0
        elif shape.tag == "arc":
            bend = float(shape.get("curvature"))
            u, v, turn = math.sin(bend * ds) / bend, (1 - math.cos(bend * ds)) / bend, bend * ds
        else:
            assert shape.get("pRange") == "normalized"
            p = ds / length
            cu, cv = ([float(shape.get(letter + side)) for letter in "abcd"] for side in "UV")
            u, v = (c[0] + c[1] * p + c[2] * p * p + c[3] * p ** 3 for c in (cu, cv))
            du, dv = (c[1] + 2 * c[2] * p + 3 * c[3] * p * p for c in (cu, cv))
            turn = math.atan2(dv, du)
        return (x + u * math.cos(heading) - v * math.sin(heading), y + u * math.sin(heading) + v * math.cos(heading),
                heading + turn)

    def offset(self, lane: int, s: float) -> float:
        """Offset to the left of a lane's outer border at s; of the reference line for 0."""
        sign = 1 if lane > 0 else -1
        return sum(sign * polynomial(self.lanes[one].findall("width"), "sOffset", s)
                   for one in range(sign, lane + sign, sign)) if lane else 0.0

    def border(self, lane: int, s: float) -> tuple[float, float]:
        """Place of a lane's outer border at s."""
        x, y, heading = self.axis(s)
        t = self.offset(lane, s)
        return x - t * math.sin(heading), y + t * math.cos(heading)

    def height(self, s: float) -> float:
        pieces = list(self.element.iter("elevation"))
        return polynomial(pieces, "s", s) if pieces else 0.0  # a road without heights lies at zero


def polynomial(pieces, at: str, s: float) -> float:
    held = [one for one in pieces if float(one.get(at)) <= s + 1e-9][-1]
    ds = s - float(held.get(at))
    a, b, c, d = (float(held.get(name)) for name in "abcd")
    return a + b * ds + c * ds * ds + d * ds ** 3


def read_roads(path) -> tuple[ET.Element, dict[str, ReadRoad]]:
    """The file's root and its roads by id."""
    root = ET.parse(path).getroot()
    roads = {}
    for element in root.findall("road"):
        (section,) = element.iter("laneSection")
        roads[element.get("id")] = ReadRoad(element, {int(lane.get("id")): lane for lane in section.iter("lane")})
    return root, roads


def widest_gap(root: ET.Element, roads: dict[str, ReadRoad]) -> float:
    """The largest distance between the borders of lanes where one is linked to the next, m."""
    worst = 0.0
    for road in roads.values():
        for kind, s in (("predecessor", 0.0), ("successor", road.length)):
            link = road.element.find(f"link/{kind}")
            if link is None or link.get("elementType") != "road":
                continue
            other = roads[link.get("elementId")]
            there = 0.0 if link.get("contactPoint") == "start" else other.length
            for number, lane in road.lanes.items():
                to = lane.find(f"link/{kind}")
                if to is None:
                    continue
                onward = int(to.get("id"))
                inner = [number - (1 if number > 0 else -1), onward - (1 if onward > 0 else -1)]
                sides = [math.dist(road.border(one, s), other.border(two, there))
                         for one, two in ((number, onward), inner)]
                along = 1 if (s == 0.0) != (there == 0.0) else -1
                if road.offset(number, s) * other.offset(onward, there) * along < 0:
                    sides = [math.dist(road.border(number, s), other.border(inner[1], there)),
                             math.dist(road.border(inner[0], s), other.border(onward, there))]
                worst = max(worst, *sides)
    return worst
