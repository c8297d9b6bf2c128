"""A job in a file beside the data: inputs by role, wish, steps with their states and results.

JSON, version 1. Paths are relative to the file's folder wherever they lie on the same disk, with "/" between folders,
so that data and job can be moved together. The file is written whole or not at all.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from ..errors import InputError
from ..io.files.atomic import written_beside
from ..io.files.guard import read_json, reading_part, reads
from ..wording import say
from .chain_plan import WANTED, PlannedStep
from .recognition.json_facts import JOB_MARK

VERSION = 1
PLANNED, DONE, FAILED = "planned", "done", "failed"


@dataclass(frozen=True)
class JobStep:
    """A step and what became of it.

    Attributes
    ----------
    id, algorithm, parameters : as planned; what the user set is among the parameters.
    own : names of the parameters that the user set, which a later plan leaves.
    state : `PLANNED`, `DONE` or `FAILED`.
    signature : of parameters and input files at the time it was done.
    outputs : results by name: paths, numbers, texts.
    files : size and time of change of the results that are files, by path.
    grade, verdict : of its report, "" where it has none.
    message : why it failed.
    seconds : it took; 0 where it has not run.
    """

    id: str
    algorithm: str
    parameters: Mapping[str, object] = field(default_factory=dict)
    own: tuple[str, ...] = ()
    state: str = PLANNED
    signature: str = ""
    outputs: Mapping[str, object] = field(default_factory=dict)
    files: Mapping[str, list] = field(default_factory=dict)
    grade: str = ""
    verdict: str = ""
    message: str = ""
    seconds: float = 0.0


@dataclass(frozen=True)
class JobRecord:
    """What is run on what, and how far it is; paths in it are absolute."""

    wish: str
    inputs: Mapping[str, tuple[str, ...]]
    steps: tuple[JobStep, ...]
    given: tuple[str, ...] = ()
    """Files and folders that the user gave, from which the inputs were recognised."""
    left_out: tuple[str, ...] = ()
    """Sources among them that are not to be used."""
    used_as: Mapping[str, str] = field(default_factory=dict)
    """What the user says that a source is used as, a key of `roles.USES`."""
    aside: tuple[JobStep, ...] = ()
    """Steps that were done for another wish or with other files; one that is planned again is as it was."""

    def with_step(self, step: JobStep) -> JobRecord:
        """The job with the step of the same id replaced."""
        return replace(self, steps=tuple(step if item.id == step.id else item for item in self.steps))

    def step(self, identifier: str) -> JobStep:
        """The step of an id.

        Raises
        ------
        InputError : there is none.
        """
        for item in self.steps:
            if item.id == identifier:
                return item
        raise InputError(say("The job has no step “{step}”; it has {known}.", step=identifier,
                             known=", ".join(item.id for item in self.steps)))

    def with_inputs(self, changed: Mapping[str, tuple[str, ...]]) -> JobRecord:
        """The job on other files: the inputs of these roles replaced.

        Raises
        ------
        InputError : a role that the job does not have.
        """
        strange = sorted(set(changed) - set(self.inputs))
        if strange:
            raise InputError(say("The job has no input “{role}”; it has {known}.", role=strange[0],
                                 known=", ".join(sorted(self.inputs))))
        return replace(self, inputs={**self.inputs, **changed})


def planned_job(wish: str, inputs: Mapping[str, tuple[str, ...]], steps: Iterable[PlannedStep | JobStep],
                given: tuple[str, ...] = (), before: JobRecord | None = None) -> JobRecord:
    """A job of planned steps, none of them run; one that `before` has too keeps its state, results and settings."""
    old = {(item.id, item.algorithm): item for item in (*before.aside, *before.steps)} if before else {}
    planned = []
    for step in steps:
        known = old.pop((step.id, step.algorithm), None)
        if known is None:
            planned.append(JobStep(step.id, step.algorithm, step.parameters))
            continue
        planned.append(replace(known, parameters={**_settings(known), **step.parameters,
                                               **{name: known.parameters[name] for name in known.own}}))
    aside = tuple(item for item in old.values() if item.state == DONE or item.own)
    job = JobRecord(wish, dict(inputs), tuple(planned), given, aside=aside)
    return replace(job, left_out=before.left_out, used_as=before.used_as) if before else job


def _settings(step: JobStep) -> dict[str, object]:
    """Parameters of a step that name no input and no other step: those the next plan sets anew, or not."""
    return {name: value for name, value in step.parameters.items() if value != WANTED and not _refers(value)}


def _refers(value: object) -> bool:
    if isinstance(value, (list, tuple)):
        return any(_refers(item) for item in value)
    return isinstance(value, Mapping) and ("input" in value or "step" in value)


def write_job(path: str | os.PathLike, job: JobRecord) -> None:
    """Write a job file.

    Raises
    ------
    OutputError : it cannot be written there.
    """
    folder = Path(path).resolve().parent
    content = {JOB_MARK: VERSION, "wish": job.wish, "given": [_relative(item, folder) for item in job.given],
               "left_out": [_relative(item, folder) for item in job.left_out],
               "used_as": {_relative(item, folder): use for item, use in job.used_as.items()},
               "inputs": {role: [_relative(item, folder) for item in sources] for role, sources in job.inputs.items()},
               "steps": [_step_content(step, folder) for step in job.steps],
               "aside": [_step_content(step, folder) for step in job.aside]}
    with written_beside(path) as temporary:
        temporary.write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _step_content(step: JobStep, folder: Path) -> dict[str, object]:
    stored = {**asdict(step), "own": list(step.own)}
    for name in ("parameters", "outputs"):
        stored[name] = _stored(stored[name], folder)
    return {**stored, "files": {_relative(file, folder): facts for file, facts in step.files.items()}}


@reads("a job")
def read_job(path: str | os.PathLike) -> JobRecord:
    """Read a job file; paths come back absolute.

    Raises
    ------
    InputError : it is no job, or of a later version.
    """
    content = read_json(path, "a job")
    name, folder = Path(path).name, Path(path).resolve().parent
    if not isinstance(content, dict) or not isinstance(content.get(JOB_MARK), int):
        raise InputError(say("{name} is no UrbanMap job: choose a file that the dock has saved.", name=name))
    if content[JOB_MARK] > VERSION:
        raise InputError(say("{name} was written by a later version of UrbanMap: update the plugin.", name=name))
    with reading_part(path, "steps"):
        listed, aside = list(content["steps"]), list(content.get("aside", ()))
    steps = []
    for number, stored in enumerate([*listed, *aside], 1):
        with reading_part(path, say("step {number}", number=number)):
            steps.append(_read_step(stored, folder))
    steps, aside = steps[:len(listed)], steps[len(listed):]
    twice = [step.id for number, step in enumerate(steps) if step.id in [item.id for item in steps[:number]]]
    if twice:
        raise InputError(say("{name} has the step “{step}” twice: give each its own name.", name=name, step=twice[0]))
    with reading_part(path, "inputs"):
        inputs = {str(role): tuple(_absolute(item, folder) for item in sources)
                  for role, sources in content["inputs"].items()}
        given, left_out = (tuple(_absolute(item, folder) for item in content.get(key, ()))
                           for key in ("given", "left_out"))
        used_as = {_absolute(item, folder): str(use) for item, use in content.get("used_as", {}).items()}
    return JobRecord(str(content.get("wish", "")), inputs, tuple(steps), given, left_out, used_as, tuple(aside))


def _read_step(stored: Mapping[str, object], folder: Path) -> JobStep:
    fields = set(JobStep.__dataclass_fields__)
    step = JobStep(**{key: value for key, value in stored.items() if key in fields})
    return replace(step, parameters=_opened(step.parameters, folder), outputs=_opened(step.outputs, folder),
                   own=tuple(name for name in step.own if name in step.parameters),
                   files={_absolute(file, folder): facts for file, facts in step.files.items()})


_PATH = "path"
"""Key that marks a path among parameters and results: {"path": "results/models.gpkg"}."""


def _stored(value: object, folder: Path) -> object:
    """A parameter as it stands in the file: absolute paths as {"path": relative}."""
    if isinstance(value, Mapping):
        return {key: _stored(item, folder) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_stored(item, folder) for item in value]
    if isinstance(value, os.PathLike) or (isinstance(value, str) and _is_path(value)):
        return {_PATH: _relative(str(value), folder)}
    return value


def _is_path(text: str) -> bool:
    return len(text) < 4096 and "\n" not in text and Path(text.partition("|")[0]).is_absolute()


def _opened(value: object, folder: Path) -> object:
    if isinstance(value, Mapping):
        if set(value) == {_PATH}:
            return _absolute(str(value[_PATH]), folder)
        return {key: _opened(item, folder) for key, item in value.items()}
    return [_opened(item, folder) for item in value] if isinstance(value, list) else value


def _relative(source: str, folder: Path) -> str:
    """A source relative to a folder; as it is on another disk."""
    path, bar, layer = source.partition("|")
    try:
        return Path(os.path.relpath(path, folder)).as_posix() + bar + layer
    except ValueError:  # another drive of Windows
        return source


def _absolute(source: str, folder: Path) -> str:
    path, bar, layer = source.partition("|")
    return os.path.normpath(folder / path) + bar + layer
