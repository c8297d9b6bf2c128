"""Reports in QGIS's window: a line with a button that opens the one just made, or opened by themselves where wished."""

from __future__ import annotations

from qgis.core import Qgis, QgsSettings
from qgis.PyQt.QtCore import QObject, Qt, QUrl, pyqtSignal
from qgis.PyQt.QtGui import QDesktopServices
from qgis.PyQt.QtWidgets import QAction, QPushButton

from .declaring.parameters import tr

SETTING = "urbanmap/open_reports"


class ReportLinks(QObject):
    """Takes reports from the threads in which algorithms run to the window's own."""

    made = pyqtSignal(str, str)
    current: ReportLinks | None = None
    """The one of this window; None where there is no window."""

    def __init__(self, iface):
        super().__init__()
        self.iface = iface
        self.made.connect(self._offer, Qt.ConnectionType.QueuedConnection)
        ReportLinks.current = self

    def action(self, parent) -> QAction:
        """The entry of the menu that switches whether reports open by themselves."""
        action = QAction(tr("Open reports in the browser after a run"), parent)
        action.setCheckable(True)
        action.setChecked(self.opens())
        action.toggled.connect(lambda on: QgsSettings().setValue(SETTING, on))
        return action

    @staticmethod
    def opens() -> bool:
        """Whether the user wants reports opened by themselves."""
        return QgsSettings().value(SETTING, False, type=bool)

    def _offer(self, title: str, path: str) -> None:
        """Open a report, or show the line that does; one line at a time."""
        if self.opens():
            open_report(path)
            return
        self._take_away()
        bar = self.iface.messageBar()
        line = bar.createMessage("UrbanMap", title.removesuffix(f": {tr('Report')}"))  # the button says so
        line.setObjectName(SETTING)
        button = QPushButton(tr("Open report"), line)
        button.clicked.connect(lambda: open_report(path))
        line.layout().addWidget(button)
        bar.pushWidget(line, Qgis.MessageLevel.Success)

    def _take_away(self) -> None:
        """Remove the line of an earlier report."""
        bar = self.iface.messageBar()
        for line in [item for item in bar.items() if item.objectName() == SETTING]:
            bar.popWidget(line)

    def remove(self) -> None:
        """Take it all away with the plugin."""
        self._take_away()
        self.made.disconnect()
        ReportLinks.current = None


def open_report(path: str) -> None:
    """Show a file in the browser."""
    QDesktopServices.openUrl(QUrl.fromLocalFile(path))
