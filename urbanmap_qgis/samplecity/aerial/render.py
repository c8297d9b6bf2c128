"""Renders a frame: what the camera saw, and which pixels show buildings, trees and vehicles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields

import cv2
import numpy as np

from ...progress import SILENT, Progress
from ..scene.crowns import CROWN, Leaves
from ..scene.faces import Boxes, join, vehicle_boxes
from ..scene.model import AERIAL, COLOUR, FaceKind, Faces, Material
from ..scene.world import Scene
from .camera import Camera, Exposure, project, ray_matrix
from .depth_image import EMPTY, DepthImage
from .face_shading import Shading, Surfaces
from .ground_image import GroundImage
from .sunlight import AMBIENT, DIRECT, ShadowMap

BUILDING, VEGETATION, VEHICLE = 255, 128, 64
"""Values of the masks: buildings (with all on their roofs) and elevated roads, trees, vehicles; 0 is the ground.

A pixel has the value if half of it or more shows such things."""

FINE = 2  # What is nearest is found for so many places each way in a pixel.
BLUR = 0.55  # Spread of the point spread function, pixels.
ROWS_AT_ONCE = 480  # Rows of a frame that are worked on together: they bound the memory.
POINTS_AT_ONCE = 1 << 20

NOISE = (1.2, 0.012)
"""Spread of the noise: grey values in the dark, and its growth with brightness."""


@dataclass(frozen=True)
class Stage:
    """What all frames of a flight show: the still part of the city, its ground and its light."""

    scene: Scene
    ground: GroundImage
    shadows: ShadowMap
    leaves: Leaves
    still: Faces
    stains: np.ndarray


@dataclass(frozen=True)
class RenderedFrame:
    """A frame: `image` (rows, columns, 3) uint8 and `mask` (rows, columns) uint8 of `BUILDING` and so on."""

    image: np.ndarray
    mask: np.ndarray


def still_faces(scene: Scene) -> Faces:
    """Faces of buildings, furniture and parked vehicles (with glass) at the flights."""
    parked = [vehicle for vehicle in scene.vehicles if not vehicle.speed and AERIAL in vehicle.epochs]
    return join([scene.static_faces(AERIAL), _glass(vehicle_boxes(parked, 0.0, scene.ground))])


def moving_faces(scene: Scene, time: float) -> list[Faces]:
    """Faces of each moving vehicle (with glass) at the time."""
    return [join([(boxes := vehicle_boxes([vehicle], time, scene.ground)).faces(), _glass(boxes)])
            for vehicle in scene.moving(AERIAL)]


def _glass(boxes: Boxes) -> Faces:
    """Windscreens and rear windows of cars, as dark strips on the cabins' tops."""
    cabin = np.flatnonzero((np.arange(len(boxes)) % 2 == 1) & (boxes.high[:, 2] < 1.8))
    low, high = boxes.low[cabin], boxes.high[cabin]
    strips = []
    for back, front in ((high[:, 0] - 0.85, high[:, 0] - 0.06), (low[:, 0] + 0.06, low[:, 0] + 0.55)):
        strips.append((np.column_stack([back, low[:, 1] + 0.08, high[:, 2]]),
                       np.column_stack([front, high[:, 1] - 0.08, high[:, 2] + 0.01])))
    twice = np.tile(cabin, 2)
    thin = Boxes(boxes.x[twice], boxes.y[twice], boxes.z[twice], boxes.heading[twice],
                 np.concatenate([low for low, _ in strips]), np.concatenate([high for _, high in strips]),
                 np.full((len(twice), 3), COLOUR[Material.GLASS] * 0.75, np.uint8), boxes.vehicle[twice])
    whole = thin.faces()
    return Faces(*(getattr(whole, item.name)[4::5] for item in fields(Faces)))


def render_frame(stage: Stage, camera: Camera, exposure: Exposure, gain: float, rng: np.random.Generator | None,
                 progress: Progress = SILENT) -> RenderedFrame:
    """Render one frame at the time of its exposure.

    Parameters
    ----------
    gain : brightness against the mean exposure.
    rng : of the noise; None for a frame without noise and blur.
    """
    moving = moving_faces(stage.scene, exposure.time)
    progress.check()
    faces = join([stage.still, *moving])
    shadows = stage.shadows.with_faces(join(moving), len(stage.still)) if moving else stage.shadows
    progress.check()
    ground = stage.ground.with_shadows(moving, shadows)
    progress.check()
    shading = Shading(Surfaces.of(faces, stage.scene, shadows), stage.leaves, shadows, stage.stains)
    image = np.empty((camera.height, camera.width, 3), np.float32)
    mask = np.empty((camera.height, camera.width), np.uint8)
    for top in range(0, camera.height, ROWS_AT_ONCE):
        part = progress.part(0.1 + 0.75 * top / camera.height, 0.85)
        part.step(0.0)
        rows = slice(top, min(top + ROWS_AT_ONCE, camera.height))
        view = _View(camera, exposure, ground, rows)
        nearest = view.draw(faces, stage.leaves)
        image[rows] = view.colour(nearest, shading, part)
        mask[rows] = _mask(nearest.label, _class_of(faces))
    progress.step(0.9)
    return RenderedFrame(_expose(image, gain, rng), mask)


class _View:
    """The world through some rows of one camera: rays, ground, things."""

    def __init__(self, camera: Camera, exposure: Exposure, ground: GroundImage, rows: slice):
        self._camera, self._exposure, self._ground, self._rows = camera, exposure, ground, rows
        self._centre = exposure.centre - [*ground.origin, 0.0]
        level = float(ground.height[len(ground.height) // 2, ground.height.shape[1] // 2])
        self._matrix = ray_matrix(camera, exposure, exposure.z - level) @ [[1, 0, 0], [0, 1, rows.start], [0, 0, 1]]
        column, row = np.arange(camera.width, dtype=float), np.arange(rows.stop - rows.start, dtype=float)
        # Nearness is 1/t - 1: small numbers, so that single precision holds them to a hundredth of a millimetre.
        ray_x, ray_y, ray_z = ((m[0] * column + (m[1] * row + m[2])[:, None]).astype(np.float32) for m in self._matrix)
        height = np.full(ray_z.shape, level, np.float32)
        for _ in range(3):
            t = (height - np.float32(self._centre[2])) / ray_z
            x = np.float32(self._centre[0]) + t * ray_x
            y = np.float32(self._centre[1]) + t * ray_y
            height = ground.height_at(x, y)
        self._ground_x, self._ground_y = x, y
        self._ground_nearness = 1.0 / t - 1.0

    def draw(self, faces: Faces, leaves: Leaves) -> DepthImage:
        """What is nearest on the fine grid of `FINE` x `FINE` places a pixel."""
        rows, columns = self._ground_nearness.shape
        image = DepthImage(cv2.resize(self._ground_nearness, (columns * FINE, rows * FINE),
                                      interpolation=cv2.INTER_LINEAR))
        pixels = self._fine_pixels(faces.corners)
        shift = np.array([[1 / FINE, 0, 0.5 / FINE - 0.5], [0, 1 / FINE, 0.5 / FINE - 0.5],
                          [0, 0, 1]])
        self._fine_matrix = self._matrix @ shift
        # On a face n . (C + t d) = offset, so 1/t = n . d / (offset - n . C): linear in column and row.
        distance = faces.offset - faces.normal @ self._exposure.centre
        with np.errstate(divide="ignore", invalid="ignore"):
            planes = faces.normal @ self._fine_matrix / distance[:, None] - [0.0, 0.0, 1.0]
        low, high = pixels.min(axis=1), pixels.max(axis=1)
        seen = (high >= 0).all(axis=1) & (low[:, 0] < columns * FINE) & (low[:, 1] < rows * FINE)
        for i in np.flatnonzero(seen & (np.abs(distance) > 1e-6)):
            image.draw_polygon(pixels[i], planes[i], i)
        for crown in range(len(leaves.centre)):
            self._draw_crown(image, leaves, crown)
        return image

    def _fine_pixels(self, points: np.ndarray) -> np.ndarray:
        """Columns and rows on the fine grid of these rows."""
        return (project(self._camera, self._exposure, points) - [0.0, self._rows.start] + 0.5) * FINE - 0.5

    def _draw_crown(self, image: DepthImage, leaves: Leaves, crown: int) -> None:
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
        corners = leaves.centre[crown] + signs * leaves.radii[crown] + [*self._ground.origin, 0.0]
        pixels = self._fine_pixels(corners)
        (left, top), (right, bottom) = np.floor(pixels.min(0)).astype(int), np.ceil(pixels.max(0)).astype(int)
        rows, columns = image.label.shape
        if left >= columns or top >= rows or right < 0 or bottom < 0:
            return
        column, row = np.meshgrid(np.arange(left, right + 1), np.arange(top, bottom + 1))
        ray = np.stack([column, row, np.ones(column.shape)], -1) @ self._fine_matrix.T
        enter, _, inside = leaves.meet(crown, np.broadcast_to(self._centre, ray.shape), ray)
        image.draw_patch(top, left, (1.0 / enter - 1.0).astype(np.float32), inside, CROWN + crown)

    def colour(self, nearest: DepthImage, shading: Shading, progress: Progress) -> np.ndarray:
        """Light (rows, columns, 3) float32: pixels that show one thing from their centre, others from their parts."""
        image = self._ground_colour(self._ground_x, self._ground_y)
        label, nearness = _parts(nearest.label), _parts(nearest.nearness)
        first = label[0]
        one = (first == label[1]) & (first == label[2]) & (first == label[3])
        flat = image.reshape(-1, 3)
        whole = np.flatnonzero(one & (first != EMPTY))
        for part in _chunks(whole, progress.part(0.0, 0.7)):
            near = 0.25 * sum(values.ravel()[part] for values in nearness)
            row, column = np.divmod(part, self._camera.width)
            flat[part] = shading.colour(first.ravel()[part], self._points(self._matrix, column, row, near))
        for part in _chunks(np.flatnonzero(~one), progress.part(0.7, 1.0)):
            row, column = np.divmod(part, self._camera.width)
            light = np.zeros((len(part), 3), np.float32)
            for k in range(FINE * FINE):
                fine_row, fine_column = row * FINE + k // FINE, column * FINE + k % FINE
                points = self._points(self._fine_matrix, fine_column, fine_row, nearness[k].ravel()[part])
                light += self._any_colour(label[k].ravel()[part], points, shading)
            flat[part] = light / (FINE * FINE)
        return image

    def _any_colour(self, label: np.ndarray, points: np.ndarray, shading: Shading) -> np.ndarray:
        light = np.empty((len(label), 3), np.float32)
        bare = label == EMPTY
        light[~bare] = shading.colour(label[~bare], points[~bare])
        count = np.count_nonzero(bare)
        if count:
            # The sampler takes images of less than 32768 columns: fold the list.
            x, y = (np.resize(points[bare, axis], (-(-count // 4096), 4096)) for axis in (0, 1))
            light[bare] = self._ground_colour(x, y).reshape(-1, 3)[:count]
        return light

    def _ground_colour(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        lit = self._ground.lit_at(x, y).astype(np.float32) * np.float32(1 / 255)
        colour = self._ground.colour_at(x, y).astype(np.float32)
        for band in range(3):
            colour[..., band] *= AMBIENT[band] + DIRECT[band] * lit
        return colour

    def _points(self, matrix: np.ndarray, column: np.ndarray, row: np.ndarray, near: np.ndarray) -> np.ndarray:
        """Local points (n, 3) float32 at the nearness `near` on the rays of pixels."""
        t = 1.0 / (1.0 + near)
        return np.stack([np.float32(self._centre[axis])
                         + t * (m[0] * column + m[1] * row + m[2]).astype(np.float32)
                         for axis, m in enumerate(matrix)], axis=1)


def _parts(image: np.ndarray) -> list[np.ndarray]:
    """The four fine places of each pixel, row by row, as four images."""
    fine = FINE
    return [np.ascontiguousarray(image[k // fine::fine, k % fine::fine]) for k in range(fine * fine)]


def _chunks(items: np.ndarray, progress: Progress) -> Iterator[np.ndarray]:
    for start in range(0, len(items), POINTS_AT_ONCE):
        progress.step(start / len(items))
        yield items[start:start + POINTS_AT_ONCE]


def _class_of(faces: Faces) -> np.ndarray:
    """Mask value of each face."""
    value = np.zeros(len(faces), np.uint8)
    value[(faces.building > 0) | (faces.kind == FaceKind.BRIDGE) | (faces.material == Material.BRIDGE)] = BUILDING
    value[faces.material == Material.WOOD] = VEGETATION
    value[faces.kind == FaceKind.VEHICLE] = VEHICLE
    return value


def _mask(label: np.ndarray, value: np.ndarray) -> np.ndarray:
    """The second greatest of the values that a pixel's four fine places show; `EMPTY` stands for the ground."""
    values = np.concatenate([value, [VEGETATION, 0]]).astype(np.uint8)
    classes = values[np.where(label >= CROWN, np.int32(len(value)), label)]
    a, b, c, d = _parts(classes)
    low, high = np.minimum(a, b), np.maximum(a, b)
    low_2, high_2 = np.minimum(c, d), np.maximum(c, d)
    return np.maximum(np.minimum(high, high_2), np.maximum(low, low_2))


def _expose(image: np.ndarray, gain: float, rng: np.random.Generator | None) -> np.ndarray:
    """Blur, exposure and noise of the camera."""
    if rng is None:
        return np.clip(np.rint(image * gain), 0, 255).astype(np.uint8)
    image = cv2.GaussianBlur(image, (0, 0), BLUR) * np.float32(gain)
    for band in range(3):
        spread = NOISE[0] + NOISE[1] * image[..., band]
        image[..., band] += spread * rng.standard_normal(spread.shape, np.float32)
    return np.clip(np.rint(image), 0, 255).astype(np.uint8)
