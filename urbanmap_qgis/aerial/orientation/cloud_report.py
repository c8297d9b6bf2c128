"""The report of a laser point cloud shifted to control points."""

from __future__ import annotations

import os

import numpy as np

from ...io.pages.report import GOOD, LOOK, Report
from ...wording import say
from .cloud_control import CloudControl, residual_rows

_SHOWN = ("id", "role", "east_before", "north_before", "up_before", "east_after", "north_after", "up_after",
          "east_left_out", "north_left_out", "up_left_out")


def write_cloud_report(path: str | os.PathLike, result: CloudControl) -> None:
    """Write the report (HTML)."""
    report, points = Report("Laser points shifted to control points"), result.points
    control = result.used.any(axis=1)
    before, after, left_out = (result.rms(errors, control) for errors in (points.errors, result.after, result.left_out))
    text = say("The cloud lies {before:.3f} m off in height at {count} control points as given and {after:.3f} m after "
               "(RMS); in plan {plan_before} and {plan_after}.", before=before[1], after=after[1],
               count=int(control.sum()), plan_before=_metres(before[0]), plan_after=_metres(after[0]))
    if np.isfinite(left_out[1]):
        text += " " + say("Each control point left out in turn lies {held:.3f} m off in height.", held=left_out[1])
    if points.check.any():
        plan, height = result.rms(result.after, points.check)
        text += " " + say("Check points lie {height} off in height and {plan} in plan.", height=_metres(height),
                          plan=_metres(plan))
    report.verdict(LOOK if result.findings else GOOD, text)
    for sentence in result.findings:
        report.paragraph(sentence)
    report.section("Shift")
    report.table(("Axis", "shift (m)", "standard deviation (m)"),
                 [(say(name), float(value), float(sigma)) for name, value, sigma
                  in zip(("east", "north", "up"), result.shift, result.sigma)])
    report.section("Points")
    columns = residual_rows(result)
    columns["role"] = [say(role) for role in columns["role"]]
    report.table(("Point", "role", "before east (m)", "before north (m)", "before up (m)", "after east (m)",
                  "after north (m)", "after up (m)", "left out east (m)", "left out north (m)", "left out up (m)"),
                 list(zip(*(columns[name] for name in _SHOWN))))
    report.paragraph("Cloud less truth. The height at a point is that of a plane through the ground points around it.")
    report.write(path)


def _metres(value: float) -> str:
    """A length with its unit, or that it was not measured."""
    return say("{value:.3f} m", value=value) if np.isfinite(value) else say("not measured")
