"""Whether a trajectory is that of the points: by their times, the distance from it, and its height above the ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..errors import InputError
from ..io.points.pointcloud import PointCloud
from ..mobile.gps_time import sampled_span
from ..mobile.survey_checks import Box
from ..mobile.trajectory import Trajectory, interpolate
from ..progress import Progress
from ..wording import say
from .facade_points import FacadePoints
from .laser_beams import LaserBeams

FARTHEST = 1000.0
"""No scanner on a vehicle measures farther, m."""

SAMPLES = 500
"""Places of the trajectory that are compared with the corners of the cloud."""

LIFTED = (-10.0, 25.0)
"""Between these heights (m) above the ground beside buildings roads lie, elevated ones too."""


@dataclass(frozen=True)
class BeamFacts:
    """What the lines of sight round one building say of the trajectory.

    Attributes
    ----------
    places, known : number of places measured there, and of those at whose time there is a pose.
    distance : median from the scanner, m; NaN without lines.
    height : median of the scanner above the ground round the building, m; NaN where either is not known.
    """

    places: int
    known: int
    distance: float
    height: float

    @classmethod
    def of(cls, lines: LaserBeams, points: FacadePoints) -> BeamFacts:
        """That of a building with its points."""
        if not len(lines):
            return cls(len(points.front), 0, float("nan"), float("nan"))
        distance = np.linalg.norm(lines.target - lines.origin, axis=1)
        return cls(len(points.front), len(lines), float(np.median(distance)),
                   float(np.median(points.height(lines.origin))))


def check_start(cloud: PointCloud, trajectory: Trajectory) -> None:
    """Refuse a trajectory of another time or place by samples of the times and the headers, before a cloud is read.

    Raises
    ------
    InputError : it ends before the points were measured or begins after, it lies far from all of them, or the points
        have no times.
    """
    spans = [sampled_span(replace(cloud, paths=(path,), headers=(header,)))
             for path, header in zip(cloud.paths, cloud.headers) if header.point_count]
    first, last = max(trajectory.time[0], min(spans)[0]), min(trajectory.time[-1], max(end for _, end in spans))
    if not any(start <= trajectory.time[-1] and end >= trajectory.time[0] for start, end in spans):
        raise InputError(say("The trajectory runs from {first:.0f} to {last:.0f} s, but the points were measured from "
                             "{start:.0f} to {end:.0f} s: give the trajectory of this survey, in the time of its "
                             "points.", first=trajectory.time[0], last=trajectory.time[-1], start=min(spans)[0],
                             end=max(end for _, end in spans)))
    place = interpolate(trajectory, np.linspace(first, last, SAMPLES)).place
    corners = Box(*(float(value) for value in (*cloud.minimum[:2], *cloud.maximum[:2])))
    _refuse_far(float(corners.distance(*place[:, :2].T).min()))


def _refuse_far(distance: float) -> None:
    """Refuse a trajectory farther from what was measured at its times, m, than any scanner measures."""
    if distance > FARTHEST:
        raise InputError(say("The trajectory lies {distance:.0f} m from what was measured at its times: check that it "
                             "is in the coordinate reference system of the points.", distance=distance))


def check_beams(facts: Sequence[BeamFacts], trajectory: Trajectory, progress: Progress) -> None:
    """Refuse a trajectory that cannot be the one along which the points were measured; tell what looks wrong.

    Raises
    ------
    InputError : no point was measured at its times, or it lies far from what was measured then.
    """
    seen = [one for one in facts if one.known]
    if not seen:
        raise InputError(say("The trajectory runs from {first:.0f} to {last:.0f} s, but no point near a building was "
                             "measured then: give the trajectory of this survey, in the time of its points.",
                             first=trajectory.time[0], last=trajectory.time[-1]))
    _refuse_far(float(np.median([one.distance for one in seen])))
    heights = np.array([one.height for one in seen])
    heights = heights[np.isfinite(heights)]
    if len(heights) and not LIFTED[0] <= np.median(heights) <= LIFTED[1]:
        progress.warn(say("The trajectory lies {height:.0f} m above the ground beside the buildings: check its heights "
                          "(give GEOID where they are ellipsoidal); what hides walls is wrong else.",
                          height=np.median(heights)))
    dark = sum(one.known < one.places for one in facts)
    if dark:
        progress.warn(say("Round {count} buildings some points were measured when no trajectory tells a pose: what "
                          "hides their walls may be counted as unseen.", count=dark))
