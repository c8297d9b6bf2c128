"""Connected regions of equal classes in a grid."""

import numpy as np
import pytest
from scipy import ndimage

from urbanmap_qgis.geometry.grid_regions import grid_regions


def test_regions_touch_along_sides_and_are_counted_row_by_row():
    classes = np.array([[0, 2, 2, 0, 1],
                        [1, 0, 2, 1, 1],
                        [1, 1, 0, 2, 0]])
    assert grid_regions(classes).tolist() == [[0, 1, 1, 0, 2],
                                              [3, 0, 1, 2, 2],
                                              [3, 3, 0, 4, 0]]


@pytest.mark.parametrize("seed", range(5))
def test_each_class_falls_apart_as_its_mask_does(seed):
    classes = np.random.default_rng(seed).integers(0, 4, (17, 23))
    found = grid_regions(classes)
    assert ((found == 0) == (classes == 0)).all()
    for kind in (1, 2, 3):
        alone, count = ndimage.label(classes == kind)
        pairs = np.unique(np.stack([alone[alone > 0], found[alone > 0]]), axis=1)
        assert pairs.shape[1] == count == len(np.unique(pairs[1]))
