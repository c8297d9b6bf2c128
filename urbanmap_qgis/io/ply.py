"""Triangle meshes as binary PLY, which QGIS opens as a mesh layer."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from .files.atomic import written_beside

_VERTEX = np.dtype([("x", "<f8"), ("y", "<f8"), ("z", "<f8")])
_FACE = np.dtype([("count", "u1"), ("corners", "<i4", (3,))])


class MeshWriter:
    """Takes vertices and triangles in any number of pieces; vertices are numbered in the order they come."""

    def __init__(self, folder: Path):
        self._vertices = (folder / "vertices").open("w+b")
        self._faces = (folder / "faces").open("w+b")
        self.vertex_count = 0
        self.face_count = 0

    def add_vertices(self, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> None:
        """Append vertices (n,)."""
        records = np.empty(len(x), dtype=_VERTEX)
        records["x"], records["y"], records["z"] = x, y, z
        self._vertices.write(records.tobytes())
        self.vertex_count += len(x)

    def add_triangles(self, triangles: np.ndarray) -> None:
        """Append triangles (m, 3) of vertex numbers from 0."""
        records = np.empty(len(triangles), dtype=_FACE)
        records["count"], records["corners"] = 3, triangles
        self._faces.write(records.tobytes())
        self.face_count += len(triangles)

    def save(self, path: Path) -> None:
        """Write the whole mesh."""
        header = ["ply", "format binary_little_endian 1.0", f"element vertex {self.vertex_count}",
                  "property double x", "property double y", "property double z",
                  f"element face {self.face_count}", "property list uchar int vertex_indices", "end_header", ""]
        with path.open("wb") as target:
            target.write("\n".join(header).encode("ascii"))
            for part in (self._vertices, self._faces):
                part.seek(0)
                shutil.copyfileobj(part, target)

    def close(self) -> None:
        """Let go of the temporary files."""
        self._vertices.close()
        self._faces.close()


@contextmanager
def mesh_writer(path: str | os.PathLike) -> Iterator[MeshWriter]:
    """Give a writer for a PLY file, which appears at `path` when the block succeeds.

    Raises
    ------
    OutputError : the file cannot be written there.
    """
    with written_beside(path) as temporary, tempfile.TemporaryDirectory(prefix="urbanmap-") as folder:
        writer = MeshWriter(Path(folder))
        try:
            yield writer
            writer.save(temporary)
        finally:
            writer.close()
