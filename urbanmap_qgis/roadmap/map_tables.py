"""A lane map as columns of layers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import shapely

from ..wording import known
from .map_records import VectorMap


def lane_columns(built: VectorMap) -> dict[str, list]:
    """Columns of the lanes' layer, one value a lane; ids of others are lists with commas between."""
    lanes = built.lanes
    return {"lane_id": list(range(len(lanes))), "kind": [lane.kind for lane in lanes],
            "evidence": [lane.evidence for lane in lanes], "width": [lane.width for lane in lanes],
            "narrowest": [lane.narrowest for lane in lanes],
            "length": [float(shapely.LineString(lane.centre[:, :2]).length) for lane in lanes],
            "turn": [lane.turn or None for lane in lanes],
            "arrows": [", ".join(lane.arrows) or None for lane in lanes],
            "successors": [_listed(lane.successors) for lane in lanes],
            "left": [_known(lane.left_neighbour) for lane in lanes],
            "right": [_known(lane.right_neighbour) for lane in lanes],
            "opposite": [_known(lane.opposite) for lane in lanes],
            "stop_lines": [_listed(lane.stop_lines) for lane in lanes],
            "crosswalks": [_listed(lane.crosswalks) for lane in lanes],
            "speed_limit": [lane.speed_limit for lane in lanes],
            "yields_to": [_listed(sorted(lane.yields_to)) for lane in lanes],
            "yields_by": [", ".join(sorted({known(reason) for reason in lane.yields_to.values()})) or None
                          for lane in lanes],
            "confidence": [lane.confidence for lane in lanes]}


def bound_columns(built: VectorMap, ids: Sequence[int] = ()) -> dict[str, list]:
    """Columns of the bounds' layer, one value a bound; without `ids` they are counted from 0."""
    bounds = built.bounds
    used = Counter(number for lane in built.lanes for number in (lane.left, lane.right))
    return {"bound_id": list(ids or range(len(bounds))), "class": [bound.kind for bound in bounds],
            "colour": [bound.colour or None for bound in bounds], "width": [bound.width for bound in bounds],
            "sigma": [bound.sigma for bound in bounds], "sigmas": [told_sigmas(bound.sigmas) for bound in bounds],
            "double": [bound.double for bound in bounds],
            "unseen": [bound.unseen for bound in bounds], "lanes": [used[number] for number in range(len(bounds))]}


def told_sigmas(sigmas: Sequence[float]) -> str | None:
    """Standard deviations (m) as text, commas between them; None where there are none."""
    return ",".join(f"{sigma:.3f}" for sigma in sigmas) or None


def _listed(numbers: list[int]) -> str | None:
    return ",".join(map(str, numbers)) or None


def _known(number: int) -> int | None:
    return None if number < 0 else number
