"""Numbers that keep arithmetic sound, each once: none of them is a choice about cities or surveys."""

from __future__ import annotations

LEAST_DIVISOR = 1e-9
"""Stands for zero below a fraction: what has no length (m), area (m2) or weight gets direction or share 0, not NaN."""

LEAST_SQUARE = 1e-12
"""The same for squares of lengths, m2, and for what is scaled like them."""

ROUNDING = 1e-9
"""By which a quotient may miss a whole number, or a sum its bound, by the rounding of doubles alone."""

SAME_PLACE = 1e-6
"""Coordinates nearer than this are one, m: doubles at a map's millions of metres are good to a thousandth of it."""

MILLIMETRE = 1e-3
"""Corners of faces that lie closer together than this are one vertex, m."""

GRID = 0.01
"""Nodes of plans that are cut out of each other lie on multiples of this, m."""

LEAST_FACE = 1e-4
"""Smaller faces are what the rounding of an overlay leaves, or upright ones seen in plan, m2."""

UNITS = 10_000
"""A metre in whole tenths of a millimetre: integer coordinates and heights are exact, and finer than any survey."""

SIGMA_OF_MAD = 1.4826
"""Standard deviation of a normal distribution over its median absolute deviation, 1 / 0.6745."""

OFF_THE_EARTH = 1e9
"""No map's coordinates on the earth are as great, m or feet: such a corner is damaged."""
