"""Where outputs go: found out once for each run, checked against its inputs, written beside and moved together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from qgis.core import (
    QgsDataSourceUri,
    QgsProcessing,
    QgsProcessingContext,
    QgsProcessingFeatureSourceDefinition,
    QgsProcessingOutputLayerDefinition,
    QgsProcessingUtils,
    QgsProperty,
    QgsProviderRegistry,
)

from ....urbanmap_qgis.errors import InputError, OutputError
from ....urbanmap_qgis.io.files.staging import Staging, final_text, identities, refuse_unless_replaceable
from .parameters import SOLIDS, tr

FILES = ("fileDestination", "rasterDestination", "vectorDestination", "folderDestination")
LAYERS = ("source", "vector", "raster", "layer", "pointcloud", "mesh")
IMAGES = (".tif", ".tiff", ".jpg", ".jpeg", ".png")
WITHOUT_SOLIDS = (".shp", ".dbf", ".csv", ".xlsx", ".ods", ".tab", ".mif", ".dxf", ".kml", ".kmz", ".gpx")
"""Formats of layers that keep neither faces nor rings that stand upright: polygons in them are areas in plan."""

"""What is read from a folder of images, whatever its name: a result of such an ending there would be read as well."""

_DATABASES = ("memory:", "ogr:", "postgis:", "postgres:", "spatialite:", "mssql:", "oracle:")


def check_destinations(algorithm, parameters: Mapping, context: QgsProcessingContext) -> None:
    """Refuse outputs in the place of an input or of each other, where none can be put, or under a wrong name.

    Raises
    ------
    InputError, OutputError : with both names and what to do.
    """
    _refuse_passing_folders(algorithm, parameters, context)
    taken: list[tuple[str, set[tuple]]] = []
    inputs = list(_input_files(algorithm, parameters, context))
    for name, path, table in _wanted(algorithm, parameters, context):
        label, definition = algorithm.label_of(name), algorithm.parameterDefinition(name)
        known = _with_table(identities(path), table)
        for other, used, its_table in inputs:
            if _meet(known, _with_table(identities(used), its_table)):
                raise InputError(tr("{0} would take the place of {1} ({2}); choose another output.").format(
                    label, other, used))
            if used.is_dir() and path.parent == used and path.suffix.lower() in IMAGES and path.is_file():
                raise InputError(tr("{0}: {1} is one of the images in {2}; choose another output.").format(
                    label, path.name, other))
        for other, used in taken:
            if _meet(known, used):
                raise InputError(tr("{0} and {1} have the same name, {2}; give each its own.").format(
                    other, label, path))
        taken.append((label, known))
        if not table and definition.type() != "folderDestination":
            try:
                refuse_unless_replaceable(path)
            except OutputError as error:
                raise OutputError(f"{label}: {error}") from error
    for name, path, _ in _wanted(algorithm, parameters, context):
        _refuse_other_format(algorithm.parameterDefinition(name), path)


def _refuse_other_format(definition, path: Path) -> None:
    """Refuse a name by which the result could not be held."""
    if (definition.type() == "fileDestination" and definition.defaultFileExtension() == "laz"
            and path.suffix.lower() not in (".las", ".laz")):
        raise InputError(tr("{0}: the name {1} must end in .laz or .las.").format(definition.description(), path.name))
    if definition.metadata().get(SOLIDS) and path.suffix.lower() in WITHOUT_SOLIDS:
        raise InputError(tr("{0}: {1} files do not hold closed bodies, as upright faces are lost in them; choose a "
                            "GeoPackage (.gpkg).").format(definition.description(), path.suffix.lower()))


def _refuse_passing_folders(algorithm, parameters: Mapping, context: QgsProcessingContext) -> None:
    """In the window, the folder of a long run is asked for; scripts that want a temporary one say so."""
    from qgis.utils import iface

    for name in algorithm.LASTING_FOLDERS if iface is not None else ():
        if _is_temporary(_file_text(algorithm, parameters, name, context)):
            raise InputError(tr("{0}: choose a folder; a temporary one is gone when QGIS ends.").format(
                algorithm.label_of(name)))


def staged(algorithm, parameters: Mapping, context: QgsProcessingContext, staging: Staging) -> dict:
    """The parameters of a run in which every output that is a file has a scratch place beside its own.

    Temporary destinations have their names from here on, so that they can be asked for any number of times.
    """
    result = dict(parameters)
    for name, path, table in _wanted(algorithm, parameters, context, temporary=True):
        if table:
            continue
        if name in algorithm.KEPT_FOLDERS:
            result[name] = str(path)
            continue
        definition, place = definition_of(parameters, name), str(staging.scratch_path(path))
        result[name] = place
        if definition is None:
            continue
        if algorithm.parameterDefinition(name).type() == "sink":
            result[name] = _elsewhere(definition, place)
        elif algorithm.parameterDefinition(name).type() == "rasterDestination":
            # So QGIS notes that it is to load the raster, from its place.
            algorithm.parameterAsOutputLayer({name: _elsewhere(definition, final_text(str(path)))}, name, context)
    return result


def folders_of(algorithm, parameters: Mapping, context: QgsProcessingContext) -> list[str]:
    """Folders of the inputs and outputs of a run that are files."""
    inputs = [used for _, used, _ in _input_files(algorithm, parameters, context)]
    outputs = [path for _, path, _ in _wanted(algorithm, parameters, context, temporary=True)]
    return list(dict.fromkeys(str(path.parent) for path in (*inputs, *outputs)))


def _elsewhere(definition: QgsProcessingOutputLayerDefinition, place: str) -> QgsProcessingOutputLayerDefinition:
    moved = QgsProcessingOutputLayerDefinition(definition)
    moved.sink = QgsProperty.fromValue(place)
    return moved


def close_layers(context: QgsProcessingContext, staging: Staging) -> None:
    """Close what steps of a chain opened of results that are about to be moved.

    QGIS would keep the rasters' statistics beside them when it closes them, where they no longer are.
    """
    store = context.temporaryLayerStore()
    for layer in list(store.mapLayers().values()):
        source = layer.source().split("|")[0]
        if staging.outside(source) == source:
            continue
        beside = Path(f"{source}.aux.xml")
        known = beside.exists()
        store.removeMapLayer(layer)
        if not known:
            beside.unlink(missing_ok=True)


def results_outside(results: Mapping, staging: Staging) -> dict:
    """Results with the places where the outputs are now; a number that is not known is none."""
    return {name: staging.outside(value) if isinstance(value, str) else value if value == value else None
            for name, value in results.items()}


def definition_of(parameters: Mapping, name: str) -> QgsProcessingOutputLayerDefinition | None:
    """What a dialog or a model says of an output beside its place, where it does."""
    value = parameters.get(name)
    return value if isinstance(value, QgsProcessingOutputLayerDefinition) else None


def sink_file(parameters: Mapping, name: str, context: QgsProcessingContext) -> Path | None:
    """The file that a layer output is to be written to; None for memory layers, databases and the like."""
    value = sink_text(parameters, name, context)
    if not value or value == QgsProcessing.TEMPORARY_OUTPUT or not Path(value).suffix:
        return None
    if value.startswith(_DATABASES) or "|" in value or "dbname=" in value:
        return None
    return Path(value)


def sink_text(parameters: Mapping, name: str, context: QgsProcessingContext) -> str:
    """The place of a layer output as text, empty where it is not wanted or features are added to a layer."""
    value = parameters.get(name)
    definition = definition_of(parameters, name)
    if definition is not None:
        if hasattr(definition, "useRemapping") and definition.useRemapping():
            return ""
        value, _ = definition.sink.valueAsString(context.expressionContext(), "")
    elif isinstance(value, QgsProperty):
        value, _ = value.valueAsString(context.expressionContext(), "")
    return value if isinstance(value, str) else ""


def _wanted(algorithm, parameters: Mapping, context: QgsProcessingContext,
            temporary: bool = False) -> Iterator[tuple[str, Path, str]]:
    """Name, file and (in a database that is a file) table of each output; temporary files only where asked for."""
    for definition in algorithm.destinationParameterDefinitions():
        name, kind = definition.name(), definition.type()
        if kind == "sink":
            path = sink_file(parameters, name, context)
            place = (path, "") if path else _database_place(sink_text(parameters, name, context))
            if place:
                yield name, *place
        elif kind in FILES:
            text = _file_text(algorithm, parameters, name, context)
            if text and (temporary or not _is_temporary(text)):
                yield name, _own_name(algorithm, definition, Path(text)), ""


def _file_text(algorithm, parameters: Mapping, name: str, context: QgsProcessingContext) -> str:
    """Path of an output that is a file, without QGIS noting that it be loaded."""
    definition = definition_of(parameters, name)
    if definition is not None:
        definition = QgsProcessingOutputLayerDefinition(definition)
        definition.destinationProject = None
        parameters = {**parameters, name: definition}
    if algorithm.parameterDefinition(name).type() == "rasterDestination":
        return algorithm.parameterAsOutputLayer(parameters, name, context)
    return algorithm.parameterAsFileOutput(parameters, name, context)


def _own_name(algorithm, definition, path: Path) -> Path:
    """A temporary report is called after its algorithm: the browser's tabs and QGIS's list of reports show the name."""
    if path.stem == definition.name() and path.suffix == ".html" and _is_temporary(str(path)):
        return path.with_name(f"{algorithm.name()}_{definition.name().lower().removeprefix('output_')}.html")
    return path


def _is_temporary(text: str) -> bool:
    return Path(QgsProcessingUtils.tempFolder()) in Path(text).parents


def _database_place(text: str) -> tuple[Path, str] | None:
    """File and table of a destination such as ogr:dbname='city.gpkg' table="roofs"."""
    if "dbname=" not in text or text.startswith(("postgis:", "postgres:", "mssql:", "oracle:")):
        return None
    uri = QgsDataSourceUri(text.partition(":")[2])
    return (Path(uri.database()), uri.table() or "?") if uri.database() else None


def _input_files(algorithm, parameters: Mapping, context: QgsProcessingContext) -> Iterator[tuple[str, Path, str]]:
    """Label, file and table of each input that is a file or a layer in one."""
    for definition in algorithm.parameterDefinitions():
        name, kind, label = definition.name(), definition.type(), definition.description()
        if parameters.get(name) is None:
            continue
        layers = []
        if kind == "file":
            text = algorithm.parameterAsFile(parameters, name, context)
            if text and Path(text.split("|")[0]).exists():
                yield label, Path(text.split("|")[0]), _table_of(text)
            elif text:
                layers = [QgsProcessingUtils.mapLayerFromString(text, context, False)]
        elif kind == "multilayer" and definition.layerType() == QgsProcessing.SourceType.TypeFile:
            for text in algorithm.parameterAsFileList(parameters, name, context):
                if text:
                    yield label, Path(file_of(text, context)), ""
        elif kind == "multilayer":
            layers = algorithm.parameterAsLayerList(parameters, name, context)
        elif kind in LAYERS:
            # A file is one by its name; loading it as a layer of a wrong kind would make QGIS complain of it.
            text = _source_text(parameters, name, context)
            if text and Path(text.split("|")[0]).is_file():
                yield label, Path(text.split("|")[0]), _table_of(text)
            else:
                layers = [algorithm.parameterAsLayer(parameters, name, context)]
        for layer in filter(None, layers):
            path, table = _layer_file(layer)
            if path:
                yield label, path, table


def _source_text(parameters: Mapping, name: str, context: QgsProcessingContext) -> str:
    """What was given for a layer, as text; empty for a layer object."""
    value = parameters[name]
    value = getattr(value, "source", value) if isinstance(value, QgsProcessingFeatureSourceDefinition) else value
    if isinstance(value, QgsProperty):
        value, _ = value.valueAsString(context.expressionContext(), "")
    return value if isinstance(value, str) else ""


def file_of(text: str, context: QgsProcessingContext) -> str:
    """The file of a layer of the project that is given by its id or name; anything else as it is."""
    if Path(text).suffix and Path(text).exists():
        return text
    project = context.project()
    layer = project and (project.mapLayer(text) or next(iter(project.mapLayersByName(text)), None))
    path, _ = _layer_file(layer) if layer else (None, "")
    return str(path) if path else text


def file_of_layer(layer) -> Path | None:
    """The file that a layer shows; None where it is of a database or in memory."""
    return _layer_file(layer)[0]


def _layer_file(layer) -> tuple[Path | None, str]:
    parts = QgsProviderRegistry.instance().decodeUri(layer.providerType(), layer.source())
    path = parts.get("path")
    if not path or str(path).startswith("/vsi"):
        return None, ""
    return Path(path), parts.get("layerName") or ""


def _table_of(text: str) -> str:
    return text.partition("layername=")[2].split("|")[0]


def _with_table(known: set[tuple], table: str) -> set[tuple]:
    return {(*item, table.lower()) for item in known}


def _meet(first: set[tuple], second: set[tuple]) -> bool:
    """Whether two places are one: the same file, and the same table where both name one."""
    return any(a[:-1] == b[:-1] and (not a[-1] or not b[-1] or a[-1] == b[-1] or "?" in (a[-1], b[-1]))
               for a in first for b in second)
