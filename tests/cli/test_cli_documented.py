"""Every command block of the README and the pages runs as it stands there, by a shell, on the sample city."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import sqlite3
import subprocess
from contextlib import closing
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "README.ja.md", *sorted((ROOT / "docs").glob("*.md"))]

# What the pages call the user's own files, and where the sample city has such.
FILES = {
    "block.laz": "als/als.laz", "als.laz": "als/als.laz", "outlines.gpkg": "footprints/gsi_buildings.gpkg",
    "frames": "aerial", "camera.json": "aerial/camera.json", "exterior.csv": "aerial/exterior.csv",
    "survey.laz": "mms/survey_01.laz", "trajectory.csv": "mms/survey_01_trajectory.csv",
    "calibration.json": "mms/calibration.json", "markings.gpkg": "truth/markings.gpkg", "lines": "lines",
    "day.nav": "gnss/satellites.nav", "second_flight.laz": "als/als.laz",
}


def commands_of(page: Path) -> list[str]:
    """Commands in the blocks without a language, lines that go on joined."""
    blocks = re.findall(r"^```(?:sh|bash)?\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)
    lines = "\n".join(blocks).replace("\\\n", " ").splitlines()
    return [line for line in lines if re.match(r"(scripts/\w|qgis_process|make |python|\.venv)", line)]


def outputs_of(command: str) -> list[str]:
    return re.findall(r"\bOUTPUT\w*=(\S+)", command)


def test_pages_have_commands():
    assert sum(len(commands_of(page)) for page in PAGES) >= 9


@pytest.fixture(scope="module")
def done_before():
    """Commands that ran for an earlier page: the same command in the same folder runs once."""
    return set()


@pytest.fixture(scope="module")
def folder(small_city, tmp_path_factory):
    """A user's folder: his files under the names of the pages, and the checkout's scripts."""
    made = tmp_path_factory.mktemp("user")
    for name, place in FILES.items():
        (made / name).symlink_to(small_city / place)
    (made / "scripts").symlink_to(ROOT / "scripts")
    shutil.copy(small_city / "truth/areas.gpkg", made / "roads.gpkg")
    with closing(sqlite3.connect(made / "roads.gpkg")) as roads:
        roads.execute("DELETE FROM areas WHERE kind != 'carriageway'")
        roads.commit()
    return made


@pytest.mark.once
@pytest.mark.parametrize("page", [page for page in PAGES if commands_of(page)], ids=lambda page: page.stem)
def test_commands_of_a_page_run(page, folder, done_before):
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("QGIS_", "PYTHON"))}
    for command in commands_of(page):
        if command in done_before:
            continue
        if command.startswith("make "):
            target = shlex.split(command, comments=True)[1]
            assert subprocess.run(["make", "-n", target], cwd=ROOT, capture_output=True, check=False).returncode == 0
            continue
        done = subprocess.run(["sh", "-c", command], cwd=folder, env=environment, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, check=False)
        assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
        missing = [name for name in outputs_of(command) if not (folder / name).exists()]
        assert not missing, f"{command}\n{done.stdout}"
        done_before.add(command)
    if page.name == "README.md":
        assert statuses(folder / "accuracy.gpkg") <= {"ok", "slides along the street"}


def statuses(path: Path) -> set[str]:
    """What is said of the places of a map of localisation accuracy."""
    with closing(sqlite3.connect(path)) as database:
        return {status for status, in database.execute("SELECT status FROM accuracy")}


def test_launcher_lists_helps_and_refuses(folder):
    def call(*arguments):
        return subprocess.run(["sh", str(ROOT / "scripts" / "urbanmap"), *arguments], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, check=False)

    assert "urbanmap:buildingsfromals" in call("list").stdout
    assert "EXPANSION" in call("help", "segmentbuildings").stdout
    assert call().returncode == 2
    refused = call("samplecity", "SIZE=1", f"OUTPUT={folder / 'city_1'}")
    assert refused.returncode == 1 and "Traceback" not in refused.stderr


def test_launcher_without_qgis_says_so(tmp_path):
    for tool in ("sh", "dirname", "readlink"):
        (tmp_path / tool).symlink_to(shutil.which(tool))
    done = subprocess.run(["sh", str(ROOT / "scripts" / "urbanmap"), "list"], env={"PATH": str(tmp_path)},
                          capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "QGIS is not installed" in done.stderr


@pytest.mark.parametrize("page", sorted(ROOT.glob("docs/**/tutorial_*.md")),
                         ids=lambda page: f"{page.parent.name}-{page.stem}")
def test_tutorials_need_nothing_but_what_they_make(page, small_city):
    """A reader has the sample city, and what earlier commands of the page made."""
    made, asked = set(), []
    for command in commands_of(page):
        for name, value in re.findall(r"\b([A-Z][A-Z0-9_]*)=(\S+)", command):
            if name.startswith("OUTPUT"):
                made.add(value)
            elif "/" in value or re.search(r"\.[a-z]{2,}$", value):
                asked.append(value)
                assert value in made or (small_city / value.removeprefix("city/")).exists(), f"{value}: {command}"
    assert asked
