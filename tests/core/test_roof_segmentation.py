"""Known answers for the roofs of one building (J 5.3.2 and beyond)."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.roofs.roof_segmentation import DEFAULTS, FEW_POINTS, NO_POINTS, OK, segment_roofs
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.settings.buildings import RoofParameters

DENSITY = 7.0
NOISE = 0.03


def scatter(polygon, height, density=DENSITY, seed=0):
    """Points on a polygon, evenly spread and jittered, with heights from a function of x and y or a number."""
    rng = np.random.default_rng(seed)
    left, bottom, right, top = polygon.bounds
    side = density**-0.5
    x, y = np.meshgrid(np.arange(left + side / 2, right, side), np.arange(bottom + side / 2, top, side))
    x, y = (a.ravel() + rng.uniform(-0.3, 0.3, a.size) * side for a in (x, y))
    keep = shapely.contains_xy(polygon, x, y)
    x, y = x[keep], y[keep]
    z = height(x, y) if callable(height) else np.full(len(x), float(height))
    return np.c_[x, y, z + rng.normal(0, NOISE, len(x))]


def segment(parts, outline, density=DENSITY, parameters=DEFAULTS, ground=0.0, **more):
    points = np.concatenate(parts)
    return points, segment_roofs(*points.T, outline, ground, density, parameters, **more)


def label_at(points, result, x, y):
    return int(result.roof_of_point[np.hypot(*(points[:, :2] - [x, y]).T).argmin()])


def test_flat_roof():
    outline = shapely.box(0, 0, 20, 15)
    points, result = segment([scatter(outline, 9.0)], outline)
    assert result.status == OK and len(result.roofs) == 1
    assert result.roofs.height[0] == pytest.approx(9.0, abs=0.01)
    assert result.roofs.height_max[0] == points[:, 2].max()
    assert result.roofs.points[0] == len(points)
    assert result.roofs.area[0] == pytest.approx(300, rel=0.05)
    assert result.roofs.density[0] == pytest.approx(DENSITY, rel=0.1)
    assert result.roofs.rmse[0] == pytest.approx(NOISE, rel=0.1)
    assert (result.roof_of_point == 1).all()


def test_setbacks_are_apart_and_numbered_from_low_to_high():
    outline = shapely.box(0, 0, 30, 10)
    steps = [scatter(shapely.box(10 * i, 0, 10 * i + 10, 10), h, seed=i) for i, h in enumerate((12.0, 6.0, 9.0))]
    points, result = segment(steps, outline)
    np.testing.assert_allclose(result.roofs.height, [6, 9, 12], atol=0.02)
    truth = np.repeat([3, 1, 2], [len(s) for s in steps])
    assert (result.roof_of_point == truth).mean() > 0.995
    assert [label_at(points, result, x, 5) for x in (5, 15, 25)] == [3, 1, 2]


def test_two_roofs_of_one_height_apart_in_plan():
    outline = shapely.box(0, 0, 30, 10)
    parts = [scatter(shapely.box(0, 0, 10, 10), 12), scatter(shapely.box(10, 0, 20, 10), 6),
             scatter(shapely.box(20, 0, 30, 10), 12)]
    points, result = segment(parts, outline)
    np.testing.assert_allclose(result.roofs.height, [6, 12, 12], atol=0.02)
    assert label_at(points, result, 5, 5) != label_at(points, result, 25, 5)


def test_parapet_belongs_to_its_roof_and_gives_the_paper_height():
    outline = shapely.box(0, 0, 30, 30)
    inner = outline.buffer(-0.6)
    _, result = segment([scatter(inner, 20.0), scatter(outline - inner, 21.1, seed=1)], outline)
    assert len(result.roofs) == 1
    assert result.roofs.height[0] == pytest.approx(20.0, abs=0.02)
    assert result.roofs.height_max[0] == pytest.approx(21.1, abs=0.15)
    assert (result.roof_of_point > 0).all()


def test_plant_room_a_metre_above_is_a_roof_of_its_own():
    outline = shapely.box(0, 0, 30, 30)
    room = shapely.box(10, 10, 16, 16)
    _, result = segment([scatter(outline - room, 20.0), scatter(room, 21.2, seed=1)], outline)
    np.testing.assert_allclose(result.roofs.height, [20.0, 21.2], atol=0.02)
    assert result.roofs.area[1] == pytest.approx(36, rel=0.15)


def test_small_annex_below_the_paper_threshold_is_found():
    outline = shapely.box(0, 0, 33, 20)
    annex = shapely.box(30, 0, 33, 4)
    _, result = segment([scatter(shapely.box(0, 0, 30, 20), 15.0), scatter(annex, 2.6, seed=1)], outline)
    np.testing.assert_allclose(result.roofs.height, [2.6, 15.0], atol=0.02)


@pytest.mark.parametrize("size", [3, 5])
def test_shed_smaller_than_the_paper_minimum_has_its_roof(size):
    outline = shapely.box(0, 0, size, size)
    _, result = segment([scatter(outline, 2.4)], outline)
    assert len(result.roofs) == 1
    assert result.roofs.height[0] == pytest.approx(2.4, abs=0.03)


def test_gable_is_cut_into_few_levels_within_the_tolerance():
    outline = shapely.box(0, 0, 12, 10)
    points, result = segment([scatter(outline, lambda x, y: 10 - np.abs(y - 5) * 0.8)], outline)
    assert 3 <= len(result.roofs) <= 5
    model = np.r_[np.nan, result.roofs.height][result.roof_of_point]
    assert np.sqrt(np.nanmean((points[:, 2] - model) ** 2)) < 0.47
    heights = np.sort(result.roofs.height)
    assert heights[0] > 6 and heights[-1] < 10


def test_finer_tolerance_gives_more_roofs_and_smaller_errors():
    outline = shapely.box(0, 0, 20, 12)
    found = []
    for tolerance in (1.5, 0.6, 0.3):
        _, result = segment([scatter(outline, lambda x, y: 4 + 0.5 * y)], outline,
                            parameters=RoofParameters(height_rmse=tolerance))
        error = np.sqrt(np.average(result.roofs.rmse**2, weights=result.roofs.points))
        assert error <= tolerance * 1.05
        found.append(len(result.roofs))
    assert found == sorted(found) and found[0] < found[-1]


def test_without_tolerance_the_roofs_are_the_ones_of_the_paper():
    outline = shapely.box(0, 0, 40, 12)
    slope = scatter(shapely.box(0, 0, 20, 12), lambda x, y: 4 + 0.1 * y)
    flat = scatter(shapely.box(20, 0, 40, 12), 14.0, seed=1)
    _, result = segment([slope, flat], outline, parameters=RoofParameters(height_rmse=0.0))
    assert len(result.roofs) == 2
    np.testing.assert_allclose(result.roofs.height, [4.6, 14.0], atol=0.1)


def test_clutter_gets_no_roof():
    outline = shapely.box(0, 0, 20, 20)
    rng = np.random.default_rng(3)
    roof = scatter(outline, 10.0)
    antenna = np.c_[np.full(6, 5.0), np.full(6, 5.0), np.linspace(11, 15, 6)]
    wall = np.c_[rng.uniform(0, 20, 100), np.full(100, -0.1), rng.uniform(0, 9, 100)]
    ground = np.c_[rng.uniform(-1, 0, 50), rng.uniform(0, 20, 50), rng.uniform(0, 0.5, 50)]
    points, result = segment([roof, antenna, wall, ground], outline)
    assert len(result.roofs) == 1
    of = np.split(result.roof_of_point, np.cumsum([len(roof), len(antenna), len(wall)]))
    assert (of[0] == 1).all()
    assert (of[1] == 0).all()
    assert (of[2][points[len(roof) + len(antenna):][:100, 2] < 9.5] == 0).all()
    assert (of[3] == 0).all()
    assert result.roofs.height_max[0] < 10.2


def test_neighbour_in_the_expanded_outline_is_left_out():
    outline = shapely.box(0, 0, 10, 10)
    neighbour = scatter(shapely.box(10, 0, 11, 10), 20.0, seed=1)
    own = scatter(outline, 8.0)
    _, result = segment([own, neighbour], outline)
    np.testing.assert_allclose(result.roofs.height, [8.0], atol=0.02)
    assert (result.roof_of_point[len(own):] == 0).all()


def test_roof_that_sticks_out_of_the_outline_is_followed():
    roof = shapely.box(-1.5, 0, 10, 10)
    points, result = segment([scatter(roof, 8.0)], shapely.box(0, 0, 10, 10))
    assert (result.roof_of_point == 1).all()
    assert label_at(points, result, -1, 5) == 1


@pytest.mark.parametrize("density", [1.0, 2.0, 4.0, 30.0])
def test_two_levels_at_any_density(density):
    outline = shapely.box(0, 0, 16, 10)
    parts = [scatter(shapely.box(0, 0, 8, 10), 5.0, density),
             scatter(shapely.box(8, 0, 16, 10), 9.0, density, seed=1)]
    _, result = segment(parts, outline, density)
    np.testing.assert_allclose(result.roofs.height, [5, 9], atol=0.05)


@pytest.mark.parametrize(
    "n, status, roofs", [(0, NO_POINTS, 0), (2, NO_POINTS, 0), (3, FEW_POINTS, 1), (8, FEW_POINTS, 1)]
)
def test_few_points(n, status, roofs):
    rng = np.random.default_rng(0)
    x, y = rng.uniform(0, 5, (2, n))
    result = segment_roofs(x, y, np.full(n, 4.0), shapely.box(0, 0, 5, 5), 0.0, 1.0)
    assert result.status == status
    np.testing.assert_allclose(result.roofs.height, [4.0] * roofs)
    assert result.roof_of_point.shape == (n,)
    assert (result.roof_of_point == (1 if roofs else 0)).all()


def test_order_of_points_does_not_matter():
    outline = shapely.box(0, 0, 20, 12)
    points, first = segment([scatter(outline, lambda x, y: 4 + 0.5 * y + 3 * (x > 12))], outline)
    order = np.random.default_rng(0).permutation(len(points))
    second = segment_roofs(*points[order].T, outline, 0.0, DENSITY)
    np.testing.assert_array_equal(first.roof_of_point[order], second.roof_of_point)
    np.testing.assert_array_equal(first.roofs.height, second.roofs.height)


def test_multipolygon_and_far_coordinates():
    shift = np.array([-520_000.0, 1_250_000.0, 100.0])
    outline = shapely.MultiPolygon([shapely.box(0, 0, 8, 8), shapely.box(12, 0, 20, 8)])
    points = np.concatenate([scatter(part, 6.0, seed=i) for i, part in enumerate(outline.geoms)]) + shift
    moved = shapely.transform(outline, lambda xy: xy + shift[:2])
    result = segment_roofs(*points.T, moved, 100.0, DENSITY)
    np.testing.assert_allclose(result.roofs.height, [106, 106], atol=0.02)


@pytest.mark.parametrize("change", [{"z": np.ones(4)}, {"z": np.full(5, np.nan)}, {"density": 0.0},
                                    {"ground": np.nan}])
def test_bad_input_is_refused(change):
    arguments = {"x": np.ones(5), "y": np.ones(5), "z": np.ones(5), "outline": shapely.box(0, 0, 2, 2), "ground": 0.0,
                     "density": 1.0}
    with pytest.raises(InputError):
        segment_roofs(**{**arguments, **change})
