"""The face of the plugin with Qt 6, as QGIS 4 has it, where PyQt6 is installed (`make qt6`, or in .venv)."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
APART = ROOT / "build" / "qt6"


@pytest.mark.skipif(not APART.is_dir() and importlib.util.find_spec("PyQt6") is None,
                    reason="PyQt6 is not installed; run: make qt6")
def test_every_module_is_imported_and_windows_work_with_qt_6():
    """In a process of its own: PyQt5 and PyQt6 do not go together."""
    done = subprocess.run([sys.executable, str(Path(__file__).with_name("qt6_stub.py"))], capture_output=True,
                          text=True, env={**os.environ, "QT_QPA_PLATFORM": "offscreen", "PYTHONPATH": str(APART)},
                          check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "0 not; windows: InstallDialog, FilesField, FilesDialog" in done.stdout
