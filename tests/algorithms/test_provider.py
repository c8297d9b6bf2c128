"""The provider: what it lists, how it bears broken modules, models, and packages that are not there."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from scripts.budget import BUDGET

ROOT = Path(__file__).resolve().parents[2]
CONTRACT = ("buildingoutlines", "updatebuildings",
            "samplecity", "surfacefromals", "occlusionmap", "orthorectifyframes", "filtervehicles",
            "roadmarkingsfromorthophoto", "aerialmarkings",
            "registermms", "adjustsurveys", "calibratescanner",
            "georeferencemms", "applytrajectory", "landmarkupdate", "checkaccuracy", "loadgsi", "checkmodel",
            "facadetextures", "objectsfromimages", "overlayonimages", "groundfrommms", "roadmarkingsfrommms",
            "georeferencescans", "rectifytrajectory", "tiepointproposals",
            "loadgsibuildings", "loadgsidem", "loadcitymodel", "convertheights",
            "segmentbuildings", "segmentroofs", "roofpolygons",
            "buildingmodels", "wallsfrommms", "mergebuildingmodels", "mesh25d", "exportcitymodel", "checkcitymodel",
            "buildingsfromals", "tiledrun", "runjob",
            "satellitevisibility", "gnssreflections", "adjustwalls", "markinglines", "vectormap", "checkvectormap",
            "comparemaps", "lanemap", "roadedges", "localisationaccuracy", "acceptance", "roadmodel", "adjustframes",
            "streetobjects", "adjustals", "roadspace")

LIST_WITHOUT_PACKAGES = """
import sys
sys.path.insert(0, {folder!r})
import conftest

class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name in {names!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

for name in {names!r}:
    sys.modules.pop(name, None)
sys.meta_path.insert(0, Blocker())
from qgis.core import QgsApplication
application = QgsApplication([], False, {profile!r})
application.initQgis()
plugin = conftest.load_plugin().classFactory(None)
plugin.initProcessing()
print("listed", *sorted(item.name() for item in plugin.provider.algorithms()))
"""


def algorithm_names() -> set[str]:
    """Ids of the algorithms as the files in the groups' folders state them, read without importing them."""
    texts = (path.read_text(encoding="utf-8") for path in (ROOT / "algorithms").glob("*/*.py"))
    return {name for text in texts for name in re.findall(r'^    ID = "(\w+)"$', text, re.MULTILINE)}


@pytest.fixture
def provider(qgis_app):
    from qgis.core import QgsApplication

    return QgsApplication.processingRegistry().providerById("urbanmap")


@pytest.fixture
def log(qgis_app):
    from qgis.core import QgsApplication

    lines = []
    receiver = QgsApplication.messageLog().messageReceived[str, str, "Qgis::MessageLevel"]

    def keep(text, tag, level):
        lines.append((tag, text))

    receiver.connect(keep)
    yield lines
    receiver.disconnect(keep)


def test_provider_says_who_it_is(provider):
    assert provider.name() == "UrbanMap"
    assert not provider.icon().isNull()
    assert re.fullmatch(r"\d+\.\d+\.\d+", provider.versionInfo())


def test_every_listed_module_is_there(provider, plugin):
    listed = algorithm_names()
    assert listed <= {item.name() for item in provider.algorithms()}
    assert listed <= set(CONTRACT)


def test_toolbox_stays_within_the_budget(provider):
    from qgis.core import QgsProcessingAlgorithm

    hidden = QgsProcessingAlgorithm.Flag.FlagHideFromToolbox | QgsProcessingAlgorithm.Flag.FlagDeprecated
    shown = [item.name() for item in provider.algorithms() if not item.flags() & hidden]
    assert len(shown) <= BUDGET["algorithms and models in the toolbox"]


def test_every_algorithm_is_complete(provider, plugin):
    base = plugin("algorithms.framework.base").UrbanMapAlgorithm
    groups = plugin("algorithms.framework.base").GROUPS
    known = plugin("urbanmap_qgis.dependencies").PACKAGES
    for listed in provider.algorithms():
        algorithm = listed.create()
        if not isinstance(algorithm, base):
            continue
        assert algorithm.name() == algorithm.ID == algorithm.ID.lower()
        assert algorithm.displayName() and algorithm.HELP and algorithm.tags()
        assert algorithm.groupId() in groups
        assert not algorithm.icon().isNull()
        assert set(algorithm.REQUIRES) <= set(known)
        for definition in algorithm.parameterDefinitions():
            assert definition.name() == definition.name().upper(), (algorithm.ID, definition.name())
            assert definition.help().strip(), (algorithm.ID, definition.name())
            assert definition.description().strip(), (algorithm.ID, definition.name())
        for output in algorithm.outputDefinitions():
            text = algorithm.output_helps().get(output.name())
            parameter = algorithm.parameterDefinition(output.name())
            assert text or (parameter is not None and parameter.help()), (algorithm.ID, output.name())


def test_no_file_is_refused_for_its_suffix(provider):
    files = [(algorithm.name(), definition) for algorithm in provider.algorithms()
             for definition in algorithm.parameterDefinitions()
             if definition.type() == "file" and definition.behavior() == definition.Behavior.File]
    assert len(files) > 20
    assert [(name, definition.name()) for name, definition in files
            if not definition.checkValueIsAcceptable("/data/a.ori")] == []


def test_icons_of_all_groups_are_there(plugin):
    base = plugin("algorithms.framework.base")
    assert all((base.ICONS / f"{group}.svg").is_file() for group in base.GROUPS)


def test_styles_that_algorithms_name_are_there():
    text = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "algorithms").rglob("*.py"))
    named = re.findall(r'style="(\w+)"|"\w*(?:Polygon|Point|LineString|NoGeometry)Z?",\s+"(\w+)"', text)
    assert named
    for style in {name for pair in named for name in pair if name}:
        assert (ROOT / "resources" / "styles" / f"{style}.qml").is_file(), style


def test_broken_module_is_named_and_hides_nothing(provider, plugin, monkeypatch, log):
    module = plugin("algorithms.provider")
    before = {item.name() for item in provider.algorithms()}
    found = module.algorithm_modules()
    monkeypatch.setattr(module, "algorithm_modules", lambda: [".gnss.nosuchmodule", *found])
    provider.refreshAlgorithms()
    assert {item.name() for item in provider.algorithms()} == before
    ((tag, text),) = [line for line in log if "nosuchmodule" in line[1]]
    assert tag == "UrbanMap"
    assert text.startswith("The module .gnss.nosuchmodule cannot be loaded:")


def test_models_are_registered_with_their_outputs(provider, plugin, monkeypatch, tmp_path, log):
    from qgis.core import (
        QgsProcessingModelAlgorithm,
        QgsProcessingModelChildAlgorithm,
        QgsProcessingModelChildParameterSource,
        QgsProcessingModelOutput,
        QgsProcessingModelParameter,
        QgsProcessingParameterFile,
    )

    model = QgsProcessingModelAlgorithm("oneload", "Workflows")
    model.addModelParameter(QgsProcessingParameterFile("INPUT", "Outlines"), QgsProcessingModelParameter("INPUT"))
    step = QgsProcessingModelChildAlgorithm("urbanmap:loadgsibuildings")
    step.setChildId("load")
    step.addParameterSources("INPUT", [QgsProcessingModelChildParameterSource.fromModelParameter("INPUT")])
    output = QgsProcessingModelOutput("Footprints", "Footprints")
    output.setChildId("load")
    output.setChildOutputName("OUTPUT")
    step.setModelOutputs({"Footprints": output})
    model.addChildAlgorithm(step)
    assert model.toFile(str(tmp_path / "oneload.model3"))
    (tmp_path / "torn.model3").write_text("<model", encoding="utf-8")

    monkeypatch.setattr(plugin("algorithms.provider"), "MODELS", tmp_path)
    provider.refreshAlgorithms()
    listed = provider.algorithm("oneload_model")
    # The name on the command line: QGIS 3.22 has the first, current releases the second.
    assert [item.name() for item in listed.outputDefinitions()] in (["load:Footprints"], ["footprints"])
    assert [text for tag, text in log if tag == "UrbanMap"] == ["The model torn.model3 cannot be loaded."]
    monkeypatch.undo()
    provider.refreshAlgorithms()
    assert provider.algorithm("oneload_model") is None


def test_file_outputs_of_earlier_steps_can_be_chosen_as_points(provider):
    """What the modeller of QGIS 3.22 offers for a multiple-files parameter: files, and outputs that are files."""
    from qgis.core import (
        QgsProcessingModelAlgorithm,
        QgsProcessingModelChildAlgorithm,
        QgsProcessingOutputFile,
        QgsProcessingParameterFile,
    )

    model = QgsProcessingModelAlgorithm("chain", "Workflows")
    for identifier, algorithm in (("first", "segmentbuildings"), ("second", "segmentroofs")):
        step = QgsProcessingModelChildAlgorithm(f"urbanmap:{algorithm}")
        step.setChildId(identifier)
        model.addChildAlgorithm(step)
    sources = model.availableSourcesForChild(
        "second", [QgsProcessingParameterFile.typeName()], [QgsProcessingOutputFile.typeName()])
    assert ("first", "OUTPUT") in [(item.outputChildId(), item.outputName()) for item in sources]


def test_listed_while_packages_are_missing(tmp_path, plugin):
    names = [name for name in plugin("urbanmap_qgis.dependencies").PACKAGES if name != "numpy"]
    code = LIST_WITHOUT_PACKAGES.format(folder=str(Path(__file__).parent), names=names, profile=str(tmp_path))
    environment = dict(os.environ, QGIS_CUSTOM_CONFIG_PATH=str(tmp_path))
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False,
                          env=environment, timeout=120)
    listed = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("listed")]
    modules = algorithm_names()
    assert listed and modules <= set(listed[0]), done.stderr
