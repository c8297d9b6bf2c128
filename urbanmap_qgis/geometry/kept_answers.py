"""What is computed of a solid, kept for as long as the solid is: files, tables and levels ask several times."""

from __future__ import annotations

from collections.abc import Callable
from functools import update_wrapper
from typing import Any, Generic, TypeVar
from weakref import WeakKeyDictionary

T = TypeVar("T")


class Kept(Generic[T]):
    """A function of one thing that does not change (compared by identity), which answers once for each.

    Who asks must not change the answer.
    """

    def __init__(self, work: Callable[[Any], T]):
        self._work = work
        self._answers: WeakKeyDictionary[Any, T] = WeakKeyDictionary()
        update_wrapper(self, work)

    def __call__(self, thing: Any) -> T:
        """The function's answer."""
        answer = self._answers.get(thing)
        if answer is None:
            answer = self._answers[thing] = self._work(thing)
        return answer
