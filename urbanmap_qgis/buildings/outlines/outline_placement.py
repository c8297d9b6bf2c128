"""Outlines of a tile moved to where its points show the buildings."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from ...geometry.grid import Grid
from ...geometry.sampling import sample
from ...progress import Progress
from .displacement import estimate_displacements, shifted_outlines
from .evidence import EvidenceAccumulator, evidence_cell
from .segmented_buildings import SegmentedBuildings

_MARGIN = 5.0  # m beyond the farthest displacement within which points speak


def place_outlines(table: SegmentedBuildings, records: Any, places: tuple[np.ndarray, np.ndarray, np.ndarray],
                   density: float, ground: tuple[Grid, np.ndarray] | None, reach: float, progress: Progress) -> None:
    """Move the outlines of a table to their points and fill in by how much.

    Parameters
    ----------
    table : outlines as given.
    records : points with `classification`, `return_number` and `number_of_returns` (n,).
    places : x, y, z (n,) of them, m.
    density : pulses a m2.
    ground : grid and heights, m.
    reach : m by which an outline may be moved at most.
    """
    x, y, z = places
    given, margin = table.outlines.copy(), reach + _MARGIN
    x_min, y_min, x_max, y_max = shapely.total_bounds(given)
    grid = Grid.covering(x_min - margin, y_min - margin, x_max + margin, y_max + margin, evidence_cell(density))
    evidence = EvidenceAccumulator(grid)
    evidence.add(x, y, z, np.asarray(records.classification), np.asarray(records.return_number),
                 np.asarray(records.number_of_returns))
    centre_x, centre_y = np.meshgrid(*grid.centres())
    heights = (sample(*ground, centre_x.ravel(), centre_y.ravel()).reshape(grid.shape) if ground
               else np.full(grid.shape, np.nan))
    shifts = estimate_displacements(given, evidence.evidence(heights), grid, evidence.surface, reach, progress)
    table.outlines[:] = shifted_outlines(given, shifts)
    table.shift_x[:], table.shift_y[:], table.shift_sigma[:] = shifts.dx, shifts.dy, shifts.sigma
    table.shift_status[:] = shifts.status
