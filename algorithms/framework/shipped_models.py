"""The shipped models in the toolbox: under ids without blanks, in the user's language, and as copies to change."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from qgis.core import QgsApplication, QgsProcessing, QgsProcessingModelAlgorithm, QgsXmlUtils
from qgis.PyQt.QtXml import QDomDocument

from .declaring.parameters import UNIT, distance_unit, tr, with_choice_widget, with_files_widget
from .language.language import translated_model

MODELS = Path(__file__).resolve().parents[2] / "resources" / "models"

POINTS_NAMES = ("POINTS", "ALS")
"""Parameters of the models that take point clouds."""


LATIN = re.compile("[A-Za-z]")

READ_KEYS = {"model_group", "parameterDefinitions", "children", "help"}
"""What a model's file must have for its words to be translated."""


class ShippedModel(QgsProcessingModelAlgorithm):
    """A model whose id is another than the name that it shows.

    QGIS takes a model's name for its id, with all its blanks, and keeps no id of its group in a copy.
    """

    def __init__(self, identity: str, group: str, content: Mapping):
        super().__init__()
        self._identity, self._group = identity, group
        self.loadVariant(content)
        self._title = tr(super().displayName())
        for name in self.parameterComponents():  # QGIS's own field would empty what presets say of files
            definition = self.parameterDefinition(name)
            if definition.type() not in ("multilayer", "enum", "distance"):
                continue
            result = definition.clone()
            if definition.type() == "distance":
                result.setDescription(result.description() if distance_unit() else UNIT.sub("", result.description()))
            elif definition.type() == "enum":
                with_choice_widget(result)
            else:
                with_files_widget(result, name in POINTS_NAMES)
            self.updateModelParameter(result)
        self._always = self._let_out()

    def _let_out(self) -> list[str]:
        """Let outputs be left out that the user need not want; names of those that are written all the same.

        What is left out QGIS does not ask of a step, also where the step must write it or another one takes it.
        """
        children, names = self.childAlgorithms().values(), []
        taken = {(source.outputChildId(), source.outputName()) for child in children
                 for sources in child.parameterSources().values() for source in sources}
        for child in children:
            for output in child.modelOutputs().values():
                definition = self.parameterDefinition(f"{child.childId()}:{output.name()}")
                if definition is None:  # later releases name outputs otherwise in models that they wrote themselves
                    continue
                optional = definition.Flag.FlagOptional
                must = not definition.flags() & optional
                if not output.isMandatory() and (must or (child.childId(), output.childOutputName()) in taken):
                    definition.setFlags(definition.flags() | optional)
                    names.append(definition.name())
        return names

    def checkParameterValues(self, parameters, context):
        """What the chain refuses before its work is refused here too: the steps would tell it one after another."""
        accepted, message = super().checkParameterValues(parameters, context)
        chain = QgsApplication.processingRegistry().algorithmById(f"urbanmap:{self._identity.removesuffix('_model')}")
        if not accepted or chain is None:
            return accepted, message
        given = {name.rpartition(":")[2]: value for name, value in parameters.items()}
        return chain.create().checkParameterValues(given, context)

    def processAlgorithm(self, parameters, context, feedback):
        places = {name: QgsProcessing.TEMPORARY_OUTPUT for name in self._always if not parameters.get(name)}
        return super().processAlgorithm({**parameters, **places}, context, feedback)

    def name(self):
        return self._identity

    def displayName(self):
        return self._title

    def flags(self):
        """Opened by the menu, run by `qgis_process`; the toolbox has the chain of the same steps."""
        return super().flags() | self.Flag.FlagHideFromToolbox

    def groupId(self):
        return self._group

    def createInstance(self):
        return ShippedModel(self._identity, self._group, self.toVariant())


def read_model(path: Path, groups: Mapping[str, str]) -> ShippedModel | None:
    """The model of a file; None where this QGIS cannot read it.

    Parameters
    ----------
    groups : names of the groups by their ids.
    """
    file = QDomDocument()
    # Qt 5 and 6 say differently whether they could read it; what they could not is an empty document.
    file.setContent(path.read_bytes())
    content = QgsXmlUtils.readVariant(file.documentElement())
    if not isinstance(content, dict) or not content.keys() >= READ_KEYS:
        return None
    group = content["model_group"]
    return ShippedModel(f"{path.stem.replace('_', '')}_model", group,
                        translated_model(content, groups.get(group, group)))


def keep_earlier_id(model: ShippedModel) -> None:
    """Let the id of version 0.2.0, the English name, stand for the model too: saved models and scripts say it."""
    earlier = f"urbanmap:{QgsProcessingModelAlgorithm.displayName(model)}"
    QgsApplication.processingRegistry().addAlgorithmAlias(earlier, f"urbanmap:{model.name()}")


def editable_copy(model: ShippedModel) -> QgsProcessingModelAlgorithm:
    """The same model without a file, so that saving it asks for one; inputs have QGIS's own fields."""
    copy = QgsProcessingModelAlgorithm()
    copy.loadVariant(model.toVariant())
    title = model.displayName()
    # QGIS names the class of a model exported as Python by the Latin letters of its name, of which there must be one.
    copy.setName(title if LATIN.search(title) else f"{title} {model.name()}")
    for name in copy.parameterComponents():
        result = copy.parameterDefinition(name).clone()
        result.setMetadata({})
        copy.updateModelParameter(result)
    for child in copy.childAlgorithms().values():
        if child.algorithm() is not None:
            child.setDescription(child.algorithm().displayName())
            copy.setChildAlgorithm(child)
    # QGIS 3.22 ends (signal 11) when its modeller runs a model that belongs to nobody.
    copy.setProvider(QgsApplication.processingRegistry().providerById("model"))
    return copy
