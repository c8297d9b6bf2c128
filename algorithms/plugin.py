"""The plugin: registers the provider, and in the desktop adds a menu."""

from __future__ import annotations

import sys
from functools import partial

from qgis.core import QgsApplication

from .framework.declaring.parameters import tr
from .framework.language.language import speak_language, stop_speaking
from .framework.packages.dependencies import activate_profile_packages
from .framework.running.pooled_threads import end_pooled_threads
from .provider import UrbanMapProvider


class UrbanMapPlugin:
    """UrbanMap in QGIS; `iface` is None under `qgis_process`."""

    def __init__(self, iface=None):
        self.iface = iface
        self.provider = None
        self.actions = []
        self.dialog = self.guide = self.guide_action = None
        self.menus = []
        self.toolbox_entry = None
        self.report_links = None
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

        self._add_guide()
        for label, work in ((tr("Import table…"), self.import_table), (tr("Sample city…"), self.make_sample_city),
                            (tr("Documentation"), self.show_documentation),
                            (tr("Install Python packages…"), self.install_packages),
                            (tr("Diagnostics…"), self.show_diagnostics)):
            action = QAction(self.provider.icon(), label, self.iface.mainWindow())
            action.triggered.connect(work)
            self._add_to_menu(action)
        self._add_models()
        self._add_reports()
        self.offer_packages()

    def _add_guide(self):
        """Let the menu and the toolbar show the dock that leads from files to results."""
        from qgis.PyQt.QtWidgets import QAction

        self.guide_action = QAction(self.provider.icon(), tr("Guide"), self.iface.mainWindow())
        self.guide_action.setToolTip(tr("UrbanMap: from your files to results"))
        self.guide_action.setCheckable(True)
        self.guide_action.toggled.connect(self.show_guide)
        self.iface.addToolBarIcon(self.guide_action)
        self._add_to_menu(self.guide_action)

    def show_guide(self, shown):
        """Show or hide the dock; it is made when it is wanted first."""
        from qgis.PyQt.QtCore import Qt

        from .framework.guide.dock import GuideDock

        if self.guide is None:
            if not shown:
                return
            self.guide = GuideDock(self.iface.mainWindow())
            self.guide.visibilityChanged.connect(self._guide_shown)
            self.iface.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, self.guide)
            self.guide.share_place(self.iface.mainWindow())
        self.guide.setVisible(shown)

    def _guide_shown(self, _visible):
        """Let the button say whether the dock is open, also where it lies behind another one."""
        self.guide_action.blockSignals(True)
        self.guide_action.setChecked(not self.guide.isHidden())
        self.guide_action.blockSignals(False)

    def _remove_guide(self):
        if self.guide is not None:
            self.guide.visibilityChanged.disconnect(self._guide_shown)
            self.guide.shut()
            self.iface.removeDockWidget(self.guide)
            self.guide.setParent(None)
            self.guide.deleteLater()
            self.guide = None
        if self.guide_action is not None:
            self.iface.removeToolBarIcon(self.guide_action)
            self.guide_action = None

    def _add_to_menu(self, action):
        """Add an entry to the plugin's menu."""
        self.iface.addPluginToMenu("UrbanMap", action)
        self.actions.append(action)

    def _add_models(self):
        """Let the menu and the toolbox open the shipped models in the modeller."""
        from qgis.PyQt.QtWidgets import QMenu

        from .framework.model_window import ToolboxEntry
        from .framework.shipped_models import ShippedModel

        menu = QMenu(tr("Open a chain in the modeller"), self.iface.mainWindow())
        for model in self.provider.algorithms():
            if isinstance(model, ShippedModel):
                menu.addAction(model.displayName()).triggered.connect(partial(self.open_model, model.id()))
        menu.menuAction().setIcon(self.provider.icon())
        self._add_to_menu(menu.menuAction())
        self.menus.append(menu)
        self.toolbox_entry = ToolboxEntry()

    def _add_reports(self):
        """Offer the report of each run, and the choice to open reports by themselves."""
        from .framework.report_links import ReportLinks

        self.report_links = ReportLinks(self.iface)
        self._add_to_menu(self.report_links.action(self.iface.mainWindow()))

    def open_model(self, identity, checked=False):
        """Open a copy of a shipped model in QGIS's modeller."""
        from .framework.model_window import open_in_modeller

        open_in_modeller(QgsApplication.processingRegistry().algorithmById(identity))

    def offer_packages(self):
        """Say once, in the message bar, what packages are missing, with a button that installs them."""
        from .framework.packages.install import PackagesBar

        PackagesBar.offer(self.iface, self.install_packages)

    def import_table(self):
        """Show the window that imports trajectories and exterior orientations of other programs."""
        self.guide_action.setChecked(True)
        self.guide.import_table()

    def make_sample_city(self):
        """Show the dialog of the algorithm that makes data to try everything."""
        import processing

        processing.execAlgorithmDialog("urbanmap:samplecity")

    def show_documentation(self):
        """Open the documentation in the browser."""
        from qgis.PyQt.QtCore import QUrl
        from qgis.PyQt.QtGui import QDesktopServices

        from .framework.base import UrbanMapAlgorithm
        from .framework.language.help_page import index_file

        shipped = [item.create() for item in self.provider.algorithms() if isinstance(item, UrbanMapAlgorithm)]
        QDesktopServices.openUrl(QUrl.fromLocalFile(str(index_file(shipped))))

    def install_packages(self):
        """Show the window that installs missing packages."""
        from .framework.packages.install import InstallDialog

        self.dialog = InstallDialog(self.iface.mainWindow())
        self.dialog.show()

    def show_diagnostics(self):
        """Show versions, packages and providers as one text to copy."""
        from .framework.packages.diagnostics import DiagnosticsDialog

        self.dialog = DiagnosticsDialog(self.iface.mainWindow())
        self.dialog.show()

    def unload(self):
        """Take everything away again."""
        self._remove_guide()
        self._end_work()
        end_pooled_threads()
        for action in self.actions:
            self.iface.removePluginMenu("UrbanMap", action)
        self.actions = []
        for menu in self.menus:
            menu.deleteLater()
        self.menus = []
        if self.toolbox_entry is not None:
            self.toolbox_entry.remove()
            self.toolbox_entry = None
        if self.report_links is not None:
            self.report_links.remove()
            self.report_links = None
        if self.provider is not None:
            QgsApplication.processingRegistry().removeProvider(self.provider)
            self.provider = None
        if self.translator is not None:
            stop_speaking(self.translator)
            self.translator = None
        _forget_modules()


    def _end_work(self):
        """End runs at work and close dialogs, whose algorithms would ask for a provider that is gone."""
        from .framework.running.runs_at_work import close_dialogs, end_runs

        if self.provider is not None:
            end_runs(self.provider)
            close_dialogs(self.provider.id())


def _forget_modules() -> None:
    """Let Python load everything anew next time: QGIS only forgets what statements import, not what functions do."""
    package = __name__.rsplit(".", 2)[0]
    for name in [name for name in sys.modules if name.startswith(f"{package}.")]:
        del sys.modules[name]
