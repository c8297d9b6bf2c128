"""X and Y in tables with Japanese names: in the plane rectangular system X counts north, in most programs east.

Which it is, the names tell ("X座標(北)", "平面直角X"), or numbers that only one order explains; where neither does, the
reader asks what else it knows (a vehicle's headings), and then the table is left to the user and its preview.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...wording import say

NORTH_WORDS, EAST_WORDS = ("北", "n", "north", "南北", "北距"), ("東", "e", "east", "東西", "東距")

_BRACKETS = re.compile(r"[(\[<]([^(\[<)\]>]*)[)\]>]")
_AXIS = re.compile(r"(?P<whose>計測|成果|基準|参照|真)?(?P<plane>平面直角(?:座標)?系?|公共座標系?|第?\d+系)?"
                   r"(?:(?P<before>[xy])(?P<written>座標値?)?|座標値?(?P<behind>[xy]))(?P<also>計測|成果|基準|参照|真)?")
_JAPANESE = re.compile("[\u3040-\u30ff\u3400-\u9fff]")
_AS_TRUE = ("成果", "真")  # of the place itself, which has no word before it
_UTM_EAST, _UTM_NORTH = (1e5, 9e5), (1.1e6, 1e7)  # m; no easting is as large, no plane system of Japan either
_NEAR, _FAR = 200.0, 10.0  # m, between two places of a point, and how many times more the wrong order must be off


@dataclass(frozen=True)
class NamedAxis:
    """A column named as X or Y.

    Attributes
    ----------
    letter : "x" or "y".
    whose : "" for the place itself, else the word before it, such as "計測" (measured).
    north : whether its name says that it counts north; None where it does not say.
    """

    letter: str
    whose: str
    north: bool | None

    def counts(self, x_north: bool) -> str:
        """The name of a column that counts so, as tables with Japanese names have it: "計測北"."""
        return self.whose + ("北" if (self.letter == "x") == x_north else "東")

    @property
    def x_north(self) -> bool | None:
        """Whether X counts north by this name."""
        return None if self.north is None else self.north == (self.letter == "x")


def named_axes(names: Collection[object]) -> dict[object, NamedAxis]:
    """The columns that are X or Y of a Japanese table, by their name.

    Capital X and Y alone count as such beside names in Japanese; x and y are the project's own, east and north.
    """
    texts = {name: unicodedata.normalize("NFKC", str(name)) for name in names}
    japanese = any(_JAPANESE.search(text) for text in texts.values())
    found = {name: _axis(text, japanese) for name, text in texts.items()}
    return {name: axis for name, axis in found.items() if axis is not None}


def _axis(text: str, japanese: bool) -> NamedAxis | None:
    bare = _BRACKETS.sub("", text)
    match = _AXIS.fullmatch(re.sub(r"[\s_\-.:]+", "", bare).lower())
    if match is None:
        return None
    letter, whose = match["before"] or match["behind"], match["whose"] or match["also"] or ""
    words = {word.strip().lower() for word in _BRACKETS.findall(text)}
    north = True if words & set(NORTH_WORDS) else False if words & set(EAST_WORDS) else None
    plain = not (whose or match["plane"] or match["written"] or match["behind"])
    if plain and north is None and not (japanese and bare.strip() in ("X", "Y")):
        return None
    if north is None and match["plane"]:
        north = letter == "x"
    return NamedAxis(letter, "" if whose in _AS_TRUE else whose, north)


def stated_order(axes: Mapping[object, NamedAxis]) -> bool | None:
    """Whether X counts north by the names; None where they do not say, or contradict each other."""
    said = {axis.x_north for axis in axes.values()} - {None}
    return said.pop() if len(said) == 1 else None


def x_counts_north(names: Collection[str], known: Mapping[str, str]) -> bool | None:
    """Whether X counts north in a table, by its names and the `known` ones of them; None where none is named X or Y."""
    axis = named_axes(names).get(known.get("x"))
    return None if axis is None else axis.letter == "y"


def order_note(known: Mapping[str, str], name: str) -> str:
    """What such columns of a file were taken for, a sentence."""
    return say("{name}: {north} counts north and {east} east, by the names, the numbers or the headings of the table; "
               "if that is wrong, call the columns “東” and “北”.", name=name, north=known["y"], east=known["x"])


def order_of_numbers(axes: Mapping[object, NamedAxis], columns: Mapping[object, Sequence],
                     others: Mapping[str, Sequence]) -> bool | None:
    """Whether X counts north by numbers that only one order explains; None where both are possible.

    Parameters
    ----------
    others : values of columns that are surely east and north, by "東", "計測東" and so on: places of the same points.
    """
    pairs = _pairs(axes)
    for keys in pairs.values():
        x, y = (_numbers(columns[key]) for key in keys)
        by_utm = _utm_order(x, y)
        if by_utm is not None:
            return by_utm
        for whose in {name[:-1] for name in others}:
            east, north = (_numbers(others.get(whose + word, ())) for word in "東北")
            if len(east) == len(north) == len(x) == len(y):
                off = {x_north: _distance(*((y, x) if x_north else (x, y)), east, north) for x_north in (True, False)}
                better = min(off, key=lambda order: off[order])
                if off[better] <= _NEAR and off[not better] > _FAR * max(off[better], _NEAR):
                    return better
    return None


def _pairs(axes: Mapping[object, NamedAxis]) -> dict[str, tuple[object, object]]:
    """Columns of X and Y by whose they are."""
    found: dict[str, dict[str, object]] = {}
    for key, axis in axes.items():
        found.setdefault(axis.whose, {}).setdefault(axis.letter, key)
    return {whose: (pair["x"], pair["y"]) for whose, pair in found.items() if len(pair) == 2}


def _numbers(values: Sequence) -> np.ndarray:
    """Values as numbers, NaN for what is none."""
    numbers = []
    for value in values:
        try:
            numbers.append(float(value))
        except (TypeError, ValueError):
            numbers.append(np.nan)
    return np.array(numbers)


def _utm_order(x: np.ndarray, y: np.ndarray) -> bool | None:
    """Whether X counts north by the size of UTM's numbers, m."""
    def all_within(values: np.ndarray, limits: tuple[float, float]) -> bool:
        sizes = np.abs(values[np.isfinite(values)])
        return bool(len(sizes)) and bool(((sizes >= limits[0]) & (sizes <= limits[1])).all())

    if all_within(x, _UTM_EAST) and all_within(y, _UTM_NORTH):
        return False
    return True if all_within(y, _UTM_EAST) and all_within(x, _UTM_NORTH) else None


def _distance(east: np.ndarray, north: np.ndarray, other_east: np.ndarray, other_north: np.ndarray) -> float:
    """Median distance, m, between two places of points; endless where none has both."""
    distance = np.hypot(east - other_east, north - other_north)
    distance = distance[np.isfinite(distance)]
    return float(np.median(distance)) if len(distance) else np.inf
