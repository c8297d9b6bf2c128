"""Measures the demo's road model against the sample city's true carriageways and kerbs; only files are read."""

from __future__ import annotations

from pathlib import Path

import shapely

from scripts.demo.checks import Figure
from scripts.layers import read_layer

NEAR = 0.3  # m: a true kerb farther from a border is not the kerb that a border follows


def road_space(folder: Path) -> list[Figure]:
    """How much of the model's carriageways is true, and how near their borders lie to true kerbs."""
    true, (kinds,) = read_layer(folder / "city/truth/areas.gpkg", "kind")
    road = shapely.union_all([area for area, kind in zip(true, kinds) if kind == "carriageway"])
    areas, (made,) = read_layer(folder / "road_areas.gpkg", "kind")
    ways = shapely.union_all([shapely.force_2d(area) for area, kind in zip(areas, made)
                              if kind in ("carriageway", "junction", "lane")])
    kerbs, _ = read_layer(folder / "city/truth/edges.gpkg", layer="kerbs")
    border = shapely.get_coordinates(shapely.segmentize(ways.boundary, 0.5))
    off = shapely.distance(shapely.union_all(shapely.force_2d(kerbs)), shapely.points(border))
    return [Figure("area of the road model", float(ways.area), "{:.0f} m²"),
            Figure("share of it on true carriageways", float(shapely.intersection(ways, road).area / ways.area),
                   "{:.1%}"),
            Figure("border near true kerbs, mean distance", float(off[off < NEAR].mean()), "{:.3f} m")]
