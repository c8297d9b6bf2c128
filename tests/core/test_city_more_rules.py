"""Rules of city models on lines, curves, triangles, composite surfaces, openings, rooms and roads: one fault each."""

from __future__ import annotations

import pytest

from tests.core.test_city_check import (
    BOX,
    OUTLINE,
    UUID,
    area,
    building,
    lod0,
    members,
    place,
    polygon,
    quality,
    referring,
    road,
    rules_of,
    solid,
    surfaces,
    written,
)


def line(*corners) -> str:
    text = " ".join(place(*corner) for corner in corners)
    return f"<gml:LineString><gml:posList>{text}</gml:posList></gml:LineString>"


def curve(*lines: str) -> str:
    return "<gml:CompositeCurve>" + "".join(f"<gml:curveMember>{one}</gml:curveMember>" for one in lines) \
        + "</gml:CompositeCurve>"


def with_curve(tmp_path, geometry: str):
    own = (f"<bldg:lod2MultiCurve><gml:MultiCurve><gml:curveMember>{geometry}</gml:curveMember></gml:MultiCurve>"
           "</bldg:lod2MultiCurve>")
    return written(tmp_path, building(geometry=lod0(OUTLINE) + own, about=quality("02")))


@pytest.mark.parametrize(("corners", "told"), [
    (((0, 0, 0), (0, 1, 0), (1, 1, 0)), []),
    (((0, 0, 0), (0, 1, 0), (1, 1, 0), (0, 0, 0)), []),  # closed: begin and end may meet
    (((0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)), ["L08"]),  # crosses itself
    (((0, 0, 0), (0, 1, 0), (1, 1, 0), (0, 0.5, 0), (1, 0, 0)), ["L08"]),  # touches itself
])
def test_lines_neither_cross_nor_touch_themselves(tmp_path, corners, told):
    assert [rule for rule in rules_of(with_curve(tmp_path, line(*corners))) if rule != "C04"] == told


def test_curves_hang_together(tmp_path):
    first, second, away = line((0, 0, 0), (0, 1, 0)), line((0, 1, 0), (1, 1, 0)), line((0, 1.5, 0), (1, 1, 0))
    told = [[rule for rule in rules_of(with_curve(tmp_path, curve(first, other))) if rule != "C04"]
            for other in (second, away)]
    assert told == [[], ["L17"]]
    bent = line((0, 0, 0), (0, 0.5, 0), (0, 1, 0))  # its end meets the next line's begin, the corner before does not
    assert [rule for rule in rules_of(with_curve(tmp_path, curve(bent, second))) if rule != "C04"] == []


def triangle(*corners, closed: bool = True) -> str:
    text = " ".join(place(*corner) for corner in (*corners, *corners[:1] * closed))
    return (f"<gml:Triangle><gml:exterior><gml:LinearRing><gml:posList>{text}</gml:posList></gml:LinearRing>"
            "</gml:exterior></gml:Triangle>")


def relief(*triangles: str) -> str:
    return (f'<dem:ReliefFeature xmlns:dem="http://www.opengis.net/citygml/relief/2.0" gml:id="dem_{UUID.format(1)}">'
            "<core:creationDate>2026-04-01</core:creationDate><dem:lod>1</dem:lod><dem:reliefComponent><dem:TINRelief "
            'gml:id="t"><dem:lod>1</dem:lod><dem:tin><gml:TriangulatedSurface><gml:trianglePatches>'
            + "".join(triangles) + "</gml:trianglePatches></gml:TriangulatedSurface></dem:tin></dem:TINRelief>"
            "</dem:reliefComponent></dem:ReliefFeature>")


def tin_rules(tmp_path, *triangles: str) -> list[str]:
    path = written(tmp_path, relief(*triangles), name="input.gml", theme="dem")
    return [rule for rule in rules_of(path) if rule in ("L09", "L15", "L16")]


def test_triangles_have_four_places_and_their_surface_a_border(tmp_path):
    a, b, c, d = (0, 0, 0), (0, 1, 0), (1, 0, 0), (0.3, 0.3, 5)
    assert tin_rules(tmp_path, triangle(a, b, c), triangle(b, (1, 1, 0), c)) == []
    assert "L15" in tin_rules(tmp_path, triangle(a, b, (1, 1, 0), c))
    assert "L15" in tin_rules(tmp_path, triangle(a, b, c, closed=False))
    assert tin_rules(tmp_path, triangle(a, c, b), triangle(a, b, d), triangle(b, c, d), triangle(c, a, d)) == ["L16"]


def test_composite_surfaces_are_one_piece_without_overlap(tmp_path):
    def told(*faces: str) -> list[str]:
        composite = f"<gml:CompositeSurface>{members(faces)}</gml:CompositeSurface>"
        path = written(tmp_path, building(geometry=lod0(composite), about=quality("0")))
        return [rule for rule in rules_of(path) if rule.startswith("L")]

    beside = polygon((0, 1, 0), (0, 2, 0), (1, 2, 0), (1, 1, 0))
    away = polygon((0, 3, 0), (0, 4, 0), (1, 4, 0), (1, 3, 0))
    assert told(OUTLINE, beside) == []
    assert told(OUTLINE, OUTLINE) == ["L18"]
    assert told(OUTLINE, beside, away) == ["L18"]
    above = polygon((0, 0, 9), (0, 1, 9), (1, 1, 9), (1, 0, 9))
    assert told(OUTLINE, above) == ["L18"]  # over each other in plan, but apart
    half = polygon((0, 0.5, 0), (0, 1.5, 0), (1, 1.5, 0), (1, 0.5, 0))
    assert told(OUTLINE, half) == ["L18"]
    within = polygon((0, 0, 0), (0, 0.5, 0), (0.5, 0.5, 0), (0.5, 0, 0))  # touches along parts of sides
    rest = polygon((0, 0.5, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0), (0.5, 0, 0), (0.5, 0.5, 0))
    assert told(within, rest) == []


def test_a_place_twice_in_a_row_is_told_of_rings_and_of_distances(tmp_path):
    twice = polygon((0, 0, 0), (0, 1, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0))
    path = written(tmp_path, building(geometry=lod0(twice), about=quality("0")))
    assert rules_of(path) == ["L07", "L09"]


def test_a_code_without_text_is_none_of_its_list(tmp_path):
    empty = '<bldg:class codeSpace="../../codelists/Building_class.xml"></bldg:class>'
    assert rules_of(written(tmp_path, building(own=empty))) == ["L04"]


REFERENCES = {
    "surface to ring": (f"<bldg:lod1MultiSurface>{surfaces('*')}</bldg:lod1MultiSurface>", "ring", ["C04", "T03"]),
    "surface to polygon": (f"<bldg:lod1MultiSurface>{surfaces('*')}</bldg:lod1MultiSurface>", "face", ["C04"]),
    "solid to polygon": ('<bldg:lod2Solid xlink:href="#face"/>', "face", ["T03"]),
    "surface to feature": ('<bldg:boundedBy xlink:href="#w"/>', "w", []),
    "surface to part": ('<bldg:boundedBy xlink:href="#p"/>', "p", ["T03"]),
    "part to surface": ('<bldg:consistsOfBuildingPart xlink:href="#w"/>', "w", ["T03"]),
    "part to part": ('<bldg:consistsOfBuildingPart xlink:href="#p"/>', "p", []),
}


@pytest.mark.parametrize("case", sorted(REFERENCES))
def test_properties_refer_to_what_they_take(tmp_path, case):
    text, target, told = REFERENCES[case]
    own = text.replace("<gml:surfaceMember>*</gml:surfaceMember>", f'<gml:surfaceMember xlink:href="#{target}"/>')
    face = polygon((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0), identifier="face").replace(
        "<gml:LinearRing>", '<gml:LinearRing gml:id="ring">')
    held = (f'<bldg:boundedBy><bldg:WallSurface gml:id="w"><bldg:lod2MultiSurface>{surfaces(face)}'
            "</bldg:lod2MultiSurface></bldg:WallSurface></bldg:boundedBy><bldg:consistsOfBuildingPart>"
            '<bldg:BuildingPart gml:id="p"/></bldg:consistsOfBuildingPart>')
    assert rules_of(written(tmp_path, building(own=own, geometry=held, about=quality("12")))) == told


@pytest.mark.parametrize(("north", "east", "told"), [(0.0, 1.0, []), (0.5, 1.0, []), (1.0, 1.0, ["L-bldg-02"])])
def test_parts_that_meet_at_a_corner_share_no_boundary(tmp_path, north, east, told):
    def part(number: int, at: tuple[float, float]) -> str:
        corners = [(at[0] + a, at[1] + b) for a, b in ((0, 0), (0, 1), (1, 1), (1, 0))]
        walls = [polygon((*a, 0), (*b, 0), (*b, 9), (*a, 9)) for a, b in zip(corners, (*corners[1:], corners[0]))]
        faces = [polygon(*((*corner, 0) for corner in corners[::-1])), polygon(*((*corner, 9) for corner in corners))]
        return (f'<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id="p{number}"><bldg:lod2Solid>'
                f"{solid([*faces, *walls])}</bldg:lod2Solid></bldg:BuildingPart></bldg:consistsOfBuildingPart>")

    path = written(tmp_path, building(own=part(1, (0.0, 0.0)) + part(2, (north, east)), about=quality("012")))
    assert [rule for rule in rules_of(path) if rule != "L-bldg-06"] == told


def test_faces_of_another_building_are_none_of_its_surfaces(tmp_path):
    faces = [face.replace("<gml:Polygon>", f'<gml:Polygon gml:id="f{k}">') for k, face in enumerate(BOX)]
    held = "".join(f'<bldg:boundedBy><bldg:WallSurface gml:id="s{k}"><bldg:lod2MultiSurface>{surfaces(face)}'
                   "</bldg:lod2MultiSurface></bldg:WallSurface></bldg:boundedBy>" for k, face in enumerate(faces))
    shell = solid(BOX).replace(members(BOX), "".join(f'<gml:surfaceMember xlink:href="#f{k}"/>' for k in range(6)))
    other = building(1, geometry=held, about=quality("2"))
    one = building(2, geometry=f"<bldg:lod2Solid>{shell}</bldg:lod2Solid>", about=quality("2"))
    path = written(tmp_path, other, one)
    assert rules_of(path) == ["L-bldg-06"] * 6


WALL = polygon((0, 0, 0), (0, 1, 0), (0, 1, 10), (0, 0, 10), identifier="w")


def opening(level: int, *corners, wall: str = WALL) -> str:
    """A building of one wall with a window."""
    window = (f'<bldg:opening><bldg:Window gml:id="o"><bldg:lod{level}MultiSurface>{surfaces(polygon(*corners))}'
              f"</bldg:lod{level}MultiSurface></bldg:Window></bldg:opening>")
    return (f'<bldg:boundedBy><bldg:WallSurface gml:id="s"><bldg:lod{level}MultiSurface>{surfaces(wall)}'
            f"</bldg:lod{level}MultiSurface>{window}</bldg:WallSurface></bldg:boundedBy>")


def test_openings_lie_in_their_surfaces(tmp_path):
    def told(east: float) -> list[str]:
        shape = opening(3, (0, east, 1), (0, east + 0.3, 1), (0, east + 0.3, 3), (0, east, 3))
        return rules_of(written(tmp_path, building(geometry=shape, about=quality("3"))))

    assert told(0.4) == [] and told(0.9) == ["L-bldg-03"]


def test_openings_of_lod4_share_a_side_with_their_surface(tmp_path):
    hole = ((0, 0.4, 1), (0, 0.7, 1), (0, 0.7, 3), (0, 0.4, 3))
    holed = polygon((0, 0, 0), (0, 1, 0), (0, 1, 10), (0, 0, 10), holes=[hole[::-1]], identifier="w")

    def told(wall: str) -> list[str]:
        shape = opening(4, *hole, wall=wall)
        return rules_of(written(tmp_path, building(geometry=shape, about=quality("4"))))

    assert told(holed) == [] and told(WALL) == ["L-bldg-07"]


def bounded(faces: list[str], kind: str, mark: str, flipped: bool = False, own: tuple[int, ...] = ()) -> str:
    """A solid of LOD4 that refers to boundary surfaces; the faces of the numbers `own` are in the solid itself."""
    named = [face.replace("<gml:Polygon>", f'<gml:Polygon gml:id="{mark}{k}">') for k, face in enumerate(faces)]
    link = '<gml:surfaceMember xlink:href="#{}"/>' if not flipped else (
        '<gml:surfaceMember><gml:OrientableSurface orientation="-"><gml:baseSurface xlink:href="#{}"/>'
        "</gml:OrientableSurface></gml:surfaceMember>")
    shell = "".join(members([face]) if k in own else link.format(f"{mark}{k}") for k, face in enumerate(faces))
    held = "".join(f'<bldg:boundedBy><bldg:{kind} gml:id="{mark}s{k}"><bldg:lod4MultiSurface>{surfaces(face)}'
                   f"</bldg:lod4MultiSurface></bldg:{kind}></bldg:boundedBy>" for k, face in enumerate(named)
                   if k not in own)
    return ("<bldg:lod4Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + shell
            + "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod4Solid>" + held)


def test_faces_of_lod4_solids_are_those_of_their_surfaces(tmp_path):
    def told(own: tuple[int, ...]) -> list[str]:
        shape = bounded(BOX, "WallSurface", "f", own=own)
        return rules_of(written(tmp_path, building(geometry=shape, about=quality("4"))))

    assert told(()) == [] and told((2, 3)) == ["L-bldg-08"] * 2
    assert rules_of(written(tmp_path, building(geometry=as_surfaces(bounded(BOX, "WallSurface", "f", own=(2,))),
                                               about=quality("4")))) == ["L-bldg-08"]


def as_surfaces(shape: str) -> str:
    """A solid of LOD4 as a multi-surface."""
    for name in ("<bldg:lod4Solid>", "</bldg:lod4Solid>"):
        shape = shape.replace(name, name.replace("Solid", "MultiSurface"), 1)
    head, _, rest = shape.partition("<gml:Solid><gml:exterior><gml:CompositeSurface>")
    inner, _, tail = rest.partition("</gml:CompositeSurface></gml:exterior></gml:Solid>")
    return f"{head}<gml:MultiSurface>{inner}</gml:MultiSurface>{tail}"


def turned(face: str) -> str:
    """A polygon the other way round."""
    head, rest = face.split("<gml:posList>")
    text, tail = rest.split("</gml:posList>")
    values = text.split()
    places = [" ".join(values[k:k + 3]) for k in range(0, len(values), 3)]
    return f"{head}<gml:posList>{' '.join(places[::-1])}</gml:posList>{tail}"


def room(faces: list[str], flipped: bool = True, own: tuple[int, ...] = ()) -> str:
    inward = [turned(face) for face in faces] if flipped else faces
    return ('<bldg:interiorRoom><bldg:Room gml:id="r">' + bounded(inward, "InteriorWallSurface", "r", flipped, own)
            + "</bldg:Room></bldg:interiorRoom>")


def inner_box(east: float = 0.2, top: float = 9.0) -> list[str]:
    """Faces of a box within `BOX`."""
    low, high = (0.2, east), (0.8, east + 0.6)
    corners = ((low[0], low[1]), (low[0], high[1]), (high[0], high[1]), (high[0], low[1]))
    walls = [polygon((*a, 1), (*b, 1), (*b, top), (*a, top)) for a, b in zip(corners, (*corners[1:], corners[0]))]
    return [polygon(*((*corner, 1) for corner in corners[::-1])), polygon(*((*corner, top) for corner in corners)),
            *walls]


def house_with(tmp_path, inside: str):
    shape = bounded(BOX, "WallSurface", "f") + inside
    return rules_of(written(tmp_path, building(geometry=shape, about=quality("4"))))


def test_rooms_refer_to_turned_surfaces_of_their_own(tmp_path):
    assert house_with(tmp_path, room(inner_box())) == []
    told = house_with(tmp_path, room(inner_box(), flipped=False))
    assert sorted(set(told)) == ["L-bldg-10", "L-bldg-11"] and len(told) == 12
    told = house_with(tmp_path, room(inner_box(), own=(0,)))
    assert {"L-bldg-09", "L-bldg-11"} <= set(told)
    told = house_with(tmp_path, as_surfaces(room(inner_box(), flipped=False)))
    assert [rule for rule in told if rule != "C04"] == ["L-bldg-11"] * 6
    assert "L-bldg-11" not in house_with(tmp_path, as_surfaces(room(inner_box())))


def test_surfaces_of_a_building_look_outwards(tmp_path):
    shape = bounded([turned(face) for face in BOX], "WallSurface", "f", flipped=True)
    assert rules_of(written(tmp_path, building(geometry=shape, about=quality("4")))) == ["L-bldg-10"] * 6


@pytest.mark.parametrize(("east", "top"), [(0.6, 9.0), (0.2, 12.0)])
def test_what_is_inside_lies_inside(tmp_path, east, top):
    assert set(house_with(tmp_path, room(inner_box(east, top)))) == {"L-bldg-12"}


def test_roads_that_overlap_are_told_and_neighbours_are_not(tmp_path):
    def told(east: float) -> list[str]:
        roads = [road(1, area(1, 0.0), own=referring(1)), road(2, area(2, east), own=referring(2))]
        own = "<tran:lod2MultiSurface>{}</tran:lod2MultiSurface>"
        faces = [polygon((0, e, 0), (0, e + 1, 0), (1, e + 1, 0), (1, e, 0)) for e in (0.0, east)]
        both = [text.replace("<tran:lod3MultiSurface><gml:MultiSurface><gml:surfaceMember xlink", own.format(
            surfaces(face)) + "<tran:lod3MultiSurface><gml:MultiSurface><gml:surfaceMember xlink")
            for text, face in zip(roads, faces)]
        return [rule for rule in rules_of(written(tmp_path, *both, name="input.gml", theme="tran"))
                if rule.startswith("L-tran-01")]

    assert told(1.0) == [] and told(0.5) == ["L-tran-01"] * 2


def test_the_block_about_parts_is_no_solid_beside_them(tmp_path):
    from tests.city_models import gable_house
    from urbanmap_qgis.buildings.city_objects import BuildingSource, city_objects
    from urbanmap_qgis.citymodel.citygml.whole_block import with_whole_block
    from urbanmap_qgis.citymodel.model import SOLID
    from urbanmap_qgis.citymodel.solids import outer_shells, solid_rows, whole_metres

    (item, _), = city_objects([BuildingSource("b1", {}, [gable_house(), gable_house((8, 0, 0), 5.0, 6.0)])])
    whole, lost = with_whole_block(item)
    assert not lost and [shape.lod for shape in whole.shapes if shape.kind == SOLID] == ["1.2"]
    ((_, solids),) = solid_rows([whole])
    assert [shape.lod for shape in solids] == ["2.2", "2.2"] and len(outer_shells(whole)) == 2
    block = next(shape for shape in whole.shapes if shape.lod == "1.2").shells[0]
    assert len(block) == 2 + len(block[0].rings[0]) and whole_metres([block])[2] == 20.0


def test_parts_of_our_own_models_have_no_lod1(tmp_path):
    from tests.city_models import gable_house
    from urbanmap_qgis.buildings.city_objects import BuildingSource, city_objects
    from urbanmap_qgis.citymodel.citygml.plateau import PlateauDelivery, with_plateau_attributes
    from urbanmap_qgis.citymodel.citygml.writer import write_citygml
    from urbanmap_qgis.citymodel.model import CityModel, CityReference
    from urbanmap_qgis.progress import Progress

    for step, blocks in ((8.0, 1), (20.0, 0)):
        sources = [BuildingSource("b1", {}, [gable_house(), gable_house((step, 0, 0), 5.0, 6.0)])]
        delivery = PlateauDelivery(city_code="13101", created="2026-04-01")
        items = [with_plateau_attributes(item, 1, delivery)
                 for item, _ in city_objects(sources)]
        folder, said = tmp_path / str(blocks), []
        write_citygml(folder, CityModel(CityReference("", 6677, False, "JGD2011"), items), Progress(warn=said.append),
                      lists=delivery.lists)
        found = rules_of(folder)
        assert [rule for rule in found if not (rule == "L-bldg-02" and not blocks)] == []
        written_text = next(folder.rglob("*.gml")).read_text(encoding="utf-8")
        assert written_text.count("<bldg:lod1Solid>") == blocks and "CompositeSolid" not in written_text
        assert any("no LOD1" in text for text in said) == (not blocks)
