"""Values that city models write where one is not known: PLATEAU wants an element to be there all the same.

Source: the standard product specification of 3D city models (Project PLATEAU), values for "unknown" by their type.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import Any

UNKNOWN_VALUES: tuple[tuple[str, frozenset], ...] = (
    ("", frozenset({-9999.0, -99999.0, "0001-01-01"})),
    ("height|storeys|year", frozenset({9999.0, 99999.0})),
    ("year", frozenset({1.0})),
)
"""What the name of an attribute holds (all, where that is empty), and what stands for "unknown" in such: numbers, which
a text may write in any way ("0001", "-9999.00"), and texts."""

UNKNOWN_HEIGHT = -9999.0
"""Height of a corner of which the height is not known, m."""


def known_attributes(plain: Any, name: str = "") -> Any:
    """Attributes as JSON has them, with null for what stands for "unknown", at any depth."""
    if isinstance(plain, dict):
        return {key: known_attributes(value, key) for key, value in plain.items()}
    return [known_attributes(value, name) for value in plain] if isinstance(plain, list) else known_value(
        name, plain, Counter())


def known_value(name: str, value: Any, unknown: Counter) -> Any:
    """A number or text, or None where it stands for "unknown", which is counted under the attribute's name."""
    try:
        plain = float(value)
    except (TypeError, ValueError):
        plain = value
    if isinstance(value, (str, int, float)) and any(
            plain in values and re.search(words, name, re.IGNORECASE) for words, values in UNKNOWN_VALUES):
        unknown[name] += 1
        return None
    return value
