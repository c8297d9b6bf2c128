"""The acceptance report: each criterion with its figure and limit, all check points, in the form of the tables of
quality control (精度管理表) of Japan's public surveys."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from ..io.files.excel_table import write_excel_table
from ..io.pages.report import BAD, GOOD, LOOK, Fixed, Report
from ..io.pages.svg_vectors import vector_map, vector_map_shape
from ..wording import known, mark, say
from .check_points import CheckPoints
from .criteria import FAILED, OUTCOMES, PASSED, Criterion, outcome
from .edge_sampling import EDGES_OF_UNIT, SampledEdges
from .error_figures import ErrorFigures, point_figures, signed_figures
from .job import Job
from .map_levels import Limits
from .pdf_content import Drawing, PdfContent, criterion_row, histogram_of, metres

FIGURES_HEAD = (mark("Component"), mark("points"), mark("mean (m)"), mark("RMSE (m)"), mark("standard deviation (m)"),
                mark("maximum (m)"))

CRITERIA_HEAD = (mark("Component"), mark("points"), mark("standard deviation (m)"), mark("limit (m)"),
                 mark("upper bound, 95 % (m)"), mark("outcome"))


DRAWN_TITLE = mark("Acceptance: edges of buildings to be surveyed")
DRAWN_HEAD = (mark("Unit"), mark("edges drawn"), mark("edges there are"), mark("edges needed"))
PLACE_HEAD = (mark("easting (m)"), mark("northing (m)"), "z (m)")
"""Names of coordinates: in Japan's plane systems X is the northing, so that letters alone would mislead."""
FIELD_HEAD = (mark("point"), mark("unit"), *PLACE_HEAD, mark("measured easting (m)"), mark("measured northing (m)"),
              mark("measured z (m)"), mark("Remarks"))


def write_acceptance_report(path: str | os.PathLike, points: CheckPoints, found: Sequence[Criterion], limits: Limits,
                            job: Job, level: int | None = None,
                            registration: Mapping[str, np.ndarray] | None = None) -> None:
    """Write the report (HTML, prints on A4).

    Parameters
    ----------
    found : criteria of `points` with `limits`.
    level : map level of the limits, None where they were given.
    registration : figures of a registration by their words, (n,) m each; their mean, standard deviation and maximum are
        shown.
    """
    report = Report("Acceptance: errors at check points")
    report.verdict(*verdict(points, found, level))
    report.facts(job.rows(), form=True)
    _criteria(report, found, level)
    _figures(report, points)
    _spread(report, points)
    if points.edge:
        _edges(report, found)
    _registration(report, registration or {})
    _map(report, points, limits)
    _all_points(report, points)
    report.write(path)


def verdict(points: CheckPoints, found: Sequence[Criterion], level: int | None) -> tuple[str, str]:
    """Grade and sentence of the whole."""
    name = say("map level {level}", level=level) if level else say("the given limits")
    total = outcome(found)
    if not found:
        return LOOK, say("Nothing was judged, as no limit was given: the figures of {count} check points are below.",
                         count=len(points))
    if total == FAILED:
        worst = max((item for item in found if item.outcome == FAILED), key=lambda item: item.figures.rmse / item.limit)
        return BAD, say("Not accepted for {name}: {component} {rmse:.3f} m, limit {limit:.3f} m{unit}.", name=name,
                        component=known(worst.component), rmse=worst.figures.rmse, limit=worst.limit,
                        unit=f" ({worst.unit})" if worst.unit else "")
    if total != PASSED:
        open_one = next(item for item in found if item.outcome not in (PASSED, FAILED))
        unit = f" ({open_one.unit})" if open_one.unit else ""
        if open_one.edges is not None and open_one.edges < open_one.needed_edges:
            return LOOK, say("Not judged for {name}: {edges} edges with both ends measured{unit}, and {needed} are "
                             "needed.", name=name, edges=open_one.edges, needed=open_one.needed_edges, unit=unit)
        return LOOK, say("Not judged for {name}: {component} has {count} check points{unit}, and {needed} are needed.",
                         name=name, component=known(open_one.component), count=open_one.figures.count,
                         needed=max(open_one.needed, 1), unit=unit)
    if all(item.is_certain for item in found):
        return GOOD, say("Accepted for {name}: {count} check points keep every limit, also with a confidence of 95 %.",
                         name=name, count=len(points))
    return GOOD, say("Accepted for {name}: {count} check points keep every limit. They are too few, or "
                     "the figure too close, to show it with a confidence of 95 %.", name=name, count=len(points))


def _criteria(report: Report, found: Sequence[Criterion], level: int | None) -> None:
    report.section(say("Criteria of map level {level}", level=level) if level else say("Criteria"))
    with_units = any(item.unit for item in found)
    head = (mark("Unit"), *CRITERIA_HEAD) if with_units else CRITERIA_HEAD
    report.table(head, [((item.unit,) if with_units else ()) + (
        known(item.component), item.figures.count, Fixed.of(item.figures.rmse, 3), Fixed.of(item.limit, 3),
        Fixed.of(item.figures.bound, 3), known(OUTCOMES[item.outcome])) for item in found])
    report.paragraph("The standard deviation is that about a mean of 0, the root of the mean square: what all points "
                     "share counts too. With a confidence of 95 % the standard deviation of all places is below the "
                     "upper bound, if errors are normal.")


def _edges(report: Report, found: Sequence[Criterion]) -> None:
    """How many edges of buildings were measured in each unit."""
    report.section("Sampled edges of buildings")
    report.table((mark("Unit"), mark("edges with both ends measured"), mark("edges needed")),
                 list(dict.fromkeys((item.unit, item.edges, item.needed_edges) for item in found)))
    report.paragraph("Edges were drawn at random in each unit, and both ends of each surveyed. An edge with one end "
                     "counts among the points, but not among the edges.")


def write_sampling_report(path: str | os.PathLike, drawn: SampledEdges, job: Job) -> None:
    """Write the report of a run that only drew edges (HTML): nothing is judged."""
    report = Report(DRAWN_TITLE)
    report.verdict(LOOK, _not_yet(drawn))
    report.facts(job.rows(), form=True)
    report.section("Sampled edges of buildings")
    report.table(DRAWN_HEAD, _drawn_rows(drawn))
    if min(drawn.available.values()) < EDGES_OF_UNIT:
        report.warning("Units with fewer edges than needed cannot be judged by themselves: choose others, or larger "
                       "ones.")
    report.figure(_drawn_map(drawn)(), "Where the drawn edges lie, with their numbers.")
    report.write(path)


def sampling_pdf_content(drawn: SampledEdges) -> PdfContent:
    """What the PDF shows of a run that only drew edges: a sheet for the field, with room for what is measured."""
    points = [[f"{number}{letter}", unit, *map(metres, map(float, point)), "", "", "", ""]
              for number, (unit, ends) in enumerate(zip(drawn.unit, drawn.ends), 1)
              for letter, point in zip("ab", ends)]
    return PdfContent(
        {"title": known(DRAWN_TITLE), "verdict": _not_yet(drawn), "figures_title": "",
         "points_title": say("Ends of the edges, with room for what is measured")},
        {"criteria": [list(map(known, DRAWN_HEAD)), *(list(map(str, row)) for row in _drawn_rows(drawn))],
         "figures": [], "points": [list(map(known, FIELD_HEAD)), *points]},
        {"map": _drawn_map(drawn), "histogram_plan": None, "histogram_height": None},
        vector_map_shape(drawn.ends.reshape(-1, 3)[:, :2]))


def _not_yet(drawn: SampledEdges) -> str:
    return say("Nothing was checked: {count} edges were drawn. Survey both ends of each, fill x, y, z "
               "into the table of edges and give that as check points.", count=len(drawn))


def _drawn_rows(drawn: SampledEdges) -> list[tuple[str, int, int, int]]:
    """Of each unit: its name, edges drawn, those there are, those needed."""
    number = Counter(drawn.unit)
    return [(unit, number[unit], count, EDGES_OF_UNIT) for unit, count in drawn.available.items()]


def _drawn_map(drawn: SampledEdges) -> Drawing:
    middle = drawn.ends[:, :, :2].mean(axis=1)
    return partial(vector_map, middle, np.zeros_like(middle), [str(k + 1) for k in range(len(drawn))], None)


def _figures(report: Report, points: CheckPoints) -> None:
    report.section("Figures")
    report.table(FIGURES_HEAD, [_row(name, figures) for name, figures in figure_rows(points)], whole=True)
    if points.state == "before":
        report.warning("These are the errors as reported: the layer has none after a correction.")
    if points.adjusted:
        report.paragraph(say("Left out, as the product was adjusted to them: {count} points.", count=points.adjusted))


def figure_rows(points: CheckPoints) -> list[tuple[str, ErrorFigures]]:
    """Figures of the errors by component, with its words."""
    figures = point_figures(points.errors)
    return [(say("east"), figures.east), (say("north"), figures.north), (say("plan (distance)"), figures.plan),
            (say("height"), figures.height)]


def _row(name: str, figures: ErrorFigures) -> tuple:
    return (name, figures.count, Fixed.of(figures.mean, 3), Fixed.of(figures.rmse, 3), Fixed.of(figures.std, 3),
            Fixed.of(figures.maximum, 3))


def _registration(report: Report, registration: Mapping[str, np.ndarray]) -> None:
    """Mean, standard deviation and maximum of a registration's figures."""
    if not registration:
        return
    report.section("Registration")
    report.table((mark("Figure"), "patches", "mean (m)", "standard deviation (m)", "maximum (m)"), [
        (name, item.count, Fixed.of(item.mean, 3), Fixed.of(item.std, 3), Fixed.of(item.maximum, 3))
        for name, item in _registration_rows(registration)], whole=True)


def _registration_rows(registration: Mapping[str, np.ndarray]) -> list[tuple[str, ErrorFigures]]:
    return [(known(name), signed_figures(values)) for name, values in registration.items()]


def _map(report: Report, points: CheckPoints, limits: Limits) -> None:
    """Vectors of errors in plan."""
    drawing = error_map(points, limits)
    if drawing is not None:
        report.section("Where the errors lie")
        report.figure(drawing(), say(
            "Errors in plan, drawn larger than the map; red: above the limit. Arrows that all point one way are an "
            "error that the whole product shares."))


def _spread(report: Report, points: CheckPoints) -> None:
    """How the errors are spread; before the map, so that they fill the first page in print."""
    report.histogram(np.hypot(*points.errors[:, :2].T), "m", say("Errors in plan"))
    report.histogram(points.errors[:, 2], "m", say("Errors in height"))


def pdf_content(points: CheckPoints, found: Sequence[Criterion], limits: Limits, level: int | None,
                registration: Mapping[str, np.ndarray] | None = None) -> PdfContent:
    """What the PDF shows of check points; parameters as of `write_acceptance_report`."""
    registered = [(f"{known('Registration')}: {name}", one) for name, one in _registration_rows(registration or {})]
    figures = [[name, str(one.count), *map(metres, (one.mean, one.rmse, one.std, one.maximum))]
               for name, one in (*figure_rows(points), *registered)]
    every = [[*row[:2], *map(metres, row[2:])] for row in point_rows(points)]
    return PdfContent(
        {"title": known("Acceptance: errors at check points"), "verdict": verdict(points, found, level)[1],
         "figures_title": known("Figures"), "points_title": known("All check points")},
        {"criteria": [list(map(known, CRITERIA_HEAD)), *map(criterion_row, found)],
         "figures": [list(map(known, FIGURES_HEAD)), *figures], "points": [list(map(known, point_head())), *every]},
        drawings(points, limits), vector_map_shape(points.true[:, :2]))


def drawings(points: CheckPoints, limits: Limits) -> dict[str, Drawing | None]:
    """The map and the histograms by the ids of their places in the layout; None where there is nothing."""
    plan, height = np.hypot(*points.errors[:, :2].T), points.errors[:, 2]
    return {"map": error_map(points, limits), "histogram_plan": histogram_of(plan, say("Errors in plan")),
            "histogram_height": histogram_of(height, say("Errors in height"))}


def error_map(points: CheckPoints, limits: Limits) -> Drawing | None:
    """Map of the errors in plan; None where no point's place is known."""
    placed = np.isfinite(points.true[:, :2]).all(axis=1)
    if not placed.any():
        return None
    names = [points.id[k] for k in np.flatnonzero(placed)]
    return partial(vector_map, points.true[placed, :2], points.errors[placed, :2], names, limits.plan)


def _all_points(report: Report, points: CheckPoints) -> None:
    report.section("All check points")
    rows = point_rows(points)
    report.table(point_head(), [(row[0], row[1], *(Fixed.of(value, 3) for value in row[2:])) for row in rows])


def point_head() -> tuple[str, ...]:
    """Names of the columns of `point_rows`."""
    return (mark("point"), mark("unit"), *PLACE_HEAD, mark("east (m)"), mark("north (m)"), mark("up (m)"),
            mark("plan (m)"))


def point_rows(points: CheckPoints) -> list[tuple]:
    """Every check point: name, unit, true place, errors and the error in plan, m."""
    return [(points.id[k], points.unit[k], *map(float, points.true[k]), *map(float, points.errors[k]),
             float(np.hypot(*points.errors[k, :2]))) for k in range(len(points))]


def write_points_csv(path: str | os.PathLike, points: CheckPoints) -> None:
    """Write every check point as CSV (UTF-8 with a mark that Excel knows); empty where a value is not known.

    Raises
    ------
    OutputError : the file cannot be written there.
    """
    write_excel_table(path, (("id", "unit", "x", "y", "z", "east", "north", "up", "plan"), *(
        (row[0], row[1], *("" if value != value else f"{value:.4f}" for value in row[2:]))
        for row in point_rows(points))))
