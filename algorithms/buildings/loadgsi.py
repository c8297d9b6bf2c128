"""urbanmap:loadgsi."""

from __future__ import annotations

from qgis.core import QgsCoordinateReferenceSystem

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import wkt_of

# The data's own "fid" cannot keep its name: that is the key of every GeoPackage table.
FIELDS = {"gml_id": "gml_id", "gsi_fid": "fid", "type": "type", "name": "name", "lfSpanFr": "lfSpanFr",
          "lfSpanTo": "lfSpanTo", "devDate": "devDate", "orgGILvl": "orgGILvl", "orgMDId": "orgMDId",
          "source": "source"}


class LoadGsi(UrbanMapAlgorithm):
    """FG-GML files to footprints and a raster of the ground, in the fitting zone of the Japan Plane Rectangular CS."""

    ID = "loadgsi"
    NAME = "Load GSI data"
    HELP = (
        "Loads building outlines and elevation models of the Fundamental Geospatial Data of the Geospatial Information "
        "Authority of Japan (GSI) as footprints and as a raster of the ground for the other steps.\n"
        "Outlines (BldA, BldL) and DEM1A, 5A, 5B, 5C, 10A and 10B are read as downloaded: .xml, .zip (zips in it too), "
        "or a folder of them. Outlines become polygons where they close; a building that several map sheets hold, or "
        "that is there both as an area and as an outline, comes once. The newest file of a mesh is taken; where finer "
        "products have no height, coarser ones fill in. The raster states its height system (JGD2000, JGD2011 or "
        "JGD2024). What is left out or changed is told in the log."
    )
    SOURCE = "Javanmardi, 5.3.1; GSI, product specification of the Fundamental Geospatial Data"
    KEYWORDS = ("GSI", "FGD", "GML", "JPGIS", "footprints", "DEM", "ground", "elevation", "基盤地図情報", "建築物",
                "数値標高モデル", "国土地理院")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio")

    def declare(self):
        self.add_file(
            "INPUT", "File of the GSI",
            "FG-GML-...-BldA, -BldL or -DEM5A-... .xml (or another product), or a .zip as downloaded (zips inside are "
            "opened too). The path of a folder can be typed here as well.",
            filter="GSI data (*.xml *.XML *.zip *.ZIP);;All files (*)", optional=True)
        self.add_file(
            "INPUT_FOLDER", "Folder of GSI data",
            "All .xml and .zip files in this folder and its subfolders; instead of the file or beside it.",
            folder=True, optional=True)
        self.add_crs(
            "CRS", "Coordinate reference system",
            "Of the results. If none is chosen, the zone of the Japan Plane Rectangular CS (JGD2011, EPSG:6669 to "
            "6687) in which most of it lies; close to the border of a prefecture, check it. In degrees (EPSG:6668) the "
            "cells of the raster stay as they are in the files.", optional=True)
        self.add_number(
            "RESOLUTION", "Cell size", "Side of a cell in units of the coordinate reference system; if none is given, "
            "that of the finest product: 1, 5 or 10 m, or its fraction of a second.", minimum=0.0, optional=True)
        self.add_layer_output(
            "OUTPUT_BUILDINGS", "Footprints",
            "Polygons with building_id (1, 2, 3, ... in the order of the files), the GSI's attributes as "
            "text (its fid as gsi_fid) and the file's name as source.", optional=True, by_default=True)
        self.add_raster_output("OUTPUT_GROUND", "Ground elevation",
                               "GeoTIFF of heights in metres; cells without height are no data.", optional=True,
                               by_default=True)
        self.add_number_output("BUILDINGS", "Number of buildings", "Number of footprints written.")
        self.add_text_output("CRS_NAME", "Name of the coordinate reference system",
                             "Coordinate reference system of the footprints, such as EPSG:6677.")
        self.add_number_output("MESHES", "Number of meshes", "Number of files that the raster was made of.")
        self.add_number_output("EMPTY", "Share of empty cells", "Cells without height (sea, or no mesh), 0 to 1.")
        self.add_text_output("HEIGHTS", "Height system", "JGD2000, JGD2011 or JGD2024, as the files say.")

    def check(self, parameters, context):
        if not self.input_paths(parameters, context):
            raise InputError(tr("No file was given: choose building outlines or elevation models of the GSI (.xml, "
                                ".zip) or a folder."))
        if parameters.get("CRS") and not self.parameterAsCrs(parameters, "CRS", context).isValid():
            raise InputError(tr("{0}: {1} is not known; choose another.").format(
                self.label_of("CRS"), parameters["CRS"]))

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.io.official.gsi_dem import DEMS
        from ...urbanmap_qgis.io.official.gsi_sources import BUILDINGS, may_hold

        paths, results = self.input_paths(parameters, context), {}
        kinds = {"OUTPUT_BUILDINGS": (BUILDINGS, self._load_buildings), "OUTPUT_GROUND": (DEMS, self._load_ground)}
        wanted = [name for name in kinds if parameters.get(name)]
        if len(wanted) > 1:
            there = [name for name in wanted if may_hold(paths, kinds[name][0])]
            wanted = there or wanted[:1]  # with neither, the reader's own sentence tells what is wrong
        for number, name in enumerate(wanted):
            part = progress.part(number / len(wanted), (number + 1) / len(wanted))
            results |= kinds[name][1](parameters, context, paths, part)
        return results

    def _load_buildings(self, parameters, context, paths, progress):
        from ...urbanmap_qgis.io.official.gsi import read_gsi_buildings, reproject

        buildings = read_gsi_buildings(paths, progress.part(0.0, 0.8))
        crs = self.parameterAsCrs(parameters, "CRS", context)
        buildings = reproject(buildings, wkt_of(crs) or None, progress)
        if not crs.isValid():
            crs = QgsCoordinateReferenceSystem(":".join(buildings.crs.to_authority()))
        progress.message(tr("{0} buildings, {1}").format(len(buildings), crs.userFriendlyIdentifier()))
        columns = {"building_id": list(range(1, len(buildings) + 1)),
                   **{field: buildings.attributes[name] for field, name in FIELDS.items()}}
        place = self.write_layer(parameters, "OUTPUT_BUILDINGS", context, None, columns, crs, buildings.geometries,
                                 "Polygon", "gsi_buildings", progress.part(0.8, 1.0))
        return {**place, "BUILDINGS": len(buildings), "CRS_NAME": crs.authid() or crs.description()}

    def _load_ground(self, parameters, context, paths, progress):
        from ...urbanmap_qgis.io.conversion.reprojection import epsg_wkt, plane_transform
        from ...urbanmap_qgis.io.official.gsi_dem import read_gsi_dem
        from ...urbanmap_qgis.io.official.gsi_dem_raster import dem_bounds, dem_epsg, dem_zone, write_dem

        meshes = read_gsi_dem(paths, progress.part(0.0, 0.6))
        source = epsg_wkt(dem_epsg(meshes.system))
        crs = self.parameterAsCrs(parameters, "CRS", context)
        target = wkt_of(crs) if crs.isValid() else epsg_wkt(dem_zone(meshes))
        transform = plane_transform(source, target, dem_bounds(meshes))
        if transform is not None and transform.description:
            progress.warn(tr("The elevation model was taken into {0} by {1}.").format(
                crs.userFriendlyIdentifier(), transform.description))
        place = self.output_layer_path(parameters, "OUTPUT_GROUND", context, style="ground")
        resolution = self.parameterAsDouble(parameters, "RESOLUTION", context) or None
        result = write_dem(place, meshes, target, transform, resolution, progress.part(0.6, 1.0))
        progress.message(tr("{0} meshes ({1}), heights in {2}, {3:.1f} to {4:.1f} m, {5:.1f} % of the cells "
                            "empty").format(
            len(meshes.meshes), ", ".join(result.products), result.system, result.lowest, result.highest,
            100 * result.empty))
        return {"OUTPUT_GROUND": str(place), "MESHES": len(meshes.meshes), "EMPTY": result.empty,
                "HEIGHTS": result.system}
