"""A small real run of every algorithm on a sample city, each with all of its outputs.

    python every_algorithm.py CITY FOLDER WORKERS [NAME ...]    all or some, into FOLDER, in a process of its own

What they said is in messages.json there, in the language of LANG.

A value "city:PLACE" is a file of the city, "made:PLACE" one that is prepared beside the results, "ID:OUTPUT" a result
of an algorithm that is run before.
"""

from __future__ import annotations

import importlib.util
import json
import sys
import time
from pathlib import Path

CAMERA = {"CAMERA": "city:aerial/camera.json", "EXTERIOR": "city:aerial/exterior.csv"}
FRAMES = {"FRAMES": [f"city:aerial/frame_0{number}.tif" for number in (1, 2, 3)], **CAMERA}
OUTLINES = {"FOOTPRINTS": "city:footprints/gsi_buildings.gpkg"}
HEIGHTS = {"GROUND": "surfacefromals:OUTPUT_GROUND", "DSM": "surfacefromals:OUTPUT"}
DRIVE = {"POINTS": ["city:mms/survey_01.laz"], "TRAJECTORY": "city:mms/survey_01_trajectory.csv"}
BOTH = {"TRAJECTORY": ["city:mms/survey_01_trajectory.csv", "city:mms/survey_02_trajectory.csv"]}
TRUTH = {"TRAJECTORY": ["city:truth/survey_01_trajectory.csv", "city:truth/survey_02_trajectory.csv"]}
CALIBRATION = {"CALIBRATION": "city:mms/calibration.json"}
MAP = {"MARKINGS": "city:truth/markings.gpkg|layername=mms", "GROUND": "city:truth/ground.tif"}
STRIP = {"IMAGES": ["city:lines/camera_1.png"], "TRAJECTORY": "city:truth/lines_trajectory.csv",
         "CALIBRATION": "city:lines/calibration.json"}
SKY = {"BUILDINGS": "city:models/buildings.geojson", "NAVIGATION": ["city:gnss/satellites.nav"],
       "TRAJECTORY": [f"city:gnss/pass_0{number}_trajectory.csv" for number in (1, 2, 3)]}
SIGNALS = {**SKY, "OBSERVATIONS": [f"city:gnss/pass_0{number}.obs" for number in (1, 2, 3)], "GEOID_SEPARATION": 36.6}

RECIPES: dict[str, dict] = {
    "samplecity": {"SIZE": 60, "SCENE": "canyon"},
    "surfacefromals": {"POINTS": ["city:als/als.laz"], "RESOLUTION": 1.0},
    "occlusionmap": {"FRAME": "city:aerial/frame_01.tif", **CAMERA, **HEIGHTS},
    "adjustals": {"POINTS": ["city:als/als_classified.laz"], "CONTROL": "made:cloud_points.csv"},
    "adjustframes": {**CAMERA, "CONTROL": "made:image_points.csv", "CRS": "EPSG:6677"},
    "orthorectifyframes": {**FRAMES, **HEIGHTS, **OUTLINES, "RESOLUTION": 0.25},
    "filtervehicles": {"ORTHOPHOTOS": ["orthorectifyframes:OUTPUT", "city:aerial/ortho.tif"]},
    "roadmarkingsfromorthophoto": {"INPUT": "orthorectifyframes:OUTPUT", "BUILDINGS": OUTLINES["FOOTPRINTS"]},
    "aerialmarkings": {**FRAMES, "ALS": ["city:als/als.laz"], **OUTLINES, "RESOLUTION": 0.25},
    "loadgsibuildings": {"INPUT": "city:footprints/FG-GML-533946-BldA-20240401-0001.xml", "CRS": "EPSG:6677"},
    "segmentbuildings": {"POINTS": ["city:als/als.laz"], **OUTLINES},
    "segmentroofs": {"POINTS": ["segmentbuildings:OUTPUT"], "FOOTPRINTS": "segmentbuildings:OUTPUT_BUILDINGS"},
    "roofpolygons": {"POINTS": ["segmentroofs:OUTPUT"], "FOOTPRINTS": "segmentbuildings:OUTPUT_BUILDINGS"},
    "buildingmodels": {"ROOFS": "roofpolygons:OUTPUT", "FOOTPRINTS": "segmentbuildings:OUTPUT_BUILDINGS",
                       "GROUND": HEIGHTS["GROUND"], "POINTS": ["segmentroofs:OUTPUT"]},
    "buildingsfromals": {"POINTS": ["city:als/als.laz"], **OUTLINES},
    "buildingoutlines": {"POINTS": ["city:als/als.laz"]},
    "updatebuildings": {"BUILDINGS": "buildingmodels:OUTPUT", "POINTS": ["city:als/als.laz"]},
    "mesh25d": {"POINTS": ["city:als/als.laz"], **OUTLINES, "GROUND": HEIGHTS["GROUND"]},
    "wallsfrommms": {"POINTS": DRIVE["POINTS"], "BUILDINGS": OUTLINES["FOOTPRINTS"],
                     "TRAJECTORY": [DRIVE["TRAJECTORY"]]},
    "mergebuildingmodels": {"MODELS": "buildingmodels:OUTPUT", "WALLS": "wallsfrommms:OUTPUT"},
    "loadcitymodel": {"INPUT": "city:models/buildings.city.json"},
    "exportcitymodel": {"BUILDINGS": "buildingmodels:OUTPUT", "SURFACES": "buildingmodels:OUTPUT_SURFACES"},
    "checkcitymodel": {"INPUT_FOLDER": "exportcitymodel:OUTPUT_CITYGML", "INPUT": None},
    "tiledrun": {"ALGORITHM": "buildingsfromals", "POINTS": ["city:als/als.laz"], **OUTLINES, "TILE": 100},
    "runjob": {"JOB": "made:surface.urbanmap.json"},
    "loadgsi": {"INPUT": "made:FG-GML-5339-46-11-DEM5A-20161001.xml", "INPUT_FOLDER": "city:footprints",
                "CRS": "EPSG:6677"},
    "loadgsidem": {"INPUT": "made:FG-GML-5339-46-11-DEM5A-20161001.xml", "CRS": "EPSG:6677"},
    "markinglines": {"MARKINGS": MAP["MARKINGS"], "GROUND": HEIGHTS["GROUND"]},
    "roadedges": {**DRIVE, "WALLS": "wallsfrommms:OUTPUT"},
    "streetobjects": DRIVE,
    "vectormap": {"LINES": "markinglines:OUTPUT", "TRAJECTORY": [DRIVE["TRAJECTORY"]],
                  "OBJECTS": "streetobjects:OUTPUT"},
    "roadmodel": {"ROADS": "vectormap:OUTPUT_LANES", "DATA_DATE": "2026-04-01"},
    "roadspace": {"POINTS": ["made:street.las"], "TRAJECTORY": "made:street.csv", "MARKINGS": "made:street.gpkg",
                  "DATA_DATE": "2026-04-01"},
    "lanemap": {"MARKINGS": MAP["MARKINGS"], "GROUND": HEIGHTS["GROUND"], **TRUTH},
    "checkmodel": {"INPUT": "vectormap:OUTPUT_LANELET2", "OUTPUT_TABLE": None, "OUTPUT_COUNTS": None},
    "checkvectormap": {"INPUT": "vectormap:OUTPUT_LANELET2"},
    "comparemaps": {"OLD": "lanemap:OUTPUT_LANELET2", "NEW": None, "NEW_LINES": "vectormap:OUTPUT_BOUNDS"},
    "localisationaccuracy": {"BUILDINGS": SKY["BUILDINGS"], "MARKINGS": MAP["MARKINGS"],
                             "NAVIGATION": SKY["NAVIGATION"], "TRAJECTORY": [TRUTH["TRAJECTORY"][0]], "SPACING": 10},
    "convertheights": {"POINTS": ["city:als/als.laz"], "SOURCE_HEIGHTS": "JGD2011", "TARGET_HEIGHTS": "JGD2024",
                       "CHANGE": 0.05, "OUTPUT_RASTER": None, "OUTPUT_LAYER": None},
    "groundfrommms": {"POINTS": DRIVE["POINTS"]},
    "roadmarkingsfrommms": {**DRIVE, **CALIBRATION},
    "registermms": {**DRIVE, "POINTS": ["roadmarkingsfrommms:OUTPUT"], **MAP},
    "georeferencemms": {**DRIVE, **CALIBRATION, **MAP, "IMAGES": "city:mms/survey_01_images.csv"},
    "applytrajectory": {**DRIVE, "CORRECTED": TRUTH["TRAJECTORY"][0], "IMAGES": "city:mms/survey_01_images.csv"},
    "landmarkupdate": {"TRAJECTORY": DRIVE["TRAJECTORY"], "CONTROL": "city:truth/control_survey_01.csv",
                       "CRS": "EPSG:6677"},
    "checkaccuracy": {"TRAJECTORY": DRIVE["TRAJECTORY"], "CORRECTED": "registermms:OUTPUT", "CRS": "EPSG:6677",
                      "CONTROL": "city:truth/control_survey_01.csv"},
    "acceptance": {"INPUT": "city:truth/control_survey_01.csv", "TRAJECTORY": DRIVE["TRAJECTORY"], "CRS": "EPSG:6677",
                   "CORRECTED": "registermms:OUTPUT", "BUILDINGS": "buildingmodels:OUTPUT",
                   "PATCHES": "registermms:OUTPUT_PATCHES", "JOB": "1"},
    "adjustsurveys": {"POINTS": ["roadmarkingsfrommms:OUTPUT", "city:mms/survey_02.laz"], **BOTH},
    "applytrajectory 2": {"POINTS": ["city:mms/survey_02.laz"], "TRAJECTORY": "city:mms/survey_02_trajectory.csv",
                          "CORRECTED": TRUTH["TRAJECTORY"][1], "IMAGES": "city:mms/survey_02_images.csv"},
    "calibratescanner": {"POINTS": ["applytrajectory:OUTPUT", "applytrajectory 2:OUTPUT"], **CALIBRATION, **TRUTH},
    "georeferencescans": {"SCANS": ["city:lines/scans.csv.gz"], "TRAJECTORY": STRIP["TRAJECTORY"],
                          "CALIBRATION": STRIP["CALIBRATION"], "CRS": "EPSG:6677"},
    "rectifytrajectory": {"TRAJECTORY": "city:lines/trajectory.csv", "TIE_POINTS": "city:lines/tie_points.csv",
                          "GROUND": MAP["GROUND"]},
    "tiepointproposals": {**DRIVE, "BUILDINGS": OUTLINES["FOOTPRINTS"]},
    "facadetextures": {**STRIP, "BUILDINGS": "buildingmodels:OUTPUT", "RESOLUTION": 0.2},
    "objectsfromimages": {**STRIP, "POINTS": ["georeferencescans:OUTPUT"], "OUTLINES": "made:drawn.gpkg"},
    "overlayonimages": {**STRIP, "POINTS": DRIVE["POINTS"], "LINES": "buildingmodels:OUTPUT",
                        "TRAJECTORY_BEFORE": "city:lines/trajectory.csv"},
    "satellitevisibility": {**SKY, "OUTPUT_RASTER": None},
    "satellitevisibility 2": {**SKY, "TRAJECTORY": None, "TIME": "2024-04-18 02:00:00", "RESOLUTION": 8.0},
    "gnssreflections": {**SIGNALS, "EVERY": 5},
    "adjustwalls": {**SIGNALS},
}
"""Parameters of each algorithm (a second run of one has a number behind its id); all its outputs are asked for."""

ENDINGS = {"rasterDestination": ".tif", "sink": ".gpkg", "folderDestination": ""}

def prepare(city: Path, folder: Path) -> None:
    """What the city has not: an elevation model, and what a user draws, markings on the strip image."""
    import numpy as np
    import shapely
    from qgis.core import QgsVectorLayer

    from urbanmap_qgis.mobile.calibration import read_calibration
    from urbanmap_qgis.mobile.lines.line_camera import project_to_strip
    from urbanmap_qgis.mobile.lines.strip_images import read_strips
    from urbanmap_qgis.mobile.trajectory_files import read_trajectory
    from urbanmap_qgis.samplecity.truth.geopackage import Layer, write_geopackage

    trajectory = read_trajectory(city / "truth/lines_trajectory.csv").trajectory
    strip, = read_strips([city / "lines/camera_1.png"], read_calibration(city / "lines/calibration.json"))
    drawn = []
    for feature in QgsVectorLayer(f"{city / 'truth/markings.gpkg'}|layername=mms", "markings", "ogr").getFeatures():
        part = shapely.get_parts(shapely.from_wkb(bytes(feature.geometry().asWkb())))[0]
        corners = shapely.get_coordinates(part.exterior, include_z=True)[:-1]
        if part.has_z and len(corners) <= 40 and part.area >= 0.2:
            found = project_to_strip(corners, strip, trajectory, 20.0)
            if np.array_equal(found.point_index, np.arange(len(corners))) and np.ptp(found.column) < 150:
                drawn.append(shapely.Polygon(np.column_stack([found.column + 0.5, -found.row - 0.5])))
    spec = importlib.util.spec_from_file_location(
        "gsi_dem_writer", Path(__file__).resolve().parents[1] / "core" / "gsi_dem_writer.py")
    writer = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(writer)
    text = writer.dem_xml("53394611", ["地表面,12.50"] * (150 * 225), 150, 225)
    (folder / "FG-GML-5339-46-11-DEM5A-20161001.xml").write_text(text, encoding="utf-8")
    write_geopackage(folder / "drawn.gpkg", [Layer("drawn", drawn, {"class": ["paint"] * len(drawn)})])
    write_surface_job(city, folder)
    write_image_points(city, folder / "image_points.csv")
    write_cloud_points(city, folder / "cloud_points.csv")
    write_street(folder)


def write_street(folder: Path) -> None:
    """A drive along a street with kerbs on both sides, which the city's drives do not show, and its edge lines."""
    import laspy
    import numpy as np
    import shapely
    from pyproj import CRS

    from tests.core.road_scene import Street, to_map, write_drive
    from urbanmap_qgis.samplecity.truth.geopackage import Layer, write_geopackage

    trajectory = write_drive(folder / "street.las", Street(length=60.0, rough=0.06))
    cloud = laspy.read(folder / "street.las")
    cloud.header.add_crs(CRS.from_epsg(6677))
    cloud.write(folder / "street.las")
    rows = np.column_stack([trajectory.time, trajectory.place, trajectory.angles])
    np.savetxt(folder / "street.csv", rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
    rings = [shapely.get_coordinates(shapely.box(2.0, across - 0.075, 58.0, across + 0.075))
             for across in (-1.75, 1.75)]
    paint = [shapely.Polygon(to_map(np.column_stack([ring, np.zeros(len(ring))]), 0.0)[:, :2]) for ring in rings]
    write_geopackage(folder / "street.gpkg", [Layer("paint", paint, {"colour": ["white", "white"]})])


def write_cloud_points(city: Path, path: Path) -> None:
    """Places of the ground every 30 m, half a metre aside in the cloud."""
    import numpy as np

    from urbanmap_qgis.io.raster import RasterSampler

    with RasterSampler(city / "truth/ground.tif") as ground:
        x_min, y_min, x_max, y_max = ground.grid.bounds
        x, y = (axis.ravel() for axis in np.meshgrid(np.arange(x_min + 10, x_max, 30.0),
                                                     np.arange(y_min + 10, y_max, 30.0)))
        z = ground.sample(x, y)
    rows = [f"P{n},{x[n]:.3f},{y[n]:.3f},{z[n]:.3f},{x[n] + 0.5:.3f},{y[n]:.3f}"
            for n in np.flatnonzero(np.isfinite(z))]
    path.write_text("\n".join(["id,x,y,z,x_als,y_als", *rows]) + "\n", encoding="utf-8")


def write_image_points(city: Path, path: Path, step: float = 30.0) -> None:
    """Places of the ground every so many metres as the city's frames see them, the last column as tie points."""
    import numpy as np

    from urbanmap_qgis.aerial.frames.camera import project_places, read_camera
    from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
    from urbanmap_qgis.io.raster import RasterSampler

    camera = read_camera(city / "aerial/camera.json")
    rows = ["point,image,column,row,x,y,z"]
    with RasterSampler(city / "truth/ground.tif") as ground:
        x_min, y_min, x_max, y_max = ground.grid.bounds
        x, y = (axis.ravel() for axis in np.meshgrid(np.arange(x_min + 10, x_max, step),
                                                     np.arange(y_min + 10, y_max, step)))
        z = ground.sample(x, y)
    for pose in read_exterior(city / "aerial/exterior.csv"):
        column, row, _ = project_places(camera, pose, x, y, z)
        inside = (column > 0) & (column < camera.width - 1) & (row > 0) & (row < camera.height - 1) & np.isfinite(z)
        rows += [f"{n},{pose.image},{column[n]:.2f},{row[n]:.2f},{x[n]:.3f},{y[n]:.3f},{z[n]:.3f}"
                 for n in np.flatnonzero(inside)]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")


def write_surface_job(city: Path, folder: Path) -> None:
    """A job of one short step."""
    from urbanmap_qgis.job.chain_plan import PlannedStep
    from urbanmap_qgis.job.job_file import planned_job, write_job

    step = PlannedStep("surface", "surfacefromals", {"POINTS": {"input": "als"}, "RESOLUTION": 2.0})
    write_job(folder / "surface.urbanmap.json", planned_job("reference", {"als": (str(city / "als/als.laz"),)}, [step]))


def algorithms() -> dict:
    """The algorithms of the provider, without its models, by their ids."""
    from qgis.core import QgsApplication

    return {item.name(): item for item in QgsApplication.processingRegistry().providerById("urbanmap").algorithms()
            if hasattr(item, "compute")}


def given(name: str, city: Path, made: Path, results: dict) -> dict:
    """Inputs of an algorithm; `results` by "ID:OUTPUT"."""

    def resolved(value):
        if isinstance(value, list):
            return [resolved(item) for item in value]
        if not isinstance(value, str):
            return value
        kind, _, place = value.partition(":")
        if kind in ("city", "made"):
            return str((city if kind == "city" else made) / place)
        return results[value] if place and kind in RECIPES else value

    return {key: resolved(value) for key, value in RECIPES[name].items()}


def places(name: str, algorithm, folder: Path) -> dict:
    """A file or folder in `folder` for every output."""
    wanted = {}
    for item in algorithm.destinationParameterDefinitions():
        ending = ENDINGS.get(item.type(), f".{item.defaultFileExtension()}")
        wanted[item.name()] = str(folder / f"{name}-{item.name()}{ending}")
    return wanted


def run_all(city: Path, folder: Path, workers: int, make_feedback, names=tuple(RECIPES)) -> dict[str, float]:
    """Run recipes into a folder; seconds of each."""
    import processing

    prepare(city, folder)
    results, seconds, said = {}, {}, {}
    known = algorithms()
    for name in names:
        started, algorithm = time.perf_counter(), known[name.split()[0]]
        parameters = {**places(name, algorithm, folder), **given(name, city, folder, results)}
        if algorithm.parameterDefinition("WORKERS"):
            parameters["WORKERS"] = 1 if name == "tiledrun" else workers  # its workers are processes of their own
        feedback = make_feedback()
        made = processing.run(algorithm.create(), parameters, feedback=feedback)
        said[name] = [*feedback.infos, *feedback.warnings, *feedback.errors]
        results |= {f"{name}:{key}": value for key, value in made.items()}
        seconds[name] = time.perf_counter() - started
    files = {name: value for name, value in results.items() if isinstance(value, str)}
    (folder / "results.json").write_text(json.dumps(files), encoding="utf-8")
    (folder / "messages.json").write_text(json.dumps(said), encoding="utf-8")
    return seconds


def main() -> None:
    """Start QGIS with the provider and run all."""
    spec = importlib.util.spec_from_file_location("conftest", Path(__file__).with_name("conftest.py"))
    conftest = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(conftest)
    sys.path.insert(0, str(conftest.ROOT))
    city, folder, workers = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])
    application, plugin = conftest.start_qgis(folder.with_name(f"{folder.name}-profile"))
    module = importlib.import_module(f"{conftest.PLUGIN}.algorithms.framework.running.workers")
    module._processes = module._in_window  # a spawned process does not find the plugin under its name here
    names = tuple(sys.argv[4:]) or tuple(RECIPES)
    for name, seconds in run_all(city, folder, workers, conftest.make_feedback, names).items():
        print(f"{seconds:7.2f} s  {name}", flush=True)
    plugin.unload()
    del application


if __name__ == "__main__":
    main()
