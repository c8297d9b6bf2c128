"""One place that turns what a parser raises on a damaged file into the sentence of the file's reader."""

from __future__ import annotations

import codecs
import contextlib
import csv
import functools
import inspect
import json
import os
import re
import struct
import sys
import zipfile
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar, cast
from xml.etree.ElementTree import ParseError  # nosec B405 # the error alone, no parser

import numpy as np

from ...errors import InputError, UrbanMapError
from ...wording import say
from .packed import CONTROL, read_unpacked

Read = TypeVar("Read", bound=Callable)

LONGEST_FIELD = 2**27
"""Characters of a field of a table: as long as the longest file that is read whole."""

LONGEST_INTEGER = 300
"""Digits of a whole number: those beyond 308 are too large for a decimal number."""

_MAY_BE_TOO_LARGE = re.compile(r"\d{301}|\d[eE]\+?\d{3}")
"""Numbers of JSON among which those lie that no decimal number holds."""

PARSER_ERRORS = (ArithmeticError, AttributeError, EOFError, LookupError, MemoryError, NotImplementedError, OSError,
                 ParseError, RuntimeError, TypeError, ValueError, csv.Error, np.linalg.LinAlgError, struct.error,
                 zipfile.BadZipFile, zlib.error)
"""What parsers raise on damaged files: LookupError is also an unknown encoding, RuntimeError also a recursion."""

_NO_NUMBER = re.compile(r"(?:could not convert string to float|invalid literal for int\(\) with base 10): "
                        r"(?:np\.str_\()?b?'([^']*)'")
"""What Python and numpy say of a text that is no number."""

csv.field_size_limit(min(sys.maxsize, LONGEST_FIELD))


def reads(what: str) -> Callable[[Read], Read]:
    """Decorator of a function whose first argument is a file, or several: `what` it reads, for the sentence.

    The core's own errors pass as they are. What else a parser raises becomes an `InputError` that names the file; the
    cause stays attached to it.
    """

    def decorate(function: Read) -> Read:
        if inspect.isgeneratorfunction(function):
            @functools.wraps(function)
            def guarded_pieces(path, *arguments, **named):
                try:
                    yield from function(path, *arguments, **named)
                except UrbanMapError:
                    raise
                except PARSER_ERRORS as error:
                    raise _refusal(path, what, error) from error

            return cast(Read, guarded_pieces)

        @functools.wraps(function)
        def guarded(path, *arguments, **named):
            try:
                # Numbers beyond all limits would be warned of; they are refused where they are checked.
                with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
                    return function(path, *arguments, **named)
            except UrbanMapError:
                raise
            except PARSER_ERRORS as error:
                raise _refusal(path, what, error) from error

        return cast(Read, guarded)

    return decorate


def _refusal(path: object, what: str, error: BaseException) -> InputError:
    return InputError(say("{name} cannot be read as {what}{reason}: it is damaged or of another kind; export or "
                          "download it again.", name=_name(path), what=what, reason=_reason(error)))


def unreadable_part(path: str | os.PathLike, part: str, error: BaseException) -> InputError:
    """The refusal of a file of which a row or an element cannot be read, to be raised from the parser's error.

    Parameters
    ----------
    part : what cannot be read, such as "node 12".
    """
    return InputError(say("{name}: {part} cannot be read{reason}: correct it, or export or download the file again.",
                          name=Path(path).name, part=part, reason=_reason(error)))


@contextlib.contextmanager
def reading_part(path: str | os.PathLike, part: str) -> Iterator[None]:
    """In the block, what a parser raises becomes the refusal that names the file's part, see `unreadable_part`.

    Raises
    ------
    InputError : the part cannot be read.
    """
    try:
        yield
    except UrbanMapError:
        raise
    except PARSER_ERRORS as error:
        raise unreadable_part(path, part, error) from error


def _name(path: object) -> str:
    paths = [path] if isinstance(path, (str, os.PathLike)) else path if isinstance(path, (list, tuple)) else []
    return ", ".join(Path(item).name for item in paths if isinstance(item, (str, os.PathLike))) or "The file"


def _reason(error: BaseException) -> str:
    """The cause where it says something to a surveyor."""
    if isinstance(error, OSError) and error.strerror:
        return f" ({error.strerror})"
    if isinstance(error, UnicodeError):
        return say(" (it is no text in UTF-8)")
    if isinstance(error, RecursionError):
        return say(" (it is nested too deep)")
    if isinstance(error, (MemoryError, OverflowError)):
        return say(" (a number in it is too large)")
    if isinstance(error, ParseError) and getattr(error, "position", None):
        return say(" (line {line} is no XML)", line=error.position[0])
    if isinstance(error, json.JSONDecodeError):
        return say(" (line {line} is no JSON)", line=error.lineno)
    if isinstance(error, KeyError) and error.args and isinstance(error.args[0], str):
        return say(" (“{name}” is missing in it)", name=error.args[0][:40])
    value = _NO_NUMBER.search(str(error)) if isinstance(error, ValueError) else None
    return say(" (“{value}” is no number)", value=value.group(1)[:40]) if value else ""


def read_text(path: str | os.PathLike, what: str) -> str:
    """A text file in UTF-8, in UTF-16 with its mark, or as Windows in Japanese saves it (code page 932), also gzipped.

    Raises
    ------
    InputError : it is no text, or cannot be read.
    """
    try:
        return _decoded(read_unpacked(path)).replace("\r\n", "\n").replace("\r", "\n")
    except (EOFError, OSError, UnicodeError, zlib.error) as error:
        raise _refusal(path, what, error) from error


def _decoded(data: bytes) -> str:
    """Text of bytes; the error is that of UTF-8 where they are in none of the encodings."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return data.decode("utf-16")
    try:
        return data.decode("utf-8-sig")
    except UnicodeError:
        # Bytes of no text at all may pass as Japanese: text has no control characters.
        if CONTROL.search(data):
            raise
        with contextlib.suppress(UnicodeError):
            return data.decode("cp932")
        raise


def read_json(path: str | os.PathLike, what: str) -> Any:
    """A JSON file in UTF-8, in which NaN and Infinity, which JSON does not have, and numbers beyond all are refused.

    Raises
    ------
    InputError : it is no JSON, or holds such a number.
    """
    text = read_text(path, what)
    # Looking at every number takes as long as all the rest.
    numbers = {"parse_int": _integer, "parse_float": _decimal} if _MAY_BE_TOO_LARGE.search(text) else {}
    try:
        return json.loads(text, parse_constant=_no_constant, **numbers)
    except _NoNumber as error:
        line = text.count("\n", 0, max(text.find(str(error)), 0)) + 1
        raise InputError(say("{path} cannot be read as {what}: “{number}” in its line {line} is no number that could "
                             "be used; correct it, or export it again.", path=Path(path).name, what=what,
                             number=str(error)[:20], line=line)) from error
    except (ValueError, RecursionError) as error:
        raise InputError(say("{path} cannot be read as {what}{reason}: it is not JSON, or damaged; export it again.",
                             path=Path(path).name, what=what, reason=_reason(error))) from error


class _NoNumber(ValueError):
    """A text of a JSON file that stands for no number; `str` of it is the text."""


def _no_constant(name: str) -> float:
    raise _NoNumber(name)


def _integer(text: str) -> int:
    if len(text) > LONGEST_INTEGER:
        raise _NoNumber(text)
    return int(text)


def _decimal(text: str) -> float:
    if np.isinf(float(text)):
        raise _NoNumber(text)
    return float(text)


def first_not_finite(table: np.ndarray) -> int | None:
    """First row of a table (n, ...) that holds NaN or infinity, counted from 0; None where there is none."""
    table = np.asarray(table, float)
    bad = np.flatnonzero(~np.isfinite(table.reshape(len(table), int(np.prod(table.shape[1:])))).all(axis=1))
    return int(bad[0]) if len(bad) else None
