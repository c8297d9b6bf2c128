"""The report of frames adjusted to control points."""

from __future__ import annotations

import os

import numpy as np

from ...io.pages.report import GOOD, LOOK, Report
from ...wording import say
from .bundle import POSE, AdjustedFrames
from .stage import FrameControl, residual_columns

_SHOWN = ("id", "role", "frames", "east_before", "north_before", "east_after", "north_after", "east_left_out",
          "north_left_out")


def write_control_report(path: str | os.PathLike, result: FrameControl) -> None:
    """Write the report (HTML)."""
    report, points = Report("Frames adjusted to control points"), result.points
    left_out, checks = result.left_out_rms(), points.known & points.check
    text = say("{frames} frames lie {before:.3f} m off at {count} control points as given and {after:.3f} m after "
               "(RMS in plan).", frames=len(result.adjusted.poses), before=result.rms(result.followed, before=True),
               count=int(result.followed.sum()), after=result.rms(result.followed))
    if np.isfinite(left_out):
        text += " " + say("Each control point left out in turn lies {held:.3f} m off.", held=left_out)
    if checks.any():
        text += " " + say("Check points lie {off:.3f} m off.", off=result.rms(checks))
    report.verdict(LOOK if result.findings else GOOD, text)
    for sentence in result.findings:
        report.paragraph(sentence)
    report.section("Points")
    report.table(("Point", "role", "frames", "before east (m)", "before north (m)", "after east (m)", "after north (m)",
                  "left out east (m)", "left out north (m)"), _rows(result))
    report.section("Corrections of the frames")
    report.table(("Frame", *POSE), _of_frames(result.adjusted, result.adjusted.correction))
    report.paragraph("Corrected less given, metres and degrees.")
    report.section("Accuracy of the frames")
    report.table(("Frame", *POSE), _of_frames(result.adjusted, result.adjusted.sigma))
    report.paragraph("Standard deviations after the adjustment, metres and degrees. A point's error is how far from it "
                     "its pixel comes to lie on the ground, at the point's height.")
    report.write(path)


def _of_frames(result: AdjustedFrames, values: np.ndarray) -> list[tuple]:
    """Rows of image and its six values (frames, 6)."""
    return [(pose.image, *map(float, row)) for pose, row in zip(result.poses, values)]


def _rows(result: FrameControl) -> list[tuple]:
    columns = residual_columns(result)
    columns["role"] = [say(role) for role in columns["role"]]
    return list(zip(*(columns[name] for name in _SHOWN)))
