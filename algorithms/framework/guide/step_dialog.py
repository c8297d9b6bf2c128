"""A step's own dialog, filled in from the job, and what the user set in it taken back into the job."""

from __future__ import annotations

from collections.abc import Mapping

from qgis.core import QgsCoordinateReferenceSystem, QgsProcessingException, QgsProject
from qgis.PyQt.QtCore import QEvent, QObject, pyqtSignal

from ..jobs.job_steps import algorithm_of, prefilled_parameters


class StepDialog(QObject):
    """Opens the dialog of a step; `taken` comes with the step's id and parameters when it is closed."""

    taken = pyqtSignal(str, object)
    done = pyqtSignal(str, object)

    def __init__(self, job, step, folder, parent=None):
        super().__init__(parent)
        import processing

        self.step, self.before = step, prefilled_parameters(job, step, folder)
        self.window = processing.createAlgorithmDialog(f"urbanmap:{step.algorithm}", self.before)
        self.window.installEventFilter(self)
        self.window.algorithmFinished.connect(self._finished)
        self.window.show()

    def eventFilter(self, watched, event):
        if watched is self.window and event.type() == QEvent.Type.Close:
            self._take()
        return False

    def values(self) -> dict:
        """Parameters that the user has set in the window, without places of results; {} where they are not whole."""
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


def changed_values(step, before: Mapping, found: Mapping) -> dict:
    """What differs from what the dialog was filled with and from the defaults; plain values only."""
    algorithm = algorithm_of(step.algorithm)
    made = {}
    for definition in algorithm.parameterDefinitions():
        name = definition.name()
        value = plain_value(found.get(name))
        if definition.isDestination() or value is None:
            continue
        was = before.get(name, definition.defaultValue())
        if (value or was) and value != was and [value] != was:
            made[name] = value
    return made


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
