"""The field for several files in dialogs and batch tables: it keeps what presets, histories and batch files say.

QGIS's own field takes such values for layers and opens them; files that are none, such as point clouds, are lost.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from qgis.core import QgsProject
from qgis.PyQt.QtCore import QSettings, Qt, QUrl, pyqtSignal
from qgis.PyQt.QtWidgets import (
    QAbstractItemView,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QHBoxLayout,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from .destinations import file_of_layer
from .field_of_dialog import FieldOfDialog, FieldWrapper
from .parameters import tr

_LAST_FOLDER = "urbanmap/last_folder"


class _FilesWrapper(FieldWrapper):
    """Stands between a dialog of Processing and the field."""

    def createWidget(self):
        known = self.parameterDefinition().metadata()
        field = FilesField(self.parameterDefinition().description(), known.get("urbanmap_layers", False),
                           known.get("urbanmap_filter", ""))
        field.changed.connect(lambda: self.widgetValueHasChanged.emit(self))
        return field

    def setValue(self, value):
        self.widget.set_files([value] if isinstance(value, str) else value or [])

    def value(self):
        return list(self.widget.files) or None


class FilesWidget(FieldOfDialog):
    """The field of several files: outputs of earlier steps in the modeller."""

    WRAPPER = _FilesWrapper


class FilesField(QWidget):
    """Says which files are chosen, and opens the dialog that chooses them."""

    changed = pyqtSignal()

    def __init__(self, title: str, with_layers: bool = False, filter: str = "", parent=None):
        super().__init__(parent)
        self.title, self.with_layers, self.filter, self.files = title, with_layers, filter, []
        self.line, button = QLineEdit(), QToolButton()
        self.line.setAcceptDrops(False)  # the field itself takes files that are dropped
        self.line.editingFinished.connect(self._typed)
        self.setAcceptDrops(True)
        button.setText("…")
        button.clicked.connect(self.choose)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.line, 1)
        layout.addWidget(button)
        self._show()

    def set_files(self, files: Sequence[str]) -> None:
        """Take other files for those that are chosen."""
        self.files = [str(file) for file in files if file]
        self._show()
        self.changed.emit()

    def choose(self) -> None:
        """Let the user choose."""
        dialog = FilesDialog(self.title, self.files, layer_files() if self.with_layers else {}, self.filter,
                             self)
        if dialog.exec():
            self.set_files(dialog.chosen())

    def dragEnterEvent(self, event):
        if any(url.isLocalFile() for url in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event):
        self.set_files([url.toLocalFile() for url in event.mimeData().urls() if url.isLocalFile()])
        event.acceptProposedAction()

    def _typed(self) -> None:
        """Take paths that were typed or pasted for those that are chosen; beside the number of files, as more."""
        text, shown = self.line.text(), self._shown()
        if text == shown:
            return
        beside = len(self.files) > 1 and shown in text
        more = paths_in(text.replace(shown, "\n")) if beside else paths_in(text)
        self.set_files([*self.files, *(path for path in more if path not in self.files)] if beside else more)

    def _shown(self) -> str:
        if len(self.files) > 1:
            return tr("{0} files").format(len(self.files))
        return self.files[0] if self.files else ""

    def _show(self) -> None:
        self.line.setText(self._shown())
        self.line.setPlaceholderText(tr("{0} files").format(0))
        self.line.setToolTip("\n".join(self.files))


def paths_in(text: str) -> list[str]:
    """Paths in a pasted text: in quotation marks, as file managers copy them, or between semicolons."""
    quoted = re.findall(r'"([^"]+)"', text)
    if re.fullmatch(r"\s*'[^']+'(\s+'[^']+')*\s*", text):  # as terminals of Linux write them
        quoted = re.findall(r"'([^']+)'", text)
    parts = quoted or re.split(r"[;\r\n]", text)
    urls = (part.strip() for part in parts)
    return [QUrl(part).toLocalFile() if part.startswith("file:") else part for part in urls if part]


class FilesDialog(QDialog):
    """A list of files, of which those with a tick are chosen, in their order."""

    def __init__(self, title: str, files: Sequence[str], layers: dict[str, str], filter: str = "", parent=None):
        super().__init__(parent)
        self.filter = filter
        self.setWindowTitle(title)
        self.list = QListWidget()
        self.list.setDragDropMode(QAbstractItemView.DragDropMode.InternalMove)
        for file in files:
            self._add(file, True)
        for file, name in layers.items():
            if file not in files:
                self._add(file, False, name)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel)
        add = buttons.addButton(tr("Add files…"), QDialogButtonBox.ButtonRole.ActionRole)
        add.clicked.connect(self._browse)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addWidget(self.list)
        layout.addWidget(buttons)
        self.resize(560, 320)

    def chosen(self) -> list[str]:
        """The files with a tick."""
        items = [self.list.item(row) for row in range(self.list.count())]
        return [item.data(Qt.ItemDataRole.UserRole) for item in items if item.checkState() == Qt.CheckState.Checked]

    def _add(self, file: str, ticked: bool, name: str = "") -> None:
        item = QListWidgetItem(f"{name} ({file})" if name else file)
        item.setData(Qt.ItemDataRole.UserRole, file)
        item.setCheckState(Qt.CheckState.Checked if ticked else Qt.CheckState.Unchecked)
        self.list.addItem(item)

    def _browse(self) -> None:
        settings = QSettings()
        files, _ = QFileDialog.getOpenFileNames(self, self.windowTitle(), settings.value(_LAST_FOLDER, "", str),
                                                self.filter)
        for file in files:
            self._add(file, True)
        if files:
            settings.setValue(_LAST_FOLDER, str(Path(files[0]).parent))


def layer_files() -> dict[str, str]:
    """Point cloud files that layers of the project show, with the layers' names."""
    found = {}
    for layer in QgsProject.instance().mapLayers().values():
        path = file_of_layer(layer)
        if path is not None and path.suffix.lower() in (".las", ".laz"):
            found[str(path)] = layer.name()
    return found
