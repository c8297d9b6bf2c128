"""A drive with vehicle-borne line scanners and a line camera (Z 2.1): raw range scans, strip image, tie points.

Beams and pixels follow the conventions of design: a beam at angle a points along (cos a, sin a, 0) in the scanner's
axes. With the scanner pitched by -90 degrees, angle 0 looks down and 90 to the right (Z eq. 1 counts likewise).
"""

from __future__ import annotations

import gzip
import json
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import shapely

from ...progress import Progress
from ...wording import say
from ..laser.raycast import RayCaster
from ..scene.model import GROUND
from ..scene.world import SURVEY_TIMES, Scene
from .control import first_sweep, visible_sightings
from .line_camera import NOISE, SimulatedLineCamera, seen_colours
from .motion import RUN_IN, chainage_over_time, corner_path, drive, survey_lanes
from .navigation_error import reported_trajectory
from .scanner import Response, SimulatedScanner, simulate_scans
from .trajectory import SimulatedTrajectory, carried_over

LINES_TIME = SURVEY_TIMES[1] + 3600.0
"""GPS seconds at which the drive starts."""

CRUISE = 8.0
"""m/s."""

MEAN_ERROR, HEADING_ERROR = 1.2, 0.25
"""Of the reported trajectory: mean horizontal error (m) and standard deviation of the heading (degrees)."""

FAN = np.linspace(-150.0, 150.0, 480)
SCANNERS = tuple(
    SimulatedScanner(number, name, lever_arm, 0.0, -90.0, heading, Response(4.0e5, 1.5, 0.8, 120.0, 40.0), FAN,
                     scan_hz=20.0, sweep=300.0 / 360.0, max_range=100.0, min_range=1.0, range_noise=0.03)
    for number, name, lever_arm, heading in ((1, "LD left", (0.4, -0.5, -0.4), 45.0),
                                             (2, "LD right", (0.4, 0.5, -0.4), -45.0)))
CAMERA = SimulatedLineCamera(1, "line left", (-0.6, -0.6, -0.5), 0.0, 0.0, -90.0, 640, 270.0, 319.5, 50.0)

TIE_HEIGHT, TIE_RANGE = 1.0, 30.0
"""Corners of buildings are measured this far above the ground, and up to this range, m."""

TIE_SECONDS, TIE_SPACING = 4.0, 4.0
"""The two corners of a set are seen within this time (s) and lie at least this far apart (m)."""

PICKING = 0.03
"""Noise of the picked tie points, m."""

CAMERA_RANGE = 100.0
"""What the camera sees farther away is sky, m."""

SCANS_AT_ONCE, LINES_AT_ONCE = 68, 204
"""As many as make whole portions of rays for the ray caster; bounds the memory."""


def write_lines(scene: Scene, folder: Path, seed: np.random.SeedSequence, progress: Progress) -> dict:
    """Drive once with line scanners and line camera; write `lines/` and its truth to `truth/` in the city's folder.

    Returns the number of ranges, of lines of the image, and of sets of tie points.
    """
    for name in ("lines", "truth"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    target = folder / "lines"
    drive_rng, error_rng, beam_rng, image_rng, tie_rng = (
        np.random.default_rng(np.random.SeedSequence(seed.entropy, spawn_key=(*seed.spawn_key, use)))
        for use in range(5))
    caster = RayCaster(scene, GROUND)
    path = corner_path(*survey_lanes(scene)[0], scene.size / 2 + RUN_IN)
    true = drive(scene, path, chainage_over_time(path, CRUISE, ()), LINES_TIME, drive_rng)
    reported = reported_trajectory(true, error_rng, MEAN_ERROR, HEADING_ERROR)
    true.write(folder / "truth" / "lines_trajectory.csv")
    reported.write(target / "trajectory.csv")
    _write_calibration(target / "calibration.json")
    progress.message(say("Line scanners"))
    ranges = _write_scans(target / "scans.csv.gz", raw_scans(scene, caster, true, beam_rng, progress.part(0.0, 0.4)))
    progress.message(say("Line camera"))
    times, strip = photograph(scene, caster, true, image_rng, progress.part(0.4, 1.0))
    _write_strip(target / "camera_1.png", target / "camera_1_times.csv", times, strip)
    exact = tie_points(scene, caster, true, reported)
    picked = exact.copy()
    picked[:, 2:4] += PICKING * tie_rng.standard_normal(exact[:, 2:4].shape)
    _write_ties(folder / "truth" / "lines_tie_points.csv", exact)
    _write_ties(target / "tie_points.csv", picked)
    return {"ranges": ranges, "lines": len(times), "tie_point_sets": len(exact) // 2}


def raw_scans(scene: Scene, caster: RayCaster, true: SimulatedTrajectory, rng: np.random.Generator,
              progress: Progress) -> Iterator[np.ndarray]:
    """Raw measurements (n, 5): time, angle, range, intensity, scanner; in the order of time."""
    scans = SCANNERS[0].scan_times(true.time[0], true.time[-1])
    for first in range(0, len(scans), SCANS_AT_ONCE):
        progress.step(first / len(scans))
        parts = []
        for scanner in SCANNERS:
            found = simulate_scans(scene, caster, scanner, scans[first:first + SCANS_AT_ONCE], true, rng)
            parts.append(np.column_stack([found.time, scanner.angles[found.beam], found.distance, found.intensity,
                                          np.full(len(found.time), scanner.id)]))
        both = np.concatenate(parts)
        yield both[np.argsort(both[:, 0], kind="stable")]


def photograph(scene: Scene, caster: RayCaster, true: SimulatedTrajectory, rng: np.random.Generator,
               progress: Progress) -> tuple[np.ndarray, np.ndarray]:
    """Times (n,) of the lines and the strip image (rows, n, 3) uint8 of the line camera."""
    count = int((true.time[-1] - true.time[0]) * CAMERA.lines_hz)
    times = np.round(true.time[0] + np.arange(count) / CAMERA.lines_hz, 6)
    strip = np.empty((CAMERA.rows, count, 3), np.uint8)
    for first in range(0, count, LINES_AT_ONCE):
        progress.step(first / count)
        some = times[first:first + LINES_AT_ONCE]
        origin, direction = CAMERA.rays(true, some)
        leaf = rng.exponential(size=len(origin))
        hits = caster.cast(origin, direction, np.repeat(some, CAMERA.rows), CAMERA_RANGE, leaf)
        length = np.where(np.isfinite(hits.distance), hits.distance, 0.0)
        colour = seen_colours(scene, GROUND, origin + length[:, None] * direction, hits)
        colour += NOISE * rng.standard_normal(colour.shape)
        lines = np.clip(np.round(colour), 0, 255).astype(np.uint8).reshape(len(some), CAMERA.rows, 3)
        strip[:, first:first + len(some)] = lines.swapaxes(0, 1)
    return times, strip


def tie_points(scene: Scene, caster: RayCaster, true: SimulatedTrajectory, reported: SimulatedTrajectory) -> np.ndarray:
    """Sets of two building corners (n, 6): set, time, x and y in the survey, x and y in truth (Z 3.2)."""
    corners = _building_corners(scene)
    found = []
    for scanner in SCANNERS:
        sightings = first_sweep(corners, true, scanner, TIE_RANGE)
        place, rotation = true.interpolate(sightings.time)
        origin = place + rotation @ np.array(scanner.lever_arm)
        vector = corners[sightings.number] - origin
        distance = np.linalg.norm(vector, axis=1)
        hits = caster.cast(origin, vector / distance[:, None], sightings.time, scanner.max_range)
        # A beam to the very edge may pass it: nothing nearer is enough.
        clear = visible_sightings(sightings, hits.distance > distance - 0.05)
        found += zip(clear.time, clear.number)
    found.sort()
    time = np.round(np.array([t for t, _ in found]), 6)
    place = corners[np.array([number for _, number in found], int)].reshape(-1, 3)
    shown = carried_over(place, time, true, reported)
    rows, first = [], 0
    for second in range(1, len(time)):
        if time[second] - time[first] > TIE_SECONDS:
            first = second
        elif np.hypot(*(place[second] - place[first])[:2]) >= TIE_SPACING:
            number = len(rows) // 2 + 1
            rows += [[number, time[i], *shown[i, :2], *place[i, :2]] for i in (first, second)]
            first = second
    return np.array(rows).reshape(-1, 6)


def _building_corners(scene: Scene) -> np.ndarray:
    """Outer corners (n, 3) of the buildings that stand free, `TIE_HEIGHT` above the ground."""
    outlines = shapely.union_all([building.outline.buffer(1e-3, join_style="mitre") for building in scene.buildings])
    corners = []
    for outline in shapely.get_parts(outlines):
        ring = shapely.get_coordinates(shapely.simplify(outline.exterior, 0.05))[:-1]
        before, after = ring - np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0) - ring
        bend = np.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1))
        sense = 1.0 if shapely.is_ccw(outline.exterior) else -1.0
        corners.append(ring[sense * bend > np.radians(60.0)])
    x, y = np.concatenate(corners).T
    return np.column_stack([x, y, scene.ground_height(x, y) + TIE_HEIGHT])


def _write_scans(path: Path, pieces: Iterator[np.ndarray]) -> int:
    """Write CSV time,angle,range,intensity,scanner (s, degrees, m), compressed; return the number of rows."""
    count = 0
    with path.open("wb") as raw, gzip.GzipFile("", "wb", 4, raw, mtime=0) as packed:
        packed.write(b"time,angle,range,intensity,scanner\n")
        for piece in pieces:
            text = ("%.6f,%.4f,%.3f,%d,%d\n" * len(piece)) % tuple(piece.ravel().tolist())
            packed.write(text.encode("ascii"))
            count += len(piece)
    return count


def _write_strip(path: Path, table: Path, times: np.ndarray, strip: np.ndarray) -> None:
    """Write the strip image as PNG and the time of each of its columns as CSV column,time."""
    path.write_bytes(cv2.imencode(".png", cv2.cvtColor(strip, cv2.COLOR_RGB2BGR))[1].tobytes())
    np.savetxt(table, np.column_stack([np.arange(len(times)), times]), "%d,%.6f", header="column,time", comments="")


def _write_ties(path: Path, rows: np.ndarray) -> None:
    np.savetxt(path, rows, "%d,%.6f,%.4f,%.4f,%.4f,%.4f", header="set,time,x_mms,y_mms,x_ref,y_ref", comments="")


def _write_calibration(path: Path) -> None:
    calibration = {
        "body": "x forward, y right, z down; the trajectory gives the body's origin",
        "rotation": "body to north, east, down: Rz(heading) Ry(pitch) Rx(roll), right-hand",
        "beam": "beam at angle a in the scanner's axes: (cos a, sin a, 0)",
        "pixel": "row h in the camera's axes: (cos w, 0, sin w), w = 2 asin((h - centre_px) / 2 / focal_length_px)",
        "scanners": [scanner.calibration() for scanner in SCANNERS],
        "cameras": [{**CAMERA.calibration(), "image": "camera_1.png", "times": "camera_1_times.csv"}],
    }
    path.write_text(json.dumps(calibration, indent=1) + "\n")
