"""The report on street objects: verdict, figures by kind, a map and what is doubtful."""

from __future__ import annotations

from collections import Counter

from ..framework.declaring.parameters import tr

SHOWN = 300


def write_object_report(path, found, trajectory) -> None:
    """Write the report on street objects."""
    from ...urbanmap_qgis.io.pages.report import BAD, GOOD, LOOK, Report
    from ...urbanmap_qgis.roadmap.objects.object_pictures import object_map
    from ...urbanmap_qgis.roadmap.objects.object_records import DOUBTFUL

    report = Report(tr("Street objects"))
    doubtful = [(number, thing) for number, thing in enumerate(found.objects, 1) if thing.status == DOUBTFUL]
    if not found.objects:
        report.verdict(BAD, tr("No object was found along {0:.0f} m.").format(found.path_length))
    else:
        report.verdict(LOOK if doubtful else GOOD, tr("{0} objects along {1:.0f} m; {2} of them are doubtful.").format(
            len(found.objects), found.path_length, len(doubtful)))
        _table(report, found.objects, DOUBTFUL)
        report.section(tr("Map"))
        report.figure(object_map(found.objects, trajectory.place[:, :2]), tr(
            "The path grey; poles black, lamp posts yellow, signals red, signs blue, trees green, bollards brown, "
            "boxes violet; doubtful objects hollow."))
    if doubtful:
        report.section(tr("Doubtful objects"))
        report.table((tr("No."), tr("Kind"), tr("Why"), "x", "y"),
                     [(number, tr(thing.kind), tr(thing.reason), f"{thing.foot[0]:.2f}", f"{thing.foot[1]:.2f}")
                      for number, thing in doubtful[:SHOWN]])
    report.write(path)


def _table(report, objects, doubtful) -> None:
    import numpy as np

    report.section(tr("Objects by kind"))
    rows = []
    for kind, count in sorted(Counter(thing.kind for thing in objects).items()):
        some = [thing for thing in objects if thing.kind == kind]
        known = [thing.diameter for thing in some if thing.diameter is not None]
        rows.append((tr(kind), count, sum(thing.status == doubtful for thing in some),
                     f"{np.median([thing.height for thing in some]):.1f}",
                     f"{np.median(known):.2f}" if known else "–",
                     f"{np.median([thing.sigma for thing in some]):.3f}"))
    report.table((tr("Kind"), tr("Number"), tr("Doubtful"), tr("Median height (m)"), tr("Median diameter (m)"),
                  tr("Median sigma (m)")), rows)
