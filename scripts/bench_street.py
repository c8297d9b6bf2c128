"""Speed of the mobile side, and of others' registration of the same windows: a part of `make bench`.

Runs on the independent city beside the checkout, else on a sample city made for it. The reference are the true aerial
markings, so that the peers' errors are theirs alone. Peers are measured where they are installed (small_gicp, Open3D).
"""

from __future__ import annotations

import importlib
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from scripts.bench_table import print_table
from scripts.layers import read_layer
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.apply_correction import apply_correction
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.markings.extraction import ExtractionSettings
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.register import register_windows
from urbanmap_qgis.mobile.registration.run import RegistrationRun
from urbanmap_qgis.mobile.registration.stage import register_markings
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.registration.survey_markings import survey_markings
from urbanmap_qgis.mobile.trajectory import Trajectory, interpolate, path_chainage
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

WINDOW = 15.0
"""Half the length of the peers' windows along the way, m."""

EVERY = 10.0
"""A window is given to the peers every so many metres."""

AROUND = 6.0
THIN = 0.1


@dataclass(frozen=True)
class Survey:
    """A survey of a city with its reference and its truth."""

    name: str
    points: Path
    reported: Trajectory
    true: Trajectory
    markings: MarkingPoints
    reference: Reference
    extraction_seconds: float
    point_count: int


@contextmanager
def city(data: Path) -> Iterator[Path]:
    """Folder of the independent city, or of a sample city made for the purpose."""
    if data.is_dir():
        yield data
        return
    from urbanmap_qgis.samplecity.write import make_city

    with tempfile.TemporaryDirectory() as folder:
        make_city(Path(folder) / "city", 120, seed=1)
        yield Path(folder) / "city"


def timed(work: Callable):
    """Result and CPU seconds of a piece of work."""
    start = time.process_time()
    result = work()
    return result, time.process_time() - start


def read_survey(folder: Path) -> Survey:
    """The first survey, with its markings extracted."""
    points = folder / "mms/survey_01.laz"
    reported = read_trajectory(folder / "mms/survey_01_trajectory.csv").trajectory
    calibration = read_calibration(folder / "mms/calibration.json")
    cloud = open_cloud([points])
    markings, seconds = timed(lambda: survey_markings(cloud, reported, ExtractionSettings(), calibration))
    polygons, _ = read_layer(folder / "truth/markings.gpkg", layer="aerial")
    return Survey(folder.name, points, reported, read_trajectory(folder / "truth/survey_01_trajectory.csv").trajectory,
                  markings, Reference.from_polygons(polygons, folder / "truth/ground.tif"), seconds, cloud.point_count)


def speed_rows(survey: Survey, reference: float) -> list[tuple]:
    """Each step of the mobile side: CPU seconds, per kilometre or ten million points, and as a ratio."""
    length = float(path_chainage(survey.reported)[-1])
    run = RegistrationRun(RegistrationSettings(three_d=True))
    made, registration = timed(lambda: register_markings(survey.markings, survey.reported, survey.reference, run))
    _, windows = timed(lambda: register_windows(survey.markings, survey.reported, survey.reference,
                                                RegistrationSettings(three_d=True)))
    with tempfile.TemporaryDirectory() as folder:
        _, applied = timed(lambda: apply_correction([survey.points], survey.reported, made.trajectory,
                                                    Path(folder) / "moved.laz"))
    tens = survey.point_count / 1e7
    return [("markings with ground and reading", survey.extraction_seconds, survey.extraction_seconds / tens,
             "s / 10 M points", survey.extraction_seconds / reference),
            ("windows alone, 3D", windows, 1000 * windows / length, "ms / m", windows / reference),
            ("registration, 3D", registration, 1000 * registration / length, "ms / m", registration / reference),
            ("points moved and written", applied, applied / tens, "s / 10 M points", applied / reference)]


def peer_rows(survey: Survey) -> list[tuple]:
    """Windows every `EVERY` metres registered by this program and by the peers: CPU ms a window, errors in plan (m)."""
    windows = register_windows(survey.markings, survey.reported, survey.reference, RegistrationSettings(three_d=True))
    way = path_chainage(survey.reported)
    middles = np.arange(WINDOW, way[-1] - WINDOW, EVERY)
    moment = np.interp(middles, way, survey.reported.time)
    wanted = interpolate(survey.true, moment).place - interpolate(survey.reported, moment).place
    own = np.array([windows.correction[np.argmin(np.abs(windows.chainage - middle)), :2] for middle in middles])
    _, seconds = timed(lambda: register_windows(survey.markings, survey.reported, survey.reference,
                                                RegistrationSettings(three_d=True)))
    rows = [("this program", 1000 * seconds / len(windows.chainage), *errors(own - wanted[:, :2]))]
    pairs = [window_points(survey, way, middle, place) for middle, place in
             zip(middles, interpolate(survey.reported, moment).place)]
    for name, package, align in (("small_gicp, GICP", "small_gicp", small_gicp_shift),
                                 ("Open3D, ICP", "open3d", open3d_shift)):
        try:
            library = importlib.import_module(package)
        except ImportError:
            print(f"{name}: not installed, left out")
            continue
        found, seconds = timed(partial(shifts, align, library, pairs))
        rows.append((name, 1000 * seconds / len(pairs), *errors(found - wanted[:, :2])))
    return rows


def shifts(align: Callable, library, pairs: list[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Shifts in plan (n, 2) of all windows by a peer."""
    return np.array([align(library, *pair) for pair in pairs])


def window_points(survey: Survey, way: np.ndarray, middle: float, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Marking points of a window and of the reference round it, (n, 3) each, m from the window's place."""
    at = np.interp(survey.markings.time, survey.reported.time, way)
    points = np.column_stack([survey.markings.x, survey.markings.y, survey.markings.z])[np.abs(at - middle) < WINDOW]
    points = thinned(points - place)
    low, high = (points[:, :2] + place[:2]).min(axis=0) - AROUND, (points[:, :2] + place[:2]).max(axis=0) + AROUND
    flat = survey.reference.coverage(*low, *high).points()
    target = np.column_stack([flat, survey.reference.heights(*flat.T)]) - place
    target = thinned(target[np.isfinite(target[:, 2])])
    # Heights are a metre off as well; the peers are given the median, since they do not search for it.
    points[:, 2] += np.median(target[:, 2]) - np.median(points[:, 2])
    return points, target


def thinned(points: np.ndarray) -> np.ndarray:
    """One point in each cell of `THIN` m."""
    _, first = np.unique(np.floor(points / THIN).astype(np.int64), axis=0, return_index=True)
    return points[np.sort(first)]


def small_gicp_shift(library, source: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Shift in plan (2,) by small_gicp's GICP, one thread."""
    result = library.align(target, source, registration_type="GICP", downsampling_resolution=THIN,
                           max_correspondence_distance=3.0, num_threads=1)
    return result.T_target_source[:2, 3]


def open3d_shift(library, source: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Shift in plan (2,) by Open3D's ICP, point to point: markings have no normals of their own."""
    clouds = []
    for points in (source, target):
        cloud = library.geometry.PointCloud()
        cloud.points = library.utility.Vector3dVector(points)
        clouds.append(cloud)
    result = library.pipelines.registration.registration_icp(
        clouds[0], clouds[1], 3.0, np.eye(4),
        library.pipelines.registration.TransformationEstimationPointToPoint())
    return result.transformation[:2, 3]


def errors(off: np.ndarray) -> tuple[float, float]:
    """Median and 90 % of distances (n, 2)."""
    distance = np.linalg.norm(off, axis=1)
    return float(np.nanmedian(distance)), float(np.nanpercentile(distance, 90))


def street_tables(data: Path, reference: float) -> None:
    """Print both tables."""
    with city(data) as folder:
        survey = read_survey(folder)
        print_table(f"Mobile side, {survey.name}: {survey.point_count / 1e6:.1f} million points",
                    ("step", "CPU s", "value", "unit", "CPU / reference"), speed_rows(survey, reference))
        print_table("Windows of 30 m, 3D, true aerial markings as reference",
                    ("by", "CPU ms a window", "median error, m", "90 %, m"), peer_rows(survey))
