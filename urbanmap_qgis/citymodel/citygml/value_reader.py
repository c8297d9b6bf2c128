"""Attributes of CityGML objects as plain values: texts, numbers, codes with their lists, measures, groups.

Source: OGC 12-019 (CityGML 2.0); i-UR (uro) by its schema.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from datetime import date
from typing import Any
from xml.etree.ElementTree import Element  # nosec B405 # elements alone, no parser

from ..model import AttributeGroup, CodeValue, Measure

CORE = "http://www.opengis.net/citygml/"
GML = "http://www.opengis.net/gml"
GML_3_2 = "http://www.opengis.net/gml/3.2"
XLINK_HREF = "{http://www.w3.org/1999/xlink}href"

Meaning = Callable[[str, str], str]
"""Function from the name of a list of codes and a code to what the list says; empty where it is not known."""

_PREFIXES = (("building", "bldg"), ("generics", "gen"), ("appearance", "app"), ("", "core"))
_INTEGER = re.compile(r"-?(0|[1-9]\d{0,17})\Z")
_NUMBER = re.compile(r"-?\d+(\.\d+)?([eE][-+]?\d+)?\Z")
_DATE = re.compile(r"(\d{4})-(\d\d)-(\d\d)\Z")


def split_tag(tag: str) -> tuple[str, str]:
    """Prefix ("bldg", "gen", "core", "gml", "uro", "urf", else "other") and local name of a tag."""
    space, _, name = tag[1:].rpartition("}") if tag.startswith("{") else ("", "", tag)
    if space in (GML, GML_3_2):
        return "gml", name
    if space.startswith(CORE):
        module = space[len(CORE):]
        known = (prefix for word, prefix in _PREFIXES if module.startswith(f"{word}/" if word else ("1", "2", "3")))
        return next(known, "other"), name
    for prefix in ("uro", "urf"):
        if f"/{prefix}/" in f"{space}/":
            return prefix, name
    return "other", name


def id_of(element: Element) -> str:
    """The id of a feature or geometry; empty where it has none."""
    return element.get(f"{{{GML}}}id") or element.get(f"{{{GML_3_2}}}id") or ""


def leaf_value(element: Element, meaning: Meaning) -> Any:
    """Value of an element without children: a code, a measure, a whole number, a number or a text."""
    text = (element.text or "").strip()
    space, unit = element.get("codeSpace"), element.get("uom")
    if space is not None:
        return CodeValue(text, space, meaning(space, text))
    if unit is not None:
        number = plain_number(text)
        return Measure(number, unit) if number is not None else text
    number = plain_number(text)
    # Only numbers that come back letter by letter: "0120" and "1.50" are texts.
    return number if number is not None and repr(number) == text else text


def plain_number(text: str) -> int | float | None:
    """A text as a number; None where it is none."""
    if _INTEGER.match(text):
        return int(text)
    return float(text) if _NUMBER.match(text) else None


def extension_value(element: Element, meaning: Meaning) -> Any:
    """Value of an attribute of an extension: of a simple one its leaf, else the objects in it with their values."""
    if not len(element):
        return leaf_value(element, meaning)
    groups = [AttributeGroup(_qualified(child), group_values(child, meaning)) if len(child)
              else AttributeGroup(_qualified(child), {}) for child in element]
    return groups[0] if len(groups) == 1 else groups


def group_values(element: Element, meaning: Meaning) -> dict[str, Any]:
    """Values of an object of an extension by name; several of one name are a list."""
    values: dict[str, Any] = {}
    for child in element:
        add_value(values, _qualified(child), extension_value(child, meaning))
    return values


def generic_value(element: Element, meaning: Meaning) -> Any:
    """Value of an attribute of the generics module, by its kind."""
    kind = split_tag(element.tag)[1]
    if kind == "genericAttributeSet":
        values: dict[str, Any] = {}
        for child in element:
            add_value(values, child.get("name") or "", generic_value(child, meaning))
        return AttributeGroup("gen:genericAttributeSet", values)
    inner = next(iter(element), None)
    text = ((inner.text if inner is not None else "") or "").strip()
    number = plain_number(text)
    if kind == "measureAttribute" and number is not None:
        return Measure(number, inner.get("uom") or "")
    if kind == "intAttribute" and isinstance(number, int):
        return number
    if kind == "doubleAttribute" and number is not None:
        return float(number)
    parts = _DATE.match(text)
    if kind == "dateAttribute" and parts:
        try:
            return date(*map(int, parts.groups()))
        except ValueError:
            return text
    return text


def add_value(values: dict[str, Any], name: str, value: Any) -> None:
    """Put a value under a name; several of one name become a list."""
    if name not in values:
        values[name] = value
    elif isinstance(values[name], list):
        values[name].append(value)
    else:
        values[name] = [values[name], value]


def _qualified(element: Element) -> str:
    prefix, name = split_tag(element.tag)
    return f"{prefix}:{name}"
