"""What tests share and need long to make: made once, kept under build/ until the code that makes it changes."""

from __future__ import annotations

import fcntl
import hashlib
import importlib
import os
import platform
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

STORE = Path(__file__).resolve().parents[1] / "build" / "test_cities"

MAKERS = ("numpy", "scipy", "cv2", "rasterio", "shapely", "laspy", "pyproj")
"""Packages by which what is stored differs: two releases of OpenCV and GDAL draw other grey values (a tenth of all
pixels, by up to 60), and two of numpy other last digits."""


def stored(name: str, sources: Iterable[Path], make: Callable[[Path], None]) -> Path:
    """Folder that `make(folder)` has filled, now or in an earlier run with the same contents of `sources` and packages.

    Systems that share the store get each its own, so that no result depends on which asked first.
    Processes that ask at the same time wait for the one that makes it. Nobody may write into the folder.
    """
    contents = b"".join(path.read_bytes() for path in sorted(sources))
    key = hashlib.sha256(contents + _makers().encode()).hexdigest()[:12]
    folder = STORE / f"{name}-{key}"
    STORE.mkdir(parents=True, exist_ok=True)
    with folder.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not folder.is_dir():
            beside = folder.with_name(f"{folder.name}-{os.getpid()}")
            shutil.rmtree(beside, ignore_errors=True)
            beside.mkdir()
            make(beside)
            beside.rename(folder)
    return folder


def _makers() -> str:
    """Versions of Python, of the packages that make what is stored, and of GDAL."""
    versions = [importlib.import_module(name).__version__ for name in MAKERS]
    return " ".join([platform.python_version(), *versions, importlib.import_module("rasterio").__gdal_version__])
