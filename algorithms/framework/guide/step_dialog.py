"""A step's own dialog, filled in from the job, and what the user set in it taken back into the job."""

from __future__ import annotations

from collections.abc import Mapping

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsProcessing,
    QgsProcessingException,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
)
from qgis.PyQt.QtCore import QEvent, QObject, QTimer, pyqtSignal

from ..jobs.job_steps import algorithm_of, prefilled_parameters


class StepDialog(QObject):
    """Opens the dialog of a step; `taken` comes with the step's id and parameters when it is closed."""

    taken = pyqtSignal(str, object)
    done = pyqtSignal(str, object)

    def __init__(self, job, step, folder, parent=None):
        super().__init__(parent)
        import processing

        self.gone = False
        self.step, self.before = step, prefilled_parameters(job, step, folder)
        self.window = processing.createAlgorithmDialog(f"urbanmap:{step.algorithm}", self.before)
        self.window.installEventFilter(self)
        self.window.algorithmFinished.connect(self._finished)
        self.window.rejected.connect(lambda: QTimer.singleShot(0, self._hidden))
        self.window.show()

    def eventFilter(self, watched, event):
        if watched is self.window and event.type() == QEvent.Type.Close:
            self._take()
            QTimer.singleShot(0, self._hidden)
        return False

    def _hidden(self) -> None:
        """Called when the window was closed: without a run of its own at work it goes."""
        if not self.gone and not self.window.isVisible() and self.window.runButton().isEnabled():
            self._let_go()

    def _let_go(self) -> None:
        """Delete the window, as QGIS leaves it to who made it: hidden, it would live on without this plugin."""
        self.gone = True
        self.window.removeEventFilter(self)
        self.window.deleteLater()
        self.deleteLater()

    def values(self) -> dict:
        """Parameters that the user has set in the window; {} where they are not whole."""
        read = getattr(self.window, "createProcessingParameters", None) or self.window.getParameterValues
        try:
            found = read()
        except (QgsProcessingException, AttributeError, ValueError, TypeError):  # a field is not filled in rightly
            return {}
        except Exception as error:  # AlgorithmDialogBase.InvalidParameterValue, of which QGIS has moved the class
            if "Invalid" not in type(error).__name__:
                raise
            return {}
        return changed_values(self.step, self.before, found)

    def _take(self) -> None:
        found = self.values()
        if found:
            self.taken.emit(self.step.id, found)

    def _finished(self, succeeded: bool, results: Mapping) -> None:
        self._take()
        if succeeded:
            self.done.emit(self.step.id, dict(results))
        QTimer.singleShot(0, self._hidden)


def changed_values(step, before: Mapping, found: Mapping) -> dict:
    """What differs from what the dialog was filled with and from the defaults; plain values only."""
    algorithm = algorithm_of(step.algorithm)
    result = {}
    for definition in algorithm.parameterDefinitions():
        name = definition.name()
        if definition.isDestination():
            result.update(_changed_place(name, before.get(name), found.get(name)))
            continue
        value = plain_value(found.get(name))
        if value is None:
            continue
        was = before.get(name, definition.defaultValue())
        if (value or was) and value != was and [value] != was:
            result[name] = value
    return result


def _changed_place(name: str, before: str | None, found) -> dict:
    """Where a result goes, if that was changed: at its place among the results, or at a place of the user's own."""
    from ....urbanmap_qgis.job.chain_plan import WANTED

    place = found.sink.staticValue() if isinstance(found, QgsProcessingOutputLayerDefinition) else found
    if not isinstance(place, str) or not place or place == before:
        return {}
    if place == QgsProcessing.TEMPORARY_OUTPUT:
        return {} if before else {name: WANTED}
    return {name: place}


def plain_value(value):
    """A dialog's value as a job keeps it: layers of the project as their sources; None for what it cannot keep."""
    if isinstance(value, list):
        kept = [plain_value(item) for item in value]
        return None if None in kept else kept
    if isinstance(value, QgsCoordinateReferenceSystem):
        return value.authid() or None
    if isinstance(value, str):
        layer = QgsProject.instance().mapLayer(value)
        return layer.source() if layer is not None else value
    return value if isinstance(value, (int, float, bool)) else None
