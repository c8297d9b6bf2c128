"""The chain as steps with their states; each opens in its own dialog, all run one after the other."""

from __future__ import annotations

from qgis.PyQt.QtCore import Qt, QTimer, QUrl, pyqtSignal
from qgis.PyQt.QtGui import QColor, QDesktopServices
from qgis.PyQt.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from ..declaring.parameters import tr
from ..jobs.job_steps import algorithm_of, short_id
from .step_runner import StepRunner

_STEP = Qt.ItemDataRole.UserRole
_COLOURS = {"good": "#1a7d3c", "look": "#a86400", "bad": "#c0273a", "failed": "#c0273a", "done": "#1a7d3c"}
_BAD = {"failed", "bad"}
"""States and grades of what is to be looked at before all else."""
_TICK = 1000  # ms between looks at the time that is left


def told_of(step) -> str:
    """What a step found or why it failed; nothing where it is to run anew, as that would be of an earlier run."""
    return "" if step.state == "planned" else step.verdict or step.message


class StepsPanel(QWidget):
    """Shows a job's steps and runs them; `wanted` comes with the id of a step whose dialog is to open."""

    wanted = pyqtSignal(str)
    run_wanted = pyqtSignal()

    def __init__(self, runner: StepRunner, parent=None):
        super().__init__(parent)
        self.runner = runner
        self.tree, self.bar, self.told = QTreeWidget(), QProgressBar(), QLabel()
        self.run, self.stop = QPushButton(tr("Run")), QPushButton(tr("Cancel"))
        self.open, self.report = QPushButton(tr("Settings…")), QPushButton(tr("Report"))
        self._lay_out()
        self.clock = QTimer(self)
        self.clock.timeout.connect(self._tell_time)
        self.run.clicked.connect(self.run_wanted)
        self.stop.clicked.connect(runner.cancel)
        self.open.clicked.connect(self._open)
        self.report.clicked.connect(self._show_report)
        self.tree.itemDoubleClicked.connect(lambda *_: self._open())
        self.tree.currentItemChanged.connect(self._choose)
        runner.changed.connect(self.show_job)
        runner.moved.connect(lambda share: self.bar.setValue(int(100 * share)))
        runner.ended.connect(self._ended)
        self.job = None
        self._enable()

    def _lay_out(self) -> None:
        self.tree.setHeaderLabels([tr("Step"), tr("State"), tr("Verdict")])
        self.tree.setRootIsDecorated(False)
        self.tree.setMinimumHeight(150)
        self.tree.setWordWrap(True)
        self.told.setWordWrap(True)
        self.bar.hide()
        row = QHBoxLayout()
        for button in (self.run, self.stop, self.open, self.report):
            row.addWidget(button)
        row.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addLayout(row)  # above the list: seen in a low window too
        layout.addWidget(self.bar)
        layout.addWidget(self.told)
        layout.addWidget(self.tree)

    def show_job(self, job) -> None:
        """Show the steps of a job as they are."""
        from ....urbanmap_qgis.job.job_report import state_name

        self.job = job
        chosen, at_work = self.chosen(), None
        self.tree.clear()
        steps = job.steps if job else ()
        for number, step in enumerate(steps, 1):
            title = algorithm_of(step.algorithm).displayName()
            if sum(other.algorithm == step.algorithm for other in steps) > 1:
                title = f"{title} ({short_id(step.id)})"
            state = tr("running") if step.id == self.runner.current else state_name(step.state)
            text = told_of(step)
            row = QTreeWidgetItem(self.tree, [f"{number}. {title}", state, text])
            row.setData(0, _STEP, step.id)
            row.setToolTip(0, step.id)
            row.setToolTip(2, text)
            row.setForeground(1, QColor(_COLOURS.get(step.state, "#5b6b75")))
            if text:
                row.setForeground(2, QColor(_COLOURS.get(step.grade or step.state, "#5b6b75")))
            if step.id == chosen:
                self.tree.setCurrentItem(row)
            if step.id == self.runner.current:
                at_work = row
        for column in (0, 1):
            self.tree.resizeColumnToContents(column)
        if at_work is not None:
            self.tree.scrollToItem(at_work)
        self._enable()
        self._tell_time()

    def chosen(self) -> str:
        """Id of the step that is chosen, "" for none."""
        row = self.tree.currentItem()
        return row.data(0, _STEP) if row is not None else ""

    def _choose(self, row: QTreeWidgetItem | None, _before) -> None:
        """Show the whole verdict of the step that is chosen, which its line may be too short for."""
        if row is not None and not self.runner.busy():
            self.told.setText(row.text(2))
        self._enable()

    def _enable(self) -> None:
        busy, step = self.runner.busy(), self.chosen()
        self.run.setEnabled(bool(self.job and self.job.steps) and not busy)
        self.stop.setEnabled(busy)
        self.open.setEnabled(bool(step) and not busy)
        self.report.setEnabled(bool(step and self._report_of(step)))
        self.bar.setVisible(busy)
        if busy and not self.clock.isActive():
            self.bar.setValue(0)
            self.clock.start(_TICK)
        elif not busy:
            self.clock.stop()

    def _report_of(self, step: str) -> str:
        outputs = self.job.step(step).outputs if self.job else {}
        return next((str(value) for name, value in outputs.items() if name.endswith("REPORT") and value), "")

    def _show_report(self) -> None:
        QDesktopServices.openUrl(QUrl.fromLocalFile(self._report_of(self.chosen())))

    def _open(self) -> None:
        if self.chosen() and not self.runner.busy():
            self.wanted.emit(self.chosen())

    def _tell_time(self) -> None:
        """Which step is at work, and how long all still takes."""
        if not self.runner.busy() or self.job is None:
            return
        ids = [step.id for step in self.job.steps]
        step = self.job.step(self.runner.current)
        words = tr("{0} of {1}: {2}").format(ids.index(step.id) + 1, len(ids),
                                             algorithm_of(step.algorithm).displayName())
        left = self.runner.seconds_left()
        self.told.setText(words if left is None else tr("{0}, about {1} left").format(words, duration_text(left)))

    def _ended(self, sentence: str) -> None:
        """Say how the run ended, and what the step found that is chosen, or else what came out."""
        if not self.chosen() and self.job is not None:
            self._choose_outcome()
        row = self.tree.currentItem()
        found = row.text(2) if row is not None else ""
        self.told.setText(sentence if not found or found in sentence else f"{sentence}\n{found}")
        self._enable()

    def _choose_outcome(self) -> None:
        """Choose the first step that failed or found its result bad, else the last that says something: that is what
        was wished for. Its report can be opened at once."""
        bad = [row for row, step in enumerate(self.job.steps) if _BAD & {step.state, step.grade}]
        told = [row for row, step in enumerate(self.job.steps) if told_of(step)]
        if bad or told:
            self.tree.setCurrentItem(self.tree.topLevelItem(bad[0] if bad else told[-1]))


def duration_text(seconds: float) -> str:
    """A duration in words, as exactly as it is known."""
    if seconds < 90:
        return tr("{0} s").format(round(seconds))
    return tr("{0} min").format(round(seconds / 60)) if seconds < 5400 else tr("{0:.1f} h").format(seconds / 3600)
