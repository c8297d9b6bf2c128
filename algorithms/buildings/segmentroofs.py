"""urbanmap:segmentroofs."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import BUILDING_ID, building_names, footprints_of, numbers, open_points
from ..framework.layers.point_outputs import check_points_output, points_output
from ..framework.running.workers import workers

PAPER = "paper"
PLANES, LEVELS = "planes", "levels"


class SegmentRoofs(UrbanMapAlgorithm):
    ID = "segmentroofs"
    NAME = "Segment roofs"
    SOURCE = "Javanmardi 2018, 5.3.2"
    KEYWORDS = ("building", "roof", "height", "histogram", "ALS", "lidar", "segmentation")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "cv2", "skimage")
    HELP = (
        "Segments the roofs of each building: planes, level and sloped, grown on its points; or level roofs by the "
        "histogram of its points' heights.\n"
        "The histogram has overlapping bins. Each maximum with more points than the minimum roof area holds is a "
        "roof; a parapet's maximum is joined with its roof's. Beyond the paper, one maximum that is two roofs "
        "apart in plan becomes two, small roofs that stand out are kept, and sloped roofs become a few level ones, "
        "as finely as the height error asks."
    )

    def declare(self):
        self.add_points(help="Points with the attribute building_id, from “Segment buildings”.")
        self.add_polygons("FOOTPRINTS", "Buildings", "Outlines from “Segment buildings”; their fields ground and "
                          "density are used where they are there.")
        self.add_choice("METHOD", "Method", "The full method segments roofs in the histogram and in plan. The paper's "
                        "has the histogram alone: all points in the expanded outline, maxima of at least the minimum "
                        "roof area times the density; it uses bin width, bin shift, minimum roof area and parapet "
                        "threshold only.", ("full", "paper"), "full")
        self.add_choice("ROOFS", "Roofs", "planes: level and sloped roof planes (LoD2.2); levels: level roofs, sloped "
                        "ones cut into steps (LoD1.3). The paper's method has levels always.", (PLANES, LEVELS), PLANES)
        self.add_distance("BIN_WIDTH", "Bin width", "Width of a histogram bin in metres.", 0.5, 0.05, 10.0)
        self.add_distance("BIN_SHIFT", "Bin shift", "Distance in metres from one bin to the next; smaller than the "
                          "width, so that bins overlap.", 0.1, 0.01, 10.0)
        self.add_number("MIN_ROOF_AREA", "Minimum roof area", "Area in square metres that a maximum of the histogram "
                        "must hold to be a roof (times the density: the paper's alpha).", 50.0, 0.5, 100000.0, "m2")
        self.add_number("PARAPET_THRESHOLD", "Parapet threshold", "Two maxima are one roof where the histogram "
                        "between them stays above this number of points (the paper's beta). Without it, 0.3 "
                        "of the smaller maximum; with the paper's method, 0.3 of alpha.", None, 0, None, "points",
                        optional=True)
        self.add_number("MIN_ROOF_SHARE", "Minimum roof share", "The minimum roof area is no more than this share of "
                        "the outline's area, so that small buildings have roofs too; 1 asks for the minimum roof area "
                        "everywhere but in buildings smaller than that.", 0.2, 0.01, 1.0, advanced=True)
        self.add_number("SMALL_ROOF_AREA", "Minimum area of a small roof", "Area in square metres of the smallest "
                        "part that stands out in height and becomes a roof of its own.", 4.0, 0.5, 1000.0, "m2",
                        advanced=True)
        self.add_distance("HEIGHT_RMSE", "Height error of sloped roofs", "Sloped roofs are cut into level ones until "
                          "the building's root mean square height error in metres is below this; 0 keeps the "
                          "roofs of the paper whole.", 0.45, 0.0, 10.0, advanced=True)
        self.add_distance("MIN_HEIGHT", "Minimum roof height", "Height in metres above the ground below which nothing "
                          "is a roof.", 2.0, 0.0, 20.0, advanced=True)
        self.add_distance("PLANE_TOLERANCE", "Plane tolerance", "Largest distance in metres of a point from its roof "
                          "plane; three to four times the noise of the heights.", 0.2, 0.02, 2.0, advanced=True)
        self.add_number("MIN_PLANE_AREA", "Minimum area of a plane", "Area in square metres of the smallest roof "
                        "plane.", 1.5, 0.2, 1000.0, "m2", advanced=True)
        self.add_workers()
        self.add_points_output("OUTPUT", "Roof points", "The buildings' points with the attribute roof_id: the "
                               "number of the roof in its building, 0 for trees, walls and roof furniture.")
        self.add_layer_output("OUTPUT_ROOFS", "Roofs", "Table of the roofs: building_id, roof_id, height (robust, m), "
                              "height_max (highest point as in the paper, m), points, area (m2), density (points a "
                              "m2), rmse (m), slope (degrees), azimuth (degrees from north, where it falls to), "
                              "status.", source_type=_table())
        self.add_number_output("ROOFS", "Roofs", "Number of roofs found.")
        self.add_number_output("WITHOUT_ROOFS", "Buildings without a roof", "Buildings in whose points no roof was "
                               "found.")

    def check(self, parameters, context):
        check_points_output(self, parameters, context)
        width, shift = (self.parameterAsDouble(parameters, name, context) for name in ("BIN_WIDTH", "BIN_SHIFT"))
        if shift > width:
            raise InputError(tr("{0} is {1} m, more than {2}, {3} m: heights between the bins would be lost; give at "
                                "most the width.").format(self.label_of("BIN_SHIFT"), shift,
                                                          self.label_of("BIN_WIDTH"), width))

    def compute(self, parameters, context, feedback):
        import numpy as np

        from ...urbanmap_qgis.buildings.planes.plane_detection import PlaneParameters
        from ...urbanmap_qgis.buildings.roof_stage import segment_cloud_roofs
        from ...urbanmap_qgis.buildings.roofs.roof_levels import RoofParameters

        progress = self.progress(feedback)
        table = self.read_polygons(parameters, "FOOTPRINTS", context, progress)
        footprints = footprints_of(table, progress)
        cloud = open_points(self, parameters, context, table, progress, may_be_empty=True)
        beta = parameters.get("PARAPET_THRESHOLD")
        settings = RoofParameters(
            method=self.parameterAsString(parameters, "METHOD", context),
            bin_width=self.parameterAsDouble(parameters, "BIN_WIDTH", context),
            bin_shift=self.parameterAsDouble(parameters, "BIN_SHIFT", context),
            min_roof_area=self.parameterAsDouble(parameters, "MIN_ROOF_AREA", context),
            min_roof_share=self.parameterAsDouble(parameters, "MIN_ROOF_SHARE", context),
            parapet_threshold=None if beta is None else self.parameterAsDouble(parameters, "PARAPET_THRESHOLD",
                                                                               context),
            small_roof_area=self.parameterAsDouble(parameters, "SMALL_ROOF_AREA", context),
            height_rmse=self.parameterAsDouble(parameters, "HEIGHT_RMSE", context) or None,
            min_height=self.parameterAsDouble(parameters, "MIN_HEIGHT", context))
        planes = None
        if self.parameterAsString(parameters, "ROOFS", context) == PLANES and settings.method != PAPER:
            planes = PlaneParameters(self.parameterAsDouble(parameters, "PLANE_TOLERANCE", context),
                                     self.parameterAsDouble(parameters, "MIN_PLANE_AREA", context))
        known = numbers(table, "density")
        positive = known[known > 0] if known is not None else np.zeros(0)
        density = float(np.median(positive)) if len(positive) else None
        with points_output(self, parameters, context) as points:
            with workers(self.parameterAsInt(parameters, "WORKERS", context)) as executor:
                roofs = segment_cloud_roofs(cloud, footprints, points, settings, numbers(table, "ground"), density,
                                            executor, progress.part(0.0, 0.95), planes)
            layer = self._write(parameters, context, table, roofs, progress.part(0.95, 1.0))
        without = int((~np.isin(footprints.ids, roofs.building_id)).sum())
        if without:
            progress.warn(tr("{0} of {1} buildings have no roof in their points.").format(without, len(footprints)))
        return {
            "OUTPUT": str(self.output_path(parameters, "OUTPUT", context)), "OUTPUT_ROOFS": layer,
            "ROOFS": len(roofs.roof_id), "WITHOUT_ROOFS": without,
        }

    def _write(self, parameters, context, table, roofs, progress):
        fields = make_fields((BUILDING_ID, "int"), ("roof_id", "int"), ("height", "real"), ("height_max", "real"),
                             ("points", "int"), ("area", "real"), ("density", "real"), ("rmse", "real"),
                             ("slope", "real"), ("azimuth", "real"), ("status", "text"))
        columns = {field.name(): getattr(roofs, field.name()) for field in fields}
        return self.write_layer(parameters, "OUTPUT_ROOFS", context, fields, columns, table.crs, progress=progress,
                                names=building_names(table))


def _table():
    from qgis.core import QgsProcessing

    return QgsProcessing.SourceType.TypeVector
