"""What files are: by their first bytes, then by what the reader of that kind finds in headers and samples.

The suffix of a name decides nothing; where it says something else than the content, a note tells so, since some
readers choose by it.
"""

from __future__ import annotations

import gzip
import math
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import shapely

from ...errors import InputError, UrbanMapError
from ...io.files.guard import PARSER_ERRORS
from ...io.files.packed import read_unpacked, unpacked_name
from ...progress import SILENT, Progress
from ...wording import say
from ..file_facts import CITY_MODEL, MESH, OTHER, REPORT, SCANS, FileFacts
from .cloud_facts import cloud_facts
from .gnss_facts import gnss_facts, is_gnss
from .json_facts import json_facts
from .raster_facts import is_raster, raster_facts
from .sbet_facts import is_sbet, sbet_facts
from .table_facts import parquet_facts, table_facts
from .vector_facts import geopackage_facts, shapefile_facts
from .xml_facts import xml_facts, zip_facts

RESULTS_ENDING, JOB_ENDING = "_results", ".urbanmap.json"
"""Ends of the names of a job's file and of the folder of its results beside it."""

HEAD_BYTES = 65_536
"""Bytes of a file that are looked at to tell its kind."""

_POINT_SUFFIXES = (".las", ".laz")
_SUFFIXES = {b"LASF": (*_POINT_SUFFIXES, ".copc"), b"SQLi": (".gpkg", ".sqlite", ".db"), b"II*\0": (".tif", ".tiff"),
             b"MM\0*": (".tif", ".tiff"), b"\xff\xd8\xff\xe0": (".jpg", ".jpeg"), b"\x89PNG": (".png",)}
_PARTS_OF_A_SHAPEFILE = (".dbf", ".shx", ".prj", ".cpg", ".sbn", ".sbx", ".qix", ".qpj")
_BESIDE = (".jgw", ".tfw", ".pgw", ".wld", ".aux.xml", ".qmd", ".qml", ".ovr")
_NEEDED_SUFFIX = {**dict.fromkeys(_POINT_SUFFIXES, b"LASF"), ".gpkg": b"SQLi", ".shp": b"\0\0\x27\x0a",
                  ".zip": b"PK\x03\x04"}


def recognise_files(paths: Iterable[str | os.PathLike], progress: Progress = SILENT) -> list[FileFacts]:
    """What the files are that are given or lie in folders that are given, in the order of their names, each once.

    Hidden files, files that belong to another one (parts of a shapefile, world files) and results of jobs are left out.
    """
    files = list(dict.fromkeys(file for path in paths for file in _files_in(Path(path))))
    found: list[FileFacts] = []
    for number, file in enumerate(files):
        found.extend(recognise_file(file))
        progress.step((number + 1) / len(files))
    return found


def _files_in(path: Path) -> Iterator[Path]:
    if not path.is_dir():
        yield path
        return
    inside = (file for file in sorted(path.rglob("*"), key=lambda file: file.as_posix())
              if file.is_file() and not any(part.startswith(".") for part in file.relative_to(path).parts))
    for file in inside:
        name = file.name.lower()
        if any(_is_results(folder) for folder in file.parents if folder.is_relative_to(path)):
            continue
        is_part = file.suffix.lower() in _PARTS_OF_A_SHAPEFILE and file.with_suffix(".shp").is_file()
        if not is_part and not name.endswith(_BESIDE):
            yield file


def _is_results(folder: Path) -> bool:
    """Whether a job has written its results into a folder: they are no inputs of the next one."""
    name = folder.name.removesuffix(RESULTS_ENDING)
    return name != folder.name and (folder.parent / f"{name}{JOB_ENDING}").is_file()


def recognise_file(path: str | os.PathLike) -> tuple[FileFacts, ...]:
    """What a file is: one record, or one for each layer in it. Nothing is raised: what is wrong is its `problem`."""
    file = Path(path)
    try:
        head = _head(file)
        found = tuple(map(_with_finite_extent, _by_content(file, head)))
    except UrbanMapError as error:
        return (FileFacts(file, OTHER, problem=str(error)),)
    except (*PARSER_ERRORS, shapely.errors.ShapelyError) as error:
        return (FileFacts(file, OTHER, problem=say("{name} cannot be read ({error}): it is damaged or of another kind.",
                                                   name=file.name, error=str(error) or type(error).__name__)),)
    note = _suffix_note(file, head)
    return tuple(replace(facts, notes=(*facts.notes, note)) for facts in found) if note else tuple(found)


def _with_finite_extent(facts: FileFacts) -> FileFacts:
    if facts.extent is None or all(map(math.isfinite, facts.extent)):
        return facts
    problem = say("{name} says where it lies in numbers that are not finite: it is damaged; copy or download it again.",
                  name=facts.path.name)
    return replace(facts, extent=None, problem=facts.problem or problem)


def _head(file: Path) -> bytes:
    if not file.is_file():
        raise InputError(say("{path} does not exist: check the path.", path=file))
    if file.stat().st_size == 0:
        raise InputError(say("{name} is empty: copy or download it again.", name=file.name))
    with file.open("rb") as stream:
        return stream.read(HEAD_BYTES)


def _suffix_note(file: Path, head: bytes) -> str:
    """A sentence where the name ends as that of another kind of file."""
    usual = next((suffixes for first, suffixes in _SUFFIXES.items() if head.startswith(first)), None)
    if usual is None or not file.suffix or file.suffix.lower() in usual:
        return ""
    return say("{name} ends in {suffix}, but its content is that of {usual}: rename it, as some programs go by the "
               "name.", name=file.name, suffix=file.suffix, usual=usual[0])


def _by_content(file: Path, head: bytes) -> Iterable[FileFacts]:
    for fits, facts in _READERS:
        if fits(file, head):
            return facts(file, head)
    needed = _NEEDED_SUFFIX.get(file.suffix.lower())
    if needed and not head.startswith(needed):
        raise InputError(say("{name} does not begin as a file of this name's ending does: it is damaged or of another "
                             "kind; copy or download it again.", name=file.name))
    return table_facts(file, head)


def _starts(*firsts: bytes) -> Callable[[Path, bytes], bool]:
    return lambda _file, head: head.startswith(firsts)


def _is_xml(_file: Path, head: bytes) -> bool:
    return _text_start(head).startswith(b"<")


def _is_json(_file: Path, head: bytes) -> bool:
    return _text_start(head)[:1] in (b"{", b"[")


def _text_start(head: bytes) -> bytes:
    return head.removeprefix(b"\xef\xbb\xbf").lstrip()


def _is_page(_file: Path, head: bytes) -> bool:
    return _text_start(head)[:15].lower().startswith((b"<!doctype html", b"<html"))


def _is_mesh(file: Path, head: bytes) -> bool:
    return head.startswith((b"ply\n", b"ply\r\n", b"glTF")) or (
        file.suffix.lower() == ".obj" and any(line.startswith((b"v ", b"mtllib")) for line in head.splitlines()[:50]))


def _packed_facts(file: Path, head: bytes) -> Iterable[FileFacts]:
    """A gzipped file: RINEX, a city model, or a table of scans, told from the start of what is packed."""
    try:
        with gzip.open(file) as stream:
            inner = stream.read(HEAD_BYTES)
        if is_gnss(inner):
            return gnss_facts(file, inner)
        with tempfile.TemporaryDirectory() as folder:
            plain = Path(folder) / unpacked_name(file).name
            is_model = _is_xml(file, inner) or _is_json(file, inner)
            plain.write_bytes(read_unpacked(file) if is_model else inner[:inner.rfind(b"\n") + 1])
            (facts, *_) = _by_content(plain, inner)
    except (OSError, EOFError) as error:
        raise InputError(say("{name} is not a sound gzip file: fetch it again.", name=file.name)) from error
    if facts.kind == CITY_MODEL:
        return [replace(facts, path=file)]
    return [FileFacts(file, SCANS) if facts.kind == SCANS else FileFacts(file, OTHER, detail=say("packed"))]


_READERS: tuple[tuple[Callable[[Path, bytes], bool], Callable[[Path, bytes], Iterable[FileFacts]]], ...] = (
    (_starts(b"LASF"), cloud_facts),
    (_starts(b"SQLite format 3\0"), geopackage_facts),
    (_starts(b"\0\0\x27\x0a"), shapefile_facts),
    (lambda _file, head: is_raster(head), raster_facts),
    (_starts(b"\x1f\x8b"), _packed_facts),
    (_starts(b"PK\x03\x04"), zip_facts),
    (_starts(b"PAR1"), parquet_facts),
    (lambda _file, head: is_gnss(head), gnss_facts),
    (_is_page, lambda file, _head: [FileFacts(file, REPORT)]),
    (_is_xml, xml_facts),
    (_is_json, json_facts),
    (_is_mesh, lambda file, _head: [FileFacts(file, MESH)]),
    (is_sbet, sbet_facts),
)
"""Whether a file is of a kind by its first bytes, and what tells the rest; the first that fits."""
