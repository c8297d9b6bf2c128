"""The plugin in the desktop: its menu, and the window that installs packages."""

from __future__ import annotations

import sys
import time

import pytest


class Interface:
    """As much of QGIS's `iface` as the plugin uses."""

    def __init__(self, window):
        self.window = window
        self.menus = {}

    def addToolBarIcon(self, action):
        self.tools = [action]

    def removeToolBarIcon(self, action):
        self.tools.remove(action)

    def messageBar(self):
        from qgis.gui import QgsMessageBar

        self.bar = getattr(self, "bar", None) or QgsMessageBar()
        return self.bar

    def mainWindow(self):
        return self.window

    def addPluginToMenu(self, menu, action):
        self.menus.setdefault(menu, []).append(action)

    def removePluginMenu(self, menu, action):
        self.menus[menu].remove(action)


@pytest.fixture
def missing(plugin, monkeypatch):
    """One package that is not there until it is installed, and an installer that only says so."""
    module = plugin("algorithms.framework.packages.install")
    dependencies = plugin("urbanmap_qgis.dependencies")
    item = dependencies.Missing(dependencies.Package("urbanmap_toy", "urbanmap-toy"))
    state = {"missing": [item], "error": None}

    def install(items, folder, report, cancelled, pip_options=()):
        report(f"Collecting {items[0]}")
        if state["error"]:
            raise dependencies.InstallError(state["error"])
        state["missing"] = []

    monkeypatch.setattr(module, "find_missing", lambda *names: list(state["missing"]))
    monkeypatch.setattr(module, "install", install)
    return state


def wait_until(application, condition):
    end = time.monotonic() + 20
    while not condition() and time.monotonic() < end:
        application.processEvents()
        time.sleep(0.01)
    assert condition()


def test_menu_comes_and_goes_with_the_plugin(qgis_app, plugin, monkeypatch):
    from qgis.core import QgsApplication
    from qgis.PyQt.QtWidgets import QWidget

    interface = Interface(QWidget())
    desktop = plugin("algorithms.plugin").UrbanMapPlugin(interface)
    desktop.provider = plugin("algorithms.provider").UrbanMapProvider()
    desktop.initProcessing = lambda: None
    desktop.initGui()
    assert [action.text() for action in interface.menus["UrbanMap"]] == [
        "Guide", "Import table…", "Sample city…", "Documentation", "Install Python packages…", "Diagnostics…",
        "Open a chain in the modeller", "Open reports in the browser after a run"]
    desktop.provider = None
    monkeypatch.setattr(sys, "modules", dict(sys.modules))  # other tests go on with those that are loaded
    desktop.unload()
    assert interface.menus == {"UrbanMap": []} and interface.tools == []
    assert QgsApplication.processingRegistry().providerById("urbanmap") is not None


def test_window_installs_and_says_so(qgis_app, plugin, missing):
    dialog = plugin("algorithms.framework.packages.install").InstallDialog()
    assert "urbanmap-toy" in dialog.label.text()
    assert "-m pip install" in dialog.output.toPlainText()
    dialog.button.click()
    assert not dialog.button.isEnabled()
    wait_until(qgis_app, lambda: dialog.task is None)
    assert dialog.label.text() == "The packages are installed; the algorithms can be used now."
    assert "Collecting urbanmap-toy" in dialog.output.toPlainText()


def test_window_says_why_it_failed_and_can_try_again(qgis_app, plugin, missing):
    missing["error"] = "pip could not install the packages: no network"
    dialog = plugin("algorithms.framework.packages.install").InstallDialog()
    dialog.button.click()
    wait_until(qgis_app, lambda: dialog.task is None)
    assert dialog.label.text() == "pip could not install the packages: no network"
    assert dialog.button.isEnabled()


def test_nothing_to_install(qgis_app, plugin, missing):
    missing["missing"] = []
    dialog = plugin("algorithms.framework.packages.install").InstallDialog()
    assert not dialog.button.isEnabled()
    assert dialog.label.text() == "All Python packages that UrbanMap needs are there."


def test_message_bar_offers_missing_packages_once(qgis_app, plugin, missing, monkeypatch):
    from types import SimpleNamespace

    from qgis.core import QgsSettings
    from qgis.gui import QgsMessageBar
    from qgis.PyQt.QtWidgets import QPushButton

    offered = plugin("algorithms.framework.packages.install").PackagesBar
    QgsSettings().remove(offered.SETTING)
    bar, pressed = QgsMessageBar(), []
    interface = SimpleNamespace(messageBar=lambda: bar)
    assert offered.offer(interface, lambda: pressed.append(1))
    line = bar.currentItem()
    assert line.text() == "Python packages missing: urbanmap-toy." and line.title() == "UrbanMap"
    (button,) = [item for item in line.findChildren(QPushButton) if item.text() == "Install…"]
    button.click()
    assert pressed == [1]
    assert not offered.offer(interface, pressed.append)  # it was told of the same before
    missing["missing"] = []
    QgsSettings().remove(offered.SETTING)
    assert not offered.offer(interface, pressed.append)


def test_diagnostics_name_versions_packages_and_providers(qgis_app, plugin, monkeypatch):
    import numpy
    from qgis.core import Qgis
    from qgis.PyQt.QtGui import QGuiApplication

    module = plugin("algorithms.framework.packages.diagnostics")
    dialog = module.DiagnosticsDialog()
    text = dialog.text.toPlainText()
    assert f"QGIS {Qgis.QGIS_VERSION}" in text and "Python packages" in text
    assert f"numpy {numpy.__version__}, " in text and "urbanmap (" in text and "  blas: " in text
    for name in plugin("urbanmap_qgis.dependencies").PACKAGES:
        assert f"  {name} " in text
    dialog.button.click()
    assert QGuiApplication.clipboard().text() == text
    dependencies = plugin("urbanmap_qgis.dependencies")
    package = dependencies.Package("urbanmap_absent", "urbanmap-absent", (1, 2), (2,))
    monkeypatch.setattr(module, "PACKAGES", {"urbanmap_absent": package})
    monkeypatch.setattr(module, "find_missing", lambda: [dependencies.Missing(package)])
    assert "urbanmap_absent: missing (urbanmap-absent~=1.2)" in module.diagnostics()


@pytest.fixture
def links(qgis_app, plugin):
    """What offers reports in a window of its own, its message bar, and what was opened in the browser."""
    from types import SimpleNamespace

    from qgis.core import QgsSettings
    from qgis.gui import QgsMessageBar

    module, bar = plugin("algorithms.framework.report_links"), QgsMessageBar()
    QgsSettings().remove(module.SETTING)
    made = module.ReportLinks(SimpleNamespace(messageBar=lambda: bar))
    yield SimpleNamespace(made=made, bar=bar, module=module)
    made.remove()
    QgsSettings().remove(module.SETTING)


def test_a_report_is_offered_and_opened_when_wished(qgis_app, links, monkeypatch):
    from threading import Thread

    from qgis.PyQt.QtWidgets import QPushButton, QWidget

    opened = []
    monkeypatch.setattr(links.module, "open_report", opened.append)
    for name in ("first.html", "second.html"):  # as a run does, in a thread of its own
        thread = Thread(target=links.made.made.emit, args=(f"Report {name}", f"/reports/{name}"))
        thread.start()
        thread.join()
    assert links.bar.currentItem() is None
    wait_until(qgis_app, lambda: [item.text() for item in links.bar.items()] == ["Report second.html"])
    (line,) = links.bar.items()
    (button,) = [item for item in line.findChildren(QPushButton) if item.text() == "Open report"]
    button.click()
    assert opened == ["/reports/second.html"]
    window = QWidget()
    switch = links.made.action(window)
    assert switch.isCheckable() and not switch.isChecked()
    switch.setChecked(True)
    links.made.made.emit("Check accuracy: Report", "/reports/third.html")
    wait_until(qgis_app, lambda: len(opened) == 2)
    assert opened[1] == "/reports/third.html"
