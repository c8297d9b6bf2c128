"""Laser points of a plain with roofs, crowns and bridges, made for tests of buildings."""

from __future__ import annotations

import laspy
import numpy as np
import shapely

from urbanmap_qgis.io.points.pointcloud import open_cloud

SIDE = 100.0
CRS = "EPSG:28992"


def block_points(density, roofs=(), crowns=(), bridges=(), seed=0):
    """Coordinates (n, 3), returns and numbers of returns (n,) of unclassified points.

    `roofs` : (outline, height, slope to the north); `crowns` : (x, y, height); `bridges` : (west, south, east, north,
    height), rising from the ground at both ends.
    """
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0, SIDE, (int(density * SIDE ** 2), 2))
    z, number, count = np.zeros(len(xy)), np.ones(len(xy), int), np.ones(len(xy), int)
    for outline, height, slope in roofs:
        inside = shapely.contains_xy(outline, *xy.T)
        z[inside] = height + slope * (xy[inside, 1] - outline.bounds[1])
    for west, south, east, north, height in bridges:
        inside = shapely.contains_xy(shapely.box(west, south, east, north), *xy.T)
        along = (xy[inside, 0] - west) / (east - west)
        z[inside] = height * np.minimum(1.0, 3.0 * np.minimum(along, 1.0 - along))
    z += rng.normal(0, 0.02, len(z))
    for x, y, height in crowns:
        inside = np.hypot(xy[:, 0] - x, xy[:, 1] - y) < 4.0
        crown = np.column_stack([np.repeat(xy[inside], 2, axis=0),
                                 height + rng.uniform(-2.5, 2.5, 2 * np.count_nonzero(inside))])
        count[inside], number[inside] = 3, 3
        xy, z = np.vstack([xy, crown[:, :2]]), np.append(z, crown[:, 2])
        number = np.append(number, np.tile([1, 2], len(crown) // 2))
        count = np.append(count, np.full(len(crown), 3))
    return np.column_stack([xy, z]), number, count


def write_block(path, points, number, count):
    """Write such points as LAZ."""
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = [0.001] * 3, [0.0] * 3
    las = laspy.LasData(header)
    las.x, las.y, las.z = points.T
    las.return_number, las.number_of_returns = number, count
    las.write(str(path))
    return path


def block_cloud(folder, density, **things):
    """Cloud of such points in a file of a folder."""
    return open_cloud([write_block(folder / "block.laz", *block_points(density, **things))], CRS)
