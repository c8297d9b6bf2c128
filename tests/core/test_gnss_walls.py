"""Walls of building models: solids, outlines, gables, planes, bad input."""


import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.rays.wall_faces import building_walls, is_solid, wall_table


def box_solid(x0, y0, x1, y1, low, top, inwards=False):
    """Faces of a block as MultiPolygonZ."""
    a, b, c, d = (x0, y0), (x1, y0), (x1, y1), (x0, y1)
    faces = [[(*p, top) for p in (a, b, c, d)], [(*p, low) for p in (d, c, b, a)]]
    faces += [[(*p, low), (*q, low), (*q, top), (*p, top)] for p, q in ((a, b), (b, c), (c, d), (d, a))]
    if inwards:
        faces = [face[::-1] for face in faces]
    return shapely.MultiPolygon([shapely.Polygon(face) for face in faces])


@pytest.mark.parametrize("inwards", [False, True])
def test_walls_of_a_block_face_outwards_whichever_way_its_faces_turn(inwards):
    solid = box_solid(100, 200, 120, 230, 5, 35, inwards)
    walls = building_walls([solid])
    assert is_solid(solid) and len(walls) == walls.count == 4
    middle = (walls.start + walls.end) / 2
    outwards = middle - [110, 215]
    assert (np.einsum("ij,ij->i", outwards, walls.normal) > 0).all()
    assert np.allclose(np.einsum("ij,ij->i", middle, walls.normal), walls.offset)
    assert np.allclose(walls.low, 5) and np.allclose(walls.top, 35)
    # Outwards is on the right when walking from start to end.
    edge = walls.end - walls.start
    assert np.allclose(np.column_stack([edge[:, 1], -edge[:, 0]]) / np.linalg.norm(edge, axis=1)[:, None], walls.normal)


def test_outline_and_solid_give_the_same_walls():
    outline = building_walls([shapely.box(0, 0, 10, 20)], top=np.array([30.0]), low=np.array([2.0]))
    solid = building_walls([box_solid(0, 0, 10, 20, 2, 30)])

    def rows(walls):
        table = np.column_stack([walls.start, walls.end, walls.low, walls.top, walls.normal, walls.offset])
        return table[np.lexsort(table[:, :4].round(6).T)]

    assert np.allclose(rows(outline), rows(solid))


def test_courtyard_walls_face_the_courtyard_and_rings_may_turn_either_way():
    shape = shapely.Polygon([(0, 0), (0, 30), (30, 30), (30, 0)], [[(10, 10), (20, 10), (20, 20), (10, 20)]])
    walls = building_walls([shape], top=np.array([20.0]))
    outside = (walls.start + walls.end) / 2 + 0.1 * walls.normal
    assert len(walls) == 8
    assert not shapely.contains_xy(shape, outside).any()
    assert np.isneginf(walls.low).all() and np.isnan(wall_table(walls).low).all()


def test_height_of_an_outline_comes_from_its_z_unless_a_field_tells_it():
    shape = shapely.Polygon([(0, 0, 12), (10, 0, 12), (10, 10, 12), (0, 10, 12)])
    assert np.allclose(building_walls([shape]).top, 12)
    assert np.allclose(building_walls([shape], top=np.array([9.0])).top, 9)


def test_gable_is_a_wall_with_a_sloping_edge():
    face = [(0, 0, 0), (8, 0, 0), (8, 0, 6), (4, 0, 10), (0, 0, 6)]
    back = [(x, 12, z) for x, _, z in face[::-1]]
    sides = [[(8, 0, 0), (8, 12, 0), (8, 12, 6), (8, 0, 6)], [(0, 12, 0), (0, 0, 0), (0, 0, 6), (0, 12, 6)]]
    roofs = [[(8, 0, 6), (8, 12, 6), (4, 12, 10), (4, 0, 10)], [(4, 0, 10), (4, 12, 10), (0, 12, 6), (0, 0, 6)]]
    ground = [(0, 0, 0), (0, 12, 0), (8, 12, 0), (8, 0, 0)]
    solid = shapely.MultiPolygon([shapely.Polygon(ring) for ring in (face, back, *sides, *roofs, ground)])
    walls = building_walls([solid])
    assert walls.count == 4 and len(walls) == 6
    gable = walls.normal[:, 1] < -0.9
    ends = {(round(float(x), 3), round(float(z), 3)) for x, z in zip(
        np.r_[walls.start[gable, 0], walls.end[gable, 0]], np.r_[walls.top[gable, 0], walls.top[gable, 1]])}
    assert ends == {(0.0, 6.0), (4.0, 10.0), (8.0, 6.0)}


def test_pieces_in_one_plane_are_one_wall_but_not_across_buildings():
    left, right = shapely.box(0, 0, 10, 10), shapely.box(10, 0, 20, 15)
    tops = np.array([20.0, 20.0])
    together = building_walls([left, right], np.array([7, 7]), tops)
    apart = building_walls([left, right], np.array([7, 8]), tops)
    south = np.flatnonzero(together.normal[:, 1] < -0.9)
    assert len(np.unique(together.wall[south])) == 1
    assert len(np.unique(apart.wall[np.flatnonzero(apart.normal[:, 1] < -0.9)])) == 2
    table = wall_table(together)
    row = together.wall[south[0]]
    assert table.length[row] == pytest.approx(20.0)
    assert sorted(table.edge[table.building == 0]) == list(range(1, together.count + 1))


def test_outlines_without_heights_are_refused_with_a_count():
    with pytest.raises(InputError, match="1 of 2 buildings have no heights"):
        building_walls([shapely.box(0, 0, 1, 1), shapely.box(3, 0, 4, 1)], top=np.array([5.0, np.nan]))
    with pytest.raises(InputError, match="no walls"):
        building_walls([None, shapely.Polygon()], top=np.array([1.0, 1.0]))
