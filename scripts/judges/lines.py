"""Lines, symbols and lanes against the truth of a city: what the road map's algorithms reach from found markings.

CITY is a sample city or another folder with truth/markings.gpkg, truth/survey_*_trajectory.csv and, for lanes,
truth/lanes.gpkg. MARKINGS are the polygons found in it, points the marking points of its surveys. Lines are compared by
their painted length; without drives the true trajectories are taken.
"""

from __future__ import annotations

import time
from collections import Counter
from pathlib import Path

import numpy as np
import shapely
import shapely.ops
from shapely import affinity

from scripts.judges.movements import movement_figures
from scripts.layers import read_layer
from urbanmap_qgis.io.raster import RasterSampler
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.roadmap.lines.line_work import LineWork, line_work, with_ground_heights
from urbanmap_qgis.roadmap.lines.point_paint import drive_points, drive_polygons, hidden_paint
from urbanmap_qgis.roadmap.lines.symbol_patterns import matches
from urbanmap_qgis.roadmap.lines.symbols import UNKNOWN_ARROW
from urbanmap_qgis.roadmap.map_records import DrivenPath, MapArea, MapLine, VectorMap
from urbanmap_qgis.roadmap.vector_map import build_vector_map

LINES = {"centre": "solid", "centre_dash": "dashed", "edge": "solid", "lane": "", "lane_dash": "dashed",
         "lane_solid": "solid"}
"""Kinds of truth that are lines of lanes, and their class; the sample's lane lines are dashes where 3 m long."""

OTHER_LINES = {"tactile", "parking", "bay", "sidewalk_dash"}
"""Paint that is a line too, but none of a lane: finding it is neither asked for nor wrong."""

NEAR, STEP = 0.10, 0.25  # m


def axes_of(polygons: np.ndarray) -> np.ndarray:
    """Middle lines of polygons that are strips of one width, straight or bent."""
    made = []
    for polygon in polygons:
        frame = shapely.minimum_rotated_rectangle(shapely.force_2d(polygon))
        straight = polygon.area > 0.93 * frame.area
        ring = shapely.get_coordinates((frame if straight else shapely.get_parts(polygon)[0]).exterior)[:-1]
        sides = np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1)
        ends = range(len(ring)) if len(ring) % 2 == 0 else []
        half = len(ring) // 2
        # The two ends of a strip lie half a ring apart and are its shortest sides together.
        first = min(ends, key=lambda k: sides[k] + sides[(k + half) % len(ring)], default=0)
        ring = np.roll(ring, -first - 1, axis=0)
        made.append(shapely.LineString((ring[:half] + ring[half:2 * half][::-1]) / 2))
    return np.array(made, object)


def painted(work: LineWork) -> list[tuple[object, shapely.LineString]]:
    """Painted stretches of the found lines with their line."""
    made = []
    for line in work.lines:
        for start, end in line.dashes if line.kind != "stop line" else ():
            made.append((line, shapely.ops.substring(line.plan, start, end)))
    return [(line, stretch) for line, stretch in made if stretch.length > 0.2]


def sampled(line: shapely.LineString) -> np.ndarray:
    return shapely.line_interpolate_point(line, np.arange(STEP / 2, line.length, STEP))


def line_figures(work: LineWork, shapes: np.ndarray, kinds: np.ndarray, given: np.ndarray) -> dict[str, float]:
    """Completeness, correctness, lateral error, class and sigma of the lines."""
    wanted, other = np.isin(kinds, list(LINES)), np.isin(kinds, list(OTHER_LINES))
    axes, spare = axes_of(shapes[wanted]), axes_of(shapes[other])
    classes = np.array([LINES[kind] or ("dashed" if axis.length < 4.0 else "solid")
                        for kind, axis in zip(kinds[wanted], axes)])
    found = painted(work)
    tree, truth, extra = (shapely.STRtree(one) for one in ([stretch for _, stretch in found], axes, spare))
    places = np.concatenate([sampled(axis) for axis in axes])
    complete = np.isin(np.arange(len(places)), tree.query(places, predicate="dwithin", distance=NEAR)[0])
    held = np.isin(np.arange(len(places)),
                   shapely.STRtree(given).query(places, predicate="dwithin", distance=NEAR)[0])
    right, total, lateral, within, class_right, class_total = 0, 0, [], [], 0, 0
    for line, stretch in found:
        points = sampled(stretch)
        at, which = truth.query(points, predicate="dwithin", distance=0.25)
        spared = np.unique(extra.query(points, predicate="dwithin", distance=0.25)[0])
        hit = np.unique(at[shapely.distance(points[at], axes[which]) <= NEAR])
        counted = np.setdiff1d(np.arange(len(points)), np.setdiff1d(spared, hit))
        right, total = right + len(hit), total + len(counted)
        apart = shapely.distance(points[at], axes[which])
        lateral += apart.tolist()
        within += (apart <= 2 * line.sigma).tolist()
        class_right += int((classes[which] == line.kind).sum())
        class_total += len(which)
    return {"lines, completeness": complete.mean(), "lines, share of the paint that the markings hold": held.mean(),
            "lines, completeness of paint in the markings": complete[held].mean(),
            "lines, correctness": right / max(total, 1),
            "lateral RMS, m": float(np.sqrt(np.mean(np.square(lateral)))), "class by length": class_right / class_total,
            "within two sigma": float(np.mean(within)), **end_figures(work, axes[classes == "dashed"])}


def course_figures(work: LineWork, city: Path) -> dict[str, float]:
    """Share of the true lines' courses, with the gaps of dashes, along which a found line runs, painted or bridged."""
    if not (city / "truth/lines.gpkg").is_file():
        return {}
    shapes, (kinds,) = read_layer(city / "truth/lines.gpkg", "class", layer="lines_aerial")
    places = np.concatenate([sampled(shapely.force_2d(shape)) for shape, kind in zip(shapes, kinds)
                             if kind != "stop line"])
    plans = [line.plan for line in work.lines if line.kind != "stop line"]
    at = shapely.STRtree(plans).query(places, predicate="dwithin", distance=NEAR)[0]
    return {"lines, completeness of courses": len(np.unique(at)) / len(places)}


def end_figures(work: LineWork, dashes: np.ndarray) -> dict[str, float]:
    """Errors along at dash ends."""
    ends = shapely.points(np.concatenate([shapely.get_coordinates(axis) for axis in dashes])) if len(dashes) else []
    tree, errors = shapely.STRtree(ends), []
    for line in work.lines:
        if line.kind != "dashed":
            continue
        for place in shapely.line_interpolate_point(line.plan, line.dashes.ravel()):
            near = tree.query_nearest(place, max_distance=0.6)
            errors += [shapely.distance(place, ends[k]) for k in near[:1]]
    return {"dash ends, RMS along, m": float(np.sqrt(np.mean(np.square(errors)))) if errors else np.nan,
            "dash ends, mean, m": float(np.mean(errors)) if errors else np.nan}


def area_figures(work: LineWork, shapes: np.ndarray, kinds: np.ndarray) -> dict[str, float]:
    """Stop lines, crosswalks and arrows found and right."""
    figures = {}
    stops = axes_of(shapes[np.isin(kinds, ["stop", "stop_line"])])
    found = [line.plan for line in work.lines if line.kind == "stop line"]
    figures |= _matched("stop lines", [one.buffer(0.2) for one in stops], [one.buffer(0.2) for one in found], 0.5)
    pairs = [(a, b) for a in stops for b in found if a.distance(b) < 0.3 and b.length > 0.5 * a.length]
    off = [shapely.distance(sampled(b), shapely.LineString(a)).mean() for a, b in pairs]
    figures["stop lines, RMS along the road, m"] = float(np.sqrt(np.mean(np.square(off)))) if off else np.nan
    bars = shapely.force_2d(shapes[kinds == "zebra"])
    rows = shapely.get_parts(shapely.union_all(shapely.buffer(bars, 0.5)))
    rows = [shapely.minimum_rotated_rectangle(shapely.union_all(bars[shapely.intersects(bars, row)])) for row in rows]
    figures |= _matched("crosswalks", rows, [area.polygon for area in work.areas if area.kind == "crosswalk"], 0.7)
    arrows = [area.polygon for area in work.areas if area.kind.startswith("arrow")]
    true = shapely.force_2d(shapes[kinds == "arrow"])
    return figures | _matched("arrows (any kind)", list(true), arrows, 0.4) | kind_figures(work, true)


def true_kind(shape: shapely.Geometry) -> str:
    """Kind of an arrow as it was painted; the sides of its shaft are its longest parallel edges."""
    edges = np.diff(shapely.get_coordinates(shapely.get_parts(shape)[0].exterior), axis=0)
    length, angle = np.linalg.norm(edges, axis=1), np.arctan2(edges[:, 1], edges[:, 0])
    longest = np.argmax((np.abs(np.sin(angle[:, None] - angle)) < 0.04) @ length + 1e-3 * length)
    along, place = edges[longest] / length[longest], shapely.get_coordinates(shape.centroid)[0]
    across = np.array([along[1], -along[0]])
    upright = affinity.affine_transform(shape, [*across, *along, -across @ place, -along @ place])
    return matches([upright], 0.5)[0].kind


def kind_figures(work: LineWork, shapes: np.ndarray) -> dict[str, float]:
    """Shares of the arrows found whose kind is right, wrong, and left open."""
    found = [area for area in work.areas if area.kind.startswith("arrow")]
    tree, told = shapely.STRtree([area.polygon for area in found]), Counter()
    for shape in shapes:
        near = [(shape.intersection(found[k].polygon).area / shape.union(found[k].polygon).area, k)
                for k in tree.query(shape, predicate="intersects")]
        share, k = max(near, default=(0.0, -1))
        if share > 0.3:
            kind = found[k].kind
            told["open" if kind == UNKNOWN_ARROW else "right" if kind == true_kind(shape) else "wrong"] += 1
    return {f"arrows found, kind {name}": told[name] / max(told.total(), 1) for name in ("right", "wrong", "open")}


def _matched(name: str, truth: list, found: list, least: float) -> dict[str, float]:
    """Shares of truth found and of found that is true, by intersection over union."""
    tree, hits, real = shapely.STRtree(found), 0, set()
    for one in truth:
        for k in tree.query(one, predicate="intersects"):
            if one.intersection(found[k]).area >= least * one.union(found[k]).area:
                hits += 1
                real.add(int(k))
                break
    return {f"{name}, complete": hits / max(len(truth), 1), f"{name}, right": len(real) / max(len(found), 1),
            f"{name}, true": len(truth)}


def side_figures(built: VectorMap, shapes: np.ndarray, kinds: np.ndarray) -> dict[str, float]:
    """Length of lanes that keep to the left of the nearest true centre line, and to its right (traffic on the left)."""
    centres = shapes[np.isin(kinds, ["centre", "centre_dash"])]
    tree, sides = shapely.STRtree(centres), {True: 0.0, False: 0.0}
    for lane in built.lanes:
        line = shapely.LineString(lane.centre[:, :2])
        middle = line.interpolate(0.5, normalized=True)
        near = tree.query_nearest(middle, max_distance=12.0)
        if lane.kind != "lane" or not len(near):
            continue
        course = lane.centre[-1, :2] - lane.centre[0, :2]
        ends = shapely.get_coordinates(shapely.shortest_line(middle, centres[near[0]]))
        across = ends[1] - ends[0]
        sides[bool(course[0] * across[1] - course[1] * across[0] < 0)] += line.length
    return {"lanes on the right side of the centre line, m": sides[True], "lanes on the wrong side, m": sides[False]}


def lane_figures(built: VectorMap, city: Path) -> dict[str, float]:
    """Share of the true lanes between junctions that lie in a lane of their direction with bounds where they belong."""
    figures = {f"lanes, {kind}": count for kind, count in Counter(lane.kind for lane in built.lanes).items()}
    figures |= {f"findings, {kind}": count for kind, count in Counter(one.kind for one in built.findings).items()}
    if not (city / "truth/lanes.gpkg").is_file():
        return figures
    shapes, (left, right, driven) = read_layer(city / "truth/lanes.gpkg", "left", "right", "driven")
    areas = [built.area(number) for number in range(len(built.lanes))]
    tree = shapely.STRtree(areas)
    rows = []
    for shape, *beside in zip(shapes, left, right):
        points = sampled(shapely.force_2d(shape))
        ends = shapely.get_coordinates(shape)
        course = (ends[-1] - ends[0]) / np.linalg.norm(ends[-1] - ends[0])
        good = np.zeros(len(points), bool)
        for point, number in zip(*tree.query(points, predicate="within")):
            lane = built.lanes[number]
            chord = lane.centre[-1, :2] - lane.centre[0, :2]
            sides = [shapely.distance(points[point], shapely.LineString(built.coordinates(number, side)[:, :2]))
                     for side in ("left", "right")]
            fits = np.abs(np.subtract(sides, beside)).max() < 0.2
            good[point] |= lane.kind == "lane" and chord @ course > 0 and fits
        rows.append((good.mean(), shape.length))
    share, length = np.array(rows).T
    on = np.array(driven, bool)
    figures |= {"true lanes": len(share), "lanes right by length": (share * length).sum() / length.sum(),
                "lanes right (80 % of length)": (share >= 0.8).mean(), "true lanes on driven roads": int(on.sum()),
                "on driven roads, right by length": (share * length)[on].sum() / length[on].sum(),
                "on driven roads, right": (share[on] >= 0.8).mean()}
    inside = [area for area, lane in zip(areas, built.lanes) if lane.kind == "lane"]
    true = shapely.union_all(shapely.buffer(shapes, np.array(left) + 0.3, cap_style="square"))
    return figures | {"area of lanes beside true ones, share": float(
        shapely.union_all(inside).difference(true).area / max(shapely.union_all(inside).area, 1e-9))}


def measured_lines(given, points, ground=None):
    """Line work of polygons with the marking points' paint added, and all polygons."""
    geometries, (colours,) = read_layer(given, "colour")
    parts, owner = shapely.get_parts(shapely.force_2d(geometries), return_index=True)
    paint, names = list(parts), [colours[k] or "" for k in owner]
    drives = drive_points([Path(one) for one in points])
    survey = drive_polygons(drives)
    added = hidden_paint(paint, survey)
    work = line_work([*paint, *added], [*names, *[""] * len(added)], drives=drives)
    if ground is None:
        return work, [*paint, *survey]
    with RasterSampler(ground) as heights:
        return with_ground_heights(work, heights.sample), [*paint, *survey]


def judge(city: Path, markings: str, ground: str | None = None, points: tuple[str, ...] = (),
          drives: tuple[str, ...] = ()) -> None:
    """Print the figures of one city."""
    started = time.process_time()
    work, paint = measured_lines(markings, points, ground)
    lines_done = time.process_time()
    paths = drives or sorted((city / "truth").glob("survey_*_trajectory.csv"))
    driven = [DrivenPath(read_trajectory(Path(path)).trajectory.place) for path in paths]
    lines = [MapLine(line.points, line.kind, line.colour, line.width, line.sigma, line.chain, line.partner,
                     confidence=line.confidence, sigmas=line.sigmas)
             for line in work.lines]
    built = build_vector_map(lines, [MapArea(area.polygon, area.kind, area.heading) for area in work.areas], driven)
    done = time.process_time()
    shapes, (kinds,) = read_layer(city / "truth/markings.gpkg", "kind", layer="aerial")
    kinds = np.array(kinds)
    movements = movement_figures(built, city) if (city / "truth/lanes.gpkg").is_file() else {}
    figures = {**line_figures(work, shapes, kinds, paint), **course_figures(work, city),
               **area_figures(work, shapes, kinds),
               **lane_figures(built, city), **side_figures(built, shapes, kinds), **movements,
               "CPU s, lines": lines_done - started, "CPU s, lanes": done - lines_done,
               "CPU s a km of lines": (done - started) / (sum(line.plan.length for line in work.lines) / 1000)}
    for name, value in figures.items():
        print(f"{name:45s} {value:.3f}" if isinstance(value, float) else f"{name:45s} {value}")
