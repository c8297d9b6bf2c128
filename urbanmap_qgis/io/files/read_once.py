"""What is read from a file kept for the length of a run, so that its steps need not read it again."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TypeVar

T = TypeVar("T")

_KEPT: ContextVar[dict | None] = ContextVar("read_once", default=None)


@contextmanager
def read_once() -> Iterator[None]:
    """In the block, what `once` is asked for again is kept; inside another such block nothing is added."""
    if _KEPT.get() is not None:
        yield
        return
    token = _KEPT.set({})
    try:
        yield
    finally:
        _KEPT.reset(token)


def once(key: Hashable, read: Callable[[], T]) -> T:
    """What `read` gives, from where it is kept for `key` if it is; callers must not change it.

    The key says all that the answer depends on: of files their path, size and time of the last change
    (`decoded_points.file_state`).
    """
    store = _KEPT.get()
    if store is None:
        return read()
    if key not in store:
        store[key] = read()
    return store[key]
