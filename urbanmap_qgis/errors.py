"""The one tree of errors that the core raises.

Every message is one sentence for the user: what was wrong and what to do.
"""

from __future__ import annotations

import errno
import logging
import sqlite3

from .wording import say

LOG = logging.getLogger("urbanmap")
"""Where faults of the program go with their traceback: a run passes it on to the user's log."""


class UrbanMapError(Exception):
    """Root of all errors that the core raises on purpose."""


class InputError(UrbanMapError):
    """The user's input cannot be used: a file, a parameter or their combination."""


class PreviewNeeded(InputError):
    """A table that only its user can tell how to read: in the window that imports tables, which shows its columns."""


class InsufficientDataError(UrbanMapError):
    """The input is sound but holds too little to give an honest result."""


class OutputError(UrbanMapError):
    """A result cannot be written where the user wants it."""


class Cancelled(UrbanMapError):
    """The user stopped the run."""

    def __init__(self, message: str = "The run was cancelled."):
        super().__init__(message)


def trouble_words(error: BaseException) -> str:
    """What is told of one building that could not be worked on, where the others are.

    An exception's own text is for the log: in a result it would mean nothing to the reader.
    """
    if isinstance(error, MemoryError):
        return say("the memory was not enough for it")
    if isinstance(error, UrbanMapError):
        return str(error)
    LOG.error("%s: %s", type(error).__name__, error, exc_info=error)
    return say("a fault of the program, which its log tells; please report it")


SYSTEM_TROUBLES = (OSError, MemoryError, sqlite3.OperationalError)
"""What a system without room raises."""

_NO_ROOM = (errno.ENOSPC, errno.EDQUOT if hasattr(errno, "EDQUOT") else errno.ENOSPC, errno.EFBIG)


def system_sentence(error: BaseException) -> str:
    """One sentence for an error that the system's lack of room caused; empty for any other, a mistake of ours."""
    if isinstance(error, MemoryError):
        return say("The memory is not enough for this run: give less data at a time, or a coarser resolution.")
    full = isinstance(error, OSError) and error.errno in _NO_ROOM
    if full or (isinstance(error, sqlite3.OperationalError) and "full" in str(error)):
        return say("The disk is full: make room on the disk of the outputs and of temporary files, and run again.")
    return ""
