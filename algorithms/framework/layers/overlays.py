"""Edges before and after a correction over images, in the reports of the stages that correct."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from qgis.core import QgsProcessingContext

from ..declaring.parameters import tr

PICTURES = 6


def add_orthophoto(algorithm) -> None:
    """Declare ORTHOPHOTO, the image behind the report's pictures before and after."""
    algorithm.add_raster("ORTHOPHOTO", "Orthophoto for the report", "The report shows edges before and after over it; "
                         "it changes nothing else.", optional=True)


def orthophoto_pictures(algorithm, parameters: Mapping, context: QgsProcessingContext, crs, name: str,
                        before: Sequence, after: Sequence) -> Callable:
    """Function that adds models before and after over ORTHOPHOTO to a report; it adds nothing where none was given.

    crs : of the models, those of the parameter `name`.
    """
    path = algorithm.raster_path(parameters, "ORTHOPHOTO", context)
    if path is None:
        return lambda report: None
    from ....urbanmap_qgis.imagery.views.orthophoto_source import orthophoto_source

    source = orthophoto_source(path)
    algorithm.same_crs("ORTHOPHOTO", source.crs_wkt, name, crs)
    return pictures([source], [source], before, after)


def pictures(sources_before: Sequence, sources_after: Sequence, before: Sequence, after: Sequence,
             max_range: float = 60.0) -> Callable:
    """Function that adds geometries with heights over images, before and after, to a report."""
    from ....urbanmap_qgis.imagery.overlays.overlay_stage import add_overlays, edge_state

    def add(report) -> None:
        states = [edge_state(tr("before"), sources_before, before), edge_state(tr("after"), sources_after, after)]
        add_overlays(report, states, max_range, PICTURES)

    return add
