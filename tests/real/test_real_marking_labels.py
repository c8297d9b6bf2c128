"""Road markings in labelled photographs; the labels are here, the photographs are not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely

from scripts.score_markings import LABELS, PHOTOGRAPHS, read_labels, score

AERIAL = Path(__file__).resolve().parents[2].parent / "shared" / "data" / "aerial"


@pytest.mark.parametrize("name", PHOTOGRAPHS)
def test_labels_lie_in_their_carriageway(name):
    labels = read_labels(LABELS / f"{name}.geojson")
    markings = np.array(labels.markings)
    assert len(markings) > 10 and shapely.is_valid(labels.carriageway)
    inside = shapely.area(shapely.intersection(shapely.make_valid(markings), labels.carriageway))
    assert inside.sum() > 0.98 * shapely.area(markings).sum()


@pytest.mark.skipif(not AERIAL.is_dir(), reason="../shared/data/aerial is not there")
@pytest.mark.parametrize(("name", "roads", "least"), [
    ("drift_c", False, 0.92), ("uav_markings_1", False, 0.96), ("sind", False, 0.87),
    ("drift_c", True, 0.91), ("sind", True, 0.87)])
def test_real_photograph(name, roads, least, tmp_path):
    made = score(read_labels(LABELS / f"{name}.geojson"), AERIAL, roads, tmp_path)
    assert made.f1 > least
    if not roads:
        sure, count = made.classes[-1]
        assert count >= 12 and sure > 0.94  # the highest class of confidence is what it says
