"""Whether found road markings can be used: by how much of them is paint, as their confidence says, and by the image."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...io.pages.report import BAD, GOOD, LOOK
from ...wording import say
from .marking_evidence import SearchTally
from .marking_files import MarkingResult
from .signs.lane_spacing import lane_spacing


@dataclass(frozen=True)
class VerdictLimits:
    """Limits of the verdict, each with its unit; shares are 0 to 1."""

    # Of what was found, by its confidence, that is paint, and of the paint that was found: below these it is to be
    # looked at, below the last not to be used.
    precision: float = 0.7
    recall: float = 0.5
    lost: float = 0.15
    full: tuple[float, float] = (0.1, 0.4)  # of the image
    empty: float = 0.02  # of the image
    colourless: float = 0.99  # of the image
    # Times the highest number that the image can hold, that new paint would have on its median ground.
    paint_level: float = 1.25
    pale: float = 0.25  # of the image, nearly white
    green: float = 1e-4  # of the image, below which nothing in it is green
    spacing: tuple[float, float] = (2.3, 5.0)  # m between neighbouring lines, within which lanes lie
    beside: float = 60.0  # m over which lines have a neighbour, from which their spacing tells
    # m, median width of lines longer than `line` and narrower than `stroke`, weighted by length
    wide: float = 0.38
    line: float = 2.0
    stroke: float = 0.6


LIMITS = VerdictLimits()


@dataclass(frozen=True)
class Verdict:
    """`grade` is GOOD, LOOK or BAD (the result is not to be used); `reasons` are sentences, worst first."""

    grade: str
    reasons: tuple[str, ...]


def marking_verdict(found: MarkingResult) -> Verdict:
    """Verdict on found markings."""
    evidence = found.evidence or SearchTally()
    lost = [*_lost(evidence), *_nothing(found)]
    look = [*_light(evidence), *_light_ground(found, evidence), *_by_confidence(evidence), *_result(found)]
    return Verdict(BAD if lost else LOOK if look else GOOD, (*lost, *look))


def _share(part: float, whole: float) -> float:
    return part / whole if whole else 0.0


def _lost(evidence: SearchTally) -> list[str]:
    """Why markings cannot be told in the image."""
    reasons, recall = [], evidence.recall
    if recall is not None and recall < LIMITS.lost:
        reasons.append(say("Markings cannot be told in this image: by its confidence only {recall:.0%} of the paint "
                           "was found. Do not use the result. Check the pixel size, light, noise and focus; or give "
                           "roads.", recall=recall))
    full = _share(evidence.full, evidence.seen)
    if full > LIMITS.full[1]:
        reasons.append(say("Markings cannot be told in this image: {full:.0%} of it are over-exposed. Do not use the "
                           "result.", full=full))
    return reasons


def _nothing(found: MarkingResult) -> list[str]:
    if len(found.polygons):
        return []
    return [say("No marking was found: check the roads, the contrast and whether the image shows any.")]


def _light(evidence: SearchTally) -> list[str]:
    """What is doubtful about the light and the colours."""
    reasons = []
    full, empty = _share(evidence.full, evidence.seen), _share(evidence.empty, evidence.seen)
    if LIMITS.full[0] < full <= LIMITS.full[1]:
        reasons.append(say("{full:.0%} of the image are over-exposed: paint on light ground is missed there.",
                           full=full))
    if empty > LIMITS.empty:
        reasons.append(say("{empty:.0%} of the image are black without being marked as no data: state the no-data "
                           "value, so that they do not count as ground.", empty=empty))
    if evidence.seen and evidence.colourless > LIMITS.colourless * evidence.seen:
        reasons.append(say("The image has no colours: earth, roofs and dry grass cannot be told from roads by their "
                           "colour, and more of them is taken for paint. Give roads."))
    elif evidence.seen and evidence.green < LIMITS.green * evidence.seen:
        reasons.append(say("Nothing in the image is green: it shows no plants, or infrared as a colour. Then leaves "
                           "and earth cannot be told from roads by their colour; look for finds in them."))
    return reasons


def _light_ground(found: MarkingResult, evidence: SearchTally) -> list[str]:
    """Whether the ground, or much of it, is so light that paint cannot stand out from it as it does from asphalt."""
    if found.paint_level is None or found.paint_level <= LIMITS.paint_level:
        pale = _share(evidence.pale, evidence.seen)
        return [say("{pale:.0%} of the image are nearly white: snow, or light roofs and ground. Paint on ground so "
                    "light is missed.", pale=pale)] if pale > LIMITS.pale else []
    return [say("Half of the image is so light that paint can hardly be lighter than it: snow, concrete or too much "
                "light. Paint on such ground is missed.")]


def _by_confidence(evidence: SearchTally) -> list[str]:
    """What the confidence says of the result as a whole."""
    reasons, precision, recall = [], evidence.precision, evidence.recall
    if precision is not None and precision < LIMITS.precision:
        reasons.append(say("By its confidence {precision:.0%} of the found area is paint: look at what is doubtful, "
                           "raise the minimum confidence, or give roads.", precision=precision))
    if recall is not None and LIMITS.lost <= recall < LIMITS.recall:
        reasons.append(say("By its confidence {recall:.0%} of the paint was found: look for paint without an outline, "
                           "lower the minimum confidence, or give roads.", recall=recall))
    return reasons


def _result(found: MarkingResult) -> list[str]:
    """What is doubtful about the markings themselves."""
    reasons, marks = [], found.polygons
    if not len(marks):
        return reasons
    line = (marks.length > LIMITS.line) & (marks.width < LIMITS.stroke)
    width = _weighted_median(marks.width[line], marks.length[line])
    if width > LIMITS.wide:
        reasons.append(say("Lines are {width:.2f} m wide (median): lane lines have 0.1 to 0.3 m. The pixel size may be "
                           "wrong, or the image out of focus.", width=width))
    return reasons + _spacing(found)


def _spacing(found: MarkingResult) -> list[str]:
    """Whether lanes are as wide as lanes are."""
    marks = found.polygons
    lanes = lane_spacing(marks.polygons, marks.area, marks.length, marks.width)
    if lanes.length < LIMITS.beside or LIMITS.spacing[0] <= lanes.spacing <= LIMITS.spacing[1]:
        return []
    return [say("Neighbouring lines lie {spacing:.1f} m apart (median): lanes are 2.5 to 4 m wide. The pixel size may "
                "be wrong.", spacing=lanes.spacing)]


def _weighted_median(values: np.ndarray, weights: np.ndarray) -> float:
    """Median of values (n,) by weights; 0 of none."""
    if not len(values):
        return 0.0
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(total, total[-1] / 2)])
