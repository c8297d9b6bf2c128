"""Groups of things linked in pairs are those of scipy, by the same numbers, however few or many there are."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from urbanmap_qgis.geometry.linked_groups import linked_groups


@pytest.mark.parametrize("count", [1, 2, 7, 40, 150, 400])
@pytest.mark.parametrize("share", [0.0, 0.3, 0.6, 1.0])
def test_groups_and_their_numbers_are_those_of_scipy(count, share):
    rng = np.random.default_rng(count)
    one, two = rng.integers(0, count, (2, int(share * count)))
    found, group = linked_groups(one, two, count)
    wanted = connected_components(coo_matrix((np.ones(len(one)), (one, two)), (count, count)), directed=False)
    assert found == wanted[0] and (group == wanted[1]).all() and len(group) == count


def test_a_long_chain_in_any_order_is_one_group():
    order = np.random.default_rng(3).permutation(140)
    found, group = linked_groups(order[:-1], order[1:], 140)
    assert found == 1 and not group.any()
