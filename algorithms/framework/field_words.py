"""What the columns of result tables are called for people, with units, and how many decimals they need.

The names of fields are a contract and stay as they are; tables show these words in the user's language.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...urbanmap_qgis.wording import mark


@dataclass(frozen=True)
class FieldWords:
    """A column for people: `words` with the unit, and the `decimals` that mean something; None: as they are."""

    words: str
    decimals: int | None = None


def words_of(field: str, style: str = "") -> FieldWords | None:
    """Words of a field in a layer with a style; None for fields of the user."""
    return _OF_STYLE.get((style, field)) or _WORDS.get(field)


_WORDS = {
    "building_id": FieldWords(mark("building")),
    "roof_id": FieldWords(mark("roof")),
    "wall_id": FieldWords(mark("wall")),
    "lane_id": FieldWords(mark("lane")),
    "line_id": FieldWords(mark("line")),
    "status": FieldWords(mark("status")),
    "reason": FieldWords(mark("reason")),
    "note": FieldWords(mark("note")),
    "sigma": FieldWords(mark("standard deviation (m)"), 3),
    "sigma_up": FieldWords(mark("standard deviation of the height (m)"), 3),
    "sigma_heading": FieldWords(mark("standard deviation of the heading (°)"), 3),
    "length": FieldWords(mark("length (m)"), 2),
    "width": FieldWords(mark("width (m)"), 2),
    "height": FieldWords(mark("height (m)"), 2),
    "area": FieldWords(mark("area (m²)"), 1),
    "volume": FieldWords(mark("volume (m³)"), 1),
    "points": FieldWords(mark("points")),
    "density": FieldWords(mark("points a m²"), 1),
    "rmse": FieldWords(mark("RMSE (m)"), 3),
    "rmse_z": FieldWords(mark("RMSE of the height (m)"), 3),
    "rmse_z95": FieldWords(mark("RMSE of the height, best 95 % (m)"), 3),
    "rmse_3d": FieldWords(mark("RMSE of the distance (m)"), 3),
    "p95": FieldWords(mark("95th percentile of the distance (m)"), 3),
    "east": FieldWords(mark("east (m)"), 3),
    "north": FieldWords(mark("north (m)"), 3),
    "up": FieldWords(mark("up (m)"), 3),
    "time": FieldWords(mark("time (s)"), 3),
    "chainage": FieldWords(mark("chainage (m)"), 2),
    "heading": FieldWords(mark("heading (°)"), 2),
    "azimuth": FieldWords(mark("azimuth (°)"), 1),
    "colour": FieldWords(mark("colour")),
    "kind": FieldWords(mark("kind")),
    "class": FieldWords(mark("class")),
    "quality": FieldWords(mark("quality, 0 to 1"), 2),
    "confidence": FieldWords(mark("confidence, 0 to 1"), 2),
    "coverage": FieldWords(mark("coverage, 0 to 1"), 2),
    "satellites": FieldWords(mark("satellites")),
    "lod": FieldWords(mark("level of detail")),
    "roof_type": FieldWords(mark("kind of roof")),
    "surface_type": FieldWords(mark("kind of surface")),
    "valid": FieldWords(mark("valid solid")),
    "watertight": FieldWords(mark("watertight")),
}
"""Words of fields that mean the same in all layers."""

_OF_STYLE: dict[tuple[str, str], FieldWords] = {}
"""Words of fields in the layers of one style, where they differ."""
