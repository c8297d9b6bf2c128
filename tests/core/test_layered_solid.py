"""Solids of prisms over, under and beside each other: closed, valid, of the right volume."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.merging.layered_solid import (
    Prism,
    layered_solids,
    merged_intervals,
    solid_volume,
    subtracted_intervals,
)
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.solid import GROUND, OVERHANG, ROOF

X0, Y0 = -7000.0, -34000.0


def box(x, y, width, depth):
    return shapely.box(X0 + x, Y0 + y, X0 + x + width, Y0 + y + depth)


def checked(prisms, volume, solids=1):
    made = layered_solids(prisms)
    assert len(made) == solids
    for solid in made:
        assert check_solid(solid) == ()
    assert sum(map(solid_volume, made)) == pytest.approx(volume, rel=1e-9)
    return made


def test_intervals():
    assert merged_intervals([(5, 9), (0, 3), (3, 4), (8, 12)]) == [(0, 4), (5, 12)]
    assert subtracted_intervals([(0, 10)], [(2, 3), (9, 15)]) == [(0, 2), (3, 9)]
    assert subtracted_intervals([(0, 4), (6, 8)], [(0, 4)]) == [(6, 8)]


def test_a_block_and_its_roof():
    solid, = checked([Prism(box(0, 0, 10, 8), 3.0, 15.5, "a")], 80 * 12.5)
    assert sorted(solid.surface_type).count(ROOF) == 1 and len(solid.faces) == 6
    assert [i for i, kind in zip(solid.roof_id, solid.surface_type) if kind == ROOF] == ["a"]


def test_overhang_and_ledge_at_the_height():
    """The lower part stands half a metre out on one side and back on the other."""
    solid, = checked([Prism(box(-0.5, 0, 10, 8), 0, 20), Prism(box(0, 0, 10, 8), 20, 30, 1)], 80 * 30)
    kinds = dict.fromkeys(solid.surface_type)
    assert {ROOF, GROUND, OVERHANG} <= set(kinds)
    level = {kind: [solid.vertices[face[0][0], 2] for face, own in zip(solid.faces, solid.surface_type) if own == kind]
             for kind in kinds}
    assert level[OVERHANG] == [20.0] and sorted(level[ROOF]) == [20.0, 30.0] and level[GROUND] == [0.0]


def test_turned_plans_cross_each_other():
    lower = shapely.affinity.rotate(box(0, 0, 20, 10), 1.3)
    made = layered_solids([Prism(lower, 0, 20), Prism(box(0, 0, 20, 10), 20, 45)])
    assert len(made) == 1 and check_solid(made[0]) == ()
    assert solid_volume(made[0]) == pytest.approx(200 * 45, rel=2e-3), "nodes are rounded to a centimetre"


def test_a_bridge_between_two_towers_and_a_gate_under_it():
    made = checked([Prism(box(0, 0, 5, 5), 0, 30), Prism(box(9, 0, 5, 5), 0, 20), Prism(box(5, 1, 4, 2), 10, 13)],
                   25 * 30 + 25 * 20 + 8 * 3)
    assert OVERHANG in made[0].surface_type


def test_a_courtyard():
    ring = box(0, 0, 20, 20).difference(box(6, 6, 5, 4))
    checked([Prism(ring, 0, 12)], ring.area * 12)


def test_parts_that_do_not_touch_are_solids_of_their_own():
    checked([Prism(box(0, 0, 5, 5), 0, 10), Prism(box(8, 0, 5, 5), 0, 7)], 25 * 17, solids=2)


def test_a_ledge_and_an_overhang_that_meet_in_an_edge_are_mended_by_a_lift():
    prisms = [Prism(box(0, 0, 6, 5), 0, 20), Prism(box(3, 0, 3, 5), 20, 30), Prism(box(6, 0, 4, 5), 20, 30)]
    assert {problem.code for solid in layered_solids(prisms) for problem in check_solid(solid)} == set()
    prisms = [Prism(box(0, 0, 5, 5), 0, 20), Prism(box(5, 0, 5, 5), 20, 30), Prism(box(0, 5, 10, 5), 0, 30)]
    assert {problem.code for solid in layered_solids(prisms) for problem in check_solid(solid)} == {303}
    assert all(check_solid(solid) == () for solid in layered_solids(prisms, lift=0.01))


@pytest.mark.parametrize("seed", range(12))
def test_volume_of_random_prisms_is_that_of_their_union(seed):
    """Against counting half-metre cubes."""
    rng = np.random.default_rng(seed)
    prisms, cubes = [], np.zeros((20, 20, 20), bool)
    for _ in range(5):
        low = rng.integers(0, 12, 3)
        size = rng.integers(2, 9, 3)
        high = np.minimum(low + size, 20)
        cubes[tuple(slice(a, b) for a, b in zip(low, high))] = True
        prisms.append(Prism(box(*(low[:2] / 2), *((high - low)[:2] / 2)), low[2] / 2, high[2] / 2))
    solids = layered_solids(prisms)
    assert sum(map(solid_volume, solids)) == pytest.approx(cubes.sum() / 8)


def test_bad_parts_are_refused():
    with pytest.raises(InputError, match="height"):
        layered_solids([Prism(box(0, 0, 5, 5), 0, float("nan"))])
    with pytest.raises(InputError, match="volume"):
        layered_solids([Prism(box(0, 0, 5, 5), 5, 5)])
    with pytest.raises(InputError):
        layered_solids([])
