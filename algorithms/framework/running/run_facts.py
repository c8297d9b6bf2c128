"""What reports tell of the run that made them: inputs by name, settings in the user's words, reference system."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path

from qgis.core import NULL, QgsProcessingContext, QgsProcessingUtils

from ..declaring.parameters import UNIT, tr
from ..layers.crs import crs_from, crs_name, heights, horizontal
from ..version import plugin_version

INPUTS = ("source", "vector", "raster", "multilayer", "file", "layer", "mesh", "pointcloud")
"""Types of parameters that name data."""

UNTOLD = ("WORKERS", "SCHEDULER", "NOTE", "POINTS_CRS")
"""Parameters that change nothing of the result, or are told otherwise."""

TEMPORARY_LAYER = re.compile(r"_[0-9a-f]{8}(_[0-9a-f]{4}){3}_[0-9a-f]{12}$")  # as QGIS names them


def run_facts(algorithm, parameters: Mapping, context: QgsProcessingContext):
    """The core's `RunFacts` of a run, for its reports."""
    from ....urbanmap_qgis.io.pages.report import RunFacts

    reference = _reference(algorithm, parameters, context)
    stated = heights(reference)
    return RunFacts(work=algorithm.displayName(), version=plugin_version(),
                    crs=crs_name(horizontal(reference)) if crs_from(reference).isValid() else "",
                    heights=stated.name if stated.known else tr("not stated by the inputs"),
                    inputs=_told(algorithm, parameters, context, inputs=True),
                    settings=_told(algorithm, parameters, context, inputs=False))


def _reference(algorithm, parameters: Mapping, context: QgsProcessingContext):
    """The CRS of the first input that states one: point clouds, then layers, then a CRS that is given."""
    from ..layers.reprojection import points_wkt

    found = points_wkt(algorithm, parameters, context)
    if found:
        return found
    for definition in algorithm.parameterDefinitions():
        name = definition.name()
        if not parameters.get(name):
            continue
        if definition.type() in ("source", "vector", "raster"):
            layer = QgsProcessingUtils.mapLayerFromString(str(_plain(parameters[name])), context)
            if layer is not None and layer.crs().isValid():
                return layer.crs()
        elif definition.type() == "crs":
            return algorithm.parameterAsCrs(parameters, name, context)
    return None


def _told(algorithm, parameters: Mapping, context: QgsProcessingContext, inputs: bool) -> dict[str, str]:
    """Values of the inputs, or of all else, by label as the user knows them; what was left out is not told."""
    values = {}
    for definition in algorithm.parameterDefinitions():
        name = definition.name()
        if definition.isDestination() or name in UNTOLD or (definition.type() in INPUTS) != inputs:
            continue
        value = parameters.get(name, definition.defaultValue())
        words = definition.metadata().get("urbanmap_words", {})
        text = words.get(value, "") if isinstance(value, str) else ""
        text = text or (value if _is_free_text(definition, value) else value_text(value, context))
        if text:
            unit = UNIT.findall(definition.description()) if not inputs else []
            unit = unit or (["m"] if definition.type() == "distance" else [])
            label = UNIT.sub("", definition.description()) if unit else definition.description()
            values[label] = text + (f" {unit[0].strip(' ()')}" if unit else "")
    return values


def _is_free_text(definition, value: object) -> bool:
    """Whether a value is text as the user wrote it, where "GNSS/IMU" is no path."""
    return definition.type() == "string" and isinstance(value, str) and not TEMPORARY_LAYER.search(value)


def value_text(value: object, context: QgsProcessingContext) -> str:
    """A parameter's value in words: of files and layers their names."""
    value = _plain(value)
    if value is None or value == "" or value == NULL:
        return ""
    if isinstance(value, bool):
        return tr("yes") if value else tr("no")
    if isinstance(value, (list, tuple)):
        return ", ".join(value_text(item, context) for item in value)
    if hasattr(value, "authid"):
        return crs_name(value)
    if hasattr(value, "name") and hasattr(value, "source"):
        return value.name()
    text = f"{value:g}" if isinstance(value, float) else str(value)
    if TEMPORARY_LAYER.search(text):
        layer = QgsProcessingUtils.mapLayerFromString(text, context, False)
        return layer.name() if layer is not None else tr("result of an earlier step")
    path, _, part = text.partition("|layername=")
    return Path(path).name + (f", {part}" if part else "") if os.sep in path else text


def _plain(value: object) -> object:
    """What stands in a definition of a source or of a property."""
    if hasattr(value, "source") and hasattr(value.source, "staticValue"):
        value = value.source
    return value.staticValue() if hasattr(value, "staticValue") else value
