"""Attributes of city objects as CityGML 2.0: those of the modules by their names, all others as generic ones.

Source: OGC 12-019, OGC City Geography Markup Language 2.0; i-UR 2.0 (uro) by its schema.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from datetime import date
from typing import Any
from xml.sax.saxutils import escape, quoteattr  # nosec B406 # writes, reads nothing

import numpy as np

from ..model import ADDRESS, ADDRESS_TYPE, BUILDING, BUILDING_PART, AttributeGroup, CodeValue, Measure
from .iur import PREFIX, IurTable
from .schema import ADDRESS_PROPERTY, FEATURE_FIELDS, FIELDS, GENERIC_NAMES, GENERIC_SET, THEMES

_NOT_IN_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff\ud800-\udfff]")
_GENERIC = "gen:"
_ADDRESSED = (BUILDING, BUILDING_PART)
_XML_NAME = re.compile(r"[A-Za-z_][\w.\-]*\Z")


def xml_text(value: object) -> str:
    """Text as XML holds it; characters that XML cannot hold are left out."""
    return escape(_NOT_IN_XML.sub("", str(value)))


def split_attributes(attributes: Mapping[str, Any], table: IurTable, homeless: Counter,
                     kind: str = BUILDING) -> tuple[str, str, str]:
    """The XML of what comes before the geometry (features' and generic attributes), of the module's own attributes,
    and of addresses and extensions, which come last. `kind` is that of the object. `homeless` counts extensions that
    `table` has no place for, which become generic attributes."""
    feature: dict[str, list[str]] = {name: [] for name in FEATURE_FIELDS.values()}
    of_fields: dict[str, list[str]] = {name: [] for name in FIELDS[kind]}
    generic, extension, postal = [], [], []
    for name, value in attributes.items():
        for item in value if isinstance(value, (list, tuple)) else (value,):
            place = FEATURE_FIELDS.get(name)
            if item is None or item == "" or (isinstance(item, float) and not math.isfinite(item)):
                continue
            if place and _fits_feature(place, item) and not (place != "gml:name" and feature[place]):
                feature[place].append(f"<{place}{_code_space(item)}>{_plain_text(item)}</{place}>")
            elif name in of_fields and _own_element(kind, name, item):
                of_fields[name].append(_own_element(kind, name, item))
            elif name == ADDRESS and kind in _ADDRESSED and isinstance(item, AttributeGroup):
                postal.append(_address(item))
            elif name.startswith(PREFIX):
                fitted = table.fitted(name, item, kind)
                if fitted is None:
                    homeless[name] += 1
                    generic.append(generic_attribute(name.removeprefix(PREFIX), item))
                else:
                    extension.append(_extension(fitted[0], fitted[1][0]))
            else:
                generic.append(generic_attribute(name.removeprefix(_GENERIC), item))
    return ("".join(text for name in FEATURE_FIELDS.values() for text in feature[name]) + "".join(generic),
            "".join(text for texts in of_fields.values() for text in texts), "".join(postal + extension))


def _address(group: AttributeGroup) -> str:
    """A postal address: as xAL has it where it came so, else a line for each of its values."""
    if group.type == ADDRESS_TYPE:
        inner = _xal("AddressDetails", group)
    else:
        lines = "".join(f"<xAL:AddressLine Type={quoteattr(xml_text(name))}>{xml_text(value)}</xAL:AddressLine>"
                        for name, value in _lines(group))
        inner = f"<xAL:AddressDetails><xAL:AddressLines>{lines}</xAL:AddressLines></xAL:AddressDetails>"
    return (f"<bldg:{ADDRESS_PROPERTY}><core:Address><core:xalAddress>{inner}</core:xalAddress></core:Address>"
            f"</bldg:{ADDRESS_PROPERTY}>")


def _lines(group: AttributeGroup) -> Iterator[tuple[str, Any]]:
    """Simple values of an address by name, also those of groups in it."""
    for name, value in group.values.items():
        for item in value if isinstance(value, (list, tuple)) else (value,):
            if isinstance(item, AttributeGroup):
                yield from _lines(item)
            elif item is not None:
                yield name, item


def _xal(name: str, value: Any) -> str:
    """An element of xAL with its attributes, text and elements."""
    if not isinstance(value, AttributeGroup):
        return f"<xAL:{name}>{xml_text(value)}</xAL:{name}>"
    named = "".join(f" {key[1:]}={quoteattr(_NOT_IN_XML.sub('', str(item)))}" for key, item in value.values.items()
                    if key.startswith("@") and _XML_NAME.match(key[1:]))
    inner = "".join(_xal(key, item) for key, items in value.values.items() if _XML_NAME.match(key)
                    for item in (items if isinstance(items, (list, tuple)) else (items,)))
    return f"<xAL:{name}{named}>{xml_text(value.values.get('#text', ''))}{inner}</xAL:{name}>"


def generic_attribute(name: str, value: Any) -> str:
    """One attribute of the generics module, of the type that its value has."""
    if isinstance(value, np.generic):
        value = value.item()
    named = f" name={quoteattr(_NOT_IN_XML.sub('', name))}"
    if isinstance(value, (AttributeGroup, Mapping)):
        values = value.values if isinstance(value, AttributeGroup) else value
        inner = "".join(generic_attribute(key.removeprefix(_GENERIC), item) for key, value in values.items()
                        for item in (value if isinstance(value, (list, tuple)) else (value,)) if item is not None)
        return f"<gen:{GENERIC_SET}{named}>{inner}</gen:{GENERIC_SET}>"
    kind = GENERIC_NAMES[next((known for known in GENERIC_NAMES if isinstance(value, known)
                               and not isinstance(value, bool)), str)]
    unit = f" uom={quoteattr(value.unit)}" if isinstance(value, Measure) else ""
    return f"<gen:{kind}{named}><gen:value{unit}>{_plain_text(value)}</gen:value></gen:{kind}>"


def _plain_text(value: Any) -> str:
    """A value as the text of an element that has no place for its list of codes; dates without a time of day."""
    if isinstance(value, Measure):
        return _number(value.value)
    if isinstance(value, date):
        return value.isoformat()[:10]
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (int, float)):
        return _number(value)
    return xml_text(value.value if isinstance(value, CodeValue) else value)


def _fits_feature(place: str, value: Any) -> bool:
    if place.startswith("core:"):
        return isinstance(value, date) or bool(re.fullmatch(r"\d{4}-\d\d-\d\d", str(value)))
    return isinstance(value, (str, CodeValue))


def _code_space(value: Any) -> str:
    return f" codeSpace={quoteattr(value.space)}" if isinstance(value, CodeValue) and value.space else ""


def _own_element(kind: str, name: str, value: Any) -> str:
    """An attribute of the module of an object's kind, empty where its value is not of the attribute's type."""
    field = FIELDS[kind][name]
    if isinstance(value, np.generic):
        value = value.item()
    if not isinstance(value, field.takes) or (field.form and not re.fullmatch(field.form, str(value))):
        return ""
    plain = field.unit and not isinstance(value, Measure)
    return _element(f"{THEMES[kind]}:{name}", Measure(value, field.unit) if plain else value)


def _extension(name: str, value: Any) -> str:
    """An attribute of an extension: a group or a simple value."""
    return f"<{name}>{_nested(value)}</{name}>" if isinstance(value, AttributeGroup) else _element(name, value)


def _nested(group: AttributeGroup) -> str:
    """An object of an extension with its values in order."""
    return f"<{group.type}>{''.join(_values(group))}</{group.type}>"


def _values(group: AttributeGroup) -> Iterator[str]:
    prefix = group.type.partition(":")[0]
    for name, value in group.values.items():
        qualified = name if ":" in name else f"{prefix}:{name}"
        for item in value if isinstance(value, (list, tuple)) else (value,):
            if isinstance(item, AttributeGroup):
                yield f"<{qualified}>{_nested(item)}</{qualified}>"
            elif item is not None:
                yield _element(qualified, item)


def _element(name: str, value: Any) -> str:
    """A simple element: text, number, measure or code."""
    if isinstance(value, Measure):
        return f"<{name} uom={quoteattr(value.unit)}>{_number(value.value)}</{name}>"
    if isinstance(value, CodeValue):
        return f"<{name}{_code_space(value)}>{xml_text(value.value)}</{name}>"
    if isinstance(value, bool):
        return f"<{name}>{str(value).lower()}</{name}>"
    if isinstance(value, date):
        return f"<{name}>{value.isoformat()}</{name}>"
    return f"<{name}>{_number(value) if isinstance(value, (int, float)) else xml_text(value)}</{name}>"


def _number(value: Any) -> str:
    """A number without loss and without needless digits."""
    return repr(value.item() if isinstance(value, np.generic) else value)
