"""GeoTIFF files of the sample city."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import rasterio
from rasterio.env import set_proj_data_search_path
from rasterio.errors import NotGeoreferencedWarning, RasterioError
from rasterio.transform import Affine

from ...errors import OutputError
from ...wording import say
from ..scene.world import CRS

QUALITY = 90
"""Of JPEG compression."""


def write_image(path: Path, image: np.ndarray, place: tuple[float, float, float] | None = None) -> None:
    """Write an image (rows, columns, 3) uint8 as JPEG in TIFF.

    Parameters
    ----------
    place : x and y of the north-west corner and the cell (m) of a georeferenced image.
    """
    _write(path, np.moveaxis(image, 2, 0), place,
           {"compress": "jpeg", "photometric": "ycbcr", "interleave": "pixel", "jpeg_quality": QUALITY})


def write_mask(path: Path, mask: np.ndarray, place: tuple[float, float, float] | None = None) -> None:
    """Write a raster (rows, columns) without loss; `place` as in `write_image`."""
    _write(path, mask[None], place, {"compress": "deflate"})


def _write(path: Path, bands: np.ndarray, place: tuple[float, float, float] | None, options: dict) -> None:
    count, height, width = bands.shape
    profile = {"driver": "GTiff", "width": width, "height": height, "count": count, "dtype": bands.dtype.name,
               "tiled": True, "blockxsize": 256, "blockysize": 256, **options}
    if place is not None:
        profile |= {"crs": CRS, "transform": Affine(place[2], 0.0, place[0], 0.0, -place[2], place[1])}
    try:
        with _own_gdal(), warnings.catch_warnings():
            warnings.simplefilter("ignore", NotGeoreferencedWarning)
            with rasterio.open(path, "w", **profile) as target:
                target.write(bands)
    except (RasterioError, OSError) as error:
        raise OutputError(say("{path} cannot be written: {error}", path=path, error=error)) from error


@contextmanager
def _own_gdal() -> Iterator[None]:
    """Use the GDAL and PROJ data that came with rasterio, not those that QGIS sets for its own libraries."""
    folder = Path(rasterio.__file__).parent
    options = {"GDAL_DATA": str(folder / "gdal_data")} if (folder / "gdal_data").is_dir() else {}
    with rasterio.Env(**options):
        if (folder / "proj_data").is_dir():
            set_proj_data_search_path(str(folder / "proj_data"))
        yield
