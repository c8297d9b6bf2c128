"""The report of edges of building models that were compared with laser points, and the table of all of them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import partial

import numpy as np

from ..io.files.excel_table import write_excel_table
from ..io.pages.report import BAD, GOOD, LOOK, Fixed, Report
from ..io.pages.svg_vectors import vector_map, vector_map_shape
from ..wording import known, mark, say
from .acceptance_report import FIGURES_HEAD, PLACE_HEAD
from .criteria import FAILED, OUTCOMES, PASSED, Criterion, outcome
from .edge_comparison import (
    ABSENT_EDGES,
    SAME_POINTS,
    ComparedEdges,
    compared_rows,
    plan_figures,
    shared_shift,
)
from .edge_measurement import ABSENT, REASONS, SHOWN
from .edge_sampling import EDGES_OF_UNIT
from .error_figures import signed_figures
from .job import Job
from .map_levels import Limits
from .pdf_content import Drawing, PdfContent, criterion_row, histogram_of, metres

TITLE = mark("Acceptance: edges of buildings against laser points")
POINTS_TITLE = mark("All edges shown by the points")

COLUMNS = ("id", "building", "unit", "x", "y", "z", "across", "east", "north", "up", "sigma", "sigma_up", "points",
           "left_out")

HEAD = (mark("Component"), mark("edges"), mark("standard deviation (m)"), mark("limit (m)"),
        mark("upper bound, 95 % (m)"), mark("outcome"))
FOUND_HEAD = (mark("Unit"), mark("edges drawn"), mark("edges shown by the points"))
UNIT_FIGURES_HEAD = (mark("Unit"), mark("edges"), mark("all models east (m)"), mark("all models north (m)"),
                mark("all models up (m)"), mark("outward, mean (m)"), mark("across, maximum (m)"),
                mark("sigma of the points' edges (m)"))
ROWS_HEAD = (mark("Edge"), mark("Building"), mark("Unit"), *PLACE_HEAD[:2], mark("outward (m)"), mark("up (m)"),
             mark("sigma (m)"), mark("sigma of the height (m)"), mark("Left out"))

_NOT_INDEPENDENT = mark("This is a check of the modelling, not of accuracy: the points are not said to be of another, "
                        "more accurate survey. What models and points have in common is not seen.")
_INDEPENDENT = mark("The points were said to be of another, more accurate survey than the models. Neither their dates "
                    "nor their names prove that: models that were made from these points would agree with them "
                    "whatever the points' own errors.")
_METHOD = mark("Places of edges are found in the points by themselves: the model says only where to look, and how the "
               "roof slopes. They show an edge across itself, not along; the standard deviation in plan is put "
               "together from edges of different directions, about a mean of 0.")


def write_edges_report(path: str | os.PathLike, edges: ComparedEdges, found: Sequence[Criterion], limits: Limits,
                       job: Job, level: int | None, independent: bool) -> None:
    """Write the report (HTML); `found` are the criteria of `edges`."""
    report = Report(TITLE)
    report.verdict(*edges_verdict(edges, found, level))
    report.facts(job.rows(), form=True)
    report.paragraph(_INDEPENDENT if independent else _NOT_INDEPENDENT)
    report.section(say("Criteria of map level {level}", level=level) if level else say("Criteria"))
    report.table((mark("Unit"), *HEAD), [(
        item.unit, known(item.component), item.figures.count, Fixed.of(item.figures.rmse, 3), Fixed.of(item.limit, 3),
        Fixed.of(item.figures.bound, 3), known(OUTCOMES[item.outcome])) for item in found])
    report.paragraph(_METHOD)
    _found(report, edges)
    report.section("Figures")
    report.table(UNIT_FIGURES_HEAD, [_figures(edges, unit) for unit in edges.units])
    _pictures(report, edges, limits)
    report.section("All drawn edges")
    report.table(ROWS_HEAD, [(row[0], row[1], row[2], *(Fixed.of(row[k], 3) for k in (3, 4, 6, 9, 10, 11)),
                              known(row[13])) for row in compared_rows(edges)])
    report.write(path)


def edges_verdict(edges: ComparedEdges, found: Sequence[Criterion], level: int | None) -> tuple[str, str]:
    """Grade and sentence of the whole."""
    name = say("map level {level}", level=level) if level else say("the given limits")
    count = int(np.count_nonzero(edges.shown))
    barred = {item.barred for item in found}
    if not found:
        return LOOK, say("Nothing was judged, as no limit was given: the figures of {count} edges are below.",
                         count=count)
    if SAME_POINTS in barred:
        return LOOK, say("Not judged: the points are not said to be independent of the models. {count} of {all} drawn "
                         "edges were compared; the figures below are a check of the modelling.", count=count,
                         all=len(edges))
    if outcome(found) == FAILED:
        worst = max((item for item in found if item.outcome == FAILED), key=lambda item: item.figures.rmse / item.limit)
        return BAD, say("Not accepted for {name}: {component} {rmse:.3f} m, limit {limit:.3f} m{unit}.", name=name,
                        component=known(worst.component), rmse=worst.figures.rmse, limit=worst.limit,
                        unit=_of(worst))
    if outcome(found) != PASSED:
        return LOOK, _open(edges, next(item for item in found if item.outcome != PASSED), name)
    sure = say("Accepted for {name}: {count} edges keep every limit, also with a confidence of 95 %.", name=name,
               count=count)
    return GOOD, sure if all(item.is_certain for item in found) else say(
        "Accepted for {name}: {count} edges keep every limit. They are too few, or the figure too close, to show it "
        "with a confidence of 95 %.", name=name, count=count)


def _open(edges: ComparedEdges, item: Criterion, name: str) -> str:
    """Why a criterion is not judged."""
    if item.barred == ABSENT_EDGES:
        return say("Not judged for {name}: at {absent} edges{unit} there are points, but no edge within reach of the "
                   "model's. Look at them: what is left out could be the worst.", name=name,
                   absent=edges.count(ABSENT, edges.of_unit(item.unit)), unit=_of(item))
    if item.figures.count < item.needed:
        return say("Not judged for {name}: {component} is shown at {edges} edges{unit}, and {needed} are needed.",
                   name=name, component=known(item.component), edges=item.figures.count, needed=item.needed,
                   unit=_of(item))
    return say("Not judged for {name}: nearly all edges{unit} run one way, and nothing is known along them.",
               name=name, unit=_of(item))


def _of(item: Criterion) -> str:
    return f" ({item.unit})" if item.unit else ""


def _found(report: Report, edges: ComparedEdges) -> None:
    """How many drawn edges the points show, and why not the others."""
    report.section("Edges in the points")
    rows = []
    for unit in edges.units:
        of_unit = edges.of_unit(unit)
        rows.append((unit, int(np.count_nonzero(of_unit)), edges.count(SHOWN, of_unit),
                     *(edges.count(reason, of_unit) for reason in REASONS)))
    report.table((*FOUND_HEAD, *REASONS.values()), rows)
    report.paragraph(say("Each unit needs {needed} edges. Those that the points do not show are left out. Points "
                         "without an edge near that of the model speak against it: where they are more than a tenth "
                         "of those that the points cover, nothing is accepted.", needed=EDGES_OF_UNIT))


def _figures(edges: ComparedEdges, unit: str) -> tuple:
    rows = edges.of_unit(unit)
    plan, shift = plan_figures(edges, rows), shared_shift(edges, rows)
    sigma = np.array([edges.measured[row].sigma for row in np.flatnonzero(rows & edges.shown)])
    typical = float(np.sqrt(np.mean(sigma ** 2))) if len(sigma) else np.nan
    return (unit, plan.count, *(Fixed.of(value, 3) for value in (*shift, plan.mean, plan.maximum, typical)))


def _pictures(report: Report, edges: ComparedEdges, limits: Limits) -> None:
    """Map of the residuals and how they are spread."""
    if not edges.shown.any():
        return
    report.histogram(edges.across[edges.shown], "m", say("Errors across the edges, outward"))
    if np.isfinite(edges.up).any():
        report.histogram(edges.up[edges.shown], "m", say("Errors in height"))
    report.section("Where the errors lie")
    report.figure(_map(edges, limits)(), say(
        "Errors across the edges, drawn larger than the map; red: above the limit. Arrows that all point one way are "
        "an error that the whole product shares."))


def _map(edges: ComparedEdges, limits: Limits) -> Drawing | None:
    """Map of the residuals; None where no edge is shown."""
    use = edges.shown
    if not use.any():
        return None
    middle = edges.drawn.ends[use].mean(axis=1)[:, :2]
    return partial(vector_map, middle, edges.across[use, None] * edges.normal[use],
                   [str(row + 1) for row in np.flatnonzero(use)], limits.plan)


def edges_pdf_content(edges: ComparedEdges, found: Sequence[Criterion], limits: Limits, level: int | None,
                      independent: bool) -> PdfContent:
    """What the PDF shows of compared edges; parameters as of `write_edges_report`."""
    every = np.ones(len(edges), bool)
    figures = [(say("across the edges"), signed_figures(edges.across)), (say("plan"), plan_figures(edges, every)),
               (say("height"), signed_figures(edges.up))]
    rows = [[str(row[0]), row[2], *map(metres, (*row[3:6], *row[7:10], row[6]))] for row in compared_rows(edges)
            if not row[13]]
    head = (mark("edge"), mark("unit"), *PLACE_HEAD, mark("east (m)"), mark("north (m)"), mark("up (m)"),
            mark("outward (m)"))
    return PdfContent(
        {"title": known(TITLE), "verdict": " ".join((edges_verdict(edges, found, level)[1],
                                                     known(_INDEPENDENT if independent else _NOT_INDEPENDENT))),
         "figures_title": known("Figures"), "points_title": known(POINTS_TITLE)},
        {"criteria": [list(map(known, HEAD)), *map(criterion_row, found)],
         "figures": [list(map(known, FIGURES_HEAD)),
                     *([name, str(one.count), *map(metres, (one.mean, one.rmse, one.std, one.maximum))]
                       for name, one in figures)],
         "points": [list(map(known, head)), *rows]},
        {"map": _map(edges, limits), "histogram_plan": histogram_of(edges.across, say("Errors across the edges")),
         "histogram_height": histogram_of(edges.up, say("Errors in height"))},
        vector_map_shape(_places(edges)))


def _places(edges: ComparedEdges) -> np.ndarray:
    """Ends (n, 2) of the edges that are shown, m."""
    return edges.drawn.ends[edges.shown].reshape(-1, 3)[:, :2]


def write_compared_csv(path: str | os.PathLike, edges: ComparedEdges) -> None:
    """Write every drawn edge as CSV (UTF-8 with a mark that Excel knows), `COLUMNS`; empty where it is not shown.

    Raises
    ------
    OutputError : the file cannot be written there.
    """
    write_excel_table(path, (COLUMNS, *(
        (*row[:3], *("" if value != value else f"{value:.4f}" for value in row[3:12]), row[12], known(row[13]))
        for row in compared_rows(edges))))


def compared_numbers(edges: ComparedEdges) -> dict[str, float]:
    """Figures of all shown edges by the names of the algorithm's numbers, m; NaN where not known."""
    every = np.ones(len(edges), bool)
    plan, height = plan_figures(edges, every), signed_figures(edges.up)
    return {"POINTS": plan.count, "RMSE_PLAN": plan.rmse, "RMSE_HEIGHT": height.rmse, "MEAN_PLAN": plan.mean,
            "MAX_PLAN": plan.maximum, "MAX_HEIGHT": height.maximum}
