"""A road model from a survey against the truth of a sample city: what `roadmodel` reaches at LOD3.1 and finer.

CITY is a sample city, whose scene is made anew from truth/summary.json; AREAS and STEPS are outputs of `roadmodel`. All
is compared where the model has areas that were surveyed.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import shapely

from scripts.judges.objects import scene_of
from scripts.layers import read_layer
from urbanmap_qgis.samplecity.scene.world import Scene
from urbanmap_qgis.samplecity.truth.edges import true_kerbs
from urbanmap_qgis.samplecity.truth.lanes import true_lanes
from urbanmap_qgis.samplecity.truth.road_surfaces import (
    official_roads,
    true_carriageway,
    true_junctions,
)

NEAR, STEP = 0.15, 0.5  # m


def truth_of(scene: Scene) -> dict[str, shapely.Geometry]:
    """True surfaces by kind."""
    road = true_carriageway(scene)
    islands = scene.ground.plan_to_world(shapely.union_all(list(scene.ground.islands)))
    junctions = shapely.union_all(true_junctions(scene))
    layer = true_lanes(scene)
    lanes = []
    for line, left, right in zip(layer.geometries, layer.fields["left"], layer.fields["right"]):
        ends = shapely.get_coordinates(line)
        along = (ends[-1] - ends[0]) / np.hypot(*(ends[-1] - ends[0]))
        across = np.array([-along[1], along[0]])
        lanes.append(shapely.Polygon([ends[0] + left * across, ends[-1] + left * across, ends[-1] - right * across,
                                      ends[0] - right * across]))
    lanes = shapely.intersection(shapely.union_all(lanes), road)
    return {"carriageway": shapely.difference(shapely.difference(road, junctions), lanes), "junction": junctions,
            "lane": shapely.difference(lanes, junctions), "island": islands, "all carriageways": road,
            "sidewalk": shapely.difference(shapely.difference(shapely.union_all(official_roads(scene)), road), islands)}


def print_steps(scene: Scene, surveyed: shapely.Geometry, lines: np.ndarray, heights: np.ndarray) -> None:
    """Share of the true steps' length at which there is one, and its height."""
    layer = true_kerbs(scene)
    pieces, true = np.array(layer.geometries), np.array(layer.fields["height"])
    middles = shapely.centroid(pieces)
    inside = shapely.distance(surveyed, middles) < NEAR
    tree = shapely.STRtree(shapely.force_2d(lines))
    for name, some in (("15 cm and more", inside & (true >= 0.149)), ("2 cm and more", inside & (true >= 0.02)),
                       ("under 2 cm", inside & (true < 0.0199))):
        if not some.any():
            continue
        rows, at = tree.query_nearest(middles[some], max_distance=NEAR, all_matches=False)
        off = heights[at] - true[some][rows]
        print(f"steps of {name}: {STEP * some.sum():.0f} m, found {len(rows) / some.sum():.1%}; height "
              f"{100 * np.sqrt(np.mean(off**2)) if len(off) else np.nan:.1f} cm RMS")


def judge(city: Path, areas: Path, steps: Path) -> None:
    """Print the figures."""
    scene = scene_of(city)
    shapes, (kinds,) = read_layer(areas, "kind")
    shapes, kinds = shapely.force_2d(np.array(shapes)), np.array(kinds)
    surveyed = shapely.union_all(shapes[kinds != "road, not surveyed"])
    truth = truth_of(scene)
    for kind, true in truth.items():
        wanted = np.isin(kinds, ["carriageway", "junction", "lane"]) if kind == "all carriageways" else kinds == kind
        made, true = shapely.union_all(shapes[wanted]), shapely.intersection(true, surveyed)
        if true.area < 0.1 and made.area < 0.1:
            continue
        print(f"{kind}: {int(wanted.sum())} areas, {made.area:.0f} m2, true {true.area:.0f} m2, IoU "
              f"{shapely.intersection(made, true).area / shapely.union(made, true).area:.3f}")
    road = shapely.union_all(official_roads(scene))
    print(f"surveyed {surveyed.area / road.area:.1%} of all roads, beyond them "
          f"{shapely.difference(surveyed, road).area:.1f} m2")
    valid = bool(shapely.coverage_is_valid(shapes)) if hasattr(shapely, "coverage_is_valid") else None
    print(f"borders shared to the bit: {valid}; smallest area {shapely.area(shapes).min():.3f} m2")
    print_cuts(shapes[kinds == "junction"], truth["junction"], truth["all carriageways"], surveyed)
    lines, (heights,) = read_layer(steps, "height")
    print_steps(scene, surveyed, np.array(lines), np.array(heights))


def print_cuts(junctions: np.ndarray, true: shapely.Geometry, road: shapely.Geometry,
               surveyed: shapely.Geometry) -> None:
    """Distance of the true cuts at stop lines from the borders of junctions."""
    inner = shapely.buffer(surveyed, -0.5)
    road = shapely.intersection(road, surveyed)
    rows = []
    for junction in shapely.get_parts(true):
        ring = shapely.get_coordinates(junction.exterior)
        for line in shapely.linestrings(np.stack([ring[:-1], ring[1:]], axis=1)):
            inside = shapely.intersection(line, inner)
            across = shapely.distance(shapely.centroid(line), road.boundary) > 1.0
            if across and inside.length > 0.8 * line.length:
                places = shapely.line_interpolate_point(inside, [0.1, 0.5, 0.9], normalized=True)
                rows.append(float(np.max(shapely.distance(places, shapely.union_all(junctions).boundary)))
                            if len(junctions) else np.inf)
    print(f"cuts: {len(rows)} true, within 0.3 m {np.mean(np.array(rows) < 0.3) if rows else np.nan:.0%}, "
          f"off {[round(row, 2) for row in rows]}")
