"""The report of a registration: what was corrected, how surely, pictures before and after, what to distrust."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import cv2
import numpy as np

from ...io.pages.report import BAD, GOOD, LOOK, Fixed, Report
from ...io.pages.svg_profile import COLOURS, Series, ShadedInterval, profile
from ...io.raster import RasterSampler
from ...wording import known, mark, say
from ..pose_correction import correction_between
from .correction.patch_status import BRIDGED, DISTRUSTED, REGISTERED, STATUS_NAMES
from .disagreement_areas import area_table
from .registered_survey import RegisteredSurvey, middle_and_largest, unregistered_sections
from .start.reference import Reference

_SIDE = 24.0  # m of road that a picture shows
_PIXEL = 0.04  # m
_PICTURES = 4
_MOSTLY = 0.7  # share of the path that is registered where all goes well
_SHADES = {STATUS_NAMES[BRIDGED]: "#e09a2b", STATUS_NAMES[DISTRUSTED]: "#d7263d"}
_BEFORE, _AFTER = (60, 60, 235), (60, 200, 40)  # blue, green, red


def write_registration_report(path: str | os.PathLike, survey: RegisteredSurvey, reference: Reference,
                              image: str | os.PathLike | None = None) -> None:
    """Write the report (HTML).

    Parameters
    ----------
    image : aerial image behind the pictures (1 or 3 bands of 8 or 16 bits); without it the reference markings.
    """
    report = Report("Registration of a mobile survey")
    _verdict(report, survey)
    _distrust(report, survey)
    _steps(report, survey)
    _summary(report, survey)
    _profiles(report, survey)
    _before_and_after(report, survey, reference, image)
    report.write(path)


def _verdict(report: Report, survey: RegisteredSurvey) -> None:
    """What was reached along the path, and whether it can be used."""
    registered, distrusted = survey.share(REGISTERED), survey.share(DISTRUSTED)
    if not registered and survey.correction.steps:
        report.verdict(BAD, say("Reference and survey disagree, and nobody can say from the markings alone which is "
                                "right: no part of the path is registered. Check the reference at the places below."))
        return
    if not registered:
        report.verdict(BAD, "No part of the path is registered: the result is as reported. Check that the reference is "
                       "of the same place, and its date.")
        return
    text = say("{registered:.0f} % of the path is registered. The standard deviation in plan over the whole path is "
               "{sigma:.1f} cm (median).", registered=100 * registered, sigma=100 * survey.plan_accuracy()[0])
    if distrusted:
        text += (say(" {distrusted:.0f} % is not to be trusted: leave it out, or measure it otherwise; the table "
                     "below tells where.", distrusted=100 * distrusted))
    text += " " + say("Look at the markings before and after below: where they lie on the reference, use the result.")
    report.verdict(LOOK if distrusted or registered < _MOSTLY else GOOD, text)


def _summary(report: Report, survey: RegisteredSurvey) -> None:
    correction = survey.correction
    plan = np.hypot(correction.value[:, 0], correction.value[:, 1])
    facts = {mark("Path length (m)"): float(correction.chainage[-1]), mark("Patches"): len(correction),
             mark("Marking points"): len(survey.markings),
             mark("Registered (% of the path)"): 100 * survey.share(REGISTERED),
             mark("Bridged (%)"): 100 * survey.share(BRIDGED),
             mark("Not to be trusted (%)"): 100 * survey.share(DISTRUSTED),
             mark("Correction in plan, mean and maximum (m)"): f"{plan.mean():.3f}, {plan.max():.3f}",
             mark("Standard deviation in plan over the whole path, median and maximum (m)"): _pair(
                 survey.plan_accuracy())}
    if correction.three_d:
        up = correction.value[:, 2]
        facts[mark("Correction in height, mean and maximum (m)")] = (
            f"{up.mean():.3f}, {up[np.argmax(np.abs(up))]:.3f}")
        facts[mark("Standard deviation in height over the whole path, median and maximum (m)")] = _pair(
            middle_and_largest(correction.sigma()[:, 2]))
    if correction.unseen is not None:
        facts[mark("Standard deviation in plan relative to the reference, median and maximum (m)")] = _pair(
            middle_and_largest(correction.relative_sigma()))
        facts[mark("Stated accuracy of the reference in plan (m)")] = correction.reference_sigma
        facts[mark("Steps of the reference are told from, median and maximum along the path (m)")] = _pair(
            (correction.unseen.median, correction.unseen.largest))
    if np.isfinite(correction.drift_factor):
        facts[mark("Drift, times the expected one")] = correction.drift_factor
        facts[mark("Variance of the observations, times the stated one")] = correction.noise_factor
    report.facts(facts)
    if not np.isfinite(correction.drift_factor):
        report.paragraph("Each patch is moved by its own window, as in the paper: between patches there are steps, "
                         "nothing is bridged, and patches that are not to be trusted are moved all the same.")
    report.paragraph("Registered: found from markings around. Bridged: between or beyond registered parts, by how "
                     "trajectories drift. Not to be trusted: too far from them, or markings that contradict. Standard "
                     "deviations are absolute as far as the stated accuracy of the reference is: they include it, and "
                     "steps of the reference too small to be told. What all of the reference is off by no survey "
                     "shows: measure a few control points, and state it.")
    if not correction.three_d:
        report.paragraph("Heights, roll and pitch were not touched.")


def _pair(figures: tuple[float, float]) -> str:
    """Median and maximum, m, where they are known."""
    return f"{figures[0]:.3f}, {figures[1]:.3f}" if np.isfinite(figures[0]) else say("not known")


def _profiles(report: Report, survey: RegisteredSurvey) -> None:
    correction, windows = survey.correction, survey.windows
    shades = [ShadedInterval(item.start, item.end, _SHADES[item.status], item.status)
              for item in unregistered_sections(survey)]
    chainage, sigma = correction.chainage, correction.sigma()
    report.section("Correction along the path")
    names = (mark("east"), mark("north"), mark("up")) if correction.three_d else (mark("east"), mark("north"))
    series = [Series(name, correction.value[:, k], colour) for k, (name, colour) in enumerate(zip(names, COLOURS))]
    report.figure(profile(chainage, series, "chainage (m)", "m", intervals=shades),
                  say("Correction of the reported positions. Look for steps and spikes: a trajectory drifts smoothly, "
                      "and jumps only where its satellites were lost or found again."))
    angles = (mark("roll"), mark("pitch"), mark("heading")) if correction.three_d else (mark("heading"),)
    numbers = (3, 4, 5) if correction.three_d else (5,)
    series = [Series(name, correction.value[:, k], colour) for name, k, colour in zip(angles, numbers, COLOURS)]
    report.figure(profile(chainage, series, "chainage (m)", "degrees", intervals=shades),
                  "Correction of the reported angles")
    series = [Series("plan", correction.plan_sigma(), COLOURS[0])]
    if correction.three_d:
        series.append(Series("height", sigma[:, 2], COLOURS[2]))
    report.figure(profile(chainage, series, "chainage (m)", "m", intervals=shades),
                  say("Standard deviation of the correction. It grows where markings are few or run one way only."))
    off = np.hypot(correction.residual[:, 0], correction.residual[:, 1])
    if np.isfinite(off).any():
        report.figure(profile(chainage, [Series("windows", off, COLOURS[3], dots=True)], "chainage (m)", "m",
                              intervals=shades),
                      say("Distance of each window's own correction from the smooth one, in plan. Windows that stand "
                          "out saw something else than the reference."))
    report.section("Windows")
    report.figure(profile(chainage, [Series("window length", windows.window_length, COLOURS[0])], "chainage (m)", "m"),
                  "Length of the window of each patch: as long as it needs for enough markings")
    report.figure(profile(chainage, [Series("overlap", windows.overlap, COLOURS[0])], "chainage (m)", "share"),
                  say("Share of a window's marking points that lie on reference markings. Where it falls, paint has "
                      "changed or the match is wrong."))


def _distrust(report: Report, survey: RegisteredSurvey) -> None:
    found = unregistered_sections(survey)
    if not found:
        return
    report.section("What to distrust")
    report.table(("From (m)", "to (m)", "from time (s)", "to time (s)", "status", "why", "largest sigma (m)"),
                 [(round(item.start, 1), round(item.end, 1), Fixed.of(item.start_time), Fixed.of(item.end_time),
                   item.status, item.reason, item.sigma) for item in found])


def _steps(report: Report, survey: RegisteredSurvey) -> None:
    """Where reference and survey disagree."""
    steps = survey.correction.steps
    if not steps:
        return
    report.section("Where reference and survey disagree")
    report.paragraph(say("The correction steps here, and a trajectory does not. Between two edges of changed markings "
                         "the road was painted anew: the correction bridges them. Of a single step nobody can say from "
                         "markings alone which side is right: a frame of the reference may be off, or the road beyond "
                         "was painted anew; the standard deviations of both sides hold either."))
    report.table(("At (m)", "time (s)", "kind", "size (m)", "towards (degrees)", "sigma (m)"),
                 [(round(item.place, 1), Fixed.of(item.time), say(item.kind), round(item.size, 3),
                   round(item.direction), round(item.sigma, 3)) for item in steps])
    areas, _ = area_table(survey)
    report.paragraph(say("The road that this concerns, as the layer of areas has it:"))
    report.table(("From (m)", "to (m)", "kind", "size (m)"),
                 [(round(begin, 1), round(end, 1), say(kind), round(size, 3)) for begin, end, kind, size in
                  zip(*(areas[name] for name in ("begin", "end", "kind", "size")))])


def _before_and_after(report: Report, survey: RegisteredSurvey, reference: Reference,
                      image: str | os.PathLike | None) -> None:
    places = _places(survey)
    if not len(places):
        return
    report.section("Markings before and after")
    behind = mark("Marking points of the survey over the aerial image: left as reported (red), right corrected "
                  "(green). A picture is {side:.0f} m wide.") if image else mark(
        "Marking points of the survey over the reference markings: left as reported (red), right corrected (green). A "
        "picture is {side:.0f} m wide.")
    report.paragraph(say(behind, side=_SIDE))
    moved = correction_between(survey.reported, survey.trajectory)
    with tempfile.TemporaryDirectory() as folder:
        for number, patch in enumerate(places):
            picture = _picture(survey, patch, moved, reference, image)
            file = Path(folder) / f"{number}.png"
            file.write_bytes(cv2.imencode(".png", picture)[1].tobytes())
            status = known(STATUS_NAMES[survey.correction.status[patch]])
            report.picture(file, f"{survey.correction.chainage[patch]:.0f} m: {status}")


def _places(survey: RegisteredSurvey) -> np.ndarray:
    """Patches to show: in each quarter of the way the one with the most markings around, and the least sure one."""
    points = survey.windows.points * (survey.windows.overlap > 0)
    if not points.any():
        return np.zeros(0, int)
    parts = np.array_split(np.arange(len(points)), min(_PICTURES, len(points)))
    chosen = [int(part[np.argmax(points[part])]) for part in parts]
    chosen.append(int(np.argmax(survey.correction.plan_sigma())))
    return np.unique(chosen)


def _picture(survey: RegisteredSurvey, patch: int, moved, reference: Reference,
             image: str | os.PathLike | None) -> np.ndarray:
    """Two views side by side (rows, columns, 3) uint8: points of the window before and after over the background."""
    correction, windows, markings = survey.correction, survey.windows, survey.markings
    x, y = (windows.place + correction.value[:, :3])[patch, :2]
    box = (x - _SIDE / 2, y - _SIDE / 2, x + _SIDE / 2, y + _SIDE / 2)
    ground = _background(box, reference, image)
    start, end = correction.time[windows.window_first[patch]], correction.time[windows.window_last[patch]]
    rows = np.flatnonzero((markings.time >= start) & (markings.time <= end)
                          & (np.abs(markings.x - x) < _SIDE) & (np.abs(markings.y - y) < _SIDE))
    points = np.column_stack([markings.x[rows], markings.y[rows], markings.z[rows]])
    views = []
    for places, colour in ((points, _BEFORE), (points + moved.translations(points, markings.time[rows]), _AFTER)):
        view = ground.copy()
        column = ((places[:, 0] - box[0]) / _PIXEL).astype(int)
        row = ((box[3] - places[:, 1]) / _PIXEL).astype(int)
        inside = (column >= 0) & (column < view.shape[1]) & (row >= 0) & (row < view.shape[0])
        view[row[inside], column[inside]] = colour
        views.append(view)
    return np.hstack([views[0], np.full((len(ground), 6, 3), 255, np.uint8), views[1]])


def _background(box: tuple[float, float, float, float], reference: Reference,
                image: str | os.PathLike | None) -> np.ndarray:
    """The aerial image, or the reference's coverage in grey, on the picture's pixels."""
    size = round(_SIDE / _PIXEL)
    if image is None:
        coverage = reference.coverage(*box)
        bands, grid = [255.0 * (0.15 + 0.5 * coverage.share)] * 3, coverage.grid
    else:
        bands, grid = _image_bands(image, box)
    column = (box[0] + (np.arange(size) + 0.5) * _PIXEL - grid.x_min) / grid.cell - 0.5
    row = (grid.y_max - box[3] + (np.arange(size) + 0.5) * _PIXEL) / grid.cell - 0.5
    at = np.meshgrid(column.astype(np.float32), row.astype(np.float32))
    drawn = [cv2.remap(np.nan_to_num(band).astype(np.float32), *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT)
             for band in bands]
    return np.clip(np.dstack(drawn), 0, 255).astype(np.uint8)


def _image_bands(image: str | os.PathLike, box: tuple[float, float, float, float]):
    """Blue, green and red (or three times grey) of a raster around a box, 0 to 255, and their grid."""
    bands = []
    for number in (3, 2, 1):
        with RasterSampler(image) as source:
            number = number if source.bands >= 3 else 1
            rows, columns, grid = source.grid.window(*box)
        with RasterSampler(image, number) as source:
            bands.append(source.read(rows, columns))
    brightest = max((float(np.nanmax(band)) for band in bands if np.isfinite(band).any()), default=255.0)
    return [band * (255.0 / brightest if brightest > 255 else 1.0) for band in bands], grid
