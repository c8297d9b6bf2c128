"""Delays of GNSS signals in troposphere and ionosphere by the standard models."""

from __future__ import annotations

import numpy as np

from .orbits import SPEED_OF_LIGHT

ALPHA = (1.1176e-08, 2.2352e-08, -5.9605e-08, -1.1921e-07)
BETA = (9.6256e+04, 1.3107e+05, -6.5536e+04, -5.8982e+05)
"""Coefficients of the Klobuchar model that the simulated satellites broadcast."""


def saastamoinen_delay(latitude: float, height: float, elevation: np.ndarray) -> np.ndarray:
    """Delay in the troposphere, m (Saastamoinen 1972, standard atmosphere, 70 % humidity).

    `latitude` and `elevation` in rad, `height` above sea level in m. The mapping is 1 / sin(elevation).
    """
    pressure = 1013.25 * (1 - 2.2557e-5 * height) ** 5.2568
    kelvin = 288.16 - 6.5e-3 * height
    vapour = 6.108 * 0.7 * np.exp((17.15 * kelvin - 4684.0) / (kelvin - 38.45))
    dry = 0.0022768 * pressure / (1 - 0.00266 * np.cos(2 * latitude) - 2.8e-7 * height)
    wet = 0.002277 * (1255.0 / kelvin + 0.05) * vapour
    return (dry + wet) / np.sin(elevation)


def klobuchar_delay(latitude: float, longitude: float, azimuth: np.ndarray, elevation: np.ndarray,
                    time: np.ndarray) -> np.ndarray:
    """Delay in the ionosphere at 1575.42 MHz, m (IS-GPS-200, 20.3.3.5.2.5).

    Angles in rad, `time` in GPS seconds of week; azimuth, elevation and time broadcast against each other.
    """
    semicircle = elevation / np.pi
    psi = 0.0137 / (semicircle + 0.11) - 0.022
    phi = np.clip(latitude / np.pi + psi * np.cos(azimuth), -0.416, 0.416)
    lam = longitude / np.pi + psi * np.sin(azimuth) / np.cos(phi * np.pi)
    phi_m = phi + 0.064 * np.cos((lam - 1.617) * np.pi)
    local = (43200.0 * lam + time) % 86400.0
    amplitude = np.maximum(np.polyval(ALPHA[::-1], phi_m), 0.0)
    period = np.maximum(np.polyval(BETA[::-1], phi_m), 72000.0)
    x = 2 * np.pi * (local - 50400.0) / period
    slant = 1.0 + 16.0 * (0.53 - semicircle) ** 3
    return SPEED_OF_LIGHT * slant * np.where(np.abs(x) < 1.57, 5e-9 + amplitude * (1 - x**2 / 2 + x**4 / 24), 5e-9)
