"""Layers and rasters as GDAL reads them, not the plugin: for what measures its results.

GDAL is imported when something is read, so that what imports this module can do without.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import shapely


def read_layer(path: Path, *names: str, layer: str | int = 0) -> tuple[np.ndarray, list[list]]:
    """Geometries of a layer, and a list for each named field; "fid" gives the numbers of the features."""
    from osgeo import ogr

    ogr.UseExceptions()
    source = ogr.Open(str(path))
    features = list(source.GetLayer(layer))
    shapes = [feature.GetGeometryRef() for feature in features]
    geometries = np.empty(len(features), dtype=object)
    geometries[:] = shapely.from_wkb([bytes(shape.ExportToWkb()) if shape else None for shape in shapes])
    return geometries, [[feature.GetFID() if name == "fid" else feature.GetField(name) for feature in features]
                        for name in names]


def plans_of(path: Path, layer: str | int = 0) -> np.ndarray:
    """Geometries of a layer in plan."""
    return shapely.force_2d(read_layer(path, layer=layer)[0])


def read_raster(path: Path) -> tuple[np.ndarray, tuple[float, ...]]:
    """Heights of a raster (NaN where there are none) and GDAL's six numbers of its place."""
    from osgeo import gdal

    gdal.UseExceptions()
    source = gdal.Open(str(path))
    band = source.GetRasterBand(1)
    heights = band.ReadAsArray().astype(float)
    if band.GetNoDataValue() is not None:
        heights[heights == band.GetNoDataValue()] = np.nan
    return heights, source.GetGeoTransform()
