"""Make the demo's input: a block of buildings as an airborne laser scan, rough outlines, and the truth.

    python scripts/demo_data.py demo/input

Writes `points.laz` (unclassified, two overlapping strips, trees, cars, noise), `建物外周線.gpkg` (outlines drawn too
large or too small, and up to half a metre out of place, so that neighbours overlap) and `truth.json` (the parts of
each building). The same run gives the same files.
"""

from __future__ import annotations

import argparse
import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path

import laspy
import numpy as np
import shapely
from pyproj import CRS

EPSG = 6677  # JGD2011 / Japan Plane Rectangular IX
ORIGIN = np.array([-12000.0, -35000.0])
TURN = math.radians(14.0)
"""Angle of the streets against the grid."""
SIZE = (190.0, 130.0)
DENSITY = 6.0  # points a m2 in one of two strips
SEED = 5
OUTLINES = "建物外周線.gpkg"


@dataclass(frozen=True)
class Part:
    """A rectangle of a building in the block's own axes (m): flat, or with a gable along its longer side."""

    x0: float
    y0: float
    x1: float
    y1: float
    eaves: float
    ridge: float | None = None

    def heights(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Height of the roof above the foot of the building, NaN outside."""
        inside = (x >= self.x0) & (x <= self.x1) & (y >= self.y0) & (y <= self.y1)
        heights = np.full(x.shape, self.eaves)
        if self.ridge is not None:
            across, low, high = ((y, self.y0, self.y1) if self.x1 - self.x0 >= self.y1 - self.y0
                                 else (x, self.x0, self.x1))
            share = 1.0 - np.abs(across - (low + high) / 2) / ((high - low) / 2)
            heights = self.eaves + (self.ridge - self.eaves) * share
        return np.where(inside, heights, np.nan)


@dataclass(frozen=True)
class Building:
    """A building: its parts, and the height of its foot (m)."""

    number: int
    parts: tuple[Part, ...]
    foot: float

    @property
    def gabled(self) -> bool:
        return any(part.ridge is not None for part in self.parts)

    def roof(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Roof height at block coordinates, NaN outside."""
        heights = np.full(np.shape(x), -np.inf)
        for part in self.parts:
            heights = np.fmax(heights, part.heights(x, y))
        return np.where(np.isfinite(heights), heights + self.foot, np.nan)

    def outline(self):
        """Plan polygon in map coordinates."""
        plan = shapely.union_all([shapely.box(part.x0, part.y0, part.x1, part.y1) for part in self.parts])
        return shapely.transform(plan, to_map)


def to_map(block: np.ndarray) -> np.ndarray:
    """Map coordinates (n, 2) of block coordinates."""
    cos, sin = math.cos(TURN), math.sin(TURN)
    return block @ np.array([[cos, sin], [-sin, cos]]) + ORIGIN


def to_block(places: np.ndarray) -> np.ndarray:
    """Block coordinates (n, 2) of map coordinates."""
    cos, sin = math.cos(TURN), math.sin(TURN)
    return (places - ORIGIN) @ np.array([[cos, -sin], [sin, cos]])


def ground(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Height of the ground at block coordinates, m."""
    return 22.0 + 0.012 * x - 0.008 * y + 0.4 * np.sin(x / 31.0) * np.cos(y / 23.0)


def block() -> list[Building]:
    """Offices, an L, a U, a courtyard, a tower on a base, a terrace of touching gabled houses, and villas."""
    plans: list[list[Part]] = [
        [Part(8, 84, 40, 118, 24.0), Part(14, 92, 30, 110, 31.5)],
        [Part(46, 84, 64, 118, 17.0), Part(64, 84, 82, 98, 12.5)],
        [Part(88, 84, 128, 118, 9.0), Part(96, 92, 114, 112, 46.0)],
        [Part(134, 84, 142, 118, 14.0), Part(142, 84, 160, 93, 14.0), Part(142, 109, 160, 118, 14.0),
         Part(160, 84, 168, 118, 20.0)],
        [Part(174, 84, 186, 99, 27.0)], [Part(174, 102, 186, 118, 11.0)],
    ]
    for place in range(8):
        x = 8 + 7.5 * place
        plans.append([Part(x, 48, x + 7.5, 59, 6.2 + 0.4 * (place % 3), 9.6 + 0.4 * (place % 3))])
    plans += [
        [Part(76, 44, 106, 52, 12.0), Part(76, 64, 106, 72, 12.0), Part(76, 52, 84, 64, 12.0),
         Part(98, 52, 106, 64, 16.5)],
        [Part(112, 44, 124, 72, 21.0)], [Part(124, 44, 138, 72, 15.5)], [Part(138, 48, 150, 72, 18.5)],
        [Part(156, 44, 186, 58, 7.0), Part(156, 58, 168, 74, 10.5)],
    ]
    for place in range(9):
        x, deep = 10 + 20 * place, 10.0 + (place * 3) % 4
        house = [Part(x, 10, x + 11, 10 + deep, 5.6, 8.8)]
        if place % 2:
            house.append(Part(x + 11, 11, x + 14.5, 10 + deep - 2, 3.1))
        plans.append(house)
    buildings = []
    for number, parts in enumerate(plans, 1):
        corners = np.array([[x, y] for part in parts for x in (part.x0, part.x1) for y in (part.y0, part.y1)])
        foot = round(float(ground(corners[:, 0], corners[:, 1]).min()), 3)
        buildings.append(Building(number, tuple(parts), foot))
    return buildings


def surface_points(buildings: list[Building], random: np.random.Generator) -> np.ndarray:
    """Points (n, 4) of ground, roofs, walls and roof furniture from two strips: block x, y, height, strip."""
    points = []
    for strip in (1, 2):
        count = int(DENSITY * SIZE[0] * SIZE[1])
        x, y = random.uniform(0, SIZE[0], count), random.uniform(0, SIZE[1], count)
        z = ground(x, y)
        for building in buildings:
            roof = building.roof(x, y)
            z = np.where(np.isfinite(roof), roof, z)
        for building in buildings:
            if not building.gabled:
                z = furnish(building, x, y, z)
        points.append(np.column_stack([x, y, z + random.normal(0.02 * (strip - 1), 0.03, count),
                                       np.full(count, strip)]))
    return np.vstack(points)


def furnish(building: Building, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """A parapet and two machines on a flat roof, which are no roofs of their own."""
    part = building.parts[0]
    top = building.foot + part.eaves
    on_it = np.abs(z - top) < 0.01
    inside = (x > part.x0) & (x < part.x1) & (y > part.y0) & (y < part.y1)
    edge = np.minimum(np.minimum(x - part.x0, part.x1 - x), np.minimum(y - part.y0, part.y1 - y)) < 0.3
    z = np.where(inside & on_it & edge, top + 0.6, z)
    for share in (0.25, 0.7):
        near = (np.abs(x - (part.x0 + share * (part.x1 - part.x0))) < 0.8) & (np.abs(y - part.y0 - 2.5) < 0.6)
        z = np.where(near & on_it, top + 1.3, z)
    return z


def clutter(random: np.random.Generator) -> np.ndarray:
    """Trees in the streets and yards, cars, birds and false echoes below the ground; columns as `surface_points`."""
    points = []
    trees = [(x, y) for x in np.arange(6, SIZE[0], 11) for y in (79.0, 33.0)]
    trees += [(x, 40.5) for x in np.arange(14, 70, 9)] + [(x, 4.5) for x in np.arange(24, 180, 20)]
    for x, y in trees:
        radius, height, count = random.uniform(1.5, 2.6), random.uniform(5.0, 9.0), 260
        direction = random.normal(size=(count, 3))
        direction /= np.linalg.norm(direction, axis=1)[:, None]
        crown = direction * random.uniform(0.55, 1.0, count)[:, None] * [radius, radius, 0.32 * height]
        z = ground(np.full(count, x), np.full(count, y)) + 0.65 * height + crown[:, 2]
        points.append(np.column_stack([x + crown[:, 0], y + crown[:, 1], z, random.integers(1, 3, count)]))
    for _ in range(40):
        x, y, count = random.uniform(4, SIZE[0] - 6), random.choice([37.0, 76.0, 81.0]), 70
        xs, ys = x + random.uniform(0, 4.4, count), y + random.uniform(-0.9, 0.9, count)
        points.append(np.column_stack([xs, ys, ground(xs, ys) + 1.5, random.integers(1, 3, count)]))
    for low, high, count in ((25.0, 90.0, 30), (-6.0, -1.5, 30)):
        xs, ys = random.uniform(0, SIZE[0], count), random.uniform(0, SIZE[1], count)
        points.append(np.column_stack([xs, ys, ground(xs, ys) + random.uniform(low, high, count),
                                       random.integers(1, 3, count)]))
    return np.vstack(points)


def write_cloud(path: Path, points: np.ndarray) -> None:
    """Write block points as LAZ, all of class 1, strip after strip."""
    points = points[np.lexsort((points[:, 0], points[:, 3]))]
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales = [0.001] * 3
    header.offsets = [*ORIGIN, 0.0]
    header.add_crs(CRS.from_epsg(EPSG))
    header.creation_date = None
    cloud = laspy.LasData(header)
    cloud.x, cloud.y = to_map(points[:, :2]).T
    cloud.z = points[:, 2]
    cloud.classification = np.ones(len(points), np.uint8)
    cloud.point_source_id = points[:, 3].astype(np.uint16)
    cloud.gps_time = np.arange(len(points)) * 2e-6
    cloud.return_number = cloud.number_of_returns = np.ones(len(points), np.uint8)
    cloud.write(str(path))


def rough_outlines(buildings: list[Building], random: np.random.Generator) -> list:
    """Outlines as a map has them: drawn a little too large or small, and moved by up to 0.5 m."""
    outlines = []
    for building in buildings:
        grown = building.outline().buffer(random.uniform(-0.2, 0.4), join_style="mitre")
        angle, length = random.uniform(0, 2 * math.pi), 0.5 * math.sqrt(random.uniform())
        move = np.array([length * math.cos(angle), length * math.sin(angle)])
        outlines.append(shapely.transform(grown, lambda places, move=move: places + move))
    return outlines


def write_outlines(path: Path, buildings: list[Building], outlines: list) -> None:
    """Write the outlines as GeoPackage."""
    from osgeo import gdal, ogr, osr

    ogr.UseExceptions()
    gdal.SetConfigOption("OGR_CURRENT_DATE", "2026-01-01T00:00:00Z")
    reference = osr.SpatialReference()
    reference.ImportFromEPSG(EPSG)
    reference.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    path.unlink(missing_ok=True)
    source = ogr.GetDriverByName("GPKG").CreateDataSource(str(path))
    layer = source.CreateLayer("建物外周線", reference, ogr.wkbPolygon)
    layer.CreateField(ogr.FieldDefn("building_id", ogr.OFTInteger))
    layer.CreateField(ogr.FieldDefn("種別", ogr.OFTString))
    for building, outline in zip(buildings, outlines):
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetField("building_id", building.number)
        feature.SetField("種別", "普通建物" if building.gabled else "堅ろう建物")
        feature.SetGeometry(ogr.CreateGeometryFromWkb(shapely.to_wkb(outline)))
        layer.CreateFeature(feature)
    source.Destroy()


def read_truth(path: Path) -> list[Building]:
    """The buildings as `truth.json` has them."""
    rows = json.loads(path.read_text(encoding="utf-8"))
    return [Building(row["number"], tuple(Part(**part) for part in row["parts"]), row["foot"]) for row in rows]


def make(folder: Path) -> tuple[int, int]:
    """Write all files into a folder; returns the numbers of buildings and points."""
    folder.mkdir(parents=True, exist_ok=True)
    buildings = block()
    random = np.random.default_rng(SEED)
    points = np.vstack([surface_points(buildings, random), clutter(random)])
    write_cloud(folder / "points.laz", points)
    write_outlines(folder / OUTLINES, buildings, rough_outlines(buildings, random))
    (folder / "truth.json").write_text(json.dumps([asdict(building) for building in buildings], indent=1),
                                       encoding="utf-8")
    return len(buildings), len(points)


def main() -> None:
    """Write the input where the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    buildings, points = make(folder)
    print(f"{folder}: {buildings} buildings, {points} points")


if __name__ == "__main__":
    main()
