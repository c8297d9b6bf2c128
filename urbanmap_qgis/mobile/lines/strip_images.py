"""Strip images of line cameras from files: the image, the table of its columns' times, the camera's calibration."""

from __future__ import annotations

import csv
import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import rasterio
from rasterio.errors import NotGeoreferencedWarning, RasterioError
from rasterio.windows import Window

from ...errors import InputError
from ...io.files.guard import reads
from ...io.files.named_table import numbers_of
from ...io.raster import OPENING_ERRORS, own_gdal
from ...wording import say
from ..calibration import Calibration, MountedCamera
from .line_camera import LineCamera, StripImage

TIMES_ENDING = "_times.csv"
"""The table of times of `strip.png` is `strip_times.csv`, where the calibration names no other."""

SUFFIXES = (".png", ".tif", ".tiff", ".jpg", ".jpeg")


def line_camera_of(camera: MountedCamera) -> LineCamera:
    """The line camera of a calibration entry with `rows`, `focal_length_px`, `centre_px` and, if wanted, `margin_px`.

    Raises
    ------
    InputError : one of them is missing or no number.
    """
    entry, values = camera.properties, []
    for key, default in (("rows", None), ("focal_length_px", None), ("centre_px", None), ("margin_px", 0)):
        value = entry.get(key, default)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value):
            raise InputError(say("The calibration of camera {id} has no number “{key}”: a line camera needs rows, "
                                 "focal_length_px and centre_px.", id=camera.id, key=key))
        values.append(value)
    rows, focal, centre, margin = values
    if rows < 1 or focal <= 0 or not 0 <= margin < rows / 2:
        raise InputError(say("The calibration of camera {id} cannot be right: rows and focal_length_px must be "
                             "greater than 0, margin_px less than half the rows.", id=camera.id))
    return LineCamera(camera, int(rows), float(focal), float(centre), int(margin))


def read_strips(images: Sequence[str | os.PathLike], calibration: Calibration) -> list[StripImage]:
    """Strip images of a calibrated vehicle, in the order given; pixels are read later, see `read_columns`.

    An image belongs to the camera whose calibration entry names it under `image`; where none does, to the one whose
    id or name stands in its file name, or to the only camera. Its times are in the file that the entry names under
    `times` or in `<image>_times.csv`, beside the image.

    Raises
    ------
    InputError : there is no image, no table of times or no camera for one, or they do not fit together.
    """
    if not images:
        raise InputError(say("No strip image was given: choose one or several images of line cameras."))
    return [read_strip(path, _camera_of(Path(path), calibration)) for path in images]


def _camera_of(path: Path, calibration: Calibration) -> MountedCamera:
    """The calibration entry of an image."""
    named = [camera for camera in calibration.cameras if str(camera.properties.get("image", "")) == path.name]
    if not named:
        named = [camera for camera in calibration.cameras
                 if path.stem == f"camera_{camera.id}" or path.stem in (camera.id, camera.properties.get("name"))]
    if not named and len(calibration.cameras) == 1 and not calibration.damaged_cameras:
        named = list(calibration.cameras)
    if len(named) != 1 and calibration.damaged_cameras:
        raise InputError(calibration.damaged_cameras[0])
    if len(named) != 1:
        known = ", ".join(camera.id for camera in calibration.cameras) or "none"
        raise InputError(say("The calibration does not say which camera took {path} (it has: {known}): give the "
                             "camera's entry an “image” with this file name.", path=path.name, known=known))
    return named[0]


def read_strip(path: str | os.PathLike, camera: MountedCamera) -> StripImage:
    """One strip image with its times, whose file the calibration names or lies beside.

    Raises
    ------
    InputError : image or times cannot be read, or do not fit each other or the camera.
    """
    path, line_camera = Path(path), line_camera_of(camera)
    rows, columns = image_size(path)
    if rows != line_camera.rows:
        raise InputError(say("{path} has {rows} rows, its camera {id} has {rows_2}: choose the image of this camera.",
                             path=path.name, rows=rows, id=camera.id, rows_2=line_camera.rows))
    named = camera.properties.get("times") if camera.properties.get("image") == path.name else None
    times = path.with_name(str(named) if named else path.stem + TIMES_ENDING)
    return StripImage(line_camera, read_times(times, columns, path.name), path)


def image_size(path: Path) -> tuple[int, int]:
    """Rows and columns of an image file.

    Raises
    ------
    InputError : it is no image.
    """
    with _opened(path) as source:
        return source.height, source.width


def _opened(path: Path):
    """The open image; call it in a `with`."""
    import warnings

    if not path.is_file():
        raise InputError(say("The strip image {path} does not exist: check its name.", path=path))
    try:
        with own_gdal(), warnings.catch_warnings():
            warnings.simplefilter("ignore", NotGeoreferencedWarning)
            return rasterio.open(path)
    except OPENING_ERRORS as error:
        raise InputError(say("{path} cannot be read as an image: check the file.", path=path.name)) from error


@reads("a table of times")
def read_times(path: str | os.PathLike, columns: int, image: str = "the image") -> np.ndarray:
    """Times (columns,) of an image's columns from a table `column,time` (s), in any order.

    Raises
    ------
    InputError : there is no such table, or it does not give every column one time, later than the one before.
    """
    path = Path(path)
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = [{str(key).strip().lower(): value for key, value in row.items()} for row in csv.DictReader(file)]
    except FileNotFoundError:
        raise InputError(say("There are no times for {image}: put a table column,time named {path} beside it.",
                             image=image, path=path.name)) from None
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(say("{path} cannot be read as a table of times: {error}.", path=path.name,
                             error=error)) from error
    if not rows or not {"column", "time"} <= set(rows[0]):
        raise InputError(say("{path} must have the columns column and time.", path=path.name))
    number, time = (numbers_of([row[column] for row in rows], column, path.name) for column in ("column", "time"))
    whole = np.sort(number)
    if len(number) != columns or not np.array_equal(whole, np.arange(columns)):
        raise InputError(say("{path} gives times for {unique_count} columns, {image} has {columns}: each column "
                             "needs one, numbered from 0.", path=path.name, unique_count=len(np.unique(number)),
                             image=image, columns=columns))
    if columns < 2:
        raise InputError(say("{image} has {columns} column: a strip needs at least two.", image=image, columns=columns))
    time = time[np.argsort(number)]
    backwards = np.flatnonzero(~(np.diff(time) > 0))
    if len(backwards) or not np.isfinite(time).all():
        at = int(backwards[0]) + 1 if len(backwards) else int(np.flatnonzero(~np.isfinite(time))[0])
        raise InputError(say("{path}: the time of column {at} is not later than that of the column before; correct "
                             "it.", path=path.name, at=at))
    return time


def read_columns(strip: StripImage, first: int = 0, last: int | None = None) -> np.ndarray:
    """Pixels (rows, columns, 3) uint8, red green blue, of the columns from `first` to before `last`.

    Grey images give three equal bands; 16 bit images are scaled to 8.

    Raises
    ------
    InputError : the strip has no image, or the image is damaged.
    """
    if strip.path is None:
        raise InputError(say("The strip image has no file."))
    last = strip.columns if last is None else min(last, strip.columns)
    with _opened(strip.path) as source:
        bands = [1, 2, 3] if source.count >= 3 else [1, 1, 1]
        try:
            with own_gdal():
                pixels = source.read(bands, window=Window(first, 0, last - first, source.height))
        except RasterioError as error:
            raise InputError(say("{path} is damaged: {error}.", path=strip.path.name, error=error)) from error
    if pixels.dtype == np.uint16:
        pixels = (pixels >> 8).astype(np.uint8)
    if pixels.dtype != np.uint8:
        raise InputError(say("{path} must be an image of 8 or 16 bits.", path=strip.path.name))
    return np.ascontiguousarray(pixels.transpose(1, 2, 0))


def sample_pixels(pixels: np.ndarray, columns: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Colours (n, bands) float32 between the pixels of an image (rows, columns, bands), bilinear; the border holds."""
    height, width = pixels.shape[:2]
    column = np.clip(np.asarray(columns, np.float32), 0, width - 1)
    row = np.clip(np.asarray(rows, np.float32), 0, height - 1)
    left = np.minimum(column.astype(np.int64), max(width - 2, 0))
    top = np.minimum(row.astype(np.int64), max(height - 2, 0))
    u, v = (column - left)[:, None], (row - top)[:, None]
    right, bottom = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    upper = pixels[top, left] * (1 - u) + pixels[top, right] * u
    return upper * (1 - v) + (pixels[bottom, left] * (1 - u) + pixels[bottom, right] * u) * v
