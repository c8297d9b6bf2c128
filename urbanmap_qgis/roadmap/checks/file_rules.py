"""Rules on the file: ids, references, tags and their values, coordinates, heights."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from ..formats.lanelet_tags import (
    AUTOWARE_RULES,
    LINE_SUBTYPES,
    PARTICIPANTS,
    TAGS,
    YES_NO,
)
from .inspection import MapInspection
from .rule_table import Broken, MapRule, broken, rule

APART, CURVATURE = 0.2, 1e-8
"""Local and geographic coordinates may differ by so much, m, and, with the square of the distance from the middle of
the map, by what the change of scale of projections makes of it, 1/m."""

FAR = 20000.0
"""A node so far from the middle one, and from every other, is not of the map, m."""

FAR_OFF = 0.1
"""Local coordinates of a node so far away are wrong by this share of the distance at least, where they are told."""

RELATIONS, ROLES = ("lanelet", "regulatory_element", "multipolygon"), {"left", "right", "refers", "ref_line"}
"""Types of relations that Lanelet2 reads, and roles by which a member shows that one of the first two is meant."""

SPIKE, STEEP = 1.0, 0.15
"""A node that leaves both neighbours on a bound by more than this (m) and more steeply (rise over run) is a spike;
at an end, where there is one neighbour only, twice as steeply."""


@rule("File.RepeatedId-001")
def _repeated(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for kind, number in inspected.content.repeated:
        yield broken(kind, number, kind=kind)


@rule("File.MissingReference-001")
def _missing_nodes(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for number, way in inspected.content.ways.items():
        missing = next((node for node in way.nodes if node not in inspected.row), None)
        if missing is not None:
            yield broken("way", number, missing=missing)


@rule("File.MissingReference-002")
def _short_ways(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for number, way in inspected.content.ways.items():
        if len(way.nodes) < 2:
            yield broken("way", number)


@rule("File.MissingReference-003")
def _missing_members(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    content = inspected.content
    elements = {"node": content.nodes, "way": content.ways, "relation": content.relations}
    for number, relation in content.relations.items():
        for kind, member, _ in relation.members:
            if member not in elements.get(kind, {}):
                yield broken("relation", number, kind=kind, missing=member)


@rule("File.Coordinates-001")
def _off_the_earth(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    longitude, latitude = inspected.degrees.T
    numbers = list(inspected.row)
    for k in np.flatnonzero((np.abs(latitude) > 90.0) | (np.abs(longitude) > 180.0)):
        yield broken("node", numbers[k], latitude=f"{latitude[k]:g}", longitude=f"{longitude[k]:g}")


@rule("File.Coordinates-002")
def _local_against_geographic(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    """Nodes off the similarity by which most nodes' local coordinates follow from their degrees."""
    both = np.flatnonzero(np.isfinite(inspected.local).all(axis=1) & np.isfinite(inspected.projected).all(axis=1))
    away = np.linalg.norm(inspected.projected[both], axis=1)
    both, far = both[away < FAR], both[away >= FAR]
    if len(both) < 5:
        return
    if np.ptp(inspected.projected[both], axis=0).max() < 1e-3:
        return  # all nodes at one place in degrees, as Autoware's maps in local coordinates may have them
    one, other = (values[both] @ [1, 1j] for values in (inspected.projected, inspected.local))
    weight = np.ones(len(both))
    for _ in range(20):
        middle, goal = np.average(one, weights=weight), np.average(other, weights=weight)
        turn = (weight * np.conj(one - middle) * (other - goal)).sum() / max(
            (weight * np.abs(one - middle) ** 2).sum(), LEAST_DIVISOR)
        off = np.abs(goal + turn * (one - middle) - other)
        weight = 1.0 / np.maximum(off, 0.1)
    numbers = list(inspected.row)
    if abs(abs(turn) - 1.0) > 0.02:
        yield broken("node", numbers[both[0]], apart=f"{np.median(np.abs(np.abs(one) - np.abs(other))):.0f}")
        return
    for k in np.flatnonzero(off > np.maximum(APART + CURVATURE * np.abs(one - middle) ** 2, 5.0 * np.median(off))):
        yield broken("node", numbers[both[k]], apart=f"{off[k]:.1f}")
    off = np.abs(goal + turn * (inspected.projected[far] @ [1, 1j] - middle) - inspected.local[far] @ [1, 1j])
    # Projections differ more and more with the distance.
    for k in np.flatnonzero(off > FAR_OFF * np.linalg.norm(inspected.projected[far], axis=1)):
        yield broken("node", numbers[far[k]], apart=f"{off[k]:.0f}")


@rule("File.Coordinates-003")
def _far_away(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    known = np.flatnonzero(np.isfinite(inspected.metres[:, :2]).all(axis=1))
    if len(known) < 3:
        return
    points = shapely.points(inspected.metres[known, :2])
    away = np.linalg.norm(inspected.metres[known, :2] - np.median(inspected.metres[known, :2], axis=0), axis=1)
    numbers, far = list(inspected.row), np.flatnonzero(away > FAR)
    if not len(far):
        return
    (given, _), apart = shapely.STRtree(points).query_nearest(points[far], exclusive=True, all_matches=False,
                                                              return_distance=True)
    distance = np.full(len(far), np.inf)
    distance[given] = apart
    for k in np.flatnonzero(distance > FAR / 2):
        yield broken("node", numbers[known[far[k]]], apart=f"{distance[k]:.0f}")


@rule("File.Height-001")
def _without_height(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    low = [number for number, node in inspected.content.nodes.items() if "ele" not in node.tags]
    if low:
        yield broken("node", low[0], low=len(low), all=len(inspected.row))


@rule("File.Height-002")
def _height_spikes(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    reported: set[int] = set()
    for way in dict.fromkeys(way for lane in inspected.lanes.values() for way in lane.ways):
        nodes = inspected.line(way)
        places = inspected.places(nodes)
        rise = np.diff(_as_read(places[:, 2]) if np.isnan(places[:, 2]).any() else places[:, 2])
        run = np.linalg.norm(np.diff(places[:, :2], axis=0), axis=1)
        if not (np.abs(rise) > SPIKE).any():
            continue
        steep = np.where(np.abs(rise) > SPIKE, np.abs(rise) / np.maximum(run, 1e-3), 0.0)
        inner = (np.minimum(steep[:-1], steep[1:]) > STEEP) & (rise[:-1] * rise[1:] < 0)
        spike = np.concatenate([steep[:1] > 2 * STEEP, inner, steep[-1:] > 2 * STEEP])
        for k in np.flatnonzero(spike):
            if nodes[k] not in reported:
                reported.add(nodes[k])
                yield broken("node", nodes[k], apart=f"{np.abs(rise[max(k - 1, 0):k + 1]).max():.1f}")


def _as_read(heights: np.ndarray) -> np.ndarray:
    """Heights in which the unknown ones beside one that is alone are 0, as readers take them."""
    known = np.concatenate([[False], np.isfinite(heights), [False]])
    alone = known[1:-1] & ~known[:-2] & ~known[2:]
    beside = np.concatenate([[False], alone[:-1]]) | np.concatenate([alone[1:], [False]])
    return np.where(beside, 0.0, heights)


@rule("Lanelet2.Load-002")
def _sides(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for number, relation in inspected.content.relations.items():
        if relation.tags.get("type") == "lanelet" and number not in inspected.lanes:
            roles = Counter(role for kind, way, role in relation.members if kind == "way" and inspected.line(way))
            yield broken("relation", number, left=roles["left"], right=roles["right"])


@rule("Lanelet2.Load-004")
def _sign_without_kind(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("traffic_sign"):
        ways = [inspected.content.ways[number] for number in one.ids("refers") if number in inspected.content.ways]
        with_kind = [way for way in ways if "subtype" in way.tags]
        if "sign_type" not in one.tags and not (ways and with_kind):
            yield broken("relation", one.number)


@rule("Lanelet2.Load-006")
def _extension(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    reported: set[str] = set()
    for one in inspected.rules.values():
        if one.subtype in AUTOWARE_RULES and one.subtype not in reported:
            reported.add(one.subtype)
            yield broken("relation", one.number, value=one.subtype)


@rule("Lanelet2.Load-008")
def _virtual_light_lines(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    for one in inspected.rules_of("virtual_traffic_light"):
        starts, ends = len(one.ids("start_line")), len(one.ids("end_line"))
        if starts != 1 or not ends:
            yield broken("relation", one.number, starts=starts, ends=ends)


def _without_participants(inspected: MapInspection) -> tuple[dict[str, list[int]], set[str]]:
    """Lanelets without participants by subtype, and the subtypes of which others have some."""
    without: dict[str, list[int]] = {}
    stated = set()
    for lane in inspected.lanes.values():
        if any(key.startswith("participant") for key in lane.tags):
            stated.add(lane.subtype)
        else:
            without.setdefault(lane.subtype, []).append(lane.number)
    return without, stated


@rule("Lanelet2.Participants-001")
def _participant_missing(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    without, stated = _without_participants(inspected)
    for subtype in stated & without.keys():
        for number in without[subtype]:
            yield broken("relation", number)


@rule("Lanelet2.Participants-002")
def _participants_nowhere(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    without, stated = _without_participants(inspected)
    for subtype in sorted(without.keys() - stated):
        yield broken("relation", without[subtype][0], value=subtype)


def _tagged(inspected: MapInspection) -> Iterator[tuple[str, str, int, Mapping[str, str]]]:
    """Elements as (kind of tags, kind, id, tags)."""
    for number, way in inspected.content.ways.items():
        yield "linestring", "way", number, way.tags
    for lane in inspected.lanes.values():
        yield "lanelet", "relation", lane.number, lane.tags
    for one in inspected.rules.values():
        yield "regulatory element", "relation", one.number, one.tags


@rule("mapping.mandatory_tags")
def _mandatory(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    asked = {"linestring": ("type",), "lanelet": ("subtype", "location"), "regulatory element": ()}
    members = {number for relation in inspected.content.relations.values() for kind, number, _ in relation.members
               if kind == "way"}
    for element, kind, number, tags in _tagged(inspected):
        for tag in asked[element]:
            if tag not in tags and (kind != "way" or number in members):
                yield broken(kind, number, tag=tag)
        if tags.get("type") in ("line_thin", "line_thick") and "subtype" not in tags:
            yield broken(kind, number, tag="subtype")


@rule("mapping.unknown_tag_values")
def _unknown_values(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    declared = {(one.element, one.key): one for one in TAGS if one.values != YES_NO
                and (one.element, one.key) != ("regulatory element", "subtype")}
    for element, kind, number, tags in _tagged(inspected):
        for key, value in tags.items():
            one = declared.get((element, key))
            if one is not None and not one.allows(value):
                yield broken(kind, number, tag=key, value=value)
            elif key.startswith("participant:") and key.split(":", 1)[1] not in PARTICIPANTS:
                yield broken(kind, number, tag="participant", value=key.split(":", 1)[1])
        # A virtual line may be written as if it were painted.
        like = {"virtual": "line_thin"}.get(tags.get("type", ""), tags.get("type", ""))
        subtypes = LINE_SUBTYPES.get(like, ()) if kind == "way" else ()
        if subtypes and "subtype" in tags and tags["subtype"] not in subtypes:
            yield broken(kind, number, tag="subtype", value=tags["subtype"])
    for number, relation in inspected.content.relations.items():
        # Relations of other kinds may lie in the file too; what has the members of a lanelet or a rule is meant as one.
        if relation.tags.get("type") not in RELATIONS and not ROLES.isdisjoint(role for *_, role in relation.members):
            yield broken("relation", number, tag="type", value=relation.tags.get("type", ""))


@rule("mapping.bool_tags")
def _no_bool(inspected: MapInspection, rule: MapRule) -> Iterator[Broken]:
    begins = ("one_way", "dynamic", "lane_change", "participant", "fallback", "temporary")
    for _, kind, number, tags in _tagged(inspected):
        for key, value in tags.items():
            if key.startswith(begins) and value.lower() not in (*YES_NO, "1", "0"):
                yield broken(kind, number, tag=key, value=value)
