"""The frame camera of the sample city: J eq. 1 to 3 between world and pixels, both ways."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Camera:
    """A frame camera without distortion.

    Attributes
    ----------
    focal_length, pixel_pitch : mm.
    width, height : pixels.
    principal_point : x0, y0 in mm from the image centre, x right and y up.
    """

    focal_length: float
    pixel_pitch: float
    width: int
    height: int
    principal_point: tuple[float, float]

    def to_json(self) -> str:
        """The camera file of the aerial stages (design: frames)."""
        return json.dumps({
            "focal_length_mm": self.focal_length, "pixel_pitch_mm": self.pixel_pitch,
            "image_width": self.width, "image_height": self.height,
            "principal_point_mm": list(self.principal_point)}, indent=1) + "\n"


@dataclass(frozen=True)
class Exposure:
    """A frame: its file name, where and how the camera was (m, degrees), and when (GPS seconds)."""

    image: str
    x: float
    y: float
    z: float
    omega: float
    phi: float
    kappa: float
    time: float

    @property
    def centre(self) -> np.ndarray:
        """Projection centre (3,)."""
        return np.array([self.x, self.y, self.z])

    @property
    def rotation(self) -> np.ndarray:
        """R_omega R_phi R_kappa, from world to camera axes (J eq. 1)."""
        (so, sp, sk), (co, cp, ck) = (f(np.radians([self.omega, self.phi, self.kappa])) for f in (np.sin, np.cos))
        omega = np.array([[1, 0, 0], [0, co, so], [0, -so, co]])
        phi = np.array([[cp, 0, -sp], [0, 1, 0], [sp, 0, cp]])
        kappa = np.array([[ck, sk, 0], [-sk, ck, 0], [0, 0, 1]])
        return omega @ phi @ kappa


def exterior_csv(exposures: Sequence[Exposure]) -> str:
    """The exterior orientation file of the aerial stages."""
    rows = [f"{e.image},{e.x:.3f},{e.y:.3f},{e.z:.3f},{e.omega:.5f},{e.phi:.5f},{e.kappa:.5f}" for e in exposures]
    return "\n".join(["image,x,y,z,omega,phi,kappa", *rows]) + "\n"


def project(camera: Camera, exposure: Exposure, points: np.ndarray) -> np.ndarray:
    """Columns and rows (..., 2) of world points (..., 3), by J eq. 1 to 3; pixel (0, 0) is the first one's centre."""
    d = (np.asarray(points, float) - exposure.centre) @ exposure.rotation.T
    x = camera.principal_point[0] - camera.focal_length * d[..., 0] / d[..., 2]
    y = camera.principal_point[1] - camera.focal_length * d[..., 1] / d[..., 2]
    return np.stack([(camera.width - 1) / 2 + x / camera.pixel_pitch,
                     (camera.height - 1) / 2 - y / camera.pixel_pitch], axis=-1)


def ray_matrix(camera: Camera, exposure: Exposure, drop: float) -> np.ndarray:
    """The matrix (3, 3) that turns (column, row, 1) into a world vector from the projection centre.

    The vector is so long that it descends `drop` m along the camera's axis: P = C + t (M @ (column, row, 1)),
    where t is about 1 at `drop` m under a camera that looks straight down.
    """
    scale = drop / camera.focal_length
    pitch, (x0, y0) = camera.pixel_pitch, camera.principal_point
    to_camera = scale * np.array([[pitch, 0.0, -pitch * (camera.width - 1) / 2 - x0],
                                  [0.0, -pitch, pitch * (camera.height - 1) / 2 - y0],
                                  [0.0, 0.0, -camera.focal_length]])
    return exposure.rotation.T @ to_camera
