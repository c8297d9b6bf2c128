"""Frames, their orientations, and cameras that contradict them."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import rasterio
from rasterio.errors import NotGeoreferencedWarning

from urbanmap_qgis.aerial.frames.camera import (
    ExteriorOrientation,
    FrameCamera,
    angles_from_usual_order,
    elementary_rotations,
    project_to_frame,
)
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.aerial.frames.frame_images import AerialFrame, FrameImage, find_frames
from urbanmap_qgis.aerial.orthophotos.contradictions import HYPOTHESES, refuse_contradiction, require_ground_pixel
from urbanmap_qgis.aerial.orthophotos.frame_shifts import FrameShift
from urbanmap_qgis.errors import InputError

CAMERA = FrameCamera(100.0, 0.01, 60, 40)


def write(path, dtype="uint8", bands=3, shape=(40, 60)):
    values = np.arange(bands * shape[0] * shape[1]).reshape(bands, *shape) % 251
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NotGeoreferencedWarning)
        with rasterio.open(path, "w", driver="GTiff", width=shape[1], height=shape[0], count=bands, dtype=dtype) as out:
            out.write(values.astype(dtype))
    return values


def poses(*names):
    return [ExteriorOrientation(name, float(number), 0, 0, 0, 0, 0) for number, name in enumerate(names)]


def test_frames_by_file_name_in_the_order_given(tmp_path):
    for name in ("写真1.tif", "B.TIF"):
        write(tmp_path / name)
    frames = find_frames([tmp_path / "B.TIF", tmp_path / "写真1.tif"], poses("写真1.tif", r"D:\flight\b.tif", "c.tif"))
    assert [frame.pose.x for frame in frames] == [1.0, 0.0]


def test_frames_of_a_folder(tmp_path):
    for name in ("a.tif", "0018.tif", "0018.tfw"):
        write(tmp_path / name) if name.endswith("tif") else (tmp_path / name).write_text("1")
    frames = find_frames([tmp_path], poses("a.tif", "0018"))
    assert [frame.path.name for frame in frames] == ["a.tif", "0018.tif"]
    with pytest.raises(InputError, match="missing.tif"):
        find_frames([tmp_path], poses("a.tif", "missing.tif"))


def test_frame_without_a_pose_or_given_twice(tmp_path):
    write(tmp_path / "a.tif")
    with pytest.raises(InputError, match="no line for a.tif"):
        find_frames([tmp_path / "a.tif"], poses("b.tif"))
    with pytest.raises(InputError, match="twice"):
        find_frames([tmp_path / "a.tif", tmp_path], poses("a.tif"))


@pytest.mark.parametrize("dtype", ["uint8", "uint16"])
def test_windows(tmp_path, dtype):
    values = write(tmp_path / "空中.tif", dtype, 4)
    with FrameImage(tmp_path / "空中.tif", CAMERA) as image:
        assert (image.bands, image.width, image.height, image.dtype) == (4, 60, 40, np.dtype(dtype))
        assert (image.read(slice(5, 9), slice(10, 30)) == values[:, 5:9, 10:30]).all()
        assert (image.read() == values).all()


@pytest.mark.parametrize(("dtype", "shape", "word"), [("uint8", (60, 40), "60 x 40"), ("float32", (40, 60), "float32")])
def test_images_that_do_not_fit(tmp_path, dtype, shape, word):
    write(tmp_path / "a.tif", dtype, shape=shape)
    with pytest.raises(InputError, match=word):
        FrameImage(tmp_path / "a.tif", CAMERA)


def test_file_that_is_no_image(tmp_path):
    (tmp_path / "a.tif").write_text("no image")
    with pytest.raises(InputError, match="cannot be read"):
        FrameImage(tmp_path / "a.tif", CAMERA)


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


SOUND = FrameCamera(38.0, 0.006, 1576, 2456)
TRUE = [ExteriorOrientation("a.tif", 10.0, 20.0, 770.0, -0.2, 0.3, 175.0),
        ExteriorOrientation("b.tif", 60.0, 22.0, 772.0, 0.5, -0.1, 3.0)]
ALIKE = FrameShift("a.tif", "b.tif", np.zeros((9, 2)), np.zeros((9, 2)))
UNLIKE = replace(ALIKE, vectors=np.full((9, 2), np.nan), alike=False)


def compared(frames):
    """Frames are alike where all look where they truly did."""
    same = all(np.allclose(frame.pose.rotation, pose.rotation, atol=1e-9)
               and np.allclose(frame.pose.centre, pose.centre) for frame, pose in zip(frames, TRUE))
    return [ALIKE if same else UNLIKE]


def frames_of(poses):
    return [AerialFrame(Path(pose.image), pose) for pose in poses]


@pytest.mark.parametrize(("mistake", "reason"), [
    (lambda pose: replace(pose, omega=pose.omega / 0.9, phi=pose.phi / 0.9, kappa=pose.kappa / 0.9), "in gon"),
    (lambda pose: replace(pose, z=pose.z / 0.3048), "in feet"),
    (lambda pose: replace(pose, x=pose.y, y=pose.x), "swapped"),
    (lambda pose: replace(pose, kappa=-pose.kappa), "kappa had the other sign")])
def test_the_mistake_that_explains_all_is_named(mistake, reason):
    with pytest.raises(InputError, match=reason):
        refuse_contradiction(frames_of(map(mistake, TRUE)), [UNLIKE], compared)


def test_frames_that_nothing_explains_are_refused_and_sound_ones_are_not():
    odd = [replace(TRUE[0], kappa=33.0), TRUE[1]]
    with pytest.raises(InputError, match="no two of them show the same things"):
        refuse_contradiction(frames_of(odd), [UNLIKE], compared)
    refuse_contradiction(frames_of(odd), [UNLIKE, ALIKE], compared)  # a part: `warn_of_shifts` names them
    refuse_contradiction(frames_of(odd), [], compared)  # nothing to compare is no contradiction


def test_a_turned_image_shows_a_place_at_the_opposite_pixel():
    turned = dict(HYPOTHESES)["the images were turned by half a turn"]
    point = np.array([30.0, 5.0, 12.0])
    column, row, _ = project_to_frame(SOUND, TRUE[0], point)
    other_column, other_row, _ = project_to_frame(SOUND, turned(TRUE[0]), point)
    assert other_column == pytest.approx(SOUND.width - 1 - column, abs=1e-6)
    assert other_row == pytest.approx(SOUND.height - 1 - row, abs=1e-6)


@pytest.mark.parametrize(("camera", "height", "reason"), [
    (replace(SOUND, pixel_pitch=6.0), 750.0, "micrometres"),
    (replace(SOUND, focal_length=6333.0), 750.0, "in pixels"),
    (SOUND, 20.0, "aerial frame"), (replace(SOUND, principal_point=(788.0, 1228.0)), 750.0, "not in pixels"),
    (SOUND, -5.0, "below the ground")])
def test_a_camera_that_cannot_be_is_refused_with_what_explains_it(camera, height, reason):
    with pytest.raises(InputError, match=reason):
        require_ground_pixel(camera, height)


def test_a_sound_camera_gives_its_pixel():
    assert require_ground_pixel(SOUND, 750.0) == pytest.approx(750.0 * 0.006 / 38.0)
