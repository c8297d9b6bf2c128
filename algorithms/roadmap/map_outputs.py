"""Layers and files of a lane map."""

from __future__ import annotations

DATUMS = ("not stated", "WGS84", "EGM2008")


def write_map_layers(stage, parameters, context, built, crs, ids=()) -> dict[str, str | None]:
    """Write lanes, centre lines, bounds and findings as layers; their places by output."""
    import shapely

    from ...urbanmap_qgis.roadmap.map_tables import bound_columns, lane_columns

    high = built.has_heights()
    suffix = "Z" if high else ""
    columns = lane_columns(built)
    results = stage.write_layer(
        parameters, "OUTPUT_LANES", context, None, columns, crs,
        [built.area(number) for number in range(len(built.lanes))], "Polygon", style="lanes")
    shown = ("lane_id", "kind", "width")
    results |= stage.write_layer(
        parameters, "OUTPUT_CENTRES", context, None, {name: columns[name] for name in shown}, crs,
        [shapely.linestrings(lane.centre if high else lane.centre[:, :2]) for lane in built.lanes],
        f"LineString{suffix}", style="lane_centres")
    results |= stage.write_layer(
        parameters, "OUTPUT_BOUNDS", context, None, bound_columns(built, ids), crs,
        [shapely.linestrings(built.bound_points(bound)[:, :3 if high else 2]) for bound in built.bounds],
        f"LineString{suffix}", style="lane_bounds")
    results |= stage.write_layer(
        parameters, "OUTPUT_FINDINGS", context, None,
        {name: [getattr(one, name) for one in built.findings] for name in ("kind", "text")}, crs,
        [shapely.points(one.x, one.y) for one in built.findings], "Point", style="map_findings")
    return results


def write_map_files(stage, parameters, context, built, crs_wkt, speed_limit, progress) -> dict[str, str | None]:
    """Write the files for other programs that are wanted: Lanelet2 with its projector, OpenDRIVE."""
    from ...urbanmap_qgis.io.osm import write_osm
    from ...urbanmap_qgis.roadmap.formats.lanelet_map import META, lanelet_elements
    from ...urbanmap_qgis.roadmap.formats.map_projection import write_projector
    from ...urbanmap_qgis.roadmap.formats.opendrive_map import opendrive_tree, write_opendrive

    names = ("OUTPUT_LANELET2", "OUTPUT_PROJECTOR", "OUTPUT_OPENDRIVE")
    places = {name: stage.output_path(parameters, name, context) for name in names}
    if not built.lanes or not any(places.values()):
        return {}
    if places["OUTPUT_LANELET2"] or places["OUTPUT_PROJECTOR"]:
        projector, dialect = (stage.parameterAsString(parameters, name, context) for name in ("PROJECTOR", "DIALECT"))
        elements, coordinates = lanelet_elements(built, crs_wkt, projector, speed_limit, dialect)
        if places["OUTPUT_LANELET2"]:
            write_osm(places["OUTPUT_LANELET2"], elements, META)
        if places["OUTPUT_PROJECTOR"]:
            datum = stage.parameterAsString(parameters, "VERTICAL_DATUM", context)
            write_projector(places["OUTPUT_PROJECTOR"], coordinates, "" if datum == DATUMS[0] else datum)
    if places["OUTPUT_OPENDRIVE"]:
        tree, notes = opendrive_tree(built, crs_wkt, speed_limit)
        for note in notes:
            progress.warn(note)
        write_opendrive(places["OUTPUT_OPENDRIVE"], tree)
    return {name: place and str(place) for name, place in places.items()}
