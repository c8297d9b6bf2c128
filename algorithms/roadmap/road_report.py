"""The report on a road model: verdict, figures, pictures and findings with their places."""

from __future__ import annotations

from collections import Counter

from ..framework.declaring.parameters import tr

PICTURES = 24
FINDINGS_SHOWN = 300


def write_road_report(path, built) -> None:
    """Write the report on a road model."""
    from ...urbanmap_qgis.io.pages.report import BAD, GOOD, LOOK, Report

    report = Report(tr("Road model"))
    if not built.pieces:
        report.verdict(BAD, tr("No surface was made."))
    else:
        doubtful = sum(piece.status != "made" for piece in built.pieces)
        report.verdict(LOOK if built.findings else GOOD, tr(
            "{0} surfaces, {1} of them junctions; to be looked at: {2} surfaces; findings: {3}.").format(
                len(built.pieces), built.count("junction"), doubtful, len(built.findings)))
    _table(report, built)
    _pictures(report, built)
    _findings(report, built)
    report.write(path)


def write_survey_report(path, model, trouble: str = "") -> None:
    """Write the report on a road model from a survey; `trouble` says why there is nothing in it."""
    from ...urbanmap_qgis.io.pages.report import BAD, GOOD, LOOK, Report
    from ...urbanmap_qgis.roadspace.survey.area_pictures import area_picture, areas_extent, junction_windows
    from ...urbanmap_qgis.roadspace.survey.area_records import HARDLY_SEEN

    report = Report(tr("Road model"))
    if trouble:
        report.verdict(BAD, tr("No road model was made. {0}").format(trouble))
        _findings(report, model)
        report.write(path)
        return
    unseen = sum(area.source in ("continued", "doubtful") for area in model.areas)
    hardly = model.seen < HARDLY_SEEN
    report.verdict(BAD if hardly else LOOK if model.findings else GOOD, tr(
        "LOD{0}: {1} sections and {2} junctions in {3} areas; borders doubtful or not seen all along: {4} areas; "
        "findings: {5}.").format(
            model.level, sum(piece.kind == "road" for piece in model.pieces),
            sum(piece.kind == "junction" for piece in model.pieces), len(model.areas), unseen, len(model.findings)))
    if hardly:
        report.warning(tr("Only {0:.0%} of the borders were measured: the rest is drawn on, doubtful or given. "
                          "Snow, parked vehicles or a scanner too far away may hide the kerbs.").format(model.seen))
    report.section(tr("Areas by kind"))
    rows, sources = [], ("measured", "doubtful", "continued", "official")
    for kind in dict.fromkeys(area.kind for area in model.areas):
        some = [area for area in model.areas if area.kind == kind]
        rows.append((tr(kind), len(some), f"{sum(area.polygon.area for area in some):.1f}",
                     *(sum(area.source == name for area in some) for name in sources)))
    report.table((tr("Kind"), tr("Number"), tr("Area (m²)"), *map(tr, sources)), rows)
    if model.areas:
        report.section(tr("Map"))
        report.figure(area_picture(model, areas_extent(model)), tr(
            "Carriageways grey, lanes blue, junctions orange, sidewalks green, islands dark green; steps red, findings "
            "numbered."))
    extents = junction_windows(model)[:PICTURES]
    if extents:
        report.section(tr("Junctions"))
    for number, extent in enumerate(extents, 1):
        report.figure(area_picture(model, extent), tr("Junction {0}, about {1:.0f}, {2:.0f}: look whether it is cut "
                                                      "where the stop lines are.").format(
            number, (extent[0] + extent[2]) / 2, (extent[1] + extent[3]) / 2))
    _findings(report, model)
    report.write(path)


def _table(report, built) -> None:
    report.section(tr("Surfaces by kind"))
    areas = Counter()
    for piece in built.pieces:
        areas[piece.kind] += piece.polygon.area
    report.table((tr("Kind"), tr("Number"), tr("Area (m²)")),
                 [(tr(kind), built.count(kind), f"{area:.1f}") for kind, area in sorted(areas.items())])


def _pictures(report, built) -> None:
    from ...urbanmap_qgis.roadspace.road_pictures import doubtful_extents, model_extent, road_picture

    if not built.pieces:
        return
    report.section(tr("Map"))
    report.figure(road_picture(built, model_extent(built)), tr(
        "Roads grey, junctions orange, bridges blue, tunnels violet; middle lines dashed, findings numbered."))
    extents = doubtful_extents(built)[:PICTURES]
    if extents:
        report.section(tr("Surfaces to look at"))
    for number, extent in enumerate(extents, 1):
        report.figure(road_picture(built, extent), tr("Surface {0}, about {1:.0f}, {2:.0f}.").format(
            number, (extent[0] + extent[2]) / 2, (extent[1] + extent[3]) / 2))


def _findings(report, built) -> None:
    if not built.findings:
        return
    report.section(tr("Findings"))
    report.table((tr("No."), tr("Kind"), tr("What"), "x", "y"),
                 [(number, tr(one.kind), one.text, f"{one.x:.1f}", f"{one.y:.1f}")
                  for number, one in enumerate(built.findings[:FINDINGS_SHOWN], 1)])
    if len(built.findings) > FINDINGS_SHOWN:
        report.paragraph(tr("The first {0} of {1} are shown; the layer holds all.").format(
            FINDINGS_SHOWN, len(built.findings)))
