"""What the core says to its user, in his language.

Sentences are written in English, as format strings with named fields; `say` looks them up in the catalogue of the
language. A catalogue is a Qt translation, compiled (`.qm`) or its source (`.ts`), read with the standard library, so
that the core and its worker processes need no Qt.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from xml.etree import ElementTree  # nosec B405 # reads our own translation source alone

_language: dict[str, Path | None] = {"catalogue": None}


def use_catalogue(path: str | os.PathLike | None) -> None:
    """Say everything from now on in the language of the catalogue at `path`; None for English."""
    _language["catalogue"] = Path(path) if path else None


def catalogue_path() -> Path | None:
    """The catalogue in use, for worker processes; None for English."""
    return _language["catalogue"]


def language() -> str:
    """Code of the language in use, such as "en" or "ja"."""
    path = catalogue_path()
    return path.stem.rpartition("_")[2] if path else "en"


def say(sentence: str, /, **values: object) -> str:
    """`sentence` in the user's language, its named fields filled with `values` as `str.format` does."""
    return known(sentence).format(**values)


def known(words: str) -> str:
    """`words` in the user's language where the catalogue holds them, else as they are; for words that are data too."""
    path = catalogue_path()
    return _read(path).get(words, words) if path else words


def mark(sentence: str) -> str:
    """`sentence` as it is: marks a constant for the catalogue that is said later."""
    return sentence


@lru_cache(maxsize=4)
def _read(path: Path) -> Mapping[str, str]:
    return read_catalogue(path)


def read_catalogue(path: str | os.PathLike) -> dict[str, str]:
    """Translations by their English text, of a Qt translation or its source; unfinished ones are left out.

    Raises
    ------
    ValueError : a compiled translation is none, or holds no English texts.
    """
    if Path(path).suffix == ".qm":
        return _compiled(Path(path).read_bytes())
    messages = ElementTree.parse(path).getroot().iter("message")  # nosec B314 # our own file
    texts = ((item.findtext("source", ""), item.find("translation")) for item in messages)
    return {source: found.text for source, found in texts
            if found is not None and found.text and found.get("type") not in ("unfinished", "vanished", "obsolete")}


_QM = bytes.fromhex("3cb86418caef9c95cd211cbf60a1bddd")
_HASHES, _MESSAGES = 0x42, 0x69
_END, _TRANSLATION, _OBSOLETE, _SOURCE = 1, 3, 5, 6


def _compiled(data: bytes) -> dict[str, str]:
    """Translations of a compiled Qt translation. Source: Qt's qtranslator.cpp, sections and tags of a QM file."""
    if not data.startswith(_QM):
        raise ValueError("no compiled Qt translation")
    sections, at = {}, len(_QM)
    while at + 5 <= len(data):
        tag, size = struct.unpack_from(">BI", data, at)
        sections[tag] = data[at + 5:at + 5 + size]
        at += 5 + size
    messages = sections.get(_MESSAGES, b"")
    places = [place for _, place in struct.iter_unpack(">II", sections.get(_HASHES, b""))]
    return dict(_message(messages, place) for place in places)


def _message(data: bytes, at: int) -> tuple[str, str]:
    """English text and translation of the message that begins at a place of the messages' section."""
    parts = {}
    while data[at] != _END:
        tag = data[at]
        if tag == _OBSOLETE:
            at += 5
            continue
        (size,) = struct.unpack_from(">I", data, at + 1)
        size = 0 if size == 0xffffffff else size
        parts[tag] = data[at + 5:at + 5 + size]
        at += 5 + size
    if _SOURCE not in parts:
        raise ValueError("a compiled Qt translation without its English texts")
    return parts[_SOURCE].decode("utf-8"), parts.get(_TRANSLATION, b"").decode("utf-16-be")
