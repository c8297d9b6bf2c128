"""Compare the demo's models with the truth and print a short table.

    python scripts/demo_check.py demo/input demo/building_models.gpkg demo/building_surfaces.gpkg SECONDS
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import shapely
from demo_data import OUTLINES, Building, read_truth, to_block

STEP = 0.5  # m between the places where heights are compared


def read_layer(path: Path, *names: str) -> tuple[np.ndarray, list[list]]:
    """Geometries of a GeoPackage's only layer, and a list for each named field."""
    from osgeo import ogr

    ogr.UseExceptions()
    source = ogr.Open(str(path))
    features = list(source.GetLayer(0))
    shapes = [feature.GetGeometryRef() for feature in features]
    geometries = shapely.from_wkb([bytes(shape.ExportToWkb()) if shape else None for shape in shapes])
    return geometries, [[feature.GetField(name) for feature in features] for name in names]


def roofs_by_building(path: Path) -> dict[int, list]:
    """Roof polygons with z of each building."""
    geometries, (numbers, kinds) = read_layer(path, "building_id", "surface_type")
    roofs: dict[int, list] = {}
    for shape, number, kind in zip(geometries, numbers, kinds):
        if kind == "roof":
            roofs.setdefault(number, []).extend(shapely.get_parts(shape))
    return roofs


def height_errors(building: Building, roofs: list) -> np.ndarray:
    """Model's minus true roof height on a grid, NaN where the model has no roof."""
    x0, y0, x1, y1 = shapely.bounds(building.outline())
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(x0, x1, STEP), np.arange(y0, y1, STEP)))
    true = building.roof(*to_block(np.column_stack([x, y])).T)
    model = np.full(len(x), np.nan)
    for roof in roofs:
        inside = shapely.contains_xy(shapely.force_2d(roof), x, y)
        model[inside] = np.fmax(model[inside], shapely.get_coordinates(roof, include_z=True)[:, 2].max())
    return (model - true)[np.isfinite(true)]


def overlap(a, b) -> float:
    """Area of the intersection over that of the union."""
    return shapely.area(shapely.intersection(a, b)) / shapely.area(shapely.union(a, b))


def rmse(errors: list[np.ndarray]) -> float:
    """Root mean square of what is known; of each building the best 95 % (the rest is at its edges)."""
    kept = []
    for values in errors:
        size = np.sort(np.abs(values[np.isfinite(values)]))
        kept.append(size[:int(np.ceil(0.95 * len(size)))])
    return float(np.sqrt(np.mean(np.concatenate(kept) ** 2)))


def main() -> None:
    """Print the table."""
    folder, models, surfaces, seconds = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]), float(sys.argv[4])
    truth = read_truth(folder / "truth.json")
    roofs = roofs_by_building(surfaces)
    _, (status,) = read_layer(models, "status")
    given, (numbers,) = read_layer(folder / OUTLINES, "building_id")
    rough = dict(zip(numbers, given))
    errors = {building.number: height_errors(building, roofs.get(building.number, [])) for building in truth}
    plans = {number: shapely.union_all([shapely.force_2d(roof) for roof in parts]) for number, parts in roofs.items()}
    before = np.mean([overlap(building.outline(), rough[building.number]) for building in truth])
    after = np.mean([overlap(building.outline(), plans[building.number]) for building in truth
                     if building.number in plans])
    modelled = sum(word != "not modelled" for word in status)
    flat = rmse([errors[building.number] for building in truth if not building.gabled])
    gabled = rmse([errors[building.number] for building in truth if building.gabled])
    rows = (("buildings", f"{len(truth)}"), ("modelled", f"{modelled} ({status.count('ok')} sound)"),
            ("roof heights, flat roofs", f"RMSE {flat:.2f} m"),
            ("roof heights, gabled roofs in level steps", f"RMSE {gabled:.2f} m"),
            ("overlap with the true outlines", f"{before:.2f} as given, {after:.2f} as modelled"),
            ("time", f"{seconds:.0f} s"))
    for name, value in rows:
        print(f"  {name:<44}{value}")


if __name__ == "__main__":
    main()
