"""What have you: files that are dropped, told by kind in a table, with a map and what does not fit together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from datetime import datetime, timedelta
from pathlib import Path

from qgis.PyQt.QtCore import Qt, pyqtSignal
from qgis.PyQt.QtGui import QColor
from qgis.PyQt.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QMenu,
    QProgressBar,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from ....urbanmap_qgis.wording import known
from ..declaring.parameters import tr
from .extent_map import ExtentMap
from .recognition_thread import Findings, Recognition

_FACTS = Qt.ItemDataRole.UserRole
_GPS_START = datetime(1980, 1, 6)
_WEEK = 604_800.0
_SHOWN = 3
"""Reasons why files cannot be used that are told below the table; all stand beside the files."""
_MANY = 6
"""Groups of more files stay folded."""
_WIDEST = 230
"""Pixels of a column at first."""
_TABLES = (".csv", ".txt", ".tsv", ".dat")
"""Files whose columns are shown when wished."""
_NOT_NEEDED = "–"
"""In the place of the part of a file that is ticked and plays none."""
_BAD, _DOUBT = "#c0273a", "#a86400"


def span_text(times: tuple[float, float] | None) -> str:
    """A time span for a table: seconds of the week as they are, full GPS seconds as day and time (GPS)."""
    if times is None:
        return ""
    first, last = times
    if not _WEEK < first < 4e9:
        return f"{first:.0f}–{last:.0f} s"
    start, end = (_GPS_START + timedelta(seconds=value) for value in (first, last))
    return f"{start:%Y-%m-%d %H:%M}–{end:%H:%M}" if start.date() == end.date() else f"{start:%Y-%m-%d}–{end:%Y-%m-%d}"


class FilesTree(QTreeWidget):
    """The table, which takes files and folders that are dropped on it."""

    dropped = pyqtSignal(list)

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setHeaderLabels([tr("File"), tr("Used as"), tr("Reference system"), tr("Heights"), tr("Times"),
                              tr("Remarks")])
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.setAcceptDrops(True)
        self.setMinimumHeight(200)
        for column in range(self.columnCount()):
            self.resizeColumnToContents(column)

    def dragEnterEvent(self, event):
        if any(url.isLocalFile() for url in event.mimeData().urls()):
            event.acceptProposedAction()

    def dragMoveEvent(self, event):
        event.acceptProposedAction()

    def dropEvent(self, event):
        self.dropped.emit([url.toLocalFile() for url in event.mimeData().urls() if url.isLocalFile()])
        event.acceptProposedAction()


class FilesPanel(QWidget):
    """Files and folders given, what they are, and which of them are used; `changed` comes when any of it changes."""

    changed = pyqtSignal()
    preview_wanted = pyqtSignal(str)

    def __init__(self, parent=None):
        super().__init__(parent)
        self.given: list[str] = []
        self.left_out: set[str] = set()
        self.used_as: dict[str, str] = {}
        self.findings = Findings((), ())
        self.tree, self.map = FilesTree(), ExtentMap()
        self.hint = QLabel(tr("Drop files and folders here."))
        self.fit = QLabel()
        self.use, self.preview = QComboBox(), QPushButton(tr("Preview of columns…"))
        self.bar = QProgressBar()
        self.recognition = Recognition(self)
        self._lay_out()
        self.tree.dropped.connect(self.add)
        self.tree.itemChanged.connect(self._ticked)
        self.tree.currentItemChanged.connect(self._chosen)
        self.tree.itemSelectionChanged.connect(self._offer_uses)
        self.tree.customContextMenuRequested.connect(self._open_menu)
        self.preview.clicked.connect(self._show_preview)
        self.tree.itemDoubleClicked.connect(lambda _row, _column: self._show_preview())
        self.use.activated.connect(lambda row: self.put_to_use(self.use.itemData(row)))
        self.recognition.found.connect(self._show)
        self.recognition.moved.connect(lambda share: self.bar.setValue(int(100 * share)))

    def _lay_out(self) -> None:
        self.hint.setWordWrap(True)
        self.fit.setWordWrap(True)
        self.fit.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.bar.hide()
        row = QHBoxLayout()
        for label, work in ((tr("Add files…"), self._browse_files), (tr("Add folder…"), self._browse_folder),
                            (tr("Clear"), self.clear)):
            button = QPushButton(label)
            button.clicked.connect(work)
            row.addWidget(button)
        row.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addLayout(row)
        for widget, share in ((self.hint, 0), (self.bar, 0), (self.tree, 2)):
            layout.addWidget(widget, share)
        uses = QHBoxLayout()
        uses.addWidget(QLabel(tr("Use the chosen file as")))
        uses.addWidget(self.use, 1)
        uses.addWidget(self.preview)
        layout.addLayout(uses)
        layout.addWidget(self.fit)
        layout.addWidget(self.map, 1)
        self._offer_uses()

    def add(self, paths: Sequence[str]) -> None:
        """Take more files and folders."""
        self.set_given([*self.given, *paths], self.left_out, self.used_as)

    def set_given(self, paths: Sequence[str], left_out: Sequence[str] = (),
                  used_as: Mapping[str, str] | None = None) -> None:
        """Take these instead of those before."""
        self.given, self.left_out = list(dict.fromkeys(str(path) for path in paths if path)), set(left_out)
        self.used_as = dict(used_as or {})
        self.bar.setValue(0)
        self.bar.setVisible(bool(self.given))
        self.recognition.start(self.given)

    def clear(self) -> None:
        """Forget all files."""
        self.set_given([])

    def used(self) -> list:
        """The core's records of the files that have a tick, as the user puts them to use."""
        from ....urbanmap_qgis.job.roles import put_to_use

        return [item for item in put_to_use(self.findings.facts, self.used_as)
                if item.usable and item.source not in self.left_out]

    def put_to_use(self, use: str) -> None:
        """Say what the chosen files are used as; "" leaves it to the program."""
        from ....urbanmap_qgis.job.roles import uses_of

        for item in self._chosen_facts():
            if use and use in uses_of(item):
                self.used_as[item.source] = use
                self.left_out.discard(item.source)
            else:
                self.used_as.pop(item.source, None)
        self._show_ticks()
        self._tell()
        self._offer_uses()
        self.changed.emit()

    def _chosen_facts(self) -> list:
        chosen = {row.data(0, _FACTS) for row in self.tree.selectedItems()}
        return [item for item in self.findings.facts if item.source in chosen]

    def _table_chosen(self) -> str:
        """The one table of text that is chosen, "" where it is none or there are several."""
        chosen = self._chosen_facts()
        return str(chosen[0].path) if len(chosen) == 1 and chosen[0].path.suffix.lower() in _TABLES else ""

    def _show_preview(self) -> None:
        if self._table_chosen():
            self.preview_wanted.emit(self._table_chosen())

    def _uses_offered(self) -> list[tuple[str, str]]:
        """Name and key of each use that fits all chosen files, first that it is left to the program."""
        from ....urbanmap_qgis.job.roles import use_name, uses_of

        chosen = [uses_of(item) for item in self._chosen_facts()]
        fitting = [use for use in (chosen[0] if chosen else ()) if all(use in uses for uses in chosen)]
        return [(tr("as recognised"), ""), *((use_name(use), use) for use in fitting)] if fitting else []

    def _offer_uses(self) -> None:
        self.use.clear()
        offered = self._uses_offered() if self.tree.selectedItems() else []
        for label, use in offered:
            self.use.addItem(label, use)
        self.use.setEnabled(bool(offered))
        self.preview.setEnabled(bool(self._table_chosen()))
        said = {self.used_as.get(item.source, "") for item in self._chosen_facts()} if offered else set()
        if len(said) == 1:
            self.use.setCurrentIndex(max(self.use.findData(said.pop()), 0))

    def _open_menu(self, place) -> None:
        """The same uses as a menu at the row."""
        menu = QMenu(self.tree)
        if self._table_chosen():
            menu.addAction(self.preview.text()).triggered.connect(self._show_preview)
        for label, use in self._uses_offered():
            action = menu.addAction(label if not use else tr("Use as: {0}").format(label))
            action.triggered.connect(lambda _checked=False, use=use: self.put_to_use(use))
        if menu.actions():
            menu.exec(self.tree.viewport().mapToGlobal(place))

    def _browse_files(self) -> None:
        files, _ = QFileDialog.getOpenFileNames(self, tr("Add files…"), self._folder())
        if files:
            self.add(files)

    def _browse_folder(self) -> None:
        folder = QFileDialog.getExistingDirectory(self, tr("Add folder…"), self._folder())
        if folder:
            self.add([folder])

    def _folder(self) -> str:
        return str(Path(self.given[-1]).parent) if self.given else ""

    def _show(self, findings: Findings) -> None:
        from ....urbanmap_qgis.job.file_facts import kind_name

        self.findings = findings
        self.bar.hide()
        self.tree.blockSignals(True)
        self.tree.clear()
        groups: dict[str, list] = {}
        for item in findings.facts:
            title = tr("Cannot be used") if item.problem else kind_name(item.kind)
            groups.setdefault(title, []).append(item)
        for title, members in sorted(groups.items(), key=lambda entry: _group_rank(entry[1])):
            head = QTreeWidgetItem(self.tree, [f"{title} ({len(members)})"])
            head.setFirstColumnSpanned(True)
            for item in members:
                self._add_row(head, item)
            head.setExpanded(bool(members[0].problem) or (members[0].usable and len(members) <= _MANY))
        self.tree.blockSignals(False)
        self._show_ticks()
        self._tell()
        self._offer_uses()
        for column in range(self.tree.columnCount()):
            self.tree.resizeColumnToContents(column)
            self.tree.setColumnWidth(column, min(self.tree.columnWidth(column), _WIDEST))
        usable = sum(item.usable for item in findings.facts)
        self.hint.setText(tr(
            "{0} of {1} files and layers can be used. Untick what is not to be used; where a file is used as something "
            "else than it is, choose it and say so below the table.").format(
            usable, len(findings.facts)) if findings.facts else tr("Drop files and folders here."))
        self.changed.emit()

    def _add_row(self, head: QTreeWidgetItem, item) -> None:
        from ....urbanmap_qgis.job.agreement import system_name
        from ....urbanmap_qgis.job.chain_plan import WISHES
        from ....urbanmap_qgis.job.file_facts import JOB

        detail = known(WISHES.get(item.detail, item.detail)) if item.kind == JOB else item.detail
        parts = (item.doubt and f"? {item.doubt}", detail, *item.notes)
        remarks = item.problem or "; ".join(part for part in parts if part)
        system = system_name(item.crs_wkt)
        code = system.split(" ")[0] if system.startswith("EPSG:") else system
        row = QTreeWidgetItem(head, [item.label, "", code, "" if item.heights == "unknown" else known(item.heights),
                                     span_text(item.times), remarks])
        row.setData(0, _FACTS, item.source)
        for column in range(6):
            row.setToolTip(column, "\n".join(part for part in (str(item.path), system, remarks) if part))
        if item.problem:
            row.setForeground(5, QColor(_BAD))
        elif item.doubt:
            row.setForeground(5, QColor(_DOUBT))

    def _rows(self) -> Iterator[QTreeWidgetItem]:
        for number in range(self.tree.topLevelItemCount()):
            head = self.tree.topLevelItem(number)
            yield from (head.child(place) for place in range(head.childCount()))

    def _show_ticks(self) -> None:
        """A tick box at each file of a use, ticked where it is used."""
        from ....urbanmap_qgis.job.roles import put_to_use

        usable = {item.source for item in put_to_use(self.findings.facts, self.used_as) if item.usable}
        self.tree.blockSignals(True)
        for row in self._rows():
            source = row.data(0, _FACTS)
            if source in usable:
                row.setCheckState(0, Qt.CheckState.Unchecked if source in self.left_out else Qt.CheckState.Checked)
            else:
                row.setData(0, Qt.ItemDataRole.CheckStateRole, None)
        self.tree.blockSignals(False)

    def _show_parts(self, used: Sequence) -> None:
        """Beside each file the part that it plays."""
        from ....urbanmap_qgis.job.roles import parts_of, use_name

        kept, played = {item.source for item in used}, {}
        for role, sources in parts_of(used).inputs.items():
            for source in sources:
                played.setdefault(source, []).append(use_name(role))
        self.tree.blockSignals(True)
        for row in self._rows():
            source = row.data(0, _FACTS)
            unused = _NOT_NEEDED if source in kept else ""
            row.setText(1, ", ".join(played.get(source, ())) or unused)
            font = row.font(1)
            font.setBold(source in self.used_as)
            row.setFont(1, font)
        self.tree.blockSignals(False)

    def _ticked(self, row: QTreeWidgetItem, _column: int) -> None:
        source = row.data(0, _FACTS)
        if source is None:
            return
        if row.checkState(0) == Qt.CheckState.Checked:
            self.left_out.discard(source)
        else:
            self.left_out.add(source)
        self._tell()
        self.changed.emit()

    def _chosen(self, row: QTreeWidgetItem | None, _before) -> None:
        self.map.choose(row.text(0) if row is not None else "")

    def _tell(self) -> None:
        """Show where the files lie and what does not fit together."""
        from ....urbanmap_qgis.job.agreement import disagreements

        used = self.used()
        kept = {item.source for item in used}
        self._show_parts(used)
        self.map.show_boxes([(item.label, item.kind, extent) for item, extent in
                             zip(self.findings.facts, self.findings.extents) if extent and item.source in kept])
        told = disagreements(used)
        problems = [item.problem for item in self.findings.facts if item.problem]
        more = [tr("and {0} more").format(len(problems) - _SHOWN)] if len(problems) > _SHOWN else []
        groups = ((tr("Does not fit together:"), told), (tr("Cannot be used:"), [*problems[:_SHOWN], *more]))
        if told or problems:
            self.fit.setText("\n".join(line for title, sentences in groups if sentences
                                       for line in (title, *(f"• {sentence}" for sentence in sentences))))
            self.fit.setStyleSheet(f"color: {_BAD}")
        else:
            self.fit.setText(tr("As far as the files say, all fits together.") if used else "")
            self.fit.setStyleSheet("")


def _group_rank(members: Sequence) -> tuple[int, int]:
    """What cannot be used first, then what is of use in the order found, then the rest."""
    first = members[0]
    return (0 if first.problem else 1 if first.usable else 2), 0
