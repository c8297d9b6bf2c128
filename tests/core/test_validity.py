"""Each code of the checker on a solid broken for it, and nothing on sound ones."""

from dataclasses import dataclass

import numpy as np
import pytest

from urbanmap_qgis.buildings.solids.validity import NAMES, check_solid
from urbanmap_qgis.errors import InputError


@dataclass
class Body:
    vertices: np.ndarray
    faces: list


def cube(size=1.0, at=(0.0, 0.0, 0.0), first=0):
    """Vertices and outward faces of a cube."""
    corners = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float) * size + at
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    return corners, [[tuple(first + v for v in face)] for face in faces]


def plain():
    return Body(*cube())


def two(size, at):
    """Two cubes as one shell, vertices at one place counting once."""
    (first, faces), (second, more) = cube(), cube(size, at, 8)
    return Body(np.vstack([first, second]), faces + more)


def holed(hole, height=1.0):
    """A cube of 4 m whose top has the given inner rings (lists of x, y)."""
    body = Body(*cube(4.0))
    for ring in hole:
        start = len(body.vertices)
        body.vertices = np.vstack([body.vertices, [(x, y, 4.0 * height) for x, y in ring]])
        body.faces[1].append(tuple(range(start, start + len(ring))))
    return body


def codes(body, **options):
    return {problem.code for problem in check_solid(body, **options)}


def test_sound_solids():
    assert check_solid(plain()) == ()
    tetrahedron = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
    assert check_solid(Body(tetrahedron, [[(0, 2, 1)], [(0, 1, 3)], [(1, 2, 3)], [(0, 3, 2)]])) == ()
    gable = np.array([(0, 0, 0), (4, 0, 0), (4, 6, 0), (0, 6, 0), (0, 0, 3), (4, 0, 3), (4, 6, 3), (0, 6, 3),
                      (2, 0, 5), (2, 6, 5)], dtype=float)
    faces = [(0, 3, 2, 1), (0, 1, 5, 8, 4), (2, 3, 7, 9, 6), (1, 2, 6, 5), (3, 0, 4, 7), (5, 6, 9, 8), (7, 4, 8, 9)]
    assert check_solid(Body(gable + np.array([5e5, 5e6, 10]), [[face] for face in faces])) == ()


def test_rings():
    body = plain()
    body.faces[0] = [(0, 2)]
    assert 101 in codes(body)
    body = plain()
    body.faces[0] = [(0, 2, 2, 3, 1)]
    assert codes(body) == {102}
    body = plain()
    body.vertices = np.vstack([body.vertices, [(0, 1, 0.0005)]])
    body.faces[0] = [(0, 2, 8, 3, 1)]
    assert codes(body) == {102}
    assert 102 not in codes(body, snap=0.0001)
    body = plain()
    body.faces[0] = [(0, 3, 2, 1)]
    assert codes(body) == {104}
    body = plain()
    body.faces[0] = [(0, 2, 3, 0, 1, 3)]
    assert codes(body) == {104}
    body.faces[0] = [(0, 2, 8)]
    body.vertices = np.vstack([body.vertices, [(0, 2, 0)]])
    assert codes(body) == {104}


def test_polygons():
    square = [(1, 1), (1, 2), (2, 2), (2, 1)]
    assert codes(holed([[(3, 1), (3, 2), (6, 2), (6, 1)]])) == {201}
    assert codes(holed([square, [(1.5, 1.5), (1.5, 3), (3, 3), (3, 1.5)]])) == {201}
    assert codes(holed([square, square])) == {202}
    assert codes(holed([[(5, 5), (5, 6), (6, 6), (6, 5)]])) == {206}
    assert codes(holed([[(0.5, 0.5), (0.5, 3), (3, 3), (3, 0.5)], square])) == {207}
    assert codes(holed([square[::-1]])) == {208}
    assert codes(holed([[(0, 2), (2, 4), (4, 2), (2, 0)]])) == {205}
    assert codes(holed([square])) == {302}


def test_planarity():
    body = Body(*cube(4.0))
    body.vertices[7, 2] += 0.02
    assert codes(body) == {203}
    assert codes(body, planarity=0.03) == set()
    body = Body(*cube(4.0))
    body.vertices = np.vstack([body.vertices, [(4.0, 2.0, 4.0), (4.0, 2.0015, 4.0005)]])
    body.faces[1] = [(4, 5, 8, 9, 7, 6)]
    body.faces[3] = [(1, 3, 7, 9, 8, 5)]
    assert codes(body) == {204}
    assert codes(body, normals=30.0) == set()


def test_shell():
    body = plain()
    assert codes(Body(body.vertices, body.faces[:3])) == {301}
    assert codes(Body(body.vertices, [])) == {301}
    assert codes(Body(body.vertices, body.faces[:5])) == {302}
    assert codes(two(1.0, (1.0, 1.0, 0.0))) == {303}
    assert codes(two(1.0, (1.0, 1.0, 1.0))) == {303}
    assert codes(two(1.0, (1.0, 0.0, 0.0))) == {303}
    assert codes(two(1.0, (5.0, 0.0, 0.0))) == {305}
    body.faces[2] = [body.faces[2][0][::-1]]
    assert codes(body) == {307}


def test_solid_turned_inside_out():
    body = plain()
    assert codes(Body(body.vertices, [[ring[::-1] for ring in face] for face in body.faces])) == {405}


def notched(depth):
    """A cube with a pyramid pressed into its top; at a depth of more than 1 it comes out below."""
    corners, faces = cube()
    vertices = np.vstack([corners, [(0.5, 0.5, 1 - depth)]])
    faces[1:2] = [[(4, 5, 8)], [(5, 7, 8)], [(7, 6, 8)], [(6, 4, 8)]]
    return Body(vertices, faces)


def test_self_intersection():
    assert check_solid(notched(0.9)) == ()
    assert codes(notched(1.2)) == {306}
    assert codes(notched(1.0)) == {306}
    sideways = notched(0.5)
    sideways.vertices[8] = (1.5, 0.5, 0.5)
    assert codes(sideways) == {306}


def folded(y):
    """A cube whose top is cut in two at y: beyond y = 1 the second half folds back over the first."""
    corners, faces = cube()
    vertices = np.vstack([corners, [(0, y, 1), (1, y, 1)]])
    faces[1:2] = [[(4, 5, 9, 8)], [(8, 9, 7, 6)]]
    faces = [face for face in faces if face not in ([(1, 3, 7, 5)], [(2, 0, 4, 6)])]
    faces += [[(1, 3, 5)], [(3, 9, 5)], [(3, 7, 9)], [(2, 0, 4)], [(2, 4, 8)], [(2, 8, 6)]]
    return Body(vertices, faces)


def test_self_intersection_in_one_plane():
    assert check_solid(folded(0.5)) == ()
    assert codes(folded(1.3)) == {306}


def test_rings_touching_in_a_point_are_judged_by_their_inside():
    """A roof whose inner ring touches its outer one: a tower in the corner of a notch."""
    plan = [(0, 0), (9, 0), (9, 6), (6, 6), (6, 9), (0, 9)]
    tower = [(3, 3), (6, 3), (6, 6), (3, 6)]
    vertices = [(x, y, 0) for x, y in plan] + [(x, y, 5) for x, y in plan]
    vertices += [(3, 3, 5), (6, 3, 5), (3, 6, 5)] + [(x, y, 8) for x, y in tower]
    low = [12, 13, 9, 14]
    high = [15, 16, 17, 18]
    faces = [[(5, 4, 3, 2, 1, 0)], [tuple(range(6, 12)), tuple(low[::-1])], [tuple(high)]]
    faces += [[(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6)] for i in range(6)]
    faces += [[(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i])] for i in range(4)]
    assert check_solid(Body(np.array(vertices, dtype=float), faces)) == ()


def test_place_and_text():
    body = plain()
    body.vertices = body.vertices + np.array([5e5, 5e6, 0])
    problem = check_solid(Body(body.vertices, body.faces[:5]))[0]
    assert (problem.code, problem.name) == (302, NAMES[302])
    assert problem.where in {tuple(v) for v in body.vertices.tolist()}
    assert "hole" in problem.text


def test_damaged_input():
    body = plain()
    with pytest.raises(InputError, match="does not exist"):
        check_solid(Body(body.vertices[:5], body.faces))
    body.vertices[0, 0] = np.nan
    with pytest.raises(InputError, match="finite"):
        check_solid(body)
