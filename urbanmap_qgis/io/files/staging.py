"""The outputs of one run: made in scratch folders beside their places, moved there together when all are whole."""

from __future__ import annotations

import errno
import os
import shutil
import sqlite3
import sys
import time
import unicodedata
import uuid
from contextlib import closing
from pathlib import Path
from urllib.parse import quote

from ...errors import OutputError
from ...wording import say

PREFIX = ".urbanmap-"
_FILES, _EARLIER, _LOCK = "new", "earlier", "lock"
_STARTING, _LOOKS = 20.0, 200  # s that a run may take from its folder to its lock; how often it tries

DATABASES = (".gpkg", ".sqlite", ".db")
"""Endings of SQLite databases."""

JOURNALS = ("-wal", "-shm", "-journal")
"""What SQLite may keep beside a database."""

_ONE_LAYER = {".dbf": ".shp", ".shx": ".shp", ".prj": ".shp", ".cpg": ".shp", ".qix": ".shp"}

# Scratch folder of files -> folder that they are for, of all runs going on in this process.
_SCRATCH: dict[str, str] = {}


def final_text(text: str) -> str:
    """A text in which scratch folders are replaced by the folders whose files they hold."""
    for scratch, folder in reversed(list(_SCRATCH.items())):
        text = text.replace(scratch, folder)
    return text

LONGEST_NAME = 255
"""Bytes of a file's name that systems take."""

_BESIDE = {".gpkg": "-journal", ".sqlite": "-journal", ".tif": ".aux.xml", ".tiff": ".aux.xml"}
"""Longest ending of files that appear beside an output, by its own: its name must leave room for it."""


class Staging:
    """Scratch places for the outputs of one run. Use as a context manager.

    What is made at the places that `place` gives appears where it belongs when `publish` is called: all of it, or,
    where one file cannot be replaced, nothing. Without `publish` everything stays as it was. A run that is killed
    leaves its scratch folder behind; the next run that writes into the same folder removes it.
    """

    def __init__(self):
        self._scratch: dict[Path, Path] = {}
        self._locks: list = []

    def __enter__(self) -> Staging:
        return self

    def __exit__(self, *_exception: object) -> None:
        for lock in self._locks:
            lock.close()
        for scratch in self._scratch.values():
            _SCRATCH.pop(str(scratch / _FILES), None)
            shutil.rmtree(scratch, ignore_errors=True)

    def scratch_path(self, target: str | os.PathLike) -> Path:
        """Scratch path for what is to become `target`.

        Raises
        ------
        OutputError : the folder of `target` cannot be written.
        """
        target = Path(target)
        longest = LONGEST_NAME - len(_BESIDE.get(target.suffix.lower(), ""))
        if len(os.fsencode(target.name)) > longest:
            raise OutputError(say("The name {name} is too long for the files that are made beside it: give a shorter "
                                  "one, of at most {longest} bytes.", name=f"{target.name[:40]}…",
                                  longest=longest))
        folder = target.parent
        try:
            if folder not in self._scratch:
                clear_leftovers(folder)
                self._open(folder)
        except OSError as error:
            raise OutputError(say("The folder {folder} cannot be written ({strerror}): choose another output.",
                                  folder=folder, strerror=error.strerror)
                              ) from error
        return self._scratch[folder] / _FILES / target.name

    def _open(self, folder: Path) -> None:
        scratch = folder / f"{PREFIX}{uuid.uuid4().hex[:8]}"
        scratch.mkdir()
        self._scratch[folder] = scratch
        lock = (scratch / _LOCK).open("w")
        self._locks.append(lock)
        _take_own_lock(lock)
        (scratch / _FILES).mkdir()  # from now on a lock that can be taken is a killed run's
        _SCRATCH[str(scratch / _FILES)] = str(folder)

    def outside(self, text: str) -> str:
        """A text in which this run's own scratch folders are replaced by those that they are for."""
        for folder, scratch in self._scratch.items():
            text = text.replace(str(scratch / _FILES), str(folder))
        return text

    def publish(self) -> None:
        """Move everything that was made into place.

        Raises
        ------
        OutputError : a file cannot be replaced; those that were moved before it are put back.
        """
        undo: list[tuple[Path, Path | None]] = []
        for folder, scratch in self._scratch.items():
            (scratch / _EARLIER).mkdir(exist_ok=True)
            for source, target in _moves(scratch / _FILES, folder):
                try:
                    exists = target.is_file()
                    earlier = _keep_earlier(target, scratch / _EARLIER) if exists else None
                    _replace(source, target)
                    if earlier or not exists:
                        undo.append((target, earlier))
                except OSError as error:
                    _put_back(undo)
                    raise OutputError(say("{final_text} cannot be replaced ({strerror}): close the program that has "
                                          "it open, or choose another output.", final_text=final_text(str(target)),
                                          strerror=error.strerror)) from error


def _moves(source: Path, folder: Path) -> list[tuple[Path, Path]]:
    """What is to be moved where: files and new folders whole, files of folders that are there already one by one."""
    moves = []
    for item in sorted(source.iterdir()):
        target = folder / item.name
        if item.is_dir() and target.is_dir() and any(target.iterdir()):
            moves += _moves(item, target)
        else:
            moves.append((item, target))
    return moves


def _keep_earlier(target: Path, folder: Path) -> Path | None:
    """Keep what stands at `target` in `folder` too; None where that cannot be."""
    place = folder / str(len(list(folder.iterdir())))
    try:
        os.link(target, place)
    except OSError:  # a file system without links: its files cannot be put back, but are not lost either
        return None
    return place


def _replace(source: Path, target: Path) -> None:
    if source.is_dir() and target.is_dir():
        target.rmdir()
    # A journal left by a program that still shows the old file would be replayed into the new one.
    for journal in JOURNALS if source.suffix.lower() in DATABASES else ():
        target.with_name(target.name + journal).unlink(missing_ok=True)
    os.replace(source, target)


def _put_back(undo: list[tuple[Path, Path | None]]) -> None:
    for target, earlier in reversed(undo):
        if earlier is not None:
            os.replace(earlier, target)
        elif target.is_dir():
            shutil.rmtree(target, ignore_errors=True)
        else:
            target.unlink(missing_ok=True)


def clear_leftovers(folder: str | os.PathLike) -> None:
    """Remove the scratch folders of runs that were killed; those of runs that go on are left alone."""
    for scratch in Path(folder).glob(f"{PREFIX}????????"):
        try:
            with (scratch / _LOCK).open("r+") as lock:
                take_lock(lock)
                starting = not (scratch / _FILES).is_dir() and time.time() - scratch.stat().st_mtime < _STARTING
        except OSError:  # no scratch folder of ours, or its run goes on
            continue
        if starting:  # its run is about to take the lock
            continue
        shutil.rmtree(scratch, ignore_errors=True)


def _take_own_lock(lock) -> None:
    """Lock a run's own file, which another run may hold for the moment that it takes to look whether it is left."""
    for left in reversed(range(_LOOKS)):
        try:
            take_lock(lock)
            break
        except OSError:
            if not left:
                raise
            time.sleep(_STARTING / _LOOKS)


def take_lock(lock) -> None:
    """Lock an open file for as long as it is open; OSError where another process has it."""
    if sys.platform == "win32":
        import msvcrt

        msvcrt.locking(lock.fileno(), msvcrt.LK_NBLCK, 1)
    else:
        import fcntl

        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)


def identities(path: str | os.PathLike) -> set[tuple]:
    """By what a file is known, however its path is spelt: two paths with a common identity are one file.

    The parts of a shapefile are one file here.
    """
    try:
        place = Path(os.path.realpath(path))
    except (OSError, ValueError):  # no name that a file can have
        return {("name", str(path))}
    place = place.with_suffix(_ONE_LAYER.get(place.suffix.lower(), place.suffix))
    name = unicodedata.normalize("NFC", os.path.normcase(str(place)))
    found: set[tuple] = {("name", name.casefold() if sys.platform == "darwin" else name)}
    try:
        status = os.stat(place)
    except (OSError, ValueError):
        return found
    return found | {("file", status.st_dev, status.st_ino)} if status.st_ino else found


def refuse_unless_replaceable(path: str | os.PathLike) -> None:
    """Refuse a place for a file where none can be put.

    Raises
    ------
    OutputError : the folder is missing or cannot be written, the name is too long, something else than a file stands
        there, or it is a database that another program has open.
    """
    target = Path(path)
    folder = target.parent
    try:
        if not folder.is_dir():
            raise OutputError(say("The folder {folder} does not exist; create it or choose another output.",
                                  folder=folder))
        if not os.access(folder, os.W_OK):
            raise OutputError(say("The folder {folder} cannot be written; choose another output.", folder=folder))
        if "\0" in str(target):
            raise ValueError
        exists = _exists(target)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "it holds characters that no name can have"
        raise OutputError(say("{target} cannot be the name of a file ({reason}); choose another output.", target=target,
                              reason=reason)) from error
    if not exists:
        return
    if target.is_dir():
        raise OutputError(say("{target} is a folder; give the name of a file.", target=target))
    if not target.is_file():
        raise OutputError(say("{target} is no plain file; give another name.", target=target))
    if target.suffix.lower() in DATABASES and held_open(target):
        raise OutputError(say("{target} is open in another program, or is edited in this one; close it there, or "
                              "choose another output.", target=target))


def _exists(path: Path) -> bool:
    """Whether something stands at a path; a name that cannot be raises, which `exists` leaves out in Python 3.14."""
    try:
        os.stat(path)
    except FileNotFoundError:
        return False
    return True


def held_open(database: Path) -> bool:
    """Whether another program has an SQLite database (GeoPackage) open, as far as the system tells."""
    return _leased_elsewhere(database) or _locked(database)


def _locked(database: Path) -> bool:
    """Whether a connection holds a lock, as each does in journal mode WAL and while it reads or writes in others."""
    address = f"file:{quote(str(database.absolute()))}?mode=rw"
    try:
        with closing(sqlite3.connect(address, uri=True, timeout=0)) as connection:
            connection.execute("PRAGMA locking_mode=EXCLUSIVE")
            connection.execute("BEGIN EXCLUSIVE")
            connection.rollback()
    except sqlite3.OperationalError as error:
        return "locked" in str(error)
    except sqlite3.DatabaseError:  # no database, so nobody has it open as one
        return False
    return False


def _leased_elsewhere(database: Path) -> bool:
    """Whether another process has the file open, by Linux's leases, which are granted on files that nobody has open.

    Not asked where this process itself has it open: closing the file here would drop its own locks.
    """
    if not sys.platform.startswith("linux") or _open_here(database):
        return False
    import fcntl

    try:
        with database.open("rb+") as file:
            fcntl.fcntl(file, fcntl.F_SETLEASE, fcntl.F_WRLCK)
            fcntl.fcntl(file, fcntl.F_SETLEASE, fcntl.F_UNLCK)
    except OSError as error:  # file systems without leases say EINVAL, files of other users EACCES
        return error.errno == errno.EAGAIN
    return False


def _open_here(path: Path) -> bool:
    place = os.path.realpath(path)
    for descriptor in os.listdir("/proc/self/fd"):
        try:
            if os.readlink(f"/proc/self/fd/{descriptor}") == place:
                return True
        except OSError:  # closed in the meantime
            continue
    return False
