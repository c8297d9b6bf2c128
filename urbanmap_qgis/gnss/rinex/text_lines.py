"""What all RINEX files have in common: bytes, lines, header."""

from __future__ import annotations

import bz2
import os
import re
import zlib
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...io.files.guard import reads
from ...wording import say
from .compact import is_compact, plain_rinex

_LARGEST = 2**30
_PIECE = 1 << 16
_MAGIC_GZIP, _MAGIC_BZIP = b"\x1f\x8b", b"BZh"
_MAGIC_COMPRESS, _MAGIC_ZIP = b"\x1f\x9d", b"PK\x03\x04"
BYTE_ORDER_MARK = b"\xef\xbb\xbf"


@dataclass(frozen=True)
class RinexFile:
    """A RINEX file cut into lines.

    Attributes
    ----------
    name : of the file, for messages.
    version : such as 2.11.
    kind : letter of the file type (column 21): O, N, G ...
    system : letter of the system (column 41), " " where none is told.
    header : (label, content of columns 1 to 60) of each header line.
    data : (b,) uint8, the body with spaces behind it.
    start, length : (l,) first byte and length of each line of the body, without its end.
    cut : the file ends within a line.
    notes : sentences on damage that was worked around.
    """

    name: str
    version: float
    kind: str
    system: str
    header: tuple[tuple[str, str], ...]
    data: np.ndarray
    start: np.ndarray
    length: np.ndarray
    cut: bool
    notes: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.start)

    def line(self, number: int) -> str:
        """Text of a line of the body."""
        start = self.start[number]
        return self.data[start:start + self.length[number]].tobytes().decode("latin-1")

    def contents(self, label: str) -> list[str]:
        """Contents (columns 1 to 60) of all header lines with a label."""
        return [content for name, content in self.header if name == label]


def read_bytes(path: str | os.PathLike) -> tuple[bytes, tuple[str, ...]]:
    """Content of a plain, gzipped or bzipped file and sentences on damage; one that breaks off is read up to there.

    Raises
    ------
    InputError : the file cannot be read, is empty, or is packed in another way.
    """
    path = Path(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(say("{path} cannot be read ({strerror}): check the file.", path=path.name,
                             strerror=error.strerror)) from error
    notes: tuple[str, ...] = ()
    if data[:2] == _MAGIC_GZIP:
        data, whole = _unpacked(data, path.name)
        if not whole:
            notes = (say("{path} breaks off: it is used up to there.", path=path.name),)
    elif data[:3] == _MAGIC_BZIP:
        data, whole = _unpacked_bzip(data, path.name)
        if not whole:
            notes = (say("{path} breaks off: it is used up to there.", path=path.name),)
    if data[:2] == _MAGIC_COMPRESS or data[:4] == _MAGIC_ZIP:
        raise InputError(say("{path} is packed in a way that is not read here: unpack it, or pack it with gzip.",
                             path=path.name))
    if not data.strip():
        raise InputError(say("{path} is empty: choose another file.", path=path.name))
    return data.removeprefix(BYTE_ORDER_MARK), notes


def _unpacked(data: bytes, name: str) -> tuple[bytes, bool]:
    """Content of gzip data of one or more members, and whether it ended as it should."""
    parts: list[bytes] = []
    while data[:2] == _MAGIC_GZIP:
        stream = zlib.decompressobj(31)
        try:
            last = _decompressed(stream, data, name, parts)
        except zlib.error as error:
            if not any(parts):
                raise InputError(say("{name} is not a sound gzip file: fetch it again.", name=name)) from error
            return b"".join(parts), False
        if not stream.eof:
            return b"".join(parts), False
        data = stream.unused_data + data[last + _PIECE:]
    return b"".join(parts), True


def _unpacked_bzip(data: bytes, name: str) -> tuple[bytes, bool]:
    """Content of bzip2 data, and whether it ended as it should."""
    parts: list[bytes] = []
    stream = bz2.BZ2Decompressor()
    try:
        _decompressed(stream, data, name, parts)
    except OSError as error:
        if not any(parts):
            raise InputError(say("{name} is not a sound bzip2 file: fetch it again.", name=name)) from error
    return b"".join(parts), stream.eof


def _decompressed(stream, data: bytes, name: str, parts: list[bytes]) -> int:
    """Put what a stream makes of data, up to its end, behind `parts`; where in the data the last piece begins."""
    first, total = 0, sum(map(len, parts))
    for first in range(0, len(data), _PIECE):
        parts.append(stream.decompress(data[first:first + _PIECE], _LARGEST))
        total += len(parts[-1])
        if total >= _LARGEST:
            raise _too_large(name)
        if stream.eof:
            break
    return first


def _too_large(name: str) -> InputError:
    return InputError(say("{name} holds more than {largest} MB when unpacked: give the files of one drive at a time.",
                          name=name, largest=_LARGEST >> 20))


@reads("RINEX")
def read_rinex(path: str | os.PathLike) -> RinexFile:
    """Read a RINEX file of version 2, 3 or 4, plain or compact (Hatanaka), and cut it into lines.

    Raises
    ------
    InputError : not readable, not RINEX, of a version that is not known, no end of header.
    """
    name = Path(path).name
    data, notes = read_bytes(path)
    first = data[:80].decode("latin-1")
    if is_compact(data):
        data = plain_rinex(data, name)
        first = data[:80].decode("latin-1")
    if "RINEX VERSION / TYPE" not in first[60:]:
        raise InputError(say("{name} is not a RINEX file: its first line does not say \"RINEX VERSION / TYPE\".",
                             name=name))
    try:
        version = float(first[:9])
    except ValueError as error:
        raise InputError(say("{name} tells no RINEX version in its first line: check the file.", name=name)) from error
    if not 2.0 <= version < 5.0:
        raise InputError(say("{name} is RINEX {version:.2f}: convert it to RINEX 2.11, 3 or 4.", name=name,
                             version=version))
    header, body = _split_header(data.replace(b"\r\n", b"\n"), name)
    return RinexFile(name, version, first[20], first[40], header, *_lines(body), not body.endswith(b"\n"), notes)


def _split_header(data: bytes, name: str) -> tuple[tuple[tuple[str, str], ...], bytes]:
    end = data.find(b"END OF HEADER")
    if end < 0:
        raise InputError(say("{name} has no \"END OF HEADER\": the file is not whole.", name=name))
    stop = data.find(b"\n", end)
    stop = len(data) if stop < 0 else stop + 1
    lines = data[:stop].decode("latin-1").split("\n")
    return tuple((line[60:].strip(), line[:60]) for line in lines if line), data[stop:]


def headers_within(file: RinexFile) -> list[tuple[int, int, RinexFile]]:
    """Whole headers in the body of a file made of several: first line, the line behind it, the file by that header."""
    found = []
    for first in map(int, np.flatnonzero(file.length > 60)):
        if not file.line(first)[60:].startswith("RINEX VERSION / TYPE"):
            continue
        lines = [file.line(first)]
        while first + len(lines) < len(file) and not lines[-1][60:].startswith("END OF HEADER"):
            following = file.line(first + len(lines))
            if not following[60:61].strip("0123456789.> -"):
                break
            lines.append(following)
        header = tuple((line[60:].strip(), line[:60]) for line in lines)
        version = float(lines[0][:9]) if re.fullmatch(r" *\d+(\.\d*)? *", lines[0][:9]) else 0.0
        found.append((first, first + len(lines), replace(file, version=version, kind=lines[0][20], system=lines[0][40],
                                                         header=header)))
    return found


def _lines(body: bytes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The body's bytes with spaces behind, and start and length of its lines."""
    data = np.frombuffer(body + b" " * 32, np.uint8)
    ends = np.flatnonzero(data == 10)
    if not body.endswith(b"\n") and body:
        ends = np.append(ends, len(body))
    start = np.concatenate([[0], ends[:-1] + 1]) if len(ends) else np.zeros(0, np.int64)
    return data, start.astype(np.int64), (ends - start).astype(np.int64)
