"""The lists of codes of the standard product specification of 3D city models (Project PLATEAU) 5.0.

``code_lists.tsv`` beside this module: names of the lists that 4.2, 4.3, 4.14 and 4.25 name, with the codes that they
print; without codes where a city makes or changes the list, or another document has it. They serve where a data set
brings no lists of its own.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path


@lru_cache(maxsize=1)
def standard_lists() -> Mapping[str, frozenset[str]]:
    """Codes by list; empty where they are not known."""
    with open(Path(__file__).with_name("code_lists.tsv"), encoding="utf-8", newline="") as table:
        return {row["list"]: frozenset(row["codes"].split()) for row in csv.DictReader(table, delimiter="\t")}


DESIGNATED_CITIES = frozenset((
    "01100", "04100", "11100", "12100", "14100", "14130", "14150", "15100", "22100", "22130", "23100", "26100", "27100",
    "27140", "28100", "33100", "34100", "40100", "40130", "43100"))
"""Codes (JIS X 0402) of the cities that are divided into wards: buildings have their ward's code."""


def could_be_municipality(code: str) -> bool:
    """Whether five digits have the form of a municipality's code: a prefecture 01 to 47 (JIS X 0401) and a number
    100 to 799 in it (JIS X 0402)."""
    return len(code) == 5 and code.isdigit() and 1 <= int(code[:2]) <= 47 and 100 <= int(code[2:]) <= 799
