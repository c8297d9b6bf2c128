"""Roof planes: found on points, divided in plan, raised to solids; known houses with exact truth."""

import itertools
import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
import shapely

from tests.solid_files import write_solids
from urbanmap_qgis.buildings.planes.alpha_expansion import expand_labels
from urbanmap_qgis.buildings.planes.plane_detection import detect_planes
from urbanmap_qgis.buildings.planes.plane_moments import azimuth_degrees, moments, slope_degrees, solve
from urbanmap_qgis.buildings.planes.plane_partition import partition_planes
from urbanmap_qgis.buildings.planes.plane_segmentation import segment_planes
from urbanmap_qgis.buildings.planes.plane_solids import checked_sloped_solids, is_coverage, is_sloped
from urbanmap_qgis.buildings.planes.roof_type import roof_type
from urbanmap_qgis.buildings.quality import RoofCell, model_fit
from urbanmap_qgis.buildings.solids.sloped_solid import SlopedCell, sloped_solids
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.solids import solid_object
from urbanmap_qgis.geometry.solid import INNER_WALL, ROOF, volume
from urbanmap_qgis.settings.buildings import PlaneParameters

VAL3DITY = Path(__file__).resolve().parents[3] / "shared" / "tools" / "val3dity"
X0, Y0 = 84_900.0, 447_400.0


def gable(x, y):
    """Ridge along x at y = 4, 9 m high; eaves at 5 m."""
    return 9.0 - np.abs(y - 4.0)


def hip(x, y):
    """Four slopes over 12 x 8 m: eaves at 5 m, ridge at 8.2 m."""
    return 5.0 + 0.8 * np.minimum.reduce([x, 12.0 - x, y, 8.0 - y])


def valley(x, y):
    """A gable along x and a lower one along y from its middle: an L of 12 x 8 m and 6 x 8 m to the north."""
    main = 9.0 - np.abs(y - 4.0)
    wing = 8.0 - np.abs(x - 3.0)
    return np.where(y > 8.0, wing, np.where((y > 4.0) & (np.abs(x - 3) < 3), np.maximum(main, wing), main))


def steps(x, y):
    """Two sheds that fall the same way, one 3 m higher."""
    return np.where(x < 6.0, 6.0 + 0.3 * y, 9.0 + 0.3 * y)


BOX = shapely.box(0, 0, 12, 8)
L_SHAPE = BOX.union(shapely.box(0, 8, 6, 16))
HOUSES = {"gable": (BOX, gable, 2), "hip": (BOX, hip, 4), "valley": (L_SHAPE, valley, 4), "steps": (BOX, steps, 2)}


def cloud(outline, height, density=8.0, noise=0.03, seed=1):
    """Points (n, 3) on a house in national coordinates, and its outline there."""
    rng = np.random.default_rng(seed)
    x0, y0, x1, y1 = outline.bounds
    xy = rng.uniform((x0, y0), (x1, y1), (int(density * (x1 - x0) * (y1 - y0)), 2))
    xy = xy[shapely.contains_xy(outline, *xy.T)]
    z = height(*xy.T) + rng.normal(0, noise, len(xy))
    return np.column_stack([xy[:, 0] + X0, xy[:, 1] + Y0, z]), shapely.affinity.translate(outline, X0, Y0)


def model(points, outline, density, ground=0.0):
    """Partition, solids and what the check says of a house's points."""
    found = segment_planes(*points.T, outline, ground, density, PlaneParameters(), 2.0)
    plan = partition_planes(outline, points, found.roof_of_point)
    solids, problems = checked_sloped_solids(outline, np.array(plan.polygons, object), plan.roof_numbers, ground)
    return found, plan, solids, problems


def content(outline, height):
    """Volume under a roof by fine sums, m3."""
    x0, y0, x1, y1 = outline.bounds
    step = 0.02
    x, y = np.meshgrid(np.arange(x0 + step / 2, x1, step), np.arange(y0 + step / 2, y1, step))
    inside = shapely.contains_xy(outline, x, y)
    return height(x[inside], y[inside]).sum() * step**2


def test_planes_of_moments_are_least_squares():
    rng = np.random.default_rng(3)
    points = rng.normal(0, 4, (60, 3))
    label = rng.integers(-1, 3, 60)
    planes, squares = solve(moments(points, label, 3))
    for number in range(3):
        own = points[label == number]
        design = np.column_stack([own[:, :2], np.ones(len(own))])
        truth, residual, *_ = np.linalg.lstsq(design, own[:, 2], rcond=None)
        assert planes[number] == pytest.approx(truth, abs=1e-6)
        assert squares[number] == pytest.approx(residual[0], rel=1e-6)
    joined = moments(points, np.where(label >= 0, 0, -1), 1)[0]
    assert moments(points, label, 3).sum(axis=0) == pytest.approx(joined)


class TableBorders:
    """Borders whose costs stand in a table (m, k, k)."""

    def __init__(self, pairs, table):
        self.pairs, self.table, self.most = pairs, table, table.max(axis=(1, 2), initial=0.0)

    def cost(self, rows, one, two):
        return self.table[np.arange(len(self.pairs))[rows], one, two]


def energy_of(data, borders, labels):
    one, two = labels[borders.pairs[:, 0]], labels[borders.pairs[:, 1]]
    return data[np.arange(len(labels)), labels].sum() + borders.cost(slice(None), one, two).sum()


@pytest.mark.parametrize("seed", range(20))
def test_alpha_expansion_finds_the_least_energy(seed):
    rng = np.random.default_rng(seed)
    n, k = 7, 3
    data = rng.uniform(0, 1, (n, k))
    pairs = np.array([pair for pair in itertools.combinations(range(n), 2) if rng.random() < 0.4])
    share = rng.uniform(0.5, 1, (len(pairs), k, k))
    share = np.maximum(share, share.transpose(0, 2, 1)) * (1 - np.eye(k))
    borders = TableBorders(pairs, rng.uniform(0, 0.6, len(pairs))[:, None, None] * share)
    best = min(energy_of(data, borders, np.array(labels)) for labels in itertools.product(range(k), repeat=n))
    found = energy_of(data, borders, expand_labels(data, borders, data.argmin(axis=1)))
    assert found == pytest.approx(best, rel=0.02)


@pytest.mark.parametrize("density", [8.0, 3.0])
@pytest.mark.parametrize("name", HOUSES)
def test_known_houses(name, density):
    outline, height, count = HOUSES[name]
    points, placed = cloud(outline, height, density)
    found, plan, solids, problems = model(points, placed, density)
    assert problems == []
    assert count <= len(found.rows) <= count + (density < 5) and len(plan.polygons) == count
    assert shapely.area(plan.polygons).sum() == pytest.approx(outline.area, rel=2e-3)
    assert sum(map(volume, solids)) == pytest.approx(content(outline, height), rel=0.01)
    cells = [RoofCell(shapely.force_2d(polygon), plane[2], 0, tuple(plane[:2]), tuple(plan.origin))
             for polygon, plane in zip(plan.polygons, plan.planes)]
    assert model_fit(*points.T, cells, np.empty((0, 6))).rmse_z95 < 0.06


def test_ridge_of_a_gable_is_one_and_in_the_middle():
    points, placed = cloud(*HOUSES["gable"][:2])
    _, plan, solids, _ = model(points, placed, 8.0)
    ridges = [{tuple(corner) for corner in solids[0].vertices[list(face[0])].tolist() if corner[2] > 8.0}
              for face, kind in zip(solids[0].faces, solids[0].surface_type) if kind == ROOF]
    assert ridges[0] == ridges[1] and len(ridges[0]) == 2
    for _, y, z in ridges[0]:
        assert (y - Y0, z) == pytest.approx((4.0, 9.0), abs=0.03)
    assert list(map(slope_degrees, plan.planes)) == pytest.approx([45, 45], abs=0.5)
    assert sorted(map(azimuth_degrees, plan.planes)) == pytest.approx([0.0, 180.0], abs=0.5) or \
        sorted(map(azimuth_degrees, plan.planes)) == pytest.approx([180.0, 360.0], abs=0.5)


def test_a_step_is_an_inner_wall_where_it_is():
    points, placed = cloud(*HOUSES["steps"][:2])
    *_, solids, _ = model(points, placed, 8.0)
    walls = [solids[0].vertices[list(face[0])] for face, kind in zip(solids[0].faces, solids[0].surface_type)
             if kind == INNER_WALL]
    assert len(walls) == 1
    assert walls[0][:, 0] - X0 == pytest.approx(np.full(4, 6.0), abs=0.25)


def test_a_slope_that_was_not_seen_gets_no_plane_stretched_over_it():
    points, placed = cloud(BOX, gable)
    seen = points[points[:, 1] - Y0 < 4.0]
    *_, solids, problems = model(seen, placed, 8.0)
    assert problems == []
    assert max(solid.vertices[:, 2].max() for solid in solids) < seen[:, 2].max() + 0.3


def test_clutter_and_trees_are_on_no_plane():
    rng = np.random.default_rng(4)
    points, _ = cloud(BOX, gable)
    crown = np.column_stack([rng.uniform(9, 12, 80) + X0, rng.uniform(0, 3, 80) + Y0, rng.uniform(9, 14, 80)])
    both = np.concatenate([points, crown]) - [X0, Y0, 0]
    label = detect_planes(both, 8.0, PlaneParameters())
    assert (label[:len(points)] >= 0).mean() > 0.97
    assert (label[len(points):] >= 0).mean() < 0.2


def test_the_order_of_the_points_changes_no_plane():
    points, placed = cloud(*HOUSES["hip"][:2])
    order = np.random.default_rng(0).permutation(len(points))
    first, second = model(points, placed, 8.0)[1], model(points[order], placed, 8.0)[1]
    assert [polygon.area for polygon in first.polygons] == pytest.approx([polygon.area for polygon in second.polygons],
                                                                         abs=1e-3)


def test_too_few_points_have_no_planes():
    box = shapely.box(0, 0, 12, 8)
    rng = np.random.default_rng(1)
    assert segment_planes(*rng.uniform(0, 5, (3, 2)), box, -9, 8.0, PlaneParameters(), 2.0).rows == ()
    scattered = segment_planes(*rng.uniform(0, 8, (3, 60)), box, -9, 8.0, PlaneParameters(), 2.0)
    assert scattered.rows == () and scattered.status == "no planes"


def random_cells(seed):
    """A plan of strips under random planes, some a few centimetres apart."""
    rng = np.random.default_rng(seed)
    xs = np.sort(rng.uniform(0, 20, 3))
    lines = [shapely.LineString([(x, -1), (x + rng.uniform(-4, 4), 11)]) for x in xs]
    lines.append(shapely.LineString([(-1, rng.uniform(2, 8)), (21, rng.uniform(2, 8))]))
    network = shapely.union_all([*lines, shapely.box(0, 0, 20, 10).exterior], grid_size=0.01)
    base = rng.uniform(-0.5, 0.5, 2)
    cells = []
    for number, polygon in enumerate(shapely.get_parts(shapely.polygonize([network]))):
        slope = base if rng.random() < 0.3 else rng.uniform(-0.8, 0.8, 2)
        cells.append(SlopedCell(polygon, number, (*slope, 20.0 + rng.choice([0.0, 0.02, 0.04, 0.3, 2.0])),
                                (10.0, 5.0)))
    return cells


@pytest.fixture(scope="module")
def random_solids():
    return [sloped_solids(random_cells(seed), 0.0) for seed in range(40)]


def test_random_roofs_are_valid(random_solids):
    for seed, solids in enumerate(random_solids):
        assert [problem for solid in solids for problem in check_solid(solid)] == [], seed


def test_random_roofs_are_valid_by_val3dity(random_solids, tmp_path):
    if not VAL3DITY.is_file():
        pytest.skip("val3dity is not beside the checkout")
    write_solids(tmp_path / "m.city.json", [solid_object(f"b{seed}", {}, solids, lod="2.2")
                                              for seed, solids in enumerate(random_solids)])
    run = subprocess.run([VAL3DITY, tmp_path / "m.city.json", "--report", tmp_path / "r.json"], capture_output=True)
    if not (tmp_path / "r.json").is_file():
        pytest.skip(f"val3dity does not run here: {run.stderr[:80]}")
    report = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))
    assert [feature["id"] for feature in report["features"] if not feature["validity"]] == []


def test_no_step_under_five_centimetres(random_solids):
    for solids in random_solids:
        for solid in solids:
            for face, kind in zip(solid.faces, solid.surface_type):
                if kind == INNER_WALL:
                    assert np.ptp(solid.vertices[list(face[0]), 2]) >= 0.05


def test_two_level_roofs_four_centimetres_apart_meet():
    left, right = shapely.box(0, 0, 5, 5), shapely.box(5, 0, 9, 5)
    for step, walls in ((0.04, 0), (0.2, 1)):
        solid, = sloped_solids([SlopedCell(left, 1, (0, 0, 6.0)), SlopedCell(right, 2, (0, 0, 6.0 + step))], 0.0)
        assert sum(kind == INNER_WALL for kind in solid.surface_type) == walls
        assert check_solid(solid) == ()


def test_polygons_changed_by_hand_are_cut_to_fit():
    lower = shapely.Polygon([(0, 0, 5), (12, 0, 5), (12, 4.5, 9.5), (0, 4.5, 9.5)])
    upper = shapely.Polygon([(0, 4, 9), (12, 4, 9), (12, 8, 5), (0, 8, 5)])
    polygons = np.array([lower, upper], object)
    assert not is_coverage(polygons) and is_sloped(lower)
    solids, problems = checked_sloped_solids(BOX, polygons, np.array([1, 2]), 0.0)
    assert problems == [] and len(solids) == 1
    assert sum(map(volume, solids)) == pytest.approx(content(BOX, gable), rel=0.03)


def test_words_for_roofs():
    def cell(x, slope):
        return RoofCell(shapely.box(x, 0, x + 5, 5), 5.0, 0, slope)

    assert roof_type([cell(0, (0, 0))]) == "flat"
    assert roof_type([cell(0, (0.5, 0))]) == "shed"
    assert roof_type([cell(0, (0.5, 0)), cell(5, (-0.5, 0))]) == "gable"
    assert roof_type([cell(5 * i, slope) for i, slope in enumerate([(1, 0), (-1, 0), (0, 1), (0, -1)])]) == "hip"
    assert roof_type([cell(0, (0.5, 0)), cell(5, (0, 0))]) == "flat and sloped"
    assert roof_type([cell(0, (0.5, 0)), cell(5, (-0.4, 0.4)), cell(10, (0.1, 0.6))]) == "complex"


def test_distances_to_a_sloped_roof():
    roof = RoofCell(shapely.box(0, 0, 10, 10), 5.0, 0, (1.0, 0.0))  # z = 5 + x
    x, y, z = np.array([[5.0, 5.0, 11.0], [-3.0, 5.0, 1.0], [5.0, -2.0, 10.0]]).T
    fit = model_fit(x, y, z, [roof], np.empty((0, 8)))
    assert fit.rmse_z == pytest.approx(1.0)
    assert fit.rmse_3d == pytest.approx(np.sqrt(np.mean([0.5, 25.0, 4.0])))
