"""urbanmap:objectsfromimages."""

from __future__ import annotations

from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import column
from .image_sources import add_images, check_images, image_sources

IMAGE = "image"

FIELDS = ("width", "height", "azimuth", "area", "z_low", "z_high", "distance", "points", "rmse", "sigma", "status",
          "reason")


class ObjectsFromImages(UrbanMapAlgorithm):
    ID = "objectsfromimages"
    NAME = "Objects from images"
    SOURCE = "Zhao and Shibasaki, 4.2"
    KEYWORDS = ("sign", "signal", "light", "kerb", "object", "line camera", "strip", "image", "laser")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    HELP = (
        "Brings outlines that were drawn on line images or frames into the map: sign boards, signals and lights as "
        "polygons or points, kerbs as lines.\n"
        "Laser points are projected into the image; those inside the outline and on the nearest connected "
        "surface give the outline its place, size, orientation and height. All fields of the outlines are kept.\n"
        "Open the image in QGIS without a coordinate reference system and draw on it: x runs along the columns, y "
        "is negative downwards. A field image names the file where there are several.\n"
        "Images and points must be placed by the same trajectory."
    )

    def declare(self):
        self.add_points(help="Laser points of the survey, LAS, LAZ or COPC, placed by the same trajectory.")
        add_images(self)
        self.add_vector("OUTLINES", "Outlines", "Polygons, lines or points drawn on the images, in pixels.",
                        kind="geometry")
        self.add_distance("REACH", "Maximum range", "Laser points farther from the camera are not used (line images).",
                          50.0, 1.0, 500.0, advanced=True)
        self.add_layer_output("OUTPUT", "Objects", "One feature an outline, with z: the fields of the outlines and "
                              "width, height (m), azimuth (degrees, where the surface faces), area (m2), z_low, "
                              "z_high, distance (m, from the camera), points, rmse, sigma (m), status, reason.",
                              kind="geometry")
        self.add_number_output("OBJECTS", "Outlines", "Number of outlines.")
        self.add_number_output("MEASURED", "Measured", "Outlines that became features with a place.")
        self.add_number_output("SIGMA", "Median sigma", "Median standard deviation of the corners' places against the "
                               "laser points.", "m")

    def check(self, parameters, context):
        check_images(self, parameters, context)

    def work(self, parameters, context, progress):
        import numpy as np

        from ...urbanmap_qgis.imagery.objects.image_outlines import image_outlines
        from ...urbanmap_qgis.imagery.objects.object_stage import geometry_type, objects_from_outlines

        cloud = self.projected_cloud(parameters, context)
        table = self.read_vector(parameters, "OUTLINES", context, progress)
        sources = image_sources(self, parameters, context, cloud.crs_wkt, progress)
        outlines = image_outlines(table.geometries, column(table, IMAGE), sources)
        result = objects_from_outlines(outlines, cloud, self.parameterAsDouble(parameters, "REACH", context),
                                       progress.part(0.0, 0.95))
        missing = sum(item.geometry is None for item in result)
        if missing:
            progress.warn(tr("{0} of {1} outlines could not be measured; the field “reason” tells why.").format(
                missing, len(result)))
        taken = {name.lower() for name in FIELDS}
        carried = {name: [values[item.feature] for item in result] for name, values in table.columns.items()
                if name.lower() not in taken}
        columns = {**carried, **{name: [getattr(item, name) for item in result] for name in FIELDS}}
        layer = self.write_layer(parameters, "OUTPUT", context, make_fields(*FIELDS, base=table.fields), columns,
                                 cloud.crs_wkt, [item.geometry for item in result], geometry_type(outlines), "",
                                 progress.part(0.95, 1.0))
        sigmas = [item.sigma for item in result if item.geometry is not None]
        return {**layer, "OBJECTS": len(result), "MEASURED": len(result) - missing,
                "SIGMA": float(np.median(sigmas)) if sigmas else None}
