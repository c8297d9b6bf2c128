"""urbanmap:segmentroofs."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.buildings import LEVELS, PAPER, PLANES, PlaneParameters, RoofParameters
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import BUILDING_ID, building_names, footprints_of, numbers, open_points


class SegmentRoofs(UrbanMapAlgorithm):
    ID = "segmentroofs"
    NAME = "Segment roofs"
    SOURCE = "Javanmardi, 5.3.2"
    KEYWORDS = ("building", "roof", "height", "histogram", "ALS", "lidar", "segmentation")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "cv2")
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
        self.add_settings(RoofParameters, "method")
        self.add_choice("ROOFS", "Roofs", "planes: level and sloped roof planes (LoD2.2); levels: level roofs, sloped "
                        "ones cut into steps (LoD1.3). The paper's method has levels always.", (PLANES, LEVELS), PLANES)
        self.add_settings(RoofParameters)
        self.add_settings(PlaneParameters)
        self.add_workers()
        self.add_points_output("OUTPUT", "Roof points", "The buildings' points with the attribute roof_id: the "
                               "number of the roof in its building, 0 for trees, walls and roof furniture.")
        self.add_layer_output("OUTPUT_ROOFS", "Roofs", "Table of the roofs: building_id, roof_id, height (robust, m), "
                              "height_max (highest point as in the paper, m), points, area (m2), density (points a "
                              "m2), rmse (m), slope (degrees), azimuth (degrees from north, where it falls to), "
                              "status.", kind="any")
        self.add_number_output("ROOFS", "Roofs", "Number of roofs found.")
        self.add_number_output("WITHOUT_ROOFS", "Buildings without a roof", "Buildings in whose points no roof was "
                               "found.")

    def check(self, parameters, context):
        width, shift = (self.parameterAsDouble(parameters, name, context) for name in ("BIN_WIDTH", "BIN_SHIFT"))
        if shift > width:
            raise InputError(tr("{0} is {1} m, more than {2}, {3} m: heights between the bins would be lost; give at "
                                "most the width.").format(self.label_of("BIN_SHIFT"), shift,
                                                          self.label_of("BIN_WIDTH"), width))

    def work(self, parameters, context, progress):
        import numpy as np

        from ...urbanmap_qgis.buildings.roof_stage import segment_cloud_roofs

        table = self.read_polygons(parameters, "FOOTPRINTS", context, progress)
        footprints = footprints_of(table, progress)
        cloud = open_points(self, parameters, context, table, progress, may_be_empty=True)
        settings, planes = self.settings(RoofParameters, parameters, context), None
        if self.parameterAsString(parameters, "ROOFS", context) == PLANES and settings.method != PAPER:
            planes = self.settings(PlaneParameters, parameters, context)
        known = numbers(table, "density")
        positive = known[known > 0] if known is not None else np.zeros(0)
        density = float(np.median(positive)) if len(positive) else None
        points = self.output_path(parameters, "OUTPUT", context)
        with self.workers(parameters, context) as executor:
            roofs = segment_cloud_roofs(cloud, footprints, points, settings, numbers(table, "ground"), density,
                                        executor, progress.part(0.0, 0.95), planes)
        layer = self._write(parameters, context, table, roofs, progress.part(0.95, 1.0))
        without = int((~np.isin(footprints.ids, roofs.building_id)).sum())
        if without:
            progress.warn(tr("{0} of {1} buildings have no roof in their points.").format(without, len(footprints)))
        return {
            "OUTPUT": str(points), **layer,
            "ROOFS": len(roofs.roof_id), "WITHOUT_ROOFS": without,
        }

    def _write(self, parameters, context, table, roofs, progress):
        fields = make_fields((BUILDING_ID, "int"), "roof_id", "height", "height_max", "points", "area", "density",
                             "rmse", "slope", "azimuth", "status")
        columns = {field.name(): getattr(roofs, field.name()) for field in fields}
        return self.write_layer(parameters, "OUTPUT_ROOFS", context, fields, columns, table.crs, progress=progress,
                                names=building_names(table))
