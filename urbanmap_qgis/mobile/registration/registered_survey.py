"""What the registration gives: the corrected trajectory with all that it rests on, its open sections and its tables."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...progress import Progress
from ...wording import say
from ..markings.records import MarkingPoints
from ..trajectory import Trajectory
from .correction.patch_corrections import Correction
from .correction.patch_status import BRIDGED, DISTRUSTED, REGISTERED, STATUS_NAMES
from .records import WindowResults

_SHORTEST = 1.0  # m: shorter sections are joined to what is around them when they are listed


@dataclass(frozen=True)
class RegisteredSurvey:
    """What came out.

    Attributes
    ----------
    trajectory : corrected, with the reported one's epochs.
    reported : the trajectory as it was given.
    markings : the marking points used, as reported.
    windows : result of each patch's window.
    correction : the smooth one.
    """

    trajectory: Trajectory
    reported: Trajectory
    markings: MarkingPoints
    windows: WindowResults
    correction: Correction

    def share(self, status: int) -> float:
        """Share of the patches with a status, 0 to 1."""
        return float(np.mean(self.correction.status == status))

    def plan_accuracy(self) -> tuple[float, float]:
        """Median and maximum of the standard deviation in plan over the whole path, m; NaN where it is not known.

        The one figure that log, report and results tell: of registered, bridged and distrusted patches alike.
        """
        return middle_and_largest(self.correction.plan_sigma())


def middle_and_largest(sigma: np.ndarray) -> tuple[float, float]:
    """Median and maximum of standard deviations (n,), those that are known; NaN where none is."""
    known = sigma[np.isfinite(sigma)]
    return (float(np.median(known)), float(known.max())) if len(known) else (np.nan, np.nan)


@dataclass(frozen=True)
class UnregisteredSection:
    """A part of the path that is not registered throughout.

    Attributes
    ----------
    start, end : chainage, m.
    start_time, end_time : s.
    status, reason : of its patches.
    sigma : largest standard deviation in plan, m.
    """

    start: float
    end: float
    start_time: float
    end_time: float
    status: str
    reason: str
    sigma: float


def unregistered_sections(survey: RegisteredSurvey) -> list[UnregisteredSection]:
    """Parts of the path that are not registered, in the order driven."""
    correction, sigma = survey.correction, survey.correction.plan_sigma()
    half = 0.5 * float(np.median(np.diff(correction.chainage))) if len(correction) > 1 else 0.0
    label = np.where(correction.status == REGISTERED, -1, correction.status)
    code = np.array([f"{number}{reason}" if number >= 0 else "" for number, reason in zip(label, correction.reason)])
    starts = np.flatnonzero(np.r_[True, code[1:] != code[:-1]])
    found = []
    for first, end in zip(starts, np.r_[starts[1:], len(code)]):
        part = slice(first, end)
        if code[first] and correction.chainage[end - 1] - correction.chainage[first] + 2 * half >= _SHORTEST:
            found.append(UnregisteredSection(
                float(correction.chainage[first] - half), float(correction.chainage[end - 1] + half),
                float(correction.time[first]), float(correction.time[end - 1]),
                STATUS_NAMES[correction.status[first]], str(correction.reason[first]),
                float(np.fmax.reduce(sigma[part]))))
    return found


def step_table(survey: RegisteredSurvey) -> tuple[dict[str, object], np.ndarray]:
    """Columns of the layer of steps between reference and survey, and their places on the corrected path (n, 3)."""
    steps = survey.correction.steps
    columns = {"way": [item.place for item in steps], "time": [item.time for item in steps],
               "kind": [item.kind for item in steps], "size": [item.size for item in steps],
               "direction": [item.direction for item in steps], "east": [item.east for item in steps],
               "north": [item.north for item in steps], "sigma": [item.sigma for item in steps]}
    time = np.array(columns["time"], float)
    places = np.column_stack([np.interp(time, survey.trajectory.time, axis) for axis in survey.trajectory.place.T])
    return columns, places


def patch_table(survey: RegisteredSurvey) -> tuple[dict[str, object], np.ndarray]:
    """Columns of the patches' layer, and their corrected places (n, 3)."""
    correction, windows = survey.correction, survey.windows
    sigma = correction.sigma()
    estimated = np.isfinite(sigma)
    value = np.where(estimated, correction.value, np.nan)
    names = ("east", "north", "up", "roll", "pitch", "heading")
    columns: dict[str, object] = {
        "patch": np.arange(len(correction)), "way": correction.chainage, "time": correction.time,
        "status": [STATUS_NAMES[number] for number in correction.status], "reason": list(correction.reason),
        "sigma": correction.plan_sigma(), "correction": np.hypot(value[:, 0], value[:, 1])}
    columns.update({name: value[:, k] for k, name in enumerate(names)})
    columns.update({f"sigma_{name}": sigma[:, k] for k, name in enumerate(names)})
    columns.update({
        "window": windows.window_length, "features": windows.features, "points": windows.points,
        "score": windows.score, "overlap": windows.overlap, "margin": np.where(np.isfinite(windows.margin),
                                                                              windows.margin, np.nan),
        "weight": correction.weight, "residual": np.hypot(correction.residual[:, 0], correction.residual[:, 1])})
    relative = correction.relative_sigma()
    if relative is not None:
        columns["sigma_relative"] = relative
    if correction.walls is not None:
        columns.update({"paint": 1.0 - correction.walls, "walls": correction.walls})
    return columns, windows.place + correction.value[:, :3]


def tell_result(survey: RegisteredSurvey, progress: Progress) -> None:
    """Say what was reached, and warn of what must not be trusted."""
    correction = survey.correction
    middle, _ = survey.plan_accuracy()
    spread = (say("standard deviation in plan over the whole path {sigma:.1f} cm (median)", sigma=100 * middle)
              if np.isfinite(middle) else say("how accurate it is is not known"))
    progress.message(say("{share:.0f} % of the path is registered, {share_2:.0f} % bridged; {spread}.",
                         share=100 * survey.share(REGISTERED), share_2=100 * survey.share(BRIDGED), spread=spread))
    if correction.unseen is not None and np.isfinite(correction.unseen.median):
        progress.message(say("Steps of the reference are told from {median:.2f} m on (median along the path, "
                             "{largest:.2f} m at most); standard deviations hold smaller ones and the {sigma:.1f} cm "
                             "stated for the reference.", median=correction.unseen.median,
                             largest=correction.unseen.largest, sigma=100 * correction.reference_sigma))
    if correction.heading_factor > 1.0:
        progress.warn(say("The reported heading contradicts the markings by {correction:.1f} degrees (median), much "
                          "more than its accuracy: it was corrected; check the calibration and the trajectory.",
                          correction=abs(np.median(correction.value[:, 5]))))
    if correction.steps:
        first = correction.steps[0]
        progress.warn(say("Reference and survey disagree at {count} places, the first at {place:.0f} m by {size:.2f} m "
                          "({kind}): see the steps' layer and the report.", count=len(correction.steps),
                          place=first.place, size=first.size, kind=say(first.kind)))
    if survey.share(DISTRUSTED) > 0:
        spans = [item for item in unregistered_sections(survey) if item.status == STATUS_NAMES[DISTRUSTED]]
    else:
        spans = []
    if spans:  # those shorter than a metre are not listed
        longest = max(spans, key=lambda item: item.end - item.start)
        progress.warn(say("{share:.0f} % of the path is not to be trusted, the longest section from "
                          "{longest_start:.0f} to {end:.0f} m ({reason}): see the patches' layer.",
                          share=100 * survey.share(DISTRUSTED), longest_start=longest.start, end=longest.end,
                          reason=longest.reason))
