"""Buildings of tiles in scratch files: what comes back is what went in."""

import numpy as np
import pytest

from urbanmap_qgis.citymodel.tiles.tile_content import TileBuilding
from urbanmap_qgis.citymodel.tiles.tile_scratch import append_building, stored_buildings
from urbanmap_qgis.errors import OutputError


def building(seed):
    random = np.random.default_rng(seed)
    attributes = {"id": f"棟 {seed}", "height": 0.1 + 0.2, "floors": 2**40, "known": None, "flat": True,
                  "uses": ["住宅", {"type": "店舗"}], "far": float("inf")}
    return TileBuilding(attributes, {"roof": random.normal(4e6, 1e6, (seed, 3, 3)),
                                     "image:a b.jpg": np.ones((2, 3, 3))},
                        {"image:a b.jpg": random.random((2, 3, 2))})


def test_buildings_come_back_as_they_went_in(tmp_path):
    path = tmp_path / "cell"
    for seed in (3, 1, 2, 0):
        append_building(path, building(seed))
    append_building(path, TileBuilding({}, {}, {}))
    found = list(stored_buildings(path))
    assert found[-1].attributes == {} and found[-1].triangles == {}
    for seed, read in zip((3, 1, 2, 0), found):
        made = building(seed)
        assert read.attributes == made.attributes
        assert list(read.triangles) == list(made.triangles) and list(read.places) == list(made.places)
        for look in made.triangles:
            assert np.array_equal(read.triangles[look], made.triangles[look])
        assert np.array_equal(read.places["image:a b.jpg"], made.places["image:a b.jpg"])


@pytest.mark.parametrize("left", [2, 40, -1])
def test_a_file_that_is_cut_off_is_told(tmp_path, left):
    path = tmp_path / "cell"
    append_building(path, building(2))
    path.write_bytes(path.read_bytes()[:left])
    with pytest.raises(OutputError, match="cut off"):
        list(stored_buildings(path))
