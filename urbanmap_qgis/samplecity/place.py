"""Whether the sample city's folder can be made where the user wants it."""

from __future__ import annotations

import os
from pathlib import Path

from ..errors import OutputError


def check_place(folder: Path) -> None:
    """Raise `OutputError` unless a new folder can be made at the path."""
    if folder.is_file():
        raise OutputError(f"{folder} is a file: give the name of a new folder.")
    if folder.is_dir() and any(folder.iterdir()):
        raise OutputError(f"The folder {folder} is not empty: give the name of a new one.")
    if not folder.parent.is_dir():
        raise OutputError(f"The folder {folder.parent} does not exist: create it or choose another.")
    if not os.access(folder.parent, os.W_OK):
        raise OutputError(f"The folder {folder.parent} cannot be written: choose another.")
