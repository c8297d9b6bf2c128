"""The field for a choice in dialogs and batch tables: it shows words of the user's language for the values."""

from __future__ import annotations

from processing.gui.wrappers import WidgetWrapper
from qgis.gui import QgsGui
from qgis.PyQt.QtWidgets import QComboBox


class ChoiceWidget:
    """What QGIS makes of the metadata of a parameter: the field of this module, in the modeller QGIS's own."""

    def __new__(cls, parameter, dialog, row=0, column=0):
        if not hasattr(dialog, "childId"):
            return _ChoiceWrapper(parameter, dialog, row, column)
        # The modeller, whose field offers values, inputs and expressions.
        wrapper = QgsGui.processingGuiRegistry().createModelerParameterWidget(
            dialog.model, dialog.childId, parameter, dialog.context)
        wrapper.setDialog(dialog)
        return wrapper


class _ChoiceWrapper(WidgetWrapper):
    """Stands between a dialog of Processing and the field."""

    def createWidget(self):
        field = QComboBox()
        definition = self.parameterDefinition()
        words = definition.metadata().get("urbanmap_words", {})
        for value in definition.options():
            field.addItem(words.get(value, value), value)
        field.setCurrentIndex(max(field.findData(definition.defaultValue()), 0))
        field.currentIndexChanged.connect(lambda: self.widgetValueHasChanged.emit(self))
        return field

    def setValue(self, value):
        row = self.widget.findData(value)
        if row < 0 and str(value).isdecimal() and int(value) < self.widget.count():
            row = int(value)  # the number of a value, as scripts may say
        if row >= 0:
            self.widget.setCurrentIndex(row)

    def value(self):
        return self.widget.currentData()
