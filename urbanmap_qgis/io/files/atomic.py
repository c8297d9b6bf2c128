"""Results are written beside their place and moved there when they are whole."""

from __future__ import annotations

import os
import shutil
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...errors import OutputError
from ...wording import say
from .staging import final_text, refuse_unless_replaceable

_LEAST_ROOM = 2**20  # bytes, below which a disk counts as full
STEM_LENGTH = 32
"""Characters of a name that its temporary file shows, so that long names stay within what file systems take."""


@contextmanager
def written_beside(path: str | os.PathLike) -> Iterator[Path]:
    """Give a temporary path in the folder of `path`; move it to `path` if the block succeeds.

    On an error the temporary file is removed and what stood at `path` before stays as it was.
    The temporary name keeps the suffixes, because many writers choose their format by them.

    Raises
    ------
    OutputError : no file can be put there (`refuse_unless_replaceable`), or it cannot be written.
    """
    target = Path(path)
    folder, shown = target.parent, final_text(str(target))
    refuse_unless_replaceable(target)
    suffix = "".join(target.suffixes[-2:]) or target.suffix
    suffix = suffix if len(suffix) <= STEM_LENGTH else target.suffix
    temporary = folder / f".{target.stem.split('.')[0][:STEM_LENGTH]}-{uuid.uuid4().hex[:8]}{suffix}"
    try:
        yield temporary
        try:
            os.replace(temporary, target)
        except OSError as error:
            raise OutputError(
                say("{shown} cannot be replaced ({strerror}): close the program that has it open.", shown=shown,
                    strerror=error.strerror)
            ) from error
    except OSError as error:
        if error.errno is None and shutil.disk_usage(folder).free < _LEAST_ROOM:  # rasterio does not say why
            raise _no_room(shown) from error
        raise OutputError(say("{shown} cannot be written ({strerror}).", shown=shown,
                              strerror=error.strerror or error)) from error
    except RuntimeError as error:
        # What the compressor of LAZ makes of a file that cannot grow.
        if type(error).__name__ != "LazrsError" or "call write" not in str(error):
            raise
        raise _no_room(shown) from error
    finally:
        temporary.unlink(missing_ok=True)


def _no_room(shown: str) -> OutputError:
    return OutputError(say("{shown} cannot be written: make room on its disk, or choose another output.", shown=shown))
