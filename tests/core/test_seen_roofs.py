"""What the cloud has seen of a building: density and edge round its outline, share and expected error of its roofs."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.building_model import FitPoints, RoofInput, model_building, roof_remarks
from urbanmap_qgis.buildings.model_status import CLOUD_EDGE, OK, UNSEEN, quality
from urbanmap_qgis.buildings.model_table import surface_columns
from urbanmap_qgis.buildings.quality import RoofCell
from urbanmap_qgis.buildings.seen.cloud_cover import CloudCover, cloud_cover
from urbanmap_qgis.buildings.seen.seen_roofs import LEVEL_ERROR, seen_roofs

HOUSE = shapely.box(50, 50, 60, 60)


def random_points(x0, y0, x1, y1, density):
    """Points (n, 3) anywhere, as those of a cloud."""
    count = int(density * (x1 - x0) * (y1 - y0))
    return np.random.default_rng(3).uniform((x0, y0, 0), (x1, y1, 0), (count, 3))


def even_points(x0, y0, x1, y1, density, z=0.0):
    """Points (n, 3) on a regular raster."""
    step = 1.0 / np.sqrt(density)
    x, y = [a.ravel() for a in np.meshgrid(np.arange(x0 + step / 2, x1, step), np.arange(y0 + step / 2, y1, step))]
    return np.column_stack([x, y, np.full(len(x), float(z))])


def cover_of(points, *outlines):
    held = np.empty(len(outlines), object)
    held[:] = outlines
    return cloud_cover(points[:, 0], points[:, 1], np.ones(len(points), bool), held, 4.0)


@pytest.mark.parametrize("left", [1.0, 0.5, 0.0])
def test_density_is_that_of_the_cloud_round_a_building_whatever_it_has_itself(left):
    cloud = random_points(0, 0, 110, 110, 4.0)
    own = shapely.contains_xy(HOUSE, *cloud[:, :2].T)
    gone = own & (cloud[:, 0] > 50 + 10 * left)
    found = cover_of(cloud[~gone], HOUSE, None)
    assert found.density[0] == pytest.approx(4.0, rel=0.1) and np.isnan(found.density[1])
    assert found.beyond[0] == 0.0


def test_density_is_local():
    cloud = np.concatenate([random_points(0, 0, 200, 110, 2.0), random_points(200, 0, 400, 110, 8.0)])
    found = cover_of(cloud, HOUSE, shapely.box(340, 50, 350, 60))
    assert found.density == pytest.approx([2.0, 8.0], rel=0.15)


@pytest.mark.parametrize("edge", [52.0, 55.0, 58.0])
def test_the_share_beyond_the_clouds_edge_is_told(edge):
    found = cover_of(random_points(0, 0, edge, 110, 4.0), HOUSE)
    assert found.beyond[0] == pytest.approx((60 - edge) / 10, abs=0.16)


def test_streets_of_a_cloud_of_buildings_alone_are_no_edge():
    blocks = [random_points(x, y, x + 30, y + 30, 4.0) for x in range(0, 150, 45) for y in range(0, 150, 45)]
    house = shapely.box(50, 50, 70, 70)
    cloud = np.concatenate(blocks)
    cut = cloud[~(shapely.contains_xy(house, *cloud[:, :2].T) & (cloud[:, 0] > 60))]
    assert cover_of(cut, house).beyond[0] == 0.0


def flat(polygon, height, slope=0.0):
    return RoofCell(polygon, height, 1, (slope, 0.0), (50.0, 50.0))


def test_the_unseen_share_is_exact():
    points = even_points(50, 50, 55, 60, 4.0, 8.0)
    seen = seen_roofs([flat(HOUSE, 8.0)], points, 4.0, 0.0)
    # The last points stand 0.25 m within 55 m; two spacings of 0.5 m lie beyond them.
    assert seen.unseen == pytest.approx((60 - (55 - 0.25 + 1.0)) / 10, abs=0.03)
    assert seen.seen[0] == pytest.approx(1 - seen.unseen)
    whole = seen_roofs([flat(HOUSE, 8.0)], even_points(50, 50, 60, 60, 4.0, 8.1), 4.0, 0.0)
    assert whole.unseen == whole.doubt == 0.0 and whole.sigma[0] == pytest.approx(0.1)


def test_the_expected_error_grows_with_what_is_not_seen_and_with_the_height():
    def sigma(right, height, slope=0.0):
        points = even_points(50, 50, right, 60, 4.0)
        points[:, 2] = height + slope * (points[:, 0] - 50.0)
        return seen_roofs([flat(HOUSE, height, slope)], points, 4.0, 0.0).sigma[0]

    assert sigma(58, 8.0) < sigma(55, 8.0) < sigma(52, 8.0) < LEVEL_ERROR * 8.0
    assert sigma(55, 20.0) == pytest.approx(2.5 * sigma(55, 8.0))
    assert sigma(55, 8.0, 0.1) < sigma(55, 8.0)


def test_each_roof_has_its_own_share():
    left, right = shapely.box(50, 50, 55, 60), shapely.box(55, 50, 60, 60)
    seen = seen_roofs([flat(left, 8.0), flat(right, 6.0)], even_points(50, 50, 55, 60, 4.0, 8.0), 4.0, 0.0)
    assert seen.seen[0] == 1.0 and seen.seen[1] == pytest.approx(0.15, abs=0.05)
    assert seen.sigma[0] == 0.0 and seen.sigma[1] > 0.5


def test_without_any_point_nothing_is_seen():
    seen = seen_roofs([flat(HOUSE, 8.0)], np.zeros((0, 3)), 4.0, 0.0)
    assert seen.unseen == pytest.approx(1.0) and seen.seen[0] == 0.0 and seen.doubt > 0


def made(points, cover):
    roofs = RoofInput(np.array([HOUSE], object), np.array([1]), np.array([1]), np.array([8.0]),
                      np.array(["ok"], object))
    return model_building(1, HOUSE, "", roofs, 0.0, FitPoints(points, np.ones(len(points), int)), cover=cover)


def test_half_a_roof_is_not_ok_where_the_density_of_the_cloud_is_known():
    half = even_points(50, 50, 57, 60, 8.0, 8.0)
    assert made(half, (8.0, 0.0)).status == UNSEEN
    assert made(half, (8.0, 0.3)).status == CLOUD_EDGE and "30 %" in made(half, (8.0, 0.3)).reason
    assert made(half, (np.nan, np.nan)).status == OK  # as before, where nothing is known of the cloud
    whole = made(even_points(50, 50, 60, 60, 8.0, 8.0), (8.0, 0.0))
    assert whole.status == OK and whole.quality > made(half, (8.0, 0.0)).quality


def test_roofs_carry_what_was_seen_of_them():
    model = made(even_points(50, 50, 57, 60, 8.0, 8.0), (8.0, 0.0))
    said = [each for solid in roof_remarks(model) for each in solid if each]
    assert len(said) == 1 and 0.7 < said[0]["seen"] < 0.85 and said[0]["sigma"] > 0.3
    columns = surface_columns([model])
    assert columns["seen"][columns["surface_type"].index("roof")] == said[0]["seen"]
    assert columns["sigma"][columns["surface_type"].index("ground")] is None
    unknown = made(even_points(50, 50, 57, 60, 8.0, 8.0), (np.nan, np.nan))
    assert not any(each for solid in roof_remarks(unknown) for each in solid)


def test_quality_falls_with_doubt_and_a_model_off_its_points_has_none():
    assert quality(OK, 0.2, 0.1, 0.05, 0.3, 0.8) < quality(OK, 0.2, 0.1, 0.05, 0.3, 0.4) < quality(OK, 0.2, 0.1, 0.05,
                                                                                                  0.0, 0.0)
    assert quality(OK, np.nan, np.nan, 1.0, 0.3, 0.8) == 0.0


def test_a_layer_without_the_columns_tells_nothing_of_the_cloud():
    assert CloudCover.of(None, np.zeros(1)) is None and CloudCover.of(np.ones(1), None) is None
