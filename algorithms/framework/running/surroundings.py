"""What holds around every run: the same sums on each system, memory that is kept, and faults in the run's log."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from ....urbanmap_qgis.progress import notices_to
from .fault_log import faults_told
from .same_sums import same_sums


@contextmanager
def surroundings(feedback) -> Iterator[None]:
    """In the block, a run computes as it does everywhere, and its feedback tells what is odd about inputs, and
    faults."""
    with same_sums(), faults_told(feedback), notices_to(feedback.pushWarning):
        yield
