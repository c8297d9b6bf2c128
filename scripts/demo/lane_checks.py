"""Measures the demo's lane map against the sample city's true lanes; only files are read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import shapely

from scripts.demo.checks import Figure
from scripts.layers import read_layer

STEP = 0.5  # m


def lane_map(folder: Path) -> list[Figure]:
    """How much of the true lanes lies in lanes of their direction, and how much of the lanes lies beside true ones."""
    true, (left, driven) = read_layer(folder / "city/truth/lanes.gpkg", "left", "driven")
    areas, (kinds, ids) = read_layer(folder / "lanes.gpkg", "kind", "lane_id")
    centres, (centre_ids,) = read_layer(folder / "lane_centres.gpkg", "lane_id")
    courses = {number: np.diff(shapely.get_coordinates(line)[[0, -1]], axis=0)[0]
               for number, line in zip(centre_ids, centres)}
    made = [(area, courses[number]) for area, kind, number in zip(areas, kinds, ids) if kind == "lane"]
    tree = shapely.STRtree([area for area, _ in made])
    hits, lengths = [], []
    for line in shapely.force_2d(true):
        places = shapely.line_interpolate_point(line, np.arange(STEP / 2, line.length, STEP))
        course = np.diff(shapely.get_coordinates(line)[[0, -1]], axis=0)[0]
        place, number = tree.query(places, predicate="within")
        right = [k for k, one in zip(place, number) if made[one][1] @ course > 0]
        hits.append(len(set(right)) / len(places))
        lengths.append(line.length)
    share, length, on = np.array(hits), np.array(lengths), np.array(driven, bool)
    figures = [Figure("lanes between junctions", len(made), "{:.0f}"),
               Figure("true lanes on driven roads in a lane of their direction, by length",
                      float((share * length)[on].sum() / length[on].sum()) if on.any() else 0.0, "{:.0%}")]
    if made:
        roads = shapely.union_all(shapely.buffer(shapely.force_2d(true), np.array(left) + 0.5, cap_style="square"))
        lanes = shapely.union_all([area for area, _ in made])
        figures.append(Figure("area of the lanes that lies beside true lanes",
                              float(lanes.difference(roads).area / lanes.area), "{:.0%}"))
    return figures
