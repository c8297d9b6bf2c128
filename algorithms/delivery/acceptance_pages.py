"""The acceptance report as pages of A4: a layout of QGIS, shipped or the office's own, filled in and printed."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from qgis.core import (
    QgsLayoutExporter,
    QgsLayoutPoint,
    QgsLayoutSize,
    QgsPrintLayout,
    QgsProject,
    QgsReadWriteContext,
    QgsRenderContext,
)
from qgis.PyQt.QtXml import QDomDocument

from ...urbanmap_qgis.errors import InputError, OutputError
from ..framework.declaring.parameters import tr
from .cell_lines import LINE
from .page_tables import fill_table, may_go_on, move_below, move_up_into, put_behind, room_below, text_lines

LAYOUT = Path(__file__).resolve().parents[2] / "resources" / "layouts" / "acceptance.qpt"
HISTOGRAMS = ("histogram_plan", "histogram_height")
HISTOGRAM = 70.0  # mm that one needs to go behind a table
PIXELS = 4.0  # of a drawing in a millimetre of the page
LETTER = 0.23  # mean width of a bold letter, mm a point of its size

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
    shape = content.map_shape if content.drawings.get("map") else 0.0
    long = [name for name in tables if may_go_on(layout, name)]
    for name in [*(name for name in tables if name not in long), *long]:
        behind = _put_map_to_the_figures(layout, name, tables[name], content) if name in long else []
        fill_table(layout, name, tables[name], shape)
        put_behind(layout, name, behind)
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
        more = text_lines(text, size.width(), LETTER * letters) * LINE * letters + 1.0 - size.height()
        if more > 0.0:
            lower = item.pagePos().y() + size.height()
            item.attemptResize(QgsLayoutSize(size.width(), size.height() + more))
            move_below(layout, item.page(), lower, more)


def _put_map_to_the_figures(layout, name: str, rows: list[list[str]], content) -> list:
    """Let the map take the place of the histograms where there are none, or where a wide map and a short table would
    leave half of their page empty; the histograms that go behind the table instead."""
    item, places = layout.itemById("map"), [layout.itemById(one) for one in HISTOGRAMS]
    places = [one for one in places if one is not None]
    if item is None or not content.drawings.get("map") or not places:
        return []
    page, drawn = places[0].page(), [one for one in places if content.drawings.get(one.id())]
    bottom = layout.pageCollection().page(page).pageSize().height() - places[0].pagePos().x()
    top, width = min(one.pagePos().y() for one in places), item.sizeWithUnits().width()
    if drawn and not (0 < content.map_shape * width < bottom - top and page != item.page()
                      and room_below(layout, name, rows) > HISTOGRAM * len(drawn)):
        return []
    move_up_into(layout, item)
    item.attemptMove(QgsLayoutPoint(item.pagePos().x(), top), True, False, page)
    item.attemptResize(QgsLayoutSize(width, bottom - top))
    return drawn


def _fill_pictures(layout, drawings: Mapping, folder: Path) -> None:
    """Show drawings by id, each in the shape of its item; an item without one goes."""
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
