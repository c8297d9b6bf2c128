"""The checker and the reader on another program's block models of real buildings."""

from pathlib import Path

import pytest

from tests.solid_files import read_solids
from urbanmap_qgis.buildings.solids.validity import check_solid

MODELS = (Path(__file__).resolve().parents[2].parent / "shared" / "data" / "als" / "delft_west"
          / "peer_3dfier_lod1.city.json")

pytestmark = pytest.mark.skipif(not MODELS.exists(), reason="the shared real data are not here")


@pytest.fixture(scope="module")
def buildings():
    return read_solids(MODELS)


def test_peers_models_are_valid(buildings):
    assert len(buildings) == 92
    assert all(len(building.solids) == 1 for building in buildings)
    assert {building.id for building in buildings if check_solid(building.solids[0])} == set()


def test_a_missing_face_is_found_in_each(buildings):
    for building in buildings:
        solid = building.solids[0]
        broken = type(solid)(solid.vertices, solid.faces[1:], solid.surface_type[1:])
        assert {problem.code for problem in check_solid(broken)} == {302}
