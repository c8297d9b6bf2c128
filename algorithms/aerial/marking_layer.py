"""The layers of road markings found in an orthophoto."""

from __future__ import annotations

from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields


def write_markings(algorithm, parameters, context, found, crs, progress):
    """The polygons' layer, with heights where a ground raster was given."""
    from ...urbanmap_qgis.aerial.markings.marking_polygons import with_heights
    from ...urbanmap_qgis.io.raster import RasterSampler

    geometries, kind = found.polygons, "Polygon"
    ground = algorithm.raster_path(parameters, "GROUND", context)
    if ground is not None:
        with RasterSampler(ground) as heights:
            geometries, without = with_heights(geometries, heights)
        kind = "PolygonZ"
        if without:
            progress.warn(tr("{0} has no height at {1} of {2} markings: they lie outside of it or in its gaps, and "
                             "have no height there.").format(algorithm.label_of("GROUND"), without, len(found)))
    fields = make_fields("area", "length", "width", "contrast", "colour", "confidence")
    columns = {name: getattr(found, name)
               for name in ("area", "length", "width", "contrast", "colour", "confidence")}
    return algorithm.write_layer(parameters, "OUTPUT_POLYGONS", context, fields, columns, crs, geometries, kind,
                            style="road_markings", progress=progress.part(0.9, 1.0))


def write_doubtful(algorithm, parameters, context, found, crs):
    """The layer of markings that are worth a look, the most area in doubt first; None where it is not wanted."""
    if not parameters.get("OUTPUT_DOUBTFUL"):
        return None
    import numpy as np

    from ...urbanmap_qgis.aerial.markings.marking_polygons import doubtful_markings

    chosen = doubtful_markings(found.confidence, found.area)
    names = ("confidence", "length", "width", "colour")
    fields = make_fields("paint", *((name, "text" if name == "colour" else "real") for name in names))
    return algorithm.write_layer(parameters, "OUTPUT_DOUBTFUL", context, fields,
                                 {"paint": [None] * len(chosen), **{name: getattr(found, name)[chosen]
                                                                    for name in names}}, crs,
                                 np.array([found.polygons[int(number)] for number in chosen], object), "Polygon",
                                 style="doubtful_markings")
