"""Tables of what i-UR lets objects say, one a version, from its XML schemas; and its lists of codes.

Run: `python scripts/make_iur_tables.py SCHEMAS [SPECIFICATION]`. SCHEMAS is the folder with `<version>/urbanObject.xsd`
of each version, SPECIFICATION the text of PLATEAU's standard product specification, in which the lists of codes stand.
"""

from __future__ import annotations

import csv
import re
import sys
from pathlib import Path
from xml.etree import ElementTree as Xml

ROOT = Path(__file__).resolve().parents[1]
PLACE = ROOT / "urbanmap_qgis" / "citymodel" / "citygml"
VERSIONS = ("2.0", "3.1", "3.2")
HOOKS = {"Building": ("bldg:_GenericApplicationPropertyOfAbstractBuilding",),
         "CityFurniture": ("frn:_GenericApplicationPropertyOfCityFurniture",),
         "Vegetation": ("veg:_GenericApplicationPropertyOfVegetationObject",
                        "veg:_GenericApplicationPropertyOfSolitaryVegetationObject"),
         "Road": ("tran:_GenericApplicationPropertyOfTransportationComplex", "tran:_GenericApplicationPropertyOfRoad")}
"""Properties that elements of i-UR stand in for, by the objects that have them."""
XS = "{http://www.w3.org/2001/XMLSchema}"
HEADER = ("owner", "name", "kind", "least", "most", "choice", "older")

KINDS = {"gml:CodeType": "code", "xs:string": "text", "xs:anyURI": "text", "xs:integer": "whole",
         "xs:nonNegativeInteger": "whole", "xs:positiveInteger": "whole", "xs:double": "number", "xs:decimal": "number",
         "gml:MeasureType": "measure", "gml:LengthType": "measure", "gml:VolumeType": "measure",
         "gml:AreaType": "measure", "xs:date": "date", "xs:gYear": "year", "xs:boolean": "truth"}

LISTS = "DataQuality|PublicSurvey|Building_lodType"
FURNITURE_LISTS = "CityFurniture_"
ROAD_LISTS = "TransportationComplex_class|Road_|RoadStructureAttribute"
"""Begins of the names of the lists of quality attributes, of furniture, and of roads."""

OLDER = {"bldgDataQualityAttribute": "buildingDataQualityAttribute",
         "bldgDisasterRiskAttribute": "buildingDisasterRiskAttribute",
         "bldgKeyValuePairAttribute": "keyValuePairAttribute",
         "RiverFloodingRiskAttribute": "BuildingRiverFloodingRiskAttribute",
         "InlandFloodingRiskAttribute": "BuildingInlandFloodingRiskAttribute",
         "HighTideRiskAttribute": "BuildingHighTideRiskAttribute",
         "TsunamiRiskAttribute": "BuildingTsunamiRiskAttribute",
         "LandSlideRiskAttribute": "BuildingLandSlideRiskAttribute"}
"""Names of today with those of i-UR 2.0."""


class Schema:
    """The elements and types of one schema file."""

    def __init__(self, path: Path):
        root = Xml.parse(path).getroot()
        self.elements = {item.get("name"): item for item in root.findall(f"{XS}element")}
        self.types = {item.get("name"): item for kind in ("complexType", "simpleType")
                      for item in root.findall(f"{XS}{kind}")}

    def concrete(self, name: str) -> list[str]:
        """Elements that can stand for an element: itself unless it is abstract, and its substitutes."""
        own = [] if self.elements[name].get("abstract") == "true" else [name]
        return own + [found for other, item in self.elements.items()
                      if item.get("substitutionGroup") == f"uro:{name}" for found in self.concrete(other)]

    def kind(self, type_name: str) -> str:
        """Kind of the values of a type; "a|b" are the data types that a group can be; empty for others."""
        if type_name in KINDS:
            return KINDS[type_name]
        local = type_name.partition(":")[2]
        if not type_name.startswith("uro:") or local not in self.types:
            return ""
        found = self.types[local]
        if found.tag == f"{XS}simpleType":
            return "text"
        inner = [item.get("ref", "").partition(":")[2] for item in found.iter(f"{XS}element")]
        if not local.endswith("PropertyType") or not all(name in self.elements for name in inner):
            return ""
        return "|".join(name for part in inner for name in self.concrete(part))

    def fields(self, type_name: str) -> list[tuple[str, str, str, str, str]]:
        """Name, kind, least and most number and choice of each element, those of its base first."""
        found = self.types[type_name]
        base = found.find(f".//{XS}extension")
        own = base.get("base", "").partition(":")[2] if base is not None else ""
        rows = self.fields(own) if own in self.types else []
        choice = {item: str(number) for number, group in enumerate(found.iter(f"{XS}choice"), 1)
                  for item in group.iter(f"{XS}element")}
        return rows + [(item.get("name"), self.kind(item.get("type", "")),
                        "0" if item in choice else item.get("minOccurs", "1"), item.get("maxOccurs", "1"),
                        choice.get(item, "")) for item in found.iter(f"{XS}element") if item.get("name")]

    def rows(self) -> list[tuple[str, ...]]:
        """Rows of the table: what objects of each kind have, then each data type that this leads to."""
        made, waiting, seen = [], [], set()
        for owner, hook in ((owner, hook) for owner, hooks in HOOKS.items() for hook in hooks):
            for name, item in self.elements.items():
                if item.get("substitutionGroup") == hook:
                    kind = self.kind(item.get("type"))
                    made.append((owner, name, kind, "0", "unbounded", ""))
                    waiting += kind.split("|") if kind else []
        while waiting:
            name = waiting.pop(0)
            if name in seen or name in KINDS.values() or name not in self.elements:
                continue
            seen.add(name)
            fields = self.fields(self.elements[name].get("type").partition(":")[2])
            made += [(name, *field) for field in fields] or [(name, "", "", "0", "0", "")]
            waiting += [part for _, kind, *_ in fields for part in kind.split("|") if part]
        return made


def write_table(schemas: Path, version: str) -> None:
    """One version's table."""
    old = version == "2.0"
    with open(PLACE / f"iur_{version}.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        for row in Schema(schemas / version / "urbanObject.xsd").rows():
            name = row[1] if row[0] in HOOKS else row[0]
            writer.writerow((*row, "" if old else OLDER.get(name, "")))


def write_codes(specification: Path, place: Path = PLACE / "codelists.csv", lists: str = LISTS) -> None:
    """The lists of codes whose names begin so, as the specification has them."""
    text = specification.read_text(encoding="utf-8")
    with open(place, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("list", "code", "meaning"))
        head = rf"^\| ファイル名 \| ((?:{lists})\w*)\.xml \|\n"
        for name, body in re.findall(rf"{head}(.*?)\n\n", text, re.MULTILINE | re.DOTALL):
            # The heading calls it geometrySrcDesc, the attributes that use it publicSurveySrcDesc.
            listed = name.replace("PublicSurveyDataQualityAttribute_geometrySrcDesc",
                                  "PublicSurveyDataQualityAttribute_publicSurveySrcDesc")
            for code, meaning in re.findall(r"^\| ([\d.]+) \| (.*?) \|$", body, re.MULTILINE):
                writer.writerow((listed, code, meaning))


if __name__ == "__main__":
    for each in VERSIONS:
        write_table(Path(sys.argv[1]), each)
    if len(sys.argv) > 2:
        write_codes(Path(sys.argv[2]))
        write_codes(Path(sys.argv[2]), PLACE / "codelists_tran.csv", ROAD_LISTS)
        write_codes(Path(sys.argv[2]), PLACE / "codelists_frn.csv", FURNITURE_LISTS)
