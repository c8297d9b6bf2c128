"""Rasters: frames, orthophotos, heights and masks, told by bands, numbers and georeference from a few windows."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import rasterio
from rasterio.errors import NotGeoreferencedWarning, RasterioError
from rasterio.windows import Window

from ...errors import InputError
from ...io.raster import own_gdal
from ...io.reference.height_systems import heights_of
from ...io.reference.renamed_crs import known_wkt
from ...wording import say
from ..file_facts import (
    ELEVATION,
    FRAME,
    FRAME_MASK,
    LINE_IMAGE,
    MARKING_MASK,
    ORTHOPHOTO,
    RASTER,
    TEXTURE,
    FileFacts,
    without_system,
)

_MAGIC = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+", b"\xff\xd8\xff", b"\x89PNG\r\n", b"\0\0\0\x0cjP  ")
_WINDOW = 256
_PLACES = 3
"""Windows are looked at in so many places along either side."""
_MOST_PAINT = 0.25
"""Share of a place that paint covers at most: above it a mask shows something else."""


def is_raster(head: bytes) -> bool:
    """Whether a file begins as TIFF, JPEG, PNG or JPEG 2000."""
    return head.startswith(_MAGIC)


def raster_facts(path: Path, _head: bytes) -> list[FileFacts]:
    """What a raster is.

    Raises
    ------
    InputError : it cannot be opened, or ends before its last pixels.
    """
    try:
        with warnings.catch_warnings(), own_gdal():
            warnings.simplefilter("ignore", NotGeoreferencedWarning)
            with rasterio.open(path) as source:
                sample = np.concatenate([source.read(window=window).reshape(source.count, -1)
                                         for window in _windows(source.width, source.height)], axis=1)
                return [_facts(path, source, sample)]
    except RasterioError as error:
        raise InputError(say("{name} cannot be read as an image or raster: it is damaged or cut off; copy or download "
                             "it again.", name=path.name)) from error


def _windows(width: int, height: int) -> list[Window]:
    """Windows spread over the raster; the last one ends with its last pixel."""
    lefts, tops = (sorted({int(share * max(size - _WINDOW, 0)) for share in np.linspace(0.0, 1.0, _PLACES)})
                   for size in (width, height))
    return [Window(left, top, min(_WINDOW, width), min(_WINDOW, height)) for top in tops for left in lefts]


def _facts(path: Path, source: rasterio.DatasetReader, sample: np.ndarray) -> FileFacts:
    placed = not source.transform.is_identity
    crs = known_wkt(source.crs.to_wkt()) if source.crs else ""
    kind, doubt = _kind(path, source, sample, placed)
    size = say("{width} x {height} pixels", width=source.width, height=source.height)
    cell = abs(source.transform.a)
    detail = f"{size}, {cell:.3g} m" if placed and source.crs and source.crs.is_projected else size
    return FileFacts(path, kind, detail=detail, crs_wkt=crs, heights=heights_of(crs).word,
                     extent=tuple(map(float, source.bounds)) if placed else None, doubt=doubt,
                     count=source.width * source.height, notes=without_system(path.name, crs) if placed else ())


def _kind(path: Path, source: rasterio.DatasetReader, sample: np.ndarray, placed: bool) -> tuple[str, str]:
    """Kind, and why it may be another one."""
    if path.with_name(f"{path.stem}_times.csv").is_file():
        return LINE_IMAGE, ""
    if "appearance" in path.parent.name.lower() and not placed:  # where CityGML keeps its textures
        return TEXTURE, ""
    floating = np.issubdtype(sample.dtype, np.floating)
    if source.count == 1 and floating:
        return (ELEVATION, say("told by its decimal numbers")) if placed else (RASTER, "")
    if floating:
        return RASTER, ""
    values = np.unique(sample)
    if source.count >= 3:
        return (ORTHOPHOTO if placed else FRAME), ""
    if len(values) <= 8:
        return _mask(sample, values, placed)
    return (ORTHOPHOTO, say("of one band")) if placed else (FRAME, say("of one band"))


def _mask(sample: np.ndarray, values: np.ndarray, placed: bool) -> tuple[str, str]:
    if not placed:
        return FRAME_MASK, ""
    share = float(np.mean(sample > 0))
    if set(values.tolist()) <= {0, 255} and 0.0 < share <= _MOST_PAINT:
        return MARKING_MASK, say("told by the {share:.1f} % of it that are set", share=100 * share)
    return RASTER, ""
