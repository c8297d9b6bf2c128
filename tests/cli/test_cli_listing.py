"""The plugin is found by `qgis_process` from a link of any name, and says what it is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def listed_algorithms() -> list[str]:
    """Ids of the algorithms as their modules state them, read without importing QGIS."""
    texts = [path.read_text(encoding="utf-8") for path in (ROOT / "algorithms").glob("*/*.py")]
    texts = [text for text in texts if not re.search(r"\n    SUCCESSOR = |FlagHideFromToolbox", text)]  # left out
    names = [name for text in texts for name in re.findall(r'^    ID = "(\w+)"$', text, re.MULTILINE)]
    assert len(names) > 30
    return names


@pytest.mark.parametrize("folder", ["urbanmap_qgis", "urbanmap-qgis", "main"])
def test_listed_from_any_folder_name(linked_profile, folder):
    listing = linked_profile(folder).call("list")
    assert listing.code == 0, listing.err
    assert "UrbanMap" in listing.out
    for name in listed_algorithms():
        assert f"urbanmap:{name}\t" in listing.out, listing.err


def test_help_says_what_parameters_mean(linked_profile):
    text = linked_profile().call("help", "urbanmap:loadgsibuildings").out
    assert "INPUT" in text and "OUTPUT" in text
    assert "help" in text or "GML" in text
