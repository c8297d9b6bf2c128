#!/usr/bin/env python3
"""Write the documentation's pages of rules, docs/map_rules.md and docs/city_rules.md, from their tables.

    python3 scripts/make_rule_page.py
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable
from itertools import groupby
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from urbanmap_qgis.citymodel.checks.city_rule_table import CITY_RULES, NOT_CHECKED  # noqa: E402
from urbanmap_qgis.io.files.rule_table import CheckRule  # noqa: E402
from urbanmap_qgis.roadmap.checks.rule_table import map_rules  # noqa: E402

PAGE = ROOT / "docs" / "map_rules.md"
CITY_PAGE = ROOT / "docs" / "city_rules.md"

HEAD = """# Rules of lane maps

What [checkmodel](algorithms/checkmodel.md) looks at, made by `scripts/make_rule_page.py` from
`urbanmap_qgis/roadmap/checks/rules.tsv`. To leave rules out, give their codes, or the begin of several
(`Lane.BorderSharing, mapping.`), as `EXCLUDE`. Codes and severities are those of Autoware's lanelet2_map_validator
(source Autoware) and of lanelet2_validation or the Lanelet2 library (source Lanelet2); rules of source UrbanMap are our
own. Left out are four rules that Autoware has discontinued (Crosswalk.RegulatoryElementDetails-004, -005, -008 and
Lane.RoadShoulder-002), and what needs other files than the map. Traffic is taken to keep to the left where a rule asks
who turns across whom, as in Autoware.
"""


CITY_HEAD = """# Rules of city models

What [checkmodel](algorithms/checkmodel.md) looks at, made by `scripts/make_rule_page.py` from
`urbanmap_qgis/citymodel/checks/rules.tsv`. To leave rules out, give their codes, or the begin of several
(`L-bldg, D-`), as `EXCLUDE`. Codes are those of the standard product specification of 3D city models (Project PLATEAU)
5.0, chapter 6; a word after a full stop tells apart what is mended differently. Codes that begin with D are demands of
other chapters, whose numbers the source names; "PLATEAU practice" is what published data keep to without a sentence of
the specification. Where a data set brings no lists of codes (folder `codelists`), codes are compared with the lists
that the specification prints, and the names of lists with the type and property that they are for.

L-bldg-01 and L-bldg-12 compare solids by their plans and heights: what crosses a sloped roof from inside is not found.
L-bldg-10 looks at the surfaces that a solid refers to, as its faces' sides are known. L02 is looked at in values and
at the root; for the whole schema use an XML validator with the schemas of i-UR (the program depends on none).
"""


def _groups(rules: Iterable[CheckRule], key) -> list[str]:
    """A table for each group of codes."""
    lines = []
    for group, members in groupby(rules, key=key):
        lines += [f"## {group}", "", "| code | severity | looks at | what is told | source |", "|---|---|---|---|---|"]
        lines += [f"| {rule.code} | {rule.severity} | {rule.primitive} | {rule.text.replace('{', '').replace('}', '')}"
                  f" | {rule.source} |" for rule in members]
        lines.append("")
    return lines


def rules_page() -> str:
    """The page on lane maps as Markdown."""
    return "\n".join([HEAD, *_groups(map_rules().values(), lambda rule: rule.code.split(".")[0])]).rstrip() + "\n"


def city_rules_page() -> str:
    """The page on city models as Markdown, with what is not checked."""
    lines = [CITY_HEAD, *_groups(CITY_RULES.rules.values(), lambda rule: _chapter(rule.code)), "## Not checked", "",
             "| code | why |", "|---|---|", *(f"| {code} | {why} |" for code, why in NOT_CHECKED.items())]
    return "\n".join(lines) + "\n"


def _chapter(code: str) -> str:
    words = {"C": "Completeness", "L": "Logical consistency", "T": "Thematic accuracy", "D": "Data and deliveries"}
    return words[re.match("[A-Z]", code).group()]


if __name__ == "__main__":
    PAGE.write_text(rules_page(), encoding="utf-8")
    CITY_PAGE.write_text(city_rules_page(), encoding="utf-8")
