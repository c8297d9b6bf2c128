"""Points packed for sorting: the same coordinates and passes as the files give."""

import laspy
import numpy as np
import pytest

from urbanmap_qgis.mobile.packed_points import PackedPoints
from urbanmap_qgis.mobile.passes import SurveyPasses


def points(scale, offset, count=500, seed=0):
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = np.full(3, scale), np.array([offset, 2 * offset, 0.0])
    rng = np.random.default_rng(seed)
    made = laspy.ScaleAwarePointRecord.zeros(count, header=header)
    for name in "XYZ":
        made[name] = rng.integers(-2**31, 2**31, count)
    return header, made


@pytest.mark.parametrize("kinds", [[(0.001, -6863.0)], [(0.001, -6863.0), (0.0025, 0.1)]])
def test_coordinates_come_back_to_the_last_digit(kinds):
    given = [points(*kind, seed=seed) for seed, kind in enumerate(kinds)]
    packing = PackedPoints([header for header, _ in given])
    records = np.concatenate([packing.packed(made, np.zeros(len(made))) for _, made in given])
    rows = np.array([3, 1, len(records) - 1])
    for name in "xyz":
        expected = np.concatenate([np.asarray(made[name]) for _, made in given])
        assert np.array_equal(packing.column(records, name), expected)
        assert np.array_equal(packing.column(records, name, rows), expected[rows])
        assert packing.extent(records, name, rows) == (expected[rows].min(), expected[rows].max())
    assert packing.dtype.itemsize == (16 if len(kinds) == 1 else 20)


def test_passes_are_those_of_the_times_themselves():
    header, made = points(0.001, 0.0, 9)
    time = np.array([3e8, 3e8 + 59.999, 3e8 + 60.0, 3e8 + 60.5, 3e8 - 2.5, 3e8 + 200.0, -1e300, 1e300, np.nan])
    passes = SurveyPasses(np.array([3e8 + 60.0, 3e8 + 200.0]))
    packing = PackedPoints([header])
    records = packing.packed(made, time)
    assert packing.passes(records, passes).tolist() == passes.of(time).tolist() == [0, 0, 1, 1, 0, 2, 0, 2, 2]
    assert packing.passes(records, SurveyPasses(np.empty(0))).tolist() == [0] * 9
