"""Memory that a run has used is used again within the run, rather than handed back and asked for anew.

The C library (glibc) hands the memory of every large array back to the system at once. The next array of that size is
then cleared page by page once more: in runs that work through points in chunks the system's part of the CPU time was a
third to a half more.
"""

from __future__ import annotations

import ctypes
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

_TRIM_THRESHOLD, _TOP_PAD, _MMAP_THRESHOLD = -1, -2, -3
_DURING = ((_MMAP_THRESHOLD, 64 << 20), (_TRIM_THRESHOLD, 256 << 20), (_TOP_PAD, 64 << 20))
_AFTER = ((_MMAP_THRESHOLD, 32 << 20), (_TRIM_THRESHOLD, 64 << 20), (_TOP_PAD, 128 << 10))
"""Bytes: blocks that get pages of their own, free memory at the end that goes back, and what is taken beyond need.
Afterwards they are what the library itself comes to in a process that has freed a large array."""

_lock = threading.Lock()
_runs = 0


@contextmanager
def kept_memory() -> Iterator[None]:
    """In the block, and in others that are open at a time, freed memory up to 64 MB a piece is kept.

    The end of the last of them gives back to the system what is free. Where there is no glibc nothing is done.
    """
    global _runs
    library = _glibc()
    with _lock:
        _runs += 1
        if _runs == 1:
            _set(library, _DURING)
    try:
        yield
    finally:
        with _lock:
            _runs -= 1
            if not _runs and library is not None:
                _set(library, _AFTER)
                library.malloc_trim(ctypes.c_size_t(0))


def _glibc() -> ctypes.CDLL | None:
    """The C library of this process where it is glibc."""
    if not sys.platform.startswith("linux"):
        return None
    library = ctypes.CDLL(None)
    return library if hasattr(library, "gnu_get_libc_version") and hasattr(library, "mallopt") else None


def _set(library: ctypes.CDLL | None, options: tuple[tuple[int, int], ...]) -> None:
    if library is not None:
        for option, value in options:
            library.mallopt(ctypes.c_int(option), ctypes.c_int(value))
