"""Shipped models opened in QGIS's modeller, from the menu and from the toolbox."""

from __future__ import annotations

from processing.gui.ContextAction import ContextAction
from processing.gui.ProviderActions import ProviderContextMenuActions
from processing.modeler.ModelerDialog import ModelerDialog
from qgis.core import QgsApplication

from .declaring.parameters import tr
from .shipped_models import ShippedModel, editable_copy


def open_in_modeller(model: ShippedModel) -> ModelerDialog:
    """Show a copy of the model in the modeller; saved there, it stands among the user's own models."""
    window = ModelerDialog.create(editable_copy(model))
    window.update_model.connect(_list_own_models)
    window.show()
    window.activate()
    return window


def _list_own_models() -> None:
    """Let the toolbox see what was saved."""
    QgsApplication.processingRegistry().providerById("model").refreshAlgorithms()


class OpenModel(ContextAction):
    """Entry of the toolbox's menu on a shipped model."""

    def __init__(self):
        super().__init__()
        self.name = tr("Open a copy in the modeller…")

    def isEnabled(self):
        return isinstance(self.itemData, ShippedModel)

    def execute(self):
        open_in_modeller(self.itemData)


class ToolboxEntry:
    """The entry in the toolbox as long as the plugin is there."""

    def __init__(self):
        self._actions = [OpenModel()]
        ProviderContextMenuActions.registerProviderContextMenuActions(self._actions)

    def remove(self) -> None:
        """Take it away."""
        ProviderContextMenuActions.deregisterProviderContextMenuActions(self._actions)
