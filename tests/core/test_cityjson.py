"""CityJSON written and read back: same solids, right semantics, same bytes."""

import json

import numpy as np
import pytest
import shapely
from shapely import box

from tests.solid_files import read_solids, write_solids
from urbanmap_qgis.buildings.solids.plan_partition import partition_plan
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.cityjson import vertices
from urbanmap_qgis.citymodel.solids import solid_object
from urbanmap_qgis.errors import Cancelled, InputError, OutputError
from urbanmap_qgis.progress import Progress


def solids(footprint, roofs, heights, base=1.5):
    return building_solids(partition_plan(footprint, roofs, heights, [f"r{i}" for i in range(len(roofs))]), base)


def blocks():
    """Solids of a court with two levels, and of two boxes touching in a point."""
    x, y = 84_000.0, 447_000.0
    court = box(x, y, x + 12, y + 12) - box(x + 4, y + 4, x + 8, y + 8)
    pair = shapely.MultiPolygon([box(x + 20, y, x + 24, y + 4), box(x + 24, y + 4, x + 30, y + 9)])
    return [solids(court, [box(x, y, x + 6, y + 12), box(x + 6, y, x + 12, y + 12)], [5.1234, 9]),
            solids(pair, [pair], [4.0]), ()]


def houses():
    """The blocks as buildings, and one without a model."""
    court, pair, _ = blocks()
    return [
        solid_object("家 1", {"rmse": 0.25, "points": np.int64(7), "bad": float("nan"), "name": "é", "none": None,
                             "ok": np.bool_(True)}, court),
        solid_object("b2", {}, pair), solid_object("b3", {"status": "no points"})]


@pytest.fixture
def path(tmp_path):
    return tmp_path / "町.city.json"


def test_what_is_written(path):
    assert write_solids(path, houses(), epsg=28992, title="Test") == 3
    content = json.loads(path.read_text(encoding="utf-8"))
    assert (content["type"], content["version"]) == ("CityJSON", "2.0")
    assert content["metadata"]["referenceSystem"] == "https://www.opengis.net/def/crs/EPSG/0/28992"
    assert content["metadata"]["title"] == "Test"
    assert content["metadata"]["geographicalExtent"] == [84000.0, 447000.0, 1.5, 84030.0, 447012.0, 9.0]
    assert content["transform"] == {"scale": [0.0001] * 3, "translate": [84000.0, 447000.0, 1.5]}
    vertices = np.array(content["vertices"])
    assert vertices.min(axis=0).tolist() == [0, 0, 0]
    assert len(np.unique(vertices, axis=0)) == len(vertices)
    objects = content["CityObjects"]
    assert list(objects) == ["家 1", "b2", "b2-part-1", "b2-part-2", "b3"]
    assert objects["家 1"]["attributes"] == {"rmse": 0.25, "points": 7, "bad": None, "name": "é", "none": None,
                                            "ok": True}
    assert objects["b3"] == {"type": "Building", "attributes": {"status": "no points"}, "geometry": []}
    assert objects["b2"]["geometry"] == [] and objects["b2"]["children"] == ["b2-part-1", "b2-part-2"]
    assert [g["type"] for g in objects["b2-part-1"]["geometry"]] == ["Solid"]


def test_semantics_fit_the_faces(path):
    write_solids(path, houses())
    content = json.loads(path.read_text(encoding="utf-8"))
    geometry = content["CityObjects"]["家 1"]["geometry"][0]
    assert (geometry["type"], geometry["lod"]) == ("Solid", "1.3")
    surfaces, values = geometry["semantics"]["surfaces"], geometry["semantics"]["values"]
    assert len(values) == 1 and len(values[0]) == len(geometry["boundaries"][0])
    z = np.array(content["vertices"])[:, 2]
    for face, value in zip(geometry["boundaries"][0], values[0]):
        flat = len({z[v] for v in face[0]}) == 1
        assert flat == (surfaces[value]["type"] in ("RoofSurface", "GroundSurface"))
    assert {s.get("wall") for s in surfaces if s["type"] == "WallSurface"} == {"outer", "inner"}
    assert {s["roof_id"] for s in surfaces if s["type"] == "RoofSurface"} == {"r0", "r1"}


def test_read_back(path):
    given = houses()
    write_solids(path, given)
    read = read_solids(path)
    assert [item.id for item in read] == [building.id for building in given]
    for item, given_solids in zip(read, blocks()):
        assert len(item.solids) == len(given_solids)
        for back, solid in zip(item.solids, given_solids):
            assert check_solid(back) == ()
            for face, original in zip(back.faces, solid.faces):
                for ring, first in zip(face, original):
                    assert np.abs(back.vertices[list(ring)] - solid.vertices[list(first)]).max() < 5.1e-5
    assert set(read[0].solids[0].surface_type) == {"RoofSurface", "WallSurface", "GroundSurface"}


def test_same_bytes(path, tmp_path):
    write_solids(path, houses(), epsg=28992)
    other = tmp_path / "other.city.json"
    write_solids(other, iter(houses()), epsg=28992)
    assert path.read_bytes() == other.read_bytes()


def test_bounded_memory_of_shared_vertices(path, monkeypatch):
    monkeypatch.setattr(vertices, "_REMEMBERED", 5)
    write_solids(path, houses())
    for item in read_solids(path):
        assert all(check_solid(solid) == () for solid in item.solids)


def test_nothing_to_write(path):
    assert write_solids(path, []) == 0
    assert read_solids(path) == ()
    write_solids(path, [solid_object("a")])
    assert "geographicalExtent" not in json.loads(path.read_text(encoding="utf-8"))["metadata"]


def test_a_failed_run_leaves_what_was_there(path, tmp_path):
    path.write_text("before", encoding="utf-8")
    with pytest.raises(InputError, match="own"):
        write_solids(path, [solid_object("a"), solid_object("a")])
    with pytest.raises(Cancelled):
        write_solids(path, houses(), progress=Progress(cancelled=lambda: True))
    assert path.read_text(encoding="utf-8") == "before"
    assert list(tmp_path.iterdir()) == [path]
    with pytest.raises(OutputError):
        write_solids(tmp_path / "missing" / "a.city.json", [])


@pytest.mark.parametrize(("text", "says"), [
    ("{", "not JSON"),
    ('{"type": "Feature"}', "not a CityJSON"),
    ('{"type": "CityJSON", "CityObjects": {}}', "damaged"),
    ('{"type": "CityJSON", "vertices": [[0, 0, 0]], "CityObjects": {"a": {"type": "Building", "geometry": '
     '[{"type": "Solid", "boundaries": [[[[0, 1, 2]]]]}]}}}', "damaged"),
])
def test_damaged_files(path, text, says):
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=says):
        read_solids(path)


def test_missing_file(path):
    with pytest.raises(InputError, match="cannot be read"):
        read_solids(path)
