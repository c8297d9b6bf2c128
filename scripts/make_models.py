#!/usr/bin/env python3
"""Write the shipped editable models, resources/models/*.model3, from the algorithms' own parameters.

    python3 scripts/make_models.py

Written by the oldest QGIS that the plugin supports (3.22), they are read by all later ones. Needs a Python that
sees QGIS, and the packages of requirements.txt.
"""

from __future__ import annotations

import importlib.util
import os
import sys
from dataclasses import dataclass, field
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("QT_HASH_SEED", "0")  # the same order of attributes each time

from qgis.core import (
    QgsApplication,
    QgsProcessingModelAlgorithm,
    QgsProcessingModelChildAlgorithm,
    QgsProcessingModelChildParameterSource,
    QgsProcessingModelOutput,
    QgsProcessingModelParameter,
)
from qgis.PyQt.QtCore import QPointF, QSizeF
from qgis.PyQt.QtGui import QColor

ROOT = Path(__file__).resolve().parent.parent
MODELS = ROOT / "resources" / "models"
DATA = ("multilayer", "source", "vector", "raster", "file")

INPUT, STEP, OUTPUT, COMMENT = (QSizeF(210, 40), QSizeF(220, 44), QSizeF(210, 40), QSizeF(300, 56))
COLUMNS = {"inputs": 140.0, "steps": 540.0, "comments": 900.0}
TOP, ROW, STEP_ROW = 80.0, 60.0, 180.0
SETTING_COLOUR, INPUT_COLOUR = QColor("#eef1f4"), QColor("#fff3c4")


@dataclass(frozen=True)
class Step:
    """A step of a model: the algorithm's id, what is told beside it, and where its parameters come from.

    `made` takes another step's output; `note` is a text parameter that takes the model's settings; of the rest, the
    step is given what it shares by name with the model. `outputs` are results of the model: name and label. `named`
    gives the model's name to parameters and outputs of the step that have another name in the model, "" for those of
    one name that have nothing in common. `derived` gives parameters of the step an expression of the model's inputs.
    """

    algorithm: str
    comment: str
    made: dict[str, tuple[str, str]] = field(default_factory=dict)
    note: str = ""
    outputs: dict[str, str] = field(default_factory=dict)
    named: dict[str, str] = field(default_factory=dict)
    derived: dict[str, str] = field(default_factory=dict)

    def name_in_chain(self, name: str) -> str:
        """The model's name of a parameter or output of the step."""
        return self.named.get(name, name)


FULL_OR_PAPER = {"METHOD": "CASE WHEN @METHOD = 'paper' THEN 'paper' ELSE 'full' END"}

BUILDINGS_FROM_ALS = (
    Step("segmentbuildings", "1. Moves each outline to its building and takes the points out of the cloud.",
         derived=FULL_OR_PAPER),
    Step("segmentroofs", "2. Segments the roofs of each building: its planes, or level roofs.", derived=FULL_OR_PAPER,
         made={"POINTS": ("segmentbuildings", "OUTPUT"), "FOOTPRINTS": ("segmentbuildings", "OUTPUT_BUILDINGS")}),
    Step("roofpolygons", "3. Draws the polygon of each roof from its points.",
         made={"POINTS": ("segmentroofs", "OUTPUT"), "FOOTPRINTS": ("segmentbuildings", "OUTPUT_BUILDINGS")}),
    Step("buildingmodels", "4. Joins the roofs to closed solids on the ground, checks and measures each.",
         made={"ROOFS": ("roofpolygons", "OUTPUT"), "FOOTPRINTS": ("segmentbuildings", "OUTPUT_BUILDINGS"),
               "POINTS": ("segmentroofs", "OUTPUT")},
         named={"ROOF_SHAPE": "ROOFS"}, note="NOTE",
         outputs={"OUTPUT": "Building models", "OUTPUT_SURFACES": "Surfaces", "OUTPUT_CITYJSON": "CityJSON",
                  "OUTPUT_MESH": "OBJ mesh", "OUTPUT_MESHES": "2.5D meshes", "OUTPUT_REPORT": "Report"}),
)

AERIAL_MARKINGS = (
    Step("surfacefromals", "1. Makes the surface, which tells what hides the ground, and the bare ground.",
         named={"POINTS": "ALS", "RESOLUTION": "SURFACE_RESOLUTION"}, outputs={"OUTPUT_GROUND": "Ground"}),
    Step("orthorectifyframes", "2. Lays the frames on the ground that they see, without moving vehicles.",
         made={"GROUND": ("surfacefromals", "OUTPUT_GROUND"), "DSM": ("surfacefromals", "OUTPUT")},
         named={"OUTPUT": "OUTPUT_ORTHOPHOTO"},
         outputs={"OUTPUT": "Orthophoto", "OUTPUT_SHIFTS": "Shifts between images"}),
    Step("roadmarkingsfromorthophoto", "3. Finds the road markings, with their heights, and reports on them.",
         made={"INPUT": ("orthorectifyframes", "OUTPUT"), "GROUND": ("surfacefromals", "OUTPUT_GROUND"),
               "SHIFTS": ("orthorectifyframes", "OUTPUT_SHIFTS"),
               "FRAME_COUNT": ("orthorectifyframes", "OUTPUT_COUNT")},
         named={"METHOD": "MARKING_METHOD"}, note="NOTE",
         outputs={"OUTPUT": "Marking mask", "OUTPUT_POLYGONS": "Road markings", "OUTPUT_REPORT": "Report"}),
)

GEOREFERENCE_MMS = (
    Step("roadmarkingsfrommms", "1. Takes the points on road markings out of the survey by their intensity."),
    Step("registermms", "2. Lays them on the reference markings: the corrected trajectory, and how sure it is.",
         made={"POINTS": ("roadmarkingsfrommms", "OUTPUT")},
         named={"OUTPUT": "OUTPUT_TRAJECTORY", "SURVEY": "POINTS"},
         outputs={"OUTPUT": "Corrected trajectory", "OUTPUT_PATCHES": "Patches", "OUTPUT_STEPS": "Disagreements",
                  "OUTPUT_AREAS": "Areas of disagreement", "OUTPUT_REPORT": "Report"}),
    Step("applytrajectory", "3. Moves the survey's points and images with the corrected trajectory.",
         made={"CORRECTED": ("registermms", "OUTPUT")},
         outputs={"OUTPUT": "Georeferenced survey", "OUTPUT_IMAGES": "Corrected image poses"}),
)

LANE_MAP = (
    Step("markinglines", "1. Makes line work of the markings: lines, stop lines, crosswalks and arrows.",
         named={"OUTPUT": "OUTPUT_LINES", "MAX_WIDTH": "MAX_LINE_WIDTH"},
         outputs={"OUTPUT": "Marking lines", "OUTPUT_AREAS": "Marking areas"}),
    Step("vectormap", "2. Makes lanes of the lines and the drives, and tells what is missing.",
         made={"LINES": ("markinglines", "OUTPUT"), "AREAS": ("markinglines", "OUTPUT_AREAS")},
         outputs={"OUTPUT_LANES": "Lanes", "OUTPUT_CENTRES": "Centre lines of lanes",
                  "OUTPUT_BOUNDS": "Bounds of lanes", "OUTPUT_FINDINGS": "Findings",
                  "OUTPUT_LANELET2": "Lanelet2 file", "OUTPUT_PROJECTOR": "Projector file",
                  "OUTPUT_OPENDRIVE": "OpenDRIVE file", "OUTPUT_REPORT": "Report"}),
)

ROAD_SPACE = (
    Step("roadedges", "1. Finds kerbs and other edges along the drive.", named={"OUTPUT": "OUTPUT_EDGES"},
         outputs={"OUTPUT": "Road edges"}),
    Step("streetobjects", "2. Finds poles, lamp posts, signals, signs and trees.",
         named={"OUTPUT": "OUTPUT_OBJECTS", "OUTPUT_CITYGML": "OUTPUT_FURNITURE",
                "OUTPUT_REPORT": "OUTPUT_OBJECT_REPORT"},
         outputs={"OUTPUT": "Street objects", "OUTPUT_CITYGML": "CityGML folder of furniture and trees",
                  "OUTPUT_REPORT": "Report on the objects"}),
    Step("markinglines", "3. Makes line work of the markings.", named={"SIGMA": "", "POINTS": "", "POINTS_CRS": ""}),
    Step("vectormap", "4. Makes lanes of the lines and the drive.",
         made={"LINES": ("markinglines", "OUTPUT"), "AREAS": ("markinglines", "OUTPUT_AREAS"),
               "EDGES": ("roadedges", "OUTPUT"), "OBJECTS": ("streetobjects", "OUTPUT"),
               "RAILS": ("streetobjects", "OUTPUT_RAILS")},
         named={"ROADS": ""}, outputs={"OUTPUT_LANES": "Lanes", "OUTPUT_BOUNDS": "Bounds of lanes",
                                       "OUTPUT_LANELET2": "Lanelet2 file", "OUTPUT_OPENDRIVE": "OpenDRIVE file"}),
    Step("roadmodel", "5. Makes the areas of the road of edges, lanes and stop lines.",
         made={"EDGES": ("roadedges", "OUTPUT"), "TOPS": ("roadedges", "OUTPUT_TOPS"),
               "LANES": ("vectormap", "OUTPUT_LANES"), "STOP_LINES": ("markinglines", "OUTPUT")},
         outputs={"OUTPUT": "Road surfaces", "OUTPUT_AREAS": "Areas of roads", "OUTPUT_STEPS": "Steps",
                  "OUTPUT_FINDINGS": "Findings", "OUTPUT_CITYGML": "CityGML folder", "OUTPUT_REPORT": "Report"}),
)

CHAINS = (("buildings_from_als", "Buildings from ALS (model)", "buildingsfromals", BUILDINGS_FROM_ALS),
          ("aerial_markings", "Road markings from aerial frames (model)", "aerialmarkings", AERIAL_MARKINGS),
          ("georeference_mms", "Georeference mobile survey (model)", "georeferencemms", GEOREFERENCE_MMS),
          ("lane_map", "Lane map from markings and drives (model)", "lanemap", LANE_MAP),
          ("road_space", "Road space from a mobile survey (model)", "roadspace", ROAD_SPACE))
"""File, name, algorithm with the same chain, and steps of each model."""


def load_provider():
    """Start QGIS's Processing with the checkout as a plugin; returns what has to be kept alive."""
    application = QgsApplication([], True)
    application.initQgis()
    sys.path.append(str(Path(QgsApplication.pkgDataPath()) / "python" / "plugins"))
    from processing.core.Processing import Processing

    Processing.initialize()
    spec = importlib.util.spec_from_file_location(
        "urbanmap_plugin", ROOT / "__init__.py", submodule_search_locations=[str(ROOT)])
    package = importlib.util.module_from_spec(spec)
    sys.modules["urbanmap_plugin"] = package
    spec.loader.exec_module(package)
    plugin = package.classFactory(None)
    plugin.initProcessing()
    return application, plugin


def place(component, column: str, y: float, size: QSizeF, text: str = "", colour: QColor | None = None) -> None:
    """Position, size, comment and colour of a box of the model."""
    component.setPosition(QPointF(COLUMNS[column], y))
    component.setSize(size)
    if text:
        component.comment().setDescription(text)
    if colour is not None:
        component.setColor(colour)


def add_inputs(model: QgsProcessingModelAlgorithm, chain) -> None:
    """The chain's input parameters: layers and files above, settings below."""
    inputs = [item for item in chain.parameterDefinitions() if not item.isDestination()]
    data = [item for item in inputs if item.type() in DATA]
    for row, definition in enumerate([*data, *(item for item in inputs if item not in data)]):
        box = QgsProcessingModelParameter(definition.name())
        place(box, "inputs", TOP + row * ROW, INPUT, colour=INPUT_COLOUR if definition in data else SETTING_COLOUR)
        copy = definition.clone()
        copy.setMetadata({})  # the field of the dialog is found again where the model is loaded
        model.addModelParameter(copy, box)


def settings_expression(chain) -> str:
    """Expression for a text with the settings of a run (QGIS 3.22 knows no files, and no defaults, there)."""
    parts = []
    for definition in chain.parameterDefinitions():
        default = definition.defaultValue()
        if not definition.isDestination() and default is not None:
            label = definition.description().replace("'", "''")
            value = f"'{default}'" if isinstance(default, str) else default
            parts.append(f"'{label}: ' || coalesce(@{definition.name()}, {value})")
    return " || '; ' || ".join(parts)


def add_step(model: QgsProcessingModelAlgorithm, step: Step, y: float, chain) -> None:
    """One step with its sources, its comment and the results of the model that it makes."""
    source = QgsProcessingModelChildParameterSource
    child = QgsProcessingModelChildAlgorithm(f"urbanmap:{step.algorithm}")
    child.setChildId(step.algorithm)
    child.setDescription(child.algorithm().displayName())
    for definition in child.algorithm().parameterDefinitions():
        name = definition.name()
        if definition.isDestination() or name in step.made:
            continue
        shared = step.name_in_chain(name)
        if name in step.derived:
            child.addParameterSources(name, [source.fromExpression(step.derived[name])])
        elif shared and chain.parameterDefinition(shared):
            default = chain.parameterDefinition(shared).defaultValue()
            if default != definition.defaultValue():
                sys.exit(f"{shared} of {chain.id()} is {default!r} by default, {name} of {child.algorithmId()} "
                         f"{definition.defaultValue()!r}: QGIS hands on nothing where the model is given nothing.")
            child.addParameterSources(name, [source.fromModelParameter(shared)])
        elif definition.defaultValue() is not None:
            child.addParameterSources(name, [source.fromStaticValue(definition.defaultValue())])
    for name, (other, output) in step.made.items():
        child.addParameterSources(name, [source.fromChildOutput(other, output)])
    if step.note:
        child.addParameterSources(step.note, [source.fromExpression(settings_expression(chain))])
    place(child, "steps", y, STEP, step.comment)
    child.comment().setPosition(QPointF(COLUMNS["comments"], y))
    child.comment().setSize(COMMENT)
    results = {}
    for place_down, (name, label) in enumerate(step.outputs.items()):
        definition = chain.parameterDefinition(step.name_in_chain(name))
        result = QgsProcessingModelOutput(label, label)
        result.setChildId(step.algorithm)
        result.setChildOutputName(name)
        result.setMandatory(not definition.flags() & definition.Flag.FlagOptional)
        place(result, "comments", y + COMMENT.height() + (place_down + 1) * ROW, OUTPUT)
        results[step.name_in_chain(name)] = result
    child.setModelOutputs(results)
    model.addChildAlgorithm(child)


def build(name: str, chain_id: str, steps: tuple[Step, ...]) -> QgsProcessingModelAlgorithm:
    """The model of a chain, with the chain's own parameters, labels and help."""
    chain = QgsApplication.processingRegistry().algorithmById(f"urbanmap:{chain_id}").create()
    # QGIS reads the group's id from the file; the provider gives the group its name.
    model = QgsProcessingModelAlgorithm(name, chain.groupId(), chain.groupId())
    add_inputs(model, chain)
    y = TOP
    for step in steps:
        add_step(model, step, y, chain)
        y += max(STEP_ROW, 2 * COMMENT.height() + (len(step.outputs) + 0.5) * ROW)
    model.setHelpContent(help_content(chain, steps))
    model.setParameterOrder([definition.name() for definition in chain.parameterDefinitions()
                             if not definition.isDestination()])
    sound, problems = model.validate()
    if not sound:
        sys.exit(f"{name}: {'; '.join(problems)}")
    missing = [definition.name() for definition in chain.parameterDefinitions() if definition.isDestination()
               and not any(definition.name() == step.name_in_chain(name) for step in steps for name in step.outputs)]
    if missing:
        sys.exit(f"{name}: the model lacks {', '.join(missing)} of {chain.id()}.")
    return model


def help_content(chain, steps: tuple[Step, ...]) -> dict[str, str]:
    """The chain's help, for the model's panel."""
    content = {
        "ALG_DESC": f"{chain.shortDescription()}</p><p>This is the same chain as “{chain.displayName()}”, as a model: "
                    "the menu Plugins > UrbanMap > Open a chain in the modeller opens a copy to look at and to change.",
    }
    for definition in chain.parameterDefinitions():
        key = definition.name()
        if definition.isDestination():
            key = next(f"{step.algorithm}:{key}" for step in steps for name in step.outputs
                       if step.name_in_chain(name) == key)
        content[key] = definition.help()
    return content


def main() -> None:
    """Write all models."""
    application, plugin = load_provider()
    for file, name, chain_id, steps in CHAINS:
        path = MODELS / f"{file}.model3"
        if not build(name, chain_id, steps).toFile(str(path)):
            sys.exit(f"{path} cannot be written.")
        print(path.relative_to(ROOT))
    plugin.unload()
    application.exitQgis()


if __name__ == "__main__":
    main()
