"""What became of a job on one page: each step with its state, verdict and results."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from ..io.pages.report import BAD, GOOD, LOOK, Report
from ..wording import known, mark, say
from .chain_plan import WISHES, wish_name
from .job_file import DONE, FAILED, PLANNED, JobRecord
from .roles import use_name

STATE_NAMES = {PLANNED: mark("to run"), DONE: mark("done"), FAILED: mark("error")}
"""English name of each state."""


def state_name(state: str) -> str:
    """Name of a state in the user's language."""
    return known(STATE_NAMES[state])


def write_job_report(path: str | os.PathLike, job: JobRecord, titles: Mapping[str, str]) -> None:
    """Write the page; `titles` gives each algorithm's name by its id."""
    page = Report(say("Job: {wish}", wish=wish_name(job.wish) if job.wish in WISHES else job.wish))
    grade, text = _verdict(job)
    page.verdict(grade, text)
    page.section(say("Steps"))
    page.table([say("Step"), say("Algorithm"), say("State"), say("Seconds"), say("Verdict")],
               [(step.id, titles.get(step.algorithm, step.algorithm), state_name(step.state), step.seconds or "",
                 step.verdict or step.message) for step in job.steps])
    page.section(say("Inputs"))
    page.table([say("Part"), say("Files")], [
        (use_name(role), ", ".join(Path(item.partition("|")[0]).name for item in sources))
        for role, sources in job.inputs.items()])
    page.section(say("Results"))
    page.table([say("Step"), say("Files")], [(step.id, ", ".join(Path(item).name for item in step.files))
                                             for step in job.steps if step.files])
    page.write(path)


def _verdict(job: JobRecord) -> tuple[str, str]:
    """The worst that a step says."""
    failed = [step for step in job.steps if step.state == FAILED]
    if failed:
        return BAD, say("Step “{step}” failed: {message}", step=failed[0].id, message=failed[0].message)
    waiting = sum(step.state == PLANNED for step in job.steps)
    if waiting:
        return LOOK, say("{waiting} of {count} steps have not run yet.", waiting=waiting, count=len(job.steps))
    for grade in (BAD, LOOK):
        of_grade = [step for step in job.steps if step.grade == grade]
        if of_grade:
            return grade, say("{step}: {verdict}", step=of_grade[0].id, verdict=of_grade[0].verdict)
    if not any(step.grade for step in job.steps):
        return LOOK, say("All steps are done; none of them judges its result: look at the layers.")
    return GOOD, say("All steps are done, and no report finds fault.")
