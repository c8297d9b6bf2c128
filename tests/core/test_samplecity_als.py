"""The sample city's airborne laser points against the city's own truth."""

import laspy
import numpy as np
import pytest
import shapely

from urbanmap_qgis.samplecity.laser import als
from urbanmap_qgis.samplecity.scene.world import make_scene


@pytest.fixture(scope="module")
def city():
    return make_scene(60, "canyon", 3)


@pytest.fixture(scope="module")
def scanned(city):
    return als.simulate_strips(city, np.random.SeedSequence(9))


def test_true_points_lie_on_the_true_surfaces(city, scanned):
    points, _ = scanned
    ground = points.classification == 2
    x, y, z = points.true[ground].T
    gap = np.abs(z - city.ground_height(x, y))
    assert np.mean(gap < 1e-5) > 0.995 and gap.max() < 0.2
    x, y, z = points.true[points.classification == 6].T
    roof = np.full(len(x), np.nan)
    for building in city.buildings:
        for part in building.parts:
            inner = part.plan.buffer(-part.parapet_width - 1e-6)
            shapely.prepare(inner)
            inside = shapely.contains_xy(inner, x, y)
            for structure in part.structures:
                inside &= ~shapely.contains_xy(structure.plan.buffer(1e-6), x, y)
            if part.z_ridge is None:
                roof[inside] = part.z_roof
    known = np.isfinite(roof) & (z > roof - 0.01) & (z < roof + 0.01)
    assert np.count_nonzero(known) > 2000
    assert np.abs(z - roof)[known].max() < 1e-6


def test_noise_is_what_is_stated(scanned):
    points, shifts = scanned
    good = points.classification != 7
    for strip in (1, 2):
        error = (points.xyz - points.true)[good & (points.strip == strip)]
        np.testing.assert_allclose(error.mean(axis=0), shifts[strip - 1], atol=0.005)
        np.testing.assert_allclose(error.std(axis=0), [als.PLAN_JITTER, als.PLAN_JITTER, als.HEIGHT_JITTER], rtol=0.05)


def test_density_strips_and_returns(city, scanned):
    points, _ = scanned
    area = city.extent.buffer(als.MARGIN, join_style="mitre").area
    assert len(points) / area == pytest.approx(als.DENSITY, rel=0.1)
    assert (np.diff(points.time) >= 0).all()
    assert set(points.strip) == {1, 2}
    assert {1, 2, 5, 6} <= set(points.classification)
    several = points.returns > 1
    assert several.any() and (points.return_number <= points.returns).all()
    first = several & (points.return_number == 1)
    assert (points.classification[first & (points.classification != 7)] == 5).all()


def test_points_lie_on_the_line_of_their_pulse(city, scanned):
    points, _ = scanned
    pulses = als.strip_pulses(city, 1)
    rows = np.searchsorted(pulses.time, points.time[points.strip == 2])
    away = points.true[points.strip == 2] - pulses.origin[rows]
    off = np.linalg.norm(np.cross(away, pulses.direction[rows]), axis=1)
    assert off.max() < 1e-6
    np.testing.assert_allclose(np.linalg.norm(pulses.direction, axis=1), 1.0)


def test_elevated_road_has_its_class():
    points, _ = als.simulate_strips(make_scene(60, "elevated road", 3), np.random.SeedSequence(9))
    assert np.count_nonzero(points.classification == 17) > 0.05 * len(points)


def test_files_hold_the_points_and_the_same_seed_gives_the_same_bytes(city, scanned, tmp_path):
    points, _ = scanned
    als.write_als(city, tmp_path / "a", np.random.SeedSequence(9))
    als.write_als(city, tmp_path / "b", np.random.SeedSequence(9))
    for name in ("als.laz", "als_classified.laz"):
        assert (tmp_path / "a/als" / name).read_bytes() == (tmp_path / "b/als" / name).read_bytes()
    las = laspy.read(str(tmp_path / "a/als/als_classified.laz"))
    np.testing.assert_allclose(las.xyz, points.xyz, atol=0.00051)
    np.testing.assert_array_equal(las.classification, points.classification)
    assert las.header.parse_crs().to_epsg() == 6677
    assert set(laspy.read(str(tmp_path / "a/als/als.laz")).classification) == {1}
