"""Tables of other programs imported as the user tells, and his ways of reading kept by name."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from pyproj import Proj, Transformer

from urbanmap_qgis.aerial.frames.camera import angles_from_usual_order
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.job.table_guess import guessed_import, guessed_target, told_order
from urbanmap_qgis.job.table_import import (
    TableImport,
    import_table,
    remember_import,
    remembered_imports,
    split_table,
    table_place,
)
from urbanmap_qgis.job.table_places import degrees_of, suggested_crs
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

PREAMBLE = "経路の解析結果\n作成: 測量 太郎\n"
NAMES = "時刻;東;北;標高;ロール;ピッチ;ヘディング"


def rows(count=40):
    """Driving east at 10 m/s."""
    time = np.arange(count) * 0.1
    return [(100.0 + t, 1000.0 + 10.0 * t, 2000.0, 5.0, 0.0, 0.0, 90.0) for t in time]


@pytest.fixture
def japanese(tmp_path):
    """What a Japanese Excel writes: code page 932, semicolons, a head, a line of units."""
    lines = [PREAMBLE + NAMES, "(s);(m);(m);(m);(deg);(deg);(deg)",
             *(";".join(f"{value:.3f}" for value in row) for row in rows())]
    path = tmp_path / "軌跡.txt"
    path.write_bytes("\n".join(lines).encode("cp932"))
    return path


def test_guess_and_preview_of_a_japanese_table(japanese):
    how = guessed_import(japanese, "trajectory")
    assert (how.encoding, how.delimiter, how.skip) == ("cp932", ";", 2)
    assert how.columns == {name: k for k, name in enumerate(("time", "x", "y", "z", "roll", "pitch", "heading"))}
    names, preview = split_table(japanese, how, 5)
    assert names == NAMES.split(";") and len(preview) == 5


def test_trajectory_comes_out_in_the_projects_own_format(japanese, tmp_path):
    import_table(japanese, guessed_import(japanese, "trajectory"), tmp_path / "out.csv")
    text = (tmp_path / "out.csv").read_text(encoding="utf-8")
    assert text.startswith("time,x,y,z,roll,pitch,heading\n100.000000,1000.0000")
    made = read_trajectory(tmp_path / "out.csv").trajectory
    assert len(made) == 40 and made.place[-1, 0] == pytest.approx(1039.0)


def test_radians_from_east_and_feet_are_converted(tmp_path):
    feet = [(t, x / 0.3048, y / 0.3048, z / 0.3048) for t, x, y, z, *_ in rows()]
    lines = ["GPSTime,E,N,H,R,P,Y", *(f"{t},{x},{y},{z},0.001,0,0.0" for t, x, y, z in feet)]
    (tmp_path / "t.csv").write_text("\n".join(lines), encoding="utf-8")
    how = TableImport("trajectory", columns=dict(zip(("time", "x", "y", "z", "roll", "pitch", "heading"), range(7))),
                      angles="radians_from_east", length="ft")
    import_table(tmp_path / "t.csv", how, tmp_path / "out.csv")
    made = read_trajectory(tmp_path / "out.csv").trajectory
    assert made.place[0] == pytest.approx((1000.0, 2000.0, 5.0), abs=1e-3)
    assert made.angles[:, 2] == pytest.approx(90.0)
    with pytest.raises(InputError, match="counter-clockwise from east"):
        import_table(tmp_path / "t.csv", replace(how, angles="degrees"), tmp_path / "out.csv")


def test_exterior_orientation_in_gon_and_the_usual_order(tmp_path):
    lines = ["Name X Y Z O P K", "a.tif 100.0 200.0 700.0 1.0 2.0 100.0", "b.tif 150.0 200.0 700.0 1.0 -2.0 300.0"]
    (tmp_path / "e.txt").write_text("\n".join(lines), encoding="utf-8")
    how = replace(guessed_import(tmp_path / "e.txt", "exterior"), angles="gon usual")
    assert how.delimiter == " " and set(how.columns) == {"image", "x", "y", "z"}
    with pytest.raises(InputError, match="omega, phi, kappa"):
        import_table(tmp_path / "e.txt", how, tmp_path / "out.csv")
    import_table(tmp_path / "e.txt", replace(how, columns={**how.columns, "omega": 4, "phi": 5, "kappa": 6}),
                 tmp_path / "out.csv")
    pose = read_exterior(tmp_path / "out.csv")[0]
    assert (pose.omega, pose.phi, pose.kappa) == pytest.approx(angles_from_usual_order(0.9, 1.8, 90.0), abs=1e-5)


@pytest.mark.parametrize(("change", "says"), [
    ({"delimiter": ","}, "fewer than the columns chosen"), ({"skip": 500}, "leave fewer out"),
    ({"encoding": "utf-8-sig"}, "no text in UTF-8"), ({"columns": {"time": 0}}, "No column is chosen for x, y")])
def test_wrong_ways_get_a_sentence(japanese, tmp_path, change, says):
    with pytest.raises(InputError, match=says):
        import_table(japanese, replace(guessed_import(japanese, "trajectory"), **change), tmp_path / "out.csv")
    assert not (tmp_path / "out.csv").exists()


def test_tables_without_names_and_of_words(tmp_path):
    (tmp_path / "n.csv").write_text("\n".join(",".join(map(str, row)) for row in rows()), encoding="utf-8")
    how = TableImport("trajectory", columns=dict(zip(("time", "x", "y", "z", "roll", "pitch", "heading"), range(7))),
                      angles="degrees")
    assert split_table(tmp_path / "n.csv", how)[0] == list("1234567")
    import_table(tmp_path / "n.csv", how, tmp_path / "out.csv")
    assert len(read_trajectory(tmp_path / "out.csv").trajectory) == 40
    (tmp_path / "w.csv").write_text("a,b,c,d,e,f,g\n" * 5, encoding="utf-8")
    with pytest.raises(InputError, match="no row with numbers"):
        import_table(tmp_path / "w.csv", how, tmp_path / "out.csv")


def test_ways_are_kept_by_name(tmp_path):
    path = tmp_path / "deep" / "imports.json"
    assert remembered_imports(path) == {}
    how = TableImport("trajectory", "cp932", ";", 2, {"time": 0}, "degrees", "mm")
    remember_import(path, "社内の様式", how)
    remember_import(path, "other", replace(how, skip=0))
    assert remembered_imports(path) == {"社内の様式": how, "other": replace(how, skip=0)}
    path.write_text("[1]", encoding="utf-8")
    with pytest.raises(InputError, match="delete it"):
        remembered_imports(path)


def polar_rows(count=40):
    """Driving to grid east in zone IX at 10 m/s, with the heading from true north."""
    plan = Transformer.from_crs(6677, 6668, always_xy=True)
    for number in range(count):
        longitude, latitude = plan.transform(-6000.0 + number, -34000.0)
        turn = float(Proj("EPSG:6677").get_factors(longitude, latitude).meridian_convergence)
        yield 100.0 + 0.1 * number, latitude, longitude, 45.0, 0.0, 0.0, 90.0 + turn


def sexagesimal(value):
    return int(value), int(value * 60 % 60), value * 3600 % 60


POLAR_NAMES = "TIME,LATITUDE,LONGITUDE,ELLIPSOID HEIGHT,ROLL,PITCH,HEADING"
POSPAC = ["POSPac MMS export", "Datum: JGD2011", POLAR_NAMES, "(sec),(deg),(deg),(m),(deg),(deg),(deg)"]


def test_degrees_go_into_the_zone_of_their_place_and_headings_to_grid_north(tmp_path):
    lines = [*POSPAC, *(",".join(f"{value:.9f}" for value in row) for row in polar_rows())]
    (tmp_path / "t.txt").write_text("\n".join(lines), encoding="utf-8")
    how = guessed_import(tmp_path / "t.txt", "trajectory")
    assert how.polar and how.heights == "ellipsoidal" and how.skip == 2
    crs, x, y = table_place(tmp_path / "t.txt", how)
    assert crs == "EPSG:6677" and (x, y) == pytest.approx((-6000.0, -34000.0), abs=1e-3)
    notes = import_table(tmp_path / "t.txt", how, tmp_path / "out.csv")
    assert any("EPSG:6677" in note for note in notes) and any("above the ellipsoid" in note for note in notes)
    made = read_trajectory(tmp_path / "out.csv").trajectory
    assert made.place[[0, -1]].tolist() == [pytest.approx((-6000.0, -34000.0, 45.0), abs=1e-3),
                                            pytest.approx((-5961.0, -34000.0, 45.0), abs=1e-3)]
    assert made.angles[:, 2] == pytest.approx(90.0, abs=1e-5)
    import_table(tmp_path / "t.txt", replace(how, north="grid"), tmp_path / "grid.csv")
    assert read_trajectory(tmp_path / "grid.csv").trajectory.angles[0, 2] == pytest.approx(89.9614, abs=1e-3)


def test_angles_from_east_in_radians_turn_the_other_way(tmp_path):
    rows = [(*row[:6], np.radians(90.0 - row[6])) for row in polar_rows()]
    lines = [POLAR_NAMES, *(",".join(f"{value:.9f}" for value in row) for row in rows)]
    (tmp_path / "t.csv").write_text("\n".join(lines), encoding="utf-8")
    how = replace(guessed_import(tmp_path / "t.csv", "trajectory"), angles="radians_from_east")
    import_table(tmp_path / "t.csv", how, tmp_path / "out.csv")
    assert read_trajectory(tmp_path / "out.csv").trajectory.angles[:, 2] == pytest.approx(90.0, abs=1e-4)


def test_degrees_minutes_and_seconds_in_columns_of_their_own(tmp_path):
    """As Inertial Explorer writes them: one name over three columns between blanks."""
    lines = ["Project: 測量", "GPSTime Latitude Longitude H-Ell Roll Pitch Heading",
             "(sec) (deg min sec) (deg min sec) (m) (deg) (deg) (deg)".replace("deg min sec", "D M S")]
    for time, latitude, longitude, *rest in polar_rows():
        (d, m, s), (e, n, t) = sexagesimal(latitude), sexagesimal(longitude)
        lines.append(f"{time:.3f} {d} {m} {s:.6f} {e} {n} {t:.6f} " + " ".join(f"{value:.5f}" for value in rest))
    (tmp_path / "ie.txt").write_text("\n".join(lines), encoding="utf-8")
    how = guessed_import(tmp_path / "ie.txt", "trajectory")
    assert how.columns == {"time": 0, "latitude": 1, "latitude_minutes": 2, "latitude_seconds": 3, "longitude": 4,
                           "longitude_minutes": 5, "longitude_seconds": 6, "z": 7, "roll": 8, "pitch": 9, "heading": 10}
    assert len(split_table(tmp_path / "ie.txt", how, 4)[0]) == 11 and how.heights == "ellipsoidal"
    import_table(tmp_path / "ie.txt", how, tmp_path / "out.csv")
    made = read_trajectory(tmp_path / "out.csv").trajectory
    assert made.place[5, :2] == pytest.approx((-5995.0, -34000.0), abs=1e-3)


def test_heights_are_asked_for_and_lowered_by_a_geoid(tmp_path):
    lines = [POLAR_NAMES.replace("ELLIPSOID ", ""), *(",".join(map(repr, row)) for row in polar_rows())]
    (tmp_path / "t.csv").write_text("\n".join(lines), encoding="utf-8")
    how = guessed_import(tmp_path / "t.csv", "trajectory")
    assert how.heights == ""
    with pytest.raises(InputError, match="what the heights count from"):
        import_table(tmp_path / "t.csv", how, tmp_path / "out.csv")
    isg = ("model name : local\nunits : meters\nlat min = 35.0\nlat max = 36.0\nlon min = 139.0\nlon max = 140.0\n"
           "delta lat = 1.0\ndelta lon = 1.0\nnrows = 2\nncols = 2\nnodata = -9999\nISG format = 1.0\n"
           "end_of_head ====\n36.5 36.5\n36.5 36.5\n")
    (tmp_path / "g.isg").write_text(isg, encoding="utf-8")
    notes = import_table(tmp_path / "t.csv", replace(how, heights="ellipsoidal", geoid=str(tmp_path / "g.isg")),
                         tmp_path / "out.csv")
    assert read_trajectory(tmp_path / "out.csv").trajectory.place[:, 2] == pytest.approx(8.5, abs=1e-3)
    assert any("lowered by 36.500" in note for note in notes)
    notes = import_table(tmp_path / "t.csv", replace(how, heights="sea level"), tmp_path / "out.csv")
    assert len(notes) == 1 and read_trajectory(tmp_path / "out.csv").trajectory.place[0, 2] == pytest.approx(45.0)


def test_frames_in_degrees_turn_their_kappa(tmp_path):
    (_, latitude, longitude, *_), *_ = polar_rows()
    turn = float(Proj("EPSG:6677").get_factors(longitude, latitude).meridian_convergence)
    lines = ["Label,Longitude,Latitude,Altitude,Omega,Phi,Kappa", f"a.tif,{longitude:.9f},{latitude:.9f},700,1,2,170"]
    (tmp_path / "e.csv").write_text("\n".join(lines), encoding="utf-8")
    how = replace(guessed_import(tmp_path / "e.csv", "exterior"), heights="sea level")
    import_table(tmp_path / "e.csv", how, tmp_path / "out.csv")
    pose, = read_exterior(tmp_path / "out.csv")
    assert (pose.x, pose.y, pose.z) == pytest.approx((-6000.0, -34000.0, 700.0), abs=1e-3)
    assert (pose.omega, pose.phi, pose.kappa) == pytest.approx((1.0, 2.0, 170.0 + turn), abs=1e-5)


def test_map_coordinates_go_before_degrees(tmp_path):
    (tmp_path / "t.csv").write_text("time,easting,northing,latitude,longitude,z,roll,pitch,heading\n"
                                    "1,2,3,4,5,6,7,8,9\n", encoding="utf-8")
    how = guessed_import(tmp_path / "t.csv", "trajectory")
    assert not how.polar and how.columns["x"] == 1 and table_place(tmp_path / "t.csv", how) == ("", 2.0, 3.0)


@pytest.mark.parametrize(("cells", "degrees"), [
    (["35.5"], 35.5), (["-0.25"], -0.25), (["3.55e+01"], 35.5), (["35 30 36"], 35.51), (["35°30'36.0\"N"], 35.51),
    (["139-30-36"], 139.51), (["35:30.6"], 35.51), (["-0 30 00"], -0.5), (["S 35 30 36"], -35.51),
    (["北緯35度30分36秒"], 35.51), (["35", "30", "36"], 35.51), (["-35", "30", "36"], -35.51), (["35d30m36"], 35.51),
    (["35 60 00"], None), (["north"], None), ([""], None), (["1 2 3 4"], None)])
def test_angles_as_they_are_written(cells, degrees):
    found = degrees_of(cells)
    assert found is None if degrees is None else found == pytest.approx(degrees)


@pytest.mark.parametrize(("name", "longitude", "latitude", "crs"), [
    ("Tokyo", 139.7, 35.7, 6677), ("Naha", 127.7, 26.2, 6683), ("Tsushima", 129.3, 34.3, 6669),
    ("Wakkanai", 141.7, 45.4, 6680), ("Seoul", 127.0, 37.5, 32652), ("Busan", 129.05, 35.15, 32652),
    ("Taipei", 121.5, 25.0, 32651), ("Berlin", 13.4, 52.5, 32633), ("Sydney", 151.2, -33.9, 32756),
    ("Vladivostok", 131.9, 43.1, 32652), ("Shanghai", 121.5, 31.2, 32651)])
def test_a_place_gets_its_zone(name, longitude, latitude, crs):
    assert suggested_crs(longitude, latitude) == f"EPSG:{crs}", name


@pytest.mark.parametrize(("change", "says"), [
    ({"crs": "EPSG:4326"}, "no system of plane coordinates"), ({"crs": "nowhere"}, "cannot be understood"),
    ({"crs": "EPSG:2263"}, "in metres"), ({"columns": {"latitude": 0, "longitude": 1}}, "beyond 90"),
    ({"columns": {"latitude": 1}}, "No column is chosen for time, longitude")])
def test_wrong_places_get_a_sentence(tmp_path, change, says):
    lines = [POLAR_NAMES, *(",".join(map(repr, row)) for row in polar_rows())]
    (tmp_path / "t.csv").write_text("\n".join(lines), encoding="utf-8")
    how = guessed_import(tmp_path / "t.csv", "trajectory")
    columns = {**how.columns, **change.get("columns", {})} if len(change.get("columns", ())) > 1 else change.get(
        "columns", how.columns)
    with pytest.raises(InputError, match=says):
        import_table(tmp_path / "t.csv", replace(how, **{**change, "columns": columns}), tmp_path / "out.csv")


def test_a_row_without_a_place_is_named(tmp_path):
    lines = [POLAR_NAMES, *(",".join(map(repr, row)) for row in polar_rows())]
    lines[4] = "100.3,none,139.7,45,0,0,90"
    (tmp_path / "t.csv").write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(InputError, match="row 5 has no latitude and longitude"):
        import_table(tmp_path / "t.csv", guessed_import(tmp_path / "t.csv", "trajectory"), tmp_path / "out.csv")


RESULTS = "点名,X座標,Y座標,標高\n1001,-35123.456,-8123.456,12.3\n1002,-35223.456,-8023.456,13.3\n"
TABLES_OF_JAPAN = {
    "als_control": (RESULTS, "id,x,y,z\n1001,-8123.456,-35123.456,12.3\n"),
    "control": ("点名,X座標,Y座標,標高,時刻,計測X,計測Y,計測標高,役割\nA,10,20,3,100,10.1,20.2,3.1,検証点\n",
                "id,x,y,z,time,x_mms,y_mms,z_mms,role\nA,20,10,3,100,20.2,10.1,3.1,検証点\n"),
    "ties": ("組番号,時刻,計測X,計測Y,基準X,基準Y\n1,5,10,20,10.5,20.5\n",
             "set,time,x_mms,y_mms,x_ref,y_ref\n1,5,20,10,20.5,10.5\n"),
    "frame_control": ("点名,画像名,列,行,X座標,Y座標,標高\nA,f1,3,4,10,20,5\nT,f1,6,7,,,\n",
                      "point,image,column,row,x,y,z\nA,f1,3,4,20,10,5\nT,f1,6,7,,,\n"),
    "exterior": ("写真名,X座標,Y座標,標高,ω,φ,κ\nf1,10,20,300,0.1,0.2,0.3\n",
                 "image,x,y,z,omega,phi,kappa\nf1,20.0000,10.0000,300.0000,0.100000,0.200000,0.300000\n"),
    "poses": ("画像名,時刻,X,Y,Z,ロール,ピッチ,方位角\ni,5,10,20,3,0,0,90\n",
              "id,time,x,y,z,roll,pitch,heading\ni,5.0000,20.0000,10.0000,3.0000,0.000000,0.000000,90.000000\n"),
    "trajectory": ("時刻,X座標,Y座標,標高,ロール,ピッチ,方位角\n5,10,20,3,0,0,90\n6,10,21,3,0,0,90\n",
                   "time,x,y,z,roll,pitch,heading\n5.000000,20.0000,10.0000,3.0000,0.000000,0.000000,90.000000\n")}


@pytest.mark.parametrize("encoding", ["utf-8", "cp932"])
@pytest.mark.parametrize("target", TABLES_OF_JAPAN)
def test_tables_with_x_and_y_in_japanese_come_out_with_x_north(tmp_path, target, encoding):
    """In the plane rectangular system X counts north; that nothing but this habit says so is told in the preview."""
    path, (given, wanted) = tmp_path / "成果.csv", TABLES_OF_JAPAN[target]
    path.write_text(given, encoding=encoding)
    how = guessed_target(path)
    assert how.target == target
    assert "counts north" in told_order(path, how) and "does not say it" in told_order(path, how)
    import_table(path, how, tmp_path / "out.csv")
    assert (tmp_path / "out.csv").read_text(encoding="utf-8").startswith(wanted)


def test_an_order_that_names_or_numbers_tell_is_not_doubted(tmp_path):
    named, utm = tmp_path / "named.csv", tmp_path / "utm.csv"
    named.write_text(RESULTS.replace("X座標", "X座標(東)").replace("Y座標", "Y座標(北)"), encoding="cp932")
    utm.write_text("点名,X座標,Y座標,標高\nA,412345.6,3954321.0,12\n", encoding="cp932")
    for path in (named, utm):
        how = guessed_target(path)
        assert (how.columns["x"], how.columns["y"]) == (1, 2) and told_order(path, how) == ""


def test_swapped_columns_are_told_as_they_are_chosen(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text(RESULTS, encoding="utf-8")
    how = guessed_target(path)
    swapped = replace(how, columns={**how.columns, "x": how.columns["y"], "y": how.columns["x"]})
    assert told_order(path, swapped).startswith("Y座標 is taken as counting north and X座標 as counting east")
    assert table_place(path, swapped) == ("", -35123.456, -8123.456)


@pytest.mark.parametrize("target", ["control", "als_control", "frame_control", "poses"])
def test_points_and_poses_in_degrees_are_laid_into_the_plane(tmp_path, target):
    given, _ = TABLES_OF_JAPAN[target]
    names, row, *more = given.replace("X座標", "緯度").replace("Y座標", "経度").replace("時刻,X,Y", "時刻,緯度,経度") \
        .replace("計測X", "計測北").replace("計測Y", "計測東").replace("Z,", "標高,").splitlines()
    cells = dict(zip(names.split(","), row.split(",")))
    cells.update({"緯度": "35.6812", "経度": "139.7671"})
    path = tmp_path / "t.csv"
    path.write_text("\n".join([names, ",".join(cells.values()), *more[target == "als_control":]]), encoding="cp932")
    how = replace(guessed_target(path), heights="sea level")
    assert how.target == target
    import_table(path, how, tmp_path / "out.csv")
    lines = [line.split(",") for line in (tmp_path / "out.csv").read_text(encoding="utf-8").splitlines()]
    found = dict(zip(lines[0], lines[1]))
    x, y = Transformer.from_crs(6668, 6677, always_xy=True).transform(139.7671, 35.6812)
    assert float(found["x"]) == pytest.approx(x, abs=1e-3) and float(found["y"]) == pytest.approx(y, abs=1e-3)
    if target == "frame_control":  # a point of no known place stays so
        assert dict(zip(lines[0], lines[2]))["x"] == ""
    if target == "poses":  # headings count from true north
        turn = Proj(6677).get_factors(139.7671, 35.6812).meridian_convergence
        assert float(found["heading"]) == pytest.approx(90.0 - turn, abs=1e-5)


@pytest.mark.parametrize("place", ["35.6812000000   139.7671000000", "35 40 52.32000   139 46 01.56000"])
def test_a_pospac_text_in_degrees_is_guessed_whole(tmp_path, place):
    """Names stand between many blanks and hold one themselves, below a head and above a line of units."""
    lines = ["POSPac MMS Export Utility", "Datum: JGD2011", "",
             "   TIME      LATITUDE      LONGITUDE     ELLIPSOID HEIGHT   ROLL    PITCH   HEADING",
             "   (sec)   (deg)   (deg)   (m)   (deg)   (deg)   (deg)", "",
             *(f"  {100 + 0.1 * k:.4f}   {place}   48.5{k}   0.1   0.2   90.0" for k in range(5))]
    path = tmp_path / "export.txt"
    path.write_text("\n".join(lines), encoding="utf-8")
    how = replace(guessed_target(path), heights="ellipsoidal")
    assert how.target == "trajectory" and not set(how.needed) - set(how.columns)
    assert table_place(path, how)[0] == "EPSG:6677"
    if " 40 " not in place:
        import_table(path, how, tmp_path / "out.csv")
        assert read_trajectory(tmp_path / "out.csv").trajectory.place[0, 2] == pytest.approx(48.50)


@pytest.mark.parametrize(("names", "delimiter"), [
    ("imageName X Y Z Omega Phi Kappa", " "), ("#Label,X/Easting,Y/Northing,Z/Altitude,Omega,Phi,Kappa", ","),
    ("# PhotoID, X, Y, Z, Omega, Phi, Kappa", "\t")])
def test_frames_of_metashape_and_pix4d_keep_their_rotations(tmp_path, names, delimiter):
    rows = [delimiter.join(["a.tif", "1", "2", "700", "1.5", "-2.25", "88"]),
            delimiter.join(["b.tif", "2", "3", "701", "-3", "4", "-91.5"])]
    (tmp_path / "e.txt").write_text("\n".join([names, *rows]), encoding="utf-8")
    assert guessed_target(tmp_path / "e.txt").target == "exterior"
    import_table(tmp_path / "e.txt", guessed_import(tmp_path / "e.txt", "exterior"), tmp_path / "out.csv")
    one, two = read_exterior(tmp_path / "out.csv")
    assert (one.image, two.x) == ("a.tif", 2.0)
    assert (one.omega, one.phi, one.kappa) == pytest.approx(angles_from_usual_order(1.5, -2.25, 88), abs=1e-5)
    assert (two.omega, two.phi, two.kappa) == pytest.approx(angles_from_usual_order(-3, 4, -91.5), abs=1e-5)


def test_angles_of_frames_in_gon_are_offered_as_gon(tmp_path):
    rows = ["a.tif,1,2,700,0.1,0.2,100", "b.tif,2,3,700,0.1,0.2,-100", "c.tif,3,4,700,0.1,0.2,200"]
    (tmp_path / "e.csv").write_text("\n".join(["image,x,y,z,omega,phi,kappa", *rows]), encoding="utf-8")
    assert guessed_import(tmp_path / "e.csv", "exterior").angles == "gon papers"
