"""Columns that tables of control points have in common: numbers that may be missing, and what a point is for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...errors import InputError
from ...wording import say

_CHECKS = ("check", "検証点", "検証")
_CONTROLS = ("", "control", "adjusted", "調整点", "標定点")


def column_numbers(texts: Sequence[str], column: str, name: str, needed: bool = False) -> np.ndarray:
    """A column (n,) as numbers; NaN where it is empty and not `needed`.

    Raises
    ------
    InputError : a value is no number, or a needed one is missing; it names the row of the file `name`.
    """
    found = np.full(len(texts), np.nan)
    for row, text in enumerate(texts):
        try:
            found[row] = float(text) if text or needed else np.nan
        except ValueError:
            found[row] = np.inf
        if np.isinf(found[row]) or (needed and np.isnan(found[row])):
            raise InputError(say("{name} has no number for {column} in row {row}: correct or remove it.", name=name,
                                 column=column, row=row + 2))
    return found


def check_rows(columns: Mapping[str, Sequence[str]], known: Mapping[str, str], count: int, name: str) -> np.ndarray:
    """(count,) rows whose points are only compared, by the column “role” where there is one.

    Raises
    ------
    InputError : a role is not known.
    """
    texts = columns[known["role"]] if "role" in known else [""] * count
    roles = [text.lower() for text in texts]
    for text in roles:
        if text not in (*_CHECKS, *_CONTROLS):
            raise InputError(say("{name}: the role “{text}” is not known; write control or check.", name=name,
                                 text=text))
    return np.isin(roles, _CHECKS)
