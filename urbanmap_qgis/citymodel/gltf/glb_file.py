"""The container of glTF 2.0 binary files (.glb): one buffer that grows, views and accessors on it, the JSON before it.

Source: Khronos glTF 2.0 specification.
"""

from __future__ import annotations

import json
import shutil
import struct
from typing import IO, Any

import numpy as np

ARRAY_BUFFER = 34962
_FLOATS = 5126


class GlbBuffer:
    """The binary part of a file, and what is said of it.

    Attributes
    ----------
    views, accessors : entries of the document, as they were added.
    """

    def __init__(self, data: IO[bytes], alignment: int = 4):
        self.data, self.alignment = data, alignment
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def view(self, data: bytes, target: int | None = None) -> int:
        """Add bytes; the number of their view."""
        start = self._aligned(self.alignment)
        view = {"buffer": 0, "byteOffset": start, "byteLength": len(data)}
        self.views.append({**view, "target": target} if target else view)
        self.data.write(data)
        return len(self.views) - 1

    def accessor(self, values: np.ndarray, limits: bool = False) -> int:
        """Add values (n,) or (n, k) of vertices in single precision; the number of their accessor."""
        values = np.ascontiguousarray(values, "<f4")
        entry = {"bufferView": self.view(values.tobytes(), ARRAY_BUFFER), "componentType": _FLOATS,
                 "count": len(values), "type": "SCALAR" if values.ndim == 1 else f"VEC{values.shape[1]}"}
        if limits:
            entry.update(min=values.min(axis=0).tolist(), max=values.max(axis=0).tolist())
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def length(self) -> int:
        """Length of the buffer, bytes, filled up to a multiple of four."""
        return self._aligned(4)

    def write(self, target: IO[bytes], document: dict[str, Any]) -> None:
        """Write the whole file."""
        length = self.length()
        text = json.dumps(document, ensure_ascii=False, separators=(",", ":")).encode("utf-8")
        text += b" " * (-len(text) % 4)
        total = 12 + 8 + len(text) + (8 + length if length else 0)
        target.write(struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<II", len(text), 0x4E4F534A) + text)
        if length:
            target.write(struct.pack("<II", length, 0x004E4942))
            self.data.seek(0)
            shutil.copyfileobj(self.data, target)

    def _aligned(self, step: int) -> int:
        """Fill up to a multiple of some bytes; the length so far."""
        self.data.write(b"\0" * (-self.data.tell() % step))
        return self.data.tell()
