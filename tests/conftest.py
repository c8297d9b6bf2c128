"""What all tests share: real data where it is there, and small point clouds made on the spot."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections import Counter
from pathlib import Path

import laspy
import numpy as np
import pytest
from pyproj import CRS

from tests.stored import stored

ROOT = Path(__file__).resolve().parents[1]
SHARED_DATA = ROOT.parent / "shared" / "data"


def pytest_collection_modifyitems(items):
    """Files with most slow tests, then most tests, first: the processes that share them end at about one time."""
    tests = Counter(item.path for item in items)
    slow = Counter(item.path for item in items if item.get_closest_marker("slow"))
    items.sort(key=lambda item: (-slow[item.path], -tests[item.path]))


@pytest.fixture(autouse=True)
def told_fractions(monkeypatch):
    """Whatever runs tells fractions from 0 to 1 of its work, in parts within the whole."""
    from urbanmap_qgis.progress import Progress

    step, part = Progress.step, Progress.part

    def checked_step(self, fraction: float) -> None:
        assert -1e-6 <= fraction <= 1.0 + 1e-6, f"a fraction of {fraction} is told"
        step(self, fraction)

    def checked_part(self, start: float, end: float) -> Progress:
        assert -1e-6 <= start <= end + 1e-6 <= 1.0 + 2e-6, f"a part from {start} to {end} is given"
        return part(self, start, end)

    monkeypatch.setattr(Progress, "step", checked_step)
    monkeypatch.setattr(Progress, "part", checked_part)


@pytest.fixture(scope="session")
def real_data() -> Path:
    """Folder of the real test data; tests that need it skip where it is absent."""
    if not SHARED_DATA.is_dir():
        pytest.skip(f"the real test data are not beside the checkout ({SHARED_DATA.name})")
    return SHARED_DATA


@pytest.fixture(scope="session")
def small_city() -> Path:
    """Folder of a sample city of 100 m, made once for all parts of the tests and kept until its code changes."""
    write = importlib.import_module("urbanmap_qgis.samplecity.write")
    sources = Path(write.__file__).parent.rglob("*.py")
    return stored("small", sources, lambda folder: write.make_city(folder, 100, seed=1))


@pytest.fixture(scope="session")
def make_cloud():
    """Function that writes a LAS or LAZ file from arrays and gives back its path."""

    def make(path: Path, x, y, z, epsg: int | None = 6677, point_format: int = 6, extra: dict | None = None,
             **attributes) -> Path:
        header = laspy.LasHeader(point_format=point_format, version="1.4" if point_format >= 6 else "1.2")
        header.scales = [0.001] * 3
        header.offsets = [float(np.floor(np.min(axis))) if len(axis) else 0.0 for axis in (x, y, z)]
        if epsg:
            header.add_crs(CRS.from_epsg(epsg))
        for name in extra or {}:
            header.add_extra_dim(laspy.ExtraBytesParams(name, np.uint32))
        las = laspy.LasData(header)
        las.x, las.y, las.z = np.asarray(x, float), np.asarray(y, float), np.asarray(z, float)
        for name, values in {**(extra or {}), **attributes}.items():
            las[name] = np.broadcast_to(values, len(las.x))
        las.write(path)
        return path

    return make


@pytest.fixture(scope="session")
def synthetic():
    """The module of made-up town blocks, see synthetic_blocks.py."""
    name = "urbanmap_synthetic_blocks"
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, Path(__file__).with_name("synthetic_blocks.py"))
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
    return sys.modules[name]
