"""The acceptance report as pages of A4, laid out and printed by QGIS."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from qgis.core import (
    QgsLayoutExporter,
    QgsLayoutFrame,
    QgsLayoutItemLabel,
    QgsLayoutItemManualTable,
    QgsLayoutItemPage,
    QgsLayoutItemPicture,
    QgsLayoutPoint,
    QgsLayoutSize,
    QgsPrintLayout,
    QgsProject,
    QgsTableCell,
    QgsTextFormat,
)
from qgis.PyQt.QtGui import QFont

from ...urbanmap_qgis.errors import OutputError

LEFT, WIDTH = 15.0, 180.0  # mm on A4
PAGE = 282.0  # mm down to which a page is used
MARGIN, LINE, LETTER = 0.8, 3.3, 1.7  # mm in tables: margin of a cell, height of a line, mean width of a letter
TITLE, TEXT, SMALL = 15, 10, 8  # points

_OF_THE_MOMENT = (
    (re.compile(rb"(/(?:CreationDate|ModDate) \(D:\d{8})\d{6}"), rb"\g<1>000000"),
    (re.compile(rb'(xmp:\w+Date="\d{4}-\d\d-\d\dT)\d\d:\d\d:\d\d'), rb"\g<1>00:00:00"),
    (re.compile(rb"uuid:[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}"), b"uuid:00000000-0000-0000-0000-000000000000"),
)
"""What a PDF says of the moment it was made, and what stands there instead: the same report has the same bytes."""


def write_acceptance_pdf(path: Path, points, found, limits, job, level) -> None:
    """Write the report as PDF; `points`, `found`, `limits`, `job`, `level` as for the core's page.

    Raises
    ------
    OutputError : QGIS cannot write the file.
    """
    from ...urbanmap_qgis.acceptance import acceptance_report as texts
    from ...urbanmap_qgis.wording import known, say

    project = QgsProject()
    about = project.metadata()
    about.setAuthor(job.surveyor)  # not the name under which somebody is logged in
    project.setMetadata(about)
    layout = QgsPrintLayout(project)
    layout.setName("acceptance")
    project.layoutManager().addLayout(layout)  # owned by the project, which ends it before itself
    layout.initializeDefaults()
    layout.pageCollection().page(0).setPageSize("A4", QgsLayoutItemPage.Orientation.Portrait)
    _label(layout, known("Acceptance: errors at check points"), 15, 10, TITLE, bold=True)
    _label(layout, texts.verdict(points, found, level)[1], 26, 16, TEXT, bold=True)
    below = _table(layout, [[name, value] for name, value in job.rows().items()], 44, (60.0, 120.0))
    rows = [[known(name) for name in texts.CRITERIA_HEAD]] + [
        [" ".join(part for part in (item.unit, known(item.component)) if part), str(item.figures.count),
         f"{item.figures.rmse:.3f}", f"{item.limit:.3f}", f"{item.figures.bound:.3f}",
         known(texts.OUTCOMES[item.outcome])] for item in found]
    below = _table(layout, rows, below + 6, (44.0, 20.0, 34.0, 24.0, 32.0, 26.0))
    with TemporaryDirectory() as folder:
        svg = texts.error_map(points, limits)
        if svg:
            drawing = Path(folder) / "errors.svg"
            drawing.write_text(svg, encoding="utf-8")
            _picture(layout, drawing, below + 6)
        _new_page(layout)
        _label(layout, known("All check points"), 15, 8, TEXT, bold=True, page=1)
        head = [known(name) for name in texts.point_head()]
        body = [[*row[:2], *("–" if value != value else f"{value:.3f}" for value in row[2:])]
                for row in texts.point_rows(points)]
        _table(layout, [head, *body], 25, (22.0, 18.0, 26.0, 28.0, 18.0, 17.0, 17.0, 17.0, 17.0), page=1)
        settings = QgsLayoutExporter.PdfExportSettings()
        result = QgsLayoutExporter(layout).exportToPdf(str(path), settings)
    if result != QgsLayoutExporter.ExportResult.Success:
        raise OutputError(say("{path} cannot be printed: choose another output.", path=path.name))
    data = path.read_bytes()
    for pattern, instead in _OF_THE_MOMENT:
        data = pattern.sub(instead, data)
    path.write_bytes(data)


def _new_page(layout) -> None:
    """One more page of A4."""
    page = QgsLayoutItemPage(layout)
    page.setPageSize("A4", QgsLayoutItemPage.Orientation.Portrait)
    layout.pageCollection().addPage(page)


def _label(layout, text: str, y: float, height: float, size: int, bold: bool = False, page: int = 0) -> None:
    """A text over the page's width, mm from the top of a page."""
    label = QgsLayoutItemLabel(layout)
    label.setText(text)
    label.setFont(_font(size, bold))
    layout.addLayoutItem(label)
    label.attemptMove(QgsLayoutPoint(LEFT, y), True, False, page)
    label.attemptResize(QgsLayoutSize(WIDTH, height))


def _font(size: int, bold: bool = False) -> QFont:
    font = QFont("sans-serif", size)
    font.setBold(bold)
    return font


def _table(layout, rows: Sequence[Sequence[str]], y: float, widths: Sequence[float], page: int = 0) -> float:
    """A table of texts, columns of `widths` (mm) with their margins, over as many pages as it needs.

    Returns its lower edge on the page where it begins, mm.
    """
    table = QgsLayoutItemManualTable.create(layout)
    layout.addMultiFrame(table)
    table.setContentTextFormat(QgsTextFormat.fromQFont(_font(SMALL)))
    table.setWrapBehavior(table.WrapText)
    table.setGridStrokeWidth(0.1)
    table.setCellMargin(MARGIN)
    table.setTableContents([[QgsTableCell(text) for text in row] for row in rows])
    table.setColumnWidths([width - 2 * MARGIN for width in widths])
    frame = QgsLayoutFrame(layout, table)
    frame.attemptMove(QgsLayoutPoint(LEFT, y), True, False, page)
    height = sum(max(_lines(text, width) for text, width in zip(row, widths)) * LINE + 2 * MARGIN for row in rows)
    frame.attemptResize(QgsLayoutSize(WIDTH, min(height, PAGE - y)))
    table.addFrame(frame)
    if height > PAGE - y:
        table.setResizeMode(table.ExtendToNextPage)
    return min(y + height, PAGE)


def _lines(text: str, width: float) -> int:
    """About how many lines a text takes in a column of `width` mm; Japanese letters are twice as wide."""
    letters = sum(2 if unicodedata.east_asian_width(letter) in "WF" else 1 for letter in text)
    return max(1, math.ceil(letters * LETTER / (width - 2 * MARGIN)))


def _picture(layout, path: Path, y: float) -> None:
    """A drawing that keeps its shape, on what is left of the first page."""
    picture = QgsLayoutItemPicture(layout)
    picture.setPicturePath(str(path))
    picture.setResizeMode(picture.Zoom)
    layout.addLayoutItem(picture)
    picture.attemptMove(QgsLayoutPoint(LEFT, y), True, False, -1)
    picture.attemptResize(QgsLayoutSize(WIDTH, max(PAGE - y, 60.0)))
