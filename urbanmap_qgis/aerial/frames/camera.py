"""Frame cameras: between the world and the pixels, both ways (J eq. 1 to 3, Brown's distortion)."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...io.files.columns import Entry
from ...io.files.guard import read_json, reads
from ...wording import say

CAMERA = (Entry("focal_length_mm", "mm"), Entry("pixel_pitch_mm", "mm"), Entry("image_width", "pixels"),
          Entry("image_height", "pixels"))
LENS = tuple(Entry(name, "", default=0.0) for name in ("k1", "k2", "k3", "p1", "p2"))
"""Entries of a camera file, and of the distortion in it, whose unit the file says."""

_NEWTON_STEPS = 12
_NEWTON_ENOUGH = 1e-12


@dataclass(frozen=True)
class Distortion:
    """Brown's lens distortion, applied to u, v = image coordinates from the principal point, divided by `unit_mm`.

    Attributes
    ----------
    k1, k2, k3 : radial.
    p1, p2 : tangential.
    unit_mm : 1 where the coefficients are for millimetres, the focal length where they are for focal lengths.
    """

    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    unit_mm: float = 1.0

    @property
    def is_zero(self) -> bool:
        """Whether the lens draws straight."""
        return not any((self.k1, self.k2, self.k3, self.p1, self.p2))

    def apply(self, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Observed coordinates of ideal ones, same unit."""
        r2 = u * u + v * v
        radial = 1 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3))
        return (u * radial + self.p1 * (r2 + 2 * u * u) + 2 * self.p2 * u * v,
                v * radial + self.p2 * (r2 + 2 * v * v) + 2 * self.p1 * u * v)

    def remove(self, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Ideal coordinates of observed ones, same unit, by Newton's method; NaN where there are none."""
        ideal_u, ideal_v = np.array(u, float), np.array(v, float)
        for _ in range(_NEWTON_STEPS):
            step_u, step_v = self._newton_step(ideal_u, ideal_v, u, v)
            ideal_u -= step_u
            ideal_v -= step_v
            if np.max(np.hypot(step_u, step_v), initial=0.0) <= _NEWTON_ENOUGH * max(self.unit_mm, 1.0):
                return ideal_u, ideal_v
        lost = ~(np.hypot(*self._newton_step(ideal_u, ideal_v, u, v)) < 1e-9)
        lost |= ideal_u**2 + ideal_v**2 > self.fold**2
        return np.where(lost, np.nan, ideal_u), np.where(lost, np.nan, ideal_v)

    def _newton_step(self, u: np.ndarray, v: np.ndarray, target_u: np.ndarray,
                     target_v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        r2 = u * u + v * v
        radial = 1 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3))
        slope = 2 * (self.k1 + r2 * (2 * self.k2 + r2 * 3 * self.k3))
        uu = radial + u * u * slope + 6 * self.p1 * u + 2 * self.p2 * v
        vv = radial + v * v * slope + 6 * self.p2 * v + 2 * self.p1 * u
        uv = u * v * slope + 2 * self.p1 * v + 2 * self.p2 * u
        miss_u, miss_v = self.apply(u, v)
        miss_u, miss_v = miss_u - target_u, miss_v - target_v
        area = uu * vv - uv * uv
        area = np.where(np.abs(area) < 1e-9, 1e-9, area)
        return (vv * miss_u - uv * miss_v) / area, (uu * miss_v - uv * miss_u) / area

    @property
    def fold(self) -> float:
        """Ideal radius from which the polynomial draws things nearer again: nothing beyond it is in the image."""
        roots = np.roots([7 * self.k3, 5 * self.k2, 3 * self.k1, 1.0])
        radii = [root.real for root in roots if abs(root.imag) < 1e-12 and root.real > 0]
        return math.sqrt(min(radii)) if radii else math.inf


@dataclass(frozen=True)
class FrameCamera:
    """A calibrated frame camera.

    Attributes
    ----------
    focal_length, pixel_pitch : mm.
    width, height : pixels.
    principal_point : x0, y0 in mm from the image centre, x right and y up.
    distortion : of the lens.
    """

    focal_length: float
    pixel_pitch: float
    width: int
    height: int
    principal_point: tuple[float, float] = (0.0, 0.0)
    distortion: Distortion = field(default_factory=Distortion)

    def __post_init__(self) -> None:
        if not (self.focal_length > 0 and self.pixel_pitch > 0 and self.width > 0 and self.height > 0):
            raise InputError(say("The camera's focal length, pixel pitch, width and height must be greater than 0."))

    def ground_pixel(self, distance: float) -> float:
        """Side of a pixel, m, on things `distance` m away along the axis."""
        return distance * self.pixel_pitch / self.focal_length


@dataclass(frozen=True)
class ExteriorOrientation:
    """Exterior orientation of a frame: projection centre (m), angles (degrees); d = R_omega R_phi R_kappa (X - C)."""

    image: str
    x: float
    y: float
    z: float
    omega: float
    phi: float
    kappa: float

    @property
    def centre(self) -> np.ndarray:
        """Projection centre (3,)."""
        return np.array([self.x, self.y, self.z])

    @property
    def rotation(self) -> np.ndarray:
        """(3, 3) from world to camera axes: x right, y up, looking along -z (J eq. 1)."""
        omega, phi, kappa = elementary_rotations(self.omega, self.phi, self.kappa)
        return omega @ phi @ kappa


def elementary_rotations(omega: float, phi: float, kappa: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The three matrices (3, 3) of J eq. 1; angles in degrees."""
    (so, sp, sk), (co, cp, ck) = (f(np.radians([omega, phi, kappa])) for f in (np.sin, np.cos))
    return (np.array([[1, 0, 0], [0, co, so], [0, -so, co]]),
            np.array([[cp, 0, -sp], [0, 1, 0], [sp, 0, cp]]),
            np.array([[ck, sk, 0], [-sk, ck, 0], [0, 0, 1]]))


def omega_phi_kappa(rotation: np.ndarray) -> tuple[float, float, float]:
    """omega, phi, kappa in degrees of a rotation (3, 3) = R_omega R_phi R_kappa."""
    return (math.degrees(math.atan2(rotation[1, 2], rotation[2, 2])),
            math.degrees(math.asin(min(max(-rotation[0, 2], -1.0), 1.0))),
            math.degrees(math.atan2(rotation[0, 1], rotation[0, 0])))


def angles_from_usual_order(omega: float, phi: float, kappa: float) -> tuple[float, float, float]:
    """Angles of J eq. 1 from those of most bundle adjustments, R_kappa R_phi R_omega; all degrees."""
    first, second, third = elementary_rotations(omega, phi, kappa)
    return omega_phi_kappa(third @ second @ first)


@reads("a camera file")
def read_camera(path: str | os.PathLike) -> FrameCamera:
    """The camera of a JSON file (design: frames).

    Raises
    ------
    InputError : the file is no JSON, or a value is missing or not a number.
    """
    path = Path(path)
    values = read_json(path, "a camera file")
    if not isinstance(values, dict):
        raise InputError(say("{path} holds no camera: it must be a JSON object with focal_length_mm and so on.",
                             path=path.name))
    focal, pitch, width, height = (_number(values, entry, path) for entry in CAMERA)
    point = values.get("principal_point_mm", [0.0, 0.0])
    if not isinstance(point, list) or len(point) != 2:
        raise InputError(say("principal_point_mm in {path} must be two numbers: x0 and y0 in millimetres.",
                             path=path.name))
    named = {"x0": point[0], "y0": point[1]}
    return FrameCamera(focal, pitch, int(width), int(height),
                       tuple(_number(named, Entry(name, "mm"), path) for name in named),
                       _distortion(values.get("distortion"), focal, path))


def _number(values: dict, entry: Entry, path: Path) -> float:
    value = values.get(entry.name, entry.default)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(float(value)):
        raise InputError(say("{name} is missing in {path} or is not a number: add it.", name=entry.name,
                             path=path.name))
    return float(value)


def _distortion(values: object, focal: float, path: Path) -> Distortion:
    if values is None:
        return Distortion()
    if not isinstance(values, dict) or values.get("model", "brown") != "brown":
        raise InputError(say("The distortion in {path} is not of the model \"brown\": convert it, or resample the "
                             "frames without distortion.", path=path.name))
    units = values.get("units")
    coefficients = {entry.name: _number(values, entry, path) for entry in LENS}
    if units not in ("mm", "focal") and any(coefficients.values()):
        raise InputError(say("The distortion in {path} must name its units: \"mm\" or \"focal\".", path=path.name))
    return Distortion(**coefficients, unit_mm=focal if units == "focal" else 1.0)


def project_to_frame(camera: FrameCamera, pose: ExteriorOrientation,
                     points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where world points appear in a frame (J eq. 1 to 3); column 0, row 0 is the centre of the first pixel.

    Parameters
    ----------
    points : (..., 3), m.

    Returns
    -------
    column, row, in_front : (...) each. Columns and rows of points that the camera cannot draw (behind it, or beyond
    the radius where the distortion turns back) are NaN and `in_front` is False. Points outside the frame keep their
    columns and rows.
    """
    points = np.asarray(points, dtype=np.float64)
    found = project_places(camera, pose, *points.reshape(-1, 3).T)
    return tuple(values.reshape(points.shape[:-1]) for values in found)


def project_places(camera: FrameCamera, pose: ExteriorOrientation, x: np.ndarray, y: np.ndarray,
                   z: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The same for heights (n,) or (m, n) and coordinates that broadcast to as many, such as (1, n) and (m, 1)."""
    u, v, in_front = _to_image(pose, x, y, z)
    u *= -camera.focal_length
    v *= -camera.focal_length
    lens = camera.distortion
    if not lens.is_zero:
        u /= lens.unit_mm
        v /= lens.unit_mm
        in_front &= u * u + v * v < lens.fold**2
        u, v = lens.apply(u, v)
        u *= lens.unit_mm
        v *= lens.unit_mm
    for values, principal in zip((u, v), camera.principal_point):
        values += principal
        values /= camera.pixel_pitch
    u += (camera.width - 1) / 2
    np.subtract((camera.height - 1) / 2, v, out=v)
    if not in_front.all():
        u[~in_front] = v[~in_front] = np.nan
    return u, v, in_front


def _to_image(pose: ExteriorOrientation, x: np.ndarray, y: np.ndarray, z: np.ndarray
              ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """dx / dz, dy / dz (NaN behind the camera) and whether the points lie in front."""
    x, y, z = (np.asarray(values, np.float64) - place for values, place in zip((x, y, z), pose.centre))
    turned = []
    for axis in pose.rotation:
        # Not a matrix product, whose last digits depend on how many points come at once.
        along = axis[0] * x + axis[1] * y
        turned.append(np.add(along, axis[2] * z, out=along))
    right, up, back = turned
    in_front = back < -1e-6
    if not in_front.all():
        back[~in_front] = np.nan
    right /= back
    up /= back
    return right, up, in_front


def frame_rays(camera: FrameCamera, pose: ExteriorOrientation, column: np.ndarray, row: np.ndarray) -> np.ndarray:
    """World directions (..., 3), of length 1, in which pixels look from the projection centre.

    Directions of pixels that no ray reaches (beyond the reach of the distortion) are NaN.
    """
    x = (np.asarray(column, dtype=np.float64) - (camera.width - 1) / 2) * camera.pixel_pitch
    y = ((camera.height - 1) / 2 - np.asarray(row, dtype=np.float64)) * camera.pixel_pitch
    x, y = np.broadcast_arrays(x - camera.principal_point[0], y - camera.principal_point[1])
    lens = camera.distortion
    if not lens.is_zero:
        x, y = (value * lens.unit_mm for value in lens.remove(x / lens.unit_mm, y / lens.unit_mm))
    d = np.stack([x, y, np.full(x.shape, -camera.focal_length)], axis=-1)
    return d / np.linalg.norm(d, axis=-1, keepdims=True) @ pose.rotation
