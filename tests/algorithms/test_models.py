"""The shipped models: listed, sound, in step with the algorithms they are made of, and free to be changed."""

from __future__ import annotations

from pathlib import Path

import pytest

MODELS = Path(__file__).resolve().parents[2] / "resources" / "models"
CHAINS = {"aerial_markings": "aerialmarkings", "buildings_from_als": "buildingsfromals",
          "georeference_mms": "georeferencemms", "lane_map": "lanemap"}
REMEDY = "run scripts/make_models.py"


@pytest.fixture(params=CHAINS)
def pair(request, qgis_app):
    """A model as read from its file, and the algorithm whose chain it is."""
    from qgis.core import QgsApplication, QgsProcessingModelAlgorithm

    model = QgsProcessingModelAlgorithm()
    assert model.fromFile(str(MODELS / f"{request.param}.model3"))
    return model, QgsApplication.processingRegistry().algorithmById(f"urbanmap:{CHAINS[request.param]}")


def test_each_model_file_is_known():
    assert {path.stem for path in MODELS.glob("*.model3")} == set(CHAINS)


def test_the_provider_lists_the_model_in_the_group_of_its_chain(pair):
    from qgis.core import QgsApplication

    model, chain = pair
    listed = QgsApplication.processingRegistry().algorithmById(f"urbanmap:{model.name()}")
    assert listed is not None
    assert listed.groupId() == chain.groupId()


def test_the_model_is_sound(pair):
    assert pair[0].validate() == (True, [])


def test_the_model_has_the_chains_parameters(pair):
    model, chain = pair
    wanted = [item for item in chain.parameterDefinitions() if not item.isDestination()]
    have = [item for item in model.parameterDefinitions() if not item.isDestination()]
    assert [item.name() for item in have] == [item.name() for item in wanted], REMEDY
    for mine, theirs in zip(have, wanted):
        assert mine.type() == theirs.type(), REMEDY
        assert mine.description() == theirs.description(), REMEDY
        assert mine.defaultValue() == theirs.defaultValue(), REMEDY
        assert mine.flags() == theirs.flags(), REMEDY
        assert mine.help() == theirs.help(), REMEDY


def test_the_model_has_the_chains_outputs(pair):
    model, chain = pair
    wanted = {item.name(): item.type() for item in chain.parameterDefinitions() if item.isDestination()}
    have = {item.name().partition(":")[2]: item.type() for item in model.parameterDefinitions() if item.isDestination()}
    assert have == wanted, REMEDY


def kinds_of_source():
    """The enum of where a step's parameter comes from; it moved to `Qgis` in 3.34."""
    from qgis.core import Qgis, QgsProcessingModelChildParameterSource

    return getattr(Qgis, "ProcessingModelChildParameterSource", QgsProcessingModelChildParameterSource)


def test_every_parameter_is_used_by_a_step(pair):
    model, _ = pair
    used = {source.parameterName() for child in model.childAlgorithms().values()
            for sources in child.parameterSources().values() for source in sources
            if source.source() == kinds_of_source().ModelParameter}
    assert used == {item.name() for item in model.parameterDefinitions() if not item.isDestination()}


def test_fixed_values_are_the_steps_own_defaults(pair):
    model, _ = pair
    for child in model.childAlgorithms().values():
        for name, sources in child.parameterSources().items():
            for source in sources:
                if source.source() == kinds_of_source().StaticValue:
                    default = child.algorithm().parameterDefinition(name).defaultValue()
                    assert source.staticValue() == default, f"{child.childId()} {name}: {REMEDY}"


def test_boxes_do_not_overlap(pair):
    from qgis.PyQt.QtCore import QRectF

    model, _ = pair
    children = list(model.childAlgorithms().values())
    outputs = [output for child in children for output in child.modelOutputs().values()]
    parts = [*model.parameterComponents().values(), *children, *(child.comment() for child in children), *outputs]
    boxes = [QRectF(part.position().x() - part.size().width() / 2, part.position().y() - part.size().height() / 2,
                    part.size().width(), part.size().height()) for part in parts]
    for place, box in enumerate(boxes):
        assert not any(box.intersects(other) for other in boxes[place + 1:])


def test_each_step_says_what_it_does(pair):
    for child in pair[0].childAlgorithms().values():
        assert len(child.comment().description()) > 20
