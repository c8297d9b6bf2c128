"""Faults of a Lanelet2 map by the rules of its validators: what breaks which rule, and where."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from ...io.osm import OsmFile
from . import (
    area_rules,
    element_rules,
    file_rules,
    intersection_rules,
    lane_rules,
    light_rules,
    member_rules,
    sense_rules,
    shape_rules,
    virtual_light_rules,
)
from .inspection import MapInspection
from .rule_table import MAP_RULES, SEVERITIES, Broken, MapRule

ROOMS = (file_rules, shape_rules, sense_rules, lane_rules, light_rules, area_rules, intersection_rules,
         virtual_light_rules, member_rules, element_rules)
"""Modules whose rules are checked, one kind of elements each."""


@dataclass(frozen=True)
class MapFault:
    """A rule that is broken.

    Attributes
    ----------
    rule : its code.
    severity : "error", "warning" or "info".
    text : what.
    element : such as "way 12".
    source : of the rule.
    longitude, latitude : where, degrees; NaN where it has no place.
    """

    rule: str
    severity: str
    text: str
    element: str
    longitude: float
    latitude: float
    source: str = ""


def check_map(content: OsmFile, excluded: Collection[str] = ()) -> list[MapFault]:
    """All faults of a Lanelet2 file, errors first.

    Parameters
    ----------
    excluded : codes of rules that are not looked at; the begin of a code stands for all that begin so.

    Raises
    ------
    InputError : an excluded code is the begin of none.
    """
    inspected = MapInspection(content)
    found = [_fault(inspected, rule, one) for code, rule in MAP_RULES.chosen(excluded).items()
             for one in MAP_RULES.functions[code](inspected, rule)]
    return sorted(found, key=lambda fault: SEVERITIES.index(fault.severity))


def _fault(inspected: MapInspection, rule: MapRule, one: Broken) -> MapFault:
    """The fault with its place, the middle node of the element."""
    nodes = inspected.nodes_of(one.kind, one.number)
    longitude, latitude = inspected.degrees[inspected.row[nodes[len(nodes) // 2]]] if nodes else (np.nan, np.nan)
    return MapFault(rule.code, rule.severity, rule.sentence(one.fields), f"{_name(inspected, one)} {one.number}",
                    float(longitude), float(latitude), rule.source)


def _name(inspected: MapInspection, one: Broken) -> str:
    """What a relation is called in the map: lanelet or regulatory element."""
    relation = inspected.content.relations.get(one.number) if one.kind == "relation" else None
    kind = relation.tags.get("type", "") if relation else ""
    return {"lanelet": "lanelet", "regulatory_element": "regulatory element"}.get(kind, one.kind)
