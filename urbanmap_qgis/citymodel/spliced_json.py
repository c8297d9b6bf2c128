"""CityJSON with some objects taken out, replaced or added; all others keep every value that they had."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ..errors import InputError
from ..wording import say


def spliced_cityjson(model: dict[str, Any], changed: Mapping[str, Any], gone: Iterable[str]) -> dict[str, Any]:
    """A CityJSON model without what is gone, and with the objects of another one in the place of its own.

    The corners of the other model are appended in the first one's whole numbers.

    Parameters
    ----------
    model : as read; not changed.
    changed : a model with the objects to put in, in the same system.
    gone : ids of objects that go with all their children.

    Raises
    ------
    InputError : the two are in different systems.
    """
    systems = [each.get("metadata", {}).get("referenceSystem", "") for each in (model, changed)]
    if changed.get("CityObjects") and _code(systems[0]) != _code(systems[1]):
        raise InputError(say("The model is in another reference system ({model}) than what is put into it ({changed}).",
                             model=systems[0], changed=systems[1]))
    objects = dict(model["CityObjects"])
    for name in gone:
        _take_out(objects, name)
    result = {**model, "CityObjects": objects, "vertices": list(model["vertices"])}
    first = len(result["vertices"])
    result["vertices"] += _in_numbers_of(model, changed)
    attributes = {name: item.get("attributes", {}) for name, item in objects.items()}
    for name, item in changed.get("CityObjects", {}).items():
        if not item.get("parents"):
            _take_out(objects, name)
    for name, item in changed.get("CityObjects", {}).items():
        kept = {**attributes.get(name, {}), **item.get("attributes", {})}
        objects[name] = {**item, **({"attributes": kept} if kept else {}), "geometry": [
            {**shape, "boundaries": _raised(shape["boundaries"], first)} for shape in item.get("geometry", [])]}
    return result


def _take_out(objects: dict[str, Any], name: str) -> None:
    """Take an object and its children out."""
    for child in objects.pop(name, {}).get("children", []):
        _take_out(objects, child)


def _in_numbers_of(model: Mapping[str, Any], changed: Mapping[str, Any]) -> list[list[float]]:
    """Corners of the changed model in the whole numbers of the first."""
    def of(each: Mapping[str, Any]) -> tuple[list[float], list[float]]:
        transform = each.get("transform", {})
        return transform.get("scale", [1.0] * 3), transform.get("translate", [0.0] * 3)

    (scale, origin), (from_scale, from_origin) = of(model), of(changed)
    whole = "transform" in model
    rows = []
    for corner in changed.get("vertices", []):
        place = [(value * a + b - o) / s for value, a, b, s, o in zip(corner, from_scale, from_origin, scale, origin)]
        rows.append([round(value) for value in place] if whole else place)
    return rows


def _raised(boundaries: Any, first: int) -> Any:
    """Boundaries with all numbers of corners raised."""
    return boundaries + first if isinstance(boundaries, int) else [_raised(each, first) for each in boundaries]


def _code(system: str) -> str:
    """The code at the end of a system's name."""
    return system.rstrip("/").rpartition("/")[2]
