"""How the survey vehicle truly drives: its path through the crossing, its speed, and how its body leans and shakes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.ndimage import gaussian_filter1d

from ..faults import LONG_STOP
from ..scene.model import Lane, Marking
from ..scene.world import Scene
from .trajectory import SimulatedTrajectory

RATE = 100.0  # Epochs per second.
BODY_HEIGHT = 1.95  # Of the body's origin above the road, m.
# Distances of the wheels along and across, m.
WHEELBASE = 2.7
TRACK = 1.55
# Maximum acceleration and braking, m/s2; speed in a bend, m/s.
ACCELERATION = 1.8
BEND_SPEED = 4.4
# A bend starts this far before the corner, m; the speed falls this far around it already.
BEND_START = 14.0
BEND_WIDENING = 2.0
STOP_GAP = 3.0  # The body's origin stands this far behind a stop line, m.
# The body leans out of a bend and backwards when it speeds up, degrees for each m/s2.
LEAN_ROLL = 0.45
LEAN_PITCH = 0.30
# Vibration at 8 m/s (standard deviations): m, degrees.
SHAKE_HEIGHT = 0.002
SHAKE_ANGLE = 0.04
STEP = 0.05

RUN_IN = 10.0
"""The drive begins and ends this far outside the city's square, m."""


@dataclass(frozen=True)
class DrivePath:
    """A path in plan, every `STEP` m: s (n,), x, y (n,), heading (n,) degrees, curvature (n,) to the right 1/m.

    `corner` is the chainage at which the two straight lanes would meet.
    """

    s: np.ndarray
    x: np.ndarray
    y: np.ndarray
    heading: np.ndarray
    curvature: np.ndarray
    corner: float


@dataclass(frozen=True)
class Stop:
    """A stop of `seconds` at the chainage `s`, m."""

    s: float
    seconds: float


def survey_lanes(scene: Scene) -> tuple[tuple[Lane, Lane], tuple[Lane, Lane]]:
    """The lanes of two drives in opposite directions: along A and left into B; down B and right into A."""
    lanes = [lane for lane in scene.lanes if lane.survey]
    along = [lane for lane in lanes if lane.street == "A"]
    across = [lane for lane in lanes if lane.street == "B"]
    first, back = along[0], along[1]
    left = min(across, key=lambda lane: abs((lane.heading - first.heading) % 360.0 - 270.0))
    return (first, left), (next(lane for lane in across if lane is not left), back)


def corner_path(first: Lane, second: Lane, distance: float) -> DrivePath:
    """Along `first`, round the corner and along `second`, starting and ending `distance` m from the corner.

    The curvature of the bend rises and falls as 1 - cos, so that there is no jerk.
    """
    corner = _crossing(first, second)
    angle_change = np.radians((second.heading - first.heading + 180.0) % 360.0 - 180.0)
    share = np.linspace(0.0, 1.0, 2001)
    angle = angle_change * (share - np.sin(2 * np.pi * share) / (2 * np.pi))
    tangent = _integral(np.sin(angle), share)[-1] / np.sin(angle_change)
    length = BEND_START / tangent
    straight = distance - BEND_START
    s = np.arange(0.0, 2 * straight + length + STEP / 2, STEP)
    share = np.clip((s - straight) / length, 0.0, 1.0)
    heading = np.radians(first.heading) + angle_change * (share - np.sin(2 * np.pi * share) / (2 * np.pi))
    x0, y0 = corner - distance * _direction(first)
    return DrivePath(s, x0 + _integral(np.sin(heading), s), y0 + _integral(np.cos(heading), s), np.degrees(heading),
                     angle_change / length * (1 - np.cos(2 * np.pi * share)), straight + length / 2)


def with_meander(path: DrivePath, metres: float, phase: float) -> DrivePath:
    """The path with a driver who does not hold the lane's middle exactly."""
    wave = 2 * np.pi / 43.0
    off, slope = metres * np.sin(wave * path.s + phase), metres * wave * np.cos(wave * path.s + phase)
    sin, cos = np.sin(np.radians(path.heading)), np.cos(np.radians(path.heading))
    return DrivePath(path.s, path.x + off * cos, path.y - off * sin, path.heading + np.degrees(np.arctan(slope)),
                     path.curvature, path.corner)


def stop_at_line(path: DrivePath, markings: Sequence[Marking], default: float) -> float:
    """Chainage at which the vehicle stands behind the last stop line that it crosses before the corner."""
    before = path.s < path.corner
    line = shapely.LineString(np.column_stack([path.x, path.y])[before])
    lines = [line.intersection(m.plan) for m in markings if m.kind == "stop" and m.plan.intersects(line)]
    reached = [line.project(shapely.Point(crossing.coords[0])) for crossing in lines if not crossing.is_empty]
    return max(max(reached) - STOP_GAP if reached else default, 0.0)


def chainage_over_time(path: DrivePath, cruise: float, stops: Sequence[Stop]) -> np.ndarray:
    """Chainage (n,) at epochs of `RATE`: smoothly at `cruise` m/s, slower in bends; on the move at both ends."""
    speed = np.full(len(path.s), cruise)
    widening = int(BEND_WIDENING / STEP)
    in_bend = np.convolve(np.abs(path.curvature) > 0.02, np.ones(2 * widening + 1), "same") > 0
    speed[in_bend] = np.minimum(cruise, BEND_SPEED)
    number = [round(stop.s / STEP) for stop in stops]
    speed[number] = 0.0
    square = speed**2
    for order in (slice(None), slice(None, None, -1)):
        ramp = 2 * ACCELERATION * path.s
        square[order] = np.minimum.accumulate(square[order] - ramp) + ramp
    speed = np.sqrt(np.maximum(square, 0.0))
    ticks = np.concatenate([[0.0], np.cumsum(2 * np.diff(path.s) / (speed[1:] + speed[:-1]))])
    chainages = path.s
    for stop, index in sorted(zip(stops, number), key=lambda pair: -pair[1]):
        ticks = np.concatenate([ticks[:index + 1], ticks[index:] + stop.seconds])
        chainages = np.concatenate([chainages[:index + 1], chainages[index:]])
    smoothing = 0.35 * RATE
    ends = int(4 * smoothing)
    chainage = np.interp(np.arange(int(ticks[-1] * RATE) + 1) / RATE, ticks, chainages)
    # Near its ends the smoothing knows one side only.
    return gaussian_filter1d(chainage, smoothing, mode="nearest")[ends:-ends]


def drive(scene: Scene, path: DrivePath, chainage: np.ndarray, start: float,
          rng: np.random.Generator) -> SimulatedTrajectory:
    """True trajectory of a vehicle at the chainages (m) of the path at epochs from `start` s on."""
    heading = np.interp(chainage, path.s, path.heading)
    x, y = np.interp(chainage, path.s, path.x), np.interp(chainage, path.s, path.y)
    speed = np.gradient(chainage) * RATE
    height, roll, pitch = _on_wheels(scene.ground_height, x, y, heading)
    lateral_acceleration = speed**2 * np.interp(chainage, path.s, path.curvature)
    roll = roll - LEAN_ROLL * lateral_acceleration
    pitch = pitch + LEAN_PITCH * gaussian_filter1d(np.gradient(speed) * RATE, 0.15 * RATE)
    liveliness = np.minimum(speed / 8.0, 1.0)
    z = height + BODY_HEIGHT + liveliness * SHAKE_HEIGHT * _shake(len(chainage), rng)
    roll, pitch, heading = (angle + liveliness * size * _shake(len(chainage), rng) for angle, size in (
        (roll, SHAKE_ANGLE), (pitch, SHAKE_ANGLE), (heading, 0.3 * SHAKE_ANGLE)))
    time = start + np.arange(len(chainage)) / RATE
    return SimulatedTrajectory(time, np.column_stack([x, y, z]), np.column_stack([roll, pitch, heading])).rounded()


def survey_drive(scene: Scene, number: int, start: float, rng: np.random.Generator) -> SimulatedTrajectory:
    """True trajectory of one of the two surveys (0 or 1), which starts at `start` s."""
    distance = scene.size / 2 + RUN_IN
    path = with_meander(corner_path(*survey_lanes(scene)[number], distance), 0.12, rng.uniform(0, 2 * np.pi))
    stops = [Stop(stop_at_line(path, scene.markings, path.corner - 20.0), rng.uniform(7.0, 10.0))]
    queue = path.corner + 30.0 + rng.uniform(0.0, 15.0)
    if queue < path.s[-1] - 20.0:
        stops.append(Stop(queue, rng.uniform(3.0, 5.0)))
    if "stops" in scene.faults:
        stops.append(Stop(0.35 * path.corner, LONG_STOP))
    return drive(scene, path, chainage_over_time(path, rng.uniform(7.6, 8.6), stops), start, rng)


def _on_wheels(ground: Callable, x: np.ndarray, y: np.ndarray, heading: np.ndarray) -> tuple[np.ndarray, ...]:
    """Height under the vehicle (m) and roll and pitch (degrees) of its four wheels' plane, softened by springs."""
    sin, cos = np.sin(np.radians(heading)), np.cos(np.radians(heading))
    wheels = {}
    for along in (-1, 1):
        for right in (-1, 1):
            forward, side = along * WHEELBASE / 2, right * TRACK / 2
            wheels[along, right] = ground(x + sin * forward + cos * side, y + cos * forward - sin * side)
    height = sum(wheels.values()) / 4
    rise = (wheels[1, -1] + wheels[1, 1] - wheels[-1, -1] - wheels[-1, 1]) / (2 * WHEELBASE)
    fall = (wheels[1, -1] + wheels[-1, -1] - wheels[1, 1] - wheels[-1, 1]) / (2 * TRACK)
    soft = (gaussian_filter1d(v, 0.15 * RATE) for v in (height, np.degrees(np.arctan(fall)),
                                                       np.degrees(np.arctan(rise))))
    return tuple(soft)


def _shake(count: int, rng: np.random.Generator) -> np.ndarray:
    """Noise of a few hertz with standard deviation 1."""
    sigma = 3.0
    return gaussian_filter1d(rng.standard_normal(count), sigma) * np.sqrt(2 * np.sqrt(np.pi) * sigma)


def _crossing(first: Lane, second: Lane) -> np.ndarray:
    """x, y where the lines of two lanes meet."""
    along = np.column_stack([_direction(first), -_direction(second)])
    distance = np.linalg.solve(along, np.subtract(second.start, first.start))
    return np.array(first.start) + distance[0] * _direction(first)


def _direction(lane: Lane) -> np.ndarray:
    heading = np.radians(lane.heading)
    return np.array([np.sin(heading), np.cos(heading)])


def _integral(values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Running integral by the trapezoid rule, starting with 0."""
    return np.concatenate([[0.0], np.cumsum(np.diff(at) * (values[1:] + values[:-1]) / 2)])
