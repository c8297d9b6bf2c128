"""Chains of states with offsets that short runs of them share, against the dense solution."""

import numpy as np
import pytest
from scipy.sparse import csr_matrix

from urbanmap_qgis.estimation import held_observations
from urbanmap_qgis.estimation.held_observations import HeldSystem, OffsetEquations
from urbanmap_qgis.estimation.offset_chain import OffsetChain, touched_states

STATES, SIZE = 30, 4


def system(spans, seed=0):
    """Chain (diagonal, ahead) alone, equations of offsets that touch spans of states, and the dense matrix of both."""
    rng = np.random.default_rng(seed)
    n, count = STATES * SIZE, len(spans)
    diagonal = np.tile(np.eye(SIZE), (STATES, 1, 1)) * 10.0 ** rng.uniform(-2, 2, SIZE)
    ahead = np.zeros((STATES - 1, SIZE, SIZE))
    for k in range(STATES - 1):
        step = rng.normal(size=(3, 2 * SIZE))
        square = step.T @ step
        diagonal[k] += square[:SIZE, :SIZE]
        diagonal[k + 1] += square[SIZE:, SIZE:]
        ahead[k] = square[:SIZE, SIZE:]
    whole = np.zeros((n + count, n + count))
    for k in range(STATES):
        at = slice(k * SIZE, (k + 1) * SIZE)
        whole[at, at] = diagonal[k]
        if k < STATES - 1:
            whole[at, at.stop:at.stop + SIZE] = ahead[k]
            whole[at.stop:at.stop + SIZE, at] = ahead[k].T
    whole[n:, n:] = np.diag(rng.uniform(1.0, 9.0, count))
    for number, (first, last) in enumerate(spans):
        for k in {first, last, *rng.integers(first, last + 1, 3).tolist()}:
            row = np.zeros(n + count)
            row[k * SIZE:(k + 1) * SIZE], row[n + number] = rng.normal(size=SIZE), 1.0
            shared = [other for other, span in enumerate(spans) if span[0] <= k <= span[1] and other != number]
            row[n + np.array(shared[:1], int)] = 1.0
            whole += 3.0 * np.outer(row, row)
    blocks = np.stack([whole[k * SIZE:(k + 1) * SIZE, k * SIZE:(k + 1) * SIZE] for k in range(STATES)])
    return diagonal, ahead, blocks, csr_matrix(whole[:n, n:]), csr_matrix(whole[n:, n:]), whole


SPANS = [(0, STATES - 1), (0, 0), (0, 6), (3, 9), (5, 5), (9, 14), (8, 29), (20, 29), (29, 29), (12, 13)]


def lag(inverse, k):
    """Block (p, p) of a state and the next one."""
    return inverse[k * SIZE:(k + 1) * SIZE, (k + 1) * SIZE:(k + 2) * SIZE]


def test_a_chain_with_offsets_equals_the_dense_solution():
    _, ahead, blocks, pull, normal, whole = system(SPANS)
    inverse, n = np.linalg.inv(whole), STATES * SIZE
    chain = OffsetChain(blocks, ahead, pull, normal)
    sides = np.random.default_rng(1).normal(size=(n + len(SPANS), 3))
    state, offset = chain.solve(sides[:n].reshape(STATES, SIZE, 3), sides[n:])
    assert np.concatenate([state.reshape(n, 3), offset]) == pytest.approx(inverse @ sides, rel=1e-8, abs=1e-9)
    assert chain.covariance == pytest.approx(np.stack([inverse[k * SIZE:(k + 1) * SIZE, k * SIZE:(k + 1) * SIZE]
                                                       for k in range(STATES)]), rel=1e-8, abs=1e-9)
    assert chain.lagged == pytest.approx(np.stack([lag(inverse, k) for k in range(STATES - 1)]), rel=1e-8, abs=1e-9)
    assert chain.offset_variance == pytest.approx(np.diag(inverse)[n:], rel=1e-8)


def test_an_offset_that_touches_nothing_keeps_its_prior():
    _, ahead, blocks, pull, normal, _ = system([(2, 4), (6, 9)])
    alone = csr_matrix((pull.data, pull.indices, pull.indptr), shape=(STATES * SIZE, 3))
    wider = csr_matrix(np.block([[normal.toarray(), np.zeros((2, 1))], [np.zeros((1, 2)), np.full((1, 1), 4.0)]]))
    assert [part.tolist() for part in touched_states(alone, SIZE)] == [[2, 6, 0], [4, 9, 0]]
    assert OffsetChain(blocks, ahead, alone, wider).offset_variance[2] == pytest.approx(0.25)


def test_a_matrix_that_is_not_positive_definite_is_refused():
    _, ahead, blocks, pull, normal, _ = system([(2, 4)])
    with pytest.raises(np.linalg.LinAlgError, match="positive definite"):
        OffsetChain(blocks, 100.0 * ahead, pull, normal)


@pytest.mark.parametrize("most", [0, 5, 100])
def test_offsets_beside_the_chain_and_along_it_are_the_same(most, monkeypatch):
    monkeypatch.setattr(held_observations, "_MOST_NODES", most)
    monkeypatch.setattr(held_observations, "_COLUMNS", 2)
    diagonal, ahead, blocks, pull, normal, whole = system(SPANS, 3)
    n, rng = STATES * SIZE, np.random.default_rng(2)
    inverse, right = np.linalg.inv(whole), rng.normal(size=n + len(SPANS))
    equations = OffsetEquations((blocks - diagonal).reshape(STATES, 2, 2, 2, 2), np.zeros((STATES, 2, 2)), pull, normal,
                                right[n:])
    held = HeldSystem(diagonal, ahead, right[:n].reshape(STATES, SIZE), equations)
    made, expected = held.solved(), inverse @ right
    assert made.state.ravel() == pytest.approx(expected[:n], rel=1e-8, abs=1e-9)
    assert made.offset == pytest.approx(expected[n:], rel=1e-8, abs=1e-9)
    assert made.offset_variance == pytest.approx(np.diag(inverse)[n:], rel=1e-8)
    assert made.covariance[11] == pytest.approx(inverse[44:48, 44:48], rel=1e-8, abs=1e-9)
    assert made.lagged == pytest.approx(np.stack([lag(inverse, k) for k in range(STATES - 1)]), rel=1e-8, abs=1e-9)
    sides = rng.normal(size=(n, 2))
    assert held.response(sides).reshape(n, 2) == pytest.approx(inverse[:n, :n] @ sides, rel=1e-8, abs=1e-9)
