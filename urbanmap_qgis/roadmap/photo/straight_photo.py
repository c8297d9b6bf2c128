"""An orthophoto along a road, straightened: rows of equal chainage, columns of equal offset."""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np

from ...io.raster import RasterSampler
from ..lanes.road_sections import Axis


class ColourImage:
    """Red, green and blue of an image file at places; a grey image has the same in all three. A context manager.

    Raises
    ------
    InputError : the file is no raster, or is turned, or its cells are not square.
    """

    def __init__(self, path: str | os.PathLike):
        first = RasterSampler(path)
        self.crs_wkt = first.crs_wkt
        self._bands = [first, *(RasterSampler(path, band) for band in (2, 3))] if first.bands >= 3 else [first]

    def __enter__(self) -> ColourImage:
        return self

    def __exit__(self, *_exception: object) -> None:
        for band in self._bands:
            band.__exit__()

    def colours(self, places: np.ndarray) -> np.ndarray:
        """Colours (..., 3) float32 at places (..., 2); NaN outside and where there is no data."""
        x, y = places[..., 0].ravel(), places[..., 1].ravel()
        values = [band.sample(x, y).reshape(places.shape[:-1]) for band in self._bands]
        return np.stack(values if len(values) == 3 else values * 3, axis=-1)


@dataclass(frozen=True)
class StraightPhoto:
    """An image along an axis.

    Attributes
    ----------
    axis : that of the road.
    chainage : (n,) of the rows, m.
    offset : (m,) of the columns, to the left of the axis, m.
    colours : (n, m, 3), NaN where the image shows nothing.
    """

    axis: Axis
    chainage: np.ndarray
    offset: np.ndarray
    colours: np.ndarray

    def column(self, offset: np.ndarray) -> np.ndarray:
        """Numbers of the columns nearest to offsets."""
        step = self.offset[1] - self.offset[0]
        return np.clip(np.round((offset - self.offset[0]) / step).astype(int), 0, len(self.offset) - 1)


def straight_places(axis: Axis, chainage: np.ndarray, offset: np.ndarray) -> np.ndarray:
    """Plan places (n, m, 2) at chainages (n,) and offsets (m,) or (n, m), m."""
    foot, along = axis.frame(chainage)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    return foot[:, None, :] + np.broadcast_to(offset, (len(foot), np.shape(offset)[-1]))[..., None] * across[:, None, :]


def straight_photo(image: ColourImage, axis: Axis, chainage: np.ndarray, offset: np.ndarray) -> StraightPhoto:
    """The image at chainages (n,) and offsets (m,) of an axis, both at equal steps, m."""
    return StraightPhoto(axis, chainage, offset, image.colours(straight_places(axis, chainage, offset)))
