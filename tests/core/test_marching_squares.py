"""Lines along which a field is zero."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from urbanmap_qgis.aerial.markings.marching_squares import zero_lines


def framed(field):
    return np.pad(field.astype(np.float32), 1, constant_values=np.float32(-1e9))


@pytest.mark.parametrize("side, smooth", [(5, 0.0), (60, 0.0), (200, 0.7), (300, 3.0)])
def test_lines_are_those_of_scikit_image_to_the_last_bit(side, smooth):
    measure = pytest.importorskip("skimage.measure")
    noise = np.random.default_rng(side).normal(size=(side, side + 3))
    field = framed(gaussian_filter(noise, smooth) if smooth else noise)
    wanted = measure.find_contours(field, 0.0)
    points, counts = zero_lines(field)
    assert len(wanted) > 1
    assert counts.tolist() == [len(line) for line in wanted]
    assert np.array_equal(points, np.concatenate(wanted))


def test_one_high_value_has_four_crossings():
    field = -np.ones((3, 3))
    field[1, 1] = 3
    points, counts = zero_lines(field)
    assert counts.tolist() == [5]
    assert {tuple(point) for point in points.tolist()} == {(0.25, 1), (1.75, 1), (1, 0.25), (1, 1.75)}
    assert points[0].tolist() == points[-1].tolist()


def test_high_values_across_a_square_do_not_touch():
    field = -np.ones((4, 4))
    field[1, 1] = field[2, 2] = 1
    assert zero_lines(field)[1].tolist() == [5, 5]


def test_nothing_high_has_no_lines():
    points, counts = zero_lines(-np.ones((4, 5)))
    assert points.shape == (0, 2)
    assert len(counts) == 0


def test_a_field_high_at_its_edge_is_refused():
    with pytest.raises(ValueError, match="below zero along its edges"):
        zero_lines(np.ones((3, 3)))
