"""urbanmap:facadetextures."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InsufficientDataError
from ...urbanmap_qgis.settings.lines import TextureSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import column
from .image_sources import add_images, check_images, image_sources

MODEL_FILTER = "glTF binary (*.glb);;Wavefront OBJ (*.obj);;CityJSON (*.city.json *.json)"


class FacadeTextures(UrbanMapAlgorithm):
    ID = "facadetextures"
    NAME = "Facade textures"
    SOURCE = "Zhao and Shibasaki, 2.2 and 4.2"
    KEYWORDS = ("texture", "facade", "line camera", "strip", "image", "glTF", "OBJ", "CityJSON", "appearance")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    HELP = (
        "Gives the facades of building models the images of line cameras, of aerial frames, or of both.\n"
        "Every place of a facade takes the image that shows it in most detail among those from which no other building "
        "hides it and, where laser points are given, no tree or vehicle. Brightness is evened out between images, and "
        "they pass softly into each other. Places that no image shows stay grey; a facade that none shows gets no "
        "texture, and the layer of facades says why.\n"
        "Trajectory, points and building models must fit together: correct the survey first."
    )

    def declare(self):
        add_images(self)
        self.add_vector("BUILDINGS", "Building models", "MultiPolygonZ with all faces of each building, such as those "
                        "of “Building models”; the field building_id names them.", kind="polygon")
        self.add_points("POINTS", "Laser points", "Points of the survey; what stands before a facade hides it.", True)
        self.add_settings(TextureSettings)
        self.add_workers()
        self.add_file_output("OUTPUT", "Textured model", "By its ending: .glb holds its images; .obj and .city.json "
                             "have theirs in a folder beside.", MODEL_FILTER)
        self.add_folder_output("OUTPUT_FOLDER", "Folder of all kinds", "The model as glTF, OBJ and CityJSON with its "
                               "images.", optional=True)
        self.add_layer_output("OUTPUT_FACADES", "Facades", "PolygonZ, one feature a facade: building_id, facade, area "
                              "(m2), azimuth (degrees), seen (share), detail (m, size of the images' pixels), images, "
                              "status, reason.", optional=True, by_default=True)
        self.add_number_output("FACADES", "Facades", "Number of facades.")
        self.add_number_output("TEXTURED", "Textured facades", "Facades with a texture.")
        self.add_number_output("SEEN", "Share seen", "Share of all facades' area that images show, 0 to 1.")

    def check(self, parameters, context):
        from ...urbanmap_qgis.imagery.textures.texture_files import check_model_name

        check_model_name(self.output_path(parameters, "OUTPUT", context))
        check_images(self, parameters, context)

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.imagery.textures.texture_files import write_textured
        from ...urbanmap_qgis.imagery.textures.texture_stage import buildings_of, summary, texture_buildings

        table = self.read_vector(parameters, "BUILDINGS", context, progress)
        self.require_projected("BUILDINGS", table.crs)
        ids = column(table, "building_id") or table.ids.tolist()
        buildings = buildings_of(ids, table.geometries)
        sources = image_sources(self, parameters, context, table.crs_wkt, progress)
        voxels = self._voxels(parameters, context, table, progress.part(0.0, 0.2))
        folder = self.parameterAsString(parameters, "OUTPUT_FOLDER", context) or None
        model = self.output_path(parameters, "OUTPUT", context)
        code = table.crs.authid().removeprefix("EPSG:")
        with self.workers(parameters, context) as executor:
            settings = self.settings(TextureSettings, parameters, context)
            result = texture_buildings(buildings, sources, settings, voxels, executor, progress.part(0.2, 0.9))
            records = write_textured(result, model, folder, epsg=int(code) if code.isdigit() else None,
                                     crs=table.crs.authid(), progress=progress)
        numbers = summary(records)
        if not numbers["textured"]:
            raise InsufficientDataError(tr("None of the {0} facades is seen in an image, so that there is no result: "
                                           "check that building models, trajectory and images are of one place."
                                           ).format(numbers["facades"]))
        if numbers["textured"] < numbers["facades"]:
            progress.warn(tr("{0} of {1} facades have no texture; the field “reason” of the layer of facades tells "
                             "why.").format(numbers["facades"] - numbers["textured"], numbers["facades"]))
        return {"OUTPUT": str(model), "FACADES": numbers["facades"], "TEXTURED": numbers["textured"],
                "SEEN": numbers["seen"], **({"OUTPUT_FOLDER": folder} if folder else {}),
                **self._write_facades(parameters, context, records, table, progress)}

    def _voxels(self, parameters, context, table, progress):
        """Cells with laser points round the buildings."""
        from ...urbanmap_qgis.imagery.views.obstacles import NO_POINTS, voxels_from_cloud

        paths = self.point_files(parameters, "POINTS", context)
        if not paths:
            return NO_POINTS
        from ...urbanmap_qgis.io.points.pointcloud import open_cloud

        cloud = open_cloud(paths, table.crs_wkt)
        self.same_crs("POINTS", cloud.crs_wkt, "BUILDINGS", table.crs)
        return voxels_from_cloud(cloud, progress)

    def _write_facades(self, parameters, context, records, table, progress):
        """The layer of facades, where wanted."""
        names = ("facade", "area", "azimuth", "seen", "detail", "images", "status", "reason")
        values = {name: [getattr(record, name) for record in records] for name in names}
        ids = [record.building for record in records]
        kind = "int" if all(isinstance(value, int) for value in ids) else "text"
        values["building_id"] = ids if kind == "int" else [str(value) for value in ids]
        fields = make_fields(("building_id", kind), ("facade", "int"), *names[1:], style="facades")
        return self.write_layer(parameters, "OUTPUT_FACADES", context, fields, values, table.crs,
                                [record.polygon for record in records], "PolygonZ", "facades", progress)
