"""The user's language: QGIS's own, where there is a translation of UrbanMap."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from qgis.core import QgsApplication
from qgis.PyQt.QtCore import QCoreApplication, QTranslator

from ....urbanmap_qgis.wording import use_catalogue
from ..declaring.parameters import UNIT, choice_help, tr

TRANSLATIONS = Path(__file__).resolve().parents[3] / "resources" / "translations"


def speak_language(code: str = "") -> QTranslator | None:
    """Say everything in the language of QGIS (or of `code`, such as "ja"); None where there is no translation.

    Qt and the core, which needs no Qt for it, read the same compiled file. The translator speaks as long as it is kept.
    """
    compiled = TRANSLATIONS / f"{(code or QgsApplication.locale())[:2]}.qm"
    if not compiled.is_file():
        return None
    use_catalogue(compiled)
    translator = QTranslator()
    # Qt would map the file into memory and QGIS die when an update writes over it: QGIS unpacks before it unloads.
    translator.data = compiled.read_bytes()  # Qt does not copy it
    translator.loadFromData(translator.data)
    QCoreApplication.installTranslator(translator)
    return translator


def stop_speaking(translator: QTranslator) -> None:
    """Go back to English."""
    QCoreApplication.removeTranslator(translator)
    use_catalogue(None)


def translated_model(content: Mapping, group: str) -> dict:
    """The content of a model's file with its labels, comments and help in the user's language; its name stays, for
    saved models say it.

    The content is translated and not the model made of it: QGIS makes all of a model's steps anew for each question.
    """
    choices = {name: values["options"] for name, values in content["parameterDefinitions"].items()
               if values["parameter_type"] == "enum"}
    definitions = {name: {**values, "description": _label(values["description"]),
                          "help": _help(values["help"], choices.get(name))}
                   for name, values in content["parameterDefinitions"].items()}
    children = {name: {**child, "comment": _comment(child["comment"]), "outputs": {
        output: {**values, "component_description": tr(values["component_description"])}
        for output, values in (child["outputs"] or {}).items()}} for name, child in content["children"].items()}
    helps = {key: _help(text, choices.get(key)) if isinstance(text, str) else text
             for key, text in (content["help"] or {}).items()}
    return {**content, "model_group": tr(group), "parameterDefinitions": definitions, "children": children,
            "help": helps}


def _comment(comment: Mapping) -> dict:
    """The box beside a step that says what the step does."""
    return {**comment, "component_description": tr(comment["component_description"])}


def _help(text: str, values: Sequence[str] | None) -> str:
    """A help in the user's language; of a choice, with words for its values."""
    if not text:
        return text
    return choice_help(text, values) if values else tr(text)


def _label(text: str) -> str:
    """A label with its unit behind it."""
    unit = "".join(UNIT.findall(text))
    words = text[:len(text) - len(unit)]
    return tr(words) + (f" ({tr(unit[2:-1])})" if unit else "")
