"""Faces cut into triangles: whole area, only the face's own vertices, by both ways."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.geometry.triangulation import clip_ears, triangulate_face

FACES = {
    "square": [[(0, 0), (4, 0), (4, 4), (0, 4)]],
    "points along a side": [[(0, 0), (1, 0), (3, 0), (4, 0), (4, 2), (4, 4), (0, 4), (0, 3), (0, 1)]],
    "comb": [[(0, 0), (7, 0), (7, 3), (6, 3), (6, 1), (5, 1), (5, 3), (4, 3), (4, 1), (3, 1), (3, 3), (0, 3)]],
    "hole": [[(0, 0), (6, 0), (6, 6), (0, 6)], [(2, 2), (2, 4), (4, 4), (4, 2)]],
    "three holes": [[(0, 0), (9, 0), (9, 6), (0, 6)], [(1, 1), (1, 2), (2, 2), (2, 1)],
                    [(4, 3), (4, 5), (5, 5), (5, 3)], [(6, 1), (6, 2), (8, 2), (8, 1)]],
    "hole touching the outer ring": [[(0, 0), (6, 0), (6, 6), (0, 6)], [(0, 0), (1, 3), (3, 1)]],
}


def laid(rings, turn):
    """Vertices in space and index rings of a flat face, standing upright or not."""
    points = list(dict.fromkeys(point for ring in rings for point in ring))
    flat = np.column_stack([np.array(points, dtype=float), np.zeros(len(points))])
    return flat @ turn.T, [[points.index(p) for p in ring] for ring in rings]


@pytest.mark.parametrize("turn", [np.eye(3), np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]),
                                  np.array([[0.6, 0, 0.8], [0, 1, 0], [-0.8, 0, 0.6]])])
@pytest.mark.parametrize("name", FACES)
def test_area_and_sense(name, turn):
    rings = FACES[name]
    vertices, face = laid(rings, turn.astype(float))
    area = shapely.Polygon(rings[0], rings[1:]).area
    place = {i: (p @ turn)[:2] for i, p in enumerate(vertices)}
    place = {i: (float(p[0]), float(p[1])) for i, p in place.items()}
    for triangles in (triangulate_face(vertices, face), clip_ears(place, face)):
        corners = vertices[np.array(triangles)]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        up = turn[:, 2]
        assert (across @ up > 0).all()
        assert (across @ up).sum() == pytest.approx(area)
        corners, touching = sum(map(len, face)), sum(map(len, face)) - len(vertices)
        assert len(triangles) == corners - 2 + 2 * (len(face) - 1) - 2 * touching


def test_a_ring_without_an_inside_is_refused():
    place = {0: (0.0, 0.0), 1: (0.0, 4.0), 2: (4.0, 4.0), 3: (4.0, 0.0)}
    with pytest.raises(ValueError, match="cannot be cut"):
        clip_ears(place, [[0, 1, 2, 3]])


def test_a_face_whose_hole_leaves_it_is_refused():
    outer = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    with pytest.raises(ValueError, match="cannot be cut"):
        triangulate_face(np.array([*outer, *outer], float), [(0, 1, 2, 3), (7, 6, 5, 4)])
