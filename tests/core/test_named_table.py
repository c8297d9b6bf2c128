"""Tables of other programs: heads, units, encodings, Japanese names; what could be meant in two ways is refused."""

import numpy as np
import pytest

from urbanmap_qgis.aerial.frames.exterior_files import EXTERIOR, read_exterior
from urbanmap_qgis.errors import InputError, OutputError, PreviewNeeded
from urbanmap_qgis.io.files.named_table import known_columns, named_rows, plain_name
from urbanmap_qgis.io.files.staging import Staging
from urbanmap_qgis.mobile.control import read_control
from urbanmap_qgis.mobile.image_poses import read_image_poses, write_image_poses
from urbanmap_qgis.mobile.lines.tie_points import read_tie_points
from urbanmap_qgis.mobile.survey_columns import CONTROL, IMAGE_POSES, TIE_POINTS, TRAJECTORY
from urbanmap_qgis.mobile.trajectory_files import read_trajectory, write_trajectory

ROWS = ["10.0,1,2,3,0,0,359", "10.1,2,2,3,0,0,1", "10.2,3,2,3,0,0,3"]
EXPORT = """Export of a smoothed solution
Project: 駅前, Datum: JGD2011

TIME, DISTANCE, EASTING, NORTHING, ELLIPSOID HEIGHT, LATITUDE, LONGITUDE, ELLIPSOID HEIGHT, ROLL, PITCH, HEADING
(time in Sec, distance in Meters, position in Meters, lat, long in Degrees, orientation angles in Degrees)

  10.000   0.0   1.000  2.000  3.000  35.6  139.7  3.000  0.1  -0.2  359.0
  10.100   1.0   2.000  2.000  3.000  35.6  139.7  3.000  0.1  -0.2    1.0
  10.200   2.0   3.000  2.000  3.500  35.6  139.7  3.500  0.1  -0.2    3.0
"""


def written(folder, text, encoding="utf-8", name="a.csv"):
    path = folder / name
    path.write_bytes(text.encode(encoding))
    return path


def same_poses(read):
    assert np.allclose(read.trajectory.time, [10.0, 10.1, 10.2])
    assert np.allclose(read.trajectory.place[:, :2], [[1, 2], [2, 2], [3, 2]])
    assert np.allclose(read.trajectory.angles[:, 2], [359, 361, 363])


def test_names_are_compared_without_case_blanks_and_units():
    assert plain_name(" ELLIPSOID_HEIGHT (m)") == "ellipsoidheight"
    assert plain_name("ＧＰＳ時刻［秒］") == "gps時刻" and plain_name("Heading[deg]") == "heading"


def test_export_with_a_head_and_a_line_of_units_is_read(tmp_path):
    read = read_trajectory(written(tmp_path, EXPORT, name="export.txt"))
    same_poses(read)
    assert np.allclose(read.trajectory.place[:, 2], [3, 3, 3.5])
    assert read.columns["DISTANCE"] == ["0.0", "1.0", "2.0"]
    write_trajectory(tmp_path / "out.csv", read, read.trajectory)
    same_poses(read_trajectory(tmp_path / "out.csv"))


def test_decimal_commas_are_read(tmp_path):
    head, *rows = ["time;x;y;z;roll;pitch;heading", *(row.replace(",", ";").replace(".", ",") for row in ROWS)]
    assert "," in rows[0]
    same_poses(read_trajectory(written(tmp_path, "\n".join([head, *rows]), name="komma.csv")))


def test_names_with_a_blank_between_many_blanks_are_read(tmp_path):
    text = "\n".join(["Export of a smoothed solution", "Datum: JGD2011", "",
                      "   TIME    EASTING   NORTHING   ELLIPSOID HEIGHT   ROLL  PITCH   HEADING",
                      "   (sec)  (m)  (m)  (m)  (deg)  (deg)  (deg)", "", *(row.replace(",", "   ") for row in ROWS)])
    read = read_trajectory(written(tmp_path, text, name="export.txt"))
    same_poses(read)
    assert read.header[3] == "ELLIPSOID HEIGHT"


def test_two_different_heights_are_refused_by_name(tmp_path):
    text = EXPORT.replace("LONGITUDE, ELLIPSOID HEIGHT", "LONGITUDE, ORTHOMETRIC HEIGHT")
    text = text.replace(" 3.500  0.1", " 4.5 0.1")
    with pytest.raises(InputError, match=r"several columns that could be z \(ELLIPSOID HEIGHT, ORTHOMETRIC HEIGHT\)"):
        read_trajectory(written(tmp_path, text))


@pytest.mark.parametrize("unit", ["orientation angles in Degrees)\n(rad", "x)\n(feet"])
def test_a_unit_that_is_not_read_is_refused(tmp_path, unit):
    with pytest.raises(InputError, match=r"states the unit (rad|feet): metres, seconds and decimal degrees"):
        read_trajectory(written(tmp_path, EXPORT.replace("orientation angles in Degrees", unit)))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp932", "utf-16"])
@pytest.mark.parametrize("delimiter", [",", "\t", ";"])
def test_japanese_names_in_the_encodings_of_spreadsheets_are_read(tmp_path, encoding, delimiter):
    text = "\r\n".join(["GPS時刻(秒),東(m),北(m),標高(m),ロール(度),ピッチ(度),方位角(度),備考",
                        *(f"{row},～①" for row in ROWS)])
    read = read_trajectory(written(tmp_path, text.replace(",", delimiter), encoding))
    same_poses(read)
    write_trajectory(tmp_path / "out.csv", read, read.trajectory)
    again = read_trajectory(tmp_path / "out.csv")
    same_poses(again)
    assert again.columns["備考"] == ["～①"] * 3


def test_x_and_y_of_the_plane_rectangular_system_are_not_guessed(tmp_path):
    text = "\n".join(["時刻,X座標,Y座標,標高,ロール,ピッチ,方位角", *ROWS])
    with pytest.raises(InputError, match="X座標, Y座標 may count north or east"):
        read_trajectory(written(tmp_path, text, "cp932"))


def driven(north, east, heading):
    """A trajectory's rows by an own formula: 40 epochs at 10 m/s towards a heading, north before east."""
    step = np.arange(40.0)
    way = step[:, None] * [np.cos(np.radians(heading)), np.sin(np.radians(heading))]
    return [f"{10 + 0.1 * k:.1f},{north + n:.3f},{east + e:.3f},5,0,0,{heading}" for k, (n, e) in zip(step, way)]


@pytest.mark.parametrize("names", ["X座標,Y座標", "Ｘ座標（m）,Ｙ座標（m）", "X,Y", "座標X,座標Y"])
def test_headings_tell_which_coordinate_counts_north(tmp_path, names):
    north_first = "\n".join([f"時刻,{names},標高,ロール,ピッチ,方位角", *driven(-35000.0, -8000.0, 70.0)])
    read = read_trajectory(written(tmp_path, north_first, "cp932"))
    assert np.allclose(read.trajectory.place[0], [-8000, -35000, 5]) and "counts north" in read.notes[0]
    write_trajectory(tmp_path / "again.csv", read, read.trajectory)  # in the order that it came in
    assert (tmp_path / "again.csv").read_text(encoding="utf-8").splitlines()[1].startswith("10.000000,-35000.0000,-80")
    rows = [",".join([row[0], row[2], row[1], *row[3:]]) for row in
            (line.split(",") for line in driven(-35000.0, -8000.0, 70.0))]
    read = read_trajectory(written(tmp_path, "\n".join([f"時刻,{names},標高,ロール,ピッチ,方位角", *rows]), "cp932"))
    assert np.allclose(read.trajectory.place[0], [-8000, -35000, 5])


def test_headings_along_the_diagonal_tell_nothing(tmp_path):
    text = "\n".join(["時刻,X座標,Y座標,標高,ロール,ピッチ,方位角", *driven(-35000.0, -8000.0, 45.0)])
    with pytest.raises(PreviewNeeded, match="may count north or east"):
        read_trajectory(written(tmp_path, text))


@pytest.mark.parametrize("names", ["X座標(北),Y座標(東)", "平面直角X,平面直角Y", "X(N),Y(E)", "9系X座標,9系Y座標"])
def test_names_that_say_which_coordinate_counts_north_are_read(tmp_path, names):
    text = f"点名,{names},標高,時刻,計測東,計測北\nA,-35000,-8000,3,10,-8000.1,-35000.1\n"
    assert np.allclose(read_control(written(tmp_path, text, "cp932")).true[0], [-8000, -35000, 3])


def test_names_that_contradict_each_other_are_left_to_the_user(tmp_path):
    text = "点名,X座標(北),Y座標(北),標高,時刻,計測東,計測北\nA,-35000,-8000,3,10,-8000.1,-35000.1\n"
    with pytest.raises(PreviewNeeded):
        read_control(written(tmp_path, text))


def test_places_in_the_survey_tell_the_order_of_the_true_ones(tmp_path):
    text = "点名,X座標,Y座標,標高,時刻,計測東,計測北\nA,-35000,-8000,3,10,-8000.1,-35000.1\n"
    assert np.allclose(read_control(written(tmp_path, text)).true[0], [-8000, -35000, 3])
    near = "点名,X座標,Y座標,標高,時刻,計測東,計測北\nA,-8000,-8050,3,10,-8000.1,-8050.1\n"  # both orders fit
    with pytest.raises(PreviewNeeded):
        read_control(written(tmp_path, near))


def test_sizes_of_utm_tell_the_order(tmp_path):
    text = "写真名,X座標,Y座標,標高,ω,φ,κ\nf1,412000,3950000,300,0,0,90\n"
    pose, = read_exterior(written(tmp_path, text, "cp932"))
    assert (pose.x, pose.y) == (412000.0, 3950000.0)


def test_capital_letters_beside_japanese_names_are_not_taken_for_east_and_north(tmp_path):
    text = "写真名,X,Y,標高,ω,φ,κ\nf1,-35000,-8000,300,0,0,90\n"
    with pytest.raises(PreviewNeeded, match="X, Y may count north or east"):
        read_exterior(written(tmp_path, text))
    assert read_exterior(written(tmp_path, text.replace("X,Y", "x,y")))[0].x == -35000.0


def test_degrees_are_sent_to_the_preview(tmp_path):
    for read, header in ((read_control, "点名,緯度,経度,標高,時刻,計測東,計測北"),
                         (read_trajectory, "時刻,緯度,経度,楕円体高,ロール,ピッチ,方位角"),
                         (read_image_poses, "画像名,時刻,北緯,東経,標高,ロール,ピッチ,方位角")):
        with pytest.raises(PreviewNeeded, match="latitude and longitude .*Import table"):
            read(written(tmp_path, header + "\n" + ",".join("1" * (header.count(",") + 1)) + "\n", "cp932"))


def test_the_name_itself_goes_before_another_name():
    columns = {"altitude": ["9"], "z": ["3"], "x": ["1"]}
    assert known_columns(columns, ("x", "z"), {"altitude": "z"}, "a.csv") == {"z": "z", "x": "x"}


def test_bytes_that_are_no_text_are_refused(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(bytes(range(256)) * 4)
    with pytest.raises(InputError, match="no text in UTF-8"):
        read_trajectory(path)
    path.write_bytes("time,x,y\n1,2,é".encode("latin-1"))  # no Japanese text either
    with pytest.raises(InputError, match="no text in UTF-8"):
        read_trajectory(path)


def test_control_points_of_a_japanese_spreadsheet_are_read(tmp_path):
    text = "点名,東,北,標高,時刻,計測東,計測北,計測標高\r\n基1,1.5,2.5,3.5,10,1.6,2.6,3.4\r\n基2,5,6,,11,5.1,6.1,\r\n"
    control = read_control(written(tmp_path, text, "cp932"))
    assert control.id == ("基1", "基2") and np.allclose(control.true[0], [1.5, 2.5, 3.5])
    assert np.allclose(control.surveyed[:, :2], [[1.6, 2.6], [5.1, 6.1]]) and np.isnan(control.true[1, 2])


def test_a_table_without_the_names_is_left_to_its_reader():
    assert named_rows("a,b\n1,2\n", ("x",), {}, "a.csv") == (("a", "b"), [["1", "2"]], ",")
    assert named_rows("", ("x",), {}, "a.csv") == ((), [], ",")


POSES = ["img_1,10.0,1,2,3,0,0,359", "img_2,10.1,2,2,3,0,0,1", "img_3,10.2,3,2,3,0,0,3"]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "cp932", "utf-16"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t", " "])
def test_image_poses_with_a_head_and_japanese_names_are_read(tmp_path, encoding, delimiter):
    text = "\r\n".join(["車載カメラの姿勢",
                        "画像名,GPS時刻(秒),東(m),北(m),標高(m),ロール(度),ピッチ(度),方位角(度),備考",
                        *(f"{row},良" for row in POSES)])
    poses = read_image_poses(written(tmp_path, text.replace(",", delimiter), encoding))
    assert poses.id == ("img_1", "img_2", "img_3") and poses.others == {"備考": ("良",) * 3}
    assert np.allclose(poses.place[:, 0], [1, 2, 3]) and np.allclose(poses.angles[:, 2], [359, 361, 363])


def test_image_poses_of_inertial_explorer_are_read(tmp_path):
    text = ("Project: drive\nDatum: JGD2011\n\n  Event     GPSTime   Easting  Northing   H-Ell  Roll  Pitch  Heading\n"
            "              (sec)       (m)       (m)     (m) (deg)  (deg)    (deg)\n"
            "  shot_1     10.000     1.000     2.000   3.000  0.10  -0.20   359.00\n"
            "  shot_2     10.100     2.000     2.000   3.500  0.10  -0.20     1.00\n")
    poses = read_image_poses(written(tmp_path, text, name="export.txt"))
    assert poses.id == ("shot_1", "shot_2") and np.allclose(poses.place[1], [2, 2, 3.5])
    assert np.allclose(poses.angles, [[0.1, -0.2, 359], [0.1, -0.2, 361]])


def test_image_poses_in_radians_are_refused_or_read_as_said_and_come_back_so(tmp_path):
    course = np.radians(np.arange(0, 180, 10.0))
    places = np.cumsum(5.0 * np.column_stack([np.sin(course), np.cos(course)]), axis=0)
    text = "\n".join(["id,time,x,y,z,roll,pitch,heading",
                      *(f"i{k},{k},{x:.4f},{y:.4f},3,0.01,0.02,{course[k]:.6f}" for k, (x, y) in enumerate(places))])
    with pytest.raises(InputError, match="they are radians; say that the angles are counted so"):
        read_image_poses(written(tmp_path, text))
    poses = read_image_poses(written(tmp_path, text), "radians")
    assert np.allclose(poses.angles[:, 2], np.degrees(course), atol=1e-3)
    write_image_poses(tmp_path / "out.csv", poses)
    again = read_image_poses(tmp_path / "out.csv", "radians")
    assert np.allclose(again.angles, poses.angles, atol=1e-5)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "cp932"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t", " "])
def test_tie_points_with_a_head_and_japanese_names_are_read(tmp_path, encoding, delimiter):
    text = "\r\n".join(["タイポイント一覧", "組番号,時刻,計測東(m),計測北(m),基準東(m),基準北(m)", "角,12.5,1,2,3,4",
                        "角,11,5,6,7,8"])
    ties = read_tie_points(written(tmp_path, text.replace(",", delimiter), encoding))
    assert ties.time.tolist() == [11, 12.5]
    assert ties.measured[0].tolist() == [5, 6] and ties.reference[1].tolist() == [3, 4]


@pytest.mark.parametrize(("read", "header"), [
    (read_image_poses, "id,time,X座標,Y座標,z,roll,pitch,heading"),
    (read_tie_points, "set,time,計測X,計測Y,x_ref,y_ref"),
    (read_control, "id,x,y,z,time,計測X座標,計測Y座標,z_mms"),
])
def test_plane_coordinates_of_the_survey_are_not_guessed_either(tmp_path, read, header):
    with pytest.raises(InputError, match="may count north or east"):
        read(written(tmp_path, header + "\n" + ",".join("1" * (header.count(",") + 1)) + "\n"))


def test_the_tables_name_each_column_and_each_other_name_once():
    for table in (TRAJECTORY, CONTROL, IMAGE_POSES, TIE_POINTS, EXTERIOR):
        others = [other for column in table for other in (column.name, *column.others)]
        assert len(others) == len(set(others))
        assert all(plain_name(other) == other for column in table for other in column.others)
        assert {column.unit for column in table} <= {"", "m", "s", "degrees"}


def test_brackets_that_never_close_are_looked_through_once():
    """Quadratic work on a damaged name would take hours here."""
    assert plain_name("height" + "[" * 300_000 + "(m)").startswith("height[")


@pytest.mark.parametrize("kept", ["-wal", "-shm", "-journal"])
def test_a_journal_of_an_earlier_database_does_not_outlive_it(tmp_path, kept):
    target = tmp_path / "a.gpkg"
    target.write_bytes(b"old")
    target.with_name(target.name + kept).write_bytes(b"journal")
    (tmp_path / f"b.gpkg{kept}").write_bytes(b"another's")
    with Staging() as staging:
        staging.scratch_path(target).write_bytes(b"new")
        staging.publish()
    assert target.read_bytes() == b"new" and not target.with_name(target.name + kept).exists()
    assert (tmp_path / f"b.gpkg{kept}").exists()


def test_a_name_of_an_output_that_is_too_long_shows_no_inner_path(tmp_path):
    with Staging() as staging:
        for name in ("n" * 250 + ".gpkg", "町" * 82 + ".tif"):
            with pytest.raises(OutputError, match="at most 247 bytes") as told:
                staging.scratch_path(tmp_path / name)
            assert str(tmp_path) not in str(told.value)
        assert staging.scratch_path(tmp_path / ("町" * 60 + ".tif")).parent != tmp_path
