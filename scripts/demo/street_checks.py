"""Measures the demo's street-level results against the sample city's truth.

As in `demo_checks`, only files are read and geometry is written anew: nothing of the code that made them is used.
"""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import shapely

from scripts.demo.checks import Figure, overlap, true_outlines
from scripts.layers import read_layer

FACING = np.cos(np.radians(20.0))
"""A wall belongs to a true one when their directions differ by less than 20 degrees."""

NEAR = 1.5
"""And when they lie less than this apart, m."""


def poses(path: Path) -> np.ndarray:
    """Rows (n, 7) of a trajectory: time, x, y, z, roll, pitch, heading (degrees, without jumps of a full turn)."""
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    table[:, 4:] = np.unwrap(table[:, 4:], axis=0, period=360.0)
    return table


def at(trajectory: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Poses (m, 6) at times, linear between epochs."""
    return np.column_stack([np.interp(time, trajectory[:, 0], column) for column in trajectory[:, 1:].T])


def turn(angles: np.ndarray) -> np.ndarray:
    """Matrices (n, 3, 3) from forward, right, down to east, north, up: Rz(heading) Ry(pitch) Rx(roll)."""
    matrices = []
    for roll, pitch, heading in np.radians(angles):
        about_x = np.array([[1, 0, 0], [0, np.cos(roll), -np.sin(roll)], [0, np.sin(roll), np.cos(roll)]])
        about_y = np.array([[np.cos(pitch), 0, np.sin(pitch)], [0, 1, 0], [-np.sin(pitch), 0, np.cos(pitch)]])
        about_z = np.array([[np.cos(heading), -np.sin(heading), 0], [np.sin(heading), np.cos(heading), 0], [0, 0, 1]])
        matrices.append(np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]]) @ about_z @ about_y @ about_x)
    return np.array(matrices)


def moved(places: np.ndarray, time: np.ndarray, before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Places (n, 3) of one trajectory as another one puts them."""
    first, second = at(before, time), at(after, time)
    body = np.einsum("nji,nj->ni", turn(first[:, 3:]), places - first[:, :3])
    return second[:, :3] + np.einsum("nij,nj->ni", turn(second[:, 3:]), body)


def registered_survey(folder: Path) -> list[Figure]:
    """Control points of the first mobile survey before and after its registration to the markings."""
    city = folder / "city"
    with open(city / "truth/control_survey_01.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    true, measured = (np.array([[float(row[name]) for name in names] for row in rows])
                      for names in (("x", "y", "z"), ("x_mms", "y_mms", "z_mms")))
    time = np.array([float(row["time"]) for row in rows])
    after = moved(measured, time, poses(city / "mms/survey_01_trajectory.csv"),
                  poses(folder / "survey_01_trajectory.csv"))
    figures = []
    for name, places in (("before", measured), ("after", after)):
        plan, space = np.linalg.norm((places - true)[:, :2], axis=1), np.linalg.norm(places - true, axis=1)
        figures += [Figure(f"control points {name}, mean distance in plan", float(plan.mean()), "{:.3f} m"),
                    Figure(f"control points {name}, greatest in plan", float(plan.max()), "{:.3f} m"),
                    Figure(f"control points {name}, mean in space", float(space.mean()), "{:.3f} m")]
    return figures


def rectified_trajectory(folder: Path) -> list[Figure]:
    """The line scanners' trajectory before and after its rectification by tie points."""
    city = folder / "city"
    true = poses(city / "truth/lines_trajectory.csv")
    figures = []
    for name, path in (("before", city / "lines/trajectory.csv"), ("after", folder / "lines_trajectory.csv")):
        found = poses(path)
        off = found[:, 1:4] - at(true, found[:, 0])[:, :3]
        figures += [Figure(f"epochs {name}, mean distance in plan", float(np.hypot(off[:, 0], off[:, 1]).mean()),
                           "{:.3f} m"),
                    Figure(f"epochs {name}, mean height error", float(np.abs(off[:, 2]).mean()), "{:.3f} m")]
    return figures


def true_walls(city: Path) -> tuple[np.ndarray, np.ndarray]:
    """Feet of the true walls: starts and ends (n, 2) each."""
    lines, _ = read_layer(city / "truth/roofs.gpkg", layer="wall_lines")
    ends = np.array([shapely.get_coordinates(shapely.force_2d(line))[[0, -1]] for line in lines])
    return ends[:, 0], ends[:, 1]


def distance_to_walls(middle: np.ndarray, direction: np.ndarray, walls: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Distance (n,) of walls with the given middles and directions (n, 2) from the line of the nearest true wall.

    NaN where no true wall of the same direction is near.
    """
    start, end = walls
    length = np.linalg.norm(end - start, axis=1)
    along = (end - start) / np.maximum(length, 1e-9)[:, None]
    off = middle[:, None, :] - start[None]
    way = np.einsum("nmi,mi->nm", off, along)
    across = off[..., 0] * along[None, :, 1] - off[..., 1] * along[None, :, 0]
    fits = (np.abs(direction @ along.T) > FACING) & (way > -0.5) & (way < length + 0.5) & (np.abs(across) < NEAR)
    distance = np.where(fits, np.abs(across), np.inf).min(axis=1)
    return np.where(np.isfinite(distance), distance, np.nan)


def measured_walls(folder: Path) -> list[Figure]:
    """Walls measured by the corrected mobile survey against the true ones."""
    walls, (areas,) = read_layer(folder / "walls.gpkg", "area")
    boxes = [shapely.minimum_rotated_rectangle(shapely.force_2d(wall).buffer(0.001)) for wall in walls]
    sides = [max(zip(shapely.get_coordinates(box)[:-1], shapely.get_coordinates(box)[1:]),
                 key=lambda side: np.hypot(*(side[1] - side[0]))) for box in boxes]
    direction = np.array([(end - start) / np.hypot(*(end - start)) for start, end in sides])
    # An upright wall has no area in plan: its centroid would be of rounding.
    middle = np.array([shapely.get_coordinates(box)[:4].mean(axis=0) for box in boxes])
    off = distance_to_walls(middle, direction, true_walls(folder / "city"))
    areas = np.array(areas, float)
    known = np.isfinite(off)
    return [Figure("measured walls that are true walls, share of area", float(areas[known].sum() / areas.sum()),
                   "{:.0%}"),
            Figure("their distance from the true plane, median by area",
                   float(np.sort(off[known])[np.searchsorted(np.cumsum(areas[known][np.argsort(off[known])]),
                                                             areas[known].sum() / 2)]), "{:.3f} m"),
            Figure("share of them within 5 cm of it", float(areas[known][off[known] < 0.05].sum() / areas[known].sum()),
                   "{:.0%}")]


def merged_models(folder: Path) -> list[Figure]:
    """Models whose lower walls were moved: are they closed, and how well do their feet fit the true outlines."""
    true = true_outlines(folder / "city")
    number_of = json.loads((folder / "city/truth/gsi_to_building.json").read_text(encoding="utf-8"))
    _, (ids, names) = read_layer(folder / "outlines.gpkg", "building_id", "gml_id")
    of = {number: number_of[name] for number, name in zip(ids, names)}
    figures, feet = [], {}
    for name in ("models", "merged"):
        shapes, (numbers, status) = read_layer(folder / f"{name}.gpkg", "building_id", "status")
        feet[name] = {number: foot(shape) for number, shape in zip(numbers, shapes)}
        if name == "merged":
            merged = [number for number, word in zip(numbers, status) if word == "merged"]
            figures.append(Figure("merged models, closed", float(np.mean([is_closed(shape) for shape in shapes])),
                                  "{:.0%}"))
    figures.insert(0, Figure("buildings with moved walls", len(merged), "{:.0f}"))
    for name, what in (("models", "before"), ("merged", "after")):
        fits = [overlap(true[of[number]], feet[name][number]) for number in merged]
        figures.append(Figure(f"overlap of their feet with the true outlines {what}", float(np.mean(fits)), "{:.3f}"))
    return figures


def foot(shape: shapely.Geometry) -> shapely.Geometry:
    """Plan of the lowest faces of a model."""
    faces = shapely.get_parts(shape)
    lowest = np.array([shapely.get_coordinates(face, include_z=True)[:, 2].max() for face in faces])
    return shapely.union_all(shapely.force_2d(faces[lowest < lowest.min() + 0.01]))


def is_closed(shape: shapely.Geometry) -> bool:
    """Whether every edge of a model's faces is met as often in one sense as in the other."""
    balance: dict[tuple, int] = {}
    for ring in shapely.get_rings(shapely.get_parts(shape)):
        millimetres = np.rint(shapely.get_coordinates(ring, include_z=True) * 1000).astype(int)
        corners = [tuple(corner) for corner in millimetres]
        for a, b in zip(corners, corners[1:]):
            balance[min((a, b), (b, a))] = balance.get(min((a, b), (b, a)), 0) + (1 if a < b else -1)
    return not any(balance.values())


def adjusted_walls(folder: Path) -> list[Figure]:
    """Walls that were moved by GNSS reflections against the true offsets of the delivered models."""
    with open(folder / "city/truth/wall_offsets.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["z_low"]]
    start, end, normal = (np.array([[float(row[name]) for name in names] for row in rows])
                          for names in (("x0", "y0"), ("x1", "y1"), ("nx", "ny")))
    true = np.array([float(row["offset"]) for row in rows])
    lines, (offsets, statuses, applied) = read_layer(folder / "adjusted_walls.gpkg", "offset", "status", "applied")
    pairs = []
    for line, offset, status, move in zip(lines, offsets, statuses, applied):
        if status == "adjusted":
            row = delivered_wall(shapely.get_coordinates(shapely.force_2d(line)), move, start, end, normal)
            pairs.append((true[row], offset))
    if not pairs:
        return [Figure("walls adjusted", 0, "{:.0f}")]
    before, found = np.array(pairs).T
    return [Figure("walls adjusted", len(pairs), "{:.0f}"),
            Figure("their offset as delivered, RMS", float(np.sqrt(np.mean(before**2))), "{:.2f} m"),
            Figure("their offset after the adjustment, RMS", float(np.sqrt(np.mean((found - before) ** 2))),
                   "{:.2f} m")]


def delivered_wall(line: np.ndarray, move: float, start: np.ndarray, end: np.ndarray, normal: np.ndarray) -> int:
    """Row of the delivered wall, of those from `start` to `end` (n, 2), that stands at a line moved by `move` m."""
    middle, direction = line.mean(axis=0), (line[-1] - line[0]) / np.linalg.norm(line[-1] - line[0])
    off = np.abs(np.einsum("ni,ni->n", middle - start, normal) - move)
    along = (end - start) / np.linalg.norm(end - start, axis=1)[:, None]
    way = np.einsum("ni,ni->n", middle - start, along)
    beside = np.maximum(np.maximum(-way, way - np.linalg.norm(end - start, axis=1)), 0.0)
    turned = 100.0 * (np.abs(along @ direction) < FACING)
    return int(np.argmin(off + beside + turned))


def textured_model(folder: Path) -> list[Figure]:
    """What is in the textured model, and the images it names."""
    content = json.loads((folder / "textured/model.city.json").read_text(encoding="utf-8"))
    images = [texture["image"] for texture in content["appearance"]["textures"]]
    there = sum((folder / "textured" / name).is_file() for name in images)
    _, (seen, areas) = read_layer(folder / "facades.gpkg", "seen", "area")
    street = np.array(seen, float) > 0
    return [Figure("facades with a texture", float(street.sum()), "{:.0f}"),
            Figure("images that the model names and that are there", there / max(len(images), 1), "{:.0%}"),
            Figure("share of these facades that images show",
                   float(np.average(np.array(seen)[street], weights=np.array(areas)[street])), "{:.0%}")]
