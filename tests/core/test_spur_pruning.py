"""Spurs of an axis: those of one path at a time are those of the whole graph looked at again after each."""

import numpy as np
import pytest

from urbanmap_qgis.roadmap.lines.strokes import _length, _paths, _pruned_paths


def looked_at_again(edges, nodes, radius):
    """All paths anew after each spur taken off: slow, and plainly what is meant."""
    near = {}
    for a, b in edges.tolist():
        near.setdefault(a, set()).add(b)
        near.setdefault(b, set()).add(a)
    while True:
        paths = _paths(near)
        spurs = [path for path in paths if (len(near[path[0]]) == 1) != (len(near[path[-1]]) == 1)
                 and _length(nodes[path]) < 1.6 * max(radius[path[0]], radius[path[-1]]) + 0.1]
        if not spurs:
            return [path for path in paths if _length(nodes[path]) > 0.1]
        spur = min(spurs, key=lambda path: _length(nodes[path]))
        for a, b in zip(spur[:-1], spur[1:]):
            near[a].discard(b)
            near[b].discard(a)
        near = {node: others for node, others in near.items() if others}


@pytest.mark.parametrize("seed", range(60))
def test_the_same_paths_are_left(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(3, 120))
    tree = [(int(rng.integers(max(0, node - 6), node)), node) for node in range(1, count)]
    rings = [(a, b) for a, b in np.sort(rng.integers(0, count, (seed % 6, 2)), axis=1).tolist() if a < b]
    edges = np.unique(np.array(tree + rings), axis=0)
    nodes, radius = rng.normal(0.0, 0.3, (count, 2)), rng.uniform(0.0, 0.8, count)
    assert _pruned_paths(edges, nodes, radius) == looked_at_again(edges, nodes, radius)


def test_a_short_spur_goes_and_its_axis_stays_whole():
    nodes = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.1]])
    paths = _pruned_paths(np.array([[0, 1], [1, 2], [1, 3]]), nodes, np.full(4, 0.1))
    assert len(paths) == 1 and sorted(paths[0]) == [0, 1, 2]
