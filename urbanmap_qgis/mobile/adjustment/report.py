"""The report of a network of drives: what agrees, what is placed, how sure, and what to distrust."""

from __future__ import annotations

import os

import numpy as np

from ...io.pages.report import GOOD, LOOK, WORST, Report
from ...io.pages.svg_profile import COLOURS, Series, profile
from ...wording import known, mark, say
from .network import KINDS, plan_residuals
from .records import STATUS_NAMES, AdjustedDrive, AdjustedSurvey


def write_network_report(path: str | os.PathLike, survey: AdjustedSurvey) -> None:
    """Write the report (HTML)."""
    report = Report("Adjustment of several drives")
    _verdict(report, survey)
    _worst(report, survey)
    report.section("Residuals by kind")
    report.table(("Observation", "number", "without weight", "RMS in plan (m)", "largest in plan (m)",
                  "RMS in height (m)", "largest in height (m)"), survey.residual_rows())
    report.section("Drives")
    report.table(("Drive", "path length (m)", "mean correction in plan (m)", "median sigma in plan (m)",
                  "largest sigma in plan (m)", *(f"{known(name)} (%)" for name in STATUS_NAMES)),
                 [_drive_row(drive) for drive in survey.drives])
    report.section("Witnesses")
    report.table(("Drive", *(f"{known(name)} (%)" for name in KINDS)),
                 [(drive.name, *(100.0 * share for share in survey.witness_shares(number)))
                  for number, drive in enumerate(survey.drives)])
    report.paragraph("Share that each kind of observation has in what is known of a drive in plan. Ties and planes lay "
                     "drives on each other; control points, reference markings and walls place them.")
    for drive in survey.drives:
        _profiles(report, drive)
    report.write(path)


def _verdict(report: Report, survey: AdjustedSurvey) -> None:
    if survey.relative:
        report.verdict(LOOK, "The drives agree with each other, but nothing fixes their place: give control points, "
                       "reference markings or buildings, or use the result only for comparing drives.")
    else:
        sigma = np.concatenate([drive.plan_sigma() for drive in survey.drives])
        report.verdict(GOOD, say("The drives are placed with a standard deviation of {sigma:.1f} cm in plan (median; "
                                 "largest {max:.0f} cm).", sigma=100 * np.median(sigma), max=100 * sigma.max()))
    for drive in survey.drives:
        if (drive.status == STATUS_NAMES.index("not tied")).all():
            report.warning(say("{drive} shares no markings with other drives, control or reference: it stays as "
                               "reported.", drive=drive.name))


def _drive_row(drive: AdjustedDrive) -> tuple:
    plan, sigma = np.hypot(*drive.correction[:, :2].T), drive.plan_sigma()
    shares = (100.0 * float(np.mean(drive.status == number)) for number in range(len(STATUS_NAMES)))
    return (drive.name, float(drive.chainage[-1] - drive.chainage[0]), float(plan.mean()), float(np.median(sigma)),
            float(sigma.max()), *shares)


def _worst(report: Report, survey: AdjustedSurvey) -> None:
    seen, network = survey.observations, survey.network
    plan = plan_residuals(seen, network.residual)
    worst = np.argsort(-plan)[:WORST]
    report.section("Largest residuals")
    names = [drive.name for drive in survey.drives]
    report.table(("Observation", "drive", "chainage (m)", "other drive", "in plan (m)", "in height (m)", "weight"),
                 [(KINDS[seen.kind[k]], names[seen.drive[k]], float(seen.parameter[k]),
                   names[seen.other[k]] if seen.other[k] >= 0 else "", float(plan[k]),
                   float(network.residual[k, 2]), float(network.weight[k])) for k in worst])


def _profiles(report: Report, drive: AdjustedDrive) -> None:
    report.section(drive.name)
    curves = [Series(name, drive.correction[:, k], colour)
              for k, (name, colour) in enumerate(zip((mark("east"), mark("north"), mark("up")), COLOURS))]
    report.figure(profile(drive.chainage, curves, "chainage (m)", "m"),
                  say("Correction along the path. Look for steps that no loss of satellites explains."))
    sigma = np.sqrt(drive.covariance[:, 2, 2])
    report.figure(profile(drive.chainage, [Series("plan", drive.plan_sigma(), COLOURS[0]),
                                           Series("height", sigma, COLOURS[2])], "chainage (m)", "m"),
                  say("Standard deviation of the correction. It grows away from ties and control."))
