"""The report of merged models: how many walls lie on measured ones now, and what could not be merged."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ...io.pages.report import BAD, GOOD, LOOK, Report
from ...wording import say
from .merge_stage import MERGED, NOT_MERGED, UNCHANGED, MergedBuilding

_ROWS = 50


def write_merge_report(path: str | os.PathLike, merged: Sequence[MergedBuilding], columns: Mapping[str, Sequence],
                       edges: Mapping[str, Sequence], names: Sequence,
                       more: Callable[[Report], None] = lambda report: None) -> None:
    """Write the report (HTML).

    Parameters
    ----------
    columns, edges : of the buildings and of their walls, as `merged_columns` and `edge_columns` give them.
    names : of the buildings, in their order.
    more : adds to the report, such as pictures.
    """
    report = Report("Merged building models")
    status = Counter(building.status for building in merged)
    text = say("{status} of {merged_count} buildings have walls that lie on measured ones now.", status=status[MERGED],
               merged_count=len(merged))
    if status[NOT_MERGED]:
        text += say(" {status} could not be merged and keep their models; the table tells why.",
                    status=status[NOT_MERGED])
    if status[UNCHANGED]:
        text += " " + say("Unchanged: {count}; the table tells why.", count=status[UNCHANGED])
    report.verdict(BAD if not status[MERGED] else LOOK if status[NOT_MERGED] else GOOD, text)
    others = sorted((building.status, row) for row, building in enumerate(merged) if building.status != MERGED)
    if others:
        report.section("Not merged or unchanged")
        report.table(("building", "status", "reason"),
                     [(names[row], word, merged[row].reason) for word, row in others[:_ROWS]])
    more(report)
    report.section("Result")
    offsets = np.array([value for value in columns["mean_offset"] if value is not None], float)
    offsets = offsets[np.isfinite(offsets)]
    report.facts({"Buildings": len(merged), "Valid": sum(building.valid for building in merged),
                  "Walls moved": int(sum(columns["walls_moved"])),
                  "Mean offset of the moved walls (m)": float(np.abs(offsets).mean()) if len(offsets) else None})
    report.table(("wall", "number"), sorted(Counter(edges["status"]).items()))
    report.histogram(np.array(columns["max_offset"], float), "largest offset of a wall (m)",
                     say("Buildings by the largest offset of a wall. Offsets of metres hint at another building, or "
                         "another date."))
    report.write(path)
