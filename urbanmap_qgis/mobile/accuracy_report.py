"""The report of a survey's accuracy at control points, as J tables 3-3 and 4-1 and figures 3-25 and 4-3 show it."""

from __future__ import annotations

import os
from collections.abc import Mapping

import numpy as np

from ..io.pages.report import LOOK, WORST, Fixed, Report
from ..io.pages.svg_profile import COLOURS, Series, profile
from ..wording import say
from .control import Accuracy, ControlPoints, accuracy


def write_accuracy_report(path: str | os.PathLike, control: ControlPoints, errors: Mapping[str, np.ndarray],
                          left_out: int = 0, adjusted: int = 0) -> None:
    """Write the report (HTML).

    Parameters
    ----------
    errors : (n, 3) at the control points, m, for each state of the survey by its name, the best last.
    left_out : control points outside the survey's time.
    adjusted : control points that the survey was adjusted to.
    """
    report = Report("Accuracy at control points")
    report.paragraph(say("{control_count} control points. An error is where the survey has a point less where it "
                         "truly is.", control_count=len(control)))
    if left_out:
        report.warning(say("{left_out} control points were not measured during this survey and are left out.",
                           left_out=left_out))
    if adjusted:
        report.paragraph(say("Left out, as the product was adjusted to them: {count} points.", count=adjusted))
    figures = {name: accuracy(values) for name, values in errors.items()}
    name, best = list(figures.items())[-1]
    report.verdict(LOOK, say("{name}: {mean_2d:.1f} cm off in plan on average and {max_2d:.1f} cm at most, at "
                             "{control_count} control points. Compare this with what the job asks for; the worst "
                             "points are below.", name=name[:1].upper() + name[1:],
                             mean_2d=100 * best.mean_2d, max_2d=100 * best.max_2d,
                             control_count=len(control)))
    report.table(("Survey", "mean 2D (m)", "max 2D (m)", "std 2D (m)", "mean 3D (m)", "max 3D (m)", "std 3D (m)",
                  "east (m)", "north (m)", "up (m)"), [_row(name, item) for name, item in figures.items()])
    report.paragraph("East, north and up are mean errors: what is left in all points alike.")
    name, last = list(errors.items())[-1]
    plan = np.hypot(*last[:, :2].T)
    _worst(report, control, name, last, plan)
    order = np.argsort(control.time)
    since = control.time[order] - control.time[order[0]]
    series = [Series(name, np.hypot(*values[order, :2].T), colour, dots=True)
              for (name, values), colour in zip(errors.items(), COLOURS[::-1][-len(errors):])]
    if len(control) > 1:
        report.section("Horizontal error over time")
        report.figure(profile(since, series, "seconds since the first control point", "m"),
                      say("Horizontal error of each control point. Points that stand out alone hint at the control; "
                          "errors that grow with time, at a part that is not corrected."))
    report.histogram(plan, "m", say("Horizontal errors, {name}", name=name))
    report.write(path)


def _worst(report: Report, control: ControlPoints, name: str, errors: np.ndarray, plan: np.ndarray) -> None:
    report.section(say("The worst control points, {name}", name=name))
    worst = np.argsort(-plan)[:WORST]
    report.table(("Control point", "time (s)", "east (m)", "north (m)", "up (m)", "2D (m)"),
                 [(control.id[k], Fixed.of(control.time[k]), *map(float, errors[k]), float(plan[k])) for k in worst])


def _row(name: str, item: Accuracy) -> tuple:
    return (name, item.mean_2d, item.max_2d, item.std_2d, item.mean_3d, item.max_3d, item.std_3d,
            *map(float, item.bias))
