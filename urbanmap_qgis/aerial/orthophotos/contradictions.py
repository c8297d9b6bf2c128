"""Cameras and orientations that cannot be true, and which usual mistake explains it: asked before any mosaic."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from ...errors import InputError
from ...wording import mark, say
from ..frames.camera import (
    ExteriorOrientation,
    FrameCamera,
    angles_from_usual_order,
    elementary_rotations,
    omega_phi_kappa,
)
from ..frames.frame_images import AerialFrame
from .frame_shifts import FrameShift

FOOT = 0.3048
"""m."""

GROUND_PIXEL = 0.01, 2.0
"""m: side of the pixels on the ground of any camera that takes road markings or buildings from the air."""

CAMERA_MISTAKES: tuple[tuple[str, Callable[[FrameCamera], float]], ...] = (
    (mark("the pixel pitch is in micrometres: give millimetres"), lambda camera: 1e-3),
    (mark("the pixel pitch is in metres: give millimetres"), lambda camera: 1e3),
    (mark("the focal length is in pixels: give millimetres, that is, times the pixel pitch"),
     lambda camera: 1.0 / camera.pixel_pitch),
    (mark("the focal length is in metres: give millimetres"), lambda camera: 1e-3),
    (mark("the heights of the frames are in feet: give metres"), lambda camera: FOOT))
"""Mistakes that make the pixel on the ground wrong, and what to multiply that by to put it right."""


def require_ground_pixel(camera: FrameCamera, height: float) -> float:
    """Side of a pixel on the ground, m, seen from a height (m) above it.

    Raises
    ------
    InputError : no camera takes such pixels from the air, or its axis does not meet the image.
    """
    if height <= 0:
        raise InputError(say("The frames lie below the ground: check the heights in the exterior orientation."))
    pixel = camera.ground_pixel(height)
    if not GROUND_PIXEL[0] <= pixel <= GROUND_PIXEL[1]:
        fitting = [say(text) for text, factor in CAMERA_MISTAKES
                   if GROUND_PIXEL[0] <= pixel * factor(camera) <= GROUND_PIXEL[1]]
        raise InputError(say("By the camera and the heights of the frames a pixel is {pixel:.3g} m wide on the ground: "
                             "no aerial frame has such pixels. Check the focal length, the pixel pitch and the heights"
                             "{hint}.", pixel=pixel, hint=say(" (what would explain it: {reasons})", reasons="; ".join(
                                 fitting)) if fitting else ""))
    half = 0.5 * camera.pixel_pitch * max(camera.width, camera.height)
    if max(map(abs, camera.principal_point)) > half:
        raise InputError(say("The principal point lies {offset:.1f} mm from the middle of an image that ends at "
                             "{half:.1f} mm: give it in millimetres from the middle, not in pixels or from a corner.",
                             offset=max(map(abs, camera.principal_point)), half=half))
    return pixel


def _turned(angle: float) -> Callable[[ExteriorOrientation], ExteriorOrientation]:
    """The orientation of an image that was turned by an angle (degrees, counterclockwise) after it was taken."""
    def change(pose: ExteriorOrientation) -> ExteriorOrientation:
        return _with_angles(pose, *omega_phi_kappa(elementary_rotations(0.0, 0.0, angle)[2] @ pose.rotation))
    return change


def _with_angles(pose: ExteriorOrientation, omega: float, phi: float, kappa: float) -> ExteriorOrientation:
    return replace(pose, omega=omega, phi=phi, kappa=kappa)


def _scaled(unit: float) -> Callable[[ExteriorOrientation], ExteriorOrientation]:
    """The orientation of angles that count a unit, degrees."""
    return lambda pose: _with_angles(pose, unit * pose.omega, unit * pose.phi, unit * pose.kappa)


_gon = _scaled(0.9)


HYPOTHESES: tuple[tuple[str, Callable[[ExteriorOrientation], ExteriorOrientation]], ...] = (
    (mark("the images were turned by half a turn"), _turned(180.0)),
    (mark("the images were turned by a quarter turn to the left"), _turned(90.0)),
    (mark("the images were turned by a quarter turn to the right"), _turned(-90.0)),
    (mark("kappa were counted from the opposite direction"), lambda pose: replace(pose, kappa=pose.kappa + 180.0)),
    (mark("kappa were counted from a quarter turn to the left"), lambda pose: replace(pose, kappa=pose.kappa + 90.0)),
    (mark("kappa were counted from a quarter turn to the right"), lambda pose: replace(pose, kappa=pose.kappa - 90.0)),
    (mark("the angles were in gon"), _gon),
    (mark("the angles were in radians"), _scaled(math.degrees(1.0))),
    (mark("the angles were in gon and the images turned by half a turn"), lambda pose: _turned(180.0)(_gon(pose))),
    (mark("the angles were in gon and kappa counted from the opposite direction"),
     lambda pose: replace(_gon(pose), kappa=0.9 * pose.kappa + 180.0)),
    (mark("the angles were in the usual order of rotations"),
     lambda pose: _with_angles(pose, *angles_from_usual_order(pose.omega, pose.phi, pose.kappa))),
    (mark("the angles had the other sign"), lambda pose: _with_angles(pose, -pose.omega, -pose.phi, -pose.kappa)),
    (mark("kappa had the other sign"), lambda pose: replace(pose, kappa=-pose.kappa)),
    (mark("the heights of the frames were in feet"), lambda pose: replace(pose, z=FOOT * pose.z)),
    (mark("x and y of the frames were swapped"), lambda pose: replace(pose, x=pose.y, y=pose.x)))
"""Mistakes of a whole block, and what would put each right."""


def refuse_contradiction(frames: Sequence[AerialFrame], given: Sequence[FrameShift],
                         compare: Callable[[Sequence[AerialFrame]], Sequence[FrameShift]]) -> None:
    """Refuse frames of which no two show the same ground, with the mistake that explains it if one does.

    Where no two frames could be compared at all, they are refused only if a mistake explains that.

    Parameters
    ----------
    given : shifts by the orientations as they are.
    compare : shifts by other orientations.

    Raises
    ------
    InputError : they contradict each other.
    """
    if len(frames) < 2 or any(shift.alike for shift in given):
        return
    scores = {text: sum(shift.alike for shift in compare([replace(frame, pose=change(frame.pose)) for frame in frames]))
              for text, change in HYPOTHESES}
    best = max(scores, key=scores.__getitem__)
    if scores[best]:
        raise InputError(say("The frames contradict each other: by their orientations no two of them show the same "
                             "ground. They would if {reason}: put that right and run again.", reason=say(best)))
    if given:
        raise InputError(say("The frames contradict each other: no two of them show the same things where they "
                             "overlap ({count} pairs compared). Check the camera, the unit, order and signs of the "
                             "angles, and that each image has its own orientation.", count=len(given)))
