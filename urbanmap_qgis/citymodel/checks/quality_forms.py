"""The forms of a quality report: results by file and requirement, instances by file and type, and the report itself."""

from __future__ import annotations

import csv
import os
from collections import Counter

from ...io.files.atomic import written_beside
from ...io.pages.report import BAD, GOOD, LOOK, Report
from ...wording import known, language, mark, say
from .city_check import CityFault, CityInspection
from .city_rule_table import CITY_RULES, NOT_CHECKED

_MOST = 500
"""Faults of a requirement that the report lists; the layer holds all."""

_WHY_NOT = {
    "needs the reference data; the table of instances has the numbers to compare": mark(
        "needs the reference data; the table of instances has the numbers to compare"),
    "needs the reference data and eyes": mark("needs the reference data and eyes"),
    "needs the city's own list of attributes": mark("needs the city's own list of attributes"),
    "only in part: the root, values and coordinates; the schema needs a validator": mark(
        "only in part: the root, values and coordinates; the schema needs a validator"),
    "has no rule here": mark("has no rule here"),
    "needs the BIM model": mark("needs the BIM model"),
    "needs the BIM model and eyes": mark("needs the BIM model and eyes")}

PACKAGES = ("bldg", "frn", "tran")
"""Parts of the specification with requirements of their own, as their codes and the types of features name them."""


def requirements() -> list[str]:
    """Codes of the specification that are checked, in the order of the table."""
    return list(dict.fromkeys(_requirement(code) for code in CITY_RULES.rules))


def _requirement(code: str) -> str:
    return code if code.startswith("D-") else code.partition(".")[0]


def _by_file(found: CityInspection, key) -> dict[str, Counter]:
    numbers = {name: Counter() for name in found.files}
    for fault in found.faults:
        numbers[fault.path][key(fault)] += 1
    return numbers


def write_results(path: str | os.PathLike, found: CityInspection) -> None:
    """CSV, a line a file: name, size, number of faults of each rule.

    Raises
    ------
    OutputError : it cannot be written.
    """
    numbers = _by_file(found, lambda fault: fault.rule)
    _write(path, ["Index", "Filename", "Size_KB", *CITY_RULES.rules],
           [[number, name, found.sizes[name] // 1024,
             *(numbers[name][code] if code in found.checked else "" for code in CITY_RULES.rules)]
            for number, name in enumerate(found.files, 1)])


def write_counts(path: str | os.PathLike, found: CityInspection) -> None:
    """CSV, a line a file: name, number of features of each type that is there.

    Raises
    ------
    OutputError : it cannot be written.
    """
    types = sorted({kind for counts in found.counts.values() for kind in counts})
    _write(path, ["Index", "Filename", *types],
           [[number, name, *(found.counts[name].get(kind, 0) for kind in types)]
            for number, name in enumerate(found.files, 1)])


def _write(path: str | os.PathLike, head: list[str], rows: list[list]) -> None:
    with written_beside(path) as temporary, open(temporary, "w", encoding="utf-8-sig", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])


def quality_report(found: CityInspection) -> Report:
    """The report: verdict, requirements with their numbers, faults, instances, what is not checked."""
    numbers = Counter(fault.severity for fault in found.faults)
    report = Report(say("Check of a city model"))
    text = say("{objects} city objects in {files} files: {errors} errors, {warnings} warnings.", objects=found.objects,
               files=len(found.files), errors=numbers["error"], warnings=numbers["warning"])
    if numbers["error"]:
        text += " " + say("The data set does not pass: put the errors right, the commonest first.")
    elif numbers["warning"]:
        text += " " + say("It passes what is checked here; look at the warnings before it is delivered.")
    elif not found.objects:
        text += " " + say("There is nothing to check but the files.")
    doubtful = numbers["warning"] or not found.objects
    report.verdict(BAD if numbers["error"] else LOOK if doubtful else GOOD, text)
    _requirement_table(report, found)
    _fault_tables(report, found)
    report.section(say("Instances"))
    total = Counter()
    for counts in found.counts.values():
        total.update(counts)
    report.table((say("Type"), say("Number")), sorted(total.items()))
    report.section(say("Not checked"))
    report.table((say("Requirement"), say("Why")), [(code, known(_WHY_NOT[why])) for code, why in NOT_CHECKED.items()])
    return report


def _requirement_table(report: Report, found: CityInspection) -> None:
    """One line a requirement: faults, and whether it is met (none allowed); no word on what was not looked at."""
    report.section(say("Requirements"))
    numbers = Counter(fault.requirement for fault in found.faults)
    files = {code: {fault.path for fault in found.faults if fault.requirement == code} for code in numbers}
    report.table((say("Requirement"), say("Faults"), say("Files"), say("Verdict")),
                 [(code, numbers[code], len(files.get(code, ())), _verdict(code, numbers[code], found))
                  for code in requirements()])


def _verdict(code: str, faults: int, found: CityInspection) -> str:
    """Whether a requirement is met, as far as it was looked at and something was there."""
    if faults:
        return say("not met")
    rules = {rule: what.primitive for rule, what in CITY_RULES.rules.items() if _requirement(rule) == code}
    if not rules.keys() <= set(found.checked):
        return say("left out")
    package = next((f"{name}:" for name in PACKAGES if f"-{name}-" in code), "")
    has_package = any(kind.startswith(package) for counts in found.counts.values() for kind in counts)
    if not has_package and "file" not in rules.values():
        return say("nothing to check")
    return say("met in part") if code in NOT_CHECKED else say("met")


def _fault_tables(report: Report, found: CityInspection) -> None:
    """The faults of each requirement that is not met, those with most first."""
    by_code: dict[str, list[CityFault]] = {}
    for fault in found.faults:
        by_code.setdefault(fault.requirement, []).append(fault)
    for code, faults in sorted(by_code.items(), key=lambda item: -len(item[1])):
        report.section(code if language() == "ja" else say("Faults of {code}", code=code))
        report.table((say("File"), say("Feature"), say("Id"), say("What")),
                     [(fault.file, fault.type, fault.gml_id, fault.text) for fault in faults[:_MOST]])
        if len(faults) > _MOST:
            report.paragraph(say("The first {shown} of {number} are shown; the layer holds all.", shown=_MOST,
                                 number=len(faults)))
