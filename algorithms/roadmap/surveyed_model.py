"""The part of `roadmodel` that works from a survey: its inputs, layers and messages."""

from __future__ import annotations

from collections import Counter

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..framework.running.chain import is_rest_kept

AREA_FIELDS = ("area_id", "road_id", "kind", "function", "width", "area", ("source", "text"), "seen", ("step", "real"),
               "sigma")


def read_survey_roads(algorithm, parameters, context, progress):
    """Edges and what goes with them, the CRS of the edges, and the opened raster of the ground or None."""
    from ...urbanmap_qgis.roadspace.road_surface import surface_of
    from ...urbanmap_qgis.roadspace.survey.area_records import kerb_edge_lines, tops_by_number
    from ...urbanmap_qgis.roadspace.survey.survey_roads import SurveyInputs

    table = algorithm.read_vector(parameters, "EDGES", context, progress)
    others = {name: algorithm.read_vector(parameters, name, context) for name in ("TOPS", "ROADS", "LANES",
                                                                                  "STOP_LINES")}
    for name, other in others.items():
        if other is not None:
            algorithm.same_crs("EDGES", table.crs, name, other.crs)
    tops = others["TOPS"]
    if tops is not None and "edge_id" not in tops.columns:
        raise InputError(tr("{0} has no field edge_id; give the upper edges of “Road edges”.").format(tops.label))
    by_number = {} if tops is None else tops_by_number(tops.columns, tops.geometries)
    edges = kerb_edge_lines(table.geometries, by_number, table.columns)
    roads = others["ROADS"]
    official = () if roads is None else surface_of(roads.geometries).polygons
    lanes = _plans(others["LANES"], "kind", "lane", "Polygon")
    stops = _plans(others["STOP_LINES"], "class", "stop line", "LineString")
    return edges, SurveyInputs(official, lanes, stops), table


def _plans(table, field, wanted, kind):
    """Parts in plan of the features of a table whose field has a value; of all without that field."""
    from ...urbanmap_qgis.roadspace.survey.area_records import layer_parts

    if table is None:
        return ()
    chosen = [shape if field not in table.columns or table.columns[field][row] == wanted else None
              for row, shape in enumerate(table.geometries)]
    return layer_parts(table.label, chosen, kind)


def write_area_layers(algorithm, parameters, context, model, crs) -> dict:
    """The layers of areas and steps."""
    import shapely

    from ...urbanmap_qgis.roadspace.survey.area_records import FUNCTIONS

    steps = Counter()
    for step in model.steps:
        steps[step.area] = max(steps[step.area], step.height)
    areas = model.areas
    columns = {"area_id": list(range(1, len(areas) + 1)),
               "road_id": [area.road + 1 if area.road >= 0 else None for area in areas],
               "function": [FUNCTIONS.get(area.kind) for area in areas],
               "area": [area.polygon.area for area in areas],
               "step": [steps.get(number) for number in range(len(areas))],
               **{name: [getattr(area, name) for area in areas] for name in (
                   "kind", "width", "source", "seen", "sigma")}}
    results = algorithm.write_layer(
        parameters, "OUTPUT_AREAS", context, make_fields(*AREA_FIELDS), columns, crs,
        [area.raised for area in areas], "PolygonZ", style="road_areas")
    results |= algorithm.write_layer(
        parameters, "OUTPUT_STEPS", context, None, {
            "area_id": [step.area + 1 for step in model.steps],
            **{name: [getattr(step, name) for step in model.steps] for name in ("height", "length")}},
        crs, [shapely.linestrings(step.upper) for step in model.steps], "LineStringZ", style="road_steps")
    return results


def write_no_areas(algorithm, parameters, context, crs) -> dict:
    """The same layers without a feature, of LOD1, which has no areas."""
    from ...urbanmap_qgis.roadspace.survey.area_records import SurveyedRoads

    wanted = any(parameters.get(name) not in (None, "") for name in ("OUTPUT_AREAS", "OUTPUT_STEPS"))
    return write_area_layers(algorithm, parameters, context, SurveyedRoads("1", (), (), (), ()), crs) if wanted else {}


def tell_kinds(things, progress) -> None:
    """How many things there are of each kind."""
    for kind, count in sorted(Counter(one.kind for one in things).items()):
        progress.message(tr("{0}: {1}").format(tr(kind), count))


def modelled_or_told(edges, level, inputs, progress):
    """The model, and why there is nothing in it; empty where there is. Only in a chain, which made more than it."""
    from ...urbanmap_qgis.roadspace.survey.area_records import SurveyedRoads
    from ...urbanmap_qgis.roadspace.survey.carriageways import NoCarriagewayError
    from ...urbanmap_qgis.roadspace.survey.survey_roads import surveyed_roads

    try:
        return surveyed_roads(edges, level, inputs, progress), ""
    except NoCarriagewayError as error:
        if not is_rest_kept():
            raise
        progress.warn(tr("No road model was made. {0}").format(error))
        return SurveyedRoads(level, (), (), (), error.findings), str(error)


def compute_surveyed(algorithm, parameters, context, progress):
    """LOD2 and finer."""
    from dataclasses import replace

    from ...urbanmap_qgis.roadspace.road_records import RoadSurfaceModel
    from .road_report import write_survey_report

    edges, inputs, table = read_survey_roads(algorithm, parameters, context, progress.part(0.0, 0.1))
    with algorithm.sampled_raster(parameters, "GROUND", context, "EDGES", table.crs) as ground:
        inputs = replace(inputs, ground=ground and ground.sample)
        model, trouble = modelled_or_told(edges, algorithm.level(parameters, context), inputs,
                                          progress.part(0.1, 0.8))
    tell_kinds(model.areas, progress)
    tell_kinds(model.findings, progress)
    built = RoadSurfaceModel(model.pieces, (), model.findings)
    results = {**algorithm.write_road_layers(parameters, context, built, table.crs),
               **write_area_layers(algorithm, parameters, context, model, table.crs)}
    folder = algorithm.output_path(parameters, "OUTPUT_CITYGML", context)
    if folder is not None and not trouble:
        from ...urbanmap_qgis.roadspace.survey.area_city import write_survey_citygml

        write_survey_citygml(folder, model, table.crs_wkt, algorithm.delivery(parameters, context, progress),
                             progress.part(0.8, 0.95))
        results["OUTPUT_CITYGML"] = str(folder)
    results |= algorithm.write_file(parameters, "OUTPUT_REPORT", context, write_survey_report, model, trouble)
    return {**results, "SURFACES": len(model.pieces), "JUNCTIONS": built.count("junction"),
            "FINDINGS": len(model.findings)}
