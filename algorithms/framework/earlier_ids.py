"""Ids of earlier versions whose work another algorithm does now: each still runs, as a row of a table says.

Models and scripts of users keep working; the toolbox and the modeller show only the algorithm of today.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from .base import UrbanMapAlgorithm


@dataclass(frozen=True)
class EarlierId:
    """How an earlier algorithm is run by that of today.

    Attributes
    ----------
    stage : module (relative to `algorithms`) and class of the algorithm of today.
    names : parameters and outputs that keep their names.
    renamed : names of today of the others.
    required : outputs that the earlier id always made.
    """

    stage: str
    names: tuple[str, ...]
    renamed: Mapping[str, str] = field(default_factory=dict)
    required: tuple[str, ...] = ("OUTPUT",)


_PLACE = ("INPUT", "INPUT_FOLDER", "CRS")
_RESIDUALS = ("TRAJECTORY", "CORRECTED", "ANGLES", "GEOID", "GEOID_HEIGHT", "CRS", "OUTPUT", "MEAN_2D", "MAX_2D",
              "STD_2D", "MEAN_3D", "MAX_3D", "STD_3D", "POINTS_USED")

EARLIER_IDS = {
    "loadgsibuildings": EarlierId("buildings.loadgsi:LoadGsi", (*_PLACE, "BUILDINGS", "CRS_NAME"),
                                  {"OUTPUT": "OUTPUT_BUILDINGS"}),
    "loadgsidem": EarlierId("buildings.loadgsi:LoadGsi", (*_PLACE, "RESOLUTION", "MESHES", "EMPTY", "HEIGHTS"),
                            {"OUTPUT": "OUTPUT_GROUND"}),
    "checkvectormap": EarlierId("delivery.checkmodel:CheckModel", ("INPUT", "EXCLUDE", "OUTPUT", "OUTPUT_REPORT",
                                                                   "LANELETS", "ERRORS", "WARNINGS")),
    "checkcitymodel": EarlierId("delivery.checkmodel:CheckModel", (
        "INPUT", "INPUT_FOLDER", "EXCLUDE", "WORKERS", "SCHEDULER", "OUTPUT", "OUTPUT_TABLE", "OUTPUT_COUNTS",
        "OUTPUT_REPORT", "OBJECTS", "ERRORS", "WARNINGS")),
    "checkaccuracy": EarlierId("delivery.acceptance:Acceptance", _RESIDUALS,
                               {"CONTROL": "INPUT", "OUTPUT_REPORT": "OUTPUT_ERRORS"},
                               ("CONTROL", "TRAJECTORY", "OUTPUT")),
}


class EarlierAlgorithm(UrbanMapAlgorithm):
    """An id of `EARLIER_IDS`, which hands its parameters to the algorithm of today and its results back."""

    def __init__(self, identity: str, row: EarlierId, stage: type[UrbanMapAlgorithm]):
        super().__init__()
        self._row, self._stage = row, stage
        self.ID, self.SUCCESSOR = identity, stage.ID
        self.NAME, self.HELP, self.SOURCE = stage.NAME, stage.HELP, stage.SOURCE
        self.KEYWORDS, self.REQUIRES = stage.KEYWORDS, stage.REQUIRES

    def createInstance(self):
        return EarlierAlgorithm(self.ID, self._row, self._stage)

    def groupId(self):
        return self._stage().groupId()

    def flags(self):
        return super().flags() | self._stage().flags()

    def declare(self):
        for required in (True, False):
            pairs = {name: of_today for name, of_today in self._pairs() if (name in self._row.required) == required}
            self.add_from(self._stage, optional=False if required else None, **pairs)

    def check(self, parameters, context):
        self._of_today().check(self._renamed(parameters), context)

    def compute(self, parameters, context, feedback):
        results = self._of_today().compute(self._renamed(parameters), context, feedback)
        return {name: results[of_today] for name, of_today in self._pairs() if of_today in results}

    def _pairs(self) -> Iterator[tuple[str, str]]:
        return iter((*((name, name) for name in self._row.names), *self._row.renamed.items()))

    def _of_today(self) -> UrbanMapAlgorithm:
        stage = self._stage()
        stage.initAlgorithm()
        return stage

    def _renamed(self, parameters: Mapping) -> dict:
        return {of_today: parameters[name] for name, of_today in self._pairs() if name in parameters}


def earlier_algorithms(package: str) -> Iterator[EarlierAlgorithm]:
    """An algorithm for each earlier id; `package` is that of the algorithms."""
    for identity, row in EARLIER_IDS.items():
        module, _, name = row.stage.partition(":")
        yield EarlierAlgorithm(identity, row, getattr(importlib.import_module(f".{module}", package), name))
