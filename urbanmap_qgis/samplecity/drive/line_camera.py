"""A line camera: strip images whose columns are times and whose rows are angles (Z 2.1, eq. 2 and 3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..laser.raycast import Hit, Hits
from ..laser.surfaces import STOREY, WINDOW_PITCH, hit_material, wall_coordinates
from ..scene.model import COLOUR, FaceKind, Material
from ..scene.paint import value_noise
from ..scene.world import Scene
from .trajectory import SimulatedTrajectory, mounting

SKY = np.array([206.0, 218.0, 232.0])
SUN = np.array([0.35, -0.62, 0.70])
"""Direction towards the sun (east, north, up)."""

SHADE = 0.62
"""Light on a face that the sun does not reach, against one that it meets squarely."""

NOISE = 2.5
"""Of the image, grey values."""


@dataclass(frozen=True)
class SimulatedLineCamera:
    """A camera that sees one line at a time through a fish-eye lens.

    Row h (0 is the centre of the first) looks at the angle omega = 2 asin((h - centre) / 2 / focal), down from the
    camera's x axis: along (cos omega, 0, sin omega) in its axes x forward, y right, z down.

    Attributes
    ----------
    lever_arm : forward, right, down from the body's origin, m.
    roll, pitch, heading : in the body, degrees.
    rows : of a line.
    focal, centre : pixels.
    lines_hz : lines per second.
    """

    id: int
    name: str
    lever_arm: tuple[float, float, float]
    roll: float
    pitch: float
    heading: float
    rows: int
    focal: float
    centre: float
    lines_hz: float

    def directions(self) -> np.ndarray:
        """Unit vectors (rows, 3) of the pixels in the body's axes."""
        angle = 2 * np.arcsin((np.arange(self.rows) - self.centre) / 2 / self.focal)
        rays = np.column_stack([np.cos(angle), np.zeros(self.rows), np.sin(angle)])
        return rays @ mounting(self.roll, self.pitch, self.heading).T

    def rays(self, trajectory: SimulatedTrajectory, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where lines at the times (n,) start and whither their pixels look, (n rows, 3) each, line by line."""
        place, rotation = trajectory.interpolate(time)
        origin = place + rotation @ np.array(self.lever_arm)
        direction = np.einsum("nij,kj->nki", rotation, self.directions())
        return np.repeat(origin, self.rows, axis=0), direction.reshape(-1, 3)

    def calibration(self) -> dict:
        """Its entry in calibration.json."""
        return {"id": self.id, "name": self.name, "lever_arm_m": list(self.lever_arm), "roll": self.roll,
                "pitch": self.pitch, "heading": self.heading, "rows": self.rows, "focal_length_px": self.focal,
                "centre_px": self.centre, "lines_hz": self.lines_hz}


def seen_colours(scene: Scene, epoch: str, points: np.ndarray, hits: Hits) -> np.ndarray:
    """Colours (n, 3), 0 to 255, of what beams met at points (n, 3): base colour, texture and sunlight."""
    material = hit_material(scene, epoch, points, hits)
    colour = COLOUR[material].astype(float)
    met = np.flatnonzero(hits.source == Hit.FACE)
    faces = scene.static_faces(epoch)
    opaque = met[material[met] != Material.GLASS]
    colour[opaque] = faces.colour[hits.index[opaque]]
    vehicle = np.flatnonzero(hits.source == Hit.VEHICLE)
    if len(vehicle):
        colour[vehicle] = np.array([v.colour for v in scene.moving(epoch)])[hits.index[vehicle]]
    colour *= _texture(scene, epoch, material, points, hits)[:, None]
    light = SHADE + (1 - SHADE) * np.maximum(hits.normal @ (SUN / np.linalg.norm(SUN)), 0.0)
    colour *= light[:, None]
    colour[hits.source == Hit.NOTHING] = SKY
    return colour


def _texture(scene: Scene, epoch: str, material: np.ndarray, points: np.ndarray, hits: Hits) -> np.ndarray:
    """Brightness (n,) of the places against their base colour: grain, stains, lit and dark windows, leaves."""
    brightness = np.ones(len(points))
    ground = hits.source == Hit.GROUND
    brightness[ground] = 0.85 + 0.3 * value_noise(points[ground, 0], points[ground, 1], 0.12)
    crown = hits.source == Hit.CROWN
    brightness[crown] = 0.5 + value_noise(points[crown, 0] + points[crown, 1], points[crown, 2], 0.2)
    faces = scene.static_faces(epoch)
    wall = np.flatnonzero(hits.source == Hit.FACE)
    wall = wall[faces.kind[hits.index[wall]] == FaceKind.WALL]
    along, height = wall_coordinates(scene, faces, hits.index[wall], points[wall])
    stains = 0.86 + 0.28 * value_noise(along + 37.0 * hits.index[wall], height, 0.6)
    windows = 0.5 + 1.4 * value_noise(np.floor(along / WINDOW_PITCH) + 0.5 + 37.0 * hits.index[wall],
                                      np.floor(height / STOREY) + 0.5, 1.0)
    brightness[wall] = np.where(material[wall] == Material.GLASS, windows, stains)
    return brightness
