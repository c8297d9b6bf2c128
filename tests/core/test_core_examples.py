"""The examples of the page of the core run as they stand there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PAGES = Path(__file__).resolve().parents[2] / "docs" / "api"
CORE = PAGES.parents[1] / "urbanmap_qgis"


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::rasterio.errors.NotGeoreferencedWarning")
def test_examples_run(small_city, tmp_path, monkeypatch):
    (tmp_path / "city").symlink_to(small_city)
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in re.findall(r"```python\n(.*?)```", (PAGES / "index.md").read_text(encoding="utf-8"), re.DOTALL):
        exec(compile(block, block.split("\n")[0], "exec"), names)
    error = abs(names["registered"].correction.value[:, :2]).max(axis=1)
    assert 0.1 < error.mean() < 3.0, "the survey was moved by about what it was wrong"
    assert sum(bool(model.solids) for model in names["models"]) > 0.8 * len(names["models"]) > 0
    assert names["walls"] and names["work"].lines and (names["seen"].satellites > 3).any()
    assert 0.0 < names["accuracy"].ellipse.major[0] < 5.0
    assert names["after"].mean_2d < 0.2 < names["before"].mean_2d
    assert names["inspected"].objects >= len(names["city_objects"]) > 0
    assert len(names["given"]) > 0 and names["change"].mean == pytest.approx(36.7)
    assert names["lanes"].lanes and not [fault for fault in names["faults"] if fault.severity == "error"]
    assert names["edges"].length("kerb", "lowered kerb") > 50.0 and names["objects"].objects
    assert names["calm"].pixels_shared > 0 and names["usual"].mean_2d < 0.05 and names["accepted"] == "passed"
    assert 0.3 < names["street"].ground / names["street"].usable < 0.7 and names["within"] > 0.9
    assert all(building.valid for building in names["merged"]) and abs(names["figures"].los_median) < 1.0
    calibrated = names["mounted"].boresights
    assert calibrated.determined[:, :2].all() and calibrated.rms_after < 0.5 * calibrated.rms_before
    assert (names["official_ground"].lowest, names["official_ground"].highest) == pytest.approx((30.0, 32.0), abs=0.5)
    assert names["official_ground"].system == "JGD2011"
    assert not names["changes"] and {piece.kind for piece in names["road"].pieces} == {"road", "junction"}
    assert names["held"].rms(names["held"].followed) < 0.02 < names["held"].rms(names["held"].followed, before=True)
    assert names["lifted"].shift == pytest.approx([0.0, 0.0, 0.1], abs=0.01)
    assert names["network"].median_sigma() < 0.1 and len(names["network"].drives) == 2
    assert names["facades"]["textured"] > 3 and names["window"].status == "measured"
    assert names["overlaid"][0].edges[0] > 1000.0 and len(names["proposed"].ties) >= 2
    assert set(names["reflecting"].walls.status) == {"not observable"}
    assert [step.algorithm for step in names["chain"].steps] == ["aerialmarkings"] and not names["chain"].missing
    assert {"trajectory", "camera", "calibration"} <= {item.kind for item in names["facts"]}


def test_each_room_has_its_page():
    rooms = {path.parent.name for path in CORE.glob("*/__init__.py")}
    assert rooms and rooms == {path.stem for path in PAGES.glob("*.md")} - {"index"}
    assert all(f"::: urbanmap_qgis.{room}\n" in (PAGES / f"{room}.md").read_text(encoding="utf-8") for room in rooms)


def test_items_of_docstrings_go_below_their_names():
    from scripts.api_docstrings import as_numpydoc

    text = ("What.\n\nParameters\n----------\nx, y : (n,) m.\n    More: words.\nkind : which.\n\n"
            "Returns\n-------\n(n,) m.\n")
    assert as_numpydoc(text).splitlines() == [
        "What.", "", "Parameters", "----------", "x, y", "    (n,) m.", "    More: words.", "kind", "    which.", "",
        "**Returns**", "", "(n,) m."]
