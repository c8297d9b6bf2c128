"""The Processing provider of UrbanMap."""

from __future__ import annotations

import importlib
import pkgutil
import traceback
from collections.abc import Iterator
from pathlib import Path

from qgis.core import Qgis, QgsApplication, QgsMessageLog, QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .framework.base import GROUPS, UrbanMapAlgorithm
from .framework.declaring.parameters import tr
from .framework.earlier_ids import earlier_algorithms
from .framework.shipped_models import MODELS, keep_earlier_id, read_model
from .framework.version import plugin_version

ROOT = Path(__file__).resolve().parent.parent

# What importing a module with a mistake in it raises.
BROKEN_MODULE = (ImportError, SyntaxError, NameError, AttributeError, TypeError, ValueError, OSError)


class UrbanMapProvider(QgsProcessingProvider):
    """Algorithms and models of UrbanMap in the toolbox, the modeller and `qgis_process`."""

    def id(self):
        return "urbanmap"

    def name(self):
        return "UrbanMap"

    def longName(self):
        return tr("UrbanMap: mobile mapping and 3D city models")

    def icon(self):
        return QIcon(str(ROOT / "resources" / "icons" / "urbanmap.svg"))

    def svgIconPath(self):
        return str(ROOT / "resources" / "icons" / "urbanmap.svg")

    def versionInfo(self):
        return plugin_version()

    def register(self) -> None:
        """Add the provider to QGIS, then load its algorithms.

        In this order, because a model finds its steps, and with them its outputs, through the registry.
        """
        QgsApplication.processingRegistry().addProvider(self)
        self.refreshAlgorithms()

    def load(self):
        return True

    def loadAlgorithms(self):
        for module in algorithm_modules():
            try:
                for algorithm in algorithms_of(importlib.import_module(module, __package__)):
                    self.addAlgorithm(algorithm)
            except BROKEN_MODULE:
                self._warn(tr("The module {0} cannot be loaded:").format(module), traceback.format_exc())
        for algorithm in earlier_algorithms(__package__):
            self.addAlgorithm(algorithm)
        for path in sorted(MODELS.glob("*.model3")):
            model = read_model(path, GROUPS)
            if model is None:
                self._warn(tr("The model {0} cannot be loaded.").format(path.name))
                continue
            keep_earlier_id(model)
            self.addAlgorithm(model)

    @staticmethod
    def _warn(sentence: str, detail: str = "") -> None:
        QgsMessageLog.logMessage(f"{sentence}\n{detail}".strip(), "UrbanMap", Qgis.MessageLevel.Warning)


def algorithm_modules() -> list[str]:
    """Relative names of the modules in the groups' folders (".buildings.segmentroofs"), in the order of the groups."""
    folder = Path(__file__).resolve().parent
    return [f".{group}.{module.name}" for group in GROUPS for module in pkgutil.iter_modules([str(folder / group)])]


def algorithms_of(module) -> Iterator[UrbanMapAlgorithm]:
    """An instance of each algorithm that a module defines; none for a module of what a group shares."""
    for kind in vars(module).values():
        if (isinstance(kind, type) and issubclass(kind, UrbanMapAlgorithm) and kind.ID
                and kind.__module__ == module.__name__):
            yield kind()
