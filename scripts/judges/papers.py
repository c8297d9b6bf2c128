"""The papers' tables and figures on a sample city, beside the papers' own, as one HTML page.

The reference markings are made by “Road markings from aerial frames”: MARKINGS is their mask, POLYGONS (GeoPackage) are
for virtual control points, GROUND a raster of heights. A section is a function that takes the inputs and returns
tables; `SECTIONS` lists them in the order of the page.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import shapely

from scripts.bench_table import Table
from scripts.judges.chains import building_tables, line_tables, wall_tables
from scripts.judges.registration import Evaluation, read_surveys
from scripts.layers import plans_of
from scripts.make_paper_page import references
from urbanmap_qgis.io.pages.report import Report
from urbanmap_qgis.mobile.registration.start.reference import Reference


@dataclass(frozen=True)
class Inputs:
    """Where the data lie.

    Attributes
    ----------
    city : folder of a sample city. markings, ground : rasters of the aerial reference. polygons : its markings.
    trials : from each initial error. landmarks : every so many-th control point is a landmark.
    """

    city: Path
    markings: Path | None
    ground: Path | None
    polygons: Path | None
    trials: int
    landmarks: int


def registration(inputs: Inputs) -> list[Table]:
    """J 3.3 and 4.3: tables 3-3 to 3-7 and 4-1, figures 3-29 and 3-30, stability."""
    if inputs.markings is None:
        raise SystemExit("The registration needs --markings: make them with “Road markings from aerial frames”.")
    polygons = shapely.get_parts(plans_of(inputs.polygons)) if inputs.polygons else None
    evaluation = Evaluation(read_surveys(inputs.city, (), None, inputs.landmarks),
                            Reference.from_mask(inputs.markings, inputs.ground), inputs.trials, polygons)
    for part in (evaluation.methods, evaluation.sensitivity, evaluation.agreement, evaluation.heights,
                 evaluation.start_errors):
        part()
    return evaluation.tables


SECTIONS: tuple[tuple[str, str, Callable[[Inputs], list[Table]]], ...] = (
    ("registration", "J 3.3 and 4.3: registration", registration),
    ("buildings", "J 5.3: building models", lambda inputs: building_tables(inputs.city)),
    ("walls", "J 5.6: walls by GNSS reflections", lambda inputs: wall_tables(inputs.city)),
    ("lines", "Z 3: rectified trajectory", lambda inputs: line_tables(inputs.city)),
)
"""Key, heading and function of each section."""


def judge(city: Path, output: Path, markings: Path | None = None, ground: Path | None = None,
          polygons: Path | None = None, trials: int = 8, landmarks: int = 15,
          sections: tuple[str, ...] = tuple(key for key, _, _ in SECTIONS)) -> None:
    """Make the page."""
    inputs = Inputs(city, markings, ground, polygons, trials, landmarks)
    report = Report("The papers' tables and figures")
    report.paragraph(f"J is {references()['J'][1].replace('*', '')}. Rows and columns that begin with J are its "
                     "own figures, on its own surveys in Tokyo; all others are measured on the sample city given.")
    for key, heading, work in SECTIONS:
        if key not in sections:
            continue
        start = time.monotonic()
        tables = work(inputs)
        report.section(heading)
        for table in tables:
            report.paragraph(table.title)
            report.table(table.header, [[f"{value:.3f}" if isinstance(value, float) else value for value in row]
                                        for row in table.rows])
            if table.note:
                report.paragraph(table.note)
        report.paragraph(f"Made in {time.monotonic() - start:.0f} s.")
    report.write(output)
