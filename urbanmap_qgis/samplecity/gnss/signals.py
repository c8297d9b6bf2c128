"""What the receiver measures: which path each signal takes, how strong it arrives, and its code range.

A code range is the path of the signal (with the rotation of the earth), plus receiver clock and system offset, minus
satellite clock, plus group delay, troposphere and ionosphere, plus the excess path of a reflection, plus errors.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from scipy.signal import lfilter

from ..scene.model import Crowns, Material
from .atmosphere import klobuchar_delay, saastamoinen_delay
from .earth_fixed import CityFrame
from .orbits import FREQUENCY, SPEED_OF_LIGHT, Orbits, light_path
from .passes import Pass
from .rays import Mirrors, OpaqueFaces, edge_excess, edge_loss, path_through_crowns

MASK = np.radians(10.0)
"""Satellites below this elevation are not tracked."""

MAX_RANGE = 120.0
"""Walls farther than this from the antenna reflect nothing that is tracked, m."""

TRACKED = 25.0  # Minimum carrier to noise density that the receiver tracks, dB-Hz.
LEAF_LOSS = 0.8  # Loss per metre of a tree's crown, dB.
# Standard deviations, m: of what the atmosphere models leave in the zenith; of a reflection by an uneven
# wall.
RESIDUAL_DELAY = 0.12
WALL_ROUGHNESS = 0.5
# Share of the reflected signals that arrive later still (by further detours), how much (m) and for how long
# (s).
NLOS_DELAY_SHARE = 0.15
NLOS_DELAY_MEAN = 4.0
NLOS_DELAY_SECONDS = 20

WALL_LOSS = {Material.FACADE: 12.0, Material.GLASS: 8.0}
"""Loss of a reflection, with that of the reversed polarisation in the antenna, dB; steeper reflections lose more."""

SECOND_FREQUENCY = {"G": 1227.60e6, "E": 1176.45e6, "J": 1227.60e6, "C": 1207.14e6}
"""Carrier of the second signal of each system, Hz: L2C, E5a, L2C, B2I."""

SYSTEM_OFFSET = {"G": 0.0, "E": 1.4, "J": 0.4, "C": -7.5}
"""Mean delay of each system in the receiver against GPS, m."""


@dataclass(frozen=True)
class Sky:
    """What the receiver's bands and the day's ionosphere are like.

    Attributes
    ----------
    two_bands : the receiver measures a second code.
    activity : true delay of the ionosphere over that which the satellites broadcast.
    slope : share by which it is larger towards the south, at the horizon, than overhead.
    patches : standard deviation of what single satellites meet beside that, in the zenith, m.
    """

    two_bands: bool = False
    activity: float = 1.0
    slope: float = 0.0
    patches: float = 0.0


class SignalKind(IntEnum):
    """How a signal arrives."""

    BLOCKED = 0
    LOS = 1
    REFLECTED = 2
    DIFFRACTED = 3


@dataclass(frozen=True)
class SimulatedSignals:
    """Signals of one pass; arrays of the shape (epochs, satellites), lengths in m, angles in rad from grid
    north.

    Attributes
    ----------
    above : above the elevation mask.
    tracked : there is an observation.
    kind : `SignalKind`.
    face : number of the reflecting face in the scene's static faces, -1 for none.
    reflections : number of walls that could reflect the signal with both legs free.
    excess : excess path of the tracked signal.
    multipath : error by reflections beside a free line of sight.
    nlos_delay : additional delay of reflected signals.
    noise : all other random errors.
    clock : receiver clock and system offset.
    distance : geometric range.
    satellite_clock : of the satellite, s.
    strength : carrier to noise density, dB-Hz.
    code : the code range.
    ionosphere : delay of the code.
    second_code : the code range on the second band, None where the receiver has none.
    """

    satellite: np.ndarray
    azimuth: np.ndarray
    elevation: np.ndarray
    above: np.ndarray
    tracked: np.ndarray
    kind: np.ndarray
    face: np.ndarray
    reflections: np.ndarray
    excess: np.ndarray
    multipath: np.ndarray
    nlos_delay: np.ndarray
    noise: np.ndarray
    clock: np.ndarray
    distance: np.ndarray
    satellite_clock: np.ndarray
    strength: np.ndarray
    code: np.ndarray
    ionosphere: np.ndarray
    second_code: np.ndarray | None


@dataclass(frozen=True)
class Site:
    """What the signals of all passes have in common."""

    frame: CityFrame
    obstacles: OpaqueFaces
    mirrors: Mirrors
    crowns: Crowns
    height: float


def receive(site: Site, drive: Pass, orbits: Orbits, orbit_error: np.ndarray, rng: np.random.Generator,
            sky: Sky | None = None) -> SimulatedSignals:
    """Signals of a pass. `orbit_error` (n,) is the error of the broadcast orbits and clocks along the signal,
    m."""
    sky = sky or Sky()
    shape = (len(drive.epochs), len(orbits))
    receiver_clock = _receiver_clock(drive.epochs, rng)
    arrival = drive.epochs - receiver_clock / SPEED_OF_LIGHT
    antenna, _ = drive.truth.interpolate(arrival)
    earth_fixed = site.frame.earth_fixed(antenna)
    place, distance, satellite_clock = light_path(orbits, arrival, earth_fixed)
    clock = receiver_clock[:, None] + orbits.constant(SYSTEM_OFFSET)
    to_satellite = place - earth_fixed[:, None]
    direction = site.frame.directions(to_satellite)
    elevation = np.arcsin(direction[..., 2])
    above = elevation > MASK
    draw = {name: rng.normal(size=shape) for name in ("strength", "code", "slow", "bounce", "bounce_strength")}
    nlos_delay = _nlos_delay(shape, rng)
    trace = _trace(site, antenna, direction, above, _persistent(draw["bounce_strength"], 15.0))
    fade = 1.0 * draw["strength"]
    strength = 36.0 + 12.0 * np.sqrt(np.sin(np.where(above, elevation, MASK))) - trace.loss + fade
    tracked = above & (strength > TRACKED)
    kind = np.where((trace.kind != SignalKind.LOS) & ~tracked, SignalKind.BLOCKED, trace.kind)
    reflected = kind == SignalKind.REFLECTED
    slow = _persistent(draw["slow"], 40.0) * RESIDUAL_DELAY / np.sin(np.maximum(elevation, MASK))
    rough = reflected * WALL_ROUGHNESS * _persistent(draw["bounce"], 15.0)
    noise = draw["code"] * code_noise(strength) + orbit_error + slow + rough
    nlos_delay = nlos_delay * reflected
    excess = np.where((kind == SignalKind.REFLECTED) | (kind == SignalKind.DIFFRACTED), trace.excess, 0.0)
    multipath = np.where(kind == SignalKind.LOS, trace.multipath, 0.0)
    azimuth = site.frame.true_azimuth(to_satellite)
    patch = rng.normal(0.0, sky.patches, len(orbits)) if sky.patches else np.zeros(len(orbits))
    air = saastamoinen_delay(site.frame.latitude, site.height, np.maximum(elevation, MASK))
    free = _ionosphere(site, orbits, azimuth, elevation, drive.epochs, sky, patch)
    common = distance + clock - SPEED_OF_LIGHT * satellite_clock + excess + nlos_delay
    delay = SPEED_OF_LIGHT * orbits.delay + (air + free)
    code = (distance + clock - SPEED_OF_LIGHT * satellite_clock + delay + excess + multipath + nlos_delay + noise)
    second = None
    if sky.two_bands:
        second = common + air + orbit_error + slow + rough + _second_band(orbits, free, strength, multipath, rng)
    return SimulatedSignals(orbits.satellite, np.arctan2(direction[..., 0], direction[..., 1]) % (2 * np.pi), elevation,
                            above, tracked, kind, np.where(reflected, trace.face, -1), trace.count, excess, multipath,
                            nlos_delay, noise, clock, distance, satellite_clock, strength, code, free, second)


def code_noise(strength: np.ndarray) -> np.ndarray:
    """Standard deviation of a code range, m, at a carrier to noise density in dB-Hz: 0.26 m at 45, 1.2 m at 30."""
    return np.sqrt(0.15**2 + 1400.0 * 10 ** (-strength / 10))


@dataclass(frozen=True)
class _Trace:
    """Paths of the signals, (epochs, satellites): loss in dB against a free one, infinite where nothing arrives."""

    kind: np.ndarray
    loss: np.ndarray
    excess: np.ndarray
    multipath: np.ndarray
    face: np.ndarray
    count: np.ndarray


def _trace(site: Site, antenna: np.ndarray, direction: np.ndarray, above: np.ndarray, fading: np.ndarray) -> _Trace:
    epoch, satellite = np.nonzero(above)
    start, towards = antenna[epoch], direction[epoch, satellite]
    free = site.obstacles.stop(start, site.obstacles.far_end(start, towards)) < 0
    hidden = np.flatnonzero(~free)
    edge, away = site.obstacles.over_edge(start[hidden], towards[hidden])
    loss, excess = np.zeros(len(start)), np.zeros(len(start))
    kind = np.full(len(start), int(SignalKind.LOS))
    kind[hidden] = SignalKind.DIFFRACTED
    loss[hidden], excess[hidden] = edge_loss(edge, away, towards[hidden]), edge_excess(edge, away, towards[hidden])
    loss[free] = LEAF_LOSS * path_through_crowns(site.crowns, start[free], towards[free])
    face, count, multipath = np.full(len(start), -1), np.zeros(len(start), np.int64), np.zeros(len(start))
    reflection = site.mirrors.reflect(site.obstacles, start, towards, MAX_RANGE)
    material = site.mirrors.faces.material[reflection.face]
    wall_loss = np.select([material == key for key in WALL_LOSS], list(WALL_LOSS.values()), 12.0)
    wall_loss = wall_loss + 5.0 * reflection.cosine + 3.0 * fading[epoch, satellite][reflection.ray]
    np.add.at(count, reflection.ray, 1)
    beside = free[reflection.ray]
    np.add.at(multipath, reflection.ray[beside], _beside_line_of_sight(reflection.excess[beside]))
    order = np.argsort(-wall_loss, kind="stable")
    for number in order[~beside[order] & (wall_loss[order] < loss[reflection.ray[order]])]:
        ray = reflection.ray[number]
        kind[ray], loss[ray], excess[ray] = SignalKind.REFLECTED, wall_loss[number], reflection.excess[number]
        face[ray] = site.mirrors.number[reflection.face[number]]
    arrays = []
    for values, empty in ((kind, int(SignalKind.BLOCKED)), (loss, np.inf), (excess, 0.0), (multipath, 0.0), (face, -1),
                          (count, 0)):
        full = np.full(above.shape, empty, values.dtype)
        full[epoch, satellite] = values
        arrays.append(full)
    return _Trace(*arrays)


def _beside_line_of_sight(excess: np.ndarray) -> np.ndarray:
    """Code error by a weaker reflection beside a free line of sight, m: its sign follows the phase of the carrier."""
    return 0.12 * excess * np.exp(-excess / 20.0) * np.cos(2 * np.pi * excess / 0.1903)


def _receiver_clock(epochs: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """(epochs,) clock of the receiver in m: offset, drift, a random walk."""
    walk = np.cumsum(rng.normal(0, 0.05, len(epochs)))
    return rng.uniform(-6e4, 6e4) + rng.uniform(-60.0, 60.0) * (epochs - epochs[0]) + walk


def _persistent(white: np.ndarray, seconds: float) -> np.ndarray:
    """White noise (epochs, n) of standard deviation 1 made persistent over `seconds`, of the same deviation."""
    keep = np.exp(-1.0 / seconds)
    driven = np.sqrt(1 - keep**2) * white
    driven[0] = white[0]
    return lfilter([1.0], [1.0, -keep], driven, axis=0)


def _nlos_delay(shape: tuple[int, int], rng: np.random.Generator) -> np.ndarray:
    blocks = (shape[0] // NLOS_DELAY_SECONDS + 1, shape[1])
    nlos_delay = (rng.random(blocks) < NLOS_DELAY_SHARE) * rng.exponential(NLOS_DELAY_MEAN, blocks)
    return np.repeat(nlos_delay, NLOS_DELAY_SECONDS, axis=0)[:shape[0]]


def _ionosphere(site: Site, orbits: Orbits, azimuth: np.ndarray, elevation: np.ndarray, epochs: np.ndarray, sky: Sky,
                patch: np.ndarray) -> np.ndarray:
    """(epochs, satellites) delay of the first code in the ionosphere, m; `patch` (n,) what each meets in the zenith."""
    elevation = np.maximum(elevation, MASK)
    dispersion = (FREQUENCY["G"] / orbits.constant(FREQUENCY)) ** 2
    model = klobuchar_delay(site.frame.latitude, site.frame.longitude, azimuth, elevation, epochs[:, None])
    factor = sky.activity * (1.0 - sky.slope * np.cos(azimuth) * np.cos(elevation))
    slant = 1.0 + 16.0 * (0.53 - elevation / np.pi) ** 3
    return dispersion * (factor * model + patch * slant)


def _second_band(orbits: Orbits, ionosphere: np.ndarray, strength: np.ndarray, multipath: np.ndarray,
                 rng: np.random.Generator) -> np.ndarray:
    """(epochs, satellites) what the second code holds of its own, m: group delay, ionosphere, multipath of another
    phase of the carrier, noise at 2 dB less, and a bias of the receiver for each system."""
    system = orbits.satellite.astype("U1")
    ratio = (orbits.constant(FREQUENCY) / orbits.constant(SECOND_FREQUENCY)) ** 2
    # Galileo's first code goes with the other delay (BGD E5b/E1), the second one with BGD E5a/E1.
    delay = np.select([system == "E", system == "C"],
                      [orbits.delay + (ratio - 1.0) * orbits.delay2, orbits.delay2], ratio * orbits.delay)
    bias = dict(zip("GEJC", rng.normal(0.0, 3.0, 4)))
    phase = np.cos(rng.uniform(0, 2 * np.pi, multipath.shape[1]))
    noise = rng.normal(size=strength.shape) * code_noise(strength - 2.0)
    return SPEED_OF_LIGHT * delay + ratio * ionosphere + orbits.constant(bias) + phase * multipath + noise
