"""Ground of a mobile survey's files: a made-up street whose ground is known."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import laspy
import numpy as np
import pytest

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError
from urbanmap_qgis.mobile import survey_tiles
from urbanmap_qgis.mobile.ground import classify_ground_files
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.settings.terrain import ClothSettings
from urbanmap_qgis.terrain.cloth import classify_ground

X0, Y0 = -7000.0, -34000.0


def street(length=120.0, lift=0.0, start=1000.0, seed=1, backwards=False):
    """x, y, z, time, ground of a sloping street with kerbs, walls and parked vehicles; driven at 10 m/s."""
    rng = np.random.default_rng(seed)
    u, v = rng.uniform(0, length, 60_000), rng.uniform(-10, 10, 60_000)
    z = 0.03 * u + np.where(np.abs(v) > 5, 0.15, 0.0) + rng.normal(0, 0.004, len(u))
    wall_u, wall_v = rng.uniform(0, length, 20_000), rng.choice([-10.0, 10.0], 20_000)
    wall_z = 0.03 * wall_u + 0.15 + rng.uniform(0.3, 12, 20_000)
    car_u, car_v, car_z = (rng.uniform(*span, 6_000) for span in ((50, 54.5), (2.5, 4.3), (0.35, 1.5)))
    under = (u > 50) & (u < 54.5) & (v > 2.5) & (v < 4.3)
    u, v, z = (np.concatenate(parts) for parts in
               ((u[~under], wall_u, car_u), (v[~under], wall_v, car_v), (z[~under], wall_z, 0.03 * car_u + car_z)))
    truth = np.arange(len(u)) < np.count_nonzero(~under)
    time = start + (length - u if backwards else u) / 10.0
    order = np.argsort(time, kind="stable")
    return X0 + u[order], Y0 + v[order], 10.0 + lift + z[order], time[order], truth[order]


@pytest.fixture
def survey(make_cloud, tmp_path):
    def make(name="測量.laz", parts=None, **attributes):
        x, y, z, time, truth = parts or street()
        path = make_cloud(tmp_path / name, x, y, z, gps_time=time, **attributes)
        return path, truth
    return make


def classes(path):
    return np.asarray(laspy.read(path).classification)


def test_ground_is_class_2_and_all_else_stays(survey, tmp_path):
    x, y, z, time, truth = street()
    number = np.arange(len(x))
    path, _ = survey(parts=(x, y, z, time, truth), extra={"number": number}, intensity=number % 60_000,
                     scan_angle=number % 100, user_data=7)
    made = classify_ground_files([path], tmp_path / "地面.laz")
    before, after = laspy.read(path), laspy.read(tmp_path / "地面.laz")
    ground_class = classes(tmp_path / "地面.laz") == 2
    assert (ground_class & truth).sum() / truth.sum() > 0.999
    assert (ground_class & truth).sum() / ground_class.sum() > 0.999
    assert set(classes(tmp_path / "地面.laz")) == {1, 2}
    for name in before.point_format.dimension_names:
        if name != "classification":
            assert np.array_equal(before[name], after[name]), name
    assert after.header.parse_crs() == before.header.parse_crs()
    assert made.points == made.usable == len(x) and made.ground == ground_class.sum() and made.passes == 1


def test_the_same_as_the_filter_in_memory_whatever_the_tiles(survey, tmp_path, monkeypatch):
    path, _ = survey()
    las = laspy.read(path)
    expected = classify_ground(*(np.asarray(las[name]) for name in "xyz"))
    for number, tile in enumerate((32.0, 50.0, 128.0)):
        monkeypatch.setattr(survey_tiles, "_TILE", tile)
        with ThreadPoolExecutor(2) as executor:
            classify_ground_files([path], tmp_path / f"{number}.laz", executor=executor if number else None)
        assert np.mean((classes(tmp_path / f"{number}.laz") == 2) != expected) < 1e-4


def test_tiles_of_many_points_are_split_and_the_ground_stays(survey, tmp_path, monkeypatch):
    path, _ = survey()
    classify_ground_files([path], tmp_path / "whole.laz")
    seen = []
    tiling = survey_tiles.Tiling
    monkeypatch.setattr(survey_tiles, "Tiling", lambda cell, cells: seen.append(cells) or tiling(cell, cells))
    monkeypatch.setattr(survey_tiles, "_TILE_POINTS", 5_000)
    classify_ground_files([path], tmp_path / "split.laz")
    assert seen[0] == 64 and seen[-1] < 64
    assert np.array_equal(classes(tmp_path / "whole.laz"), classes(tmp_path / "split.laz"))


@pytest.mark.slow
def test_a_second_pass_that_lies_higher_keeps_its_ground(survey, tmp_path):
    first, second = street(), street(lift=0.6, start=1100.0, seed=2, backwards=True)
    both = tuple(np.concatenate(pair) for pair in zip(first, second))
    path, truth = survey(parts=both)
    made = classify_ground_files([path], tmp_path / "g.laz")
    found = classes(tmp_path / "g.laz") == 2
    assert made.passes == 2
    for half in (slice(0, len(first[0])), slice(len(first[0]), None)):
        assert (found[half] & truth[half]).sum() / truth[half].sum() > 0.999
    # The passes in two files, the later one first, are told apart too.
    (a, _), (b, _) = survey("a.laz", first), survey("b.laz", second)
    classify_ground_files([b, a], tmp_path / "two.laz")
    turned = np.concatenate([found[len(first[0]):], found[:len(first[0])]])
    assert np.mean((classes(tmp_path / "two.laz") == 2) != turned) < 1e-4


def test_other_classes_and_noise_stay(survey, tmp_path):
    path, _ = survey(parts=street(), classification=np.arange(86_000)[:len(street()[0])] % 8)
    before = classes(path)
    classify_ground_files([path], tmp_path / "g.laz")
    after = classes(tmp_path / "g.laz")
    other = ~np.isin(before, (0, 1, 2))
    assert np.array_equal(before[other], after[other])
    assert set(after[~other]) == {1, 2}


def test_without_gps_time(make_cloud, tmp_path):
    x, y, z, _time, truth = street()
    path = make_cloud(tmp_path / "a.las", x, y, z, point_format=0)
    assert classify_ground_files([path], tmp_path / "g.las").passes == 1
    assert ((classes(tmp_path / "g.las") == 2) & truth).sum() / truth.sum() > 0.999


def with_clusters(parts, count, depth, size, seed=3):
    """The street with clusters of points `depth` m below its own points, and which points those are."""
    rng = np.random.default_rng(seed)
    x, y, z, time, truth = parts
    row = np.repeat(rng.choice(np.flatnonzero(truth), count), size)
    low = -rng.uniform(*depth, count).repeat(size) + rng.normal(0, 0.02, count * size)
    place = np.column_stack([x, y, z])[row] + np.column_stack([rng.normal(0, 0.2, (len(row), 2)), low])
    parts = [np.append(old, new) for old, new in zip((x, y, z, time, truth), (*place.T, time[row], 0 * row))]
    order = np.argsort(parts[3], kind="stable")
    return *(column[order] for column in parts[:4]), parts[4][order].astype(bool)


@pytest.mark.parametrize("depth", [(0.25, 0.4), (0.4, 1.0), (1.0, 2.0), (6.0, 13.0)])
def test_ghosts_below_the_road_take_no_ground(survey, tmp_path, depth):
    clean, truth = survey("clean.laz")
    classify_ground_files([clean], tmp_path / "clean_ground.laz")
    path, still = survey("ghosts.laz", with_clusters(street(), 30, depth, 12))
    classify_ground_files([path], tmp_path / "ghosts_ground.laz")
    before, after = classes(tmp_path / "clean_ground.laz") == 2, classes(tmp_path / "ghosts_ground.laz") == 2
    assert (after & still).sum() > 0.99 * (before & truth).sum()
    assert (after & ~still).sum() - (before & ~truth).sum() < 0.35 * 360


def test_a_ditch_beside_the_road_stays_ground(survey, tmp_path):
    x, y, z, time, truth = street()
    ditch = truth & (y > Y0 + 7.0) & (y < Y0 + 8.5)
    thinned = ~ditch | (np.arange(len(x)) % 4 == 0)  # its floor is seen at a flat angle: a quarter of the points
    path, _ = survey("ditch.laz", tuple(column[thinned] for column in (x, y, z - 0.6 * ditch, time, truth)))
    classify_ground_files([path], tmp_path / "g.laz")
    assert (classes(tmp_path / "g.laz") == 2)[ditch[thinned]].mean() > 0.8


def test_a_share_of_ground_that_cannot_be_right_is_refused(survey, tmp_path):
    path, _ = survey("walls.laz")
    with pytest.raises(InsufficientDataError, match="found to be ground"):
        classify_ground_files([path], tmp_path / "g.laz", min_ground_share=0.9)
    assert not (tmp_path / "g.laz").exists()


@pytest.mark.parametrize("humped", [False, True])
def test_stretches_where_the_cloth_leaves_the_ground_out_are_told(survey, tmp_path, humped):
    """Humps as steep as 37 % on the last third of the street."""
    x, y, z, time, truth = street(240.0)
    along, told = x - X0, []
    z = z + np.where(humped & (along > 160.0), 0.75 * (1.0 - np.cos(along / 2.0)), 0.0)
    path, _ = survey(parts=(x, y, z, time, truth))
    classify_ground_files([path], tmp_path / "g.laz", progress=Progress(warn=told.append))
    assert len(told) == humped and all("seconds of the drive" in line for line in told)


@pytest.mark.slow
def test_refusals(survey, make_cloud, tmp_path):
    path, _ = survey("noise.laz", classification=7)
    with pytest.raises(InsufficientDataError, match="no usable points"):
        classify_ground_files([path], tmp_path / "g.laz")
    for epsg, words in ((None, "coordinate reference system"), (6668, "in metres")):
        path, _ = survey("crs.laz", epsg=epsg)
        with pytest.raises(InputError, match=words):
            classify_ground_files([path], tmp_path / "g.laz")
    path, _ = survey("whole.laz")
    broken = tmp_path / "broken.laz"
    broken.write_bytes(path.read_bytes()[:-40_000])
    with pytest.raises(InputError, match="copy or download it again"):
        classify_ground_files([broken], tmp_path / "g.laz")
    with pytest.raises(InputError, match="too large for one cloth"):
        away = (X0 + 1.5e6, Y0 + 1.5e6, 10.0, 1010.0, True)
        far = tuple(np.append(column, value) for column, value in zip(street(), away))
        path, _ = survey("far.laz", parts=far)
        classify_ground_files([path], tmp_path / "g.laz", ClothSettings(resolution=0.1))
    assert not (tmp_path / "g.laz").exists()


@pytest.mark.parametrize("at", [0.1, 0.4, 0.6])
def test_cancel_leaves_nothing(survey, tmp_path, at):
    path, _ = survey()
    seen = []
    progress = Progress(report=seen.append, cancelled=lambda: bool(seen) and seen[-1] >= at)
    with pytest.raises(Cancelled):
        classify_ground_files([path], tmp_path / "g.laz", progress=progress)
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]
