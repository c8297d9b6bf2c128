"""2.5D meshes of made-up buildings: closed, valid, within the stated error."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.merging.layered_solid import solid_volume
from urbanmap_qgis.buildings.mesh25d.height_grid import height_grid
from urbanmap_qgis.buildings.mesh25d.mesh_points import building_points
from urbanmap_qgis.buildings.mesh25d.mesh_quality import is_watertight, mesh_fit, roof_distance, wall_boxes
from urbanmap_qgis.buildings.mesh25d.mesh_stage import (
    GROUND_UNKNOWN,
    MESH_COLUMNS,
    NOT_MODELLED,
    OK,
    mesh_building,
    mesh_buildings,
    mesh_columns,
    total_fit,
    write_ply,
)
from urbanmap_qgis.buildings.mesh25d.node_heights import local_heights
from urbanmap_qgis.buildings.mesh25d.tin import Tin
from urbanmap_qgis.buildings.outlines.footprint import clean_footprints
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.geometry.solid import GROUND, INNER_WALL, OUTER_WALL, Solid
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.settings.buildings import MeshSettings

X0, Y0, BASE = -7000.0, -34000.0, 12.0


def box(x, y, width, depth):
    return shapely.box(X0 + x, Y0 + y, X0 + x + width, Y0 + y + depth)


def points_on(rng, plan, height, density=8.0, noise=0.03):
    """Points (n, 3) over a plan; `height(x, y)` above ground, x and y from the origin."""
    x_min, y_min, x_max, y_max = plan.bounds
    xy = rng.uniform((x_min, y_min), (x_max, y_max), (int((x_max - x_min) * (y_max - y_min) * density), 2))
    xy = xy[shapely.contains_xy(plan, xy[:, 0], xy[:, 1])]
    z = height(xy[:, 0] - X0, xy[:, 1] - Y0)
    return np.column_stack([xy, BASE + z + rng.normal(0, noise, len(xy))])


SHAPES = {
    "flat": (box(0, 0, 20, 12), lambda x, y: np.full(len(x), 15.0), 240 * 15),
    "gable": (box(0, 0, 20, 12), lambda x, y: 10 - 0.8 * np.abs(y - 6), 20 * (12 * 10 - 0.8 * 36)),
    "levels": (box(0, 0, 20, 12), lambda x, y: np.where(x < 8, 20.0, 9.0), 96 * 20 + 144 * 9),
    "courtyard": (box(0, 0, 24, 24).difference(box(8, 8, 8, 8)), lambda x, y: np.full(len(x), 11.0), 512 * 11),
    "slope on levels": (box(0, 0, 20, 12), lambda x, y: np.where(x < 8, 20.0, 6 + 0.3 * y), 96 * 20 + 12 * 12 * 7.8),
    "crossing": (box(0, 0, 20, 12), lambda x, y: np.where(y < 6, 14 + 0.4 * (x - 10), 14 - 0.4 * (x - 10)), 240 * 14),
    "dome": (shapely.Point(X0 + 15, Y0 + 15).buffer(12, quad_segs=16),
             lambda x, y: 8 + np.sqrt(np.maximum(15**2 - (x - 15)**2 - (y - 15)**2, 0)), None),
}


@pytest.mark.paper("J 5.7, mesh")
@pytest.mark.parametrize("name", SHAPES)
def test_known_shapes(name):
    plan, height, volume = SHAPES[name]
    points = points_on(np.random.default_rng(1), plan, height)
    made = mesh_building(1, plan, points, BASE)
    assert made.status == OK and made.watertight and made.valid
    assert check_solid(made.mesh) == () and is_watertight(made.mesh)
    assert made.fit.within >= 0.95
    if volume is not None:
        assert solid_volume(made.mesh) == pytest.approx(volume, rel=0.02)
    else:
        truth = points_on(np.random.default_rng(2), plan.buffer(-0.5), height, noise=0.0)
        assert np.quantile(roof_distance(made.mesh, truth), 0.95) < 0.3


@pytest.mark.slow
def test_a_flat_roof_needs_few_triangles_and_a_smaller_error_more():
    flat = mesh_building(1, SHAPES["flat"][0], points_on(np.random.default_rng(3), *SHAPES["flat"][:2]), BASE)
    assert len(flat.mesh.faces) < 20
    plan, height, _ = SHAPES["dome"]
    points = points_on(np.random.default_rng(3), plan, height, density=20)
    counts = [len(mesh_building(1, plan, points, BASE, MeshSettings(max_error=error)).mesh.faces)
              for error in (1.0, 0.4, 0.15)]
    assert counts[0] < counts[1] < counts[2]


def test_walls_stand_at_height_steps():
    plan, height, _ = SHAPES["levels"]
    made = mesh_building(1, plan, points_on(np.random.default_rng(4), plan, height), BASE)
    assert made.surfaces == 2
    inner = [made.mesh.vertices[list(face[0])] for face, kind in zip(made.mesh.faces, made.mesh.surface_type)
             if kind == INNER_WALL]
    x = np.concatenate(inner)[:, 0] - X0
    assert np.abs(x - 8).max() < 0.5
    z = np.concatenate(inner)[:, 2] - BASE
    assert z.min() == pytest.approx(9, abs=0.1) and z.max() == pytest.approx(20, abs=0.1)


@pytest.mark.parametrize("seed", range(15))
def test_whatever_the_roof_the_mesh_is_closed(seed):
    """Random boxes on a random outline: steps that meet in corners, narrow pieces, holes in the points."""
    rng = np.random.default_rng(seed)
    plan = shapely.affinity.rotate(box(0, 0, rng.uniform(8, 25), rng.uniform(8, 20)), rng.uniform(0, 90))
    x, y, w, d, h = rng.uniform([-5, -5, 2, 2, 3], [20, 20, 12, 12, 25], (7, 5)).T
    slope = rng.normal(0, 0.2, (7, 2))

    def height(px, py):
        z = np.full(len(px), 5.0)
        for k in range(7):
            inside = (px > x[k]) & (px < x[k] + w[k]) & (py > y[k]) & (py < y[k] + d[k])
            z = np.where(inside, np.maximum(z, h[k] + slope[k, 0] * (px - x[k]) + slope[k, 1] * (py - y[k])), z)
        return np.maximum(z, 1.0)

    points = points_on(rng, plan, height, density=6)
    points = points[np.hypot(points[:, 0] - X0 - 6, points[:, 1] - Y0 - 6) > 1.5]
    made = mesh_building(1, plan, points, BASE)
    assert made.mesh is not None and made.watertight and is_watertight(made.mesh)
    assert made.fit.within > 0.85
    assert {GROUND, OUTER_WALL} <= set(made.mesh.surface_type)


def test_an_open_mesh_is_not_watertight():
    plan, height, _ = SHAPES["flat"]
    mesh = mesh_building(1, plan, points_on(np.random.default_rng(5), plan, height), BASE).mesh
    assert not is_watertight(Solid(mesh.vertices, mesh.faces[1:], mesh.surface_type[1:], mesh.roof_id[1:]))
    turned = (mesh.faces[0][0][::-1],)
    assert not is_watertight(Solid(mesh.vertices, (turned, *mesh.faces[1:]), mesh.surface_type, mesh.roof_id))


def test_distances_against_known_places():
    plan, _, _ = SHAPES["flat"]
    mesh = mesh_building(1, plan, points_on(np.random.default_rng(6), *SHAPES["flat"][:2], noise=0.0), BASE).mesh
    places = np.array([[5, 5, 15.0], [5, 5, 15.2], [5, 5, 14.0], [5, 0.1, 7.0], [-0.2, 5, 7.0], [12, 6, 13.5]])
    places += np.array([X0, Y0, BASE])
    fit = mesh_fit(mesh, places, 0.25)
    # The third lies under the first two: of the five uppermost ones the last is off.
    assert fit.within == pytest.approx(4 / 5) and fit.under == pytest.approx(1 / 6)
    assert fit.max_distance == pytest.approx(1.5, abs=0.01)


def test_a_second_surface_under_the_first_is_told():
    """A canopy of glass 3 m under a part of the roof, seen by a tenth of the pulses."""
    rng = np.random.default_rng(9)
    plan, height, _ = SHAPES["flat"]
    roof = points_on(rng, plan, height, density=20.0)
    below = points_on(rng, box(2, 2, 12, 8), lambda x, y: np.full(len(x), 12.0), density=5.0)
    made = mesh_building(1, plan, np.concatenate([roof, below]), BASE)
    assert made.status == OK and made.fit.within > 0.95
    assert made.fit.under > 0.06 and "under the uppermost surface" in made.reason
    assert "under" not in mesh_building(1, plan, roof, BASE).reason


@pytest.mark.parametrize(("points", "words"), [
    (np.zeros((0, 3)), "0 points"),
    (np.array([[X0 + 1, Y0 + 1, 20.0]] * 12), "12 points"),
    (np.array([[X0 + 900, Y0 + 1, 20.0]] * 30), "none of its points"),
])
def test_too_little_gives_no_mesh_and_says_so(points, words):
    made = mesh_building(3, box(0, 0, 10, 10), points, BASE)
    assert made.mesh is None and made.status == NOT_MODELLED and words in made.reason


def test_an_unknown_ground_is_said():
    plan, height, _ = SHAPES["flat"]
    made = mesh_building(1, plan, points_on(np.random.default_rng(7), plan, height), float("nan"))
    assert made.status == GROUND_UNKNOWN and "not known" in made.reason and made.watertight
    assert mesh_building(1, None, np.zeros((0, 3)), BASE).status == NOT_MODELLED
    with pytest.raises(InputError):
        MeshSettings(max_error=0)


def test_small_things_on_a_roof_do_not_become_surfaces():
    plan, height, _ = SHAPES["flat"]
    points = points_on(np.random.default_rng(8), plan, height)
    points[np.hypot(points[:, 0] - X0 - 9, points[:, 1] - Y0 - 5) < 0.5, 2] += 3.0
    assert height_grid(points, plan, 0.5, 2.0).label.max() == 0
    assert height_grid(points, plan, 0.5, 0.2).label.max() == 1


def test_local_heights_follow_slopes_and_stay_near_their_cells():
    rng = np.random.default_rng(9)
    xy = rng.uniform(0, 10, (300, 2))
    cells = np.column_stack([xy, 5 + 0.4 * xy[:, 0]])
    assert local_heights(cells, np.array([[5.0, 5.0], [0.0, 3.0]])) == pytest.approx([7.0, 5.0], abs=0.08)
    line = np.column_stack([np.arange(10.0), np.zeros(10), np.full(10, 4.0)])
    assert local_heights(line, np.array([[3.0, 8.0]]))[0] == pytest.approx(4.0, abs=0.31)


def test_a_tin_meets_its_points():
    corners = np.array([[0, 0], [10, 0], [10, 10], [0, 10]], float)
    xy = np.random.default_rng(10).uniform(0.2, 9.8, (800, 2))
    z = np.sin(xy[:, 0]) + 0.5 * np.cos(xy[:, 1])
    tin = Tin(corners, np.zeros(4), [[0, 1, 2, 3]])
    tin.refine(xy, z, 0.1, 800)
    owner = tin.locate(xy, list(tin.triangles))
    assert (owner >= 0).all()
    assert np.abs(tin.heights(xy, owner) - z).max() <= 0.1 + 1e-9
    area = sum(shapely.Polygon([tin.xy[corner] for corner in triangle]).area for triangle in tin.triangles.values())
    assert area == pytest.approx(100.0)
    assert 20 < len(tin.triangles) < 700


def test_points_are_cut_by_outlines_or_taken_by_number(make_cloud, tmp_path):
    rng = np.random.default_rng(11)
    plans = [box(0, 0, 10, 10), box(30, 0, 10, 10), box(60, 0, 10, 10)]
    roof = np.concatenate([points_on(rng, plan, lambda x, y: np.full(len(x), 8.0)) for plan in plans[:2]])
    ground = points_on(rng, box(-3, -3, 46, 16), lambda x, y: np.zeros(len(x)), density=4)
    points = np.concatenate([roof, ground])
    kind = np.repeat([6, 2], [len(roof), len(ground)])
    number = np.where(points[:, 0] < X0 + 20, 7, 9) * (kind == 6)
    footprints = clean_footprints(np.array(plans, object), np.array([7, 9, 11]))
    cut = make_cloud(tmp_path / "cut.laz", *points.T, classification=kind)
    numbered = make_cloud(tmp_path / "numbered.laz", *points.T, extra={"building_id": number})
    for path in (cut, numbered):
        meshes = mesh_buildings(open_cloud([path]), footprints, np.full(3, np.nan))
        assert [item.mesh is not None for item in meshes] == [True, True, False]
        assert meshes[0].mesh.vertices[:, 2].max() == pytest.approx(BASE + 8, abs=0.1)
        assert meshes[0].status == (OK if path == cut else GROUND_UNKNOWN)
    columns = mesh_columns(meshes)
    assert list(columns) == list(MESH_COLUMNS) and columns["building_id"] == [7, 9, 11]
    within, rmse = total_fit(meshes)
    assert within > 0.95 and 0.01 < rmse < 0.3
    write_ply(tmp_path / "all.ply", meshes)
    text = (tmp_path / "all.ply").read_bytes()
    assert f"element face {sum(columns['triangles'])}".encode() in text
    far = clean_footprints(np.array([box(900, 0, 5, 5)], object))
    with pytest.raises(InsufficientDataError, match="same place"):
        list(building_points(open_cloud([cut]), far))


def test_a_refined_surface_has_no_point_in_a_triangles_circle():
    rng = np.random.default_rng(4)
    corners = np.array([[0, 0], [10, 0], [10, 10], [0, 10]], float)
    surface = Tin(corners, np.zeros(4), [[0, 1, 2, 3]])
    xy = rng.uniform(0.5, 9.5, (60, 2))
    surface.refine(xy, rng.uniform(0.0, 5.0, 60), 0.01, 40)
    places = np.array(surface.xy)
    assert len(places) == 44
    for triangle in surface.triangles.values():
        a, b, c = places[list(triangle)]
        centre = np.linalg.solve(2 * np.array([b - a, c - a]), [b @ b - a @ a, c @ c - a @ a])
        assert np.hypot(*(places - centre).T).min() > np.hypot(*(a - centre)) * (1 - 1e-4)


def test_the_box_of_a_slanting_wall_has_the_mean_of_its_two_ends():
    lower, upper = [(80, 40, 2), (90, 40, 4), (90, 40, 9), (80, 40, 5)], [(80, 40, 5), (90, 40, 9), (90, 40, 11)]
    faces = (((0, 1, 2, 3),), ((4, 5, 6),))
    mesh = Solid(np.array([*lower, *upper], float), faces, (OUTER_WALL, OUTER_WALL), (0, 0))
    assert wall_boxes(mesh).tolist() == [[80.0, 40.0, 90.0, 40.0, 3.0, 8.0]]
