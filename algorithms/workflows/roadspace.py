"""urbanmap:roadspace."""

from __future__ import annotations

from ..framework.base import UrbanMapAlgorithm
from ..framework.running.chain import GivenParameters, files_read_once, rest_kept
from ..roadmap.markinglines import MarkingLines
from ..roadmap.roadedges import RoadEdges
from ..roadmap.roadmodel import RoadModel
from ..roadmap.streetobjects import StreetObjects
from ..roadmap.vectormap import VectorMap

READING = ("ANGLES", "GEOID", "GEOID_HEIGHT", "POINTS_CRS")
"""How points and trajectory are read, by all steps."""

ROAD_LAYERS = ("OUTPUT", "OUTPUT_AREAS", "OUTPUT_STEPS", "OUTPUT_FINDINGS", "OUTPUT_CITYGML", "OUTPUT_REPORT")
LANE_LAYERS = ("OUTPUT_LANES", "OUTPUT_BOUNDS")
LANE_FILES = ("OUTPUT_LANELET2", "OUTPUT_OPENDRIVE")
FIGURES = ("SURFACES", "JUNCTIONS", "FINDINGS")
OBJECT_FIGURES = ("OBJECTS", "DOUBTFUL")


class RoadSpace(UrbanMapAlgorithm):
    ID = "roadspace"
    NAME = "Road space from a mobile survey"
    SOURCE = "Javanmardi, 6.2; Project PLATEAU, standard product specification 5.0, 4.3 and 4.14"
    KEYWORDS = ("road", "PLATEAU", "CityGML", "LOD3", "kerb", "lane", "pole", "sign", "tree", "street furniture", "MMS",
                "workflow")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs")
    HELP = (
        "Goes from a corrected mobile survey and reference markings to the road as a model, in one run: kerbs, lanes, "
        "and of them carriageways, junctions, sidewalks and islands with their steps; and what stands beside the road: "
        "poles, lamp posts, signals, signs and trees. All as layers and as CityGML of PLATEAU; the lanes with what "
        "stands beside them as Lanelet2 and OpenDRIVE files, too.\n"
        "Several drives are given as one: their points together, their trajectories one after another in one file. "
        "What was not seen is a finding with its place, never made up. Where the edges bound no carriageway, the road "
        "model is empty and a warning says why; the rest is kept."
    )

    def declare(self):
        self.add_from(StreetObjects, "POINTS", "TRAJECTORY")
        self.add_from(MarkingLines, "MARKINGS", optional=False)
        self.add_from(RoadModel, "GROUND", "ROADS")
        self.add_from(RoadModel, "LOD")
        self.add_from(StreetObjects, "WIDTH", "SIGMA", "DATA_DATE", advanced=True)
        self.add_from(StreetObjects, *READING, advanced=True)
        self.add_from(RoadModel, "FUNCTION")
        self.add_from(VectorMap, "TRAFFIC")
        self.add_from(RoadModel, *ROAD_LAYERS)
        self.add_from(StreetObjects, OUTPUT_OBJECTS="OUTPUT", optional=True, by_default=True)
        self.add_from(StreetObjects, OUTPUT_FURNITURE="OUTPUT_CITYGML", label="CityGML folder of furniture and trees")
        self.add_from(StreetObjects, OUTPUT_OBJECT_REPORT="OUTPUT_REPORT", label="Report on the objects")
        self.add_from(RoadEdges, OUTPUT_EDGES="OUTPUT", optional=True, by_default=True)
        self.add_from(VectorMap, "OUTPUT_LANES", "OUTPUT_BOUNDS", optional=True, by_default=True)
        self.add_from(VectorMap, *LANE_FILES)
        self.add_from(RoadModel, *FIGURES)
        self.add_from(StreetObjects, *OBJECT_FIGURES)

    def compute(self, parameters, context, feedback):
        with files_read_once(), rest_kept():
            return self._run_stages(parameters, context, feedback)

    def _run_stages(self, parameters, context, feedback):
        given = GivenParameters(parameters)
        run = self.child_runner(context, feedback, 5)
        survey = {"POINTS": self.parameterAsFileList(parameters, "POINTS", context),
                  **given.pick("TRAJECTORY", "WIDTH", "SIGMA", *READING)}
        edges = run("roadedges", **survey, OUTPUT=given.get("OUTPUT_EDGES") or "TEMPORARY_OUTPUT",
                    OUTPUT_TOPS="TEMPORARY_OUTPUT")
        objects = run("streetobjects", **survey, **given.pick("DATA_DATE"),
                      OUTPUT=given.get("OUTPUT_OBJECTS") or "TEMPORARY_OUTPUT", OUTPUT_RAILS="TEMPORARY_OUTPUT",
                      **given.pick(OUTPUT_CITYGML="OUTPUT_FURNITURE", OUTPUT_REPORT="OUTPUT_OBJECT_REPORT"))
        lines = run("markinglines", **given.pick("MARKINGS", "GROUND"), OUTPUT="TEMPORARY_OUTPUT",
                    OUTPUT_AREAS="TEMPORARY_OUTPUT")
        lanes = run("vectormap", **given.pick("TRAFFIC"), LINES=lines["OUTPUT"], AREAS=lines["OUTPUT_AREAS"],
                    EDGES=edges["OUTPUT"], TRAJECTORY=[given["TRAJECTORY"]], OBJECTS=objects["OUTPUT"],
                    RAILS=objects["OUTPUT_RAILS"], **given.pick(*LANE_FILES),
                    **{name: given.get(name) or "TEMPORARY_OUTPUT" for name in LANE_LAYERS})
        roads = run("roadmodel", **given.pick("ROADS", "GROUND", "LOD", "FUNCTION", "DATA_DATE", *ROAD_LAYERS),
                    EDGES=edges["OUTPUT"], TOPS=edges["OUTPUT_TOPS"], LANES=lanes["OUTPUT_LANES"],
                    STOP_LINES=lines["OUTPUT"])
        results = {name: roads[name] for name in (*ROAD_LAYERS, *FIGURES) if name in roads}
        results |= {name: objects[name] for name in OBJECT_FIGURES}
        for outputs, stage_names in ((objects, {"OUTPUT_OBJECTS": "OUTPUT", "OUTPUT_FURNITURE": "OUTPUT_CITYGML",
                                                "OUTPUT_OBJECT_REPORT": "OUTPUT_REPORT"}),
                                     (edges, {"OUTPUT_EDGES": "OUTPUT"}),
                                     (lanes, {name: name for name in (*LANE_LAYERS, *LANE_FILES)})):
            results |= {name: outputs[stage_name] for name, stage_name in stage_names.items()
                        if stage_name in outputs and name in given}
        return results
