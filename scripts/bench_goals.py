"""One line for each work that has a goal of speed: a part of `make bench`.

Each is held to a reference of the same run: what decoding its points costs alone, or for work without points the
Delaunay triangulation of `bench.py`. The surveys of the independent city are laid side by side until they have the
millions of points of the goal. Without that city beside the checkout a sample city is made.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np
import shapely
from scipy.spatial import Delaunay

from scripts import tiled_town
from scripts.bench_stages import DATA, city, cost, reading_cost, run_cost, start_row
from scripts.bench_table import print_table
from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.localisation.accuracy_map import accuracy_map
from urbanmap_qgis.localisation.accuracy_records import LocalisationMap
from urbanmap_qgis.localisation.localisation_settings import LocalisationSettings, VehicleScanner
from urbanmap_qgis.localisation.places.road_places import places_on_roads
from urbanmap_qgis.localisation.walls.wall_map import WallMap, wall_sigmas
from urbanmap_qgis.mobile.trajectory import path_chainage
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

ROOT = Path(__file__).resolve().parents[1]

HEADER = ("work", "CPU s", "value", "unit", "goal", "MB", "goal MB", "reference CPU s", "CPU / reference")
POINTS = 16_000_000
BESIDE, LATER = 400.0, 2000.0
"""m and s between two copies of a survey."""

PLACES, BLOCKS = 750, 18
TILES = 64


@dataclass(frozen=True)
class Goal:
    """A work: its name, what runs it in a folder with the data, the unit of its value, its goal and that of memory."""

    name: str
    run: Callable[[Path, Path], tuple[float, float, float, float]]
    unit: str
    goal: float
    memory: float | str = ""

    def row(self, data: Path, folder: Path) -> tuple:
        """The line of the table."""
        spent, value, used, reference = self.run(data, folder)
        return (self.name, spent, value, self.unit, self.goal, round(used) if used else "", self.memory, reference,
                spent / reference)


def triangulation() -> float:
    """CPU seconds of the reference for work without points."""
    points = np.random.default_rng(0).uniform(0, 1000, (200_000, 2))
    start = time.process_time()
    Delaunay(points)
    return time.process_time() - start


def side_by_side(surveys: Sequence[Path], folder: Path) -> list[Path]:
    """Copies of surveys beside each other with about `POINTS` points in all, each moved and at a time of its own."""
    made, total, number = [], 0, 0
    while total < 0.9 * POINTS:
        for path in surveys:
            target = folder / f"{path.stem}_{number}.laz"
            if not target.exists():
                survey = laspy.read(path)
                survey.X = survey.X + round(number * BESIDE / survey.header.scales[0])
                survey.gps_time = survey.gps_time + number * LATER
                survey.update_header()
                survey.write(target)
            with laspy.open(target) as reader:
                total += reader.header.point_count
            made.append(target)
        number += 1
    return made


def outlines_beside(outlines: Path, folder: Path, copies: int) -> Path:
    """The outlines likewise."""
    from osgeo import ogr

    ogr.UseExceptions()
    target = folder / "outlines.gpkg"
    source = ogr.Open(str(outlines))
    layer = source.GetLayer(0)
    made = ogr.GetDriverByName("GPKG").CreateDataSource(str(target))
    out = made.CreateLayer("outlines", layer.GetSpatialRef(), ogr.wkbUnknown)
    out.StartTransaction()
    shapes = [shapely.from_wkb(bytes(feature.GetGeometryRef().ExportToWkb())) for feature in layer]
    for number in range(copies):
        for moved in shapely.transform(np.array(shapes, object), lambda xy, by=number: np.add(xy, (by * BESIDE, 0.0))):
            feature = ogr.Feature(out.GetLayerDefn())
            feature.SetGeometry(ogr.CreateGeometryFromWkb(shapely.to_wkb(moved)))
            out.CreateFeature(feature)
    out.CommitTransaction()
    return target


def georeference(data: Path, folder: Path) -> tuple[float, float, float, float]:
    """The mobile chain on the true markings: seconds a kilometre of 7.5 million points."""
    survey, drive = data / "mms" / "survey_01.laz", data / "mms" / "survey_01_trajectory.csv"
    _, reference = reading_cost([survey])
    spent, used = run_cost("georeferencemms", {
        "POINTS": survey, "TRAJECTORY": drive, "CALIBRATION": data / "mms" / "calibration.json",
        "MARKINGS": f"{data / 'truth' / 'markings.gpkg'}|layername=aerial", "GROUND": data / "truth" / "ground.tif",
        "OUTPUT": folder / "moved.laz", "OUTPUT_TRAJECTORY": folder / "way.csv",
        "OUTPUT_PATCHES": folder / "patches.gpkg"})
    return spent, 1000 * spent / float(path_chainage(read_trajectory(drive).trajectory)[-1]), used, reference


def ground(data: Path, folder: Path) -> tuple[float, float, float, float]:
    """Ground of 16 million points."""
    surveys = side_by_side(sorted((data / "mms").glob("survey_*.laz")), folder)
    _, reference = reading_cost(surveys)
    spent, used = run_cost("groundfrommms", {"POINTS": surveys, "OUTPUT": folder / "ground.laz"})
    return spent, spent, used, reference


def walls(data: Path, folder: Path) -> tuple[float, float, float, float]:
    """Walls in 16 million points."""
    sources = sorted((data / "mms").glob("survey_*.laz"))
    surveys = side_by_side(sources, folder)
    outlines = outlines_beside(data / "footprints" / "gsi_buildings.gpkg", folder, len(surveys) // len(sources))
    _, reference = reading_cost(surveys)
    spent, used = run_cost("wallsfrommms", {"POINTS": surveys, "BUILDINGS": outlines, "OUTPUT": folder / "walls.gpkg"})
    return spent, spent, used, reference


def buildings(_data: Path, folder: Path) -> tuple[float, float, float, float]:
    """Buildings of Delft with slopes, with all levels of detail and files: milliseconds a building."""
    from osgeo import ogr

    delft = DATA / "als" / "delft_west"
    _, reference = reading_cost([delft / "points.laz"])
    spent, used = run_cost("buildingsfromals", {
        "POINTS": delft / "points.laz", "FOOTPRINTS": delft / "outlines.gpkg", "ROOFS": "planes",
        "OUTPUT": folder / "models.gpkg", "OUTPUT_CITYJSON": folder / "models.json",
        "OUTPUT_REPORT": folder / "models.html"})
    outlines = ogr.Open(str(delft / "outlines.gpkg"))  # its layer lives as long as it does
    return spent, 1000 * spent / outlines.GetLayer(0).GetFeatureCount(), used, reference


def lane_map(data: Path, folder: Path) -> tuple[float, float, float, float]:
    """Lane map from the true markings and drives: seconds for 10 km of lines."""
    from osgeo import ogr

    reference = triangulation()
    spent, used = run_cost("lanemap", {
        "MARKINGS": f"{data / 'truth' / 'markings.gpkg'}|layername=aerial",
        "TRAJECTORY": sorted((data / "truth").glob("survey_*_trajectory.csv")), "GROUND": data / "truth" / "ground.tif",
        "OUTPUT_LINES": folder / "lines.gpkg", "OUTPUT_AREAS": folder / "areas.gpkg",
        "OUTPUT_LANES": folder / "lanes.gpkg", "OUTPUT_BOUNDS": folder / "bounds.gpkg",
        "OUTPUT_LANELET2": folder / "lanes.osm", "OUTPUT_OPENDRIVE": folder / "lanes.xodr"})
    lines = ogr.Open(str(folder / "lines.gpkg"))
    metres = sum(feature.GetGeometryRef().Length() for feature in lines.GetLayer(0))
    return spent, 10_000 * spent / metres, used, reference


def localisation(_data: Path, _folder: Path) -> tuple[float, float, float, float]:
    """Places a second in a made town of 8,000 buildings, seen by a scanner of many layers; walls and repetitions."""
    rng = np.random.default_rng(3)
    across = 5 * BLOCKS
    at = np.arange(across) * 11.2 + 6.0 * (np.arange(across) // 5)
    shapes = np.array([shapely.box(x, y, x + rng.uniform(6, 10), y + rng.uniform(6, 10)) for x in at for y in at],
                      object)
    faces = building_walls(shapes, None, rng.uniform(5, 20, len(shapes)), np.zeros(len(shapes)))
    town = LocalisationMap(WallMap.of(faces, wall_sigmas(faces, 0.2)))
    roads = [shapely.LineString([(0, 62 * k - 3, 0), (at[-1], 62 * k - 3, 0)]) for k in range(1, BLOCKS)]
    places = places_on_roads(roads, 2.0).select(slice(0, PLACES))
    reference = triangulation()
    start = time.process_time()
    accuracy_map(town, places, LocalisationSettings(scanner=VehicleScanner("multi-layer")))
    spent = time.process_time() - start
    return spent, PLACES / spent, 0.0, reference


def tiles(_data: Path, folder: Path) -> tuple[float, float, float, float]:
    """Buildings over tiles: what the greatest process takes more with each tile, MB, between a quarter and all."""
    from osgeo import gdal

    gdal.UseExceptions()
    delft = DATA / "als" / "delft_west"
    block, trial = folder / "block.geojson", tiled_town.Trial(tile=40, buffer=10, workers=2)
    gdal.VectorTranslate(str(block), str(delft / "outlines.gpkg"), format="GeoJSON")
    greatest, spent = [], []
    for count in (TILES // 4, TILES):
        run, town = folder / f"run_{count}", folder / f"town_{count}"
        inputs = tiled_town.make_town(delft / "points_2_per_m2.laz", block, count, town, trial.tile)
        run.mkdir()
        used = cost(tiled_town.command(inputs, run, trial))
        greatest.append(used[1])
        spent.append(used[0])
    return spent[1], (greatest[1] - greatest[0]) / (TILES - TILES // 4), greatest[1], triangulation()


GOALS = (
    Goal("georeferencemms, 7.5 M points/km", georeference, "s / km", 15, 700),
    Goal("groundfrommms, 16 M points", ground, "s", 15, 800),
    Goal("wallsfrommms, 16 M points", walls, "s", 12, 800),
    Goal("buildings with slopes, Delft", buildings, "ms / building", 45),
    Goal("lane map", lane_map, "s / 10 km", 45),
    Goal("localisation accuracy, multi-layer", localisation, "places / s", 150),
    Goal("tiles", tiles, "MB more / tile", 0),
)


def goals_table(only: str = "") -> None:
    """Print the line of each work whose name holds `only`, and that of QGIS's start."""
    rows = []
    with city(DATA / "city") as data:
        for goal in GOALS:
            if only not in goal.name or (goal.run in (buildings, tiles) and not (DATA / "als" / "delft_west").is_dir()):
                continue
            with tempfile.TemporaryDirectory() as folder:
                rows.append(goal.row(data, Path(folder)))
    print_table("Work with a goal of speed: points beside decoding them, all else beside the triangulation", HEADER,
                rows)
    if not only:
        with tempfile.TemporaryDirectory() as folder:
            _, spent, memory, _, bare, ratio = start_row(Path(folder))
        print_table("Start of qgis_process", ("CPU s", "without plugin", "more", "MB", "ratio"),
                    [(spent, bare, spent - bare, memory, ratio)])
