"""Surface and ground rasters, in memory and from files."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError, OutputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.raster import read_raster
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.settings.terrain import ClothSettings, SurfaceSettings
from urbanmap_qgis.terrain.delaunay import triangulate
from urbanmap_qgis.terrain.rasterise import rasterise
from urbanmap_qgis.terrain.surface import ground_mask, ground_raster, ground_source, thin_highest, thin_mean
from urbanmap_qgis.terrain.surface_files import surfaces_from_files

X0, Y0 = -8_000.0, -34_000.0
ROOFS = [(20, 20, 45, 50, 12.0), (60, 15, 95, 55, 30.0), (30, 70, 80, 100, 8.0)]


def ground_at(x, y):
    return 5.0 + 0.03 * (x - X0) - 0.02 * (y - Y0)


def town(size=120.0, density=5.0, seed=1):
    """x, y, z and classes (2 and 6) of a town on a plane, to the millimetre."""
    rng = np.random.default_rng(seed)
    x = np.round(X0 + rng.random(int(size * size * density)) * size, 3)
    y = np.round(Y0 + rng.random(len(x)) * size, 3)
    z, classes = ground_at(x, y), np.full(len(x), 2, dtype=np.uint8)
    for x0, y0, x1, y1, height in ROOFS:
        roof = (x > X0 + x0) & (x < X0 + x1) & (y > Y0 + y0) & (y < Y0 + y1)
        z[roof], classes[roof] = ground_at(X0 + x0, Y0 + y0) + height, 6
    return x, y, np.round(z, 3), classes


def grid_of(x, y, cell=0.5):
    return Grid.covering(x.min(), y.min(), x.max(), y.max(), cell)


def expected_ground(grid):
    cx, cy = grid.centres()
    return ground_at(cx[None, :], cy[:, None])


@pytest.mark.parametrize("classified", [True, False])
def test_ground_has_no_gap_under_buildings(classified):
    x, y, z, classes = town()
    grid = grid_of(x, y)
    raster = ground_raster(x, y, z, classes if classified else None, grid)
    assert raster.dtype == np.float32 and np.isfinite(raster).all()
    assert np.abs(raster - expected_ground(grid)).max() < 0.05


def test_ground_continues_outwards():
    x, y, z, classes = town()
    grid = Grid(X0 - 30, Y0 + 150, 1.0, 180, 180)
    raster = ground_raster(x, y, z, classes, grid)
    assert np.isfinite(raster).all()
    assert raster.min() >= z[classes == 2].min() - 0.01 and raster.max() <= z[classes == 2].max() + 0.01


@pytest.fixture
def surface_of(make_cloud, tmp_path):
    """`surface_of(x, y, z)`: surface (DSM) of a file with these points, and its grid."""
    def make(x, y, z, **settings):
        cloud = make_cloud(tmp_path / "points.las", x, y, z)
        surfaces_from_files([cloud], tmp_path / "surface.tif", settings=SurfaceSettings(**settings))
        return read_raster(tmp_path / "surface.tif")[:2]
    return make


def test_surface_shows_roofs_and_ground(surface_of):
    x, y, z, _classes = town()
    raster, grid = surface_of(x, y, z)
    for x0, y0, x1, y1, height in ROOFS:
        rows, columns, _part = grid.window(X0 + x0 + 3, Y0 + y0 + 3, X0 + x1 - 3, Y0 + y1 - 3)
        np.testing.assert_allclose(raster[rows, columns], ground_at(X0 + x0, Y0 + y0) + height, atol=0.01)
    assert np.nanmin(raster - expected_ground(grid)) > -0.01


def test_lone_points_in_the_air_are_left_out(surface_of):
    x, y, z, _classes = town()
    high, _ = surface_of(np.append(x, x[0]), np.append(y, y[0]), np.append(z, 500.0))
    assert np.array_equal(high, surface_of(x, y, z)[0], equal_nan=True)


def test_longest_edge_leaves_gaps_empty(surface_of):
    x, y, z, _classes = town()
    keep = np.hypot(x - X0 - 60, y - Y0 - 62) > 15
    whole, grid = surface_of(x[keep], y[keep], z[keep])
    cut, _ = surface_of(x[keep], y[keep], z[keep], max_edge=4.0)
    row, column, _inside = grid.cells(np.array([X0 + 60]), np.array([Y0 + 62]))
    assert np.isfinite(whole[row, column]).all() and np.isnan(cut[row, column]).all()
    same = np.isfinite(cut)
    assert np.array_equal(cut[same], whole[same])


def counts(**by_class):
    values = np.zeros(256, dtype=np.int64)
    for name, number in by_class.items():
        values[int(name[1:])] = number
    return values


def test_choice_of_ground_points():
    assert ground_source(counts(c2=400, c6=600)).method == "classes"
    assert ground_source(counts(c1=1000)).method == "cloth"
    assert ground_source(counts(c1=990, c2=3, c6=7)).method == "cloth"
    assert ground_source(counts(c2=400, c6=600), "cloth").method == "cloth"
    with pytest.raises(InsufficientDataError, match="no ground points"):
        ground_source(counts(c6=1000))
    with pytest.raises(InsufficientDataError, match="no ground points"):
        ground_source(counts(c1=1000), "classes")
    with pytest.raises(InsufficientDataError, match="no usable points"):
        ground_source(counts())
    with pytest.raises(InputError):
        ground_source(counts(c2=5), "guess")


def test_noise_is_never_ground():
    x, y, z, classes = town()
    z[:200], classes[:200] = -40.0, 7
    assert not ground_mask(x, y, z, classes)[:200].any()
    assert not ground_mask(x, y, z, np.where(classes == 7, 7, 1))[:200].any()


def test_mean_points_stay_on_a_plane():
    x, y, _z, _classes = town()
    mx, my, mz = thin_mean(x, y, ground_at(x, y), 0.7)
    np.testing.assert_allclose(mz, ground_at(mx, my), atol=1e-9)
    assert len(mx) <= (120 / 0.7 + 2) ** 2


# From files

@pytest.fixture
def town_file(make_cloud, tmp_path):
    x, y, z, classes = town()
    return make_cloud(tmp_path / "点群.laz", x, y, z, classification=classes)


@pytest.mark.slow
def test_files_equal_memory(town_file, tmp_path):
    x, y, z, classes = town()
    summary = surfaces_from_files([town_file], tmp_path / "dsm.tif", tmp_path / "ground.tif")
    surface, grid, wkt = read_raster(tmp_path / "dsm.tif")
    ground, ground_grid, _wkt = read_raster(tmp_path / "ground.tif")
    assert grid == ground_grid == summary.grid and "Japan Plane Rectangular" in wkt
    assert summary.points_read == len(x) and summary.ground_method == "classes"
    assert summary.ground_points == (classes == 2).sum()
    top = thin_highest(x, y, z, grid.cell)
    expected = np.full(grid.shape, np.nan, np.float32)
    rasterise(x[top], y[top], z[top], triangulate(x[top], y[top]), grid, expected)
    # The lattice of the triangulation differs: of four points on nearly one circle the other diagonal may win.
    assert np.array_equal(np.isnan(surface), np.isnan(expected))
    assert (np.abs(surface - expected) > 1e-3).mean() < 1e-3
    assert (np.isnan(ground) == np.isnan(surface)).all()
    assert np.nanmax(np.abs(ground - expected_ground(grid))) < 0.05
    assert summary.empty_share == pytest.approx(np.isnan(surface).mean())


@pytest.mark.slow
@pytest.mark.parametrize("tile_metres", [40.0, 97.0])
def test_result_does_not_depend_on_tiles_order_or_workers(make_cloud, tmp_path, monkeypatch, tile_metres):
    x, y, z, _classes = town(density=3.0)
    whole = make_cloud(tmp_path / "whole.las", x, y, z)
    east = x > X0 + 55
    parts = [make_cloud(tmp_path / f"part{k}.las", x[part], y[part], z[part]) for k, part in
             enumerate((east, ~east))]
    settings = SurfaceSettings(cloth=ClothSettings(resolution=2.0))

    def run(paths, name, executor=None):
        surfaces_from_files(paths, tmp_path / f"{name}.tif", tmp_path / f"{name}_ground.tif", None, settings,
                            executor=executor)
        return read_raster(tmp_path / f"{name}.tif")[0], read_raster(tmp_path / f"{name}_ground.tif")[0]

    reference = run([whole], "one")
    monkeypatch.setattr("urbanmap_qgis.terrain.delaunay._BLOCK_POINTS", 1500)
    monkeypatch.setattr("urbanmap_qgis.terrain.tiles._TILE_METRES", tile_metres)
    monkeypatch.setattr("urbanmap_qgis.io.points.point_buckets.MEMORY_LIMIT", 10_000)
    with ThreadPoolExecutor(3) as executor:
        tiled = run(parts, "tiled", executor)
    alone = run(parts, "alone")
    for a, b, c in zip(reference, tiled, alone):
        assert np.array_equal(b, c, equal_nan=True)
        assert np.array_equal(np.isnan(a), np.isnan(b))
        assert (np.abs(a - b) > 1e-3).mean() < 2e-3


def test_mesh_is_the_whole_surface(town_file, tmp_path):
    summary = surfaces_from_files([town_file], tmp_path / "dsm.tif", mesh_path=tmp_path / "mesh.ply")
    content = (tmp_path / "mesh.ply").read_bytes()
    header, body = content.split(b"end_header\n", 1)
    vertex_count = int(header.split(b"element vertex ")[1].split()[0])
    vertices = np.frombuffer(body, dtype="<f8", count=3 * vertex_count).reshape(-1, 3)
    faces = np.frombuffer(body, dtype=[("n", "u1"), ("c", "<i4", 3)], offset=24 * vertex_count)
    assert len(faces) == summary.triangles and (faces["n"] == 3).all()
    a, b, c = (vertices[faces["c"][:, k], :2] for k in range(3))
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    assert (area > 0).all()
    assert area.sum() == pytest.approx(shapely.MultiPoint(vertices[:, :2]).convex_hull.area, rel=1e-6)
    assert not (tmp_path / "ground.tif").exists() and summary.ground_points is None


@pytest.mark.slow
def test_gaps_empty_or_ground(make_cloud, tmp_path):
    x, y, z, classes = town()
    keep = np.hypot(x - X0 - 60, y - Y0 - 62) > 15
    path = make_cloud(tmp_path / "gap.las", x[keep], y[keep], z[keep], classification=classes[keep])
    empty = surfaces_from_files([path], tmp_path / "a.tif", tmp_path / "ag.tif",
                                settings=SurfaceSettings(max_edge=4.0))
    filled = surfaces_from_files([path], tmp_path / "b.tif", tmp_path / "bg.tif",
                                 settings=SurfaceSettings(max_edge=4.0, ground_in_gaps=True))
    assert empty.triangles_left_out > 0 and empty.empty_share > filled.empty_share + 0.03
    surface, grid, _wkt = read_raster(tmp_path / "b.tif")
    row, column, _inside = grid.cells(np.array([X0 + 60]), np.array([Y0 + 62]))
    assert surface[row, column] == pytest.approx(ground_at(X0 + 60, Y0 + 62), abs=0.05)
    assert np.isfinite(read_raster(tmp_path / "ag.tif")[0][row, column]).all()


def test_absurd_heights_and_noise_are_left_out(make_cloud, tmp_path):
    x, y, z, classes = town()
    z[:3], z[3:6], classes[3:6] = 50_000.0, 300.0, 18
    path = make_cloud(tmp_path / "noisy.las", x, y, z, classification=classes)
    summary = surfaces_from_files([path], tmp_path / "dsm.tif")
    assert summary.points_used == len(x) - 6
    assert np.nanmax(read_raster(tmp_path / "dsm.tif")[0]) < 45


def test_buildings_alone_give_no_ground(make_cloud, tmp_path):
    x, y, z, classes = town()
    path = make_cloud(tmp_path / "roofs.las", *(v[classes == 6] for v in (x, y, z)), classification=6)
    with pytest.raises(InsufficientDataError, match="no ground points"):
        surfaces_from_files([path], tmp_path / "dsm.tif", tmp_path / "ground.tif")
    assert not list(tmp_path.glob("*.tif"))
    assert surfaces_from_files([path], tmp_path / "dsm.tif").ground_points is None


@pytest.mark.parametrize(("epsg", "words"), [(None, "no coordinate reference system"), (6668, "in metres"),
                                             (2263, "in metres")])
def test_crs_must_be_in_metres(make_cloud, tmp_path, epsg, words):
    path = make_cloud(tmp_path / "a.las", np.arange(5.0), np.arange(5.0) ** 2, np.arange(5.0), epsg=epsg)
    with pytest.raises(InputError, match=words):
        surfaces_from_files([path], tmp_path / "dsm.tif")


def test_unusable_clouds(make_cloud, tmp_path):
    none = make_cloud(tmp_path / "none.las", np.empty(0), np.empty(0), np.empty(0))
    noise = make_cloud(tmp_path / "noise.las", np.arange(9.0), np.arange(9.0) ** 2, np.arange(9.0), classification=7)
    line = make_cloud(tmp_path / "line.las", np.arange(9.0), np.arange(9.0), np.arange(9.0))
    for path, words in ((none, "no points"), (noise, "no usable points"), (line, "line")):
        with pytest.raises(InsufficientDataError, match=words):
            surfaces_from_files([path], tmp_path / "dsm.tif")
    far = make_cloud(tmp_path / "far.las", np.array([0.0, 1.0, 900_000.0]), np.array([0.0, 5.0, 900_000.0]),
                     np.zeros(3))
    with pytest.raises(InputError, match="coarser"):
        surfaces_from_files([far], tmp_path / "dsm.tif")
    assert not list(tmp_path.glob("*.tif"))


def test_truncated_file(town_file, tmp_path):
    short = tmp_path / "short.laz"
    short.write_bytes(town_file.read_bytes()[:-20_000])
    with pytest.raises(InputError, match="short.laz"):
        surfaces_from_files([short], tmp_path / "dsm.tif")
    assert not (tmp_path / "dsm.tif").exists()


def test_cancel_keeps_the_earlier_result(town_file, tmp_path):
    (tmp_path / "dsm.tif").write_bytes(b"earlier")
    seen = []
    progress = Progress(report=seen.append, cancelled=lambda: bool(seen) and seen[-1] > 0.6)
    with pytest.raises(Cancelled):
        surfaces_from_files([town_file], tmp_path / "dsm.tif", tmp_path / "g.tif", tmp_path / "m.ply",
                            progress=progress)
    assert (tmp_path / "dsm.tif").read_bytes() == b"earlier"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["dsm.tif", town_file.name]


def test_progress_grows_to_one(town_file, tmp_path):
    seen = []
    surfaces_from_files([town_file], tmp_path / "dsm.tif", tmp_path / "g.tif", progress=Progress(report=seen.append))
    assert seen == sorted(seen) and seen[-1] == 1.0


def test_folder_that_does_not_exist(town_file, tmp_path):
    with pytest.raises(OutputError, match="does not exist"):
        surfaces_from_files([town_file], tmp_path / "nowhere" / "dsm.tif")


@pytest.mark.parametrize("wrong", [{"resolution": 0.0}, {"resolution": float("nan")}, {"max_edge": -1.0}])
def test_settings_are_checked(wrong):
    with pytest.raises(InputError):
        SurfaceSettings(**wrong)


def test_a_point_far_outside_is_named_before_its_raster_is_laid_out(make_cloud, tmp_path):
    chance = np.random.default_rng(2)
    x, y = chance.uniform(0, 100, (2, 5000))
    x[700] = 1.9e6
    cloud = make_cloud(tmp_path / "far.laz", x, y, np.full(5000, 3.0))
    with pytest.raises(InputError, match="some lie near 19[0-9]{5}, .* km from the others"):
        surfaces_from_files([cloud], tmp_path / "dsm.tif", settings=SurfaceSettings(resolution=1.0))
    assert not (tmp_path / "dsm.tif").exists()


def test_fractions_of_a_part_run_within_the_whole():
    told = []
    part = Progress(told.append).part(0.5, 1.0).part(0.25, 0.75)
    for fraction in (0.0, 0.5, 1.0):
        part.step(fraction)
    assert told == pytest.approx([0.625, 0.75, 0.875])
