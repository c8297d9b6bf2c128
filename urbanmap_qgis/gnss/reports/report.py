"""HTML reports of the GNSS part: the sky, residuals against prediction, walls before and after, what to distrust."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Callable

import numpy as np

from ...io.pages.report import BAD, GOOD, LOOK, Report, percent
from ...io.pages.svg import bars
from ...wording import known as known_words
from ...wording import mark, say
from ..rays.ray_lines import RayStatistics, ray_statistics
from ..rays.reflections import LOS, NLOS, REFLECTED, SignalPaths
from ..signals.tables import SYSTEM_NAMES, Signals
from ..walls.adjustment import ADJUSTED, HELD, LIKELY, NOT_OBSERVABLE, Adjustment
from .charts import scatter, sky_plot, wall_map

_NAMES = {LOS: mark("in line of sight"), NLOS: mark("blocked, no single wall reflects it"),
          REFLECTED: mark("reflected by one wall")}
_ROWS = 200


def write_reflection_report(path: str | os.PathLike, signals: Signals, paths: SignalPaths, corrected: np.ndarray,
                            figures: RayStatistics) -> None:
    """Report of traced signals.

    Parameters
    ----------
    corrected : (n,) residuals less the receiver's clock, m.
    """
    report = Report("GNSS reflections")
    sure = float(np.mean(paths.sure)) if len(paths.sure) else 0.0
    report.verdict(GOOD if sure > 0.8 else LOOK, say("{count} of {kind_count} signals are reflected by one wall; of "
                                                     "{sure:.0f} % of all signals the class is sure.",
                                                     count=int(np.sum(paths.kind == REFLECTED)),
                                                     kind_count=len(paths.kind), sure=100 * sure)
                   + " " + say("Where measured and predicted paths agree below, the models can be adjusted by them."))
    _distrust(report, signals, paths, corrected)
    _signals(report, signals, paths, corrected, figures)
    report.write(path)


def write_adjustment_report(path: str | os.PathLike, signals: Signals, adjustment: Adjustment, names: np.ndarray,
                            shapes: np.ndarray, more: Callable[[Report], None] = lambda report: None) -> None:
    """Report of adjusted walls.

    Parameters
    ----------
    names : (buildings,) of the buildings by row.
    shapes : (n,) the buildings as they were given.
    more : adds to the report behind its plan.
    """
    report = Report("Walls adjusted by GNSS")
    walls = adjustment.walls
    adjusted, likely = walls.status == ADJUSTED, walls.status == LIKELY
    if walls.is_moved.any():
        report.verdict(GOOD if adjusted.all() else LOOK,
                       say("{sum} of {adjusted_count} walls are adjusted, with a median standard deviation of "
                           "{median:.2f} m, {likely} more are likely ({likely_median:.2f} m). The others stay where "
                           "they were: nothing is known of them.",
                           sum=int(adjusted.sum()), adjusted_count=len(adjusted),
                           median=_median(walls.sigma[adjusted]), likely=int(likely.sum()),
                           likely_median=_median(walls.sigma[likely])))
    else:
        report.verdict(BAD, "No wall was moved: the observations do not decide. The table below tells why; more "
                       "drives along the walls help.")
    report.facts({"Walls": len(adjusted), "Adjusted": int(adjusted.sum()), "Likely": int(likely.sum()),
                  "Held back to keep buildings valid": int(np.sum(walls.status == HELD)),
                  "Not observable": int(np.sum(walls.status == NOT_OBSERVABLE)),
                  "Passes": len(adjustment.clocks), "Independent observations": len(adjustment.observations),
                  "Signals in them": int(adjustment.used.sum()),
                  "Median sigma of adjusted walls, m": _median(walls.sigma[adjusted]),
                  "Median size of their offsets, m": _median(np.abs(walls.offset[adjusted])),
                  "Median sigma of likely walls, m": _median(walls.sigma[likely]),
                  "Iterations until nothing changed": adjustment.iterations})
    _reasons(report, adjustment)
    _plan(report, adjustment, shapes)
    more(report)
    _wall_table(report, adjustment, names)
    _errors(report, adjustment)
    statistics = ray_statistics(signals, adjustment.paths, adjustment.corrected)
    _signals(report, signals, adjustment.paths, adjustment.corrected, statistics)
    _distrust(report, signals, adjustment.paths, adjustment.corrected)
    report.write(path)


def _plan(report: Report, adjustment: Adjustment, shapes: np.ndarray) -> None:
    report.section("Walls before and after")
    svg = wall_map(shapes, adjustment.before, adjustment.after, adjustment.walls)
    report.figure(svg, "Buildings as given (grey). Adjusted and likely walls: where they stood (dashed) and where they "
                       "stand now, blue inwards, red outwards; the label is the offset in cm. Orange: observed, but "
                       "not decided.")


def _reasons(report: Report, adjustment: Adjustment) -> None:
    walls = adjustment.walls
    report.section("Walls that stay where they are")
    left = ~walls.is_moved
    counted = Counter(_kind_of(reason) for reason in walls.reason[left])
    report.table(["reason", "walls"], counted.most_common())
    report.paragraph("A wall that is not observable may stand where the model has it or a metre off: nothing is known "
                     "of it. More passes help where observations are few; nothing helps under open sky.")


def _wall_table(report: Report, adjustment: Adjustment, names: np.ndarray) -> None:
    walls, table = adjustment.walls, adjustment.walls.table
    report.section("Walls with observations")
    seen = np.flatnonzero(walls.observations > 0)
    rank = 2 * ~walls.is_moved[seen] + (walls.status[seen] == LIKELY)
    order = seen[np.lexsort((walls.sigma[seen], rank))]
    rows = [[str(names[table.building[w]]), int(table.edge[w]), walls.status[w], float(walls.offset[w]),
             float(walls.sigma[w]), float(walls.applied[w]), int(walls.observations[w]), int(walls.satellites[w]),
             int(walls.passes[w]), percent(float(walls.inlier_share[w])), walls.reason[w]] for w in order[:_ROWS]]
    report.table(["building", "edge", "status", "offset, m", "sigma, m", "moved, m", "observations", "satellites",
                  "passes", "share of inliers", "reason"], rows)
    if len(order) > _ROWS:
        report.paragraph(say("{order_count} more are in the layer of walls.", order_count=len(order) - _ROWS))


def _errors(report: Report, adjustment: Adjustment) -> None:
    if adjustment.offsets is None:
        return
    model, error = adjustment.offsets.model, adjustment.offsets.error
    report.section("How the observations scatter")
    report.facts({"Error of an observation besides its noise, m": model.sigma,
                  "Factor of the noise expected": model.noise, "Share of NLOS-delayed ones": percent(model.nlos_share),
                  "Their mean delay, m": model.nlos_mean_delay, "Share of outliers": percent(model.outlier_share)})
    shown = np.clip(error, -10.0, 20.0)
    counts, edges = np.histogram(shown, bins=30, range=(-10.0, 20.0))
    report.figure(bars(counts, edges, "m"), "What the offsets leave of the observations: NLOS-delayed ones are to the "
                  "right; "
                                            "the first and the last bar hold all that is beyond.")


def _signals(report: Report, signals: Signals, paths: SignalPaths, corrected: np.ndarray,
             figures: RayStatistics) -> None:
    report.section("Signals")
    systems = ", ".join(f"{SYSTEM_NAMES.get(name, name)} {np.sum(signals.system == name):,}"
                        for name in np.unique(signals.system))
    report.facts({"Epochs": len(signals.epochs), "Signals": len(signals), "By system": systems,
                  **{known_words(_NAMES[kind]).capitalize(): count for kind, count in figures.count.items()},
                  "Residuals in line of sight: median, m": figures.los_median,
                  "Residuals in line of sight: quartile range, m": figures.los_iqr,
                  "Reflected signals with a known clock": figures.reflected,
                  "of these within 5 m of prediction": percent(figures.within_5),
                  "of these within 10 m of prediction": percent(figures.within_10),
                  "of these: median difference, m": figures.difference})
    report.figure(sky_plot(signals, paths), "Sky plot (grid north up, horizon outside): green in line of sight, orange "
                                           "reflected, grey blocked.")
    known = np.isfinite(corrected)
    for kind in (LOS, REFLECTED, NLOS):
        rows = known & (paths.kind == kind)
        if rows.any():
            low, high = (-10.0, 10.0) if kind == LOS else (-20.0, 80.0)
            counts, edges = np.histogram(np.clip(corrected[rows], low, high), bins=50, range=(low, high))
            report.figure(bars(counts, edges, "residual, m"), say("Residuals of signals {names} ({sum:,}).",
                                                                  names=known_words(_NAMES[kind]), sum=rows.sum()))
    rows = np.flatnonzero(known & (paths.kind == REFLECTED))
    if len(rows):
        report.figure(scatter(paths.excess()[rows], corrected[rows], paths.sure[rows]),
                      "Measured against predicted excess path of reflected signals, m: dark where the class is "
                      "sure. Above the line signals are late, at the foot the direct signal got through.")


def _distrust(report: Report, signals: Signals, paths: SignalPaths, corrected: np.ndarray) -> None:
    report.section("What to distrust")
    unknown = int(np.sum(~np.isfinite(corrected)))
    unsure = float(np.mean(~paths.sure))
    report.table(["what", "how many"], [
        ["signals without a known receiver clock (fewer than three in line of sight)", unknown],
        ["share of signals near an edge: class not sure", percent(unsure)],
        ["epochs with the antenna within a building", int(paths.indoors.sum())],
        *[[f"observations left out: {reason}", count] for reason, count in signals.left_out.items()]])
    for note in signals.notes:
        report.paragraph(note)
    if np.isfinite(signals.geoid_sigma):
        report.warning(say("The geoid separation was estimated from the satellites ({geoid_separation:.1f} m, sigma "
                           "{geoid_sigma:.1f} m). An error of it is mostly taken up by the clock.",
                           geoid_separation=signals.geoid_separation, geoid_sigma=signals.geoid_sigma))
    report.paragraph("Reflections by ground, vehicles, bridges and trees, two reflections in a row and diffraction at "
                     "edges are not traced; walls are taken for flat and upright.")


def _median(values: np.ndarray) -> float:
    return float(np.median(values)) if len(values) else float("nan")


def _kind_of(reason: str) -> str:
    """A reason without its figures."""
    return re.split(r" \(|（", reason)[0]
