"""What the core says to its user, in his language.

Sentences are written in English, as format strings with named fields; `say` looks them up in the catalogue of the
language. A catalogue is a Qt translation source (`.ts`), read with the standard library, so that the core and its
worker processes need no Qt.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from xml.etree import ElementTree

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
    """Translations by their English text, of a Qt translation source; unfinished ones are left out."""
    messages = ElementTree.parse(path).getroot().iter("message")
    texts = ((item.findtext("source", ""), item.find("translation")) for item in messages)
    return {source: found.text for source, found in texts
            if found is not None and found.text and found.get("type") not in ("unfinished", "vanished", "obsolete")}
