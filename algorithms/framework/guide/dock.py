"""The dock “UrbanMap”: from files to results, and the job kept in a file."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from qgis.PyQt.QtCore import Qt
from qgis.PyQt.QtWidgets import (
    QComboBox,
    QDockWidget,
    QFileDialog,
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from ....urbanmap_qgis.errors import UrbanMapError
from ....urbanmap_qgis.wording import mark
from ..declaring.parameters import tr
from ..jobs.job_steps import algorithms_there, make_results_folder, results_folder
from ..packages.dependencies import refusal
from ..running.native_libraries import PACKAGES_WITH_LIBRARIES, import_apart
from .files_panel import FilesPanel
from .import_dialog import ImportDialog
from .step_dialog import StepDialog
from .step_runner import StepRunner
from .steps_panel import StepsPanel

NEEDED = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
RESULTS_VIEWER = "ResultsViewer"
"""Name of the dock in which Processing lists reports."""
JOB_FILTER = mark("UrbanMap job (*.urbanmap.json)")


class GuideDock(QDockWidget):
    """What have you, what do you want, what is missing, and the steps; all else is asked of the core and algorithms."""

    def __init__(self, parent=None):
        super().__init__(tr("UrbanMap"), parent)
        self.setObjectName("UrbanMapGuide")
        self.job, self.path, self.dialog, self.importing = None, None, None, None
        self._loading = False
        self._kept: bytes | None = None  # the job's file as this window wrote or read it last
        self.files, self.runner = FilesPanel(), StepRunner(self)
        self.steps = StepsPanel(self.runner)
        self.wish, self.missing, self.place, self.pages = QComboBox(), QLabel(), QLabel(), QTabWidget()
        self._lay_out()
        self.files.changed.connect(self.plan)
        self.files.preview_wanted.connect(self.import_table)
        self.wish.currentIndexChanged.connect(self.plan)
        self.steps.wanted.connect(self.open_step)
        self.steps.run_wanted.connect(self.run)
        self.runner.changed.connect(self._keep)

    def _lay_out(self) -> None:
        for label in (self.missing, self.place):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        for title, *widgets in ((tr("1. What have you?"), self.files),
                                (tr("2. What do you want?"), self.wish, self.missing, self.steps)):
            page = QWidget()
            column = QVBoxLayout(page)
            for widget in widgets:
                column.addWidget(widget)
            area = QScrollArea()
            area.setWidgetResizable(True)
            area.setFrameShape(QFrame.Shape.NoFrame)
            area.setWidget(page)
            self.pages.addTab(area, title)
        inside = QWidget()
        layout = QVBoxLayout(inside)
        layout.addLayout(self._job_row())
        layout.addWidget(self.place)
        layout.addWidget(self.pages, 1)
        self.setWidget(inside)
        self._fill_wishes()

    def _job_row(self) -> QHBoxLayout:
        row = QHBoxLayout()
        for label, work in ((tr("New job"), self.new_job), (tr("Open job…"), self._browse_job),
                            (tr("Save job as…"), self._save_as), (tr("Import table…"), self.import_table)):
            button = QPushButton(label)
            button.clicked.connect(lambda _checked=False, work=work: work())
            row.addWidget(button)
        row.addStretch(1)
        return row

    def _fill_wishes(self) -> None:
        message = refusal(NEEDED)
        self.setEnabled(not message)
        if message:
            self.missing.setText(message)
            return
        import_apart(PACKAGES_WITH_LIBRARIES)
        from ....urbanmap_qgis.job.chain_plan import wish_name, wishes

        self.wish.addItem(tr("Choose…"), "")
        for wish in wishes(algorithms_there()):
            self.wish.addItem(wish_name(wish), wish)

    def plan(self, *_ignored) -> None:
        """Plan the chain anew from the files that are used and the wish; settings and states of steps stay."""
        from ....urbanmap_qgis.job.agreement import common_system
        from ....urbanmap_qgis.job.chain_plan import plan_chain, roles_taken
        from ....urbanmap_qgis.job.job_file import planned_job
        from ....urbanmap_qgis.job.job_progress import refreshed_job
        from ....urbanmap_qgis.job.roles import parts_of

        wish, used = self.wish.currentData(), self.files.used()
        if self._loading or self.runner.busy():
            return
        if not wish or not self.files.findings.facts:
            self.missing.clear()
            return
        parts = parts_of(used)
        plan = plan_chain(wish, parts, crs_text(common_system(used)))
        taken = roles_taken(plan.steps)
        chosen = [sentence for role, sentence in parts.choices.items() if role in taken]
        told = [*(f"• {sentence}" for sentence in plan.missing),
                *(f"◦ {sentence}" for sentence in (*parts.notes, *chosen, *plan.notes))]
        head = tr("Missing:") if plan.missing else tr("Nothing is missing.")
        self.missing.setText("\n".join([head, *told]))
        result = planned_job(wish, parts.inputs, plan.steps, tuple(self.files.given), self.job)
        self._keep(refreshed_job(replace(result, left_out=tuple(sorted(self.files.left_out)),
                                         used_as=dict(self.files.used_as))))
        self.steps.told.clear()
        self.steps.show_job(self.job)
        self.steps.run.setEnabled(not plan.missing)

    def run(self) -> None:
        """Run what is not done, one step after the other."""
        if self.path is None:
            self.path = default_place(self.files.given)
        self.steps.tree.setCurrentItem(None)  # what comes out is chosen
        self.runner.start(self.job, [step.id for step in self.job.steps], results_folder(self.path))

    def open_step(self, identifier: str) -> None:
        """Open a step's own dialog, filled in."""
        folder = results_folder(self.path or default_place(self.files.given))
        try:
            make_results_folder(folder)
        except UrbanMapError as error:
            self.steps.told.setText(str(error))
        self.dialog = StepDialog(self.job, self.job.step(identifier), folder, self)
        self.dialog.taken.connect(self._take)
        self.dialog.done.connect(self._take_results)

    def _take(self, identifier: str, values: dict) -> None:
        """Keep what the user has set in a step's dialog."""
        from ....urbanmap_qgis.job.job_progress import refreshed_job

        step = self.job.step(identifier)
        changed = replace(step, parameters={**step.parameters, **values}, own=tuple(sorted({*step.own, *values})))
        self._keep(refreshed_job(self.job.with_step(changed)))
        self.steps.show_job(self.job)

    def _take_results(self, identifier: str, results: dict) -> None:
        """Keep what a step has made that was run from its own dialog."""
        from ....urbanmap_qgis.job.job_progress import done_step, resolved_parameters

        step = self.job.step(identifier)
        self._keep(self.job.with_step(done_step(step, resolved_parameters(self.job, step), results, step.seconds)))
        self.steps.show_job(self.job)
        self.raise_()  # QGIS has put its results viewer in front

    def _keep(self, job) -> None:
        """Take a job and write it beside the data."""
        from ....urbanmap_qgis.job.job_file import write_job

        self.job = job
        if self.path is None and self.files.given:
            self.path = default_place(self.files.given)
        if self.path is None:
            return
        if self._kept is not None and _bytes_of(self.path) not in (None, self._kept):
            self.place.setText(tr(
                "{0} was changed by another window of QGIS and is not written over: open it again, or save this job "
                "under another name.").format(self.path))
            return
        try:
            write_job(self.path, job)
            self._kept = _bytes_of(self.path)
            self.place.setText(tr("Job: {0}").format(self.path))
        except UrbanMapError as error:
            self.place.setText(str(error))

    def new_job(self) -> None:
        """Begin with nothing."""
        self.runner.cancel()
        self.job, self.path, self._kept = None, None, None
        self.place.clear()
        self.wish.setCurrentIndex(0)
        self.files.clear()
        self.steps.show_job(None)
        self.pages.setCurrentIndex(0)

    def open_job(self, path: str) -> None:
        """Take a job from its file; steps that are done and unchanged stay so."""
        from ....urbanmap_qgis.job.job_file import read_job
        from ....urbanmap_qgis.job.job_progress import refreshed_job

        try:
            job = refreshed_job(read_job(path))
        except UrbanMapError as error:
            self.place.setText(str(error))
            return
        self.job, self.path, self._kept = job, Path(path), _bytes_of(Path(path))
        self._loading = True
        self.wish.setCurrentIndex(max(self.wish.findData(job.wish), 0))
        self._loading = False
        self.place.setText(tr("Job: {0}").format(self.path))
        self.files.set_given(job.given, job.left_out, job.used_as)
        self.steps.show_job(job)
        self.pages.setCurrentIndex(1)

    def import_table(self, path: str = "") -> None:
        """Let the user import a table of another program, with a preview of its columns, and take what comes out."""
        from ....urbanmap_qgis.job.agreement import common_system

        used = self.files.used()
        self.importing = ImportDialog(self, crs_text(common_system(used)) if used else "")
        self.importing.imported.connect(lambda made: self.files.add([made]))
        self.importing.show()
        if path:
            self.importing.open_file(path)

    def _browse_job(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self, tr("Open job…"), "", tr(JOB_FILTER))
        if path:
            self.open_job(path)

    def _save_as(self) -> None:
        path, _ = QFileDialog.getSaveFileName(self, tr("Save job as…"), str(self.path or ""), tr(JOB_FILTER))
        if path and self.job is not None:
            self.path, self._kept = Path(path if path.endswith(".json") else f"{path}.urbanmap.json"), None
            self._keep(self.job)

    def share_place(self, window) -> None:
        """Be a tab beside QGIS's results viewer where both lie on one side of the window: it opens by itself with the
        first report of a dialog, and would take half of the dock's height, so that the steps are out of sight."""
        viewer = window.findChild(QDockWidget, RESULTS_VIEWER)
        if viewer is not None and not viewer.isFloating() and window.dockWidgetArea(viewer) == window.dockWidgetArea(
                self):
            window.tabifyDockWidget(viewer, self)

    def shut(self) -> None:
        """End what is at work, before the dock goes."""
        self.files.recognition.stop()
        self.runner.cancel()


def _bytes_of(path: Path) -> bytes | None:
    """What a file holds, None where it is not there."""
    try:
        return path.read_bytes()
    except OSError:
        return None


def default_place(given: list[str]) -> Path:
    """Where a job is kept if nobody says otherwise: in the folder that holds all files given, under its name."""
    folder = Path(given[0]) if len(given) == 1 and Path(given[0]).is_dir() else Path(
        os.path.commonpath([str(Path(path).parent) for path in given]))
    return folder / f"{folder.name or 'job'}.urbanmap.json"


def crs_text(wkt: str) -> str:
    """The plane part of a system as its code where it has one, as parameters of algorithms take it."""
    from ..layers.crs import crs_from, horizontal

    found = horizontal(crs_from(wkt)) if wkt else None
    return (found.authid() or found.toWkt()) if found is not None and found.isValid() else ""
