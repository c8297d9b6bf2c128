"""Occlusion maps against the truth of the simulated city; poses and cameras of real oblique frames."""

from __future__ import annotations

import warnings
from pathlib import Path

import cv2
import numpy as np
import pytest
import rasterio
from rasterio.errors import NotGeoreferencedWarning
from scipy.ndimage import map_coordinates

from urbanmap_qgis.aerial.frames.camera import frame_rays, project_to_frame, read_camera
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.aerial.frames.frame_images import FrameImage, find_frames
from urbanmap_qgis.aerial.frames.normalised_surface import NormalisedSurface
from urbanmap_qgis.aerial.frames.occlusion import occlusion_mask
from urbanmap_qgis.geometry.sampling import sample
from urbanmap_qgis.io.raster import read_raster
from urbanmap_qgis.settings.terrain import SurfaceSettings
from urbanmap_qgis.terrain.surface_files import surfaces_from_files

DATA = Path(__file__).resolve().parents[2].parent / "shared" / "data"
CITY, ODM = DATA / "city", DATA / "aerial" / "odm"
BUILDING, VEGETATION = 255, 128
HIGHEST = 110.0
PATCH, STEP, SEARCH = 12.0, 0.25, 6


@pytest.fixture(scope="module")
def heights(tmp_path_factory):
    if not CITY.is_dir():
        pytest.skip("needs the simulated city in ../shared/data/city")
    folder = tmp_path_factory.mktemp("heights")
    paths = folder / "dsm.tif", folder / "ground.tif"
    surfaces_from_files([CITY / "als" / "als_classified.laz"], *paths, None, SurfaceSettings(0.5))
    return paths


def looks_at(camera, pose, bounds, level):
    """Pixels (rows, columns) that see nothing outside the bounds between 3 m below the level and the highest roof."""
    column, row = np.meshgrid(np.arange(0, camera.width, 4), np.arange(0, camera.height, 4))
    ray = frame_rays(camera, pose, column, row)
    seen = np.ones(column.shape, bool)
    for height in (level - 3, level + HIGHEST):
        distance = (height - pose.z) / ray[..., 2]
        x, y = pose.x + distance * ray[..., 0], pose.y + distance * ray[..., 1]
        seen &= (x > bounds[0] + 3) & (x < bounds[2] - 3) & (y > bounds[1] + 3) & (y < bounds[3] - 3)
    return np.kron(seen, np.ones((4, 4), bool))[:camera.height, :camera.width]


@pytest.mark.parametrize("number", [0, 4])
def test_mask_against_the_truth(heights, number):
    """IoU of what shows buildings or hides behind them; trees, which are as high but no buildings, left out."""
    camera, pose = read_camera(CITY / "aerial" / "camera.json"), read_exterior(CITY / "aerial" / "exterior.csv")[number]
    with NormalisedSurface(*heights) as surface:
        mask = occlusion_mask(camera, pose, surface)
        level = float(np.nanmedian(surface.ground.read(slice(0, 200), slice(0, 200))))
        seen = looks_at(camera, pose, surface.grid.bounds, level)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NotGeoreferencedWarning)
        with rasterio.open(CITY / "truth" / "occlusion" / pose.image) as source:
            truth = source.read(1)
    counted = seen & (truth != VEGETATION)
    building = truth == BUILDING
    assert counted.mean() > 0.4
    assert (mask & building & counted).sum() / ((mask | building) & counted).sum() > 0.97


def test_real_frames_agree_on_the_ground():
    """Patches of the surface seen by two frames: the clear ones match where the poses say, to one step of 0.25 m."""
    if not ODM.is_dir():
        pytest.skip("needs the drone frames in ../shared/data/aerial/odm")
    camera = read_camera(ODM / "camera.json")
    frames = find_frames([ODM], read_exterior(ODM / "exterior.csv"))
    dsm, grid, _ = read_raster(ODM / "dsm.tif")
    shifts = []
    for first, second in ((0, 1), (0, 2)):
        shifts += patch_shifts(camera, (frames[first], frames[second]), grid, dsm)
    assert len(shifts) >= 15
    assert np.median(np.abs(shifts)) == 0 and np.percentile(np.hypot(*np.transpose(shifts)) * STEP, 90) <= STEP


def patch_shifts(camera, frames, grid, dsm):
    """Shifts, in steps, of the best match of each clear patch between two frames."""
    images = []
    for frame in frames:
        with FrameImage(frame.path, camera) as image:
            images.append(image.read()[:3].mean(axis=0))
    shifts = []
    left, bottom, right, top = grid.bounds
    for x0 in np.arange(left + 20, right - 40, 9):
        for y0 in np.arange(bottom + 20, top - 40, 9):
            patches = [patch_of(camera, frame.pose, image, grid, dsm, x0, y0) for frame, image in zip(frames, images)]
            if any(patch is None for patch in patches):
                continue
            inner = patches[1][SEARCH:-SEARCH, SEARCH:-SEARCH]
            score = cv2.matchTemplate(patches[0], inner, cv2.TM_CCOEFF_NORMED)
            if score.max() > 0.8 and inner.std() > 12:
                shifts.append(np.array(np.unravel_index(score.argmax(), score.shape)) - SEARCH)
    return shifts


def patch_of(camera, pose, image, grid, dsm, x0, y0):
    """Grey values of a frame on the surface round a place, None where the frame does not show all of it."""
    steps = np.arange(-SEARCH * STEP, PATCH + SEARCH * STEP, STEP)
    x, y = np.meshgrid(x0 + steps, y0 + steps)
    z = sample(grid, dsm, x.ravel(), y.ravel())
    column, row, in_front = project_to_frame(camera, pose, np.stack([x.ravel(), y.ravel(), z], axis=-1))
    inside = in_front & (column >= 0) & (row >= 0) & (column <= camera.width - 1) & (row <= camera.height - 1)
    if not inside.all():
        return None
    return map_coordinates(image, [row, column], order=1).reshape(x.shape).astype(np.float32)
