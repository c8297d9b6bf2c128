"""Whether found road markings can be used: by what was taken and rejected, and by the result itself.

Limits were chosen on six photographs, each as it is and with fifteen faults or lights (`scripts/score_image_kinds.py`),
and tried on seven others.
"""

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

    # Of bright narrow pixels left out by their confidence: from where paint may be among them, and from where nothing
    # can be told; likewise for straight pieces alone, and with both.
    unsure: float = 0.8
    all_unsure: float = 0.96
    straight_unsure: float = 0.98
    lines_unsure: float = 0.68  # of straight pieces: from where lines may be among them
    both_unsure: tuple[float, float] = (0.9, 0.92)
    # Of bright narrow pixels that lie in straight pieces: with fewer those tell nothing.
    straight: float = 0.005
    full: tuple[float, float] = (0.1, 0.4)  # of the image
    empty: float = 0.02  # of the image
    colourless: float = 0.99  # of the image
    # Times the highest number that the image can hold, that new paint would have on its median ground.
    paint_level: float = 1.25
    pale: float = 0.25  # of the image, nearly white
    green: float = 1e-4  # of the image, below which nothing in it is green
    colder: float = 0.25  # of what but for its colour is paint
    spacing: tuple[float, float] = (2.3, 5.0)  # m between neighbouring lines, within which lanes lie
    beside: float = 60.0  # m over which lines have a neighbour, from which their spacing tells
    # m, median width of lines longer than `line` and narrower than `stroke`, weighted by length
    wide: float = 0.38
    line: float = 2.0
    stroke: float = 0.6
    sure: float = 0.61  # confidence that a quarter of the markings exceeds
    contrast: float = 1.53  # times the contrast asked for, that half of the markings exceed
    rough: float = 5.0  # grey values, texture of the road
    short: float = 2.0  # m, length of pieces; dashes, bars of crossings and arrows are longer
    in_short: float = 0.26  # of the found paint, that lies in shorter pieces


LIMITS = VerdictLimits()


@dataclass(frozen=True)
class Verdict:
    """`grade` is GOOD, LOOK or BAD (the result is not to be used); `reasons` are sentences, worst first."""

    grade: str
    reasons: tuple[str, ...]


def marking_verdict(found: MarkingResult, contrast: float) -> Verdict:
    """Verdict on markings found with a contrast asked for, grey values."""
    evidence = found.evidence or SearchTally()
    lost = [*_lost(evidence), *_nothing(found)]
    look = [*_light(evidence), *_light_ground(found, evidence), *_rejected(evidence, bool(lost)),
            *_result(found, contrast)]
    return Verdict(BAD if lost else LOOK if look else GOOD, (*lost, *look))


def _share(part: float, whole: float) -> float:
    return part / whole if whole else 0.0


def _shares_unsure(evidence: SearchTally) -> tuple[float, float]:
    """Share left out by confidence of what is bright and narrow, and of its straight pieces (0 where these are few)."""
    few = evidence.straight < LIMITS.straight * evidence.narrow
    return (_share(evidence.unsure, evidence.narrow),
            0.0 if few else _share(evidence.straight_unsure, evidence.straight))


def _lost(evidence: SearchTally) -> list[str]:
    """Why markings cannot be told in the image."""
    reasons = []
    unsure, straight = _shares_unsure(evidence)
    if (unsure > LIMITS.all_unsure or straight > LIMITS.straight_unsure
            or (unsure > LIMITS.both_unsure[0] and straight > LIMITS.both_unsure[1])):
        reasons.append(say("Markings cannot be told in this image: {share:.0%} of what is bright and narrow was left "
                           "out, because the ground beside it is not smooth and grey as a road is. Do not use the "
                           "result. Check the pixel size, the order of the colours, light, noise and focus; or give "
                           "roads.", share=unsure))
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
    colder = _share(evidence.colder, evidence.colder + evidence.painted)
    if colder > LIMITS.colder:
        reasons.append(say("{colder:.0%} of what looks like paint is bluer than the road beside it and was left out: "
                           "the order of the colours may be wrong (blue for red), or the image has a warm cast.",
                           colder=colder))
    return reasons


def _light_ground(found: MarkingResult, evidence: SearchTally) -> list[str]:
    """Whether the ground, or much of it, is so light that paint cannot stand out from it as it does from asphalt."""
    if found.paint_level is None or found.paint_level <= LIMITS.paint_level:
        pale = _share(evidence.pale, evidence.seen)
        return [say("{pale:.0%} of the image are nearly white: snow, or light roofs and ground. Paint on ground so "
                    "light is missed.", pale=pale)] if pale > LIMITS.pale else []
    return [say("Half of the image is so light that paint can hardly be lighter than it: snow, concrete or too much "
                "light. Paint on such ground is missed.")]


def _rejected(evidence: SearchTally, lost: bool) -> list[str]:
    unsure, straight = _shares_unsure(evidence)
    if lost:
        return []
    if unsure > LIMITS.unsure:
        return [say("{unsure:.0%} of what is bright and narrow was left out, because the ground beside it is not "
                    "smooth and grey as a road is: look for paint without an outline, or give roads.", unsure=unsure)]
    if straight > LIMITS.lines_unsure:
        return [say("{straight:.0%} of what is straight, bright and narrow was left out: look for lines without an "
                    "outline; the order of the colours may be wrong, or roads be few.", straight=straight)]
    return []


def _result(found: MarkingResult, contrast: float) -> list[str]:
    """What is doubtful about the markings themselves."""
    reasons, marks = [], found.polygons
    if not len(marks):
        return reasons
    line = (marks.length > LIMITS.line) & (marks.width < LIMITS.stroke)
    width = _weighted_median(marks.width[line], marks.length[line])
    if width > LIMITS.wide:
        reasons.append(say("Lines are {width:.2f} m wide (median): lane lines have 0.1 to 0.3 m. The pixel size may be "
                           "wrong, or the image out of focus.", width=width))
    reasons += _spacing(found)
    cleaned = np.isfinite(marks.confidence).all()
    sure = float(np.percentile(marks.confidence, 75)) if cleaned else 1.0
    if sure < LIMITS.sure:
        reasons.append(say("Few markings are sure: three quarters have a confidence below {sure:.2f}. Look at them "
                           "over the image.", sure=sure))
    if np.median(marks.contrast) < LIMITS.contrast * contrast:
        reasons.append(say("Half of the markings hardly stand out from the ground: worn paint, joints of paving, or "
                           "an image that is dim or out of focus."))
    short = _share(float(marks.area[marks.length < LIMITS.short].sum()), float(marks.area.sum()))
    if cleaned and short > LIMITS.in_short:  # a plain threshold leaves specks in every image
        reasons.append(say("{share:.0%} of the found paint lies in pieces shorter than {length:g} m, as rims, joints "
                           "and specks of light do: much of it may be no paint. Look at it over the image, answer "
                           "what is doubtful, or give roads.", share=short, length=LIMITS.short))
    if found.road is not None and found.road.texture > LIMITS.rough:
        reasons.append(say("Smooth ground has a texture of {texture:.1f} grey values in this image, as noise or "
                           "sharpening make it: more paint is missed, and more else found.",
                           texture=found.road.texture))
    return reasons


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
