"""New classes for the points of LAZ files, with all their other layers copied as they are.

From point format 6 on LASzip packs the attributes of a chunk's points into layers, one behind the other. How that of
the classes is packed depends on the classes, the returns and the scanner's channel alone (LASzip 3.4, `POINT14`): it is
made anew and put in the place of the old one. Each point is stored whole once at the head of its chunk, the first.
"""

from __future__ import annotations

import copy
import io
import os
import struct
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Protocol

import laspy
import lazrs
import numpy as np
from laspy.vlrs.known import LasZipVlr

from ..files.atomic import written_beside
from .pointcloud import NAMES_NOT_ASCII, CloudWriter, PointCloud, PointLayout, cloud_writer
from .whole_records import copied_records, joined_records

_CLASS_LAYER, _CLASS_PLACE = 2, 16
"""Place of the classes among a chunk's layers (behind x and y, and z), and of the class in a record, bytes."""

_CHANNEL = 0x30
"""Bits of the flags that tell the scanner's channel."""

_HEAD, _TABLE_PLACE = 4, 8
"""Bytes of a chunk's count of points, and of the place of the chunk table before all chunks."""

_VARIABLE = 2**32 - 1

_LAYERS = {6: 9, 7: 10, 8: 11, 9: 10, 10: 12}
"""Layers of a chunk of each point format; each byte of extra attributes has one more."""


class ClassWriter(Protocol):
    """Takes the points of a cloud, in their order and in any number of pieces, with new classes."""

    def write(self, points: laspy.ScaleAwarePointRecord, classes: np.ndarray) -> None:
        """Append points (n,) of the cloud with their classes (n,)."""


@dataclass(frozen=True)
class _Chunk:
    """Place of a chunk in its file, its bytes, its points, and whether its layers fill it."""

    place: int
    length: int
    points: int
    whole: bool


def layers_can_stay(cloud: PointCloud, output: str | os.PathLike) -> bool:
    """Whether a LAZ of a cloud's points with other classes can be made of the layers that its files have.

    If so, what is given to `class_writer` needs no more than the points' shape (`pointcloud.iter_chunks`).
    """
    if Path(output).suffix.lower() != ".laz":
        return False
    layout = PointLayout(cloud)
    return all(_fits(path, header, layout) for path, header in zip(cloud.paths, cloud.headers))


def _fits(path: Path, header: laspy.LasHeader, layout: PointLayout) -> bool:
    """Whether the layers of one file are those that its points would have in the output."""
    wanted = layout.header
    if not header.are_points_compressed or header.point_format.id < 6 or header.version.minor != 4:
        return False
    if not np.array_equal(header.scales, wanted.scales) or not np.array_equal(header.offsets, wanted.offsets):
        return False
    if header.point_format.id != wanted.point_format.id or header.point_format.dtype() != layout.dtype:
        return False
    ours = _laszip(wanted.point_format).record_data()
    theirs = _laszip_of(header)
    if (theirs[:4], theirs[32:]) != (ours[:4], ours[32:]):  # compressor, coder; kinds, sizes and versions of the items
        return False
    chunks = _chunks(path, header)
    return all(chunk.whole for chunk in chunks) and sum(chunk.points for chunk in chunks) == header.point_count


def _laszip(kind: laspy.PointFormat, variable: bool = False) -> lazrs.LazVlr:
    """How this package packs points of a format."""
    return lazrs.LazVlr.new_for_compression(kind.id, kind.num_extra_bytes, variable)


def _laszip_of(header: laspy.LasHeader) -> bytes:
    """The record that tells how a file is packed."""
    return header.vlrs[header.vlrs.index("LasZipVlr")].record_data


def _chunks(path: Path, header: laspy.LasHeader) -> list[_Chunk]:
    """The chunks of a file in their order, each with what it states of itself."""
    if not header.point_count:
        return []
    with path.open("rb") as file:
        file.seek(header.offset_to_point_data)
        lengths = [length for _, length in lazrs.read_chunk_table(file, lazrs.LazVlr(_laszip_of(header)))]
        place, found = header.offset_to_point_data + _TABLE_PLACE, []
        layers = _layer_count(header.point_format)
        head = header.point_format.size + _HEAD + 4 * layers
        for length in lengths:
            file.seek(place + header.point_format.size)
            points, *sizes = struct.unpack(f"<{1 + layers}I", file.read(_HEAD + 4 * layers))
            found.append(_Chunk(place, length, points, head + sum(sizes) == length))
            place += length
    return found


def _layer_count(kind: laspy.PointFormat) -> int:
    return _LAYERS[kind.id] + kind.num_extra_bytes


@contextmanager
def class_writer(path: str | os.PathLike, cloud: PointCloud) -> Iterator[ClassWriter]:
    """Open a LAZ (or LAS) file for all points of a cloud with new classes; it appears when the block succeeds.

    Where `layers_can_stay` only the classes are packed, else everything is.

    Raises
    ------
    OutputError : the file cannot be written there.
    """
    layout = PointLayout(cloud)
    if not layers_can_stay(cloud, path):
        with cloud_writer(path, layout) as writer:
            yield _Repacked(writer)
        return
    with written_beside(path) as temporary, temporary.open("w+b") as file:
        copied = _CopiedLayers(file, cloud, layout.header)
        yield copied
        copied.finish()


@dataclass(frozen=True)
class _Repacked:
    """Packs all attributes anew."""

    writer: CloudWriter

    def write(self, points: laspy.ScaleAwarePointRecord, classes: np.ndarray) -> None:
        """Append points (n,) with their classes (n,)."""
        layout = self.writer.layout
        view = layout.view(layout.adapt(points, np.ones(len(points), dtype=bool)))
        view.classification = classes
        self.writer.write(view.array)


class _CopiedLayers:
    """Copies chunks and packs their classes anew; the header is told of the points as they come."""

    def __init__(self, file: BinaryIO, cloud: PointCloud, header: laspy.LasHeader):
        sources = [(path, chunk) for path, one in zip(cloud.paths, cloud.headers) for chunk in _chunks(path, one)]
        self._file, self._sources, self._next = file, sources, 0
        size = _common_size([chunk.points for _, chunk in sources])
        self._laszip = lazrs.LazVlr(_with_size(_laszip(header.point_format, size == _VARIABLE).record_data(), size))
        self._header = copy.deepcopy(header)
        self._header.partial_reset()
        self._header.are_points_compressed = True
        self._header.vlrs.append(LasZipVlr(self._laszip.record_data()))
        self._header.write_to(file, encoding_errors=NAMES_NOT_ASCII)
        self._file.write(struct.pack("<q", -1))  # the place of the chunk table, when it is known
        self._table: list[tuple[int, int]] = []
        self._waiting = np.zeros(0, _point_layout())

    def write(self, points: laspy.ScaleAwarePointRecord, classes: np.ndarray) -> None:
        """Append points (n,) with their classes (n,)."""
        self._header.grow(points)
        records = np.zeros(len(points), _point_layout())
        records["bit_fields"] = points.array["bit_fields"]
        records["classification_flags"] = points.array["classification_flags"] & _CHANNEL
        records["classification"] = classes
        self._waiting = joined_records([self._waiting, records]) if len(self._waiting) else records
        done = 0
        while self._next < len(self._sources) and self._sources[self._next][1].points <= len(self._waiting) - done:
            path, chunk = self._sources[self._next]
            self._copy(path, chunk, self._waiting[done:done + chunk.points])
            done += chunk.points
            self._next += 1
        self._waiting = copied_records(self._waiting[done:])

    def _copy(self, path: Path, chunk: _Chunk, records: np.ndarray) -> None:
        with path.open("rb") as source:
            source.seek(chunk.place)
            packed = source.read(chunk.length)
        layers = with_classes(packed, self._header.point_format, records)
        self._file.write(layers)
        self._table.append((chunk.points, len(layers)))

    def finish(self) -> None:
        """Write the chunk table and the header's counts."""
        if len(self._waiting) or self._next != len(self._sources):
            raise ValueError("points that were not given, or more than there are")
        start, end = self._header.offset_to_point_data, self._file.tell()
        with io.BytesIO() as table:  # what a full disk makes of the writing of lazrs says little
            lazrs.write_chunk_table(table, self._table, self._laszip)
            self._file.write(table.getvalue())
        self._file.seek(start)
        self._file.write(struct.pack("<q", end))
        self._file.seek(0)
        self._header.write_to(self._file, ensure_same_size=True, encoding_errors=NAMES_NOT_ASCII)


def _point_layout() -> np.dtype:
    return laspy.PointFormat(6).dtype()


def _common_size(points: Sequence[int]) -> int:
    """Points of each chunk but the last, which may have fewer; `_VARIABLE` where they differ."""
    same = bool(points) and all(number == points[0] for number in points[:-1]) and points[-1] <= points[0]
    return points[0] if same else _VARIABLE


def _with_size(laszip: bytes, size: int) -> bytes:
    """LASzip's record with another number of points in a chunk."""
    return laszip[:12] + struct.pack("<I", size) + laszip[16:]


def with_classes(chunk: bytes, kind: laspy.PointFormat, points: np.ndarray) -> bytes:
    """A packed chunk with other classes.

    Parameters
    ----------
    chunk : first point, count, lengths of the layers, layers.
    kind : its point format, 6 to 10.
    points : (n,) of point format 6 with returns, channel and classes; nothing else may be in them.
    """
    lengths, place = _layers(chunk, kind)
    classes, record = _class_layer(points), kind.size
    low = place + sum(lengths[:_CLASS_LAYER])
    first = bytearray(chunk[:record])
    first[_CLASS_PLACE] = int(points["classification"][0])
    sizes = [*lengths[:_CLASS_LAYER], len(classes), *lengths[_CLASS_LAYER + 1:]]
    return b"".join((first, chunk[record:record + _HEAD], struct.pack(f"<{len(sizes)}I", *sizes), chunk[place:low],
                     classes, chunk[low + lengths[_CLASS_LAYER]:]))


def _layers(chunk: bytes, kind: laspy.PointFormat) -> tuple[tuple[int, ...], int]:
    """Lengths of the layers of a chunk, and where the first begins."""
    lengths = struct.unpack_from(f"<{_layer_count(kind)}I", chunk, kind.size + _HEAD)
    return lengths, kind.size + _HEAD + 4 * len(lengths)


def _class_layer(points: np.ndarray) -> bytes:
    """The packed layer of the classes of points (n,) of format 6."""
    kind = laspy.PointFormat(6)
    laszip = lazrs.LazVlr(_with_size(_laszip(kind).record_data(), len(points)))
    packed = lazrs.compress_points(laszip, np.ascontiguousarray(points).view(np.uint8), False)
    (end,) = struct.unpack_from("<q", packed)
    lengths, place = _layers(packed[_TABLE_PLACE:end], kind)
    low = _TABLE_PLACE + place + sum(lengths[:_CLASS_LAYER])
    return packed[low:low + lengths[_CLASS_LAYER]]
