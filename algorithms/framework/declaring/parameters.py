"""Terse declarations of parameters and outputs: label, unit, range and help in one call."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from datetime import date
from math import isfinite
from pathlib import Path

from qgis.core import (
    QgsProcessing,
    QgsProcessingOutputNumber,
    QgsProcessingOutputString,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterCrs,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterDistance,
    QgsProcessingParameterEnum,
    QgsProcessingParameterFeatureSink,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
    QgsProcessingParameterFile,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterNumber,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
    QgsUnitTypes,
    QgsVectorFileWriter,
)
from qgis.PyQt.QtCore import QCoreApplication

from ....urbanmap_qgis.errors import InputError
from ....urbanmap_qgis.settings.declaration import Settings
from .choice_words import CHOICE_WORDS

LAZ_FILTER = "LAZ point cloud (*.laz);;LAS point cloud (*.las)"
CITYJSON_FILTER = "CityJSON (*.city.json *.json)"
CITY_MODEL_FILTER = "City models (*.gml *.GML *.zip *.json *.jsonl *.xml);;All files (*)"
HTML_FILTER = "HTML report (*.html)"
OBJ_FILTER = "Wavefront OBJ (*.obj)"

FILES_WIDGET = f"{__package__}.files_widget.FilesWidget"
"""What QGIS's dialogs show for several files."""

CHOICE_WIDGET = f"{__package__}.choice_widget.ChoiceWidget"
"""What QGIS's dialogs show for a choice."""

TEXT_TABLES = (".csv", ".txt", ".tsv")

SOLIDS = "urbanmap_solids"
"""Mark in the metadata of outputs that hold closed bodies."""

UNIT = re.compile(r" \([^()]*\)$")
"""The unit at the end of a label."""

_TYPES = QgsProcessing.SourceType
KINDS = {"any": _TYPES.TypeVector, "geometry": _TYPES.TypeVectorAnyGeometry, "point": _TYPES.TypeVectorPoint,
         "line": _TYPES.TypeVectorLine, "polygon": _TYPES.TypeVectorPolygon}
"""What layers hold, by its word; "any" are tables as well."""


def tr(text: str) -> str:
    """`text` in the user's language."""
    return QCoreApplication.translate("UrbanMap", text)


_POINT_FILES = "Point clouds (*.las *.laz *.LAS *.LAZ)"
_IMAGE_FILES = "Images (*.tif *.tiff *.jpg *.jpeg *.png *.TIF *.TIFF *.JPG *.JPEG *.PNG)"

FILES_FILTERS = {
    "FRAMES": _IMAGE_FILES, "IMAGES": _IMAGE_FILES, "MASKS": _IMAGE_FILES,
    "SCANS": "Range scans (*.csv *.csv.gz *.parquet *.las *.laz)",
    "NAVIGATION": "Navigation and orbits (*.nav *.rnx *.sp3 *.SP3 *.??n *.??N *.??p *.??P *.gz *.Z *.bz2)",
    "OBSERVATIONS": "Observations (*.obs *.rnx *.crx *.??o *.??O *.??d *.??D *.gz *.Z *.bz2)",
    "TRAJECTORY": "Trajectory (*.csv *.txt *.out *.sbet *.gpkg *.shp *.geojson)",
}
"""Which files dialogs show first, by parameters of several files that are no point clouds."""


def with_files_widget(definition, layers: bool) -> None:
    """Let dialogs show our own field for a parameter of several files; `layers`: with those of point cloud layers."""
    if definition.type() == "multilayer" and definition.layerType() == QgsProcessing.SourceType.TypeFile:
        filter = FILES_FILTERS.get(definition.name(), _POINT_FILES if layers else "")
        shown = [filter] if filter else []
        definition.setMetadata({"widget_wrapper": {"class": FILES_WIDGET}, "urbanmap_layers": layers,
                                "urbanmap_filter": ";;".join(tr(text) for text in (*shown, "All files (*)"))})


def choice_words(values: Sequence[str]) -> dict[str, str]:
    """What the user is shown for each value of a choice, in his language."""
    return {value: tr(CHOICE_WORDS[value]) if value in CHOICE_WORDS else value for value in values}


def with_choice_widget(definition) -> None:
    """Let dialogs show the words of a choice."""
    words = choice_words(definition.options())
    definition.setMetadata({"widget_wrapper": {"class": CHOICE_WIDGET}, "urbanmap_words": words})


def choice_help(help: str, values: Sequence[str]) -> str:
    """Translated help of a choice: its last bracket, which lists the values, also says the words that dialogs show."""
    translated, words = tr(help), choice_words(values)
    if translated == help:
        return help
    listed = "、".join(value if word == value else f"{value}：{word}" for value, word in words.items())
    return re.sub(r" ?[（(][^（）()]*[)）]$", f"（{listed}）", translated)


class Declarations:
    """Methods with which an algorithm declares its parameters and outputs.

    Every method takes the parameter's name, its label and its help, adds the definition and returns it.
    Labels and help are given in English and translated here. `advanced` puts a parameter under "Advanced".
    """

    def complete_declarations(self) -> None:
        """What all algorithms have: a system for their point clouds, and names of reports that tell whose they are."""
        if "POINTS" in self.points_names() and self.parameterDefinition("POINTS_CRS") is None:
            self.add_points_crs()
        for output in self.outputDefinitions():
            if output.type() == "outputHtml":  # QGIS lists the reports of all runs under this name
                output.setDescription(f"{self.displayName()}: {output.description()}")

    def output_helps(self) -> dict[str, str]:
        """Help of outputs that are not parameters (numbers, texts), by name."""
        if not hasattr(self, "_output_helps"):
            self._output_helps: dict[str, str] = {}
        return self._output_helps

    def table_names(self) -> set[str]:
        """Names of the parameters that take tables of text as well as layers."""
        if not hasattr(self, "_table_names"):
            self._table_names: set[str] = set()
        return self._table_names

    def points_names(self) -> set[str]:
        """Names of the parameters that take point cloud files."""
        if not hasattr(self, "_points_names"):
            self._points_names: set[str] = set()
        return self._points_names

    def declare_parameter(self, definition, help: str, advanced: bool = False):
        """Add any parameter definition with its help."""
        definition.setHelp(tr(help))
        with_files_widget(definition, definition.name() in self.points_names())
        if advanced:
            definition.setFlags(definition.flags() | QgsProcessingParameterDefinition.Flag.FlagAdvanced)
        self.addParameter(definition)
        return definition

    # Input

    def add_points(self, name: str = "POINTS", label: str = "Point clouds", help: str = "", optional: bool = False):
        """One or several LAS, LAZ or COPC files; read with `point_files`.

        File outputs of earlier steps can be chosen for it in the modeller.
        """
        text = help or "One or several LAS, LAZ or COPC files in one projected coordinate system, heights in metres."
        self.points_names().add(name)
        return self.add_files(name, label, text, optional)

    def add_points_crs(self):
        """The CRS of point clouds that state none: taken by itself wherever a file without one is opened in the run."""
        return self.add_crs("POINTS_CRS", "CRS of the point clouds", "Projected coordinate system in metres of files "
                            "that state none or a wrong one; it counts before what they state.", optional=True,
                            advanced=True)

    def add_files(self, name: str, label: str, help: str, optional: bool = False, advanced: bool = False):
        """Several files of another kind; read with `files_of`."""
        return self.declare_parameter(QgsProcessingParameterMultipleLayers(
            name, tr(label), QgsProcessing.SourceType.TypeFile, None, optional), help, advanced)

    def add_file(self, name: str, label: str, help: str, filter: str = "", folder: bool = False,
                 optional: bool = False, advanced: bool = False):
        """An existing file (or folder); read with `input_path`. What it is, its reader tells from its content.

        QGIS itself refuses, without a reason, names that no filter has.
        """
        behavior = QgsProcessingParameterFile.Behavior
        filters = tr(filter) if "(*)" in filter or not filter else f"{tr(filter)};;{tr('All files (*)')}"
        return self.declare_parameter(QgsProcessingParameterFile(
            name, tr(label), behavior.Folder if folder else behavior.File, "", None, optional, filters), help, advanced)

    def add_polygons(self, name: str, label: str, help: str, optional: bool = False):
        """A polygon layer; read with `read_polygons`."""
        return self.add_vector(name, label, help, optional, "polygon")

    def add_vector(self, name: str, label: str, help: str, optional: bool = False, kind: str = "any"):
        """A vector layer of one of the `KINDS`; read with `read_vector`."""
        return self.declare_parameter(QgsProcessingParameterFeatureSource(
            name, tr(label), [KINDS[kind]], None, optional), help)

    def add_table(self, name: str, label: str, help: str, optional: bool = False):
        """A layer or table, which may be a file of text as spreadsheets save it; read with `read_table`."""
        self.table_names().add(name)
        return self.add_vector(name, label, help, optional)

    def add_field(self, name: str, label: str, help: str, parent: str, optional: bool = True, advanced: bool = False):
        """A field of the layer parameter `parent`."""
        return self.declare_parameter(QgsProcessingParameterField(
            name, tr(label), None, parent, QgsProcessingParameterField.DataType.Any, False, optional), help, advanced)

    def add_raster(self, name: str, label: str, help: str, optional: bool = False):
        """A raster layer; its file is had with `raster_path`."""
        return self.declare_parameter(QgsProcessingParameterRasterLayer(name, tr(label), None, optional), help)

    def add_crs(self, name: str, label: str, help: str, optional: bool = False, advanced: bool = False):
        """A coordinate reference system."""
        return self.declare_parameter(QgsProcessingParameterCrs(name, tr(label), None, optional), help, advanced)

    # Settings

    def settings_names(self) -> dict[type[Settings], dict[str, str]]:
        """Names of the parameters that `add_settings` declared, by record and field."""
        if not hasattr(self, "_settings_names"):
            self._settings_names: dict[type[Settings], dict[str, str]] = {}
        return self._settings_names

    def add_settings(self, record: type[Settings], *chosen: str, advanced: bool | None = None, **renamed: str) -> None:
        """Parameters for the fields that a record of settings declares: those chosen, or all that are not there yet.

        `renamed` gives the parameters of fields other names; `advanced` replaces what the record says.
        """
        names = self.settings_names().setdefault(record, {})
        for field in chosen or [field for field in record.declared if field not in names]:
            said, default = record.declared[field], record.defaults[field]
            names[field] = renamed.get(field) or said.alias or field.upper()
            words, flag = (names[field], said.label, said.help), said.advanced if advanced is None else advanced
            limits = (limit if isfinite(limit) else None for limit in (said.minimum, said.maximum))
            if said.choices:
                self.add_choice(*words, said.choices, default, flag)
            elif isinstance(default, bool):
                self.add_boolean(*words, default, flag)
            elif said.unit == "m":
                self.add_distance(*words, default, *limits, default is None, flag)
            else:
                self.add_number(*words, default, *limits, said.unit, record.kinds[field].startswith("int"),
                                default is None, flag)

    def settings(self, record: type[Settings], parameters: Mapping, context, **given: object):
        """A record of settings as the user gave them; `given` are those that are no parameters.

        What its bases declare is read too, so that a record of the core can add fields that no user sets.
        """
        names = {field: name for base in record.__mro__ for field, name in self.settings_names().get(base, {}).items()}
        readers = {"bool": self.parameterAsBool, "str": self.parameterAsString, "int": self.parameterAsInt,
                   "float": self.parameterAsDouble}
        for field, name in names.items():
            if field not in given:
                missing = record.defaults[field] is None and parameters.get(name) is None
                given[field] = None if missing else readers[record.kinds[field].split()[0]](parameters, name, context)
        return record(**given)

    def day_of(self, parameters: Mapping, name: str, context) -> str:
        """The day that a text parameter names, ISO 8601; empty where none is given."""
        text = self.parameterAsString(parameters, name, context) or ""
        try:
            return date.fromisoformat(text).isoformat() if text else ""
        except ValueError:
            raise InputError(tr("{0}: {1} is no day; give it as 2026-04-01.").format(
                self.label_of(name), text)) from None

    # Numbers and choices

    def add_number(self, name: str, label: str, help: str, default: float | None = None,
                   minimum: float | None = None, maximum: float | None = None, unit: str = "",
                   integer: bool = False, optional: bool = False, advanced: bool = False):
        """A number; `unit` (such as "m2" or "points") is shown after the label."""
        kind = QgsProcessingParameterNumber.Type
        definition = QgsProcessingParameterNumber(
            name, _with_unit(label, unit), kind.Integer if integer else kind.Double, default, optional)
        _limit(definition, minimum, maximum)
        return self.declare_parameter(definition, help, advanced)

    def add_distance(self, name: str, label: str, help: str, default: float | None = None,
                     minimum: float | None = 0.0, maximum: float | None = None,
                     optional: bool = False, advanced: bool = False):
        """A distance in metres."""
        definition = QgsProcessingParameterDistance(name, _with_unit(label, distance_unit()), default, "", optional)
        definition.setDefaultUnit(QgsUnitTypes.DistanceUnit.DistanceMeters)
        _limit(definition, minimum, maximum)
        return self.declare_parameter(definition, help, advanced)

    def add_workers(self):
        """How many workers share the work; see `workers`."""
        self.add_number("WORKERS", "Workers", "Number of buildings or tiles worked on at the same time. The "
                        "result does not depend on it.", 1, 1, 256, integer=True, advanced=True)
        self.add_text("SCHEDULER", "Dask scheduler", "Address of a Dask cluster that shares the work instead of "
                      "workers on this machine, such as tcp://host:8786. The result does not depend on it. "
                      "Inputs, outputs and temporary files must be on storage that all its machines see.",
                      advanced=True)

    def workers(self, parameters: Mapping, context):
        """Context with the executor of as many workers as WORKERS says."""
        from ..running.workers import workers

        return workers(self.parameterAsInt(parameters, "WORKERS", context))

    def add_boolean(self, name: str, label: str, help: str, default: bool = False, advanced: bool = False):
        """Yes or no."""
        return self.declare_parameter(QgsProcessingParameterBoolean(name, tr(label), default), help, advanced)

    def add_choice(self, name: str, label: str, help: str, choices: Sequence[str], default: str,
                   advanced: bool = False):
        """One of a few words; the words themselves are the values. On the command line their numbers do as well."""
        definition = QgsProcessingParameterEnum(name, tr(label), list(choices), False, default, False, True)
        with_choice_widget(definition)
        return self.declare_parameter(definition, choice_help(f"{help} ({', '.join(choices)})", choices), advanced)

    def add_text(self, name: str, label: str, help: str, default: str | None = None, optional: bool = True,
                 advanced: bool = False):
        """A text."""
        return self.declare_parameter(
            QgsProcessingParameterString(name, tr(label), default, False, optional), help, advanced)

    # Output

    # An optional output is written when asked for; `by_default` makes the toolbox ask for it from the start, while on
    # the command line and in models it may still be left out.

    def add_file_output(self, name: str, label: str, help: str, filter: str, optional: bool = False,
                        by_default: bool = False):
        """A file to write. Its path: `output_path`."""
        return self.declare_parameter(QgsProcessingParameterFileDestination(
            name, tr(label), tr(filter), None, optional, not optional or by_default), help)

    def add_report(self, help: str, by_default: bool = False):
        """OUTPUT_REPORT, a page that may be written."""
        return self.add_file_output("OUTPUT_REPORT", "Report", help, HTML_FILTER, True, by_default)

    def add_points_output(self, name: str, label: str, help: str):
        """A LAZ or LAS file to write."""
        return self.add_file_output(name, label, help, LAZ_FILTER)

    def add_folder_output(self, name: str, label: str, help: str, optional: bool = False):
        """A folder to write into."""
        return self.declare_parameter(QgsProcessingParameterFolderDestination(
            name, tr(label), None, optional, not optional), help)

    def add_raster_output(self, name: str, label: str, help: str, optional: bool = False, by_default: bool = False):
        """A raster to write. Its path: `output_layer_path`."""
        return self.declare_parameter(QgsProcessingParameterRasterDestination(
            name, tr(label), None, optional, not optional or by_default), help)

    def add_layer_output(self, name: str, label: str, help: str, optional: bool = False,
                         kind: str = "polygon", by_default: bool = False, solids: bool = False):
        """A layer of one of the `KINDS`, written with `write_layer`; `solids`: of closed bodies, which few formats
        hold."""
        definition = QgsProcessingParameterFeatureSink(
            name, tr(label), KINDS[kind], None, optional, not optional or by_default)
        if solids:
            definition.setMetadata({SOLIDS: True})
        return self.declare_parameter(definition, help)

    def add_number_output(self, name: str, label: str, help: str, unit: str = ""):
        """A number among the results."""
        self.output_helps()[name] = tr(help)
        return self.addOutput(QgsProcessingOutputNumber(name, _with_unit(label, unit)))

    def add_text_output(self, name: str, label: str, help: str):
        """A text among the results."""
        self.output_helps()[name] = tr(help)
        return self.addOutput(QgsProcessingOutputString(name, tr(label)))

    # Chains

    def add_from(self, stage: type, *names: str, label: str = "", help: str = "", advanced: bool | None = None,
                 optional: bool | None = None, by_default: bool | None = None, **renamed: str):
        """Parameters and outputs as the algorithm class `stage` declares them: a chain repeats nothing.

        `names` keep their names, `renamed` gives them another in the chain (`OUTPUT_GROUND="OUTPUT"`). What else is
        given replaces what the stage says; the label's unit and the default, which the stage takes where the chain is
        given nothing, stay.
        """
        owner = stage()
        owner.initAlgorithm()
        for name, original in (*((name, name) for name in names), *renamed.items()):
            definition = owner.parameterDefinition(original)
            if definition is None:
                self.output_helps()[name] = owner.output_helps()[original]
                output = owner.outputDefinition(original)
                self.addOutput(type(output)(name, output.description()))
                continue
            # Not clone(): of a copy that C++ made Python does not learn when it is deleted, and takes what comes to
            # its address for it.
            definition = type(definition)(definition)
            definition.setName(name)
            if original in owner.table_names():
                self.table_names().add(name)
            if label:
                definition.setDescription(tr(label) + "".join(UNIT.findall(definition.description())))
            if help:
                definition.setHelp(tr(help))
            if by_default is not None:
                definition.setCreateByDefault(by_default)
            flags = definition.Flag
            for wanted, flag in ((advanced, flags.FlagAdvanced), (optional, flags.FlagOptional)):
                if wanted is not None:
                    definition.setFlags(definition.flags() | flag if wanted else definition.flags() & ~flag)
            for kinds in ("points_names", "trajectory_names"):
                if original in getattr(owner, kinds, set)():
                    getattr(self, kinds)().add(name)
            self.addParameter(definition)


def text_table(parameters: Mapping, name: str) -> str:
    """The file of text that a parameter names, "" for a layer or none."""
    text = parameters.get(name)
    found = isinstance(text, str) and Path(text).is_file() and (
        Path(text).suffix.lower() in TEXT_TABLES or is_plain_table(text))
    return text if found else ""


def is_plain_table(text: str) -> bool:
    """Whether a file is a text whose suffix is of no format of layers, such as a table called “drive.ori”."""
    from ....urbanmap_qgis.io.files.packed import content_kind

    return Path(text).is_file() and content_kind(text) == "text" and not QgsVectorFileWriter.driverForExtension(
        Path(text).suffix[1:])


def is_optional(definition) -> bool:
    """Whether a parameter may be left out."""
    return bool(definition.flags() & definition.Flag.FlagOptional)


def check_names(given: Mapping[str, object], known: Sequence[str]) -> list[str]:
    """One sentence for each given parameter name that the algorithm does not have."""
    import difflib  # only for a mistake, not with every start of QGIS

    sentences = []
    for name in sorted(set(given) - set(known)):
        close = difflib.get_close_matches(name.upper(), known, 1)
        hint = f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}."
        sentences.append(tr("Unknown parameter {0} is ignored; {1}").format(name, hint))
    return sentences


def with_words(parameters: Mapping[str, object], definitions: Sequence) -> dict[str, object]:
    """The parameters with the words of choices where their numbers, as `qgis_process help` counts them, were given.

    Raises
    ------
    InputError : what was given is neither a word nor the number of one.
    """
    result = dict(parameters)
    for definition in definitions:
        given = result.get(definition.name())
        if definition.type() != "enum" or not definition.usesStaticStrings() or not isinstance(given, (str, int)):
            continue
        words = definition.options()
        text = str(given).strip()
        if given not in words and (isinstance(given, bool) or not text.isdecimal() or int(text) >= len(words)):
            raise InputError(tr("{0}: {1} is none of {2}; give one of these words, or its number from 0 on.").format(
                definition.description(), given, ", ".join(words)))
        result[definition.name()] = given if given in words else words[int(text)]
    return result


def _with_unit(label: str, unit: str) -> str:
    return f"{tr(label)} ({tr(unit.replace('m2', 'm²'))})" if unit else tr(label)


def distance_unit() -> str:
    """Unit behind the label of a distance: none in the window, where QGIS shows it in a box beside the field."""
    from qgis.utils import iface

    return "m" if iface is None else ""


def _limit(definition, minimum: float | None, maximum: float | None) -> None:
    if minimum is not None:
        definition.setMinimum(minimum)
    if maximum is not None:
        definition.setMaximum(maximum)
