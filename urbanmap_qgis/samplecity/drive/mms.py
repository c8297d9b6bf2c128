"""Two mobile surveys: points of two line scanners, placed with trajectories that are about a metre wrong (J 3.2.3).

The vehicle carries two scanners of 180 degrees that look up and down ahead of it (J table 3-1).
"""

from __future__ import annotations

import datetime
import json
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from pathlib import Path

import laspy
import numpy as np
import pyproj

from ...progress import Progress
from ...wording import say
from ..faults import fault_rng, ghost_rows, laser_answers, laser_of, step_along
from ..laser.raycast import RayCaster
from ..scene.model import GROUND, Material
from ..scene.world import CRS, SURVEY_TIMES, Scene
from .control import MarkingCorners, Sightings, first_sweep, marking_corners, visible_sightings, write_control
from .motion import survey_drive
from .navigation_error import reported_trajectory
from .scanner import Response, Returns, SimulatedScanner, simulate_scans
from .trajectory import FIELDS, SimulatedTrajectory, mounting

FAN = np.linspace(-90.0, 90.0, 361)
SCANNERS = (
    SimulatedScanner(1, "CH1 front/down", (0.95, 0.12, -0.32), 0.15, -25.12, -0.18,
                     Response(gain=6.2e5, fall=1.3, tilt=0.6, floor=250.0, threshold=60.0), FAN),
    SimulatedScanner(2, "CH2 front/up", (0.93, -0.14, -0.45), -0.08, 24.91, 0.22,
                     Response(gain=9.0e5, fall=1.7, tilt=0.9, floor=180.0, threshold=45.0), FAN),
)
CAMERA = {"id": "front", "lever_arm_m": [1.05, 0.0, -0.25], "roll": 0.0, "pitch": 0.0, "heading": 0.0}

IMAGE_SPACING = 5.0  # Way between two images, m.
SCANS_AT_ONCE = 90  # Scans of each scanner worked on at once; bounds the memory.
# Below this speed (m/s) the vehicle waits and only one scan in so many is recorded.
WAITING_SPEED = 0.1
WAITING_SCANS = 8

LABELS = {Material.ASPHALT: 1, Material.PAINT_WHITE: 2, Material.PAINT_YELLOW: 2, Material.PAVEMENT: 3,
          Material.PLOT: 3, Material.FACADE: 4, Material.GLASS: 5, Material.ROOF: 4, Material.PARAPET: 4,
          Material.STRUCTURE: 4, Material.VEHICLE: 6, Material.FOLIAGE: 7, Material.WOOD: 8, Material.METAL: 8,
          Material.BRIDGE: 9}
LABEL_NAMES = ("", "asphalt", "paint", "other ground", "facade", "glass", "vehicle", "foliage", "furniture", "bridge")
_LABEL = np.zeros(max(LABELS) + 1, np.uint8)
_LABEL[list(LABELS)] = list(LABELS.values())


@dataclass(frozen=True)
class Points:
    """Measured points, in arrays (n,).

    `place` (n, 3) lies on the reported trajectory, m; `time` in GPS seconds; `angle` in the scan, degrees; `label`
    (`LABEL_NAMES`; 0 of a ghost) and `ground` (0 or 1) are the truth. `laser` is the number of the laser, None where
    all are alike.
    """

    place: np.ndarray
    time: np.ndarray
    intensity: np.ndarray
    scanner: np.ndarray
    angle: np.ndarray
    ground: np.ndarray
    label: np.ndarray
    laser: np.ndarray | None = None


def write_mms(scene: Scene, folder: Path, seed: np.random.SeedSequence, progress: Progress) -> dict:
    """Drive and measure both surveys; write `mms/` and their truth to `truth/` within the city's folder.

    Returns the number of points and control points, and the mean and greatest horizontal error, of each survey.
    """
    for name in ("mms", "truth"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    _write_calibration(folder / "mms" / "calibration.json")
    corners = marking_corners(scene)
    caster = RayCaster(scene, GROUND)
    summary = {}
    for number, start in enumerate(SURVEY_TIMES):
        part = progress.part(number / len(SURVEY_TIMES), (number + 1) / len(SURVEY_TIMES))
        part.message(say("Mobile survey {number} of {survey_times_count}", number=number + 1,
                         survey_times_count=len(SURVEY_TIMES)))
        name = f"survey_{number + 1:02d}"
        drive_rng, error_rng, beam_rng = (
            np.random.default_rng(np.random.SeedSequence(seed.entropy, spawn_key=(*seed.spawn_key, number, use)))
            for use in range(3))
        true = survey_drive(scene, number, start, drive_rng)
        reported = reported_trajectory(true, error_rng)
        if "steps" in scene.faults:
            reported = _with_step(reported, fault_rng("steps", _survey_seed(seed, number)))
        true.write(folder / "truth" / f"{name}_trajectory.csv")
        reported.write(folder / "mms" / f"{name}_trajectory.csv")
        _write_images(folder / "mms" / f"{name}_images.csv", reported)
        points = with_faults(simulate_survey(scene, caster, true, reported, beam_rng, part), scene.faults,
                             _survey_seed(seed, number))
        count = _write_points(folder / "mms" / f"{name}.laz", folder / "truth" / f"{name}_labels.npz", reported, points)
        sightings = visible_corners(caster, corners, true)
        control = write_control(folder / "truth" / f"control_{name}.csv", corners, sightings, true, reported)
        error = np.hypot(*(reported.place - true.place)[:, :2].T)
        summary[name] = {"points": count, "control_points": control, "mean_error": float(error.mean()),
                         "greatest_error": float(error.max())}
    return summary


def _survey_seed(seed: np.random.SeedSequence, number: int) -> np.random.SeedSequence:
    """Seed of the faults of one survey."""
    return np.random.SeedSequence(seed.entropy, spawn_key=(*seed.spawn_key, number))


def _with_step(reported: SimulatedTrajectory, rng: np.random.Generator) -> SimulatedTrajectory:
    """The trajectory with a step in plan."""
    place = reported.place.copy()
    place[:, :2] += step_along(reported.chainage(), rng)
    return SimulatedTrajectory(reported.time, place, reported.angles).rounded()


def with_faults(pieces: Iterator[Points], faults: tuple[str, ...], seed: np.random.SeedSequence) -> Iterator[Points]:
    """The pieces of a survey with the faults of its points."""
    ghosts, rings = fault_rng("ghosts", seed), laser_answers(fault_rng("rings", seed))
    for points in pieces:
        if "rings" in faults:
            laser = laser_of(points.angle)
            answer = np.clip(points.intensity * rings[laser], 0, 65535).astype(np.uint16)
            points = replace(points, intensity=answer, laser=laser)
        yield _with_ghosts(points, ghosts) if "ghosts" in faults else points


def _with_ghosts(points: Points, rng: np.random.Generator) -> Points:
    """The points and ghosts of some of them, each beside the point that it is of."""
    rows, depth = ghost_rows(points.ground.astype(bool), points.place, rng)
    row = np.concatenate([np.arange(len(points.time)), rows])
    order = np.argsort(row, kind="stable")
    columns = {item.name: getattr(points, item.name) for item in fields(Points)}
    merged = {name: None if column is None else column[row[order]] for name, column in columns.items()}
    ghost = order >= len(points.time)
    merged["place"] = merged["place"].copy()
    merged["place"][ghost, 2] -= depth[order[ghost] - len(points.time)]
    merged["ground"], merged["label"] = (np.where(ghost, 0, merged[name]).astype(np.uint8)
                                         for name in ("ground", "label"))
    return Points(**merged)


def simulate_survey(scene: Scene, caster: RayCaster, true: SimulatedTrajectory, reported: SimulatedTrajectory,
                    rng: np.random.Generator, progress: Progress) -> Iterator[Points]:
    """Points of both scanners in the order of time, a second or two at once."""
    scans = recorded_scans(true, SCANNERS[0])
    for first in range(0, len(scans), SCANS_AT_ONCE):
        progress.step(first / len(scans))
        some = scans[first:first + SCANS_AT_ONCE]
        parts = [_points(scanner, simulate_scans(scene, caster, scanner, some, true, rng), reported)
                 for scanner in SCANNERS]
        order = np.argsort(np.concatenate([part.time for part in parts]), kind="stable")
        yield Points(*(np.concatenate([getattr(part, item.name) for part in parts])[order]
                       for item in fields(Points) if item.name != "laser"))


def recorded_scans(true: SimulatedTrajectory, scanner: SimulatedScanner) -> np.ndarray:
    """Times at which scans begin that are recorded: all while the vehicle moves, few while it waits."""
    scans = scanner.scan_times(true.time[0], true.time[-1])
    speed = np.interp(scans, true.time, np.gradient(true.chainage(), true.time))
    return scans[(speed > WAITING_SPEED) | (np.arange(len(scans)) % WAITING_SCANS == 0)]


def _points(scanner: SimulatedScanner, returns: Returns, reported: SimulatedTrajectory) -> Points:
    """What one scanner measured, placed with the reported trajectory."""
    place = scanner.placed(reported, returns.time, returns.beam, returns.distance)
    return Points(place, returns.time, returns.intensity, np.full(len(place), scanner.id, np.uint16),
                  scanner.angles[returns.beam], returns.ground.astype(np.uint8), _LABEL[returns.material])


def visible_corners(caster: RayCaster, corners: MarkingCorners, true: SimulatedTrajectory) -> Sightings:
    """When the scanner that looks down sees corners of markings that nothing hides."""
    scanner = SCANNERS[0]
    sightings = first_sweep(corners.place, true, scanner)
    place, rotation = true.interpolate(sightings.time)
    origin = place + rotation @ np.array(scanner.lever_arm)
    vector = corners.place[sightings.number] - origin
    distance = np.linalg.norm(vector, axis=1)
    hits = caster.cast(origin, vector / distance[:, None], sightings.time, scanner.max_range)
    return visible_sightings(sightings, np.abs(hits.distance - distance) < 0.1)


def _write_calibration(path: Path) -> None:
    calibration = {
        "body": "x forward, y right, z down; the trajectory gives the body's origin",
        "rotation": "body to north, east, down: Rz(heading) Ry(pitch) Rx(roll), right-hand",
        "beam": "beam at angle a in the scanner's axes: (cos a, sin a, 0), a from -90 to 90 degrees, left to right",
        "point": "P = p(t) + R(t) (lever_arm + R_bs d r), position and unwrapped angles linear between epochs",
        "timing": "a scan takes the first half of its period",
        "scanners": [scanner.calibration() for scanner in SCANNERS],
        "camera": CAMERA,
    }
    path.write_text(json.dumps(calibration, indent=1) + "\n")


def _write_images(path: Path, reported: SimulatedTrajectory) -> None:
    """Poses of the camera at every `IMAGE_SPACING` m of chainage, on the reported trajectory."""
    chainage = reported.chainage()
    marks = np.arange(IMAGE_SPACING / 2, chainage[-1], IMAGE_SPACING)
    time = np.round(np.interp(marks, chainage, reported.time), 4)
    place, rotation = reported.interpolate(time)
    place = place + rotation @ np.array(CAMERA["lever_arm_m"])
    camera_axes = rotation @ mounting(CAMERA["roll"], CAMERA["pitch"], CAMERA["heading"])
    heading = np.degrees(np.arctan2(camera_axes[:, 0, 0], camera_axes[:, 1, 0])) % 360.0
    pitch = np.degrees(np.arcsin(camera_axes[:, 2, 0]))
    roll = np.degrees(np.arctan2(-camera_axes[:, 2, 1], -camera_axes[:, 2, 2]))
    rows = [f"img_{number + 1:04d},{t:.4f},{p[0]:.4f},{p[1]:.4f},{p[2]:.4f},{r:.6f},{n:.6f},{h:.6f}\n"
            for number, (t, p, r, n, h) in enumerate(zip(time, place, roll, pitch, heading))]
    path.write_text(f"id,{FIELDS}\n" + "".join(rows))


def _write_points(path: Path, labels: Path, reported: SimulatedTrajectory, pieces: Iterator[Points]) -> int:
    """Write the points as LAZ (point format 6) and their labels as NPZ; return their number."""
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales = np.full(3, 0.001)
    header.offsets = np.append(np.floor(reported.place[0, :2]), 0.0)
    header.add_crs(pyproj.CRS(CRS))
    header.creation_date = datetime.date(2024, 4, 1)
    header.generating_software, header.system_identifier = "UrbanMap sample city", "simulated"
    truth = []
    with laspy.open(path, mode="w", header=header) as writer:
        for points in pieces:
            record = laspy.ScaleAwarePointRecord.zeros(len(points.time), header=header)
            record.x, record.y, record.z = points.place.T
            record.gps_time, record.intensity, record.point_source_id = points.time, points.intensity, points.scanner
            record.scan_angle = np.round(points.angle / 0.006).astype(np.int16)
            if points.laser is not None:
                record.user_data[:] = points.laser
            record.return_number[:] = 1
            record.number_of_returns[:] = 1
            writer.write_points(record)
            truth.append((points.ground, points.label))
    ground, label = (np.concatenate(column) for column in zip(*truth))
    np.savez_compressed(labels, ground=ground, material=label, names=np.array(LABEL_NAMES))
    return len(ground)
