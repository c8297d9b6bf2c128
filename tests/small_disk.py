"""A small disk in memory, to be filled."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest


@contextmanager
def small_disk(folder: Path, size: str) -> Iterator[None]:
    """In the block, `folder` is a disk of `size` ("4m"); the test is skipped where that is not permitted."""
    folder.mkdir(exist_ok=True)
    if not sys.platform.startswith("linux") or mount("-t", "tmpfs", "-o", f"size={size}", "none", str(folder)):
        pytest.skip("a disk in memory cannot be mounted here")
    try:
        yield
    finally:  # lazy: a library may still hold a file that it could not write
        subprocess.run(["umount", "--lazy", str(folder)], check=True)


def mount(*arguments: str) -> int:
    """Code with which the system's mount ended; 1 where there is none."""
    try:
        return subprocess.run(["mount", *arguments], capture_output=True, check=False).returncode
    except OSError:
        return 1
