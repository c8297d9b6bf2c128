"""What earlier versions took and this one does not: it may still be given, and is told in a sentence."""

from __future__ import annotations

from collections.abc import Mapping

from qgis.core import QgsApplication

from ..running.step_feedback import StepsMultiStepFeedback
from .parameters import check_names, tr, with_words


def of_today(algorithm, parameters: Mapping) -> tuple[dict, list[str]]:
    """The parameters in the words of today, and a sentence for each name or word that is none.

    Raises
    ------
    InputError : a word of a choice is neither of today nor of an earlier version.
    """
    sentences = check_names(parameters, algorithm.known_names(parameters))
    sentences += [tr(sentence).format(name) for name, sentence in algorithm.RETIRED.items()
                  if parameters.get(name) not in (None, "")]
    result = dict(parameters)
    for name, words in algorithm.RETIRED_WORDS.items():
        given = result.get(name)
        if isinstance(given, str) and given in words:
            result[name] = words[given]
            sentences.append(tr("{0}: “{1}” was retired; the run takes “{2}” instead: give that.").format(
                algorithm.label_of(name), given, words[given]))
    return with_words(result, algorithm.parameterDefinitions()), sentences


def succession(algorithm, feedback) -> list[str]:
    """What is said of an algorithm whose work another does now, where the user, not a chain, runs it."""
    if not algorithm.SUCCESSOR or isinstance(feedback, StepsMultiStepFeedback):
        return []
    identity = f"urbanmap:{algorithm.SUCCESSOR}"
    today = QgsApplication.processingRegistry().algorithmById(identity)
    return [tr("{0} is an id of earlier versions: “{1}” ({2}) does this now; give that.").format(
        f"urbanmap:{algorithm.name()}", today.displayName(), identity)]
