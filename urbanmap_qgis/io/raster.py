"""GeoTIFF rasters: written in tiles, read whole or just where points lie."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import rasterio
from rasterio._err import CPLE_BaseError
from rasterio.crs import CRS
from rasterio.env import set_proj_data_search_path
from rasterio.errors import CRSError, RasterioError
from rasterio.transform import Affine
from rasterio.windows import Window

from ..errors import InputError, OutputError
from ..geometry.grid import Grid
from ..geometry.sampling import sample
from ..progress import SILENT, Progress, notice
from ..wording import say
from .files.atomic import written_beside
from .reference.height_systems import heights_of, stating_heights
from .reference.renamed_crs import known_wkt

NODATA = -9999.0
"""What stands for no height; no height on land is so large, either way, as it and other programs' values for it."""

_BLOCK = 256
_SAMPLE_BLOCK = 2048


OPENING_ERRORS = (RasterioError, CPLE_BaseError, OSError, UnicodeError)
"""What rasterio raises on a file that cannot be opened, or whose head turns out damaged later; the text of a damaged
reference system may be no UTF-8. GDAL's own errors are not among rasterio's, which lets some of them through."""


@contextmanager
def own_gdal(cache: int | None = None) -> Iterator[None]:
    """Let rasterio use the GDAL and PROJ data that came with it.

    QGIS sets PROJ_LIB and GDAL_DATA for its own libraries; a rasterio wheel brings others of another version,
    which cannot read those. This tells rasterio's copies only, not the process.

    `cache` : bytes that GDAL may keep of files in the meantime; None for its own choice, 5 % of the memory.
    """
    folder = Path(rasterio.__file__).parent
    options: dict[str, str | int] = {"GDAL_DATA": str(folder / "gdal_data")} if (folder / "gdal_data").is_dir() else {}
    if cache is not None:
        options["GDAL_CACHEMAX"] = cache
    with rasterio.Env(**options):
        if (folder / "proj_data").is_dir():
            set_proj_data_search_path(str(folder / "proj_data"))
        yield


def write_raster(path: str | os.PathLike, raster: np.ndarray, grid: Grid, crs_wkt: str,
                 nodata: float | None = NODATA, progress: Progress = SILENT) -> None:
    """Write a raster as a tiled and compressed GeoTIFF.

    Parameters
    ----------
    raster : (rows, columns), floats with NaN where empty or whole numbers.
    grid : its place.
    crs_wkt : coordinate reference system as WKT.
    nodata : value that stands for NaN in the file; None for rasters without gaps.

    Raises
    ------
    OutputError : the file cannot be written.
    InputError : the CRS cannot be understood.
    """
    floating = np.issubdtype(raster.dtype, np.floating)
    profile = {"driver": "GTiff", "width": grid.columns, "height": grid.rows, "count": 1,
               "dtype": raster.dtype.name, "transform": Affine(grid.cell, 0, grid.x_min, 0, -grid.cell, grid.y_max),
               "tiled": True, "blockxsize": _BLOCK, "blockysize": _BLOCK, "compress": "deflate",
               "predictor": 3 if floating else 2, "bigtiff": "if_safer", "nodata": nodata}
    try:
        with (own_gdal(), written_beside(path) as temporary,
              rasterio.open(temporary, "w", crs=_lasting_crs(crs_wkt), **profile) as target):
            for top in range(0, grid.rows, _BLOCK):
                band = np.asarray(raster[top:top + _BLOCK])
                if floating and nodata is not None:
                    band = np.where(np.isnan(band), band.dtype.type(nodata), band)
                target.write(band, 1, window=Window(0, top, grid.columns, len(band)))
                progress.step(top / grid.rows)
    except CRSError as error:
        raise InputError(say("The coordinate reference system cannot be understood: set another one.")) from error
    except RasterioError as error:
        raise OutputError(say("{path} cannot be written ({error}): choose another output.", path=Path(path).name,
                              error=error)) from error


def _lasting_crs(crs_wkt: str) -> CRS:
    """A CRS that comes back from a GeoTIFF: heights whose code the database does not know are spelt out.

    A GeoTIFF holds codes, and one that the reader's database lacks would be lost with all that it says of heights.
    """
    system = heights_of(crs_wkt)
    if system.epsg is not None:
        try:
            CRS.from_epsg(system.epsg)
        except CRSError:
            crs_wkt = stating_heights(crs_wkt, system, coded=False)
    return CRS.from_wkt(crs_wkt)


class RasterSampler:
    """A raster file from which heights at points are read, holding no more of it than the points need.

    Use as a context manager.

    Attributes
    ----------
    grid : its place.
    crs_wkt : its CRS as WKT, "" where the file states none.
    bands : how many the file has.

    Raises
    ------
    InputError : the file is no raster, or is turned, or its cells are not square.
    """

    def __init__(self, path: str | os.PathLike, band: int = 1):
        self.path = Path(path)
        self.band = band
        try:
            with own_gdal():
                self._source = rasterio.open(self.path)
                self.crs_wkt = known_wkt(self._source.crs.to_wkt()) if self._source.crs else ""
        except OPENING_ERRORS as error:
            raise InputError(say("{path} cannot be read as a raster: check the file.", path=self.path.name)) from error
        self.bands = self._source.count
        if not 1 <= band <= self.bands:
            raise InputError(say("{path} has {bands} bands, no band {band}.", path=self.path.name, bands=self.bands,
                                 band=band))
        self.grid = _grid_of(self._source, self.path)

    def __enter__(self) -> RasterSampler:
        return self

    def __exit__(self, *_exception: object) -> None:
        self._source.close()

    def read(self, rows: slice | None = None, columns: slice | None = None) -> np.ndarray:
        """Values of a window, by default all, as float32 with NaN where there is no data."""
        rows = rows or slice(0, self.grid.rows)
        columns = columns or slice(0, self.grid.columns)
        window = Window(columns.start, rows.start, columns.stop - columns.start, rows.stop - rows.start)
        try:
            with own_gdal():
                values = self._source.read(self.band, window=window, masked=True)
        except RasterioError as error:
            raise InputError(say("{path} is damaged: {error}.", path=self.path.name, error=error)) from error
        heights = values.data.astype(np.float32, copy=False)
        if values.mask is not np.ma.nomask:
            heights[values.mask] = np.nan
        if not np.issubdtype(values.dtype, np.unsignedinteger) and (unsaid := np.abs(heights) >= -NODATA).any():
            notice(say("{path} has the value {value:g} where it holds no height, and does not say that it stands for "
                       "no data: such cells are taken as empty.", path=self.path.name, value=heights[unsaid][0]))
            heights[unsaid] = np.nan
        return heights

    def sample(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Bilinear values at points, (n,) float32; NaN outside and where there is no data (see `sample`)."""
        x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        heights = np.full(x.shape, np.nan, dtype=np.float32)
        numbers = np.isfinite(x) & np.isfinite(y)
        row, column, inside = self.grid.cells(np.where(numbers, x, 0), np.where(numbers, y, 0))
        points = np.flatnonzero(inside & numbers)
        across = -(-self.grid.columns // _SAMPLE_BLOCK)
        block = row[points] // _SAMPLE_BLOCK * across + column[points] // _SAMPLE_BLOCK
        one = len(block) and block.min() == block.max()  # as on a small grid
        order = slice(None) if one else np.argsort(block, kind="stable")
        for part in np.split(points[order], np.flatnonzero(np.diff(block[order])) + 1):
            if len(part):
                grid, values = self._around(row[part], column[part])
                heights[part] = sample(grid, values, x[part], y[part])
        return heights

    def sample_cells(self, grid: Grid) -> np.ndarray:
        """The same at the centres of a grid's cells, (rows, columns)."""
        x, y = np.meshgrid(*grid.centres())
        return self.sample(x.ravel(), y.ravel()).reshape(grid.shape)

    def _around(self, row: np.ndarray, column: np.ndarray) -> tuple[Grid, np.ndarray]:
        """The part of the raster with these cells and one more all round: its grid and values."""
        rows = slice(max(int(row.min()) - 1, 0), min(int(row.max()) + 2, self.grid.rows))
        columns = slice(max(int(column.min()) - 1, 0), min(int(column.max()) + 2, self.grid.columns))
        grid = Grid(self.grid.x_min + columns.start * self.grid.cell, self.grid.y_max - rows.start * self.grid.cell,
                    self.grid.cell, rows.stop - rows.start, columns.stop - columns.start)
        return grid, self.read(rows, columns)


def _grid_of(source: rasterio.DatasetReader, path: Path) -> Grid:
    """Grid of an open raster, which must be north-up with square cells."""
    place = source.transform
    if not np.isfinite(place[:6]).all():
        raise InputError(say("{path} says where it lies in numbers that are not finite: it is damaged; export it "
                             "again.", path=path.name))
    if not place.determinant:
        raise InputError(say("{path} has cells of no size: it is damaged; export it again.", path=path.name))
    if place.b or place.d or place.a <= 0 or not np.isclose(place.a, -place.e, rtol=1e-6):
        raise InputError(say("{path} is turned or its cells are not square: warp it to a north-up raster first.",
                             path=path.name))
    return Grid(place.c, place.f, place.a, source.height, source.width)


def read_raster(path: str | os.PathLike, band: int = 1) -> tuple[np.ndarray, Grid, str]:
    """A whole raster as float32 (rows, columns) with NaN where there is no data, its grid and its CRS as WKT.

    Raises
    ------
    InputError : the file is no raster, or is turned, or its cells are not square.
    """
    with RasterSampler(path, band) as source:
        return source.read(), source.grid, source.crs_wkt
