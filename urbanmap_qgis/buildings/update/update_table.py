"""Rows and report of an updated city model."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely

from ...geometry.solid_faces import solids_of
from ...io.pages.report import GOOD, LOOK, Report
from ...wording import say
from ..model_surfaces import roof_cells
from .building_change import GONE, NEW, SAME, UNSEEN, Change, OldBuilding
from .update_stage import REACH, CityChanges

FIELDS = ("change", "height_change", "area_change", "significance", "seen", "reason")
ROWS = 100


def old_building(geometry: shapely.Geometry | None, sigma: float = float("nan")) -> OldBuilding:
    """Building of a layer: a model with its faces, or an outline, whose heights are not known.

    Parameters
    ----------
    geometry : MultiPolygon with z of all faces, or polygons in plan.
    sigma : standard deviation of the model's heights, m; NaN where it is not known.
    """
    if geometry is None or geometry.is_empty:
        return OldBuilding(shapely.Polygon(), ())
    cells = roof_cells(tuple(solids_of(geometry))) if geometry.has_z else []
    plans = [cell.polygon for cell in cells] or list(shapely.make_valid(shapely.get_parts(shapely.force_2d(geometry))))
    return OldBuilding(shapely.union_all(plans), cells, sigma)


def outlines_to_model(old: Sequence[OldBuilding], found: CityChanges) -> tuple[list[int], list[shapely.Geometry]]:
    """Buildings that need a new model: their rows (from len(old) on those of the new ones) and outlines."""
    rows, outlines = [], []
    for row, (building, change) in enumerate(zip(old, found.changes)):
        if change.change in (SAME, UNSEEN, GONE):
            continue
        outline = found.standing.get(row, building.outline)
        parts = [part.outline for part in found.extensions.get(row, ())]
        rows.append(row)
        outlines.append(with_extension(outline, parts) if parts else outline)
    return (rows + list(range(len(old), len(old) + len(found.added))),
            outlines + [building.outline for building in found.added])


def with_extension(outline: shapely.Geometry, parts: Sequence[shapely.Geometry]) -> shapely.Geometry:
    """An outline and what was built on to it as one, the gap between them closed."""
    both = shapely.union_all([outline, *parts])
    closed = shapely.buffer(shapely.buffer(both, REACH / 2.0, join_style="mitre"), -REACH / 2.0, join_style="mitre")
    return shapely.union(both, closed)


def update_columns(changes: Sequence[Change]) -> dict[str, list]:
    """Columns of the layer that tell of the changes."""
    values = [(each.change, each.height_change, each.area_change, each.significance, each.seen, each.reason)
              for each in changes]
    return {name: [row[place] for row in values] for place, name in enumerate(FIELDS)}


def new_ids(old: Sequence[Any], count: int) -> list[Any]:
    """Ids of new buildings: numbers after the highest, or "new-1" and so on where ids are words."""
    if all(isinstance(value, int) for value in old):
        first = max(old, default=0) + 1
        return list(range(first, first + count))
    taken = {str(value) for value in old}
    names = (f"new-{number}" for number in range(1, len(taken) + count + 1))
    return [name for name in names if name not in taken][:count]


def write_update_report(path: str | os.PathLike, ids: Sequence, changes: Sequence[Change], found: CityChanges,
                        failed: Sequence[str]) -> None:
    """Write the report (HTML): counts by kind, the epochs' offset, and all changes, surest first.

    Parameters
    ----------
    ids, changes : of all buildings, the new ones last.
    failed : reasons of changed buildings that could not be modelled anew.
    """
    report = Report("Updated city model")
    counts = Counter(change.change for change in changes)
    changed = sum(counts.values()) - counts[SAME] - counts[UNSEEN]
    report.verdict(LOOK if counts[UNSEEN] or failed else GOOD,
                   say("{changed} of {count} buildings changed, {same} are the same, {unseen} were not seen.",
                       changed=changed, count=len(changes), same=counts[SAME], unseen=counts[UNSEEN]))
    for sentence in failed:
        report.warning(sentence)
    report.section("Changes by kind")
    report.table(("change", "number"), counts.most_common())
    report.section("Offset of the epochs")
    report.paragraph(say("The new points lie this far from the old model as a whole, which counts as no change."))
    east, north, up = found.offset.shift
    report.facts({"East (m)": east, "North (m)": north, "Up (m)": up,
                  "Standard deviation up (m)": found.offset.sigma[2],
                  "Standard deviation of one cell (m)": found.offset.noise})
    rows = [row for row, change in enumerate(changes) if change.change not in (SAME, UNSEEN)]
    rows.sort(key=lambda row: -changes[row].significance)
    report.section("Changes")
    report.table(("building", "change", "height change (m)", "area change (m2)", "reason"),
                 [(ids[row], changes[row].change, _number(changes[row].height_change),
                   _number(changes[row].area_change), changes[row].reason) for row in rows[:ROWS]])
    if counts[UNSEEN]:
        report.section("Not seen")
        report.table(("building", "reason"), [(ids[row], change.reason) for row, change in enumerate(changes)
                                              if change.change == UNSEEN][:ROWS])
    report.write(path)


def _number(value: float) -> float | None:
    """A number for a table, None where it is none."""
    return float(value) if np.isfinite(value) else None


COUNTED = {"NEW": (NEW,), "GONE": (GONE,), "SAME": (SAME,), "UNSEEN": (UNSEEN,)}
"""Numbers among the results; CHANGED are all others."""


def counts_of(changes: Sequence[Change]) -> dict[str, int]:
    """Numbers of buildings by result."""
    counts = Counter(change.change for change in changes)
    numbers = {name: sum(counts[kind] for kind in kinds) for name, kinds in COUNTED.items()}
    return {**numbers, "CHANGED": len(changes) - sum(numbers.values())}

