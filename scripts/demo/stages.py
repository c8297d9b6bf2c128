"""The stages of the demo: what is run on the sample city, in which order, and how each result is checked.

A new stage is one more row. Paths are relative to the demo's folder; `check` gets that folder.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from scripts.demo import checks
from scripts.demo import street_checks as street
from scripts.demo.checks import Figure
from scripts.demo.city_checks import city_files
from scripts.demo.lane_checks import lane_map
from scripts.demo.road_checks import road_space

CITY = Path("city")
ALS = CITY / "als/als.laz"
ALS_CLASSIFIED = CITY / "als/als_classified.laz"
OUTLINES = Path("outlines.gpkg")


@dataclass(frozen=True)
class Stage:
    """A run of an algorithm and the measure of its result.

    `parameters` hold paths as `Path`, and values as QGIS reads them.
    """

    title: str
    algorithm: str
    parameters: Mapping[str, object]
    check: Callable[[Path], list[Figure]]

    def parameters_in(self, folder: Path) -> dict[str, object]:
        """The parameters with paths in the demo's folder; a list stands for a parameter that is given several times."""
        return {name: _in(folder, value) for name, value in self.parameters.items()}


def _in(folder: Path, value: object) -> object:
    if isinstance(value, list):
        return [_in(folder, item) for item in value]
    return folder / value if isinstance(value, Path) else value


def _buildings(title: str, points: Path, name: str) -> Stage:
    """Building models from points and the loaded outlines, in files that begin with `name`."""
    return Stage(title, "urbanmap:buildingsfromals",
                 {"POINTS": points, "FOOTPRINTS": OUTLINES, "OUTPUT": Path(f"{name}.gpkg"),
                  "OUTPUT_SURFACES": Path(f"{name}_surfaces.gpkg"), "OUTPUT_CITYJSON": Path(f"{name}.city.json"),
                  "OUTPUT_REPORT": Path(f"{name}.html")},
                 partial(checks.models, models=name))


def stages(size: float, seed: int) -> list[Stage]:
    """All stages on a city of `size` metres, in the order in which they need each other."""
    return [
        Stage("Sample city", "urbanmap:samplecity", {"SIZE": size, "SEED": seed, "OUTPUT": CITY},
              checks.city_as_delivered),
        Stage("Load GSI buildings", "urbanmap:loadgsi",
              {"INPUT_FOLDER": CITY / "footprints", "OUTPUT_BUILDINGS": OUTLINES}, checks.loaded_outlines),
        Stage("Surface and ground from ALS", "urbanmap:surfacefromals",
              {"POINTS": ALS, "OUTPUT": Path("dsm.tif"), "OUTPUT_GROUND": Path("ground.tif")}, checks.surfaces),
        _buildings("Buildings from unclassified ALS", ALS, "models"),
        _buildings("Buildings from classified ALS", ALS_CLASSIFIED, "models_classified"),
        Stage("Road markings from frames", "urbanmap:aerialmarkings",
              {"FRAMES": CITY / "aerial", "CAMERA": CITY / "aerial/camera.json",
               "EXTERIOR": CITY / "aerial/exterior.csv", "ALS": ALS, "FOOTPRINTS": OUTLINES,
               "OUTPUT": Path("markings.tif"), "OUTPUT_POLYGONS": Path("markings.gpkg"),
               "OUTPUT_ORTHOPHOTO": Path("orthophoto.tif")}, checks.markings),
        *_street_stages(),
    ]


def _street_stages() -> list[Stage]:
    """What vehicles measured: mobile survey, line scanners and camera, GNSS."""
    survey, lines = CITY / "mms/survey_01", CITY / "lines"
    passes = [CITY / f"gnss/pass_{number:02d}" for number in range(1, 17)]
    return [
        Stage("Mobile survey onto the markings", "urbanmap:georeferencemms",
              {"POINTS": survey.with_suffix(".laz"), "TRAJECTORY": survey.with_name("survey_01_trajectory.csv"),
               "CALIBRATION": CITY / "mms/calibration.json", "MARKINGS": Path("markings.tif"),
               "GROUND": Path("ground.tif"), "OUTPUT": Path("survey_01.laz"),
               "OUTPUT_TRAJECTORY": Path("survey_01_trajectory.csv"), "OUTPUT_PATCHES": Path("survey_01_patches.gpkg"),
               "OUTPUT_REPORT": Path("survey_01.html")}, street.registered_survey),
        Stage("Lane map from markings and the drive", "urbanmap:lanemap",
              {"MARKINGS": Path("markings.gpkg"), "GROUND": Path("ground.tif"),
               "TRAJECTORY": Path("survey_01_trajectory.csv"), "TRAFFIC": "left", "OUTPUT_LANES": Path("lanes.gpkg"),
               "OUTPUT_CENTRES": Path("lane_centres.gpkg"), "OUTPUT_BOUNDS": Path("lane_bounds.gpkg"),
               "OUTPUT_FINDINGS": Path("lane_findings.gpkg"), "OUTPUT_LINES": Path("marking_lines.gpkg"),
               "OUTPUT_AREAS": Path("marking_areas.gpkg"), "OUTPUT_LANELET2": Path("lanes.osm"),
               "OUTPUT_OPENDRIVE": Path("lanes.xodr"), "OUTPUT_REPORT": Path("lanes.html")}, lane_map),
        Stage("Road model and street objects", "urbanmap:roadspace",
              {"POINTS": Path("survey_01.laz"), "TRAJECTORY": Path("survey_01_trajectory.csv"),
               "MARKINGS": Path("markings.gpkg"), "GROUND": Path("ground.tif"), "TRAFFIC": "left",
               "DATA_DATE": "2026-04-01", "OUTPUT": Path("road_surfaces.gpkg"),
               "OUTPUT_AREAS": Path("road_areas.gpkg"), "OUTPUT_STEPS": Path("road_steps.gpkg"),
               "OUTPUT_OBJECTS": Path("street_objects.gpkg"), "OUTPUT_FINDINGS": Path("road_findings.gpkg"),
               "OUTPUT_CITYGML": Path("road_citygml"), "OUTPUT_FURNITURE": Path("furniture_citygml"),
               "OUTPUT_REPORT": Path("road_model.html")}, road_space),
        Stage("Walls from the mobile survey", "urbanmap:wallsfrommms",
              {"POINTS": Path("survey_01.laz"), "BUILDINGS": Path("models.gpkg"), "GROUND": Path("ground.tif"),
               "OUTPUT": Path("walls.gpkg")}, street.measured_walls),
        Stage("Models merged with the walls", "urbanmap:mergebuildingmodels",
              {"MODELS": Path("models.gpkg"), "WALLS": Path("walls.gpkg"), "OUTPUT": Path("merged.gpkg"),
               "OUTPUT_WALLS": Path("merged_walls.gpkg"), "OUTPUT_CITYJSON": Path("merged.city.json")},
              street.merged_models),
        Stage("Rectified trajectory of the line scanners", "urbanmap:rectifytrajectory",
              {"TRAJECTORY": lines / "trajectory.csv", "TIE_POINTS": lines / "tie_points.csv",
               "GROUND": Path("ground.tif"), "SENSOR_HEIGHT": 1.95, "CRS": "EPSG:6677",
               "OUTPUT": Path("lines_trajectory.csv"), "OUTPUT_REPORT": Path("lines_trajectory.html")},
              street.rectified_trajectory),
        Stage("Facade textures", "urbanmap:facadetextures",
              {"IMAGES": lines / "camera_1.png", "TRAJECTORY": Path("lines_trajectory.csv"),
               "CALIBRATION": lines / "calibration.json", "BUILDINGS": Path("models.gpkg"),
               "POINTS": Path("survey_01.laz"), "OUTPUT": Path("textured.glb"), "OUTPUT_FOLDER": Path("textured"),
               "OUTPUT_FACADES": Path("facades.gpkg")}, street.textured_model),
        Stage("City model for other programs", "urbanmap:exportcitymodel",
              {"BUILDINGS": Path("models.gpkg"), "SURFACES": Path("models_surfaces.gpkg"),
               "TEXTURES": Path("textured/model.city.json"), "HEIGHTS": "JGD2011",
               "GEOID_HEIGHT": 36.6, "OUTPUT": Path("city_model.gpkg"), "OUTPUT_CITYJSONSEQ": Path("models.city.jsonl"),
               "OUTPUT_CITYGML": Path("citygml"), "OUTPUT_TILES": Path("tiles")}, city_files),
        Stage("Walls adjusted by GNSS reflections", "urbanmap:adjustwalls",
              {"BUILDINGS": CITY / "models/buildings.geojson",
               "TRAJECTORY": [path.with_name(f"{path.name}_trajectory.csv") for path in passes],
               "OBSERVATIONS": [path.with_suffix(".obs") for path in passes],
               "NAVIGATION": CITY / "gnss/satellites.nav", "GEOID_SEPARATION": 36.6, "OUTPUT": Path("adjusted.gpkg"),
               "OUTPUT_WALLS": Path("adjusted_walls.gpkg"), "OUTPUT_REPORT": Path("adjusted.html")},
              street.adjusted_walls),
    ]
