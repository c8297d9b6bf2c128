"""From surveys to a calibration: planes of each scanner and pass, their adjustment, the corrected file."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...io.files.atomic import written_beside
from ...io.points.pointcloud import iter_chunks, open_cloud
from ...progress import SILENT, Progress
from ...settings.lines import BoresightSettings
from ...wording import mark, say
from ..calibration import Calibration, scanner_of
from ..gps_time import time_shift
from ..passes import BlockPositions
from ..trajectory import Trajectory, attitude_angles, interpolate, path_chainage, rotations
from .adjustment import PARAMETERS, Boresights, PatchPoses, adjust_boresights, skew
from .plane_patches import PatchSearch, PlanePatches

_MAX_RANGE = 40.0  # m; beyond it scan lines lie too far apart for planes
_GROUPS = 1 << 8  # scanners, and passes, that are told apart
_FEWEST_PAIRS = 200
_TIGHT = 0.1  # of the largest distance of passes, and of their walk
_AS_GOOD = 1.25  # times the planes' distances, and fewer pairs, with which tight courses fit as well as loose ones

_BODY = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""Forward, right, down as north, east, down: takes body rotations to the map's order of axes and back."""


@dataclass(frozen=True)
class CalibratedScanners:
    """What came out.

    Attributes
    ----------
    calibration : corrected where determined.
    boresights : corrections.
    passes : number of passes compared.
    """

    calibration: Calibration
    boresights: Boresights
    passes: int

    def rows(self) -> list[tuple[str, str, str, float, float, str]]:
        """Scanner, parameter, unit, correction, standard deviation, status."""
        found = self.boresights
        return [(scanner.id, name, "m" if k < 3 else "degrees", float(found.value[s, k]), float(found.sigma[s, k]),
                 mark("determined") if found.determined[s, k] else mark("not determined"))
                for s, scanner in enumerate(self.calibration.scanners) for k, name in enumerate(PARAMETERS)]


def calibrate_scanners(clouds: Sequence[Sequence[str | os.PathLike]], trajectories: Sequence[Trajectory],
                       calibration: Calibration, settings: BoresightSettings | None = None,
                       progress: Progress = SILENT) -> CalibratedScanners:
    """Corrections of the scanners' lever arms and boresights.

    Parameters
    ----------
    clouds : the files of each drive, placed by its trajectory and `calibration`.

    Raises
    ------
    InputError : the passes lie too far apart.
    InsufficientDataError : too few planes were seen by two scanners or in two passes.
    """
    settings = settings or BoresightSettings()
    if not calibration.scanners:
        raise InputError(say("The calibration holds no scanner: there is nothing to calibrate."))
    passes = [_passes(trajectory) for trajectory in trajectories]
    search = PatchSearch(trajectories[0].place[0])
    first_pass = 0
    for number, (paths, trajectory, part) in enumerate(zip(clouds, trajectories, passes)):
        step = progress.part(0.8 * number / len(clouds), 0.8 * (number + 1) / len(clouds))
        _collect(search, paths, trajectory, part, first_pass, calibration, step)
        first_pass += part.count
    patches = search.patches()
    progress.message(say("{patches_count:,} planes in {first_pass} passes.", patches_count=len(patches),
                         first_pass=first_pass))
    poses, node_pass = _poses(patches, trajectories, passes, calibration, settings)
    found = _adjusted(patches, poses, node_pass, len(calibration.scanners), settings)
    if found.pairs < _FEWEST_PAIRS:
        raise InsufficientDataError(say("Only {pairs} planes were seen by two scanners or in two passes: drive a "
                                        "street with walls in both directions.", pairs=found.pairs))
    if found.place_rms > settings.max_apart:
        raise InputError(say("The passes lie {apart:.1f} m apart: correct the trajectories first (“Adjust several "
                             "drives”) and place the points with them (“Apply corrected trajectory”).",
                             apart=found.place_rms))
    _tell(found, progress)
    return CalibratedScanners(_corrected(calibration, found), found, first_pass)


def _adjusted(patches: PlanePatches, poses: PatchPoses, node_pass: np.ndarray, scanners: int,
              settings: BoresightSettings) -> Boresights:
    """The adjustment; with courses held tightly where they seem far apart and yet need not be.

    A boresight of some tenths of a degree moves planes like a course that is off, and loose courses soak it up.
    """
    found = adjust_boresights(patches, poses, node_pass, scanners, settings)
    if not found.place_rms > settings.max_apart:
        return found
    tight = replace(settings, place=_TIGHT * settings.max_apart, place_walk=_TIGHT * settings.place_walk)
    tightened = adjust_boresights(patches, poses, node_pass, scanners, tight)
    alike = tightened.pairs >= found.pairs / _AS_GOOD and tightened.rms_after <= _AS_GOOD * found.rms_after
    return tightened if alike and tightened.place_rms <= settings.max_apart else found


def _passes(trajectory: Trajectory):
    positions = BlockPositions()
    positions.add(trajectory.place[:, 0], trajectory.place[:, 1], trajectory.time)
    return positions.passes()


def _collect(search: PatchSearch, paths: Sequence[str | os.PathLike], trajectory: Trajectory, passes, first_pass: int,
             calibration: Calibration, progress: Progress) -> None:
    """Put the points of a drive into the search, by scanner and pass."""
    cloud = open_cloud(paths)
    shift = time_shift(cloud, trajectory)
    scanners = {id(scanner): number for number, scanner in enumerate(calibration.scanners)}
    for chunk in iter_chunks(cloud, progress):
        time = np.asarray(chunk.gps_time) + shift
        points = np.column_stack([chunk.x, chunk.y, chunk.z])
        source = np.asarray(chunk.point_source_id)
        scanner = np.zeros(len(time), np.int64)
        for number in np.unique(source).tolist():
            scanner[source == number] = scanners[id(scanner_of(calibration, number))]
        usable = trajectory.within(time) & np.isfinite(points).all(axis=1)
        place = interpolate(trajectory, time[usable]).place
        usable[usable] = np.linalg.norm(points[usable] - place, axis=1) <= _MAX_RANGE
        pose = interpolate(trajectory, time[usable])
        group = (first_pass + passes.of(time[usable])) * _GROUPS + scanner[usable]
        search.add(points[usable], time[usable], group, _turned(rotations(pose.angles), points[usable] - pose.place))


def _turned(rotation: np.ndarray, from_body: np.ndarray) -> np.ndarray:
    """(n, 18): rotations R (n, 3, 3) body to map, and R [b]x of the vectors R b = `from_body` (n, 3), m, in rows.

    A plane that was looked at twice, before a turn and after it, moves by the means of both, not as one look between.
    """
    body = np.einsum("nji,nj->ni", rotation, from_body)
    return np.concatenate([rotation.reshape(-1, 9), (rotation @ skew(body)).reshape(-1, 9)], axis=1)


def _poses(patches: PlanePatches, trajectories: Sequence[Trajectory], passes: Sequence, calibration: Calibration,
           settings: BoresightSettings) -> tuple[PatchPoses, np.ndarray]:
    """Poses of the vehicle at the planes' times, and the pass (k,) of each node."""
    scanner, survey_pass = patches.group % _GROUPS, patches.group // _GROUPS
    node, node_pass, first_pass = np.zeros(len(patches), int), [], 0
    for trajectory, part in zip(trajectories, passes):
        chainage = path_chainage(trajectory)
        for number in range(part.count):
            of_pass = survey_pass == first_pass + number
            at = np.interp(patches.time[of_pass], trajectory.time, chainage)
            low = at.min() if len(at) else 0.0
            piece = np.floor((at - low) / settings.node_length).astype(int)
            node[of_pass] = len(node_pass) + piece
            node_pass += [first_pass + number] * (int(piece.max(initial=-1)) + 1)
        first_pass += part.count
    arm = np.array([item.lever_arm for item in calibration.scanners])[scanner]
    rotation, body = np.moveaxis(patches.means.reshape(-1, 2, 3, 3), 1, 0)
    return PatchPoses(scanner, node, rotation, body, body - rotation @ skew(arm)), np.array(node_pass, int)


def _corrected(calibration: Calibration, found: Boresights) -> Calibration:
    """The calibration with what is determined."""
    scanners = []
    for number, scanner in enumerate(calibration.scanners):
        value = np.where(found.determined[number], found.value[number], 0.0)
        x, y, z = np.radians(value[3:])
        length = float(np.linalg.norm([x, y, z]))
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        small = np.eye(3) + (np.sinc(length / np.pi) * cross
                             + 0.5 * np.sinc(0.5 * length / np.pi) ** 2 * cross @ cross)
        body = small @ _BODY @ rotations(scanner.angles[None])[0]
        roll, pitch, heading = attitude_angles((_BODY @ body)[None])[0]
        scanners.append(replace(scanner, lever_arm=scanner.lever_arm + value[:3],
                                angles=np.array([roll, pitch, (heading + 180.0) % 360.0 - 180.0])))
    return replace(calibration, scanners=tuple(scanners))


def _tell(found: Boresights, progress: Progress) -> None:
    progress.message(say("{pairs:,} pairs of planes; they lie {rms_before:.1f} mm apart before and {rms_after:.1f} "
                         "mm after (RMS).", pairs=found.pairs, rms_before=1000 * found.rms_before,
                         rms_after=1000 * found.rms_after))
    if not found.determined.any():
        progress.warn(say("Nothing is determined: the calibration stays as it is. Drive a street with walls in both "
                          "directions, and correct the trajectories first."))


def write_calibration(path: str | os.PathLike, source: str | os.PathLike, calibrated: CalibratedScanners) -> None:
    """Write the calibration file with the scanners' corrected values, standard deviations and statuses.

    Everything else in `source`, the file that was read, is kept.
    """
    content = json.loads(Path(source).read_text(encoding="utf-8-sig"))
    found = calibrated.boresights
    for number, (entry, scanner) in enumerate(zip(content["scanners"], calibrated.calibration.scanners)):
        entry["lever_arm_m"] = [round(float(value), 5) for value in scanner.lever_arm]
        entry.update(zip(("roll", "pitch", "heading"), (round(float(angle), 6) for angle in scanner.angles)))
        entry["calibrated"] = _statement(found, number)
    with written_beside(path) as temporary:
        temporary.write_text(json.dumps(content, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


def _statement(found: Boresights, number: int) -> Mapping[str, object]:
    """What is said of each value of a scanner: standard deviation, or that it is not determined."""
    return {name: ({"sigma": round(float(found.sigma[number, k]), 6)} if found.determined[number, k]
                   else "not determined") for k, name in enumerate(PARAMETERS)}
