"""Tables of other programs imported as the user tells, and his ways of reading kept by name."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.aerial.frames.camera import angles_from_usual_order
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.job.table_import import (
    TableImport,
    guessed_import,
    import_table,
    remember_import,
    remembered_imports,
    split_table,
)
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
    lines = ["GPSTime,E,N,H,R,P,Y", *(f"{t},{x},{y},{z},0,0,0.0" for t, x, y, z in feet)]
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
