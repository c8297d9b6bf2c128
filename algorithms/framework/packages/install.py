"""The window that installs missing Python packages into the QGIS profile."""

from __future__ import annotations

from qgis.core import Qgis, QgsApplication, QgsSettings, QgsTask
from qgis.PyQt.QtCore import Qt, pyqtSignal
from qgis.PyQt.QtWidgets import QDialog, QDialogButtonBox, QLabel, QPlainTextEdit, QPushButton, QVBoxLayout

from ....urbanmap_qgis.dependencies import find_missing, install, install_command, shown_command
from ....urbanmap_qgis.errors import UrbanMapError
from ....urbanmap_qgis.wording import say
from ..declaring.parameters import tr
from .dependencies import profile_packages

_TOLD = 1
"""Packages that the line above the map names."""


class PackagesBar:
    """The line above the map that offers to install what is missing."""

    SETTING = "urbanmap/offered_packages"

    @classmethod
    def offer(cls, iface, install_packages) -> bool:
        """Whether the line was shown: once for the same missing packages, so that it can be dismissed for good."""
        names = [item.package.distribution for item in find_missing()]
        settings = QgsSettings()
        if not names or settings.value(cls.SETTING, "") == " ".join(names):
            return False
        # The line above the map holds no more; the window behind the button names all.
        listed = ", ".join(names) if len(names) <= _TOLD else say(
            "{names} and {count} more", names=", ".join(names[:_TOLD]), count=len(names) - _TOLD)
        line = iface.messageBar().createMessage("UrbanMap", tr("Python packages missing: {0}.").format(listed))
        button = QPushButton(tr("Install…"), line)
        button.clicked.connect(lambda: (iface.messageBar().popWidget(line), install_packages()))
        line.layout().addWidget(button)
        iface.messageBar().pushWidget(line, Qgis.MessageLevel.Warning)
        settings.setValue(cls.SETTING, " ".join(names))
        return True


class InstallTask(QgsTask):
    """Runs pip in the background and sends what it prints."""

    printed = pyqtSignal(str)
    ended = pyqtSignal(str)

    def __init__(self, missing, folder, pip_options=()):
        super().__init__(tr("Installing Python packages for UrbanMap"), QgsTask.Flag.CanCancel)
        self.missing = missing
        self.folder = folder
        self.pip_options = pip_options
        self.error = ""

    def run(self):
        try:
            install(self.missing, self.folder, self.printed.emit, self.isCanceled, self.pip_options)
        except (UrbanMapError, OSError) as error:
            self.error = str(error)
        return not self.error

    def finished(self, result):
        if result:
            left = find_missing(item.package.import_name for item in self.missing)
            self.error = tr("Still missing: {0}. Restart QGIS and look again.").format(
                ", ".join(map(str, left))) if left else ""
        self.ended.emit(self.error or tr("The packages are installed; the algorithms can be used now."))


class InstallDialog(QDialog):
    """Says what is missing, installs it on demand and shows what pip prints."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setWindowTitle(tr("UrbanMap: Python packages"))
        self.resize(640, 400)
        self.task = None
        self.missing = find_missing()
        self.label = QLabel(self._summary())
        self.label.setTextFormat(Qt.TextFormat.PlainText)
        self.label.setWordWrap(True)
        self.output = QPlainTextEdit()
        self.output.setReadOnly(True)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        self.button = self.buttons.addButton(tr("Install"), QDialogButtonBox.ButtonRole.ActionRole)
        self.button.setEnabled(bool(self.missing))
        self.button.clicked.connect(self.start)
        self.buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        for widget in (self.label, self.output, self.buttons):
            layout.addWidget(widget)
        if self.missing:
            self.output.appendPlainText(shown_command(install_command(self.missing, profile_packages())))

    def start(self, _checked=False, pip_options=()):
        """Start the installation."""
        self.button.setEnabled(False)
        self.task = InstallTask(self.missing, profile_packages(), pip_options)
        self.task.printed.connect(self.output.appendPlainText)
        self.task.ended.connect(self._ended)
        QgsApplication.taskManager().addTask(self.task)

    def reject(self):
        if self.task is not None:
            self.task.cancel()
        super().reject()

    def _ended(self, message):
        self.task = None
        self.missing = find_missing()
        self.label.setText(message)
        self.output.appendPlainText(message)
        self.button.setEnabled(bool(self.missing))

    def _summary(self):
        if not self.missing:
            return tr("All Python packages that UrbanMap needs are there.")
        return tr("Missing: {0}. They are installed into a folder of the QGIS profile; what QGIS brought with it "
                  "stays as it is.").format(", ".join(map(str, self.missing)))
