"""Facades, and what stands before them, in made fronts of one kind each, by kind.

A made vehicle scans each front (`front_scenes`); walls are found and models over the map's outline are merged with
them. A front is `good` where 90 % of its length lie within 5 cm of its facade, `wrong` where half a metre or more of it
moved onto (or fits) anything else, else `marked`: what was not decided stayed and says so. The last column is the mean
difference between what each facade says is hidden and rays to each of its cells. `--front outermost`: fronts of
balconies; `--each`: what was found of each front that is not good.
"""

from __future__ import annotations

import tempfile
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely

from scripts.front_scenes.fronts import KINDS, Front, make_front
from scripts.front_scenes.scan import (
    Survey,
    hidden_share,
    local,
    scan,
    trajectory,
    turned,
    write_survey,
)
from urbanmap_qgis.buildings.merging.merge_stage import MergedBuilding, merge_models
from urbanmap_qgis.buildings.merging.wall_match import KEPT, MOVED, measured_wall
from urbanmap_qgis.buildings.solids.plan_partition import Cell
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.facades.building_plans import building_plans
from urbanmap_qgis.facades.wall_stage import OK, PARTLY, WALL, FacadeWall, contour_area, find_walls
from urbanmap_qgis.geometry.solid import multipolygon
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.settings.buildings import MergeSettings
from urbanmap_qgis.settings.facades import MAIN, WallSettings

NEAR, STEP, SIDE = 0.05, 0.1, 0.4  # m: right; between samples; left out beside the ends and steps of the truth


@dataclass(frozen=True, eq=False)
class Trial:
    """A front, its survey, walls and merged model, and what came of it."""

    front: Front
    seed: int
    survey: Survey
    walls: list[FacadeWall]
    model: MergedBuilding
    verdict: str
    cpu: float


def trial(kind: str, seed: int, folder: Path, wanted: str = MAIN) -> Trial:
    """One front, end to end; `wanted`: the main wall, or the outermost where there are balconies."""
    front = make_front(kind, seed)
    survey = scan(front, seed)
    path = write_survey(folder / "front.laz", survey, seed)
    plan = on_map(front.outline, seed)
    model = multipolygon(building_solids([Cell(plan, 0, 20.0 + front.height)], 20.0))
    started = time.process_time()
    walls, _ = find_walls(open_cloud([path]), building_plans([model], [1]), WallSettings(front=wanted),
                          trajectory=trajectory(survey, seed))
    cpu = time.process_time() - started
    measured = [measured_wall(row, wall.contour, wall.plane.rmse, wall.plane.sigma, wall.points)
                for row, wall in enumerate(walls) if wall.status in ("ok", "partly seen")]
    measured = [wall for wall in measured if wall is not None]
    merged = merge_models([1], [model], measured, MergeSettings())[0] if measured else None
    truth = front.wall if wanted == MAIN else front.outer
    return Trial(front, seed, survey, walls, merged, verdict(front, seed, merged, truth), cpu)


def on_map(plan: shapely.Polygon, seed: int) -> shapely.Polygon:
    """A local outline on the map."""
    return shapely.transform(plan, lambda xy: turned(xy, seed))


def verdict(front: Front, seed: int, model: MergedBuilding | None, truth: list[tuple[float, float, float]]) -> str:
    """`good`, `marked` or `wrong`."""
    if model is None:
        return "marked"
    right = wrong = total = 0
    for x, y, status in samples(front, seed, model):
        true = [piece[2] for piece in truth if piece[0] + SIDE <= x <= piece[1] - SIDE]
        if not true:
            continue
        total += 1
        near = abs(y - true[0]) <= NEAR
        right += near
        wrong += status in (MOVED, KEPT) and not near
    if wrong * STEP >= 0.5:
        return "wrong"
    return "good" if right >= 0.9 * max(total, 1) else "marked"


def samples(front: Front, seed: int, model: MergedBuilding) -> list[tuple[float, float, str]]:
    """x, y and status along the model's walls that face the street."""
    found = []
    for edge in model.edges:
        ends = local(shapely.get_coordinates(edge.wall)[:2], seed)
        (x0, y0), (x1, y1) = ends[np.argsort(ends[:, 0])]
        if abs(x1 - x0) < 2 * abs(y1 - y0) or (y0 + y1) / 2 > front.depth - 2.0:
            continue
        found += [(float(x), float(np.interp(x, (x0, x1), (y0, y1))), edge.match.status)
                  for x in np.arange(x0, x1, STEP)]
    return found


def street_walls(one: Trial) -> list[FacadeWall]:
    """Facades that look towards the street."""
    def looks_there(wall: FacadeWall) -> bool:
        y = local(wall.plane.point[None] + np.array([[0, 0, 0], wall.plane.normal]), one.seed)[:, 1]
        return bool(y[1] - y[0] < -0.9)

    return [wall for wall in one.walls if wall.kind == WALL and wall.status in (OK, PARTLY) and looks_there(wall)]


def hidden_differences(one: Trial) -> list[float]:
    """Share that each of the street's walls says is hidden, less that by a ray to each of its cells."""
    places = [local(shapely.get_coordinates(wall.contour, include_z=True), one.seed) for wall in street_walls(one)]
    return [wall.seen.hidden - hidden_share(one.front, one.survey, place)
            for wall, place in zip(street_walls(one), places)]


def lines_of(one: Trial) -> list[str]:
    """What was found of a front, in words."""
    front = one.front
    lines = [f"  {front.kind} {one.seed}: {one.verdict}; outline {front.off:+.2f}, wall {front.wall}, "
             f"before {front.before}, {len(one.survey.points)} points, {one.cpu:.1f} s"]
    for wall in one.walls:
        xyz = local(shapely.get_coordinates(wall.contour, include_z=True), one.seed)
        if np.ptp(xyz[:, 0]) > np.ptp(xyz[:, 1]):
            lines.append(f"    wall y {xyz[:, 1].mean():+.3f} x {xyz[:, 0].min():.1f}..{xyz[:, 0].max():.1f} "
                         f"z {xyz[:, 2].min():.1f}..{xyz[:, 2].max():.1f} {wall.status} "
                         f"{contour_area(wall.plane, wall.contour):.0f} m2 {wall.note}")
    for edge in one.model.edges if one.model else ():
        ends = local(shapely.get_coordinates(edge.wall)[:2], one.seed)
        if np.ptp(ends[:, 0]) > np.ptp(ends[:, 1]) and ends[:, 1].mean() < front.depth - 2.0:
            match = edge.match
            lines.append(f"    edge {ends.round(2).tolist()} {match.status} {match.offset:.2f} {match.note}")
    return lines


def judge(seeds: tuple[int, ...] = (1, 2, 3, 4, 5), kinds: tuple[str, ...] = tuple(KINDS), front: str = MAIN,
          each: bool = False) -> None:
    """Print a row a kind."""
    total, cpu, hidden = Counter(), 0.0, []
    print(f"{'kind':26s}  good marked wrong   CPU  hidden")
    for kind in kinds:
        with tempfile.TemporaryDirectory() as folder:
            trials = [trial(kind, seed, Path(folder), front) for seed in seeds]
        counts = Counter(one.verdict for one in trials)
        total.update(counts)
        cpu += sum(one.cpu for one in trials)
        differences = np.abs([value for one in trials for value in hidden_differences(one)])
        hidden.append(differences)
        print(f"{kind:26s} {counts['good']:5d} {counts['marked']:6d} {counts['wrong']:5d} "
              f"{sum(one.cpu for one in trials):5.1f} {_mean(differences)}", flush=True)
        if each:
            print("\n".join(line for one in trials if one.verdict != "good" for line in lines_of(one)))
    print(f"{'all':26s} {total['good']:5d} {total['marked']:6d} {total['wrong']:5d} {cpu:5.1f} "
          f"{_mean(np.concatenate(hidden))}")


def _mean(values: np.ndarray) -> str:
    return f"{values.mean():7.3f}" if len(values) else "       "
