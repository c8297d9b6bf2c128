"""Where the XML of GSI Fundamental Geospatial Data lies: files, folders, downloaded zips and zips in them."""

from __future__ import annotations

import os
import posixpath
import re
import tempfile
import zipfile
import zlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import IO, Union

from ...errors import InputError
from ...wording import say
from ..files.named_files import is_kind, named_file, relative_name
from ..files.packed import open_unpacked, unpacked_suffix

PathLike = Union[str, os.PathLike]

# GSI names its files FG-GML-<map sheet>-<type of object>-<date>-<number>.xml.
_OBJECT_TYPE = re.compile(r"FG-GML-.*?-([A-Z][A-Za-z]+)-\d{8}", re.IGNORECASE)
_BUILDING_TYPES = {"blda", "bldl", "all"}

DEEPEST_ZIP = 4  # the site packs a zip of map sheets at most twice; deeper is a mistake or a bomb
LARGE = 2**30
MOST_PACKED = 300  # bytes from one: XML of maps packs to about a thirtieth
SPOOL_BYTES = 32 * 2**20

_LARGEST_ZIP = 2**31
_ZIP_ERRORS = (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, OSError)


@dataclass(frozen=True)
class XmlSource:
    """One XML file, on disk or in a zip: its name for messages, its size in bytes and how to open it.

    `beside` gives the source of a kind that a relative path in the file names, None where there is none; a path that is
    absolute or an address, or that leaves the zip or the model's folder, names none (see `named_file`).
    `path` is the file on disk, None in a zip.
    """

    name: str
    size: int
    open: Callable[[], IO[bytes]]
    beside: Callable[[str, str], XmlSource | None] = lambda _relative, _kind: None
    path: Path | None = None

    @property
    def short_name(self) -> str:
        """Name of the file without the folders, or zips, in which it lies."""
        return re.split(r"[/\\]", self.name)[-1]


@dataclass(frozen=True)
class Wanted:
    """What is looked for among files: how it is called, which names cannot hold it, and what to do without it.

    Attributes
    ----------
    what : in messages, such as "building outlines (BldA or BldL)".
    advice : what to do when there are none.
    other : whether a file of this name holds something else for certain.
    suffixes : of the files, lower case.
    """

    what: str
    advice: str
    other: Callable[[str], bool]
    suffixes: tuple[str, ...] = (".xml",)


def _no_building(name: str) -> bool:
    """Whether a file's name says that it holds roads or the like."""
    kind = _OBJECT_TYPE.search(name)
    return bool(kind) and kind.group(1).lower() not in _BUILDING_TYPES

BUILDINGS = Wanted("building outlines (BldA or BldL)",
                   "download the item 'outlines of buildings' from the GSI", _no_building)


@dataclass(frozen=True)
class Listing:
    """XML files that may hold what is wanted, and the names of those that by their name hold something else."""

    sources: list[XmlSource]
    others: list[str]


def list_sources(paths: PathLike | Sequence[PathLike], stack: ExitStack, wanted: Wanted = BUILDINGS) -> Listing:
    """List the XML files behind one path or several, in an order that depends on their names only.

    A path is an .xml, maybe packed with gzip, a .zip (zips inside are opened too) or a folder, searched with all its
    subfolders.
    Zip archives stay open until `stack` is closed; nothing of them is written anywhere under a name of theirs.

    Raises
    ------
    InputError : a path does not exist, a zip is damaged, empty or encrypted, or nothing is there to read.
    """
    given = [paths] if isinstance(paths, (str, os.PathLike)) else list(paths)
    if not given:
        raise InputError(say("No file was given: choose {what} ({suffixes}, .zip or a folder of them).",
                             what=wanted.what, suffixes=wanted.suffixes[0]))
    listing = Listing([], [])
    for path in given:
        found = len(listing.sources) + len(listing.others)
        files = _files_of(Path(path), wanted)
        for file in files:
            with _explained(str(file)):
                if zipfile.is_zipfile(file) or file.suffix.lower() == ".zip":
                    _list_zip(stack.enter_context(zipfile.ZipFile(file)), str(file), listing, stack, wanted, 1)
                else:
                    chosen = _on_disk(file, Path(path) if Path(path).is_dir() else None)
                    _add(chosen, listing, wanted, by_name=Path(path).is_dir())
        if len(listing.sources) + len(listing.others) == found:
            raise InputError(say("{path} holds no {suffixes} file: give {what} as they were downloaded.", path=path,
                                 suffixes=wanted.suffixes[0], what=wanted.what))
    if not listing.sources:
        raise InputError(say("{given} holds no {what} but {others}: {advice}.", given=given[0], what=wanted.what,
                             others=listing.others[0], advice=wanted.advice))
    return listing


def some_of(items: list[str], count: int = 3) -> str:
    """The first names of a list, and how many more there are."""
    more = len(items) - count
    return ", ".join(items[:count]) + (say(" and {count} more", count=more) if more > 0 else "")


def may_hold(paths: PathLike | Sequence[PathLike], wanted: Wanted) -> bool:
    """Whether a file behind the paths can hold what is wanted, by the files' names; not of what cannot be listed."""
    with ExitStack() as stack:
        try:
            return any(not wanted.other(source.short_name) for source in list_sources(paths, stack, wanted).sources)
        except InputError:
            return False


@contextmanager
def opened(source: XmlSource) -> Iterator[IO[bytes]]:
    """Open a source; what goes wrong while it is read becomes an `InputError` that names it."""
    with _explained(source.name), source.open() as stream:
        yield stream


def _files_of(path: Path, wanted: Wanted) -> list[Path]:
    if path.is_file():
        return [path]
    if not path.is_dir():
        raise InputError(say("{path} does not exist: check the path.", path=path))
    return sorted((file for file in path.rglob("*") if unpacked_suffix(file) in {*wanted.suffixes, ".zip"}
                   and file.is_file()), key=lambda file: file.as_posix())


def _list_zip(archive: zipfile.ZipFile, name: str, listing: Listing, stack: ExitStack, wanted: Wanted,
              depth: int) -> None:
    if depth > DEEPEST_ZIP:
        raise InputError(say("{name} is a zip nested more than {deepest_zip} deep: unpack it first.", name=name,
                             deepest_zip=DEEPEST_ZIP))
    entries = sorted((_entry_name(info), index, info) for index, info in enumerate(archive.infolist()))
    for entry, _, info in entries:
        suffix = Path(entry).suffix.lower()
        if suffix not in {*wanted.suffixes, ".zip"} or info.is_dir() or entry.startswith("__MACOSX/"):
            continue
        label = f"{name}/{entry}"
        if info.flag_bits & 0x1:
            raise InputError(say("{label} is encrypted: unpack it with its password and give the files in it.",
                                 label=label))
        if info.file_size > LARGE and info.file_size > MOST_PACKED * max(info.compress_size, 1):
            raise InputError(say("{label} would unpack to {file_size} GB from {compress_size} MB, which no map data "
                                 "does: get the file again from where it comes from.", label=label,
                                 file_size=info.file_size >> 30, compress_size=info.compress_size >> 20))
        if suffix != ".zip":
            source = _in_zip(archive, info, label)
            _add(source, listing, wanted, by_name=True)
            continue
        # A compressed stream can be read forwards only, a zip starts at its end: so unpack the inner one.
        spool = stack.enter_context(tempfile.SpooledTemporaryFile(SPOOL_BYTES))  # noqa: SIM115
        with _explained(label):
            with archive.open(info) as packed:
                _copy(packed, spool, label)
            spool.seek(0)
        with _explained(label):
            inner = stack.enter_context(zipfile.ZipFile(_seekable(spool)))
        _list_zip(inner, label, listing, stack, wanted, depth + 1)


def _on_disk(file: Path, root: Path | None = None) -> XmlSource:
    """A file on disk: it can be handed to another process."""
    return XmlSource(str(file), file.stat().st_size, partial(open_unpacked, file), partial(_beside_on_disk, file, root),
                     file)


def _beside_on_disk(file: Path, root: Path | None, relative: str, kind: str) -> XmlSource | None:
    found = named_file(file, relative, kind, root)
    return _on_disk(found) if found is not None else None


def _in_zip(archive: zipfile.ZipFile, info: zipfile.ZipInfo, label: str) -> XmlSource:
    def beside(relative: str, kind: str) -> XmlSource | None:
        if relative_name(relative) is None:
            return None
        place = posixpath.normpath(posixpath.join(posixpath.dirname(info.filename), relative.replace("\\", "/")))
        try:
            found = archive.getinfo(place)
            with archive.open(found) as file:
                fits = is_kind(file.read(16), kind)
        except (KeyError, *_ZIP_ERRORS):
            return None
        return _in_zip(archive, found, f"{label}: {place}") if fits else None

    return XmlSource(label, info.file_size, lambda: archive.open(info), beside)


def _copy(packed: IO[bytes], spool: IO[bytes], label: str) -> None:
    """Unpack a zip of a zip, as far as one can be that the GSI packs."""
    done = 0
    while piece := packed.read(2**20):
        done += len(piece)
        if done > _LARGEST_ZIP:
            raise InputError(say("{label} holds more than {largest_zip} GB: unpack it first.", label=label,
                                 largest_zip=_LARGEST_ZIP >> 30))
        spool.write(piece)


def _seekable(spool: tempfile.SpooledTemporaryFile) -> IO[bytes]:
    """The file inside a spooled file: before Python 3.11 the wrapper itself lacks `seekable`."""
    if hasattr(spool, "seekable"):
        return spool
    spool.rollover()
    return spool._file


def _entry_name(info: zipfile.ZipInfo) -> str:
    """Name of a zip entry; Japanese Windows writes cp932 without saying so, which Python reads as cp437."""
    if info.flag_bits & 0x800:
        return info.filename
    try:
        return info.filename.encode("cp437").decode("cp932")
    except UnicodeError:
        return info.filename


def _add(source: XmlSource, listing: Listing, wanted: Wanted, by_name: bool) -> None:
    """Sort a file in; roads and the like beside the buildings are told by their names and not opened."""
    if by_name and wanted.other(source.short_name):
        listing.others.append(source.name)
    else:
        listing.sources.append(source)


@contextmanager
def _explained(name: str) -> Iterator[None]:
    """Turn the errors of reading files and zips into one sentence."""
    try:
        yield
    except (zipfile.BadZipFile, zlib.error, EOFError) as error:
        raise InputError(say("{name} is damaged or not a zip file ({error}): download it again.", name=name,
                             error=error)) from error
    except (NotImplementedError, RuntimeError) as error:
        raise InputError(say("{name} cannot be unpacked here ({error}): unpack it and give the files in it.", name=name,
                             error=error)) from error
    except OSError as error:
        raise InputError(say("{name} cannot be read ({value}): check the file.", name=name,
                             value=error.strerror or error)) from error
