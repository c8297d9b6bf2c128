"""The report on a lane map: verdict, figures, pictures and findings with their places."""

from __future__ import annotations

from collections import Counter

from ..framework.declaring.parameters import tr

FINDINGS_SHOWN = 300


def write_map_report(stage, parameters, context, built, drives) -> dict[str, str]:
    """Write the report, where it is wanted; its place by output."""
    path = stage.output_path(parameters, "OUTPUT_REPORT", context)
    if path is None:
        return {}
    from ...urbanmap_qgis.io.pages.report import Report
    from ...urbanmap_qgis.roadmap.map_figures import map_figures

    report = Report(tr("Lane map"))
    figures = map_figures(built, drives)
    _verdict(report, built, drives, figures)
    report.facts(_facts(built, figures))
    _pictures(report, built, drives)
    _findings(report, built)
    report.write(path)
    return {"OUTPUT_REPORT": str(path)}


def _verdict(report, built, drives, figures) -> None:
    from ...urbanmap_qgis.io.pages.report import BAD, GOOD, LOOK

    if not built.lanes:
        report.verdict(BAD, tr("No lane was made: nothing shows the direction of any strip between lines."))
        return
    warnings = _warnings(built, drives, figures)
    report.verdict(LOOK if warnings else GOOD, tr(
        "{0} lanes of {1:.0f} m together, and {2} ways through junctions that were driven.").format(
        sum(lane.kind == "lane" for lane in built.lanes), figures.length,
        sum(lane.kind == "virtual" for lane in built.lanes)) + " " + tr(
        "What is missing or contradicts is numbered in the map and listed below: {0} findings.").format(
        len(built.findings)))
    for text in warnings:
        report.warning(text)


def _warnings(built, drives, figures) -> list[str]:
    """What keeps the map from being taken as it is."""
    warnings = []
    if not drives:
        warnings.append(tr("No trajectory was given: only paint and road axes tell directions, and nothing leads "
                           "through junctions."))
    elif figures.breaks:
        warnings.append(tr("The map is not connected along the drives at {0} places; see the findings “driven without "
                           "lane” and “way not drawn”.").format(figures.breaks))
    if figures.seen < 0.9:
        warnings.append(tr("{0:.0%} of the length of the bounds was not seen and is drawn through gaps; see the "
                           "findings “bound not seen”.").format(1.0 - figures.seen))
    strips = sum(finding.kind == "no lane made" for finding in built.findings)
    if strips:
        warnings.append(tr("Of {0} strips beside lines no lane was made; see the findings “{1}”.").format(
            strips, tr("no lane made")))
    contradictions = sum(finding.kind == "direction contradicts" for finding in built.findings)
    if contradictions:
        warnings.append(tr("Evidence on directions contradicts itself at {0} places.").format(contradictions))
    return warnings


def _facts(built, figures) -> dict[str, object]:
    side = {True: tr("left"), False: tr("right"), None: tr("not shown by drives; left assumed")}[built.left_hand]
    return {tr("Side of the traffic"): side, tr("Length of lanes (m)"): figures.length,
            **{tr("Direction from: {0} (m)").format(tr(name)): length
               for name, length in figures.by_evidence.items()},
            tr("Bounds seen, share"): figures.seen, tr("Median sigma of bounds (m)"): figures.sigma,
            tr("Driven near the map (m)"): figures.driven, tr("Of it inside lanes, share"): figures.covered}


def _pictures(report, built, drives) -> None:
    from ...urbanmap_qgis.roadmap.map_pictures import junction_extents, map_picture, whole_extent

    if not built.lanes:
        return
    report.section(tr("Map"))
    report.figure(map_picture(built, drives, whole_extent(built)), tr(
        "Lanes pale, ways through junctions red, arrows with the traffic; drives dotted, findings numbered. "
        "Look for arrows against the traffic, and for strips of road without a lane."))
    extents = junction_extents(built)
    if extents:
        report.section(tr("Junctions"))
    for number, extent in enumerate(extents):
        report.figure(map_picture(built, drives, extent), tr(
            "Junction {0}, about {1:.0f}, {2:.0f}: each way that may be driven should be drawn red.").format(
            number + 1, (extent[0] + extent[2]) / 2, (extent[1] + extent[3]) / 2))


def _findings(report, built) -> None:
    report.section(tr("Findings"))
    counts = Counter(finding.kind for finding in built.findings)
    report.table((tr("Kind"), tr("Number")), sorted(counts.items()))
    rows = [(number + 1, one.kind, one.text, f"{one.x:.1f}", f"{one.y:.1f}")
            for number, one in enumerate(built.findings[:FINDINGS_SHOWN])]
    report.table((tr("No."), tr("Kind"), tr("What"), "x", "y"), rows)
    if len(built.findings) > FINDINGS_SHOWN:
        report.paragraph(tr("The first {0} of {1} are shown; the layer holds all.").format(
            FINDINGS_SHOWN, len(built.findings)))
