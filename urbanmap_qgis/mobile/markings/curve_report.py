"""Page of the range-intensity fit: plot and table of each scanner (J figure 3-10)."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

import numpy as np

from ...geometry.tolerances import ROUNDING
from ...io.pages.report import BAD, GOOD, LOOK, Report
from ...wording import mark, say
from .extraction import Extraction
from .intensity_calibration import IntensityCurve
from .lasers import LaserGains

WIDTH, HEIGHT = 640, 320
_LEFT, _RIGHT, _TOP, _BOTTOM = 60, 14, 14, 42
POOR_RESIDUAL = 0.1
"""Above this share the asphalt does not follow the curve well."""

LARGE_SCATTER = 0.3
"""Above this share of asphalt's intensity single points scatter more than those of survey scanners do."""

LOW_CONTRAST = 1.5


def write_curve_report(path: str | os.PathLike, extraction: Extraction, files: Sequence[str]) -> None:
    """Write the page.

    Parameters
    ----------
    files : names of the survey's files.

    Raises
    ------
    OutputError : it cannot be written there.
    """
    report = Report("Intensity over range")
    doubtful = doubts(extraction)
    report.verdict(BAD if not len(extraction.points) else LOOK if doubtful or extraction.failed else GOOD,
                   say("{points_count:,} marking points on {marked_share:.0f} % of the path. ",
                       points_count=len(extraction.points), marked_share=100 * extraction.marked_share)
                   + (" ".join(doubtful) if doubtful else say(
                       "Their intensities follow the curves of the scanners. Look at them over an aerial image before "
                       "they are matched.")))
    report.paragraph("Asphalt's intensity falls with range and incidence. The curve f(R) = C + A R^-b "
                     "(1 - exp(-(R/d)^2)) is fitted to the asphalt of each scanner; intensities are divided by it up "
                     "to R1, by the smallest value from there to R2, and left out beyond (Javanmardi, eq. 4).")
    _survey(report, extraction, files)
    for number, curve in sorted(extraction.curves.items()):
        report.section(say("Scanner {number}", number=number))
        if number in extraction.lasers:
            _lasers(report, extraction.lasers[number])
        _curve(report, curve, extraction.reference)
    for number, reason in sorted(extraction.failed.items()):
        report.warning(say("Scanner {number} has no curve and its points are left out: {reason}.", number=number,
                           reason=reason))
    report.write(path)


def _survey(report: Report, extraction: Extraction, files: Sequence[str]) -> None:
    """What was read and found."""
    report.section("Survey")
    count = len(extraction.points)
    report.facts({
        "Files": ", ".join(files), "Points read": extraction.read,
        "Outside the trajectory's time": extraction.outside, "Measured while standing (left out)": extraction.standing,
        "Within range of the vehicle": extraction.near, "On the ground": extraction.ground,
        "Ground told by": "classes" if extraction.ground_method == "classes" else "cloth filter",
        "Ground within R2": extraction.in_range, "Marking points": count,
        "Share of marking points among these, %": 100.0 * count / max(extraction.in_range, 1),
        "Contrast of paint to the ground beside it (median)": contrast_of(extraction),
        "Path with markings, %": 100.0 * extraction.marked_share,
        "Scatter of the ground's heights, m": extraction.height_scatter,
        "Reference intensity": extraction.reference})


def contrast_of(extraction: Extraction) -> float:
    """Median intensity of marking points over that of the ground beside them; NaN without any."""
    return float(np.median(extraction.contrast)) if len(extraction.contrast) else float("nan")


def doubts(extraction: Extraction) -> list[str]:
    """Sentences on what should not be trusted."""
    sentences = []
    if not len(extraction.points):
        sentences.append(say("No marking points were found: the road has no paint, or its intensity does not show it."))
    elif contrast_of(extraction) < LOW_CONTRAST:
        sentences.append(say("The marking points are only {contrast_of:.1f} times as bright as the ground beside "
                             "them: look at them before they are used.", contrast_of=contrast_of(extraction)))
    for number, curve in sorted(extraction.curves.items()):
        if curve.residual > POOR_RESIDUAL:
            sentences.append(say("The asphalt of scanner {number} does not follow one curve over range (residual "
                                 "{residual:.0f} %): several surfaces may have been taken together.", number=number,
                                 residual=100 * curve.residual))
        if curve.scatter > LARGE_SCATTER:
            sentences.append(say("Single asphalt points of scanner {number} scatter by {scatter:.0f} %: only strong "
                                 "paint stands out, and bright specks may be taken for paint.", number=number,
                                 scatter=100 * curve.scatter))
    return sentences


def _lasers(report: Report, gains: LaserGains) -> None:
    """What the lasers of a scanner differ by."""
    known = gains.gain[np.isfinite(gains.gain)]
    report.facts({
        "Lasers told apart by": gains.told_by, "Lasers (of the angle: bins of 0.1 degrees) used": gains.used,
        "Left out (no signal or too much scatter)": gains.left_out, "Smallest gain": float(known.min()),
        "Largest gain": float(known.max()), "Scatter on even ground before, %": 100.0 * gains.before,
        "After, %": 100.0 * gains.after})


def _curve(report: Report, curve: IntensityCurve, reference: float) -> None:
    report.figure(curve_svg(curve), "Asphalt's intensity in bins of 0.25 m (dots; grey: not used), the fitted curve as "
                  "it is applied (line), R1 and R2.")
    report.facts({
        "C (floor)": curve.floor, "A (at 1 m)": curve.gain, "b (fall)": curve.fall,
        "d (loss near the scanner), m": curve.near or None, "R1, m": curve.r1, "R2, m": curve.r2,
        "Shortest range, m": curve.nearest, "I_M (largest intensity of asphalt)": float(curve.intensity(curve.nearest)),
        "I_m (smallest)": curve.smallest, mark("I_ref (reference)"): reference,
        "Ground points": int(curve.points.sum()), "Bins used": int(curve.used.sum()),
        "Residual of the bins (robust), %": 100.0 * curve.residual,
        "Scatter of single asphalt points, %": 100.0 * curve.scatter})
    fitted = curve.intensity(curve.ranges)
    rows = [(float(r), int(n), float(i), float(f), 100.0 * float(i / f - 1), bool(used)) for r, n, i, f, used in
            zip(curve.ranges, curve.points, curve.asphalt, fitted, curve.used)]
    report.table(("Range, m", "Ground points", "Asphalt", "Curve", "Difference, %", "Used"), rows[::_every(len(rows))])


def _every(count: int) -> int:
    """Step by which rows are shown, so that a table stays short."""
    return max(count // 40, 1)


def curve_svg(curve: IntensityCurve) -> str:
    """The plot of a curve."""
    r_max = max(float(curve.ranges.max()), curve.r2) * 1.02
    i_max = 1.05 * max(float(curve.asphalt.max()), float(curve.intensity(curve.nearest)))
    width, height = WIDTH - _LEFT - _RIGHT, HEIGHT - _TOP - _BOTTOM

    def to_picture(r: np.ndarray, i: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return _LEFT + np.asarray(r) / r_max * width, _TOP + (1 - np.asarray(i) / i_max) * height

    x, y = to_picture(curve.ranges, curve.asphalt)
    dots = "".join(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2.2" fill="{"#2f6f8f" if used else "#bbbbbb"}"/>'
                   for a, b, used in zip(x, y, curve.used))
    r = np.linspace(curve.nearest, curve.r2, 200)
    line = "L".join(f"{a:.1f} {b:.1f}" for a, b in zip(*to_picture(r, curve.intensity(r))))
    limits = "".join(f'<path d="M{a:.1f} {_TOP}V{HEIGHT - _BOTTOM}" stroke="#777" stroke-dasharray="4 3"/>'
                     f'<text x="{a - 4:.1f}" y="{_TOP + 10}" text-anchor="end">{name}</text>'
                     for name, a in _limits(curve, lambda at: float(to_picture(at, 0)[0])))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" role="img" '
            f'font-family="sans-serif" font-size="11">{dots}<path d="M{line}" fill="none" stroke="#d73027" '
            f'stroke-width="1.6"/>{limits}{_axes(r_max, i_max, to_picture)}</svg>')


def _limits(curve: IntensityCurve, at) -> list[tuple[str, float]]:
    """Names and places of R1 and R2; one where they are the same."""
    if curve.r1 >= curve.r2:
        return [("R1 = R2", at(curve.r2))]
    return [("R1", at(curve.r1)), ("R2", at(curve.r2))]


def _axes(r_max: float, i_max: float, place) -> str:
    """Axes with ticks and labels."""
    bottom, parts = HEIGHT - _BOTTOM, []
    for value in _ticks(r_max):
        x = float(place(value, 0)[0])
        parts.append(f'<path d="M{x:.1f} {bottom}v4" stroke="#444"/>'
                     f'<text x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{value:g}</text>')
    for value in _ticks(i_max):
        y = float(place(0, value)[1])
        parts.append(f'<path d="M{_LEFT} {y:.1f}h-4" stroke="#444"/>'
                     f'<text x="{_LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{value:g}</text>')
    parts.append(f'<path d="M{_LEFT} {_TOP}V{bottom}H{WIDTH - _RIGHT}" fill="none" stroke="#444"/>'
                 f'<text x="{(_LEFT + WIDTH) / 2}" y="{HEIGHT - 6}" text-anchor="middle">{say("Range, m")}</text>'
                 f'<text x="14" y="{HEIGHT / 2}" transform="rotate(-90 14 {HEIGHT / 2})" '
                 f'text-anchor="middle">{say("Intensity")}</text>')
    return "".join(parts)


def _ticks(top: float) -> np.ndarray:
    """About five round values from 0 to `top`."""
    power = 10.0 ** np.floor(np.log10(top / 5))
    step = next(step * power for step in (1, 2, 5, 10) if step * power >= top / 5)
    return np.arange(0.0, top + ROUNDING, step)


def facts_of(extraction: Extraction) -> Mapping[str, float]:
    """Numbers of an extraction for the results of a run."""
    worst = max(extraction.curves.values(), key=lambda curve: curve.residual)
    return {"POINTS_READ": extraction.read, "GROUND_POINTS": extraction.ground,
            "MARKING_POINTS": len(extraction.points),
            "MARKING_SHARE": len(extraction.points) / max(extraction.in_range, 1),
            "PAINT_CONTRAST": contrast_of(extraction),
            "FIT_RESIDUAL": worst.residual, "FIT_SCATTER": worst.scatter, "SCANNERS": len(extraction.curves),
            "FARTHEST_RANGE": max(curve.r2 for curve in extraction.curves.values()),
            "MARKED_WAY": extraction.marked_share, "LEFT_OUT": extraction.outside + extraction.standing}
