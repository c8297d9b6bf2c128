"""Settings of walls from a mobile survey (J 5.7)."""

from __future__ import annotations

from .declaration import Settings, record, setting

MAIN, OUTERMOST = "main", "outermost"
"""Which wall is wanted where a building has balconies: the one behind them, or their fronts."""


@record(frozen=True)
class WallSettings(Settings):
    """Which points are a wall's, how walls are told apart and their contours drawn.

    Attributes
    ----------
    max_points : a building with more points is thinned at random to about so many, and says so.
    alpha : radius of the circle that no gap within a wall may hold, m; 0: three times the points' spacing.
    """

    max_height: float = setting(
        20.0, "Maximum height", "Height in metres above the ground up to which points are used.", "m", 1.0, 500.0)
    front: str = setting(
        MAIN, "Front with balconies", "Which wall of a building is wanted where balconies stand before it. main: the "
        "wall behind them; outermost: the fronts of the balconies. Where storeys stand on columns, it is their wall in "
        "both.", choices=(MAIN, OUTERMOST))
    reach: float = setting(
        2.0, "Tolerance of the outlines", "How far the outlines may be off, in metres: walls are looked for up to this "
        "far from the edges. Inside, setbacks are found at any distance.", "m", 0.25, 6.0, advanced=True)
    min_area: float = setting(
        3.0, "Minimum area of a wall", "Smaller pieces are left out.", "m2", 0.25, 1000.0, advanced=True)
    tolerance: float = setting(
        0.08, "Tolerance", "Maximum distance in metres of a wall's points, on the mean of 30 cm, from its plane.", "m",
        0.01, 0.5, advanced=True)
    max_gap: float = setting(
        1.5, "Maximum gap", "A wall may be interrupted by up to so many metres.", "m", 0.0, 20.0, alias="GAP",
        advanced=True)
    min_opening: float = setting(
        0.5, "Minimum opening", "Smaller holes in a contour are filled, and their share is reported.", "m2", 0.0, 100.0,
        advanced=True)
    max_points: int = 4_000_000
    alpha: float = 0.0
