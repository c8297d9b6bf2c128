"""Sums in one order: products of matrices by several threads differ in their last digits with the number of threads."""

from __future__ import annotations

import ctypes
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

VARIABLES = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
"""What libraries (BLAS) that are loaded later, also in processes started meanwhile, take the number from."""

_CALLS = [tuple(f"{prefix}openblas_{verb}_num_threads{suffix}" for verb in ("get", "set"))
          for prefix in ("", "scipy_") for suffix in ("", "64_", "_64")]

_lock = threading.Lock()
_runs = 0
_before: dict[str, str | None] = {}
_undo: list[tuple] = []


@contextmanager
def same_sums() -> Iterator[None]:
    """In the block, the BLAS libraries that numpy and scipy have loaded, or load, work in one thread.

    The last of several blocks that are open at a time, in whatever threads, gives the libraries back their threads.
    """
    global _runs
    with _lock:
        if not _runs:
            _before.update({name: os.environ.get(name) for name in VARIABLES})
            os.environ.update(dict.fromkeys(VARIABLES, "1"))
        _runs += 1
        for library in _loaded_libraries():
            _limit(library)
    try:
        yield
    finally:
        with _lock:
            _runs -= 1
            if not _runs:
                _restore()


def _limit(library: ctypes.CDLL) -> None:
    for getter, setter in _CALLS:
        get, put = getattr(library, getter, None), getattr(library, setter, None)
        if get is not None and put is not None:
            get.restype = ctypes.c_int
            threads = get()
            if threads > 1:
                put(1)
                _undo.append((put, threads))


def _restore() -> None:
    while _undo:
        put, threads = _undo.pop()
        put(threads)
    for name, value in _before.items():
        if value is None:
            os.environ.pop(name, None)
        else:
            os.environ[name] = value
    _before.clear()


def _loaded_libraries() -> list[ctypes.CDLL]:
    """OpenBLAS where it is loaded: by Linux's list of what is, elsewhere where wheels of numpy and scipy hold it."""
    maps = Path("/proc/self/maps")
    if maps.exists():
        lines = maps.read_text(encoding="utf-8", errors="replace").splitlines()
        fields = (line.split(maxsplit=5) for line in lines if "blas" in line)  # of thousands of lines
        names = {field[5] for field in fields if len(field) == 6 and "blas" in Path(field[5]).name}
    else:
        names = {str(path) for package in ("numpy", "scipy") if package in sys.modules
                 for path in _in_wheel(Path(sys.modules[package].__file__).parent)}
    libraries = []
    for name in sorted(names):
        try:
            libraries.append(ctypes.CDLL(name))
        except OSError:  # a file that was replaced since it was loaded, or an extension module that is no library
            continue
    return libraries


def _in_wheel(package: Path) -> list[Path]:
    folders = (package.with_name(f"{package.name}.libs"), package / ".libs", package / ".dylibs")
    return [path for folder in folders for path in folder.glob("*openblas*")]
