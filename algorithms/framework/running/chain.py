"""What the chains of stages share: parameters that were given, and files that are read once by all stages."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar

_REST_KEPT: ContextVar[bool] = ContextVar("rest_kept", default=False)


@contextmanager
def rest_kept() -> Iterator[None]:
    """In the block, a stage that finds nothing to make says so and gives empty layers: what others made is kept."""
    token = _REST_KEPT.set(True)
    try:
        yield
    finally:
        _REST_KEPT.reset(token)


def is_rest_kept() -> bool:
    """Whether the stage runs in such a block."""
    return _REST_KEPT.get()


class GivenParameters(dict):
    """The parameters of a chain that have a value, by name."""

    def __init__(self, parameters: Mapping):
        super().__init__((name, parameters[name]) for name in parameters if parameters[name] is not None)

    def pick(self, *names: str, **renamed: str) -> dict:
        """Those of some names; `renamed` ones, stage's name = own name, under the name that the stage has for them."""
        wanted = {**dict(zip(names, names)), **renamed}
        return {name: self[own_name] for name, own_name in wanted.items() if own_name in self}


@contextmanager
def files_read_once() -> Iterator[None]:
    """Points and tables that several stages read are read and decoded once."""
    from ....urbanmap_qgis.io.files.read_once import read_once
    from ....urbanmap_qgis.io.points.decoded_points import decoded_once

    with decoded_once(), read_once():
        yield
