"""Raw measurements of line scanners: time, angle and range of every return, read in chunks (Z 2.1).

Files: CSV (`.csv`, `.txt`, also `.gz`) with the columns time, angle, range and, if wanted, intensity and scanner;
Parquet with the same columns, where pyarrow is installed; LAS and LAZ with gps_time, extra dimensions angle and range,
and the scanner in point_source_id. Times in seconds, angles in degrees (see `read_scans`), ranges in metres.
"""

from __future__ import annotations

import gzip
import importlib
import io
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...io.files.guard import first_not_finite, reads
from ...io.points.pointcloud import iter_chunks, open_cloud
from ...progress import SILENT, Progress
from ...wording import say

NAMES = {
    "time": ("time", "gps_time", "gpstime", "t"),
    "angle": ("angle", "alpha", "angle_deg"),
    "range": ("range", "distance", "r", "range_m"),
    "intensity": ("intensity", "reflectance", "amplitude"),
    "scanner": ("scanner", "scanner_id", "point_source_id", "sensor"),
}
"""Names under which the columns are known, in any case."""

NEEDED = ("time", "angle", "range")

SUFFIXES = (".csv", ".txt", ".csv.gz", ".txt.gz", ".parquet", ".las", ".laz")

_CHUNK_BYTES = 16_000_000
_CHUNK_ROWS = 1_000_000
_LONGEST_LINE = 2**24
_DAMAGED = (OSError, EOFError, UnicodeDecodeError)


@dataclass(frozen=True)
class RangeScans:
    """Returns of scanners, (n,) each.

    Attributes
    ----------
    time : s.
    angle : in the scanner's plane, degrees.
    distance : m.
    intensity : 0 where it was not measured.
    scanner : number, -1 where the file does not say.
    """

    time: np.ndarray
    angle: np.ndarray
    distance: np.ndarray
    intensity: np.ndarray
    scanner: np.ndarray

    def __len__(self) -> int:
        return len(self.time)

    def of(self, keep: np.ndarray) -> RangeScans:
        """The returns that a mask (n,) marks."""
        return RangeScans(self.time[keep], self.angle[keep], self.distance[keep], self.intensity[keep],
                          self.scanner[keep])


@reads("range scans")
def read_scans(paths: Sequence[str | os.PathLike], radians: bool = False,
               progress: Progress = SILENT) -> Iterator[RangeScans]:
    """The returns of files, chunk by chunk, file after file.

    Parameters
    ----------
    radians : angles in the files are radians; they are given in degrees either way.

    Raises
    ------
    InputError : a file is of no known kind, lacks a column, is damaged, or needs a package that is not there.
    """
    files = [Path(path) for path in paths]
    if not files:
        raise InputError(say("No range scans were given: choose one or several files."))
    readers = [_reader(path) for path in files]
    for number, (path, reader) in enumerate(zip(files, readers)):
        for chunk in reader(path, progress.part(number / len(files), (number + 1) / len(files))):
            bad = first_not_finite(np.column_stack([chunk.time, chunk.angle]))
            if bad is not None:
                raise InputError(say("{path} has a return without a time or an angle that is a number (return {bad} "
                                     "of those read at a time): correct it or export the scans again.", path=path.name,
                                     bad=bad + 1))
            yield _in_degrees(chunk) if radians else chunk


def _in_degrees(scans: RangeScans) -> RangeScans:
    return RangeScans(scans.time, np.degrees(scans.angle), scans.distance, scans.intensity, scans.scanner)


def _reader(path: Path) -> Callable[[Path, Progress], Iterator[RangeScans]]:
    """What reads a file, by its name."""
    if not path.is_file():
        raise InputError(say("The range scans {path} do not exist: check the file's name.", path=path))
    name = path.name.lower()
    if name.endswith((".csv", ".txt", ".csv.gz", ".txt.gz")):
        return _read_text
    if name.endswith((".las", ".laz")):
        return _read_cloud
    if name.endswith(".parquet"):
        try:
            importlib.import_module("pyarrow.parquet")
        except ImportError as error:
            raise InputError(say("{path} is a Parquet file, and the package pyarrow that reads these cannot be "
                                 "loaded ({error}): install it (pip install pyarrow) or export the scans as CSV.",
                                 path=path.name, error=error)) from error
        return _read_parquet
    raise InputError(say("{path} is of no known kind: range scans come as {suffixes}.", path=path.name,
                         suffixes=", ".join(SUFFIXES)))


def _columns(names: Sequence[str], file: str, needed: Sequence[str] = NEEDED) -> dict[str, int]:
    """Number of each known column that is there."""
    lower = [str(name).strip().strip('"').lower() for name in names]
    found = {}
    for column, aliases in NAMES.items():
        present = [lower.index(alias) for alias in aliases if alias in lower]
        if present:
            found[column] = present[0]
    missing = [column for column in needed if column not in found]
    if missing:
        raise InputError(say("{file} has no column {missing}: range scans need time, angle and range, and may have "
                             "intensity and scanner.", file=file, missing=", ".join(missing)))
    return found


def _scans(columns: Mapping[str, np.ndarray], count: int) -> RangeScans:
    """Returns from columns (count,) by name; intensity and scanner may be missing."""
    intensity, scanner = columns.get("intensity"), columns.get("scanner")
    known = np.full(count, -1) if scanner is None else np.where(np.isfinite(scanner), scanner, -1).astype(np.int64)
    shine = np.zeros(count, np.uint16) if intensity is None else _counts(intensity)
    return RangeScans(*(np.asarray(columns[name], float) for name in NEEDED), shine, known)


def _counts(intensity: np.ndarray) -> np.ndarray:
    """Intensities as LAS stores them."""
    return np.clip(np.round(np.nan_to_num(intensity)), 0, 65535).astype(np.uint16)


def _read_text(path: Path, progress: Progress) -> Iterator[RangeScans]:
    """CSV with a header, its separator comma, semicolon or tabulator."""
    size = max(path.stat().st_size, 1)
    packed = path.suffix.lower() == ".gz"
    with path.open("rb") as raw, (gzip.GzipFile(fileobj=raw) if packed else nullcontext(raw)) as stream:
        try:
            header = stream.readline().decode("utf-8-sig").strip()
            delimiter = max(",;\t", key=header.count)
            known = _columns(header.split(delimiter), path.name)
            lines = 1
            for block in _whole_lines(stream):
                progress.step(raw.tell() / size)
                table = _parsed(block, delimiter, list(known.values()), path.name, lines)
                lines += block.count(b"\n")
                yield _scans(dict(zip(known, table.T)), len(table))
        except _DAMAGED as error:
            raise InputError(say("{path} cannot be read ({error}): it may be cut off; copy it again.", path=path.name,
                                 error=error)) from error


def _whole_lines(stream) -> Iterator[bytes]:
    """The stream in blocks that end with a line."""
    rest = b""
    while block := stream.read(_CHUNK_BYTES):
        block = rest + block
        cut = block.rfind(b"\n") + 1
        rest = block[cut:]
        if len(rest) > _LONGEST_LINE:
            raise ValueError("a line without an end")
        if cut:
            yield block[:cut]
    if rest.strip():
        yield rest


def _parsed(block: bytes, delimiter: str, columns: list[int], file: str, lines: int) -> np.ndarray:
    """Numbers (n, columns) of a block of lines; an empty field is no number."""
    try:
        return np.loadtxt(io.BytesIO(block), delimiter=delimiter, usecols=columns, ndmin=2, comments=None)
    except ValueError as error:
        row = re.search(r"row (\d+)", str(error))
        where = f" in line {lines + int(row[1]) + 1}" if row else ""
        raise InputError(say("{file} holds something that is no number{where} ({split}): correct it or export the "
                             "scans again.", file=file, where=where,
                             split=str(error).split(";")[0].rstrip("."))) from error


def _read_parquet(path: Path, progress: Progress) -> Iterator[RangeScans]:
    import pyarrow
    from pyarrow import parquet

    try:
        file = parquet.ParquetFile(path)
        names = file.schema_arrow.names
        known = {name: names[number] for name, number in _columns(names, path.name).items()}
        done, total = 0, max(file.metadata.num_rows, 1)
        for batch in file.iter_batches(_CHUNK_ROWS, columns=list(known.values())):
            progress.step(done / total)
            done += len(batch)
            table = {name: batch.column(source).to_numpy(zero_copy_only=False) for name, source in known.items()}
            yield _scans(table, len(batch))
    except (pyarrow.ArrowException, OSError) as error:
        raise InputError(say("{path} cannot be read as Parquet ({error}): check the file.", path=path.name,
                             error=error)) from error


def _read_cloud(path: Path, progress: Progress) -> Iterator[RangeScans]:
    """LAS or LAZ with polar extra dimensions; coordinates in it are not used."""
    cloud = open_cloud([path])
    names = list(cloud.headers[0].point_format.dimension_names)
    known = {name: names[number] for name, number in _columns(names, path.name).items()}
    for chunk in iter_chunks(cloud, progress):
        yield _scans({name: np.asarray(chunk[source], float) for name, source in known.items()}, len(chunk))
