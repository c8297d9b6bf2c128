"""Roofs of any size: memory of the division, limits that are told, and no building that ends the others."""

import subprocess
import sys
import textwrap
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings import model_stage
from urbanmap_qgis.buildings.building_model import FitPoints, RoofInput, model_building
from urbanmap_qgis.buildings.model_status import NOT_MODELLED, SIMPLIFIED
from urbanmap_qgis.buildings.planes import plan_faces as faces_module
from urbanmap_qgis.buildings.planes.plan_faces import plan_faces
from urbanmap_qgis.buildings.roof_polygons import plane_roofs
from urbanmap_qgis.buildings.roof_polygons.building_polygons import roof_polygons_or_block
from urbanmap_qgis.buildings.roof_polygons.polygon_rows import RoofedBuilding
from urbanmap_qgis.errors import Cancelled, InsufficientDataError
from urbanmap_qgis.execution import checkpoint, in_order
from urbanmap_qgis.settings.buildings import PLANES, PolygonParameters

ROOT = Path(__file__).resolve().parents[2]

PATCHWORK = """
    import resource
    import numpy as np, shapely
    from scipy.spatial import cKDTree
    from urbanmap_qgis.buildings.planes.plane_detection import PlaneParameters
    from urbanmap_qgis.buildings.planes.plane_segmentation import segment_planes
    from urbanmap_qgis.buildings.planes.plane_partition import partition_planes
    rng = np.random.default_rng(2029)
    side = 78.0
    centre, slope = rng.uniform(0, side, (270, 2)), rng.uniform(-0.6, 0.6, (270, 2))
    xy = rng.uniform(0, side, (50_000, 2))
    own = cKDTree(centre).query(xy)[1]
    z = rng.uniform(20, 26, 270)[own] + ((xy - centre[own]) * slope[own]).sum(axis=1) + rng.normal(0, 0.03, len(xy))
    outline = shapely.box(0, 0, side, side)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    found = segment_planes(*xy.T, z, outline, 2.0, 8.0, PlaneParameters(), 2.0)
    made = partition_planes(outline, np.column_stack([xy, z]), found.roof_of_point.astype(int))
    height = [abs(polygon.area) for polygon in made.polygons]
    print(len(found.rows), len(made.polygons), sum(height), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
"""


@pytest.mark.slow
def test_a_roof_of_6000_m2_and_270_planes_stays_in_memory():
    resource = pytest.importorskip("resource")
    limit = 4 * 2**30
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(PATCHWORK)], cwd=ROOT, capture_output=True, text=True,
                          check=False, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
    assert done.returncode == 0, done.stderr
    planes, polygons, area, kilobytes = map(float, done.stdout.split())
    assert planes > 200 and polygons > 200
    assert area == pytest.approx(78.0**2, abs=0.5)
    assert kilobytes < 600_000


def test_segments_that_would_cut_too_many_faces_are_refused(monkeypatch):
    monkeypatch.setattr(faces_module, "MOST_FACES", 100)
    rng = np.random.default_rng(1)
    segments = rng.uniform(0, 50, (200, 2, 2))
    with pytest.raises(InsufficientDataError, match="more than 100"):
        plan_faces(shapely.box(0, 0, 50, 50), segments)
    assert len(plan_faces(shapely.box(0, 0, 50, 50), segments[:3]).polygons) < 10


def gable(seed=3, density=8.0):
    rng = np.random.default_rng(seed)
    xy = rng.uniform([0, 0], [12, 8], (int(96 * density), 2))
    z = 8.0 - 0.7 * np.abs(xy[:, 1] - 4) + rng.normal(0, 0.02, len(xy))
    return shapely.box(0, 0, 12, 8), np.column_stack([xy, z]), np.where(xy[:, 1] < 4, 1, 2)


def divided(monkeypatch, error):
    outline, points, roof = gable()

    def fails(*_arguments):
        raise error

    monkeypatch.setattr(plane_roofs, "partition_planes", fails)
    table = roof_polygons_or_block(RoofedBuilding(1, outline, points, roof), PolygonParameters(roofs=PLANES))
    return outline, points, roof, table


@pytest.mark.parametrize(("error", "reason"), [
    (MemoryError(), "memory"), (ValueError("no such node"), "a fault of the program"),
    (InsufficientDataError("too many faces"), "too many faces")])
def test_a_roof_that_fails_becomes_a_block_and_says_so(monkeypatch, error, reason):
    outline, points, roof, table = divided(monkeypatch, error)
    assert all(SIMPLIFIED in str(words) for words in table.status)
    assert sum(polygon.area for polygon in table.polygon) == pytest.approx(outline.area)
    roofs = RoofInput(*(np.array(getattr(table, name), object if name in ("polygon", "status") else None)
                        for name in RoofInput.__dataclass_fields__))
    model = model_building(1, outline, "", roofs, 0.0, FitPoints(points, roof), True)
    assert model.solids and model.status == SIMPLIFIED
    assert reason in model.reason


def test_a_cancelled_roof_is_not_simplified(monkeypatch):
    with pytest.raises(Cancelled):
        divided(monkeypatch, Cancelled())


def test_a_building_that_fails_leaves_the_others(monkeypatch):
    outline, points, roof = gable()
    whole = model_stage.model_building

    def model(number, *rest):
        if number == 2:
            raise ZeroDivisionError("a mistake")
        return whole(number, *rest)

    monkeypatch.setattr(model_stage, "model_building", model)
    roofs = RoofInput(np.array([outline], object), np.array([1]), np.array([1]), np.array([7.0]), np.array(["ok"]))
    block = model_stage.ModelPiece(np.array([1, 2, 3]), np.array([outline] * 3), np.array([""] * 3), np.zeros(3),
                                   [roofs] * 3, False, np.array([""] * 3), np.zeros(3), [FitPoints(points, roof)] * 3)
    _, made = model_stage._model_piece((np.arange(3), block))
    assert [bool(model.solids) for model in made] == [True, False, True]
    assert made[1].status == NOT_MODELLED and "a fault of the program" in made[1].reason


@pytest.mark.parametrize("executor", [None, ThreadPoolExecutor(2)])
def test_work_ends_at_its_next_checkpoint(executor):
    calls = []

    def check():
        if len(calls) > 3:
            raise Cancelled()

    def work(piece):
        for _ in range(1000):
            calls.append(piece)
            checkpoint()
        return piece

    with pytest.raises(Cancelled):
        list(in_order(work, range(4), executor, check))
    assert len(calls) < 20


def test_checkpoint_asks_nobody_outside_of_work():
    checkpoint()
