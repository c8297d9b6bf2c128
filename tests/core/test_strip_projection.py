"""Where road paint lies in the sample city's strip image against where its edges are seen: parts of a pixel."""

import sqlite3

import numpy as np
import pytest
import shapely

from urbanmap_qgis.io.raster import RasterSampler
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.lines.line_camera import project_to_strip
from urbanmap_qgis.mobile.lines.strip_images import read_columns, read_strips, sample_pixels
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

ACROSS = np.arange(-0.24, 0.2401, 0.02)


def polygons(path, table):
    """Polygons of a GeoPackage layer, without GDAL."""
    with sqlite3.connect(path) as base:
        blobs = [row[0] for row in base.execute(f"select geom from {table}")]
    envelope = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}
    return shapely.get_parts([shapely.from_wkb(blob[8 + envelope[(blob[3] >> 1) & 7]:]) for blob in blobs])


def edge_profiles(polygon):
    """Places (s, d, 2) across each straight edge of more than a metre, from inside to outside."""
    ring = shapely.get_coordinates(shapely.orient_polygons(polygon).exterior if hasattr(shapely, "orient_polygons")
                                   else shapely.normalize(polygon).exterior)
    sense = 1.0 if shapely.is_ccw(shapely.linearrings(ring)) else -1.0
    for start, end in zip(ring[:-1], ring[1:]):
        length = np.hypot(*(end - start))
        if length > 1.0:
            along = (end - start) / length
            outwards = sense * np.array([along[1], -along[0]])
            base = start + np.arange(0.3, length - 0.3, 0.1)[:, None] * along
            yield base[:, None] + ACROSS[:, None] * outwards


def crossing(brightness):
    """Where the mean brightness (d,) across an edge falls through the half, m; None where it is no clear edge."""
    inside, outside = np.median(brightness[:5]), np.median(brightness[-5:])
    half = (inside + outside) / 2
    falls = np.flatnonzero((brightness[:-1] >= half) & (brightness[1:] < half))
    if inside - outside < 60 or len(falls) != 1:
        return None
    k = falls[0]
    return ACROSS[k] + 0.02 * (brightness[k] - half) / (brightness[k] - brightness[k + 1])


@pytest.fixture(scope="module")
def offsets(small_city):
    """Offsets in rows (n,) of all edges along the road that are seen clearly."""
    lines = small_city / "lines"
    strip, = read_strips([lines / "camera_1.png"], read_calibration(lines / "calibration.json"))
    true = read_trajectory(small_city / "truth" / "lines_trajectory.csv").trajectory
    grey = read_columns(strip).mean(axis=2, dtype=float)[:, :, None]
    course = shapely.LineString(true.place[::20, :2])
    edges = [places for polygon in polygons(small_city / "truth" / "markings.gpkg", "mms")
             if polygon.distance(course) < 10.0 for places in edge_profiles(polygon)]
    flat = np.concatenate([places.reshape(-1, 2) for places in edges])
    with RasterSampler(small_city / "truth" / "ground.tif") as ground:
        seen = project_to_strip(np.column_stack([flat, ground.sample(*flat.T)]), strip, true, 15.0)
    place = np.full((len(flat), 2), np.nan)
    place[seen.point_index[::-1]] = np.column_stack([seen.column, seen.row])[::-1]
    found, first = [], 0
    for places in edges:
        part = place[first:first + places[..., 0].size].reshape(places.shape)
        first += places[..., 0].size
        if np.isnan(part).any():
            continue
        column, row = part[..., 0], part[..., 1]
        colours = sample_pixels(grey, column.ravel(), row.ravel()).reshape(column.shape)
        off = crossing(colours.mean(axis=0))
        if off is not None:
            step = [np.abs(np.gradient(values, axis=1)).mean() / 0.02 for values in (column, row)]
            if step[1] > 3 * step[0]:
                found.append(off * step[1])
    return np.array(found)


@pytest.mark.slow
def test_edges_are_seen_where_they_are_projected(offsets):
    assert len(offsets) >= 5
    assert abs(np.median(offsets)) < 0.3 and np.median(np.abs(offsets)) < 0.4 and np.abs(offsets).max() < 1.5
