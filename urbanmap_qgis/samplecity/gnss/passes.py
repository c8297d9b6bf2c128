"""The drives of the GNSS receiver through the city, at different times of a day."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from ..drive.trajectory import SimulatedTrajectory
from ..scene.model import Lane
from ..scene.world import Scene

WEEK = 2310
"""GPS week of all surveys (April 2024)."""

DAY_START = 345600.0
"""GPS seconds of week at which the day of the drives begins, 9:00 in Japan."""

PASSES, PASS_EVERY = 16, 2900.0
"""Number of drives, and seconds between their starts."""

ANTENNA_HEIGHT = 2.1
"""Of the antenna above the road, m."""

TRAJECTORY_RATE = 5
"""Epochs of the delivered trajectories per second."""

TRAJECTORY_ERROR = (0.04, 0.06)
"""Of the delivered trajectories, plan (each axis) and height: standard deviation, m, over about 20 s."""


@dataclass(frozen=True)
class Pass:
    """A drive. `epochs` (n,) whole GPS seconds of week by the receiver's clock; `truth` the antenna's true poses;
    `reported` the delivered ones."""

    number: int
    epochs: np.ndarray
    truth: SimulatedTrajectory
    reported: SimulatedTrajectory

    @property
    def name(self) -> str:
        return f"pass_{self.number:02d}"


def make_passes(scene: Scene, rng: np.random.Generator) -> list[Pass]:
    """Drives along the survey lanes one after the other, each with a wait in the traffic at a place of its own."""
    lanes = [lane for lane in scene.lanes if lane.survey]
    return [_drive(scene, lanes[number % len(lanes)], number + 1,
                   DAY_START + 600.0 + PASS_EVERY * number + float(rng.integers(0, 600)), rng)
            for number in range(PASSES)]


def _drive(scene: Scene, lane: Lane, number: int, start: float, rng: np.random.Generator) -> Pass:
    seconds = int(rng.integers(70, 91))
    wait = rng.uniform(0.25, 0.4) * seconds
    before, stop = rng.uniform(0.2, 0.8) * (seconds - wait), rng.uniform(0.25, 0.75) * lane.length
    chainage = PchipInterpolator([-5.0, before, before + wait, seconds + 5.0], [-5.0, stop, stop, lane.length + 5.0])
    time = np.arange(-2 * TRAJECTORY_RATE, (seconds + 2) * TRAJECTORY_RATE + 1) / TRAJECTORY_RATE
    along = chainage(time) / lane.length
    across = 0.15 * np.sin(2 * np.pi * (lane.length * along / 60.0 + rng.random()))
    angle = np.radians(lane.heading)
    (x0, y0), (x1, y1) = lane.start, lane.end
    x = x0 + (x1 - x0) * along + np.cos(angle) * across
    y = y0 + (y1 - y0) * along - np.sin(angle) * across
    angles = np.column_stack([np.zeros_like(x), _slope(scene, lane, x, y), np.full_like(x, lane.heading)])
    place = np.column_stack([x, y, scene.ground_height(x, y) + ANTENNA_HEIGHT])
    truth = SimulatedTrajectory(start + time, place, angles).rounded()
    error = np.column_stack([_slow(time, rng) * scale for scale in np.repeat(TRAJECTORY_ERROR, (2, 1))])
    reported = SimulatedTrajectory(truth.time, truth.place + error, truth.angles).rounded()
    return Pass(number, start + np.arange(seconds), truth, reported)


def _slope(scene: Scene, lane: Lane, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Pitch of the vehicle along the lane, degrees."""
    dx, dy = np.sin(np.radians(lane.heading)), np.cos(np.radians(lane.heading))
    rise = scene.ground_height(x + dx, y + dy) - scene.ground_height(x - dx, y - dy)
    return np.degrees(np.arctan(rise / 2.0))


def _slow(time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Error that changes over about 20 s, standard deviation 1."""
    phase, period = rng.uniform(0, 2 * np.pi, 3), np.array([90.0, 43.0, 19.0])
    return np.sqrt(2 / 3) * np.sin(2 * np.pi * time[:, None] / period + phase).sum(axis=1)
