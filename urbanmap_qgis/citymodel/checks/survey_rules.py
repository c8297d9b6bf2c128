"""Rules on the whole data set: ids, references, solids and roads that overlap."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from ...geometry.mesh_code import mesh_bounds, regional_mesh_code
from ...io.files.rule_table import CheckRule
from .checked_file import CheckedFile, CityBlock, blocks_of
from .city_rule_table import Violation, city_rule, violation
from .city_survey import CitySurvey, NamedFeature, PlanOutline, id_number, named, wrong_target
from .feature_walk import CityFeature
from .geometry_rules import NEAREST

MEDIAN_STRIP, SIDE_STRIP, SHOULDER, DIVIDER = "1080", "1090", "1100", "3020"
_MAY_HOLD = {frozenset((MEDIAN_STRIP, DIVIDER)), frozenset((MEDIAN_STRIP, SIDE_STRIP)),
             frozenset((SHOULDER, SIDE_STRIP))}
"""Functions of auxiliary traffic areas of which one may hold the other (L-tran-02, 4.3.4.1.5)."""
_OVER_EACH_OTHER = 2.0
"""Roads whose surfaces lie so far apart in height cross at different levels, m: less than any clearance."""
_DEGREE = 111_000.0
_ROWS_A_DEGREE, _COLUMNS_A_DEGREE = 120, 80

SurveyViolation = tuple[NamedFeature, Violation]


def _told(feature: NamedFeature, lod: int | None = None, /, **fields: object) -> SurveyViolation:
    return feature, violation(None, lod, feature.place, **fields)


@city_rule("C01")
def _repeated_ids(survey: CitySurvey, rule: CheckRule) -> Iterator[SurveyViolation]:
    """Ids that are there more than once; their files are read again to name them."""
    numbers, count = np.unique(np.frombuffer(survey.ids, np.int64) if survey.ids else np.zeros(0, np.int64),
                               return_counts=True)
    repeated = dict(zip(numbers[count > 1].tolist(), count[count > 1].tolist()))
    if not repeated:
        return
    concerned = set(np.frombuffer(survey.files, np.uint16)[
        np.isin(np.frombuffer(survey.ids, np.int64), list(repeated))].tolist())
    for file in survey.read:
        if file.number not in concerned:
            continue
        for block in blocks_of(CheckedFile(file.source, file.number)):
            for thing in block.things:
                for identifier, tag, feature in thing.ids:
                    number = id_number(identifier)
                    if number in repeated:
                        found = named(file, feature)
                        kind = ":".join(filter(None, tag))
                        yield _told(NamedFeature(file, kind, identifier, found.place), id=identifier,
                                    count=repeated[number])


@city_rule("C-bldg-01")
def _repeated_building_ids(survey: CitySurvey, rule: CheckRule) -> Iterator[SurveyViolation]:
    for identifier, features in survey.building_ids.items():
        if len(features) > 1:
            for feature in features:
                yield _told(feature, id=identifier, count=len(features))


def _target_tags(survey: CitySurvey) -> dict[tuple[int, int], tuple[str, str]]:
    """Tags of the targets of all kept references by file and number of the id."""
    wanted = {id_number(link.target.lstrip("#")) for _, link in survey.links}
    if not wanted:
        return {}
    ids = np.frombuffer(survey.ids, np.int64)
    rows = np.flatnonzero(np.isin(ids, np.fromiter(wanted, np.int64, len(wanted))))
    kinds = list(survey.kinds)
    return {(survey.files[row], int(ids[row])): kinds[survey.tags[row]] for row in rows.tolist()}


@city_rule("T03")
def _wrong_target(survey: CitySurvey, rule: CheckRule) -> Iterator[SurveyViolation]:
    tags = _target_tags(survey)
    for feature, link in survey.links:
        tag = tags.get((feature.file.number, id_number(link.target.lstrip("#"))))
        if tag is not None and wrong_target(link, tag):
            yield _told(feature, name=":".join(filter(None, link.tag)), target=link.target.lstrip("#"),
                        kind=":".join(filter(None, tag)))


@city_rule("T03.missing")
def _no_target(survey: CitySurvey, rule: CheckRule) -> Iterator[SurveyViolation]:
    tags = _target_tags(survey)
    for feature, link in survey.links:
        if link.target.startswith("#") and (feature.file.number, id_number(link.target[1:])) not in tags:
            yield _told(feature, name=":".join(filter(None, link.tag)), target=link.target)


def _overlaps(outlines: list[PlanOutline]) -> Iterator[tuple[PlanOutline, PlanOutline]]:
    """Pairs of outlines that overlap in plan by more than vertices may be off, and in height."""
    if len(outlines) < 2:
        return
    plans = shapely.make_valid(np.array([one.plan for one in outlines], object))
    first, second = shapely.STRtree(plans).query(plans, predicate="intersects")
    for k, j in zip(first.tolist(), second.tolist()):
        one, other = outlines[k], outlines[j]
        if k >= j or (one.feature.id == other.feature.id and one.feature.file is other.feature.file):
            continue
        if min(one.high, other.high) - max(one.low, other.low) > NEAREST and _deep(plans[k], plans[j], one):
            yield one, other


def _deep(plan: shapely.Geometry, other: shapely.Geometry, outline: PlanOutline) -> bool:
    """Whether two plans overlap by more than `NEAREST` across."""
    common = shapely.intersection(plan, other)
    if shapely.area(common) == 0.0:
        return False
    if not outline.feature.file.geographic:
        return not shapely.buffer(common, -NEAREST / 2.0).is_empty
    middle = common.centroid
    scale = np.array([_DEGREE * np.cos(np.radians(middle.y)), _DEGREE])
    local = shapely.transform(common, lambda places: (places - [middle.x, middle.y]) * scale)
    return not shapely.buffer(local, -NEAREST / 2.0).is_empty


@city_rule("L-bldg-01")
def _solids_overlap(survey: CitySurvey, rule: CheckRule) -> Iterator[SurveyViolation]:
    for level in (1, 2):
        for one, other in _overlaps(survey.solids.get(level, [])):
            yield _told(one.feature, level, level=level, other=other.feature.id)


@city_rule("L-tran-01")
def _roads_overlap(survey: CitySurvey, rule: CheckRule) -> Iterator[SurveyViolation]:
    for level, roads in sorted(survey.roads.items()):
        for one, other in _crossing(roads):
            yield _told(one.feature, level, level=level, other=other.feature.id)
            yield _told(other.feature, level, level=level, other=one.feature.id)


@city_rule("L-tran-02")
def _areas_overlap(survey: CitySurvey, rule: CheckRule) -> Iterator[SurveyViolation]:
    for level, areas in sorted(survey.areas.items()):
        pairs: dict[int, tuple[PlanOutline, PlanOutline]] = {}
        for one, other in _crossing(areas):
            if frozenset((one.feature.function, other.feature.function)) not in _MAY_HOLD:
                pairs.setdefault(id(one), (one, other))
                pairs.setdefault(id(other), (other, one))
        for one, other in pairs.values():
            yield _told(one.feature, level, level=level, other=other.feature.id)


def _crossing(outlines: list[PlanOutline]) -> Iterator[tuple[PlanOutline, PlanOutline]]:
    """Pairs of surfaces that overlap in plan and do not cross at different heights."""
    thick = [PlanOutline(one.feature, one.plan, one.low, one.high + _OVER_EACH_OTHER) for one in outlines]
    yield from _overlaps(thick)


@city_rule("D-7.2.2.1")
def _other_mesh(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    """City objects that belong into the file of another mesh, by the largest share of their area."""
    if not block.file.geographic or not len(block.shapes.polygons):
        return
    shapes = block.shapes
    code = block.file.parts[0] if block.file.parts else ""
    bounds = mesh_bounds(code) if len(code) in (8, 9, 10) else None
    if bounds is None and (code or block.file.package != "bldg"):
        return
    owner = shapes.thing[shapes.polygon[shapes.ring_of_place]]
    begin = np.searchsorted(owner, np.arange(len(block.things)))
    for number, thing in enumerate(block.things):
        end = begin[number + 1] if number + 1 < len(begin) else len(owner)
        if begin[number] == end:
            continue
        places = shapes.raw[begin[number]:end, 1::-1]
        low, high = places.min(axis=0), places.max(axis=0)
        if bounds is not None and (low >= bounds[:2]).all() and (high <= bounds[2:]).all():
            continue
        shares = _shares(block, number, len(code) or 8)
        best = min(shares, key=lambda mesh: (-round(shares[mesh], 2), mesh), default="")
        if best and best != code and (bounds is not None or len(shares) > 1):
            yield _other(thing.features[0], best, shares[best])


def _other(feature: CityFeature, mesh: str, area: float) -> Violation:
    return violation(feature, mesh=mesh, area=f"{area:.2f}")


def _shares(block: CityBlock, thing: int, digits: int) -> dict[str, float]:
    """Area in plan (m2) of a city object in each mesh, by its lowest level of detail."""
    shapes = block.shapes
    polygons = np.flatnonzero(shapes.thing == thing)
    level = shapes.lods[polygons][shapes.lods[polygons] >= 0].min(initial=9)
    upward = polygons[(shapes.lods[polygons] == level) & (np.abs(shapes.normals[polygons, 2]) > 0.1)]
    plans = [shapes.plan(polygon, swapped=True) for polygon in upward if shapes.whole[shapes.outer_ring[polygon]]]
    if not plans:
        return {}
    plan = shapely.union_all(shapely.make_valid(np.array(plans, object)))
    parts = {8: 1, 9: 2, 10: 4}[digits]
    west, south, east, north = plan.bounds
    if not (20.0 <= south <= north <= 46.0 and 122.0 <= west <= east <= 154.0):
        return {}
    rows, columns = _ROWS_A_DEGREE * parts, _COLUMNS_A_DEGREE * parts
    shares = {}
    for row in range(int(south * rows), int(north * rows) + 1):
        for column in range(int((west - 100.0) * columns), int((east - 100.0) * columns) + 1):
            cell = shapely.box(100.0 + column / columns, row / rows, 100.0 + (column + 1) / columns,
                               (row + 1) / rows)
            area = shapely.area(shapely.intersection(plan, cell))
            if area > 0.0:
                square = _DEGREE ** 2 * np.cos(np.radians((row + 0.5) / rows))
                shares[regional_mesh_code(row, column, parts)] = float(area * square)
    return shares
