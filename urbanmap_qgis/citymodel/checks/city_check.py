"""What breaks the rules of the specification in the files of a city model, file by file and block by block.

Source: the standard product specification of 3D city models (Project PLATEAU) 5.0, chapters 4, 6 and 7.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from ...execution import checkpoint, in_order, without_collection
from ...io.files.rule_table import SEVERITIES, CheckRule
from ...io.official.gsi_sources import PathLike, Wanted, XmlSource, list_sources
from ...progress import SILENT, Progress
from . import feature_rules, file_rules, geometry_rules, interior_rules, survey_rules
from .checked_file import CheckedFile, CityBlock, blocks_of
from .city_rule_table import CITY_RULES, Violation
from .city_survey import CitySurvey, NamedFeature, named
from .solid_rules import SolidCheck, solid_violations

ROOMS = (file_rules, feature_rules, geometry_rules, interior_rules, survey_rules)
"""Modules whose rules are checked."""

SOLID_RULES = ("L14.closed", "L14.boundary")
"""Rules that the check of solids tells apart; one look at a solid serves both."""

_BLOCKS_A_COLLECTION = 8
"""Blocks after which what died in cycles is looked for: some 50 MB."""

ANY_CITYGML = Wanted("city models (CityGML)", "give files of a city model", lambda name: False, (".gml", ".citygml"))


@dataclass(frozen=True)
class CityFault:
    """A rule that is broken.

    Attributes
    ----------
    rule : its code.
    severity : "error", "warning" or "info".
    text : what.
    file : its name
    path : with its folder.
    type, gml_id : of the feature, "" for a file.
    lod : -1 without.
    longitude, latitude : where, as in the file (degrees, or metres of a projected system); NaN where it has no place.
    source : of the rule.
    """

    rule: str
    severity: str
    text: str
    file: str
    type: str
    gml_id: str
    lod: int
    longitude: float
    latitude: float
    source: str
    path: str = ""

    @property
    def requirement(self) -> str:
        """The code without what tells its cases apart."""
        return self.rule if self.rule.startswith("D-") else self.rule.partition(".")[0]


@dataclass
class CityInspection:
    """What was looked at and found.

    Attributes
    ----------
    faults : errors first.
    files : their names with their folders.
    counts : features by file and type.
    sizes : bytes by file.
    objects : number of city objects.
    geographic : whether places are degrees.
    plane : reference system of those that are none, as the file names it.
    checked : codes of the rules that were looked at.
    """

    faults: list[CityFault] = field(default_factory=list)
    files: list[str] = field(default_factory=list)
    counts: dict[str, dict[str, int]] = field(default_factory=dict)
    sizes: dict[str, int] = field(default_factory=dict)
    objects: int = 0
    geographic: bool = True
    plane: str = ""
    checked: tuple[str, ...] = ()


@dataclass
class _FileFindings:
    """What a file is found to have, and what the rules on the whole data set need of it."""

    file: CheckedFile
    faults: list[CityFault]
    survey: CitySurvey
    objects: int = 0


def check_city(path: PathLike | Sequence[PathLike], check_solid: SolidCheck, excluded: Collection[str] = (),
               progress: Progress = SILENT, executor: Executor | None = None) -> CityInspection:
    """Look at a CityGML file, a folder or a zip of them by all rules.

    Memory does not grow with the files but for an id, an outline and a building id a city object.

    Parameters
    ----------
    check_solid : judges solids that are no plain prisms: vertices and faces in, problems with val3dity's codes out.
    excluded : codes of rules that are not looked at; the begin of a code stands for all that begin so.
    executor : looks at several files at a time; those in a zip are read here, one after another.

    Raises
    ------
    InputError : nothing is there to read, or an excluded code is the begin of none.
    """
    rules = CITY_RULES.chosen(excluded)
    inspection = CityInspection(checked=tuple(rules))
    with ExitStack() as stack:
        sources = list_sources(path, stack, ANY_CITYGML).sources
        survey = CitySurvey()
        for found in _findings(_checked_files(sources), rules, check_solid, progress.part(0.0, 0.95), executor):
            file = found.file
            inspection.faults += found.faults
            inspection.objects += found.objects
            survey.join(found.survey)
            inspection.files.append(file.path)
            inspection.counts[file.path], inspection.sizes[file.path] = file.counts, file.source.size
            if not file.geographic:
                inspection.geographic, inspection.plane = False, file.system
        for code, rule in _of(rules, "data set"):
            progress.check()
            inspection.faults += [_fault(rule, one, feature.file, feature)
                            for feature, one in CITY_RULES.functions[code](survey, rule)]
    inspection.faults.sort(key=lambda fault: SEVERITIES.index(fault.severity))
    return inspection


def _checked_files(sources: Sequence[XmlSource]) -> list[CheckedFile]:
    """Files with their names and the folders that tell them apart."""
    folders = [re.split(r"[/\\]", source.name)[:-1] for source in sources]
    shared = next((k for k, steps in enumerate(zip(*folders)) if len(set(steps)) > 1), min(map(len, folders)))
    return [CheckedFile(source, number, _is_delivery(source.path),
                        "/".join(re.split(r"[/\\]", source.name)[shared:])) for number, source in enumerate(sources)]


def _findings(files: Sequence[CheckedFile], rules: Mapping[str, CheckRule], check_solid: SolidCheck,
              progress: Progress, executor: Executor | None) -> Iterator[_FileFindings]:
    """What each file is found to have, in their order."""
    total, done = max(sum(file.source.size for file in files), 1), 0
    if executor is None or len(files) < 2 or any(file.source.path is None for file in files):
        for file in files:
            part = progress.part(done / total, (done + file.source.size) / total)
            yield _looked_at(file, tuple(rules), check_solid, part)
            done += file.source.size
        return
    work = partial(_looked_at, codes=tuple(rules), check_solid=check_solid)
    for found in in_order(work, files, executor, progress.check):
        yield found
        done += found.file.source.size
        progress.step(done / total)


def _looked_at(file: CheckedFile, codes: tuple[str, ...], check_solid: SolidCheck,
               progress: Progress = SILENT) -> _FileFindings:
    """Look at a file by the rules of some codes; its head is judged when all of it was read."""
    rules = {code: CITY_RULES.rules[code] for code in codes}
    blockwise = [*_of(rules, "feature"), *_of(rules, "geometry")]
    found = _FileFindings(file, [], CitySurvey())
    with without_collection() as collect:
        for number, block in enumerate(blocks_of(file, progress), 1):
            progress.check()
            checkpoint()
            found.objects += len(block.things)
            found.survey.add(block)
            found.faults += _faults_of_block(block, blockwise, check_solid)
            if number % _BLOCKS_A_COLLECTION == 0:
                collect()
    found.survey.read.append(file)
    for code, rule in _of(rules, "file"):
        found.faults += [_fault(rule, one, file, None) for one in CITY_RULES.functions[code](file, rule)]
    return found


def _faults_of_block(block: CityBlock, rules: Sequence[tuple[str, CheckRule]],
                     check_solid: SolidCheck) -> Iterator[CityFault]:
    by_code = dict(rules)
    for code, rule in rules:
        if code not in SOLID_RULES:
            for one in CITY_RULES.functions[code](block, rule):
                yield _fault(rule, one, block.file, named(block.file, one.feature) if one.feature else None)
    if set(SOLID_RULES) & set(by_code):
        for code, one in solid_violations(block, check_solid):
            if code in by_code and one.feature is not None:
                yield _fault(by_code[code], one, block.file, named(block.file, one.feature))


def _of(rules: Mapping[str, CheckRule], primitive: str) -> list[tuple[str, CheckRule]]:
    return [(code, rule) for code, rule in rules.items() if rule.primitive == primitive]


def _fault(rule: CheckRule, one: Violation, file: CheckedFile, feature: NamedFeature | None) -> CityFault:
    """The fault with its place: that of the geometry, else the feature's."""
    place = one.place or (feature.place if feature is not None else None)
    first, second = (float(place[0]), float(place[1])) if place is not None else (np.nan, np.nan)
    if file.geographic:
        first, second = second, first
    return CityFault(rule.code, rule.severity, rule.sentence(one.fields), file.name,
                     feature.type if feature is not None else "", feature.id if feature is not None else "",
                     -1 if one.lod is None else one.lod, first, second, rule.source, file.path)


def _is_delivery(path: Path | None) -> bool:
    """Whether a file lies in folders as the specification lays out a delivery (7.2.4.1): two at least are there."""
    if path is None or path.parent.parent.name != "udx":
        return False
    root = path.parent.parent.parent
    return sum((root / name).is_dir() for name in ("codelists", "metadata", "schemas", "specification")) >= 2
