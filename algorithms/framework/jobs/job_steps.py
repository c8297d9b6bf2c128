"""A job's steps as runs of algorithms: what each is given, and where its results go.

What an algorithm takes and makes is asked of its definitions; nothing of it stands here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from qgis.core import QgsApplication, QgsProcessingAlgorithm

from ....urbanmap_qgis.errors import InputError
from ..declaring.parameters import tr

_DESTINATIONS = ("sink", "rasterDestination", "fileDestination")


def short_id(identifier: str) -> str:
    """What tells a step from others of its algorithm: the survey's number, "2" of "survey_2", else the id."""
    number = identifier.rpartition("_")[2]
    return number if number.isdigit() else identifier


def algorithm_of(identifier: str) -> QgsProcessingAlgorithm:
    """An algorithm of the provider by its id.

    Raises
    ------
    InputError : there is none.
    """
    found = QgsApplication.processingRegistry().createAlgorithmById(f"urbanmap:{identifier}")
    if found is None:
        raise InputError(tr("The job has a step “{0}”, which is no algorithm of this version: update the plugin.")
                         .format(identifier))
    return found


def algorithms_there() -> set[str]:
    """Ids of the algorithms that the provider has."""
    provider = QgsApplication.processingRegistry().providerById("urbanmap")
    return {item.name() for item in provider.algorithms()} if provider else set()


def results_folder(job_path: Path) -> Path:
    """Where a job's results go if nobody says otherwise: beside it, under its name."""
    from ....urbanmap_qgis.job.recognition.contents import RESULTS_ENDING

    name = re.sub(r"(\.urbanmap)?\.json$", "", job_path.name, flags=re.IGNORECASE)
    return job_path.parent / f"{name}{RESULTS_ENDING}"


def make_results_folder(folder: Path) -> None:
    """Make the folder of a job's results, without which no algorithm writes there; InputError where that fails."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(tr("The folder of the results cannot be made ({0}): save the job in another folder by "
                            "“Save job as…”.").format(error)) from error


def filled_parameters(job, step, folder: Path) -> dict:
    """Parameters with which a step runs: its own, and a place in `folder` for each result.

    Raises
    ------
    InputError : something is missing that it needs, or several files are given where it takes one.
    """
    from ....urbanmap_qgis.job.chain_plan import WANTED
    from ....urbanmap_qgis.job.job_progress import resolved_parameters

    algorithm = algorithm_of(step.algorithm)
    values = resolved_parameters(job, step)
    result = {name: _fitting(algorithm, name, value) for name, value in values.items() if value != WANTED}
    for name, place in _places(algorithm, job, step, folder):
        result.setdefault(name, str(place))
    return result


def prefilled_parameters(job, step, folder: Path) -> dict:
    """The same for a dialog, in which what is not there yet stays empty."""
    from dataclasses import replace

    result = {}
    for name, value in step.parameters.items():
        try:
            result.update(filled_parameters(job, replace(step, parameters={name: value}), folder))
        except InputError:  # the step that makes it has not run: the user sees the empty field
            continue
    return result or dict(filled_parameters(job, replace(step, parameters={}), folder))


def _fitting(algorithm: QgsProcessingAlgorithm, name: str, value):
    """A value as the algorithm takes it: several files as a flat list, one as itself."""
    definition = algorithm.parameterDefinition(name)
    if definition is None:
        raise InputError(tr("{0} has no parameter {1}: correct the job.").format(algorithm.displayName(), name))
    if not isinstance(value, list):
        return [value] if definition.type() == "multilayer" and isinstance(value, str) else value
    flat = list(_flat(value))
    if definition.type() == "multilayer":
        return flat
    if len(flat) > 1:
        raise InputError(tr("{0}: “{1}” takes one file, but the job gives {2}: leave one.").format(
            algorithm.displayName(), definition.description(), len(flat)))
    return flat[0] if flat else None


def _flat(values: list) -> Iterator:
    for value in values:
        if isinstance(value, list):
            yield from _flat(value)
        else:
            yield value


def _places(algorithm: QgsProcessingAlgorithm, job, step, folder: Path) -> Iterator[tuple[str, Path]]:
    """Each result that is made by default, that must be named, is asked for or taken later, and its place."""
    from ....urbanmap_qgis.job.chain_plan import WANTED

    taken = set(_taken(step.id, [other.parameters for other in job.steps]))
    taken |= {name for name, value in step.parameters.items() if value == WANTED}
    for definition in algorithm.destinationParameterDefinitions():
        optional = bool(definition.flags() & definition.Flag.FlagOptional)
        wanted = not optional or definition.createByDefault() or definition.name() in taken
        if wanted:
            ending = f".{definition.defaultFileExtension()}" if definition.type() in _DESTINATIONS else ""
            part = definition.name().removeprefix("OUTPUT").strip("_").lower()
            yield definition.name(), folder / ("_".join(word for word in (step.id, part) if word) + ending)


def _taken(step: str, value) -> Iterator[str]:
    """Names of the results of a step that the parameters of others take."""
    if isinstance(value, Mapping):
        if value.get("step") == step:
            yield str(value.get("output"))
        for item in value.values():
            yield from _taken(step, item)
    elif isinstance(value, (list, tuple)):
        for item in value:
            yield from _taken(step, item)


def shown_results_of(algorithm: QgsProcessingAlgorithm, results: Mapping) -> Iterator[tuple[str, Path]]:
    """Label and file of each result that is a layer of its own."""
    for definition in algorithm.destinationParameterDefinitions():
        value = results.get(definition.name())
        if definition.type() in ("sink", "rasterDestination") and isinstance(value, str):
            path = Path(value.partition("|")[0])
            if path.is_file():
                yield definition.description(), path
