"""Towers with sloped roofs above the height of the measured walls: prisms below the cut, the old model above."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.merging.merge_stage import MERGED, NOT_MERGED, merge_models
from urbanmap_qgis.buildings.merging.wall_match import measured_wall
from urbanmap_qgis.buildings.solids.sloped_solid import SlopedCell, sloped_solids
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.cityjson.writer import write_model_cityjson
from urbanmap_qgis.citymodel.model import CityModel, CityReference
from urbanmap_qgis.citymodel.solids import solid_object
from urbanmap_qgis.geometry.solid import OVERHANG, multipolygon
from urbanmap_qgis.settings.buildings import MergeSettings

X0, Y0, BASE = -7000.0, -34000.0, 10.0
VAL3DITY = Path(__file__).resolve().parents[2].parent / "shared" / "tools" / "val3dity"
SEEDS = range(29_400, 29_424)


def cell(number, x, y, width, depth, height, slope=(0.0, 0.0)):
    polygon = shapely.box(X0 + x, Y0 + y, X0 + x + width, Y0 + y + depth)
    return SlopedCell(polygon, number, (*slope, BASE + height), (X0, Y0))


def wall(start, end, high=18.0, number=0):
    (ax, ay), (bx, by) = start, end
    ring = [(ax, ay, 0.5), (bx, by, 0.5), (bx, by, high), (ax, ay, high)]
    return measured_wall(number, shapely.Polygon([(X0 + x, Y0 + y, BASE + z) for x, y, z in ring]), 0.01, 0.001)


def tower(rng):
    """Cells of a tower of 20 x 12 m with a penthouse of little slope, and now and then a podium."""
    x, y = rng.uniform(2, 12), rng.uniform(2, 7)
    x, y, top = round(x, 3), round(y, 3), rng.uniform(30, 77)
    slope = tuple(rng.uniform(-0.1, 0.1, 2))
    cells = [cell(0, 0, 0, 20, y, top), cell(1, 0, y + 3, 20, 9 - y, top), cell(2, 0, y, x, 3, top),
             cell(3, x, y, 3, 3, top + 4, slope), cell(4, x + 3, y, 17 - x, 3, top)]
    return cells + [cell(5, 20, 0, 8, 12, rng.uniform(6, 15))] * (rng.random() < 0.5)


def walls_round(rng, length):
    off = rng.uniform(-0.6, 0.6, 8)
    return [wall((0, off[0]), (length, off[1]), number=1), wall((length + off[2], 0), (length + off[3], 12), number=2),
            wall((length, 12 + off[4]), (0, 12 + off[5]), number=3), wall((off[6], 12), (off[7], 0), number=4)]


def merged_tower(seed):
    rng = np.random.default_rng(seed)
    cells = tower(rng)
    model = multipolygon(sloped_solids(cells, BASE))
    building, = merge_models([1], [model], walls_round(rng, 28 if len(cells) > 5 else 20), MergeSettings())
    return cells, building


@pytest.mark.parametrize("seed", SEEDS)
def test_a_tower_with_a_sloped_penthouse_is_merged(seed):
    cells, building = merged_tower(seed)
    assert building.status == MERGED, building.reason
    assert building.valid and not any(check_solid(solid) for solid in building.solids)
    top = max(solid.vertices[:, 2].max() for solid in building.solids)
    a, b, c = cells[3].plane
    corners = shapely.get_coordinates(cells[3].polygon) - (X0, Y0)
    assert top == pytest.approx((corners @ (a, b) + c).max(), abs=0.01)
    assert any(edge.match.status == "moved" for edge in building.edges)


def test_seen_edges_of_towers_are_moved():
    states = [edge.match.status for seed in SEEDS for edge in merged_tower(seed)[1].edges]
    assert sum(state in ("moved", "fits") for state in states) >= 0.95 * (len(states) - states.count("not seen"))


def test_the_cut_leaves_what_is_above_and_moves_what_is_below():
    cells = [cell(0, 0, 0, 20, 10, 40.0, (0.1, 0.0))]
    model = multipolygon(sloped_solids(cells, BASE))
    out, = merge_models([1], [model], [wall((0, -0.4), (20, -0.4))], MergeSettings())
    assert out.volume - out.volume_before == pytest.approx(20 * 0.4 * 20, abs=0.1)
    back, = merge_models([1], [model], [wall((0, 0.25), (20, 0.25))], MergeSettings())
    assert back.volume - back.volume_before == pytest.approx(-20 * 0.25 * 20, abs=0.1)
    assert OVERHANG in back.solids[0].surface_type


def test_a_roof_that_falls_below_the_height_lowers_the_cut():
    cells = [cell(0, 0, 0, 20, 10, 17.0, (0.3, 0.0))]
    model = multipolygon(sloped_solids(cells, BASE))
    made, = merge_models([1], [model], [wall((0, -0.4), (20, -0.4), high=15.0)], MergeSettings())
    assert made.volume - made.volume_before == pytest.approx(20 * 0.4 * 16.8, abs=0.1)
    low = multipolygon(sloped_solids([cell(0, 0, 0, 20, 10, 8.0, (0.8, 0.0))], BASE))
    kept, = merge_models([1], [low], [wall((0, -0.4), (20, -0.4), high=7.0)], MergeSettings())
    assert kept.status == NOT_MERGED and "sloped" in kept.reason


@pytest.mark.parametrize("rise, merged", [(0.02, True), (0.5, False)])
def test_a_low_roof_of_some_centimetres_of_fall_counts_as_level(rise, merged):
    cells = [cell(0, 0, 0, 20, 10, 40.0), cell(1, 20, 0, 8, 10, 6.0, (rise / 8, 0.0))]
    cells[1] = SlopedCell(cells[1].polygon, 1, (rise / 8, 0.0, BASE + 6.0 - 20 * rise / 8), (X0, Y0))
    model = multipolygon(sloped_solids(cells, BASE))
    out, = merge_models([1], [model], [wall((0, -0.4), (28, -0.4), high=5.0)], MergeSettings())
    assert (out.status == MERGED) == merged
    if merged:
        assert out.valid and out.volume - out.volume_before == pytest.approx(
            20 * 0.4 * 20 + 8 * 0.4 * 6.02 + 80 * 0.01, abs=0.3)


def test_cut_towers_are_valid_for_the_outside_judge(tmp_path):
    if not VAL3DITY.exists() or shutil.which("ldd") is None:
        pytest.skip("val3dity is not beside the checkout")
    made = [merged_tower(seed)[1] for seed in SEEDS]
    write_model_cityjson(tmp_path / "towers.city.json", CityModel(CityReference(), [
        solid_object(str(number), {}, building.solids, lod="2.2") for number, building in enumerate(made)]))
    report = tmp_path / "report.json"
    try:
        subprocess.run([VAL3DITY, tmp_path / "towers.city.json", "--report", report], capture_output=True, check=False)
    except OSError as error:
        pytest.skip(f"val3dity does not start: {error}")
    if not report.exists():
        pytest.skip("val3dity does not start: its libraries are not there")
    features = json.loads(report.read_text(encoding="utf-8"))["features"]
    assert [feature["id"] for feature in features if not feature["validity"]] == []
