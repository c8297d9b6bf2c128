"""How far a job is: what a step's parameters come to, whether it has to run again, what its report says."""

from __future__ import annotations

import hashlib
import html
import json
import os
import re
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from urllib.parse import quote

from ..errors import InputError
from ..wording import say
from .job_file import DONE, FAILED, PLANNED, JobRecord, JobStep

_HEAD_OF_SQLITE, _ENDS = 100, 8_000_000
"""Bytes."""
_VERDICT = re.compile(r'<p class="verdict (\w+)">(.*?)</p>', re.DOTALL)
_HEAD = 200_000
"""Characters of a report in which its verdict stands."""


def resolved_parameters(job: JobRecord, step: JobStep) -> dict[str, object]:
    """A step's parameters with the files of its inputs and the results of earlier steps in their places.

    An input is a list of sources always; the face gives an algorithm one or several as it takes them.

    Raises
    ------
    InputError : the job has no such input, or the step before it has not been run.
    """
    return {name: _resolved(job, step, value) for name, value in step.parameters.items()}


def _resolved(job: JobRecord, step: JobStep, value: object) -> object:
    if isinstance(value, (list, tuple)):
        return [_resolved(job, step, item) for item in value]
    if isinstance(value, Mapping) and "input" in value:
        sources = job.inputs.get(str(value["input"]))
        if not sources:
            raise InputError(say("Step “{step}”: the job has no input “{role}”; add the file.", step=step.id,
                                 role=value["input"]))
        return list(sources)
    if isinstance(value, Mapping) and "step" in value:
        before = job.step(str(value["step"]))
        result = before.outputs.get(str(value["output"]))
        if before.state == DONE and result is None:
            raise InputError(say("Step “{step}” needs {output} of step “{before}”, which gave none: say it in the "
                                 "settings of the step.", step=step.id, output=value["output"], before=before.id))
        if before.state != DONE:
            raise InputError(say("Step “{step}” needs what “{before}” makes: run that step first.", step=step.id,
                                 before=before.id))
        return result
    return value


def step_signature(algorithm: str, parameters: Mapping[str, object]) -> str:
    """A text that is the same as long as the parameters and the files that they name are, wherever these lie: a job
    that has moved with its data is as it was."""
    named = {name: _without_folders(value) for name, value in parameters.items()}
    text = json.dumps([algorithm, named], sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()


def _without_folders(value: object) -> object:
    """A value of a parameter with each file in it as its name and state."""
    if isinstance(value, (list, tuple)):
        return [_without_folders(item) for item in value]
    path = next(_paths(value), None)
    if path is None:
        return value
    return [os.path.basename(path) + str(value)[len(path):], file_state_of(path), _digest(path)]


def _digest(path: str) -> str:
    """Of the content of a GeoPackage, whose own record of changes may be the same in two files of one name; "" for
    other files. Its head is left out, as QGIS changes it when it only opens the file; of a large one the ends count."""
    if os.path.isdir(path) or not _changes(path):
        return ""
    with open(path, "rb") as file:
        file.seek(_HEAD_OF_SQLITE)
        found = hashlib.sha256(file.read(_ENDS))
        file.seek(max(os.path.getsize(path) - _ENDS, _HEAD_OF_SQLITE))
        found.update(file.read(_ENDS))
    return found.hexdigest()


def _paths(value: object) -> Iterator[str]:
    if isinstance(value, (list, tuple)):
        for item in value:
            yield from _paths(item)
    elif isinstance(value, str) and value:
        path = value.partition("|")[0]
        if len(path) < 4096 and "\n" not in path and os.path.isabs(path) and os.path.exists(path):
            yield path


def file_state_of(path: str) -> list:
    """What tells whether a file is as it was; [] where it is gone.

    Size (bytes) and time of change (ns); of a folder the names in it; of a GeoPackage, which changes its time when QGIS
    only opens it, its own record of changes.
    """
    try:
        found = os.stat(path)
        if os.path.isdir(path):
            return sorted(os.listdir(path))
    except OSError:  # gone: it is then not what it was
        return []
    return [found.st_size, _changes(path) or found.st_mtime_ns]


def _changes(path: str) -> str:
    """Tables of a GeoPackage with the moment of their last change; "" for other files."""
    with open(path, "rb") as file:
        if not file.read(16).startswith(b"SQLite format 3"):
            return ""
    try:
        with closing(sqlite3.connect(f"file:{quote(path)}?mode=ro&immutable=1", uri=True)) as base:
            rows = base.execute("SELECT table_name, last_change FROM gpkg_contents ORDER BY table_name").fetchall()
    except (sqlite3.DatabaseError, UnicodeError):  # no GeoPackage, or a damaged one: its time of change tells
        return ""
    return "; ".join(f"{name} {moment}" for name, moment in rows)


def is_up_to_date(job: JobRecord, step: JobStep) -> bool:
    """Whether a step is done, with the parameters and inputs as they are now, and its results are all there."""
    if step.state != DONE:
        return False
    try:
        signature = step_signature(step.algorithm, resolved_parameters(job, step))
    except InputError:  # what it needs is not there (any more)
        return False
    return signature == step.signature and all(file_state_of(path) == list(state) for path, state in step.files.items())


def done_step(step: JobStep, parameters: Mapping[str, object], results: Mapping[str, object],
              seconds: float) -> JobStep:
    """A step after it has run well: results, states of the files and the verdict of its report."""
    outputs = {name: value for name, value in results.items() if isinstance(value, (str, int, float, bool))}
    files = {path: file_state_of(path) for value in outputs.values() for path in _paths(value)}
    grade, verdict = next((found for name, value in outputs.items() if name.endswith("REPORT")
                           and (found := verdict_of(str(value)))[0]), ("", ""))
    return replace(step, state=DONE, signature=step_signature(step.algorithm, parameters), outputs=outputs, files=files,
                   grade=grade, verdict=verdict, message="", seconds=round(seconds, 1))


def failed_step(step: JobStep, message: str, seconds: float) -> JobStep:
    """A step after it has failed."""
    return replace(step, state=FAILED, signature="", outputs={}, files={}, grade="", verdict="", message=message,
                   seconds=round(seconds, 1))


def refreshed_job(job: JobRecord) -> JobRecord:
    """The job with steps back to planned whose parameters, inputs or results have changed since they were done."""
    for step in job.steps:
        if step.state == DONE and not is_up_to_date(job, step):
            job = job.with_step(replace(step, state=PLANNED))
    return job


def verdict_of(path: str | os.PathLike) -> tuple[str, str]:
    """Grade and text of a report's verdict; both "" where it has none or is not there."""
    if not Path(path).is_file() or Path(path).suffix.lower() != ".html":
        return "", ""
    with open(path, encoding="utf-8", errors="replace") as file:
        found = _VERDICT.search(file.read(_HEAD))
    return (found.group(1), html.unescape(re.sub(r"<[^>]+>", "", found.group(2)))) if found else ("", "")


def time_remaining(steps: Sequence[JobStep], done_seconds: float, fraction: float) -> float | None:
    """Seconds that the run still takes, by the share of this step that is done and what steps took before.

    Parameters
    ----------
    steps : the step at work first, then those that wait.
    done_seconds : since the step at work began.
    fraction : of it that is done, 0 to 1.

    Returns
    -------
    None while nothing can be said: of this step too little is done, or a step that waits has never run.
    """
    waiting = [step.seconds for step in steps[1:]]
    if fraction >= 0.05:
        seconds = done_seconds * (1.0 - fraction) / fraction
    elif steps and steps[0].seconds:
        seconds = max(steps[0].seconds - done_seconds, 0.0)
    else:
        return None
    return None if not all(waiting) and waiting else seconds + sum(waiting)
