"""How high the rows of a layout's table are, and where the lines of their cells end."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from qgis.core import QgsLayoutUtils, QgsTextRenderer

LINE = 0.345  # height of a line, mm a point of the letters' size
NEXT_LINE = 0.46  # of each more line of a cell, likewise


def row_heights(layout, table, rows: Sequence[Sequence[str]]) -> list[float]:
    """How high each row of a table is, mm."""
    context = QgsLayoutUtils.createRenderContextForLayout(layout, None)
    letters, unit = table.contentTextFormat(), context.scaleFactor()
    room = [width * unit for width in table.columnWidths()]

    def lines(text: str, width: float) -> int:
        """Lines of a text, broken between words as QGIS does."""
        count = 0
        for part in text.split("\n"):
            count, filled = count + 1, ""
            for word in part.split(" "):
                longer = f"{filled} {word}" if filled else word
                if filled and QgsTextRenderer.textWidth(context, letters, [longer]) > width:
                    count, filled = count + 1, word
                else:
                    filled = longer
        return count

    return [(LINE + NEXT_LINE * (max(map(lines, row, room)) - 1)) * letters.size() + 2 * table.cellMargin()
            + table.gridStrokeWidth() for row in rows]


def broken_rows(layout, table, rows: Sequence[Sequence[str]]) -> list[list[str]]:
    """Rows with line ends in texts of which a word is wider than its column: QGIS breaks between words alone, and cuts
    off what a Japanese text, which has none, does not have room for."""
    from ...urbanmap_qgis.io.pages.line_breaks import broken_lines

    context = QgsLayoutUtils.createRenderContextForLayout(layout, None)
    letters, unit = table.contentTextFormat(), context.scaleFactor()
    room = [0.99 * width * unit for width in table.columnWidths()]  # margins are not in them

    def fits(text: str, width: float) -> bool:
        return QgsTextRenderer.textWidth(context, letters, [text]) <= width

    return [[text if all(fits(word, width) for word in text.split(" "))
             else "\n".join(broken_lines(text, partial(fits, width=width))) for text, width in zip(row, room)]
            for row in rows]
