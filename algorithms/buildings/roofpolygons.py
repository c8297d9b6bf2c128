"""urbanmap:roofpolygons."""

from __future__ import annotations

from dataclasses import replace

from ...urbanmap_qgis.settings.buildings import MAXIMUM, PAPER, PolygonParameters
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import building_names, footprints_of, open_points


class RoofPolygons(UrbanMapAlgorithm):
    ID = "roofpolygons"
    NAME = "Roof polygons"
    SOURCE = "Javanmardi, 5.3.3"
    KEYWORDS = ("building", "roof", "polygon", "alpha shape", "Hough", "outline")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "cv2")
    HELP = (
        "Draws the polygon of each roof from its points.\n"
        "The method “partition” divides each outline among its roofs along straight lines where roofs meet: no "
        "gaps, no slivers, common edges. The method “points” first draws the building's outer limit from its points, "
        "for outlines that are wrong in shape, then divides it likewise. The method “paper” outlines each roof on its "
        "own: radius outlier removal, alpha shape, Hough lines over the ordered boundary points, and the polygon from "
        "these lines, at the height of the roof's highest point; it leaves the outline aside and needs roofs of simple "
        "shape. A building without a roof then has no polygon; the other methods give it a plain block."
    )

    def declare(self):
        self.add_points(help="Points with the attributes building_id and roof_id, from “Segment roofs”.")
        self.add_polygons("FOOTPRINTS", "Buildings", "Outlines from “Segment buildings”.")
        self.add_settings(PolygonParameters)
        self.add_workers()
        self.add_layer_output("OUTPUT", "Roof polygons", "PolygonZ at the roofs' heights: building_id, roof_id (0: "
                              "plain block), height, height_max (m), points, density (points a m2), rmse (m), "
                              "coverage (share of the area with points), slope (degrees), azimuth "
                              "(degrees from north, where it falls to), status.")
        self.add_number_output("ROOFS", "Roofs", "Number of polygons.")
        self.add_number_output("WITHOUT_ROOFS", "Buildings without a roof", "Outlines that got no polygon.")

    def work(self, parameters, context, progress):
        import numpy as np
        import shapely

        from ...urbanmap_qgis.buildings.polygon_stage import cloud_roof_polygons

        table = self.read_polygons(parameters, "FOOTPRINTS", context, progress)
        footprints = footprints_of(table, progress)
        cloud = open_points(self, parameters, context, table, progress, may_be_empty=True)
        settings = self.settings(PolygonParameters, parameters, context)
        if settings.method == PAPER:
            settings = replace(settings, height=MAXIMUM)
        with self.workers(parameters, context) as executor:
            roofs = cloud_roof_polygons(cloud, footprints, settings, executor, progress)
        without = int((~np.isin(footprints.ids, roofs.building_id)).sum())
        if without:
            progress.warn(tr("{0} of {1} buildings got no roof polygon.").format(without, len(footprints)))
        fields = make_fields("building_id", "roof_id", "height", "height_max", "points", "density", "rmse", "coverage",
                             "slope", "azimuth", "status")
        geometries = shapely.force_3d(np.array(roofs.polygon, dtype=object), np.array(roofs.height, float))
        columns = {field.name(): getattr(roofs, field.name()) for field in fields}
        return {
            **self.write_layer(parameters, "OUTPUT", context, fields, columns, table.crs, geometries,
                                       "PolygonZ", "roof_polygons", progress, building_names(table)),
            "ROOFS": len(roofs.polygon), "WITHOUT_ROOFS": without,
        }
