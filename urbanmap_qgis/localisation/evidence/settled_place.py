"""Where an NDT settles that sees walls where the map has them: cells with two surfaces pull it aside (J 6.2)."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_matrix

from ...mobile.registration.matching.ndt_match import Mixture, ndt_terms
from ..walls.wall_cells import PlanWallCells
from ..walls.wall_scan import WallScan

ITERATIONS = 4


def settled_places(scan: WallScan, sensor: np.ndarray, cells: PlanWallCells, mixture: Mixture, prior: np.ndarray
                   ) -> np.ndarray:
    """East, north, m, and turn, rad, (n, 3) from the true places (n, 3) to where Newton's method leads from there.

    `prior` (3, 3) is the information of what is known before.
    """
    found = np.zeros((len(sensor), 3))
    for _ in range(ITERATIONS):
        gradient, hessian = _derivatives(found, scan, sensor, cells, mixture)
        found += np.linalg.solve(prior - hessian, gradient[..., None])[..., 0]
    return found


def _derivatives(at: np.ndarray, scan: WallScan, sensor: np.ndarray, cells: PlanWallCells, mixture: Mixture
                 ) -> tuple[np.ndarray, np.ndarray]:
    """Gradient (n, 3) and bounded Hessian (n, 3, 3) of the scores of all places, moved by `at` (n, 3)."""
    of, weight, count = scan.of, scan.weight, len(sensor)
    cosine, sine = np.cos(at[:, 2])[of], np.sin(at[:, 2])[of]
    east, north = scan.offset.T
    arm_east, arm_north = cosine * east - sine * north, sine * east + cosine * north
    points = np.column_stack([sensor[of, 0] + arm_east + at[of, 0], sensor[of, 1] + arm_north + at[of, 1]])
    terms = ndt_terms(cells.ndt, points, mixture, "neighbours", bound=True)
    by_east, by_north = weight * terms.gradient[:, 0], weight * terms.gradient[:, 1]
    ee, en, nn = (weight * terms.hessian[:, i, j] for i, j in ((0, 0), (0, 1), (1, 1)))
    # A turn moves a point by (-north, east) of its arm.
    e_turn, n_turn = en * arm_east - ee * arm_north, nn * arm_east - en * arm_north
    turn = n_turn * arm_east - e_turn * arm_north
    gradient = np.column_stack([by_east, by_north, by_north * arm_east - by_east * arm_north])
    ends = np.searchsorted(of, np.arange(count + 1))
    sums = csr_matrix((np.ones(len(of)), np.arange(len(of)), ends), (count, len(of))) @ np.column_stack(
        [gradient, ee, en, e_turn, nn, n_turn, turn])
    return sums[:, :3], np.take(sums[:, 3:], [0, 1, 2, 1, 3, 4, 2, 4, 5], axis=1).reshape(count, 3, 3)
