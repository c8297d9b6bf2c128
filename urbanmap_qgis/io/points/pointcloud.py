"""LAS, LAZ and COPC: read in chunks, written whole with every attribute kept."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import laspy
import lazrs
import numpy as np
from laspy.vlrs.known import GeoKeyDirectoryVlr, WktCoordinateSystemVlr
from lazrs import LazrsError
from pyproj import CRS

from ...errors import InputError, InsufficientDataError
from ...progress import SILENT, Progress, notice
from ...wording import say
from ..files.atomic import written_beside
from ..reference.height_systems import refuse_other_heights
from ..reference.system_parts import parsed_crs, same_horizontal
from ..reference.true_lengths import require_true_lengths
from .decoded_points import decoded_points
from .las_check import check_las, decoding, is_pointwise
from .stated_crs import stated_crs
from .whole_records import copied_records, record_rows

CHUNK_POINTS = 1_000_000
"""Points held in memory at a time while reading."""

FIRST_POINTS = 1000
"""Points of a file that are held against the box in its header."""

NAMES_NOT_ASCII = "replace"
"""What laspy does with names that are not ASCII, as programs in Japan write them: it writes them as it read them."""

NOISE_CLASSES = (7, 18)
"""LAS classes of low and high noise."""

_SHAPE = (laspy.DecompressionSelection.base() | laspy.DecompressionSelection.Z
          | laspy.DecompressionSelection.CLASSIFICATION | laspy.DecompressionSelection.FLAGS
          | laspy.DecompressionSelection.ALL_EXTRA_BYTES)

_READ_ERRORS = (laspy.errors.LaspyException, LazrsError, OSError, ValueError, EOFError, RuntimeError)


_GIVEN: ContextVar[tuple[str | None, frozenset[Path]]] = ContextVar("given_crs", default=(None, frozenset()))


@contextmanager
def given_crs(crs_wkt: str | None, paths: Iterable[Path] = ()) -> Iterator[None]:
    """In the block, files that state no CRS are taken to be in this one (WKT), and those of `paths` whatever they
    state; None leaves things as they are."""
    token = _GIVEN.set((crs_wkt, frozenset(paths)) if crs_wkt else _GIVEN.get())
    try:
        yield
    finally:
        _GIVEN.reset(token)


@dataclass(frozen=True)
class PointCloud:
    """One or several point cloud files taken as one cloud.

    Attributes
    ----------
    paths : the files, in the order given.
    headers : their LAS headers.
    crs_wkt : WKT of the coordinate reference system, None where no file states one.
    minimum, maximum : (3,) corners of the bounding box from the headers.
    """

    paths: tuple[Path, ...]
    headers: tuple[laspy.LasHeader, ...]
    crs_wkt: str | None
    minimum: np.ndarray
    maximum: np.ndarray

    @property
    def point_count(self) -> int:
        """Number of points by the headers."""
        return sum(header.point_count for header in self.headers)

    def has_dimension(self, name: str) -> bool:
        """Whether every file has the named dimension (standard or extra)."""
        return all(name in header.point_format.dimension_names for header in self.headers)


def open_cloud(paths: Sequence[str | os.PathLike], crs_wkt: str | None = None,
               may_be_empty: bool = False) -> PointCloud:
    """Open the headers of LAS, LAZ or COPC files and check that they form one cloud.

    Parameters
    ----------
    paths : one or several files.
    crs_wkt : the coordinate reference system to use where the files state none.
    may_be_empty : accept files without any point, which an earlier step may have had to write.

    Raises
    ------
    InputError : a file is missing, is no LAS/LAZ, or the files' CRS differ.
    InsufficientDataError : there are no points in any file.
    """
    files = tuple(Path(path) for path in paths)
    if not files:
        raise InputError(say("No point cloud was given: choose one or several LAS or LAZ files."))
    headers = tuple(_header(path) for path in files)
    given, renamed = _GIVEN.get()
    stated = [(path, crs) for path, header in zip(files, headers)
              if (crs := _counting_crs(path, header, given if path in renamed else None))]
    for path, crs in stated[1:]:
        if not same_horizontal(crs.to_wkt(), stated[0][1].to_wkt()):
            raise InputError(say("{path} is in {crs}, but {stated} is in {stated_2}: give files of one coordinate "
                                 "reference system.", path=path.name, crs=crs.name, stated=stated[0][0].name,
                                 stated_2=stated[0][1].name))
        refuse_other_heights(path.name, crs.to_wkt(), stated[0][0].name, stated[0][1].to_wkt())
    full = [header for header in headers if header.point_count]
    if not full and not may_be_empty:
        raise InsufficientDataError(say("{files} holds no points: choose another point cloud.", files=files[0].name))
    corners = np.array([_box(path, header) for path, header in zip(files, headers) if header.point_count]
                       or [(headers[0].mins, headers[0].maxs)], dtype=float)
    if not np.isfinite(corners).all():
        raise InputError(say("{files} has coordinates that are not numbers: repair the file's header.",
                             files=files[0].name))
    minimum, maximum = corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)
    wkt = stated[0][1].to_wkt() if stated else given or crs_wkt
    if full:
        require_true_lengths(files[0].name, wkt, (*minimum[:2], *maximum[:2]))
    return PointCloud(files, headers, wkt, minimum, maximum)


def _counting_crs(path: Path, header: laspy.LasHeader, given: str | None) -> CRS | None:
    """The system that a file states, or the one that was given for it; the user is told where they differ."""
    if given is None:
        return stated_crs(path, header)
    counting = parsed_crs(given)
    try:
        stated = stated_crs(path, header)
    except InputError:  # what is given is there to put it right
        return counting
    if stated is None:
        return counting
    if same_horizontal(stated.to_wkt(), given) and not counting.is_compound:
        return stated  # with its heights
    notice(say("{path} says that it is in {stated}; {given} counts, which was given for it.", path=path.name,
               stated=stated.name, given=counting.name))
    return counting


def _box(path: Path, header: laspy.LasHeader) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest coordinates (3,) of a file, which its header states, or where its first points lie outside of
    these, found from all points."""
    stated = np.asarray(header.mins, float), np.asarray(header.maxs, float)
    if not np.isfinite(stated).all():
        return stated
    stamp = path.stat()
    try:
        if _first_points_lie_in(path, stamp.st_mtime_ns, stamp.st_size):
            return stated
        box = _true_box(path, stamp.st_mtime_ns, stamp.st_size)
    except _READ_ERRORS as error:
        raise InputError(say("{path} is damaged: copy or download it again.", path=path.name)) from error
    notice(say("The box in the header of {path} does not hold its points: it was found from them.", path=path.name))
    return box


@lru_cache(maxsize=4096)
def _first_points_lie_in(path: Path, _changed: int, _size: int) -> bool:
    with decoding(path), laspy.open(path) as reader:
        header = reader.header
        points = reader.read_points(min(FIRST_POINTS, header.point_count))
    place = np.array([points.x, points.y, points.z])
    slack = header.scales[:, None]
    return bool(((place >= header.mins[:, None] - slack) & (place <= header.maxs[:, None] + slack)).all())


@lru_cache(maxsize=4096)
def _true_box(path: Path, _changed: int, _size: int) -> tuple[np.ndarray, np.ndarray]:
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    with decoding(path), laspy.open(path, decompression_selection=_SHAPE) as reader:
        for chunk in reader.chunk_iterator(CHUNK_POINTS):
            place = np.array([chunk.x, chunk.y, chunk.z])
            low, high = np.fmin(low, place.min(axis=1)), np.fmax(high, place.max(axis=1))
    return low, high


def _header(path: Path) -> laspy.LasHeader:
    """Header of one file, or the sentence that tells the user why not."""
    if not path.is_file():
        raise InputError(say("The point cloud {path} does not exist.", path=path))
    check_las(path)
    try:
        with decoding(path), laspy.open(path) as reader:
            return reader.header
    except _READ_ERRORS as error:
        raise InputError(say("{path} cannot be read as LAS or LAZ ({error}): it may be truncated or of another kind.",
                             path=path.name, error=error)) from error


def iter_chunks(cloud: PointCloud, progress: Progress = SILENT, chunk_points: int = CHUNK_POINTS, *,
                shape_only: bool = False, timed: bool = False) -> Iterator[laspy.ScaleAwarePointRecord]:
    """Give the cloud's points in chunks, file after file, reporting the share read.

    With `shape_only` times, intensities and colours may be 0: of LAZ of the point formats from 6 on these layers are
    not decoded. Coordinates, returns, classes, flags and extra attributes are there, times too where `timed`.

    Raises
    ------
    InputError : a file ends before the number of points that its header promises.
    """
    layers = _SHAPE if shape_only else laspy.DecompressionSelection.all()
    if timed:
        layers |= laspy.DecompressionSelection.GPS_TIME
    done = 0
    total = max(cloud.point_count, 1)
    for path, header in zip(cloud.paths, cloud.headers):
        read = 0
        try:
            for chunk in _chunks(path, header, chunk_points, layers):
                read += len(chunk)
                yield chunk
                progress.step((done + read) / total)
        except _READ_ERRORS as error:
            raise InputError(say("{path} is damaged or truncated after {read:,} of {point_count:,} points: copy or "
                                 "download it again.", path=path.name, read=read,
                                 point_count=header.point_count)) from error
        if read < header.point_count:
            raise InputError(say("{path} is truncated: it holds {read:,} of {point_count:,} points; copy or download "
                                 "it again.", path=path.name, read=read, point_count=header.point_count))
        done += read


def _chunks(path: Path, header: laspy.LasHeader, chunk_points: int,
            layers: laspy.DecompressionSelection) -> Iterator[laspy.ScaleAwarePointRecord]:
    """The points of one file, from where `decoded_points.decoded_once` holds them if it does."""
    holder = decoded_points() if header.are_points_compressed else None
    decoded = holder.chunks(path, header, chunk_points) if holder else None
    if decoded is not None:
        yield from decoded
        return
    with decoding(path), laspy.open(path, decompression_selection=layers) as reader:
        chunks = reader.chunk_iterator(chunk_points)
        whole = layers == laspy.DecompressionSelection.all()
        yield from holder.remember(path, header, chunks) if holder and whole else chunks


def can_be_entered(header: laspy.LasHeader) -> bool:
    """Whether the points of a file can be read from any place on.

    Where LAZ chunks differ in their number of points, as in COPC, lazrs goes to a wrong place without a word; without
    chunks it knows no place.
    """
    laszip = header.vlrs.get("LasZipVlr") if header.are_points_compressed else []
    return not any(lazrs.LazVlr(record.record_data).uses_variable_size_chunks() or is_pointwise(record.record_data)
                   for record in laszip)


def valid_points(points: laspy.ScaleAwarePointRecord) -> np.ndarray:
    """Mask (n,) of points that are neither noise (classes 7, 18) nor withheld, with heights in reason."""
    keep = np.abs(np.asarray(points.z)) < 1e5  # not so for what is no number
    keep &= ~of_classes(points, NOISE_CLASSES)
    keep &= ~np.asarray(points.withheld).astype(bool)
    return keep


def of_classes(points: laspy.ScaleAwarePointRecord, classes: Iterable[int]) -> np.ndarray:
    """Mask (n,) of the points of some classes (0 to 255)."""
    wanted = np.zeros(256, dtype=bool)
    wanted[list(classes)] = True
    return wanted[np.asarray(points.classification)]


class PointLayout:
    """The record layout that holds the points of all files of a cloud, plus new attributes.

    Parameters
    ----------
    cloud : the cloud whose attributes are kept.
    extra : names of unsigned 32 bit attributes to add (name, description).
    """

    def __init__(self, cloud: PointCloud, extra: Sequence[tuple[str, str]] = ()):
        first = max(cloud.headers, key=lambda header: header.point_format.id)
        header = laspy.LasHeader(point_format=first.point_format.id, version=first.version)
        header.offsets = _common_offsets(cloud)
        header.scales = _common_scales(cloud, header.offsets)
        header.global_encoding = cloud.headers[0].global_encoding
        header.system_identifier = cloud.headers[0].system_identifier
        header.generating_software = "UrbanMap"
        header.creation_date = cloud.headers[0].creation_date
        for source in cloud.headers:
            known = set(header.point_format.dimension_names) | {name for name, _ in extra}
            header.add_extra_dims([_extra_parameters(dimension) for dimension
                                   in source.point_format.extra_dimensions if dimension.name not in known])
        header.add_extra_dims([laspy.ExtraBytesParams(name, np.uint32, description[:31])
                               for name, description in extra])
        skipped = {"copc", "laszip encoded", "LASF_Spec"}
        if cloud.crs_wkt and not _states(cloud.paths[cloud.headers.index(first)], first, cloud.crs_wkt):
            skipped.add("LASF_Projection")
            header.add_crs(CRS.from_wkt(cloud.crs_wkt))
        header.vlrs.extend(vlr for vlr in first.vlrs if vlr.user_id not in skipped)
        self.header = header
        self.dtype = header.point_format.dtype()

    def adapt(self, points: laspy.ScaleAwarePointRecord, keep: np.ndarray) -> np.ndarray:
        """Records (m,) of this layout for the points that `keep` (n,) marks; new attributes are 0."""
        rows = slice(None) if keep.all() else np.flatnonzero(keep)
        same_place = (np.array_equal(points.scales, self.header.scales)
                      and np.array_equal(points.offsets, self.header.offsets))
        if same_place and points.array.dtype == self.dtype:
            return copied_records(points.array) if keep.all() else record_rows(points.array, rows)
        stored = set(points.array.dtype.names) & set(self.dtype.names)
        if points.point_format.id != self.header.point_format.id:
            stored = set(points.point_format.dimension_names) & set(self.header.point_format.dimension_names)
        record = laspy.ScaleAwarePointRecord.zeros(int(np.count_nonzero(keep)), header=self.header)
        for name in sorted(stored - {"X", "Y", "Z"}):
            record[name] = points[name][rows]
        if same_place:
            for name in ("X", "Y", "Z"):
                record.array[name] = points.array[name][rows]
        else:
            record.x, record.y, record.z = (np.asarray(points[name])[rows] for name in "xyz")
        return record.array

    def view(self, records: np.ndarray) -> laspy.ScaleAwarePointRecord:
        """Records of this layout with their attributes by name and scaled coordinates."""
        return laspy.ScaleAwarePointRecord(records, self.header.point_format,
                                           self.header.scales, self.header.offsets)


def _states(path: Path, header: laspy.LasHeader, wkt: str) -> bool:
    """Whether a file states the system, and no other beside it."""
    kinds = {type(record) for record in header.vlrs if record.user_id == "LASF_Projection"}
    if kinds >= {GeoKeyDirectoryVlr, WktCoordinateSystemVlr}:
        return False
    try:
        stated = stated_crs(path, header)
    except InputError:
        return False
    return stated is not None and stated.to_wkt() == wkt


def _common_offsets(cloud: PointCloud) -> np.ndarray:
    """Offsets (3,) that suit all files: their own, or where they differ the cloud's corner in whole units.

    With one file's offsets and another's finer scale, coordinates could be too large for 32 bits.
    """
    first = cloud.headers[0]
    alike = all(np.array_equal(header.offsets, first.offsets) and np.array_equal(header.scales, first.scales)
                for header in cloud.headers)
    return first.offsets if alike else np.floor(cloud.minimum)


def _common_scales(cloud: PointCloud, offsets: np.ndarray) -> np.ndarray:
    """Scales (3,) that suit all files: the finest of theirs, or where coordinates would not fit into 32 bits the next
    power of ten in which they do."""
    finest = np.min([header.scales for header in cloud.headers], axis=0)
    reach = np.maximum(np.abs(cloud.maximum - offsets), np.abs(cloud.minimum - offsets))
    needed = np.maximum(reach, finest) / (2.0**31 - 1)
    return np.where(needed > finest, 10.0 ** np.ceil(np.log10(needed)), finest)


def _extra_parameters(dimension: laspy.DimensionInfo) -> laspy.ExtraBytesParams:
    """What laspy needs to declare an extra dimension again."""
    return laspy.ExtraBytesParams(dimension.name, dimension.type_str(), dimension.description,
                                  dimension.offsets, dimension.scales, dimension.no_data)


@contextmanager
def cloud_writer(path: str | os.PathLike, layout: PointLayout) -> Iterator[CloudWriter]:
    """Open a LAZ (or LAS) file for records of a layout; it appears at `path` when the block succeeds.

    Raises
    ------
    OutputError : the file cannot be written there.
    """
    if Path(path).suffix.lower() not in (".las", ".laz"):
        raise InputError(say("{path} must end in .laz or .las.", path=Path(path).name))
    compress = Path(path).suffix.lower() == ".laz"
    with (written_beside(path) as temporary,
          laspy.open(temporary, mode="w", header=layout.header, do_compress=compress,
                     encoding_errors=NAMES_NOT_ASCII) as writer):
        yield CloudWriter(writer, layout)


@dataclass(frozen=True)
class CloudWriter:
    """Takes records of a layout, in any number of pieces."""

    writer: laspy.LasWriter
    layout: PointLayout

    def write(self, records: np.ndarray) -> None:
        """Append records (n,) of the layout."""
        if len(records):
            self.writer.write_points(laspy.PackedPointRecord(records, self.layout.header.point_format))


def read_all(cloud: PointCloud, names: Iterable[str], progress: Progress = SILENT) -> dict[str, np.ndarray]:
    """Named attributes of all points, for clouds that are known to fit into memory.

    `x`, `y` and `z` are the scaled coordinates (n,) in CRS units.
    """
    wanted = tuple(names)
    pieces: dict[str, list[np.ndarray]] = {name: [] for name in wanted}
    for chunk in iter_chunks(cloud, progress):
        for name in wanted:
            pieces[name].append(np.array(chunk[name]))
    return {name: np.concatenate(values) for name, values in pieces.items()}
