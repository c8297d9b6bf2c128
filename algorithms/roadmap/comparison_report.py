"""The report on two lane maps: verdict, offset, tables, sigmas, pictures and the list of changes."""

from __future__ import annotations

from ..framework.declaring.parameters import tr

CHANGES_SHOWN = 300


def write_comparison_report(stage, parameters, context, found, maps, settings) -> dict[str, str]:
    """Write the report, where it is wanted; its place by output."""
    path = stage.output_path(parameters, "OUTPUT_REPORT", context)
    if path is None:
        return {}
    from ...urbanmap_qgis.io.pages.report import Report

    report = Report(tr("Compare lane maps"))
    _verdict(report, found)
    report.facts(_facts(found))
    _tables(report, found)
    _pictures(report, found, maps)
    _list(report, found)
    report.write(path)
    return {"OUTPUT_REPORT": str(path)}


def _sources() -> dict[str, str]:
    """What a sigma comes from, in words."""
    return {"stated": tr("stated by both maps"), "given": tr("given"),
            "estimated": tr("estimated from what did not change"),
            "all elements": tr("too few of the kind: taken from all stop lines, crosswalks and symbols, or from lines"),
            "unknown": tr("not known: too few lines, and no map states it; no shift is told")}


def _verdict(report, found) -> None:
    from ...urbanmap_qgis.io.pages.report import GOOD, LOOK

    changes = [one for one in found.changes if one.element]
    share = found.same / found.compared if found.compared else 0.0
    text = tr("{0:.1%} of {1:.0f} m of lines are the same within three sigma; {2} changes are listed below.").format(
        share, found.compared, len(changes))
    if found.offset.significant:
        text += " " + tr("The whole new map lies {0:+.3f} m to the east and {1:+.3f} m to the north of the old one, "
                         "which was taken off first: look which of them is right.").format(found.offset.east,
                                                                                           found.offset.north)
    if found.unjudged:
        text += " " + tr("Of {0:.0f} m it is not known whether they moved: the maps are not accurate enough.").format(
            found.unjudged)
    report.verdict(LOOK if changes or found.offset.significant or found.unjudged else GOOD, text)
    if found.noises["line"].factor > 1.2:
        report.warning(tr("What did not change scatters {0:.1f} times as much as the maps' sigmas say: they were "
                          "multiplied by it. Look whether one of the maps is placed worse than it states.").format(
                              found.noises["line"].factor))


def _facts(found) -> dict[str, object]:
    offset = found.offset
    return {tr("Offset to the east (m)"): offset.east, tr("Its sigma (m)"): offset.sigma_east,
            tr("Offset to the north (m)"): offset.north, tr("Sigma of that (m)"): offset.sigma_north,
            tr("Offset significant"): offset.significant, tr("Compared lines of the old map (m)"): found.compared,
            tr("Of it as they were (m)"): found.same, tr("Of it not known (m)"): found.unjudged,
            tr("Lines of the old map where the new one shows no road, not judged (m)"): found.outside_old,
            tr("Lines of the new map where the old one shows no road, not judged (m)"): found.outside_new,
            **{tr("In both maps: {0}").format(tr(name)): count for name, count in found.counts.items()}}


def _tables(report, found) -> None:
    from ...urbanmap_qgis.roadmap.comparison.comparison_tables import change_summary

    report.section(tr("Changes by kind"))
    rows = [(tr(kind), tr(element), *rest) for kind, element, *rest in change_summary(found)]
    report.table((tr("Kind"), tr("Element"), tr("Number"), tr("Length (m)"), tr("Median shift (m)")), rows)
    report.section(tr("Sigma of places"))
    sources = _sources()
    report.paragraph(tr("A shift is told where it exceeds the limit, in sigmas of both maps together: 3, more where "
                        "sigma was estimated from few. Sigmas that the maps state are multiplied by the factor."))
    report.table((tr("Element"), tr("From"), tr("Old map (m)"), tr("New map (m)"), tr("Factor"), tr("Limit (sigmas)"),
                  tr("Compared")),
                 [(", ".join(tr(word) for word in name.split(", ")), sources[one.source], one.old, one.new,
                   one.factor, one.limit, one.count) for name, one in found.noises.items()])


def _pictures(report, found, maps) -> None:
    from ...urbanmap_qgis.roadmap.comparison.comparison_picture import change_extents, change_picture, whole_map

    report.section(tr("Map"))
    report.figure(change_picture(*maps, found.changes, whole_map([*maps[0], *maps[1]])), tr(
        "The old map pale, the new one dark; moved orange, added green, removed red, repainted blue, with the numbers "
        "of the list."))
    for number, extent in enumerate(change_extents(found.changes)):
        report.figure(change_picture(*maps, found.changes, extent), tr("Place {0}, about {1:.0f}, {2:.0f}.").format(
            number + 1, (extent[0] + extent[2]) / 2, (extent[1] + extent[3]) / 2))


def _list(report, found) -> None:
    from ...urbanmap_qgis.io.pages.report import Fixed

    report.section(tr("List of changes"))
    rows = [(number + 1, tr(one.kind), tr(one.element) if one.element else tr("whole map"), one.before, one.after,
             one.length, one.shift, one.along, one.across, one.sigma, one.significance,
             *(Fixed.of(value, 1) for value in one.middle), one.old_id, one.new_id)
            for number, one in enumerate(found.changes[:CHANGES_SHOWN])]
    report.table((tr("No."), tr("Kind"), tr("Element"), tr("Before"), tr("After"), tr("Length (m)"), tr("Shift (m)"),
                  tr("Along (m)"), tr("Across (m)"), tr("Sigma (m)"), tr("Shift over sigma"), "x", "y", tr("Old id"),
                  tr("New id")), rows)
    if len(found.changes) > CHANGES_SHOWN:
        report.paragraph(tr("The first {0} of {1} are shown; the layer holds all.").format(
            CHANGES_SHOWN, len(found.changes)))
