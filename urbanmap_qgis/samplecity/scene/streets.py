"""Lays out the streets, the ground under them and the lanes on them."""

from __future__ import annotations

import numpy as np
import shapely

from .ground import Ground, LoweredKerb, Street
from .model import Lane

AVENUE_PITCH, STREET_PITCH = 72.0, 80.0
"""Distances between streets along u and along v, m."""

BEYOND = 25.0
"""Lanes and markings go on beyond the city's square, m."""

ISLAND_WIDTH, ISLAND_END, ISLAND_LENGTH = 0.8, 16.0, 24.0
"""Of islands in the middle of the avenue: width, distance from the kerb line of a crossing street, greatest length."""


def make_ground(size: float, origin: tuple[float, float], rng: np.random.Generator) -> Ground:
    """Ground with an avenue (A, along u) and a street (B, along v) that cross at the origin, and side streets."""
    streets = [Street("A", "u", 0.0, 8.7, 3.5, 2), Street("B", "v", 0.0, 6.2, 3.0, 1)]
    for along, pitch, letter in (("u", AVENUE_PITCH, "A"), ("v", STREET_PITCH, "B")):
        count = int((size / 2 - 18.0) // pitch)
        for number in range(1, count + 1):
            for side in (1, -1):
                streets.append(Street(f"{letter}{2 * number - (side > 0)}", along, side * number * pitch, 3.0, 2.0, 1,
                                      2.7))
    angle = float(rng.uniform(8.0, 20.0))
    slope = (float(rng.uniform(0.008, 0.016)), float(rng.uniform(-0.012, -0.004)))
    return Ground(origin, angle, float(rng.uniform(11.0, 15.0)), slope, 0.2, tuple(streets))


def make_lanes(ground: Ground, size: float) -> tuple[Lane, ...]:
    """Lanes of all streets, traffic on the left. The survey drives in the kerb lane of the avenue and the street."""
    lanes = []
    half_extent = size / 2 + BEYOND
    for street in ground.streets:
        for side in (1, -1):
            for number in range(street.lanes):
                across = street.at + side * (number + 0.5) * street.lane_width
                # Traffic in the direction of u keeps to its left, the side of +v; along v to the side of -u.
                ends = ((-side * half_extent, across), (side * half_extent, across))
                if street.along == "v":
                    across = street.at - side * (number + 0.5) * street.lane_width
                    ends = ((across, -side * half_extent), (across, side * half_extent))
                start, end = (tuple(float(c) for c in ground.to_world(*uv)) for uv in ends)
                lanes.append(Lane(street.name, start, end, street.lane_width,
                                  survey=street.name in ("A", "B") and number == street.lanes - 1))
    return tuple(lanes)


def lowered_kerbs(ground: Ground, size: float) -> tuple[LoweredKerb, ...]:
    """Driveways over the pavements of the main streets, clear of crossings."""
    places = []
    for street in (s for s in ground.streets if s.name in ("A", "B")):
        others = [other for other in ground.streets if other.along != street.along]
        for start in np.arange(-size / 2 + 14.5, size / 2 - 10.0, 30.0):
            if all(abs(start + 2.0 - other.at) > other.half_width + 12.0 for other in others):
                places += [LoweredKerb(street.name, side, float(start), float(start) + 4.0) for side in (1, -1)]
    return tuple(places)


def median_islands(ground: Ground, size: float) -> tuple[shapely.Polygon, ...]:
    """Raised islands with round ends along the middle of the avenue, clear of crossings; in u, v."""
    avenue = next(street for street in ground.streets if street.name == "A")
    others = [other for other in ground.streets if other.along != avenue.along]
    islands = []
    for start in np.arange(-size / 2 + 6.0, size / 2 - 8.0, ISLAND_LENGTH + 8.0):
        clear = [(float(other.at - other.half_width - ISLAND_END), float(other.at + other.half_width + ISLAND_END))
                 for other in others]
        end = min([start + ISLAND_LENGTH, size / 2 - 6.0, *(low for low, _ in clear if low > start)])
        if end - start < 5.0 or any(low < start < high for low, high in clear):
            continue
        half = ISLAND_WIDTH / 2.0
        line = shapely.linestrings([[start + half, avenue.at], [end - half, avenue.at]])
        islands.append(line.buffer(half, quad_segs=8))
    return tuple(islands)
