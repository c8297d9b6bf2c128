"""Marking points on a made-up road surface whose paint is known exactly."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.markings.marking_points import MarkingPointSettings, Noise, marking_points, roughness

WHITE = 3.5


def swept(length=40.0, width=8.0, seed=1):
    """Points of a scanner that looks across the road: lines 12 cm apart, beams that lie farther apart to the sides."""
    rng = np.random.default_rng(seed)
    angle = np.radians(np.arange(-65, 65, 0.5))
    v = 2.0 * np.tan(angle)
    v = v[np.abs(v) < width / 2]
    u = np.arange(0, length, 0.12)
    u, v = (part.ravel() for part in np.meshgrid(u, v, indexing="ij"))
    return u + rng.normal(0, 0.01, len(u)), v + rng.normal(0, 0.004, len(v)), rng


def lit(u, v, paint, ground, footprint=0.06):
    """Brightness of spots of 6 cm: means of paint over three places across."""
    return np.mean([np.where(paint(u, v + shift), WHITE, ground(u, v + shift)) for shift in (-footprint / 2, 0,
                                                                                            footprint / 2)], axis=0)


def asphalt(u, v):
    return np.ones(len(u))


def line(at, width=0.15, start=2.0, end=38.0):
    return lambda u, v: (np.abs(v - at) < width / 2) & (u > start) & (u < end)


def turned(u, v, degrees, offset=(500.0, 900.0)):
    a = np.radians(degrees)
    return offset[0] + u * np.cos(a) - v * np.sin(a), offset[1] + u * np.sin(a) + v * np.cos(a)


def found(u, v, brightness, rng, z=None, degrees=17.0, noise=0.1, **settings):
    x, y = turned(u, v, degrees)
    z = np.zeros(len(u)) if z is None else z
    brightness = brightness * np.exp(noise * rng.standard_normal(len(u)))
    return marking_points(x, y, z + rng.normal(0, 0.003, len(u)), brightness, Noise(0.003, noise),
                          MarkingPointSettings(**settings))


def score(answer, truth):
    """Precision and recall."""
    hit = (answer.paint & truth).sum()
    return hit / max(answer.paint.sum(), 1), hit / truth.sum()


@pytest.mark.parametrize("degrees", [0, 17, 45, 90, 200])
@pytest.mark.parametrize("at", [0.0, 1.8, -3.0])
def test_a_line_is_found_where_it_is(degrees, at):
    u, v, rng = swept()
    paint = line(at)
    answer = found(u, v, lit(u, v, paint, asphalt), rng, degrees=degrees)
    truth = paint(u, v)
    precision, recall = score(answer, truth)
    assert precision > 0.85 and recall > 0.93
    # Points beside the line may be lit by it, but on both sides alike.
    assert abs(v[answer.paint].mean() - v[truth].mean()) < 0.006
    assert np.abs(v[answer.paint] - at).max() < 0.15 / 2 + 0.035


def test_quality_of_the_answer():
    u, v, rng = swept()
    answer = found(u, v, lit(u, v, line(0.5), asphalt), rng)
    assert np.median(answer.contrast[answer.paint]) == pytest.approx(WHITE, rel=0.1)
    assert np.isnan(answer.contrast[~answer.paint]).all() and not answer.weight[~answer.paint].any()
    assert 0.7 < np.median(answer.weight[answer.paint]) <= 1.0


def test_zebra_and_stop_line():
    u, v, rng = swept()

    def paint(u, v):
        return ((u > 10) & (u < 14) & (np.mod(v, 0.9) < 0.45)) | ((u > 20) & (u < 20.45))
    truth = paint(u, v)
    precision, recall = score(found(u, v, lit(u, v, paint, asphalt), rng), truth)
    assert precision > 0.9 and recall > 0.95


def test_two_asphalts_a_wet_patch_and_paving_are_ground():
    u, v, rng = swept()

    def ground(u, v):
        level = np.where(u > 20, 1.6, 1.0)
        level = np.where(np.hypot(u - 10, v - 1) < 1.2, 0.45, level)
        return np.where(v < -2.5, 2.1, level)
    answer = found(u, v, lit(u, v, lambda u, v: np.zeros(len(u), bool), ground), rng)
    assert answer.paint.mean() < 0.002
    paint = line(1.0)
    precision, recall = score(found(u, v, lit(u, v, paint, ground), rng), paint(u, v))
    assert precision > 0.8 and recall > 0.88


def test_kerb_face_is_no_line():
    u, v, rng = swept()
    kerb = np.abs(v - 2.4) < 0.03
    z = np.where(v > 2.4, 0.15, 0.0)
    z = np.where(kerb, rng.uniform(0, 0.15, len(u)), z)
    brightness = lit(u, v, line(2.0), lambda u, v: np.where(v > 2.4, 2.0, 1.0))
    brightness[kerb] = 4.0
    answer = found(u, v, brightness, rng, z=z)
    assert (answer.paint & (v > 2.3)).sum() < 0.03 * kerb.sum()
    assert (answer.paint & line(2.0)(u, v)).sum() > 0.9 * line(2.0)(u, v).sum()


def test_worn_paint_is_found_in_part():
    u, v, rng = swept()
    worn = rng.random(len(u)) < 0.4
    paint = line(0.3, 0.3)
    brightness = np.where(paint(u, v) & ~worn, WHITE, 1.0)
    precision, recall = score(found(u, v, brightness, rng), paint(u, v) & ~worn)
    assert precision > 0.9 and recall > 0.9


def test_specks_and_wide_bright_surfaces_are_left_out():
    u, v, rng = swept()

    def bright(u, v):
        return (np.hypot(u - 10, v - 1) < 0.1) | (np.hypot(u - 15, v + 1) < 0.08) | ((u > 22) & (u < 26) & (v > -1.5))
    answer = found(u, v, lit(u, v, bright, asphalt), rng)
    assert answer.paint.sum() < 20


def test_noise_alone_gives_no_markings():
    u, v, rng = swept()
    assert found(u, v, asphalt(u, v), rng, noise=0.14).paint.sum() == 0
    assert found(u, v, asphalt(u, v), rng, noise=0.45).paint.mean() < 0.003


def test_order_and_place_on_the_grid_do_not_matter():
    u, v, rng = swept(20.0)
    x, y = turned(u, v, 30)
    brightness = lit(u, v, line(1.0), asphalt) * np.exp(0.1 * rng.standard_normal(len(u)))
    z = rng.normal(0, 0.003, len(u))
    first = marking_points(x, y, z, brightness)
    turn = rng.permutation(len(x))
    assert np.array_equal(marking_points(x[turn], y[turn], z[turn], brightness[turn]).paint, first.paint[turn])
    moved = marking_points(x + 40.0, y - 80.0, z + 3.0, brightness)
    assert (moved.paint != first.paint).mean() < 1e-3


def test_what_is_beyond_reach_does_not_matter():
    u, v, rng = swept(60.0)
    x, y = turned(u, v, 30)
    brightness = lit(u, v, line(1.0, start=0, end=60), asphalt) * np.exp(0.1 * rng.standard_normal(len(u)))
    z = np.zeros(len(u))
    whole = marking_points(x, y, z, brightness)
    reach = MarkingPointSettings().reach
    part = np.flatnonzero((u > 30 - reach) & (u < 34 + reach))
    own = (u[part] > 30) & (u[part] < 34)
    alone = marking_points(x[part], y[part], z[part], brightness[part])
    assert np.array_equal(alone.paint[own], whole.paint[part][own])


def test_nothing_and_little():
    empty = np.empty(0)
    assert not len(marking_points(empty, empty, empty, empty).paint)
    one = np.ones(1)
    assert not marking_points(one, one, one, one).paint.any()


def test_roughness():
    rng = np.random.default_rng(1)
    x, y = rng.uniform(0, 20, (2, 60_000))
    assert roughness(x, y, 0.01 * x + rng.normal(0, 0.02, len(x))) == pytest.approx(0.02, rel=0.1)
    assert np.isnan(roughness(x[:10], y[:10], y[:10]))


@pytest.mark.parametrize("wrong", [{"contrast": 0.0}, {"block_size": -1.0}, {"max_width": 0.0}])
def test_settings_out_of_range(wrong):
    with pytest.raises(InputError):
        MarkingPointSettings(**wrong)
