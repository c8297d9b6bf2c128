"""Exterior orientations of other programs: Metashape, Pix4D, Japanese spreadsheets; what contradicts is refused."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.aerial.frames.camera import angles_from_usual_order, elementary_rotations
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.errors import InputError

ANGLES = [(1.5, -2.25, 88.0), (-3.0, 4.0, -91.5), (12.0, 7.5, 178.25)]


def usual_rotation(omega, phi, kappa):
    """World to camera of photogrammetry's omega, phi, kappa."""
    first, second, third = elementary_rotations(omega, phi, kappa)
    return third @ second @ first


def metashape(angles=ANGLES, matrices=None, name="IMG {number}"):
    matrices = matrices or [usual_rotation(*row) for row in angles]
    rows = ["\t".join([name.format(number=number), "1000.5", f"{2000 + number}", "90.25", *map(str, row),
                       *(f"{value:.9f}" for value in matrix.ravel())])
            for number, (row, matrix) in enumerate(zip(angles, matrices))]
    names = "PhotoID, X, Y, Z, Omega, Phi, Kappa, r11, r12, r13, r21, r22, r23, r31, r32, r33"
    return "\n".join([f"# Cameras ({len(rows)})", f"# {names}", *rows]) + "\n"


def read(tmp_path, text, encoding="utf-8", **said):
    path = tmp_path / "e.txt"
    path.write_bytes(text.encode(encoding))
    return read_exterior(path, **said)


def agrees(poses, angles=ANGLES):
    for pose, row in zip(poses, angles):
        np.testing.assert_allclose(pose.rotation, usual_rotation(*row), atol=1e-9)
    assert len(poses) == len(angles)


def test_omega_phi_kappa_of_metashape_are_read_in_their_own_order(tmp_path):
    poses = read(tmp_path, metashape())
    agrees(poses)
    assert [pose.image for pose in poses] == ["IMG 0", "IMG 1", "IMG 2"] and poses[1].centre.tolist() == [
        1000.5, 2001.0, 90.25]


def test_a_matrix_that_contradicts_the_angles_is_refused(tmp_path):
    turned = [usual_rotation(omega, phi, kappa + 5) for omega, phi, kappa in ANGLES]
    with pytest.raises(InputError, match="rotation matrix of IMG 0 contradicts its omega, phi and kappa"):
        read(tmp_path, metashape(matrices=turned))


def test_external_parameters_of_pix4d_are_read_in_their_own_order(tmp_path):
    rows = [f"DJI_000{number}.JPG 1000.5 200{number}.25 90 {' '.join(map(str, row))}"
            for number, row in enumerate(ANGLES)]
    poses = read(tmp_path, "\r\n".join(["imageName X Y Z Omega Phi Kappa", *rows]))
    agrees(poses)
    assert poses[2].image == "DJI_0002.JPG" and poses[2].y == 2002.25


@pytest.mark.parametrize("encoding", ["utf-8-sig", "cp932", "utf-16"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t", " "])
def test_japanese_tables_with_a_head_and_a_line_of_units_are_read(tmp_path, encoding, delimiter):
    text = "\r\n".join(["外部標定要素", "写真名,東(m),北(m),標高(m),ω(度),φ(度),κ(度)", "-,m,m,m,度,度,度",
                        "甲.tif,1,2,3,0.5,0.25,90"])
    (pose,) = read(tmp_path, text.replace(",", delimiter), encoding)
    assert (pose.image, pose.x, pose.y, pose.z, pose.omega, pose.phi, pose.kappa) == (
        "甲.tif", 1.0, 2.0, 3.0, 0.5, 0.25, 90.0)


@pytest.mark.parametrize(("header", "sentence"), [
    ("image,X座標,Y座標,z,omega,phi,kappa", "X座標, Y座標 may count north or east"),
    ("image,x,y,z,omega[gon],phi[gon],kappa[gon]", "states the unit gon"),
    ("image,longitude,latitude,altitude,omega,phi,kappa", "latitude and longitude .*Import table"),
    ("image,x,y,z,yaw,pitch,roll", "no column omega, phi, kappa"),
    ("photo,name,x,y,z,omega,phi,kappa", "several columns that could be image"),
])
def test_what_could_be_meant_otherwise_is_refused_in_a_sentence(tmp_path, header, sentence):
    row = ",".join(f"{value}" for value in range(1, header.count(",") + 2))
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, f"{header}\n{row}\n")


def test_a_stated_unit_that_was_said_is_right(tmp_path):
    (pose,) = read(tmp_path, "image,x,y,z,omega[gon],phi[gon],kappa[gon]\na,1,2,3,0,0,100\n", unit="gon")
    assert pose.kappa == 90.0


@pytest.mark.parametrize("tilts", [(0.17, -0.6, 0.83), (1.5, -2.25, 88.0)])
def test_matrices_beside_the_angles_say_their_order(tmp_path, tilts):
    """Small tilts differ by 0.01 degrees between the orders: a decimetre on the ground from 700 m."""
    angles, papers = [tilts], angles_from_usual_order(*tilts)
    labelled = metashape(angles).replace("PhotoID", "Label")
    agrees(read(tmp_path, labelled), angles)
    own = metashape([papers], [usual_rotation(*tilts)]).replace("PhotoID", "Label")
    agrees(read(tmp_path, own), angles)


def test_the_reference_table_of_metashape_is_known_by_its_columns(tmp_path):
    (pose,) = read(tmp_path, "#Label,X/Easting,Y/Northing,Z/Altitude,Omega,Phi,Kappa\na.jpg,1,2,3,1.5,-2.25,88\n")
    agrees([pose], [(1.5, -2.25, 88)])
