"""PLATEAU's own files: read whole, written again by the program's writers and read again, nothing lost."""

from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.citymodel.city_sources import open_city_model, placed_model
from urbanmap_qgis.citymodel.citygml.writer import write_citygml
from urbanmap_qgis.citymodel.reading_notes import ReadingNotes
from urbanmap_qgis.citymodel.tables.building_table import TableNotes, building_rows

PLATEAU = Path(__file__).resolve().parents[3] / "shared" / "data" / "als" / "plateau"
FILES = {"yokosuka/52397519_bldg_6697_op.gml": (13, 3), "sapporo/64413325_bldg_6697_op.gml": (25, 0)}
"""Buildings, and solids of level 2, of each file."""

pytestmark = pytest.mark.skipif(not PLATEAU.is_dir(), reason="../shared/data is not there")


def read(path):
    notes = ReadingNotes()
    with ExitStack() as stack:
        model = open_city_model(path, stack, notes)
        return model, list(model.buildings), notes


def faces(item):
    """Shapes of an object: level, kind, and of each face its kind, rings (to 1e-9 degrees, 0.1 mm) and texture."""
    found = {}
    for shape in item.shapes:
        rows = [(surface.kind, surface.id, tuple(tuple(map(tuple, np.rint(ring * [1e9, 1e9, 1e4]).tolist()))
                                                 for ring in surface.rings),
                 None if surface.texture is None else (Path(surface.texture.image).name, tuple(
                     tuple(map(tuple, np.round(uv, 6).tolist())) for uv in surface.texture.uv)))
                for surface in shape.surfaces]
        found.setdefault((shape.lod, shape.kind), []).append(sorted(rows, key=repr))
    return found


@pytest.mark.parametrize("name", FILES)
def test_everything_in_the_file_is_read(name):
    text = (PLATEAU / name).read_text(encoding="utf-8-sig")
    _, buildings, notes = read(PLATEAU / name)
    objects = [item for building in buildings for item in building.objects()]
    assert len(buildings) == FILES[name][0] and not notes.unread and not notes.others and not notes.repeated
    shapes = [shape for item in objects for shape in item.shapes]
    assert sum(shape.kind == "solid" and shape.lod == "2" for shape in shapes) == FILES[name][1]
    # Polygons of boundaries are referred to by the solid, so that each is there once.
    assert sum(len(shape.surfaces) for shape in shapes) == text.count("<gml:Polygon")
    textured = [surface for shape in shapes for surface in shape.surfaces if surface.texture is not None]
    assert len(textured) == text.count("<app:target ")
    assert not [building.problems for building in buildings if building.problems]


@pytest.mark.parametrize("name", FILES)
def test_file_read_and_written_again_loses_nothing(name, tmp_path):
    model, buildings, _ = read(PLATEAU / name)
    notes = ReadingNotes()
    with ExitStack() as stack:
        write_citygml(tmp_path / "out", open_city_model(PLATEAU / name, stack, notes), version="2.0")
    again, copies, _ = read(tmp_path / "out")
    assert again.reference == model.reference
    assert {item.id for item in copies} == {item.id for item in buildings}
    by_id = {item.id: item for copy in copies for item in copy.objects()}
    for building in buildings:
        assert [part.id for part in by_id[building.id].parts] == [part.id for part in building.parts]
        for item in building.objects():
            copy = by_id[item.id]
            assert without_meanings(copy.attributes) == without_meanings(item.attributes)
            assert faces(copy) == faces(item)
    assert {Path(image).name for image in again.images} == {Path(image).name for image in model.images}


def without_meanings(value):
    """Attributes as they stand in the file: what lists of codes say of them depends on the lists that are there."""
    if hasattr(value, "meaning"):
        return (value.value, value.space)
    if hasattr(value, "values") and hasattr(value, "type"):
        return (value.type, without_meanings(dict(value.values)))
    if isinstance(value, dict):
        return {name: without_meanings(item) for name, item in value.items()}
    return [without_meanings(item) for item in value] if isinstance(value, list) else value


@pytest.mark.parametrize("name", FILES)
def test_outlines_lie_where_the_solids_do(name):
    with ExitStack() as stack:
        wkt, buildings, places = placed_model(open_city_model(PLATEAU / name, stack, ReadingNotes()), None, [])
        rows = list(building_rows(buildings, places, TableNotes()))
    assert "Japan Plane Rectangular CS" in wkt and "JGD2011 (vertical)" in wkt
    for row in rows:
        assert row.outline is not None and row.outline.is_valid
        low, high = row.values["ground"], row.values["top"]
        assert 0 < high - low < 60 and abs(row.values["height"] - (high - low)) < 12
        assert row.solid is None or row.outline.buffer(1.0).covers(row.solid.envelope.centroid) or row.values["parts"]
