"""The plugin: registers the provider, and in the desktop adds a menu."""

from __future__ import annotations

from qgis.core import QgsApplication

from .framework.dependencies import activate_profile_packages
from .framework.language import speak_language, stop_speaking
from .framework.parameters import tr
from .provider import UrbanMapProvider


class UrbanMapPlugin:
    """UrbanMap in QGIS; `iface` is None under `qgis_process`."""

    def __init__(self, iface=None):
        self.iface = iface
        self.provider = None
        self.action = None
        self.dialog = None
        activate_profile_packages()
        self.translator = speak_language()

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
        if self.translator is not None:
            stop_speaking(self.translator)
            self.translator = None
