"""Contours of walls: the alpha shape of each segment in its plane, openings kept as holes (J 5.7).

What a wall shows and hides is reported: share of its rectangle (from end to end, from the ground up to its top or the
maximum height) that is seen, share of openings, share not seen behind something that stands in front.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
import shapely
from scipy import ndimage

from ..geometry.alpha_shape import alpha_shape, signed_area
from ..io.points.point_buckets import stable_order
from ..settings.facades import WallSettings
from .laser_beams import LaserBeams, crossed_cells
from .normals import numbered_cells
from .plane_fit import WallPlane, component

THIN = 0.12  # One point in each square of this side (m) is enough for a hull.
OFF = 0.1705  # How far the middles of two squares may be from what is in them, both together, m.
CELL = 0.25  # Cells on which shares are counted, m.
SPACINGS = 3.0
MIN_ALPHA = 0.35
MAX_ALPHA = 1.2
IN_FRONT = 0.3
SIDEWARDS = 4
SIMPLIFICATION = 0.04
GRID = 0.001

DEFAULTS = WallSettings()


@dataclass(frozen=True, eq=False)
class Contour:
    """One contour on a wall's plane.

    Attributes
    ----------
    polygon : in the plane's axes (along, up), m from the plane's point, holes kept.
    points : number of points in it.
    filled : share of its area that are gaps too small to be kept as openings, or gaps over which pieces were joined.
    measured : the polygon without the gaps over which pieces were joined.
    """

    polygon: shapely.Polygon
    points: int
    filled: float
    measured: shapely.Geometry

    @property
    def openings(self) -> float:
        """Share of the outer contour's area that is holes."""
        outer = shapely.area(shapely.polygons(self.polygon.exterior))
        return 1.0 - self.polygon.area / outer


@dataclass(frozen=True)
class WallCoverage:
    """How much of a wall's rectangle was seen.

    Attributes
    ----------
    area : of the rectangle, m2.
    coverage : share within the contour.
    hidden : share outside of it, or in its openings, with something standing in front.
    unseen : share that neither is seen nor has anything in front.
    through : share outside of it, or in its openings, that beams went through: glass, openings, or no wall; NaN where
        the lines of sight are not known.
    """

    area: float
    coverage: float
    hidden: float
    unseen: float
    through: float = float("nan")


def in_plane(plane: WallPlane, points: np.ndarray) -> np.ndarray:
    """Points (n, 3) in the plane's axes, (n, 2) m from its point."""
    away = points - plane.point
    return np.column_stack([component(away, axis) for axis in plane.axes])


def on_map(plane: WallPlane, flat: shapely.Geometry) -> shapely.Geometry:
    """A geometry in the plane's axes as one with x, y, z on the plane; counterclockwise seen from in front."""
    along, up = plane.axes
    return shapely.transform(shapely.force_3d(flat), lambda c: plane.point + c[:, :1] * along + c[:, 1:2] * up,
                             include_z=True)


def wall_contours(plane: WallPlane, points: np.ndarray,
                  settings: WallSettings = DEFAULTS) -> list[Contour]:
    """Contours of a wall's points (n, 3), the largest first; empty where none is large enough."""
    flat = in_plane(plane, points)
    alpha = settings.alpha or contour_alpha(flat)
    hull = alpha_polygon(*_thinned(flat, alpha), alpha)
    contours = []
    for joined, measured in _joined(shapely.get_parts(hull), settings.max_gap):
        if measured.area < settings.min_area:
            continue
        polygon, filled = _without_small_holes(joined, settings.min_opening)
        bridges = shapely.difference(joined, measured)
        shapely.prepare(polygon)
        contours.append(Contour(polygon, int(shapely.contains_xy(polygon, *flat.T).sum()),
                                filled + float(bridges.area / polygon.area), shapely.difference(polygon, bridges)))
    return sorted(contours, key=lambda contour: -contour.polygon.area)


def _joined(pieces: np.ndarray, max_gap: float) -> list[tuple[shapely.Polygon, shapely.Geometry]]:
    """Pieces of a plane joined over gaps, and what of each was measured: the pieces themselves."""
    if len(pieces) < 2 or max_gap <= 0:
        return [(piece, piece) for piece in pieces]
    outer = shapely.union_all(shapely.polygons([shapely.get_exterior_ring(piece) for piece in pieces]))
    grown = shapely.buffer(outer, max_gap / 2, join_style="mitre")
    # At sharp corners mitres are cut, so that what is shrunk again may lack parts of the pieces, or all of one, or meet
    # itself.
    shrunk = shapely.make_valid(shapely.buffer(grown, -max_gap / 2, join_style="mitre"))
    closed = shapely.union(shrunk, outer)
    bridges = shapely.get_parts(shapely.difference(closed, outer))
    contours = []
    for whole in shapely.get_parts(closed):
        members = pieces[shapely.intersects(shapely.point_on_surface(pieces), whole)]
        if not len(members):
            continue
        measured = shapely.union_all(members)
        joined = members[0]
        if len(members) > 1:
            # Only what leads from one piece to another: bays of one piece stay as they are.
            links = [part for part in bridges if part.geom_type == "Polygon"
                     and np.count_nonzero(shapely.dwithin(members, part, 1e-6)) > 1]
            joined = shapely.union_all([measured, *links], grid_size=GRID)
        parts = [part for part in shapely.get_parts(joined) if part.geom_type == "Polygon" and part.area > 1e-3]
        contours += [(part, shapely.intersection(part, measured)) for part in parts]
    return contours


def _thinned(flat: np.ndarray, alpha: float) -> tuple[np.ndarray, np.ndarray]:
    """One point of each small square, well within the wall one of each four: those that the alpha shape needs, and
    those too deep within for it.
    """
    place = np.floor((flat - flat.min(axis=0)) / THIN).astype(np.int64)
    height = int(place[:, 1].max()) + 1
    code = place[:, 0] * height + place[:, 1]
    first = _first_of_each(code)
    row, column = code[first] // height, code[first] % height
    chosen = np.flatnonzero(~_surrounded(row, column, 2) | ((row % 2 == 0) & (column % 2 == 0)))
    points = flat[first[chosen]]
    deep = _deep(row[chosen], column[chosen], alpha)
    return points[~deep], points[deep]


def _deep(row: np.ndarray, column: np.ndarray, alpha: float) -> np.ndarray:
    """Points (n,), one in each square, all of whose Delaunay triangles have a circumradius below `alpha`, m, as far as
    the squares tell.

    A wider circle holds one as wide as alpha through the same point. That is empty: no point is nearer to its middle
    than alpha, and this one is no farther.
    """
    if alpha <= OFF:
        return np.zeros(len(row), bool)
    pad = math.ceil((alpha + OFF) / THIN) + 1
    empty = np.ones((int(row.max()) + 2 * pad + 1, int(column.max()) + 2 * pad + 1), np.uint8)
    empty[row + pad, column + pad] = 0
    middles = _away(empty) < alpha - OFF
    return _away(middles.view(np.uint8))[row + pad, column + pad] > alpha + OFF


def _away(squares: np.ndarray) -> np.ndarray:
    """Distance of squares from the nearest that is 0, m."""
    return cv2.distanceTransform(squares, cv2.DIST_L2, cv2.DIST_MASK_PRECISE) * THIN


def _first_of_each(code: np.ndarray) -> np.ndarray:
    """Indices of the first of each different whole number (n,), the numbers ascending."""
    order = stable_order(code)
    code = code[order]
    return order[np.flatnonzero(np.append(True, code[1:] != code[:-1]))]


def _surrounded(row: np.ndarray, column: np.ndarray, cells: int) -> np.ndarray:
    """Which squares (n,) have so many others on every side."""
    filled = np.zeros((int(row.max()) + 1, int(column.max()) + 1), np.uint8)
    filled[row, column] = 1
    square = np.ones((2 * cells + 1, 2 * cells + 1), np.uint8)
    return cv2.erode(filled, square, borderType=cv2.BORDER_CONSTANT, borderValue=0)[row, column] > 0


def contour_alpha(flat: np.ndarray) -> float:
    """Three times the spacing of points (n, 2) where they are thin: the sparsest tenth of the filled half metres."""
    place = np.floor((flat - flat.min(axis=0)) / 0.5).astype(np.int64)
    height = int(place[:, 1].max()) + 1
    *_, count = numbered_cells(place[:, 0] * height + place[:, 1])
    spacing = 0.5 / math.sqrt(float(np.quantile(count, 0.2)))
    return float(np.clip(SPACINGS * spacing, MIN_ALPHA, MAX_ALPHA))


def alpha_polygon(flat: np.ndarray, left_out: np.ndarray, alpha: float) -> shapely.Geometry:
    """Polygons that points (n, 2) cover: their alpha shape, its rings joined and simplified.

    `left_out` (m, 2) : further points deep within, see `alpha_shape`.
    """
    rings = alpha_shape(flat, alpha, left_out)
    outer, holes = [], []
    for ring in rings:
        xy = flat[ring]
        (outer if signed_area(xy) > 0 else holes).append(shapely.Polygon(xy))
    if not outer:
        return shapely.MultiPolygon()
    hull = shapely.union_all(shapely.make_valid(outer))
    if holes:
        hull = shapely.difference(hull, shapely.union_all(shapely.make_valid(holes)))
    hull = shapely.simplify(hull, SIMPLIFICATION)
    parts = shapely.get_parts(hull if hull.is_valid else shapely.make_valid(hull))
    return shapely.MultiPolygon([part for part in parts if part.geom_type == "Polygon"])


def _without_small_holes(polygon: shapely.Polygon, least: float) -> tuple[shapely.Polygon, float]:
    """The polygon with small holes filled, and their share of its area."""
    holes = [shapely.Polygon(ring) for ring in polygon.interiors]
    large_holes = [hole.exterior for hole in holes if hole.area >= least]
    filled = sum(hole.area for hole in holes if hole.area < least)
    cleaned = shapely.Polygon(polygon.exterior, large_holes)
    cleaned = shapely.orient_polygons(cleaned) if hasattr(shapely, "orient_polygons") \
        else shapely.geometry.polygon.orient(cleaned)
    return cleaned, float(filled / cleaned.area)


def wall_coverage(plane: WallPlane, contours: list[Contour], foot: float, top: float, front: np.ndarray,
                  beams: LaserBeams | None = None) -> WallCoverage:
    """How much of the wall between heights `foot` and `top` (m) its contours cover, and what stands before the rest.

    Parameters
    ----------
    front : (k, 3) thinned places of everything near the building.
    beams : lines of sight to them; with them what hides the wall is what beams ended at, else what stands in front.
    """
    shape = shapely.union_all([contour.measured for contour in contours])
    left, low, right, high = shape.bounds
    low, high = min(low, foot - plane.point[2]), max(high, top - plane.point[2])
    columns = max(math.ceil((right - left) / CELL), 1)
    rows = max(math.ceil((high - low) / CELL), 1)
    u, v = np.meshgrid(left + (np.arange(columns) + 0.5) * CELL, low + (np.arange(rows) + 0.5) * CELL)
    shapely.prepare(shape)
    seen = shapely.contains_xy(shape, u, v)
    if beams is not None:
        before, through = crossed_cells(beams, plane, (left, low), (rows, columns), CELL)
        through &= ~seen
        return _shares((right - left) * (high - low), seen, before & ~through, float(through.mean()))
    before = np.zeros_like(seen)
    if len(front):
        off = plane.distance(front)
        flat = in_plane(plane, front[off > IN_FRONT])
        place = np.floor((flat - (left, low)) / CELL).astype(np.int64)
        inside = ((place >= 0) & (place < (columns, rows))).all(axis=1)
        before[place[inside, 1], place[inside, 0]] = True
        # It is seen aslant: what stands in front hides something to its sides and above.
        before = ndimage.binary_dilation(before, np.ones((2 * SIDEWARDS + 1, 2 * SIDEWARDS + 1)))
    return _shares((right - left) * (high - low), seen, before)


def _shares(area: float, seen: np.ndarray, before: np.ndarray, through: float = float("nan")) -> WallCoverage:
    """Shares of a wall's cells: seen, hidden by what stands before it, the rest; `through` was counted already."""
    covered, hidden = float(seen.mean()), float((before & ~seen).mean())
    rest = 1.0 - covered - hidden - (through if np.isfinite(through) else 0.0)
    return WallCoverage(area, covered, hidden, max(rest, 0.0), through)
