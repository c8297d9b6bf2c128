"""What PLATEAU asks of a building's attributes beside its geometry.

Source: the standard product specification of 3D city models (Project PLATEAU); i-UR 2.0 (uro) by its schema.
"""

from __future__ import annotations

import re
from dataclasses import replace

from ...errors import InputError
from ...wording import say
from ..model import AttributeGroup, CityObject, CodeValue, Measure
from .codelists import code_value

ID_ATTRIBUTE, QUALITY_ATTRIBUTE = "uro:buildingIDAttribute", "uro:buildingDataQualityAttribute"
AUTHORITIES = "../../codelists/Common_localPublicAuthorities.xml"
LASER, LASER_AND_STREET = "1", "2"
"""Codes of `UrbanMap_geometrySrcDesc`."""

MEDIAN = "2"
"""Code of `BuildingDataQualityAttribute_lod1HeightType`: median of the point cloud."""

PLAIN_ROOFS = "2.0"
"""The least of PLATEAU's kinds of LOD2, which asks for the main roofs; the finer ones ask for sizes that are not
measured here."""


def check_city_code(code: str) -> None:
    """Refuse what is no code of a municipality.

    Raises
    ------
    InputError : with what to give.
    """
    if code and not re.fullmatch(r"\d{5}", code):
        raise InputError(say("The code {code} is none of a municipality: give its five digits, such as 13101.",
                             code=code))


def with_plateau_attributes(item: CityObject, number: int, city_code: str = "", extended: bool = True,
                            source: str = LASER) -> CityObject:
    """A building with measured height and, `extended`, quality of data and, where the municipality is known, its id.

    What the building says already stays.

    Parameters
    ----------
    number : of the building in the data set, from 1. city_code : five digits of the municipality.
    source : what the geometry was measured by, `LASER` or `LASER_AND_STREET`.
    """
    made = dict(item.attributes)
    height = made.get("roof_max")
    if "measuredHeight" not in made and height is not None:
        made["measuredHeight"] = Measure(height, "m")
    shapes = [shape for part in item.objects() for shape in part.shapes]
    if extended and QUALITY_ATTRIBUTE not in made and any(shape.lod.startswith("1") for shape in shapes):
        values = {"geometrySrcDesc": code_value("UrbanMap_geometrySrcDesc", source),
                  "lod1HeightType": code_value("BuildingDataQualityAttribute_lod1HeightType", MEDIAN)}
        if any(shape.lod.startswith("2") for shape in shapes):
            values["lodType"] = PLAIN_ROOFS
        made[QUALITY_ATTRIBUTE] = AttributeGroup("uro:BuildingDataQualityAttribute", values)
    if extended and city_code and ID_ATTRIBUTE not in made:
        made[ID_ATTRIBUTE] = AttributeGroup("uro:BuildingIDAttribute", {
            "buildingID": f"{city_code}-bldg-{number}", "prefecture": CodeValue(city_code[:2], AUTHORITIES),
            "city": CodeValue(city_code, AUTHORITIES)})
    return replace(item, attributes=made)
