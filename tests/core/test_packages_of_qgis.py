"""What the core uses of packages is there in the versions that QGIS's own Python brings, which stand before newer ones
of the plugin in QGIS's window."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SYSTEM = Path("/usr/lib/python3/dist-packages")
FILES = ("test_opendrive", "test_roadmap_lanes", "test_tile_codes", "test_edge_sampling", "test_reprojection",
         "test_job")


@pytest.mark.slow
@pytest.mark.skipif(not (SYSTEM / "pyproj").is_dir(), reason="the system brings no pyproj of its own")
def test_the_core_runs_on_the_pyproj_that_qgis_brings():
    files = [str(path) for name in FILES for path in (ROOT / "tests/core").glob(f"{name}*.py")]
    data = str(Path(sys.base_prefix) / "share" / "proj")  # which that pyproj looks for beside the Python it came with
    environment = {**os.environ, "PYTHONPATH": str(SYSTEM), "PROJ_DATA": data, "PROJ_LIB": data}
    told = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "-m", "not slow", *files], cwd=ROOT,
        env=environment, capture_output=True, text=True, check=False)
    assert told.returncode == 0, told.stdout[-3000:]
