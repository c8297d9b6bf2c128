"""What the algorithms that write city models share."""

from __future__ import annotations

from dataclasses import replace

from qgis.core import QgsVectorFileWriter

from ...urbanmap_qgis.errors import OutputError
from ..framework.declaring.destinations import sink_file
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import stated_wkt

IUR_VERSIONS = ("3.2", "3.1", "2.0")
MAP_LEVELS = ("none", "500", "1000", "2500", "5000")


def add_plateau_parameters(algorithm):
    """What PLATEAU asks for beside the models."""
    algorithm.add_text("CITY_CODE", "Municipality's code",
                       "Five digits, such as 13101: CityGML then has the buildings' ids as PLATEAU asks for them.",
                       advanced=True)
    algorithm.add_choice("IUR_VERSION", "i-UR version", "Version of PLATEAU's extension of CityGML: 3.2 of the "
                         "specification in force, 3.1 or 2.0.", IUR_VERSIONS, IUR_VERSIONS[0], advanced=True)
    algorithm.add_choice("MAP_LEVEL", "Map level of the public survey", "Level of the public survey that the laser "
                         "points are of, for CityGML's quality attributes; none where they are of no public survey.",
                         MAP_LEVELS, MAP_LEVELS[0], advanced=True)
    algorithm.add_file("SCHEMAS", "Schemas of i-UR", "Folder with uro/3.2/urbanObject.xsd and urf/3.2/urbanFunction.xsd"
                       " (of the version above), as the G-spatial information centre gives them: they go along with "
                       "CityGML into the folder “schemas”.", folder=True, optional=True, advanced=True)


def check_parquet(algorithm, parameters, name, context):
    """Refuse a layer as GeoParquet where GDAL has no driver for it: QGIS would write another format."""
    path = sink_file(parameters, name, context)
    known = [ending.lower() for ending in QgsVectorFileWriter.supportedFormatExtensions()]
    if path is not None and path.suffix.lower() == ".parquet" and "parquet" not in known:
        raise OutputError(tr("{0}: this system's GDAL cannot write GeoParquet; give a name that ends in .gpkg.").format(
            algorithm.label_of(name)))


def write_files(algorithm, parameters, context, names, model, progress):
    """Write a city model to the outputs `names` (CityJSON, CityJSONSeq, CityGML, 3D Tiles); paths by output name."""
    from ...urbanmap_qgis.citymodel.city_files import write_city_files

    paths = {name: algorithm.output_path(parameters, name, context) for name in names}
    write_city_files(model, *paths.values(), algorithm.geoid(parameters, context),
                     _delivery(algorithm, parameters, context), progress)
    return {name: str(path) for name, path in paths.items() if path}


def whole_model(algorithm, parameters, context, stack, progress):
    """All of CITY_MODEL in memory, its images until `stack` is closed; what its reader met is told."""
    from ...urbanmap_qgis.citymodel.city_sources import open_city_model
    from ...urbanmap_qgis.citymodel.citygml.reader import STREET_SPACE_MODULES
    from ...urbanmap_qgis.citymodel.reading_notes import ReadingNotes

    notes = ReadingNotes()
    model = open_city_model(algorithm.input_path(parameters, "CITY_MODEL", context), stack, notes,
                            given_source(algorithm, parameters, context), progress, STREET_SPACE_MODULES, fittings=True)
    model = replace(model, buildings=list(model.buildings))
    for sentence in notes.sentences():
        progress.warn(sentence)
    return model


def given_source(algorithm, parameters, context):
    """The reference of files that name none or an unknown one, for the core; None where it was not given."""
    from ...urbanmap_qgis.citymodel.named_reference import given_reference

    crs = algorithm.parameterAsCrs(parameters, "SOURCE_CRS", context)
    return given_reference(stated_wkt(crs)) if crs.isValid() else None


def _delivery(algorithm, parameters, context):
    """What CityGML says of all its buildings."""
    from ...urbanmap_qgis.citymodel.citygml.plateau import PlateauDelivery

    level = algorithm.parameterAsString(parameters, "MAP_LEVEL", context)
    return PlateauDelivery(algorithm.parameterAsString(parameters, "IUR_VERSION", context),
                           algorithm.parameterAsString(parameters, "CITY_CODE", context) or "",
                           not parameters.get("CITY_MODEL"), int(level) if level.isdigit() else 0,
                           algorithm.day_of(parameters, "DATA_DATE", context) if "DATA_DATE" in parameters else "",
                           algorithm.input_path(parameters, "SCHEMAS", context))
