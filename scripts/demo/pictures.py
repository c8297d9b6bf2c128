"""Pictures of the sample city's images and of what was made of them: frame, orthophoto, survey over it, line image."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import cv2
import laspy
import numpy as np
from osgeo import gdal

gdal.UseExceptions()

def make_pictures(folder: Path) -> Iterator[tuple[Path, str]]:
    """Draw all pictures into `folder`/pictures; file and caption of each."""
    city, target = folder / "city", folder / "pictures"
    target.mkdir(exist_ok=True)
    for name, picture, caption in (*_pictures(city), *_results(folder)):
        path = target / name
        _, data = cv2.imencode(path.suffix, picture, [cv2.IMWRITE_JPEG_QUALITY, 88])
        path.write_bytes(data.tobytes())
        yield path, caption


def _results(folder: Path) -> Iterator[tuple[str, np.ndarray, str]]:
    picture = read_image(folder / "orthophoto.tif")
    picture[gdal.Open(str(folder / "markings.tif")).ReadAsArray() == 255] = (255, 0, 255)
    yield ("markings.jpg", middle(picture, 1200, 900), "Made by UrbanMap from the frames: the orthophoto of the ground "
           "that they see, without buildings and moving vehicles; found road markings in magenta.")


    yield ("survey.jpg", _survey_over_ground(folder), "Bright laser points of the mobile survey over the orthophoto: "
           "as delivered (red, left) and after the registration to the road markings (green, right).")
    texture = max((folder / "textured/textures").glob("*.jpg"), key=lambda path: path.stat().st_size)
    yield ("texture.jpg", _shrunk(read_image(texture), 900), "Textures of a building's facades from the strip image of "
           "the line camera; grey is what no image shows, such as what trees hide.")


def _survey_over_ground(folder: Path, side: int = 500) -> np.ndarray:
    """Two pictures side by side: the points of most intensity before and after, round the middle of the drive."""
    source = gdal.Open(str(folder / "orthophoto.tif"))
    west, cell, _, north, _, _ = source.GetGeoTransform()
    ground = read_image(folder / "orthophoto.tif")
    panels, centre = [], None
    for path, colour in ((folder / "city/mms/survey_01.laz", (0, 0, 255)), (folder / "survey_01.laz", (0, 220, 0))):
        cloud = laspy.read(path)
        bright = np.asarray(cloud.intensity) > np.percentile(cloud.intensity, 98.5)
        column = ((np.asarray(cloud.x)[bright] - west) / cell).astype(int)
        row = ((north - np.asarray(cloud.y)[bright]) / cell).astype(int)
        if centre is None:
            height, width = ground.shape[:2]
            centre = (int(np.clip(np.median(row), side / 2, height - side / 2)),
                      int(np.clip(np.median(column), side / 2, width - side / 2)))
        top, left = centre[0] - side // 2, centre[1] - side // 2
        panel = ground[top:top + side, left:left + side].copy()
        inside = (row >= top) & (row < top + side) & (column >= left) & (column < left + side)
        panel[row[inside] - top, column[inside] - left] = colour
        panels.append(panel)
    return np.hstack(panels)


def _shrunk(picture: np.ndarray, side: int) -> np.ndarray:
    factor = min(1.0, side / max(picture.shape[:2]))
    return cv2.resize(picture, None, fx=factor, fy=factor, interpolation=cv2.INTER_AREA)


def _pictures(city: Path) -> Iterator[tuple[str, np.ndarray, str]]:
    yield ("frame.jpg", middle(read_image(city / "aerial/frame_02.tif"), 1200, 900),
           "Part of an aerial frame, 12 cm a pixel: perspective, so that buildings lean outwards and hide the street.")
    ortho = read_image(city / "aerial/ortho.tif")
    yield ("orthophoto.jpg", cv2.resize(ortho, None, fx=0.7, fy=0.7, interpolation=cv2.INTER_AREA),
           "The conventional orthophoto: right on the ground, while roofs lie where the frames saw them.")
    yield ("line_camera.jpg", cv2.imdecode(np.fromfile(city / "lines/camera_1.png", np.uint8), cv2.IMREAD_COLOR),
           "Image of the line camera: a column is a moment, a row an angle. Things are drawn out where the vehicle "
           "drives slowly, and bend where it turns.")


def read_image(path: Path) -> np.ndarray:
    """Rows, columns, three colours."""
    return np.ascontiguousarray(np.moveaxis(gdal.Open(str(path)).ReadAsArray(), 0, -1)[..., 2::-1])


def middle(picture: np.ndarray, width: int, height: int) -> np.ndarray:
    """The middle part of a picture."""
    top, left = (max(0, (size - wanted) // 2) for size, wanted in zip(picture.shape, (height, width)))
    return picture[top:top + height, left:left + width]
