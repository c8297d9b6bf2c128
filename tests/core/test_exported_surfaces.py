"""What a layer of surfaces says of faces goes with them into the exported city model."""

import math

import numpy as np
import shapely

from urbanmap_qgis.buildings.city_export import SurfaceRows, export_buildings, known_remarks
from urbanmap_qgis.buildings.solids.sloped_solid import SlopedCell, sloped_solids
from urbanmap_qgis.geometry.solid import multipolygon

ROOFS = [SlopedCell(shapely.box(0, 0, 6, 8), 1, (0.0, 0.0, 9.0), (0.0, 0.0)),
         SlopedCell(shapely.box(6, 0, 12, 8), 2, (0.0, 0.0, 6.0), (0.0, 0.0))]


def test_seen_and_sigma_of_roofs_are_exported():
    model = multipolygon(sloped_solids(ROOFS, 0.0))
    lids = np.array([shapely.force_3d(cell.polygon, height) for cell, height in zip(ROOFS, (9.0, 6.0))], object)
    said = known_remarks({"seen": [0.9, None], "sigma": [0.05, math.nan], "words": ["a", "b"]}, [0, 1])
    assert said == [{"seen": 0.9, "sigma": 0.05}, {}]
    made = export_buildings(["a"], [model], [{}], ["1.3"], SurfaceRows(lids, ["roof", "roof"], [1, 2], said))
    found = {surface.attributes.get("roof_id"): surface.attributes for item in made.objects[0].objects()
             for shape in item.shapes if shape.lod == "1.3" for surface in shape.surfaces
             if surface.kind == "RoofSurface"}
    assert found[1]["seen"] == 0.9 and found[1]["sigma"] == 0.05
    assert "seen" not in found[2] and "sigma" not in found[2]


def test_surfaces_without_remarks_say_nothing():
    model = multipolygon(sloped_solids(ROOFS, 0.0))
    lids = np.array([shapely.force_3d(ROOFS[0].polygon, 9.0)], object)
    made = export_buildings(["a"], [model], [{}], ["1.3"], SurfaceRows(lids, ["roof"], [1]))
    assert not any("seen" in surface.attributes for item in made.objects[0].objects() for shape in item.shapes
                   for surface in shape.surfaces)
