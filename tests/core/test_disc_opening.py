"""The opening by a disc is OpenCV's, to the bit."""

import cv2
import numpy as np
import pytest

from urbanmap_qgis.aerial.markings.disc_opening import disc_opened


@pytest.mark.parametrize("side", [3, 7, 9, 11, 13, 17, 25, 31])
@pytest.mark.parametrize("shape", [(1, 40), (300, 270), (20, 300), (257, 5)])
def test_it_is_opencvs(side, shape):
    image = np.random.default_rng(side).normal(100.0, 30.0, shape).astype(np.float32)
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))
    wanted = cv2.morphologyEx(image, cv2.MORPH_OPEN, disc, borderType=cv2.BORDER_REPLICATE)
    assert np.array_equal(disc_opened(image, disc), wanted)


def test_a_line_goes_and_a_field_stays():
    image = np.zeros((100, 100), np.float32)
    image[:, 20:28] = image[40:80, 50:90] = 7.0
    opened = disc_opened(image, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (11, 11)))
    assert not opened[:, 15:40].any()
    assert (opened[50:70, 60:80] == 7.0).all()
