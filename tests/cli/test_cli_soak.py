"""A short soak: a run over tiles that is killed, starved and damaged ends with the bytes of one that was not."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.once
@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the soak limits files as Linux does")
def test_a_short_soak(tmp_path):
    done = subprocess.run([sys.executable, str(ROOT / "scripts" / "soak.py"), str(tmp_path), "--rounds", "6", "--side",
                           "2", "--seed", "4"], capture_output=True, text=True,
                          env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
    assert done.returncode == 0, done.stdout + done.stderr
    assert "6 misfortunes" in done.stdout and "the same bytes" in done.stdout
