"""The Processing provider of UrbanMap."""

from __future__ import annotations

import importlib
import traceback
from pathlib import Path

from qgis.core import Qgis, QgsApplication, QgsMessageLog, QgsProcessingModelAlgorithm, QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .base import GROUPS
from .parameters import tr

ROOT = Path(__file__).resolve().parent.parent
MODELS = ROOT / "resources" / "models"

# Module and class of every algorithm. A module that cannot be imported is named in the log; the others go on.
ALGORITHMS = (
    ("samplecity", "SampleCity"),
    ("surfacefromals", "SurfaceFromAls"),
    ("orthorectifyframes", "OrthorectifyFrames"),
    ("filtervehicles", "FilterVehicles"),
    ("occlusionmap", "OcclusionMap"),
    ("roadmarkingsfromorthophoto", "RoadMarkingsFromOrthophoto"),
    ("aerialmarkings", "AerialMarkings"),
    ("registermms", "RegisterMms"),
    ("applytrajectory", "ApplyTrajectory"),
    ("georeferencemms", "GeoreferenceMms"),
    ("landmarkupdate", "LandmarkUpdate"),
    ("checkaccuracy", "CheckAccuracy"),
    ("groundfrommms", "GroundFromMms"),
    ("roadmarkingsfrommms", "RoadMarkingsFromMms"),
    ("facadetextures", "FacadeTextures"),
    ("objectsfromimages", "ObjectsFromImages"),
    ("georeferencescans", "GeoreferenceScans"),
    ("rectifytrajectory", "RectifyTrajectory"),
    ("tiepointproposals", "TiePointProposals"),
    ("loadgsibuildings", "LoadGsiBuildings"),
    ("segmentbuildings", "SegmentBuildings"),
    ("segmentroofs", "SegmentRoofs"),
    ("roofpolygons", "RoofPolygons"),
    ("buildingmodels", "BuildingModels"),
    ("wallsfrommms", "WallsFromMms"),
    ("mergebuildingmodels", "MergeBuildingModels"),
    ("mesh25d", "Mesh25D"),
    ("buildingsfromals", "BuildingsFromAls"),
    ("satellitevisibility", "SatelliteVisibility"),
    ("gnssreflections", "GnssReflections"),
    ("adjustwalls", "AdjustWalls"),
)

# What importing a module with a mistake in it raises.
BROKEN_MODULE = (ImportError, SyntaxError, NameError, AttributeError, TypeError, ValueError, OSError)


class UrbanMapProvider(QgsProcessingProvider):
    """Algorithms and models of UrbanMap in the toolbox, the modeller and `qgis_process`."""

    def id(self):
        return "urbanmap"

    def name(self):
        return "UrbanMap"

    def longName(self):
        return tr("UrbanMap: mobile mapping and 3D city models")

    def icon(self):
        return QIcon(str(ROOT / "resources" / "icons" / "urbanmap.svg"))

    def svgIconPath(self):
        return str(ROOT / "resources" / "icons" / "urbanmap.svg")

    def versionInfo(self):
        return plugin_version()

    def register(self) -> None:
        """Add the provider to QGIS, then load its algorithms.

        In this order, because a model finds its steps, and with them its outputs, through the registry.
        """
        QgsApplication.processingRegistry().addProvider(self)
        self.refreshAlgorithms()

    def load(self):
        return True

    def loadAlgorithms(self):
        for module, class_name in ALGORITHMS:
            try:
                algorithm = getattr(importlib.import_module(f".{module}", __package__), class_name)()
            except BROKEN_MODULE:
                self._warn(tr("The algorithm {0} cannot be loaded:").format(module), traceback.format_exc())
                continue
            self.addAlgorithm(algorithm)
        for path in sorted(MODELS.glob("*.model3")):
            model = QgsProcessingModelAlgorithm()
            if model.fromFile(str(path)):
                model.setGroup(tr(GROUPS.get(model.groupId(), model.group())))
                self.addAlgorithm(model)
            else:
                self._warn(tr("The model {0} cannot be loaded.").format(path.name))

    @staticmethod
    def _warn(sentence: str, detail: str = "") -> None:
        QgsMessageLog.logMessage(f"{sentence}\n{detail}".strip(), "UrbanMap", Qgis.MessageLevel.Warning)


def plugin_version() -> str:
    """Version in the plugin's metadata.txt."""
    for line in (ROOT / "metadata.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("version="):
            return line.partition("=")[2].strip()
    return ""
