"""Every algorithm runs into temporary places, as an exported model of one step, on small real input.

The runs are those of every_algorithm.py; the inputs come from results shared with test_every_algorithm.py.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

_SPEC = importlib.util.spec_from_file_location("urbanmap_every_results", Path(__file__).with_name("every_results.py"))
shared = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(shared)
every, place, made, inputs = shared.every, shared.place, shared.made, shared.inputs

LONG = {"samplecity", "georeferencemms", "adjustsurveys", "calibratescanner"}
"""More than four seconds: no models of one step here; their own tests run all but the city into temporary places."""


@pytest.mark.parametrize("name", [name for name in every.RECIPES if name not in LONG])
def test_as_an_exported_model_into_temporary_places(run, inputs, name):
    """A model of this one step, exported as Python by QGIS, hands the places that it is given on to the step."""
    exported, given = exported_model(name, inputs(name))
    asked = {item.name(): "TEMPORARY_OUTPUT" for item in exported.parameterDefinitions() if item.isDestination()}
    results = run(exported, {**given, **asked})
    assert_whole(run, [item for item in exported.parameterDefinitions() if item.isDestination()], results, asked)


def assert_whole(run, definitions, results, asked):
    """All that was asked for is there, and no place that the run used for itself is named to the user."""
    shared.assert_all_there(definitions, results, asked)
    assert not [word for word in run.feedback.warnings if ".urbanmap-" in word]


def exported_model(name, given):
    """The algorithm that QGIS writes for a model of one step with fixed inputs, and what it needs."""
    from qgis.core import (
        QgsProcessing,
        QgsProcessingAlgorithm,
        QgsProcessingModelAlgorithm,
        QgsProcessingModelChildAlgorithm,
        QgsProcessingModelChildParameterSource,
        QgsProcessingModelOutput,
    )

    model, algorithm = QgsProcessingModelAlgorithm(name.replace(" ", ""), "trials"), shared.algorithm_of(name)
    child = QgsProcessingModelChildAlgorithm(algorithm.id())
    child.setChildId("step")
    for key, value in given.items():
        child.addParameterSources(key, [QgsProcessingModelChildParameterSource.fromStaticValue(value)])
    outputs = {}
    for key in shared.wanted(name, given):
        output = QgsProcessingModelOutput(key, key)
        output.setChildId("step")
        output.setChildOutputName(key)
        outputs[key] = output
    child.setModelOutputs(outputs)
    model.addChildAlgorithm(child)
    model.updateDestinationParameters()
    code = "\n".join(model.asPythonCode(QgsProcessing.PythonOutputType.PythonQgsProcessingAlgorithmSubclass, 4))
    scope: dict = {}
    exec(compile(code, "exported", "exec"), scope)
    exported = next(item for item in scope.values() if isinstance(item, type)
                    and issubclass(item, QgsProcessingAlgorithm) and item is not QgsProcessingAlgorithm)()
    exported.initAlgorithm()
    return exported, {}
