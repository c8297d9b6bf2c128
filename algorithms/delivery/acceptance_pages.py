"""The acceptance report as pages of A4: a layout of QGIS, shipped or the office's own, filled in and printed."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from qgis.core import (
    QgsLayoutExporter,
    QgsLayoutFrame,
    QgsLayoutItemPage,
    QgsLayoutPoint,
    QgsLayoutSize,
    QgsLayoutTableColumn,
    QgsLayoutUtils,
    QgsPrintLayout,
    QgsProject,
    QgsReadWriteContext,
    QgsRenderContext,
    QgsTableCell,
    QgsTextRenderer,
)
from qgis.PyQt.QtXml import QDomDocument

from ...urbanmap_qgis.errors import InputError, OutputError
from ..framework.declaring.parameters import tr

LAYOUT = Path(__file__).resolve().parents[2] / "resources" / "layouts" / "acceptance.qpt"
LINE, LETTER = 0.345, 0.21  # height of a line and mean width of a letter, mm a point of the letters' size
BOLD = 1.1  # times as wide
SPARE = 5.0  # mm
LEAST = 40.0  # mm that a picture keeps
LEAST_MAP, LEAST_PAGE = 70.0, 110.0  # mm that a map needs below a table, and has on a page of its own

_OF_THE_MOMENT = (
    (re.compile(rb"(/(?:CreationDate|ModDate) \(D:\d{8})\d{6}"), rb"\g<1>000000"),
    (re.compile(rb'(xmp:\w+Date="\d{4}-\d\d-\d\dT)\d\d:\d\d:\d\d'), rb"\g<1>00:00:00"),
    (re.compile(rb"uuid:[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}"), b"uuid:00000000-0000-0000-0000-000000000000"),
)
"""What a PDF says of the moment it was made, and what stands there instead: the same report has the same bytes."""


def write_acceptance_pdf(path: Path, content, job, template: Path | None = None) -> None:
    """Write the report as PDF: the core's `PdfContent`, and its `Job`.

    Items of the layout are filled by their ids (`LAYOUT` has all); those that a template has not are left out, and what
    else it has stays. Tables are made as high as they need, and what stands below them moves.

    Raises
    ------
    InputError : the template is no layout of QGIS, or has none of the items.
    OutputError : QGIS cannot write the file.
    """
    from ...urbanmap_qgis.wording import known, say

    project = QgsProject()
    about = project.metadata()
    about.setAuthor(job.surveyor)  # not the name under which somebody is logged in
    project.setMetadata(about)
    layout = QgsPrintLayout(project)
    layout.setName("acceptance")
    project.layoutManager().addLayout(layout)  # owned by the project, which ends it before itself
    _load(layout, template or LAYOUT)
    _fill_labels(layout, content.labels)
    tables = {"job": [[known(name), value] for name, value in job.rows().items()], **content.tables}
    long = [name for name in tables if _goes_on(layout, name)]
    for name in [*(name for name in tables if name not in long), *long]:
        if name in long:
            _put_map_to_the_figures(layout, content.drawings)
        _fill_table(layout, name, tables[name], content.map_shape)
    with TemporaryDirectory() as folder:
        _fill_pictures(layout, content.drawings, Path(folder))
        settings = QgsLayoutExporter.PdfExportSettings()
        settings.textRenderFormat = QgsRenderContext.TextFormatAlwaysText  # it can be searched
        result = QgsLayoutExporter(layout).exportToPdf(str(path), settings)
    if result != QgsLayoutExporter.ExportResult.Success:
        raise OutputError(say("{path} cannot be printed: choose another output.", path=path.name))
    data = path.read_bytes()
    for pattern, instead in _OF_THE_MOMENT:
        data = pattern.sub(instead, data)
    path.write_bytes(data)


def _load(layout, template: Path) -> None:
    """Take the items of a template into an empty layout."""
    document = QDomDocument()
    try:
        understood = document.setContent(template.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError):
        understood = False
    accepted = bool(understood) and layout.loadFromTemplate(document, QgsReadWriteContext(), True)[1]
    ids = ("title", "verdict", "job", "criteria", "map", "points")
    if not accepted or not any(layout.itemById(name) for name in ids):
        raise InputError(tr("{0} is no layout for this report: change a copy of the plugin's own, and keep the ids of "
                            "its items ({1}).").format(template.name, ", ".join(ids)))


def _fill_labels(layout, labels: Mapping[str, str]) -> None:
    """Put the texts into their labels; one that needs more lines than it has room for moves what stands below."""
    for name, text in labels.items():
        item = layout.itemById(name)
        if item is None or not hasattr(item, "setText"):
            continue
        item.setText(text)
        size, letters = item.sizeWithUnits(), item.font().pointSizeF()
        more = _lines(text, size.width(), LETTER * BOLD * letters) * LINE * letters + 1.0 - size.height()
        if more > 0.0:
            lower = item.pagePos().y() + size.height()
            item.attemptResize(QgsLayoutSize(size.width(), size.height() + more))
            _move_below(layout, item.page(), lower, more)


def _table(layout, name: str):
    """The table of an id and its first frame; None for both where the layout has none."""
    frame = layout.itemById(name)
    table = frame.multiFrame() if frame is not None and hasattr(frame, "multiFrame") else None
    return (table, frame) if hasattr(table, "setTableContents") else (None, None)


def _goes_on(layout, name: str) -> bool:
    """Whether a table may go on over pages."""
    table, _ = _table(layout, name)
    return table is not None and table.resizeMode() == table.ExtendToNextPage


def _fill_table(layout, name: str, rows: list[list[str]], map_shape: float) -> None:
    """Put rows into a table, which is made as high as it needs, and move what stands below; a map below is as high as
    its shape (height by width) asks for."""
    table, frame = _table(layout, name)
    if table is None:
        return
    goes_on = _goes_on(layout, name)
    table.setResizeMode(table.UseExistingFrames)
    frame.setVisibility(bool(rows))
    if rows and len(rows[0]) < len(table.columnWidths()):
        table.setColumnWidths([sum(table.columnWidths()) / len(rows[0])] * len(rows[0]))
    heights = _row_heights(layout, table, rows)
    if goes_on and rows:
        _repeat_head(table, rows[0])
    table.setTableContents([[QgsTableCell(text) for text in row] for row in (rows[1:] if goes_on else rows)])
    size, place, page = frame.sizeWithUnits(), frame.pagePos(), frame.page()
    lower = place.y() + size.height()
    if goes_on:
        _put_map_behind(layout, table, frame, lower, _go_on(layout, table, frame, heights), map_shape)
        return
    room = layout.pageCollection().page(page).pageSize().height() - place.y() - place.x()
    needed = sum(heights) + (SPARE if rows else 0.0)  # a row without room would not be drawn
    frame.attemptResize(QgsLayoutSize(size.width(), min(needed, room)))
    _move_below(layout, page, lower, min(needed, room) - size.height())


def _repeat_head(table, words: Sequence[str]) -> None:
    """Give every page of a table the same head; a template that has one of its own keeps its letters."""
    if not table.includeTableHeader():
        letters = table.contentTextFormat()
        font = letters.font()
        font.setBold(True)
        letters.setFont(font)
        table.setHeaderTextFormat(letters)
        table.setIncludeTableHeader(True)
    table.setHeaders([QgsLayoutTableColumn(text) for text in words])
    table.setHeaderMode(table.AllFrames)


def _put_map_to_the_figures(layout, drawings: Mapping) -> None:
    """Where nothing is known of how errors are spread, let the map take the place of the histograms."""
    item, places = layout.itemById("map"), [layout.itemById(name) for name in ("histogram_plan", "histogram_height")]
    if item is None or not drawings.get("map") or any(map(drawings.get, ("histogram_plan", "histogram_height"))):
        return
    places = [one for one in places if one is not None]
    if not places:
        return
    page = places[0].page()
    bottom = layout.pageCollection().page(page).pageSize().height() - places[0].pagePos().x()
    top = min(one.pagePos().y() for one in places)
    item.attemptMove(QgsLayoutPoint(item.pagePos().x(), top), True, False, page)
    item.attemptResize(QgsLayoutSize(item.sizeWithUnits().width(), bottom - top))


def _go_on(layout, table, first, heights: Sequence[float]) -> float:
    """Share the rows of a table (`heights` in mm, the head's first) among its frame and as many more pages as it needs,
    each with the first one's margin and the head; how far down the last of them the table reaches, mm.

    (By itself QGIS lets a table go on at the very edge of the page.)
    """
    pages = layout.pageCollection()
    like, left, width = pages.page(first.page()), first.pagePos().x(), first.sizeWithUnits().width()
    bottom = like.pageSize().height() - left
    frame, top, reached = first, first.pagePos().y(), first.pagePos().y() + sum(heights[:1])
    for row, height in enumerate(heights[1:]):
        if row and reached + height > bottom:
            frame.attemptResize(QgsLayoutSize(width, reached - top + heights[0] / 2))
            page = QgsLayoutItemPage(layout)
            page.attemptResize(like.sizeWithUnits())
            pages.addPage(page)
            frame, top, reached = QgsLayoutFrame(layout, table), left, left + heights[0]
            frame.attemptMove(QgsLayoutPoint(left, top), True, False, pages.pageCount() - 1)
            table.addFrame(frame)
        reached += height
    # Half a row more than they need: none is left out for a tenth of a millimetre, and no other has room.
    frame.attemptResize(QgsLayoutSize(width, reached - top + sum(heights[:1]) / 2))
    return reached


def _put_map_behind(layout, table, first, lower: float, reached: float, shape: float) -> None:
    """Put a map that stands below a table in the template onto the page on which the table ends, or one of its own.

    `lower`: where the table ended in the template; `reached`: where it ends now, mm. The map is as high as its `shape`
    asks for, if there is room for that.
    """
    item = layout.itemById("map")
    if item is None or item.page() != first.page() or item.pagePos().y() < lower - 0.5:
        return
    pages, left = layout.pageCollection(), first.pagePos().x()
    page = table.frame(table.frameCount() - 1).page()
    size, bottom = item.sizeWithUnits(), pages.page(page).pageSize().height() - left
    top, wanted = reached + SPARE, max(shape * size.width(), LEAST_MAP)
    if bottom - top < LEAST_MAP:
        added = QgsLayoutItemPage(layout)
        added.attemptResize(pages.page(page).sizeWithUnits())
        pages.addPage(added)
        page, top, wanted = pages.pageCount() - 1, left, max(wanted, LEAST_PAGE)
    item.attemptMove(QgsLayoutPoint(item.pagePos().x(), top), True, False, page)
    item.attemptResize(QgsLayoutSize(size.width(), min(bottom - top, wanted)))


def _row_heights(layout, table, rows: Sequence[Sequence[str]]) -> list[float]:
    """How high each row of a table is, mm."""
    context = QgsLayoutUtils.createRenderContextForLayout(layout, None)
    letters, unit = table.contentTextFormat(), context.scaleFactor()
    line = LINE * letters.size()
    room = [width * unit for width in table.columnWidths()]

    def lines(text: str, width: float) -> int:
        """Lines of a text, broken between words as QGIS does."""
        count, filled = 1, ""
        for word in text.split(" "):
            longer = f"{filled} {word}" if filled else word
            if filled and QgsTextRenderer.textWidth(context, letters, [longer]) > width:
                count, filled = count + 1, word
            else:
                filled = longer
        return count

    return [max(map(lines, row, room)) * line + 2 * table.cellMargin() + table.gridStrokeWidth() for row in rows]


def _lines(text: str, width: float, letter: float) -> int:
    """About how many lines a text takes in a column of `width` mm; Japanese letters are twice as wide."""
    letters = sum(2 if unicodedata.east_asian_width(one) in "WF" else 1 for one in text)
    return max(1, math.ceil(letters * letter / width))


def _move_below(layout, page: int, lower: float, by: float) -> None:
    """Move the items of a page that begin below a height, mm; pictures give or take the room at the foot."""
    for item in layout.items():
        if not hasattr(item, "pagePos") or not hasattr(item, "attemptMove") or item.page() != page:
            continue
        place = item.pagePos()
        if place.y() < lower - 0.5 or place.y() <= 0.0:
            continue
        item.attemptMove(QgsLayoutPoint(place.x(), place.y() + by), True, False, page)
        size = item.sizeWithUnits()
        if item.id() == "map":
            item.attemptResize(QgsLayoutSize(size.width(), max(size.height() - by, LEAST)))
        elif item.id().startswith("histogram") and by > 0.0:
            item.attemptResize(QgsLayoutSize(size.width(), max(size.height() - by, LEAST / 2)))


def _fill_pictures(layout, drawings: Mapping, folder: Path) -> None:
    """Show drawings by id, each in the shape of its item; an item without one goes."""
    from ...urbanmap_qgis.acceptance.pdf_content import PIXELS

    for name, drawing in drawings.items():
        item = layout.itemById(name)
        if item is None or not hasattr(item, "setPicturePath"):
            continue
        if drawing is None:
            layout.removeLayoutItem(item)
            continue
        size = item.sizeWithUnits()
        svg = drawing(width=round(PIXELS * size.width()), height=round(PIXELS * size.height()))
        (folder / f"{name}.svg").write_text(svg, encoding="utf-8")
        item.setPicturePath(str(folder / f"{name}.svg"))
