"""Sections that are not registered: where they begin and end, and which are too short to be listed."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from urbanmap_qgis.mobile.registration.correction.patch_status import REGISTERED, STATUS_NAMES
from urbanmap_qgis.mobile.registration.registered_survey import unregistered_sections


def survey(status, reason, step=0.3):
    """A survey with a patch each `step` metres and second, sigma 1 cm a patch."""
    count = len(status)
    return SimpleNamespace(correction=_Correction(
        chainage=step * np.arange(count), time=100.0 + np.arange(count), status=np.array(status),
        reason=np.array(reason, object), sigma=0.01 * np.arange(count)))


class _Correction(SimpleNamespace):
    def __len__(self):
        return len(self.chainage)

    def plan_sigma(self):
        return self.sigma


OTHER = next(number for number in range(len(STATUS_NAMES)) if number != REGISTERED)


def test_sections_reach_half_a_step_beyond_their_patches():
    status = [REGISTERED] * 5 + [OTHER] * 5 + [REGISTERED] * 5
    item, = unregistered_sections(survey(status, ["few"] * 15))
    assert (item.start, item.end) == pytest.approx((1.35, 2.85))
    assert (item.start_time, item.end_time) == (105.0, 109.0)
    assert (item.status, item.reason) == (STATUS_NAMES[OTHER], "few") and item.sigma == pytest.approx(0.09)


def test_short_sections_are_not_listed_and_reasons_part_them():
    """Three patches of 0.3 m take 0.9 m, four 1.2 m; two reasons are two sections."""
    for count, listed in ((3, 0), (4, 1)):
        status = [REGISTERED] * 5 + [OTHER] * count + [REGISTERED] * 5
        assert len(unregistered_sections(survey(status, [""] * len(status)))) == listed
    found = unregistered_sections(survey([OTHER] * 10, ["a"] * 5 + ["b"] * 5))
    assert [item.reason for item in found] == ["a", "b"]


def test_a_registered_survey_has_none():
    assert unregistered_sections(survey([REGISTERED] * 10, [""] * 10)) == []
