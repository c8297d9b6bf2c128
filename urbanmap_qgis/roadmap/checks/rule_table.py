"""The rules of lane maps as a table: code, severity, kind of element, source and text in English and Japanese.

``rules.tsv`` beside this module holds them. Codes, severities and kinds of elements of "Autoware" are those of its
lanelet2_map_validator, of "Lanelet2" those of lanelet2_validation or what the library refuses to load; "UrbanMap" are
our own. A rule's function (`rule`) says only which elements break it, with the fields of the text.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ...io.files.rule_table import SEVERITIES, CheckRule, RuleTable

__all__ = ["MAP_RULES", "SEVERITIES", "Broken", "MapRule", "broken", "map_rules", "rule"]

MapRule = CheckRule
MAP_RULES = RuleTable(Path(__file__).with_name("rules.tsv"))
rule = MAP_RULES.rule


@dataclass(frozen=True)
class Broken:
    """An element that breaks a rule: its kind ("node", "way", "relation"), id, and the fields of the rule's text."""

    kind: str
    number: int
    fields: Mapping[str, object]


def broken(kind: str, number: int, /, **fields: object) -> Broken:
    """An element that breaks a rule."""
    return Broken(kind, number, fields)


def map_rules() -> Mapping[str, MapRule]:
    """All rules by their codes, in the order of the table."""
    return MAP_RULES.rules
