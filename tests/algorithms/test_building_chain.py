"""From points and outlines to models on made-up blocks whose roofs are known, through Processing."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
import shapely.affinity

from tests.solid_files import read_solids
from urbanmap_qgis.buildings.solids.validity import check_solid

EAST, NORTH = -7000.0, -35000.0
GROUND = 3.0


def make_blocks(synthetic):
    """Blocks by name; those without parts stand in the map only."""
    at = lambda x, y, width, depth: synthetic.rectangle(EAST + x, NORTH + y, width, depth)  # noqa: E731
    block, part, flat = synthetic.Block, synthetic.Part, synthetic.flat
    parapet = at(0, 50, 20, 20)
    court = at(0, 100, 24, 24)
    return {
        "box": flat(at(0, 0, 10, 15), 12.30),
        "L": flat(at(40, 0, 20, 20).difference(at(50, 10, 10, 10)), 15.0),
        "two levels": block(at(90, 0, 20, 12), (part(at(90, 0, 10, 12), 10.0), part(at(100, 0, 10, 12), 16.0))),
        "parapet": block(parapet, (part(parapet, 14.0), part(parapet.buffer(-0.5, join_style="mitre"), 13.0))),
        "touching, low": flat(at(40, 50, 12, 12), 9.0),
        "touching, high": flat(at(52, 50, 12, 12), 13.5),
        "one height twice": block(at(90, 50, 30, 10), (part(at(90, 50, 30, 10), 14.0), part(at(100, 50, 10, 10), 8.0))),
        "courtyard": flat(court.difference(at(8, 108, 8, 8)), 11.0),
        "gable": synthetic.gable(EAST + 100, NORTH + 100, 10, 16, 6.0, 9.0),
        "clutter": flat(at(0, 150, 16, 16), 12.0),
        "bare ground": block(at(60, 150, 10, 10)),
        "beyond the survey": block(at(400, 100, 10, 10)),
    }


def make_clutter(synthetic):
    """Trees beside and over the building "clutter", a car, and an antenna on its roof."""
    car = synthetic.tree(EAST + 7, NORTH + 145, 1.5, 4.2, 4.5, 60, 3)
    antenna = np.column_stack([np.full(6, EAST + 8.0), np.full(6, NORTH + 158.0), np.linspace(13, 18, 6)])
    return np.concatenate([synthetic.tree(EAST - 2.5, NORTH + 158, 2.5, 5, 11, 150, 1),
                           synthetic.tree(EAST + 17, NORTH + 160, 3.0, 9, 15, 200, 2), car, antenna])


# name: roof heights (m, one a roof), plan area (m2), volume (m3)
KNOWN = {
    "box": ([12.30], 150.0, 150 * 9.30),
    "L": ([15.0], 300.0, 300 * 12.0),
    "two levels": ([10.0, 16.0], 240.0, 120 * 7.0 + 120 * 13.0),
    "parapet": ([13.0, 14.0], 400.0, 361 * 10.0 + 39 * 11.0),
    "touching, low": ([9.0], 144.0, 144 * 6.0),
    "touching, high": ([13.5], 144.0, 144 * 10.5),
    "one height twice": ([8.0, 14.0, 14.0], 300.0, 200 * 11.0 + 100 * 5.0),
    "courtyard": ([11.0], 576.0 - 64.0, 512 * 8.0),
    "clutter": ([12.0], 256.0, 256 * 9.0),
}
FLAT_GABLE_VOLUME = 160 * (7.5 - GROUND)


def run_chain(folder, clouds, outlines, **more):
    """Results of the whole chain from files."""
    import processing

    return processing.run("urbanmap:buildingsfromals", {
        "POINTS": [str(cloud) for cloud in clouds], "FOOTPRINTS": str(outlines), "OUTPUT": str(folder / "models.gpkg"),
        "OUTPUT_CITYJSON": str(folder / "models.city.json"), "OUTPUT_REPORT": str(folder / "report.html"), **more})


@pytest.fixture(scope="module")
def town(qgis_app, synthetic, make_cloud, save_outlines, tmp_path_factory):
    """The whole chain run once: two point files and Japanese names; results by building name."""
    folder = tmp_path_factory.mktemp("街区 モデル")
    blocks = make_blocks(synthetic)
    scene = synthetic.Scene([block for block in blocks.values() if block.parts], noise=0.02,
                            extra=make_clutter(synthetic))
    points, _ = scene.points()
    half = len(points) // 2
    files = [make_cloud(folder / name, *part.T, number_of_returns=1, return_number=1)
             for name, part in (("点群 東.laz", points[:half]), ("点群 西.las", points[half:]))]
    outlines = save_outlines(folder / "建物 外周.gpkg", [block.outline for block in blocks.values()],
                             {"名称": list(blocks)})
    wanted = {"OUTPUT": "モデル.gpkg", "OUTPUT_SURFACES": "面.gpkg", "OUTPUT_CITYJSON": "都市 模型.city.json",
              "OUTPUT_REPORT": "報告.html", "OUTPUT_MESH": "網.obj", "OUTPUT_MESHES": "三角網.gpkg"}
    results = run_chain(folder, files, outlines, **{name: str(folder / file) for name, file in wanted.items()})
    return SimpleNamespace(folder=folder, results=results, wanted=wanted, blocks=blocks, points=points, files=files,
                           outlines=outlines)


@pytest.fixture(scope="module")
def buildings(town):
    """Rows, solids and attributes of the models by building name."""
    found = rows_of(town.results["OUTPUT"])
    objects = {item.id: item for item in read_solids(town.results["OUTPUT_CITYJSON"])}
    return {row["名称"]: SimpleNamespace(row=row, object=objects[f"building-{row['building_id']}"]) for row in found}


def rows_of(path, layer=None):
    """Attributes and geometry ("wkb") of the rows of a layer, as dictionaries."""
    from qgis.core import NULL, QgsVectorLayer

    opened = QgsVectorLayer(f"{path}|layername={layer}" if layer else str(path), "rows", "ogr")
    assert opened.isValid(), path
    names = [item.name() for item in opened.fields()]
    return [{**{name: None if value == NULL else value for name, value in zip(names, feature.attributes())},
             "wkb": None if feature.geometry().isEmpty() else feature.geometry().asWkb().data()}
            for feature in opened.getFeatures()]


def volume(solid):
    """Volume of a closed solid from the oriented fans of all its rings (Gauss), m3."""
    origin, six_volumes = solid.vertices[0], 0.0
    for face in solid.faces:
        for ring in face:
            corners = solid.vertices[list(ring)] - origin
            six_volumes += np.einsum("j,ij->", corners[0], np.cross(corners[1:-1], corners[2:]))
    return six_volumes / 6


def roof_heights(solids):
    """Height of each connected roof of solids, ascending."""
    heights = []
    for solid in solids:
        levels = {}
        for face, kind in zip(solid.faces, solid.surface_type):
            if kind == "RoofSurface":
                corners = solid.vertices[list(face[0])]
                levels.setdefault(round(float(corners[0, 2]), 3), []).append(shapely.Polygon(corners[:, :2]))
        for level, plans in levels.items():
            heights += [level] * len(shapely.get_parts(shapely.union_all(plans)))
    return sorted(heights)


def same_heights(found, expected):
    """Whether each height is one of the expected, and each of these is there."""
    apart = np.abs(np.subtract.outer(found, expected))
    return (apart.min(axis=0) < 0.05).all() and (apart.min(axis=1) < 0.05).all()


@pytest.mark.parametrize("name", KNOWN)
def test_known_building(buildings, name):
    heights, area, content = KNOWN[name]
    building = buildings[name]
    assert (building.row["status"], building.row["reason"] or "") == ("ok", "")
    assert building.row["area"] == pytest.approx(area, rel=0.01)
    assert building.row["volume"] == pytest.approx(content, rel=0.02)
    assert building.row["base"] == pytest.approx(GROUND, abs=0.05)
    assert sum(map(volume, building.object.solids)) == pytest.approx(building.row["volume"], rel=1e-4)
    assert same_heights(roof_heights(building.object.solids), heights)
    assert building.row["height"] + building.row["base"] == pytest.approx(heights[-1], abs=0.05)


def test_every_solid_is_valid(buildings):
    for name, building in buildings.items():
        assert [str(problem) for solid in building.object.solids for problem in check_solid(solid)] == [], name


def test_gable_is_modelled_with_its_two_planes(buildings):
    row, (solid,) = buildings["gable"].row, buildings["gable"].object.solids
    assert (row["status"], row["lod"], row["roof_type"], row["roofs"]) == ("ok", "2.2", "gable", 2)
    assert row["rmse_z"] < 0.05
    assert row["volume"] == pytest.approx(FLAT_GABLE_VOLUME, rel=0.01)
    planes = [solid.vertices[list(face[0])] for face, kind in zip(solid.faces, solid.surface_type)
              if kind == "RoofSurface"]
    assert len(planes) == 2
    assert [plane[:, 2].min() for plane in planes] == pytest.approx([6.0, 6.0], abs=0.06)
    ridges = [{tuple(corner) for corner in plane if corner[2] > 8.0} for plane in planes]
    assert ridges[0] == ridges[1] and len(ridges[0]) == 2  # both planes have the very same ridge
    assert all(corner[2] == pytest.approx(9.0, abs=0.05) for corner in ridges[0])


def test_gable_becomes_level_roofs_of_its_volume(town, tmp_path):
    results = run_chain(tmp_path, town.files, town.outlines, ROOFS="levels")
    row, = (row for row in rows_of(results["OUTPUT"]) if row["名称"] == "gable")
    objects = {item.id: item for item in read_solids(results["OUTPUT_CITYJSON"])}
    assert (row["status"], row["lod"]) == ("ok", "1.3")
    assert row["roofs"] >= 2
    assert row["rmse_z"] < 0.6
    assert row["area"] == pytest.approx(160.0, rel=0.01)
    assert row["volume"] == pytest.approx(FLAT_GABLE_VOLUME, rel=0.02)
    heights = roof_heights(objects[f"building-{row['building_id']}"].solids)
    assert heights[0] > 6.0
    assert heights[-1] < 9.0


@pytest.mark.parametrize("name", ["bare ground", "beyond the survey"])
def test_building_without_points_keeps_its_row(buildings, name):
    building = buildings[name]
    assert building.row["wkb"] is None
    assert building.row["status"] == "not modelled"
    assert building.row["reason"] == "there are no points of a building in its outline"
    assert building.object.solids == ()
    assert building.object.attributes["status"] == "not modelled"


def test_touching_buildings_share_their_wall_without_overlap(town):
    plans = {}
    for row in rows_of(town.results["OUTPUT_SURFACES"]):
        if row["surface_type"] == "ground":
            plans.setdefault(row["building_id"], []).append(shapely.force_2d(shapely.from_wkb(row["wkb"])))
    low, high = (shapely.union_all(plans[list(town.blocks).index(name) + 1])
                 for name in ("touching, low", "touching, high"))
    assert low.intersection(high).area < 0.1
    assert low.distance(high) < 0.01


def test_every_declared_output_is_there(town):
    from qgis.core import QgsApplication

    algorithm = QgsApplication.processingRegistry().algorithmById("urbanmap:buildingsfromals")
    assert set(town.results) == {item.name() for item in algorithm.outputDefinitions()}
    assert {town.results[name] for name in town.wanted} == {str(town.folder / file) for file in town.wanted.values()}
    assert (town.results["BUILDINGS"], town.results["MODELLED"]) == (12, 10)
    assert 0.0 < town.results["RMSE_Z95"] < 0.2
    mesh = (town.folder / "網.obj").read_text(encoding="utf-8")
    assert sum(line.startswith(("o ", "g ")) for line in mesh.splitlines()) >= 10
    report = (town.folder / "報告.html").read_text(encoding="utf-8")
    assert "no points of a building" in report and "</html>" in report
    document = json.loads((town.folder / "都市 模型.city.json").read_text(encoding="utf-8"))
    assert document["metadata"]["referenceSystem"].endswith("/6677")
    assert len(document["CityObjects"]) == 12
    assert not [path.name for path in town.folder.iterdir() if path.name.startswith(".")]


@pytest.mark.parametrize("output", ["OUTPUT", "OUTPUT_SURFACES"])
def test_layers_carry_crs_and_style(town, output):
    from qgis.core import QgsVectorLayer

    layer = QgsVectorLayer(town.results[output], "result", "ogr")
    assert layer.crs().authid() == "EPSG:6677"
    assert layer.listStylesInDatabase()[0] == 1


def solids_of(path):
    """What the models of a CityJSON file are, by building id: vertices, faces, types, and figures.

    The order of points may change the last binary digit of a mean, so figures are taken to the micrometre.
    """
    return {item.id: ([(solid.vertices.tolist(), solid.faces, solid.surface_type) for solid in item.solids],
                      {name: round(value, 6) if isinstance(value, float) else value
                       for name, value in item.attributes.items()}) for item in read_solids(path)}


def test_the_same_input_gives_the_same_bytes(town, tmp_path):
    again = run_chain(tmp_path, town.files, town.outlines)
    first, second = (Path(results["OUTPUT_CITYJSON"]).read_bytes() for results in (town.results, again))
    assert first == second
    assert rows_of(town.results["OUTPUT"]) == rows_of(again["OUTPUT"])


def test_order_and_cut_of_the_input_change_no_model(town, save_outlines, make_cloud, tmp_path):
    """Outlines from last to first, points in another order and cut into other files of other kinds."""
    numbers = list(range(1, len(town.blocks) + 1))
    outlines = [block.outline for block in town.blocks.values()]
    save_outlines(tmp_path / "o.gpkg", outlines[::-1], {"building_id": numbers[::-1], "名称": list(town.blocks)[::-1]})
    points = town.points[np.random.default_rng(5).permutation(len(town.points))]
    cuts = np.split(points, [len(points) // 5, len(points) // 2])
    clouds = [make_cloud(tmp_path / f"{place}.{suffix}", *part.T, point_format=kind, return_number=1,
                         number_of_returns=1) for place, (part, suffix, kind) in
              enumerate(zip(cuts, ("las", "laz", "laz"), (1, 6, 7)))]
    other = run_chain(tmp_path, clouds, tmp_path / "o.gpkg")
    assert solids_of(other["OUTPUT_CITYJSON"]) == solids_of(town.results["OUTPUT_CITYJSON"])
    assert [row["building_id"] for row in rows_of(other["OUTPUT"])] == numbers[::-1]


def test_two_workers_change_nothing(town, tmp_path, monkeypatch, plugin):
    """Two at work, a few buildings at once, and points that do not fit into memory."""
    monkeypatch.setattr(plugin("urbanmap_qgis.buildings.building_points"), "BUILDINGS_AT_ONCE", 3)
    monkeypatch.setattr(plugin("urbanmap_qgis.io.points.point_buckets").PointBuckets.__init__, "__defaults__", (0,))
    monkeypatch.setattr(plugin("urbanmap_qgis.io.points.pointcloud").iter_chunks, "__defaults__", (
        *plugin("urbanmap_qgis.io.points.pointcloud").iter_chunks.__defaults__[:-1], 20_000))
    workers = plugin("algorithms.framework.running.workers")
    monkeypatch.setattr(workers, "_processes", workers._in_window)
    again = run_chain(tmp_path, town.files, town.outlines, WORKERS=2)
    assert solids_of(again["OUTPUT_CITYJSON"]) == solids_of(town.results["OUTPUT_CITYJSON"])


def test_turned_and_moved_town_has_the_same_roofs(town, synthetic, save_outlines, make_cloud, tmp_path):
    """By 30 degrees, and from near the origin of the zone to 40 km away."""
    shift = np.array([-EAST, -NORTH, 0.0])
    place = (30.0, -41_234.56, 43_210.98)
    points = synthetic.turned(town.points + shift, *place)
    outlines = [synthetic.turned_plan(shapely.affinity.translate(block.outline, -EAST, -NORTH), *place)
                for block in town.blocks.values()]
    save_outlines(tmp_path / "o.gpkg", outlines, {"名称": list(town.blocks)})
    cloud = make_cloud(tmp_path / "turned.laz", *points.T, return_number=1, number_of_returns=1)
    turned = run_chain(tmp_path, [cloud], tmp_path / "o.gpkg")
    rows = {row["名称"]: row for row in rows_of(turned["OUTPUT"])}
    solids = {item.id: item.solids for item in read_solids(turned["OUTPUT_CITYJSON"])}
    for name, (heights, area, content) in KNOWN.items():
        found = solids[f"building-{rows[name]['building_id']}"]
        assert rows[name]["status"] == "ok", name
        assert same_heights(roof_heights(found), heights), name
        assert rows[name]["area"] == pytest.approx(area, rel=0.01), name
        assert rows[name]["volume"] == pytest.approx(content, rel=0.02), name
        assert [str(problem) for solid in found for problem in check_solid(solid)] == [], name


def test_the_papers_method_switches_the_whole_chain(town, tmp_path):
    results = run_chain(tmp_path, town.files, town.outlines, METHOD="paper")
    rows = {row["名称"]: row for row in rows_of(results["OUTPUT"])}
    assert {name: row["roofs"] for name, row in rows.items() if name not in ("bare ground", "beyond the survey")} == {
        "box": 1, "L": 1, "two levels": 2, "parapet": 1, "touching, low": 1, "touching, high": 1, "one height twice": 2,
        "courtyard": 1, "gable": 0, "clutter": 1}
    assert rows["parapet"]["height"] == pytest.approx(14.0 - GROUND, abs=0.15)  # the highest point, on the parapet
    assert rows["clutter"]["height"] == pytest.approx(18.0 - GROUND, abs=0.15)  # that of the antenna
    assert rows["gable"]["status"] == "not modelled"
