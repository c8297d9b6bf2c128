"""How sure it is that a movement through a junction is allowed, where no drive shows it.

An arrow tells it. Without one the rule of the road holds only where none is painted: that an arrow was not found may
mean that it is worn or hidden. How many lanes have arrows is seen in the map itself, and so is what arrows of lanes in
the same place of their approach say; where the map has none, what is usual counts.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ..map_records import VectorMap


@dataclass(frozen=True)
class ConfidenceLimits:
    """Shares that the confidence starts from."""

    # A lane's arrow, or one that leaves no other choice beside it, is right: 59 of 60 of the told kinds.
    arrow: float = 0.98
    # Without arrows a movement of the rule of the road is allowed; signs forbid the others.
    lawful: float = 0.97
    # The one lane of an approach whose arrow is not told leads straight on where the road does and no other lane may:
    # else nobody could go there.
    only_straight: float = 0.95
    # A painted arrow before a stop line is found at least so often (36 to 75 % of single ones).
    found: float = 0.45
    # What is usual counts as so many lanes with arrows.
    weight: float = 2.0


LIMITS = ConfidenceLimits()

USUAL = {
    ("only", "straight"): 0.9, ("only", "left"): 0.7, ("only", "right"): 0.7,
    ("left", "straight"): 0.7, ("left", "left"): 0.8,
    ("right", "straight"): 0.6, ("right", "right"): 0.8,
    ("middle", "straight"): 0.95,
}
"""Share of the lanes with arrows whose arrow allows a turn, by the lane's place in its approach."""


@dataclass(frozen=True)
class ArrowStatistics:
    """What the arrows of all approaches of a map say.

    Attributes
    ----------
    lanes : number of lanes that end at junctions.
    with_arrow : number of those with an arrow of any kind.
    with_turns : number of lanes whose arrow is told, by place in the approach.
    allowed : number of those that allow a turn, by place and turn.
    """

    lanes: int = 0
    with_arrow: int = 0
    with_turns: Mapping[str, int] = field(default_factory=dict)
    allowed: Mapping[tuple[str, str], int] = field(default_factory=dict)

    def painted(self) -> float:
        """How likely arrows are painted on a lane where none was found."""
        # Cities have arrows before most of their junctions or before none: a prior with its weight at both ends.
        share = min((self.with_arrow + 0.25) / (self.lanes + 0.5) / LIMITS.found, 1.0)
        missed = share * (1.0 - LIMITS.found)
        return missed / (1.0 - share + missed)

    def by_arrows(self, place: str, turn: str) -> float:
        """How likely an arrow that is painted but not told allows a turn, at least: less one sigma of the share, as few
        arrows tell little."""
        usual, number = USUAL.get((place, turn), 0.0) * LIMITS.weight, self.with_turns.get(place, 0) + LIMITS.weight
        share = (self.allowed.get((place, turn), 0) + usual) / number
        return max(share - math.sqrt(share * (1.0 - share) / (number + 1.0)), 0.0)


def arrow_statistics(built: VectorMap, approaches: Sequence[Sequence[int]],
                     turns_of: Mapping[int, set[str]]) -> ArrowStatistics:
    """Statistics of the lanes of approaches (numbers from left to right) with the turns that their arrows tell."""
    with_turns: dict[str, int] = {}
    allowed: dict[tuple[str, str], int] = {}
    for approach in approaches:
        for lane in approach:
            where = place_of(approach, lane)
            with_turns[where] = with_turns.get(where, 0) + bool(turns_of[lane])
            for turn in turns_of[lane]:
                allowed[where, turn] = allowed.get((where, turn), 0) + 1
    lanes = [lane for approach in approaches for lane in approach]
    with_arrow = sum(has_arrow(built, lane) or bool(turns_of[lane]) for lane in lanes)
    return ArrowStatistics(len(lanes), with_arrow, with_turns, allowed)


def place_of(approach: Sequence[int], lane: int) -> str:
    """Place of a lane in its approach: "only", "left", "middle" or "right"."""
    if len(approach) == 1:
        return "only"
    return "left" if lane == approach[0] else "right" if lane == approach[-1] else "middle"


def has_arrow(built: VectorMap, lane: int) -> bool:
    """Whether a lane has an arrow, also one of unknown kind."""
    return bool(built.lanes[lane].arrows)


def forced_turns(approach: Sequence[int], turns_of: Mapping[int, set[str]]) -> dict[int, set[str]]:
    """The one turn left to lanes without a told arrow: left of a lane that may turn left, right of one that may turn
    right."""
    forced = {}
    for k, lane in enumerate(approach):
        to_the_right = [turns_of[other] for other in approach[k + 1:]]
        to_the_left = [turns_of[other] for other in approach[:k]]
        if not turns_of[lane] and any("left" in turns for turns in to_the_right):
            forced[lane] = {"left"}
        elif not turns_of[lane] and any("right" in turns for turns in to_the_left):
            forced[lane] = {"right"}
    return forced


def rule_confidence(statistics: ArrowStatistics, built: VectorMap, approach: Sequence[int], lane: int, turn: str,
                    turns_of: Mapping[int, set[str]]) -> float:
    """How likely a movement of the rule of the road is allowed for a lane whose arrow is not told, where a road lies
    to that side."""
    others = [turns_of[other] for other in approach if other != lane]
    if turn == "straight" and others and all(others) and not any("straight" in turns for turns in others):
        return LIMITS.only_straight
    # Where another lane of the approach has a told arrow this one has arrows too.
    painted = 1.0 if any(others) or has_arrow(built, lane) else statistics.painted()
    by_arrows = statistics.by_arrows(place_of(approach, lane), turn)
    return painted * by_arrows + (1.0 - painted) * LIMITS.lawful
