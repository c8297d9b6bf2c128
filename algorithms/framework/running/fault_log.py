"""Faults that the core passes over, such as one building's, in the log of the run."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager

from ....urbanmap_qgis.errors import LOG


class _ToFeedback(logging.Handler):
    """Hands each record, with its traceback, to the feedback of a run."""

    def __init__(self, feedback):
        super().__init__(logging.ERROR)
        self._feedback = feedback

    def emit(self, record: logging.LogRecord) -> None:
        self._feedback.pushWarning(self.format(record))


@contextmanager
def faults_told(feedback) -> Iterator[None]:
    """In the block, faults that the core logs are shown in the log of the run."""
    handler = _ToFeedback(feedback)
    LOG.addHandler(handler)
    try:
        yield
    finally:
        LOG.removeHandler(handler)
