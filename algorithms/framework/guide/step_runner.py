"""A job's steps run one after the other in the background, with progress and time remaining."""

from __future__ import annotations

import time
from collections.abc import Collection, Sequence
from functools import partial
from pathlib import Path

from qgis.core import (
    QgsApplication,
    QgsLayerTreeLayer,
    QgsProcessingAlgRunnerTask,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsRasterLayer,
    QgsVectorLayer,
    QgsWkbTypes,
)
from qgis.PyQt.QtCore import QObject, QTimer, pyqtSignal

from ....urbanmap_qgis.errors import InputError
from ..declaring.parameters import tr
from ..jobs.job_steps import algorithm_of, filled_parameters, make_results_folder, short_id


class StepFeedback(QgsProcessingFeedback):
    """Keeps the errors that a run tells."""

    def __init__(self):
        super().__init__(False)
        self.errors: list[str] = []

    def reportError(self, error, fatalError=False):
        self.errors.append(error)
        super().reportError(error, fatalError)


def name_by_outputs(context: QgsProcessingContext) -> None:
    """Let the layers that a run loads have the names of its outputs, in the user's language, where QGIS would call them
    after their files."""
    loaded = context.layersToLoadOnCompletion()
    for details in loaded.values():
        details.forceName = True
    context.setLayersToLoadOnCompletion(loaded)


def arrange_layers(layers: Collection[str], note: str, files: Sequence[str] = ()) -> None:
    """Put layers that were just loaded, by their ids, in order: points above lines above areas, all of them above what
    was there before; images below all else, rasters of heights below these.

    `note` : is set behind their names, "" for none.
    `files` : of the step's results, as it declares them; of one kind the later ones, which add to the first, go above.
    (In which order layers are loaded differs among releases of QGIS.)
    """
    root = QgsProject.instance().layerTreeRoot()
    loaded = [node for node in root.findLayers() if node.layerId() in layers]
    drawn = sorted((node for node in loaded if not _is_raster(node)), key=partial(_depth, files=files), reverse=True)
    for node in loaded:
        if note:
            node.layer().setName(f"{node.layer().name()} ({note})")
        parent = node.parent()
        if _is_raster(node):
            others = [row for row, child in enumerate(parent.children()) if _is_raster(child) and child != node]
            heights = node.layer().bandCount() == 1
            parent.insertChildNode(others[0] if others and not heights else -1, node.clone())
            parent.removeChildNode(node)
    for node in drawn:
        parent = node.parent()
        parent.insertChildNode(0, node.clone())
        parent.removeChildNode(node)


def tell_apart(layers: Collection[str], title: str) -> None:
    """Give layers that were just loaded the step's title where another one of the project has the same name."""
    project = QgsProject.instance()
    others = {layer.name() for identity, layer in project.mapLayers().items() if identity not in layers}
    for layer in map(project.mapLayer, layers):
        if layer.name() in others:
            layer.setName(f"{layer.name()} ({title})")


def _depth(node, files: Sequence[str]) -> tuple[int, int, int]:
    """How far down a layer goes that is no raster: its kind, its file's place, and its own in the tree now."""
    kinds = (QgsWkbTypes.GeometryType.PointGeometry, QgsWkbTypes.GeometryType.LineGeometry,
             QgsWkbTypes.GeometryType.PolygonGeometry)
    kind = node.layer().geometryType() if isinstance(node.layer(), QgsVectorLayer) else None
    file = node.layer().source().partition("|")[0]
    return (kinds.index(kind) if kind in kinds else len(kinds), -files.index(file) if file in files else 0,
            node.parent().children().index(node))


def _is_raster(node) -> bool:
    return isinstance(node, QgsLayerTreeLayer) and isinstance(node.layer(), QgsRasterLayer)


class StepRunner(QObject):
    """Runs steps of a job; `changed` comes with the job whenever a step begins or ends, `ended` with a sentence."""

    changed = pyqtSignal(object)
    moved = pyqtSignal(float)
    ended = pyqtSignal(str)

    def __init__(self, parent=None):
        super().__init__(parent)
        self.job, self.folder = None, Path()
        self.waiting: list[str] = []
        self.current = ""
        self.fraction = 0.0
        self._started = 0.0
        self._task = self._feedback = self._context = self._asked = self._given = self._algorithm = None

    def busy(self) -> bool:
        """Whether a step is at work."""
        return bool(self.current)

    def start(self, job, steps: Sequence[str], folder: Path) -> None:
        """Run steps of a job, by their ids in their order; those that are done and unchanged are left alone."""
        from ....urbanmap_qgis.job.job_progress import refreshed_job

        self.job, self.folder, self.waiting = refreshed_job(job), folder, list(steps)
        self._next()

    def cancel(self) -> None:
        """End the step at work and begin no other."""
        self.waiting = []
        if self._task is not None:
            self._feedback.cancel()
            self._task.cancel()

    def seconds_left(self) -> float | None:
        """Seconds that all that is to run still takes; None while nothing can be said."""
        from ....urbanmap_qgis.job.job_progress import time_remaining

        if not self.current:
            return None
        steps = [self.job.step(name) for name in (self.current, *self.waiting)]
        return time_remaining(steps, time.monotonic() - self._started, self.fraction)

    def _next(self) -> None:
        from ....urbanmap_qgis.job.job_progress import failed_step, is_up_to_date

        while self.waiting and is_up_to_date(self.job, self.job.step(self.waiting[0])):
            self.waiting.pop(0)
        if not self.waiting:
            self._end(tr("All steps are done."))
            return
        step = self.job.step(self.waiting.pop(0))
        self.current, self.fraction, self._started = step.id, 0.0, time.monotonic()
        try:
            self._begin(step)
        except InputError as error:
            self.job = self.job.with_step(failed_step(step, str(error), 0.0))
            self._end(self._failure(step, str(error)))
        else:
            self.changed.emit(self.job)

    def _begin(self, step) -> None:
        """Start a step as a task; what keeps it from running is raised."""
        from ....urbanmap_qgis.job.job_progress import resolved_parameters

        make_results_folder(self.folder)
        self._asked = resolved_parameters(self.job, step)
        self._algorithm = algorithm_of(step.algorithm)
        self._given = filled_parameters(self.job, step, self.folder)
        for definition in self._algorithm.destinationParameterDefinitions():
            place = self._given.get(definition.name())
            if place and definition.type() in ("sink", "rasterDestination"):
                self._given[definition.name()] = QgsProcessingOutputLayerDefinition(place, QgsProject.instance())
        self._context, self._feedback = QgsProcessingContext(), StepFeedback()
        self._context.setProject(QgsProject.instance())
        self._context.setFeedback(self._feedback)
        sound, message = self._algorithm.checkParameterValues(self._given, self._context)
        if not sound:
            raise InputError(message)
        self._feedback.progressChanged.connect(self._progress)
        if self._algorithm.flags() & self._algorithm.Flag.FlagNoThreading:  # QGIS's printing works in this thread alone
            QTimer.singleShot(0, self._run_here)
            return
        self._task = QgsProcessingAlgRunnerTask(self._algorithm, self._given, self._context, self._feedback)
        self._task.executed.connect(self._executed)
        # The task works with these also where this runner goes before it, as when the plugin is updated meanwhile.
        used = (self._algorithm, self._given, self._context, self._feedback)
        for ended in (self._task.taskCompleted, self._task.taskTerminated):
            ended.connect(partial(len, used))
        QgsApplication.taskManager().addTask(self._task)

    def _run_here(self) -> None:
        """Run the step in the window's own thread."""
        results, succeeded = self._algorithm.run(self._given, self._context, self._feedback)
        self._executed(succeeded, results)

    def _progress(self, percent: float) -> None:
        self.fraction = percent / 100.0
        self.moved.emit(self.fraction)

    def _executed(self, succeeded: bool, results: dict) -> None:
        from processing.gui.Postprocessing import handleAlgorithmResults

        from ....urbanmap_qgis.job.job_progress import done_step, failed_step

        step, seconds = self.job.step(self.current), time.monotonic() - self._started
        cancelled, errors = self._feedback.isCanceled(), self._feedback.errors
        self._task = None
        if cancelled:
            self._end(tr("Stopped."))
            return
        if not succeeded:
            message = " ".join(errors[-1:]).strip() or tr("It ended without a reason.")
            self.job = self.job.with_step(failed_step(step, message, seconds))
            self._end(self._failure(step, message))
            return
        before = set(QgsProject.instance().mapLayers())
        name_by_outputs(self._context)
        handleAlgorithmResults(self._algorithm, self._context, self._feedback, parameters=self._given)
        alike = sum(other.algorithm == step.algorithm for other in self.job.steps) > 1
        files = [str(results.get(one.name())) for one in self._algorithm.destinationParameterDefinitions()]
        loaded = set(QgsProject.instance().mapLayers()) - before
        arrange_layers(loaded, short_id(step.id) if alike else "", files)
        tell_apart(loaded, algorithm_of(step.algorithm).displayName())
        self.job = self.job.with_step(done_step(step, self._asked, results, seconds))
        self._next()

    def _failure(self, step, message: str) -> str:
        return tr("Step “{0}” ({1}) failed: {2}").format(step.id, algorithm_of(step.algorithm).displayName(), message)

    def _end(self, sentence: str) -> None:
        self.current, self.waiting = "", []
        self.changed.emit(self.job)
        self.ended.emit(sentence)
