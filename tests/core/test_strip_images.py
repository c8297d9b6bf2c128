"""Strip images from files, and what is wrong with them in one sentence."""

import json

import cv2
import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.lines.strip_images import read_columns, read_strips, sample_pixels

ENTRY = {"id": 1, "lever_arm_m": [0, 0, 0], "rows": 8, "focal_length_px": 5.0, "centre_px": 3.5}


@pytest.fixture
def folder(tmp_path):
    pixels = np.random.default_rng(0).integers(0, 255, (8, 20, 3), dtype=np.uint8)
    (tmp_path / "左.png").write_bytes(cv2.imencode(".png", pixels[:, :, ::-1])[1].tobytes())
    write_times(tmp_path / "左_times.csv", range(20))
    return tmp_path, pixels


def write_times(path, columns, step=0.5):
    path.write_text("column,time\n" + "".join(f"{c},{100 + step * c}\n" for c in columns), encoding="utf-8")


def calibration(folder, *entries):
    path = folder / "calibration.json"
    path.write_text(json.dumps({"cameras": entries or [ENTRY]}), encoding="utf-8")
    return read_calibration(path)


def test_image_times_and_pixels(folder):
    path, pixels = folder
    strip, = read_strips([path / "左.png"], calibration(path))
    assert strip.columns == 20 and strip.camera.rows == 8
    np.testing.assert_allclose(strip.times, 100 + 0.5 * np.arange(20))
    np.testing.assert_allclose(strip.times_of([0.0, 2.5, 19.0, 19.4]), [100, 101.25, 109.5, 109.7])
    np.testing.assert_array_equal(read_columns(strip), pixels)
    np.testing.assert_array_equal(read_columns(strip, 5, 9), pixels[:, 5:9])


def test_the_calibration_names_image_and_times(folder):
    path, _ = folder
    write_times(path / "other.csv", reversed(range(20)), step=0.25)
    made = calibration(path, {**ENTRY, "id": 2}, {**ENTRY, "image": "左.png", "times": "other.csv"})
    strip, = read_strips([path / "左.png"], made)
    assert strip.camera.mount.id == "1" and strip.times[1] == 100.25


def test_pixels_are_bilinear():
    pixels = np.arange(12, dtype=float).reshape(3, 4, 1)
    np.testing.assert_allclose(sample_pixels(pixels, [0, 1.5, 3, 9], [0, 1, 1.5, 9])[:, 0], [0, 5.5, 9, 11])


@pytest.mark.parametrize(("content", "sentence"), [
    (None, "no times for 左.png"), ("a,b\n1,2\n", "columns column and time"), ("column,time\n0,x\n", "no number"),
    ("column,time\n0,1\n1,2\n", "2 columns, 左.png has 20"),
    ("column,time\n" + "".join(f"{c},{5 if c == 7 else c}\n" for c in range(20)), "time of column 7"),
])
def test_bad_times(folder, content, sentence):
    path, _ = folder
    (path / "左_times.csv").unlink()
    if content:
        (path / "左_times.csv").write_text(content, encoding="utf-8")
    with pytest.raises(InputError, match=sentence):
        read_strips([path / "左.png"], calibration(path))


@pytest.mark.parametrize(("entry", "sentence"), [
    ({"focal_length_px": "x"}, "focal_length_px"), ({"rows": None}, "rows"), ({"rows": 9}, "has 8 rows"),
    ({"focal_length_px": -1}, "cannot be right"),
])
def test_bad_cameras(folder, entry, sentence):
    path, _ = folder
    with pytest.raises(InputError, match=sentence):
        read_strips([path / "左.png"], calibration(path, {**ENTRY, **entry}))


def test_a_damaged_camera_is_told_to_who_needs_it(folder):
    path, _ = folder
    damaged = {**ENTRY, "lever_arm_m": "lost"}
    with pytest.raises(InputError, match="lever_arm_m"):
        read_strips([path / "左.png"], calibration(path, damaged))
    with pytest.raises(InputError, match="lever_arm_m"):
        read_strips([path / "左.png"], calibration(path, damaged, {**ENTRY, "id": 6}))


def test_images_that_are_none_and_cameras_that_cannot_be_told(folder):
    path, _ = folder
    with pytest.raises(InputError, match="which camera took"):
        read_strips([path / "左.png"], calibration(path, {**ENTRY, "id": 5}, {**ENTRY, "id": 6}))
    with pytest.raises(InputError, match="does not exist"):
        read_strips([path / "none.png"], calibration(path))
    (path / "bad.png").write_text("no image")
    with pytest.raises(InputError, match="cannot be read as an image"):
        read_strips([path / "bad.png"], calibration(path))
    with pytest.raises(InputError, match="No strip image"):
        read_strips([], calibration(path))
