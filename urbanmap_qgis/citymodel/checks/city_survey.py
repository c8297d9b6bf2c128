"""What rules on the whole data set need of every file, kept small: ids as numbers, outlines, references that lead out
of their city object."""

from __future__ import annotations

import hashlib
import re
from array import array
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
import shapely

from .checked_file import CheckedFile, CityBlock
from .feature_walk import CityFeature, CityLink, tag_name

_LEVEL = re.compile(r"lod[0-4](\w+)")
_TAKEN = {
    **dict.fromkeys(("surfaceMember", "baseSurface"), frozenset((
        "Polygon", "CompositeSurface", "OrientableSurface", "Surface", "TriangulatedSurface", "Tin", "Triangle"))),
    "curveMember": frozenset(("LineString", "Curve", "CompositeCurve", "OrientableCurve")),
    "pointMember": frozenset(("Point",)),
    **dict.fromkeys(("Solid", "solidMember"), frozenset(("Solid", "CompositeSolid"))),
    **dict.fromkeys(("MultiSurface", "FootPrint", "RoofEdge"), frozenset(("MultiSurface",))),
    "MultiCurve": frozenset(("MultiCurve",)),
    "opening": frozenset(("Door", "Window")), "consistsOfBuildingPart": frozenset(("BuildingPart",)),
    "interiorRoom": frozenset(("Room",)), "outerBuildingInstallation": frozenset(("BuildingInstallation",)),
    **dict.fromkeys(("interiorBuildingInstallation", "roomInstallation"), frozenset(("IntBuildingInstallation",))),
    "interiorFurniture": frozenset(("BuildingFurniture",)), "trafficArea": frozenset(("TrafficArea",)),
    "auxiliaryTrafficArea": frozenset(("AuxiliaryTrafficArea",))}
"""What properties take, by their names; of those with a level of detail by what follows it (CityGML 2.0, GML 3.1.1)."""

ROAD_AREAS = ("tran:TrafficArea", "tran:AuxiliaryTrafficArea")


@dataclass(eq=False)
class NamedFeature:
    """A feature as a finding needs it when its file is long passed."""

    file: CheckedFile
    type: str
    id: str
    place: tuple[float, float] | None
    function: str = ""


@dataclass(eq=False)
class PlanOutline:
    """A solid or road surface in plan (degrees or metres as in the file) with its heights."""

    feature: NamedFeature
    plan: shapely.Geometry
    low: float
    high: float


@dataclass(eq=False)
class CitySurvey:
    """All that rules on several files need.

    Attributes
    ----------
    ids : hash of every id
    tags : number of the tag that has it
    files : number of its file.
    kinds : tags by their number.
    building_ids : features by building id that have neither branch nor part.
    solids, areas, roads : outlines by level of detail.
    links : references that lead out of their city object.
    """

    ids: array = field(default_factory=lambda: array("q"))
    tags: array = field(default_factory=lambda: array("H"))
    files: array = field(default_factory=lambda: array("H"))
    kinds: dict[tuple[str, str], int] = field(default_factory=dict)
    building_ids: dict[str, list[NamedFeature]] = field(default_factory=dict)
    solids: dict[int, list[PlanOutline]] = field(default_factory=dict)
    areas: dict[int, list[PlanOutline]] = field(default_factory=dict)
    roads: dict[int, list[PlanOutline]] = field(default_factory=dict)
    links: list[tuple[NamedFeature, CityLink]] = field(default_factory=list)
    read: list[CheckedFile] = field(default_factory=list)

    def add(self, block: CityBlock) -> None:
        """Keep what a block has of all this."""
        counts = Counter(block.file.counts)
        for thing in block.things:
            counts.update(feature.type for feature in thing.features)
            tag_of_id = {identifier: tag for identifier, tag, _ in thing.ids}
            for identifier, tag, _ in thing.ids:
                self.ids.append(id_number(identifier))
                self.tags.append(self.kinds.setdefault(tag, len(self.kinds)))
                self.files.append(block.file.number)
            for link in thing.references:
                target = link.target[1:] if link.target.startswith("#") else None
                if target is None or target not in tag_of_id or wrong_target(link, tag_of_id[target]):
                    self.links.append((named(block.file, link.feature), _bare(link)))
            self._add_building_ids(block.file, thing.features)
        block.file.counts = dict(counts)
        self._add_outlines(block)

    def join(self, other: CitySurvey) -> None:
        """Take what another one has kept of other files."""
        tags = np.array([self.kinds.setdefault(tag, len(self.kinds)) for tag in other.kinds], np.uint16)
        self.ids.extend(other.ids)
        self.files.extend(other.files)
        self.tags.frombytes(tags[np.frombuffer(other.tags, np.uint16)].tobytes() if other.tags else b"")
        self.links += other.links
        self.read += other.read
        for mine, theirs in ((self.building_ids, other.building_ids), (self.solids, other.solids),
                             (self.areas, other.areas), (self.roads, other.roads)):
            for key, found in theirs.items():
                mine.setdefault(key, []).extend(found)

    def _add_building_ids(self, file: CheckedFile, features: Iterable[CityFeature]) -> None:
        for feature in features:
            if feature.type != "bldg:Building":
                continue
            values = {tag_name(item.tag)[1]: (item.text or "").strip() for holder in feature.element
                      for group in holder if tag_name(group.tag)[1] == "BuildingIDAttribute" for item in group}
            if values.get("buildingID") and not values.get("branchID") and not values.get("partID"):
                self.building_ids.setdefault(values["buildingID"], []).append(named(file, feature))

    def _add_outlines(self, block: CityBlock) -> None:
        """Outlines of buildings' solids (their lowest level faces) and of road surfaces."""
        shapes = block.shapes
        solids: dict[tuple[int, int], list[int]] = {}
        roads: dict[tuple[int, int], list[int]] = {}
        for number, polygon in enumerate(shapes.polygons):
            if polygon.lod is None:
                continue
            key = (id(polygon.feature), polygon.lod)
            if (polygon.owner is not None and polygon.name.endswith("Solid") and polygon.feature.type in (
                    "bldg:Building", "bldg:BuildingPart")) or polygon.feature.type == "bldg:GroundSurface":
                solids.setdefault(key, []).append(number)
            elif polygon.lod in (2, 3) and polygon.feature.type in (*ROAD_AREAS, "tran:Road"):
                roads.setdefault(key, []).append(number)
        for (_, level), numbers in solids.items():
            top = shapes.polygons[numbers[0]].feature
            outline = _outline(block, named(block.file, top.top), numbers, lowest=True)
            if outline is not None:
                self.solids.setdefault(level, []).append(outline)
        for (_, level), numbers in roads.items():
            feature = shapes.polygons[numbers[0]].feature
            outline = _outline(block, named(block.file, feature), numbers, lowest=False)
            if outline is not None:
                place = self.areas if feature.type in ROAD_AREAS else self.roads
                place.setdefault(level, []).append(outline)


def id_number(identifier: str) -> int:
    """A number of 63 bits for an id: two ids with the same one are not to be expected in any data set."""
    return int.from_bytes(hashlib.blake2b(identifier.encode("utf-8", "replace"), digest_size=8).digest(), "big") >> 1


def named(file: CheckedFile, feature: CityFeature) -> NamedFeature:
    """A feature without its element."""
    place = feature.place if feature.place is not None else feature.top.place
    function = next(((child.text or "").strip() for child in feature.children("function")), "")
    return NamedFeature(file, feature.type, feature.id, tuple(place[:2]) if place is not None else None, function)


def wrong_target(link: CityLink, tag: tuple[str, str]) -> bool:
    """Whether a reference leads to another kind of thing than its property takes."""
    geometric = link.tag[0] == "gml" or link.tag[1].startswith("lod")
    if geometric != (tag[0] == "gml"):
        return True
    if link.tag[1] == "boundedBy":
        return not tag[1].endswith("Surface")
    level = _LEVEL.match(link.tag[1])
    taken = _TAKEN.get(level.group(1) if level else link.tag[1])
    return taken is not None and tag[1] not in taken


def _bare(link: CityLink) -> CityLink:
    """A reference without its feature, whose element would keep the whole city object in memory."""
    return CityLink(None, link.target, link.tag, link.name)


def _outline(block: CityBlock, feature: NamedFeature, numbers: list[int], lowest: bool) -> PlanOutline | None:
    """Plan of some polygons: of all that lie, or of the lowest ones."""
    shapes = block.shapes
    numbers_of = np.array(numbers)
    ends = np.append(shapes.outer_ring[1:], len(shapes.polygon))
    heights = [shapes.raw[shapes.start[shapes.outer_ring[k]]:shapes.start[ends[k]], 2] for k in numbers]
    low, high = min(one.min() for one in heights), max(one.max() for one in heights)
    lying = np.abs(shapes.normals[numbers_of, 2]) > (0.5 if lowest else 0.1)
    if lowest:
        lying &= np.array([one.min() for one in heights]) <= low + 0.5
        lying &= shapes.normals[numbers_of, 2] < 0 if (shapes.normals[numbers_of[lying], 2] < 0).any() else True
    plans = [shapes.plan(k, block.file.geographic) for k, flat in zip(numbers, lying) if flat]
    plans = [plan for plan in plans if plan is not None]
    if not plans:
        return None
    plan = plans[0] if len(plans) == 1 else shapely.union_all(shapely.make_valid(np.array(plans, object)))
    return PlanOutline(feature, plan, float(low), float(high))
