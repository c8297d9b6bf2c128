"""The own check of solids against val3dity itself, on generated cases: what val3dity refuses, the own check refuses."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
import shapely

from tests.solid_files import write_solids
from urbanmap_qgis.buildings.solids.plan_partition import Cell, partition_plan
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.solids import solid_object
from urbanmap_qgis.geometry.solid import Solid

VAL3DITY = Path(__file__).resolve().parents[3] / "shared" / "tools" / "val3dity"


def judged(folder, solids):
    """Valid or not, by val3dity, of each solid."""
    path, report = folder / "solids.city.json", folder / "report.json"
    write_solids(path, [solid_object(f"b{i}", {}, (solid,)) for i, solid in enumerate(solids)])
    subprocess.run([str(VAL3DITY), str(path), "--report", str(report)], check=True, capture_output=True, timeout=60)
    found = {item["id"]: item["validity"] for item in json.loads(report.read_text())["features"]}
    return [found[f"b{i}"] for i in range(len(solids))]


def runs():
    try:
        return subprocess.run([str(VAL3DITY), "--version"], capture_output=True, timeout=20).returncode == 0
    except OSError:
        return False


pytestmark = pytest.mark.skipif(not runs(), reason="val3dity does not lie beside the checkout or cannot run here")


def random_plan(seed):
    """Roof polygons with gaps and overlaps on one outline, with heights that may nearly be equal."""
    rng = np.random.default_rng(seed)
    polygons, heights = [], []
    for _ in range(rng.integers(2, 6)):
        x, y = rng.uniform(0, 14, 2)
        polygons.append(shapely.box(x, y, x + rng.uniform(3, 12), y + rng.uniform(3, 12)))
        heights.append(rng.choice([6.0, 6.001, 6.04, 6.06, 7.0, rng.uniform(4, 9)]))
    return polygons, heights


def test_every_solid_that_is_made_is_valid_by_val3dity(tmp_path):
    solids = []
    for seed in range(60):
        polygons, heights = random_plan(seed)
        plan = partition_plan(None, polygons, heights, list(range(len(heights))))
        solids += building_solids(plan, 0.0)
    assert not any(check_solid(solid) for solid in solids)
    assert all(judged(tmp_path, solids))


def block(height, step):
    """Two roofs a step apart in height, side by side."""
    cells = (Cell(shapely.box(0, 0, 5, 5), 1, height), Cell(shapely.box(5, 0, 10, 5), 2, height + step))
    (solid,) = building_solids(cells, 0.0)
    return solid


def test_roofs_a_millimetre_apart_become_one_level(tmp_path):
    good = [block(height, 0.001) for height in np.arange(6.0, 30.0, 0.7)]
    assert all(judged(tmp_path, good)) and not any(check_solid(solid) for solid in good)
    assert all(len(set(solid.vertices[:, 2])) == 2 for solid in good)


def damaged(solid, kind, rng):
    """A solid with one thing wrong, or nearly so."""
    vertices, faces = solid.vertices.copy(), list(solid.faces)
    one = int(rng.integers(len(faces)))
    if kind == "missing":
        faces.pop(one)
    elif kind == "reversed":
        faces[one] = tuple(tuple(reversed(ring)) for ring in faces[one])
    elif kind == "moved":
        vertices[rng.integers(len(vertices))] += rng.normal(0, 10.0 ** rng.uniform(-4, 0.5), 3)
    elif kind == "near":
        a, b = rng.choice(len(vertices), 2, replace=False)
        vertices[a] = vertices[b] + [10.0 ** rng.uniform(-3.5, -2.0), 0, 0]
    elif kind == "twice":
        faces.append(faces[one])
    elif kind == "inside out":
        faces = [tuple(tuple(reversed(ring)) for ring in face) for face in faces]
    return Solid(vertices, tuple(faces), (*solid.surface_type, solid.surface_type[0])[:len(faces)],
                 (*solid.roof_id, None)[:len(faces)])


@pytest.mark.parametrize("kind", ["missing", "reversed", "moved", "near", "twice", "inside out"])
def test_what_val3dity_refuses_the_own_check_refuses(tmp_path, kind):
    rng = np.random.default_rng(7)
    cases = []
    for seed in range(40):
        polygons, heights = random_plan(100 + seed)
        plan = partition_plan(None, polygons, heights, list(range(len(heights))))
        cases.append(damaged(building_solids(plan, 0.0)[0], kind, rng))
    theirs = judged(tmp_path, cases)
    ours = [not check_solid(case) for case in cases]
    assert not [i for i, (our, their) in enumerate(zip(ours, theirs)) if our and not their]
    assert not all(theirs)
