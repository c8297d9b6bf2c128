"""What an upright thing is: how likely what hangs on its post is in the sizes that published standards give.

Each size of a thing has a likelihood under each design: even over the design's range, soft at its ends by how well it
is measured, and never nothing, as no list of designs is whole. A thing of no design says nothing about its post.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Optional

import numpy as np
from scipy.special import ndtr

from .boards import board_of
from .hanging_parts import HangingParts, hanging_parts
from .lone_boards import board_on
from .object_records import LAMP, POLE, SIGN, SIGNAL, TREE, Board, HangingThing, Stem, StemAxis

DESIGNS = (
    # Kind; ranges of width, depth, height, height of the lower edge, distance of its middle from the post's axis, and
    # of the axis from its plane, m. Of a head the face alone may show, or of one beside a post the side alone.
    # Japan: signals 警交仕規 245 and 247 (heads in a row, upright ones of snowy regions, walkers'), 4.5 m clear of the
    # road (道路構造令); Germany: RiLSA 2015, DIN EN 12368; United States: MUTCD 2009, 4D.11 to 4D.15, 4E.04, ITE VTCSH.
    (SIGNAL, (0.9, 1.3), (0.0, 0.35), (0.33, 0.7), (4.5, 6.5), (0.4, 8.0), (0.0, 5.0)),  # With brackets and arm.
    (SIGNAL, (0.25, 0.65), (0.0, 0.4), (0.85, 1.4), (4.4, 7.8), (0.3, 8.0), (0.0, 8.0)),
    (SIGNAL, (0.2, 0.45), (0.0, 0.4), (0.7, 1.2), (2.0, 4.5), (0.1, 0.7), (0.0, 0.7)),
    (SIGNAL, (0.2, 0.45), (0.0, 0.35), (0.65, 0.9), (2.2, 3.6), (0.1, 0.8), (0.0, 0.8)),
    (SIGNAL, (0.2, 0.5), (0.0, 0.35), (0.4, 0.65), (2.0, 3.2), (0.1, 0.6), (0.0, 0.6)),
    # Japan: 道路標識設置基準 2019 (discs and squares of 0.6 m, warnings with sides of 0.45 m, 1.8 m up, boards over the
    # road); Germany: VzKat 2017, HAV (0.42 to 0.9 m, 2 m up); United States: MUTCD 2009, 2A.18, 2A.19 (0.3 to 1.2 m).
    (SIGN, (0.3, 1.3), (0.0, 0.08), (0.3, 1.3), (0.9, 3.5), (0.0, 0.5), (0.0, 0.2)),
    (SIGN, (0.1, 0.6), (0.0, 0.08), (0.3, 1.3), (0.9, 3.5), (0.1, 0.6), (0.0, 0.12)),  # The half beside its post.
    (SIGN, (0.9, 3.6), (0.0, 0.4), (0.8, 2.5), (1.8, 3.5), (0.0, 2.0), (0.0, 0.4)),
    (SIGN, (0.9, 3.6), (0.0, 0.4), (0.6, 2.5), (4.4, 6.5), (0.0, 8.0), (0.0, 0.5)),
    # Japan: 道路照明施設設置基準 2007 (8 to 12 m); Germany: DIN EN 40, DIN 13201 (4 to 12 m, also on posts' tops);
    # United States: AASHTO GL-7 (9 to 15 m). On an arm, its end counts.
    (LAMP, (0.4, 0.9), (0.0, 0.5), (0.05, 0.3), (4.5, 15.0), (0.4, 4.5), (0.0, 0.5)),
    (LAMP, (0.3, 0.7), (0.05, 0.7), (0.15, 0.7), (2.8, 6.5), (0.0, 0.3), (0.0, 0.3)),
    # A strip of the post's own surface; cross-arms and transformers of poles: JIS C 3801, DIN EN 50341; anything else.
    (POLE, (0.0, 0.4), (0.0, 0.1), (0.2, 12.0), (0.5, 12.0), (0.03, 0.25), (0.03, 0.25)),
    (POLE, (0.8, 2.4), (0.0, 0.3), (0.05, 0.3), (5.0, 16.0), (0.0, 0.4), (0.0, 0.4)),
    (POLE, (0.0, 4.0), (0.0, 3.0), (0.0, 4.0), (0.5, 16.0), (0.0, 5.5), (0.0, 5.5)),
)

MEASURED_TO = (0.06, 0.03, 0.06, 0.15, 0.1, 0.05)
"""Standard deviations of the sizes, m: points end before edges do, and lie to either side of a face."""

UNLISTED, SPAN = 0.02, (4.0, 3.0, 4.0, 16.0, 8.0, 8.0)
"""Share of things whose size lies anywhere within a span, m."""

BARE = {POLE: 0.6, SIGN: 0.25, LAMP: 0.15}
"""Kinds of posts on which nothing shows: one drive misses a third of boards that are seen along their faces."""

TRUNK = 0.2
"""m, diameter from which a stem in leaves is a trunk, not the post of a sign that stands by."""

_KINDS = (SIGNAL, LAMP, SIGN, POLE)
_LOW, _HIGH = np.moveaxis(np.array([design[1:] for design in DESIGNS]), 2, 0)
_OF_KIND = np.array([[design[0] == kind for design in DESIGNS] for kind in _KINDS], float)
_OF_KIND /= _OF_KIND.sum(axis=1, keepdims=True)


def thing_kinds(things: Sequence[HangingThing]) -> np.ndarray:
    """How likely each of some things (n, 4) is of a signal, a lamp, a sign, or tells nothing; rows sum to one."""
    size = np.array([[*thing.sides, thing.low, thing.away, thing.aside] for thing in things]).reshape(-1, 1, len(SPAN))
    inside = (ndtr((size - _LOW) / MEASURED_TO) - ndtr((size - _HIGH) / MEASURED_TO)) / (_HIGH - _LOW)
    likely = ((1.0 - UNLISTED) * inside + UNLISTED / np.array(SPAN)).prod(axis=2) @ _OF_KIND.T
    return likely / likely.sum(axis=1, keepdims=True)


def kind_of(things: Sequence[HangingThing]) -> tuple[dict[str, float], HangingThing | None]:
    """How likely a post is of each kind, and the thing that tells the likeliest; None of a pole.

    A post with a signal is a signal, whatever else hangs on it; then lamps come before signs.
    """
    if not things:
        return BARE, None
    likely = thing_kinds(things)
    # Whether none is of the first kinds; what is none of the first is of the next by its share in the rest.
    none = np.prod(1.0 - np.cumsum(likely[:, :-1], axis=1), axis=0)
    kinds = dict(zip(_KINDS, -np.diff([1.0, *none.tolist(), 0.0])))
    best = max(kinds, key=kinds.__getitem__)
    return kinds, None if best == POLE else things[int(np.argmax(likely[:, _KINDS.index(best)]))]


Hung = tuple[HangingParts, dict[str, float], Optional[HangingThing], Optional[Board]]
"""What hangs on a stem, how likely that makes each kind, the thing that tells the likeliest, and its board."""


def hung_on(place: np.ndarray, height: np.ndarray, axis: StemAxis, stem: Stem, seen_from: np.ndarray,
            boards: list[Board]) -> Hung:
    """What hangs on a stem and tells its kind; parameters as in `hanging_parts`. `seen_from` (m, 2) where the stem was
    measured from, m; `boards` that were found by their faces alone, for posts that show none of their own."""
    around = hanging_parts(place, height, axis, stem.high)
    kinds, thing = kind_of(around.things)
    board = None
    if thing is not None and max(kinds, key=kinds.__getitem__) == SIGN:
        board = board_of(thing, place, axis, seen_from.mean(axis=0))
    elif thing is None and axis.diameter < TRUNK:
        board = board_on(boards, axis)
        kinds = kinds if board is None else {SIGN: 0.6, TREE if around.crown else POLE: 0.4}
    if around.crown and board is None:
        kinds = {TREE: min(0.6 + 0.1 * around.crown, 0.95)}
    return around, kinds, thing, board
