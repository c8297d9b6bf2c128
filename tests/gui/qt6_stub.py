"""QGIS's modules over PyQt6 where no QGIS of Qt 6 is to be had: Qt for real, QGIS's own classes as names alone.

Run as a script it imports every module of `algorithms`, which evaluates what their classes take from Qt, builds the
windows and uses them, and prints what went wrong.
"""

from __future__ import annotations

import importlib
import importlib.util
import pkgutil
import sys
import traceback
import types
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class _Names(type):
    """A class whose attributes are there whatever their name, as QGIS's constants and methods are."""

    def __getattr__(cls, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return Name


class Name(metaclass=_Names):
    """Stands for a class, a value or the result of a call of QGIS."""

    def __init__(self, *_arguments, **_named):
        pass

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return Name()

    def __call__(self, *_arguments, **_named):
        return Name()

    def __iter__(self):
        return iter(())

    def __or__(self, other):
        return self

    __ror__ = __or__

    def __str__(self):
        return "name"


class Stub(types.ModuleType):
    """A module of QGIS: every name that is asked for is a class of its own, to inherit from."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        made = _Names(name, (Name,), {})
        setattr(self, name, made)
        return made


def install() -> None:
    """Put the modules where they are imported from."""
    from PyQt6 import QtCore, QtGui, QtWidgets, QtXml, sip

    for name in ("qgis", "qgis.core", "qgis.gui", "qgis.PyQt", "processing", "processing.gui",
                 "processing.gui.wrappers", "processing.gui.ContextAction", "processing.gui.ProviderActions",
                 "processing.modeler", "processing.modeler.ModelerDialog", "processing.core",
                 "processing.core.Processing"):
        sys.modules[name] = Stub(name)
        sys.modules[name].__path__ = []
    for module in (QtCore, QtGui, QtWidgets, QtXml, sip):
        sys.modules[f"qgis.PyQt.{module.__name__.rpartition('.')[2]}"] = module
    sys.modules["qgis.PyQt"].sip = sip
    QtWidgets.QAction = QtGui.QAction  # QGIS's own layer does the same

    class Task(QtCore.QObject):
        Flag = Name

        def __init__(self, *_arguments):
            super().__init__()

    sys.modules["qgis.core"].QgsTask = Task
    sys.modules["qgis.core"].Qgis.QGIS_VERSION_INT = 40000
    sys.modules["qgis.core"].Qgis.QGIS_VERSION = "4.0.0"


def load() -> types.ModuleType:
    """The checkout as QGIS loads a plugin folder."""
    spec = importlib.util.spec_from_file_location("urbanmap_plugin", ROOT / "__init__.py",
                                                  submodule_search_locations=[str(ROOT)])
    module = importlib.util.module_from_spec(spec)
    sys.modules["urbanmap_plugin"] = module
    spec.loader.exec_module(module)
    return module


def imported() -> tuple[int, list[str]]:
    """How many modules of `algorithms` are imported, and what those say that are not."""
    package = importlib.import_module("urbanmap_plugin.algorithms")
    names = [item.name for item in pkgutil.walk_packages(package.__path__, package.__name__ + ".")]
    wrong = []
    for name in names:
        try:
            importlib.import_module(name)
        except Exception:
            wrong.append(f"{name}: {traceback.format_exc(limit=-1)}")
    return len(names) - len(wrong), wrong


def windows() -> list[str]:
    """Names of the windows and fields that were built and used."""
    from PyQt6.QtCore import QMimeData, QPointF, Qt, QUrl
    from PyQt6.QtGui import QDropEvent
    from PyQt6.QtWidgets import QApplication, QPushButton

    application = QApplication.instance() or QApplication([])
    install_window = importlib.import_module("urbanmap_plugin.algorithms.framework.packages.install")
    dialog = install_window.InstallDialog()
    assert isinstance(dialog.button, QPushButton) and dialog.label.text()
    dialog._ended("done")
    task = install_window.InstallTask([], "")
    heard = []
    task.printed.connect(heard.append)
    task.printed.emit("line")
    assert heard == ["line"]
    files = importlib.import_module("urbanmap_plugin.algorithms.framework.declaring.files_widget")
    field = files.FilesField("Points", False)
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile("/data/a b.laz"), QUrl.fromLocalFile("/data/c.laz")])
    field.dropEvent(QDropEvent(QPointF(1, 1), Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton,
                               Qt.KeyboardModifier.NoModifier))
    assert field.files == ["/data/a b.laz", "/data/c.laz"], field.files
    field.line.setText('"/data/d e.laz" "/data/f.laz"')
    field.line.editingFinished.emit()
    assert field.files == ["/data/d e.laz", "/data/f.laz"], field.files
    chooser = files.FilesDialog("Points", field.files, {"/data/g.laz": "g"})
    assert chooser.chosen() == field.files
    for window in (dialog, field, chooser):
        window.show()
    application.processEvents()
    return [type(window).__name__ for window in (dialog, field, chooser)]


def main() -> int:
    install()
    load()
    count, wrong = imported()
    print("\n".join(wrong))
    print(f"{count} modules imported, {len(wrong)} not; windows: {', '.join(windows())}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
