"""GNSS algorithms on the sample city's observations, and on bad input."""

import csv
from pathlib import Path
from xml.etree import ElementTree

import pytest
import shapely


def numbered(folder, passes):
    """Parameters of the passes of a sample city."""
    gnss = folder / "gnss"
    return {"OBSERVATIONS": [str(gnss / f"pass_{n:02d}.obs") for n in passes],
            "TRAJECTORY": [str(gnss / f"pass_{n:02d}_trajectory.csv") for n in passes],
            "NAVIGATION": [str(gnss / "satellites.nav")], "GEOID_SEPARATION": 36.6,
            "BUILDINGS": str(folder / "models" / "buildings.geojson")}


def corners(feature):
    """Corners (x, y, z) of a layer's feature."""
    return shapely.get_coordinates(shapely.from_wkt(feature.wkt.replace("StringZ", "String Z").replace(
        "PolygonZ", "Polygon Z")), include_z=True)


def test_rays_carry_class_excess_and_residual(run, read_layer, small_city, tmp_path):
    report = tmp_path / "rays.html"
    result = run("urbanmap:gnssreflections", {
        **numbered(small_city, [1, 2]), "EVERY": 5, "LENGTH": 50, "OUTPUT": str(tmp_path / "rays.gpkg"),
        "OUTPUT_REPORT": str(report)})
    rays = read_layer(result["OUTPUT"])
    assert {ray.attributes["kind"] for ray in rays} == {"LOS", "NLOS", "reflected"}
    assert result["SIGNALS"] == result["LOS"] + result["NLOS"] + result["REFLECTED"] > 4 * len(rays)
    assert abs(result["LOS_MEDIAN"]) < 0.5 and result["LOS_IQR"] < 1.5
    assert 0.5 < result["WITHIN_5"] <= result["WITHIN_10"] <= 1.0
    reflected = [ray for ray in rays if ray.attributes["kind"] == "reflected"]
    for ray in reflected:
        antenna, at_wall, end = corners(ray)
        # The way by the wall is longer than the straight one by the excess told.
        way = (end - at_wall) / 50.0
        longer = ((at_wall - antenna) ** 2).sum() ** 0.5 - (at_wall - antenna) @ way
        assert longer == pytest.approx(ray.attributes["excess"], abs=1e-3)
        assert ray.attributes["building"] and ray.attributes["edge"] >= 1
    start, end = corners(next(ray for ray in rays if ray.attributes["kind"] == "LOS"))
    assert ((end - start) ** 2).sum() ** 0.5 == pytest.approx(50.0)
    page = report.read_text(encoding="utf-8")
    assert "Sky plot" in page and "What to distrust" in page and "quartile range" in page


def test_walls_move_to_where_they_are_and_the_rest_say_why_not(run, read_layer, small_city, tmp_path):
    parameters = {**numbered(small_city, range(1, 17)), "OUTPUT": str(tmp_path / "adjusted.gpkg"),
                  "OUTPUT_WALLS": str(tmp_path / "walls.gpkg"), "OUTPUT_REPORT": str(tmp_path / "report.html")}
    result = run("urbanmap:adjustwalls", parameters)
    walls = [wall.attributes | {"line": corners(wall)} for wall in read_layer(result["OUTPUT_WALLS"])]
    adjusted = [wall for wall in walls if wall["status"] == "adjusted"]
    assert len(walls) == result["WALLS"] and len(adjusted) == result["ADJUSTED"] >= 2
    assert all(wall["reason"] for wall in walls if wall["status"] != "adjusted")
    with open(small_city / "truth" / "wall_offsets.csv", newline="") as file:
        truth = [{key: float(value) if value else None for key, value in row.items()} for row in csv.DictReader(file)]
    errors = []
    for wall in adjusted:
        true = true_offset(wall, truth)
        errors.append(wall["offset"] - true)
        assert abs(errors[-1]) < 3 * wall["sigma"], (wall["building"], wall["edge"], wall["offset"], true)
        assert wall["applied"] == pytest.approx(wall["offset"], abs=0.05)
        assert wall["passes"] >= 3 and wall["satellites"] >= 4 and wall["observations"] >= 8
    assert (sum(error**2 for error in errors) / len(errors)) ** 0.5 < 0.4
    before, after = read_layer(parameters["BUILDINGS"]), read_layer(result["OUTPUT"])
    assert len(before) == len(after) and all(item.geometry.isGeosValid() for item in after)
    assert [item.attributes["z_top"] for item in before] == [item.attributes["z_top"] for item in after]
    likely = [wall for wall in walls if wall["status"] == "likely"]
    assert len(likely) == result["LIKELY"] and all(wall["sigma"] <= 0.5 and wall["passes"] >= 3 for wall in likely)
    moved = {str(item.attributes["building"]) for item in after if item.attributes["walls_adjusted"]}
    assert moved == {wall["building"] for wall in adjusted + likely}
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Walls before and after" in page and "Walls that stay where they are" in page


def true_offset(wall, truth):
    """Offset of the true wall in the line of a wall of the layer, which has been moved by `applied`."""
    a, b = wall["line"][:, :2]
    way = (b - a) / ((b - a) ** 2).sum() ** 0.5
    # The building is on the left of the line as the algorithm draws it.
    normal = way[1], -way[0]
    return next(row["offset"] for row in truth if same_wall(row, normal, a, wall))


def same_wall(row, normal, point, wall):
    """Whether a row of the truth is the wall with this normal, before it was moved."""
    across = (row["x0"] - point[0]) * normal[0] + (row["y0"] - point[1]) * normal[1] + wall["applied"]
    return (int(row["building"]) == int(wall["building"]) and abs(across) < 0.03
            and row["nx"] * normal[0] + row["ny"] * normal[1] > 0.999)


def test_one_pass_leaves_every_wall_and_warns(run, read_layer, small_city, tmp_path):
    result = run("urbanmap:adjustwalls", {**numbered(small_city, [1]), "OUTPUT": str(tmp_path / "adjusted.gpkg")})
    assert result["ADJUSTED"] == 0 and "OUTPUT_WALLS" not in result
    assert any("No wall was moved" in text for text in run.feedback.warnings)
    before = read_layer(str(small_city / "models" / "buildings.geojson"))
    assert all(a.wkt == b.wkt for a, b in zip(before, read_layer(result["OUTPUT"])))


def test_solids_stay_solids(run, read_layer, small_city, polygon_layer, tmp_path):
    layer = read_layer(str(small_city / "models" / "buildings.geojson"))
    wkts = []
    for item in layer:
        ring = [(x, y) for x, y, _ in corners(item)[:-1]]
        if not shapely.LinearRing(ring).is_ccw:
            ring = ring[::-1]
        low, top = item.attributes["z_base"], item.attributes["z_top"]
        faces = [[(*p, top) for p in ring], [(*p, low) for p in ring[::-1]]]
        faces += [[(*p, low), (*q, low), (*q, top), (*p, top)] for p, q in zip(ring, ring[1:] + ring[:1])]
        text = ",".join("((" + ",".join(f"{x:f} {y:f} {z:f}" for x, y, z in [*face, face[0]]) + "))" for face in faces)
        wkts.append(f"MultiPolygonZ({text})")
    solids = polygon_layer(wkts, fields={"building_id": [int(item.attributes["building"]) for item in layer]},
                           kind="MultiPolygonZ")
    result = run("urbanmap:adjustwalls", {
        **numbered(small_city, range(1, 17)), "BUILDINGS": solids, "OUTPUT": str(tmp_path / "solids.gpkg")})
    made = read_layer(result["OUTPUT"])
    assert result["ADJUSTED"] >= 2
    assert all(item.wkt.replace(" ", "").startswith("MultiPolygonZ") for item in made)
    assert [item.wkt.count("((") for item in made] == [text.count("((") for text in wkts]


@pytest.mark.parametrize("change, message", [
    ({"TRAJECTORY": ["no_such.csv"]}, "does not exist"),
    ({"OBSERVATIONS": ["no_such.obs"]}, "does not exist"),
    ({"LEVER_ARM": "1, 2"}, "three numbers"),
    ({"TOP_FIELD": "no_such"}, "no field no_such"),
])
def test_bad_input_is_one_sentence(run, small_city, tmp_path, change, message):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match=message):
        run("urbanmap:gnssreflections", {**numbered(small_city, [1]), "OUTPUT": str(tmp_path / "r.gpkg"), **change})


def test_buildings_without_heights_are_refused(run, small_city, polygon_layer, tmp_path):
    from qgis.core import QgsProcessingException

    flat = polygon_layer(["POLYGON((0 0, 10 0, 10 10, 0 10, 0 0))"])
    with pytest.raises(QgsProcessingException, match="no heights"):
        run("urbanmap:adjustwalls", {**numbered(small_city, [1]), "BUILDINGS": flat,
                                     "OUTPUT": str(tmp_path / "a.gpkg")})


@pytest.mark.parametrize("style, values", [
    ("gnss_rays", ("LOS", "NLOS", "reflected")), ("gnss_walls", ("adjusted", "likely", "not observable", "held"))])
def test_every_class_has_its_symbol_in_plan_and_in_3d(style, values):
    path = Path(__file__).resolve().parents[2] / "resources" / "styles" / f"{style}.qml"
    document = ElementTree.parse(path)
    flat = ElementTree.tostring(document.find("renderer-v2"), encoding="unicode")
    upright = ElementTree.tostring(document.find("renderer-3d"), encoding="unicode")
    for value in values:
        named = f"= '{value}'", f"('{value}'", f", '{value}'"
        assert f'value="{value}"' in flat or any(text in flat for text in named)
        assert any(text in upright for text in named)
