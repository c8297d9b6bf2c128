"""Attributes as plain values, which JSON, tables and property tables can hold."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from .model import AttributeGroup, CodeValue, Measure

_METRE = "m"


def plain_attributes(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Attributes as JSON can say them, without loss.

    A code is its meaning, where that is known, with `<name>_code` and `<name>_codeSpace` beside it; a measure its
    number, with `<name>_uom` where it is not in metres; a group an object with `type`.
    """
    plain: dict[str, Any] = {}
    for name, value in attributes.items():
        name = str(name)
        if isinstance(value, CodeValue):
            plain[name] = value.meaning or value.value
            if value.meaning:
                plain[f"{name}_code"] = value.value
            if value.space:
                plain[f"{name}_codeSpace"] = value.space
        elif isinstance(value, Measure):
            plain[name] = json_value(value.value)
            if value.unit != _METRE:
                plain[f"{name}_uom"] = value.unit
        else:
            plain[name] = _plain(value)
    return plain


def code_text(value: Any) -> str:
    """Codes as text, several with commas."""
    items = value if isinstance(value, list) else [] if value is None else [value]
    return ",".join(str(item.value if isinstance(item, CodeValue) else item) for item in items)


def _plain(value: Any) -> Any:
    if isinstance(value, AttributeGroup):
        return {**({"type": value.type} if value.type else {}), **plain_attributes(value.values)}
    if isinstance(value, (CodeValue, Measure)):
        return plain_attributes({"value": value})
    if isinstance(value, Mapping):
        return plain_attributes(value)
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return json_value(value)


def json_value(value: Any) -> Any:
    """A value as JSON can say it: numpy numbers as plain ones, what is not finite as null, dates as text."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if value is None or isinstance(value, (bool, int, str)):
        return value
    return str(value)
