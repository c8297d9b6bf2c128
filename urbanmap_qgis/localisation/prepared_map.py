"""The map on board made ready for all places: what walls and markings look like to a vehicle's sensors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .accuracy_records import LocalisationMap
from .localisation_settings import LocalisationSettings
from .map_aliases import STEP, ScoreField
from .places.road_places import RoadPlaces
from .walls.clutter import clutter_patterns
from .walls.wall_cells import PlanWallCells, pieces_at_height, wall_plan_cells, wall_points
from .walls.wall_map import WallMap
from .walls.wall_scan import AZIMUTHS, LAYERS


@dataclass(frozen=True)
class PreparedMap:
    """What all blocks of places share; None where the map or the settings have no use for it."""

    cells: PlanWallCells | None
    patterns: np.ndarray | None
    wall_field: ScoreField | None
    marking_field: ScoreField | None
    marking_tree: cKDTree | None


def prepared_map(city: LocalisationMap, places: RoadPlaces, settings: LocalisationSettings) -> PreparedMap:
    """Cells, patterns and scores of a map around places."""
    cells = patterns = wall_field = marking_field = tree = None
    if city.walls is not None:
        cells = wall_plan_cells(city.walls, settings.cell, settings.scanner.height)
        patterns = clutter_patterns(settings.scanner, settings.scanner.elevations(LAYERS), AZIMUTHS)
        if settings.search > 0:
            wall_field = field_of_walls(city.walls, places, settings)
    if city.markings is not None:
        tree = cKDTree(city.markings.xy)
        if settings.search > 0:
            marking_field = ScoreField.of(city.markings.xy, _bounds(places, settings), STEP / 2)
    return PreparedMap(cells, patterns, wall_field, marking_field, tree)


def field_of_walls(walls: WallMap, places: RoadPlaces, settings: LocalisationSettings) -> ScoreField:
    """Score of the walls around places, for shifts within the search and of the start."""
    points, _ = wall_points(walls.walls, pieces_at_height(walls.walls, settings.scanner.height))
    return ScoreField.of(points, _bounds(places, settings), max(float(np.median(walls.sigma)), STEP))


def _bounds(places: RoadPlaces, settings: LocalisationSettings) -> tuple[float, float, float, float]:
    reach = max(settings.scanner.max_range, settings.marking_range) + max(settings.search, 6 * settings.start_sigma)
    low, high = (end + side * (reach + 5.0) for end, side in ((places.place[:, :2].min(axis=0), -1),
                                                              (places.place[:, :2].max(axis=0), 1)))
    return (*low.tolist(), *high.tolist())
