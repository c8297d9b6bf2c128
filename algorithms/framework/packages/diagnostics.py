"""Everything that one asks about an installation, as one text to copy."""

from __future__ import annotations

import importlib.util
import os
import platform
import sys

from qgis.core import Qgis, QgsApplication, QgsProviderRegistry
from qgis.PyQt.QtCore import PYQT_VERSION_STR, QT_VERSION_STR
from qgis.PyQt.QtGui import QFontDatabase, QGuiApplication
from qgis.PyQt.QtWidgets import QDialog, QDialogButtonBox, QPlainTextEdit, QVBoxLayout

from ....urbanmap_qgis.dependencies import PACKAGES, find_missing, installed_version
from ..declaring.parameters import tr
from ..version import plugin_version
from .dependencies import profile_packages


def diagnostics() -> str:
    """Versions, packages and where each comes from, providers; in English, as developers read it."""
    missing = {item.package.import_name: item for item in find_missing()}
    lines = [f"UrbanMap {plugin_version()}", f"QGIS {Qgis.QGIS_VERSION}",
             f"Qt {QT_VERSION_STR}, PyQt {PYQT_VERSION_STR}", f"Python {sys.version.split()[0]}, {sys.executable}",
             f"{platform.platform()}, {os.cpu_count()} processors", f"language {QgsApplication.locale()}",
             f"profile {QgsApplication.qgisSettingsDirPath()}", f"packages folder {profile_packages()}", "",
             "Python packages"]
    lines += [_package_line(name, missing) for name in PACKAGES]
    lines += ["", "Algebra of numpy", *_algebra(), "", "Providers of QGIS",
              "  data: " + ", ".join(sorted(QgsProviderRegistry.instance().providerList())),
              "  processing: " + ", ".join(sorted(f"{item.id()} ({len(item.algorithms())})" for item in
                                                  QgsApplication.processingRegistry().providers()))]
    return "\n".join(lines) + "\n"


def _package_line(name: str, missing: dict) -> str:
    """Version and folder of a package, and whether it is the one that works."""
    spec = importlib.util.find_spec(name)
    if spec is None:
        return f"  {name}: missing ({PACKAGES[name].requirement})"
    folder = os.path.dirname(os.path.dirname(spec.origin)) if spec.origin else "no folder"
    state = f", does not work: {missing[name]}" if name in missing else ""
    loaded = ", loaded" if name in sys.modules else ""
    return f"  {name} {installed_version(PACKAGES[name]) or 'without a version'}, {folder}{loaded}{state}"


def _algebra() -> list[str]:
    """What numpy multiplies matrices with, of the libraries that it says it was built with."""
    import numpy

    try:
        libraries = numpy.show_config(mode="dicts")["Build Dependencies"]
    except TypeError:  # numpy before 1.25 prints it and hands nothing over
        libraries = {name: getattr(numpy.__config__, f"{name}_opt_info", {}) for name in ("blas", "lapack")}
    return [f"  {name}: " + ", ".join(f"{key} {value}" for key, value in sorted(entry.items())
                                      if key in ("name", "version", "libraries", "library_dirs"))
            for name, entry in sorted(libraries.items()) if name in ("blas", "lapack")]


class DiagnosticsDialog(QDialog):
    """Shows the text, with a button that copies it."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setWindowTitle(tr("UrbanMap: diagnostics"))
        self.resize(720, 480)
        self.text = QPlainTextEdit(diagnostics())
        self.text.setReadOnly(True)
        self.text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        self.button = buttons.addButton(tr("Copy"), QDialogButtonBox.ButtonRole.ActionRole)
        self.button.clicked.connect(lambda: QGuiApplication.clipboard().setText(self.text.toPlainText()))
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        for widget in (self.text, buttons):
            layout.addWidget(widget)
