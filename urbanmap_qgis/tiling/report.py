"""The report of a run over tiles."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

import numpy as np

from ..io.pages.report import BAD, GOOD, LOOK, Fixed, Report
from ..wording import say
from .journal import DONE, EMPTY, FAILED, TileRecord
from .result_counts import ResultCounts
from .tile_grid import GridTile, TileGrid

_LISTED = 50


def write_tiles_report(path: str | os.PathLike, title: str, settings: Mapping[str, object], grid: TileGrid,
                       tiles: Sequence[GridTile], records: Sequence[TileRecord], reused: int,
                       estimate: Mapping[str, object], results: ResultCounts | None = None) -> None:
    """Write what was made: a verdict on it, failed tiles with their reasons, time and memory, a map.

    Parameters
    ----------
    records : of the tiles that were done, in their order.
    reused : how many of them an earlier run had done.
    estimate : lines of an extrapolation to all tiles; empty for a run over all.
    results : what the merged result holds; None where its features have no status.
    """
    count = {status: sum(record.status == status for record in records) for status in (DONE, EMPTY, FAILED)}
    report = Report(title)
    _verdict(report, count[FAILED], len(records), len(tiles), bool(estimate), results)
    report.facts(estimate)
    _add_failures(report, records)
    if results and results.total:
        report.section("Results")
        rows = sorted(results.statuses.items(), key=lambda item: (-item[1], item[0]))
        report.table(("status", "number"), rows)
    report.section("Tiles")
    seconds = np.array([record.seconds for record in records if record.status == DONE])
    report.facts({"Done": count[DONE], "Empty": count[EMPTY], "Failed": count[FAILED],
                  "Kept from an earlier run": reused, "Grid": grid.title, "Buffer (m)": Fixed(f"{grid.buffer:g}"),
                  "Time of all tiles (s)": float(seconds.sum()) if len(seconds) else None,
                  "Processor time of all tiles (s)": float(sum(record.cpu for record in records)),
                  "Slowest tile (s)": float(seconds.max()) if len(seconds) else None,
                  "Greatest memory of a process (MB)": max((record.memory for record in records), default=None),
                  "Disk of the results (MB)": sum(sum(record.outputs.values()) for record in records) / 1e6})
    report.figure(_map(tiles, {record.name: record.status for record in records}),
                  say("Tiles: done green, empty grey, failed red, not done white. North is up. Look for empty tiles "
                      "where data should be."))
    if len(seconds) > 1:
        report.histogram(seconds, "time of a tile (s)", "How long the tiles took.")
    if settings:
        report.section("Settings of the algorithm")
        report.facts(settings)
    report.write(path)


def _verdict(report: Report, failed: int, done: int, tiles: int, estimate: bool, results: ResultCounts | None) -> None:
    """First what the user wants, buildings or walls; then the tiles."""
    parts = [results.sentence()] if results else []
    grade = LOOK if results and (results.doubtful or results.missing) else GOOD
    if results and not results.good + results.doubtful:
        grade = BAD
    if estimate:
        grade = LOOK
        parts.append(say("This is an estimate from {records_count} of {tiles_count} tiles.", records_count=done,
                         tiles_count=tiles))
    elif failed:
        grade = BAD
        parts.append(say("{count} of {tiles_count} tiles failed, and what lies in them is missing. Run again with the "
                         "same folder when the reasons below are put right: only the failed tiles are then done.",
                         count=failed, tiles_count=tiles))
    else:
        parts.append(say("All {tiles_count} tiles are done.", tiles_count=tiles))
    report.verdict(grade, " ".join(parts))


def _add_failures(report: Report, records: Sequence[TileRecord]) -> None:
    failed = [record for record in records if record.status == FAILED]
    if not failed:
        return
    report.section("Failed tiles")
    report.table(("Tile", "Reason", "Time (s)"),
                 [(record.name, record.reason, record.seconds) for record in failed[:_LISTED]])
    if len(failed) > _LISTED:
        report.paragraph(say("{failed_count} more are in the layer of tiles.", failed_count=len(failed) - _LISTED))


_COLOURS = {DONE: "#5fa777", EMPTY: "#d5d9dc", FAILED: "#c8443a", "": "#ffffff"}


def _map(tiles: Sequence[GridTile], statuses: Mapping[str, str]) -> str:
    """The tiles as an SVG, at most 640 px wide."""
    columns = [tile.column for tile in tiles]
    rows = [tile.row for tile in tiles]
    wide, high = max(columns) - min(columns) + 1, max(rows) - min(rows) + 1
    squares = "".join(
        f'<rect x="{tile.column - min(columns)}" y="{max(rows) - tile.row}" width="1" height="1" '
        f'fill="{_COLOURS[statuses.get(tile.name, "")]}"/>' for tile in tiles)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" width="{min(640, 24 * wide)}" '
            f'style="max-width:100%" stroke="#888" stroke-width="0.03">{squares}</svg>')


def extrapolated(records: Sequence[TileRecord], tiles: int, workers: int) -> dict[str, object]:
    """What all tiles will take, by those that were tried: time, memory and disk."""
    share = tiles / len(records)
    seconds = np.array([record.seconds for record in records])
    spread = float(seconds.std(ddof=1) / np.sqrt(len(records)) * tiles) if len(records) > 1 else float("nan")
    size = sum(sum(record.outputs.values()) for record in records)
    return {"Tiles": tiles, "Tiles tried": len(records), "Work of all tiles (h)": float(seconds.sum()) * share / 3600,
            "Its standard error (h)": spread / 3600,
            f"Time with {workers} workers (h)": float(seconds.sum()) * share / 3600 / workers,
            "Memory of a worker (MB)": max(record.memory for record in records),
            "Disk of the results (GB), without merged ones": size * share / 1e9}
