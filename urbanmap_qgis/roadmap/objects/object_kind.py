"""What an upright thing is, by what hangs on its stem, and how clearly."""

from __future__ import annotations

from dataclasses import dataclass

from .hanging_parts import HangingParts
from .object_records import LAMP, POLE, SIGN, SIGNAL, TREE, Board


@dataclass(frozen=True)
class KindLimits:
    """Limits of object kind, each with its unit."""

    lamp: float = 4.5  # m, lowest lamp
    signal: tuple[float, float] = (4.0, 7.5)  # m above the ground, heads of signals over a road
    head: tuple[float, float] = (0.3, 0.2)  # m: width and height, of what is larger than a lamp
    near_top: float = 1.5  # m below the top, where lamps hang
    crown: float = 1.0  # m, least diameter
    beside: float = 0.3  # m by which a board in a crown is wider than its post
    sign: float = 0.1  # m2, smallest board
    wider: float = 1.6  # than its stem, that a board is: posts in noise look flat


LIMITS = KindLimits()


def kind_of(around: HangingParts, diameter: float) -> tuple[str, float, Board | None]:
    """Kind, how clearly it shows (0 to 1), and the board that makes it a sign; `diameter` of the stem, m."""
    board = around.board
    if around.crown >= LIMITS.crown and board is not None and board.width > diameter + LIMITS.beside:
        return SIGN, 0.6, board
    if around.crown >= LIMITS.crown:
        return TREE, min(0.6 + 0.1 * around.crown, 0.95), None
    if around.overhead:
        return SIGN, 0.6, board
    if around.arm > 1.0 and LIMITS.signal[0] < around.arm_height < LIMITS.signal[1] and all(
            size > least for size, least in zip(around.head, LIMITS.head)):
        return SIGNAL, 0.8, None
    if around.arm > 0.0 and around.arm_height > max(LIMITS.lamp, around.top - LIMITS.near_top):
        return LAMP, 0.8, None
    if board is not None and board.width * board.height > LIMITS.sign and board.width > LIMITS.wider * diameter:
        return SIGN, 0.8, board
    return POLE, 0.6, None
