"""Satellites of the sample city: a plausible constellation and its motion.

Positions follow the algorithm of the broadcast ephemerides (IS-GPS-200 table 20-IV; Galileo OS SIS ICD 5.1.1, BeiDou
B1I ICD table 5-11 and QZSS IS-QZSS-PNT use the same one with their own constants). Times are GPS seconds of week.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

SPEED_OF_LIGHT = 299792458.0
SYSTEMS = "GEJC"
"""GPS, Galileo, QZSS and the BeiDou satellites in medium orbits, by their letters in RINEX."""

GM = {"G": 3.986005e14, "E": 3.986004418e14, "J": 3.986005e14, "C": 3.986004418e14}
"""The earth's gravitational constant as each system's interface document fixes it, m3/s2."""

EARTH_RATE = {"G": 7.2921151467e-5, "E": 7.2921151467e-5, "J": 7.2921151467e-5, "C": 7.292115e-5}
"""The earth's rotation as each system's interface document fixes it, rad/s."""

TIME_OFFSET = {"G": 0.0, "E": 0.0, "J": 0.0, "C": 14.0}
"""GPS time minus the system's own time, s."""

FREQUENCY = {"G": 1575.42e6, "E": 1575.42e6, "J": 1575.42e6, "C": 1561.098e6}
"""Carrier of the simulated signal, Hz."""


@dataclass(frozen=True)
class Orbits:
    """Broadcast ephemerides of n satellites, one record each; every field has the shape (n,).

    Angles in rad, lengths in m, `sqrt_a` in m^0.5, rates by s. `toe` is the reference time of orbit and clock in GPS
    seconds of week. `omega0` belongs to the start of the week of the system's own time. `delay` (s) is the group
    delay (TGD, BGD) of the simulated signal, `delay2` that of the system's other signal.
    """

    satellite: np.ndarray
    toe: np.ndarray
    sqrt_a: np.ndarray
    e: np.ndarray
    m0: np.ndarray
    delta_n: np.ndarray
    omega0: np.ndarray
    omega_dot: np.ndarray
    omega: np.ndarray
    i0: np.ndarray
    i_dot: np.ndarray
    cuc: np.ndarray
    cus: np.ndarray
    crc: np.ndarray
    crs: np.ndarray
    cic: np.ndarray
    cis: np.ndarray
    af0: np.ndarray
    af1: np.ndarray
    delay: np.ndarray
    delay2: np.ndarray

    def __len__(self) -> int:
        return len(self.satellite)

    @property
    def system(self) -> np.ndarray:
        """Letter of each satellite's system."""
        return np.array([name[0] for name in self.satellite])

    def constant(self, table: dict[str, float]) -> np.ndarray:
        """(n,) values of a table by system."""
        return np.array([table[name[0]] for name in self.satellite])

    def select(self, index: np.ndarray) -> Orbits:
        """The records of the given numbers."""
        return Orbits(*(getattr(self, item.name)[index] for item in fields(self)))

    def moved_to(self, reference: float) -> Orbits:
        """The same orbits and clocks described by records of another reference time (s, in each system's own time).

        Values are rounded to the 13 digits of a RINEX file, so that the file holds exactly what is simulated.
        """
        toe = reference + self.constant(TIME_OFFSET)
        step = toe - self.toe
        motion = np.sqrt(self.constant(GM)) / self.sqrt_a**3 + self.delta_n
        changed = {"toe": toe, "m0": _wrapped(self.m0 + motion * step),
                   "omega0": _wrapped(self.omega0 + self.omega_dot * step),
                   "i0": self.i0 + self.i_dot * step, "af0": self.af0 + self.af1 * step}
        values = {item.name: getattr(self, item.name) for item in fields(self)} | changed
        return Orbits(**{name: value if name == "satellite" else _rounded(value) for name, value in values.items()})


def simulated_satellite_states(orbits: Orbits, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places and clocks of the n satellites.

    Parameters
    ----------
    time : (..., n) GPS seconds of week at which each satellite transmits.

    Returns
    -------
    (..., n, 3) places (m) in the earth-fixed frame of that moment, and (..., n) clock offsets (s) with the
    relativistic part of the eccentric orbit, without group delay.
    """
    since = np.asarray(time, float) - orbits.toe
    gm, rate = orbits.constant(GM), orbits.constant(EARTH_RATE)
    motion = np.sqrt(gm) / orbits.sqrt_a**3 + orbits.delta_n
    eccentric = eccentric_anomaly(orbits.m0 + motion * since, orbits.e)
    true = np.arctan2(np.sqrt(1 - orbits.e**2) * np.sin(eccentric), np.cos(eccentric) - orbits.e)
    argument = true + orbits.omega
    cos2, sin2 = np.cos(2 * argument), np.sin(2 * argument)
    latitude = argument + orbits.cuc * cos2 + orbits.cus * sin2
    radius = (orbits.sqrt_a**2 * (1 - orbits.e * np.cos(eccentric)) + orbits.crc * cos2 + orbits.crs * sin2)
    inclination = orbits.i0 + orbits.i_dot * since + orbits.cic * cos2 + orbits.cis * sin2
    node = (orbits.omega0 + (orbits.omega_dot - rate) * since
            - rate * (orbits.toe - orbits.constant(TIME_OFFSET)))
    along, across = radius * np.cos(latitude), radius * np.sin(latitude)
    place = np.stack([along * np.cos(node) - across * np.cos(inclination) * np.sin(node),
                      along * np.sin(node) + across * np.cos(inclination) * np.cos(node),
                      across * np.sin(inclination)], axis=-1)
    relativity = -2 * np.sqrt(gm) * orbits.sqrt_a * orbits.e * np.sin(eccentric) / SPEED_OF_LIGHT**2
    return place, orbits.af0 + orbits.af1 * since + relativity


def eccentric_anomaly(mean: np.ndarray, e: np.ndarray) -> np.ndarray:
    """Kepler's equation solved for the eccentric anomaly (rad); mean anomaly and eccentricity of one shape."""
    eccentric = mean + e * np.sin(mean)
    for _ in range(6):
        eccentric = eccentric - (eccentric - e * np.sin(eccentric) - mean) / (1 - e * np.cos(eccentric))
    return eccentric


def light_path(orbits: Orbits, time: np.ndarray, receiver: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Signals that arrive at a receiver.

    Parameters
    ----------
    time : (m,) GPS seconds of week of arrival.
    receiver : (m, 3) earth-fixed places of the antenna, m.

    Returns
    -------
    (m, n, 3) places of the satellites when they transmitted, in the earth-fixed frame of arrival; (m, n) ranges (m);
    (m, n) satellite clock offsets (s) at transmission.
    """
    travel = np.full((len(time), len(orbits)), 0.075)
    turn_rate = orbits.constant(EARTH_RATE)
    for _ in range(4):
        place, clock = simulated_satellite_states(orbits, time[:, None] - travel)
        cos, sin = np.cos(turn_rate * travel), np.sin(turn_rate * travel)
        place = np.stack([cos * place[..., 0] + sin * place[..., 1], cos * place[..., 1] - sin * place[..., 0],
                          place[..., 2]], axis=-1)
        distance = np.linalg.norm(place - receiver[:, None], axis=-1)
        travel = distance / SPEED_OF_LIGHT
    return place, distance, clock


def make_constellation(reference: float, rng: np.random.Generator) -> Orbits:
    """A plausible constellation: 24 GPS, 24 Galileo, 4 QZSS (one geostationary) and 24 BeiDou satellites.

    `reference` is the time (s of the system's week) of the records.
    """
    walker = {"G": (6, 4, 26559.7e3, 55.0, range(1, 25)), "E": (3, 8, 29600.3e3, 56.0, range(1, 25)),
              "C": (3, 8, 27906.1e3, 55.0, range(19, 43))}
    names, rows = [], []
    for system, (planes, slots, a, inclination, numbers) in walker.items():
        names += [f"{system}{number:02d}" for number in numbers]
        rows.append(_walker(planes, slots, a, np.radians(inclination), system, rng))
    names += ["J02", "J03", "J04", "J07"]
    rows.append(_quasi_zenith(reference, rng))
    elements = {key: np.concatenate([row[key] for row in rows]) for key in rows[0]}
    n = len(names)

    def spread(scale: float) -> np.ndarray:
        return rng.normal(0.0, scale, n)

    names = np.array(names)
    toe = reference + np.array([TIME_OFFSET[name[0]] for name in names])
    orbits = Orbits(
        satellite=names, toe=toe, **elements, delta_n=rng.uniform(2.5e-9, 5.5e-9, n) * (names != "J07"),
        omega_dot=rng.uniform(-8.5e-9, -5e-9, n), i_dot=spread(2e-10),
        cuc=spread(2e-6), cus=rng.uniform(3e-6, 1e-5, n), crc=rng.uniform(120.0, 320.0, n), crs=spread(60.0),
        cic=spread(8e-8), cis=spread(8e-8), af0=spread(2.5e-4), af1=spread(4e-12), delay=spread(5e-9),
        delay2=spread(5e-9))
    order = np.argsort([SYSTEMS.index(name[0]) * 100 + int(name[1:]) for name in names])
    return orbits.select(order)


def _walker(planes: int, slots: int, a: float, inclination: float, system: str,
            rng: np.random.Generator) -> dict[str, np.ndarray]:
    plane, slot = (grid.ravel() for grid in np.meshgrid(np.arange(planes), np.arange(slots), indexing="ij"))
    n = len(plane)
    phase = 2 * np.pi * (slot / slots + plane / (planes * slots)) + rng.uniform(0, 2 * np.pi) + rng.normal(0, 0.08, n)
    e = rng.uniform(5e-5, 6e-4, n) if system != "G" else rng.uniform(0.002, 0.018, n)
    omega = rng.uniform(-np.pi, np.pi, n)
    return {"sqrt_a": np.sqrt(a + rng.normal(0, 300.0, n)), "e": e, "m0": _wrapped(phase - omega),
            "omega0": _wrapped(2 * np.pi * plane / planes + rng.uniform(0, 2 * np.pi) + rng.normal(0, 0.02, n)),
            "omega": omega, "i0": inclination + rng.normal(0, 0.008, n)}


def _quasi_zenith(reference: float, rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Three satellites over Japan in an inclined eccentric orbit of one day, and one over the equator at 127 east."""
    e = np.array([0.075, 0.075, 0.075, 2e-4])
    omega = np.radians([270.0, 270.0, 270.0, 30.0])
    m0 = rng.uniform(0, 2 * np.pi) + 2 * np.pi / 3 * np.array([0, 1, 2, 0.5])
    centre = np.radians([136.0, 135.0, 137.0, 127.0])
    return {"sqrt_a": np.sqrt(np.full(4, 42164.17e3)), "e": e, "m0": _wrapped(m0),
            "omega0": _wrapped(centre - omega - m0 + EARTH_RATE["J"] * reference), "omega": omega,
            "i0": np.radians([41.0, 40.5, 41.3, 0.06])}


def _wrapped(angle: np.ndarray) -> np.ndarray:
    return (np.asarray(angle) + np.pi) % (2 * np.pi) - np.pi


def _rounded(values: np.ndarray) -> np.ndarray:
    return np.array([float(f"{value:.12E}") for value in values])
