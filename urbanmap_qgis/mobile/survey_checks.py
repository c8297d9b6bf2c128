"""Whether points, trajectory and reference are of one place and time: asked before any work is done on them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ..errors import InputError
from ..geometry.tolerances import ROUNDING
from ..io.points.coordinate_steps import sampled_points
from ..io.points.pointcloud import PointCloud
from ..io.raster import RasterSampler
from ..progress import SILENT, Progress, notice
from ..wording import known, mark, say
from .gps_time import sampled_span, time_shift
from .registration.start.reference import Reference
from .trajectory import Trajectory, interpolate

MEASURED = 200.0
"""m: no scanner of a survey vehicle is used farther out."""

SEEN_BESIDE = 25.0  # m to either side of the path within which markings are taken.
MOST = 0.9  # of the path; less is told
SAMPLES = 500
OVER_GROUND = 15.0  # m; no body of a vehicle is higher
CLOCKS = 60.0  # s; clocks that differ by up to this are looked for
ALIKE = 1.5  # s; a difference is known no better, as scanners look forward or back
KNOWN = 0.25  # of the samples
NEARER = 1.25  # times; as much nearer to the path points must lie at other times to be told
SURELY = 2.0  # times; then a usual difference of clocks is refused
# m by which a body is never above all points, or below them
ABOVE = 30.0
BELOW = 5.0

_CLOCKS = {mark("UTC against GPS time, 18 s since 2017 and 17 s before"): (17.0, 18.0),
           mark("UTC against TAI, 37 s since 2017 and 36 s before"): (36.0, 37.0)}
_UNITS = {"millimetres": 1e-3, "centimetres": 1e-2, "feet": 0.3048, "kilometres": 1e3}


@dataclass(frozen=True)
class Box:
    """x_min, y_min, x_max, y_max, m."""

    x_min: float
    y_min: float
    x_max: float
    y_max: float

    def distance(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Distance (n,), m, of places from the box; 0 inside."""
        return np.hypot(np.maximum(np.maximum(self.x_min - x, x - self.x_max), 0.0),
                        np.maximum(np.maximum(self.y_min - y, y - self.y_max), 0.0))


def require_survey(cloud: PointCloud, trajectory: Trajectory) -> None:
    """Refuse a cloud that was not measured along a trajectory, by its times, the corners of its headers and samples.

    Raises
    ------
    InputError : the times do not overlap, or the points lie elsewhere or at other heights.
    """
    span = sampled_span(cloud)
    shift = time_shift(cloud, trajectory)
    time = np.linspace(span[0] + shift, span[1] + shift, SAMPLES)
    place = interpolate(trajectory, time, "hold").place
    name, low, high = cloud.paths[0].name, cloud.minimum, cloud.maximum
    away = _box(low, high).distance(place[:, 0], place[:, 1]).min()
    if away > MEASURED:
        raise InputError(say("{name} lies {length} from where the vehicle was at its times: {reason}.", name=name,
                             length=_length(away), reason=_reason(_box(low, high), place)))
    above, below = place[:, 2].min() - high[2], low[2] - place[:, 2].max()
    if above > ABOVE or below > BELOW:
        raise InputError(say("All points of {name} lie more than {above:.0f} m {value} the trajectory: heights above "
                             "the ellipsoid and above sea level cannot be mixed; convert one of them (a geoid model "
                             "can be given for SBET).", name=name, above=max(above, below),
                             value=say("below") if above > below else say("above")))
    _require_clock(cloud, trajectory, shift)


def _require_clock(cloud: PointCloud, trajectory: Trajectory, shift: float) -> None:
    """Tell of samples that lie nearer to where the vehicle was some seconds before or after; refuse UTC and TAI."""
    time, place = sampled_points(cloud)
    most = np.floor(min(CLOCKS, 0.5 * np.ptp(time))) if len(time) else 0.0  # in less time all is near
    later = np.arange(-most, most + 1.0)
    now = len(later) // 2
    away, along = _places_later(time, place, trajectory, shift, later) if most else np.full((2, 1), np.nan)
    if not np.isfinite(away[now]):
        return
    best = int(np.nanargmin(away))
    seconds, ratio = float(later[best]), away[now] / max(away[best], ROUNDING)
    # A scanner that looks ahead or back does so by the same length at any speed, a wrong clock does not.
    if abs(seconds) <= ALIKE or ratio < NEARER or along[best] > NEARER * along[now]:
        return
    named = [known(clocks) for clocks, (low, high) in _CLOCKS.items()
             if low - ALIKE <= abs(seconds) <= high + ALIKE]
    text = say("The points of {name} lie {now:.0f} m (median) from where the vehicle was at their times, but "
               "{near:.0f} m from where it was about {seconds:.0f} s {value}: their clocks seem to differ{clocks}.",
               name=cloud.paths[0].name, now=away[now], near=away[best], seconds=abs(seconds),
               value=say("later") if seconds > 0 else say("earlier"), clocks=f" ({named[0]})" if named else "")
    if named and ratio >= SURELY:
        raise InputError(text)
    notice(text)


def _places_later(time: np.ndarray, place: np.ndarray, trajectory: Trajectory, shift: float,
                  later: np.ndarray) -> np.ndarray:
    """(2, k) m, of points (n,), (n, 2) seen from where the vehicle was `later` (k,) seconds after their times: median
    distance in plan, and the range of the middle half of their places along its course; NaN where it is known for less
    than a quarter of them."""
    found = np.full((2, len(later)), np.nan)
    course = np.gradient(trajectory.place[:, :2], trajectory.time, axis=0)
    for k, seconds in enumerate(later):
        at = time + shift + seconds
        known_at = trajectory.within(at)
        if known_at.mean() >= KNOWN:
            x, y, east, north = (np.interp(at[known_at], trajectory.time, axis)
                                 for axis in (*trajectory.place[:, :2].T, *course.T))
            x, y = place[known_at].T - [x, y]
            along = (x * east + y * north) / np.maximum(np.hypot(east, north), ROUNDING)
            found[:, k] = np.median(np.hypot(x, y)), np.subtract(*np.quantile(along, [0.75, 0.25]))
    return found


def _reason(box: Box, place: np.ndarray) -> str:
    """Why places (n, 3) of a trajectory may lie far from the box of its points, and what to do."""
    x, y = place[:, :2].T
    if box.distance(y, x).min() <= MEASURED:
        return say("x and y are swapped in one of them: swap them")
    for unit, metres in _UNITS.items():
        if box.distance(metres * x, metres * y).min() <= MEASURED:
            return say("the trajectory is in {unit}; give it in metres", unit=unit)
    if np.abs(x).max() <= 360.0 and np.abs(y).max() <= 360.0 and np.ptp(x) + np.ptp(y) < 1.0:
        return say("the trajectory looks like latitudes and longitudes in degrees; give it in the points' projected "
                   "system")
    return say("give both of one survey, in one coordinate reference system")


def require_reference(trajectory: Trajectory, span: tuple[float, float] | None, reference: Reference,
                      progress: Progress = SILENT) -> None:
    """Refuse reference markings or ground of another place or height system; warn where they cover a part of the path.

    Parameters
    ----------
    span : s, times in which the survey was measured; None for the whole trajectory.

    Raises
    ------
    InputError : no part of the path lies in them, or the vehicle is far above or below the ground.
    """
    first, last = span or (trajectory.time[0], trajectory.time[-1])
    time = np.linspace(max(first, trajectory.time[0]), min(last, trajectory.time[-1]), SAMPLES)
    x, y, z = interpolate(trajectory, time, "hold").place.T
    boxes = [(say("The reference markings"), _markings_box(reference), SEEN_BESIDE)]
    if reference.ground is not None:
        boxes.append((say("The ground elevation"), _raster_box(reference.ground), 0.0))
    for what, box, beside in boxes:
        away = box.distance(x, y)
        share = float(np.mean(away <= beside))
        if share == 0.0:
            reach = "lie" if what.endswith("s") else "lies"
            raise InputError(say("{what} {reach} {length} from the path of the survey: give those of the same place.",
                                 what=what, reach=reach, length=_length(float(away.min()))))
        if share < MOST:
            progress.warn(say("{what} cover{value} {share:.0f} % of the path only: the rest cannot be registered.",
                              what=what, value="" if what.endswith("s") else "s", share=100 * share))
    if reference.ground is not None:
        height = z - reference.heights(x, y)
        middle = float(np.median(height[np.isfinite(height)])) if np.isfinite(height).any() else 0.0
        if not -BELOW <= middle <= OVER_GROUND:
            raise InputError(say("The vehicle is {middle:.0f} m {value} the ground elevation: heights above the "
                                 "ellipsoid and above sea level cannot be mixed, convert one of the two (a geoid "
                                 "model can be given for SBET).", middle=abs(middle),
                                 value=say("below") if middle < 0 else say("above")))


def survey_span(cloud: PointCloud, trajectory: Trajectory) -> tuple[float, float]:
    """Times, s, in the trajectory's count, in which a cloud was measured."""
    span = sampled_span(cloud)
    shift = time_shift(cloud, trajectory)
    return span[0] + shift, span[1] + shift


def _box(low: np.ndarray, high: np.ndarray) -> Box:
    return Box(float(low[0]), float(low[1]), float(high[0]), float(high[1]))


def _markings_box(reference: Reference) -> Box:
    if reference.polygons is not None:
        return Box(*(float(value) for value in shapely.total_bounds(reference.polygons)))
    return _raster_box(reference.mask)


def _raster_box(path: str) -> Box:
    with RasterSampler(path) as source:
        return Box(*(float(value) for value in source.grid.bounds))


def _length(metres: float) -> str:
    return f"{metres:.0f} m" if metres < 2000 else f"{metres / 1000:.0f} km"
