"""Points grouped by building, buckets on disk, outlines made usable, owners of contested points."""

import multiprocessing
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.building_points import iter_building_blocks, require_dimension
from urbanmap_qgis.buildings.outlines.footprint import clean_footprints
from urbanmap_qgis.buildings.point_assignment import PlanIndex, assign_points
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.execution import end_workers_but, in_order
from urbanmap_qgis.io.points.point_buckets import PointBuckets
from urbanmap_qgis.io.points.pointcloud import PointLayout, open_cloud


@pytest.mark.parametrize("limit", [0, 10**9])
def test_buckets_keep_the_order_in_memory_and_on_disk(limit):
    dtype = np.dtype([("n", "i4")])
    rng = np.random.default_rng(2)
    keys = rng.integers(0, 5, 1000)
    records = np.arange(1000).astype("i4").view(dtype)
    with PointBuckets(dtype, memory_limit=limit) as buckets:
        for start in range(0, 1000, 130):
            buckets.add(keys[start:start + 130], records[start:start + 130])
        for key in range(5):
            whole = np.flatnonzero(keys == key)
            assert np.array_equal(buckets.read(key)["n"], whole)
            for rows in (slice(3, 40), slice(150, None), slice(30, 30)):
                assert np.array_equal(buckets.read(key, rows)["n"], whole[rows])
            assert np.array_equal(buckets.pop(key)["n"], np.flatnonzero(keys == key))
            assert len(buckets.read(key)) == 0
        assert len(buckets.read(99)) == 0 and len(buckets.pop(99)) == 0


def test_blocks_give_each_building_its_points_whatever_the_order(tmp_path, make_cloud):
    rng = np.random.default_rng(3)
    owner = rng.integers(0, 700, 4000)
    path = make_cloud(tmp_path / "p.laz", rng.uniform(0, 9, 4000), rng.uniform(0, 9, 4000), np.arange(4000) / 100,
                      extra={"building_id": owner})
    cloud = open_cloud([path])
    layout = PointLayout(cloud)
    ids = rng.permutation(np.arange(1, 651))
    seen = {}
    for rows, groups in iter_building_blocks(cloud, layout, ids):
        seen.update({int(ids[row]): group["Z"] for row, group in zip(rows, groups)})
    assert set(seen) == set(ids.tolist())
    for number, heights in seen.items():
        assert np.array_equal(heights, np.flatnonzero(owner == number) * 10)
    with pytest.raises(InputError, match="roof_id"):
        require_dimension(cloud, "roof_id", "Segment roofs")


def test_outlines_are_repaired_and_none_is_lost():
    bow = shapely.from_wkt("POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))")
    rows = np.array([shapely.box(0, 0, 1, 1), None, shapely.Polygon(), bow,
                     shapely.MultiPolygon([shapely.box(0, 0, 1, 1), shapely.box(3, 0, 4, 1)]),
                     shapely.from_wkt("POLYGON Z ((0 0 9, 1 0 9, 1 1 9, 0 0 9))"),
                     shapely.LineString([(0, 0), (1, 1)])], dtype=object)
    result = clean_footprints(rows)
    assert result.ids.tolist() == [1, 2, 3, 4, 5, 6, 7]
    assert result.usable.tolist() == [True, False, False, True, True, True, False]
    assert result.polygons[3].is_valid and result.polygons[3].area == pytest.approx(8)
    assert "repaired" in result.notes[3] and "empty" in result.notes[1] and "no area" in result.notes[6]
    assert not result.polygons[5].has_z


def test_bad_ids_are_named():
    box = np.array([shapely.box(0, 0, 1, 1)] * 2, dtype=object)
    with pytest.raises(InputError, match="hold the building_id 7 more than once"):
        clean_footprints(box, np.array([7, 7]))
    with pytest.raises(InputError, match="below 1"):
        clean_footprints(box, np.array([0, 1]))
    with pytest.raises(InputError, match="no whole number"):
        clean_footprints(box, np.array(["a", None], dtype=object))
    with pytest.raises(InputError, match="empty"):
        clean_footprints(np.array([], dtype=object))


def test_plan_index_finds_what_a_full_search_finds():
    rng = np.random.default_rng(4)
    x, y = rng.uniform(-50, 90, 3000), rng.uniform(1000, 1100, 3000)
    triangle = shapely.Polygon([(-20, 1010), (60, 1030), (10, 1090)])
    expected = np.flatnonzero(shapely.contains_xy(triangle, x, y))
    assert np.array_equal(PlanIndex(x, y).inside(triangle), expected)
    assert not len(PlanIndex(x, y).inside(shapely.box(500, 500, 600, 600)))
    assert not len(PlanIndex(x[:0], y[:0]).inside(triangle))


def surface(x0, x1, z, step=0.25):
    x, y = (a.ravel() for a in np.meshgrid(np.arange(x0 + step / 2, x1, step), np.arange(0.1, 10, step)))
    return x, y, np.full(len(x), float(z))


def test_an_eave_over_a_lower_neighbour_stays_with_its_roof():
    tall, low = surface(0, 10.6, 12), surface(10.6, 20, 4)
    x, y, z = (np.concatenate(axis) for axis in zip(tall, low))
    outlines = np.array([shapely.box(0, 0, 10, 10), shapely.box(10, 0, 20, 10)], dtype=object)
    result = assign_points(x, y, z, outlines, 1.0)
    assert np.array_equal(result.owner, (z < 8).astype(int))
    assert not result.primary[(x > 10) & (z > 8)].any()


def test_a_party_wall_between_equal_roofs_parts_the_points_at_the_outline():
    x, y, z = surface(0, 20, 5)
    outlines = np.array([shapely.box(0, 0, 10, 10), shapely.box(10, 0, 20, 10), None], dtype=object)
    result = assign_points(x, y, z, outlines, 1.0)
    assert np.array_equal(result.owner, (x > 10).astype(int))
    swapped = assign_points(x, y, z, outlines[[1, 0]], 1.0)
    assert np.array_equal(swapped.owner, (x < 10).astype(int))


def test_points_far_away_belong_to_nobody():
    result = assign_points(np.array([50.0]), np.array([50.0]), np.array([5.0]),
                           np.array([shapely.box(0, 0, 1, 1)], dtype=object), 2.0)
    assert result.owner.tolist() == [-1] and result.primary.tolist() == [False]


def test_pieces_come_back_in_order_with_and_without_workers():
    expected = [n * n for n in range(50)]
    assert list(in_order(lambda n: n * n, range(50))) == expected
    with ThreadPoolExecutor(3) as executor:
        assert list(in_order(lambda n: n * n, range(50), executor)) == expected


def test_only_workers_started_since_are_ended():
    context = multiprocessing.get_context("fork")
    before, after = (context.Process(target=time.sleep, args=(60,), daemon=True) for _ in range(2))
    before.start()
    others = set(multiprocessing.active_children())
    after.start()
    try:
        end_workers_but(others)
        after.join(10)
        assert after.exitcode is not None and before.exitcode is None
    finally:
        before.kill()
