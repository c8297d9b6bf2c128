"""What stands before a facade (canopy, sign, garden wall, hoarding) is not taken for it: made fronts, end to end."""

import laspy
import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.merging.merge_stage import merge_models
from urbanmap_qgis.buildings.merging.wall_match import MOVED, measured_wall
from urbanmap_qgis.buildings.solids.plan_partition import Cell
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.facades.building_plans import building_plans
from urbanmap_qgis.facades.wall_stage import find_walls
from urbanmap_qgis.geometry.solid import multipolygon
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.settings.buildings import MergeSettings

X0, Y0, Z0 = -7000.0, -34000.0, 20.0
SEEDS = range(3100, 3106)


def front(kind, seed):
    """Outline, true depth of the facade, and walls (start, end, low, high) that the survey sees, for a front of 20 m.

    The facade stands at y = 0; the outline is up to half a metre off.
    """
    rng = np.random.default_rng(seed)
    before, off = rng.uniform(0.8, 3.0), rng.uniform(-0.5, 0.5)
    height = rng.uniform(7, 14)
    facade = [((0, 0), (20, 0), 0.0, height)]
    left, right = rng.uniform(0, 1), rng.uniform(19, 20)
    things = {
        "plain": [],
        "canopy": [((left, -before), (right, -before), 3.0, 3.0 + rng.uniform(0.5, 1.0))],
        "sign band": [((left, -min(before, 1.2)), (right, -min(before, 1.2)), 3.2, 3.2 + rng.uniform(0.6, 1.5))],
        "garden wall": [((-2, -before), (22, -before), 0.0, rng.uniform(1.2, 1.8))],
        "hoarding": [((-2, -before), (22, -before), 0.0, rng.uniform(2.0, 3.0))],
        "setback": [((0, 2.0), (20, 2.0), height, height + 3.5)],
    }[kind]
    if kind in ("garden wall", "hoarding") and rng.random() < 0.5:  # what stands behind it was not seen
        facade = [((0, 0), (20, 0), things[0][3], height)]
    return shapely.box(0, off, 20, 10 + off), facade + things


def survey(path, walls, seed):
    rng = np.random.default_rng(seed)
    parts = [np.column_stack([rng.uniform(-5, 25, 4000), rng.uniform(-10, -4, 4000), rng.normal(0, 0.01, 4000)])]
    for (ax, ay), (bx, _), low, high in walls:
        n = int(60 * (bx - ax) * (high - low))
        parts.append(np.column_stack([rng.uniform(ax, bx, n), ay + rng.normal(0, 0.005, n), rng.uniform(low, high, n)]))
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales, header.offsets = np.full(3, 0.001), np.array([X0, Y0, 0.0])
    las = laspy.LasData(header)
    las.x, las.y, las.z = (np.concatenate(parts) + np.array([X0, Y0, Z0])).T
    las.write(path)
    return open_cloud([path])


def front_edge(tmp_path, kind, seed):
    """What became of the model's front edge, and the true depth of the facade beyond the outline."""
    outline, walls = front(kind, seed)
    plan = shapely.affinity.translate(outline, X0, Y0)
    found, _ = find_walls(survey(tmp_path / "front.las", walls, seed), building_plans([plan], [1]))
    measured = [measured_wall(row, wall.contour, wall.plane.rmse, wall.plane.sigma)
                for row, wall in enumerate(found) if wall.status in ("ok", "partly seen")]
    model = multipolygon(building_solids([Cell(plan, 0, Z0 + max(wall[3] for wall in walls))], Z0))
    merged, = merge_models([1], [model], [wall for wall in measured if wall is not None], MergeSettings())
    assert merged.valid
    edge = min(merged.edges, key=lambda edge: shapely.get_coordinates(edge.wall)[:, 1].mean())
    return edge.match, outline.bounds[1]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", ["plain", "canopy", "sign band", "garden wall", "hoarding", "setback"])
def test_a_wall_moves_onto_its_facade_alone(tmp_path, kind, seed):
    match, off = front_edge(tmp_path, kind, seed)
    assert match.status in (MOVED, "fits"), match.note
    assert match.offset == pytest.approx(off, abs=0.05)
