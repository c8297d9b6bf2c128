"""Aerial frames: image files with their poses, read by windows."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rasterio
from rasterio.enums import MaskFlags
from rasterio.errors import NotGeoreferencedWarning, RasterioError
from rasterio.windows import Window

from ...errors import InputError
from ...io.raster import OPENING_ERRORS, own_gdal
from ...wording import say
from ..valid_pixels import valid_pixels
from .camera import ExteriorOrientation, FrameCamera

_NAMED = 5


@dataclass(frozen=True)
class AerialFrame:
    """An image file and its exterior orientation."""

    path: Path
    pose: ExteriorOrientation


def find_frames(images: Sequence[str | os.PathLike], poses: Sequence[ExteriorOrientation]) -> list[AerialFrame]:
    """Frames in the order given, with their poses found by the file's name.

    Names are compared without regard to case; a pose without a suffix (`0018`) stands for any image of that stem.

    Parameters
    ----------
    images : image files, or folders, which stand for all images of `poses` and must hold each.

    Raises
    ------
    InputError : an image has no pose, a folder lacks an image, or a file comes twice.
    """
    by_name = {Path(pose.image.replace("\\", "/")).name.casefold(): pose for pose in poses}
    frames: list[AerialFrame] = []
    for given in map(Path, images):
        if given.is_dir():
            frames += _frames_of_folder(given, poses)
            continue
        pose = by_name.get(given.name.casefold()) or by_name.get(given.stem.casefold())
        if pose is None:
            raise InputError(say("The exterior orientation has no line for {given}: add it, or leave the frame out.",
                                 given=given.name))
        frames.append(AerialFrame(given, pose))
    names = [frame.path.resolve() for frame in frames]
    twice = next((path for k, path in enumerate(names) if path in names[:k]), None)
    if twice:
        raise InputError(say("The frame {twice} is given twice: name each once.", twice=twice.name))
    return frames


def _frames_of_folder(folder: Path, poses: Sequence[ExteriorOrientation]) -> list[AerialFrame]:
    """Frames of all poses, whose images must lie in the folder."""
    files = [path for path in sorted(folder.iterdir()) if path.is_file()]
    by_stem = {path.stem.casefold(): path for path in reversed(files)
               if path.suffix.casefold() in (".tif", ".tiff", ".jpg", ".jpeg")}
    by_name = {path.name.casefold(): path for path in files}
    frames, missing = [], []
    for pose in poses:
        name = Path(pose.image.replace("\\", "/")).name.casefold()
        path = by_name.get(name) or (None if Path(name).suffix else by_stem.get(name))
        if path is None:
            missing.append(pose.image)
        else:
            frames.append(AerialFrame(path, pose))
    if missing:
        more = say(" and {count} more", count=len(missing) - _NAMED) if len(missing) > _NAMED else ""
        raise InputError(say("Images of the exterior orientation are not in {folder}: {missing}{more}; copy them "
                             "there, or choose the frames one by one.", folder=folder.name,
                             missing=", ".join(missing[:_NAMED]), more=more))
    return frames


class FrameImage:
    """The pixels of a frame, read by windows. Use as a context manager.

    Attributes
    ----------
    bands : 1 (grey) or 3 and more (red, green, blue first).
    width, height : pixels.
    dtype : uint8 or uint16.

    Raises
    ------
    InputError : the file is no image, its size is not the camera's, or it is neither 8 nor 16 bit.
    """

    def __init__(self, path: str | os.PathLike, camera: FrameCamera):
        self.path = Path(path)
        try:
            with own_gdal(), warnings.catch_warnings():
                warnings.simplefilter("ignore", NotGeoreferencedWarning)
                self._source = rasterio.open(self.path)
        except OPENING_ERRORS as error:
            raise InputError(say("{path} cannot be read as an image: check the file.", path=self.path.name)) from error
        self.bands, self.width, self.height = self._source.count, self._source.width, self._source.height
        self.dtype = np.dtype(self._source.dtypes[0])
        problem = self._problem(camera)
        if problem:
            self._source.close()
            raise InputError(problem)

    def _problem(self, camera: FrameCamera) -> str:
        if (self.width, self.height) != (camera.width, camera.height):
            return (say("{path} has {width} x {height} pixels but the camera {width_2} x {height_2}: choose the "
                        "camera file of these frames.", path=self.path.name, width=self.width, height=self.height,
                        width_2=camera.width, height_2=camera.height))
        if self.dtype not in (np.uint8, np.uint16):
            return say("{path} holds {dtype} values: convert it to 8 or 16 bit.", path=self.path.name,
                       dtype=self.dtype.name)
        return ""

    def __enter__(self) -> FrameImage:
        return self

    def __exit__(self, *_exception: object) -> None:
        self._source.close()

    def read(self, rows: slice | None = None, columns: slice | None = None) -> np.ndarray:
        """Values of a window, by default all: (bands, rows, columns)."""
        rows, columns = rows or slice(0, self.height), columns or slice(0, self.width)
        window = Window(columns.start, rows.start, columns.stop - columns.start, rows.stop - rows.start)
        try:
            with own_gdal():
                return self._source.read(window=window)
        except RasterioError as error:
            raise InputError(say("{path} is damaged: {error}.", path=self.path.name, error=error)) from error

    def valid(self, rows: slice, columns: slice) -> np.ndarray | None:
        """Where a window holds an image by the file's own word (no-data value, alpha, mask), bool; None: everywhere."""
        if all(MaskFlags.all_valid in flags for flags in self._source.mask_flag_enums):
            return None
        window = Window(columns.start, rows.start, columns.stop - columns.start, rows.stop - rows.start)
        try:
            with own_gdal():
                return valid_pixels(self._source, window)[0]
        except RasterioError as error:
            raise InputError(say("{path} is damaged: {error}.", path=self.path.name, error=error)) from error
