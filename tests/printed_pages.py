"""How far the pages of a printed report are filled."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

RESOLUTION = 30  # dpi
BLANK = 245  # grey value


def shares_filled(pdf: str | Path, margin: float, height: float) -> list[float]:
    """How far down each page is filled, as a share of `height` mm below a top margin of `margin` mm."""
    if shutil.which("pdftoppm") is None:
        pytest.skip("pdftoppm, which draws the pages, is not installed (poppler-utils)")
    told = subprocess.run(["pdftoppm", "-r", str(RESOLUTION), "-gray", str(pdf)], capture_output=True,
                          check=True).stdout
    shares = []
    while told:
        head = re.match(rb"P5\s+(\d+)\s+(\d+)\s+255\s", told)
        width, rows = int(head[1]), int(head[2])
        page = np.frombuffer(told, np.uint8, width * rows, head.end()).reshape(rows, width)
        told = told[head.end() + width * rows:]
        lowest = np.flatnonzero((page < BLANK).any(axis=1))[-1] + 1
        shares.append((lowest / RESOLUTION * 25.4 - margin) / height)
    return shares
