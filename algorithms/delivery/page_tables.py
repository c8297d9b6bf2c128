"""Tables of a layout of QGIS made as high as their rows need, over pages where they must, with what stands below."""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Sequence

from qgis.core import (
    QgsLayoutFrame,
    QgsLayoutItemPage,
    QgsLayoutPoint,
    QgsLayoutSize,
    QgsLayoutTableColumn,
    QgsTableCell,
)

from .cell_lines import broken_rows, row_heights

SPARE = 5.0  # mm
LEAST = 40.0  # mm that a picture keeps
HIGHEST = 100.0  # mm of a histogram behind a table
LEAST_MAP, LEAST_PAGE = 70.0, 110.0  # mm that a map needs below a table, and has on a page of its own


def fill_table(layout, name: str, rows: list[list[str]], map_shape: float) -> None:
    """Put rows into a table, which is made as high as it needs, and move what stands below; a map beside it on its page
    is about as high as its `map_shape` (height by width) asks for, 0 if there is none."""
    table, frame = _table(layout, name)
    if table is None:
        return
    goes_on = may_go_on(layout, name)
    table.setResizeMode(table.UseExistingFrames)
    frame.setVisibility(bool(rows))
    if rows and len(rows[0]) < len(table.columnWidths()):
        table.setColumnWidths([sum(table.columnWidths()) / len(rows[0])] * len(rows[0]))
    rows = broken_rows(layout, table, rows)
    heights = row_heights(layout, table, rows)
    if goes_on and rows:
        _repeat_head(table, rows[0])
    table.setTableContents([[QgsTableCell(text) for text in row] for row in (rows[1:] if goes_on else rows)])
    size, place, page = frame.sizeWithUnits(), frame.pagePos(), frame.page()
    lower = place.y() + size.height()
    if goes_on:
        _fit_map_above(layout, frame, heights, map_shape)
        lower += frame.pagePos().y() - place.y()
        _put_map_behind(layout, table, frame, lower, _go_on(layout, table, frame, heights), map_shape)
        return
    room = layout.pageCollection().page(page).pageSize().height() - place.y() - place.x()
    needed = sum(heights) + (SPARE if rows else 0.0)  # a row without room would not be drawn
    frame.attemptResize(QgsLayoutSize(size.width(), min(needed, room)))
    move_below(layout, page, lower, min(needed, room) - size.height())


def _table(layout, name: str):
    """The table of an id and its first frame; None for both where the layout has none."""
    frame = layout.itemById(name)
    table = frame.multiFrame() if frame is not None and hasattr(frame, "multiFrame") else None
    return (table, frame) if hasattr(table, "setTableContents") else (None, None)


def may_go_on(layout, name: str) -> bool:
    """Whether a table may go on over pages."""
    table, _ = _table(layout, name)
    return table is not None and table.resizeMode() == table.ExtendToNextPage


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


def _fit_map_above(layout, first, heights: Sequence[float], shape: float) -> None:
    """Give a map that stands above a table the height that its `shape` asks for, less where the table then stays on the
    page, and move the table with its title; without a map (`shape` 0) these take its place."""
    item = layout.itemById("map")
    if item is None or item.page() != first.page() or item.pagePos().y() > first.pagePos().y():
        return
    size, top = item.sizeWithUnits(), item.pagePos().y()
    if not shape:
        move_up_into(layout, item)
        return
    page = layout.pageCollection().page(first.page()).pageSize().height() - first.pagePos().x() - top
    gap = first.pagePos().y() - top - size.height()
    room = page - gap - sum(heights) - sum(heights[:1]) / 2
    height = min(max(shape * size.width(), LEAST_MAP), room if room > LEAST_MAP else page / 2)
    move_below(layout, first.page(), top + size.height(), height - size.height())
    item.attemptResize(QgsLayoutSize(size.width(), height))


def move_up_into(layout, item) -> None:
    """Move what stands below an item into its place."""
    top, bottom = item.pagePos().y(), item.pagePos().y() + item.sizeWithUnits().height()
    below = [other.pagePos().y() for other in layout.items() if hasattr(other, "pagePos")
             and hasattr(other, "attemptMove") and other.page() == item.page() and other.pagePos().y() >= bottom - 0.5]
    if below:
        move_below(layout, item.page(), bottom, top - min(below))


def room_below(layout, name: str, rows: list[list[str]]) -> float:
    """What a table with these rows, its title above it, would leave free at the top of a page of its own, mm; negative
    where it needs more."""
    table, frame = _table(layout, name)
    page = layout.pageCollection().page(frame.page()).pageSize().height() - 2 * frame.pagePos().x()
    return page - sum(row_heights(layout, table, rows)) - 3 * SPARE


def put_behind(layout, name: str, items: Sequence) -> None:
    """Put pictures below each other behind the end of a table, as high as there is room, in the order given."""
    table, first = _table(layout, name)
    if not items or table is None:
        return
    frame = table.frame(table.frameCount() - 1)
    top = frame.pagePos().y() + frame.sizeWithUnits().height() + SPARE
    bottom = layout.pageCollection().page(frame.page()).pageSize().height() - first.pagePos().x()
    height = min((bottom - top) / len(items), HIGHEST) - SPARE
    for number, item in enumerate(items):
        item.attemptMove(QgsLayoutPoint(item.pagePos().x(), top + number * (height + SPARE)), True, False, frame.page())
        item.attemptResize(QgsLayoutSize(item.sizeWithUnits().width(), height))


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


def text_lines(text: str, width: float, letter: float) -> int:
    """About how many lines a text takes in a column of `width` mm; Japanese letters are twice as wide."""
    letters = sum(2 if unicodedata.east_asian_width(one) in "WF" else 1 for one in text)
    return max(1, math.ceil(letters * letter / width))


def move_below(layout, page: int, lower: float, by: float) -> None:
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
