"""The layers of road markings found in an orthophoto."""

from __future__ import annotations

from ..framework.declaring.parameters import tr


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
    columns = {name: getattr(found, name)
               for name in ("area", "length", "width", "contrast", "colour", "confidence")}
    return algorithm.write_layer(parameters, "OUTPUT_POLYGONS", context, None, columns, crs, geometries, kind,
                            style="road_markings", progress=progress.part(0.9, 1.0))


def write_doubtful(algorithm, parameters, context, search, settings, crs):
    """The layer of what `search` (settings, path of a mask) finds below the least confidence; where wanted."""
    if not parameters.get("OUTPUT_DOUBTFUL") or settings.cleaning is None:
        return {}
    import tempfile

    from ...urbanmap_qgis.aerial.markings.marking_polygons import most_in_doubt

    names = ("confidence", "length", "width", "colour")
    with tempfile.TemporaryDirectory(prefix="urbanmap-") as folder:
        found = search(settings.doubtful, f"{folder}/doubtful.tif").polygons
        order = most_in_doubt(found.confidence, found.area)
        columns = {"paint": [None] * len(order), **{name: getattr(found, name)[order] for name in names}}
        return algorithm.write_layer(parameters, "OUTPUT_DOUBTFUL", context, None, columns, crs,
                                     [found.polygons[int(number)] for number in order], "Polygon",
                                     style="doubtful_markings")
