"""Packages that bring their own GEOS, PROJ and GDAL, kept apart from QGIS's copies.

On Linux `qgis_process` has QGIS's GEOS, PROJ and GDAL in the scope in which every library loaded later looks for
its functions first. The wheels of shapely, pyproj and rasterio carry other versions of these libraries
under other file names but with the same function names: their calls would end in QGIS's copies, with wrong answers
and crashes ("WKB output dimension must be 2 or 3", "munmap_chunk(): invalid pointer"). A library loaded with
RTLD_DEEPBIND (see dlopen(3)) looks into its own copies first. On Windows and macOS names are bound to files.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
import pkgutil
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

PACKAGES_WITH_LIBRARIES = ("shapely", "pyproj", "rasterio")


def import_apart(packages: Iterable[str]) -> None:
    """Import those of `packages` that bring such libraries, bound to their own copies.

    To be called before anything else imports them; what is imported already stays as it is.
    """
    with _bound_to_own_copies():
        for name in PACKAGES_WITH_LIBRARIES:
            if name in packages and name not in sys.modules and importlib.util.find_spec(name):
                for module in _extension_modules(importlib.import_module(name)):
                    importlib.import_module(module)


@contextmanager
def _bound_to_own_copies() -> Iterator[None]:
    if not hasattr(os, "RTLD_DEEPBIND"):
        yield
        return
    flags = sys.getdlopenflags()
    sys.setdlopenflags(os.RTLD_NOW | os.RTLD_DEEPBIND)
    try:
        yield
    finally:
        sys.setdlopenflags(flags)


def _extension_modules(package) -> list[str]:
    """Compiled modules of a package: one that were imported later would be bound to QGIS's copies."""
    found = []
    for folder in map(Path, package.__path__):
        for module in pkgutil.iter_modules([str(folder)]):
            if any((folder / f"{module.name}{suffix}").is_file() for suffix in EXTENSION_SUFFIXES):
                found.append(f"{package.__name__}.{module.name}")
    return sorted(found)
