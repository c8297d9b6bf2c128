"""The day of the data that goes into a city model."""

from __future__ import annotations

from datetime import date

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr


def day_of(algorithm, parameters, context) -> str:
    """The day given as DATA_DATE, ISO 8601; empty where none is given."""
    text = algorithm.parameterAsString(parameters, "DATA_DATE", context) or ""
    try:
        return date.fromisoformat(text).isoformat() if text else ""
    except ValueError:
        raise InputError(tr("{0}: {1} is no day; give it as 2026-04-01.").format(
            algorithm.label_of("DATA_DATE"), text)) from None
