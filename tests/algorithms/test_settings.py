"""What a dialog offers is what the core does by itself, so that figures measured on the core hold for both."""

from __future__ import annotations

import pytest

RECORDS = {"segmentroofs": 2, "wallsfrommms": 1, "roadmarkingsfrommms": 3, "localisationaccuracy": 2, "registermms": 3,
           "rectifytrajectory": 1}
"""Algorithms with the number of records that each reads."""


@pytest.fixture
def algorithms(qgis_app):
    from qgis.core import QgsApplication

    listed = QgsApplication.processingRegistry().providerById("urbanmap").algorithms()
    return {item.name(): item.create() for item in listed if hasattr(item, "settings_names")}


def test_untouched_dialogs_give_the_cores_own_settings(algorithms):
    from qgis.core import QgsProcessingContext

    for name, algorithm in algorithms.items():
        for record in algorithm.settings_names():
            read = algorithm.settings(record, {}, QgsProcessingContext())
            assert known(read) == known(record()), f"{name}: {record.__name__}"
    assert {name: len(algorithms[name].settings_names()) for name in RECORDS} == RECORDS


def known(record):
    """Fields of a record by name; those that are no number by default are None, as NaN is not itself."""
    return {name: value if value == value else None for name, value in vars(record).items()}


def test_what_is_given_is_read_by_its_name_and_kind(algorithms):
    from qgis.core import QgsProcessingContext

    roofs = algorithms["segmentroofs"]
    record = next(record for record in roofs.settings_names() if record.__name__ == "RoofParameters")
    given = {"BIN_WIDTH": 0.75, "METHOD": "paper", "PARAPET_THRESHOLD": 12}
    read = roofs.settings(record, given, QgsProcessingContext(), min_height=3.0)
    assert (read.bin_width, read.method, read.parapet_threshold, read.min_height) == (0.75, "paper", 12.0, 3.0)
    ground = algorithms["groundfrommms"]
    cloth, = ground.settings_names()
    read = ground.settings(cloth, {"THRESHOLD": 0.4, "ITERATIONS": 7}, QgsProcessingContext())
    assert read.threshold == 0.4 and read.iterations == 7 and isinstance(read.iterations, int)
    assert ground.parameterDefinition("THRESHOLD").minimum() == 0.01
