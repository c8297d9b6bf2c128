"""Solids read back from the faces of a layer."""

import numpy as np
import shapely

from urbanmap_qgis.geometry.solid import GROUND, OUTER_WALL, ROOF, multipolygon, volume
from urbanmap_qgis.geometry.solid_faces import face_normal, solids_of


def box(x, y, z, width, depth, height):
    """Faces of a box as polygons, counterclockwise seen from outside."""
    corner = np.array([[x + i * width, y + j * depth, z + k * height] for k in (0, 1) for j in (0, 1) for i in (0, 1)])
    rings = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    return [shapely.Polygon(corner[list(ring)]) for ring in rings]


def test_a_box_comes_back_as_a_solid_with_its_surfaces():
    solid, = solids_of(shapely.MultiPolygon(box(-7000, -34000, 10, 8, 5, 3)))
    assert len(solid.vertices) == 8 and sorted(solid.surface_type) == sorted([GROUND, ROOF] + [OUTER_WALL] * 4)
    assert volume(solid) == 8 * 5 * 3
    assert shapely.equals_exact(shapely.normalize(multipolygon([solid])),
                                shapely.normalize(shapely.MultiPolygon(box(-7000, -34000, 10, 8, 5, 3))), 1e-3)


def test_boxes_apart_are_two_solids_and_touching_at_a_corner_too():
    faces = box(0, 0, 0, 2, 2, 2) + box(2, 2, 0, 2, 2, 2)
    assert [len(solid.faces) for solid in solids_of(shapely.MultiPolygon(faces))] == [12]
    faces = box(0, 0, 0, 2, 2, 2) + box(2, 2, 2, 2, 2, 2)
    assert [len(solid.faces) for solid in solids_of(shapely.MultiPolygon(faces))] == [6, 6]


def test_normals_look_outwards():
    solid, = solids_of(shapely.MultiPolygon(box(0, 0, 0, 4, 4, 4)))
    middle = solid.vertices.mean(axis=0)
    for face in solid.faces:
        away = solid.vertices[list(face[0])].mean(axis=0) - middle
        assert face_normal(solid.vertices, face) @ away > 1.9


def test_nothing_gives_nothing():
    assert solids_of(shapely.MultiPolygon()) == []
