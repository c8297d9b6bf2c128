"""Fields of the plugin in dialogs and batch tables; in the modeller QGIS's own."""

from __future__ import annotations

from processing.gui.wrappers import WidgetWrapper
from qgis.gui import QgsGui
from qgis.PyQt.QtCore import QCoreApplication


class FieldWrapper(WidgetWrapper):
    """Stands between a dialog of Processing and a field, and says what QGIS says in QGIS's own words."""

    def tr(self, text: str, *_context) -> str:
        """QGIS's words for its own text: by themselves they are looked for under the name of the class at hand."""
        return QCoreApplication.translate("WidgetWrapper", text)


class FieldOfDialog:
    """What QGIS makes of the metadata of a parameter: a `WRAPPER`, or in the modeller the field that QGIS has there."""

    WRAPPER: type[FieldWrapper]

    def __new__(cls, parameter, dialog, row=0, column=0):
        if not hasattr(dialog, "childId"):
            return cls.WRAPPER(parameter, dialog, row, column)
        wrapper = QgsGui.processingGuiRegistry().createModelerParameterWidget(
            dialog.model, dialog.childId, parameter, dialog.context)
        wrapper.setDialog(dialog)
        return wrapper
