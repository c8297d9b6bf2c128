"""What tests share and need long to make: made once, kept under build/ until the code that makes it changes."""

from __future__ import annotations

import fcntl
import hashlib
import os
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

STORE = Path(__file__).resolve().parents[1] / "build" / "test_cities"


def stored(name: str, sources: Iterable[Path], make: Callable[[Path], None]) -> Path:
    """Folder that `make(folder)` has filled, now or in an earlier run with the same contents of `sources`.

    Processes that ask at the same time wait for the one that makes it. Nobody may write into the folder.
    """
    key = hashlib.sha256(b"".join(path.read_bytes() for path in sorted(sources))).hexdigest()[:12]
    folder = STORE / f"{name}-{key}"
    STORE.mkdir(parents=True, exist_ok=True)
    with (STORE / f"{name}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not folder.is_dir():
            beside = folder.with_name(f"{folder.name}-{os.getpid()}")
            shutil.rmtree(beside, ignore_errors=True)
            beside.mkdir()
            make(beside)
            beside.rename(folder)
    return folder
