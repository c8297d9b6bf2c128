"""City models as other programs write them: names of systems, packed files, exchanged degrees, templates, dummies."""

from __future__ import annotations

import gzip
import json
from contextlib import ExitStack
from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.citymodel.city_files import write_city_files
from urbanmap_qgis.citymodel.city_sources import open_city_model, placed_model
from urbanmap_qgis.citymodel.model import CityReference
from urbanmap_qgis.citymodel.named_reference import named_reference
from urbanmap_qgis.citymodel.reading_notes import ReadingNotes
from urbanmap_qgis.citymodel.tables.building_table import TableNotes, building_rows
from urbanmap_qgis.citymodel.unknown_values import known_attributes
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.osm import read_osm

BOX = np.array([[0, 0, 0], [10, 0, 0], [10, 8, 0], [0, 8, 0], [0, 0, 6], [10, 0, 6], [10, 8, 6], [0, 8, 6]], float)
FACES = [[[0, 3, 2, 1]], [[4, 5, 6, 7]], [[0, 1, 5, 4]], [[1, 2, 6, 5]], [[2, 3, 7, 6]], [[3, 0, 4, 7]]]
TOKYO = (35.68, 139.76)


def gml(corners=None, name="EPSG:6677", attributes=""):
    """CityGML of one building whose solid is the box, with these corners."""
    corners = BOX + np.array([85000, 446000, 0]) if corners is None else corners
    faces = "".join(
        "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>"
        + " ".join(str(value) for corner in (*face, face[0]) for value in corners[corner])
        + "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>" for (face,) in FACES)
    return ('<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml" '
            f'xmlns:bldg="http://www.opengis.net/citygml/building/2.0"><gml:boundedBy><gml:Envelope srsName="{name}"/>'
            f'</gml:boundedBy><core:cityObjectMember><bldg:Building gml:id="b">{attributes}<bldg:lod1Solid><gml:Solid>'
            f"<gml:exterior><gml:CompositeSurface>{faces}</gml:CompositeSurface></gml:exterior></gml:Solid>"
            "</bldg:lod1Solid></bldg:Building></core:cityObjectMember></core:CityModel>")


def cityjson(matrix=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)), template=0):
    """CityJSON of one building that is a template at a place."""
    instance = {"type": "GeometryInstance", "template": template, "boundaries": [1],
                "transformationMatrix": np.asarray(matrix).ravel().tolist()}
    return {"type": "CityJSON", "version": "2.0", "vertices": [[0, 0, 0], [5000, 0, 0]],
            "transform": {"scale": [0.001] * 3, "translate": [85000, 446000, 2]},
            "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/6677"},
            "CityObjects": {"t": {"type": "Building", "geometry": [instance]}},
            "geometry-templates": {"templates": [{"type": "Solid", "lod": "2", "boundaries": [FACES]}],
                                   "vertices-templates": BOX.tolist()}}


def rows_of(path, given=None):
    """Rows of a file's buildings in its own system, and what was counted."""
    notes = TableNotes()
    with ExitStack() as stack:
        model = open_city_model(path, stack, ReadingNotes(), given)
        _, buildings, places = placed_model(model, None, [])
        return list(building_rows(buildings, places, notes)), notes


@pytest.mark.parametrize("name, epsg, heights, swapped", [
    ("urn:adv:crs:ETRS89_UTM33*DE_DHHN2016_NH", 25833, "EPSG:7837", False),
    ("urn:adv:crs:ETRS89_UTM32*DE_DHHN92_NH*GCG2016", 25832, "EPSG:5783", False),
    ("urn:adv:crs:DE_DHDN_3GK2_NW101", 31466, "unknown", False),
    ("urn:adv:crs:ETRS89_Lat-Lon", 4258, "unknown", True),
    ("http://www.opengis.net/gml/srs/epsg.xml#31467", 31467, "unknown", False),
    ("urn:x-ogc:def:crs:EPSG:6.9:31467", 31467, "unknown", True),
    ("urn:EPSG:geographicCRS:4326", 4326, "unknown", True),
    ("http://www.opengis.net/def/crs/OGC/1.3/CRS84", 4326, "unknown", False),
    ("EPSG:25832+7837", 25832, "EPSG:7837", False),
    ("25832", 25832, "unknown", False)])
def test_names_of_systems_as_surveys_and_programs_write_them(name, epsg, heights, swapped):
    found = named_reference(name, "a.gml")
    assert (found.reference.epsg, found.reference.heights, found.swapped) == (epsg, heights, swapped)


@pytest.mark.parametrize("name", ["urn:adv:crs:ETRS89_X-Y-Z", "our grid", "EPSG:999999"])
def test_a_given_system_counts_before_a_name_that_is_not_known(name):
    given = CityReference("", 25832)
    assert named_reference(name, "a.gml", given).reference is given
    with pytest.raises(InputError, match=r"a\.gml: the coordinate reference system .* is not known"):
        named_reference(name, "a.gml")


@pytest.mark.parametrize("name", ["town.gml.gz", "town.city.json.gz", "town.dat"])
def test_packed_files_and_other_suffixes_are_told_by_their_content(tmp_path, name):
    path = tmp_path / name
    text = gml() if ".gml" in name else json.dumps(cityjson())
    path.write_bytes(gzip.compress(text.encode()))
    assert rows_of(path)[0][0].values["height"] == 6.0
    if name != "town.dat":
        assert rows_of(tmp_path)[0][0].values["height"] == 6.0


def test_lane_maps_are_unpacked_and_another_format_is_named(tmp_path):
    path = tmp_path / "map.osm.gz"
    path.write_bytes(gzip.compress(b'<osm version="0.6"><node id="1" lat="35.0" lon="139.0"/></osm>'))
    assert list(read_osm(path).nodes) == [1]
    path.write_bytes(b"<OpenDRIVE/>")
    with pytest.raises(InputError, match="OpenDRIVE file.*Lanelet2"):
        read_osm(path)


def test_exchanged_metres_are_named_and_the_other_order_is_read(tmp_path):
    path = tmp_path / "a.gml"
    stuttgart = np.array([3513000, 5404000, 200])
    path.write_text(gml(BOX + stuttgart, "urn:ogc:def:crs:EPSG::31467"))
    with pytest.raises(InputError, match="East and north of the city model are exchanged"):
        rows_of(path)
    for corners, name in ((BOX + stuttgart, "urn:adv:crs:DE_DHDN_3GK3"),
                          ((BOX + stuttgart)[:, [1, 0, 2]], "urn:ogc:def:crs:EPSG::31467"),
                          (BOX + np.array([-250000, 180000, 0]), "EPSG:6677")):  # beyond the zone, as some surveys are
        path.write_text(gml(corners, name))
        assert rows_of(path)[0][0].values["height"] == 6.0


@pytest.mark.parametrize("name, place", [("http://www.opengis.net/def/crs/EPSG/0/6697", TOKYO),
                                         ("urn:ogc:def:crs:EPSG::4258", (52.5, 13.4))])
def test_exchanged_degrees_are_named(tmp_path, name, place):
    path = tmp_path / "a.gml"
    path.write_text(gml(BOX * [1e-5, 1e-5, 1] + np.array([*place[::-1], 0]), name))
    with pytest.raises(InputError, match="Latitude and longitude of the city model are exchanged"):
        rows_of(path)
    with ExitStack() as stack, pytest.raises(InputError, match="are exchanged"):
        model = open_city_model(path, stack, ReadingNotes())
        write_city_files(replace(model, buildings=list(model.buildings)), tiles=tmp_path / "tiles")
    assert not (tmp_path / "tiles").exists()


@pytest.mark.parametrize("turned", [1, -1])
def test_templates_stand_where_their_instances_say(tmp_path, turned):
    matrix = np.diag([2.0, 2.0 * turned, 2.0, 1.0])
    matrix[0, 3] = 7.0
    path = tmp_path / "a.city.json"
    path.write_text(json.dumps(cityjson(matrix)))
    (row,), _ = rows_of(path)
    low = min(446000, 446000 + 16 * turned)
    assert row.outline.bounds == pytest.approx((85012, low, 85032, low + 16))
    assert (row.values["ground"], row.values["top"], row.values["note"]) == (2.0, 14.0, "")
    with ExitStack() as stack:
        model = open_city_model(path, stack, ReadingNotes())
        rings = [surface.rings[0] for surface in next(iter(model.buildings)).shapes[0].surfaces]
    volume = sum(np.linalg.det(ring[[0, corner, corner + 1]] - rings[0][0]) for ring in rings for corner in (1, 2)) / 6
    assert volume == pytest.approx(8 * 480)


def test_a_scale_of_zero_is_told(tmp_path):
    path = tmp_path / "a.city.json"
    path.write_text(json.dumps({**cityjson(), "transform": {"scale": [0.0, 0.0, 0.0], "translate": [1.0, 2.0, 3.0]}}))
    with pytest.raises(InputError, match="the scale of its “transform” is 0"):
        rows_of(path)


def test_a_template_that_is_not_there_is_told(tmp_path):
    path = tmp_path / "a.city.json"
    path.write_text(json.dumps(cityjson(template=3)))
    with pytest.raises(InputError, match=r"a\.city\.json: t cannot be read"):
        rows_of(path)


def test_values_for_unknown_become_empty_and_heights_top_less_ground(tmp_path):
    path = tmp_path / "a.gml"
    path.write_text(gml(attributes=(
        "<bldg:yearOfConstruction>0001</bldg:yearOfConstruction>"
        "<bldg:measuredHeight uom='m'>-9999</bldg:measuredHeight>"
        "<bldg:storeysAboveGround>9999</bldg:storeysAboveGround><bldg:storeysBelowGround>1</bldg:storeysBelowGround>")))
    (row,), notes = rows_of(path)
    values = row.values
    assert (values["height"], values["note"]) == (6.0, "")
    assert [values[name] for name in ("yearOfConstruction", "measuredHeight", "storeysAboveGround")] == [None] * 3
    assert values["storeysBelowGround"] == 1 and json.loads(values["attributes"])["measuredHeight"] == -9999
    assert notes.unknown == {"yearOfConstruction": 1, "measuredHeight": 1, "storeysAboveGround": 1}
    assert known_attributes({"uro": [{"height": 9999, "name": "9999"}], "yearOfConstruction": "0001"}) == {
        "uro": [{"height": None, "name": "9999"}], "yearOfConstruction": None}
