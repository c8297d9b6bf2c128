"""Statistical outlier removal: points whose neighbours are far (J 5.7; Rusu et al. 2008)."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

NEIGHBOURS = 8
DEVIATIONS = 3.0


def statistical_outliers(places: np.ndarray) -> np.ndarray:
    """Which places are statistical outliers, (n,) bool.

    A place is an outlier where the mean distance to its neighbours is above the mean of all such distances by more than
    `DEVIATIONS` standard deviations. With as few places as neighbours none is.

    Parameters
    ----------
    places : (n, 3), m; points, or the centroids of voxels that stand for them.
    """
    if len(places) <= NEIGHBOURS + 1:
        return np.zeros(len(places), bool)
    distance = cKDTree(places).query(places, NEIGHBOURS + 1)[0][:, 1:].mean(axis=1)
    return distance > distance.mean() + DEVIATIONS * distance.std()
