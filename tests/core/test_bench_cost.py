"""The memory that `make bench` prints is that of the program measured."""

import sys

import numpy as np
import pytest

from scripts.bench_stages import cost


def test_memory_is_that_of_the_program_and_not_of_this_process():
    held = np.ones(50_000_000)  # 400 MB
    assert cost([sys.executable, "-S", "-c", "pass"])[1] < 100 < held.nbytes / 2**20
    assert 200 < cost([sys.executable, "-S", "-c", "b'1' * (200 << 20)"])[1] < 300


def test_a_program_that_fails_is_told_with_what_it_said():
    with pytest.raises(SystemExit, match="ended with 3:\nno good"):
        cost([sys.executable, "-S", "-c", "print('no good'); raise SystemExit(3)"])
