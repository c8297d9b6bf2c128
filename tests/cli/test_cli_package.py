"""The zip that users install: built, unpacked into a clean profile, and listed by QGIS."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    if not (ROOT / ".git").exists():
        pytest.skip("the zip is built from the files that git tracks, and this is no git checkout")
    target = tmp_path_factory.mktemp("build") / "urbanmap_qgis.zip"
    subprocess.run([sys.executable, str(ROOT / "scripts" / "package.py"), "--output", str(target)], check=True)
    return target


def test_zip_holds_what_is_needed_and_nothing_else(package):
    names = zipfile.ZipFile(package).namelist()
    assert {"urbanmap_qgis/metadata.txt", "urbanmap_qgis/LICENSE", "urbanmap_qgis/__init__.py",
            "urbanmap_qgis/algorithms/provider.py", "urbanmap_qgis/urbanmap_qgis/errors.py",
            "urbanmap_qgis/resources/icons/urbanmap.svg"} <= set(names)
    assert all(name.startswith("urbanmap_qgis/") for name in names)
    inside = {name.split("/")[1] for name in names}
    assert inside <= {"metadata.txt", "LICENSE", "README.md", "CHANGELOG.md", "__init__.py", "algorithms",
                      "urbanmap_qgis", "resources"}
    assert not [name for name in names if "__pycache__" in name or "/." in name or "/tests/" in name]


def test_zip_is_the_same_each_time(package, tmp_path):
    again = tmp_path / "again.zip"
    subprocess.run([sys.executable, str(ROOT / "scripts" / "package.py"), "--output", str(again)], check=True)
    assert again.read_bytes() == package.read_bytes()


def test_metadata_for_the_plugin_repository(package, tmp_path):
    """What is asked there is in the zip where it was given, and nothing that is made up where it was not."""
    import configparser

    def told(path):
        read = configparser.ConfigParser(interpolation=None)
        read.read_string(zipfile.ZipFile(path).read("urbanmap_qgis/metadata.txt").decode("utf-8"))
        return read["general"]

    assert not {"repository", "tracker", "homepage", "email"} & set(told(package))
    script = [sys.executable, str(ROOT / "scripts" / "package.py"), "--output", str(tmp_path / "p.zip")]
    subprocess.run([*script, "--repository", "https://code.example.org/survey/urbanmap/", "--email", "a@example.org"],
                   check=True)
    made = told(tmp_path / "p.zip")
    assert made["tracker"] == "https://code.example.org/survey/urbanmap/issues" and made["email"] == "a@example.org"
    assert made["repository"] == made["homepage"] and "Processing provider" in made["changelog"]
    assert subprocess.run([*script, "--repository", "urbanmap"], check=False, capture_output=True).returncode == 1


def test_unpacked_zip_lists_the_algorithms(package, new_profile, linked_profile):
    profile = new_profile()
    with zipfile.ZipFile(package) as archive:
        archive.extractall(profile.plugins)
    enabled = profile.call("plugins", "enable", "urbanmap_qgis")
    assert enabled.code == 0, enabled.err
    found = own_lines(profile.call("list").out)
    assert any("urbanmap:loadgsibuildings" in line for line in found)
    assert found == own_lines(linked_profile().call("list").out)


def own_lines(listing: str) -> list[str]:
    return [line.strip() for line in listing.splitlines() if "urbanmap:" in line]
