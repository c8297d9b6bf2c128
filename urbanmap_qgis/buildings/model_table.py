"""What is known of every model, as columns for layers, CityJSON attributes and the report."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

import numpy as np
import shapely

from ..geometry.solid import volume
from ..io.pages.report import BAD, GOOD, LOOK, WORST, Report
from ..io.pages.svg import plan_map
from ..wording import mark, say
from .building_model import BuildingModel, roof_remarks
from .model_figures import OWN_FIGURES, figure_columns, model_figures
from .model_status import NOT_MODELLED, STATUSES, counts
from .model_surfaces import ground_area

COLUMNS = ("building_id", "status", "reason", "roofs", "base", "height", "area", "volume", "points", "density",
           "rmse_z", "rmse_z95", "median_dz", "rmse_3d", "p95", "coverage", "unseen", "beyond", "lod", "roof_type",
           "not_explained", "quality", *OWN_FIGURES)
"""Names of the columns, in order."""

SURFACE_COLUMNS = ("building_id", "roof_id", "surface_type", "seen", "sigma")
"""Names of the columns of the faces: of roofs the share that the points have seen, and the expected error of
the height, m."""


def model_columns(models: Sequence[BuildingModel]) -> dict[str, list]:
    """Columns of `COLUMNS`, one entry a model; NaN where a figure is not known.

    base: height of the ground face; height: highest roof above it; area and volume of the solids; the rest is
    `quality.ModelFit`, density (points a m2), unseen (share of the plan without points), beyond (share of the
    outline beyond the cloud's edge), `model_status.quality` and `model_figures.OWN_FIGURES`.
    """
    rows = [_row(model) for model in models]
    figures = figure_columns([model_figures(model.solids, model.lod.startswith("2")) for model in models], OWN_FIGURES)
    return {name: figures[name] if name in figures else [row[name] for row in rows] for name in COLUMNS}


def _row(model: BuildingModel) -> dict:
    nan = float("nan")
    fit = model.fit
    top = max((float(solid.vertices[:, 2].max()) for solid in model.solids), default=nan)
    return {
        "building_id": model.building_id, "status": model.status, "reason": model.reason, "roofs": model.roofs,
        "base": model.base, "height": top - model.base, "area": ground_area(model.solids) if model.solids else nan,
        "volume": sum(volume(solid) for solid in model.solids) if model.solids else nan,
        "points": fit.points if fit else 0, "density": model.density, "unseen": model.unseen,
        "beyond": model.beyond,
        "lod": model.lod if model.solids else "", "roof_type": model.roof_type,
        "quality": model.quality,
        **{name: getattr(fit, name) if fit else nan
           for name in ("rmse_z", "rmse_z95", "median_dz", "rmse_3d", "p95", "coverage", "not_explained")},
    }


def surface_columns(models: Sequence[BuildingModel]) -> dict[str, list]:
    """Columns of `SURFACE_COLUMNS`, one entry a face, solid after solid; None where a figure is not known."""
    rows = [(model.building_id, roof, kind, said.get("seen"), said.get("sigma")) for model in models
            for solid, remarks in zip(model.solids, roof_remarks(model))
            for roof, kind, said in zip(solid.roof_id, solid.surface_type, remarks)]
    return {name: [row[place] for row in rows] for place, name in enumerate(SURFACE_COLUMNS)}


def write_model_report(path: str | os.PathLike, columns: Mapping[str, Sequence],
                       plans: Sequence[shapely.Geometry | None] = (), note: str = "") -> None:
    """Write the HTML report of a run: verdict, the worst buildings with reasons, counts, quality.

    Parameters
    ----------
    columns : as `model_columns` gives them.
    note : of whoever ran it, such as the settings of a chain.
    plans : plan of each building, for the map.
    """
    status = np.array(columns["status"], dtype=object)
    report = Report("Building models")
    _verdict(report, status, any(columns["points"]))
    worst = _worst(columns)
    report.section(say("The worst {worst_count}", worst_count=len(worst)))
    names = ("building_id", "status", "quality", "roofs", "points", "rmse_z95", "p95")
    heads = (mark("building"), mark("status"), mark("quality"), mark("roofs"), mark("points"), "RMSE z 95 % (m)",
             "p95 (m)", mark("why"))
    report.table(heads, [[*(columns[name][row] for name in names), _why(columns, row)] for row in worst])
    report.section("Result")
    report.facts({
        "Buildings": len(status),
        "Roofs": int(sum(columns["roofs"])),
        "Mean RMSE of roof heights (m)": _mean(columns["rmse_z"]),
        "Mean RMSE of the best 95 % (m)": _mean(columns["rmse_z95"]),
        "Mean point to model distance, RMSE (m)": _mean(columns["rmse_3d"]),
        "Mean quality, 0 to 1": _mean(columns["quality"]),
    })
    report.table(("status", "buildings", "what it says"),
                 [(word, number, STATUSES[word]) for word, number in counts(columns["status"]).items() if number])
    report.section("Quality")
    report.paragraph("Distances to the models of all points that can be roof, whether or not a roof was made of them. "
                     "Level roofs (lod 1.3) in place of sloped ones show the slope as height differences.")
    report.histogram(np.array(columns["quality"], float), "quality, 0 to 1", say("Buildings by quality. Those far left "
                     "are to be looked at first."), upper=1.0)
    report.histogram(100 * np.array(columns["not_explained"], float), "% of the points",
                     "Buildings by points that the model does not explain")
    report.histogram(np.array(columns["rmse_z95"], float), "RMSE of height, best 95 % (m)", "Buildings by height error",
                     upper=2.0)
    report.histogram(np.array(columns["p95"], float), "95th percentile of distance (m)",
                     "Buildings by point to model distance", upper=4.0)
    report.histogram(np.array(columns["density"], float), "points a m²", "Buildings by point density")
    report.histogram(100 * np.array(columns["unseen"], float), "% of the plan", "Buildings by plan without points")
    if len(plans) and not shapely.is_missing(np.array(plans, dtype=object)).all():
        report.section("Map")
        labels = {int(row): str(columns["building_id"][row]) for row in worst}
        report.figure(plan_map(plans, np.array(columns["rmse_z95"], float), (0.15, 0.3, 0.6, 1.0), "m", labels),
                      say("RMSE of height, best 95 %, of each building; the worst are numbered. North is up. Red ones "
                          "side by side hint at a shift or another date; single ones at their roofs."))
    report.note(note)
    report.write(path)


def _verdict(report: Report, status: np.ndarray, seen: bool) -> None:
    """How many models can be used as they are; `seen`: whether points were there to compare them with."""
    good, missing = int((status == "ok").sum()), int((status == NOT_MODELLED).sum())
    if seen:
        text = say("{good} of {count} buildings have a model that explains their points.", good=good, count=len(status))
    else:
        text = say("{good} of {count} buildings have a valid model. How well it fits is not known: no points were "
                   "given.", good=good, count=len(status))
    others = len(status) - good - missing
    if others:
        text += " " + say("With a remark: {others}; look at the worst below first.", others=others)
    if missing:
        text += " " + say("Without a model: {missing}; they keep their rows, with the reason, in the result.",
                          missing=missing)
    report.verdict(BAD if not len(status) - missing else LOOK if others or missing or not seen else GOOD, text)


def _worst(columns: Mapping[str, Sequence]) -> np.ndarray:
    """Rows of the buildings to look at first: those without a model, then those of the lowest quality."""
    figure = np.array(columns["quality"], float)
    return np.lexsort((np.arange(len(figure)), np.where(np.isfinite(figure), figure, 2.0)))[:WORST]


def _why(columns: Mapping[str, Sequence], row: int) -> str:
    """In words, what the figures of a building say against its model."""
    causes = [columns["reason"][row]] if columns["reason"][row] else []
    unseen, density = columns["unseen"][row], columns["density"][row]
    coverage, rmse = columns["coverage"][row], columns["rmse_z95"][row]
    empty = say("{unseen:.0f} % of its plan has no roof points", unseen=100 * unseen)
    if unseen > 0.2 and not any(empty in cause for cause in causes):
        causes.append(empty)
    if density < 2.0:
        causes.append(say("only {density:.1f} points a m²", density=density))
    if coverage < 0.9:
        causes.append(say("{coverage:.0f} % of its points lie beside the model: check the outline",
                          coverage=100 * (1 - coverage)))
    if rmse > 1.0:
        causes.append(say("its roofs do not follow the points: a broken roof, or points of something else"))
    elif rmse > 0.3:
        causes.append(say("sloped or uneven roofs are modelled level"))
    return "; ".join(causes)


def _mean(values: Sequence[float]) -> float:
    finite = np.array(values, float)
    finite = finite[np.isfinite(finite)]
    return float(finite.mean()) if len(finite) else float("nan")
