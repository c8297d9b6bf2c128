"""Rules on features, their attributes and the kinds of their geometries."""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import date
from xml.etree.ElementTree import Element  # nosec B405 # elements alone, no parser

from ...io.files.rule_table import CheckRule
from .checked_file import FREE_PACKAGES, PACKAGES, CityBlock
from .city_rule_table import Violation, city_rule, violation
from .feature_walk import CityFeature, tag_name
from .standard_lists import DESIGNATED_CITIES, could_be_municipality

_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9]*_[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\Z", re.IGNORECASE)
_BUILDING_ID = re.compile(r"(\d{5})-[a-z]{3,4}-\d+\Z")

USABLE: dict[str, dict[int, tuple[str, ...]]] = {
    "bldg:Building": {0: ("lod0FootPrint", "lod0RoofEdge"), 1: ("lod1Solid",), 2: ("lod2Solid",), 3: ("lod3Solid",),
                      4: ("lod4Solid", "lod4MultiSurface")},
    "bldg:BuildingPart": {2: ("lod2Solid",), 3: ("lod3Solid",), 4: ("lod4Solid", "lod4MultiSurface")},
    "bldg:Room": {4: ("lod4Solid",)},
    **{f"bldg:{name}": {level: (f"lod{level}MultiSurface",) for level in levels} for name, levels in (
        ("RoofSurface", (2, 3, 4)), ("WallSurface", (2, 3, 4)), ("GroundSurface", (2, 3, 4)),
        ("OuterFloorSurface", (2, 3, 4)), ("OuterCeilingSurface", (3, 4)), ("ClosureSurface", (2, 3, 4)),
        ("InteriorWallSurface", (4,)), ("CeilingSurface", (4,)), ("FloorSurface", (4,)), ("Door", (3, 4)),
        ("Window", (3, 4)))},
    "bldg:BuildingInstallation": {level: (f"lod{level}Geometry",) for level in (2, 3, 4)},
    "bldg:IntBuildingInstallation": {4: ("lod4Geometry",)}, "bldg:BuildingFurniture": {4: ("lod4Geometry",)},
    "tran:Road": {0: ("lod0Network", "lod0Geometry"), **{k: (f"lod{k}MultiSurface",) for k in (1, 2, 3)}},
    "tran:TrafficArea": {k: (f"lod{k}MultiSurface",) for k in (2, 3)},
    "tran:AuxiliaryTrafficArea": {k: (f"lod{k}MultiSurface",) for k in (2, 3)},
    "frn:CityFurniture": {k: (f"lod{k}Geometry",) for k in (0, 1, 2, 3)}}
"""Geometries that a feature may have, by its level of detail (specification, tables 4-27, 4-149 and 4-668)."""

_MANDATORY_QUALITY = {"tran:Road": "tranDataQualityAttribute", "frn:CityFurniture": "frnDataQualityAttribute"}
"""Properties with the quality attribute that occur once (specification, 4.3.3 and 4.14.3)."""
_PUBLIC = "000"
_NUMBERS = {"measuredHeight": float, "storeysAboveGround": int, "storeysBelowGround": int, "totalFloorArea": float,
            "buildingFootprintArea": float, "buildingRoofEdgeArea": float, "buildingHeight": float,
            "eaveHeight": float, "siteArea": float, "width": float, "branchID": int, "partID": int}
_KINDS = {float: "number", int: "whole number"}
_YEARS = {"yearOfConstruction", "yearOfDemolition", "surveyYear"}
_DATES = {"creationDate", "terminationDate"}


def _values(feature: CityFeature) -> Iterator[tuple[str, str]]:
    """Names and texts of the simple values of a feature and of its data types."""
    stack = [feature.element]
    while stack:
        for child in stack.pop():
            prefix, name = tag_name(child.tag)
            if len(child) == 0:
                yield name, (child.text or "").strip()
            elif prefix in ("uro", "urf"):
                stack.append(child)


def _groups(feature: CityFeature, name: str) -> Iterator[Element]:
    """Data types of a name in the feature's own properties."""
    for holder in feature.element:
        for item in holder:
            if tag_name(item.tag)[1] == name:
                yield item


def _text(element: Element, name: str) -> str | None:
    """Text of the first child of a name; None without."""
    return next(((child.text or "").strip() for child in element if tag_name(child.tag)[1] == name), None)


@city_rule("C04")
def _unusable(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for feature in block.features(*USABLE):
        usable = USABLE[feature.type]
        for name in feature.geometry:
            level = int(name[3])
            if name not in usable.get(level, ()):
                yield violation(feature, level, type=feature.type, name=name)


@city_rule("C05")
def _missing(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    """What operation makes mandatory of city objects; each building's id, the quality of roads and furniture."""
    for thing in block.things:
        top = thing.features[0]
        names = {tag_name(child.tag)[1] for child in top.element}
        if top.type.startswith(("core:", "grp:", "app:")):
            continue
        if "creationDate" not in names:
            yield violation(top, name="core:creationDate")
        if top.type == "bldg:Building" and not names & {"buildingIDAttribute", "consistsOfBuildingPart"}:
            yield violation(top, name="uro:buildingIDAttribute")
        quality = _MANDATORY_QUALITY.get(top.type)
        if quality is not None and quality not in names:
            yield violation(top, name=f"uro:{quality}")


def _quality(feature: CityFeature) -> Element | None:
    """The quality attribute of a feature (uro:DataQualityAttribute)."""
    return next(_groups(feature, "DataQualityAttribute"), None)


def _levels(block: CityBlock) -> Iterator[tuple[CityFeature, Element | None, set[int]]]:
    """Features that quality is said of, with it, and the levels that they and what they hold have a geometry of."""
    for thing in block.things:
        top = thing.features[0]
        if top.type.partition(":")[2] == "CityObjectGroup":
            continue
        parts = [one for one in thing.features if one.type == "bldg:BuildingPart" and _quality(one) is not None]
        levels = {level for one in thing.features for level in one.lods
                  if not any(_within(one, part) for part in parts)}
        if levels or _quality(top) is not None:
            yield top, _quality(top), levels
        for part in parts:
            yield part, _quality(part), {level for one in thing.features if _within(one, part) for level in one.lods}


def _within(feature: CityFeature, holder: CityFeature) -> bool:
    one: CityFeature | None = feature
    while one is not None and one is not holder:
        one = one.parent
    return one is holder


@city_rule("C07")
def _no_source(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    if block.file.package in FREE_PACKAGES:
        return
    for feature, quality, levels in _levels(block):
        for level in sorted(levels):
            if quality is None or not _text(quality, f"geometrySrcDescLod{level}"):
                yield violation(feature, level, level=level)


@city_rule("C08")
def _no_public_survey(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for feature, quality, _ in _levels(block):
        if quality is None:
            continue
        survey = next((item for holder in quality for item in holder
                       if tag_name(item.tag)[1] == "PublicSurveyDataQualityAttribute"), None)
        for level in range(5):
            sources = {(child.text or "").strip() for child in quality
                       if tag_name(child.tag)[1] == f"geometrySrcDescLod{level}"}
            if sources != {_PUBLIC}:
                continue
            missing = [name for name in (f"srcScaleLod{level}", f"publicSurveySrcDescLod{level}")
                       if survey is None or not _text(survey, name)]
            if missing:
                yield violation(feature, level, level=level, name=", ".join(f"uro:{name}" for name in missing))


@city_rule("L02.value")
def _value_of_another_kind(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for feature in block.features():
        for name, text in _values(feature):
            kind = _wrong_kind(name, text)
            if kind:
                yield violation(feature, name=name, value=text[:40], kind=kind)


def _wrong_kind(name: str, text: str) -> str:
    """What a value should be and is not; empty where it is right, or nothing is known of its kind."""
    if name in _NUMBERS:
        kind = _NUMBERS[name]
        form = r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?" if kind is float else r"[-+]?\d+"
        return "" if re.fullmatch(form, text) else _KINDS[kind]
    if name in _YEARS:
        return "" if re.fullmatch(r"-?\d{4,}(Z|[-+]\d\d:\d\d)?", text) else "year"
    if name in _DATES:
        try:
            date.fromisoformat(re.sub(r"(Z|[-+]\d\d:\d\d)\Z", "", text) if len(text) > 10 else text)
        except ValueError:
            return "date"
    return ""


@city_rule("L03")
def _not_of_the_schema(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    package = block.file.package
    known = PACKAGES.get(package)
    if known is None:
        return
    for thing in block.things:
        kind = thing.features[0].type
        if kind not in known and not kind.startswith(("grp:", "app:")):
            yield violation(thing.features[0], type=kind.partition(":")[2], package=package)


@city_rule("L04")
def _unknown_code(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for thing in block.things:
        for feature, element, _parent in thing.codes:
            space, value = element.get("codeSpace") or "", (element.text or "").strip()
            codes = block.file.codes(space)
            unknown = not block.file.lists_there and re.fullmatch("9+", value)  # cities' lists say "unknown" so
            if codes and value not in codes and not unknown:
                yield violation(feature, name=_qualified(element), value=value, list=space)


@city_rule("L04.list")
def _unknown_list(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for thing in block.things:
        for feature, element, parent in thing.codes:
            space = element.get("codeSpace") or ""
            if block.file.codes(space) is None and not _named_after(element, parent, space, block):
                yield violation(feature, name=_qualified(element), list=space)


def _named_after(element: Element, parent: Element, space: str, block: CityBlock) -> bool:
    """Whether a list that the data set does not bring is called as the specification calls them: type and property."""
    name = re.split(r"[/\\]", space)[-1].removesuffix(".xml")
    return not block.file.lists_there and name == f"{tag_name(parent.tag)[1]}_{tag_name(element.tag)[1]}"


def _qualified(element: Element) -> str:
    return ":".join(filter(None, tag_name(element.tag)))


@city_rule("L-bldg-04")
def _usage_without_major(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for feature in block.features("bldg:Building"):
        if any(_text(group, "majorUsage2") and not _text(group, "majorUsage")
               for group in _groups(feature, "BuildingDetailAttribute")):
            yield violation(feature)


@city_rule("L-bldg-05")
def _usage_without_coarser(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for feature in block.features("bldg:Building"):
        for name, above in (("detailedUsage2", "detailedUsage"), ("detailedUsage3", "detailedUsage2")):
            if any(_text(group, name) and not _text(group, above)
                   for group in _groups(feature, "BuildingDetailAttribute")):
                yield violation(feature, name=f"uro:{name}", above=f"uro:{above}")


def _kinds(block: CityBlock, names: tuple[str, ...], allowed: tuple[str, ...], types: tuple[str, ...] = (),
           ) -> Iterator[Violation]:
    """Geometries of other kinds than allowed in properties of some names."""
    for feature in block.features(*types):
        for name in names:
            for kind in feature.geometry.get(name, ()):
                if kind not in allowed:
                    yield violation(feature, int(name[3]), name=name, kind=kind)


@city_rule("L-frn-01")
def _geometry_kind(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    yield from _kinds(block, ("lod1Geometry", "lod2Geometry", "lod3Geometry"), ("MultiSurface", "Solid"))


@city_rule("L-frn-02")
def _geometry_kind_0(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    yield from _kinds(block, ("lod0Geometry",), ("Point", "MultiPoint", "MultiCurve", "MultiSurface"))


@city_rule("T-bldg-02")
def _installation_kind(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    yield from _kinds(block, ("lod2Geometry", "lod3Geometry"), ("MultiSurface", "Solid"),
                      ("bldg:BuildingInstallation",))


@city_rule("D-gml-id")
def _id_of_another_form(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for thing in block.things:
        top = thing.features[0]
        if not _IDENTIFIER.match(top.id):
            yield violation(top, id=top.id)


@city_rule("D-building-id")
def _building_id(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for feature in block.features("bldg:Building", "bldg:BuildingPart"):
        for group in _groups(feature, "BuildingIDAttribute"):
            identifier = _text(group, "buildingID") or ""
            if not _BUILDING_ID.match(identifier):
                yield violation(feature, id=identifier)


@city_rule("D-city-code")
def _municipality(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for feature in block.features():
        for group in _groups(feature, "BuildingIDAttribute"):
            city = next((child for child in group if tag_name(child.tag)[1] == "city"), None)
            code = (city.text or "").strip() if city is not None else ""
            known = block.file.codes(city.get("codeSpace") or "") if city is not None else None
            why = _wrong_city(code, known)
            if why:
                yield violation(feature, code=code or "-", why=why[0], why_ja=why[1])


def _wrong_city(code: str, known: frozenset[str] | None) -> tuple[str, str] | None:
    """What is wrong with a municipality's code, in English and Japanese."""
    if code in DESIGNATED_CITIES:
        return "is that of a city with wards: give the ward's", "政令指定都市のコードです。区のコードとしてください"
    if code not in known if known else not could_be_municipality(code):
        return "is none of the list", "コードリストに該当がありません"
    return None
