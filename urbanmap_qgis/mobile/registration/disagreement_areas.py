"""Where reference and survey disagree, as areas: the road between the ends of each stretch, as wide as its markings."""

from __future__ import annotations

import numpy as np
import shapely

from ..trajectory import interpolate, path_chainage
from .registered_survey import RegisteredSurvey

_ABOUT = 20.0  # m of path to either side of a single step: the evidence for it lies there
_LEAST = 3.0  # m, half the width of an area at least
_SHARE = 95.0  # % of the markings that an area is as wide as
_EVERY = 1.0  # m of path between the corners of an area's sides


def area_table(survey: RegisteredSurvey) -> tuple[dict[str, object], np.ndarray]:
    """Columns of the layer of areas in which reference and survey disagree, and their polygons (n,).

    A stretch of changed markings is one area; a single step, of which nobody can say the right side, the road about it.
    """
    length = float(survey.correction.chainage[-1])
    steps = survey.correction.steps
    closing = _closing(survey)
    extents = [(step, step.span or (step.place - _ABOUT, step.place + _ABOUT)) for number, step in enumerate(steps)
               if number not in closing]
    spans = [(max(begin, 0.0), min(end, length)) for _, (begin, end) in extents]
    items = [step for step, _ in extents]
    columns = {"begin": [begin for begin, _ in spans], "end": [end for _, end in spans],
               "kind": [step.kind for step in items], "size": [step.size for step in items],
               "direction": [step.direction for step in items], "sigma": [step.sigma for step in items]}
    areas = [_road(survey, *span) for span in spans]
    return columns, np.array(areas, dtype=object)


def _closing(survey: RegisteredSurvey) -> set[int]:
    """Numbers of steps that are the second edge of a stretch of changed markings."""
    ends = [step.span[1] for step in survey.correction.steps if step.span is not None]
    return {number for number, step in enumerate(survey.correction.steps)
            if step.span is None and any(abs(step.place - end) < 1e-6 for end in ends)}


def _road(survey: RegisteredSurvey, begin: float, end: float) -> shapely.Polygon:
    """The road between two chainages, m, about the corrected path."""
    chainage = path_chainage(survey.reported)
    rising = np.concatenate([[True], np.diff(chainage) > 0])
    along = np.linspace(begin, max(end, begin + _EVERY), max(int((end - begin) / _EVERY), 1) + 1)
    time = np.interp(along, chainage[rising], survey.reported.time[rising])
    path = interpolate(survey.trajectory, time).place[:, :2]
    return shapely.buffer(shapely.LineString(path), _half_width(survey, time[0], time[-1]), cap_style="flat")


def _half_width(survey: RegisteredSurvey, first: float, last: float) -> float:
    """m to either side of the path within which most of the markings lie that were measured between two times, s."""
    some = survey.markings.select((survey.markings.time >= first) & (survey.markings.time <= last))
    if not len(some):
        return _LEAST
    body = interpolate(survey.reported, some.time)
    heading = np.radians(body.angles[:, 2])
    aside = (some.x - body.place[:, 0]) * np.cos(heading) - (some.y - body.place[:, 1]) * np.sin(heading)
    return max(float(np.percentile(np.abs(aside), _SHARE)), _LEAST)
