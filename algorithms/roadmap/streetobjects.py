"""urbanmap:streetobjects."""

from __future__ import annotations

from collections import Counter

from ...urbanmap_qgis.settings.roadmap import EdgeSettings, ObjectSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..mobile.survey_inputs import read_survey
from .roadedges import RoadEdges

FIELDS = ("object_id", "kind", "confidence", "height", "diameter", "lean", "azimuth", "crown", "arm", "arm_height",
          "head_height", "board_width", "board_height", "board_z", "sigma", "points", "passes", "status", "reason",
          "second_kind")
RAIL_FIELDS = ("rail_id", "height", "sigma", "sigma_z", "length", "points", "passes", "status", "reason")


class StreetObjects(UrbanMapAlgorithm):
    ID = "streetobjects"
    NAME = "Street objects"
    SOURCE = "Javanmardi, 6.2"
    KEYWORDS = ("pole", "lamp post", "street light", "traffic light", "signal", "traffic sign", "tree", "guard rail",
                "street furniture", "bollard", "cabinet", "MMS")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "rasterio")
    HELP = (
        "Finds poles, lamp posts, signals, signs, trees, bollards and boxes such as cabinets along the drive of a "
        "corrected mobile survey, as points at their feet with height, diameter, direction and standard deviation.\n"
        "Things that stay narrow in plan over height are stems. The axis of a stem is adjusted to the sides of it that "
        "were seen, as each line of sight sees its middle across and its face before the axis. The sizes and "
        "the place of what hangs on the stem, beside those that standards of Japan, Germany and the United States "
        "give to signals, signs and lamps, tell the kind and how likely it is; leaves on all sides make a tree. "
        "What a sign says is not read. Bollards (0.5 to 1.5 m high) and boxes (0.7 to 2 m high, "
        "“other upright”) stand free beside the road.\n"
        "Stems of few points, with a hidden foot, or that may be a part of a wall are doubtful, with the reason. "
        "Points and trajectory must be corrected ones: objects are as wrong as the survey is."
    )

    def declare(self):
        self.add_from(RoadEdges, "POINTS", "TRAJECTORY", "ANGLES", "GEOID", "GEOID_HEIGHT")
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres, from which those of the "
                        "points are counted. Without it the ground is found among the points; where the raster has no "
                        "value no object is found.", optional=True)
        self.add_settings(ObjectSettings)
        self.add_points_crs()
        self.add_layer_output("OUTPUT", "Street objects", "PointZ at the foot: object_id, kind (pole, lamp post, "
                              "signal, sign, tree, bollard, other upright), confidence (0 to 1), height over the "
                              "ground, diameter (of the stem, or the longer sides of a box), lean (degrees), azimuth "
                              "(degrees, of a board's face or an arm), crown (diameter), arm and arm_height (length, "
                              "and height over the ground), head_height (of what is at its end), board_width, "
                              "board_height, board_z (height of the board's middle), sigma (east and north each, m), "
                              "points, passes, status (measured, doubtful), reason, second_kind (the next likely).",
                              kind="point")
        self.add_layer_output("OUTPUT_RAILS", "Guard rails", "LineStringZ along the foot: rail_id, height, sigma "
                              "(across), sigma_z, length (m), points, passes, status, reason; as “Road edges” finds "
                              "them.", optional=True, kind="line")
        self.add_report("HTML report: verdict, figures, a map, what is doubtful.")
        self.add_folder_output("OUTPUT_CITYGML", "CityGML folder", "CityGML 2.0 with i-UR 3.2 as PLATEAU lays it out: "
                               "udx/frn (city furniture) and udx/veg (trees) by third meshes, with the lists of "
                               "codes; LOD1 as blocks, LOD2 of posts with arms and boards.", optional=True)
        self.add_text("DATA_DATE", "Date of the data", "Day on which the model was made, such as 2026-04-01; CityGML "
                      "has it as creationDate, which PLATEAU asks for.", "", advanced=True)
        self.add_number_output("OBJECTS", "Objects", "Number of objects.")
        self.add_number_output("DOUBTFUL", "Doubtful objects", "Number of objects that are doubtful.")
        self.add_number_output("MEDIAN_SIGMA", "Median sigma", "Median standard deviation of the feet of measured "
                               "objects; no value without any.", "m")

    def check(self, parameters, context):
        self.day_of(parameters, "DATA_DATE", context)

    def work(self, parameters, context, progress):
        import numpy as np

        from ...urbanmap_qgis.roadmap.objects.object_records import MEASURED
        from .object_report import write_object_report

        paths, crs, read = read_survey(self, parameters, context, progress)
        settings = self.settings(ObjectSettings, parameters, context)
        wants_rails = parameters.get("OUTPUT_RAILS") not in (None, "")
        found, rails = self._find(parameters, context, paths, crs, read.trajectory, settings, wants_rails, progress)
        self._tell(found, progress)
        results = self._write(parameters, context, found, rails, crs)
        folder = self.output_path(parameters, "OUTPUT_CITYGML", context)
        if folder is not None:
            results["OUTPUT_CITYGML"] = self._write_citygml(parameters, context, folder, found, crs, progress)
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_object_report, found, read.trajectory)
        sigmas = [thing.sigma for thing in found.objects if thing.status == MEASURED]
        return {**results, "OBJECTS": len(found.objects), "DOUBTFUL": len(found.objects) - len(sigmas),
                "MEDIAN_SIGMA": float(np.median(sigmas)) if sigmas else None}

    def _find(self, parameters, context, paths, crs, trajectory, settings, wants_rails, progress):
        """Objects, and the guard rails where they are wanted."""
        from ...urbanmap_qgis.roadmap.edges.edge_records import RAIL
        from ...urbanmap_qgis.roadmap.edges.road_edges import road_edges
        from ...urbanmap_qgis.roadmap.objects.street_objects import street_objects

        rails, share = [], 0.5 if wants_rails else 0.95
        with self.sampled_raster(parameters, "GROUND", context, "POINTS", crs) as ground:
            heights = ground and ground.sample
            found = street_objects(paths, trajectory, settings, heights, progress.part(0.0, share))
            if wants_rails:
                edges = EdgeSettings(width=settings.width, survey_sigma=settings.survey_sigma)
                found_edges = road_edges(paths, trajectory, edges, heights, progress.part(share, 0.95)).edges
                rails = [edge for edge in found_edges if edge.kind == RAIL]
        return found, rails

    def _write(self, parameters, context, found, rails, crs):
        import shapely

        objects = found.objects
        columns = {"object_id": list(range(1, len(objects) + 1)),
                   **{name: [getattr(thing, name) for thing in objects] for name in (
                       "kind", "confidence", "height", "diameter", "lean", "azimuth", "crown", "head_height", "sigma",
                       "points", "passes", "status")},
                   "arm": [thing.arm[0] if thing.arm else None for thing in objects],
                   "arm_height": [thing.arm[1] if thing.arm else None for thing in objects],
                   "board_width": [thing.board.width if thing.board else None for thing in objects],
                   "board_height": [thing.board.height if thing.board else None for thing in objects],
                   "board_z": [float(thing.board.centre[2]) if thing.board else None for thing in objects],
                   "reason": [tr(thing.reason) if thing.reason else None for thing in objects],
                   "second_kind": [thing.second or None for thing in objects]}
        results = self.write_layer(
            parameters, "OUTPUT", context, make_fields(*FIELDS), columns, crs,
            [shapely.points(thing.foot) for thing in objects], "PointZ", style="street_objects")
        if parameters.get("OUTPUT_RAILS") not in (None, ""):
            rail_columns = {"rail_id": list(range(1, len(rails) + 1)),
                            **{name: [getattr(rail, name) for rail in rails] for name in RAIL_FIELDS[1:]},
                            "reason": [tr(rail.reason) if rail.reason else None for rail in rails]}
            results |= self.write_layer(
                parameters, "OUTPUT_RAILS", context, make_fields(*RAIL_FIELDS), rail_columns, crs,
                [shapely.linestrings(rail.foot) for rail in rails], "LineStringZ", style="street_rails")
        return results

    def _write_citygml(self, parameters, context, folder, found, crs, progress):
        from ...urbanmap_qgis.roadmap.objects.object_city import write_object_citygml

        write_object_citygml(folder, found.objects, crs, creation_day(self, parameters, context, progress), progress)
        return str(folder)

    def _tell(self, found, progress):
        progress.message(tr("{0} objects along {1:.0f} m.").format(len(found.objects), found.path_length))
        for kind, count in sorted(Counter(thing.kind for thing in found.objects).items()):
            progress.message(tr("{0}: {1}").format(tr(kind), count))
        reasons = Counter(thing.reason for thing in found.objects if thing.reason)
        for reason, count in sorted(reasons.items()):
            progress.message(tr("{0} objects are doubtful: {1}.").format(count, tr(reason)))


def creation_day(algorithm, parameters, context, progress) -> str:
    """The day of DATA_DATE for CityGML, ISO 8601; without one the user is told."""
    day = algorithm.day_of(parameters, "DATA_DATE", context)
    if not day:
        progress.warn(tr("{0} is not given: CityGML then has no creationDate, which PLATEAU asks for.").format(
            algorithm.label_of("DATA_DATE")))
    return day
