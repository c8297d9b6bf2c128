"""Medians of groups of values, all groups at once."""

from __future__ import annotations

import numpy as np


def grouped_median(value: np.ndarray, group: np.ndarray, count: int) -> np.ndarray:
    """(count,) median of the values of each group; NaN for empty ones."""
    order = np.lexsort((value, group))
    value, group = value[order], group[order]
    size = np.bincount(group, minlength=count)
    first = np.concatenate([[0], np.cumsum(size)[:-1]])
    median = np.full(count, np.nan)
    full = size > 0
    low, high = first[full] + (size[full] - 1) // 2, first[full] + size[full] // 2
    median[full] = 0.5 * (value[low] + value[high])
    return median
