"""Frames: images found by the names of the exterior orientation, checked and read by windows."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
import rasterio
from rasterio.errors import NotGeoreferencedWarning

from urbanmap_qgis.aerial.frames.camera import ExteriorOrientation, FrameCamera
from urbanmap_qgis.aerial.frames.frame_images import FrameImage, find_frames
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
