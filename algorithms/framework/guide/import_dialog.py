"""A table of another program read as the user tells, with a preview of its columns; ways are kept by name."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsApplication, QgsCoordinateReferenceSystem
from qgis.gui import QgsFileWidget, QgsProjectionSelectionWidget
from qgis.PyQt.QtCore import pyqtSignal
from qgis.PyQt.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QSpinBox,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from ....urbanmap_qgis.errors import UrbanMapError
from ....urbanmap_qgis.wording import mark
from ..declaring.choice_words import CHOICE_WORDS
from ..declaring.parameters import tr

_ROWS = 12
_HEIGHTS = (mark("Choose…"), mark("the ellipsoid, as GNSS measures"), mark("sea level (the geoid)"))
_NORTHS = (mark("true north"), mark("grid north"))
_ANGLES_OF_ANY_NORTH = (mark("degrees clockwise from north"), mark("radians clockwise from north"),
                        mark("degrees counter-clockwise from east"), mark("radians counter-clockwise from east"))
_GEOIDS = mark("Geoid models (*.tif *.gtx *.asc *.isg *.txt *.ver);;All files (*)")
_TARGETS = {"trajectory": mark("Trajectory"), "exterior": mark("Exterior orientation"), "poses": mark("Image poses"),
            "control": mark("Control points of a survey"), "als_control": mark("Control points of a point cloud"),
            "frame_control": mark("Points in frames"), "ties": mark("Tie points")}
_COLUMN_NAMES = {
    "time": mark("time"), "x": mark("east"), "y": mark("north"), "z": mark("height"), "roll": mark("roll"),
    "pitch": mark("pitch"), "heading": mark("heading"), "image": mark("image"), "id": mark("name"),
    "point": mark("point"), "set": mark("set"), "column": mark("column"), "row": mark("row"), "role": mark("role"),
    "x_mms": mark("measured east"), "y_mms": mark("measured north"), "z_mms": mark("measured height"),
    "x_als": mark("east in the cloud"), "y_als": mark("north in the cloud"), "z_als": mark("height in the cloud"),
    "x_ref": mark("reference east"), "y_ref": mark("reference north"), "latitude": mark("latitude"),
    "longitude": mark("longitude"), "latitude_minutes": mark("latitude, minutes"),
    "latitude_seconds": mark("latitude, seconds"), "longitude_minutes": mark("longitude, minutes"),
    "longitude_seconds": mark("longitude, seconds")}
"""What the columns of the project's tables are, shown with their names."""
_DOUBT = "#a86400"
_DELIMITERS = ((",", ","), (";", ";"), ("\t", mark("Tab")), (" ", mark("Space")))


def imports_file() -> Path:
    """Where ways of reading are kept: in the user's profile."""
    return Path(QgsApplication.qgisSettingsDirPath()) / "urbanmap" / "imports.json"


class ImportDialog(QDialog):
    """Makes a table into one of the project's own; `imported` comes with the file written.

    `crs` is the job's plane system (a code), offered for latitudes and longitudes; "" offers that of their place.
    """

    imported = pyqtSignal(str)

    def __init__(self, parent=None, crs: str = ""):
        super().__init__(parent)
        from ....urbanmap_qgis.job.table_import import ENCODINGS, HEIGHTS, LENGTHS, NORTHS

        self.setWindowTitle(tr("Import a table"))
        self.path, self.target, self.kept = QLineEdit(), QComboBox(), QComboBox()
        self.encoding, self.delimiter, self.skip = QComboBox(), QComboBox(), QSpinBox()
        self.angles, self.length, self.name = QComboBox(), QComboBox(), QLineEdit()
        self.table, self.told = QTableWidget(), QLabel()
        self.crs, self.heights, self.north = QgsProjectionSelectionWidget(), QComboBox(), QComboBox()
        self.geoid, self.placed, self.order = QgsFileWidget(), QLabel(), QLabel()
        self._job_crs = crs
        for word, label in _TARGETS.items():
            self.target.addItem(tr(label), word)
        self.encoding.addItems(ENCODINGS)
        self.length.addItems(LENGTHS)
        for words, box, names in ((HEIGHTS, self.heights, _HEIGHTS), (NORTHS, self.north, _NORTHS)):
            for word, label in zip(words, names):
                box.addItem(tr(label), word)
        for sign, label in _DELIMITERS:
            self.delimiter.addItem(tr(label) if len(label) > 1 else label, sign)
        self.skip.setMaximum(1000)
        self._busy = False
        self._lay_out()
        self._list_kept()
        self._target_changed()
        self.path.editingFinished.connect(self.guess)
        self.target.currentIndexChanged.connect(self._target_changed)
        self.kept.activated.connect(lambda _row: self._take_kept())
        for box in (self.encoding, self.delimiter):
            box.currentIndexChanged.connect(lambda _row: self.preview({}))
        self.skip.valueChanged.connect(lambda _value: self.preview({}))
        self.length.currentIndexChanged.connect(lambda _row: self._show_place())
        self.crs.crsChanged.connect(lambda _crs: self._show_place())
        self.heights.currentIndexChanged.connect(lambda _row: self._show_place())

    def _lay_out(self) -> None:
        browse = QPushButton("…")
        browse.clicked.connect(self._browse)
        row = QWidget()
        line = QHBoxLayout(row)
        line.setContentsMargins(0, 0, 0, 0)
        line.addWidget(self.path, 1)
        line.addWidget(browse)
        for label in (self.placed, self.order):
            label.setWordWrap(True)
        self.order.setStyleSheet(f"color: {_DOUBT}")
        self.geoid.setFilter(tr(_GEOIDS))
        self.geoid.lineEdit().setPlaceholderText(tr("none: heights stay above the ellipsoid"))
        form = self.form = QFormLayout()
        for label, widget in ((tr("File"), row), (tr("Make it a"), self.target), (tr("Read as"), self.kept),
                              (tr("Encoding"), self.encoding), (tr("Delimiter"), self.delimiter),
                              (tr("Lines before the names"), self.skip), (tr("Unit of lengths"), self.length),
                              (tr("Angles"), self.angles), (tr("Plane reference system"), self.crs),
                              (tr("Angles count from"), self.north), (tr("Heights count from"), self.heights),
                              (tr("Geoid model"), self.geoid), (tr("Keep this way of reading as"), self.name)):
            form.addRow(label, widget)
        self.name.setPlaceholderText(tr("not kept"))
        self.told.setWordWrap(True)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Save | QDialogButtonBox.StandardButton.Close)
        for which, label in ((QDialogButtonBox.StandardButton.Save, tr("Save…")),
                             (QDialogButtonBox.StandardButton.Close, tr("Close"))):
            buttons.button(which).setText(label)  # Qt's own words are English where its translation is not installed
        buttons.accepted.connect(self._save)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addLayout(form)
        layout.addWidget(QLabel(tr("Choose above each column what it is.")))
        layout.addWidget(self.table, 1)
        for label in (self.order, self.placed, self.told):
            layout.addWidget(label)
        layout.addWidget(buttons)
        self.resize(760, 740)

    def open_file(self, path: str) -> None:
        """Take a file and guess what it is and how it is read."""
        from ....urbanmap_qgis.job.table_guess import guessed_target

        self.path.setText(path)
        if Path(path).is_file():
            self.take(guessed_target(path))

    def guess(self) -> None:
        """Set everything as the file's content suggests."""
        from ....urbanmap_qgis.job.table_guess import guessed_import

        if Path(self.path.text()).is_file():
            self.take(guessed_import(self.path.text(), self.target.currentData()))

    def take(self, how) -> None:
        """Set everything as a way of reading says."""
        self._busy = True
        self.target.setCurrentIndex(self.target.findData(how.target))
        self._fill_angles()
        self.encoding.setCurrentText(how.encoding)
        self.delimiter.setCurrentIndex(self.delimiter.findData(how.delimiter))
        self.skip.setValue(how.skip)
        self.length.setCurrentText(how.length)
        self.angles.setCurrentIndex(max(self.angles.findData(how.angles), 0))
        self.crs.setCrs(QgsCoordinateReferenceSystem(how.crs or self._job_crs))
        self.heights.setCurrentIndex(max(self.heights.findData(how.heights), 0))
        self.north.setCurrentIndex(max(self.north.findData(how.north), 0))
        self.geoid.setFilePath(how.geoid)
        self._busy = False
        self.preview(how.columns)

    def way(self):
        """The way of reading as it is set."""
        from ....urbanmap_qgis.job.table_import import TableImport

        boxes = [self.table.cellWidget(0, column) for column in range(self.table.columnCount())]
        columns = {box.currentData(): column for column, box in enumerate(boxes) if box is not None
                   and box.currentData()}
        crs = self.crs.crs()
        return TableImport(self.target.currentData(), self.encoding.currentText(), self.delimiter.currentData(),
                           self.skip.value(), columns, self.angles.currentData(), self.length.currentText(),
                           (crs.authid() or crs.toWkt()) if crs.isValid() else "", self.heights.currentData(),
                           self.geoid.filePath(), self.north.currentData())

    def preview(self, columns) -> None:
        """Show the first rows, above each column what it is taken for."""
        from ....urbanmap_qgis.job.table_import import split_table
        from ....urbanmap_qgis.job.table_places import POLAR
        from ....urbanmap_qgis.job.table_targets import TARGETS

        if self._busy or not Path(self.path.text()).is_file():
            return
        self.table.clear()
        try:
            names, rows = split_table(self.path.text(), self.way(), _ROWS)
        except UrbanMapError as error:
            self.told.setText(str(error))
            self.table.setColumnCount(0)
            return
        self.told.clear()
        self.table.setColumnCount(len(names))
        self.table.setRowCount(len(rows) + 1)
        self.table.setHorizontalHeaderLabels(names)
        meant = {column: name for name, column in columns.items()}
        for column in range(len(names)):
            box = QComboBox()
            box.addItem("–", "")
            for needed in (*TARGETS[self.target.currentData()], *POLAR):
                words = tr(_COLUMN_NAMES[needed]) if needed in _COLUMN_NAMES else needed
                box.addItem(words if words == needed else f"{words} ({needed})", needed)
            box.setCurrentIndex(max(box.findData(meant.get(column, "")), 0))
            box.currentIndexChanged.connect(lambda _row: self._show_place())
            self.table.setCellWidget(0, column, box)
            for number, cells in enumerate(rows, 1):
                self.table.setItem(number, column, QTableWidgetItem(cells[column] if column < len(cells) else ""))
        self.table.resizeColumnsToContents()
        self._show_place()

    def _show_place(self) -> None:
        """Where the first latitude and longitude come to lie, with the fields that only such tables need."""
        from ....urbanmap_qgis.io.reference.system_names import local_name
        from ....urbanmap_qgis.job.table_guess import told_order
        from ....urbanmap_qgis.job.table_import import table_place

        if self._busy or not Path(self.path.text()).is_file():
            return
        how = self.way()
        for widget, needed in ((self.crs, how.polar), (self.north, how.polar), (self.heights, how.polar),
                               (self.geoid, how.polar and how.heights == "ellipsoidal")):
            widget.setVisible(needed)
            self.form.labelForField(widget).setVisible(needed)
        self._name_angles(how.polar)
        self.order.clear()
        try:
            place = table_place(self.path.text(), how)
            self.order.setText(told_order(self.path.text(), how))
        except UrbanMapError as error:
            self.placed.setText(str(error))
            return
        self.order.setVisible(bool(self.order.text()))
        self.placed.clear()
        if place is None:
            return
        crs, x, y = place
        if not how.polar:
            self.placed.setText(tr("First place: {0:.3f} m east, {1:.3f} m north.").format(x, y))
            return
        if not how.crs:  # offered by its place; the user can choose another one
            self.crs.setCrs(QgsCoordinateReferenceSystem(crs))
            return
        self.placed.setText(tr("First place in {0}: {1:.3f} m east, {2:.3f} m north.").format(
            local_name(QgsCoordinateReferenceSystem(crs).description()) or crs, x, y))

    def write(self, output: str) -> bool:
        """Write the file, and keep the way of reading where it has a name; whether it went well."""
        from ....urbanmap_qgis.job.table_import import import_table, remember_import

        try:
            notes = import_table(self.path.text(), self.way(), output)
            if self.name.text().strip():
                remember_import(imports_file(), self.name.text().strip(), self.way())
                self._list_kept()
        except UrbanMapError as error:
            self.told.setText(str(error))
            return False
        self.told.setText("\n".join([tr("Written: {0}").format(output), *notes]))
        self.imported.emit(output)
        return True

    def _save(self) -> None:
        source = Path(self.path.text())
        output, _ = QFileDialog.getSaveFileName(self, self.windowTitle(), str(
            source.with_name(f"{source.stem}_{self.target.currentData()}.csv")), "CSV (*.csv)")
        if output:
            self.write(output)

    def _browse(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self, self.windowTitle(), self.path.text())
        if path:
            self.open_file(path)

    def _fill_angles(self) -> None:
        from ....urbanmap_qgis.job.table_targets import ANGLE_WAYS

        self.angles.clear()
        ways = ANGLE_WAYS[self.target.currentData()]
        for way in ways:
            self.angles.addItem(way, way)
        self._name_angles(False)
        self.angles.setVisible(any(ways))
        self.form.labelForField(self.angles).setVisible(any(ways))

    def _name_angles(self, polar: bool) -> None:
        """Name the ways of counting angles; where places are latitudes and longitudes, from which north is asked for
        apart."""
        from ....urbanmap_qgis.mobile.trajectory_reading import ANGLE_NAMES, ANGLES

        names = dict(zip(ANGLES, _ANGLES_OF_ANY_NORTH if polar else ANGLE_NAMES))
        for row in range(self.angles.count()):
            way = self.angles.itemData(row)
            words = ", ".join(tr(CHOICE_WORDS[word]) for word in way.split(" ") if word) if way not in names else ""
            self.angles.setItemText(row, tr(names[way]) if way in names else words)

    def _target_changed(self, *_ignored) -> None:
        if not self._busy:
            self._fill_angles()
            self.guess()

    def _list_kept(self) -> None:
        """The ways of reading that were kept."""
        from ....urbanmap_qgis.job.table_import import remembered_imports

        self.kept.clear()
        self.kept.addItem(tr("as guessed"), None)
        try:
            for name, how in remembered_imports(imports_file()).items():
                self.kept.addItem(name, how)
        except UrbanMapError as error:
            self.told.setText(str(error))

    def _take_kept(self) -> None:
        how = self.kept.currentData()
        if how is None:
            self.guess()
        else:
            self.name.setText(self.kept.currentText())
            self.take(how)
