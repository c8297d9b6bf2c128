"""What the PDF of an acceptance shows, by the ids of the places in its layout."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..io.pages.svg import bars
from ..wording import known
from .criteria import OUTCOMES, Criterion

Drawing = Callable[..., str]
"""A drawing (SVG) by its `width` and `height`, pixels (both may be left out): it takes the shape of the room that the
page has for it."""


@dataclass(frozen=True)
class PdfContent:
    """Texts, tables and pictures by the ids of their items.

    Attributes
    ----------
    labels : texts.
    tables : rows of texts, the head first.
    drawings : None where there is nothing to draw.
    map_shape : height by width of the map that leaves no empty bands.
    """

    labels: Mapping[str, str]
    tables: Mapping[str, list[list[str]]]
    drawings: Mapping[str, Drawing | None]
    map_shape: float


def metres(value: float) -> str:
    """A length in a table, m; a dash where it is not known."""
    return f"{round(value, 3) + 0.0:.3f}" if math.isfinite(value) else "–"


def criterion_row(item: Criterion) -> list[str]:
    """A criterion as a row of a table: what, number, figure, limit, upper bound, outcome."""
    return [" ".join(part for part in (item.unit, known(item.component)) if part), str(item.figures.count),
            metres(item.figures.rmse), metres(item.limit), metres(item.figures.bound), known(OUTCOMES[item.outcome])]


def histogram_of(values: np.ndarray, words: str) -> Drawing | None:
    """How errors (n,) m are spread; None where none is known."""
    finite = values[np.isfinite(values)]
    if not len(finite):
        return None
    low, high = min(0.0, float(finite.min())), float(finite.max())
    counts, edges = np.histogram(finite, bins=16, range=(low, max(high, low + 1e-3)))
    return partial(bars, counts, edges, f"{words} (m)")
