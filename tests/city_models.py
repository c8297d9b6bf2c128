"""City models for tests of writers: a gable house, a house in two parts, one without a model, one with a texture."""

import numpy as np

from urbanmap_qgis.buildings.city_objects import BuildingSource, city_objects
from urbanmap_qgis.buildings.solids.plan_partition import Cell
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.citymodel.model import CityModel, CityReference
from urbanmap_qgis.geometry.solid import OUTER_WALL, ROOF, FaceTexture, Solid

PLACE = np.array([-6950.0, -34100.0, 20.0])
"""A place in Tokyo, plane rectangular zone IX, m."""


def gable_house(shift=(0.0, 0.0, 0.0), eaves=4.0, ridge=7.0):
    """A closed house of 8 by 10 m with a ridge along y."""
    low = [(0, 0, 0), (8, 0, 0), (8, 10, 0), (0, 10, 0)]
    high = [(x, y, eaves) for x, y, _ in low]
    vertices = np.array([*low, *high, (4, 0, ridge), (4, 10, ridge)], float) + PLACE + shift
    faces = [(3, 2, 1, 0), (0, 1, 5, 8, 4), (1, 2, 6, 5), (2, 3, 7, 9, 6), (3, 0, 4, 7), (5, 6, 9, 8), (4, 8, 9, 7)]
    kinds = ("ground", *(OUTER_WALL,) * 4, ROOF, ROOF)
    return Solid(vertices, tuple((face,) for face in faces), kinds, (None,) * 5 + (1, 2))


def court(shift):
    """A block of 12 by 12 m round a court of 4 by 4 m."""
    import shapely

    plan = shapely.box(0, 0, 12, 12).difference(shapely.box(4, 4, 8, 8))
    plan = shapely.transform(plan, lambda xy: xy + PLACE[:2] + shift)
    return building_solids((Cell(plan, 1, PLACE[2] + 6.0),), PLACE[2])


def wall_texture(solid, face, image):
    """A texture on one face, its places the corners of the image."""
    faces = [None] * len(solid.faces)
    faces[face] = FaceTexture(image, (np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)[:len(solid.faces[face][0])],))
    return faces


def town(epsg=6677, heights="JGD2011", images=None, **attributes):
    """A model of four buildings."""
    house = gable_house((0, 0, 0))
    textures = [wall_texture(house, 2, next(iter(images)))] if images else ()
    sources = [
        BuildingSource("家 1", {"note": "a < b & \"c\"", "points": 7, "rmse": 0.25, "bad": float("nan"), **attributes},
                       [house], textures=textures),
        BuildingSource("b2", {"status": "ok"}, [gable_house((20, 0, 0)), gable_house((40, 0, 0), 5.0, 6.0)]),
        BuildingSource("b3", {"status": "not modelled"}), BuildingSource("b4", {}, court((0, 30)), "1.3")]
    return CityModel(CityReference("", epsg, False, heights), [item for item, _ in city_objects(sources)],
                     images or {}, "Town", "2026-04-01")
