"""Progress and cancelling, without knowing who listens."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from .errors import Cancelled


def _ignore(_value: object) -> None:
    """Listener that does nothing."""


@dataclass(frozen=True)
class Progress:
    """What a long computation reports to, and asks whether it should stop.

    Parameters
    ----------
    report : called with the fraction done, 0 to 1, of the whole run.
    message : called with one line of text for the user.
    warn : called with one line that the user must not miss.
    cancelled : returns True once the user wants to stop.
    start, end : the part of the whole run that this object stands for.
    """

    report: Callable[[float], None] = _ignore
    message: Callable[[str], None] = _ignore
    warn: Callable[[str], None] = _ignore
    cancelled: Callable[[], bool] = lambda: False
    start: float = 0.0
    end: float = 1.0

    def step(self, fraction: float) -> None:
        """Report a fraction (0 to 1) of this part; raise `Cancelled` if the user wants to stop."""
        self.check()
        self.report(self.start + (self.end - self.start) * min(max(fraction, 0.0), 1.0))

    def check(self) -> None:
        """Raise `Cancelled` if the user wants to stop."""
        if self.cancelled():
            raise Cancelled()

    def part(self, start: float, end: float) -> Progress:
        """Progress object of the part from `start` to `end` (fractions) of this one."""
        span = self.end - self.start
        return Progress(self.report, self.message, self.warn, self.cancelled,
                        self.start + span * start, self.start + span * end)


SILENT = Progress()

_NOTICES: ContextVar[tuple[Callable[[str], None], set[str]] | None] = ContextVar("notices", default=None)


@contextmanager
def notices_to(warn: Callable[[str], None]) -> Iterator[None]:
    """In the block, what `notice` says is given to `warn`, each sentence once; a block within another adds nothing."""
    token = _NOTICES.set(_NOTICES.get() or (warn, set()))
    try:
        yield
    finally:
        _NOTICES.reset(token)


def notice(sentence: str) -> None:
    """Say what a user must know of an input where it is opened, however deep in the work that is."""
    listener = _NOTICES.get()
    if listener and sentence not in listener[1]:
        listener[1].add(sentence)
        listener[0](sentence)
