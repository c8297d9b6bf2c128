"""Frame cameras: projection, rays, angles and the files they come from."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urbanmap_qgis.aerial.frames.camera import (
    Distortion,
    ExteriorOrientation,
    FrameCamera,
    angles_from_usual_order,
    elementary_rotations,
    frame_rays,
    omega_phi_kappa,
    project_to_frame,
    read_camera,
)
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.errors import InputError

CAMERA = FrameCamera(100.0, 0.01, 1001, 801, (0.05, -0.03))
LENS = Distortion(-0.26, 0.10, -0.026, 2.6e-4, -7.3e-4, unit_mm=8.8)
WIDE = FrameCamera(8.8, 0.01, 1300, 900, (-0.02, -0.06), LENS)
angle = st.floats(-180, 180)
tilt = st.floats(-80, 80)


@pytest.mark.paper("J 3.2.1.1, eq. 1 to 3")
def test_vertical_camera_by_hand():
    """1000 m up, 1 pixel is 0.1 m: 30 m east and 20 m north are 300 pixels right and 200 up of the principal point."""
    pose = ExteriorOrientation("a", 5000.0, -7000.0, 1000.0, 0.0, 0.0, 0.0)
    column, row, in_front = project_to_frame(CAMERA, pose, np.array([5030.0, -6980.0, 0.0]))
    assert column == pytest.approx(500 + 5 + 300) and row == pytest.approx(400 + 3 - 200) and in_front


def test_height_leans_outwards():
    pose = ExteriorOrientation("a", 0.0, 0.0, 1000.0, 0.0, 0.0, 0.0)
    column, _, _ = project_to_frame(CAMERA, pose, np.array([[30.0, 0.0, 0.0], [30.0, 0.0, 100.0]]))
    assert (column - 505) == pytest.approx([300, 300 * 1000 / 900])


@pytest.mark.paper("J 3.2.1.1, eq. 1 to 3")
def test_heading_and_tilts_turn_the_way_of_the_paper():
    """Kappa turns the camera counterclockwise; positive omega looks north of the nadir, positive phi west."""
    north = np.array([0.0, 100.0, 0.0])
    column, row, _ = project_to_frame(CAMERA, ExteriorOrientation("a", 0, 0, 1000, 0, 0, 90), north)
    assert column == pytest.approx(1505) and row == pytest.approx(403)
    centre = (500 + 5, 400 + 3)
    assert frame_rays(CAMERA, ExteriorOrientation("a", 0, 0, 1000, 10, 0, 0), *centre)[1] > 0.17
    assert frame_rays(CAMERA, ExteriorOrientation("a", 0, 0, 1000, 0, 10, 0), *centre)[0] < -0.17


@given(tilt, tilt, angle, st.sampled_from([CAMERA, WIDE]), st.floats(0, 1), st.floats(0, 1))
def test_rays_lead_back_to_their_pixels(omega, phi, kappa, camera, across, down):
    pose = ExteriorOrientation("a", -7000.0, -34000.0, 800.0, omega, phi, kappa)
    column, row = across * camera.width - 0.5, down * camera.height - 0.5
    ray = frame_rays(camera, pose, column, row)
    assert np.linalg.norm(ray) == pytest.approx(1)
    found = project_to_frame(camera, pose, pose.centre + 500 * ray)
    assert found[2] and found[0] == pytest.approx(column, abs=1e-5) and found[1] == pytest.approx(row, abs=1e-5)


def test_distortion_by_its_formula():
    u, v = 0.4, -0.3
    r2 = u * u + v * v
    factor = LENS.k1 * r2 + LENS.k2 * r2**2 + LENS.k3 * r2**3
    x = u + u * factor + LENS.p1 * (r2 + 2 * u * u) + 2 * LENS.p2 * u * v
    y = v + v * factor + LENS.p2 * (r2 + 2 * v * v) + 2 * LENS.p1 * u * v
    assert LENS.apply(np.array(u), np.array(v)) == pytest.approx((x, y))


def test_points_behind_and_beyond_the_fold_are_not_drawn():
    """With k1 = -1/3 the drawn radius r - r3/3 turns back at r = 1."""
    camera = FrameCamera(10.0, 0.01, 1000, 1000, distortion=Distortion(k1=-1 / 3, unit_mm=10.0))
    assert camera.distortion.fold == pytest.approx(1)
    points = np.array([[0, 0, 200.0], [150, 0, 0], [90, 0, 0]])
    column, _, in_front = project_to_frame(camera, ExteriorOrientation("a", 0, 0, 100, 0, 0, 0), points)
    assert in_front.tolist() == [False, False, True]
    assert np.isnan(column[:2]).all() and column[2] == pytest.approx(499.5 + 1000 * (0.9 - 0.9**3 / 3))
    assert np.isnan(frame_rays(camera, ExteriorOrientation("a", 0, 0, 100, 0, 0, 0), 499.5 + 700, 499.5)).all()


@given(tilt, tilt, angle)
def test_usual_angles_give_the_same_rotation(omega, phi, kappa):
    first, second, third = elementary_rotations(omega, phi, kappa)
    pose = ExteriorOrientation("a", 0, 0, 0, *angles_from_usual_order(omega, phi, kappa))
    assert pose.rotation == pytest.approx(third @ second @ first, abs=1e-9)
    rotation = ExteriorOrientation("a", 0, 0, 0, omega, phi, kappa).rotation
    assert omega_phi_kappa(rotation) == pytest.approx((omega, phi, kappa), abs=1e-6)


def write_json(tmp_path, **changes):
    values = {"focal_length_mm": 33.1, "pixel_pitch_mm": 0.0052, "image_width": 4000, "image_height": 3000,
              "principal_point_mm": [0.02, -0.03], **changes}
    path = tmp_path / "カメラ.json"
    path.write_text(json.dumps({name: value for name, value in values.items() if value is not None}), encoding="utf-8")
    return path


def test_camera_file(tmp_path):
    camera = read_camera(write_json(tmp_path, distortion={"model": "brown", "units": "focal", "k1": -0.1}))
    assert (camera.width, camera.height, camera.principal_point) == (4000, 3000, (0.02, -0.03))
    assert camera.distortion == Distortion(k1=-0.1, unit_mm=33.1)


@pytest.mark.parametrize(("changes", "word"), [
    ({"focal_length_mm": None}, "focal_length_mm"), ({"pixel_pitch_mm": "5 um"}, "pixel_pitch_mm"),
    ({"image_width": 0}, "greater than 0"), ({"principal_point_mm": [1]}, "two numbers"),
    ({"distortion": {"model": "fisheye"}}, "brown"), ({"distortion": {"k1": 0.1}}, "units"),
])
def test_bad_camera_file(tmp_path, changes, word):
    with pytest.raises(InputError, match=word):
        read_camera(write_json(tmp_path, **changes))


def test_camera_file_that_is_no_json(tmp_path):
    (tmp_path / "a.json").write_text("focal length 3")
    with pytest.raises(InputError, match="JSON"):
        read_camera(tmp_path / "a.json")


def write_poses(tmp_path, angles, header="image,x,y,z,omega,phi,kappa"):
    path = tmp_path / "exterior.csv"
    rows = [f"{number}.tif,1,2,3,{','.join(map(str, row))}" for number, row in enumerate(angles)]
    path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8-sig")
    return path


def test_exterior_file(tmp_path):
    poses = read_exterior(write_poses(tmp_path, [(0.5, -0.25, 182.0)]))
    assert poses == [ExteriorOrientation("0.tif", 1.0, 2.0, 3.0, 0.5, -0.25, 182.0)]


def test_exterior_file_with_semicolons_and_more_columns(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("Kappa; image; X; Y; Z; omega; phi; time\n90; a.tif; 1; 2; 3; 0; 0.5; 7\n", encoding="utf-8")
    assert read_exterior(path) == [ExteriorOrientation("a.tif", 1.0, 2.0, 3.0, 0.0, 0.5, 90.0)]


STRIPS = [(0.5, -0.3, 1.2), (-0.4, 0.2, 0.4), (0.3, 0.3, 181.6), (-0.6, 0.1, 179.2)]


def test_flights_in_degrees_are_taken(tmp_path):
    crosswise = [(0.5, -0.3, -91.2), (0.2, 0.2, 88.7), (0.1, 1.0, 270.2)]
    small = [(0.4, -0.3, 1.6), (0.1, 0.2, -1.1), (0.3, 0.2, 3.0)]
    for angles in (STRIPS, crosswise, small, [(0, 0, 2.0)], [(30.2, -0.9, -93.2), (30.1, 0.4, 175.6), (28.8, 0, 2.0)]):
        assert len(read_exterior(write_poses(tmp_path, angles))) == len(angles)


@pytest.mark.parametrize(("unit", "factor"), [("gon", 1 / 0.9), ("radians", math.pi / 180)])
def test_other_units_are_found_and_can_be_said(tmp_path, unit, factor):
    path = write_poses(tmp_path, np.array(STRIPS) * factor)
    with pytest.raises(InputError, match=unit):
        read_exterior(path)
    kappas = [pose.kappa for pose in read_exterior(path, unit)]
    assert kappas == pytest.approx([row[2] for row in STRIPS])


def test_oblique_flight_in_radians_is_found(tmp_path):
    angles = np.radians([(30.2, -0.9, -93.2), (30.1, 0.4, 175.6), (28.8, 0, 2.0)])
    with pytest.raises(InputError, match="radians"):
        read_exterior(write_poses(tmp_path, angles))


@pytest.mark.parametrize(("text", "word"), [
    ("image,x,y,z,omega,phi\na,1,2,3,4,5\n", "kappa"), ("image,x,y,z,omega,phi,kappa\n", "no image"),
    ("image,x,y,z,omega,phi,kappa\na,1,2,3,0,0,east\n", "Row 1"),
    ("image,x,y,z,omega,phi,kappa\na,1,2,3,0,0,nan\n", "not a number"),
    ("image,x,y,z,omega,phi,kappa\na,1,2,3,0,0,0\na,1,2,3,0,0,0\n", "Row 2"),
])
def test_bad_exterior_file(tmp_path, text, word):
    (tmp_path / "e.csv").write_text(text)
    with pytest.raises(InputError, match=word):
        read_exterior(tmp_path / "e.csv")
