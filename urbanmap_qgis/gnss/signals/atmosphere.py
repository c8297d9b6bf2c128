"""Delays of code ranges in troposphere and ionosphere by the standard models."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..orbits.earth_fixed import SPEED_OF_LIGHT
from ..rinex.gnss_time import DAY
from ..rinex.navigation import Ionosphere
from ..rinex.observation_file import MEGAHERTZ

_L1 = MEGAHERTZ["G"]["1"]
_B1 = MEGAHERTZ["C"]["2"]
_NIGHT = 5e-9


def troposphere(latitude: np.ndarray, height: np.ndarray, elevation: np.ndarray, humidity: float = 0.7) -> np.ndarray:
    """Delay, m: Saastamoinen's zenith delay in the standard atmosphere, mapped by Black and Eisner (1984).

    Parameters
    ----------
    latitude, elevation : rad; elevation from about 5 degrees up.
    height : above sea level, m; held within -200 to 9000 m.
    humidity : relative, 0 to 1.
    """
    height = np.clip(height, -200.0, 9000.0)
    kelvin = 288.15 - 6.5e-3 * height
    pressure = 1013.25 * (kelvin / 288.15) ** 5.2559
    # Saturation pressure of water in hPa (Magnus).
    vapour = humidity * 6.1094 * np.exp(17.625 * (kelvin - 273.15) / (kelvin - 30.11))
    dry = 0.0022768 * pressure / (1 - 0.00266 * np.cos(2 * latitude) - 2.8e-7 * height)
    wet = 0.0022768 * (1255.0 / kelvin + 0.05) * vapour
    return (dry + wet) * 1.001 / np.sqrt(0.002001 + np.sin(elevation) ** 2)


def klobuchar(alpha: Sequence[float], beta: Sequence[float], latitude: np.ndarray, longitude: np.ndarray,
              azimuth: np.ndarray, elevation: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Delay at 1575.42 MHz, m, by the coefficients of GPS or QZSS (IS-GPS-200, 20.3.3.5.2.5).

    Angles in rad, azimuth from TRUE north; `time` in GPS seconds.
    """
    half_turns = elevation / np.pi
    psi = 0.0137 / (half_turns + 0.11) - 0.022
    phi = np.clip(latitude / np.pi + psi * np.cos(azimuth), -0.416, 0.416)
    lam = longitude / np.pi + psi * np.sin(azimuth) / np.cos(phi * np.pi)
    magnetic = phi + 0.064 * np.cos((lam - 1.617) * np.pi)
    slant = 1.0 + 16.0 * (0.53 - half_turns) ** 3
    day = np.mod(43200.0 * lam + time, DAY)
    amplitude = np.maximum(np.polyval(tuple(alpha)[::-1], magnetic), 0.0)
    period = np.maximum(np.polyval(tuple(beta)[::-1], magnetic), 72000.0)
    phase = 2 * np.pi * (day - 50400.0) / period
    wave = np.where(np.abs(phase) < 1.57, amplitude * (1 - phase ** 2 / 2 + phase ** 4 / 24), 0.0)
    return SPEED_OF_LIGHT * slant * (_NIGHT + wave)


def klobuchar_beidou(alpha: Sequence[float], beta: Sequence[float], latitude: np.ndarray, longitude: np.ndarray,
                     azimuth: np.ndarray, elevation: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Delay at 1561.098 MHz, m, by BeiDou's coefficients (BeiDou B1I ICD, 5.2.4.7): geographic, not magnetic latitude.

    Angles in rad, azimuth from TRUE north; `time` in seconds of BeiDou time of day or any multiple of days more.
    """
    radius = 6378.0 / (6378.0 + 375.0)
    psi = np.pi / 2 - elevation - np.arcsin(radius * np.cos(elevation))
    phi = np.arcsin(np.sin(latitude) * np.cos(psi) + np.cos(latitude) * np.sin(psi) * np.cos(azimuth))
    lam = longitude + np.arcsin(np.sin(psi) * np.sin(azimuth) / np.cos(phi))
    day = np.mod(43200.0 * lam / np.pi + time, DAY)
    half_turns = np.abs(phi) / np.pi
    amplitude = np.maximum(np.polyval(tuple(alpha)[::-1], half_turns), 0.0)
    period = np.clip(np.polyval(tuple(beta)[::-1], half_turns), 72000.0, 172800.0)
    late = day - 50400.0
    wave = np.where(np.abs(late) < period / 4, amplitude * np.cos(2 * np.pi * late / period), 0.0)
    return SPEED_OF_LIGHT * (_NIGHT + wave) / np.sqrt(1 - (radius * np.cos(elevation)) ** 2)


def ionosphere(model: Ionosphere, system: np.ndarray, bands: dict[str, str], latitude: np.ndarray,
               longitude: np.ndarray, azimuth: np.ndarray, elevation: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Delay, m, of signals (n,) on the bands of their systems: it falls with the square of the frequency."""
    beidou = model.source == "BDS"
    compute, of = (klobuchar_beidou, _B1) if beidou else (klobuchar, _L1)
    delay = compute(model.alpha, model.beta, latitude, longitude, azimuth, elevation, time)
    scale = {name: (of / MEGAHERTZ[name][bands[name]]) ** 2 for name in bands}
    return delay * np.array([scale[name] for name in system])


def nearest_model(models: Sequence[Ionosphere], time: float) -> Ionosphere | None:
    """The coefficients of the day, GPS's before QZSS's before BeiDou's; None without any."""
    order = {"GPS": 0, "QZS": 1, "BDS": 2}
    return min(models, key=lambda model: (order[model.source], abs(model.time - time)), default=None)
