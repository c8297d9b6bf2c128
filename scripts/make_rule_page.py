#!/usr/bin/env python3
"""Write the documentation's page of the lane map's rules, docs/map_rules.md, from their table.

    python3 scripts/make_rule_page.py
"""

from __future__ import annotations

import sys
from itertools import groupby
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from urbanmap_qgis.roadmap.checks.rule_table import map_rules  # noqa: E402

PAGE = ROOT / "docs" / "map_rules.md"

HEAD = """# Rules of lane maps

What [checkvectormap](algorithms/checkvectormap.md) looks at, made by `scripts/make_rule_page.py` from
`urbanmap_qgis/roadmap/checks/rules.tsv`. To leave rules out, give their codes, or the begin of several
(`Lane.BorderSharing, mapping.`), as `EXCLUDE`. Codes and severities are those of Autoware's lanelet2_map_validator
(source Autoware) and of lanelet2_validation or the Lanelet2 library (source Lanelet2); rules of source UrbanMap are our
own. Left out are four rules that Autoware has discontinued (Crosswalk.RegulatoryElementDetails-004, -005, -008 and
Lane.RoadShoulder-002), and what needs other files than the map. Traffic is taken to keep to the left where a rule asks
who turns across whom, as in Autoware.
"""


def rules_page() -> str:
    """The page as Markdown, a table for each group of codes."""
    lines = [HEAD]
    for group, rules in groupby(map_rules().values(), key=lambda rule: rule.code.split(".")[0]):
        lines += [f"## {group}", "", "| code | severity | looks at | what is told | source |", "|---|---|---|---|---|"]
        lines += [f"| {rule.code} | {rule.severity} | {rule.primitive} | {rule.text.replace('{', '').replace('}', '')}"
                  f" | {rule.source} |" for rule in rules]
        lines.append("")
    return "\n".join(lines).rstrip() + "\n"


if __name__ == "__main__":
    PAGE.write_text(rules_page(), encoding="utf-8")
