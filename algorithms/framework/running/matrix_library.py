"""numpy's products of matrices, bound to the BLAS that numpy was built with.

QGIS brings the reference BLAS of the GNU Scientific Library (`libgslcblas`) into its process, in the scope in which
every library loaded later looks for its functions first. A numpy of the system that takes its BLAS from there
(`cblas_dgemm` and its like) multiplies several times slower, and rounds otherwise than in worker processes, so that
results would depend on the number of workers. Processing imports numpy before any plugin can, so importing it bound
to its own copies (`native_libraries`) comes too late: here the table of functions (see elf(5), relocations) of numpy's
module is corrected instead. Wheels of numpy carry a BLAS under names of its own; other systems bind names to files.
"""

from __future__ import annotations

import ctypes
import mmap
import platform
import struct
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ..declaring.parameters import tr

STRANGER = "libgslcblas"
PREFIX = b"cblas_"
_MAPS = Path("/proc/self/maps")
_LOAD, _DYNAMIC = 1, 2
_NEEDED, _STRTAB, _SYMTAB, _RELA, _RELASZ, _JMPREL, _PLTRELSZ = 1, 5, 6, 7, 8, 23, 2
_KINDS = {"x86_64": (1, 6, 7), "aarch64": (257, 1025, 1026)}
"""Relocations by a symbol's address: absolute, GLOB_DAT, JUMP_SLOT."""
_READ, _WRITE, _EXECUTE = 1, 2, 4


@dataclass(frozen=True)
class _Mapping:
    start: int
    end: int
    protection: int
    offset: int
    path: str


@dataclass(frozen=True)
class _Library:
    """Of a library's file: libraries that it needs, and where its table of functions stands, by their names."""

    needed: tuple[str, ...]
    slots: dict[str, list[int]]


_settled: list[str] = []


def bind_products() -> str:
    """Let numpy multiply with its own BLAS where it is loaded and bound to QGIS's; a sentence where that cannot be.

    What is bound stays so, and is looked at once a process.
    """
    if not _settled and _numpy_module() is not None:
        _settled.append(_bind())
    return _settled[0] if _settled else ""


def _bind() -> str:
    found = _strange_slots()
    if found is None:
        return ""
    library, slots = found
    mappings = _mappings()
    try:
        for address, name in slots:
            _write(address, ctypes.cast(getattr(library, name), ctypes.c_void_p).value, mappings)
    except (OSError, AttributeError):
        return tr("numpy multiplies matrices with a slow library of QGIS ({0}), and the system does not let it use its "
                  "own; results can differ in their last digits with the number of workers.").format(STRANGER)
    return ""


def products_library() -> str:
    """Library that numpy's products of matrices run in now, for the diagnostics; empty where it cannot be told."""
    module = _numpy_module()
    maps = _mappings()
    if module is None or not maps:
        return ""
    library = _read_library(module)
    for address in (_base(module, maps) + place for place in library.slots.get("cblas_dgemm", ())):
        value = ctypes.c_size_t.from_address(address).value
        return next((Path(item.path).name for item in maps if item.start <= value < item.end), "")
    return next((Path(item.path).name for item in maps if "openblas" in Path(item.path).name), "")


def _strange_slots() -> tuple[ctypes.CDLL, list[tuple[int, str]]] | None:
    """numpy's own BLAS, and address and name of each function of numpy's table that is another's; None if all is well.

    A slot that points into numpy itself is one that is bound when it is first called, which would be the stranger's.
    """
    module, mappings = _numpy_module(), _mappings()
    strangers = [item for item in mappings if STRANGER in Path(item.path).name]
    if module is None or not strangers:
        return None
    library, base = _read_library(module), _base(module, mappings)
    name = next((needed for needed in library.needed if "blas" in needed), "")
    if not name or STRANGER in name or not library.slots:
        return None
    inside = [*strangers, *(item for item in mappings if item.path == str(module))]
    strange = []
    for function, places in library.slots.items():
        for place in places:
            value = ctypes.c_size_t.from_address(base + place).value
            if any(item.start <= value < item.end for item in inside):
                strange.append((base + place, function))
    return (ctypes.CDLL(name), strange) if strange else None


def _numpy_module() -> Path | None:
    """File of numpy's compiled core, where it is loaded and the system is one whose tables are known here."""
    loaded = sys.modules.get("numpy.core._multiarray_umath") or sys.modules.get("numpy._core._multiarray_umath")
    file = getattr(loaded, "__file__", None)
    known = platform.machine() in _KINDS and sys.maxsize > 2**32 and sys.byteorder == "little" and _MAPS.exists()
    return Path(file).resolve() if file and known else None


def _mappings() -> list[_Mapping]:
    if not _MAPS.exists():
        return []
    result = []
    for line in _MAPS.read_text(encoding="utf-8", errors="replace").splitlines():
        fields = line.split(maxsplit=5)
        if len(fields) == 6 and fields[5].startswith("/"):
            start, end = (int(value, 16) for value in fields[0].split("-"))
            protection = sum(bit for bit, letter in ((_READ, "r"), (_WRITE, "w"), (_EXECUTE, "x"))
                             if letter in fields[1])
            result.append(_Mapping(start, end, protection, int(fields[2], 16), fields[5]))
    return result


def _base(module: Path, mappings: list[_Mapping]) -> int:
    """Address at which a library's file begins in memory; its first segment stands at 0 in the file."""
    return min((item.start for item in mappings if item.path == str(module) and item.offset == 0), default=0)


def _read_library(path: Path) -> _Library:
    """Read from a library's file (ELF, 64 bit, little end first) where its table holds functions of `PREFIX`."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        return _parsed(data)


def _parsed(data: mmap.mmap) -> _Library:
    if data[:6] != b"\x7fELF\x02\x01":
        return _Library((), {})
    first, = struct.unpack_from("<Q", data, 32)
    size, count = struct.unpack_from("<HH", data, 54)
    segments = [struct.unpack_from("<IIQQQQ", data, first + number * size) for number in range(count)]
    loads = [(place, offset, length) for kind, _, offset, place, _, length in segments if kind == _LOAD]

    def file_offset(place: int) -> int:
        return next((offset + place - start for start, offset, length in loads if start <= place < start + length), 0)

    tags: dict[int, list[int]] = {}
    for kind, _, offset, _, _, length in segments:
        for entry in range(offset, offset + length, 16) if kind == _DYNAMIC else ():
            tag, value = struct.unpack_from("<QQ", data, entry)
            tags.setdefault(tag, []).append(value)
    if not {_STRTAB, _SYMTAB} <= set(tags):
        return _Library((), {})
    texts = file_offset(tags[_STRTAB][0])

    def text(place: int) -> bytes:
        return data[texts + place:data.find(b"\0", texts + place)]

    slots: dict[str, list[int]] = {}
    for address, kind, number in _relocations(data, tags, file_offset):
        symbol, = struct.unpack_from("<I", data, file_offset(tags[_SYMTAB][0]) + 24 * number)
        if kind in _KINDS[platform.machine()] and number and text(symbol).startswith(PREFIX):
            slots.setdefault(text(symbol).decode(), []).append(address)
    return _Library(tuple(text(place).decode() for place in tags.get(_NEEDED, ())), slots)


def _relocations(data: mmap.mmap, tags: dict[int, list[int]], file_offset) -> Iterator[tuple[int, int, int]]:
    """Place in memory, kind and number of the symbol of each entry of the two tables."""
    for table, length in ((_RELA, _RELASZ), (_JMPREL, _PLTRELSZ)):
        if table in tags and length in tags:
            start = file_offset(tags[table][0])
            for entry in range(start, start + tags[length][0], 24):
                address, info = struct.unpack_from("<QQ", data, entry)
                yield address, info & 0xFFFFFFFF, info >> 32


def _write(address: int, value: int, mappings: list[_Mapping]) -> None:
    """Write an address into a table, which the system may hold ready for reading only."""
    mapping = next(item for item in mappings if item.start <= address < item.end)
    system = ctypes.CDLL(None, use_errno=True)
    page = ctypes.c_void_p(mapping.start)
    length = ctypes.c_size_t(mapping.end - mapping.start)
    if not mapping.protection & _WRITE and system.mprotect(page, length, mapping.protection | _WRITE):
        raise OSError(ctypes.get_errno(), "mprotect")
    try:
        ctypes.c_size_t.from_address(address).value = value
    finally:
        if not mapping.protection & _WRITE:
            system.mprotect(page, length, mapping.protection)
