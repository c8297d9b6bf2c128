"""Attributes of buildings as a property table of EXT_structural_metadata: one column an attribute.

Source: Khronos registry, glTF extension EXT_structural_metadata; OGC 3D Tiles 1.1, 3D metadata.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..gltf.glb_file import GlbBuffer

CLASS = "building"
NO_TEXT, NO_INTEGER, NO_NUMBER = "", -(2**31), -1e30
"""Stand for a value that is not there."""


def property_table(rows: Sequence[Mapping[str, Any]], buffer: GlbBuffer) -> dict[str, Any]:
    """The extension's object with a schema and a table of one row a building; values go to the buffer.

    Whole numbers are INT32, other numbers FLOAT64, all else STRING (lists and groups as JSON). A column of several
    kinds is text. Names that the extension cannot take are changed; the property's name is the attribute's own.
    """
    schema, columns = {}, {}
    for name, key in _keys(rows).items():
        values = [row.get(name) for row in rows]
        schema[key], columns[key] = _column(name, values, buffer)
    return {"schema": {"id": "urbanmap", "name": "UrbanMap buildings",
                       "classes": {CLASS: {"name": "Building", "properties": schema}}},
            "propertyTables": [{"name": "Buildings", "class": CLASS, "count": len(rows), "properties": columns}]}


def _keys(rows: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    """Name in the table of each attribute, each once."""
    keys: dict[str, str] = {}
    for name in dict.fromkeys(name for row in rows for name in row):
        key = re.sub(r"[^a-zA-Z0-9_]", "_", name)
        key = key if re.match(r"[a-zA-Z_]", key) and re.search(r"[a-zA-Z0-9]", key) else f"attribute_{len(keys) + 1}"
        while key in keys.values():
            key += "_"
        keys[name] = key
    return keys


def _column(name: str, values: list, buffer: GlbBuffer) -> tuple[dict[str, Any], dict[str, Any]]:
    """Schema entry and table entry of one attribute."""
    present = [value for value in values if value is not None]
    numbers = all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in present)
    missing = len(present) < len(values)
    if present and numbers and all(isinstance(value, int) and abs(value) < 2**31 for value in present):
        column = np.array([NO_INTEGER if value is None else value for value in values], "<i4")
        entry: dict[str, Any] = {"type": "SCALAR", "componentType": "INT32", "noData": NO_INTEGER}
    elif present and numbers:
        column = np.array([NO_NUMBER if value is None else value for value in values], "<f8")
        entry = {"type": "SCALAR", "componentType": "FLOAT64", "noData": NO_NUMBER}
    else:
        texts = [_text(value).encode("utf-8") for value in values]
        offsets = np.cumsum([0, *map(len, texts)], dtype="<u4")
        # A view of no bytes is not allowed.
        place = {"values": buffer.view(b"".join(texts) or b"\0"), "stringOffsets": buffer.view(offsets.tobytes()),
                 "stringOffsetType": "UINT32"}
        entry = {"type": "STRING", "noData": NO_TEXT}
        return {"name": name, **(entry if missing else {"type": "STRING"})}, place
    if not missing:
        del entry["noData"]
    return {"name": name, **entry}, {"values": buffer.view(column.tobytes())}


def _text(value: Any) -> str:
    if value is None:
        return NO_TEXT
    if isinstance(value, (list, dict)):
        return json.dumps(value, ensure_ascii=False)
    return str(value).lower() if isinstance(value, bool) else str(value)
