"""The building stages over files: segmentation, roofs, polygons, models, on blocks with exact truth."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings import segmentation
from urbanmap_qgis.buildings.base_height import outline_ground
from urbanmap_qgis.buildings.building_model import RoofInput, model_building
from urbanmap_qgis.buildings.model_stage import build_models
from urbanmap_qgis.buildings.model_status import BLOCK, GROUND_UNKNOWN, NOT_MODELLED, OK
from urbanmap_qgis.buildings.model_surfaces import roof_cells
from urbanmap_qgis.buildings.model_table import COLUMNS, model_columns, write_model_report
from urbanmap_qgis.buildings.outlines.footprint import Footprints, clean_footprints
from urbanmap_qgis.buildings.polygon_stage import cloud_roof_polygons
from urbanmap_qgis.buildings.roof_stage import segment_cloud_roofs
from urbanmap_qgis.buildings.segmentation import segment_buildings
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.errors import Cancelled, InputError, trouble_words
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.settings.buildings import PolygonParameters, SegmentationParameters

X0, Y0, GROUND = -6900.0, -34200.0, 20.0
ROOFS = {1: [((0, 0, 15, 12), 29.0)], 2: [((15, 0, 27, 12), 33.5)],
         3: [((50, 0, 70, 14), 31.0), ((50, 14, 70, 28), 37.0)], 4: [((50, 50, 55, 54), 23.0)]}
OUTLINES = {1: (0, 0, 15, 12), 2: (15, 0, 27, 12), 3: (50, 0, 70, 28), 4: (50, 50, 55, 54), 5: (0, 50, 8, 58)}


def scene(classified: bool, density: float = 9.0, seed: int = 5):
    """Points (n, 3) and classes of flat ground, the roofs above and two trees; outlines from building 5 are empty."""
    rng = np.random.default_rng(seed)
    count = int(110 * 90 * density)
    x, y = rng.uniform(-20, 90, count), rng.uniform(-15, 75, count)
    z, classes = np.full(count, GROUND), np.full(count, 2)
    for roofs in ROOFS.values():
        for (x_min, y_min, x_max, y_max), height in roofs:
            inside = (x > x_min) & (x < x_max) & (y > y_min) & (y < y_max)
            z[inside], classes[inside] = height, 6
    for tree_x, tree_y in ((-4.0, 6.0), (76.0, 20.0)):
        crown = (np.hypot(x - tree_x, y - tree_y) < 3.5) & (classes == 2)
        z[crown], classes[crown] = GROUND + rng.uniform(1.0, 9.0, crown.sum()), 5
    z = z + rng.normal(0, 0.03, count)
    return x + X0, y + Y0, z, (classes if classified else np.zeros(count, int))


@pytest.fixture(scope="module")
def footprints():
    return clean_footprints(np.array([shapely.box(x0 + X0, y0 + Y0, x1 + X0, y1 + Y0)
                                      for x0, y0, x1, y1 in OUTLINES.values()], dtype=object))


@pytest.fixture(scope="module", params=[True, False], ids=["classified", "unclassified"])
def chain(request, tmp_path_factory, make_cloud, footprints):
    folder = tmp_path_factory.mktemp("鎖")
    x, y, z, classes = scene(request.param)
    path = make_cloud(folder / "cloud.laz", x, y, z, classification=classes)
    return run_chain(path, footprints, folder)


def run_chain(path, footprints, folder, executor=None):
    found = segment_buildings(open_cloud([path]), footprints, folder / "b.laz", executor=executor)
    placed = Footprints(footprints.ids, found.outlines, footprints.notes)
    roofs = segment_cloud_roofs(open_cloud([folder / "b.laz"]), placed, folder / "r.laz", ground=found.ground,
                                executor=executor)
    drawn = cloud_roof_polygons(open_cloud([folder / "r.laz"]), placed, PolygonParameters(roofs="levels"),
                                executor)
    table = RoofInput(np.array(drawn.polygon, object), np.array(drawn.building_id), np.array(drawn.roof_id),
                      np.array(drawn.height), np.array(drawn.status, object))
    models = build_models(placed, table, found.ground, open_cloud([folder / "r.laz"]), executor)
    return found, roofs, drawn, models


def test_every_outline_gets_its_points_and_its_ground(chain):
    found, *_ = chain
    assert found.status.tolist() == ["ok", "ok", "ok", "ok", "no points"]
    assert np.abs(found.ground[:4] - GROUND).max() < 0.15
    assert found.density[:3] == pytest.approx([9, 9, 9], rel=0.15)
    assert np.abs(np.column_stack([found.shift_x, found.shift_y])).max() < 0.3


def test_roofs_lie_at_their_heights(chain):
    _, roofs, _, models = chain
    for building, parts in ROOFS.items():
        heights = sorted(roofs.height[roofs.building_id == building])
        assert heights == pytest.approx(sorted(height for _, height in parts), abs=0.05), building
    assert [model.roofs for model in models] == [1, 1, 2, 1, 0]


def test_models_are_closed_valid_and_of_the_right_volume(chain):
    *_, models = chain
    for model, (building, parts) in zip(models, ROOFS.items()):
        assert model.status == OK and model.fit.rmse_z < 0.06 and model.fit.coverage > 0.9
        assert not [problem for solid in model.solids for problem in check_solid(solid)]
        true = sum((x1 - x0) * (y1 - y0) * (height - GROUND) for (x0, y0, x1, y1), height in parts)
        made = sum(cell.polygon.area * (cell.height - model.base) for cell in roof_cells(model.solids))
        assert made == pytest.approx(true, rel=0.05), building
    assert models[4].status == NOT_MODELLED and models[4].reason and not models[4].solids


@pytest.mark.slow
def test_workers_and_cuts_change_nothing(tmp_path, make_cloud, footprints, monkeypatch):
    path = make_cloud(tmp_path / "c.laz", *scene(False)[:3])
    one = run_chain(path, footprints, tmp_path)
    with ThreadPoolExecutor(2) as executor:
        two = run_chain(path, footprints, tmp_path, executor)
    assert np.array_equal(model_columns(one[3])["volume"], model_columns(two[3])["volume"], equal_nan=True)
    monkeypatch.setattr("urbanmap_qgis.io.points.point_buckets.MEMORY_LIMIT", 0)
    monkeypatch.setattr("urbanmap_qgis.buildings.building_points.BUILDINGS_AT_ONCE", 1)
    three = run_chain(path, footprints, tmp_path)
    for first, third in zip(one[3][:4], three[3][:4]):
        assert np.array_equal(first.solids[0].vertices, third.solids[0].vertices)


def test_small_tiles_find_the_same_owners(tmp_path, make_cloud, footprints, monkeypatch):
    path = make_cloud(tmp_path / "c.laz", *scene(True)[:3], classification=scene(True)[3])
    still = SegmentationParameters(maximum_displacement=0)
    whole = segment_buildings(open_cloud([path]), footprints, tmp_path / "w.laz", still)
    monkeypatch.setattr(segmentation, "TILE_SIDE", (40.0, 40.0))
    tiled = segment_buildings(open_cloud([path]), footprints, tmp_path / "t.laz", still)
    assert np.array_equal(whole.points, tiled.points) and np.array_equal(whole.status, tiled.status)
    keys = ("x", "y", "building_id")
    sort = [np.lexsort(tuple(read_all(open_cloud([tmp_path / name]), keys).values())) for name in ("w.laz", "t.laz")]
    both = [read_all(open_cloud([tmp_path / name]), keys) for name in ("w.laz", "t.laz")]
    for key in keys:
        assert np.array_equal(both[0][key][sort[0]], both[1][key][sort[1]])


def test_cancelling_leaves_no_file(tmp_path, make_cloud, footprints):
    path = make_cloud(tmp_path / "c.laz", *scene(False)[:3])
    with pytest.raises(Cancelled):
        segment_buildings(open_cloud([path]), footprints, tmp_path / "b.laz", progress=Progress(cancelled=lambda: True))
    assert [item.name for item in tmp_path.iterdir()] == ["c.laz"]


def test_no_overlap_is_said(tmp_path, make_cloud, footprints):
    path = make_cloud(tmp_path / "far.laz", [1e5, 1e5 + 1], [1e5, 1e5], [1, 1])
    with pytest.raises(InputError, match="do not overlap"):
        segment_buildings(open_cloud([path]), footprints, tmp_path / "b.laz")


def test_the_papers_polygons_and_heights_are_there_as_options(tmp_path, make_cloud, footprints):
    x, y, z, classes = scene(True)
    path = make_cloud(tmp_path / "c.laz", x, y, z, classification=classes)
    run_chain(path, footprints, tmp_path)
    cloud = open_cloud([tmp_path / "r.laz"])
    paper = cloud_roof_polygons(cloud, footprints, PolygonParameters("paper", height="maximum"))
    assert [sum(np.array(paper.building_id) == number) for number in (1, 2, 3)] == [1, 1, 2]
    highest = [max(height for _, height in ROOFS[number]) for number in paper.building_id]
    assert all(height > top - 7 for height, top in zip(paper.height, highest))
    first = paper.polygon[paper.building_id.index(1)]
    truth = shapely.box(X0, Y0, X0 + 15, Y0 + 12)
    assert first.intersection(truth).area / first.union(truth).area > 0.88
    points = cloud_roof_polygons(cloud, footprints, PolygonParameters("points", "levels"))
    drawn = shapely.union_all([polygon for polygon, number in zip(points.polygon, points.building_id) if number == 3])
    truth = shapely.box(X0 + 50, Y0, X0 + 70, Y0 + 28)
    assert drawn.intersection(truth).area / drawn.union(truth).area > 0.95


def roof_input(*rows):
    polygons = np.empty(len(rows), dtype=object)
    polygons[:] = [row[0] for row in rows]
    return RoofInput(polygons, np.ones(len(rows), int), np.array([row[1] for row in rows]),
                     np.array([row[2] for row in rows], float), np.full(len(rows), "ok", object))


def test_a_building_without_roofs_keeps_its_row_and_reason():
    model = model_building(7, shapely.box(0, 0, 5, 5), "the outline was repaired", roof_input(), 0.0)
    assert (model.building_id, model.status, model.reason) == (7, NOT_MODELLED, "the outline was repaired")


def test_blocks_and_assumed_ground_are_said():
    block = model_building(1, shapely.box(0, 0, 5, 5), "", roof_input((shapely.box(0, 0, 5, 5), 0, 6.0)), 0.0)
    assert block.status == BLOCK and block.solids
    assumed = model_building(1, shapely.box(0, 0, 5, 5), "", roof_input((shapely.box(0, 0, 5, 5), 1, 6.0)), np.nan)
    assert assumed.status == GROUND_UNKNOWN and assumed.base == 3.5


def test_few_points_without_a_roof_become_a_plain_block(tmp_path, make_cloud):
    path = make_cloud(tmp_path / "p.laz", [1.0, 2.0], [1.0, 2.0], [5.0, 5.4],
                      extra={"building_id": 1, "roof_id": 0})
    drawn = cloud_roof_polygons(open_cloud([path]), clean_footprints(np.array([shapely.box(0, 0, 4, 4)], object)),
                                PolygonParameters(roofs="levels"))
    assert drawn.status == [BLOCK] and drawn.roof_id == [0] and drawn.height == [pytest.approx(5.2)]


def test_roofs_of_other_outlines_are_refused(footprints):
    roofs = RoofInput(np.array([shapely.box(0, 0, 1, 1)], object), np.array([99]), np.array([1]), np.array([3.0]),
                      np.array(["ok"], object))
    with pytest.raises(InputError, match="building_id"):
        build_models(footprints, roofs, np.zeros(5))


def test_report_names_what_to_distrust(chain, tmp_path):
    *_, models = chain
    columns = model_columns(models)
    assert list(columns) == list(COLUMNS)
    write_model_report(tmp_path / "報告.html", columns, note="Outlines: <b>; Expansion: 1")
    page = (tmp_path / "報告.html").read_text(encoding="utf-8")
    assert "Without a model: 1;" in page and "&lt;b&gt;" in page and "<svg" in page


def test_outline_ground_is_the_lowest_along_the_outline():
    grid = Grid(0.0, 20.0, 1.0, 20, 20)
    slope = np.repeat(np.linspace(0, 19, 20)[None, :], 20, axis=0)  # rises eastwards, 1 m a metre
    outlines = np.array([shapely.box(5, 5, 10, 10), None, shapely.box(90, 90, 95, 95)], object)
    found = outline_ground(outlines, grid, slope)
    assert found[0] == pytest.approx(4.5) and np.isnan(found[1:]).all()


def low_chain(make_cloud, folder, parts, outline, classes):
    """Models of one building of level parts (x_min, y_min, x_max, y_max, height) on flat ground."""
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-15, 30, 18_000), rng.uniform(-15, 25, 18_000)
    z, classified = np.full(len(x), GROUND), np.full(len(x), 2)
    for x_min, y_min, x_max, y_max, height in parts:
        inside = (x > x_min) & (x < x_max) & (y > y_min) & (y < y_max)
        z[inside], classified[inside] = GROUND + height, 6
    z = z + rng.normal(0, 0.02, len(x))
    path = make_cloud(folder / "low.laz", x + X0, y + Y0, z, classification=classified if classes else 0 * classified)
    box = shapely.box(outline[0] + X0, outline[1] + Y0, outline[2] + X0, outline[3] + Y0)
    return run_chain(path, clean_footprints(np.array([box], object)), folder)[-1][0]


def test_what_the_file_calls_a_building_is_believed_below_two_metres(tmp_path, make_cloud):
    shed = low_chain(make_cloud, tmp_path, [(0, 0, 8, 7, 1.8)], (0, 0, 8, 7), True)
    assert shed.status == OK and shed.fit.rmse_z95 < 0.05
    house = [(0, 0, 10, 8, 6.0), (10, 0, 15, 8, 1.7)]
    annex = low_chain(make_cloud, tmp_path, house, (0, 0, 15, 8), True)
    volume = model_columns([annex])["volume"][0]
    assert annex.status == OK and volume == pytest.approx(80 * 6.0 + 40 * 1.7, rel=0.02)


def test_a_fault_is_a_sentence_in_the_result_and_its_text_in_the_log(caplog):
    words = trouble_words(ValueError("slice step cannot be zero"))
    assert "slice step" not in words and "log" in words
    assert "ValueError: slice step cannot be zero" in caplog.text
    assert trouble_words(InputError("The outline is empty.")) == "The outline is empty."
