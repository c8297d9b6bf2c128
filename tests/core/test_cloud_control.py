"""Laser points shifted to control points: known shifts come back; wrong, few and clustered points are told."""

from __future__ import annotations

import laspy
import numpy as np
import pyproj
import pytest

from urbanmap_qgis.aerial.orientation.cloud_control import CloudControl, control_cloud, residual_rows, write_shifted
from urbanmap_qgis.aerial.orientation.cloud_points import CloudPoints, measured_heights, read_cloud_points
from urbanmap_qgis.aerial.orientation.cloud_report import write_cloud_report
from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.io.points.pointcloud import open_cloud

CRS = "EPSG:6677"
SHIFT = np.array([0.21, -0.34, 0.18])
"""By which the clouds here lie off."""

PLACES = np.array([[10.0, 10.0], [90.0, 12.0], [88.0, 91.0], [12.0, 88.0], [50.0, 52.0]])


def ground(x, y):
    return 20.0 + 0.03 * x - 0.02 * y


@pytest.fixture(scope="module")
def cloud(tmp_path_factory):
    """A sloping square of 100 m with 8 points/m2, off by SHIFT, a car beside the first point; classes, or none."""
    rng = np.random.default_rng(4)
    xy = rng.uniform(0, 100, (80_000, 2))
    z = ground(*xy.T) + rng.normal(0, 0.03, len(xy))
    car = (np.abs(xy - [11.0, 10.0]) < [0.7, 0.7]).all(axis=1)
    z[car] += 1.5
    folder = tmp_path_factory.mktemp("als")
    for name, classes in (("classified", np.where(car, 1, 2)), ("unclassified", np.ones(len(xy), int))):
        header = laspy.LasHeader(point_format=6, version="1.4")
        header.scales, header.offsets = [0.001] * 3, [0.0, 0.0, 0.0]
        header.add_crs(pyproj.CRS(CRS))
        las = laspy.LasData(header)
        las.x, las.y, las.z = (np.column_stack([xy, z]) + SHIFT).T
        las.classification, las.intensity = classes, np.arange(len(xy)) % 5000
        las.write(folder / f"{name}.laz")
    return folder


def points_of(places=PLACES, roles=None, in_cloud=False, wrong=None):
    true = np.column_stack([places, ground(*places.T)])
    found = np.full(true.shape, np.nan)
    if in_cloud:
        found[:, :2] = places + SHIFT[:2]
    if wrong is not None:
        true[wrong, 2] += 0.5
    check = np.zeros(len(places), bool) if roles is None else np.array(roles)
    return CloudPoints(tuple(f"P{k}" for k in range(len(places))), true, found, check, np.full(len(places), np.nan))


@pytest.mark.parametrize("name", ["classified", "unclassified"])
def test_heights_come_back(cloud, name):
    """The shift in plan changes the height by the slope: 0.21 * 0.03 + 0.34 * 0.02 = 0.0131 m where it is not known."""
    points = measured_heights(points_of(), open_cloud([cloud / f"{name}.laz"]))
    found = control_cloud(points, 0.01, np.array([100.0, 100.0]))
    expected = -(SHIFT[2] - 0.03 * SHIFT[0] + 0.02 * SHIFT[1])
    assert found.shift[2] == pytest.approx(expected, abs=0.01) and abs(found.shift[2] - expected) < 3 * found.sigma[2]
    assert found.shift[:2].tolist() == [0.0, 0.0] and np.isnan(found.sigma[:2]).all()
    assert not found.wrong.any() and any("only its height" in sentence for sentence in found.findings)
    assert found.rms(found.left_out, found.used.any(axis=1))[1] < 0.02


def test_places_found_in_the_cloud_give_all_three(cloud):
    points = measured_heights(points_of(in_cloud=True), open_cloud([cloud / "classified.laz"]))
    found = control_cloud(points, 0.01, np.array([100.0, 100.0]))
    assert found.shift == pytest.approx(-SHIFT, abs=0.01)
    assert not found.findings


def test_a_wrong_point_is_named_and_not_followed(cloud):
    points = measured_heights(points_of(in_cloud=True, wrong=2), open_cloud([cloud / "classified.laz"]))
    found = control_cloud(points, 0.01, np.array([100.0, 100.0]))
    assert found.wrong.tolist() == [False, False, True, False, False]
    assert found.shift == pytest.approx(-SHIFT, abs=0.015)
    assert any("P2" in sentence for sentence in found.findings)


def test_check_points_are_only_compared(cloud):
    roles = [False, False, False, True, True]
    points = measured_heights(points_of(in_cloud=True, roles=roles), open_cloud([cloud / "classified.laz"]))
    found = control_cloud(points, 0.01, np.array([100.0, 100.0]))
    assert found.used[:, 2].tolist() == [True, True, True, False, False]
    assert max(found.rms(found.after, points.check)) < 0.03
    assert residual_rows(found)["role"] == ["control"] * 3 + ["check"] * 2


def test_few_and_clustered_points_are_told(cloud):
    near = open_cloud([cloud / "classified.laz"])
    two = control_cloud(measured_heights(points_of(PLACES[:2]), near), 0.01, np.array([100.0, 100.0]))
    assert any("2 control points tell the height" in sentence for sentence in two.findings)
    close = PLACES[4] + np.array([[0.0, 0.0], [5.0, 0.0], [0.0, 5.0], [4.0, 4.0]])
    clustered = control_cloud(measured_heights(points_of(close), near), 0.01, np.array([100.0, 100.0]))
    assert any("close together" in sentence for sentence in clustered.findings)


def test_a_cloud_that_fits_is_said_to(cloud):
    points = points_of(in_cloud=True)
    found = points.true + np.array([0.001, -0.001, 0.001])
    fitting = CloudPoints(points.id, points.true, found, points.check, points.sigma)
    found = control_cloud(fitting, 0.02, np.array([100.0, 100.0]))
    assert any("fits as it is" in sentence for sentence in found.findings)


def test_points_beside_the_cloud(cloud):
    near = open_cloud([cloud / "classified.laz"])
    away = np.vstack([PLACES, [[500.0, 500.0]]])
    found = control_cloud(measured_heights(points_of(away), near), 0.01, np.array([100.0, 100.0]))
    assert any("no ground around these points: P5" in sentence for sentence in found.findings)
    with pytest.raises(InsufficientDataError, match="no ground around any"):
        measured_heights(points_of(PLACES + 1000.0), near)


def test_the_shift_moves_every_coordinate_alike(cloud, tmp_path):
    source = open_cloud([cloud / "classified.laz"])
    assert write_shifted(source, -SHIFT, tmp_path / "out.laz") == 80_000
    before, after = laspy.read(cloud / "classified.laz"), laspy.read(tmp_path / "out.laz")
    assert np.array_equal(before.points.array, after.points.array)
    assert after.xyz == pytest.approx(before.xyz - SHIFT, abs=1e-9)
    assert after.header.parse_crs() is not None and after.header.mins == pytest.approx(before.header.mins - SHIFT)


def test_report(cloud, tmp_path):
    points = measured_heights(points_of(in_cloud=True, roles=[False] * 4 + [True]),
                              open_cloud([cloud / "classified.laz"]))
    write_cloud_report(tmp_path / "r.html", control_cloud(points, 0.01, np.array([100.0, 100.0])))
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "Check points lie" in text and "left out in turn" in text and "P4" in text


def test_tables_are_read(tmp_path):
    path = tmp_path / "調整点.csv"
    path.write_text("点名,x,y,z,x_als,y_als,z_als,role\nA,1,2,3,1.1,2.1,3.1,\nB,4,5,6,,,,検証点\n", encoding="cp932")
    points = read_cloud_points(path)
    assert points.id == ("A", "B") and points.check.tolist() == [False, True]
    assert points.errors[0] == pytest.approx([0.1, 0.1, 0.1]) and np.isnan(points.found[1]).all()


@pytest.mark.parametrize("text, message", [
    ("id,x,y,z\nA,1,2,\n", "no number for z in row 2"), ("id,x,y,z\nA,1,2,3\nA,4,5,6\n", "A is there twice"),
    ("id,x,y,z,x_als,y_als\nA,1,2,3,4,\n", "only one of x_als and y_als"),
    ("id,x,y,z,role\nA,1,2,3,perhaps\n", "role “perhaps” is not known"), ("id,x,y,z\n", "control point")])
def test_bad_tables_are_refused(tmp_path, text, message):
    path = tmp_path / "a.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=message):
        read_cloud_points(path)


def test_errors_of_a_cloud_are_root_mean_squares():
    errors = np.array([[3.0, 4.0, 0.3], [np.nan, np.nan, 0.4], [30.0, 40.0, 9.0]])
    plan, height = CloudControl.rms(None, errors, np.array([True, True, False]))
    assert (plan, height) == pytest.approx((5.0, np.sqrt(0.125)))
