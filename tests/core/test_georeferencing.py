"""Raw range scans placed in the map, against matrices written here anew in our axes and in those of Z."""

import gzip

import laspy
import numpy as np
import pytest
from pyproj import CRS
from scipy.spatial.transform import Rotation

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError
from urbanmap_qgis.mobile.calibration import Calibration, MountedScanner, read_calibration
from urbanmap_qgis.mobile.lines.georeferencing import georeference_scans, place_ranges
from urbanmap_qgis.mobile.lines.range_scans import read_scans
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.settings.lines import ScanSettings

LEFT = MountedScanner("left", np.array([0.4, -0.5, -0.4]), np.array([1.5, -88.0, 44.0]), 1, 100.0)
RIGHT = MountedScanner("right", np.array([0.4, 0.5, -0.4]), np.array([0.0, -90.0, -45.0]), 2, 60.0)
BOTH = Calibration((LEFT, RIGHT))
HEADER = "time,angle,range,intensity,scanner\n"


def drive(start=1000.0):
    time = start + np.array([0.0, 0.5, 1.0, 3.0])
    place = np.array([[10.0, 20, 5], [12, 24, 5.1], [14, 29, 5.0], [20, 40, 5.2]])
    angles = np.array([[0.5, 1, 350.0], [1.0, 0, 362], [-1, 2, 368], [0, 0, 380]])
    return Trajectory(time, place, angles)


def by_matrices(trajectory, scanner, time, angle, distance):
    """design: P = p(t) + R(t) (lever arm + R_bs r (cos a, sin a, 0)), one return at a time."""
    points = []
    for t, a, r in zip(time, np.radians(angle), distance):
        p = [np.interp(t, trajectory.time, axis) for axis in trajectory.place.T]
        roll, pitch, heading = (np.interp(t, trajectory.time, axis) for axis in trajectory.angles.T)
        body = Rotation.from_euler("ZYX", [heading, pitch, roll], degrees=True)
        mount = Rotation.from_euler("ZYX", scanner.angles[::-1], degrees=True)
        north, east, down = body.apply(scanner.lever_arm + mount.apply([r * np.cos(a), r * np.sin(a), 0.0]))
        points.append([p[0] + east, p[1] + north, p[2] - down])
    return np.array(points)


def by_the_paper(trajectory, scanner, time, angle, distance):
    """Z eq. 1 with T_hg of eq. 4: homogeneous matrices, HISS x forward, y left, z up, kappa from east anticlockwise.

    The scanner's axes in Z: a range at angle alpha lies at (-r sin alpha, 0, -r cos alpha); they are our (-y, z, -x).
    """
    to_hiss = np.diag([1.0, -1.0, -1.0])
    from_paper = np.array([[0, 0, -1.0], [-1.0, 0, 0], [0, 1.0, 0]])
    t_lh = np.eye(4)
    t_lh[:3, :3] = to_hiss @ Rotation.from_euler("ZYX", scanner.angles[::-1], degrees=True).as_matrix() @ from_paper
    t_lh[:3, 3] = to_hiss @ scanner.lever_arm
    points = []
    for t, alpha, r in zip(time, np.radians(angle), distance):
        shift = np.eye(4)
        shift[:3, 3] = [np.interp(t, trajectory.time, axis) for axis in trajectory.place.T]
        omega, psi, heading = np.radians([np.interp(t, trajectory.time, axis) for axis in trajectory.angles.T])
        kappa = np.pi / 2 - heading
        r_kappa, r_psi, r_omega = np.eye(4), np.eye(4), np.eye(4)
        r_kappa[:2, :2] = [[np.cos(kappa), -np.sin(kappa)], [np.sin(kappa), np.cos(kappa)]]
        r_psi[[0, 0, 2, 2], [0, 2, 0, 2]] = [np.cos(psi), -np.sin(psi), np.sin(psi), np.cos(psi)]
        r_omega[1:3, 1:3] = [[np.cos(omega), -np.sin(omega)], [np.sin(omega), np.cos(omega)]]
        beam = np.array([-r * np.sin(alpha), 0, -r * np.cos(alpha), 1.0])
        p = shift @ r_kappa @ r_psi @ r_omega @ t_lh @ beam
        # Eq. 7 says the same with what is not adjusted taken together (eq. 5).
        q = r_psi @ r_omega @ t_lh @ beam
        again = [q[0] * np.cos(kappa) - q[1] * np.sin(kappa) + shift[0, 3],
                 q[0] * np.sin(kappa) + q[1] * np.cos(kappa) + shift[1, 3], q[2] + shift[2, 3]]
        np.testing.assert_allclose(p[:3], again, atol=1e-12)
        points.append(p[:3])
    return np.array(points)


@pytest.mark.paper("Z 2.2, eq. 1, 4 to 7")
@pytest.mark.parametrize("scanner", BOTH.scanners)
def test_our_axes_and_the_paper_s_give_the_same_point(scanner):
    rng = np.random.default_rng(0)
    time, angle, distance = rng.uniform(1000, 1003, 60), rng.uniform(-180, 180, 60), rng.uniform(1, 90, 60)
    points = place_ranges(drive(), scanner, time, angle, distance)
    np.testing.assert_allclose(points, by_matrices(drive(), scanner, time, angle, distance), atol=1e-9)
    np.testing.assert_allclose(points, by_the_paper(drive(), scanner, time, angle, distance), atol=1e-9)


def test_angle_nought_of_a_scanner_pitched_down_looks_down_and_ninety_right():
    still = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.zeros((2, 3)))
    scanner = MountedScanner("a", np.zeros(3), np.array([0.0, -90.0, 0.0]), 1)
    points = place_ranges(still, scanner, np.zeros(2), np.array([0.0, 90.0]), np.array([5.0, 7.0]))
    np.testing.assert_allclose(points, [[0, 0, -5], [7, 0, 0]], atol=1e-12)


def rows(count=200, start=1000.0, seconds=3.0, seed=0):
    rng = np.random.default_rng(seed)
    return np.column_stack([np.sort(rng.uniform(start, start + seconds, count)), rng.uniform(-150, 150, count),
                            rng.uniform(2, 55, count), rng.integers(0, 4000, count), rng.integers(1, 3, count)])


def write(path, table, header=HEADER, delimiter=","):
    text = header.replace(",", delimiter) + "".join(
        delimiter.join(f"{value:.6f}" for value in row) + "\n" for row in table)
    with gzip.open(path, "wt") if path.suffix == ".gz" else path.open("w") as file:
        file.write(text)
    return path


def expected(table, trajectory):
    points = np.empty((len(table), 3))
    for scanner in BOTH.scanners:
        own = table[:, 4] == scanner.point_source_id
        points[own] = by_matrices(trajectory, scanner, table[own, 0], table[own, 1], table[own, 2])
    return points


def drive_without_gaps(start=1000.0):
    made = drive(start)
    time = start + np.arange(0, 3.01, 0.25)
    return Trajectory(time, *(np.column_stack([np.interp(time, made.time, axis) for axis in values.T])
                              for values in (made.place, made.angles)))


@pytest.mark.parametrize(("name", "delimiter"), [("走査.csv", ","), ("s.csv.gz", ","), ("s.txt", ";"), ("s.csv", "\t")])
def test_tables_become_points_that_keep_what_was_measured(tmp_path, name, delimiter):
    table = rows()
    path = write(tmp_path / name, table, delimiter=delimiter)
    done = georeference_scans([path], drive_without_gaps(), BOTH, tmp_path / "out.laz", CRS.from_epsg(6677).to_wkt())
    las = laspy.read(tmp_path / "out.laz")
    assert done.read == done.written == len(las.x) == 200
    assert done.by_scanner == {1: int((table[:, 4] == 1).sum()), 2: int((table[:, 4] == 2).sum())}
    np.testing.assert_allclose(las.xyz, expected(table, drive_without_gaps()), atol=6e-4)
    for dimension, column, tolerance in (("gps_time", 0, 1e-6), ("angle", 1, 1e-4), ("range", 2, 1e-5),
                                         ("intensity", 3, 0), ("point_source_id", 4, 0)):
        np.testing.assert_allclose(las[dimension], np.round(table[:, column], 6), atol=tolerance)
    assert las.header.parse_crs().to_epsg() == 6677


def test_las_with_polar_dimensions_and_several_files(tmp_path):
    table = rows()
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.add_extra_dims([laspy.ExtraBytesParams("Angle", np.float64), laspy.ExtraBytesParams("Range", np.float64)])
    las = laspy.LasData(header)
    las.x = las.y = las.z = np.zeros(len(table))
    las.gps_time, las.intensity, las.point_source_id = table[:, 0], table[:, 3].astype(int), table[:, 4].astype(int)
    las["Angle"], las["Range"] = table[:, 1], table[:, 2]
    las.write(tmp_path / "polar.laz")
    georeference_scans([tmp_path / "polar.laz", write(tmp_path / "s.csv", table)], drive_without_gaps(), BOTH,
                       tmp_path / "out.las")
    made = laspy.read(tmp_path / "out.las")
    np.testing.assert_allclose(made.xyz, np.vstack([expected(table, drive_without_gaps())] * 2), atol=6e-4)
    np.testing.assert_array_equal(made.intensity[:200], made.intensity[200:])


def test_parquet_is_read_or_its_package_is_named(tmp_path):
    path = tmp_path / "s.parquet"
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        path.write_bytes(b"PAR1")
        with pytest.raises(InputError, match="pip install pyarrow"):
            next(read_scans([path]))
        return
    table = rows()
    parquet.write_table(pyarrow.table(dict(zip(HEADER.strip().split(","), table.T))), path)
    scans, = read_scans([path])
    np.testing.assert_array_equal(scans.distance, table[:, 2])


def test_what_cannot_be_placed_is_counted(tmp_path):
    table = rows(100)
    table[:5, 2] = [0.0, -1.0, np.nan, 200.0, 0.5]
    table[5:8, 0] = [900.0, 1003.5, 5000.0]
    table[8, 4], table[8, 2] = 2, 80.0
    done = georeference_scans([write(tmp_path / "s.csv", table)], drive_without_gaps(), BOTH, tmp_path / "o.laz",
                              settings=ScanSettings(min_range=1.0))
    assert (done.no_return, done.outside, done.too_near, done.too_far) == (3, 3, 1, 2)
    assert done.written == 100 - 9 == len(laspy.read(tmp_path / "o.laz").x)
    wide = georeference_scans([tmp_path / "s.csv"], drive_without_gaps(), BOTH, tmp_path / "o.laz",
                              settings=ScanSettings(max_range=300.0))
    assert wide.too_far == 0 and wide.written == 94


def test_nothing_is_placed_in_a_gap_of_the_trajectory(tmp_path):
    table = rows()
    done = georeference_scans([write(tmp_path / "s.csv", table)], drive(), BOTH, tmp_path / "o.laz")
    assert done.outside == np.count_nonzero((table[:, 0] > 1001) & (table[:, 0] < 1003)) > 50
    assert laspy.read(tmp_path / "o.laz").gps_time.max() <= 1001


def test_weeks_and_adjusted_time_are_told_apart(tmp_path):
    """Scans in seconds of the week, the trajectory in adjusted standard time."""
    start = 2200 * 604800.0 + 1000.0 - 1e9
    table = rows()
    done = georeference_scans([write(tmp_path / "s.csv", table)], drive_without_gaps(start), BOTH, tmp_path / "o.laz")
    las = laspy.read(tmp_path / "o.laz")
    assert done.shift == start - 1000.0 and las.header.global_encoding.gps_time_type == 1
    np.testing.assert_allclose(las.xyz, expected(table, drive_without_gaps()), atol=6e-4)
    np.testing.assert_allclose(las.gps_time, table[:, 0] + done.shift, atol=1e-5)


def test_radians_are_taken_and_suspected(tmp_path):
    table = rows(2000)
    table[:, 1] = np.radians(table[:, 1])
    path = write(tmp_path / "s.csv", np.round(table, 6))
    told = []
    georeference_scans([path], drive_without_gaps(), BOTH, tmp_path / "a.laz", progress=Progress(warn=told.append))
    assert "radians" in told[0]
    georeference_scans([path], drive_without_gaps(), BOTH, tmp_path / "b.laz", settings=ScanSettings(radians=True))
    table[:, 1] = np.degrees(table[:, 1])
    np.testing.assert_allclose(laspy.read(tmp_path / "b.laz").xyz, expected(table, drive_without_gaps()), atol=1e-3)


@pytest.mark.parametrize(("text", "sentence"), [
    ("time,angle,range,scanner\n1000.1,0,5,7\n", "no scanner with point source id 7"),
    ("time,angle,range\n1000.1,0,5\n", "do not say which scanner"),
    ("time,range\n1000.1,5\n", "no column angle"),
    ("time,angle,range,scanner\n1000.1,0,5,1\n1000.1,x,5,1\n", "line 3"),
    ("time,angle,range,scanner\n5,0,5,1\n6,0,5,1\n", "give those of one survey"),
    ("time,angle,range,scanner\n", "no returns"),
    ("time,angle,range,scanner\n1000.1,0,0,1\n", "No return could be placed"),
])
def test_bad_scans_are_told_in_a_sentence(tmp_path, text, sentence):
    path = tmp_path / "s.csv"
    path.write_text(text)
    with pytest.raises((InputError, InsufficientDataError), match=sentence):
        georeference_scans([path], drive_without_gaps(), BOTH, tmp_path / "o.laz")
    assert not list(tmp_path.glob("*.laz"))


def test_files_of_other_kinds_or_cut_off(tmp_path):
    (tmp_path / "s.xyz").write_text("1")
    whole = write(tmp_path / "s.csv.gz", rows(5000)).read_bytes()
    (tmp_path / "cut.csv.gz").write_bytes(whole[:len(whole) // 2])
    for name, sentence in (("s.xyz", "no known kind"), ("none.csv", "do not exist"), ("cut.csv.gz", "cut off")):
        with pytest.raises(InputError, match=sentence):
            georeference_scans([tmp_path / name], drive_without_gaps(), BOTH, tmp_path / "o.laz")
    with pytest.raises(InputError, match="must end in .laz"):
        georeference_scans([tmp_path / "s.csv.gz"], drive_without_gaps(), BOTH, tmp_path / "o.xyz")


def test_a_single_scanner_needs_no_number(tmp_path):
    path = tmp_path / "s.csv"
    path.write_text("time,angle,range\n1000.1,0,5\n")
    georeference_scans([path], drive_without_gaps(), Calibration((LEFT,)), tmp_path / "o.laz")
    assert laspy.read(tmp_path / "o.laz").point_source_id.tolist() == [1]


def test_cancel_leaves_what_was_there(tmp_path):
    (tmp_path / "o.laz").write_bytes(b"before")
    with pytest.raises(Cancelled):
        georeference_scans([write(tmp_path / "s.csv", rows())], drive_without_gaps(), BOTH, tmp_path / "o.laz",
                           progress=Progress(cancelled=lambda: True))
    assert (tmp_path / "o.laz").read_bytes() == b"before" and len(list(tmp_path.glob(".*"))) == 0


def test_sample_city_against_the_true_trajectory(small_city, tmp_path):
    """Every 500th return of the city's scans, placed with the true trajectory, one by one by matrices."""
    calibration = read_calibration(small_city / "lines" / "calibration.json")
    true = read_trajectory(small_city / "truth" / "lines_trajectory.csv").trajectory
    done = georeference_scans([small_city / "lines" / "scans.csv.gz"], true, calibration, tmp_path / "o.laz")
    las = laspy.read(tmp_path / "o.laz")
    assert done.written == len(las.x) > 0.99 * done.read
    some = np.arange(0, len(las.x), 500)
    for scanner in calibration.scanners:
        own = some[np.asarray(las.point_source_id)[some] == scanner.point_source_id]
        assert len(own) > 100
        matrices = by_matrices(true, scanner, las.gps_time[own], las["angle"][own], las["range"][own])
        np.testing.assert_allclose(las.xyz[own], matrices, atol=1e-3)
