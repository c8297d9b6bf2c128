"""The tutorials' pictures: QGIS's desktop really opens, with the toolbox and dialogs that the pages show."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "make_tutorial_pictures.py"

pytestmark = [pytest.mark.once, pytest.mark.skipif(
    shutil.which("xvfb-run") is None or not (shutil.which("qgis.bin") or shutil.which("qgis")),
    reason="no QGIS desktop or no xvfb-run (apt install qgis xvfb)",
)]


def test_toolbox_and_dialog_are_drawn(tmp_path):
    sizes = {"toolbox.jpg": (800, 1280), "survey_dialog.jpg": (640, 900)}
    command = [sys.executable, str(SCRIPT), *sizes, "--folder", str(tmp_path / "work"), "--to", str(tmp_path)]
    environment = {key: value for key, value in os.environ.items() if key != "URBANMAP_TUTORIAL"}
    done = subprocess.run(command, capture_output=True, text=True, timeout=180, env=environment, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    for name, size in sizes.items():
        picture = cv2.imread(str(tmp_path / name))
        assert picture.shape[:2] == size
        dark = np.mean(picture.max(axis=2) < 110)
        assert 0.01 < dark < 0.3, "letters and icons on a bright window"
        assert (tmp_path / name).stat().st_size < 120_000


def test_unknown_picture_is_refused(tmp_path):
    done = subprocess.run([sys.executable, str(SCRIPT), "other.jpg", "--to", str(tmp_path)], capture_output=True,
                          text=True, timeout=60, check=False)
    assert done.returncode == 1 and "There is no picture other.jpg" in done.stderr and not list(tmp_path.iterdir())
