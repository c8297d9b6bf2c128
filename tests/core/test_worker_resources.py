"""What workers open: polygons come from a file, files are opened once in each worker and closed after the job."""

from __future__ import annotations

import pickle
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import shapely

from urbanmap_qgis.aerial.worker_resources import sent_polygons, worker_resource

OPENED = []


def opened(kind, stack):
    OPENED.append(kind)
    stack.callback(OPENED.append, f"{kind} closed")
    return kind


def test_polygons_come_back_in_their_order_and_are_sent_as_a_path():
    polygons = [shapely.box(0, 0, k + 1, 1) for k in range(1000)] + [None, shapely.Polygon()]
    with sent_polygons(polygons) as stored:
        sent = pickle.loads(pickle.dumps(stored))
        assert len(pickle.dumps(stored)) < 500
        assert len(sent) == 1002 and sent[1000] is None and sent[1001].is_empty
        assert all(a.equals(b) for a, b in zip(list(sent)[:1000], polygons[:1000]))
    assert not stored.path.exists()
    with sent_polygons(None) as nothing:
        assert nothing is None
    with sent_polygons([]) as none_of_them:
        assert list(none_of_them) == []


def test_a_worker_opens_once_a_job():
    OPENED.clear()
    with ThreadPoolExecutor(1) as executor:
        for kind in ("a", "b"):
            with worker_resource(partial(opened, kind)) as resource:
                assert list(executor.map(lambda _piece, one=resource: one.get(), range(5))) == [kind] * 5
    assert OPENED == ["a", "a closed", "b"]
