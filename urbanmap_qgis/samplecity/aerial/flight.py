"""Plans the photo flight over the sample city: the camera and its exposures."""

from __future__ import annotations

import numpy as np

from ..scene.world import AERIAL_TIME, Scene
from .camera import Camera, Exposure, ray_matrix

# Ground sampling distance and height above ground, m.
GSD = 0.12
FLYING_HEIGHT = 760.0
# Maximum useful extent of a frame across and along the strips, m; a larger city gets more frames.
WIDEST = (480.0, 400.0)
PITCH = 0.006

MARGIN = 19.0
"""Ground that a frame may lose at each side by tilt, drift and relief, m."""

SPEED, TURN = 50.0, 420.0
"""Of the aircraft, m/s, and the time from one strip to the next, s."""


def plan_flight(scene: Scene, rng: np.random.Generator) -> tuple[Camera, list[Exposure]]:
    """A camera whose frames suit the city, and the exposures, strip by strip.

    Strips run north and south alternately (kappa about 0 and 180 degrees). Every place of the city is in three
    frames or more: in all three of the one strip of a small city; otherwise in two of each of two strips.
    """
    x_min, y_min, x_max, y_max = scene.extent.bounds
    length = max(x_max - x_min, y_max - y_min)
    if scene.size < 150.0:
        step = 0.35 * length
        extent = (length, length + 2 * step)
        strips, stations = np.zeros(1), step * np.array([-1.0, 0.0, 1.0])
    else:
        extent = (min(1.24 * length, WIDEST[0]), min(length, WIDEST[1]))
        steps = (min(0.24 * length, 0.47 * extent[0]), min(0.28 * length, 0.47 * extent[1]))
        strips, stations = (_twice_covered(length, r, s) for r, s in zip(extent, steps))
    width, height = (int(np.ceil((r + 2 * MARGIN) / GSD / 8)) * 8 for r in extent)
    middle = (x_min + x_max) / 2, (y_min + y_max) / 2
    ground = float(scene.ground_height(*np.array(middle)))
    camera = Camera(round(FLYING_HEIGHT / GSD * PITCH + rng.uniform(-0.02, 0.02), 4), PITCH,
                    width, height, tuple(round(float(v), 4) for v in rng.uniform(-0.03, 0.03, 2)))
    exposures = []
    for number, strip in enumerate(strips):
        start = AERIAL_TIME + number * (TURN + np.ptp(stations) / SPEED)
        for place, station in enumerate(stations if number % 2 == 0 else stations[::-1]):
            x, y, z = rng.uniform(-2.0, 2.0, 3)
            omega, phi = np.clip(rng.normal(0.0, 0.35, 2), -0.6, 0.6)
            kappa = 180.0 * (number % 2) + np.clip(rng.normal(0.0, 0.8), -1.5, 1.5)
            exposures.append(Exposure(
                f"frame_{len(exposures) + 1:02d}.tif", round(middle[0] + strip + x, 3),
                round(middle[1] + station + y, 3), round(ground + FLYING_HEIGHT + z, 3),
                round(omega, 5), round(phi, 5), round(kappa, 5),
                round(start + place * (stations[1] - stations[0]) / SPEED, 3)))
    return camera, exposures


def _twice_covered(length: float, extent: float, step: float) -> np.ndarray:
    """Places `step` apart and even about 0 such that windows of `extent` around them cover `length` at least twice."""
    half = length / 2 + step - extent / 2
    count = int(np.ceil(2 * half / step - 1e-9)) + 1
    return step * (np.arange(count) - (count - 1) / 2)


def footprint(camera: Camera, exposure: Exposure, level: float) -> np.ndarray:
    """Corners (4, 2) of a frame's edges on the level, x and y."""
    right, bottom = camera.width - 0.5, camera.height - 0.5
    pixels = np.array([[-0.5, -0.5, 1], [right, -0.5, 1], [right, bottom, 1], [-0.5, bottom, 1]])
    rays = pixels @ ray_matrix(camera, exposure, 1.0).T
    return (exposure.centre + rays * ((level - exposure.z) / rays[:, 2:]))[:, :2]
