"""What the plugin loads when QGIS starts: itself, little of Python, and no package that only a run needs."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

START = """
import json, sys
from qgis.core import QgsApplication
application = QgsApplication([], False)
application.initQgis()
before = set(sys.modules)
import start_up_trial
plugin = start_up_trial.classFactory(None)
plugin.initProcessing()
registry = QgsApplication.processingRegistry()
listed = [algorithm.displayName() for algorithm in registry.providerById("urbanmap").algorithms()]
help = registry.algorithmById("urbanmap:segmentroofs").shortHelpString()
print(json.dumps([sorted(set(sys.modules) - before), len(listed), len(help)]))
"""

HEAVY = {"numpy", "scipy", "shapely", "laspy", "lazrs", "rasterio", "pyproj", "matplotlib", "cv2", "osgeo",
         "numba", "dask", "distributed", "asyncio", "ssl", "email", "difflib"}
"""Packages, also of Python itself, that take long to load."""

MOST_OWN, MOST_CORE, MOST_OTHERS = 165, 30, 170
"""Modules that may be loaded: of the plugin, of its core among them (errors, progress, the list of packages), and of
Python. 91, 9 and 116 when this was written; the plugin's share of the start was 0.10 to 0.15 s then."""


@pytest.fixture(scope="module")
def started(tmp_path_factory):
    """Modules that the start loads in a fresh process, number of algorithms, and letters of one's help."""
    folder = tmp_path_factory.mktemp("plugins")
    (folder / "start_up_trial").symlink_to(ROOT, target_is_directory=True)
    settings = tmp_path_factory.mktemp("profile")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(folder), os.environ.get("PYTHONPATH", "")]),
                   "QT_QPA_PLATFORM": "offscreen", "HOME": str(settings), "QGIS_CUSTOM_CONFIG_PATH": str(settings)}
    done = subprocess.run([sys.executable, "-c", START], env=environment, cwd=settings, text=True, capture_output=True,
                          timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_the_start_loads_no_package_that_only_a_run_needs(started):
    modules, algorithms, letters = started
    assert algorithms > 40 and letters > 100
    assert not HEAVY & {name.partition(".")[0] for name in modules}


def test_the_start_loads_few_modules(started):
    modules, *_ = started
    own = [name for name in modules if name.partition(".")[0] == "start_up_trial"]
    core = [name for name in own if name.startswith("start_up_trial.urbanmap_qgis")]
    assert len(own) <= MOST_OWN
    assert len(core) <= MOST_CORE, core
    assert len(modules) - len(own) <= MOST_OTHERS
