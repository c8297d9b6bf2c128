"""The one tree of errors that the core raises.

Every message is one sentence for the user: what was wrong and what to do.
"""


class UrbanMapError(Exception):
    """Root of all errors that the core raises on purpose."""


class InputError(UrbanMapError):
    """The user's input cannot be used: a file, a parameter or their combination."""


class InsufficientDataError(UrbanMapError):
    """The input is sound but holds too little to give an honest result."""


class OutputError(UrbanMapError):
    """A result cannot be written where the user wants it."""


class Cancelled(UrbanMapError):
    """The user stopped the run."""

    def __init__(self, message: str = "The run was cancelled."):
        super().__init__(message)
