"""Choices in QGIS's dialogs: words of the user's language, while values stay what scripts and models say."""

from __future__ import annotations

import pytest


def choices():
    """Algorithm and parameter of every choice."""
    from qgis.core import QgsApplication

    return [(algorithm, item)
            for algorithm in QgsApplication.processingRegistry().providerById("urbanmap").algorithms()
            if hasattr(algorithm, "compute") for item in algorithm.parameterDefinitions() if item.type() == "enum"]


def wrapper_of(definition):
    from processing.gui.wrappers import WidgetWrapperFactory
    from qgis.PyQt.QtWidgets import QDialog

    return WidgetWrapperFactory.create_wrapper(definition, QDialog())


def test_every_choice_keeps_its_values(qgis_app):
    from qgis.core import QgsProcessingContext

    context, asked = QgsProcessingContext(), 0
    for algorithm, definition in choices():
        wrapper = wrapper_of(definition)
        assert wrapper.parameterValue() == definition.defaultValue(), (algorithm.name(), definition.name())
        for number, value in enumerate(definition.options()):
            wrapper.setParameterValue(value, context)
            assert wrapper.parameterValue() == value
            if not value.isdecimal():
                wrapper.setParameterValue(number, context)
                assert wrapper.parameterValue() == value
        asked += 1
    assert asked > 30


def test_the_words_are_shown_and_the_value_is_handed_over(qgis_app):
    from processing.gui.AlgorithmDialog import AlgorithmDialog
    from qgis.core import QgsApplication

    dialog = AlgorithmDialog(QgsApplication.processingRegistry().algorithmById("urbanmap:overlayonimages").create())
    field = dialog.mainWidget().wrappers["COLOUR"].widget
    assert [field.itemText(row) for row in range(field.count())] == [
        "height of the point", "intensity", "class of the point", "one colour"]
    field.setCurrentIndex(3)
    values = (dialog.createProcessingParameters() if hasattr(dialog, "createProcessingParameters")
              else dialog.getParameterValues())
    assert values["COLOUR"] == "one"
    dialog.close()


@pytest.mark.parametrize("value", ["unheard of", None])
def test_a_value_that_is_none_changes_nothing(qgis_app, value):
    from qgis.core import QgsProcessingContext

    _, definition = choices()[0]
    wrapper = wrapper_of(definition)
    wrapper.setParameterValue(value, QgsProcessingContext())
    assert wrapper.parameterValue() == definition.defaultValue()


def test_algorithms_that_are_chosen_have_their_names(qgis_app, plugin):
    from qgis.core import QgsApplication

    words = plugin("algorithms.framework.declaring.choice_words").CHOICE_WORDS
    for value in QgsApplication.processingRegistry().algorithmById("urbanmap:tiledrun").parameterDefinition(
            "ALGORITHM").options():
        assert words[value] == QgsApplication.processingRegistry().algorithmById(f"urbanmap:{value}").displayName()


def test_labels_say_in_qgis_s_own_words_what_is_optional(qgis_app):
    from qgis.core import QgsApplication
    from qgis.PyQt.QtCore import QTranslator

    translator = QTranslator()
    if not translator.load("qgis_ja", QgsApplication.i18nPath()):
        pytest.skip("QGIS's translations are not installed")
    definition = QgsApplication.processingRegistry().algorithmById("urbanmap:acceptance").parameterDefinition("POINTS")
    QgsApplication.installTranslator(translator)
    try:
        wrapper = wrapper_of(definition)
        label = wrapper.createLabel()
        assert label.text().endswith("[オプション]")
    finally:
        QgsApplication.removeTranslator(translator)
