"""Faults of real surveys that a sample city can have: what a scene's name does not say and a method must bear.

Without faults the city of a seed stays as it is, byte for byte: faults draw their random numbers from seeds of their
own.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable

import numpy as np

from ..errors import InputError
from ..wording import say

FAULTS = {
    "steps": "the reported trajectories jump by 2 m within 20 m of path, as after a GNSS re-fix",
    "stops": "the vehicle also waits for a minute in the middle of its way",
    "ghosts": "clusters of laser points 0.2 to 1 m below the road, 0.05 % of all (multipath)",
    "rings": "the beams of the mobile scanners are 32 lasers that answer differently (user data: number of the laser)",
    "ground": "heights of the airborne points are 5 cm off in the mean and wander by 5 cm more over 40 m",
    "rails": "rails along the kerbs and decks above the pavements",
    "driveways": "kerbs of the main streets lowered to 2 cm over 4 m, every 30 m",
    "signs": "sign posts with boards and groups of bollards along the main streets",
    "gantries": "a gantry with two boards over each of the main streets",
    "japan": "posts, lamps, signs and signals in the sizes of Japan's standards instead of the plain ones",
    "germany": "the same of Germany's",
    "us": "the same of those of the United States",
    "islands": "raised islands in the middle of the avenue",
    "paint": "worn markings, and patches of new asphalt over them between the flights and the drives",
    "surface": "wet and concrete stretches of road, dark and bright to the mobile scanners",
    "fronts": "canopies, sign bands, garden walls, hoardings, balconies, awnings, storeys on columns before the fronts",
}
"""What each fault is, by name."""

STEP, STEP_LENGTH = 2.0, 20.0
"""m, and m of path over which it comes."""

LONG_STOP = 60.0
"""s."""

# Share of the points; points of a cluster; its radius, m.
GHOSTS = 5e-4
GHOST_CLUSTER = 60
GHOST_REACH = 0.4
LASER_SPREAD = 0.5  # Standard deviation of the logarithm of the lasers' answers.
STRETCH = 15.0  # m: stretches of wet or concrete road, every fourth one each.
# Reflectance as a share of asphalt's.
WET = 0.4
CONCRETE = 1.8

LASERS = 32

GROUND_MEAN, GROUND_WAVE, GROUND_LENGTH = 0.05, 0.10, 40.0
"""m: mean of the error in height, half its range about the mean, and the distance over which it wanders."""


def checked_faults(names: Iterable[str]) -> tuple[str, ...]:
    """The faults named, each once and in their order here.

    Raises
    ------
    InputError : there is no such fault.
    """
    given = list(names)
    for name in given:
        if name not in FAULTS:
            raise InputError(say("There is no fault {name!r}: choose among {faults}.", name=name,
                                 faults=", ".join(FAULTS)))
    return tuple(name for name in FAULTS if name in given)


def fault_rng(name: str, seed: np.random.SeedSequence | int) -> np.random.Generator:
    """Random numbers of a fault, apart from those of the city."""
    entropy = seed.entropy if isinstance(seed, np.random.SeedSequence) else seed
    key = seed.spawn_key if isinstance(seed, np.random.SeedSequence) else ()
    return np.random.default_rng(np.random.SeedSequence(entropy, spawn_key=(*key, zlib.crc32(name.encode()))))


def step_along(chainage: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Change of the reported place (n, 2), m, at chainages (n,): a step about the middle of the drive."""
    middle = chainage[-1] * rng.uniform(0.4, 0.6)
    direction = rng.uniform(0, 2 * np.pi)
    share = np.clip((chainage - middle) / STEP_LENGTH + 0.5, 0.0, 1.0)
    return STEP * share[:, None] * np.array([np.sin(direction), np.cos(direction)])


def ghost_rows(ground: np.ndarray, place: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Rows (m,) of points that have a ghost, and how far below each it lies (m,), m.

    Parameters
    ----------
    ground : (n,) bool.
    place : (n, 3) m.
    """
    candidates = np.flatnonzero(ground)
    clusters = rng.poisson(GHOSTS * len(place) / GHOST_CLUSTER) if len(candidates) else 0
    rows, depth = [], []
    for _ in range(clusters):
        middle = place[rng.choice(candidates), :2]
        near = candidates[np.hypot(*(place[candidates, :2] - middle).T) < GHOST_REACH][:GHOST_CLUSTER]
        rows.append(near)
        depth.append(rng.uniform(0.2, 1.0) + rng.normal(0, 0.02, len(near)))
    return (np.concatenate(rows), np.concatenate(depth)) if rows else (np.zeros(0, int), np.zeros(0))


def laser_of(angle: np.ndarray) -> np.ndarray:
    """Number (n,) of the laser of a beam at an angle in the scan, degrees: every 32nd beam is one laser's."""
    return (np.round((np.asarray(angle) + 90.0) * 2.0).astype(int) % LASERS).astype(np.uint8)


def laser_answers(rng: np.random.Generator) -> np.ndarray:
    """Answer (LASERS,) of each laser, as a share of the scanner's."""
    return np.exp(rng.normal(0.0, LASER_SPREAD, LASERS))


def surface_factor(along: np.ndarray, across: np.ndarray) -> np.ndarray:
    """Reflectance (n,) of the carriageway as a share of asphalt's, at places u, v of the city's axes, m."""
    stretch = (np.floor(along / STRETCH) + np.floor(across / STRETCH)).astype(int) % 4
    return np.select([stretch == 1, stretch == 3], [WET, CONCRETE], 1.0)
