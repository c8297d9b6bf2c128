"""Points on narrow reference lines count as lying on a marking, whatever the blur of the coverage."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.mobile.registration.matching.subpixel import MarkingField, field_terms
from urbanmap_qgis.mobile.registration.start.reference import Reference


@pytest.mark.parametrize("blur", [0.0, 0.05, 0.15])
@pytest.mark.parametrize("width", [0.1, 0.15, 0.3, 0.5])
def test_points_on_and_beside_a_line(width, blur):
    line = shapely.LineString([(0.03, 0.02), (30.0, 7.3)]).buffer(width / 2, cap_style="flat")
    coverage = Reference.from_polygons([line]).coverage(-5.0, -5.0, 35.0, 15.0)
    field = MarkingField.of(coverage, blur, 0.05)
    along, normal = np.array([29.97, 7.28]) / np.hypot(29.97, 7.28), np.array([-7.28, 29.97]) / np.hypot(29.97, 7.28)
    middle = np.array([0.03, 0.02]) + np.linspace(2.0, 28.0, 200)[:, None] * along
    found = field_terms(field, *middle.T).on_marking.mean()
    assert found > (0.85 if width == 0.1 else 0.95)  # 0.1 m is drawn two cells wide
    for side in (-1, 1):
        beside = middle + side * (width / 2 + 0.25 + blur) * normal
        assert not field_terms(field, *beside.T).on_marking.any()
