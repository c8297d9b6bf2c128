"""Attributes of CityGML objects as plain values: texts, numbers, codes with their lists, measures, groups.

Source: OGC 12-019 (CityGML 2.0); i-UR (uro) by its schema.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from datetime import date
from functools import lru_cache
from typing import Any
from xml.etree.ElementTree import Element  # nosec B405 # elements alone, no parser

from ..model import ADDRESS_TYPE, AttributeGroup, CodeValue, Measure
from .iur import kinds_of
from .schema import EXTENSIONS, GENERIC_FIELDS, GENERIC_SET, GML, GML_3_2, MODULE_OBJECTS, module_of

Meaning = Callable[[str, str], str]
"""Function from the name of a list of codes and a code to what the list says; empty where it is not known."""

_KNOWN = ("core", *MODULE_OBJECTS, "gen", "app", *EXTENSIONS)
_INTEGER = re.compile(r"-?(0|[1-9]\d{0,17})\Z")
_NUMBER = re.compile(r"-?\d+(\.\d+)?([eE][-+]?\d+)?\Z")
_WHOLE = re.compile(r"[-+]?\d{1,18}\Z")
_DECIMAL = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\Z")
_DATE = re.compile(r"(\d{4})-(\d\d)-(\d\d)\Z")


@lru_cache(maxsize=4096)
def split_tag(tag: str) -> tuple[str, str]:
    """Prefix ("bldg", "gen", "core", "gml", "uro", "urf", else "other") and local name of a tag."""
    space, _, name = tag[1:].rpartition("}") if tag.startswith("{") else ("", "", tag)
    if space in (GML, GML_3_2):
        return "gml", name
    prefix = module_of(space) or next((known for known in EXTENSIONS if f"/{known}/" in f"{space}/"), "")
    return prefix if prefix in _KNOWN else "other", name


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
    """A text as a number; None where it is none or endless."""
    if _INTEGER.match(text):
        return int(text)
    number = float(text) if _NUMBER.match(text) else math.nan
    return number if math.isfinite(number) else None


def typed_value(element: Element, kind: str, meaning: Meaning) -> Any:
    """Value of an element without children, of the type that i-UR's table gives it; its text where it is not of it.

    What states a list of codes or a unit is a code or a measure, and what has no kind is what its text looks like: see
    `leaf_value`.
    """
    read = _TYPED_VALUES.get(kind)
    if read is None or element.get("codeSpace") is not None or element.get("uom") is not None:
        return leaf_value(element, meaning)
    text = (element.text or "").strip()
    value = read(text)
    return text if value is None else value


def extension_value(element: Element, meaning: Meaning, kind: str = "") -> Any:
    """Value of an attribute of an extension: of a simple one by its kind, else the objects in it with their values."""
    if not len(element):
        return typed_value(element, kind, meaning)
    groups = [AttributeGroup(_qualified(child), group_values(child, meaning)) if len(child)
              else AttributeGroup(_qualified(child), {}) for child in element]
    return groups[0] if len(groups) == 1 else groups


def group_values(element: Element, meaning: Meaning) -> dict[str, Any]:
    """Values of an object of an extension by name; several of one name are a list."""
    values: dict[str, Any] = {}
    kinds = kinds_of(element.tag)
    for child in element:
        add_value(values, _qualified(child), extension_value(child, meaning, kinds.get(child.tag, "")))
    return values


def addresses(element: Element) -> tuple[list[AttributeGroup], list[str]]:
    """Postal addresses in a property of an object: the elements of xAL by name, attributes of theirs with "@" before,
    text beside these as "#text"; and the names of what else is said of an address."""
    found, unread = [], []
    for item in (item for address in element for item in address):
        if split_tag(item.tag)[1] == "xalAddress":
            found += [AttributeGroup(ADDRESS_TYPE, _address_values(details)) for details in item]
        else:
            unread.append(split_tag(item.tag)[1])
    return found, unread


def _address_values(element: Element) -> dict[str, Any]:
    values: dict[str, Any] = {f"@{split_tag(name)[1]}": text for name, text in element.attrib.items()}
    text = (element.text or "").strip()
    if text:
        values["#text"] = text
    for child in element:
        inner = _address_values(child)
        plain = inner.keys() <= {"#text"}
        add_value(values, split_tag(child.tag)[1], inner.get("#text", "") if plain else AttributeGroup("", inner))
    return values


def generic_value(element: Element, meaning: Meaning) -> Any:
    """Value of an attribute of the generics module, by its kind."""
    name = split_tag(element.tag)[1]
    if name == GENERIC_SET:
        values: dict[str, Any] = {}
        for child in element:
            add_value(values, child.get("name") or "", generic_value(child, meaning))
        return AttributeGroup(f"gen:{GENERIC_SET}", values)
    inner = next(iter(element), None)
    text = ((inner.text if inner is not None else "") or "").strip()
    value = _GENERIC_VALUES[GENERIC_FIELDS.get(name, str)](text, "" if inner is None else inner.get("uom") or "")
    return text if value is None else value


def _plain_date(text: str) -> date | None:
    """A text as a date; None where it is none."""
    parts = _DATE.match(text)
    try:
        return date(*map(int, parts.groups())) if parts else None
    except ValueError:
        return None


def _whole(text: str) -> int | None:
    number = plain_number(text)
    return number if isinstance(number, int) else None


def _with_unit(text: str, unit: str) -> Measure | None:
    number = plain_number(text)
    return None if number is None else Measure(number, unit)


def _decimal(text: str) -> float | None:
    number = plain_number(text)
    return None if number is None else float(number)


def _double(text: str) -> int | float | None:
    """A number as XML schema writes doubles, a whole one without a point as such; None where it is none or endless."""
    whole = plain_number(text)
    if isinstance(whole, int):
        return whole
    number = float(text) if _DECIMAL.match(text) else math.nan
    return number if math.isfinite(number) else None


_TYPED_VALUES: dict[str, Callable[[str], Any]] = {
    "text": str, "code": str, "whole": lambda text: int(text) if _WHOLE.match(text) else None, "number": _double,
    "date": _plain_date, "truth": {"true": True, "1": True, "false": False, "0": False}.get}
"""How a text becomes a value of a kind of i-UR's tables; None where it is none. Years and measures are as they look."""

_GENERIC_VALUES: dict[type, Callable[[str, str], Any]] = {
    str: lambda text, unit: text, int: lambda text, unit: _whole(text), float: lambda text, unit: _decimal(text),
    date: lambda text, unit: _plain_date(text), Measure: _with_unit}
"""How a text and its unit become a value of a type; None where they are none, which leaves the text."""


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
