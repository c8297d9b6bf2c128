"""Point clouds as outputs: their names, and their place among what is written beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from ....urbanmap_qgis.errors import InputError
from ..declaring.parameters import tr


@contextmanager
def points_output(algorithm, parameters: Mapping, context) -> Iterator[Path]:
    """Path of a scratch file for the points of OUTPUT, which takes its place when the block succeeds.

    What is written in the block beside the points, such as a layer, is so part of one result: all of it is new or
    all of it is as it was.
    """
    from ....urbanmap_qgis.io.files.atomic import written_beside

    with written_beside(algorithm.output_path(parameters, "OUTPUT", context)) as scratch:
        yield scratch


def check_points_output(algorithm, parameters: Mapping, context) -> None:
    """Refuse a name for the points of OUTPUT that is not that of a LAS or LAZ file."""
    path = algorithm.output_path(parameters, "OUTPUT", context)
    if path is not None and path.suffix.lower() not in (".las", ".laz"):
        raise InputError(tr("{0}: the name {1} must end in .laz or .las.").format(
            algorithm.label_of("OUTPUT"), path.name))
