"""The results of a wall adjustment as tables and lines."""

from __future__ import annotations

import numpy as np
import shapely

from ..rays.wall_faces import wall_table
from ..signals.tables import Signals
from .adjustment import Adjustment


def adjusted_wall_columns(adjustment: Adjustment, names: np.ndarray) -> dict[str, np.ndarray]:
    """Attributes of the walls, (k,) each; `names` (buildings,) of the buildings by row."""
    walls, table = adjustment.walls, adjustment.walls.table
    return {"building": np.array([str(names[row]) for row in table.building], object), "edge": table.edge,
            "status": walls.status, "reason": walls.reason, "offset": walls.offset, "sigma": walls.sigma,
            "applied": walls.applied, "observations": walls.observations, "signals": walls.signals,
            "satellites": walls.satellites, "passes": walls.passes, "on_time": walls.inlier_share,
            "distance": walls.distance, "length": table.length, "low": table.low, "top": table.top}


def wall_lines(adjustment: Adjustment, signals: Signals) -> np.ndarray:
    """(k,) lines with z along the foot of each wall where it stands now; where the foot is not known, at the height of
    the antennas."""
    table = wall_table(adjustment.after)
    height = np.where(np.isfinite(table.low), table.low, np.median(signals.epochs.place[:, 2]))
    ends = np.stack([np.column_stack([place, height]) for place in (table.start, table.end)], axis=1)
    return shapely.linestrings(ends)


def building_columns(adjustment: Adjustment, building: np.ndarray) -> dict[str, np.ndarray]:
    """(n,) for each feature: adjusted and likely walls of its building, and how far its walls have moved at most, m."""
    wall_building, rows = adjustment.walls.table.building, np.unique(building, return_inverse=True)
    adjusted = np.bincount(wall_building, adjustment.walls.is_moved, len(rows[0])).astype(np.int64)
    moved = np.zeros(len(rows[0]))
    np.maximum.at(moved, wall_building, np.abs(adjustment.walls.applied))
    row = rows[1].ravel()
    return {"walls_adjusted": adjusted[row], "walls_moved_by": np.round(moved[row], 3)}
