"""The plugin: registers the provider, and in the desktop adds a menu."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsApplication
from qgis.PyQt.QtCore import QCoreApplication, QLocale, QSettings, QTranslator

from .framework.dependencies import activate_profile_packages
from .framework.parameters import tr
from .provider import UrbanMapProvider

TRANSLATIONS = Path(__file__).resolve().parent.parent / "resources" / "translations"


class UrbanMapPlugin:
    """UrbanMap in QGIS; `iface` is None under `qgis_process`."""

    def __init__(self, iface=None):
        self.iface = iface
        self.provider = None
        self.action = None
        self.dialog = None
        self.translator = None
        activate_profile_packages()
        self._translate()

    def initProcessing(self):
        """Register the provider."""
        self.provider = UrbanMapProvider()
        self.provider.register()

    def initGui(self):
        """Register the provider and add the menu."""
        self.initProcessing()
        if self.iface is None:
            return
        from qgis.PyQt.QtWidgets import QAction

        self.action = QAction(self.provider.icon(), tr("Install Python packages…"), self.iface.mainWindow())
        self.action.triggered.connect(self.install_packages)
        self.iface.addPluginToMenu("UrbanMap", self.action)

    def install_packages(self):
        """Show the window that installs missing packages."""
        from .framework.install import InstallDialog

        self.dialog = InstallDialog(self.iface.mainWindow())
        self.dialog.show()

    def unload(self):
        """Take everything away again."""
        if self.action is not None:
            self.iface.removePluginMenu("UrbanMap", self.action)
            self.action = None
        if self.provider is not None:
            QgsApplication.processingRegistry().removeProvider(self.provider)
            self.provider = None

    def _translate(self):
        language = QSettings().value("locale/userLocale", QLocale().name(), str)[:2]
        path = TRANSLATIONS / f"urbanmap_{language}.qm"
        if path.is_file():
            self.translator = QTranslator()
            self.translator.load(str(path))
            QCoreApplication.installTranslator(self.translator)
