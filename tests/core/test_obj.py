"""OBJ: groups, materials, and a closed mesh of the same volume."""

import numpy as np
import pytest
from shapely import box

from urbanmap_qgis.buildings.solids.plan_partition import partition_plan
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.citymodel.obj import write_obj
from urbanmap_qgis.citymodel.solids import solid_object
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.solid import volume


def house(name, x):
    return solid_object(name, {}, solids(x))


def solids(x):
    footprint = box(x, 5e6, x + 12, 5e6 + 12) - box(x + 4, 5e6 + 4, x + 8, 5e6 + 8)
    roofs = [box(x, 5e6, x + 6, 5e6 + 12), box(x + 6, 5e6, x + 12, 5e6 + 12)]
    return building_solids(partition_plan(footprint, roofs, [5, 9], ["a", "b"]), 1.0)


def read(path):
    """Vertices, and for each group its triangles and materials."""
    vertices, groups, material = [], {}, None
    for line in path.read_text(encoding="utf-8").splitlines():
        key, *values = line.split()
        if key == "v":
            vertices.append([float(v) for v in values])
        elif key == "g":
            group = groups.setdefault(values[0], [])
        elif key == "usemtl":
            material = values[0]
        elif key == "f":
            group.append((material, [int(v) - 1 for v in values]))
    return np.array(vertices), groups


def test_mesh_is_closed_and_has_the_volume(tmp_path):
    path = tmp_path / "町.obj"
    buildings = [house("家 1", 5e5), house("b", 5e5 + 20), solid_object("empty")]
    assert write_obj(path, buildings) == 2
    vertices, groups = read(path)
    assert list(groups) == ["家_1", "b"]
    assert np.abs(vertices).max() < 100
    for group, (solid,) in zip(groups.values(), (solids(5e5), solids(5e5 + 20))):
        triangles = np.array([triangle for _, triangle in group])
        a, b, c = vertices[triangles].transpose(1, 0, 2)
        assert np.einsum("ij,ij->i", np.cross(a, b), c).sum() / 6 == pytest.approx(volume(solid), abs=1e-6)
        edges = {(t[i], t[(i + 1) % 3]) for t in triangles.tolist() for i in range(3)}
        assert len(edges) == 3 * len(triangles)
        assert edges == {(b, a) for a, b in edges}
        assert {material for material, _ in group} == {"roof", "outer_wall", "inner_wall", "ground"}


def test_head_materials_and_origin(tmp_path):
    path = tmp_path / "a.obj"
    write_obj(path, [house("a", 5e5)])
    first, second = path.read_text(encoding="utf-8").splitlines()[:2]
    assert "500000.0000 5000000.0000 1.0000" in first
    assert second == "mtllib a.mtl"
    named = [line.split()[1] for line in (tmp_path / "a.mtl").read_text().splitlines() if line.startswith("newmtl")]
    assert named == ["roof", "outer_wall", "inner_wall", "ground", "overhang"]
    write_obj(path, [house("a", 5e5)], origin=(499_990.0, 5e6, 0.0))
    assert read(path)[0].min(axis=0).tolist() == [10.0, 0.0, 1.0]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.mtl", "a.obj"]


def test_nothing_to_write_and_wrong_name(tmp_path):
    assert write_obj(tmp_path / "a.obj", []) == 0
    assert (tmp_path / "a.obj").read_text().startswith("# Add 0.0000")
    with pytest.raises(InputError, match="ends in .obj"):
        write_obj(tmp_path / "a.ply", [])
