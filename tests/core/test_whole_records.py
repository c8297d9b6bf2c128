"""Rows of structured arrays moved whole are what numpy's own ways give."""

import numpy as np
import pytest

from urbanmap_qgis.io.points.whole_records import copied_records, joined_records, put_records, record_rows

KINDS = {
    "packed": np.dtype([("X", "<i4"), ("flag", "u1"), ("time", "<f8"), ("rgb", "<u2", (3,))]),
    "padded": np.dtype([("flag", "u1"), ("time", "<f8")], align=True),
    "one field": np.dtype([("z", "<f8")]),
}


def made(kind: np.dtype, count: int, seed: int = 0) -> np.ndarray:
    records = np.zeros(count, kind)
    rng = np.random.default_rng(seed)
    for name in kind.names:
        records[name] = rng.integers(0, 200, records[name].shape)
    return records


@pytest.fixture(params=KINDS.values(), ids=KINDS)
def records(request) -> np.ndarray:
    return made(request.param, 50)


def test_rows_by_number_and_by_mask(records):
    rows = np.array([3, 3, 49, -1, 0])
    assert (record_rows(records, rows) == records[rows]).all() and record_rows(records, rows).dtype == records.dtype
    mask = np.arange(50) % 3 == 1
    assert (record_rows(records, mask) == records[mask]).all()
    assert len(record_rows(records, rows[:0])) == 0
    with pytest.raises(IndexError):
        record_rows(records, np.array([50]))


def test_what_is_given_back_is_a_copy(records):
    for copy in (record_rows(records, np.arange(50)), copied_records(records), joined_records([records])):
        before = records.copy()
        copy[records.dtype.names[0]] = 250
        assert (records == before).all()


def test_pieces_of_a_strided_array(records):
    every_other = records[::2]
    assert (copied_records(every_other) == every_other).all()
    assert (joined_records([every_other, records, records[:0]]) == np.concatenate([every_other, records])).all()


def test_put_tells_the_place_behind(records):
    target = made(records.dtype, 80, 1)
    wanted = target.copy()
    wanted[10:60] = records
    assert put_records(target, 10, records) == 60 and put_records(target, 60, records[:0]) == 60
    assert (target == wanted).all()


def test_what_does_not_fit_is_refused(records):
    with pytest.raises(ValueError, match="broadcast"):
        put_records(made(records.dtype, 20), 0, records)
