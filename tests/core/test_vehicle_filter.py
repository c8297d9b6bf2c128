"""Vehicles taken out of overlapping frames, and evened frames."""

from __future__ import annotations

import numpy as np
import pytest
import rasterio
from rasterio.transform import Affine

from urbanmap_qgis.aerial.orthophotos import vehicles
from urbanmap_qgis.aerial.orthophotos.gain_compensation import (
    GainCorrection,
    RadiometricSamples,
    compensate_gains,
    robust_line,
)
from urbanmap_qgis.aerial.orthophotos.mosaic import PixelSelection
from urbanmap_qgis.aerial.orthophotos.vehicle_filter import filter_vehicles
from urbanmap_qgis.aerial.orthophotos.vehicles import composite, darkest, majority_vote, steepest_view
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.progress import Progress

CELL = 0.2


def road(x, y):
    return 100 + 30 * np.sin(x / 3) * np.cos(y / 4)


def write(path, shape=(120, 150), left=0.0, top=0.0, cell=CELL, vehicle=None, gain=1.0, bands=3, **profile):
    """An orthophoto of the road with a white or dark vehicle of 3 x 2 m at (x, y, brightness)."""
    profile = {"crs": "EPSG:6677", "dtype": "uint8", "nodata": 0, **profile}
    x, y = np.meshgrid(left + (np.arange(shape[1]) + 0.5) * cell, top - (np.arange(shape[0]) + 0.5) * cell)
    image = road(x, y) * gain
    if vehicle:
        image[(np.abs(x - vehicle[0]) < 1.5) & (np.abs(y - vehicle[1]) < 1)] = vehicle[2]
    with rasterio.open(path, "w", driver="GTiff", height=shape[0], width=shape[1], count=bands,
                       transform=Affine(cell, 0, left, 0, -cell, top), **profile) as target:
        target.write(np.repeat(np.rint(image)[None], bands, 0).astype(profile["dtype"]))
    return path


def read(path):
    with rasterio.open(path) as source:
        place, values = source.transform, source.read().astype(float)
    rows, columns = values.shape[1:]
    x, y = np.meshgrid(place.c + (np.arange(columns) + 0.5) * place.a, place.f + (np.arange(rows) + 0.5) * place.e)
    return values, road(x, y)


@pytest.mark.parametrize("dark", [False, True])
def test_three_orthophotos_on_one_grid(tmp_path, dark):
    paths = [write(tmp_path / f"{k}.tif", vehicle=(6 + 7 * k, -10, 5 if dark else 250)) for k in range(3)]
    made = filter_vehicles(paths, tmp_path / "out.tif")
    values, truth = read(tmp_path / "out.tif")
    assert np.abs(values - truth).max() < 2 and made.pixels_shared == 120 * 150


@pytest.mark.paper("J 3.2.1.2")
def test_darkest_is_the_papers(tmp_path):
    paths = [write(tmp_path / f"{k}.tif", vehicle=(6 + 7 * k, -10, 250)) for k in range(2)]
    filter_vehicles(paths, tmp_path / "out.tif", PixelSelection("darkest"))
    values, truth = read(tmp_path / "out.tif")
    assert np.abs(values - truth).max() < 2


def test_other_grid_exposure_and_no_data(tmp_path):
    first = write(tmp_path / "a.tif", vehicle=(8, -10, 250))
    other = write(tmp_path / "b.tif", (90, 160), -3.07, -4.11, 0.17, gain=1.2)
    third = write(tmp_path / "c.tif", (200, 250), -5.03, 3.01, 0.19, gain=0.9)
    filter_vehicles([first, other, third], tmp_path / "out.tif")
    values, truth = read(tmp_path / "out.tif")
    error = (values / values.mean() * truth.mean() - truth)
    assert values.shape == (3, 120, 150) and (values > 0).all()
    assert np.abs(error).max() < 6 and error.std() < 1.5


def test_position_is_kept_when_resampled(tmp_path):
    first = write(tmp_path / "a.tif", vehicle=(15, -12, 250))
    with rasterio.open(first, "r+") as source:
        image = source.read()
        image[:, 20:100, 20:120] = 0
        source.write(image)
    filter_vehicles([first, write(tmp_path / "b.tif", (200, 250), -5.03, 3.01, 0.19)], tmp_path / "out.tif",
                    PixelSelection("vote", even=False))
    values, truth = read(tmp_path / "out.tif")
    assert np.abs(values - truth)[:, 20:100, 20:120].max() < 2


def test_orthophotos_of_different_places(tmp_path):
    warnings = []
    made = filter_vehicles([write(tmp_path / "a.tif"), write(tmp_path / "b.tif", left=500.0)], tmp_path / "out.tif",
                           progress=Progress(warn=warnings.append))
    assert made.pixels_shared == 0 and "same ground" in warnings[0]


def test_16_bit_grey(tmp_path):
    paths = [write(tmp_path / f"{k}.tif", vehicle=(6 + 7 * k, -10, 60000), gain=200, bands=1, dtype="uint16")
             for k in range(2)]
    filter_vehicles(paths, tmp_path / "out.tif")
    values, truth = read(tmp_path / "out.tif")
    assert np.abs(values / 200 - truth).max() < 1


def test_input_that_cannot_be_used(tmp_path):
    good = write(tmp_path / "a.tif")
    with pytest.raises(InputError, match="two or more"):
        filter_vehicles([good], tmp_path / "out.tif")
    with pytest.raises(InputError, match="one kind"):
        filter_vehicles([good, write(tmp_path / "grey.tif", bands=1)], tmp_path / "out.tif")
    with pytest.raises(InputError, match="coordinate reference system"):
        filter_vehicles([good, write(tmp_path / "lost.tif", crs=None)], tmp_path / "out.tif")
    (tmp_path / "text.tif").write_text("no image")
    with pytest.raises(InputError, match=r"text\.tif cannot be read"):
        filter_vehicles([good, tmp_path / "text.tif"], tmp_path / "out.tif")
    assert not (tmp_path / "out.tif").exists()


ROAD, PAINT, WHITE_CAR, BLACK_CAR = 80.0, 200.0, 250.0, 20.0


@pytest.fixture
def crossing():
    """Four views of a road with a strip of paint; all see everything."""
    road = np.full((4, 20, 30, 3), ROAD, np.float32)
    road[:, :, 10:20] = PAINT
    return road, np.ones((4, 20, 30), bool)


def test_darkest_drops_a_light_vehicle_and_lets_a_dark_one_win(crossing):
    views, seen = crossing
    views[0, 5:9, 2:6], views[1, 5:9, 12:16] = WHITE_CAR, BLACK_CAR
    image = composite(views, darkest(views, seen))
    assert (image[5:9, 2:6] == ROAD).all()
    assert (image[5:9, 12:16] == BLACK_CAR).all()


def test_vote_drops_both(crossing):
    views, seen = crossing
    views[0, 5:9, 2:6], views[1, 5:9, 12:16] = WHITE_CAR, BLACK_CAR
    image = composite(views, majority_vote(views, seen, 255))
    assert (image[5:9, 2:6] == ROAD).all()
    assert (image[5:9, 12:16] == PAINT).all()


def test_two_views_are_decided_by_the_road_around(crossing):
    views, seen = crossing
    views, seen = views[:2], seen[:2]
    views[0, 5:9, 2:6], views[1, 5:9, 22:26] = WHITE_CAR, BLACK_CAR
    image = composite(views, majority_vote(views, seen, 255))
    assert (image[5:9, 2:6] == ROAD).all() and (image[5:9, 22:26] == ROAD).all()


def test_without_any_agreement_the_darkest_is_taken():
    views = np.array([250.0, 120.0, 30.0], np.float32)[:, None, None, None] * np.ones((1, 5, 5, 3), np.float32)
    assert (majority_vote(views, np.ones((3, 5, 5), bool), 255) == 2).all()


def test_vote_drops_vehicles_in_most_of_the_views(crossing):
    views, seen = crossing
    views[0, 8, 4], views[1, 8, 4] = 130.0, WHITE_CAR
    assert (composite(views, majority_vote(views, seen, 255, box=1))[8, 4] == ROAD).all()


def test_what_is_not_seen_has_no_say(crossing):
    views, seen = crossing
    views[2], seen[2] = 0.0, False
    seen[:, 0, 0] = False
    for number in (darkest(views, seen), majority_vote(views, seen, 255), steepest_view(views[..., 0], seen)):
        assert number[0, 0] == -1 and not (number == 2).any()
        assert (number[1:] >= 0).all()
        assert (composite(views, number)[0, 0] == 0).all()


@pytest.mark.parametrize("order", [(1, 0, 2, 3), (3, 2, 1, 0)])
def test_the_order_of_views_does_not_matter(crossing, order):
    views, seen = crossing
    views += np.random.default_rng(1).normal(0, 3, views.shape).astype(np.float32)
    seen &= np.random.default_rng(2).random(seen.shape) < 0.7
    for choose in (darkest, lambda v, s: majority_vote(v, s, 255)):
        first = composite(views, choose(views, seen))
        again = composite(views[list(order)], choose(views[list(order)], seen[list(order)]))
        np.testing.assert_array_equal(first, again)


def test_nearest_nadir():
    tangents = np.array([[[0.1, 0.3]], [[0.2, 0.2]]], np.float32)
    assert steepest_view(tangents, np.ones((2, 1, 2), bool)).tolist() == [[0, 1]]


def test_a_queue_in_most_views_gives_way_to_the_free_road():
    """Three of four views show the same two waiting vehicles, the fourth the lane line under them."""
    views = np.full((4, 90, 90, 3), ROAD, np.float32)
    views[:, :, 44:47] = PAINT
    views[:3, 20:58, 35:53], views[:3, 60:75, 35:53] = WHITE_CAR, BLACK_CAR
    image = composite(views, majority_vote(views, np.ones((4, 90, 90), bool), 255))
    free = (image == views[3]).all(axis=-1)
    # Corners of vehicles may stay: most of what is round them is road.
    assert free[22:73, 37:51].mean() > 0.97 and free.mean() > 0.98


def test_paint_is_not_erased_by_one_view_without_it():
    """A zebra crossing that three views show stays, although a grey vehicle in the fourth looks like the road."""
    views = np.full((4, 90, 90, 3), ROAD, np.float32)
    for left in range(10, 80, 8):
        views[:, 30:60, left:left + 4] = PAINT
    expected = views[0].copy()
    views[3, 35:55, 20:60] = ROAD * 1.05
    image = composite(views, majority_vote(views, np.ones((4, 90, 90), bool), 255))
    np.testing.assert_array_equal(image, expected)


def test_what_lies_beyond_the_reach_has_no_say():
    rng = np.random.default_rng(4)
    blocks = np.ones((1, 4, 4))
    grey = np.kron(rng.choice([60, 70, 90, 200], (4, vehicles.REACH, vehicles.REACH)), blocks)
    views = np.stack([grey, grey + 1, grey + 2], axis=-1).astype(np.float32)
    seen = np.kron(rng.random((4, vehicles.REACH, vehicles.REACH)) < 0.7, blocks) > 0
    whole = majority_vote(views, seen, 255)
    near = slice(vehicles.REACH - 1, 3 * vehicles.REACH + 1)
    cut = majority_vote(np.ascontiguousarray(views[:, near, near]), np.ascontiguousarray(seen[:, near, near]), 255)
    middle = slice(2 * vehicles.REACH - 1, 2 * vehicles.REACH + 1)
    here = slice(middle.start - near.start, middle.stop - near.start)
    assert np.array_equal(whole[middle, middle], cut[here, here])


@pytest.mark.parametrize("rows", [1, 31, 32, 33, 70])
def test_any_number_of_rows_is_voted_on(rows):
    views = np.full((3, rows, 9, 1), ROAD, np.float32)
    views[0, -1] = WHITE_CAR
    seen = np.ones(views.shape[:3], bool)
    assert set(majority_vote(views, seen, 255)[-1]) <= {1, 2}
    assert (majority_vote(views, np.zeros_like(seen), 255) == -1).all()


GAINS = np.array([[1.0, 1.1, 0.9], [1.25, 1.0, 1.0], [0.8, 0.95, 1.2]])
OFFSETS = np.array([[0.0, 4.0, -6.0], [-10.0, 0.0, 3.0], [12.0, -5.0, 0.0]])


def taken(noise=2.0, moved=0.1, points=4000, seed=3):
    """Samples of three frames in a row: 0 and 2 have no ground in common; a share of the values shows vehicles."""
    rng = np.random.default_rng(seed)
    truth = rng.uniform(50, 180, (points, 3))
    parts = []
    for frame, sees in enumerate((slice(0, 2000), slice(1000, 3500), slice(2500, 4000))):
        point = np.arange(points)[sees]
        values = truth[sees] * GAINS[frame] + OFFSETS[frame] + rng.normal(0, noise, (len(point), 3))
        vehicle = rng.random(len(point)) < moved
        values[vehicle] = rng.uniform(0, 255, (vehicle.sum(), 3))
        parts.append((np.full(len(point), frame), point, values))
    return RadiometricSamples(*(np.concatenate(part) for part in zip(*parts))), truth


def test_frames_agree_after_evening():
    samples, _ = taken()
    exposure = compensate_gains(samples, 3)
    level = np.array([60.0, 110.0, 170.0])[:, None]
    evened = [exposure.apply(frame, (level * GAINS[frame] + OFFSETS[frame]).astype(np.float32)) for frame in range(3)]
    assert np.abs(evened[0] - evened[1]).max() < 2.0
    assert np.abs(evened[0] - evened[2]).max() < 3.0
    np.testing.assert_allclose(np.log(exposure.gain).mean(axis=0), 0, atol=1e-3)


def test_the_order_of_samples_does_not_matter():
    samples, _ = taken()
    mixed = np.random.default_rng(1).permutation(len(samples.frame))
    again = compensate_gains(RadiometricSamples(samples.frame[mixed], samples.point[mixed], samples.values[mixed]), 3)
    np.testing.assert_array_equal(again.gain, compensate_gains(samples, 3).gain)


def test_equal_frames_stay_as_they_are():
    values = np.random.default_rng(1).uniform(20, 200, (1000, 1))
    samples = RadiometricSamples(np.repeat([0, 1], 1000), np.tile(np.arange(1000), 2), np.concatenate((values, values)))
    exposure = compensate_gains(samples, 2)
    np.testing.assert_allclose(exposure.gain, 1, atol=1e-9)
    np.testing.assert_allclose(exposure.offset, 0, atol=1e-6)


@pytest.mark.parametrize("points", [0, 50])
def test_frames_without_common_ground_stay_as_they_are(points):
    values = np.random.default_rng(1).uniform(20, 200, (2 * points, 3))
    samples = RadiometricSamples(np.repeat([0, 1], points), np.tile(np.arange(points), 2), values)
    exposure = compensate_gains(samples, 2)
    assert (exposure.gain == 1).all() and (exposure.offset == 0).all()
    assert (GainCorrection.identity(2, 3).apply(1, np.full((2, 3), 7, np.uint8)) == 7).all()


def test_line_with_noise_on_both_sides_and_outliers():
    rng = np.random.default_rng(5)
    truth = rng.uniform(40, 160, 5000)
    x, y = truth + rng.normal(0, 6, 5000), 1.3 * truth - 20 + rng.normal(0, 8, 5000)
    y[:1000] = rng.uniform(0, 255, 1000)
    gain, offset = robust_line(x, y)
    assert gain == pytest.approx(1.3, abs=0.03)
    assert gain * 100 + offset == pytest.approx(110, abs=1)


def test_line_of_a_flat_surface_compares_the_level_only():
    assert robust_line(np.full(300, 50.0), np.full(300, 60.0)) == (1.0, 10.0)
