"""The report on a map of localisation accuracy: road by class, the worst stretches, predicted against observed."""

from __future__ import annotations

import os
from collections import Counter

import numpy as np

from ...io.pages.report import BAD, GOOD, LOOK, WORST, Report
from ...wording import say
from ..accuracy_records import SOURCES, AccuracyMap, LocalisationMap
from ..places.place_status import NONE
from ..simulation.prediction_check import PredictionCheck
from .accuracy_tables import CLASS_NUMBERS
from .localisation_pictures import accuracy_plan, agreement_plot

STRETCH = 50.0
"""Length of road, m, that is ranked as one."""

_DRAWN = 3000


def write_localisation_report(path: str | os.PathLike, city: LocalisationMap, accuracy: AccuracyMap,
                              check: PredictionCheck | None) -> None:
    """Report of a map of accuracy."""
    report = Report("Map of localisation accuracy")
    _verdict(report, accuracy)
    _worst(report, city, accuracy)
    _summary(report, accuracy)
    _statuses(report, accuracy)
    _plan(report, city, accuracy)
    if check is not None:
        _check(report, accuracy, check)
    report.write(path)


def stretches(accuracy: AccuracyMap) -> list[np.ndarray]:
    """Rows of the places of each stretch of road of about 50 m; of an area without roads, of each square so large."""
    piece = np.floor(accuracy.places.way / STRETCH).astype(np.int64)
    key = np.column_stack([accuracy.places.street, piece])
    if accuracy.places.of_an_area:
        key = np.floor(accuracy.places.place[:, :2] / STRETCH).astype(np.int64)
    number = np.unique(key, axis=0, return_inverse=True)[1].ravel()
    order = np.argsort(number, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(number[order])) + 1)


def _verdict(report: Report, accuracy: AccuracyMap) -> None:
    known = np.isfinite(accuracy.ellipse.major)
    if not known.any():
        report.verdict(BAD, "Nothing can be said of any place; the table below tells why.")
    else:
        report.verdict(GOOD if known.all() else LOOK,
                       say("On {mean:.0%} of the places the map tells where a vehicle is, with a median sigma of "
                           "{median:.2f} m in the weakest direction; the worst stretches are below.", mean=known.mean(),
                           median=_median(accuracy.ellipse.major)))


def _summary(report: Report, accuracy: AccuracyMap) -> None:
    in_all = accuracy.places.of_an_area
    # Places of an area lie on a square grid: each stands for a square, not for a length of road.
    measure = accuracy.places.step ** 2 if in_all else accuracy.places.step
    total = measure.sum()
    report.section("Result")
    report.facts({"Places": len(accuracy.places), "Area, m²" if in_all else "Length of road, m": float(total),
                  "Median sigma of the weakest direction, m": _median(accuracy.ellipse.major),
                  "Places with a direction not determined": int((accuracy.undetermined > 0).sum()),
                  "Median share of scans that end elsewhere, all directions determined": _median(accuracy.elsewhere),
                  "Places that look like others": sum("repeats" in str(words) for words in accuracy.status)})
    report.table(["class", "area, m²" if in_all else "length, m", "share"], [
        [name, float(measure[accuracy.kind == name].sum()), f"{measure[accuracy.kind == name].sum() / total:.0%}"]
        for name in CLASS_NUMBERS])
    report.table(["source", "places", "along, m", "across, m", "heading, degrees"], [
        [name, int(np.isfinite(accuracy.sigma[name][:, 0]).sum()), *map(_median, accuracy.sigma[name].T)]
        for name in SOURCES])
    report.paragraph("Medians over the places of which the source tells something. A direction without evidence keeps "
                     "the sigma from before matching.")
    report.histogram(accuracy.ellipse.major, "sigma of the weakest direction, m",
                     "Places by the semi-major axis of their error ellipse.",
                     upper=min(2.0, np.nanmax(accuracy.ellipse.major, initial=0.01)))


def _plan(report: Report, city: LocalisationMap, accuracy: AccuracyMap) -> None:
    rows = np.unique(np.linspace(0, len(accuracy.places) - 1, min(len(accuracy.places), _DRAWN)).astype(int))
    report.section("Plan")
    report.figure(accuracy_plan(city, accuracy, rows, 10.0),
                  "Error ellipses, ten times enlarged, by class: green good, yellow usable, red poor, "
                  "grey nothing can be said.")


def _statuses(report: Report, accuracy: AccuracyMap) -> None:
    report.section("Status")
    report.table(["status", "places"], Counter(map(str, accuracy.status)).most_common(30))


def _worst(report: Report, city: LocalisationMap, accuracy: AccuracyMap) -> None:
    report.section("Worst squares of 50 m" if accuracy.places.of_an_area else "Worst stretches")
    parts = [rows for rows in stretches(accuracy) if np.isfinite(accuracy.ellipse.major[rows]).any()]
    score = np.array([np.sqrt(np.nanmean(accuracy.ellipse.major[rows] ** 2)) for rows in parts])
    worst = np.argsort(-score, kind="stable")[:WORST]
    where = ((say("east, m"), say("north, m"), say("places")) if accuracy.places.of_an_area else
             (say("street"), say("from, m"), say("to, m")))
    report.table([*where, "sigma of the weakest direction, m", "bearing, degrees",
                  "Places with a direction not determined", "Scans that end elsewhere", "status"], [
        [*_where(accuracy, rows), float(score[number]), _median(accuracy.ellipse.bearing[rows]),
         int((accuracy.undetermined[rows] > 0).sum()), _median(accuracy.elsewhere[rows]),
         _usual_status(accuracy, rows)]
        for number, rows in ((number, parts[number]) for number in worst)])
    for place, number in enumerate(worst, 1):
        rows = parts[number]
        report.figure(accuracy_plan(city, accuracy, rows, 5.0, 420, 40.0), _caption(accuracy, place, rows))
    without = [rows for rows in stretches(accuracy) if (accuracy.kind[rows] == NONE).all()]
    if without:
        report.paragraph(say("Of {without_count} stretches nothing can be said: see the statuses above and the layer.",
                             without_count=len(without)))


def _usual_status(accuracy: AccuracyMap, rows: np.ndarray) -> str:
    """The commonest status of the places of a stretch that have a sigma: it is theirs that is ranked."""
    known = rows[np.isfinite(accuracy.ellipse.major[rows])]
    return Counter(map(str, accuracy.status[known])).most_common(1)[0][0]


def _where(accuracy: AccuracyMap, rows: np.ndarray) -> list[float]:
    """Street with begin and end of a stretch, or the middle of a square with its number of places."""
    places = accuracy.places
    if places.of_an_area:
        east, north = places.place[rows, :2].mean(axis=0)
        return [float(east), float(north), len(rows)]
    return [int(places.street[rows[0]]), float(places.way[rows].min()), float(places.way[rows].max())]


def _caption(accuracy: AccuracyMap, place: int, rows: np.ndarray) -> str:
    """What a picture of a stretch or square shows."""
    first, second, _ = _where(accuracy, rows)
    if accuracy.places.of_an_area:
        return say("{place}: about east {east:.0f} m, north {north:.0f} m. Ellipses five times enlarged.", place=place,
                   east=first, north=second)
    return say("{place}: street {street}, from {min:.0f} m. Ellipses five times enlarged.", place=place, street=first,
               min=second)


def _check(report: Report, accuracy: AccuracyMap, check: PredictionCheck) -> None:
    report.section("Predicted against observed")
    report.paragraph("Scans were simulated at some of the places, with noise, vehicles and trees in the way, and "
                     "registered to the map as vehicles match them: by the plugin's own NDT, or by ICP.")
    report.facts({"Places": len(check.rows), "Scans a place": check.errors.shape[1],
                  "Spearman's coefficient over all places": check.rank,
                  "Median of it within a street": check.rank_in_street,
                  "Share of the errors within the 95 % ellipse": check.inside,
                  "Median observed error in plan, m": _median(check.observed),
                  "Median predicted error in plan, m": _median(check.predicted),
                  "Share of the rays to walls that were hidden": _median(check.hidden),
                  "Scans that end elsewhere": float((~check.converged).mean()) if len(check.rows) else None,
                  "Places with a direction not determined": int((~check.determined).sum()),
                  "Spearman's coefficient of scans that converge, directions determined": check.rank_converged,
                  "Share of these within the 95 % ellipse": check.inside_converged,
                  "Scans that end elsewhere ranked by the prediction, area under the ROC curve": check.failures_ranked,
                  "Scans that fit another place better": float(check.elsewhere.mean()) if len(check.rows) else None})
    if not len(check.rows):
        report.warning("No place could be simulated: walls tell nothing of any.")
        return
    report.figure(agreement_plot(check.predicted, check.observed), "Root mean square errors in plan of each place; "
                  "those above the picture are drawn at its edge.")
    report.table(["street", "way, m", "predicted along, across, m", "observed along, across, m", "within 95 %",
                  "elsewhere", "status"],
                 [[int(accuracy.places.street[row]), float(accuracy.places.way[row]),
                   "{:.2f}, {:.2f}".format(*check.predicted_parts[k, :2]),
                   "{:.2f}, {:.2f}".format(*check.observed_parts[k, :2]), f"{check.within[k]:.0%}",
                   f"{check.elsewhere[k]:.0%}", accuracy.status[row]] for k, row in enumerate(check.rows[:200])])


def _median(values: np.ndarray) -> float | None:
    finite = np.asarray(values, float)[np.isfinite(values)]
    return float(np.median(finite)) if len(finite) else None
