"""What vehicles have on board, and the accuracy that is predicted with it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..wording import mark
from .ellipses import PlanEllipse
from .evidence.marking_map import MarkingMap
from .evidence.satellite_evidence import SkyTimes
from .map_aliases import AliasModes
from .places.road_places import RoadPlaces
from .walls.wall_map import WallMap

SOURCES = (mark("walls"), mark("markings"), mark("satellites"), mark("together"))


@dataclass(frozen=True)
class LocalisationMap:
    """What vehicles have on board.

    Attributes
    ----------
    walls : None where no buildings are used.
    markings : None likewise.
    sky : None without satellites.
    without_height : (k, 2) middles of buildings that have no heights and are left out, m.
    """

    walls: WallMap | None
    markings: MarkingMap | None = None
    sky: SkyTimes | None = None
    without_height: np.ndarray | None = None


@dataclass(frozen=True)
class AccuracyMap:
    """Predicted accuracy at n places.

    Attributes
    ----------
    places : with the heights that were used.
    sigma : by source ("walls", "markings", "satellites", "together"), (n, 3) standard deviations along and across the
        heading, m, and of the heading, degrees; NaN where the source tells nothing.
    covariance : (n, 3, 3) together, east, north (m2), turn (rad2).
    by_source : the same for each source.
    ellipse : of the plan, together.
    alias_shift : (n, 2) m to the likeliest other place, NaN without one.
    alias_share : (n,) probability of others.
    modes : for each place its other modes.
    elsewhere : (n,) share of searches from the start known before that end beside the place, where all directions are
        determined; NaN elsewhere.
    undetermined : (n,) number of directions in plan, 0 to 2, in which the map tells too little; NaN without a sigma.
    points, walls : (n,) rays on walls and number of walls seen.
    covered : (n,) share of the horizon with a wall in range.
    sky_covered : (n,) share of the sky hidden by buildings.
    cell_rms : (n,) m.
    two_surfaces : (n,) share. See `wall_evidence.representation`.
    satellites, dilution : (n,) in line of sight, PDOP; NaN where not asked for.
    kind : (n,) class.
    status : (n,) in words.
    """

    places: RoadPlaces
    sigma: dict[str, np.ndarray]
    covariance: np.ndarray
    by_source: dict[str, np.ndarray]
    ellipse: PlanEllipse
    alias_shift: np.ndarray
    alias_share: np.ndarray
    modes: tuple[AliasModes, ...]
    elsewhere: np.ndarray
    undetermined: np.ndarray
    points: np.ndarray
    walls: np.ndarray
    covered: np.ndarray
    sky_covered: np.ndarray
    cell_rms: np.ndarray
    two_surfaces: np.ndarray
    satellites: np.ndarray
    dilution: np.ndarray
    kind: np.ndarray
    status: np.ndarray


def joined_blocks(blocks: list[AccuracyMap]) -> AccuracyMap:
    """The blocks' places one after another."""
    def together(name: str):
        values = [getattr(block, name) for block in blocks]
        if isinstance(values[0], dict):
            return {key: np.concatenate([value[key] for value in values]) for key in values[0]}
        if isinstance(values[0], tuple):
            return tuple(item for value in values for item in value)
        if isinstance(values[0], np.ndarray):
            return np.concatenate(values)
        return type(values[0])(*(np.concatenate([getattr(value, field) for value in values])
                                 for field in type(values[0]).__dataclass_fields__))

    return AccuracyMap(*(together(name) for name in AccuracyMap.__dataclass_fields__))
