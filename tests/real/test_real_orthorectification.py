"""Real drone frames laid on their surface: do two frames put the same thing in the same place?"""

from __future__ import annotations

from itertools import combinations

import cv2
import numpy as np
import pytest

from urbanmap_qgis.aerial.frames.camera import read_camera
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.aerial.frames.frame_images import find_frames
from urbanmap_qgis.aerial.orthophotos.mosaic import MosaicFiles, PixelSelection
from urbanmap_qgis.aerial.orthophotos.orthorectification import (
    ElevationInputs,
    FramePixels,
    OrthorectifiedFrame,
    OrthoSettings,
    Terrain,
    orthorectify,
)
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.raster import RasterSampler, read_raster, write_raster

CELL = 0.15
PATCH, STEP = 80, 60  # pixels


@pytest.fixture(scope="module")
def flight(real_data, tmp_path_factory):
    """Frames, camera and the surface as a north-up raster with square cells."""
    folder = real_data / "aerial" / "odm"
    heights, grid, crs = read_raster(folder / "dsm.tif")
    surface = tmp_path_factory.mktemp("odm") / "dsm.tif"
    write_raster(surface, heights, grid, crs)
    return find_frames([folder], read_exterior(folder / "exterior.csv")), read_camera(folder / "camera.json"), surface


def markings(view):
    """What is brighter than its surroundings and narrow, float32."""
    grey = view.values.mean(axis=-1)
    return cv2.morphologyEx(grey, cv2.MORPH_TOPHAT, np.ones((11, 11), np.uint8))


def shifts(first, second):
    """Shifts in pixels, (n, 2), of patches with markings that both views show."""
    a, b, both = markings(first), markings(second), first.seen & second.seen
    window = cv2.createHanningWindow((PATCH, PATCH), cv2.CV_32F)
    found = []
    for top in range(0, a.shape[0] - PATCH, STEP):
        for left in range(0, a.shape[1] - PATCH, STEP):
            part = slice(top, top + PATCH), slice(left, left + PATCH)
            if not both[part].all() or min((a[part] > 40).mean(), (b[part] > 40).mean()) < 0.01:
                continue
            shift, response = cv2.phaseCorrelate(a[part].copy(), b[part].copy(), window)
            if response > 0.3:
                found.append(shift)
    return np.array(found).reshape(-1, 2)


def test_frames_fall_on_each_other(flight):
    frames, camera, surface = flight
    with RasterSampler(surface) as ground, FramePixels(frames, camera) as pixels:
        terrain = Terrain(ground)
        sources = [OrthorectifiedFrame(frame, pixels, terrain) for frame in frames]
        x_min, y_min, x_max, y_max = ground.grid.bounds
        grid = Grid.covering(x_min + 30, y_min + 30, x_max - 30, y_max - 30, CELL)
        views = [source.view(grid) for source in sources]
    found = [shifts(first, second) for first, second in combinations(views, 2)]
    lengths = np.hypot(*np.concatenate(found).T)
    assert len(lengths) >= 20
    # The frames' own pixels are 0.13 to 0.2 m on the ground.
    assert np.median(lengths) < 0.6 and np.percentile(lengths, 90) < 1.5


def test_mosaic(flight, tmp_path):
    frames, camera, surface = flight
    made = orthorectify(frames, camera, ElevationInputs(surface, surface), MosaicFiles(tmp_path / "mosaic.tif"),
                        settings=OrthoSettings(0.3, PixelSelection("vote")))
    assert made.used == 3 and made.share_seen > 0.6
    assert np.abs(np.log(made.gains.gain)).max() < 0.5
