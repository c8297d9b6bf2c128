"""Table of sloped roof models (LoD2.2) of Delft beside the published figures of roofer 1.1: part of `make bench`."""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from scripts.bench_table import print_table
from scripts.layers import read_layer
from scripts.scoring import points_inside, summary
from urbanmap_qgis.buildings.building_model import BuildingModel
from urbanmap_qgis.buildings.model_surfaces import roof_cells
from urbanmap_qgis.buildings.quality import height_differences
from urbanmap_qgis.citymodel.cityjson.writer import write_model_cityjson
from urbanmap_qgis.citymodel.model import CityModel, CityReference
from urbanmap_qgis.citymodel.solids import solid_object

WITHIN = (0.1, 0.2, 0.5, 1.0)
"""Heights (m) within which the shares of the points are given."""

ROOFER = (("roofer 1.1 LoD2.2", "outlines", "92/92", 349, 0.80, 0.87, 0.91, 0.93, 0.239, 0.166, 0.981, "92/92",
           "37-44"),
          ("roofer, 2 points a m2", "outlines", "82/92", "", "", "", "", "", 1.64, "", "", "", ""),
          ("roofer, 1 point a m2", "outlines", "38/92", "", "", "", "", "", 2.24, "", "", "", ""),
          ("roofer", "outlines_shifted_1m", "", "", "", "", "", "", "", "", 0.66, "", ""),
          ("roofer", "outlines_shifted_2m", "", "", "", "", "", "", "", "", 0.44, "", ""))
"""Its figures on the same data, by the same scores."""

HEADER = ("points", "outlines", "modelled", "roof faces", *(f"within {step} m" for step in WITHIN), "RMSE z 95 % (m)",
          "RMSE 3D (m)", "plan IoU", "valid by val3dity", "CPU ms/building")


def sloped_row(run, scores: list, truth: np.ndarray, points: np.ndarray, judge: Path) -> tuple:
    """Figures of one run, as `HEADER` has them from "modelled" on."""
    means = summary(scores)
    return (f"{means['modelled']}/{means['buildings']}", means["roofs"],
            *shares(run.models, points_inside(points, truth)), means["rmse_z95"], means["rmse_3d"], means["plan_iou"],
            valid(run.models, judge), 1000 * sum(run.seconds.values()) / len(truth))


def shares(models: Sequence[BuildingModel], points: list[np.ndarray]) -> list[float]:
    """Mean over the buildings of the shares of their points (n, 3) within the heights `WITHIN` of the roof there."""
    rows = []
    for model, own in zip(models, points):
        if len(own):
            off = np.abs(height_differences(*own.T, roof_cells(model.solids)))
            rows.append([float(np.mean(off < step)) for step in WITHIN])
    return np.mean(rows, axis=0).tolist()


def valid(models: Sequence[BuildingModel], judge: Path) -> str:
    """Valid and all models by val3dity; "not run" where it is not there or does not start."""
    made = [model for model in models if model.solids]
    with tempfile.TemporaryDirectory() as folder:
        model, report = Path(folder, "models.city.json"), Path(folder, "report.json")
        buildings = [solid_object(str(one.building_id), {}, one.solids, lod=one.lod) for one in made]
        write_model_cityjson(model, CityModel(CityReference(), buildings))
        try:
            subprocess.run([judge, model, "--report", report], capture_output=True, check=False)
            features = json.loads(report.read_text(encoding="utf-8"))["features"]
        except OSError:
            return "not run"
    return f"{sum(feature['validity'] for feature in features)}/{len(made)}"


def sloped_table(delft, chain: Callable, score: Callable, folder: Path) -> None:
    """Sloped models of Delft with damaged inputs, one set of defaults, and roofer's figures."""
    judge = folder.parents[2] / "tools" / "val3dity"
    rows: list[tuple] = []
    for cloud_name, outline_name in (
            ("points", "outlines"), ("points_unclassified", "outlines"), ("points_2_per_m2", "outlines"),
            ("points_1_per_m2", "outlines"), ("points", "outlines_shifted_1m"), ("points", "outlines_shifted_2m")):
        outlines, _ = read_layer(folder / f"{outline_name}.gpkg", "lokaalid")
        run = chain(folder / f"{cloud_name}.laz", outlines, sloped=True)
        rows.append((cloud_name, outline_name,
                     *sloped_row(run, score(run, delft.truth, delft.points), delft.truth, delft.points, judge)))
    print_table("Delft (AHN3), sloped roofs", HEADER, [*rows, *ROOFER])
