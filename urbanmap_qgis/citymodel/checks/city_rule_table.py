"""The rules of city models as a table: code, severity, what it looks at, source and text in English and Japanese.

``rules.tsv`` beside this module holds them. Codes C, L and T are those of the standard product specification of 3D city
models (Project PLATEAU) 5.0, chapter 6; where one requirement is broken in ways that a surveyor mends differently, a
word after a full stop tells them apart (``L14.closed``). Codes that begin with D are demands that other
chapters of the specification make on data and deliveries. A rule's function says only which elements break it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ...io.files.rule_table import RuleTable
from .feature_walk import CityFeature

CITY_RULES = RuleTable(Path(__file__).with_name("rules.tsv"))
city_rule = CITY_RULES.rule

NOT_CHECKED = {
    "C02": "needs the reference data; the table of instances has the numbers to compare",
    "C03": "needs the reference data and eyes",
    "C06": "needs the city's own list of attributes",
    "C-bldg-02": "needs the BIM model", "C-bldg-03": "needs the BIM model and eyes",
    "C-bldg-04": "needs the BIM model and eyes",
    "L02": "only in part: the root, values and coordinates; the schema needs a validator",
    "T01": "needs the reference data and eyes", "T02": "needs the reference data and eyes",
    "T-bldg-01": "needs the reference data and eyes"}
"""Requirements of the specification that are not checked or only in part, and why."""


@dataclass(frozen=True)
class Violation:
    """An element that breaks a rule.

    Attributes
    ----------
    feature : the city object; None for a file as a whole.
    fields : of the rule's text.
    lod : level of detail of the geometry, None where it has none.
    place : (longitude or x, latitude or y) of the thing; None for the feature's own.
    """

    feature: CityFeature | None
    fields: Mapping[str, object] = field(default_factory=dict)
    lod: int | None = None
    place: tuple[float, float] | None = None


def violation(feature: CityFeature | None, lod: int | None = None, place: tuple[float, float] | None = None,
              **fields: object) -> Violation:
    """An element that breaks a rule, with the fields of the rule's text."""
    return Violation(feature, fields, lod, place)
