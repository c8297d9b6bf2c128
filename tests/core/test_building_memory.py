"""The memory of the first stage does not grow with the file: six times the points, the same peak."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]

# Small pieces, and nothing kept in memory between them, so that the test can be small too.
RUN = """
import json, re, sys
import numpy as np, shapely
from urbanmap_qgis.buildings import segmentation
from urbanmap_qgis.buildings.outlines.footprint import clean_footprints
from urbanmap_qgis.buildings.roof_stage import segment_cloud_roofs
from urbanmap_qgis.io.points import pointcloud
from urbanmap_qgis.io.points.point_buckets import PointBuckets
cloud, side, folder = sys.argv[1], int(sys.argv[2]), sys.argv[3]
PointBuckets.__init__.__defaults__ = (0,)
pointcloud.iter_chunks.__defaults__ = (*pointcloud.iter_chunks.__defaults__[:-1], 100_000)
segmentation.TILE_SIDE = (80.0, 80.0)
outlines = [shapely.box(x, y, x + 12, y + 15) for x in range(0, side, 30) for y in range(0, side, 30)]
found = segmentation.segment_buildings(pointcloud.open_cloud([cloud]), clean_footprints(np.array(outlines)),
                                       folder + "/buildings.laz",
                                       segmentation.SegmentationParameters(maximum_displacement=0.0))
roofs = segment_cloud_roofs(pointcloud.open_cloud([folder + "/buildings.laz"]), clean_footprints(found.outlines),
                            folder + "/roofs.laz", None, found.ground)
peak = re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read())[1]
print(json.dumps([int(peak), int((found.status == "ok").sum()),
                  len(roofs.height), float(np.abs(roofs.height - 9.0).max())]))
"""


def peak(folder, make_cloud, side):
    """Peak memory (kB), buildings with points, roofs, and largest error of a roof's height in a run on a square."""
    random = np.random.default_rng(1)
    count = int(side * side * 4)
    x, y = random.uniform(0, side, (2, count))
    roof = (x % 30 < 12) & (y % 30 < 15)
    cloud = make_cloud(folder / f"{side}.las", x, y, np.where(roof, 9.0, 3.0), classification=np.where(roof, 6, 2))
    done = subprocess.run([sys.executable, "-c", RUN, str(cloud), str(side), str(folder)], cwd=ROOT, text=True,
                          capture_output=True, check=True)
    return json.loads(done.stdout)


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="peak memory is read from Linux's /proc")
def test_peak_memory_does_not_grow_with_the_file(make_cloud, tmp_path):
    small, buildings_small, *_ = peak(tmp_path, make_cloud, 180)
    large, buildings_large, roofs, error = peak(tmp_path, make_cloud, 450)
    assert (buildings_small, buildings_large, roofs) == (36, 225, 225)
    assert error < 0.01
    print(f"peak {small / 1000:.0f} MB at 0.13 million points, {large / 1000:.0f} MB at 0.8 million")
    assert large - small < 30_000
