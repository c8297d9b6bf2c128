"""Pieces of work, done one after another or on an executor, always given back in order."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from typing import TypeVar

Piece = TypeVar("Piece")
Result = TypeVar("Result")

IN_FLIGHT = 4
"""Pieces handed to an executor before the first result is waited for: bounds the memory."""


def in_order(work: Callable[[Piece], Result], pieces: Iterable[Piece],
             executor: Executor | None = None) -> Iterator[Result]:
    """Results of `work` on each piece, in the order of the pieces.

    Without an executor the pieces are worked on here. The results do not depend on the executor or its
    number of workers. With processes, `work` and the pieces must be picklable.
    """
    if executor is None:
        yield from map(work, pieces)
        return
    waiting: deque = deque()
    try:
        for piece in pieces:
            waiting.append(executor.submit(work, piece))
            if len(waiting) >= IN_FLIGHT:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        for future in waiting:
            future.cancel()
