"""Real `qgis_process` runs with the checkout as a plugin in a clean profile.

The plain fixture for most tests is `run_algorithm`:
`run_algorithm("urbanmap:segmentroofs", POINTS=[a, b], BIN_WIDTH=0.5)`.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDER = "urbanmap_qgis"

# Debian 12's wrapper /usr/bin/qgis_process hands the program an option that it does not know.
QGIS_PROCESS = shutil.which("qgis_process.bin") or shutil.which("qgis_process")


@dataclass(frozen=True)
class Finished:
    """A finished run: exit code, what it printed, and the results by output name (empty after a failure)."""

    code: int
    out: str
    err: str
    results: dict = field(default_factory=dict)
    log: dict = field(default_factory=dict)


@dataclass(frozen=True)
class Profile:
    """A clean QGIS profile that sees the plugin folders in `plugins` and nothing else of the user's.

    `changes` are environment variables to set beside its own.
    """

    home: Path
    changes: dict[str, str] = field(default_factory=dict)

    @property
    def plugins(self) -> Path:
        return self.home / "plugins"

    def environment(self) -> dict[str, str]:
        packages = sorted((ROOT / ".venv" / "lib").glob("python3.*/site-packages"))
        kept = {key: value for key, value in os.environ.items() if not key.startswith(("QGIS_", "PYTHON"))}
        return {
            **kept,
            "HOME": str(self.home),
            "LANG": "C.UTF-8",
            # The Python inside QGIS takes its home from the first python3 on the path, which may be another one.
            "PATH": os.pathsep.join(["/usr/bin", "/bin", os.environ.get("PATH", "")]),
            "PYTHONPATH": os.pathsep.join(map(str, packages)),
            "QGIS_CUSTOM_CONFIG_PATH": str(self.home / "config"),
            "QGIS_PLUGINPATH": str(self.plugins),
            "QT_QPA_PLATFORM": "offscreen",
            "XDG_RUNTIME_DIR": str(self.home / "runtime"),
            **self.changes,
        }

    def start(self, *arguments: str, **options) -> subprocess.Popen:
        """Start `qgis_process` with these arguments."""
        return subprocess.Popen([QGIS_PROCESS, *arguments], env=self.environment(), text=True, encoding="utf-8",
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)

    def call(self, *arguments: str, timeout: float = 600.0) -> Finished:
        """Run `qgis_process` with these arguments to its end."""
        process = self.start(*arguments)
        try:
            out, err = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
        return Finished(process.returncode, out, err)

    def run_algorithm(self, algorithm: str, **parameters: object) -> Finished:
        """Run an algorithm; a list gives its parameter several times, None leaves it out."""
        done = self.call("--json", "run", algorithm, "--", *arguments_of(parameters))
        answer = json.loads(done.out[done.out.index("{"):]) if done.code == 0 else {}
        return Finished(done.code, done.out, done.err, answer.get("results", {}), answer.get("log", {}))


def arguments_of(parameters: dict[str, object]) -> list[str]:
    """`NAME=value` arguments, one for each element of a list."""
    arguments = []
    for name, value in parameters.items():
        for single in value if isinstance(value, (list, tuple)) else [value]:
            if single is not None:
                arguments.append(f"{name}={single}")
    return arguments


def pytest_collection_modifyitems(config, items):
    """Skip with the reason where there is no `qgis_process`."""
    if QGIS_PROCESS is None:
        for item in items:
            if Path(str(item.fspath)).parent == Path(__file__).parent:
                item.add_marker(pytest.mark.skip(reason="qgis_process is not installed"))


@pytest.fixture(scope="session")
def new_profile(tmp_path_factory) -> Callable[[], Profile]:
    """`new_profile()`: a clean profile without any plugin."""

    def make() -> Profile:
        profile = Profile(tmp_path_factory.mktemp("qgis"))
        profile.plugins.mkdir()
        (profile.home / "runtime").mkdir(mode=0o700)
        return profile

    return make


@pytest.fixture(scope="session")
def linked_profile(new_profile) -> Callable[..., Profile]:
    """`linked_profile("main")`: a clean profile with the checkout linked under that name and enabled."""
    made: dict[str, Profile] = {}

    def make(folder: str = FOLDER) -> Profile:
        if folder not in made:
            profile = new_profile()
            (profile.plugins / folder).symlink_to(ROOT, target_is_directory=True)
            enabled = profile.call("plugins", "enable", folder)
            assert enabled.code == 0, enabled.err
            made[folder] = profile
        return made[folder]

    return make


@pytest.fixture(scope="session")
def run_algorithm(linked_profile) -> Callable[..., Finished]:
    """`run_algorithm(id, **parameters)`: a run of the checkout's algorithm, see `Profile.run_algorithm`."""
    return linked_profile().run_algorithm
