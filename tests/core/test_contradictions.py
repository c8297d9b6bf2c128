"""Cameras and orientations that cannot be true: the mistake is named."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.aerial.frames.camera import ExteriorOrientation, FrameCamera, project_to_frame
from urbanmap_qgis.aerial.frames.frame_images import AerialFrame
from urbanmap_qgis.aerial.orthophotos.contradictions import HYPOTHESES, refuse_contradiction, require_ground_pixel
from urbanmap_qgis.aerial.orthophotos.frame_shifts import FrameShift
from urbanmap_qgis.errors import InputError

CAMERA = FrameCamera(38.0, 0.006, 1576, 2456)
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
    column, row, _ = project_to_frame(CAMERA, TRUE[0], point)
    other_column, other_row, _ = project_to_frame(CAMERA, turned(TRUE[0]), point)
    assert other_column == pytest.approx(CAMERA.width - 1 - column, abs=1e-6)
    assert other_row == pytest.approx(CAMERA.height - 1 - row, abs=1e-6)


@pytest.mark.parametrize(("camera", "height", "reason"), [
    (replace(CAMERA, pixel_pitch=6.0), 750.0, "micrometres"),
    (replace(CAMERA, focal_length=6333.0), 750.0, "in pixels"),
    (CAMERA, 20.0, "aerial frame"), (replace(CAMERA, principal_point=(788.0, 1228.0)), 750.0, "not in pixels"),
    (CAMERA, -5.0, "below the ground")])
def test_a_camera_that_cannot_be_is_refused_with_what_explains_it(camera, height, reason):
    with pytest.raises(InputError, match=reason):
        require_ground_pixel(camera, height)


def test_a_sound_camera_gives_its_pixel():
    assert require_ground_pixel(CAMERA, 750.0) == pytest.approx(750.0 * 0.006 / 38.0)
