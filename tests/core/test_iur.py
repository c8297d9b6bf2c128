"""i-UR's tables: what a version can hold, in its order, under its names; what PLATEAU asks of quality and ids."""

import datetime
from collections import Counter
from dataclasses import replace
from datetime import date
from xml.etree import ElementTree

import pytest

from tests.city_models import town
from urbanmap_qgis.citymodel.citygml.attribute_writer import split_attributes
from urbanmap_qgis.citymodel.citygml.codelists import lists_of, write_codelists
from urbanmap_qgis.citymodel.citygml.iur import VERSIONS, iur_table, kinds_of
from urbanmap_qgis.citymodel.citygml.plateau import PlateauDelivery, with_plateau_attributes
from urbanmap_qgis.citymodel.citygml.value_reader import extension_value, generic_value
from urbanmap_qgis.citymodel.citygml.writer import write_citygml
from urbanmap_qgis.citymodel.model import AttributeGroup, CodeValue, Measure
from urbanmap_qgis.progress import Progress

LISTS = "../../codelists/"


def group(name, **values):
    return AttributeGroup(f"uro:{name}", {f"uro:{key}": value for key, value in values.items()})


def names(made):
    return list(made.values)


@pytest.mark.parametrize("version", VERSIONS)
def test_values_come_in_the_schemas_order(version):
    given = group("BuildingIDAttribute", city=CodeValue("13101", LISTS), branchID=2, buildingID="13101-bldg-1")
    name, (made,) = iur_table(version).fitted("uro:buildingIDAttribute", given)
    assert name == "uro:buildingIDAttribute" and names(made) == ["buildingID", "branchID", "city"]


@pytest.mark.parametrize("values", [
    {"buildingID": "1"},  # the city is missing
    {"buildingID": "1", "city": CodeValue("13101"), "storeys": 3},  # no such value
    {"buildingID": ["1", "2"], "city": CodeValue("13101")},  # two where one may be
    {"buildingID": "1", "city": CodeValue("13101"), "branchID": "two"},  # no whole number
    {"buildingID": "1", "city": Measure(1.0, "m")}])
def test_what_the_schema_refuses_does_not_fit(values):
    assert iur_table("3.2").fitted("uro:buildingIDAttribute", group("BuildingIDAttribute", **values)) is None


def test_names_follow_the_version():
    pair = group("KeyValuePairAttribute", key=CodeValue("1"), codeValue=CodeValue("2"))
    assert iur_table("3.2").fitted("uro:keyValuePairAttribute", pair)[0] == "uro:bldgKeyValuePairAttribute"
    assert iur_table("2.0").fitted("uro:bldgKeyValuePairAttribute", pair)[0] == "uro:keyValuePairAttribute"
    both = group("KeyValuePairAttribute", key=CodeValue("1"), codeValue=CodeValue("2"), intValue=3)
    assert iur_table("2.0").fitted("uro:keyValuePairAttribute", both) is None, "one value of the choice, not two"
    flood = group("BuildingRiverFloodingRiskAttribute", description=CodeValue("1"), rank=CodeValue("2"),
                  depth=Measure(1.5, "m"), adminType=CodeValue("1"), scale=CodeValue("2"))
    name, (made,) = iur_table("3.2").fitted("uro:buildingDisasterRiskAttribute", flood)
    assert (name, made.type) == ("uro:bldgDisasterRiskAttribute", "uro:RiverFloodingRiskAttribute")
    assert iur_table("2.0").fitted("uro:bldgRealEstateIDAttribute", group("RealEstateIDAttribute")) is None


def test_what_a_version_cannot_hold_becomes_generic():
    homeless = Counter()
    attributes = {"uro:bldgRealEstateIDAttribute": group("RealEstateIDAttribute", realEstateIDOfLand=["a", "b"]),
                  "yearOfConstruction": 1999, "measuredHeight": 7.5, "storeysAboveGround": "three"}
    before, own, after = split_attributes(attributes, iur_table("2.0"), homeless)
    assert homeless == {"uro:bldgRealEstateIDAttribute": 1} and after == ""
    assert before.count("<gen:value>a</gen:value>") == before.count("<gen:value>b</gen:value>") == 1
    assert own == ('<bldg:yearOfConstruction>1999</bldg:yearOfConstruction>'
                   '<bldg:measuredHeight uom="m">7.5</bldg:measuredHeight>')
    assert 'name="storeysAboveGround"' in before, "what is no number is kept as a generic text"


def test_dates_and_truths_keep_their_form():
    table = iur_table("3.2")
    fields = {field.name: field.kind for field in table.fields["BuildingDetailAttribute"]}
    assert fields["siteArea"] == "measure" and fields["surveyYear"] == "year"
    given = group("BuildingDetailAttribute", surveyYear=2024)
    assert table.fitted("uro:buildingDetailAttribute", given)[1][0].values == {"surveyYear": 2024}
    assert table.fitted("uro:buildingDetailAttribute", group("BuildingDetailAttribute", surveyYear="24")) is None
    assert table.fitted("uro:buildingDetailAttribute", group("BuildingDetailAttribute", surveyYear=date(2024, 1, 1))
                        ) is None


def quality(item, **delivery):
    made = with_plateau_attributes(item, 1, PlateauDelivery(**delivery))
    name = "uro:buildingDataQualityAttribute" if delivery.get("version") == "2.0" else "uro:bldgDataQualityAttribute"
    found = made.attributes.get(name)
    return found and {key: [item.value for item in value] if isinstance(value, list) else
                      getattr(value, "value", value) for key, value in found.values.items()}


def test_quality_names_the_source_of_every_level():
    house, _, bare, block = town().buildings
    assert quality(house) == {
        "geometrySrcDescLod0": "112", "geometrySrcDescLod1": "112", "geometrySrcDescLod2": "112",
        "thematicSrcDesc": "100", "lodType": ["2.0"], "lod1HeightType": "2"}
    assert quality(block)["geometrySrcDescLod2"] == "999" and "lodType" not in quality(block)
    assert [quality(bare)[f"geometrySrcDescLod{level}"] for level in "012"] == ["999"] * 3
    assert quality(bare, version="2.0") is None


def test_a_public_survey_says_its_map_level():
    made = quality(town().buildings[0], map_level=2500)
    assert made["geometrySrcDescLod2"] == made["thematicSrcDesc"] == "000"
    survey = made["publicSurveyDataQualityAttribute"].values if hasattr(
        made["publicSurveyDataQualityAttribute"], "values") else made["publicSurveyDataQualityAttribute"]
    assert survey["srcScaleLod1"].value == "1" and survey["publicSurveySrcDescLod1"].value == "012"


def test_a_model_of_others_claims_no_survey():
    made = quality(town().buildings[0], measured=False)
    assert made == {f"geometrySrcDescLod{level}": "700" for level in "012"}
    old = town(**{"uro:buildingDataQualityAttribute": group(
        "BuildingDataQualityAttribute", lod1HeightType=CodeValue("6"), lodType="2.1")}).buildings[0]
    made = quality(old, measured=False)
    assert made["lod1HeightType"] == "6" and made["lodType"] == ["2.1"]


def test_parts_share_the_buildings_id_and_have_their_number():
    made = with_plateau_attributes(town().buildings[1], 7, PlateauDelivery(city_code="13101"))
    ids = [item.attributes["uro:buildingIDAttribute"].values for item in made.objects()]
    assert {values["buildingID"] for values in ids} == {"13101-bldg-7"}
    assert [values.get("partID") for values in ids] == [None, 1, 2]


@pytest.mark.parametrize("version", VERSIONS)
def test_every_code_has_its_list(version, tmp_path):
    write_codelists(tmp_path, lists_of(version))
    item = with_plateau_attributes(town().buildings[0], 1, PlateauDelivery(version, map_level=500))
    codes = [value for value in _codes(item.attributes) if LISTS in value.space]
    assert codes
    for value in codes:
        root = ElementTree.parse(tmp_path / value.space.removeprefix(LISTS)).getroot()
        assert value.value in {entry.text for entry in root.iter("{http://www.opengis.net/gml}name")}
    assert set(lists_of(version)) == {path.stem for path in tmp_path.iterdir()}


def test_lists_that_the_models_refer_to_go_along_and_those_not_known_are_named(tmp_path):
    model, told = town(), []
    item = replace(model.buildings[0], attributes={
        "class": CodeValue("3001", f"{LISTS}Building_class.xml"),
        "usage": [CodeValue("401", f"{LISTS}Building_usage.xml", "業務施設 & 他")]})
    write_citygml(tmp_path, replace(model, buildings=[item]), Progress(warn=told.append))
    root = ElementTree.parse(tmp_path / "codelists" / "Building_usage.xml").getroot()
    gml = "{http://www.opengis.net/gml}"
    (one,) = root.iter(f"{gml}Definition")
    assert one.findtext(f"{gml}name") == "401" and one.findtext(f"{gml}description") == "業務施設 & 他"
    assert not (tmp_path / "codelists" / "Building_class.xml").exists()
    (note,) = [text for text in told if "lists of codes" in text]
    assert note.startswith("1 lists") and "(Building_class)" in note


def _codes(values):
    for value in values.values():
        for item in value if isinstance(value, list) else [value]:
            if isinstance(item, CodeValue):
                yield item
            elif isinstance(item, AttributeGroup):
                yield from _codes(item.values)



def read_group(version, type_name, *values):
    """A data type as the reader makes it of XML, as an attribute of its own name; `values` are names and texts."""
    inner = "".join(f"<{name}>{text}</{name}>" for name, text in values)
    return extension_value(ElementTree.fromstring(
        f'<a xmlns="https://www.geospatial.jp/iur/uro/{version}"><{type_name}>{inner}</{type_name}></a>'), _no_meaning)


def _no_meaning(space, code):
    return ""


@pytest.mark.parametrize("name, text, value", [
    ("realEstateIDOfBuilding", "1234567890123", "1234567890123"), ("realEstateIDOfLand", "0120", "0120"),
    ("numberOfRealEstateIDOfLand", "007", 7), ("matchingScore", "three", "three"), ("matchingScore", "5", 5)])
def test_values_are_of_the_types_of_the_schema(name, text, value):
    found = read_group("3.2", "RealEstateIDAttribute", (name, text)).values[f"uro:{name}"]
    assert found == value and type(found) is type(value)


@pytest.mark.parametrize("name, text, value", [
    ("floorAreaRate", "1.50", 1.5), ("floorAreaRate", "2", 2), ("floorAreaRate", "+.5e1", 5.0),
    ("floorAreaRate", "NaN", "NaN"), ("floorAreaRate", "1e999", "1e999"), ("reference", "12", "12"),
    ("surveyYear", "2024", 2024), ("surveyYear", "0985", "0985"), ("notInTheSchema", "3", 3),
    ("landUseType", "211", "211")])
def test_numbers_come_as_numbers_and_texts_as_texts(name, text, value):
    found = read_group("3.1", "BuildingDetailAttribute", (name, text)).values[f"uro:{name}"]
    assert found == value and type(found) is type(value)


@pytest.mark.parametrize("name, text, value", [
    ("availability", "true", True), ("availability", "1", True), ("availability", "0", False),
    ("availability", "false", False), ("availability", "yes", "yes"),
    ("inauguralDate", "2024-02-29", date(2024, 2, 29)), ("inauguralDate", "2024-02-30", "2024-02-30")])
def test_truths_and_dates(name, text, value):
    found = read_group("3.2", "LargeCustomerFacilityAttribute", (name, text)).values[f"uro:{name}"]
    assert found == value and type(found) is type(value)


def test_what_was_read_can_be_written_in_the_same_words():
    """Numbers with an ending 0 and truths written as digits were refused by the table, and left as generic texts."""
    made = read_group("3.2", "BuildingDetailAttribute", ("floorAreaRate", "1.50"), ("surveyYear", "2024"))
    assert made.values == {"uro:floorAreaRate": 1.5, "uro:surveyYear": 2024}
    assert iur_table("3.2").fitted("uro:buildingDetailAttribute", made) is not None
    truth = read_group("3.2", "LargeCustomerFacilityAttribute", ("name", "12"), ("availability", "1"),
                       ("surveyYear", "2024"))
    _, _, written = split_attributes({"uro:largeCustomerFacilityAttribute": truth}, iur_table("3.2"), Counter())
    assert "<uro:name>12</uro:name>" in written and "<uro:availability>true</uro:availability>" in written


def test_types_of_a_version_without_a_table_are_as_they_look():
    assert kinds_of("{https://www.geospatial.jp/iur/uro/1.5}BuildingDetailAttribute") == {}
    assert kinds_of("BuildingDetailAttribute") == {}
    assert read_group("1.5", "RealEstateIDAttribute", ("realEstateIDOfBuilding", "12")).values == {
        "uro:realEstateIDOfBuilding": 12}


@pytest.mark.parametrize(("text", "value"), [
    ("<g:stringAttribute name='a'><g:value> 1.50 </g:value></g:stringAttribute>", "1.50"),
    ("<g:intAttribute name='a'><g:value>12</g:value></g:intAttribute>", 12),
    ("<g:doubleAttribute name='a'><g:value>1.50</g:value></g:doubleAttribute>", 1.5),
    ("<g:doubleAttribute name='a'><g:value>many</g:value></g:doubleAttribute>", "many"),
    ("<g:dateAttribute name='a'><g:value>2026-04-01</g:value></g:dateAttribute>", datetime.date(2026, 4, 1)),
    ("<g:measureAttribute name='a'><g:value uom='m'>2.5</g:value></g:measureAttribute>", Measure(2.5, "m")),
    ("<g:stringAttribute name='a'/>", ""), ("<g:intAttribute name='a'/>", "")])
def test_generic_attributes_have_values_of_their_kinds(text, value):
    space = "xmlns:g='http://www.opengis.net/citygml/generics/2.0'"
    element = ElementTree.fromstring(text.replace(" name", f" {space} name", 1))
    found = generic_value(element, lambda name, code: "")
    assert found == value and type(found) is type(value)
