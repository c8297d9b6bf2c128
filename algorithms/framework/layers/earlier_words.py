"""Words of fields that an earlier step wrote: they stay with the fields in the results that keep these."""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping
from contextlib import closing
from pathlib import Path
from xml.etree import ElementTree  # nosec B405 # reads styles without entities alone

from qgis.core import QgsProcessingContext

from .field_words import FieldWords


def earlier_words(algorithm, parameters: Mapping, context: QgsProcessingContext) -> tuple[tuple[str, FieldWords], ...]:
    """Fields of the input layers with the words that these keep of them.

    A name that any input has without words is left out: whose field the result holds is not known here.
    """
    known: dict[str, FieldWords] = {}
    without: set[str] = set()
    for definition in algorithm.parameterDefinitions():
        if definition.type() not in ("source", "vector") or not parameters.get(definition.name()):
            continue
        layer = algorithm.parameterAsVectorLayer(parameters, definition.name(), context)
        if layer is None:
            continue
        words = words_in_file(Path(layer.source().partition("|")[0]))
        without |= {item.name() for item in layer.fields()} - words.keys()
        known |= words
    return tuple((name, words) for name, words in known.items() if name not in without)


def words_in_file(path: Path) -> dict[str, FieldWords]:
    """Words of the fields of a GeoPackage of one layer, as its style tells them; none of other files."""
    if path.suffix.lower() != ".gpkg" or not path.is_file():
        return {}
    try:
        with closing(sqlite3.connect(path)) as database:
            tables = [name for name, in database.execute("SELECT table_name FROM gpkg_contents")]
            if len(tables) != 2 or "layer_styles" not in tables:
                return {}
            style = database.execute("SELECT styleQML FROM layer_styles WHERE useAsDefault").fetchone()
    except sqlite3.Error:  # locked or of another kind: only words are missing then, which is no reason to fail
        return {}
    return words_in_style(style[0]) if style else {}


def words_in_style(text: str) -> dict[str, FieldWords]:
    """Aliases of fields in QML, with the decimals that tables show."""
    if "<!ENTITY" in text:  # QGIS writes none, and they could be a bomb
        return {}
    try:
        root = ElementTree.fromstring(text)  # nosec B314 # without entities
    except ElementTree.ParseError:  # of another program: it tells nothing of fields
        return {}
    decimals = {}
    for field in root.iterfind("fieldConfiguration/field"):
        for option in field.iter("Option"):
            if option.get("name") == "Precision" and (option.get("value") or "").isdigit():
                decimals[field.get("name")] = int(option.get("value"))
    return {item.get("field"): FieldWords(item.get("name"), decimals.get(item.get("field")))
            for item in root.iterfind("aliases/alias") if item.get("name") and item.get("field")}
