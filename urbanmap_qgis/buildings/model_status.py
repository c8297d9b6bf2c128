"""The statuses of building models, one list with reasons, and the quality figure that sorts models."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ..wording import say

OK = "ok"
NOT_MODELLED, SIMPLIFIED, BLOCK = "not modelled", "simplified", "plain block"
POOR_FIT, LOST_ROOFS, LOW, GROUND_UNKNOWN = "points not explained", "lost roofs", "low", "ground unknown"
PARTLY_MODELLED, UNSEEN, FEW_POINTS, SMALL = "partly modelled", "partly unseen", "few points", "small"
CLOUD_EDGE = "cloud's edge"

STATUSES = {
    NOT_MODELLED: "no points, no roof, no outline, or no valid solid could be made",
    SIMPLIFIED: "level roofs or one height for all, as the detailed solid was not valid or did not fit",
    BLOCK: "too few points for roofs: one height for the whole outline",
    POOR_FIT: "many points that can be roof lie far from the model: roofs are missing or metres off",
    LOST_ROOFS: "a roof found in the points is not in the model",
    LOW: "lower than a storey over the ground: a deck, a platform, or ground taken for a roof",
    GROUND_UNKNOWN: "its ground is not known: taken from neighbours, or put under the lowest roof",
    PARTLY_MODELLED: "a large part of the outline has no model",
    CLOUD_EDGE: "the point cloud ends in the building: what lies beyond is not seen",
    UNSEEN: "a large part of the plan has no roof points",
    FEW_POINTS: "so few points that parts of the roof cannot be separated",
    SMALL: "a plan too small for the shape of a roof to be seen",
    OK: "a valid solid from its roofs, near all of its points",
}
"""Every status and what it says, the gravest first: a model has the first one that holds; `reason` tells all."""

MAX_NOT_EXPLAINED = 0.25
"""Share of the candidate points farther than `quality.EXPLAINED` from the model from which the fit is poor."""

MAX_RMSE, MAX_RMSE_SLOPED = 1.0, 0.5
"""RMSE of height (m) of the best 95 % of the candidate points from which the fit is poor: of level roofs, which cut
slopes into steps, and of roofs that may slope."""

LOST_AREA = 4.0
"""Area (m2) of a roof without a polygon from which it is lost, where no other surface explains its points."""

MIN_HEIGHT = 1.5
"""Height (m) over the ground below which nothing is called a sound building."""

MAX_UNMODELLED, MAX_UNSEEN = 0.25, 0.4
"""Shares of the outline without a model, and of the plan without points, from which a model says so."""

MAX_UNSEEN_EXACT, MAX_BEYOND = 0.1, 0.02
"""Shares of the plan farther than two spacings of the cloud from a roof point, where the cloud's density is known, and
of the outline beyond the cloud's edge, from which a model says so."""

MIN_POINTS, MIN_AREA = 25, 6.0
"""Points and plan area (m2) below which a building is told apart."""

LEAST_EXPLAINED = 1e-3
"""Share of explained points that the quality counts at least."""

TOWER = 30.0
"""Height (m) over the ground from which a building is called a tower where it is higher than wide."""


@dataclass(frozen=True)
class ModelFacts:
    """What a status is judged by; NaN where not known.

    Attributes
    ----------
    height : of the highest roof over the ground, m.
    area, outline_area : of the plan and of the outline, m2.
    points : candidate points.
    not_explained, unseen : shares.
    rmse_z95 : of the candidate points, m.
    lost_roofs : a roof found in the points has no polygon.
    curved : the outline has curved walls.
    beyond : share of the outline beyond the cloud's edge.
    most_unseen : share of the plan that may be unseen.
    most_rmse : `rmse_z95` that the model may have, m.
    """

    height: float
    area: float
    outline_area: float
    points: float
    not_explained: float
    unseen: float
    rmse_z95: float
    lost_roofs: bool = False
    curved: bool = False
    beyond: float = math.nan
    most_unseen: float = MAX_UNSEEN
    most_rmse: float = MAX_RMSE


def judge(status: str, reason: str, facts: ModelFacts) -> tuple[str, str]:
    """Status and reasons of a model, from those that its making gave and from the facts."""
    found = [(status, reason)] if status != OK else []
    notes = [reason] if status == OK and reason else []
    found += list(_flaws(facts))
    if facts.height >= TOWER and facts.height > math.sqrt(facts.area):
        notes.append(say("a tower, {height:.0f} m high", height=facts.height))
    if facts.curved:
        notes.append(say("curved walls are drawn as short straight ones"))
    order = list(STATUSES)
    found.sort(key=lambda flaw: order.index(flaw[0]))
    texts = [text for _, text in found if text] + notes
    return (found[0][0] if found else OK), "; ".join(dict.fromkeys(texts))


def _flaws(facts: ModelFacts):
    """Statuses that the facts give, with their reasons."""
    if facts.not_explained > MAX_NOT_EXPLAINED or facts.rmse_z95 > facts.most_rmse:
        yield POOR_FIT, (say("{not_explained:.0f} % of the points that can be roof are not explained by the model, "
                             "RMSE of height (best 95 %) {rmse_z95:.1f} m", not_explained=100 * facts.not_explained,
                             rmse_z95=facts.rmse_z95))
    if facts.lost_roofs:
        yield LOST_ROOFS, say("a roof found in its points has no polygon")
    if facts.height < MIN_HEIGHT:
        yield LOW, say("only {height:.2f} m over the ground", height=facts.height)
    if facts.area < (1 - MAX_UNMODELLED) * facts.outline_area:
        yield PARTLY_MODELLED, say("{area:.0f} % of its outline has no model",
                                   area=100 * (1 - facts.area / facts.outline_area))
    if facts.beyond > MAX_BEYOND:
        yield CLOUD_EDGE, say("the point cloud ends in it: {beyond:.0f} % of its outline lies beyond",
                              beyond=100 * facts.beyond)
    if facts.unseen > facts.most_unseen:
        yield UNSEEN, say("{unseen:.0f} % of its plan has no roof points", unseen=100 * facts.unseen)
    if facts.points < MIN_POINTS:
        yield FEW_POINTS, say("only {points:.0f} points", points=facts.points)
    if facts.area < MIN_AREA:
        yield SMALL, say("only {area:.1f} m2", area=facts.area)


def quality(status: str, rmse_z: float, rmse_z95: float, not_explained: float, unseen: float,
            doubt: float = math.nan) -> float:
    """Quality of a model, 0 to 1: its expected closeness to the roofs, by which models can be sorted.

    A figure of fit to all candidate points, lowered by what is not explained and not seen. 0 without a model and
    where no point lies over it, NaN where no points were given. The weights are those of the best rank correlation with
    the true error on Delft, see `docs/buildings.md`; 0.5 stands for about half a metre.

    Parameters
    ----------
    rmse_z, rmse_z95 : RMSE of height of all candidate points and of the best 95 %, m.
    not_explained, unseen : shares.
    doubt : expected height error by what is not seen, m (`SeenRoofs.doubt`), which then stands for `unseen`; NaN where
        the density of the cloud is not known.
    """
    if status == NOT_MODELLED:
        return 0.0
    if not math.isfinite(rmse_z95):
        return math.nan if math.isnan(doubt) else 0.0
    if math.isnan(doubt):
        return math.exp(-rmse_z95 - 0.3 * rmse_z) * (1 - not_explained) ** 0.5 * (1 - 0.25 * unseen)
    fit = rmse_z95 + 0.3 * rmse_z - 0.5 * math.log(max(1 - not_explained, LEAST_EXPLAINED))
    return math.exp(-math.hypot(fit, doubt))


def counts(statuses: Sequence[str]) -> dict[str, int]:
    """Number of models of each status, all of the list, the sound ones first."""
    found = list(statuses)
    return {status: found.count(status) for status in reversed(STATUSES)}
