"""Letters in shade where a road is thickly painted, and flecks of sun where it is not."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from urbanmap_qgis.aerial.markings import marking_filter
from urbanmap_qgis.aerial.markings.marking_filter import CleanSettings
from urbanmap_qgis.aerial.markings.marking_pieces import marking_pieces_of
from urbanmap_qgis.aerial.markings.signs.thick_paint import paint_around

PIXEL = 0.12
LETTER = np.s_[90:98, 100:108]


def lost(bars, confidence=1.0, *, far=False):
    """Share of a block in shade that goes as a speck beside so many bars of 0.48 by 4.8 m in the sun."""
    mask = np.zeros((200, 400), bool)
    for number in range(bars):
        left = 20 + 8 * number + (200 if far else 0)
        mask[40:80, left:left + 4] = True
    mask[LETTER] = True
    pieces = marking_pieces_of(mask, mask.view(np.uint8), PIXEL, 12.0)
    letter = np.zeros(mask.shape, bool)
    letter[LETTER] = True
    shaded = letter.take(pieces.inside)
    judged = SimpleNamespace(pieces=pieces, mask=mask, narrow=mask, near=(slice(0, 200), slice(0, 400)),
                             by_rules=np.where(shaded, confidence, 1.0).astype(np.float32),
                             ground=SimpleNamespace(in_shade=lambda inside, pixel: letter.take(inside)))
    specks = marking_filter._specks(judged, SimpleNamespace(roads=None), PIXEL, CleanSettings())
    assert not specks[~shaded].any()
    return specks[shaded].mean()


def test_a_sure_letter_among_much_paint_stays():
    assert lost(12) == 0.0


@pytest.mark.parametrize(("bars", "confidence", "far"), [
    (4, 1.0, False),  # little paint
    (12, 0.5, False),  # not sure by its own ground
    (12, 1.0, True),  # too far off
])
def test_flecks_go(bars, confidence, far):
    assert lost(bars, confidence, far=far) == 1.0


def test_paint_is_counted_by_rows_and_columns():
    rng = np.random.default_rng(4)
    inside = np.sort(rng.choice(60 * 80, 500, replace=False))
    sure = rng.random(500) < 0.4
    rows, columns = np.divmod(inside, 80)
    near = (np.abs(rows[:, None] - rows) <= 10) & (np.abs(columns[:, None] - columns) <= 10)
    assert np.array_equal(paint_around(sure, inside, (60, 80), 0.1, 1.0), (near & sure).sum(axis=1))
