"""Table and report of buildings that were found in points."""

from __future__ import annotations

import os
from collections import Counter

import numpy as np

from ...io.pages.report import BAD, GOOD, LOOK, Report
from ...wording import say
from .detected_outline import OK
from .detection_stage import DetectedBuildings

ROWS = 50


def detected_columns(found: DetectedBuildings) -> dict[str, list]:
    """Columns of the layer of outlines."""
    names = ("area", "height", "ground", "points", "density", "sigma", "confidence", "status", "reason")
    return {"building_id": list(range(1, len(found.buildings) + 1)),
            **{name: [getattr(building, name) for building in found.buildings] for name in names}}


def write_detection_report(path: str | os.PathLike, found: DetectedBuildings) -> None:
    """Write the report (HTML)."""
    report = Report("Building outlines")
    good = [building for building in found.buildings if building.status == OK]
    others = [(row, building) for row, building in enumerate(found.buildings, 1) if building.status != OK]
    text = say("{count} buildings were found.", count=len(good))
    if others:
        text += " " + say("{count} outlines may be no buildings; the table tells why.", count=len(others))
    report.verdict(BAD if not good else LOOK if others else GOOD, text)
    if others:
        report.section("What may be no building")
        report.table(("building", "status", "reason"),
                     [(row, building.status, building.reason) for row, building in others[:ROWS]])
    report.section("Result")
    report.facts({
        "Roofs were told by": found.told_by, "Roof points a m2": found.density,
        "Area of the buildings (m2)": float(sum(building.area for building in good)),
        "Median sigma of the edges (m)": float(np.median([building.sigma for building in good])) if good else None,
        "Groups of points below the least area": found.too_small,
        "Outlines left out as crowns": found.crowns})
    report.table(("status", "number"), sorted(Counter(building.status for building in found.buildings).items()))
    report.write(path)
