"""What the mobile part makes of the sample city stays as it is (see tests/figures.py)."""

from __future__ import annotations

import sqlite3
from contextlib import closing

import pytest
import shapely
from pyproj import CRS

from tests.figures import ENVELOPES, stays
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.accuracy_report import write_accuracy_report
from urbanmap_qgis.mobile.apply_correction import apply_correction, apply_to_images
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.control import accuracy, in_survey_time, read_control, residuals
from urbanmap_qgis.mobile.ground import classify_ground_files
from urbanmap_qgis.mobile.landmark_update import update_by_landmarks
from urbanmap_qgis.mobile.markings.curve_report import doubts, facts_of, write_curve_report
from urbanmap_qgis.mobile.markings.extraction import ExtractionSettings
from urbanmap_qgis.mobile.markings.markings_file import markings_to_file
from urbanmap_qgis.mobile.pose_correction import correction_between
from urbanmap_qgis.mobile.registration.correction.settings import CorrectionSettings
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.registered_survey import patch_table, unregistered_sections
from urbanmap_qgis.mobile.registration.report import write_registration_report
from urbanmap_qgis.mobile.registration.run import RegistrationRun
from urbanmap_qgis.mobile.registration.stage import register_markings
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.registration.survey_markings import survey_markings
from urbanmap_qgis.mobile.trajectory_files import read_trajectory


@pytest.fixture(scope="module")
def survey(small_city):
    """Points, reported and true trajectory, control points and calibration of the first survey."""
    points = small_city / "mms" / "survey_01.laz"
    reported = read_trajectory(small_city / "mms" / "survey_01_trajectory.csv").trajectory
    true = read_trajectory(small_city / "truth" / "survey_01_trajectory.csv").trajectory
    control, _ = in_survey_time(read_control(small_city / "truth" / "control_survey_01.csv"), reported)
    return points, reported, true, control, read_calibration(small_city / "mms" / "calibration.json")


@pytest.mark.slow
def test_ground_points_stay(survey, tmp_path):
    made = classify_ground_files([survey[0]], tmp_path / "ground.laz")
    stays("mobile_ground", {"made": made, "files": tmp_path})


@pytest.mark.slow
@pytest.mark.parametrize("calibrated", [True, False])
def test_marking_points_stay(survey, tmp_path, calibrated):
    points, reported, _, _, calibration = survey
    made = markings_to_file([points], tmp_path / "markings.laz", reported, calibration if calibrated else None)
    write_curve_report(tmp_path / "report.html", made, ["survey"])
    stays(f"mobile_markings_{'calibrated' if calibrated else 'plain'}", {
        "facts": facts_of(made), "doubts": list(doubts(made)), "files": tmp_path})


@pytest.mark.slow
def test_moved_points_stay(survey, small_city, tmp_path):
    points, reported, true, _, _ = survey
    moved = apply_correction([points], reported, true, tmp_path / "moved.laz")
    apply_to_images(small_city / "mms" / "survey_01_images.csv", reported, true, tmp_path / "images.csv", moved)
    stays("mobile_moved", {"made": moved, "files": tmp_path})


def test_accuracy_and_landmark_update_stay(survey, tmp_path):
    _, reported, true, control, _ = survey
    updated = update_by_landmarks(reported, control.select(slice(0, None, 3)))
    errors = {"reported": residuals(control), "updated": residuals(control, correction_between(reported, updated)),
              "true": residuals(control, correction_between(reported, true))}
    write_accuracy_report(tmp_path / "report.html", control, errors, 2)
    stays("mobile_accuracy", {"updated": updated, "errors": errors, "files": tmp_path,
                              "figures": {name: accuracy(values) for name, values in errors.items()}})


@pytest.fixture(scope="module")
def markings(survey):
    """Marking points of the first survey."""
    points, reported, _, _, calibration = survey
    return survey_markings(open_cloud([points]), reported, ExtractionSettings(), calibration)


@pytest.fixture(scope="module")
def paint(small_city):
    """The true markings as seen from the air."""
    with closing(sqlite3.connect(small_city / "truth" / "markings.gpkg")) as base:
        blobs = [row[0] for row in base.execute('SELECT geom FROM "aerial"')]
    return shapely.from_wkb([blob[8 + ENVELOPES[blob[3] >> 1 & 7]:] for blob in blobs])


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["plan", "space"])
def test_registration_stays(survey, markings, paint, small_city, tmp_path, kind):
    reported = survey[1]
    ground = small_city / "truth" / "ground.tif" if kind == "space" else None
    reference = Reference.from_polygons(list(shapely.force_2d(paint)), ground, CRS.from_epsg(6677).to_wkt())
    settings = RegistrationSettings(three_d=kind == "space")
    made = register_markings(markings, reported, reference, RegistrationRun(settings, CorrectionSettings()))
    write_registration_report(tmp_path / "report.html", made, reference, None)
    report = (tmp_path / "report.html").read_text(encoding="utf-8")
    stays(f"mobile_registration_{kind}", {
        "trajectory": made.trajectory, "windows": made.windows, "correction": made.correction,
        "patches": patch_table(made), "sections": unregistered_sections(made),
        "report": "".join(part.partition('"')[2] for part in report.split("base64,"))}, 2e-3)


@pytest.mark.slow
def test_windows_of_the_paper_stay(survey, markings, paint):
    """Their extents alone: rigid windows on their own tip over by a rounding, which other releases of numpy change."""
    reference = Reference.from_polygons(list(shapely.force_2d(paint)), None, CRS.from_epsg(6677).to_wkt())
    made = register_markings(markings, survey[1], reference,
                             RegistrationRun(RegistrationSettings.paper(), CorrectionSettings()))
    windows = made.windows
    stays("mobile_windows_paper", {"first": windows.window_first, "last": windows.window_last,
                                   "length": windows.window_length})
