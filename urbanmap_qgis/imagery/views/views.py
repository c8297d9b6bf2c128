"""Images that may show a facade: where its texels lie in them and how well they are seen."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...aerial.frames.camera import FrameCamera, frame_rays, project_to_frame, read_camera
from ...aerial.frames.exterior_files import read_exterior
from ...aerial.frames.frame_images import AerialFrame, FrameImage, find_frames
from ...errors import InputError
from ...mobile.calibration import read_calibration
from ...mobile.lines.line_camera import StripImage, camera_poses, pixel_rays, project_to_strip
from ...mobile.lines.strip_images import read_columns, read_strips, sample_pixels
from ...mobile.trajectory import Trajectory
from ...wording import say

GRAZING = np.cos(np.radians(80.0))
"""Rays that meet the facade flatter than this show nothing useful."""

_FRAME_RANGE = 5000.0

_MAX_SWEEPS = 4
"""Times that a rotating vehicle's camera may sweep over one place and be looked at."""


@dataclass(frozen=True, eq=False)
class View:
    """How one image shows n places of a facade, once.

    Attributes
    ----------
    image : number of the image.
    column, row : (n,) pixels, NaN where it does not show the place.
    camera : (n, 3) where the ray starts, m.
    detail : (n,) pixels a metre on the facade, in the less detailed direction.
    """

    image: int
    column: np.ndarray
    row: np.ndarray
    camera: np.ndarray
    detail: np.ndarray


class Source(Protocol):
    """An image that can be asked for its views of a facade and for colours at its pixels."""

    number: int
    name: str

    def views(self, places: np.ndarray, normal: np.ndarray, max_range: float) -> list[View]:
        """Views of places (n, 3) up to `max_range` m away on a facade with the normal (3,)."""

    def colours(self, column: np.ndarray, row: np.ndarray) -> np.ndarray:
        """Colours (n, 3) float32 at pixels (n,)."""

    def size(self) -> tuple[int, int]:
        """Columns and rows of the image."""

    def image_range(self, max_range: float) -> float:
        """How far the image shows things, m, where those of line images are used up to `max_range`."""

    def rays(self, column: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where the rays of pixels (n,) start, and their unit directions, (n, 3) each."""

    def window(self, left: int, top: int, right: int, bottom: int) -> np.ndarray:
        """Pixels (rows, columns, 3) uint8 from column `left` to before `right`, row `top` to before `bottom`."""

    def pixels(self, points: np.ndarray, window: tuple[float, float, float, float],
               max_range: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Where points (n, 3) lie within a window (left, top, right, bottom): index, column, row and distance (m,)."""


@dataclass(frozen=True, eq=False)
class StripSource:
    """A strip image of a line camera with its trajectory; `path` (columns, 3) are the camera's places, m.

    See `strip_source`.
    """

    number: int
    name: str
    strip: StripImage
    trajectory: Trajectory
    path: np.ndarray

    def views(self, places: np.ndarray, normal: np.ndarray, max_range: float) -> list[View]:
        """Its views of places (n, 3): one for each time that the camera passed and swept over them."""
        return [view for first, last in self._passes(places, normal, max_range)
                for view in self._pass_views(first, last, places, normal, max_range)]

    def _passes(self, places: np.ndarray, normal: np.ndarray, max_range: float) -> np.ndarray:
        """First and last column (k, 2) of the intervals of columns from which the camera may see the places."""
        low, high = places.min(axis=0), places.max(axis=0)
        known = np.isfinite(self.path[:, 0])
        off = np.where(known[:, None], self.path, 0.0) - np.clip(self.path, low, high)
        near = np.zeros(len(known), bool)
        near[known] = (((off[known] ** 2).sum(axis=1) < max_range**2)
                       & ((self.path[known] - places[0]) @ normal > 0))
        ends = np.flatnonzero(np.diff(np.concatenate([[False], near, [False]])))
        return ends.reshape(-1, 2)

    def _pass_views(self, first: int, last: int, places: np.ndarray, normal: np.ndarray,
                    max_range: float) -> list[View]:
        """Views of the columns from `first` to before `last`."""
        if last - first < 2:
            return []
        strip = StripImage(self.strip.camera, self.strip.times[first:last])
        found = project_to_strip(places, strip, self.trajectory, max_range)
        if not len(found):
            return []
        sweep = np.arange(len(found)) - np.searchsorted(found.point_index, found.point_index)
        camera, axes = camera_poses(self.strip.camera, self.trajectory, found.time)
        detail = self._detail(found, camera, axes, places, normal)
        views = []
        for number in range(min(sweep.max() + 1, _MAX_SWEEPS)):
            of_pass = np.flatnonzero((sweep == number) & np.isfinite(detail))
            view = _empty_view(self.number, len(places))
            index = found.point_index[of_pass]
            view.column[index], view.row[index] = found.column[of_pass] + first, found.row[of_pass]
            view.camera[index], view.detail[index] = camera[of_pass], detail[of_pass]
            views.append(view)
        return views

    def size(self) -> tuple[int, int]:
        """Columns and rows of the image."""
        return self.strip.columns, self.strip.camera.rows

    def image_range(self, max_range: float) -> float:
        """How far the image shows things, m."""
        return max_range

    def rays(self, column: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where the rays of pixels (n,) start, and their unit directions, (n, 3) each."""
        return pixel_rays(self.strip, self.trajectory, np.clip(column, 0, self.strip.columns - 1), row)

    def pixels(self, points: np.ndarray, window: tuple[float, float, float, float],
               max_range: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Where points (n, 3) lie within a window (left, top, right, bottom): index, column, row and distance (m,)."""
        left, top, right, bottom = window
        first, last = max(int(left) - 1, 0), min(int(right) + 2, self.strip.columns)
        strip = StripImage(self.strip.camera, self.strip.times[first:last])
        found = project_to_strip(points, strip, self.trajectory, max_range)
        column = found.column + first
        keep = (column >= left) & (column <= right) & (found.row >= top) & (found.row <= bottom)
        return found.point_index[keep], column[keep], found.row[keep], found.distance[keep]

    def window(self, left: int, top: int, right: int, bottom: int) -> np.ndarray:
        """Pixels (rows, columns, 3) uint8 from column `left` to before `right`, row `top` to before `bottom`."""
        return read_columns(self.strip, left, right)[top:bottom]

    def _detail(self, found, camera: np.ndarray, axes: np.ndarray, places: np.ndarray,
                normal: np.ndarray) -> np.ndarray:
        """Pixels a metre (m,): along the line by angle and distance, across it by how fast the plane moves."""
        ray = (places[found.point_index] - camera) / found.distance[:, None]
        facing = -ray @ normal
        along = self.strip.camera.focal / found.distance * np.maximum(facing, 0.0)
        later = np.clip(found.time + 0.05, *self.trajectory.time[[0, -1]])
        earlier = np.clip(found.time - 0.05, *self.trajectory.time[[0, -1]])
        swept = []
        for time in (earlier, later):
            place, axes_then = camera_poses(self.strip.camera, self.trajectory, time)
            swept.append(np.einsum("ni,ni->n", places[found.point_index] - place, axes_then[:, :, 1]))
        speed = np.abs(swept[1] - swept[0]) / np.maximum(later - earlier, 1e-6)
        rate = 1.0 / np.median(np.diff(self.strip.times))
        across = rate / np.maximum(speed, 1e-3)
        return np.where(facing > GRAZING, np.minimum(along, across), np.nan)

    def colours(self, column: np.ndarray, row: np.ndarray) -> np.ndarray:
        """Colours (n, 3) float32 at pixels (n,), bilinear; only the columns needed are read."""
        first, last = max(int(column.min()) - 1, 0), int(column.max()) + 3
        return sample_pixels(read_columns(self.strip, first, last), column - first, row)


def strip_source(number: int, name: str, strip: StripImage, trajectory: Trajectory) -> StripSource:
    """A strip image as a source of views: as much of it as the trajectory covers.

    Raises
    ------
    InputError : the trajectory covers less than two columns.
    """
    inside = trajectory.within(strip.times)
    if np.count_nonzero(inside) < 2:
        raise InputError(say("The strip image {name} was taken from {times:.1f} to {times_2:.1f} s, the trajectory "
                             "runs from {time:.1f} to {time_2:.1f} s: give those of one survey.", name=name,
                             times=strip.times[0], times_2=strip.times[-1], time=trajectory.time[0],
                             time_2=trajectory.time[-1]))
    path = np.full((strip.columns, 3), np.inf)
    path[inside] = camera_poses(strip.camera, trajectory, strip.times[inside])[0]
    return StripSource(number, name, strip, trajectory, path)


@dataclass(frozen=True)
class FrameSource:
    """A perspective frame with its exterior orientation."""

    number: int
    name: str
    frame: AerialFrame
    camera: FrameCamera

    def views(self, places: np.ndarray, normal: np.ndarray, max_range: float) -> list[View]:
        """Its view of places (n, 3); `max_range` does not matter, frames are taken from afar."""
        column, row, _ = project_to_frame(self.camera, self.frame.pose, places)
        centre = np.asarray(self.frame.pose.centre)
        ray = places - centre
        distance = np.linalg.norm(ray, axis=1)
        facing = -(ray @ normal) / distance
        inside = (column >= 1) & (column <= self.camera.width - 2) & (row >= 1) & (row <= self.camera.height - 2)
        seen = inside & (facing > GRAZING)
        if not seen.any():
            return []
        view = _empty_view(self.number, len(places))
        view.column[seen], view.row[seen] = column[seen], row[seen]
        view.camera[seen] = centre
        view.detail[seen] = facing[seen] / self.camera.ground_pixel(1.0) / distance[seen]
        return [view]

    def size(self) -> tuple[int, int]:
        """Columns and rows of the image."""
        return self.camera.width, self.camera.height

    def image_range(self, max_range: float) -> float:
        """How far the image shows things, m; `max_range` is for line images."""
        return max(max_range, _FRAME_RANGE)

    def rays(self, column: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where the rays of pixels (n,) start, and their unit directions, (n, 3) each."""
        direction = frame_rays(self.camera, self.frame.pose, column, row)
        return np.broadcast_to(self.frame.pose.centre, direction.shape), direction

    def pixels(self, points: np.ndarray, window: tuple[float, float, float, float],
               max_range: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Where points (n, 3) lie within a window (left, top, right, bottom): index, column, row and distance (m,)."""
        left, top, right, bottom = window
        column, row, _ = project_to_frame(self.camera, self.frame.pose, points)
        distance = np.linalg.norm(points - self.frame.pose.centre, axis=1)
        keep = np.flatnonzero((column >= left) & (column <= right) & (row >= top) & (row <= bottom)
                              & (distance <= self.image_range(max_range)))
        return keep, column[keep], row[keep], distance[keep]

    def colours(self, column: np.ndarray, row: np.ndarray) -> np.ndarray:
        """Colours (n, 3) float32 at pixels (n,), bilinear; only the window needed is read."""
        top, left = max(int(row.min()) - 1, 0), max(int(column.min()) - 1, 0)
        bottom, right = min(int(row.max()) + 3, self.camera.height), min(int(column.max()) + 3, self.camera.width)
        return sample_pixels(self.window(left, top, right, bottom), column - left, row - top)

    def window(self, left: int, top: int, right: int, bottom: int) -> np.ndarray:
        """Pixels (rows, columns, 3) uint8 from column `left` to before `right`, row `top` to before `bottom`."""
        with FrameImage(self.frame.path, self.camera) as image:
            return eight_bits(image.read(slice(top, bottom), slice(left, right)))


def eight_bits(bands: np.ndarray) -> np.ndarray:
    """Three bands of 8 bits (rows, columns, 3) of an image (bands, rows, columns); a grey one gives three equal."""
    pixels = (bands[:3] if len(bands) >= 3 else np.repeat(bands[:1], 3, axis=0)).transpose(1, 2, 0)
    return np.ascontiguousarray(pixels >> 8 if pixels.dtype == np.uint16 else pixels).astype(np.uint8, copy=False)


def strip_sources(images: Sequence[str | os.PathLike], trajectory: Trajectory, calibration: str | os.PathLike
                  ) -> list[StripSource]:
    """Strip images with their calibration file as sources, numbered from 0.

    Raises
    ------
    InputError : an image, its table of times or its camera cannot be read, or do not fit together.
    """
    strips = read_strips(images, read_calibration(calibration))
    return [strip_source(number, strip.path.name, strip, trajectory) for number, strip in enumerate(strips)]


def frame_sources(images: Sequence[str | os.PathLike], camera: str | os.PathLike, exterior: str | os.PathLike,
                  first: int = 0) -> list[FrameSource]:
    """Frames with their camera and exterior orientation as sources, numbered from `first`.

    Raises
    ------
    InputError : a file cannot be read, or an image is not named in the exterior orientation.
    """
    frames, device = find_frames(images, read_exterior(exterior)), read_camera(camera)
    for frame in frames:
        with FrameImage(frame.path, device):
            pass
    return [FrameSource(first + number, frame.path.name, frame, device) for number, frame in enumerate(frames)]


def _empty_view(image: int, count: int) -> View:
    nothing = np.full(count, np.nan)
    return View(image, nothing.copy(), nothing.copy(), np.full((count, 3), np.nan), nothing.copy())
