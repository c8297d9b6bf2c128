"""Street objects against the truth of a sample city: what `streetobjects` reaches.

CITY is a sample city, whose scene is made anew from truth/summary.json. SURVEY and DRIVE are a corrected survey and its
trajectory, SIGMA what is said of its accuracy. What counts is what stands within the half width of the path and
was measured with 20 points at least. Each true thing has one found thing at most: those that stand close together are
not held against each other.
"""

from __future__ import annotations

import json
import time
from collections import Counter
from pathlib import Path

import laspy
import numpy as np
import shapely
from scipy.optimize import linear_sum_assignment
from scipy.spatial import cKDTree

from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.roadmap.objects.object_records import MEASURED
from urbanmap_qgis.roadmap.objects.street_objects import street_objects
from urbanmap_qgis.samplecity.scene.world import Scene, make_scene
from urbanmap_qgis.settings.roadmap import ObjectSettings

TALL, NEAR, SEEN, AROUND = 2.5, 0.05, 20, 0.25  # m, m, points, m
CABINET = (0.4, 0.9)  # m, sides of a cabinet
MATCH = 0.5  # m: what is found farther from anything true is false


def scene_of(city: Path) -> Scene:
    """The scene of a sample city's folder."""
    made = json.loads((city / "truth" / "summary.json").read_text())
    return make_scene(made["size"], made["scene"], made["seed"], made.get("faults", ()))


def true_things(scene: Scene) -> dict[str, np.ndarray]:
    """Rows by kind: posts, trunks and bollards x, y, diameter, height; cabinets x, y, length, height;
    boards x, y, z of the middle, azimuth, area."""
    trunks = np.array([[tree.x, tree.y, tree.trunk, tree.z + tree.radius_z - tree.z_ground] for tree in scene.trees])
    posts, bollards, cabinets, boards = [], [], [], []
    for thing in scene.furniture:
        corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(thing.plan))[:4]
        sides = np.hypot(*(np.roll(corners, -1, axis=0) - corners).T)[:2]
        x, y = shapely.get_coordinates(thing.plan.centroid)[0]
        ground = float(scene.ground_height(x, y))
        standing = thing.z_low < ground
        if standing and max(sides) < 0.3 and not (len(trunks) and np.hypot(*(trunks[:, :2] - (x, y)).T).min() < 0.01):
            (posts if thing.z_high - ground > TALL - 1.0 else bollards).append(
                [x, y, max(sides), thing.z_high - ground])
        if standing and np.allclose(sorted(sides), CABINET, atol=0.01):
            cabinets.append([x, y, max(sides), thing.z_high - ground])
        if not standing and min(sides) < 0.05 < 0.25 < max(sides):
            long = (corners[1] - corners[0]) if sides[0] > sides[1] else (corners[2] - corners[1])
            azimuth = np.degrees(np.arctan2(-long[1], long[0])) % 180.0
            boards.append([x, y, (thing.z_low + thing.z_high) / 2, azimuth, max(sides) * (thing.z_high - thing.z_low)])
    return {"post": np.array(posts), "tree": trunks, "bollard": np.array(bollards).reshape(-1, 4),
            "cabinet": np.array(cabinets).reshape(-1, 4), "board": np.array(boards).reshape(-1, 5)}


def shown(rows: np.ndarray, path: cKDTree, width: float, points: np.ndarray, scene: Scene, low: float,
          most: float) -> np.ndarray:
    """Rows within the half width with enough points of what stands (n, 3) between two heights over the ground."""
    if not len(rows):
        return rows
    rows = rows[path.query(rows[:, :2])[0] < width]
    tree = cKDTree(points[:, :2])
    kept = []
    for row in rows:
        near = points[tree.query_ball_point(row[:2], row[2] / 2 + 0.1)]
        up = near[:, 2] - float(scene.ground_height(*row[:2]))
        kept.append(np.count_nonzero((up > low) & (up < most)) >= SEEN)
    return rows[np.array(kept, bool)]


def matched(rows: np.ndarray, every: np.ndarray, feet: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance (n,) of rows (n, 2) to their own found foot, infinite without one, and its number.

    Feet are shared out among all true things, each to one, so that as many as can be have one near.
    """
    cost = np.minimum(np.linalg.norm(every[:, None] - feet[None], axis=2), 2.0 * MATCH)
    own = dict(zip(*(side.tolist() for side in linear_sum_assignment(cost))))
    at = np.array([own.get(int(np.argmin(np.linalg.norm(every - row, axis=1))), -1) for row in rows])
    off = np.where(at >= 0, np.linalg.norm(rows - feet[at], axis=1), np.inf)
    return np.where(off < MATCH, off, np.inf), at


def judge(city: Path, survey: Path, drive: Path, sigma: float = 0.01) -> None:
    """Print the figures."""
    settings = ObjectSettings(survey_sigma=sigma)
    trajectory = read_trajectory(drive).trajectory
    start = time.process_time()
    found = street_objects([survey], trajectory, settings)
    spent = time.process_time() - start
    print(f"{found.path_length:.0f} m, {found.points_read / 1e6:.1f} million points: {spent:.1f} s of CPU, "
          f"{1000 * spent / found.path_length:.0f} s a kilometre; {dict(Counter(t.kind for t in found.objects))}")
    scene = scene_of(city)
    truth = true_things(scene)
    cloud = laspy.read(survey)
    points = np.column_stack([cloud.x, cloud.y, cloud.z])
    path = cKDTree(trajectory.place[:, :2])
    width = settings.width - 0.2
    # Of things there is a foot where they begin: what a survey shows only above that is measured, not counted on.
    posts = truth["post"][truth["post"][:, 3] > TALL]
    groups = {"posts over 2.5 m": shown(posts, path, width, points, scene, 0.3, 3.0),
              "trees": shown(truth["tree"], path, width, points, scene, 0.3, 2.5),
              "bollards": shown(truth["bollard"], path, width, points, scene, 0.2, 1.0),
              "cabinets": shown(truth["cabinet"], path, width, points, scene, 0.2, 1.4)}
    feet = np.array([thing.foot for thing in found.objects]).reshape(-1, 3)
    sigmas = np.array([thing.sigma for thing in found.objects])
    measured = np.array([thing.status == MEASURED for thing in found.objects], bool)
    tree = cKDTree(feet[:, :2]) if len(feet) else None
    every = np.concatenate([truth[name][:, :2] for name in ("post", "tree", "bollard", "cabinet")])
    for name, rows in groups.items():
        if not len(rows) or tree is None:
            print(f"{name}: {len(rows)} true")
            continue
        off, at = matched(rows[:, :2], every, feet[:, :2])
        hit = off < MATCH
        sure = hit & measured[at]
        delta = np.abs(feet[at, :2] - rows[:, :2])[sure]
        print(f"{name}: {len(rows)} true, found {hit.mean():.1%}, within 5 cm {np.mean(off < NEAR):.1%}, measured "
              f"{sure.mean():.1%}; each axis RMS {100 * np.sqrt(np.mean(delta**2)):.1f} cm, within two sigma "
              f"{np.mean(delta < 2 * sigmas[at][sure][:, None]):.1%}")
        for row in rows[off >= NEAR]:
            d, k = tree.query(row[:2])
            thing = found.objects[k]
            print(f"   missed {row.round(2).tolist()}: nearest {thing.kind} at {d:.2f} m, {thing.status} "
                  f"{thing.reason}")
    for name in ("all", MEASURED):
        rows = feet[measured if name == MEASURED else slice(None)]
        false = cKDTree(every).query(rows[:, :2])[0] > MATCH
        print(f"{name}: {len(rows)}, false {false.mean():.1%}")
    for kind in sorted({thing.standing for thing in scene.furniture if thing.standing}):
        rows = [shapely.get_coordinates(thing.plan.centroid)[0] for thing in scene.furniture if thing.standing == kind]
        rows = shown(np.column_stack([rows, np.full((len(rows), 1), 0.2)]), path, width, points, scene, 0.3, 3.0)
        off, at = cKDTree(feet[:, :2]).query(rows[:, :2])
        called = [f"{found.objects[k].kind} {found.objects[k].confidence:.2f}" for k in at[off < MATCH]]
        print(f"{kind}: {len(rows)} true, called {dict(Counter(text.rsplit(' ', 1)[0] for text in called))}: {called}")
    print_boards(found.objects, truth["board"], path, width, points)


def print_boards(objects: list, boards: np.ndarray, path: cKDTree, width: float, points: np.ndarray) -> None:
    """Middles and azimuths of boards over 0.3 m2."""
    rows = boards[boards[:, 4] > 0.3] if len(boards) else boards
    if len(rows):
        tree = cKDTree(points)
        rows = rows[(path.query(rows[:, :2])[0] < width)
                    & [len(near) >= SEEN for near in tree.query_ball_point(rows[:, :3], 0.3)]]
    made = [thing.board for thing in objects if thing.board is not None]
    if not len(rows) or not made:
        print(f"boards: {len(rows)} true, {len(made)} found")
        return
    middles = np.array([board.centre for board in made])
    off, at = cKDTree(middles).query(rows[:, :3])
    turned = np.abs((np.array([board.azimuth for board in made])[at] - rows[:, 3] + 90.0) % 180.0 - 90.0)
    false = cKDTree(boards[:, :3]).query(middles)[0] > MATCH
    print(f"boards over 0.3 m2: {len(rows)} true, found {np.mean(off < MATCH):.1%}, within 10 cm "
          f"{np.mean(off < 0.10):.1%}, and within 5 degrees {np.mean((off < 0.10) & (turned < 5.0)):.1%}; "
          f"{len(made)} found, {false.mean():.1%} false")
    for row, distance, turn in zip(rows, off, turned):
        if distance >= 0.10 or turn >= 5.0:
            print(f"   missed board {row.round(2).tolist()}: {distance:.2f} m, {turn:.1f} degrees")
