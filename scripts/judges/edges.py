"""Road edges against the truth of a city: what `roadedges` reaches.

CITY is a sample city (truth/edges.gpkg) or another folder with truth/areas.gpkg, whose border between carriageway and
sidewalks then is the truth: kerbs 0.15 m high. SURVEY and DRIVE are a corrected survey and its trajectory, LABELS its
true classes (by default truth/NAME_labels.npz), SIGMA what is said of its accuracy. Places are those of the middle of
the kerb's face. A kerb counts as scanned where five true ground points lie on both of its sides within half a metre.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np
import shapely
from scipy.spatial import cKDTree

from scripts.layers import read_layer
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.roadmap.edges.edge_records import RoadEdge
from urbanmap_qgis.roadmap.edges.road_edges import road_edges
from urbanmap_qgis.settings.roadmap import EdgeSettings

FOUND, FALSE, AROUND, STEP = 0.15, 0.5, 0.5, 0.5  # m
KERBS = {"kerb", "lowered kerb"}


@dataclass(frozen=True)
class Truth:
    """True kerbs: pieces of half a metre with their heights (m), the carriageway, rails and walls."""

    pieces: np.ndarray
    height: np.ndarray
    road: shapely.Geometry
    rails: np.ndarray
    walls: np.ndarray


def read_truth(folder: Path) -> Truth:
    """Truth of a city."""
    areas, (kinds,) = read_layer(folder / "areas.gpkg", "kind")
    areas, kinds = np.array(areas), np.array(kinds)
    road = shapely.union_all(areas[kinds == "carriageway"])
    walls = np.array(read_layer(folder / "roofs.gpkg", layer="wall_lines")[0])
    if (folder / "edges.gpkg").is_file():
        kerbs, (height,) = read_layer(folder / "edges.gpkg", "height", layer="kerbs")
        rails = read_layer(folder / "edges.gpkg", layer="rails")[0]
        return Truth(np.array(kerbs), np.array(height), road, np.array(rails), walls)
    beside = shapely.union_all(areas[kinds == "sidewalk"]).buffer(0.3)
    pieces = []
    for line in shapely.get_parts(shapely.line_merge(road.boundary & beside)):
        places = shapely.get_coordinates(shapely.line_interpolate_point(line, np.arange(0.0, line.length, STEP)))
        pieces += list(shapely.linestrings(np.stack([places[:-1], places[1:]], axis=1)))
    return Truth(np.array(pieces), np.full(len(pieces), 0.15), road, np.array([]), walls)


def scanned(truth: Truth, middles: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Which true pieces the survey's ground points (n, 2) show on both sides."""
    shapely.prepare(truth.road)
    shown = np.zeros(len(middles), bool)
    for number, rows in enumerate(cKDTree(points).query_ball_point(middles, AROUND)):
        inside = shapely.contains_xy(truth.road, *points[rows].T)
        shown[number] = np.count_nonzero(inside) >= 5 and np.count_nonzero(~inside) >= 5
    return shown


def print_places(edges: list[RoadEdge], truth: Truth) -> None:
    """Errors of the kerbs' stations in plan and height beside their sigma, by status."""
    tree, every = shapely.STRtree(truth.pieces), shapely.union_all(shapely.force_2d(truth.pieces))
    shapely.prepare(every)
    for status in ("measured", "doubtful"):
        some = [edge for edge in edges if edge.kind in KERBS and edge.status == status]
        if not some:
            continue
        places = shapely.points(np.concatenate([0.5 * (edge.foot + edge.top)[:, :2] for edge in some]))
        step = np.concatenate([edge.top[:, 2] - edge.foot[:, 2] for edge in some])
        sigma, sigma_z = (np.concatenate([np.full(len(edge.foot), getattr(edge, name)) for edge in some])
                          for name in ("sigma", "sigma_z"))
        off = shapely.distance(every, places)
        near = off < FALSE
        high = (step - truth.height[tree.query_nearest(places, all_matches=False)[1]])[near]
        print(f"{status} kerbs: {sum(edge.length for edge in some):.0f} m, {1 - near.mean():.1%} of them false; plan "
              f"{100 * np.sqrt(np.mean(off[near]**2)):.2f} cm RMS, {np.mean(off[near] < 2 * sigma[near]):.1%} within "
              f"two sigma (median sigma {100 * np.median(sigma):.2f} cm); height of the step "
              f"{100 * np.sqrt(np.mean(high**2)):.2f} cm RMS, {np.mean(np.abs(high) < 2 * sigma_z[near]):.1%} within")


def print_completeness(edges: list[RoadEdge], truth: Truth, path: np.ndarray, points: np.ndarray, width: float) -> None:
    """Share of the true kerbs near the path that were found."""
    middles = shapely.get_coordinates(shapely.centroid(truth.pieces))
    near = np.isfinite(cKDTree(path).query(middles, distance_upper_bound=width)[0])
    middles, height = middles[near], truth.height[near]
    shown = scanned(truth, middles, points)
    line = {}
    for name, wanted in (("all", lambda edge: edge.kind in KERBS), ("measured", lambda edge: edge.kind in KERBS
                         and edge.status == "measured"), ("lowered", lambda edge: edge.kind == "lowered kerb")):
        lines = [shapely.linestrings(edge.foot[:, :2]) for edge in edges if wanted(edge)]
        line[name] = shapely.distance(shapely.union_all(lines), shapely.points(middles)) < FOUND if lines else shown & 0
    print(f"kerbs within {width:g} m: {STEP * len(middles):.0f} m, scanned {shown.mean():.1%}; of these found "
          f"{np.mean(line['all'][shown]):.1%}, measured {np.mean(line['measured'][shown]):.1%}")
    low = shown & (height < 0.075)
    if low.any():
        print(f"lowered kerbs scanned: {STEP * low.sum():.0f} m, called lowered {np.mean(line['lowered'][low]):.1%}; "
              f"of full ones called lowered {np.mean(line['lowered'][shown & ~low]):.1%}")


def print_others(edges: list[RoadEdge], truth: Truth) -> None:
    """Rails and walls: distance to the nearest true one."""
    for kind, true in (("guard rail", truth.rails), ("wall", truth.walls)):
        some = [edge for edge in edges if edge.kind == kind and edge.status == "measured"]
        length = sum(edge.length for edge in some)
        if not some or not len(true):
            print(f"{kind}s, measured: {length:.0f} m, nothing to compare them with")
            continue
        off = shapely.distance(shapely.union_all(true), shapely.points(np.concatenate(
            [edge.foot[:, :2] for edge in some])))
        print(f"{kind}s, measured: {length:.0f} m; {np.mean(off >= 0.3):.1%} false, the others "
              f"{100 * np.median(off[off < 0.3]):.1f} cm off in the median")
    print(f"road borders: {sum(edge.length for edge in edges if edge.kind == 'road border'):.0f} m")


def judge(city: Path, survey: Path, drive: Path, labels: Path | None = None, sigma: float = 0.0) -> None:
    """Print the figures."""
    settings = EdgeSettings(survey_sigma=sigma)
    trajectory = read_trajectory(drive).trajectory
    start = time.process_time()
    found = road_edges([survey], trajectory, settings)
    spent = time.process_time() - start
    print(f"{found.path_length:.0f} m, {found.points_read / 1e6:.1f} million points: {spent:.1f} s of CPU, "
          f"{1000 * spent / found.path_length:.0f} s a kilometre")
    truth = read_truth(city / "truth")
    cloud = laspy.read(survey)
    ground = np.load(labels or city / "truth" / f"{survey.stem}_labels.npz")["ground"].astype(bool)
    print_places(found.edges, truth)
    print_completeness(found.edges, truth, trajectory.place[:, :2], np.column_stack([cloud.x, cloud.y])[ground],
                       settings.width)
    print_others(found.edges, truth)
