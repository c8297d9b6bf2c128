"""Frames laid on the ground, each place only from frames that truly see it (J 3.2.1)."""

from __future__ import annotations

import os
import tempfile
from collections import OrderedDict
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from pathlib import Path

import cv2
import numpy as np
import shapely
from rasterio.features import rasterize
from rasterio.transform import Affine

from ...errors import InputError, UrbanMapError
from ...geometry.grid import Grid
from ...io.raster import RasterSampler
from ...progress import SILENT, Progress
from ...settings.aerial import OcclusionSettings
from ...wording import say
from ..frames.camera import ExteriorOrientation, FrameCamera, frame_rays, project_places
from ..frames.frame_images import AerialFrame, FrameImage
from ..frames.occlusion import occlusion_map
from ..frames.visibility import off_ground, visible_ground
from ..worker_resources import sent_polygons
from .contradictions import refuse_contradiction, require_ground_pixel
from .frame_shifts import FrameShift, frame_shifts, warn_of_shifts
from .mosaic import GroundView, Mosaic, MosaicFiles, PixelSelection, Workers, covering_grid, write_mosaic

# of the line-of-sight cells round a pixel: roof edges in the image cost more than half a cell
SURELY_SEEN = 0.99
MAX_OPEN_FILES = 64  # image files
MAX_CELLS = 6000  # side of the raster in which a frame's lines of sight are followed
LEVEL = 0.5  # m: what a surface of bare ground may differ from the ground
BLOCK = 2048
MARGIN = 3  # pixels round a window that the bicubic kernel reaches
BLACK = 0.012  # of the full scale
BLACK_SIDE = 15  # pixels: black squares of this size are no image; smaller ones may be shadow
MAX_BLUR = 4.0  # pixels, standard deviation
BORDER = 33  # rays along each side of a frame


class FramePixels:
    """The frames' pixels, of which only some files are open at a time. Use as a context manager.

    Attributes
    ----------
    bands, dtype : of all frames.

    Raises
    ------
    InputError : a frame is no image, does not fit the camera, or is of another kind than the first.
    """

    def __init__(self, frames: Sequence[AerialFrame], camera: FrameCamera):
        self.camera = camera
        self._open: OrderedDict[Path, FrameImage] = OrderedDict()
        kinds = [self._kind(frame.path) for frame in frames]
        for frame, kind in zip(frames, kinds):
            if kind != kinds[0]:
                raise InputError(say("{path} has {kind} bands of {kind_2} but {path_2} {kinds} of {kinds_2}: give "
                                     "frames of one kind.", path=frame.path.name, kind=kind[0], kind_2=kind[1],
                                     path_2=frames[0].path.name, kinds=kinds[0][0], kinds_2=kinds[0][1]))
        self.bands, self.dtype = kinds[0]

    def __enter__(self) -> FramePixels:
        return self

    def __exit__(self, *_exception: object) -> None:
        while self._open:
            self._open.popitem()[1].__exit__()

    def _kind(self, path: Path) -> tuple[int, str]:
        image = self._image(path)
        return min(image.bands, 3) if image.bands >= 3 else 1, image.dtype.name

    def _image(self, path: Path) -> FrameImage:
        if path not in self._open:
            if len(self._open) >= MAX_OPEN_FILES:
                self._open.popitem(last=False)[1].__exit__()
            self._open[path] = FrameImage(path, self.camera)
        self._open.move_to_end(path)
        return self._open[path]

    def masked(self, path: Path, rows: slice, columns: slice) -> np.ndarray:
        """Where an occlusion map of a frame, a file with the frame's rows and columns, is above 0 in a window, bool."""
        return self._image(path).read(rows, columns)[0] > 0

    def read(self, path: Path, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray]:
        """A window of a frame, (rows, columns, bands): red, green, blue or grey; and where it holds no image.

        That is where the file says so (no-data value, alpha, mask), and black squares: borders of undistorted frames.
        """
        image = self._image(path)
        planes = image.read(rows, columns)[:self.bands]
        window = cv2.merge(list(planes)).reshape(*planes.shape[1:], len(planes))
        black = (planes.max(axis=0) <= BLACK * np.iinfo(window.dtype).max).view(np.uint8)
        if black.any():
            # A frame's edge counts as black, so that a narrow border is one too.
            grown = cv2.copyMakeBorder(black, *(BLACK_SIDE if at_edge else 0 for at_edge in (
                rows.start == 0, rows.stop == image.height, columns.start == 0, columns.stop == image.width)),
                cv2.BORDER_CONSTANT, value=1)
            grown = cv2.morphologyEx(grown, cv2.MORPH_OPEN, np.ones((BLACK_SIDE, BLACK_SIDE), np.uint8),
                                     borderType=cv2.BORDER_REPLICATE)
            top, left = BLACK_SIDE * (rows.start == 0), BLACK_SIDE * (columns.start == 0)
            black = grown[top:top + black.shape[0], left:left + black.shape[1]]
        empty = black > 0
        valid = image.valid(rows, columns)
        return window, empty if valid is None else empty | ~valid


class Terrain:
    """Ground, surface and building outlines of the place, read window by window.

    Parameters
    ----------
    ground : heights of the ground.
    surface : the DSM, None for none.
    outlines : polygons of buildings.
    heights : of the buildings in them above the ground, m, None for unknown: they hide ground like the surface.
    threshold : m above the ground from which the surface hides and is not ground (J: 5 m).
    """

    def __init__(self, ground: RasterSampler, surface: RasterSampler | None = None,
                 outlines: Sequence[shapely.Geometry] = (), threshold: float = 5.0,
                 heights: Sequence[float] | None = None):
        self.ground, self.surface, self.threshold = ground, surface, threshold
        self.cell = (surface or ground).grid.cell
        outlines = list(outlines)  # read once where they are in a file
        present = [k for k, shape in enumerate(outlines) if shape is not None and not shape.is_empty]
        self._outlines = np.array([outlines[k] for k in present], object)
        self._heights = np.array([np.nan if heights is None or heights[k] is None else heights[k] for k in present],
                                 np.float32)
        self._tree = shapely.STRtree(self._outlines)
        self.low, self.high = _range(ground)
        self.top = max(self.high, _range(surface)[1]) if surface else self.high
        self.top = max(self.top, self.high + float(np.nanmax(self._heights, initial=0.0)))
        self.layers = lru_cache(maxsize=2)(self._layers)

    def heights(self, grid: Grid) -> tuple[np.ndarray, np.ndarray | None]:
        """Ground and surface (None without a DSM) at the cell centres, (rows, columns) float32."""
        surface = self.surface and self.surface.sample_cells(grid)
        ground = self.ground.sample_cells(grid)
        return ground, self._with_outlines(grid, ground, surface)

    def _with_outlines(self, grid: Grid, ground: np.ndarray, surface: np.ndarray | None) -> np.ndarray | None:
        """The surface with the buildings of known height; where it shows them higher, it stays."""
        near = self._tree.query(shapely.box(*grid.bounds))
        near = near[np.isfinite(self._heights[near])]
        if not len(near):
            return surface
        near = near[np.argsort(self._heights[near], kind="stable")]
        height = rasterize(zip(self._outlines[near], self._heights[near].tolist()), grid.shape, fill=0,
                           transform=_affine(grid), dtype=np.float32)
        return np.fmax(ground if surface is None else surface, np.where(height > 0, ground + height, -np.inf))

    def _layers(self, grid: Grid) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray | None]:
        """Ground heights, where outlines lie, where those, a tree or a bridge cover the ground, and where nothing
        stands on it (None without a DSM). `layers` remembers the last grids."""
        ground, surface = self.heights(grid)
        outlined = np.zeros(grid.shape, bool)
        near = np.sort(self._tree.query(shapely.box(*grid.bounds)))
        if len(near):
            outlined = rasterize(self._outlines[near], grid.shape, transform=_affine(grid),
                                 dtype=np.uint8).astype(bool)
        covered = outlined if surface is None else outlined | off_ground(surface, ground, self.threshold)
        if self.surface is None:
            return ground, outlined, covered, None
        with np.errstate(invalid="ignore"):
            level = ~outlined & (np.abs(surface - ground) <= LEVEL)
        return ground, outlined, covered, level


def _affine(grid: Grid) -> Affine:
    return Affine(grid.cell, 0, grid.x_min, 0, -grid.cell, grid.y_max)


def _range(raster: RasterSampler) -> tuple[float, float]:
    """Lowest and highest value of a raster."""
    low, high = np.inf, -np.inf
    for top in range(0, raster.grid.rows, BLOCK):
        for left in range(0, raster.grid.columns, BLOCK):
            values = raster.read(slice(top, min(top + BLOCK, raster.grid.rows)),
                                 slice(left, min(left + BLOCK, raster.grid.columns)))
            values = values[np.isfinite(values)]
            low, high = min(low, values.min(initial=np.inf)), max(high, values.max(initial=-np.inf))
    if not np.isfinite(low):
        raise InputError(say("{path} holds no heights: check the raster.", path=raster.path.name))
    return float(low), float(high)


def frame_footprint(camera: FrameCamera, pose: ExteriorOrientation, low: float,
                    high: float) -> tuple[float, float, float, float] | None:
    """Box (x_min, y_min, x_max, y_max) round the ground in a frame, for heights from `low` to `high`.

    None where the frame looks past all ground below the horizon; infinite where it looks over the horizon too.
    """
    along, across = (np.linspace(-0.5, size - 0.5, BORDER) for size in (camera.width, camera.height))
    column = np.concatenate((along, along, np.full(BORDER, along[0]), np.full(BORDER, along[-1])))
    row = np.concatenate((np.full(BORDER, across[0]), np.full(BORDER, across[-1]), across, across))
    direction = frame_rays(camera, pose, column, row)
    direction = direction[np.isfinite(direction).all(axis=1)]
    down = direction[:, 2] < -1e-3
    if not down.any() or pose.z <= low:
        return None
    if not down.all():
        return -np.inf, -np.inf, np.inf, np.inf
    reach = (pose.z - np.array([low, min(high, pose.z)]))[:, None, None]
    ground = pose.centre[:2] + reach * direction[:, :2] / -direction[:, 2:]
    ground = ground.reshape(-1, 2)
    return (*ground.min(axis=0).tolist(), *ground.max(axis=0).tolist())


class OrthorectifiedFrame:
    """A frame as a source of views of the ground.

    Parameters
    ----------
    mask : occlusion map of the frame, which then alone tells (with the outlines) what it sees; None to tell it from the
        lines of sight on the ground.

    Attributes
    ----------
    bounds : (x_min, y_min, x_max, y_max) of the ground raster that the frame can show, None for none.
    """

    def __init__(self, frame: AerialFrame, pixels: FramePixels, terrain: Terrain, mask: Path | None = None):
        self.frame, self.name, self.pixels, self.terrain, self.mask = frame, frame.path.name, pixels, terrain, mask
        box = frame_footprint(pixels.camera, frame.pose, terrain.low, terrain.high)
        self.bounds = box and _common(box, terrain.ground.grid.bounds)
        self._seen: tuple[Grid, np.ndarray] | None = None

    def view(self, grid: Grid) -> GroundView | None:
        """The frame's pixels on a grid; None where it shows nothing of it."""
        if self.bounds is None or _common(self.bounds, grid.bounds) is None:
            return None
        ground, outlined, covered, level = self.terrain.layers(grid)
        x, y = grid.centres()
        x, y = x[None, :], y[:, None]
        camera, pose = self.pixels.camera, self.frame.pose
        column, row, _ = project_places(camera, pose, x, y, ground)
        with np.errstate(invalid="ignore"):
            inside = (column >= 0) & (column <= camera.width - 1) & (row >= 0) & (row <= camera.height - 1)
        if not inside.any():
            return None
        drop = pose.z - float(np.nanmean(ground[inside]))
        values, shown = self._resampled(column, row, inside, grid.cell / camera.ground_pixel(drop))
        inside &= shown
        if self.mask is None:
            seen = inside & ~covered & self._sees(x, y)
        else:
            seen = inside & ~outlined & ~self._masked(column, row, inside)
        return GroundView(values, seen, inside & ~covered, partial(_tangent, pose, x, y, ground), level)

    def lean(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """How far what stands at places is displaced in the view, m east and north a metre of its height, (n, 2)."""
        pose = self.frame.pose
        drop = pose.z - self.terrain.ground.sample(x, y)
        return np.stack([x - pose.x, y - pose.y], axis=-1) / drop[:, None]

    def _resampled(self, column: np.ndarray, row: np.ndarray, inside: np.ndarray, ratio: float
                   ) -> tuple[np.ndarray, np.ndarray]:
        """Bicubic values of a frame at (column, row), (rows, columns, bands) float32, 0 outside; and where it has an
        image there.

        Where a cell is `ratio` > 1 pixels wide, the frame is smoothed first, so that fine detail does not alias.
        """
        camera = self.pixels.camera
        blur = min(0.5 * np.sqrt(max(ratio ** 2 - 1, 0)), MAX_BLUR)
        margin = MARGIN + int(np.ceil(3 * blur)) + 2 * BLACK_SIDE
        columns = _around(column[inside], margin, camera.width)
        rows = _around(row[inside], margin, camera.height)
        window, empty = self.pixels.read(self.frame.path, rows, columns)
        if blur > 0.3:
            window = cv2.GaussianBlur(window, (0, 0), blur)
        place_x, place_y = (column - columns.start).astype(np.float32), (row - rows.start).astype(np.float32)
        if not inside.all():
            place_x[~inside] = place_y[~inside] = -10
        values = cv2.remap(window, place_x, place_y, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
        values = cv2.copyTo(values, inside.view(np.uint8)).reshape(*inside.shape, -1).astype(np.float32)
        if not empty.any():
            return values, inside
        empty = cv2.dilate(empty.astype(np.uint8), np.ones((2 * (margin - 2 * BLACK_SIDE) + 1,) * 2, np.uint8))
        lost = cv2.remap(empty, place_x, place_y, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE)
        return values, inside & (lost.reshape(inside.shape) == 0)

    def _masked(self, column: np.ndarray, row: np.ndarray, inside: np.ndarray) -> np.ndarray:
        """Whether the occlusion map masks the pixels nearest to (column, row), (rows, columns) bool."""
        masked = np.zeros(inside.shape, bool)
        if inside.any():
            camera = self.pixels.camera
            columns, rows = _around(column[inside], 1, camera.width), _around(row[inside], 1, camera.height)
            window = self.pixels.masked(self.mask, rows, columns)
            masked[inside] = window[np.rint(row[inside]).astype(int) - rows.start,
                                    np.rint(column[inside]).astype(int) - columns.start]
        return masked

    def _sees(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Whether nothing stands between the camera and the ground at x (1, n) and y (m, 1), (m, n) bool."""
        if self._seen is None:
            self._seen = self._lines_of_sight()
        grid, bits = self._seen
        rows, columns, _ = grid.window(x.min() - grid.cell, y.min() - grid.cell, x.max() + grid.cell,
                                       y.max() + grid.cell)
        first = columns.start // 8
        part = np.unpackbits(bits[rows, first:-(-columns.stop // 8)], axis=1)
        part = part[:, columns.start - 8 * first:columns.stop - 8 * first].astype(np.float32)
        place_x = ((x - grid.x_min) / grid.cell - 0.5 - columns.start).astype(np.float32)
        place_y = ((grid.y_max - y) / grid.cell - 0.5 - rows.start).astype(np.float32)
        shape = y.shape[0], x.shape[1]
        place_x, place_y = (np.ascontiguousarray(np.broadcast_to(place, shape)) for place in (place_x, place_y))
        share = cv2.remap(part, place_x, place_y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        return share > SURELY_SEEN

    def _lines_of_sight(self) -> tuple[Grid, np.ndarray]:
        """Grid of the frame's ground and, packed by rows into bits, which of its cells it sees; found once."""
        terrain, pose = self.terrain, self.frame.pose
        x_min, y_min, x_max, y_max = self.bounds
        farthest = max(np.hypot(x - pose.x, y - pose.y) for x in (x_min, x_max) for y in (y_min, y_max))
        shadow = farthest * (terrain.top - terrain.low) / max(pose.z - terrain.low, 1.0) + 2 * terrain.cell
        box = _common((x_min - shadow, y_min - shadow, x_max + shadow, y_max + shadow), terrain.ground.grid.bounds)
        cell = max(terrain.cell, max(box[2] - box[0], box[3] - box[1]) / MAX_CELLS)
        grid = Grid.covering(*box, cell)
        ground, surface = terrain.heights(grid)
        seen = visible_ground(pose.centre, grid, ground, surface, terrain.threshold)
        return grid, np.packbits(seen, axis=1)


def _tangent(pose: ExteriorOrientation, x: np.ndarray, y: np.ndarray, ground: np.ndarray) -> np.ndarray:
    """Tangent of the angle between the rays to ground at x (1, n) and y (m, 1) and the vertical, (m, n) float32."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return (np.hypot(x - pose.x, y - pose.y) / (pose.z - ground)).astype(np.float32)


def _common(a: Sequence[float], b: Sequence[float]) -> tuple[float, float, float, float] | None:
    """The common part of two boxes, None where there is none."""
    box = max(a[0], b[0]), max(a[1], b[1]), min(a[2], b[2]), min(a[3], b[3])
    return box if box[0] < box[2] and box[1] < box[3] else None


def _around(place: np.ndarray, margin: int, size: int) -> slice:
    """Pixels from the least to the greatest place and a margin more, as far as the frame has them."""
    return slice(max(int(place.min()) - margin, 0), min(int(place.max()) + margin + 2, size))


@dataclass(frozen=True)
class OrthoSettings:
    """How frames are laid on the ground.

    Attributes
    ----------
    resolution : side of a pixel, m; 0 for the frames' own on the ground.
    choice : which frame a pixel is taken from.
    height_threshold : m above the ground from which the DSM hides ground (J: 5 m).
    occlusion : how occlusion maps of the frames are made, which then tell what is hidden (J 3.2.1.1); None to tell it
        from the lines of sight on the ground.
    """

    resolution: float = 0.0
    choice: PixelSelection = field(default_factory=PixelSelection)
    height_threshold: float = 5.0
    occlusion: OcclusionSettings | None = None


@dataclass(frozen=True)
class ElevationInputs:
    """Where frames lie: rasters of the ground's and (optional) the surface's height, m, in one projected CRS with the
    poses, and polygons of buildings, which are taken out of the mosaic.

    Attributes
    ----------
    heights : of those buildings above the ground, m, None where unknown: with it they also hide what lies behind them.
    masks : occlusion maps, a file for each frame, of its rows and columns, above 0 where it shows no ground.
    """

    ground: str | os.PathLike
    surface: str | os.PathLike | None = None
    outlines: Sequence[shapely.Geometry] = ()
    heights: Sequence[float] | None = None
    masks: Sequence[str | os.PathLike] | None = None


def open_frames(frames: Sequence[AerialFrame], camera: FrameCamera, place: ElevationInputs, threshold: float,
                stack: ExitStack) -> list[OrthorectifiedFrame]:
    """The frames as sources of views; their files are closed by the stack."""
    terrain = Terrain(stack.enter_context(RasterSampler(place.ground)),
                      stack.enter_context(RasterSampler(place.surface)) if place.surface else None,
                      place.outlines, threshold, place.heights)
    pixels = stack.enter_context(FramePixels(frames, camera))
    masks = [None] * len(frames) if place.masks is None else [Path(mask) for mask in place.masks]
    return [OrthorectifiedFrame(frame, pixels, terrain, mask) for frame, mask in zip(frames, masks)]


def _frame_masks(frames: Sequence[AerialFrame], camera: FrameCamera, place: ElevationInputs,
                 settings: OcclusionSettings, folder: Path, progress: Progress) -> list[Path]:
    """Occlusion maps of all frames, written to a folder."""
    if place.surface is None:
        raise InputError(say("Occlusion maps of the frames need a surface (DSM): give one, or give the maps "
                             "themselves."))
    masks = [folder / f"{number}.tif" for number in range(len(frames))]
    for number, (frame, mask) in enumerate(zip(frames, masks)):
        part = progress.part(number / len(frames), (number + 1) / len(frames))
        occlusion_map(camera, frame.pose, place.surface, place.ground, mask, settings, progress=part)
    return masks


def orthorectify(frames: Sequence[AerialFrame], camera: FrameCamera, place: ElevationInputs, output: MosaicFiles,
                 settings: OrthoSettings | None = None, progress: Progress = SILENT, watch: Callable | None = None,
                 shifts: list[FrameShift] | None = None, executor: Executor | None = None) -> Mosaic:
    """Lay frames on the ground as one mosaic (J 3.2.1), written as GeoTIFF in the CRS of the ground.

    Parameters
    ----------
    watch : see `write_mosaic`, which also tells of the files and errors.
    shifts : a list to which the shifts between overlapping frames are added; None not to measure them.
    executor : threads or processes that work on the pieces; the result does not depend on it.

    Raises
    ------
    InsufficientDataError : no frame shows any of the ground.
    """
    settings = settings or OrthoSettings()
    with ExitStack() as stack:
        if place.masks is None and settings.occlusion is not None:
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="urbanmap-")))
            masks = _frame_masks(frames, camera, place, settings.occlusion, folder, progress.part(0.0, 0.2))
            place, progress = replace(place, masks=masks), progress.part(0.2, 1.0)
        sources = open_frames(frames, camera, place, settings.height_threshold, stack)
        terrain, pixels = sources[0].terrain, sources[0].pixels
        own = _own_resolution(frames, camera, terrain)
        resolution = settings.resolution or own
        grid = covering_grid(sources, resolution)
        _warn_of_places(sources, terrain, grid, progress)
        if shifts is not None and len(sources) > 1:
            shifts += frame_shifts(sources, grid, progress.part(0.0, 0.1))
            refuse_contradiction(frames, shifts, partial(_compared, camera=camera, place=place, settings=settings))
            warn_of_shifts(shifts, resolution, progress)
        opener = None
        if executor is not None:
            stored = replace(place, outlines=stack.enter_context(sent_polygons(place.outlines)))
            opener = partial(open_frames, frames, camera, stored, settings.height_threshold)
        return write_mosaic(sources, grid, terrain.ground.crs_wkt, pixels.bands, pixels.dtype, output,
                            settings.choice, progress.part(0.1, 1.0), watch, Workers(executor, opener))


def _compared(frames: Sequence[AerialFrame], camera: FrameCamera, place: ElevationInputs,
              settings: OrthoSettings) -> list[FrameShift]:
    """Shifts between frames by other orientations than were given; none where these show no ground."""
    with ExitStack() as stack:
        sources = open_frames(frames, camera, replace(place, masks=None), settings.height_threshold, stack)
        try:
            own = _own_resolution(frames, camera, sources[0].terrain)
            return frame_shifts(sources, covering_grid(sources, settings.resolution or own))
        except UrbanMapError:
            return []


def _own_resolution(frames: Sequence[AerialFrame], camera: FrameCamera, terrain: Terrain) -> float:
    """Median pixel of the frames at the nadir, m, rounded to the centimetre (to the millimetre below 5 cm)."""
    ground = require_ground_pixel(camera, float(np.median([frame.pose.z for frame in frames])) - terrain.low)
    return max(round(ground, 2 if ground >= 0.05 else 3), 0.001)


def _warn_of_places(sources: Sequence[OrthorectifiedFrame], terrain: Terrain, grid: Grid, progress: Progress) -> None:
    """Warn of frames beside the ground and of a surface that does not cover the mosaic."""
    beside = [source.name for source in sources if source.bounds is None]
    if beside:
        progress.warn(say("{beside_count} frames show none of the ground and are left out: {beside}{value}.",
                          beside_count=len(beside), beside=", ".join(beside[:5]),
                          value=say(" and others") if len(beside) > 5 else ""))
    if terrain.surface is None:
        progress.warn(say("Without a surface (DSM) buildings cannot be told to hide the ground: they lie over it in "
                          "the mosaic."))
        return
    box, have = grid.bounds, terrain.surface.grid.bounds
    if box[0] < have[0] - grid.cell or box[1] < have[1] - grid.cell or box[2] > have[2] + grid.cell \
            or box[3] > have[3] + grid.cell:
        progress.warn(say("The surface (DSM) does not cover the whole mosaic: beyond it buildings lie over the "
                          "ground."))
