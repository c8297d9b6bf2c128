"""What the running core is: its sources and the packages that it works with."""

from __future__ import annotations

import hashlib
import pkgutil
from collections.abc import Iterable
from pathlib import Path

MARK_FILE = "sources_mark.txt"
"""Holds the mark of a copy that was packed into an archive."""


def sources_mark() -> str:
    """Short text that changes with the core's sources; the same for a copy of them in an archive."""
    folder = Path(__file__).parent
    if not folder.is_dir():
        return pkgutil.get_data(__package__, MARK_FILE).decode()
    content = hashlib.sha256()
    for path in source_files():
        content.update(path.relative_to(folder).as_posix().encode())
        content.update(path.read_bytes())
    return content.hexdigest()[:16]


def packed_sources() -> dict[str, Path]:
    """All modules of the core by their names in it, such as ``io/raster.py``; also where its folder is a link."""
    folder = Path(__file__).parent
    return {path.relative_to(folder).as_posix(): path for path in source_files()}


def source_files() -> list[Path]:
    """All modules of the core."""
    return sorted(Path(__file__).parent.rglob("*.py"))


def package_versions(names: Iterable[str]) -> dict[str, str]:
    """Versions of packages by their names on the package index, empty where one is missing."""
    from importlib.metadata import PackageNotFoundError, version  # QGIS's start needs none of it

    found = {}
    for name in names:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = ""
    return found
