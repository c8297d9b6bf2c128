"""Speed of the mobile side, and of others' registration of the same windows: a part of `make bench`.

Runs on the independent city beside the checkout, else on a sample city made for it. The reference are the true aerial
markings, so that the peers' errors are theirs alone. Peers are measured where they are installed (small_gicp, Open3D).
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

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
from urbanmap_qgis.mobile.trajectory import Trajectory, path_chainage
from urbanmap_qgis.mobile.trajectory_files import read_trajectory


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


def street_tables(data: Path, reference: float) -> None:
    """Print the table."""
    with city(data) as folder:
        survey = read_survey(folder)
        print_table(f"Mobile side, {survey.name}: {survey.point_count / 1e6:.1f} million points",
                    ("step", "CPU s", "value", "unit", "CPU / reference"), speed_rows(survey, reference))
