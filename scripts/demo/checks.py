"""Measures the demo's results against the sample city's truth.

Every check reads the files that a stage wrote and those of the truth, and nothing that the stage said about itself.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import shapely
from osgeo import gdal, ogr, osr
from scipy.ndimage import binary_dilation, map_coordinates

from scripts.layers import read_layer, read_raster

gdal.UseExceptions()
ogr.UseExceptions()

MILLIMETRES = "{:.3f} m"
STEP = 0.5
"""Distance between the places where roofs are compared, m."""
CITY_EPSG = 6677
MUCH_WORN = 0.5
"""Share of its paint from which a marking is hardly brighter than asphalt."""
CLEAR = 0.5
"""Places lie at least this far from the inner side of parapets and from any step of the roof, m."""


@dataclass(frozen=True)
class Figure:
    """An error or a share: its value and how it is written (`style` as of `str.format`); `missing` where it is NaN."""

    what: str
    value: float
    style: str = "{:.2f} m"
    missing: str = "nothing to measure"

    @property
    def text(self) -> str:
        return self.style.format(self.value) if np.isfinite(self.value) else self.missing


@dataclass(frozen=True)
class RoofPlaces:
    """Places on true roofs, in arrays of length n: number of the building, x, y, height (m), kind.

    `kind` is "flat", "gable" or "structure" (lift houses and machines on flat roofs).
    """

    building: np.ndarray
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    kind: np.ndarray


def height_at(raster: tuple[np.ndarray, tuple[float, ...]], x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Heights at places, linear between the middles of cells; NaN outside."""
    heights, (west, cell, _, north, _, down) = raster
    places = [(y - north) / down - 0.5, (x - west) / cell - 0.5]
    return map_coordinates(heights, places, order=1, cval=np.nan)


def rmse(errors: np.ndarray) -> float:
    """Root mean square of the errors that are known; NaN where none is."""
    known = errors[np.isfinite(errors)]
    return float(np.sqrt(np.mean(known ** 2))) if len(known) else np.nan


# Truth

@lru_cache
def true_outlines(city: Path) -> dict[int, shapely.Polygon]:
    """The true outline of each building at the foot of its walls."""
    outlines, (numbers,) = read_layer(city / "truth/footprints.gpkg", "building")
    return dict(zip(numbers, outlines))


@lru_cache
def roof_places(city: Path) -> RoofPlaces:
    """Places `STEP` apart on all true roofs, clear of parapets and steps."""
    plans, fields = read_layer(city / "truth/roofs.gpkg", "building", "role", "kind", "z_roof", "z_top", "parapet_w",
                               layer="roofs")
    roofs = sorted(zip(shapely.force_2d(plans), *fields), key=lambda roof: roof[4])
    rows = []
    for number, (plan, building, role, kind, z_roof, z_top, parapet) in enumerate(roofs):
        higher = [other[0] for other in roofs[number + 1:] if other[1] == building]
        clear = shapely.difference(shapely.buffer(plan, -parapet - CLEAR),
                                   shapely.buffer(shapely.union_all(higher), CLEAR))
        x, y = grid_within(clear)
        z = gable_height(plan, z_roof, z_top, x, y) if kind == "gable" else np.full(len(x), z_roof)
        rows.append((np.full(len(x), building), x, y, z, np.full(len(x), kind if role == "main" else "structure")))
    return RoofPlaces(*map(np.concatenate, zip(*rows)))


def grid_within(plan: shapely.Geometry, step: float = STEP) -> tuple[np.ndarray, np.ndarray]:
    """x and y of the places of a grid that lie within a plan."""
    if plan.is_empty:
        return np.empty(0), np.empty(0)
    west, south, east, north = plan.bounds
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(west, east, step), np.arange(south, north, step)))
    inside = shapely.contains_xy(plan, x, y)
    return x[inside], y[inside]


def gable_height(plan: shapely.Polygon, eaves: float, ridge: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Height of a gabled roof over a rectangle whose ridge runs along the middle of its longer side."""
    a, b, c = shapely.get_coordinates(shapely.minimum_rotated_rectangle(plan))[:3]
    short = min(b - a, c - b, key=lambda side: np.hypot(*side))
    width = np.hypot(*short)
    middle = np.array(plan.centroid.coords[0])
    offset = np.abs((np.column_stack([x, y]) - middle) @ short / width)
    return ridge - (ridge - eaves) * offset / (width / 2)


def reported_errors(city: Path, survey: int) -> np.ndarray:
    """Horizontal distances (n,) of a mobile survey's reported positions from the true ones, m."""
    name = f"survey_{survey:02d}_trajectory.csv"
    reported, true = (np.loadtxt(city / folder / name, delimiter=",", skiprows=1) for folder in ("mms", "truth"))
    return np.hypot(reported[:, 1] - np.interp(reported[:, 0], true[:, 0], true[:, 1]),
                    reported[:, 2] - np.interp(reported[:, 0], true[:, 0], true[:, 2]))


# Checks

def city_as_delivered(folder: Path) -> list[Figure]:
    """What later stages have to put right: the positions that the mobile surveys report."""
    errors = np.concatenate([reported_errors(folder / "city", survey) for survey in (1, 2)])
    return [Figure("mobile surveys as delivered, mean distance in plan", float(errors.mean())),
            Figure("the same, greatest distance", float(errors.max()))]


def loaded_outlines(folder: Path) -> list[Figure]:
    """Outlines read from the GML against the same ones as delivered in a GeoPackage."""
    loaded, (ids,) = read_layer(folder / "outlines.gpkg", "gml_id")
    delivered, (names,) = read_layer(folder / "city/footprints/gsi_buildings.gpkg", "gml_id")
    pairs = dict(zip(ids, loaded))
    far = [shapely.hausdorff_distance(pairs[name], plan) for name, plan in zip(names, delivered) if name in pairs]
    return [Figure("outlines loaded, share of those delivered", len(far) / len(names), "{:.0%}"),
            Figure("greatest distance from the delivered outlines", max(far, default=np.nan), MILLIMETRES,
                   "no outline loaded")]


def surfaces(folder: Path) -> list[Figure]:
    """Ground raster against the true ground outside buildings; surface against true roofs."""
    city = folder / "city"
    areas, (kinds,) = read_layer(city / "truth/areas.gpkg", "kind")
    buildings = shapely.union_all(list(true_outlines(city).values()))
    x, y = grid_within(shapely.difference(areas[kinds.index("city")], buildings))
    made, true = read_raster(folder / "ground.tif"), read_raster(city / "truth/ground.tif")
    ground = height_at(made, x, y) - height_at(true, x, y)
    places = roof_places(city)
    surface = height_at(read_raster(folder / "dsm.tif"), places.x, places.y) - places.z
    return [Figure("ground outside buildings, RMSE", rmse(ground), MILLIMETRES),
            Figure("ground: share of it with a height", float(np.isfinite(ground).mean()), "{:.1%}"),
            *_by_kind("surface on {} roofs, RMSE", surface, places.kind, "no surface on them")]


def models(folder: Path, models: str) -> list[Figure]:
    """Building models (`models`: name of their files) against true roofs and true outlines."""
    city, true = folder / "city", true_outlines(folder / "city")
    number_of = json.loads((city / "truth/gsi_to_building.json").read_text(encoding="utf-8"))
    given, (ids, names) = read_layer(folder / "outlines.gpkg", "building_id", "gml_id")
    of = {number: number_of[name] for number, name in zip(ids, names)}
    shapes, (numbers, kinds) = read_layer(folder / f"{models}_surfaces.gpkg", "building_id", "surface_type")
    roofs: dict[int, list] = {number: [] for number in true}
    for shape, number, kind in zip(shapes, numbers, kinds):
        if kind == "roof":
            roofs[of[number]].extend(shapely.get_parts(shape))
    plans = {number: shapely.union_all(shapely.force_2d(parts)) for number, parts in roofs.items() if parts}
    places = roof_places(city)
    errors = model_heights(roofs, places) - places.z
    before = np.mean([overlap(true[of[number]], plan) for number, plan in zip(ids, given)])
    after = np.mean([overlap(true[number], plan) for number, plan in plans.items()]) if plans else np.nan
    return [Figure("buildings modelled", len(plans) / len(true), "{:.0%}"),
            Figure("true roofs: share with a model", float(np.isfinite(errors).mean()), "{:.1%}"),
            *_by_kind("height of {} roofs, RMSE", errors, places.kind, "none modelled"),
            Figure("overlap (IoU) with the true outlines: outlines as given", before, "{:.3f}"),
            Figure("overlap with the true outlines: models", after, "{:.3f}", "none modelled")]


def markings(folder: Path) -> list[Figure]:
    """Road markings found in the frames against the painted ones, to a pixel."""
    mask, place = read_raster(folder / "markings.tif")
    seen = gdal.Open(str(folder / "orthophoto.tif")).ReadAsArray()[:3].any(axis=0)
    painted, (wear,) = read_layer(folder / "city/truth/markings.gpkg", "wear", layer="aerial")
    found = mask == 255
    true, fresh = drawn(painted, mask.shape, place), drawn(
        painted[np.array(wear, float) < MUCH_WORN], mask.shape, place)
    around = np.ones((3, 3), bool)
    right = found & binary_dilation(true, around)
    hit = fresh & seen & binary_dilation(found, around)
    return [Figure("found paint that is paint (precision)", right.sum() / max(found.sum(), 1), "{:.0%}"),
            Figure("seen paint that is found (recall), not much worn", hit.sum() / max((fresh & seen).sum(), 1),
                   "{:.0%}")]


def drawn(shapes: np.ndarray, size: tuple[int, int], place: tuple[float, ...]) -> np.ndarray:
    """Mask (rows, columns) of the pixels whose middle lies in one of the shapes."""
    target = gdal.GetDriverByName("MEM").Create("", size[1], size[0], 1, gdal.GDT_Byte)
    target.SetGeoTransform(place)
    reference = osr.SpatialReference()
    reference.ImportFromEPSG(CITY_EPSG)
    target.SetProjection(reference.ExportToWkt())
    source = ogr.GetDriverByName("Memory").CreateDataSource("")
    layer = source.CreateLayer("", reference)
    for shape in shapes:
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetGeometry(ogr.CreateGeometryFromWkb(shapely.to_wkb(shapely.force_2d(shape))))
        layer.CreateFeature(feature)
    gdal.RasterizeLayer(target, [1], layer, burn_values=[1])
    return target.ReadAsArray() > 0


def _by_kind(what: str, errors: np.ndarray, kinds: np.ndarray, missing: str) -> list[Figure]:
    """The RMSE on flat and on gabled roofs, as far as there are any."""
    return [Figure(what.format(name), rmse(errors[kinds == kind]), MILLIMETRES, missing)
            for kind, name in (("flat", "flat"), ("gable", "gabled")) if (kinds == kind).any()]


def model_heights(roofs: dict[int, list], places: RoofPlaces) -> np.ndarray:
    """Height of a building's own roofs, level or sloped, at its places, NaN where it has none there."""
    heights = np.full(len(places.x), np.nan)
    for number, parts in roofs.items():
        own = np.flatnonzero(places.building == number)
        for roof in parts:
            within = own[shapely.contains_xy(shapely.force_2d(roof), places.x[own], places.y[own])]
            heights[within] = np.fmax(heights[within], plane_height(roof, places.x[within], places.y[within]))
    return heights


def plane_height(roof: shapely.Polygon, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Height at places of the plane through a roof's corners."""
    corners = shapely.get_coordinates(roof, include_z=True)
    centre = corners.mean(axis=0)
    slope, *_ = np.linalg.lstsq((corners - centre)[:, :2], (corners - centre)[:, 2], rcond=1e-6)
    return centre[2] + np.column_stack([x - centre[0], y - centre[1]]) @ slope


def overlap(a: shapely.Geometry, b: shapely.Geometry) -> float:
    """Area of the intersection over that of the union."""
    return shapely.area(shapely.intersection(a, b)) / shapely.area(shapely.union(a, b))
