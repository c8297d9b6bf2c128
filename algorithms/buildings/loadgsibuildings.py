"""Building outlines of the Geospatial Information Authority of Japan as a layer of footprints."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsCoordinateReferenceSystem

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import wkt_of
from ..framework.layers.layers import make_fields

# The data's own "fid" cannot keep its name: that is the key of every GeoPackage table.
FIELDS = {"gml_id": "gml_id", "gsi_fid": "fid", "type": "type", "name": "name", "lfSpanFr": "lfSpanFr",
          "lfSpanTo": "lfSpanTo", "devDate": "devDate", "orgGILvl": "orgGILvl", "orgMDId": "orgMDId",
          "source": "source"}


class LoadGsiBuildings(UrbanMapAlgorithm):
    """FG-GML files to footprints in the zone of the Japan Plane Rectangular CS that fits."""

    ID = "loadgsibuildings"
    NAME = "Load GSI buildings"
    HELP = (
        "Loads building outlines of the Fundamental Geospatial Data of the Geospatial Information Authority of Japan "
        "(GSI) as footprints for the other steps.\n"
        "Areas (BldA) and outlines (BldL) are read from the files as downloaded: .xml, .zip, or a folder of them. "
        "Outlines become polygons where they close; a building that several map sheets hold, or that is "
        "there both as an area and as an outline, comes once. What is left out or changed is told in the log."
    )
    SOURCE = "Javanmardi, 5.3.1"
    KEYWORDS = ("GSI", "FGD", "GML", "JPGIS", "footprints", "基盤地図情報", "建築物", "国土地理院")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")

    def declare(self):
        self.add_file(
            "INPUT", "File of building outlines",
            "FG-GML-...-BldA or -BldL .xml, or a .zip as downloaded (zips inside are opened too). The path of a "
            "folder can be typed here as well.",
            filter="GSI building outlines (*.xml *.XML *.zip *.ZIP);;All files (*)", optional=True)
        self.add_file(
            "INPUT_FOLDER", "Folder of building outlines",
            "All .xml and .zip files in this folder and its subfolders; instead of the file or beside it.",
            folder=True, optional=True)
        self.add_crs(
            "CRS", "Coordinate reference system",
            "Of the result. If none is chosen, the zone of the Japan Plane Rectangular CS (JGD2011, EPSG:6669 to "
            "6687) in which most buildings lie; close to the border of a prefecture, check it.",
            optional=True)
        self.add_layer_output(
            "OUTPUT", "Footprints",
            "Polygons with building_id (1, 2, 3, ... in the order of the files), the GSI's attributes as "
            "text (its fid as gsi_fid) and the file's name as source.")
        self.add_number_output("BUILDINGS", "Number of buildings", "Number of footprints written.")
        self.add_text_output("CRS_NAME", "Name of the coordinate reference system",
                             "Coordinate reference system of the result, such as EPSG:6677.")

    def check(self, parameters, context):
        if not self._paths(parameters, context):
            raise InputError(tr("No file was given: choose building outlines of the GSI (.xml, .zip) or a folder."))
        if parameters.get("CRS") and not self.parameterAsCrs(parameters, "CRS", context).isValid():
            raise InputError(tr("{0}: {1} is not known; choose another.").format(
                self.label_of("CRS"), parameters["CRS"]))

    def compute(self, parameters, context, feedback):
        from ...urbanmap_qgis.io.official.gsi import read_gsi_buildings, reproject

        progress = self.progress(feedback)
        buildings = read_gsi_buildings(self._paths(parameters, context), progress.part(0.0, 0.8))
        crs = self.parameterAsCrs(parameters, "CRS", context)
        buildings = reproject(buildings, wkt_of(crs) or None, progress)
        if not crs.isValid():
            crs = QgsCoordinateReferenceSystem(":".join(buildings.crs.to_authority()))
        progress.message(tr("{0} buildings, {1}").format(len(buildings), crs.userFriendlyIdentifier()))
        columns = {field: buildings.attributes[name] for field, name in FIELDS.items()}
        columns["building_id"] = list(range(1, len(buildings) + 1))
        fields = make_fields("building_id", *((field, "text") for field in FIELDS))
        place = self.write_layer(parameters, "OUTPUT", context, fields, columns, crs, buildings.geometries,
                                 "Polygon", "gsi_buildings", progress.part(0.8, 1.0))
        return {"OUTPUT": place, "BUILDINGS": len(buildings), "CRS_NAME": crs.authid() or crs.description()}

    def _paths(self, parameters, context) -> list[Path]:
        """The file and the folder, as far as they were given."""
        paths = (self.input_path(parameters, name, context) for name in ("INPUT", "INPUT_FOLDER"))
        return [path for path in paths if path is not None]
