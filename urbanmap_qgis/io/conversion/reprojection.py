"""From one horizontal reference system to another: exactly within one datum, with a stated accuracy between two."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
import shapely
from pyproj import CRS, Transformer
from pyproj.enums import TransformDirection
from pyproj.exceptions import CRSError, ProjError
from pyproj.transformer import TransformerGroup

from ...errors import InputError
from ...geometry.grid import Grid
from ...wording import say
from ..raster import RasterSampler
from ..reference.system_parts import datum_key, horizontal_part, same_horizontal

# West, south, east and north of the prefectures that the earthquake of 2011 moved by up to 5 m: there EPSG's change
# from JGD2000 to JGD2011 is GSI's grid, which this program has not.
_MOVED_2011 = (135.42, 34.84, 142.14, 41.58)

ROUGH = 5.0
"""m: between datums no transformation that is less accurate is used."""


@dataclass(frozen=True, eq=False)
class PlaneTransform:
    """A transformation of x (east or longitude) and y (north or latitude).

    Attributes
    ----------
    accuracy : m, of the change of datum as EPSG states it; 0 within one datum.
    method : name of the change of datum; empty within one datum.
    """

    transformer: Transformer
    accuracy: float
    method: str

    def __call__(self, x: np.ndarray, y: np.ndarray, inverse: bool = False) -> tuple[np.ndarray, np.ndarray]:
        """Places (n,) in the target system, or back; infinite where they cannot be computed."""
        direction = TransformDirection.INVERSE if inverse else TransformDirection.FORWARD
        return self.transformer.transform(x, y, direction=direction)

    def coordinates(self, points: np.ndarray) -> np.ndarray:
        """Places (n, 2) in the target system.

        Raises
        ------
        InputError : one cannot be computed there.
        """
        reprojected = np.column_stack(self(points[:, 0], points[:, 1]))
        if not np.isfinite(reprojected).all():
            raise InputError(say("Some places lie outside of where the reference system can be computed: check the "
                                 "coordinate reference systems."))
        return reprojected

    @property
    def description(self) -> str:
        """What was done with the datum, for messages; empty where nothing was."""
        return f"{self.method}, accurate to {self.accuracy:g} m" if self.method else ""


def plane_transform(source_wkt: str, target_wkt: str, bounds: tuple[float, float, float, float] | None = None,
                    ) -> PlaneTransform | None:
    """The transformation between the horizontal parts of two systems (WKT); None where they are the same.

    `bounds` (x_min, y_min, x_max, y_max) of the data in the source system tell where it is to hold.

    Raises
    ------
    InputError : a system is not understood, or no transformation of `ROUGH` or better is known between their datums.
    """
    if same_horizontal(source_wkt, target_wkt):
        return None
    source, target = (_horizontal(wkt) for wkt in (source_wkt, target_wkt))
    try:
        if datum_key(source) == datum_key(target):
            return PlaneTransform(Transformer.from_crs(source, target, always_xy=True), 0.0, "")
        with warnings.catch_warnings():
            # That better grids exist elsewhere is told below, in the refusal.
            warnings.simplefilter("ignore", UserWarning)
            group = TransformerGroup(source, target, always_xy=True)
    except (CRSError, ProjError) as error:
        raise InputError(say("A coordinate reference system cannot be understood: set another one.")) from error
    moved = ({datum_key(source), datum_key(target)} == {"jgd2000", "jgd2011"}
             and _touches(bounds, source, _MOVED_2011))
    usable = [] if moved else [
        found for found in group.transformers if 0.0 <= found.accuracy <= ROUGH and "allpark" not in found.description]
    if not usable:
        raise InputError(say("From {source} to {target} no transformation of {rough:g} m or better is known here: "
                             "transform the data first, between Japan's datums with GSI's TKY2JGD or PatchJGD.",
                             source=source.name, target=target.name, rough=ROUGH))
    best = min(usable, key=lambda found: found.accuracy)
    steps = [step for step in best.description.split(" + ") if "axis order" not in step]
    return PlaneTransform(best, float(best.accuracy), " + ".join(steps))


def _touches(bounds: tuple[float, float, float, float] | None, source: CRS, area: tuple) -> bool:
    """Whether data reach into an area of longitudes and latitudes; where nothing is known of them they may."""
    if bounds is None:
        return True
    geographic = Transformer.from_crs(source, source.geodetic_crs, always_xy=True)
    west, south, east, north = geographic.transform_bounds(*bounds)
    return west <= area[2] and east >= area[0] and south <= area[3] and north >= area[1]


def _horizontal(wkt: str) -> CRS:
    part = horizontal_part(wkt)
    if part is None:
        raise InputError(say("A coordinate reference system has no horizontal part: set another one."))
    return part


def epsg_wkt(code: int) -> str:
    """A system as WKT by its EPSG code.

    Raises
    ------
    InputError : the code is not known here.
    """
    try:
        return CRS.from_epsg(code).to_wkt()
    except CRSError as error:
        raise InputError(say("The reference system EPSG:{code} is not known here: choose another.",
                             code=code)) from error


def moved_geometries(geometries: np.ndarray, transform: PlaneTransform) -> np.ndarray:
    """Geometries (n,) in the target system, heights as they are; None stays None.

    Raises
    ------
    InputError : a place cannot be computed there.
    """
    return shapely.transform(geometries, lambda corners: np.column_stack(
        [transform.coordinates(corners[:, :2]), corners[:, 2:]]), include_z=bool(shapely.has_z(geometries).any()))


def seem_swapped(bounds: np.ndarray) -> bool:
    """Whether degrees (x_min, y_min, x_max, y_max) can only be latitude first: y beyond 90 degrees, x within."""
    x_min, y_min, x_max, y_max = (abs(float(value)) for value in bounds)
    return max(y_min, y_max) > 90.0 >= max(x_min, x_max)


def swapped_overlap(points: tuple[float, float, float, float], outlines: tuple[float, float, float, float]) -> bool:
    """Whether boxes (x_min, y_min, x_max, y_max) lie apart, but on each other where one has x and y swapped."""
    def touch(a: tuple, b: tuple) -> bool:
        return a[0] <= b[2] and b[0] <= a[2] and a[1] <= b[3] and b[1] <= a[3]

    x_min, y_min, x_max, y_max = outlines
    return not touch(points, outlines) and touch(points, (y_min, x_min, y_max, x_max))


def resampled(source: RasterSampler, transform: PlaneTransform, bounds: tuple[float, float, float, float],
              ) -> tuple[Grid, np.ndarray]:
    """Bilinear heights of a raster on a grid in the target system of `transform` that covers a box there.

    The cells are as large as the raster's are at the box. Cells that the raster does not reach are NaN.
    """
    middle = np.array([[(bounds[0] + bounds[2]) / 2, (bounds[1] + bounds[3]) / 2]])
    x, y = transform(middle[:, 0], middle[:, 1], inverse=True)
    ends = np.column_stack(transform(np.array([x[0], x[0]]), np.array([y[0], y[0] + source.grid.cell])))
    cell = float(np.hypot(*(ends[1] - ends[0])))
    if not np.isfinite(cell) or cell <= 0:
        raise InputError(say("{path} cannot be taken to where the other data lie: check the coordinate reference "
                             "systems.", path=source.path.name))
    grid = Grid.covering(*bounds, cell)
    columns, rows = grid.centres()
    heights = np.empty(grid.shape, np.float32)
    for row, north in enumerate(rows):
        x, y = transform(columns, np.full(len(columns), north), inverse=True)
        heights[row] = source.sample(x, y)
    return grid, heights
