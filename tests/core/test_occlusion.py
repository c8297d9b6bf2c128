"""Occlusion maps: outlines against triangle by triangle filling, boxes of known shape, files and refusals."""

from __future__ import annotations

import numpy as np
import pytest
import rasterio
from hypothesis import given, settings
from hypothesis import strategies as st
from rasterio.errors import NotGeoreferencedWarning
from shapely.geometry import box

from urbanmap_qgis.aerial.frames import occlusion
from urbanmap_qgis.aerial.frames.camera import Distortion, ExteriorOrientation, FrameCamera, project_to_frame
from urbanmap_qgis.aerial.frames.normalised_surface import (
    NormalisedSurface,
    steepened_walls,
    wall_offsets,
    with_low_parts,
)
from urbanmap_qgis.aerial.frames.occlusion import occlusion_map, occlusion_mask
from urbanmap_qgis.aerial.frames.silhouette import SilhouetteEdges, fill_silhouette, silhouette_edges
from urbanmap_qgis.errors import InputError, OutputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.raster import write_raster
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.settings.aerial import OcclusionSettings

WKT = rasterio.crs.CRS.from_epsg(6677).to_wkt()
GRID = Grid(-100.0, 100.0, 0.5, 400, 400)
CAMERA = FrameCamera(100.0, 0.02, 900, 800)
NADIR = ExteriorOrientation("frame.tif", 0.0, 0.0, 1000.0, 0.0, 0.0, 0.0)
STRICT = OcclusionSettings(low_parts=False)


def covered_by(corners, width, height):
    """Pixels whose centres lie in a triangle (3, 2) of columns and rows; sides as in `fill_silhouette`."""
    columns, rows = np.meshgrid(np.arange(width), np.arange(height))
    (a, b, c), inside = corners, np.ones((height, width), bool)
    for start, stop in ((a, b), (b, c), (c, a)):
        inside &= (stop[0] - start[0]) * (rows - start[1]) - (stop[1] - start[1]) * (columns - start[0]) < 0
    return inside


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_outlines_enclose_the_union_of_the_triangles_that_face_the_camera(seed):
    rng = np.random.default_rng(seed)
    shape = rng.integers(2, 7, 2)
    i, j = np.mgrid[:shape[0], :shape[1]]
    # Whole numbers off the pixel centres, so that no centre lies on a side.
    column, row = (5 * value + rng.normal(0, rng.choice([1, 4]), shape) + 0.317 for value in (j, i))
    z, high = rng.random(shape), rng.random(shape) < 0.5
    column[rng.random(shape) < 0.1] = np.nan
    expected = np.zeros((30, 35), bool)
    for r, c in np.ndindex(shape[0] - 1, shape[1] - 1):
        nw, sw, se, ne = (r, c), (r + 1, c), (r + 1, c + 1), (r, c + 1)
        falling = abs(z[nw] - z[se]) <= abs(z[ne] - z[sw])
        for triangle in ((nw, sw, se), (nw, se, ne)) if falling else ((nw, sw, ne), (sw, se, ne)):
            if any(high[vertex] for vertex in triangle):
                expected |= covered_by([(column[vertex], row[vertex]) for vertex in triangle], 35, 30)
    sides = silhouette_edges(column, row, z, high)
    assert (fill_silhouette(sides, 35, 0, 30) == expected).all()
    near = sides.within(35, 30)
    assert (np.concatenate([fill_silhouette(near, 35, top, 10) for top in (0, 10, 20)]) == expected).all()


def test_no_sides_enclose_nothing():
    assert not fill_silhouette(SilhouetteEdges.joined([]), 10, 0, 5).any()


def test_flat_raised_block_leaves_only_its_border():
    column, row = np.meshgrid(np.arange(50.0), np.arange(40.0))
    sides = silhouette_edges(column, row, np.zeros((40, 50)), np.ones((40, 50), bool))
    assert len(sides) == 2 * (49 + 39)
    assert fill_silhouette(sides, 60, 0, 50).sum() == 49 * 39


def test_walls_become_steep_and_roofs_stay():
    profile = np.array([[0, 0, 0, 3, 8, 10, 10.5, np.nan, 10]] * 3, np.float32)
    assert steepened_walls(profile)[1].tolist()[:7] == [0, 0, 0, 0, 10, 10, 10.5]
    assert np.isnan(steepened_walls(profile)[1, 7])


def test_walls_stand_between_raised_and_low_cells():
    high = np.zeros((5, 5), bool)
    high[:, 3:] = True
    east, north = wall_offsets(high, 2.0)
    assert east[2].tolist() == pytest.approx([0, 0, 1, -0.7, 0]) and not north.any()
    east, north = wall_offsets(high.T, 2.0)
    assert north[:, 2].tolist() == pytest.approx([0, 0, -1, 0.7, 0]) and not east.any()


def test_low_parts_belong_to_what_stands_beside_them_but_vehicles_do_not():
    above = np.zeros((200, 200))
    above[20:60, 20:60] = 12.0
    above[20:60, 60:80] = 4.0
    above[70:75, 20:50] = 4.0
    above[150:170, 150:170] = 4.0
    found = with_low_parts(above, 5.0, 0.5)
    assert found[20:60, 20:80].all() and found.sum() == 40 * 60


def write_town(folder, z, ground=None, ground_grid=GRID):
    ground = np.zeros(ground_grid.shape, np.float32) if ground is None else ground
    write_raster(folder / "表面.tif", z.astype(np.float32), GRID, WKT)
    write_raster(folder / "地盤.tif", ground.astype(np.float32), ground_grid, WKT)
    return folder / "表面.tif", folder / "地盤.tif"


def with_box(height, x0=50.0, x1=60.0, y0=-5.0, y1=5.0, ground=0.0):
    x, y = np.meshgrid(*GRID.centres())
    return np.where((x > x0) & (x < x1) & (y > y0) & (y < y1), ground + height, ground)


def mask_of(paths, settings=STRICT, footprints=(), camera=CAMERA, pose=NADIR):
    with NormalisedSurface(*paths) as surface:
        return occlusion_mask(camera, pose, surface, settings, footprints)


def test_box_hides_what_its_roof_leans_over(tmp_path):
    """Seen from 1000 m above the origin a box of 40 m hides the ground from its near wall to 60 m / 0.96."""
    mask = mask_of(write_town(tmp_path, with_box(40.0)))
    columns = np.flatnonzero(mask[399])
    # 5 pixels a metre; the roof's mesh ends 0.35 cells beyond the centres of its last cells, 0.075 m inside the wall.
    assert columns[0] == pytest.approx(449.5 + 5 * 50, abs=1)
    assert columns[-1] == pytest.approx(449.5 + 5 * 59.925 / 0.96, abs=1)
    assert len(columns) == columns[-1] - columns[0] + 1
    rows = np.flatnonzero(mask[:, columns[-1] - 2])
    assert (rows[0], rows[-1]) == pytest.approx((399.5 - 5 * 4.925 / 0.96, 399.5 + 5 * 4.925 / 0.96), abs=1)


def test_walls_are_masked_from_the_foot_up(tmp_path):
    """A camera tilted by 40 degrees sees the whole southern wall of a box."""
    pose = ExteriorOrientation("oblique.tif", 55.0, -900.0, 1000.0, 41.0, 0.0, 0.0)
    mask = mask_of(write_town(tmp_path, with_box(40.0)), pose=pose)
    column, row, _ = project_to_frame(CAMERA, pose, np.array([[55, -5, h] for h in (0.3, 10, 20, 30, 39)], float))
    assert mask[np.round(row).astype(int), np.round(column).astype(int)].all()
    column, row, _ = project_to_frame(CAMERA, pose, np.array([[55.0, -5.5, 0.0], [55.0, 60.0, 0.0]]))
    assert not mask[np.round(row).astype(int), np.round(column).astype(int)].any()


def test_threshold_counts_from_the_ground_not_from_the_sea(tmp_path):
    ground = np.full(GRID.shape, 300.0)
    assert not mask_of(write_town(tmp_path, with_box(4.9, ground=300.0), ground)).any()
    assert mask_of(write_town(tmp_path, with_box(5.1, ground=300.0), ground)).any()


def test_ground_of_another_grid(tmp_path):
    coarse = Grid(-300.0, 300.0, 2.0, 300, 300)
    same = mask_of(write_town(tmp_path, with_box(20.0)))
    assert (mask_of(write_town(tmp_path, with_box(20.0), np.zeros(coarse.shape), coarse)) == same).all()


def test_masks_do_not_depend_on_the_strips(tmp_path, monkeypatch):
    rng = np.random.default_rng(3)
    z = np.kron(rng.choice([0, 3, 8, 25], (20, 20)), np.ones((20, 20))) + rng.normal(0, 0.1, GRID.shape)
    paths = write_town(tmp_path, z)
    outlines = [box(-60, -60, -20.2, -10.7), box(10, 20, 40, 50)]
    camera = FrameCamera(100.0, 0.02, 900, 800, distortion=Distortion(k1=-1e-4))
    whole = mask_of(paths, OcclusionSettings(), outlines, camera)
    monkeypatch.setattr(occlusion, "_STRIP_VERTICES", 400 * 7)
    monkeypatch.setattr(occlusion, "_STRIP_ROWS", 33)
    assert (mask_of(paths, OcclusionSettings(), outlines, camera) == whole).all()
    assert 0.2 < whole.mean() < 0.9


def test_distortion_moves_the_mask(tmp_path):
    paths = write_town(tmp_path, with_box(20.0))
    bent = FrameCamera(100.0, 0.02, 900, 800, distortion=Distortion(k1=0.1, unit_mm=100.0))
    for camera, factor in ((CAMERA, 1.0), (bent, 1 + 0.1 * 0.05**2)):
        first = np.flatnonzero(mask_of(paths, camera=camera)[399])[0]
        assert first == pytest.approx(449.5 + 250 * factor, abs=1)


@pytest.mark.paper("J 3.2.1.1, boundary map")
def test_outlines_add_low_buildings_and_fill_gaps(tmp_path):
    z = with_box(3.0)
    z[:, 310:314] = 0.0
    outline = box(50, -5, 60, 5)
    paths = write_town(tmp_path, z)
    assert not mask_of(paths).any()
    mask = mask_of(paths, footprints=[outline])
    columns = np.flatnonzero(mask[399])
    assert len(columns) == pytest.approx(50, abs=4) and len(columns) == columns[-1] - columns[0] + 1


def test_files_and_figures(tmp_path):
    paths = write_town(tmp_path, with_box(20.0))
    warnings = []
    outlines = [box(50, -5, 60, 5), box(0, 0, 9, 9), None]
    made = occlusion_map(CAMERA, NADIR, *paths, tmp_path / "影.tif", STRICT, outlines, Progress(warn=warnings.append))
    with pytest.warns(NotGeoreferencedWarning), rasterio.open(tmp_path / "影.tif") as source:
        mask = source.read(1)
        assert source.compression is not None and mask.shape == (800, 900) and source.dtypes == ("uint8",)
    assert set(np.unique(mask)) == {0, 255} and made.hidden_share == (mask == 255).mean()
    assert (made.footprints_raised, made.footprints_flat, made.uncovered_share) == (1, 1, 0.0) and not warnings
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(["表面.tif", "地盤.tif", "影.tif"])


def test_frame_partly_beyond_the_surface(tmp_path):
    warnings = []
    pose = ExteriorOrientation("edge.tif", 100.0, 0.0, 1000.0, 0.0, 0.0, 0.0)
    made = occlusion_map(CAMERA, pose, *write_town(tmp_path, with_box(20.0)), tmp_path / "o.tif",
                         progress=Progress(warn=warnings.append))
    assert made.uncovered_share == pytest.approx(0.5, abs=0.02)
    assert len(warnings) == 1 and "edge.tif" in warnings[0]


def test_refusals(tmp_path):
    paths = write_town(tmp_path, with_box(20.0))
    for pose in (ExteriorOrientation("far.tif", 9000.0, 0, 1000.0, 0, 0, 0),
                 ExteriorOrientation("under.tif", 0, 0, -100.0, 0, 0, 0),
                 ExteriorOrientation("up.tif", 0, 0, 1000.0, 180, 0, 0)):
        with pytest.raises(InputError, match=pose.image):
            occlusion_map(CAMERA, pose, *paths, tmp_path / "o.tif")
    with pytest.raises(OutputError, match="does not exist"):
        occlusion_map(CAMERA, NADIR, *paths, tmp_path / "none" / "o.tif")
    with pytest.raises(InputError, match="cannot be read"):
        occlusion_map(CAMERA, NADIR, paths[0], tmp_path / "none.tif", tmp_path / "o.tif")
    with pytest.raises(InputError, match="greater than 0"):
        OcclusionSettings(0.0)
    assert not (tmp_path / "o.tif").exists()


def test_windows_one_below_the_other_are_as_if_read_alone(tmp_path):
    paths = write_town(tmp_path, with_box(40.0))
    columns = slice(5, 60)
    with NormalisedSurface(*paths) as rolling:
        for top in (0, 20, 40, 10):
            rows = slice(top, top + 25)
            got = rolling.raised(rows, columns, 5.0, True)
            with NormalisedSurface(*paths) as alone:
                for one, other in zip(got, alone.raised(rows, columns, 5.0, True)):
                    np.testing.assert_array_equal(one, other)
            got[0][:] = -99.0  # they are the caller's own
