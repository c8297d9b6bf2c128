"""What PLATEAU asks of a building's attributes beside its geometry.

Source: the standard product specification of 3D city models (Project PLATEAU) 5.0, 4.2.3.2 and 4.2.4.2, with i-UR 3.2
and 3.1; its edition 2 with i-UR 2.0.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path
from typing import Any
from uuid import NAMESPACE_URL, uuid5

from ...errors import InputError
from ...wording import say
from ..model import AttributeGroup, CityObject, CodeValue, Measure
from .codelists import code_value
from .iur import VERSIONS, code_lists, iur_table

ID_ATTRIBUTE = "uro:buildingIDAttribute"
QUALITY_ATTRIBUTE, OLD_QUALITY_ATTRIBUTE = "uro:bldgDataQualityAttribute", "uro:buildingDataQualityAttribute"
AUTHORITIES_LIST = "Common_localPublicAuthorities"
AUTHORITIES = f"../../codelists/{AUTHORITIES_LIST}.xml"
_PREFECTURES = tuple((  # noqa: SIM905
    "北海道 青森県 岩手県 宮城県 秋田県 山形県 福島県 茨城県 栃木県 群馬県 埼玉県 千葉県 東京都 神奈川県 "
    "新潟県 富山県 石川県 福井県 山梨県 長野県 岐阜県 静岡県 愛知県 三重県 滋賀県 京都府 大阪府 兵庫県 "
    "奈良県 和歌山県 鳥取県 島根県 岡山県 広島県 山口県 徳島県 香川県 愛媛県 高知県 福岡県 佐賀県 長崎県 "
    "熊本県 大分県 宮崎県 鹿児島県 沖縄県").split())
"""By their codes, JIS X 0401, from 01."""

_OWN_ID = re.compile(r"bldg_[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}", re.IGNORECASE)

PUBLIC_SURVEY, AIRBORNE_LASER, OTHER_MATERIAL, NOT_MADE = "000", "112", "700", "999"
"""Codes of `DataQualityAttribute_geometrySrcDesc`."""

NO_PUBLIC_SURVEY = "100"
"""Code of `DataQualityAttribute_thematicSrcDesc`: a survey that is no public one."""

PUBLIC_AIRBORNE_LASER = "012"
"""Code of `PublicSurveyDataQualityAttribute_publicSurveySrcDesc`."""

SCALES = {5000: "0", 2500: "1", 1000: "2", 500: "3"}
"""Codes of `PublicSurveyDataQualityAttribute_srcScale` by map level."""

LASER = "1"
"""Code of `UrbanMap_geometrySrcDesc`."""

MEDIAN = "2"
"""Code of the lists of lod1HeightType: median of the point cloud."""

PLAIN_ROOFS = "2.0"
"""The least of PLATEAU's kinds of LOD2, which asks for the main roofs; the finer ones ask for sizes that are not
measured here."""

_LEVELS = "01234"


@dataclass(frozen=True)
class PlateauDelivery:
    """What a delivery says of all its buildings.

    Attributes
    ----------
    version : of i-UR, one of `VERSIONS`.
    city_code : five digits of the municipality; empty for none.
    measured : whether the models are of laser points by this program; else nothing is known of where they come from.
    map_level : of the public survey that the points are of, one of `SCALES`; 0 where it is none.
    created : day on which the data were made, ISO 8601; empty where not known.
    schemas : folder with the schemas of i-UR that go along; None for none.
    """

    version: str = VERSIONS[0]
    city_code: str = ""
    measured: bool = True
    map_level: int = 0
    created: str = ""
    schemas: Path | None = None

    @property
    def lists(self) -> dict[str, dict[str, str]]:
        """Lists of codes that the buildings' ids refer to: the prefecture and the municipality."""
        if not self.city_code:
            return {}
        number = int(self.city_code[:2])
        prefecture = _PREFECTURES[number - 1] if 1 <= number <= len(_PREFECTURES) else self.city_code[:2]
        return {AUTHORITIES_LIST: {self.city_code[:2]: prefecture,
                                   self.city_code: f"{prefecture} 市区町村コード{self.city_code}"}}


def check_city_code(code: str) -> None:
    """Refuse what is no code of a municipality.

    Raises
    ------
    InputError : with what to give.
    """
    if code and not re.fullmatch(r"\d{5}", code):
        raise InputError(say("The code {code} is none of a municipality: give its five digits, such as 13101.",
                             code=code))


def with_plateau_attributes(item: CityObject, number: int, delivery: PlateauDelivery | None = None,
                            extended: bool = True) -> CityObject:
    """A building with measured height and, `extended`, quality of data and, where the municipality is known, its id.

    What the building says already stays.

    Parameters
    ----------
    number : of the building in the data set, from 1.
    """
    delivery = delivery or PlateauDelivery()
    attributes = dict(item.attributes)
    height = attributes.get("roof_max")
    if "measuredHeight" not in attributes and height is not None:
        attributes["measuredHeight"] = Measure(height, "m")
    if not extended:
        return replace(item, attributes=attributes)
    attributes = _with_quality(attributes, item, delivery)
    if delivery.created:
        attributes.setdefault("creationDate", date.fromisoformat(delivery.created))
    if not delivery.city_code:
        return replace(item, attributes=attributes)
    parts = tuple(_under_own_id(replace(part, attributes=_with_id(part.attributes, number, delivery.city_code, place)),
                                delivery.city_code) for place, part in enumerate(item.parts, 1))
    attributes = _with_id(attributes, number, delivery.city_code)
    return _under_own_id(replace(item, attributes=attributes, parts=parts), delivery.city_code)


def _under_own_id(item: CityObject, city_code: str) -> CityObject:
    """A building under an id as PLATEAU's data have it, bldg_ and a UUID; made of the one it has, which stays as the
    attribute source_id."""
    if _OWN_ID.fullmatch(item.id):
        return item
    uuid = uuid5(NAMESPACE_URL, f"urn:urbanmap:{city_code}:{item.id}")
    return replace(item, id=f"bldg_{uuid}", attributes={"source_id": item.id, **item.attributes})


def _with_id(attributes: dict[str, Any], number: int, city_code: str, part: int = 0) -> dict[str, Any]:
    """Attributes with the id of the building, which its parts share and tell apart by their number."""
    if ID_ATTRIBUTE in attributes:
        return dict(attributes)
    values = {"buildingID": f"{city_code}-bldg-{number}", **({"partID": part} if part else {}),
              "prefecture": CodeValue(city_code[:2], AUTHORITIES), "city": CodeValue(city_code, AUTHORITIES)}
    return {**attributes, ID_ATTRIBUTE: AttributeGroup("uro:BuildingIDAttribute", values)}


def _with_quality(attributes: dict[str, Any], item: CityObject, delivery: PlateauDelivery) -> dict[str, Any]:
    """Attributes with a quality attribute that the version can hold."""
    table = iur_table(delivery.version)
    stated = {name: attributes[name] for name in (QUALITY_ATTRIBUTE, OLD_QUALITY_ATTRIBUTE) if name in attributes}
    if any(table.fitted(name, value) for name, value in stated.items()):
        return attributes
    levels = {shape.lod[0] for part in item.objects() for shape in part.shapes}
    if delivery.version == "2.0":
        name, values = OLD_QUALITY_ATTRIBUTE, _old_quality(levels, delivery)
    else:
        name, values = QUALITY_ATTRIBUTE, _quality(levels, delivery, next(iter(stated.values()), None))
    if not values or name in stated:
        return attributes
    return {**attributes, name: AttributeGroup(_type_of(name), values)}


def _type_of(name: str) -> str:
    return "uro:DataQualityAttribute" if name == QUALITY_ATTRIBUTE else "uro:BuildingDataQualityAttribute"


def _old_quality(levels: set[str], delivery: PlateauDelivery) -> dict[str, Any]:
    """Quality as i-UR 2.0 has it, which asks how LOD1 got its height."""
    if "1" not in levels or not delivery.measured:
        return {}
    values: dict[str, Any] = {"geometrySrcDesc": code_value("UrbanMap_geometrySrcDesc", LASER),
                              "lod1HeightType": code_value("BuildingDataQualityAttribute_lod1HeightType", MEDIAN)}
    return {**values, "lodType": PLAIN_ROOFS} if "2" in levels else values


def _quality(levels: set[str], delivery: PlateauDelivery, older: Any) -> dict[str, Any]:
    """Quality as i-UR 3 has it: source of each level of detail, LOD0 to LOD2 in any case.

    `older` : quality attribute of another version, of which the kinds of LOD and of heights are kept.
    """
    old_values = older.values if isinstance(older, AttributeGroup) else {}
    source = (PUBLIC_SURVEY if delivery.map_level else AIRBORNE_LASER) if delivery.measured else OTHER_MATERIAL
    wanted = [level for level in _LEVELS if level in levels or level in "012"]
    values: dict[str, Any] = {f"geometrySrcDescLod{level}": code_value(
        "DataQualityAttribute_geometrySrcDesc", source if level in levels else NOT_MADE) for level in wanted}
    if delivery.measured:
        thematic = PUBLIC_SURVEY if delivery.map_level else NO_PUBLIC_SURVEY
        values["thematicSrcDesc"] = code_value("DataQualityAttribute_thematicSrcDesc", thematic)
    kinds = _codes(old_values, "lodType", "Building_lodType") or (
        [PLAIN_ROOFS] if delivery.measured and "2" in levels else [])
    if kinds:
        values["lodType"] = [code_value("Building_lodType", kind) for kind in kinds]
    heights = _codes(old_values, "lod1HeightType", "DataQualityAttribute_lod1HeightType") or (
        [MEDIAN] if delivery.measured and "1" in levels else [])
    if heights:
        values["lod1HeightType"] = code_value("DataQualityAttribute_lod1HeightType", heights[0])
    if delivery.measured and delivery.map_level:
        present = [level for level in wanted if level in levels]
        scale, laser = ("PublicSurveyDataQualityAttribute_srcScale", SCALES[delivery.map_level]), (
            "PublicSurveyDataQualityAttribute_publicSurveySrcDesc", PUBLIC_AIRBORNE_LASER)
        values["publicSurveyDataQualityAttribute"] = AttributeGroup("uro:PublicSurveyDataQualityAttribute", {
            **{f"srcScaleLod{level}": code_value(*scale) for level in present},
            **{f"publicSurveySrcDescLod{level}": code_value(*laser) for level in present}})
    return values


def _codes(values: Mapping[str, Any], name: str, listed: str) -> list[str]:
    """Codes of an attribute that the list of today has."""
    value = values.get(f"uro:{name}", values.get(name))
    given = value if isinstance(value, list) else [] if value is None else [value]
    texts = [str(item.value if isinstance(item, CodeValue) else item) for item in given]
    return [text for text in texts if text in code_lists()[listed]]
