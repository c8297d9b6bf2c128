"""The paper's way from frames to road markings (J 3.2.1, 3.2.2) against formulas of a few lines."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
import rasterio
import shapely
from rasterio.transform import Affine

from urbanmap_qgis.aerial.frames.camera import ExteriorOrientation, FrameCamera
from urbanmap_qgis.aerial.frames.frame_images import AerialFrame
from urbanmap_qgis.aerial.frames.normalised_surface import NormalisedSurface
from urbanmap_qgis.aerial.frames.occlusion import PAPER_OCCLUSION, occlusion_mask
from urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto
from urbanmap_qgis.aerial.markings.orthophoto_reader import SearchArea
from urbanmap_qgis.aerial.markings.road_markings import PAPER_MARKINGS, MarkingSettings
from urbanmap_qgis.aerial.orthophotos.mosaic import MosaicFiles, PixelSelection
from urbanmap_qgis.aerial.orthophotos.orthorectification import ElevationInputs, OrthoSettings, orthorectify
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.raster import write_raster

CRS = rasterio.crs.CRS.from_epsg(6677)
CAMERA = FrameCamera(30.0, 0.02, 160, 140, (0.1, -0.05))
SURFACE = Grid(-30.0, 30.0, 1.0, 60, 60)
POSE = ExteriorOrientation("a.tif", 4.0, -3.0, 305.0, 1.0, -0.5, 25.0)


def write_image(path, bands, transform=None):
    with rasterio.open(path, "w", driver="GTiff", width=bands.shape[2], height=bands.shape[1], count=len(bands),
                       dtype="uint8", transform=transform, crs=CRS if transform else None) as target:
        target.write(bands)
    return path


def street(rows=384, columns=512):
    """Whole tiles of 128 pixels, so that all pixels enter the levels."""
    rng = np.random.default_rng(4)
    image = np.full((rows, columns, 3), 90.0) + rng.normal(0, 8, (rows, columns, 1))
    image[:, 300:] *= 0.4
    image[100:104] = (220, 220, 215)
    image[200:204, 20:] = (220, 170, 60)
    return np.clip(np.moveaxis(image + rng.normal(0, 3, image.shape), 2, 0), 0, 255).astype(np.uint8)


@pytest.mark.paper("J 3.2.2")
@pytest.mark.parametrize("tile", [150, 2048])
def test_markings_are_the_plain_adaptive_threshold(tmp_path, tile):
    bands = street()
    path = write_image(tmp_path / "o.tif", bands, Affine(0.12, 0, 0, 0, -0.12, 0))
    found = markings_from_orthophoto(path, tmp_path / "m.tif", settings=PAPER_MARKINGS, tile=tile)
    grey = cv2.cvtColor(np.moveaxis(bands, 0, -1).astype(np.float32), cv2.COLOR_RGB2GRAY)
    low, high = np.percentile(grey, (0.5, 99.5))
    levelled = np.clip(np.rint((grey - low) / (high - low) * 255), 0, 255).astype(np.uint8)
    expected = cv2.adaptiveThreshold(levelled, 255, cv2.ADAPTIVE_THRESH_GAUSSIAN_C, cv2.THRESH_BINARY, 21, -17)
    with rasterio.open(tmp_path / "m.tif") as source:
        mask = source.read(1)
    assert expected.any() and (mask == expected).all()
    assert found.marked_area == pytest.approx((expected > 0).sum() * 0.12**2)


def test_hidden_ground_has_no_markings_and_leaves_no_rim(tmp_path):
    bands = np.full((3, 200, 200), 120, np.uint8)
    bands[:, :, 100:] = 0
    bands[:, 50:53, :90] = 230
    path = write_image(tmp_path / "o.tif", bands, Affine(0.12, 0, 0, 0, -0.12, 0))
    hidden = SearchArea(buildings=[shapely.box(12.0, -24.0, 24.0, 0.0)])
    markings_from_orthophoto(path, tmp_path / "m.tif", hidden, settings=PAPER_MARKINGS)
    with rasterio.open(tmp_path / "m.tif") as source:
        rows, columns = np.nonzero(source.read(1))
    assert set(rows) == {50, 51, 52} and columns.max() < 93


def test_the_paper_is_not_cleaned():
    with pytest.raises(ValueError, match="not cleaned"):
        MarkingSettings(paper=True)


def image_places(pose, points):
    """Columns and rows by J eq. 1 to 3, written out."""
    (so, sp, sk), (co, cp, ck) = (f(np.radians([pose.omega, pose.phi, pose.kappa])) for f in (np.sin, np.cos))
    rotation = (np.array([[1, 0, 0], [0, co, so], [0, -so, co]]) @ np.array([[cp, 0, -sp], [0, 1, 0], [sp, 0, cp]])
                @ np.array([[ck, sk, 0], [-sk, ck, 0], [0, 0, 1]]))
    d = (points - [pose.x, pose.y, pose.z]) @ rotation.T
    x, y = 0.1 - 30.0 * d[..., 0] / d[..., 2], -0.05 - 30.0 * d[..., 1] / d[..., 2]
    return (CAMERA.width - 1) / 2 + x / 0.02, (CAMERA.height - 1) / 2 - y / 0.02


def town(folder):
    """Two blocks on level ground, one lower than the threshold."""
    x, y = np.meshgrid(*SURFACE.centres())
    z = 22.0 * ((abs(x + 6) < 5) & (abs(y) < 7)) + 4.0 * ((abs(x - 8) < 5) & (abs(y) < 7))
    write_raster(folder / "surface.tif", z.astype(np.float32), SURFACE, CRS.to_wkt())
    write_raster(folder / "ground.tif", np.zeros(SURFACE.shape, np.float32), SURFACE, CRS.to_wkt())
    return x, y, z, folder / "surface.tif", folder / "ground.tif"


@pytest.mark.paper("J 3.2.1.1, POM")
def test_occlusion_map_fills_the_triangles_off_the_ground(tmp_path):
    x, y, z, surface, ground = town(tmp_path)
    with NormalisedSurface(surface, ground) as heights:
        found = occlusion_mask(CAMERA, POSE, heights, PAPER_OCCLUSION)
    column, row = image_places(POSE, np.stack([x, y, z], axis=-1))
    expected = np.zeros(found.shape, bool)
    columns, rows = np.meshgrid(np.arange(CAMERA.width), np.arange(CAMERA.height))
    for i, j in np.argwhere(np.ones((59, 59), bool)):
        nw, ne, sw, se = (i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1)
        falling = abs(z[nw] - z[se]) <= abs(z[ne] - z[sw])
        for triangle in ((nw, sw, se), (nw, se, ne)) if falling else ((nw, sw, ne), (sw, se, ne)):
            if max(z[vertex] for vertex in triangle) > 5.0:
                a, b, c = (np.array([column[vertex], row[vertex]]) for vertex in triangle)
                sides = [(q[0] - p[0]) * (rows - p[1]) - (q[1] - p[1]) * (columns - p[0])
                         for p, q in ((a, b), (b, c), (c, a))]
                expected |= np.all([side < 0 for side in sides], axis=0)
    assert expected.sum() > 300 and (found != expected).sum() <= 2  # centres on a side


@pytest.mark.paper("J 3.2.1.2")
def test_frames_are_masked_and_the_darkest_is_taken(tmp_path):
    """Two frames of one brightness each: the darker wins where its map does not mask it."""
    x, y, _, surface, ground = town(tmp_path)
    poses = (POSE, ExteriorOrientation("b.tif", -6.0, 5.0, 305.0, 0.0, 0.0, 80.0))
    masks = [np.zeros((CAMERA.height, CAMERA.width), bool) for _ in poses]
    masks[0][40:90, 30:80], masks[1][:, :75] = True, True
    frames, paths = [], []
    for pose, mask, light in zip(poses, masks, (80, 140)):
        image = np.full((3, CAMERA.height, CAMERA.width), light, np.uint8)
        frames.append(AerialFrame(write_image(tmp_path / pose.image, image), pose))
        paths.append(write_image(tmp_path / f"mask_{pose.image}", mask[None] * np.uint8(255)))
    place = ElevationInputs(ground, surface, [shapely.box(20, 20, 25, 25)], masks=paths)
    settings = OrthoSettings(1.0, PixelSelection.of("paper", True))
    made = orthorectify(frames, CAMERA, place, MosaicFiles(tmp_path / "mosaic.tif"), settings)
    x, y = np.meshgrid(*made.grid.centres())
    expected = np.full(x.shape, 255)
    for pose, mask, light in zip(poses, masks, (80, 140)):
        column, row = image_places(pose, np.stack([x, y, np.zeros_like(x)], axis=-1))
        inside = (column >= 0) & (column <= CAMERA.width - 1) & (row >= 0) & (row <= CAMERA.height - 1)
        column, row = (np.where(inside, np.rint(value), 0).astype(int) for value in (column, row))
        expected = np.where(inside & ~mask[row, column], np.minimum(expected, light), expected)
    expected[(expected == 255) | ((x > 20) & (x < 25) & (y > 20) & (y < 25))] = 0
    with rasterio.open(tmp_path / "mosaic.tif") as source:
        assert (source.read(1) == expected).mean() > 0.998


def test_maps_made_for_the_frames_hide_what_leans(tmp_path):
    """Masked by the maps that the frames get on the way, no roof is left in the mosaic."""
    x, y, z, surface, ground = town(tmp_path)
    column, row = image_places(POSE, np.stack([x, y, z], axis=-1))
    image = np.full((CAMERA.height, CAMERA.width), 80, np.uint8)
    roof = cv2.erode((z > 5).astype(np.uint8), np.ones((3, 3))) > 0
    image[np.rint(row[roof]).astype(int), np.rint(column[roof]).astype(int)] = 250
    frames = [AerialFrame(write_image(tmp_path / "a.tif", np.stack([image] * 3)), POSE)]
    out = MosaicFiles(tmp_path / "mosaic.tif")
    made = orthorectify(frames, CAMERA, ElevationInputs(ground, surface), out,
                        OrthoSettings(0.2, PixelSelection.of("paper", False), occlusion=PAPER_OCCLUSION))
    with rasterio.open(out.image) as source:
        values = source.read(1)
    assert values.max() < 120 and 0 < made.hidden_area < 800
    with pytest.raises(InputError, match=r"surface \(DSM\)"):
        orthorectify(frames, CAMERA, ElevationInputs(ground), out, OrthoSettings(0.2, occlusion=PAPER_OCCLUSION))
