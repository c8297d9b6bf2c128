"""Heights from one system into another by a grid that the user gives: a geoid model, or corrections between two.

H is a height above the geoid, h above the ellipsoid and N the geoid's own: h = H + N. Corrections are added to go from
the older to the newer system, as GSI publishes them for JGD2024.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field

import laspy
import numpy as np
import shapely
from pyproj import Transformer

from ...errors import InputError, InsufficientDataError
from ...progress import SILENT, Progress
from ...wording import say
from ..points.pointcloud import PointLayout, cloud_writer, iter_chunks, open_cloud
from ..raster import RasterSampler, write_raster
from ..reference.height_systems import (
    ELLIPSOIDAL,
    JAPANESE,
    HeightSystem,
    heights_of,
    same_heights,
    stating_heights,
)
from ..reference.system_parts import horizontal_part, same_horizontal
from .geoid import Geoid

LARGEST_CORRECTION = 5.0
"""m: corrections between two systems of heights above the geoid are less; more is a geoid model."""


@dataclass
class HeightChange:
    """The change of heights, gathered while they are converted.

    Attributes
    ----------
    lowest, highest : m.
    total : sum, m.
    count : of heights.
    """

    lowest: float = np.inf
    highest: float = -np.inf
    total: float = 0.0
    count: int = 0

    def add(self, change: np.ndarray) -> None:
        """Take in changes (n,), m."""
        if len(change):
            self.lowest, self.highest = min(self.lowest, float(change.min())), max(self.highest, float(change.max()))
            self.total += float(change.sum())
            self.count += len(change)

    @property
    def mean(self) -> float:
        """Mean change, m; NaN where nothing was changed."""
        return self.total / self.count if self.count else float("nan")


@dataclass(frozen=True, eq=False)
class HeightConversion:
    """How heights of one data set are converted.

    Attributes
    ----------
    grid : the geoid's or the corrections' heights.
    sign : +1 where they are added, -1 where they are taken off.
    target : the system of the result.
    wkt : reference of the result with its heights.
    to_degrees : from the data's places to longitude and latitude; None where they are these.
    change : what was done.
    """

    grid: Geoid
    sign: float
    target: HeightSystem
    wkt: str
    to_degrees: Transformer | None
    change: HeightChange = field(default_factory=HeightChange)

    def heights(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Change of the heights (n,), m, at places (n,).

        Raises
        ------
        InputError : a place lies outside the grid.
        """
        x, y = np.asarray(x, float), np.asarray(y, float)
        if self.to_degrees is not None:
            x, y = self.to_degrees.transform(x, y)
        change = self.sign * self.grid.interpolate(x, y)
        self.change.add(change)
        return change


def height_conversion(wkt: str, stated: HeightSystem, target: HeightSystem, grid: Geoid,
                      reverse: bool = False) -> HeightConversion:
    """How heights in a reference (WKT) go from one system to another.

    Parameters
    ----------
    stated : system of the data, where their reference does not say it.
    reverse : the corrections of `grid` lead from the target to the data's system; between Japan's systems their age
        tells it, and corrections are those of the older one's heights.

    Raises
    ------
    InputError : a system is not known, the two are the same, or the grid cannot be what they need.
    """
    declared = heights_of(wkt)
    if declared.known and stated.known and not same_heights(declared, stated):
        raise InputError(say("The data say that their heights are in {own}, not in {stated}: leave the system of the "
                             "data empty.", own=declared, stated=stated))
    source = declared if declared.known else stated
    if not source.known:
        raise InputError(say("The data do not say what their heights count from: give the height system that they "
                             "are in."))
    if not target.known:
        raise InputError(say("The height system of the result is not known: give JGD2000, JGD2011, JGD2024, "
                             "ellipsoidal or an EPSG code."))
    if same_heights(source, target):
        raise InputError(say("The heights are in {source} already: there is nothing to convert.", source=source))
    size = float(np.nanmax(np.abs(grid.heights)))
    if ELLIPSOIDAL in (source, target):
        if size <= LARGEST_CORRECTION:
            raise InputError(say("{grid} holds at most {size:.2f} m, which are corrections: between ellipsoidal "
                                 "heights and those above the geoid give a geoid model.", grid=grid.name, size=size))
        sign = 1.0 if target == ELLIPSOIDAL else -1.0
    else:
        if size > LARGEST_CORRECTION:
            raise InputError(say("{grid} holds up to {size:.1f} m, which is a geoid model: between {source} and "
                                 "{target} give the grid of corrections.", grid=grid.name, size=size, source=source,
                                 target=target))
        sign = _sign(source, target, reverse)
    plane = horizontal_part(wkt)
    if plane is None:
        raise InputError(say("The data have no coordinate reference system: assign the one that they are in."))
    to_degrees = None if plane.is_geographic else Transformer.from_crs(plane, plane.geodetic_crs, always_xy=True)
    return HeightConversion(grid, sign, target, stating_heights(plane.to_wkt(), target), to_degrees)


def _sign(source: HeightSystem, target: HeightSystem, reverse: bool) -> float:
    """Sign that corrections between two systems above the geoid are added with.

    Raises
    ------
    InputError : the corrections are to be taken against the grid, but the systems say that they lead along it.
    """
    age = list(JAPANESE)
    if source.kind not in age or target.kind not in age:
        return -1.0 if reverse else 1.0
    if age.index(source.kind) > age.index(target.kind):
        return -1.0
    if reverse:
        raise InputError(say("Corrections are those of the older heights, so that from {source} to {target} they are "
                             "added: leave “Against the grid” off.", source=source, target=target))
    return 1.0


def convert_points(paths: Sequence[str | os.PathLike], output: str | os.PathLike, stated: HeightSystem,
                   target: HeightSystem, grid: Geoid, reverse: bool = False, progress: Progress = SILENT,
                   ) -> HeightChange:
    """Write point clouds as one file with converted heights, stated in its header as WKT.

    Raises
    ------
    InputError : see `height_conversion`; a point lies outside the grid.
    """
    cloud = open_cloud(paths)
    conversion = height_conversion(cloud.crs_wkt or "", stated, target, grid, reverse)
    layout = PointLayout(cloud)
    header = layout.header
    header.vlrs[:] = [vlr for vlr in header.vlrs if vlr.user_id != "LASF_Projection"]
    # A compound system without a code of its own needs WKT, and WKT the newest version of the format.
    header.version = laspy.header.Version(1, 4)
    header.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr(conversion.wkt))
    header.global_encoding.wkt = True
    with cloud_writer(output, layout) as writer:
        for points in iter_chunks(cloud, progress):
            records = layout.view(layout.adapt(points, np.ones(len(points), bool)))
            records.z = np.asarray(points.z) + conversion.heights(np.asarray(points.x), np.asarray(points.y))
            writer.write(records.array)
    return conversion.change


def convert_raster(path: str | os.PathLike, output: str | os.PathLike, crs_wkt: str, stated: HeightSystem,
                   target: HeightSystem, grid: Geoid, reverse: bool = False, progress: Progress = SILENT,
                   ) -> HeightChange:
    """Write a raster of heights with converted ones.

    Parameters
    ----------
    crs_wkt : of the raster; what the file itself states of heights is used where this says nothing of them.

    Raises
    ------
    InputError : see `height_conversion`; a cell with a height lies outside the grid.
    """
    with RasterSampler(path) as source:
        conversion = height_conversion(_with_heights(crs_wkt, source.crs_wkt), stated, target, grid, reverse)
        write_raster(output, _ConvertedRows(source, conversion), source.grid, conversion.wkt, progress=progress)
    if not conversion.change.count:
        raise InsufficientDataError(say("{path} holds no heights: give another raster.", path=source.path.name))
    return conversion.change


def _with_heights(crs_wkt: str, own_wkt: str) -> str:
    """The reference given, with the heights that the file's own one states, where it states none and both are one in
    plan: programs drop the vertical part."""
    if not crs_wkt or not own_wkt or heights_of(crs_wkt).known:
        return crs_wkt or own_wkt
    return own_wkt if same_horizontal(crs_wkt, own_wkt) else crs_wkt


class _ConvertedRows:
    """A raster whose rows are converted as they are asked for: what a writer slices as if it were an array."""

    dtype = np.dtype(np.float32)

    def __init__(self, source: RasterSampler, conversion: HeightConversion):
        self.source, self.conversion = source, conversion

    def __getitem__(self, rows: slice) -> np.ndarray:
        grid = self.source.grid
        top, bottom, _ = rows.indices(grid.rows)
        heights = self.source.read(slice(top, bottom)).astype(float)
        x, y = grid.centres()
        row, column = np.nonzero(np.isfinite(heights))
        heights[row, column] += self.conversion.heights(x[column], y[top:bottom][row])
        return heights.astype(np.float32)


def convert_geometries(geometries: np.ndarray, conversion: HeightConversion) -> np.ndarray:
    """Geometries (n,) with converted heights; those without heights stay as they are."""
    def raise_corners(corners: np.ndarray) -> np.ndarray:
        converted = corners.copy()
        finite = np.isfinite(corners[:, 2])
        converted[finite, 2] += conversion.heights(corners[finite, 0], corners[finite, 1])
        return converted

    converted = geometries.copy()
    raised = shapely.has_z(geometries)
    converted[raised] = shapely.transform(geometries[raised], raise_corners, include_z=True)
    return converted
