"""Levels of detail, figures and objects of a city model, against shapes whose figures are known by hand."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.city_objects import BuildingSource, building_source, city_objects
from urbanmap_qgis.buildings.levels_of_detail import block_solid, height_quantiles, stepped_solids
from urbanmap_qgis.buildings.model_figures import figure_columns, model_figures
from urbanmap_qgis.buildings.party_walls import party_wall_areas
from urbanmap_qgis.buildings.solids.plan_partition import partition_plan
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.citymodel.model import FOOTPRINT, MULTI_SURFACE, ROOF_EDGE
from urbanmap_qgis.geometry.solid import OUTER_WALL, ROOF, Solid, multipolygon, volume


def blocks(plans, heights, base=0.0):
    cells = partition_plan(None, plans, heights, list(range(1, len(plans) + 1)))
    return building_solids(cells, base)


def gable(x=0.0, eaves=4.0, ridge=7.0, base=1.0, width=8.0, length=10.0):
    """A house with a ridge along y, closed, outwards; heights over sea."""
    half = width / 2
    plan = [(0, 0), (width, 0), (width, length), (0, length)]
    low = [(x + a, b, base) for a, b in plan]
    high = [(x + a, b, base + eaves) for a, b in plan]
    top = [(x + half, 0, base + ridge), (x + half, length, base + ridge)]
    vertices = np.array(low + high + top, float)
    faces = [(3, 2, 1, 0), (0, 1, 5, 8, 4), (1, 2, 6, 5), (2, 3, 7, 9, 6), (3, 0, 4, 7), (5, 6, 9, 8), (4, 8, 9, 7)]
    kinds = ("ground", *(OUTER_WALL,) * 4, ROOF, ROOF)
    return Solid(vertices, tuple((face,) for face in faces), kinds, (None,) * 5 + (1, 2))


def test_quantiles_of_a_slope_are_exact():
    ramp = np.array([[(0, 0, 0), (10, 0, 10), (10, 4, 10)], [(0, 0, 0), (10, 4, 10), (0, 4, 0)]], float)
    assert height_quantiles(ramp, [0.0, 0.25, 0.5, 0.7, 1.0]) == pytest.approx([0, 2.5, 5, 7, 10], abs=1e-9)
    rng = np.random.default_rng(3)
    triangles = rng.uniform(0, 10, (6, 3, 3))
    one, two = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    area = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    pick = rng.choice(6, 400_000, p=area / area.sum())
    u, v = np.sort(rng.uniform(0, 1, (2, len(pick))), axis=0)
    z = triangles[pick, 0, 2] * u + triangles[pick, 1, 2] * (v - u) + triangles[pick, 2, 2] * (1 - v)
    assert height_quantiles(triangles, [0.3, 0.5, 0.7]) == pytest.approx(np.quantile(z, [0.3, 0.5, 0.7]), abs=0.03)


def test_two_levels_meeting_give_the_height_between():
    two = blocks([shapely.box(0, 0, 6, 10), shapely.box(6, 0, 10, 10)], [5.0, 9.0])[0]
    (block,) = block_solid(two)
    assert volume(block) == pytest.approx(100 * 5.0)
    assert stepped_solids(two) == (two,)


def test_roofs_of_a_gable_become_one_and_a_step_stays():
    house = gable()
    (block,), (stepped,) = block_solid(house), stepped_solids(house)
    assert volume(house) == pytest.approx(80 * 5.5)
    assert volume(block) == volume(stepped) == pytest.approx(80 * 5.5)  # the median of a gable is its middle
    assert stepped.surface_type.count(ROOF) == 1


def test_figures_of_a_gable():
    house = gable()
    figures = model_figures([house], party_area=0.0)
    roof = 2 * 10 * np.hypot(4, 3)
    walls = 2 * 10 * 4 + 2 * (8 * 4 + 8 * 3 / 2)
    assert figures.ground_height == 1.0
    assert (figures.roof_min, figures.roof_50, figures.roof_70, figures.roof_max) == pytest.approx((4, 5.5, 6.1, 7))
    assert (figures.area_ground, figures.area_roof_flat, figures.area_roof_sloped) == pytest.approx((80, 0, roof))
    assert (figures.area_outer_walls, figures.area_party_walls) == pytest.approx((walls, 0))
    assert (figures.volume_lod12, figures.volume_lod13, figures.volume_lod22) == pytest.approx((440, 440, 440))
    assert figures.storeys_estimated == 2
    assert np.isnan(model_figures([]).roof_max) and model_figures([]).storeys_estimated is None
    assert np.isnan(model_figures([house], sloped=False).volume_lod22)
    assert np.isnan(model_figures([house]).area_outer_walls)
    assert figure_columns([figures])["storeys_estimated"] == [2]


def test_volumes_are_those_of_the_levels_solids():
    two = blocks([shapely.box(0, 0, 6, 10), shapely.box(6, 0, 10, 10)], [5.0, 9.0])[0]
    for solid in (two, gable()):
        figures = model_figures([solid])
        assert figures.volume_lod12 == pytest.approx(sum(map(volume, block_solid(solid))))
        assert figures.volume_lod13 == pytest.approx(sum(map(volume, stepped_solids(solid))))


def test_party_walls_are_what_both_have():
    low, high, far = gable(0.0), gable(8.05, eaves=6.0, ridge=9.0), gable(16.6)
    areas = party_wall_areas([[low], [high], [far], []])
    assert areas == pytest.approx([40.0, 40.0, 0.0, 0.0])  # 10 m long, 4 m of the lower; 0.55 m apart is not together
    turned = party_wall_areas([[low, gable(8.05)]])
    assert turned == pytest.approx([0.0])  # its own


def test_objects_have_all_levels_and_parts_where_they_stand_alone():
    apart = [*blocks([shapely.box(0, 0, 5, 5)], [4.0]), *blocks([shapely.box(20, 0, 25, 5)], [6.0])]
    (one, _), (two, figures), (none, _) = city_objects([
        BuildingSource("a", {"name": "x", "roof_70": "old"}, [gable()]), BuildingSource("b", {}, apart, "1.3"),
        BuildingSource("c", {"status": "not modelled"})])
    assert [(shape.lod, shape.kind) for shape in one.shapes] == [
        ("0", FOOTPRINT), ("0", ROOF_EDGE), ("1.2", "solid"), ("1.3", "solid"), ("2.2", "solid")]
    assert one.attributes["name"] == "x" and one.attributes["roof_70"] == 6.1 and one.attributes["roof_max"] == 7.0
    assert [part.id for part in two.parts] == ["b-part-1", "b-part-2"]
    assert [shape.lod for shape in two.shapes] == ["0", "0"] and len(two.shapes[0].surfaces) == 2
    assert [shape.lod for shape in two.parts[0].shapes] == ["1.2", "1.3"]
    assert figures.area_ground == pytest.approx(50) and np.isnan(figures.volume_lod22)
    assert not none.shapes and not none.parts and none.attributes == {"status": "not modelled"}


def test_surfaces_say_slope_azimuth_and_area():
    (item, _), = city_objects([BuildingSource("a", {}, [gable()])])
    faces = item.shapes_at("2")[0].surfaces
    east = next(face for face in faces if face.kind == "RoofSurface" and face.attributes["azimuth"] == 90.0)
    assert east.attributes["slope"] == pytest.approx(36.9) and east.attributes["area"] == pytest.approx(50.0)
    walls = {face.attributes["azimuth"]: face.attributes["area"] for face in faces if face.kind == "WallSurface"}
    assert walls == {180.0: 44.0, 90.0: 40.0, 0.0: 44.0, 270.0: 40.0}
    level = item.shapes_at("1")[0].surfaces
    assert all("azimuth" not in face.attributes for face in level if face.kind == "RoofSurface")


def test_a_layer_gives_back_inner_walls_and_says_what_is_not_closed():
    two = blocks([shapely.box(0, 0, 6, 10), shapely.box(6, 0, 10, 10)], [5.0, 9.0])
    source = building_source("a", multipolygon(two), {})
    assert sorted(source.solids[0].surface_type) == sorted(two[0].surface_type)
    open_faces = shapely.MultiPolygon(list(multipolygon(two).geoms)[1:])
    (item, _), = city_objects([building_source("a", open_faces, {})])
    assert item.shapes[-1].kind == MULTI_SURFACE and "302" in item.problems[0]
    assert not building_source("a", None, {}).solids and not building_source("a", shapely.box(0, 0, 1, 1), {}).solids
