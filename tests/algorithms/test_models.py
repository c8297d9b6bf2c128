"""The shipped models: listed, sound, in step with the algorithms they are made of, and free to be changed."""

from __future__ import annotations

from pathlib import Path

import pytest

MODELS = Path(__file__).resolve().parents[2] / "resources" / "models"
CHAINS = {"aerial_markings": "aerialmarkings", "buildings_from_als": "buildingsfromals",
          "georeference_mms": "georeferencemms", "lane_map": "lanemap", "road_space": "roadspace"}
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
    listed = QgsApplication.processingRegistry().algorithmById(f"{chain.id()}_model")
    assert listed is not None
    assert listed.groupId() == chain.groupId()
    assert listed.displayName() == model.name() and listed.create().displayName() == model.name()
    assert " " not in listed.id() and listed.create().id() == listed.id()


def test_the_earlier_id_with_blanks_stands_for_the_model(pair):
    from qgis.core import QgsApplication

    model, chain = pair
    old = QgsApplication.processingRegistry().algorithmById(f"urbanmap:{model.name()}")
    assert old is not None and old.id() == f"{chain.id()}_model"
    assert old.id() in [item.id() for item in QgsApplication.processingRegistry().providerById("urbanmap").algorithms()]


def test_fields_of_several_files_keep_presets(pair):
    """QGIS's own field would take the files for layers and lose them."""
    from qgis.core import QgsApplication

    listed = QgsApplication.processingRegistry().algorithmById(f"{pair[1].id()}_model").create()
    fields = [item for item in listed.parameterDefinitions() if item.type() == "multilayer"]
    assert fields
    for field in fields:
        like = pair[1].parameterDefinition(field.name())
        assert field.metadata() == like.metadata()


def test_comments_beside_the_steps_are_in_the_users_language(pair, plugin, monkeypatch):
    from qgis.core import QgsProcessingModelAlgorithm

    language = plugin("algorithms.framework.language.language")
    monkeypatch.setattr(language, "tr", lambda text: f"<{text}>")
    model = QgsProcessingModelAlgorithm()
    assert model.loadVariant(language.translated_model(pair[0].toVariant(), "group"))
    for name, child in pair[0].childAlgorithms().items():
        assert model.childAlgorithm(name).comment().description() == f"<{child.comment().description()}>"


def test_a_copy_to_change_is_a_plain_model_without_a_file(pair, plugin):
    from qgis.core import QgsApplication, QgsProcessingModelAlgorithm

    model, chain = pair
    listed = QgsApplication.processingRegistry().algorithmById(f"{chain.id()}_model")
    copy = plugin("algorithms.framework.shipped_models").editable_copy(listed)
    assert type(copy) is QgsProcessingModelAlgorithm
    assert copy.validate() == (True, []) and copy.sourceFilePath() == "" and copy.name() == model.name()
    # Run from the modeller of QGIS 3.22, a model of no provider ends QGIS.
    assert copy.create().provider().id() == "model"
    assert set(copy.childAlgorithms()) == set(model.childAlgorithms())
    assert all(not copy.parameterDefinition(name).metadata() for name in copy.parameterComponents())
    for child in copy.childAlgorithms().values():
        theirs = model.childAlgorithm(child.childId())
        assert child.description() == child.algorithm().displayName()
        assert set(child.parameterSources()) == set(theirs.parameterSources())
        assert set(child.modelOutputs()) == set(theirs.modelOutputs())


def test_a_copy_with_a_japanese_name_is_exported_as_python_that_can_be_read(pair, plugin, monkeypatch):
    from qgis.core import QgsApplication, QgsProcessing

    listed = QgsApplication.processingRegistry().algorithmById(f"{pair[1].id()}_model").create()
    monkeypatch.setattr(listed, "_title", "車線地図（モデル）")
    copy = plugin("algorithms.framework.shipped_models").editable_copy(listed)
    assert copy.name() == f"車線地図（モデル） {listed.name()}"
    kind = QgsProcessing.PythonOutputType.PythonQgsProcessingAlgorithmSubclass
    compile("\n".join(copy.asPythonCode(kind, 4)), "exported", "exec")


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
        # QGIS 3.40 reads an empty text of a model's file as none.
        assert ((mine.defaultValue() in (None, "") and theirs.defaultValue() in (None, ""))
                or mine.defaultValue() == theirs.defaultValue()), REMEDY
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
