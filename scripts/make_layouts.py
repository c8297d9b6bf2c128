#!/usr/bin/env python3
"""Write the shipped layout of the acceptance report, resources/layouts/acceptance.qpt.

    python3 scripts/make_layouts.py

The file is stored as it is: QGIS writes other ids each time. Needs a Python that sees QGIS.
"""

from __future__ import annotations

import os
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from qgis.core import (
    QgsApplication,
    QgsLayoutFrame,
    QgsLayoutItemLabel,
    QgsLayoutItemManualTable,
    QgsLayoutItemPage,
    QgsLayoutItemPicture,
    QgsLayoutPoint,
    QgsLayoutSize,
    QgsPrintLayout,
    QgsProject,
    QgsReadWriteContext,
    QgsTableCell,
    QgsTextFormat,
)
from qgis.PyQt.QtGui import QFont

TARGET = Path(__file__).resolve().parent.parent / "resources" / "layouts" / "acceptance.qpt"

LEFT, WIDTH = 15.0, 180.0  # mm on A4
MARGIN = 0.8  # mm in the cells of tables
TITLE, TEXT, SMALL = 15, 10, 8  # points

LABELS = (("title", 0, 15, 10, TITLE), ("verdict", 0, 26, 14, TEXT), ("figures_title", 0, 150, 6, TEXT),
          ("points_title", 1, 120, 6, TEXT))
"""Id, page, distance from its top and height (mm), size of the letters (points)."""

TABLES = (("job", 0, 42, 80, (60.0, 120.0)), ("criteria", 0, 126, 20, (44.0, 20.0, 34.0, 24.0, 32.0, 26.0)),
          ("figures", 0, 158, 30, (50.0, 20.0, 25.0, 25.0, 35.0, 25.0)),
          ("points", 1, 128, 150, (21.0, 21.0, 24.0, 26.0, 20.0, 17.0, 17.0, 17.0, 17.0)))
"""Id, page, distance from its top, height, widths of the columns (mm)."""

PICTURES = (("histogram_plan", 0, LEFT, 192, WIDTH, 46), ("histogram_height", 0, LEFT, 240, WIDTH, 46),
            ("map", 1, LEFT, 15, WIDTH, 100))
"""Id, page, left and upper edge, width and height (mm)."""


def main() -> None:
    """Write the layout."""
    application = QgsApplication([], False)
    application.initQgis()
    project = QgsProject()
    layout = QgsPrintLayout(project)
    project.layoutManager().addLayout(layout)
    layout.setName("acceptance")
    for _ in range(2):
        page = QgsLayoutItemPage(layout)
        page.setPageSize("A4", QgsLayoutItemPage.Orientation.Portrait)
        layout.pageCollection().addPage(page)
    for name, page, y, height, size in LABELS:
        label = QgsLayoutItemLabel(layout)
        label.setText(name)
        label.setFont(font(size, bold=True))
        put(layout, label, name, page, LEFT, y, WIDTH, height)
    for name, page, y, height, widths in TABLES:
        add_table(layout, name, page, y, height, widths)
    for name, page, x, y, width, height in PICTURES:
        picture = QgsLayoutItemPicture(layout)
        picture.setResizeMode(picture.Zoom)
        put(layout, picture, name, page, x, y, width, height)
    TARGET.parent.mkdir(exist_ok=True)
    layout.saveAsTemplate(str(TARGET), QgsReadWriteContext())
    print(TARGET.name)
    os._exit(0)  # QGIS 3.22 does not end well with a layout that Python holds


def add_table(layout, name: str, page: int, y: float, height: float, widths: tuple[float, ...]) -> None:
    """A table that goes on over pages where it must."""
    table = QgsLayoutItemManualTable.create(layout)
    layout.addMultiFrame(table)
    table.setContentTextFormat(QgsTextFormat.fromQFont(font(SMALL)))
    table.setWrapBehavior(table.WrapText)
    table.setGridStrokeWidth(0.1)
    table.setCellMargin(MARGIN)
    table.setTableContents([[QgsTableCell("") for _ in widths]])
    table.setColumnWidths([width - 2 * MARGIN for width in widths])
    if name == "points":
        table.setResizeMode(table.ExtendToNextPage)
    frame = QgsLayoutFrame(layout, table)
    table.addFrame(frame)
    place(frame, name, page, LEFT, y, WIDTH, height)


def put(layout, item, *where) -> None:
    """Add an item at its place."""
    layout.addLayoutItem(item)
    place(item, *where)


def place(item, name: str, page: int, x: float, y: float, width: float, height: float) -> None:
    """Give an item its id, page and place."""
    item.setId(name)
    item.attemptMove(QgsLayoutPoint(x, y), True, False, page)
    item.attemptResize(QgsLayoutSize(width, height))


def font(size: int, bold: bool = False) -> QFont:
    """Letters without serifs."""
    made = QFont("sans-serif", size)
    made.setBold(bold)
    return made


if __name__ == "__main__":
    main()
