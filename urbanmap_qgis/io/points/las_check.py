"""LAS and LAZ files checked against their own size before a decoder sees them.

A decoder trusts the counts and lengths in a file: a damaged one makes it ask for more memory than there is, which ends
the whole program, or count for hours. What is checked here is what the formats say of themselves: ASPRS LAS 1.0 to 1.4
(header, VLRs, EVLRs) and LASzip's record, chunk table and, for the point formats 6 to 10, the layers of each chunk.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ...errors import InputError
from ...wording import say


@dataclass(frozen=True)
class LasCheckLimits:
    """Limits of las check, each with its unit."""

    # Bytes of a record of each point format, without extra bytes.
    record_lengths: tuple[float, ...] = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
    laszip_id: int = 22204
    bytes14: int = 14
    variable: float = 2**32 - 1
    # Points of a chunk for which the decoder makes room whether the file has them or not: what no program writes.
    large_chunk: float = 2**27


LIMITS = LasCheckLimits()

_HEADER, _VLR, _EVLR = 227, 54, 60
_LAYERS = {10: 9, 11: 1, 12: 2, 13: 1}
"""Layers of the items of LASzip 3 by their type: point, colours, colours with near infrared, wave packet."""
_EXTRA_TYPES, _EXTRA_BYTES = 30, 192
"""Kinds of extra attributes by the number that tells them, and bytes of the description of one."""
_EXTRA_SIZES = (1, 1, 2, 2, 4, 4, 8, 8, 4, 8)
"""Bytes of the kinds 1 to 10; the next ten are pairs, the last triples of them."""


class _Damaged(Exception):
    """What is wrong, as the end of a sentence."""


@dataclass(frozen=True)
class _Header:
    """What is checked of a header."""

    point_format: int
    compressed: bool
    record_length: int
    points_start: int
    count: int
    header_size: int
    vlrs: int
    evlrs: int
    evlrs_start: int


def check_las(path: str | os.PathLike) -> None:
    """Refuse a LAS or LAZ file whose counts and lengths cannot be true of a file of its size.

    Raises
    ------
    InputError : with what is wrong.
    """
    path = Path(path)
    try:
        size = path.stat().st_size
        with path.open("rb") as file:
            header = _header(file, size)
            records = _vlrs(file, header)
            _check_evlrs(file, header, size)
            if header.compressed:
                _check_compressed(file, header, records, size)
            elif header.points_start + header.count * header.record_length > size:
                complete = max(size - header.points_start, 0) // header.record_length
                raise _Damaged(say("it is truncated: it holds {held:,} of {count:,} points", held=complete,
                                   count=header.count))
    except OSError as error:
        raise InputError(say("{path} cannot be read ({strerror}).", path=path.name, strerror=error.strerror)) from error
    except (_Damaged, struct.error, OverflowError) as error:
        reason = error if isinstance(error, _Damaged) else say("its header is cut off")
        raise InputError(say("{path} cannot be read as LAS or LAZ ({reason}): copy or download it again, or convert "
                             "it if it is of another kind.", path=path.name, reason=reason)) from error


@contextmanager
def decoding(path: str | os.PathLike) -> Iterator[None]:
    """Turn a panic of the decoder, which Python does not count among errors, into the sentence for damaged files."""
    try:
        yield
    except BaseException as error:
        if type(error).__name__ != "PanicException":
            raise
        raise InputError(say("{path} is damaged: copy or download it again.", path=Path(path).name)) from None


def _header(file: BinaryIO, size: int) -> _Header:
    start = file.read(375)
    if len(start) < _HEADER or start[:4] != b"LASF":
        raise _Damaged(say("it does not begin as such a file does"))
    version = start[24], start[25]
    if version[0] != 1 or version[1] > 4:
        raise _Damaged(say("its version {version}.{version_2} is none that is known", version=version[0],
                           version_2=version[1]))
    header_size, points_start, vlrs, kind, record_length, count = struct.unpack_from("<HIIBHI", start, 94)
    evlrs_start, evlrs = 0, 0
    if version[1] == 4:
        evlrs_start, evlrs, long_count = struct.unpack_from("<QIQ", start, 235)
        count = long_count or count
    if not _HEADER <= header_size <= points_start <= size:
        raise _Damaged(say("its header and the place of its points do not fit its size"))
    point_format = kind & 0x3F
    if point_format >= len(LIMITS.record_lengths):
        raise _Damaged(say("its point format {point_format} is none that is known", point_format=point_format))
    if record_length < LIMITS.record_lengths[point_format]:
        raise _Damaged(say("its records of {record_length} bytes are too short for point format {point_format}",
                           record_length=record_length, point_format=point_format))
    numbers = np.frombuffer(start, "<f8", 12, 131)
    with np.errstate(over="ignore", invalid="ignore"):
        farthest = numbers[:3] * 2.0**31 + numbers[3:6]
    if not np.isfinite(numbers).all() or not np.isfinite(farthest).all() or (numbers[:3] == 0).any():
        raise _Damaged(say("its scales, offsets or bounds are no usable numbers"))
    return _Header(point_format, bool(kind & 0xC0), record_length, points_start, count, header_size, vlrs, evlrs,
                   evlrs_start)


def _vlrs(file: BinaryIO, header: _Header) -> list[tuple[bytes, int, bytes]]:
    """User id, record id and content of the variable length records."""
    if header.vlrs * _VLR > header.points_start - header.header_size:
        raise _Damaged(say("there is no room for its {vlrs:,} variable length records", vlrs=header.vlrs))
    records, place = [], header.header_size
    for _ in range(header.vlrs):
        file.seek(place)
        user, record, length = struct.unpack("<2x16sHH32x", file.read(_VLR))
        if place + _VLR + length > header.points_start:
            raise _Damaged(say("its variable length records reach into its points"))
        records.append((user.rstrip(b"\0"), record, file.read(length)))
        place += _VLR + length
    for user, record, content in records:
        if (user, record) == (b"LASF_Spec", 4):
            _check_extra(content, header.record_length - LIMITS.record_lengths[header.point_format])
    return records


def _check_extra(content: bytes, room: int) -> None:
    """Descriptions of extra attributes: their kinds are known, those of any bytes (kind 0) have some, and the points
    have room for them (bytes)."""
    if len(content) % _EXTRA_BYTES:
        raise _Damaged(say("its record of extra attributes is cut off"))
    kinds = np.frombuffer(content, np.uint8).reshape(-1, _EXTRA_BYTES)[:, 2:4]
    if (kinds[:, 0] > _EXTRA_TYPES).any() or ((kinds[:, 0] == 0) & (kinds[:, 1] == 0)).any():
        raise _Damaged(say("its record of extra attributes holds one of no known kind"))
    kind, count = kinds[:, 0].astype(int), kinds[:, 1].astype(int)
    sizes = np.where(kind == 0, count, np.array(_EXTRA_SIZES)[(kind - 1) % 10] * ((kind - 1) // 10 + 1))
    if sizes.sum() > room:
        raise _Damaged(say("its record of extra attributes describes {sizes} bytes a point, and its points have room "
                           "for {room}", sizes=int(sizes.sum()), room=room))


def _check_evlrs(file: BinaryIO, header: _Header, size: int) -> None:
    if not header.evlrs:
        return
    if header.evlrs_start + header.evlrs * _EVLR > size:
        raise _Damaged(say("there is no room for its {evlrs:,} extended records", evlrs=header.evlrs))
    place = header.evlrs_start
    for _ in range(header.evlrs):
        file.seek(place)
        (length,) = struct.unpack("<20xQ32x", file.read(_EVLR))
        place += _EVLR + length
        if place > size:
            raise _Damaged(say("its extended records reach beyond its end"))


def _check_compressed(file: BinaryIO, header: _Header, records: list[tuple[bytes, int, bytes]], size: int) -> None:
    laszip = [content for user, record, content in records if (user, record) == (b"laszip encoded", LIMITS.laszip_id)]
    if not laszip:
        raise _Damaged(say("it is compressed, but its record on the compression is missing"))
    items = _items(laszip[0], header)
    if is_pointwise(laszip[0]):
        return
    (chunk_size,) = struct.unpack_from("<I", laszip[0], 12)
    chunks = _chunks(file, header, laszip[0], chunk_size, size)
    if any(kind in _LAYERS or kind == LIMITS.bytes14 for kind, _ in items):
        _check_layers(file, header, items, chunks, chunk_size)


def is_pointwise(laszip: bytes) -> bool:
    """Whether LASzip's record tells of one stream without chunks (compressor 1), as its first versions wrote."""
    return struct.unpack_from("<H", laszip)[0] == 1


def _items(laszip: bytes, header: _Header) -> list[tuple[int, int]]:
    """Type and size of the parts of a record as LASzip packs them."""
    if len(laszip) < 34:
        raise _Damaged(say("its record on the compression is cut off"))
    compressor, coder = struct.unpack_from("<HH", laszip, 0)
    (number,) = struct.unpack_from("<H", laszip, 32)
    if compressor not in (1, 2, 3) or coder != 0 or len(laszip) < 34 + 6 * number:
        raise _Damaged(say("its record on the compression is none that is known"))
    items = [struct.unpack_from("<HH", laszip, 34 + 6 * place) for place in range(number)]
    if sum(length for _, length in items) != header.record_length:
        raise _Damaged(say("its record on the compression does not fit its points"))
    return items


def _chunks(file: BinaryIO, header: _Header, laszip: bytes, chunk_size: int, size: int) -> list[tuple[int, int]]:
    """Points and bytes of each chunk, checked against the count of points and the file's size."""
    if not header.count:
        return []
    file.seek(header.points_start)
    (place,) = struct.unpack("<q", file.read(8))
    if place == -1:
        file.seek(size - 8)
        (place,) = struct.unpack("<q", file.read(8))
    if not header.points_start + 8 <= place <= size - 8:
        raise _Damaged(say("the table of its chunks is not where it says"))
    file.seek(place)
    version, number = struct.unpack("<II", file.read(8))
    room = place - header.points_start - 8
    if version != 0 or not 0 < number <= room // header.record_length:
        raise _Damaged(say("there is no room for its {number:,} chunks", number=number))
    if chunk_size == 0 or (chunk_size != LIMITS.variable and not (number - 1) * chunk_size < header.count
                           <= number * chunk_size):
        raise _Damaged(say("its {number:,} chunks do not hold {count:,} points", number=number, count=header.count))
    if chunk_size != LIMITS.variable and chunk_size > max(header.count, LIMITS.large_chunk):
        raise _Damaged(say("it says that its chunks hold {chunk_size:,} points", chunk_size=chunk_size))
    chunks = _chunk_table(file, header, laszip)
    if len(chunks) != number or any(length < header.record_length for _, length in chunks) or sum(
            length for _, length in chunks) > room:
        raise _Damaged(say("the table of its chunks does not fit its size"))
    if chunk_size == LIMITS.variable and sum(points for points, _ in chunks) != header.count:
        raise _Damaged(say("its chunks do not hold {count:,} points", count=header.count))
    return chunks


def _chunk_table(file: BinaryIO, header: _Header, laszip: bytes) -> list[tuple[int, int]]:
    import lazrs

    file.seek(header.points_start)
    try:
        return list(lazrs.read_chunk_table(file, lazrs.LazVlr(laszip)))
    except (lazrs.LazrsError, OSError, ValueError, RuntimeError) as error:
        raise _Damaged("the table of its chunks is damaged") from error
    except BaseException as error:
        if type(error).__name__ != "PanicException":
            raise
        raise _Damaged("the table of its chunks is damaged") from None


def _check_layers(file: BinaryIO, header: _Header, items: list[tuple[int, int]], chunks: list[tuple[int, int]],
                  chunk_size: int) -> None:
    """The lengths of each chunk's layers, for which the decoder makes room at once, add up to the chunk's."""
    layers = sum(length if kind == LIMITS.bytes14 else _LAYERS.get(kind, 0) for kind, length in items)
    head = header.record_length + 4 + 4 * layers
    place = header.points_start + 8
    for _, length in chunks:
        file.seek(place + header.record_length)
        numbers = np.frombuffer(file.read(4 + 4 * layers), "<u4").astype(np.int64)
        if len(numbers) < 1 + layers or head + numbers[1:].sum() > length or (
                chunk_size != LIMITS.variable and numbers[0] > chunk_size):
            raise _Damaged(say("the lengths within a chunk do not fit it"))
        place += length
