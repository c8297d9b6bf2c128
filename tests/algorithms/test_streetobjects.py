"""urbanmap:streetobjects through Processing."""

from __future__ import annotations

import laspy
import numpy as np
import pytest
import shapely
from pyproj import CRS

from tests.core import object_scene as scene
from tests.core.road_scene import Street, to_local, write_drive

ALGORITHM = "urbanmap:streetobjects"
STREET = Street(length=30.0, kerb=0.0)


@pytest.fixture
def drive(tmp_path):
    def write(*makers, street=STREET, **more):
        trajectory = write_drive(tmp_path / "plain.las", street, more=(
            lambda rng: np.concatenate([make(rng) for make in makers])) if makers else None, **more)
        cloud = laspy.read(tmp_path / "plain.las")
        cloud.header.add_crs(CRS.from_epsg(6677))
        cloud.write(tmp_path / "drive.las")
        rows = np.column_stack([trajectory.time, trajectory.place, trajectory.angles])
        np.savetxt(tmp_path / "drive.csv", rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
        return {"POINTS": [str(tmp_path / "drive.las")], "TRAJECTORY": str(tmp_path / "drive.csv"),
                "OUTPUT": str(tmp_path / "objects.gpkg")}
    return write


def test_objects_rails_and_report(run, read_layer, drive, tmp_path):
    given = drive(lambda rng: scene.sign(rng, 8.0, -5.0), lambda rng: scene.post(rng, 20.0, -5.0, 4.0, low=1.7),
                  street=Street(length=40.0, kerb=0.0, rail=0.7))
    results = run(ALGORITHM, {**given, "OUTPUT_RAILS": str(tmp_path / "rails.gpkg"),
                              "OUTPUT_CITYGML": str(tmp_path / "city"), "DATA_DATE": "2026-04-01",
                              "OUTPUT_REPORT": str(tmp_path / "report.html")})
    assert len(list((tmp_path / "city" / "udx" / "frn").glob("*_frn_6697_op.gml"))) == 1
    sign, pole = sorted(read_layer(results["OUTPUT"]), key=lambda row: to_local(np.array(
        shapely.get_coordinates(shapely.from_wkt(row.wkt), include_z=True)), 0.0)[0, 0])
    assert (sign.attributes["kind"], pole.attributes["kind"]) == ("sign", "pole")
    assert sign.attributes["board_width"] == pytest.approx(0.8, abs=0.08) and sign.attributes["azimuth"] is not None
    assert pole.attributes["status"] == "doubtful" and pole.attributes["reason"] == "its foot is hidden"
    assert sign.attributes["reason"] in (None, "")
    assert sign.attributes["sigma"] == pytest.approx(results["MEDIAN_SIGMA"])
    assert (results["OBJECTS"], results["DOUBTFUL"]) == (2, 1)
    rails = read_layer(results["OUTPUT_RAILS"])
    assert sum(rail.attributes["length"] for rail in rails) == pytest.approx(40.0, abs=4.0)
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "2 objects along" in text and "its foot is hidden" in text and "<svg" in text


def test_a_street_without_objects_is_an_empty_layer(run, read_layer, drive, tmp_path):
    results = run(ALGORITHM, {**drive(), "OUTPUT_REPORT": str(tmp_path / "report.html")})
    assert not read_layer(results["OUTPUT"]) and results["OBJECTS"] == 0 and results.get("MEDIAN_SIGMA") is None
    assert "No object was found" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_a_date_must_be_a_day(run, drive):
    with pytest.raises(Exception, match="is no day"):
        run(ALGORITHM, {**drive(), "DATA_DATE": "spring"})


def test_the_survey_must_fit_the_trajectory(run, drive):
    given = drive(lambda rng: scene.post(rng, 8.0, -5.0, 4.0))
    rows = np.loadtxt(given["TRAJECTORY"], delimiter=",", skiprows=1)
    rows[:, 1] += 3000.0
    np.savetxt(given["TRAJECTORY"], rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
    with pytest.raises(Exception, match="3 km from where the vehicle was"):
        run(ALGORITHM, given)
