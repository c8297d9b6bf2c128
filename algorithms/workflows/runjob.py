"""urbanmap:runjob."""

from __future__ import annotations

import time
from pathlib import Path

from qgis.core import QgsProcessingException, QgsProcessingParameterString

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.jobs.job_steps import algorithm_of, filled_parameters, results_folder, shown_results_of
from ..framework.layers.shown_results import show_layer, shown_after


class RunJob(UrbanMapAlgorithm):
    ID = "runjob"
    NAME = "Run a job"
    SOURCE = "own"
    KEYWORDS = ("job", "batch", "chain", "resume", "repeat", "workflow", "dock")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    KEPT_FOLDERS = ("FOLDER",)
    HELP = (
        "Runs the steps of a job that the dock “UrbanMap” has planned and saved. Steps that are done and whose inputs, "
        "settings and results are as they were are left alone, so that an ended run goes on where it stopped. What "
        "became of each step is written into the job's file.\n"
        "To repeat the job on another survey, give its files as lines ROLE=FILE (several with “;” between them), and "
        "another folder: the job's file is then written into that folder, and the first one stays as it is.\n"
        "A step that fails ends the run with its sentence (on the command line with exit code 1)."
    )

    def flags(self):
        """Not in the toolbox: in the window the guide runs its jobs itself."""
        return super().flags() | self.Flag.FlagHideFromToolbox

    def declare(self):
        self.add_file("JOB", "Job", "File of the job (.urbanmap.json).", "UrbanMap job (*.urbanmap.json *.json)")
        self.declare_parameter(QgsProcessingParameterString("INPUTS", tr("Other inputs"), None, True, True),
                               "Lines ROLE=FILE that take the place of the job's own inputs, with the roles of the "
                               "job, such as survey_1=drive.laz. Relative paths count from the job's folder.")
        self.add_text("STEPS", "Steps", "Ids of the steps to run, with commas between them; all if none is given.")
        self.add_boolean("AGAIN", "Run all steps again", "Also those that are done.", False, advanced=True)
        self.add_folder_output("FOLDER", "Folder of the results", "If none is given, a folder beside the job, under "
                               "its name.", optional=True)
        self.add_report("Each step with its state, verdict and results.")
        self.add_text_output("JOB_FILE", "Job file", "File in which it stands how far the job is.")
        self.add_text_output("RESULTS", "Results", "Folder in which the results lie.")
        self.add_number_output("STEPS_RUN", "Steps run", "Steps that were run now.")
        self.add_number_output("STEPS_KEPT", "Steps kept", "Steps that were done before and left alone.")

    def check(self, parameters, context):
        self._job(parameters, context)

    def compute(self, parameters, context, feedback):
        from ...urbanmap_qgis.job.job_file import write_job
        from ...urbanmap_qgis.job.job_progress import is_up_to_date
        from ...urbanmap_qgis.job.job_report import write_job_report

        job, steps, place, folder = self._job(parameters, context)
        folder.mkdir(parents=True, exist_ok=True)
        run = self.child_runner(context, feedback, len(steps))
        again, done = self.parameterAsBool(parameters, "AGAIN", context), 0
        report = self.output_path(parameters, "OUTPUT_REPORT", context)
        titles = {step.algorithm: algorithm_of(step.algorithm).displayName() for step in job.steps}
        try:
            for identifier in steps:
                step = job.step(identifier)
                if not again and is_up_to_date(job, step):
                    feedback.pushInfo(tr("{0}: done before, with the same inputs and settings; left alone.").format(
                        identifier))
                    continue
                job, trouble = self._run_step(job, step, folder, run)
                write_job(place, job)
                if trouble:
                    raise InputError(trouble)
                self._show(job.step(identifier), context, feedback)
                done += 1
        finally:
            if report is not None:
                write_job_report(report, job, titles)
        results = {} if report is None else {"OUTPUT_REPORT": str(report)}
        return {**results, "FOLDER": str(folder), "JOB_FILE": str(place), "RESULTS": str(folder), "STEPS_RUN": done,
                "STEPS_KEPT": len(steps) - done}

    def _run_step(self, job, step, folder, run):
        """The job after a step, and a sentence where it failed."""
        from ...urbanmap_qgis.job.job_progress import done_step, failed_step, resolved_parameters

        started = time.monotonic()
        try:
            asked = resolved_parameters(job, step)
            results = run(step.algorithm, **filled_parameters(job, step, folder))
        except (QgsProcessingException, InputError) as error:
            message = str(error).removeprefix("There were errors executing the algorithm.").strip()
            return (job.with_step(failed_step(step, message, time.monotonic() - started)),
                    tr("Step “{0}” ({1}) failed: {2}").format(step.id, algorithm_of(step.algorithm).displayName(),
                                                              message))
        return job.with_step(done_step(step, asked, results, time.monotonic() - started)), ""

    def _show(self, step, context, feedback):
        """Let the window load what a step made."""
        if shown_after(feedback):
            for label, path in shown_results_of(algorithm_of(step.algorithm), step.outputs):
                show_layer(context, path, label)

    def _job(self, parameters, context):
        """The job as it is to run, ids of the steps, where its file is kept, and the folder of the results."""
        from ...urbanmap_qgis.job.job_file import planned_job, read_job
        from ...urbanmap_qgis.job.job_progress import refreshed_job

        path = self.input_path(parameters, "JOB", context)
        job = read_job(path)
        changed = self._inputs(parameters, context, path.resolve().parent)
        text = self.parameterAsFileOutput(parameters, "FOLDER", context) if parameters.get("FOLDER") else ""
        folder = Path(text) if text else results_folder(path.resolve())
        if changed and not text:
            raise InputError(tr("{0}: give also a folder, so that the results of the job's own inputs stay.").format(
                self.label_of("INPUTS")))
        place = folder / path.name if text else path
        job = job.with_inputs(changed)
        if text and place.is_file():
            before = read_job(place)
            job = planned_job(job.wish, job.inputs, job.steps, job.given, before)
        elif text:
            job = planned_job(job.wish, job.inputs, job.steps, job.given)
        for step in job.steps:
            algorithm_of(step.algorithm)
        names = [word.strip() for word in self.parameterAsString(parameters, "STEPS", context).split(",")]
        steps = [job.step(name).id for name in names if name] or [step.id for step in job.steps]
        return refreshed_job(job), steps, place, folder

    def _inputs(self, parameters, context, folder):
        """Sources by role of the lines of INPUTS."""
        found = {}
        for line in self.parameterAsString(parameters, "INPUTS", context).splitlines():
            role, sign, files = line.partition("=")
            if not line.strip():
                continue
            if not sign:
                raise InputError(tr("{0}: “{1}” is no line ROLE=FILE.").format(self.label_of("INPUTS"), line.strip()))
            found[role.strip()] = tuple(str((folder / file.strip()).resolve()) for file in files.split(";")
                                        if file.strip())
        missing = [file for files in found.values() for file in files if not Path(file.partition("|")[0]).exists()]
        if missing:
            raise InputError(tr("{0}: {1} does not exist; check its name.").format(self.label_of("INPUTS"), missing[0]))
        return found
