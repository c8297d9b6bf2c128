"""One sitting in QGIS's desktop: every dialog, runs again and again, cancelling, the plugin off and on."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.gui.sitting import NEEDS_DESKTOP, profile_with_packages, windows

ROOT = Path(__file__).resolve().parents[2]
STYLES = ROOT / "resources" / "styles"

pytestmark = NEEDS_DESKTOP

ALS = {"POINTS": ["city:als/als.laz"], "FOOTPRINTS": "city:footprints/gsi_buildings.gpkg"}
MAP = {"BUILDINGS": "city:models/buildings.geojson", "NAVIGATION": ["city:gnss/satellites.nav"]}
WANTED = "TEMPORARY_OUTPUT"
RUNS = {
    "segmentbuildings": (ALS, 2, 1, {"Buildings": "segmented_buildings"}),
    "roadmarkingsfromorthophoto": ({"INPUT": "city:aerial/ortho.tif"}, 2, 1, {
        "Marking mask": "marking_mask", "Road markings": "road_markings"}),
    "checkaccuracy": ({"TRAJECTORY": "city:mms/survey_01_trajectory.csv", "CRS": "EPSG:6677",
                       "CONTROL": "city:truth/control_survey_01.csv"}, 2, 1, {"Residuals": "control_residuals"}),
    "rectifytrajectory": ({"TRAJECTORY": "city:lines/trajectory.csv", "TIE_POINTS": "city:lines/tie_points.csv",
                           "OUTPUT_SETS": WANTED, "OUTPUT_EPOCHS": WANTED}, 2, 1, {
        "Sets": "rectification_sets", "Epochs": "rectification_epochs"}),
    "satellitevisibility": ({**MAP, "TIME": "2024-04-18 02:00:00", "RESOLUTION": 8.0, "OUTPUT_RASTER": WANTED}, 2, 1, {
        "Visible satellites": "satellite_visibility", "Visible satellites over the area": "satellite_visibility_area"}),
    "localisationaccuracy": ({**MAP, "TRAJECTORY": ["city:truth/survey_01_trajectory.csv"], "SPACING": 10.0}, 2, 1, {
        "Localisation accuracy": "localisation_accuracy"}),
    "buildingsfromals": (ALS, 2, 0, {"Building models": "building_models"}),
    "tiledrun": ({**ALS, "ALGORITHM": "buildingsfromals", "TILE": 100.0, "OUTPUT_FOLDER": "made:tiles"}, 1, 0, {
        "Tiles": "tiles", "Building models": "building_models"}),
}
"""Of each group an algorithm that makes layers: what is given, runs in one dialog, new dialogs, style by layer."""

CANCELLED = ("groundfrommms", {"POINTS": ["city:mms/survey_01.laz"]})
STEPS = ["dialogs", "runs", "together", "cancel", "reloads", "again", "models", "distances"]


def in_place(value, city: Path, made: Path):
    """A value with "city:PLACE" and "made:PLACE" as the path in that folder."""
    if isinstance(value, dict):
        return {key: in_place(item, city, made) for key, item in value.items()}
    if isinstance(value, list):
        return [in_place(item, city, made) for item in value]
    kind, _, place = value.partition(":") if isinstance(value, str) else ("", "", "")
    return str({"city": city, "made": made}[kind] / place) if kind in ("city", "made") else value


@pytest.fixture(scope="module")
def sitting(small_city, tmp_path_factory):
    """What the steps of one sitting in one QGIS gave, with the packages where the plugin installs them."""
    folder = tmp_path_factory.mktemp("desktop")
    profile = profile_with_packages(folder)
    runs = [(f"urbanmap:{name}", in_place(given, small_city, folder), same, others)
            for name, (given, same, others, _) in RUNS.items()]
    journey = {"steps": STEPS, "runs": runs, "model": in_place(ALS, small_city, folder),
               "report": str(folder / "report.json"),
               "cancel": (f"urbanmap:{CANCELLED[0]}", in_place(CANCELLED[1], small_city, folder))}
    (folder / "journey.json").write_text(json.dumps(journey), encoding="utf-8")
    try:
        windows().open_desktop(Path(__file__).with_name("desktop_journey.py"), folder, profile,
                               URBANMAP_JOURNEY=str(folder / "journey.json"))
    except subprocess.CalledProcessError as error:
        print(error)  # the steps that it came to are in the report; the others fail
    return json.loads((folder / "report.json").read_text(encoding="utf-8"))


@pytest.fixture
def step(sitting):
    """`step(number)`: the result of a step."""

    def result(number: int):
        assert len(sitting) > number, f"QGIS ended in the step {STEPS[len(sitting)]}"
        assert "error" not in sitting[number], sitting[number]["error"]
        assert sitting[number]["step"] == STEPS[number]
        return sitting[number]["result"]

    return result


def drawn_by(style: str) -> tuple[str, list[str]]:
    """Kind of renderer and labels of the legend that a style says."""
    root = ElementTree.parse(STYLES / f"{style}.qml").getroot()
    renderer = next(item for item in root.iter() if item.tag in ("renderer-v2", "rasterrenderer"))
    labels = [item.get("label") for item in renderer.iter() if item.tag in (
        "category", "range", "rule", "item", "paletteEntry") and item.get("label") is not None]
    return renderer.get("type"), labels


def test_every_dialog_opens(step):
    titles = step(0)
    assert len(titles) > 45 and all(titles.values())


@pytest.mark.parametrize("number", [1, 5])
@pytest.mark.parametrize("name", RUNS)
def test_runs_repeat_with_layers_and_styles(step, name, number):
    _, same, others, styles = RUNS[name]
    results = dict(step(number))[f"urbanmap:{name}"]
    assert len(results) == (same + others if STEPS[number] == "runs" else 1)
    for result in results:
        assert result["succeeded"], result["log"][-3000:]
        # Its successor prints pages, so that it works in the window's thread and has ended before anybody listens.
        assert result["moves"] > 0 or name == "checkaccuracy"
        layers = {layer["name"]: layer for layer in result["layers"]}
        assert set(layers) == set(styles)
        for title, style in styles.items():
            kind, labels = drawn_by(style)
            assert layers[title]["renderer"] == kind
            assert layers[title]["legend"] == labels or not labels
            assert layers[title]["size"] > 0 and layers[title]["at_home"]


def test_two_dialogs_work_at_a_time(step):
    assert step(2) == [[True], [True]]


def test_cancel_ends_a_run_soon(step):
    told = step(3)
    assert told["seconds"] < 30 and "Execution completed" not in told["log"], told


def test_plugin_off_and_on_lists_all(step):
    told = step(4)
    first, *rest = told["listed"]
    assert len(first) > 45
    assert rest == [[], first] * 3, [len(ids) for ids in rest]
    assert told["between"] == [[], [], []]


def test_models_open_as_copies_in_the_modeller_and_run_with_files_preset(step):
    told = step(6)
    assert set(told["opened"]) == {
        "Buildings from ALS (model)", "Georeference mobile survey (model)", "Lane map from markings and drives (model)",
        "Road markings from aerial frames (model)", "Road space from a mobile survey (model)"}
    for name, copy in told["opened"].items():
        assert copy == {"name": name, "file": "", "steps": copy["steps"], "sound": True, "shown": True}
        assert copy["steps"] >= 2
    assert told["run"]["succeeded"], told["run"]["log"][-3000:]
    assert [layer["size"] > 0 and layer["at_home"] for layer in told["run"]["layers"]] == [True]
    assert [layer["name"] for layer in told["run"]["layers"]] == ["Building models"]
    assert told["entries"] == [["urbanmap:buildingsfromals_model", "Open a copy in the modeller…"]]


def test_a_unit_is_shown_once_beside_a_distance(step):
    for told in step(7).values():
        assert "Expansion" in told["labels"] and "meters" in told["boxes"]
        assert not [label for label in told["labels"] if label.endswith("(m)")]
