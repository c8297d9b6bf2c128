"""Frames laid on the ground: a painted plain and a block, seen by cameras whose pixels are worked out by hand."""

from __future__ import annotations

import math
import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
import rasterio
import shapely

from urbanmap_qgis.aerial.frames.camera import ExteriorOrientation, FrameCamera, frame_rays
from urbanmap_qgis.aerial.frames.frame_images import AerialFrame
from urbanmap_qgis.aerial.orthophotos.frame_shifts import FrameShift
from urbanmap_qgis.aerial.orthophotos.mosaic import MosaicFiles, PixelSelection
from urbanmap_qgis.aerial.orthophotos.orthorectification import (
    ElevationInputs,
    OrthoSettings,
    frame_footprint,
    orthorectify,
)
from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.raster import write_raster
from urbanmap_qgis.progress import Progress

CRS = rasterio.crs.CRS.from_epsg(6677).to_wkt()
CAMERA = FrameCamera(30.0, 0.02, 360, 300, (0.1, -0.05))
GROUND = Grid(-60.0, 60.0, 0.5, 240, 240)
HEIGHT = 5.0
BLOCK = (-8.0, -8.0, 8.0, 8.0)
TOP = 30.0


def lay(frames, camera, ground, output, count=None, surface=None, outlines=(), heights=None, **more):
    """Orthorectify with places given one by one."""
    place = ElevationInputs(ground, surface, outlines, heights)
    return orthorectify(frames, camera, place, MosaicFiles(output, count), **more)


def paint(x, y):
    """Brightness of the plain, smooth enough to be sampled: 60 to 200."""
    return 130 + 35 * np.sin(x / 1.7) + 35 * np.cos(y / 2.3)


def photograph(pose, block=True, gain=1.0, light=250.0):
    """What the camera takes of plain and block, (rows, columns, 3) uint8."""
    direction = frame_rays(CAMERA, pose, *np.meshgrid(np.arange(CAMERA.width), np.arange(CAMERA.height)))
    near, far = np.full(direction.shape[:2], -np.inf), np.full(direction.shape[:2], np.inf)
    for axis, (low, high) in enumerate(((BLOCK[0], BLOCK[2]), (BLOCK[1], BLOCK[3]), (HEIGHT, TOP))):
        with np.errstate(divide="ignore"):
            ends = np.sort(((low - pose.centre[axis]) / direction[..., axis],
                            (high - pose.centre[axis]) / direction[..., axis]), axis=0)
        near, far = np.maximum(near, ends[0]), np.minimum(far, ends[1])
    reach = (HEIGHT - pose.z) / direction[..., 2]
    value = paint(pose.x + reach * direction[..., 0], pose.y + reach * direction[..., 1]) * gain
    if block:
        value[near < far] = light
    return np.repeat(np.clip(np.rint(value), 0, 255).astype(np.uint8)[..., None], 3, axis=2)


def write_frame(path, image):
    with rasterio.open(path, "w", driver="GTiff", width=image.shape[1], height=image.shape[0], count=image.shape[2],
                       dtype=image.dtype) as target:
        target.write(np.moveaxis(image, -1, 0))
    return path


POSES = (ExteriorOrientation("東.tif", 25.0, 3.0, 305.0, 1.5, -2.0, 10.0),
         ExteriorOrientation("b.tif", -25.0, -4.0, 305.0, -1.0, 1.0, 170.0),
         ExteriorOrientation("c.tif", 2.0, 24.0, 300.0, 0.5, 0.5, -95.0))


@pytest.fixture
def place(tmp_path):
    """Ground and surface rasters, and a function that makes frames."""
    x, y = GROUND.centres()
    block = ((x > BLOCK[0]) & (x < BLOCK[2]))[None, :] & ((y > BLOCK[1]) & (y < BLOCK[3]))[:, None]
    ground, surface = tmp_path / "地盤.tif", tmp_path / "dsm.tif"
    write_raster(ground, np.full(GROUND.shape, HEIGHT, np.float32), GROUND, CRS)
    write_raster(surface, np.where(block, TOP, HEIGHT).astype(np.float32), GROUND, CRS)

    def frames(poses=POSES, **how):
        return [AerialFrame(write_frame(tmp_path / pose.image, photograph(pose, **how)), pose) for pose in poses]
    return ground, surface, frames, tmp_path / "正射.tif"


def read(path):
    with rasterio.open(path) as source:
        values, transform = source.read(), source.transform
        assert source.crs.to_epsg() == 6677
    rows, columns = values.shape[1:]
    x, y = np.meshgrid(transform.c + (np.arange(columns) + 0.5) * transform.a,
                       transform.f - (np.arange(rows) + 0.5) * transform.a)
    return values, x, y


@pytest.mark.parametrize("method", ["nadir", "darkest", "vote"])
def test_ground_is_where_it_is_and_the_block_is_out(place, method):
    ground, surface, frames, output = place
    count = output.with_name("count.tif")
    made = lay(frames(), CAMERA, ground, output, count, surface,
                        settings=OrthoSettings(0.2, PixelSelection(method)))
    values, x, y = read(output)
    seen = (values > 0).all(axis=0)
    wrong = np.abs(values - paint(x, y)).max(axis=0) > 6
    assert wrong[seen].mean() < 0.001
    inside = (np.abs(x) < 7.7) & (np.abs(y) < 7.7)
    assert not seen[inside].any()
    near = (np.abs(x) < 25) & (np.abs(y) < 25) & ~((np.abs(x) < 9) & (np.abs(y) < 9))
    assert seen[near].mean() > 0.97
    counts = read(count)[0][0]
    np.testing.assert_array_equal(counts > 0, seen)
    assert counts.max() == 3 and made.used == 3
    assert made.pixels_seen == seen.sum() and 0.97 < made.share_seen <= 1
    assert made.hidden_area == pytest.approx(made.pixels_hidden * 0.04)


def test_position_to_a_tenth_of_a_pixel(place):
    ground, _, frames, output = place
    lay(frames(block=False), CAMERA, ground, output, settings=OrthoSettings(0.2, PixelSelection("nadir", even=False)))
    values, x, y = read(output)
    seen = (values > 0).all(axis=0)
    error = values[0].astype(float) - paint(x, y)
    # Brightness error = slope times shift: a least-squares shift over all pixels.
    slopes = np.stack((35 / 1.7 * np.cos(x / 1.7), -35 / 2.3 * np.sin(y / 2.3)))[:, seen]
    shift, *_ = np.linalg.lstsq(slopes.T, error[seen], rcond=None)
    assert np.abs(shift).max() < 0.02


@pytest.mark.slow
def test_hidden_ground_comes_from_another_frame(place):
    ground, surface, frames, output = place
    def seen_behind_the_block(poses):
        made = lay(frames(poses), CAMERA, ground, output, surface=surface, settings=OrthoSettings(0.2))
        values, x, y = read(output)
        return made, (values[0] > 0)[(x > -9.4) & (x < -8.7) & (np.abs(y) < 6)].mean()
    east = ExteriorOrientation("d.tif", 18.0, 0.0, 305.0, 0.0, 0.0, 0.0)
    one, share = seen_behind_the_block([east])
    assert share < 0.1 and one.hidden_area > 8
    assert seen_behind_the_block([east, *POSES])[1] > 0.95


def test_exposure_is_evened(place):
    ground, surface, frames, output = place
    pair = [*frames(POSES[:1]), *frames(POSES[1:2], gain=0.8)]
    lay(pair, CAMERA, ground, output, surface=surface, settings=OrthoSettings(0.2, PixelSelection("nadir")))
    values, x, y = read(output)
    seen = (values[0] > 0) & ~((np.abs(x) < 10) & (np.abs(y) < 10))
    ratio = values[0][seen] / paint(x, y)[seen]
    assert ratio.mean() == pytest.approx(math.sqrt(0.8), abs=0.02)
    assert ratio.std() < 0.03


def test_outlines_mask_buildings_without_a_surface(place):
    ground, _, frames, output = place
    warnings = []
    lay(frames(), CAMERA, ground, output, outlines=[shapely.box(*BLOCK), None],
                 settings=OrthoSettings(0.25), progress=Progress(warn=warnings.append))
    values, x, y = read(output)
    assert not values[:, (np.abs(x) < 7.8) & (np.abs(y) < 7.8)].any()
    assert "DSM" in warnings[0]


@pytest.mark.slow
def test_own_resolution_and_same_output_twice(place):
    ground, surface, frames, output = place
    made = lay(frames(), CAMERA, ground, output, surface=surface)
    assert made.grid.cell == 0.2
    first = output.read_bytes()
    lay(frames(), CAMERA, ground, output, surface=surface)
    assert output.read_bytes() == first


def test_frames_elsewhere(place):
    ground, surface, frames, output = place
    far = ExteriorOrientation("far.tif", 5000.0, 0.0, 305.0, 0.0, 0.0, 0.0)
    with pytest.raises(InsufficientDataError, match="same place"):
        lay(frames([far]), CAMERA, ground, output, surface=surface)
    warnings = []
    lay(frames([POSES[0], far]), CAMERA, ground, output, surface=surface,
                 progress=Progress(warn=warnings.append))
    assert any("far.tif" in sentence for sentence in warnings)
    assert sorted(os.listdir(output.parent)) == sorted(["far.tif", "東.tif", "地盤.tif", "dsm.tif", "正射.tif"])


def test_frames_of_two_kinds(place):
    ground, _, frames, output = place
    pair = frames(POSES[:2])
    write_frame(pair[1].path, photograph(POSES[1])[..., :1])
    with pytest.raises(InputError, match="one kind"):
        lay(pair, CAMERA, ground, output)
    assert not output.exists()


def test_grey_16_bit(place):
    ground, _, frames, output = place
    given = frames(POSES[:1], block=False)
    write_frame(given[0].path, photograph(POSES[0], block=False)[..., :1].astype(np.uint16) * 100)
    lay(given, CAMERA, ground, output, settings=OrthoSettings(0.2))
    values, x, y = read(output)
    assert values.dtype == np.uint16 and len(values) == 1
    assert np.abs(values[0][values[0] > 0] / 100 - paint(x, y)[values[0] > 0]).max() < 6


def test_footprint_of_a_level_frame():
    camera = FrameCamera(50.0, 0.01, 1000, 800)
    box = frame_footprint(camera, ExteriorOrientation("a", 100.0, 200.0, 510.0, 0.0, 0.0, 0.0), 10.0, 10.0)
    assert box == pytest.approx((50.0, 160.0, 150.0, 240.0))
    assert frame_footprint(camera, ExteriorOrientation("a", 0.0, 0.0, 500.0, 180.0, 0.0, 0.0), 0.0, 0.0) is None


def test_a_displaced_frame_is_told(place, monkeypatch):
    ground, _, frames, output = place
    shift = FrameShift("東.tif", "b.tif", np.zeros((9, 2)), np.tile((0.3, -0.4), (9, 1)))
    monkeypatch.setattr("urbanmap_qgis.aerial.orthophotos.orthorectification.frame_shifts", lambda *_: [shift])
    warnings, shifts = [], []
    lay(frames(), CAMERA, ground, output, settings=OrthoSettings(0.2), shifts=shifts,
                 progress=Progress(warn=warnings.append))
    assert shifts == [shift] and "東.tif and b.tif lie 0.50 m apart" in warnings[-1]


def pool(kind):
    if kind == "threads":
        return ThreadPoolExecutor(2)
    return ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"))


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["threads", "processes"])
def test_workers_make_the_same_files(place, tmp_path, monkeypatch, kind):
    monkeypatch.setattr("urbanmap_qgis.aerial.orthophotos.mosaic.tiles.__defaults__", (200,))
    ground, surface, frames, output = place
    given = frames(light=150.0)
    made = [lay(given, CAMERA, ground, output, tmp_path / "count.tif", surface, [shapely.box(20, 20, 25, 25)],
                settings=OrthoSettings(0.2))]
    files = output.read_bytes(), (tmp_path / "count.tif").read_bytes()
    with pool(kind) as executor:
        made.append(lay(given, CAMERA, ground, output, tmp_path / "count.tif", surface,
                        [shapely.box(20, 20, 25, 25)], settings=OrthoSettings(0.2), executor=executor))
    assert files == (output.read_bytes(), (tmp_path / "count.tif").read_bytes())
    assert (made[0].pixels_seen, made[0].pixels_hidden) == (made[1].pixels_seen, made[1].pixels_hidden)


def test_an_outline_with_a_height_hides_what_the_surface_hides(place):
    """Without the surface, the block's outline and height give the same holes; without its height they do not."""
    ground, surface, frames, output = place
    given, settings = frames(POSES[:1]), OrthoSettings(0.2)
    by_surface = lay(given, CAMERA, ground, output, surface=surface, settings=settings)
    holes = read(output)[0][0] == 0
    outline = [None, shapely.box(*BLOCK)]
    by_outline = lay(given, CAMERA, ground, output, outlines=outline, heights=[None, TOP - HEIGHT], settings=settings)
    again = read(output)[0][0] == 0
    assert (holes != again).mean() < 0.002
    assert by_outline.hidden_area == pytest.approx(by_surface.hidden_area, rel=0.2)
    without = lay(given, CAMERA, ground, output, outlines=outline, settings=settings)
    assert without.hidden_area < by_outline.hidden_area - 10


@pytest.mark.parametrize("how", ["black", "alpha"])
def test_borders_of_a_frame_are_not_ground(place, how):
    ground, _, frames, output = place
    given = frames(POSES[:1], block=False)
    image = photograph(POSES[0], block=False)
    whole = lay(given, CAMERA, ground, output, settings=OrthoSettings(0.2)).pixels_seen
    cut = np.ones(image.shape[:2], bool)
    cut[6:-25, 40:] = False
    image[cut] = 0 if how == "black" else 90
    if how == "alpha":
        image = np.concatenate((image, np.where(cut, 0, 255).astype(np.uint8)[..., None]), axis=-1)
    write_frame(given[0].path, image)
    made = lay(given, CAMERA, ground, output, settings=OrthoSettings(0.2, PixelSelection("nadir", even=False)))
    assert made.pixels_seen / whole == pytest.approx((~cut).mean(), abs=0.05)
    values, x, y = read(output)
    assert np.abs(values[0][values[0] > 0] - paint(x, y)[values[0] > 0]).max() < 6
