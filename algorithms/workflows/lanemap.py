"""urbanmap:lanemap."""

from __future__ import annotations

from ..framework.base import UrbanMapAlgorithm
from ..framework.running.chain import GivenParameters
from ..roadmap.markinglines import MarkingLines
from ..roadmap.vectormap import VectorMap

MAP_INPUTS = ("TRAJECTORY", "ORTHOPHOTO", "EDGES", "ROADS", "OBJECTS", "RAILS")
MAP_SETTINGS = ("TRAFFIC", "SPEED_LIMIT")
MAP_ADVANCED = ("MIN_WIDTH", "MAX_WIDTH", "BRIDGE", "INFER_WAYS", "WAY_CONFIDENCE", "DIALECT", "PROJECTOR",
                "VERTICAL_DATUM")
LAYERS = ("OUTPUT_LANES", "OUTPUT_CENTRES", "OUTPUT_BOUNDS", "OUTPUT_FINDINGS")
FILES = ("OUTPUT_LANELET2", "OUTPUT_PROJECTOR", "OUTPUT_OPENDRIVE", "OUTPUT_REPORT")
FIGURES = ("LANES", "LENGTH", "FINDINGS")


class LaneMap(UrbanMapAlgorithm):
    ID = "lanemap"
    NAME = "Lane map from markings and drives"
    SOURCE = "Javanmardi, 6.2"
    KEYWORDS = ("lane", "HD map", "vector map", "Lanelet2", "OpenDRIVE", "Autoware", "marking", "workflow")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio")
    HELP = (
        "Goes from reference markings and corrected drives to a lane map, in one run: line work of the markings, then "
        "lanes with their bounds, directions and connections, as layers, as Lanelet2 file for Autoware and as "
        "OpenDRIVE file.\n"
        "Markings and ground are what “Road markings from aerial frames” makes; trajectories are what “Georeference "
        "mobile survey” makes. What is missing for a lane is a finding with its place: look at them, for no lane is "
        "made without evidence."
    )

    def declare(self):
        self.add_from(MarkingLines, "MARKINGS", optional=False)
        self.add_from(MarkingLines, "GROUND")
        self.add_from(VectorMap, *MAP_INPUTS, *MAP_SETTINGS)
        self.add_from(MarkingLines, "POINTS", "POINTS_CRS", advanced=True)
        self.add_from(MarkingLines, "SIGMA", "MIN_LENGTH", advanced=True)
        self.add_from(MarkingLines, MAX_LINE_WIDTH="MAX_WIDTH", advanced=True)
        self.add_from(VectorMap, *MAP_ADVANCED, advanced=True)
        self.add_from(VectorMap, *LAYERS)
        self.add_from(MarkingLines, OUTPUT_LINES="OUTPUT", optional=True, by_default=True)
        self.add_from(MarkingLines, "OUTPUT_AREAS", optional=True, by_default=True)
        self.add_from(VectorMap, *FILES, *FIGURES)

    def compute(self, parameters, context, feedback):
        given = GivenParameters(parameters)
        run = self.child_runner(context, feedback, 2)
        lines = run("markinglines", **given.pick("MARKINGS", "POINTS", "POINTS_CRS", "GROUND", "SIGMA", "MIN_LENGTH",
                                                  MAX_WIDTH="MAX_LINE_WIDTH"),
                    OUTPUT=given.get("OUTPUT_LINES") or "TEMPORARY_OUTPUT",
                    OUTPUT_AREAS=given.get("OUTPUT_AREAS") or "TEMPORARY_OUTPUT")
        result = run("vectormap", **given.pick(*MAP_INPUTS, *MAP_SETTINGS, *MAP_ADVANCED, *LAYERS, *FILES),
                     LINES=lines["OUTPUT"], AREAS=lines["OUTPUT_AREAS"])
        results = {name: result[name] for name in (*LAYERS, *FILES, *FIGURES) if name in result}
        results |= {name: lines[stage] for name, stage in (("OUTPUT_LINES", "OUTPUT"), ("OUTPUT_AREAS", "OUTPUT_AREAS"))
                    if name in given}
        return results
