"""The report of a rectified trajectory: before and after, set by set, with the sigmas along the course."""

from __future__ import annotations

import html
import os
from collections.abc import Callable, Sequence

import numpy as np

from ...io.pages.report import BAD, GOOD, LOOK, Fixed, Report
from ...io.pages.svg_profile import COLOURS, Series, ShadedInterval, profile
from ...wording import mark, say
from ..trajectory import Trajectory
from .course_heights import CourseHeights
from .rectification import BLUNDER, CONTRADICTING, EXTRAPOLATED, ONE_PAIR, POSITION_ONLY, SUSPECT, USED, Rectified

MEANING = {
    USED: "used",
    POSITION_ONLY: "used; its pairs lie too close together, as seen from the vehicle, to tell the heading",
    SUSPECT: "used, but far from where the other sets put it: check it",
    BLUNDER: "left out: the other sets put it elsewhere",
    CONTRADICTING: "left out: its pairs do not fit each other",
    ONE_PAIR: "left out: the paper's method needs two pairs",
}

_METHOD = {
    "drift": "best estimate of the drift from all tie points together",
    "paper": "Z 3 to the letter: sets of two pairs (eq. 13 to 17), relative motions by iteration (eq. 8, 9)",
}
_SET_COLOURS = {USED: "#1a9850", POSITION_ONLY: "#91cf60", SUSPECT: "#e09a2b", BLUNDER: "#d73027",
                CONTRADICTING: "#d73027", ONE_PAIR: "#d73027"}
_MAX_POINTS = 3000
_WIDTH = 900


def write_report(path: str | os.PathLike, before: Trajectory, rectified: Rectified,
                 notes: Sequence[str] = (), more: Callable[[Report], None] = lambda report: None) -> None:
    """Write the HTML report of a rectification; `notes` (warnings) are shown as they are, `more` adds to it."""
    report = Report("Rectified trajectory")
    _verdict(report, rectified, notes)
    for note in notes:
        report.warning(note)
    report.section("Result")
    report.facts(_facts(before, rectified))
    report.figure(course_map(before, rectified),
                  "The course as reported (grey) and rectified (blue; dashed where it is "
                  "extrapolated beyond the sets), and the sets of tie points: green used, orange suspect, red left "
                  "out.")
    report.section("Drift")
    _drift(report, before, rectified)
    report.section("Sets of tie points")
    report.table(("Set", "Time, s", "Pairs", "Before, m", "After, m", "East, m", "North, m", "Heading, °",
                  "Misfit within, m", "Off without itself, m", "Status"),
                 [(item.name, Fixed.of(item.time), say("{pairs} of {given}", pairs=item.pairs,
                                             given=item.given), item.before, item.after, item.shift[0],
                   item.shift[1], item.heading, item.misfit, item.predicted,
                   MEANING[item.status]) for item in rectified.sets])
    report.paragraph("Before and after: mean distance of the set's pairs from the reference. Off without itself: how "
                     "far the set would lie from the reference if it were not used, which is more than what to expect "
                     "halfway between sets.")
    if not rectified.settings.tie_sigma:
        report.paragraph("The sigma of the tie points was found from how well they fit each other. An error that they "
                         "share, such as that of the reference, is not in it nor in the sigmas of the epochs.")
    if rectified.heights is not None:
        report.section("Heights")
        _heights(report, before, rectified.heights)
    more(report)
    report.write(path)


def _verdict(report: Report, rectified: Rectified, notes: Sequence[str]) -> None:
    """What to expect between the sets, and whether to look further."""
    figures = rectified.figures()
    left_out = len(rectified.sets) - len(rectified.used)
    text = (say("{used_count} of {sets_count} sets of tie points are used; after the rectification they lie "
                "{figures:.2f} m from the reference on average.", used_count=len(rectified.used),
                sets_count=len(rectified.sets), figures=figures.get("AFTER", float("nan"))))
    if left_out:
        text += say(" {left_out} were left out: look at them in the table below.", left_out=left_out)
    if np.isfinite(figures.get("PREDICTED", float("nan"))):
        text += " " + say("Halfway between sets expect less than {predicted:.2f} m.", predicted=figures["PREDICTED"])
    if notes:
        text += " " + say("Read the remarks below first.")
    report.verdict(BAD if not rectified.used else LOOK if left_out or notes else GOOD, text)


def _facts(before: Trajectory, rectified: Rectified) -> dict[str, object]:
    used, walk = rectified.used, rectified.drift.walk
    moved = np.hypot(*(rectified.trajectory.place - before.place)[:, :2].T)
    figures = rectified.figures()
    return {
        mark("Method"): _METHOD[rectified.settings.method],
        mark("Epochs"): len(before),
        mark("Sets of tie points used"): say("{used} of {given}", used=len(used), given=len(rectified.sets)),
        mark("Distance of the tie points from the reference before, m"): figures.get("BEFORE"),
        mark("after, m"): figures.get("AFTER"),
        mark("Off without itself, mean over the sets, m"): figures.get("PREDICTED"),
        mark("Moved in plan, mean, m"): float(moved.mean()),
        mark("maximum, m"): float(moved.max()),
        mark("Sigma of a coordinate between the sets, mean, m"): figures.get("MEAN_SIGMA"),
        mark("maximum of all epochs, m"): figures["MAX_SIGMA"],
        mark("Share of the epochs before the first or after the last set"): figures["HELD_SHARE"],
        mark("Errors of heading rotate the course (dead reckoning)"): walk.coupled,
        mark("Drift follows the accuracy that the navigation states"): rectified.drift.pace.is_stated,
        mark("Random walk of the position, m per root second"): walk.position_walk,
        mark("of the heading, ° per root second"): float(np.degrees(walk.heading_walk)),
        mark("Sigma of a tie point's coordinate, m"): walk.sigma,
        mark("Sigmas are multiplied by"): rectified.sigma_factor,
    }


def _drift(report: Report, before: Trajectory, rectified: Rectified) -> None:
    """Profiles of the corrections over time."""
    time = before.time - before.time[0]
    change = rectified.trajectory.place - before.place
    extrapolated = _extrapolated(rectified, time)
    sets = np.searchsorted(before.time, [item.time for item in rectified.used]).clip(0, len(time) - 1)
    at_sets = np.full((len(time), 2), np.nan)
    at_sets[sets] = change[sets, :2]
    captions = (mark("Correction to the east with its sigma. A set that lies beside the curve's band does not fit the "
                     "others."),
                mark("Correction to the north with its sigma. A set that lies beside the curve's band does not fit the "
                     "others."))
    for axis, name in enumerate((mark("East correction"), mark("North correction"))):
        curve = change[:, axis]
        report.figure(profile(time, [Series(name, curve), Series("sets", at_sets[:, axis], COLOURS[1], True)],
                              "time (s)", "m",
                              (curve, rectified.plan_sigma), extrapolated),
                      captions[axis])
    change_of_heading = rectified.trajectory.angles[:, 2] - before.angles[:, 2]
    report.figure(profile(time, [Series("Heading correction", change_of_heading, COLOURS[2])], "time (s)", "°",
                          (change_of_heading, rectified.heading_sigma), extrapolated),
                  "Correction to the heading with its sigma.")


def _extrapolated(rectified: Rectified, time: np.ndarray) -> list[ShadedInterval]:
    """The parts before the first and after the last set."""
    first, last = rectified.drift.first - rectified.drift.time[0], rectified.drift.last - rectified.drift.time[0]
    name = say("beyond the sets")
    return [ShadedInterval(start, end, "#e09a2b", name) for start, end in ((0.0, first), (last, float(time[-1])))
            if end > start]


def _heights(report: Report, before: Trajectory, heights: CourseHeights) -> None:
    if heights.found:
        report.warning(say("The height of the origin above the ground was not given: the mean height stays as "
                           "reported ({sensor_height:.2f} m above the ground).", sensor_height=heights.sensor_height))
    report.facts({
        "Height of the origin above the ground, m": heights.sensor_height,
        "Samples along the course": heights.samples,
        "left out, they stand out of their neighbours": heights.left_out,
        "Share of the course with a ground": heights.covered,
        "Distance from the ground before, root mean square, m": heights.before,
        "after, m": heights.after,
        "Sigma of a sample, m": heights.sample_sigma,
        "Sigma of the heights, mean, m": float(heights.sigma.mean()),
        "maximum, m": float(heights.sigma.max()),
    })
    time = before.time - before.time[0]
    rows = np.searchsorted(before.time, heights.used_time).clip(0, len(time) - 1)
    samples = np.full(len(time), np.nan)
    samples[rows] = heights.used_error
    report.figure(profile(time, [Series("ground says", samples, COLOURS[4], True), Series("taken", heights.error)],
                          "s", "m", (heights.error, heights.sigma)),
                  "Correction to the height with its sigma, and the samples of the ground.")


def course_map(before: Trajectory, rectified: Rectified) -> str:
    """An SVG plan of the course before and after, with the sets."""
    rows = np.unique(np.linspace(0, len(before) - 1, min(len(before), _MAX_POINTS)).astype(int))
    old, new = before.place[rows, :2], rectified.trajectory.place[rows, :2]
    low, high = np.minimum(old.min(axis=0), new.min(axis=0)), np.maximum(old.max(axis=0), new.max(axis=0))
    span = np.maximum(high - low, 1.0)
    scale = (_WIDTH - 40) / max(span[0], span[1] * 1.3)
    height = int(span[1] * scale) + 60

    def to_picture(xy: np.ndarray) -> np.ndarray:
        return np.column_stack([20 + (xy[:, 0] - low[0]) * scale, 20 + (high[1] - xy[:, 1]) * scale])

    parts = [_line(to_picture(old), "#999", 1.0)]
    status = rectified.status[rows]
    for run in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(status)) + 1):
        parts.append(_line(to_picture(new[run]), COLOURS[0], 1.8, status[run[0]] == EXTRAPOLATED))
    for item in rectified.sets:
        x, y = to_picture(item.place[None, :2])[0]
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{_SET_COLOURS[item.status]}" stroke="#fff"/>'
                     f'<text x="{x + 6:.1f}" y="{y - 5:.1f}">{html.escape(item.name)}</text>')
    longest = (_WIDTH - 40) / 4 / scale
    length = max(step for step in np.outer([1, 2, 5], 10.0 ** np.arange(-3, 7)).ravel() if step <= longest)
    parts.append(f'<path d="M{_WIDTH - 20 - length * scale:.1f} {height - 16}H{_WIDTH - 20}" stroke="#333" '
                 f'stroke-width="3"/><text x="{_WIDTH - 24 - length * scale:.1f}" y="{height - 12}" '
                 f'text-anchor="end">{length:g} m</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDTH}" height="{height}" role="img" '
            f'font-family="sans-serif" font-size="11">{"".join(parts)}</svg>')


def _line(places: np.ndarray, colour: str, width: float, dashed: bool = False) -> str:
    path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
    dash = ' stroke-dasharray="5 4"' if dashed else ""
    return f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width}"{dash}/>'
