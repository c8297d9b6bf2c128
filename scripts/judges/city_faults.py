"""What the mobile side makes of each fault of the sample city: a part of `make bench`.

For each fault a city is made (the same seed, one fault), its ground and markings are found, and the first survey is
registered to the true aerial markings. Errors are those of the patches against the true trajectory.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from scripts.bench_table import print_table
from scripts.judges.faults import WRONG, DrivenSurvey, Outcome, constant_fault, percent, run
from scripts.layers import read_layer
from urbanmap_qgis.errors import UrbanMapError
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.io.raster import read_raster, write_raster
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.ground import classify_ground_files
from urbanmap_qgis.mobile.markings.extraction import Extraction
from urbanmap_qgis.mobile.markings.marking_stage import extract_markings
from urbanmap_qgis.mobile.registration.correction.patch_status import DISTRUSTED, REGISTERED
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity import write
from urbanmap_qgis.samplecity.faults import FAULTS, GROUND_LENGTH, GROUND_MEAN, GROUND_WAVE
from urbanmap_qgis.samplecity.scene.paint import value_noise
from urbanmap_qgis.samplecity.truth.stage import write_truth

PAINT, ASPHALT = 2, 1
HEADER = ("fault", "ground share", "marking points", "on paint", "on paint or asphalt", "mean (m)", "max (m)",
          "height, mean (m)", "registered", "distrusted", "registered and wrong", "plan within 2 sigma",
          "height within 2 sigma")


def fault_row(name: str, folder: Path, size: float, seed: int) -> tuple:
    """Figures of a city with one fault ("none": without any)."""
    world = (size, "canyon", seed, () if name == "none" else (name,))
    write_truth(write._scene(*world), folder)
    write._run("mms", folder, world, SILENT)
    points = folder / "mms/survey_01.laz"
    try:
        ground = classify_ground_files([points], folder / "ground.laz")
        share = percent(np.arange(ground.usable) < ground.ground)
    except UrbanMapError as error:
        share = f"refused: {str(error)[:60]}"
    try:
        survey, found = read(folder)
    except UrbanMapError as error:
        return (name, share, f"refused: {str(error)[:60]}", *[""] * (len(HEADER) - 3))
    material = np.load(folder / "truth/survey_01_labels.npz")["material"][found.number]
    made = run(survey, constant_fault("as reported", (0,) * 6), reference(folder, name),
               RegistrationSettings(three_d=True))
    return (name, share, len(found.points), percent(material == PAINT), percent(np.isin(material, (PAINT, ASPHALT))),
            *registration_figures(made))


def read(folder: Path) -> tuple[DrivenSurvey, Extraction]:
    """The first survey with its marking points."""
    cloud = open_cloud([folder / "mms/survey_01.laz"])
    reported, true = (read_trajectory(folder / where / "survey_01_trajectory.csv").trajectory
                      for where in ("mms", "truth"))
    found = extract_markings(cloud, reported, read_calibration(folder / "mms/calibration.json"))
    return DrivenSurvey("survey_01", found.points, reported, true), found


def reference(folder: Path, name: str) -> Reference:
    """The true aerial markings, on the ground as the airborne points show it."""
    polygons, _ = read_layer(folder / "truth/markings.gpkg", layer="aerial")
    ground = folder / "truth/ground.tif"
    if name == "ground":
        heights, grid, crs = read_raster(ground)
        x, y = np.meshgrid(*grid.centres())
        wave = 2.0 * value_noise(x, y, GROUND_LENGTH) - 1.0
        ground = folder / "ground.tif"
        write_raster(ground, (heights + GROUND_MEAN + GROUND_WAVE * wave).astype(np.float32), grid, crs)
    return Reference.from_polygons(polygons, ground)


def registration_figures(made: Outcome | str) -> tuple:
    """Of the patches, against the truth."""
    if isinstance(made, str):
        return (f"refused: {made[:60]}", *[""] * 7)
    kept = made.status != DISTRUSTED
    ratio = np.abs(made.error) / made.sigma
    return (float(made.plan.mean()), float(made.plan.max()), float(np.abs(made.error[:, 2]).mean()),
            percent(made.status == REGISTERED), percent(~kept),
            int(((made.status == REGISTERED) & (made.plan > WRONG)).sum()), percent(ratio[kept, :2] < 2),
            percent(ratio[kept, 2] < 2))


def judge(size: float = 120.0, seed: int = 31, faults: tuple[str, ...] = ("none", *FAULTS)) -> None:
    """Print the table of the faults."""
    rows = []
    for name in faults:
        with tempfile.TemporaryDirectory() as folder:
            rows.append(fault_row(name, Path(folder), size, seed))
    print_table(f"Faults, sample city of {size:g} m, seed {seed}", HEADER, rows)
