"""Files that an input file names: found only where the model lies, and only of the kind that is wanted.

A stranger's model may name any file of the user's disk as an image, and an export would copy it into what is
published. So every path that comes out of an input file goes through `named_file`.
"""

from __future__ import annotations

import os
from pathlib import Path, PurePosixPath

IMAGE, CODE_LIST = "image", "list of codes"
"""What is named: an image of a texture, or a list of codes (gml:Dictionary)."""

_IMAGES = (b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"II*\0", b"MM\0*")
"""First bytes of PNG, JPEG and TIFF (both orders of bytes)."""

_LISTS = "codelists"
"""PLATEAU's folder of lists, beside `udx`: files in `udx/<theme>` name it `../../codelists`."""


def named_file(owner: str | os.PathLike, name: str, kind: str, root: str | os.PathLike | None = None) -> Path | None:
    """The file that an input file names, None where it may not be read, is not there or is of another kind.

    It must lie, with all links followed, in the folder of the model: `root`, where a folder was given, else the
    owner's own, or for a file in `udx/<theme>` the data set around them. Lists of codes may lie in `../../codelists`,
    where the specification of PLATEAU has them.

    Parameters
    ----------
    owner : file that holds the name.
    name : as it stands there.
    kind : `IMAGE` or `CODE_LIST`.
    """
    folder = Path(owner).parent
    relative = relative_name(name)
    if relative is None:
        return None
    try:
        found = (folder / relative).resolve()
        if not any(found.is_relative_to(place) for place in _places(folder, root, kind)) or not found.is_file():
            return None
        with found.open("rb") as file:
            return found if is_kind(file.read(16), kind) else None
    except (OSError, RuntimeError, ValueError):  # no such name can be: too long, a circle of links, a zero byte
        return None


def relative_name(name: str) -> PurePosixPath | None:
    """A name as a relative path; None for an address, an absolute path or one with a drive."""
    text = name.replace("\\", "/")
    return None if not text or ":" in text or text.startswith("/") else PurePosixPath(text)


def is_kind(head: bytes, kind: str) -> bool:
    """Whether a file's first bytes are those of a kind. A list of codes is XML in some encoding, which is parsed."""
    return head.startswith(_IMAGES) if kind == IMAGE else b"<" in head


def _places(folder: Path, root: str | os.PathLike | None, kind: str) -> list[Path]:
    """Folders in which a named file may lie, links followed."""
    base = folder.resolve()
    places = [base] if root is None else [Path(root).resolve()]
    if base.parent.name == "udx":
        places.append(base.parent.parent)
    if kind == CODE_LIST:
        places.append(base.parent.parent / _LISTS)
    return places
