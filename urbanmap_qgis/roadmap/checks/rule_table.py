"""The rules of lane maps as a table: code, severity, kind of element, source and text in English and Japanese.

``rules.tsv`` beside this module holds them. Codes, severities and kinds of elements of "Autoware" are those of its
lanelet2_map_validator, of "Lanelet2" those of lanelet2_validation or what the library refuses to load; "UrbanMap" are
our own. A rule's function (`rule`) says only which elements break it, with the fields of the text.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from ...wording import language

SEVERITIES = ("error", "warning", "info")


@dataclass(frozen=True)
class MapRule:
    """One row.

    Attributes
    ----------
    code, severity : see there.
    primitive : kind of element that it looks at.
    source : who asks for it.
    text, japanese : sentence on an element that breaks it, with named fields.
    """

    code: str
    severity: str
    primitive: str
    source: str
    text: str
    japanese: str

    def sentence(self, fields: Mapping[str, object]) -> str:
        """The text in the user's language with its fields filled."""
        return (self.japanese if language() == "ja" else self.text).format(**fields)


@dataclass(frozen=True)
class Broken:
    """An element that breaks a rule: its kind ("node", "way", "relation"), id, and the fields of the rule's text."""

    kind: str
    number: int
    fields: Mapping[str, object]


def broken(kind: str, number: int, /, **fields: object) -> Broken:
    """An element that breaks a rule."""
    return Broken(kind, number, fields)


RuleFunction = Callable[..., Iterator[Broken]]
_functions: dict[str, RuleFunction] = {}


def rule(*codes: str) -> Callable[[RuleFunction], RuleFunction]:
    """Register the function of one rule; of several that differ by a word, it takes their number as second argument."""
    def registered(function: RuleFunction) -> RuleFunction:
        for code in codes:
            if code not in map_rules() or code in _functions:
                raise KeyError(code)
            _functions[code] = function
        return function
    return registered


def rule_functions() -> Mapping[str, RuleFunction]:
    """The functions by their rules' codes."""
    return _functions


@lru_cache(maxsize=1)
def map_rules() -> Mapping[str, MapRule]:
    """All rules by their codes, in the order of the table."""
    with open(Path(__file__).with_name("rules.tsv"), encoding="utf-8", newline="") as table:
        return {row["code"]: MapRule(**row) for row in csv.DictReader(table, delimiter="\t", quoting=csv.QUOTE_NONE)}
