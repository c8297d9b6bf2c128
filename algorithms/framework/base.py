"""The base class of all UrbanMap algorithms."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import contextmanager, nullcontext
from pathlib import Path
from types import MappingProxyType

from qgis.core import (
    QgsApplication,
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsProcessingUtils,
    QgsVectorLayer,
)
from qgis.PyQt.QtGui import QIcon

from ...urbanmap_qgis.errors import SYSTEM_TROUBLES, Cancelled, InputError, UrbanMapError, system_sentence
from ...urbanmap_qgis.io.files.staging import Staging, final_text
from ...urbanmap_qgis.progress import SILENT, Progress
from .declaring import destinations
from .declaring.parameters import is_optional, text_table, tr
from .declaring.retired import of_today, succession
from .layers import crs as crs_checks
from .layers import layers, reprojection, shown_results
from .layers.trajectories import TrajectoryParameters
from .packages.dependencies import refusal
from .running.cluster import scheduler
from .running.interrupt import signals_cancel
from .running.matrix_library import bind_products
from .running.native_libraries import PACKAGES_WITH_LIBRARIES, import_apart
from .running.python_thread import in_python_thread
from .running.runs_at_work import at_work
from .running.step_feedback import StepsMultiStepFeedback
from .running.surroundings import surroundings

ICONS = Path(__file__).resolve().parents[2] / "resources" / "icons"

GROUPS = {
    "start": "Getting started",
    "aerial": "Aerial reference",
    "mobile": "Mobile mapping",
    "lines": "Line scanners and line cameras",
    "buildings": "Buildings",
    "gnss": "GNSS",
    "roadmap": "Road map",
    "delivery": "Delivery",
    "workflows": "Workflows",
}

POINT_SUFFIXES = (".las", ".laz")


class UrbanMapAlgorithm(TrajectoryParameters, QgsProcessingAlgorithm):
    """An algorithm that says what it is in class attributes, declares its parameters and runs.

    A subclass sets the attributes below and implements `declare` and `work`, and `check` where it has more to check
    before the run than the base class (files are there, folders can be written, outlines are in metres).

    Attributes
    ----------
    ID, NAME : id (lower case) and name in the toolbox.
    HELP : what it does, as plain text; a line break starts a paragraph.
    SOURCE : where the method is described, such as "Javanmardi, 5.3.2".
    KEYWORDS : words under which the toolbox finds it too.
    REQUIRES : import names of the packages it needs.
    KEPT_FOLDERS : folder outputs that are written in their place step by step, so that a later run can go on in them.
    LASTING_FOLDERS : folder outputs that are asked for in the window: a temporary one is gone when QGIS ends.
    SUCCESSOR : id of the algorithm that does its work now: the toolbox hides it, and each run says so.
    RETIRED : parameters of earlier versions that no longer do anything, with what is said where one is given.
    RETIRED_WORDS : words of choices of earlier versions by parameter, each with the word that is taken instead.
    """

    ID = ""
    NAME = ""
    HELP = ""
    SOURCE = ""
    KEYWORDS: tuple[str, ...] = ()
    REQUIRES: tuple[str, ...] = ("numpy", "shapely")
    KEPT_FOLDERS: tuple[str, ...] = ()
    LASTING_FOLDERS: tuple[str, ...] = ()
    SUCCESSOR = ""
    RETIRED: Mapping[str, str] = MappingProxyType({})
    RETIRED_WORDS: Mapping[str, Mapping[str, str]] = MappingProxyType({})

    # To be implemented by the algorithm

    def declare(self) -> None:
        """Declare parameters and outputs with the `add_...` methods."""
        raise NotImplementedError

    def check(self, parameters: Mapping, context: QgsProcessingContext) -> None:
        """Raise `InputError` for parameters that do not fit together; called before and again in the run."""

    def work(self, parameters: Mapping, context: QgsProcessingContext, progress: Progress) -> dict:
        """Do the work and return the results by output name; core errors may simply rise."""
        raise NotImplementedError

    def compute(self, parameters: Mapping, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> dict:
        """The same with QGIS's own feedback, which chains need for their steps.

        (Not named `run`: Python callers of Processing call QGIS's own `run`.)
        """
        return self.work(parameters, context, self.progress(feedback))

    def known_names(self, parameters: Mapping) -> list[str]:
        """Names of parameters that may be given; others are told as a warning."""
        return [*(item.name() for item in self.parameterDefinitions()), *self.RETIRED]

    # What QGIS asks

    def createInstance(self):
        return type(self)()

    def name(self):
        return self.ID

    def flags(self):
        return super().flags() | self.Flag.FlagDeprecated if self.SUCCESSOR else super().flags()

    def displayName(self):
        return tr(self.NAME)

    def group(self):
        return tr(GROUPS[self.groupId()])

    def groupId(self):
        """The folder of the algorithm's module is its group."""
        return type(self).__module__.split(".")[-2]

    def tags(self):
        return [tr(word) for word in self.KEYWORDS]

    def icon(self):
        path = ICONS / f"{self.groupId()}.svg"
        return QIcon(str(path if path.is_file() else ICONS / "urbanmap.svg"))

    def shortDescription(self):
        return tr(self.HELP).strip().split("\n", 1)[0]

    def shortHelpString(self):
        from .language.help_page import panel_html

        return panel_html(self)

    def helpUrl(self):
        """The page behind the Help button of the dialog."""
        from .language.help_page import page_file

        return page_file(self).as_uri()

    def initAlgorithm(self, configuration=None):
        self.declare()
        self.complete_declarations()

    def canExecute(self):
        message = refusal(self.REQUIRES)
        return not message, message

    def _packages_missing(self) -> str:
        """Why the algorithm cannot run, empty if it can: its packages are then imported, bound to their libraries."""
        message = refusal(self.REQUIRES)
        if not message:
            import_apart(PACKAGES_WITH_LIBRARIES)
        return message

    def checkParameterValues(self, parameters, context):
        shown_results.let_go(context)
        return in_python_thread(lambda: self._checked(parameters, context), context)

    def _checked(self, parameters: Mapping, context: QgsProcessingContext) -> tuple[bool, str]:
        try:
            parameters, _ = of_today(self, parameters)
        except InputError as error:
            return False, str(error)
        accepted, message = super().checkParameterValues({**parameters, **self._stand_ins(parameters)}, context)
        if not accepted:
            return accepted, message
        message = self._packages_missing()
        if message:
            return False, message
        try:
            self._check_all(parameters, context)
        except UrbanMapError as error:
            return False, str(error)
        return True, ""

    def _stand_ins(self, parameters: Mapping) -> dict[str, QgsVectorLayer]:
        """Empty tables for those of text that the core reads: QGIS would refuse what it cannot open itself."""
        return {name: QgsVectorLayer("NoGeometry?field=id:string", name, "memory") for name in self.table_names()
                if text_table(parameters, name)}

    def processAlgorithm(self, parameters, context, feedback):
        with at_work(feedback):
            return in_python_thread(lambda: self._process(parameters, context, feedback), context)

    def _process(self, parameters: Mapping, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> dict:
        message = self._packages_missing()
        if message:
            raise QgsProcessingException(message)
        trouble = bind_products()
        if trouble:
            feedback.pushWarning(trouble)
        with signals_cancel(feedback) as signals:
            try:
                parameters, sentences = of_today(self, parameters)
                for sentence in (*sentences, *succession(self, feedback)):
                    feedback.pushWarning(sentence)
                self._check_all(parameters, context)
                with Staging() as staging:
                    return self._compute_apart(parameters, context, feedback, staging)
            except Cancelled as error:
                if feedback.isCanceled() and not signals:
                    return {}
                raise QgsProcessingException(str(error)) from None
            except UrbanMapError as error:
                raise QgsProcessingException(str(error)) from None
            except SYSTEM_TROUBLES as error:
                sentence = system_sentence(error)
                if not sentence:
                    raise
                raise QgsProcessingException(sentence) from None

    def _compute_apart(self, parameters: Mapping, context: QgsProcessingContext, feedback: QgsProcessingFeedback,
                       staging: Staging) -> dict:
        """Compute with all outputs beside their places, then move them there together."""
        try:
            run = destinations.staged(self, parameters, context, staging)
            with surroundings(feedback), self._points_crs(run, context), self._scheduler(run, context), \
                    self._told(parameters, context):
                results = self.compute(run, context, feedback)
            destinations.close_layers(context, staging)
            staging.publish()
            self.judge(results, feedback)
            results = destinations.results_outside(results, staging)
            shown_results.name_layers(self, results, context)
            shown_results.show_files(self, results, context, feedback)
        except UrbanMapError as error:
            if final_text(str(error)) == str(error):
                raise
            raise type(error)(final_text(str(error))) from error
        return results

    def judge(self, results: Mapping, feedback: QgsProcessingFeedback) -> None:
        """Called when all outputs are in their places; raises where the run must not count as one that went well."""

    def _points_crs(self, parameters: Mapping, context: QgsProcessingContext):
        """Context in which the files of POINTS, and others that state no CRS, have that of POINTS_CRS, where given."""
        if not parameters.get("POINTS_CRS") or self.parameterDefinition("POINTS_CRS") is None:
            return nullcontext()
        from ...urbanmap_qgis.io.points.pointcloud import given_crs

        crs = self.parameterAsCrs(parameters, "POINTS_CRS", context)
        self.require_projected("POINTS_CRS", crs)
        return given_crs(crs_checks.wkt_of(crs), self.point_files(parameters, "POINTS", context))

    def _scheduler(self, parameters: Mapping, context: QgsProcessingContext):
        """Context in which pieces go to the cluster that SCHEDULER names, where one is given."""
        if self.parameterDefinition("SCHEDULER") is None:
            return nullcontext()
        address = self.parameterAsString(parameters, "SCHEDULER", context).strip()
        return scheduler(address, destinations.folders_of(self, parameters, context)) if address else nullcontext()

    def _told(self, parameters: Mapping, context: QgsProcessingContext):
        """Context in which reports tell how they were made; nothing to tell where there is no report."""
        if not any(definition.name().endswith("REPORT") and parameters.get(definition.name())
                   for definition in self.destinationParameterDefinitions()):
            return nullcontext()
        from ...urbanmap_qgis.io.pages.report import run_told
        from .running.run_facts import run_facts

        return run_told(run_facts(self, parameters, context))

    def _check_all(self, parameters: Mapping, context: QgsProcessingContext) -> None:
        destinations.check_destinations(self, parameters, context)
        for definition in self.parameterDefinitions():
            name = definition.name()
            if name in self.points_names():
                self.point_files(parameters, name, context)
            elif name in self.trajectory_names():
                self.check_trajectory(parameters, name, context)
            elif definition.type() == "file":
                self.input_path(parameters, name, context)
            elif definition.type() == "multilayer" and definition.layerType() == QgsProcessing.SourceType.TypeFile:
                self.files_of(parameters, name, context)
        self.check(parameters, context)

    # Reading parameters

    def label_of(self, name: str) -> str:
        """Label of a parameter, for messages."""
        definition = self.parameterDefinition(name)
        return definition.description() if definition is not None else name

    def point_files(self, parameters: Mapping, name: str, context: QgsProcessingContext) -> list[Path]:
        """Files of a points parameter, each once, in the given order; an empty list where none was given.

        A point cloud layer of the project stands for its file.

        Raises
        ------
        InputError : a file does not exist or is no LAS or LAZ file.
        """
        paths = [Path(destinations.file_of(text, context)) for text in
                 self.parameterAsFileList(parameters, name, context) if text]
        for path in paths:
            if path.is_dir():
                raise InputError(tr("{0}: {1} is a folder; give the LAS, LAZ or COPC files in it.").format(
                    self.label_of(name), path))
            if not path.is_file():
                raise InputError(tr("{0}: the file {1} does not exist; check its name.").format(
                    self.label_of(name), path))
            if path.suffix.lower() not in POINT_SUFFIXES:
                raise InputError(tr("{0}: {1} is no LAS, LAZ or COPC file; convert it first.").format(
                    self.label_of(name), path))
        if not paths and not is_optional(self.parameterDefinition(name)):
            raise InputError(tr("{0}: no file was given; give one or several LAS or LAZ files.").format(
                self.label_of(name)))
        return list(dict.fromkeys(paths))

    def projected_cloud(self, parameters: Mapping, context: QgsProcessingContext):
        """The core's `PointCloud` of POINTS, in a projected CRS in metres."""
        from ...urbanmap_qgis.io.points.pointcloud import open_cloud

        cloud = open_cloud(self.point_files(parameters, "POINTS", context))
        self.require_projected("POINTS", cloud.crs_wkt)
        return cloud

    def input_path(self, parameters: Mapping, name: str, context: QgsProcessingContext) -> Path | None:
        """Path of an existing file or folder; None where an optional one was not given."""
        text = self.parameterAsFile(parameters, name, context)
        if not text:
            return None
        if not Path(text).exists():
            raise InputError(tr("{0}: {1} does not exist; check its name.").format(self.label_of(name), text))
        return Path(text)

    def input_paths(self, parameters: Mapping, context: QgsProcessingContext) -> list[Path]:
        """The file INPUT and the folder INPUT_FOLDER, as far as they were given."""
        paths = (self.input_path(parameters, name, context) for name in ("INPUT", "INPUT_FOLDER"))
        return [path for path in paths if path is not None]

    def raster_path(self, parameters: Mapping, name: str, context: QgsProcessingContext) -> Path | None:
        """File of a raster layer; None where an optional one was not given."""
        layer = self.parameterAsRasterLayer(parameters, name, context)
        if layer is None:
            if parameters.get(name) is None and is_optional(self.parameterDefinition(name)):
                return None
            raise InputError(tr("{0}: {1} cannot be opened as a raster; check the file.").format(
                self.label_of(name), parameters.get(name)))
        path = Path(layer.source().split("|")[0])
        if not path.is_file():
            raise InputError(tr("{0}: {1} is no file; export the layer to a GeoTIFF first.").format(
                self.label_of(name), layer.name()))
        return path

    def output_path(self, parameters: Mapping, name: str, context: QgsProcessingContext) -> Path | None:
        """Path of a file to write; None where an optional one is not wanted.

        In `compute` it is a scratch path beside the output's place, with the output's own name.
        """
        text = self.parameterAsFileOutput(parameters, name, context)
        return Path(text) if text else None

    def write_file(self, parameters: Mapping, name: str, context: QgsProcessingContext, write: Callable, *content,
                   **named) -> dict[str, str]:
        """Write a file by `write(path, *content, **named)` where it is wanted; its place by the output's name."""
        path = self.output_path(parameters, name, context)
        if path is None:
            return {}
        write(path, *content, **named)
        return {name: str(path)}

    def output_layer_path(self, parameters: Mapping, name: str, context: QgsProcessingContext,
                          style: str = "") -> Path | None:
        """Path of a raster to write, which QGIS loads afterwards with a style; None where it is not wanted."""
        text = self.parameterAsOutputLayer(parameters, name, context)
        if not text:
            return None
        if style:
            layers.give_style(context, text, style)
        return Path(text)

    def progress(self, feedback: QgsProcessingFeedback) -> Progress:
        """The core's progress object that speaks to QGIS and obeys its Cancel button."""
        return Progress(report=lambda fraction: feedback.setProgress(100.0 * fraction),
                        message=lambda text: feedback.pushInfo(final_text(text)),
                        warn=lambda text: feedback.pushWarning(final_text(text)), cancelled=feedback.isCanceled)

    # Steps of a chain

    def child_runner(self, context: QgsProcessingContext, feedback: QgsProcessingFeedback, steps: int):
        """Function `run(algorithm, **parameters) -> results` that runs one of `steps` algorithms after another.

        A step's error is raised as it is; progress goes on over all steps, and each says its name.
        """
        import processing

        stages = StepsMultiStepFeedback(steps, feedback)
        done = iter(range(steps))

        def run(algorithm: str, **parameters) -> dict:
            stages.setCurrentStep(next(done))
            name = QgsApplication.processingRegistry().algorithmById(f"urbanmap:{algorithm}").displayName()
            stages.pushInfo(tr("Step: {0}").format(name))
            results = processing.run(f"urbanmap:{algorithm}", parameters, context=context, feedback=stages,
                                     is_child_algorithm=True)
            if feedback.isCanceled():
                raise Cancelled()
            return results

        return run

    def temporary_file(self, context: QgsProcessingContext, name: str) -> str:
        """Path of a file that QGIS removes when it ends."""
        return QgsProcessingUtils.generateTempFilename(name)

    # Layers

    def read_vector(self, parameters: Mapping, name: str, context: QgsProcessingContext,
                    progress: Progress = SILENT) -> layers.VectorTable | None:
        """A vector layer or table in memory; None where an optional one was not given."""
        source = self._source(parameters, name, context)
        return source and layers.read_source(source, self.label_of(name), progress)

    def read_table(self, parameters: Mapping, name: str, context: QgsProcessingContext, columns_of: Callable,
                   progress: Progress = SILENT) -> layers.VectorTable | None:
        """The same of a table, where a file of text goes by the core's `columns_of`: it knows more than QGIS of such.

        QGIS reads UTF-8 alone, and no lines before the names.
        """
        text = text_table(parameters, name)
        if not text:
            return self.read_vector(parameters, name, context, progress)
        return layers.table_of_columns(columns_of(text), Path(text).name)

    def read_polygons(self, parameters: Mapping, name: str, context: QgsProcessingContext,
                      progress: Progress = SILENT) -> layers.VectorTable | None:
        """Polygons in a projected CRS in metres, that of the points where there are any; see `layers`."""
        source = self._source(parameters, name, context)
        return source and layers.read_polygon_source(source, self.label_of(name), progress,
                                                     reprojection.points_wkt(self, parameters, context))

    @contextmanager
    def sampled_raster(self, parameters: Mapping, name: str, context: QgsProcessingContext, other: str, crs):
        """The core's `RasterSampler` of a raster in the CRS of the parameter `other`; None where none is given."""
        path = self.raster_path(parameters, name, context)
        if path is None:
            yield None
            return
        from ...urbanmap_qgis.io.raster import RasterSampler

        with RasterSampler(path) as raster:
            self.same_crs(name, raster.crs_wkt, other, crs)
            yield raster

    def write_layer(self, parameters: Mapping, name: str, context: QgsProcessingContext, fields, columns, crs,
                    geometries=None, geometry_type: str = "NoGeometry", style: str = "",
                    progress: Progress = SILENT, names=None) -> dict[str, str]:
        """Write an output layer where it is wanted, when all is computed; its place by the output's name.

        `fields` : None for those of the columns, which are all ours. `names` (`outlines.BuildingNames`) puts the user's
        own ids in the place of the buildings' numbers.
        """
        if fields is None:
            fields = layers.make_fields(*columns, style=style)
        if names is not None:
            fields, columns = names.fields(fields), names.columns(columns)
        place = layers.write_layer(self, parameters, name, context, fields, columns, crs, geometries, geometry_type,
                                   style, progress)
        return {name: place} if place else {}

    def same_crs(self, name_a: str, crs_a, name_b: str, crs_b) -> None:
        """Refuse two inputs in different CRS, naming both by their labels; a CRS is QGIS's or WKT."""
        crs_checks.same_crs(self.label_of(name_a), crs_a, self.label_of(name_b), crs_b)

    def same_heights(self, name_a: str, crs_a, name_b: str, crs_b) -> None:
        """Refuse two inputs that state different height systems, naming both by their labels."""
        crs_checks.same_heights(self.label_of(name_a), crs_a, self.label_of(name_b), crs_b)

    def require_projected(self, name: str, crs) -> None:
        """Refuse a CRS that is missing, geographic or not in metres; it is QGIS's or WKT."""
        crs_checks.require_projected(self.label_of(name), crs)

    def _source(self, parameters: Mapping, name: str, context: QgsProcessingContext):
        source = self.parameterAsSource(parameters, name, context)
        if source is None and (parameters.get(name) or not is_optional(self.parameterDefinition(name))):
            raise InputError(tr("{0}: {1} cannot be opened as a vector layer; check the file and the layer name.")
                             .format(self.label_of(name), parameters.get(name)))
        return source
