"""One sitting in QGIS's desktop on a virtual screen: its profile with the packages of these tests."""

from __future__ import annotations

import importlib.util
import shutil
import sys
import sysconfig
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]

NEEDS_DESKTOP = pytest.mark.skipif(
    shutil.which("xvfb-run") is None or not (shutil.which("qgis.bin") or shutil.which("qgis")),
    reason="no QGIS desktop or no xvfb-run (apt install qgis xvfb)")


def windows() -> ModuleType:
    """`scripts/make_tutorial_pictures.py`, which opens QGIS's desktop."""
    spec = importlib.util.spec_from_file_location("urbanmap_windows", ROOT / "scripts" / "make_tutorial_pictures.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def profile_with_packages(folder: Path) -> Path:
    """An English profile in a folder, whose packages are those of this Python."""
    profile = windows().profile_of(folder, "en")
    packages = profile / "config/profiles/default/python/urbanmap_packages"
    packages.mkdir(parents=True)
    version = f"py{sys.version_info.major}.{sys.version_info.minor}"
    (packages / version).symlink_to(sysconfig.get_path("purelib"), target_is_directory=True)
    return profile
