"""Answers about doubtful markings: their parameters, and what they teach."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import metres_per_unit
from ..framework.layers.layers import make_fields

YES, NO = ("true", "1", "1.0", "yes", "t", "y", "はい"), ("false", "0", "0.0", "no", "f", "n", "いいえ")
"""Words of an answer."""

WEIGHTS_FILTER = "Learned weights (*.json)"


def declare_answers(algorithm):
    """Answers, and what was learned from others."""
    algorithm.add_polygons("LABELS", "Answers", "Markings of this orthophoto that you answered: polygons such as the "
                           "doubtful markings of an earlier run, with the field paint true (or 1, yes) where they are "
                           "paint and false (0, no) where not; those left empty do not count. The confidence is "
                           "corrected by what they teach. At least two of each, better thirty, all over the "
                           "image.", optional=True)
    algorithm.add_file("WEIGHTS", "Learned weights", "What an earlier run learned from answers in an orthophoto of the "
                       "same kind (camera, light and processing), with the same method.", WEIGHTS_FILTER,
                       optional=True)


def declare_answer_outputs(algorithm):
    """What is to be answered, and what was learned."""
    algorithm.add_layer_output("OUTPUT_DOUBTFUL", "Doubtful markings", "Markings with a confidence of 0.3 to 0.7, "
                               "those with the most area in doubt first, with the empty field paint: answer some "
                               "and give the layer as answers.", optional=True)
    algorithm.add_file_output("OUTPUT_WEIGHTS", "Weights", "What was learned from the answers, to be given for other "
                              "orthophotos of the same kind.", WEIGHTS_FILTER, optional=True)


def check_answers(algorithm, parameters):
    """Refuse what does not go together."""
    given = [name for name in ("LABELS", "WEIGHTS") if parameters.get(name)]
    if len(given) > 1:
        raise InputError(tr("Give answers, or weights that were learned from answers, not both."))
    if given and parameters.get("ROADS"):
        raise InputError(tr("Where roads are given, the confidence does not ask for the ground, and nothing is "
                            "learned from answers: leave out the roads, or “{0}”.").format(
                                algorithm.label_of(given[0])))
    if parameters.get("OUTPUT_WEIGHTS") and "LABELS" not in given:
        raise InputError(tr("Weights are learned from answers: give “{0}”, or ask for no weights.").format(
            algorithm.label_of("LABELS")))


def refuse_answers(algorithm, parameters):
    """Refuse answers in a run over tiles."""
    if parameters.get("LABELS"):
        raise InputError(tr("Over tiles each would learn for itself: run “{0}” on a part of the orthophoto with "
                            "the answers first, and give its weights here.").format(algorithm.displayName()))


def taught(algorithm, parameters, context, crs, settings, places, progress):
    """Settings with what answers taught, and the path of the weights where they are written."""
    from dataclasses import replace

    from ...urbanmap_qgis.aerial.markings.answered_markings import learned_from_orthophoto
    from ...urbanmap_qgis.aerial.markings.learning.answered_pieces import read_learned

    if not settings.cleaning and (parameters.get("LABELS") or parameters.get("WEIGHTS")):
        raise InputError(tr("Nothing is learned from answers where nothing is left out: clean the markings, and "
                            "do not take the paper's method."))
    if parameters.get("LABELS"):
        learned = learned_from_orthophoto(algorithm.raster_path(parameters, "INPUT", context),
                                          _answers(algorithm, parameters, context), places, settings,
                                          metres_per_unit(crs), progress)
        progress.message(tr("Learned from {0} markings that are paint and {1} that are not.").format(
            learned.yes, learned.no))
    elif weights := algorithm.input_path(parameters, "WEIGHTS", context):
        learned = read_learned(weights)
        method = algorithm.parameterAsString(parameters, "METHOD", context)
        if learned.method != method:
            raise InputError(tr("{0}: these weights were learned with the method “{1}”, not “{2}”.").format(
                algorithm.label_of("WEIGHTS"), learned.method, method))
    else:
        return settings, None
    path = algorithm.output_path(parameters, "OUTPUT_WEIGHTS", context)
    if path is not None:
        learned.write(path)
    return replace(settings, cleaning=replace(settings.cleaning, learned=learned)), path and str(path)


def _answers(algorithm, parameters, context):
    """Polygons that were answered."""
    import numpy as np

    from ...urbanmap_qgis.aerial.markings.answered_markings import MarkingAnswers

    table = algorithm.read_vector(parameters, "LABELS", context)
    if "paint" not in table.columns:
        raise InputError(tr("{0}: the field paint is missing, which tells what is paint.").format(
            algorithm.label_of("LABELS")))
    words = ["" if value is None else str(value).strip().lower() for value in table.columns["paint"]]
    strange = sorted({word for word in words if word and word not in (*YES, *NO)})
    if strange:
        raise InputError(tr("{0}: “{1}” in the field paint is no answer; write true or false, 1 or 0, yes or "
                            "no.").format(algorithm.label_of("LABELS"), strange[0]))
    answered = [k for k, word in enumerate(words) if word and table.geometries[k] is not None]
    return MarkingAnswers(np.array([table.geometries[k] for k in answered], object),
                          np.array([words[k] in YES for k in answered], bool))


def write_doubtful(algorithm, parameters, context, found, crs):
    """The layer of what is to be answered, the most area in doubt first."""
    import numpy as np

    from ...urbanmap_qgis.aerial.markings.answered_markings import doubtful_markings

    if not parameters.get("OUTPUT_DOUBTFUL"):
        return None
    chosen = doubtful_markings(found.confidence, found.area)
    fields = make_fields(("paint", "int"), ("confidence", "real"), ("length", "real"), ("width", "real"),
                         ("colour", "text"))
    columns = {name: getattr(found, name)[chosen] for name in ("confidence", "length", "width", "colour")}
    return algorithm.write_layer(parameters, "OUTPUT_DOUBTFUL", context, fields,
                            {"paint": [None] * len(chosen), **columns}, crs,
                            np.array([found.polygons[int(k)] for k in chosen], object), "Polygon",
                            style="doubtful_markings")
