"""What a scan of walls tells of a place, by NDT or ICP (J 6.2)."""

from __future__ import annotations

import numpy as np

from ...mobile.registration.matching.ndt_match import Mixture
from ..localisation_settings import LocalisationSettings
from ..walls.wall_cells import PlanWallCells
from ..walls.wall_map import WallMap
from ..walls.wall_scan import WallScan
from .effective_walls import robust_excess
from .information import Evidence, SharedError, covariances_of_parts, surface_rows
from .settled_place import settled_places


def wall_evidence(walls: WallMap, scan: WallScan, sensor: np.ndarray, cells: PlanWallCells,
                  settings: LocalisationSettings) -> Evidence:
    """Rows of the points of a scan from places (n, 3).

    An NDT weighs a point with the inverse covariance of its cell along the normal, u = n^T S^-1 n; an ICP weighs all
    alike. Displacements are shared by all points of a wall, and by all walls of a building.
    """
    pieces = walls.walls
    normal, wall = pieces.normal[scan.piece], pieces.wall[scan.piece]
    sigma = walls.sigma[wall]
    rays = scan.weight
    weight = rays * _point_weights(walls, scan, sensor, cells, settings)
    noise = settings.scanner.noise / np.sqrt(rays)
    grown = np.sqrt(_losses(weight / rays, sigma, settings))
    shared = [SharedError(wall, grown, sigma)]
    if settings.common_sigma > 0:
        common = np.full(len(wall), settings.common_sigma)
        shared += [SharedError(pieces.building[scan.piece], grown * normal[:, axis], common) for axis in range(2)]
    return Evidence(scan.of, surface_rows(normal, scan.offset), weight, noise, tuple(shared))


def walls_covariance(walls: WallMap, scan: WallScan, sensor: np.ndarray, heading: np.ndarray, cells: PlanWallCells,
                     patterns: np.ndarray, settings: LocalisationSettings) -> np.ndarray:
    """(n, 3, 3) covariance by walls from places (n, 3) with headings (n,), radians.

    It is the mean over arrangements of vehicles and trees, which hide now this wall and now that one: a map with few
    accurate walls is worse than the mean of what its walls tell.

    `patterns` : as of `clutter.clutter_patterns`.
    """
    every = wall_evidence(walls, scan, sensor, cells, settings)
    azimuths = patterns.shape[2]
    turned = np.round(heading / (2 * np.pi) * azimuths).astype(np.int64)
    ray = (scan.ray - turned[scan.of]) % azimuths
    every_layer = scan.layers.sum(axis=1)
    parts = [(scan.layers & (scan.distance < np.ascontiguousarray(reach.T)[ray])).sum(axis=1) / every_layer
             for reach in patterns]
    total = np.zeros((len(sensor), 3, 3))
    for each in covariances_of_parts(every, parts, len(sensor), settings.prior()):
        total += each
    total /= len(patterns)
    return total if settings.matcher == "ICP" else total + _of_ndt(walls, scan, sensor, cells, every, parts, settings)


def _of_ndt(walls: WallMap, scan: WallScan, sensor: np.ndarray, cells: PlanWallCells, every: Evidence,
            parts: list[np.ndarray], settings: LocalisationSettings) -> np.ndarray:
    """(n, 3, 3) that an NDT adds to the linear match: it follows the strongest walls, and cells pull it aside."""
    wall, prior = walls.walls.wall[scan.piece], settings.prior()
    mixture = Mixture.of(settings.outliers, settings.cell, 2)
    aside = settled_places(scan, sensor, cells, mixture, prior)
    added = robust_excess(every, scan.weight, wall, walls.sigma[wall], parts, len(sensor), prior, mixture.sharpness)
    values, vectors = np.linalg.eigh(added + np.einsum("ni,nj->nij", aside, aside))
    # Chance makes the difference of moments small and negative where nothing is to be added.
    return np.einsum("nij,nj,nkj->nik", vectors, np.maximum(values, 0.0), vectors)


def _losses(weight: np.ndarray, sigma: np.ndarray, settings: LocalisationSettings) -> np.ndarray:
    """(m,) by which the variance of the walls' part grows beyond that of the linear solution.

    The mixture of an NDT with the sharpness c pulls with psi(e) = e exp(-c u e^2 / 2); of errors e with the variance
    s^2 its estimate has E[psi^2] / E[psi']^2 = s^2 (1 + q)^3 / (1 + 2 q)^(3/2), q = c u s^2.
    """
    if settings.matcher == "ICP":
        return np.ones(len(weight))
    q = Mixture.of(settings.outliers, settings.cell, 2).sharpness * weight * sigma ** 2
    return (1 + q) ** 3 / (1 + 2 * q) ** 1.5


def _point_weights(walls: WallMap, scan: WallScan, sensor: np.ndarray, cells: PlanWallCells,
                   settings: LocalisationSettings) -> np.ndarray:
    normal, sigma = walls.walls.normal[scan.piece], walls.sigma[walls.walls.wall[scan.piece]]
    if settings.matcher == "ICP":
        return np.full(len(normal), 1.0 / (np.median(walls.sigma) ** 2 + settings.scanner.noise ** 2))
    number = cells.of(sensor[scan.of, :2] + scan.offset)
    inverse = cells.ndt.inverse[np.maximum(number, 0)]
    along_normal = np.einsum("mi,mij,mj->m", normal, inverse, normal)
    # Walls that no cell holds, such as those above a podium, are weighed by their own accuracy.
    return np.where(number >= 0, along_normal, 1.0 / (sigma ** 2 + settings.scanner.noise ** 2))


def _spreads(cells: PlanWallCells, number: np.ndarray) -> np.ndarray:
    """(m, 2, 2) covariances of cells, m2; of each cell, which many points fall into, only once inverted."""
    met = np.zeros(len(cells.ndt.inverse), bool)
    met[number] = True
    place = np.cumsum(met) - 1
    return np.linalg.inv(cells.ndt.inverse[met])[place[number]]


def representation(walls: WallMap, scan: WallScan, sensor: np.ndarray, cells: PlanWallCells, count: int
                   ) -> tuple[np.ndarray, np.ndarray]:
    """How well cells stand for the walls seen from each place.

    Returns
    -------
    rms : (count,) m, root mean square distance of the walls from the plane through their cell's mean, beyond the
        walls' own sigma.
    two : (count,) share of the points in cells where two surfaces meet. Both NaN where nothing is seen.
    """
    number = cells.of(sensor[scan.of, :2] + scan.offset)
    seen = np.flatnonzero(number >= 0)
    number, of, rays = number[seen], scan.of[seen], scan.weight[seen]
    normal = walls.walls.normal[scan.piece[seen]]
    sigma = walls.sigma[walls.walls.wall[scan.piece[seen]]]
    beyond = np.einsum("mi,mij,mj->m", normal, _spreads(cells, number), normal) - sigma ** 2
    points = np.bincount(of, rays, count).astype(float)
    points[points == 0] = np.nan
    return (np.sqrt(np.bincount(of, rays * np.maximum(beyond, 0.0), count) / points),
            np.bincount(of, rays * cells.two[number], count) / points)
