"""The report of a calibration: what was corrected, how surely, and what the drives do not determine."""

from __future__ import annotations

import os

from ...io.pages.report import BAD, GOOD, LOOK, Report
from ...wording import say
from .stage import CalibratedScanners


def write_boresight_report(path: str | os.PathLike, calibrated: CalibratedScanners) -> None:
    """Write the report (HTML)."""
    found, report = calibrated.boresights, Report("Calibration of scanners")
    determined, total = int(found.determined.sum()), found.determined.size
    text = say("{determined} of {total} values are determined and corrected; the others keep the values of the file.",
               determined=determined, total=total)
    text += " " + say("Planes seen twice lie {before:.1f} mm apart before and {after:.1f} mm after.",
                      before=1000 * found.rms_before, after=1000 * found.rms_after)
    if determined < total:
        text += " " + say("Drives in both directions and past walls at several angles determine more.")
    report.verdict(GOOD if determined == total else LOOK if determined else BAD, text)
    report.facts({"Pairs of planes": found.pairs, "Passes": calibrated.passes,
                  "Distance between planes before, RMS (mm)": 1000 * found.rms_before,
                  "Distance between planes after, RMS (mm)": 1000 * found.rms_after,
                  "Passes apart, RMS (m)": found.place_rms})
    report.section("Corrections")
    report.table(("Scanner", "value", "unit", "correction", "standard deviation", "status"), calibrated.rows())
    report.paragraph("Lever arms in metres forward, right and down; angles in degrees about the body's axes. A "
                     "misalignment of the inertial unit that all passes have in common is part of the angles.")
    report.write(path)
