"""Pictures of the sample city's data: frame, orthophoto, laser points, mobile survey, line image.

Points are drawn by numpy without a screen: in parallel projection, the nearest last, with shading by depth that makes
edges stand out.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import cv2
import laspy
import numpy as np
import shapely
from osgeo import gdal

from scripts.demo.checks import reported_errors
from scripts.layers import read_layer

gdal.UseExceptions()

SKY, NIGHT = (245, 237, 228), (38, 30, 24)  # colours are blue, green, red, as OpenCV has them
AROUND = 42.0
"""Of the mobile survey this much around its middle is drawn, m."""
CLASS_COLOURS = {1: (150, 150, 150), 2: (120, 160, 190), 5: (70, 150, 60), 6: (70, 90, 200)}
CLASS_NAMES = "ground tan, buildings red, trees green, vehicles and furniture grey"


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
    cloud = laspy.read(city / "als/als_classified.laz")
    xyz = np.column_stack([cloud.x, cloud.y, cloud.z])
    near = np.asarray(cloud.classification) != 7
    yield ("als_height.jpg", draw_points(xyz[near], height_colours(xyz[near, 2]), dot=6),
           "Airborne laser points by height, seen from the south-west; outliers left out.")
    classes = np.asarray(cloud.classification)
    colours = np.zeros((256, 3), np.uint8)
    colours[list(CLASS_COLOURS)] = list(CLASS_COLOURS.values())
    yield ("als_class.jpg", draw_points(xyz[near], colours[classes[near]], dot=6),
           f"The same by class, as in als_classified.laz: {CLASS_NAMES}.")
    xyz, intensity = read_survey(city / "mms/survey_01.laz")
    close = np.abs(xyz[:, :2] - np.median(xyz[:, :2], axis=0)).max(axis=1) < AROUND
    yield ("mobile.jpg", draw_points(xyz[close], grey(intensity[close]), dot=2, azimuth=20.0, back=NIGHT),
           "Mobile survey 1 by intensity: walls as far up as the scanners see, paint and pavements on the ground.")
    yield ("mobile_markings.jpg", markings_picture(city, xyz, intensity),
           "Mobile survey 1 from above by intensity, placed with its reported trajectory; the true outlines of the "
           f"markings in orange lie {reported_errors(city, 1).mean():.1f} m off in the mean: that is what the "
           "registration of later stages has to find.")
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


def read_survey(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) and intensities (n,) of a mobile survey's points."""
    cloud = laspy.read(path)
    return np.column_stack([cloud.x, cloud.y, cloud.z]), np.asarray(cloud.intensity, float)


def height_colours(z: np.ndarray) -> np.ndarray:
    """Colours (n, 3) from the lowest to the highest."""
    low, high = np.percentile(z, [1, 99.5])
    levels = np.uint8(255 * np.clip((z - low) / (high - low), 0, 1) ** 0.6)
    return cv2.applyColorMap(levels.reshape(-1, 1), cv2.COLORMAP_TURBO).reshape(-1, 3)


def grey(values: np.ndarray) -> np.ndarray:
    """Grey levels (n, 3) of intensities, by their logarithm."""
    values = np.log(np.maximum(values, 1.0))
    low, high = np.percentile(values, [1, 99])
    return np.repeat(np.uint8(30 + 225 * np.clip((values - low) / (high - low), 0, 1))[:, None], 3, axis=1)


def draw_points(xyz: np.ndarray, colours: np.ndarray, *, dot: int, width: int = 1100, azimuth: float = 35.0,
                pitch: float = 50.0, back: tuple[int, int, int] = SKY) -> np.ndarray:
    """Points in parallel projection, drawn at twice the size and scaled down.

    `azimuth` : view direction clockwise from north, degrees.  `pitch` : 90 looks straight down.  `dot` : pixels.
    """
    turn, down = np.radians([azimuth, pitch])
    ahead = np.array([np.sin(turn) * np.cos(down), np.cos(turn) * np.cos(down), -np.sin(down)])
    right = np.array([np.cos(turn), -np.sin(turn), 0.0])
    places = (xyz - xyz.mean(axis=0)) @ np.column_stack([right, np.cross(right, ahead), ahead])
    low, high = places[:, :2].min(axis=0), places[:, :2].max(axis=0)
    scale = 2 * width / (high - low)[0]
    size = np.ceil((high - low) * scale).astype(int)[::-1] + dot
    column, row = ((places[:, 0] - low[0]) * scale).astype(int), ((high[1] - places[:, 1]) * scale).astype(int)
    order = np.argsort(-places[:, 2], kind="stable")
    nearest = np.full(size, -1)
    for shift in np.ndindex(dot, dot):
        layer = np.full(size, -1)
        layer[row[order] + shift[0], column[order] + shift[1]] = order  # of equal pixels numpy keeps the last
        over = (layer >= 0) & ((nearest < 0) | (places[layer, 2] < places[nearest, 2]))
        nearest[over] = layer[over]
    seen = nearest >= 0
    depth = np.where(seen, places[nearest, 2], places[:, 2].max())
    picture = np.where(seen[..., None], colours[nearest] * edge_shade(depth)[..., None], back)
    return cv2.resize(picture.astype(np.uint8), None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)


def edge_shade(depth: np.ndarray, reach: int = 3, strength: float = 0.12) -> np.ndarray:
    """Shade 0.35 to 1 of pixels: the darker, the more (m) the neighbourhood lies in front of them."""
    depth = cv2.medianBlur(depth.astype(np.float32), 3)
    before = [np.maximum(0.0, depth - np.roll(depth, shift, axis=axis)) for axis in (0, 1) for shift in (-reach, reach)]
    return np.maximum(0.35, np.exp(-strength * np.minimum(np.sum(before, axis=0), 20.0)))


def markings_picture(city: Path, xyz: np.ndarray, intensity: np.ndarray, cell: float = 0.04,
                     reach: tuple[float, float] = (22.0, 16.0)) -> np.ndarray:
    """The ground of the survey around the crossing from above, with the true outlines of markings."""
    plans, (private,) = read_layer(city / "truth/markings.gpkg", "private", layer="mms")
    plans = [plan for plan, own in zip(plans, private) if not own]
    x0, y0 = np.median(xyz[:, :2], axis=0)
    columns, rows = (int(2 * length / cell) for length in reach)

    def pixels(places: np.ndarray) -> np.ndarray:
        return np.column_stack([(places[:, 0] - x0 + reach[0]) / cell, (y0 + reach[1] - places[:, 1]) / cell])

    low = xyz[:, 2] < np.percentile(xyz[:, 2], 2) + 2.5
    column, row = pixels(xyz[low]).astype(int).T
    inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    count, total = (np.zeros(rows * columns) for _ in range(2))
    index = row[inside] * columns + column[inside]
    np.add.at(count, index, 1.0)
    np.add.at(total, index, grey(intensity[low])[inside, 0])
    picture = np.divide(total, count, out=np.zeros_like(total), where=count > 0).reshape(rows, columns)
    picture = np.where(count.reshape(rows, columns) > 0, picture, cv2.dilate(picture, np.ones((3, 3))))
    picture = cv2.cvtColor(picture.astype(np.uint8), cv2.COLOR_GRAY2BGR)
    for plan in shapely.get_parts(shapely.force_2d(plans)):
        ring = np.round(pixels(shapely.get_coordinates(plan.exterior)) * 16).astype(np.int32)
        cv2.polylines(picture, [ring], True, (40, 140, 255), 2, cv2.LINE_AA, shift=4)
    return picture
