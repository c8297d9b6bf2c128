"""Counts of a run over tiles: what is good, doubtful and missing, in the verdict of its report."""

from __future__ import annotations

import re

import pytest

from urbanmap_qgis.tiling.journal import DONE, FAILED, TileRecord
from urbanmap_qgis.tiling.report import write_tiles_report
from urbanmap_qgis.tiling.result_counts import ResultCounts
from urbanmap_qgis.tiling.tile_grid import TileGrid


def verdict_of(tmp_path, results, statuses=(DONE, DONE)):
    grid = TileGrid(10.0, 0.0)
    tiles = grid.covering((0.5, 0.5, 19.5, 9.5))
    assert len(tiles) == 2
    records = [TileRecord(tile.name, status, seconds=1.0) for tile, status in zip(tiles, statuses)]
    write_tiles_report(tmp_path / "report.html", "Run", {}, grid, tiles, records, 0, {}, results)
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    return re.search(r'<p class="verdict (\w+)">(.*?)</p>', text).groups()


@pytest.mark.parametrize("statuses, grade, words", [
    ({"ok": 5}, "good", "5 buildings: 5 ok, 0 doubtful, 0 failed. All 2 tiles are done."),
    ({"ok": 4, "low": 2, "not modelled": 1}, "look", "7 buildings: 4 ok, 2 doubtful, 1 failed. The field “status”"),
    ({"not modelled": 3}, "bad", "3 buildings: 0 ok, 0 doubtful, 3 failed."),
])
def test_the_verdict_is_about_buildings(tmp_path, statuses, grade, words):
    found = verdict_of(tmp_path, ResultCounts.of("buildings", statuses, ("ok",), ("not modelled",)))
    assert found[0] == grade and words in found[1]


def test_a_failed_tile_is_told_behind_the_buildings(tmp_path):
    results = ResultCounts.of("walls", {"ok": 2}, ("ok",), ())
    grade, text = verdict_of(tmp_path, results, (DONE, FAILED))
    assert grade == "bad" and text.startswith("2 walls: 2 ok, 0 doubtful.") and "1 of 2 tiles failed" in text


def test_results_without_a_status_tell_of_the_tiles_alone(tmp_path):
    assert verdict_of(tmp_path, None) == ("good", "All 2 tiles are done.")
