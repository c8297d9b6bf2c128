"""Whether the sample city's folder can be made where the user wants it."""

from __future__ import annotations

import os
from pathlib import Path

from ..errors import OutputError
from ..wording import say


def check_place(folder: Path) -> None:
    """Raise `OutputError` unless a new folder can be made at the path."""
    if folder.is_file():
        raise OutputError(say("{folder} is a file: give the name of a new folder.", folder=folder))
    if folder.is_dir() and any(folder.iterdir()):
        raise OutputError(say("The folder {folder} is not empty: give the name of a new one.", folder=folder))
    if not folder.parent.is_dir():
        raise OutputError(say("The folder {parent} does not exist: create it or choose another.", parent=folder.parent))
    if not os.access(folder.parent, os.W_OK):
        raise OutputError(say("The folder {parent} cannot be written: choose another.", parent=folder.parent))
