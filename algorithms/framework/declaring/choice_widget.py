"""The field for a choice in dialogs and batch tables: it shows words of the user's language for the values."""

from __future__ import annotations

from qgis.PyQt.QtWidgets import QComboBox

from .field_of_dialog import FieldOfDialog, FieldWrapper


class _ChoiceWrapper(FieldWrapper):
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


class ChoiceWidget(FieldOfDialog):
    """The field of a choice: values, inputs and expressions in the modeller."""

    WRAPPER = _ChoiceWrapper
