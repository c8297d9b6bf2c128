"""Elevation models of the Geospatial Information Authority of Japan as a raster of the ground."""

from __future__ import annotations

from pathlib import Path

from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import wkt_of


class LoadGsiDem(UrbanMapAlgorithm):
    """FG-GML DEM files to one GeoTIFF."""

    ID = "loadgsidem"
    NAME = "Load GSI elevation model"
    HELP = (
        "Loads elevation models of the Fundamental Geospatial Data of the Geospatial Information Authority of Japan "
        "(GSI) as a raster of the ground for the other steps.\n"
        "DEM1A, 5A, 5B, 5C, 10A and 10B are read as downloaded: .xml, .zip (zips in it too), or a folder of them. The "
        "newest file of a mesh is taken; where finer products have no height, coarser ones fill in. The raster states "
        "its height system (JGD2000, JGD2011 or JGD2024)."
    )
    SOURCE = "GSI, product specification of the Fundamental Geospatial Data (digital elevation model)"
    KEYWORDS = ("GSI", "FGD", "DEM", "GML", "JPGIS", "ground", "elevation", "基盤地図情報",
                "数値標高モデル", "国土地理院")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio")

    def declare(self):
        self.add_file(
            "INPUT", "File of an elevation model",
            "FG-GML-...-DEM5A-... .xml (or 1A, 5B, 5C, 10A, 10B), or a .zip as downloaded (zips inside are opened "
            "too). The path of a folder can be typed here as well.",
            filter="GSI elevation models (*.xml *.XML *.zip *.ZIP);;All files (*)", optional=True)
        self.add_file(
            "INPUT_FOLDER", "Folder of elevation models",
            "All .xml and .zip files in this folder and its subfolders; instead of the file or beside it.",
            folder=True, optional=True)
        self.add_crs(
            "CRS", "Coordinate reference system",
            "Of the raster. If none is chosen, the zone of the Japan Plane Rectangular CS in which most meshes lie. In "
            "degrees (EPSG:6668) the cells stay as they are in the files.", optional=True)
        self.add_number(
            "RESOLUTION", "Cell size", "Side of a cell in units of the coordinate reference system; if none is given, "
            "that of the finest product: 1, 5 or 10 m, or its fraction of a second.", minimum=0.0, optional=True)
        self.add_raster_output("OUTPUT", "Ground elevation",
                               "GeoTIFF of heights in metres; cells without height are no data.")
        self.add_number_output("MESHES", "Number of meshes", "Number of files that the raster was made of.")
        self.add_number_output("EMPTY", "Share of empty cells", "Cells without height (sea, or no mesh), 0 to 1.")
        self.add_text_output("HEIGHTS", "Height system", "JGD2000, JGD2011 or JGD2024, as the files say.")

    def check(self, parameters, context):
        from ...urbanmap_qgis.errors import InputError

        if not self._paths(parameters, context):
            raise InputError(tr("No file was given: choose elevation models of the GSI (.xml, .zip) or a folder."))
        if parameters.get("CRS") and not self.parameterAsCrs(parameters, "CRS", context).isValid():
            raise InputError(tr("{0}: {1} is not known; choose another.").format(
                self.label_of("CRS"), parameters["CRS"]))

    def compute(self, parameters, context, feedback):
        from ...urbanmap_qgis.io.conversion.reprojection import epsg_wkt, plane_transform
        from ...urbanmap_qgis.io.official.gsi_dem import read_gsi_dem
        from ...urbanmap_qgis.io.official.gsi_dem_raster import dem_bounds, dem_epsg, dem_zone, write_dem

        progress = self.progress(feedback)
        meshes = read_gsi_dem(self._paths(parameters, context), progress.part(0.0, 0.6))
        source = epsg_wkt(dem_epsg(meshes.system))
        crs = self.parameterAsCrs(parameters, "CRS", context)
        target = wkt_of(crs) if crs.isValid() else epsg_wkt(dem_zone(meshes))
        transform = plane_transform(source, target, dem_bounds(meshes))
        if transform is not None and transform.description:
            progress.warn(tr("The elevation model was taken into {0} by {1}.").format(
                crs.userFriendlyIdentifier(), transform.description))
        place = self.output_layer_path(parameters, "OUTPUT", context, style="ground")
        resolution = self.parameterAsDouble(parameters, "RESOLUTION", context) or None
        result = write_dem(place, meshes, target, transform, resolution, progress.part(0.6, 1.0))
        progress.message(tr("{0} meshes ({1}), heights in {2}, {3:.1f} to {4:.1f} m, {5:.1f} % of the cells "
                            "empty").format(
            len(meshes.meshes), ", ".join(result.products), result.system, result.lowest, result.highest,
            100 * result.empty))
        return {"OUTPUT": str(place), "MESHES": len(meshes.meshes), "EMPTY": result.empty, "HEIGHTS": result.system}

    def _paths(self, parameters, context) -> list[Path]:
        """The file and the folder, as far as they were given."""
        paths = (self.input_path(parameters, name, context) for name in ("INPUT", "INPUT_FOLDER"))
        return [path for path in paths if path is not None]
