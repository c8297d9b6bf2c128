"""Results that are files, in QGIS's window: layers of the project where this QGIS can, otherwise a sentence."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from qgis.core import (
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingUtils,
    QgsProviderRegistry,
)
from qgis.PyQt.QtCore import QThread

from ....urbanmap_qgis.io.files.staging import final_text
from ..declaring.parameters import tr
from .styles import give_saved_style, give_style, read_anew

POINT_CLOUDS = (".las", ".laz")


def has_window() -> bool:
    """Whether this is QGIS's desktop."""
    from qgis.utils import iface

    return iface is not None


def shown_after(feedback: QgsProcessingFeedback) -> bool:
    """Whether a window shows what this run makes: the run was started there, and is no step of a chain or model."""
    return has_window() and not feedback.metaObject().className().endswith(("MultiStepFeedback", "ModelFeedback"))


def show_layer(context: QgsProcessingContext, path: Path, title: str, style: str = "") -> None:
    """Let QGIS load a file when the run has ended, drawn as the style of the plugin or the file's own says."""
    if context.project() is None or not path.is_file():
        return
    hint = {".gpkg": "Vector", ".tif": "Raster"}.get(path.suffix.lower(), "PointCloud")
    details = QgsProcessingContext.LayerDetails(title, context.project(), "",
                                                getattr(QgsProcessingUtils.LayerHint, hint))
    details.forceName = True  # else QGIS calls a layer after its file
    place = final_text(str(path))
    context.addLayerToLoadOnCompletion(place, details)
    if style:
        give_style(context, place, style)
    elif path.suffix.lower() == ".gpkg":
        give_saved_style(context, path)


def let_go(context: QgsProcessingContext) -> None:
    """Close databases for writing that QGIS holds open for layers whose edits were dropped: no run could replace them.

    Nothing where this is not the window's thread, in which the project's layers live.
    """
    if context.project() is None or QThread.currentThread() != context.project().thread():
        return
    for layer in context.project().mapLayers().values():
        held = Path(f"{layer.source().partition('|')[0]}-wal")
        if layer.providerType() == "ogr" and not layer.isEditable() and held.is_file():
            layer.dataProvider().reloadData()


def name_layers(algorithm, results: Mapping, context: QgsProcessingContext) -> None:
    """Let layers that QGIS loads show what is new, under their outputs' names: QGIS 3.22 says “OUTPUT” in models."""
    for definition in algorithm.destinationParameterDefinitions():
        place = results.get(definition.name())
        if not isinstance(place, str) or not context.willLoadLayerOnCompletion(place):
            continue
        read_anew(context, place)
        details = context.layerToLoadOnCompletionDetails(place)
        if details.name == definition.name():
            details.name = definition.description()


def can_show_points(path: Path) -> bool:
    """Whether this QGIS has a reader of such point clouds; builds of Debian have none."""
    readers = QgsProviderRegistry.instance().providerList()
    return "pdal" in readers or ("copc" in readers and path.name.lower().endswith(".copc.laz"))


def show_files(algorithm, results: Mapping, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> None:
    """Load the point clouds among the results, and say what is not loaded and what will not stay."""
    if not shown_after(feedback):
        return
    passing = []
    for definition in algorithm.destinationParameterDefinitions():
        value = results.get(definition.name())
        if definition.type() not in ("fileDestination", "folderDestination") or not isinstance(value, str):
            continue
        path = Path(value)
        if is_temporary(path):
            passing.append(f"{definition.description()} ({path})")
        if path.suffix.lower() not in POINT_CLOUDS:
            continue
        if can_show_points(path):
            show_layer(context, path, definition.description())
        else:
            feedback.pushInfo(tr("{0}: this QGIS cannot show point clouds, so no layer is loaded; the file is {1}.")
                              .format(definition.description(), path))
    _offer_reports(algorithm, results)
    if passing:
        feedback.pushWarning(tr("In a temporary folder, gone when QGIS ends: {0}. Give these outputs a name to keep "
                                "them.").format(", ".join(passing)))


def _offer_reports(algorithm, results: Mapping) -> None:
    """Let the window offer the reports among the results, in the order declared."""
    from ..report_links import ReportLinks

    for definition in algorithm.outputDefinitions():
        value = results.get(definition.name())
        if definition.type() == "outputHtml" and isinstance(value, str) and ReportLinks.current is not None:
            ReportLinks.current.made.emit(definition.description(), value)


def is_temporary(path: Path) -> bool:
    """Whether a file lies where QGIS deletes it when it ends."""
    return Path(QgsProcessingUtils.tempFolder()) in path.parents
