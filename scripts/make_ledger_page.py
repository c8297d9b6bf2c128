#!/usr/bin/env python3
"""Write docs/ledger.md, what each correcting mechanism brings, from scripts/ledger.toml.

    python3 scripts/make_ledger_page.py
"""

from __future__ import annotations

import sys
from itertools import groupby
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.ablate import Ledger, Row, read_ledger  # noqa: E402

PAGE = ROOT / "docs" / "ledger.md"

HEAD = """# The ledger

What each mechanism that corrects an earlier step brings, made by `scripts/make_ledger_page.py` from
`scripts/ledger.toml`. `make ablate` switches them off in turn on the scenes they act on and prints every figure that
changes; `make ablate ROWS=edges` does one room, `ROWS="'short lines'"` one row. What changes no figure goes out.

- *earns*: figures are worse without it.
- *mixed*: some are better, some worse.
- *noise*: last digits change, in no direction.
- *no change*: no figure changes; it stays only where it prevents a wrong result that nobody would see.
- *open*: not run yet.
"""


def ledger_page(ledger: Ledger) -> str:
    """The page as Markdown."""
    lines = [HEAD, "## Scenes", "", "| scene | run |", "|---|---|",
             *(f"| {name} | `{command}` |" for name, command in ledger.scenes.items()), ""]
    for room, rows in groupby(ledger.rows, key=lambda row: row.room):
        lines += [f"## {room.capitalize()}", "",
                  "| mechanism | what it does | scene | figure | with | without | verdict | run |",
                  "|---|---|---|---|---|---|---|---|", *map(_line, rows), ""]
    if ledger.retired:
        retired = (" | ".join(one[key] for key in ("name", "room", "figure", "date")) for one in ledger.retired)
        lines += ["## Retired", "", "| mechanism | room | what its going changed | when |", "|---|---|---|---|",
                  *(f"| {cells} |" for cells in retired), ""]
    return "\n".join(lines).rstrip() + "\n"


def _line(row: Row) -> str:
    cells = (row.name, row.what, ", ".join(row.scenes), row.figure or "–", row.on or "–", row.off or "–", row.verdict,
             row.date or "–")
    return f"| {' | '.join(cells)} |"


if __name__ == "__main__":
    PAGE.write_text(ledger_page(read_ledger()), encoding="utf-8")
