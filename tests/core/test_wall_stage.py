"""Walls of the sample city against the true ones."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
from pathlib import Path

import laspy
import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.merging.merge_stage import merge_models
from urbanmap_qgis.buildings.merging.wall_match import measured_wall
from urbanmap_qgis.buildings.solids.plan_partition import partition_plan
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.facades.building_plans import building_plans
from urbanmap_qgis.facades.wall_stage import WALL_COLUMNS, find_walls, wall_columns
from urbanmap_qgis.geometry.solid import multipolygon
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.registration.walls.stretches import WallReadings, shifted_stretches
from urbanmap_qgis.mobile.trajectory import move_points
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.settings.facades import WallSettings


def features(path, layer):
    """Geometries and rows of a GeoPackage layer."""
    connection = sqlite3.connect(path)
    connection.row_factory = sqlite3.Row
    rows = [dict(row) for row in connection.execute(f'select * from "{layer}"')]
    name, = (row[0] for row in connection.execute(
        "select column_name from gpkg_geometry_columns where table_name = ?", (layer,)))
    blobs = [row.pop(name) for row in rows]
    skip = {0: 8, 1: 40, 2: 56, 3: 56, 4: 72}
    return shapely.from_wkb([blob[skip[blob[3] >> 1 & 7]:] for blob in blobs]), rows


@pytest.fixture(scope="module")
def true_survey(small_city, tmp_path_factory):
    """The first survey of the small city where the scanners truly were."""
    las = laspy.read(small_city / "mms" / "survey_01.laz")
    reported = read_trajectory(small_city / "mms" / "survey_01_trajectory.csv").trajectory
    true = read_trajectory(small_city / "truth" / "survey_01_trajectory.csv").trajectory
    las.x, las.y, las.z = move_points(np.asarray(las.xyz), np.asarray(las.gps_time), reported, true).T
    path = tmp_path_factory.mktemp("walls") / "survey.laz"
    las.write(path)
    return path


@pytest.fixture(scope="module")
def found(small_city, true_survey):
    outlines, _rows = features(small_city / "footprints" / "gsi_buildings.gpkg", "BldA")
    plans = building_plans(outlines, range(1, len(outlines) + 1))
    return find_walls(open_cloud([true_survey]), plans)


@pytest.fixture(scope="module")
def truth(small_city):
    """Ends, lowest and highest z (n, 6) of the true walls."""
    lines, rows = features(small_city / "truth" / "roofs.gpkg", "wall_lines")
    ends = shapely.get_coordinates(lines).reshape(-1, 4)
    return np.column_stack([ends, [row["z_foot"] for row in rows], [row["z_top"] for row in rows]])


@pytest.mark.slow
def test_walls_lie_on_true_walls(found, truth):
    """Outlines are off by decimetres; the walls found on their behalf are not."""
    walls, counts = found
    assert counts.with_walls >= 5 and len(walls) >= 10
    errors, weights = [], []
    ends = truth[:, :4].reshape(-1, 2, 2)
    along = ends[:, 1] - ends[:, 0]
    length = np.hypot(*along.T)
    along /= length[:, None]
    for wall in walls:
        if wall.status not in ("ok", "partly seen"):
            continue
        places = shapely.get_coordinates(wall.contour, include_z=True)
        alike = np.abs(along @ wall.plane.normal[:2]) < 0.05
        middle = places[:, :2].mean(axis=0)
        reach = ((middle - ends[alike, 0]) * along[alike]).sum(axis=1)
        away = middle - ends[alike, 0]
        aside = np.abs(along[alike, 0] * away[:, 1] - along[alike, 1] * away[:, 0])
        near = aside[(reach > -0.5) & (reach < length[alike] + 0.5)]
        errors.append(near.min() if len(near) else np.inf)
        weights.append(wall.contour.length)
    errors = np.array(errors)
    assert np.mean(errors < 0.03) > 0.95
    assert np.sqrt(np.mean(errors[errors < 0.03] ** 2)) < 0.01


def test_most_of_what_was_seen_is_in_the_contours(found, truth, small_city, true_survey):
    walls, _ = found
    material = np.load(small_city / "truth" / "survey_01_labels.npz")["material"]
    points = laspy.read(true_survey).xyz[np.isin(material, (4, 5))]
    points = points[np.random.default_rng(1).permutation(len(points))[:40_000]]
    foot = truth[:, 4].mean()
    points = points[(points[:, 2] < foot + 18)]
    held = np.zeros(len(points), bool)
    for wall in walls:
        near = np.flatnonzero(np.abs(wall.plane.distance(points)) < 0.05)
        x_min, y_min, x_max, y_max = shapely.buffer(wall.contour, 0.3).bounds
        inside = ((points[near, :2] > (x_min, y_min)) & (points[near, :2] < (x_max, y_max))).all(axis=1)
        held[near[inside]] = True
    assert held.mean() > 0.9


def test_the_table_tells_all(found):
    walls, _ = found
    columns = wall_columns(walls)
    assert list(columns) == list(WALL_COLUMNS)
    ids = list(zip(columns["building_id"], columns["wall_id"]))
    assert len(set(ids)) == len(walls)
    for name in ("coverage", "hidden", "unseen", "openings"):
        values = np.array(columns[name])
        assert ((values >= 0) & (values <= 1)).all()
    assert np.nanmax(np.array(columns["sigma"])) < 0.05
    assert (np.array(columns["height"]) < 25).all()


def test_models_off_by_half_a_metre_come_to_the_true_walls(found, truth, small_city):
    """Blocks over the true outlines, moved, then merged with the walls found in the survey."""
    outlines, rows = features(small_city / "truth" / "footprints.gpkg", "wall_footprints")
    models, ids = [], []
    for outline, row in zip(outlines, rows):
        moved = shapely.affinity.translate(shapely.force_2d(outline), 0.45, -0.3)
        plan = partition_plan(moved, [moved], [row["z_max"]], [0])
        models.append(multipolygon(building_solids(plan, row["z_ground"])))
        ids.append(row["building"])
    walls = [measured_wall(number, wall.contour, wall.plane.rmse, wall.plane.sigma)
             for number, wall in enumerate(found[0]) if wall.status in ("ok", "partly seen")]
    merged = merge_models(ids, models, walls)
    assert all(building.valid for building in merged)
    lines = shapely.linestrings(truth[:, :4].reshape(-1, 2, 2))
    off = []
    for building in merged:
        ground = [polygon for polygon in shapely.get_parts(multipolygon(building.solids))
                  if (shapely.get_coordinates(polygon, include_z=True)[:, 2] == building.base).all()]
        border = shapely.boundary(shapely.union_all(shapely.force_2d(ground)))
        for edge in building.edges:
            if edge.match.status == "moved" and edge.length > 5 and edge.match.measured > 0.6:
                ends = shapely.get_coordinates(edge.wall)[:2]
                middle = shapely.line_interpolate_point(border, shapely.line_locate_point(
                    border, shapely.Point(ends.mean(axis=0))))
                off.append(shapely.distance(middle, lines).min())
    assert len(off) >= 5
    assert np.median(off) < 0.01 and np.mean(np.array(off) < 0.03) > 0.9


@pytest.mark.slow
def test_a_lower_limit_gives_lower_walls_and_workers_change_nothing(small_city, true_survey, found):
    from concurrent.futures import ThreadPoolExecutor

    outlines, _ = features(small_city / "footprints" / "gsi_buildings.gpkg", "BldA")
    plans = building_plans(outlines, range(1, len(outlines) + 1))
    settings = WallSettings(max_height=6.0)
    with ThreadPoolExecutor(2) as executor:
        low, _ = find_walls(open_cloud([true_survey]), plans, settings, executor=executor)
    again, _ = find_walls(open_cloud([true_survey]), plans, settings)
    assert 0 < max(wall_columns(low)["height"]) < 9.0
    assert [wall.contour.wkb for wall in low] == [wall.contour.wkb for wall in again]
    assert len(low) <= len(found[0])


def street(planes, per_m2=60.0, seed=0):
    """Points of upright walls (start, end, low, high) over a level street at 0 m."""
    rng = np.random.default_rng(seed)
    parts = [np.column_stack([rng.uniform(-5, 25, 4000), rng.uniform(-9, -3, 4000), rng.normal(0, 0.01, 4000)])]
    for (ax, ay), (bx, by), low, high in planes:
        length = np.hypot(bx - ax, by - ay)
        share, z = rng.uniform(0, 1, (2, int(per_m2 * length * (high - low))))
        normal = np.array([by - ay, ax - bx]) / length
        off = rng.normal(0, 0.005, len(share))
        x, y = ax + share * (bx - ax) + off * normal[0], ay + share * (by - ay) + off * normal[1]
        parts.append(np.column_stack([x, y, low + z * (high - low)]))
    return np.concatenate(parts) + np.array([-7000.0, -34000.0, 20.0])


def statuses(tmp_path, planes, outline, **settings):
    """Status of each wall by its depth behind y = 0, rounded to decimetres."""
    path = tmp_path / "street.laz"
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales, header.offsets = np.full(3, 0.001), np.array([-7000.0, -34000.0, 0.0])
    las = laspy.LasData(header)
    las.x, las.y, las.z = street(planes, **settings).T
    las.write(path)
    plans = building_plans([shapely.affinity.translate(outline, -7000.0, -34000.0)], [1])
    walls, _ = find_walls(open_cloud([path]), plans)
    return {round(wall.plane.point[1] + 34000.0, 1): wall.status for wall in walls if abs(wall.plane.normal[1]) > 0.9}


@pytest.mark.parametrize("depth", [1.2, 1.8])
def test_the_facade_of_an_outline_that_is_too_large_is_a_wall(tmp_path, depth):
    """Models whose walls stand at the eaves: the facade lies inside, and nothing stands before it."""
    outline = shapely.box(-depth, -depth, 20 + depth, 10 + depth)
    assert statuses(tmp_path, [((0, 0), (20, 0), 0, 9)], outline) == {0.0: "ok"}


@pytest.mark.slow
def test_a_setback_and_a_room_behind_the_facade_are_inside(tmp_path):
    facade, room = ((0, 0), (20, 0), 0, 9), ((1, 1.5), (19, 1.5), 1, 8)
    found = statuses(tmp_path, [facade, room], shapely.box(0, 0, 20, 10))
    assert found == {0.0: "ok", 1.5: "inside"}
    setback = statuses(tmp_path, [((0, 0), (20, 0), 0, 5), ((0, 1.6), (20, 1.6), 5, 9)], shapely.box(0, 0, 20, 10))
    assert setback[1.6] == "inside" and setback[0.0] in ("ok", "partly seen")
    # The podium's front was not seen; that the wall stands on a roof tells all the same.
    assert statuses(tmp_path, [((0, 1.6), (20, 1.6), 10, 17)], shapely.box(0, 0, 20, 10)) == {1.6: "inside"}
    assert statuses(tmp_path, [((0, 3.0), (20, 3.0), 0, 9)], shapely.box(0, 0, 20, 10)) == {3.0: "inside"}


@pytest.mark.slow
def test_walls_do_not_depend_on_the_threads_of_the_sums(small_city, true_survey):
    """The same bytes whatever number of threads multiplies matrices, in a process of its own for each."""
    script = ("import sys, shapely, hashlib\n"
              "from urbanmap_qgis.facades.building_plans import building_plans\n"
              "from urbanmap_qgis.facades.wall_stage import find_walls\n"
              "from urbanmap_qgis.io.points.pointcloud import open_cloud\n"
              "plans = building_plans(shapely.from_wkt(open(sys.argv[2]).read().split(chr(10))), range(1, 9))\n"
              "walls, _ = find_walls(open_cloud([sys.argv[1]]), plans)\n"
              "text = repr([(wall.contour.wkb_hex, wall.plane.sigma, wall.seen, wall.offset) for wall in walls])\n"
              "print(len(walls), hashlib.md5(text.encode()).hexdigest())\n")
    outlines, _rows = features(small_city / "footprints" / "gsi_buildings.gpkg", "BldA")
    path = true_survey.with_suffix(".wkt")
    path.write_text("\n".join(shapely.to_wkt(outlines[:8], rounding_precision=6)))
    told = {subprocess.run([sys.executable, "-c", script, str(true_survey), str(path)], check=True, text=True,
                           capture_output=True, cwd=Path(__file__).parents[2],
                           env={**os.environ, "OPENBLAS_NUM_THREADS": threads}).stdout for threads in ("1", "4")}
    assert len(told) == 1 and int(told.pop().split()[0]) > 5


# Stretches whose walls want the markings elsewhere: a known shift of a known stretch comes back, chance does not


EAVES = (0.1, 0.3)  # m, mean and standard deviation of how far facades stand inside the outlines


def readings(seed, change=(0.0, 0.0), begin=0.0, end=0.0, length=600.0, every=4.0):
    """Walls of both sides and of crossing streets, 0.1 m inside their outlines; in a stretch the markings are off."""
    rng = np.random.default_rng(seed)
    chainage = np.arange(0.0, length, every)
    outward = np.array([[0.0, 1.0], [0.0, -1.0], [1.0, 0.0], [-1.0, 0.0]])[np.arange(len(chainage)) % 4]
    off = np.where(((chainage >= begin) & (chainage < end))[:, None], change, 0.0)
    outside = (outward * off).sum(axis=1) - 0.1 + rng.normal(0.0, 0.03, len(chainage))
    return WallReadings(chainage, outward, outside, np.full(len(chainage), 0.05), 0.04)


@pytest.mark.parametrize("seed", range(3))
def test_a_shifted_stretch_comes_back(seed):
    item, = shifted_stretches(readings(seed, (0.3, -0.2), 200.0, 400.0), EAVES)
    assert item.change == pytest.approx([0.3, -0.2], abs=0.04)
    # It reaches on until walls have denied it: some walls' length beyond its true ends.
    assert 140.0 < item.begin < 210.0 and 390.0 < item.end < 460.0
    assert item.square > 16.0 and np.sqrt(np.diag(item.covariance)).max() < 0.06


@pytest.mark.parametrize("seed", range(3))
def test_without_a_shift_there_is_no_stretch(seed):
    assert shifted_stretches(readings(seed), EAVES) == []


def test_short_stretches_and_few_walls_say_nothing():
    """Of 40 m no stretch is made, nor of four walls in 200 m."""
    assert shifted_stretches(readings(1, (0.3, -0.2), 0.0, 40.0, length=40.0), EAVES) == []
    assert shifted_stretches(readings(1, (0.3, -0.2), 0.0, 200.0, length=200.0, every=50.0), EAVES) == []
    assert len(shifted_stretches(readings(1, (0.3, -0.2), 0.0, 200.0, length=200.0), EAVES)) == 1
