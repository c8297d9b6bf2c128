"""Files as they are, or packed with gzip ("town.gml.gz"): told from their first bytes, not from their names."""

from __future__ import annotations

import codecs
import gzip
import os
import re
import zlib
from pathlib import Path
from typing import IO, cast

from ...errors import InputError
from ...wording import say

_MAGIC = b"\x1f\x8b"
_LARGEST = 2**31
_PIECE = 2**20
_HEAD = 4096
CONTROL = re.compile(rb"[\x00-\x08\x0e-\x19\x1b-\x1f\x7f]")
"""What no text has in it."""

_ROOT = re.compile(rb"<(?![?!])(?:[\w.-]+:)?([A-Za-z_][\w.-]*)[\s/>]")


def open_unpacked(path: str | os.PathLike) -> IO[bytes]:
    """A file open for reading, unpacked on the way where it is packed."""
    with open(path, "rb") as stream:
        packed = stream.read(len(_MAGIC)) == _MAGIC
    return cast("IO[bytes]", gzip.open(path, "rb")) if packed else open(path, "rb")


def read_unpacked(path: str | os.PathLike) -> bytes:
    """All bytes of a file, unpacked where it is packed.

    Raises
    ------
    InputError : they are more than can be taken into memory.
    """
    pieces, size = [], 0
    with open_unpacked(path) as stream:
        while piece := stream.read(_PIECE):
            pieces.append(piece)
            size += len(piece)
            if size > _LARGEST:
                raise InputError(say("{label} holds more than {largest_zip} GB: unpack it first.",
                                     label=Path(path).name, largest_zip=_LARGEST >> 30))
    return b"".join(pieces)


def unpacked_name(path: str | os.PathLike) -> Path:
    """Path of a file without ".gz": "town.gml" of "town.gml.gz"."""
    path = Path(path)
    return path.with_suffix("") if path.suffix.lower() == ".gz" else path


def unpacked_suffix(path: str | os.PathLike) -> str:
    """Suffix of a file, lower case, ".gz" left out: ".gml" of "town.gml.gz"."""
    return unpacked_name(path).suffix.lower()


def content_kind(path: str | os.PathLike) -> str:
    """What a file holds by its first bytes: "json", the local name of the root of XML, "text" for other text, "" for
    all else."""
    try:
        with open_unpacked(path) as stream:
            head = stream.read(_HEAD)
    except (EOFError, OSError, zlib.error):
        return ""
    if head.removeprefix(codecs.BOM_UTF8).lstrip()[:1] == b"{":
        return "json"
    found = _ROOT.search(head) if b"<" in head[:100] else None
    return found.group(1).decode() if found else "" if CONTROL.search(head) or not head else "text"
