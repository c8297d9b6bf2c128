"""What a run over tiles has done: one record a tile, whole or not there, by which a later run goes on."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import sys
from collections.abc import Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path

from ..errors import OutputError
from ..io.files.atomic import written_beside
from ..io.files.staging import take_lock
from ..wording import say
from .tile_grid import GridTile

RECORD = "tile.json"
DONE, EMPTY, FAILED = "done", "empty", "failed"
TILES, PART = "tiles", ".part"
FOLDERS = (TILES, "inputs", "pieces", "merged")
"""Folders of a run: results by tile, copies of layers, sorted points, results put together."""
ROOM = 1 << 20
"""Bytes: where a tile fails and not even so many can be written, the disk is full."""


@dataclass(frozen=True)
class TileRecord:
    """What became of a tile.

    Attributes
    ----------
    name : of the tile.
    status : done, empty (there is nothing in it to work on) or failed.
    reason : why it is empty or failed, one sentence.
    fingerprint : of settings and inputs, see `fingerprint`.
    seconds, cpu, memory : time of the work and its time on processors, s; greatest memory of its process, MB (0 where
        not known).
    outputs : size in bytes of each result by its file name in the tile's folder.
    checksums : SHA-256 of each.
    figures : numbers that the algorithm gave.
    """

    name: str
    status: str
    reason: str = ""
    fingerprint: str = ""
    seconds: float = 0.0
    cpu: float = 0.0
    memory: float = 0.0
    outputs: Mapping[str, int] = field(default_factory=dict)
    checksums: Mapping[str, str] = field(default_factory=dict)
    figures: Mapping[str, float] = field(default_factory=dict)


def fingerprint(settings: Mapping[str, object], inputs: Sequence[str | os.PathLike]) -> str:
    """Short text that changes with the settings and with the size or time of any input file."""
    files = sorted((str(path), os.stat(path).st_size, os.stat(path).st_mtime_ns) for path in map(Path, inputs))
    text = json.dumps([settings, files], sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:24]


def checksum(path: Path) -> str:
    """SHA-256 of a file, read in pieces."""
    content = hashlib.sha256()
    with path.open("rb") as file:
        while piece := file.read(2**20):
            content.update(piece)
    return content.hexdigest()


def tile_folder(run_folder: Path, tile: GridTile) -> Path:
    """Folder of a tile's results."""
    return run_folder / TILES / tile.name


@contextmanager
def new_tile_folder(run_folder: Path, tile: GridTile):
    """Empty folder in which a tile is made; `publish` it when its record is written. Leftovers are removed.

    Raises
    ------
    OutputError : the folder of the run is not there any more, or cannot be written. It is not made again: where a
        share was, the disk of the machine would be filled.
    """
    place = tile_folder(run_folder, tile)
    scratch = place.with_name(place.name + PART)
    _remove(scratch)
    try:
        scratch.mkdir()
    except OSError as error:
        raise OutputError(say("The folder of the run, {run_folder}, is not there any more or cannot be written "
                              "({strerror}): put it right and run again; tiles that are whole are kept.",
                              run_folder=run_folder, strerror=error.strerror)) from error
    try:
        yield scratch
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def publish(run_folder: Path, tile: GridTile, record: TileRecord, scratch: Path) -> None:
    """Put a tile's results, all whole and on the disk, in the place of those of an earlier run."""
    write_record(scratch, record)
    for file in filter(Path.is_file, scratch.iterdir()):
        _to_disk(file)
    place = tile_folder(run_folder, tile)
    _remove(place)
    os.replace(scratch, place)


def _remove(place: Path) -> None:
    """Remove a folder with all that is in it, or a file or link in its place."""
    if place.is_dir() and not place.is_symlink():
        shutil.rmtree(place, ignore_errors=True)
    else:
        place.unlink(missing_ok=True)


def _to_disk(path: Path) -> None:
    """Wait until a file is on the disk: a machine that loses power must not leave a record of results that it lost."""
    with path.open("r+b") as file:
        os.fsync(file.fileno())


def write_record(folder: Path, record: TileRecord) -> None:
    """Write a tile's record into its folder."""
    with written_beside(folder / RECORD) as temporary:
        temporary.write_text(json.dumps(asdict(record), indent=1, ensure_ascii=False), encoding="utf-8")


def require_room(run_folder: Path, room: int = ROOM) -> None:
    """See whether there is room, bytes, for another tile.

    Raises
    ------
    OutputError : the disk of the folder is full, or the folder is gone.
    """
    probe = run_folder / TILES / f".room-{os.getpid()}"
    try:
        try:
            with probe.open("wb") as file:
                file.write(bytes(room))
                file.flush()
                os.fsync(file.fileno())
        finally:
            probe.unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(say("There is no room in the folder of the run, {run_folder} ({strerror}): make some and "
                              "run again; tiles that are whole are kept.", run_folder=run_folder,
                              strerror=error.strerror)) from error


def kept_record(run_folder: Path, tile: GridTile, expected: str) -> TileRecord | None:
    """The record of a tile that an earlier run did with the same settings and inputs, if all its results are whole.

    None otherwise: also for a tile that failed, which is tried again, and for one whose record cannot be read.
    """
    record = read_record(tile_folder(run_folder, tile))
    if record is None or record.name != tile.name or record.fingerprint != expected:
        return None
    return record if record.status in (DONE, EMPTY) and not damaged_output(run_folder, tile, record) else None


def read_record(folder: Path) -> TileRecord | None:
    """The record in a tile's folder; None where there is none, or anything in it is not what it should be."""
    try:
        record = TileRecord(**json.loads((folder / RECORD).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError, RecursionError):
        return None
    texts = (record.name, record.status, record.reason, record.fingerprint)
    numbers = (record.seconds, record.cpu, record.memory)
    tables = (record.outputs, record.checksums, record.figures)
    sound = (all(isinstance(text, str) for text in texts) and all(map(_is_number, numbers))
             and all(isinstance(table, dict) for table in tables)
             and all(map(_is_number, (*record.outputs.values(), *record.figures.values())))
             and all(Path(name).name == name for name in record.outputs)
             and set(record.checksums) == set(record.outputs))
    return record if sound else None


def _is_number(value: object) -> bool:
    """Whether it is a finite number; a whole one may have more digits than a decimal one can hold, and is none then."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= sys.float_info.max


def damaged_output(run_folder: Path, tile: GridTile, record: TileRecord) -> str:
    """Name of the first of a tile's results that is not as it was when its record was written; empty if all are."""
    folder = tile_folder(run_folder, tile)
    for name, size in record.outputs.items():
        try:
            if (folder / name).stat().st_size != size or checksum(folder / name) != record.checksums.get(name):
                return name
        except (OSError, ValueError):
            return name
    return ""


@contextmanager
def only_run(run_folder: Path):
    """Hold the folder for one run.

    Raises
    ------
    OutputError : it cannot be written, a file stands where it needs a folder, or another run is working in it.
    """
    for place in (run_folder, *(run_folder / name for name in FOLDERS)):
        if place.exists() and not place.is_dir():
            raise OutputError(say("{place} is a file where the run needs a folder: move it away, or choose another "
                                  "folder.", place=place))
    try:
        (run_folder / TILES).mkdir(parents=True, exist_ok=True)
        lock = (run_folder / "lock").open("a+")
    except OSError as error:
        raise OutputError(say("The folder {run_folder} cannot be written ({strerror}): choose another.",
                              run_folder=run_folder, strerror=error.strerror)) from error
    with lock:
        try:
            take_lock(lock)
        except OSError:
            raise OutputError(say("Another run works in {run_folder}: wait for its end, or choose another folder.",
                                  run_folder=run_folder)
                              ) from None
        yield
