"""Small known answers to what larger tests pass over: signs, ends, the second of two cases."""

from __future__ import annotations

import laspy
import numpy as np
import pytest

from tests.core.test_levels_of_detail import gable
from tests.core.test_rinex_navigation import glonass, header
from tests.core.test_rinex_observations import epoch_2, epoch_3, field, header_2, header_3, write
from urbanmap_qgis.buildings.party_walls import party_wall_areas
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.rinex.navigation import read_navigation_files
from urbanmap_qgis.gnss.rinex.observation_file import read_observations
from urbanmap_qgis.io.files.staging import Staging
from urbanmap_qgis.io.points.pointcloud import PointLayout, iter_chunks, open_cloud
from urbanmap_qgis.mobile.pose_correction import correction_between
from urbanmap_qgis.mobile.registration.correction.gauss_markov import GaussMarkovDrift
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.roadmap.edges.profile import fit_edge_profile
from urbanmap_qgis.samplecity.faults import ghost_rows
from urbanmap_qgis.samplecity.scene.streets import lowered_kerbs
from urbanmap_qgis.samplecity.scene.world import make_scene
from urbanmap_qgis.terrain.outliers import VOXEL, isolated


def test_a_jump_of_the_trajectory_lets_the_error_jump_by_as_much():
    """The covariance of a step grows by the square of the jump, of the fast drift, and by the walk while it stands."""
    model = GaussMarkovDrift(np.full(6, 0.01), 20.0, np.full(6, 0.002), np.ones(6), 1.0, 0.1)
    path = np.array([0.0, 5.0, 10.0, 15.0, 20.0])
    jump, stopped, fast = np.array([0.0, 3.0, 0.0, 0.0]), np.array([0.0, 0, 4.0, 0]), np.array([0.0, 0, 0, 5.0])
    _, precision = model.steps(path, stopped, jump, (0, 3), fast)
    variance = np.linalg.inv(precision)[:, :, 0, 0]
    assert variance[:, 0] - variance[0, 0] == pytest.approx([0.0, 9.0, 4.0 * 0.1**2, 25.0], rel=1e-6, abs=1e-9)
    assert variance[:, 1] - variance[0, 1] == pytest.approx([0.0, 9.0, 0.0, 0.0], rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("place", [(0, 0, 0), (-6950, -34100, 20), (5000, 90000, 300)])
def test_party_walls_are_the_same_wherever_the_buildings_stand(place):
    pairs = [[gable(0.0)], [gable(8.05, eaves=6.0, ridge=9.0)]]
    moved = [[type(solid)(solid.vertices + place, *(getattr(solid, name) for name in list(
        solid.__dataclass_fields__)[1:])) for solid in solids] for solids in pairs]
    assert party_wall_areas(moved) == pytest.approx([40.0, 40.0], rel=1e-6)


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


def test_strength_digits_behind_codes_that_stand_on_a_further_line(tmp_path):
    """Of RINEX 2 five values are on a line; of RINEX 3 all, the sixth too."""
    row = [field(float(number)) for number in range(1, 6)]
    old = header_2(["L1", "L2", "D1", "D2", "L5", "C1"]) + epoch_2(0.0, ["G01", "G02"], [
        [*row, field(2.0e7, " 5")], [*row, field(2.1e7, " 7")]])
    found = read_observations(write(tmp_path, old))
    assert found.code == pytest.approx([2.0e7, 2.1e7]) and found.cn0.tolist() == [33.0, 45.0]
    new = header_3({"G": ["L1C", "L2W", "D1C", "D2W", "L5X", "C1C"]}) + epoch_3(0.0, [
        "G01" + "".join(row) + field(2.0e7, " 5"), "G02" + "".join(row) + field(2.1e7, " 7")])
    assert read_observations(write(tmp_path, new)).cn0.tolist() == [33.0, 45.0]


@pytest.mark.parametrize("characters", [1, 8, 15, 22])
def test_a_state_vector_that_is_cut_within_its_last_line_is_left_out(tmp_path, characters):
    """Its z would be of fewer digits: 1387 km for -13877.75 km."""
    whole = header(3.04, "N: GNSS NAV DATA    M") + glonass("R01")
    path = tmp_path / "a.nav"
    cut = (whole + glonass("R05")).rstrip("\n").rpartition("\n")
    path.write_text(cut[0] + "\n" + cut[2][:characters])
    assert read_navigation_files([path]).glonass.satellite.tolist() == ["R01"]


def cloud_file(path, offset, point_format, vlr=None):
    header_of = laspy.LasHeader(point_format=point_format, version="1.4")
    header_of.scales, header_of.offsets = [0.001] * 3, offset
    if vlr:
        header_of.vlrs.append(laspy.VLR(vlr, 7, "note", b"content"))
    las = laspy.LasData(header_of)
    las.x, las.y, las.z = np.array([1000.25, 1001.5]), np.array([2000.75, 2002.0]), np.array([30.125, 31.0])
    las.intensity = np.array([5, 6], np.uint16)
    las.write(path)
    return path


@pytest.mark.parametrize("offset", [[0.0, 0.0, 0.0], [900.0, 1900.0, 10.0]])
@pytest.mark.parametrize("point_format", [6, 7])
def test_points_keep_their_place_in_a_layout_of_another_format_or_offset(tmp_path, offset, point_format):
    cloud = open_cloud([cloud_file(tmp_path / "a.las", [0.0] * 3, 7),
                        cloud_file(tmp_path / "b.las", offset, point_format)])
    layout = PointLayout(cloud)
    for chunk in iter_chunks(cloud):
        made = layout.view(layout.adapt(chunk, np.array([False, True])))
        assert (made.x[0], made.y[0], made.z[0]) == pytest.approx((1001.5, 2002.0, 31.0), abs=1e-6)
        assert made.intensity.tolist() == [6]


def test_records_of_others_stay_in_a_layout(tmp_path):
    layout = PointLayout(open_cloud([cloud_file(tmp_path / "a.las", [0.0] * 3, 6, "somebody")]))
    assert [(vlr.user_id, vlr.record_data_bytes()) for vlr in layout.header.vlrs] == [("somebody", b"content")]
    packed = cloud_file(tmp_path / "b.laz", [0.0] * 3, 6, "copc")
    assert not PointLayout(open_cloud([packed])).header.vlrs


def drive(first, last):
    time = np.linspace(first, last, 11)
    place = np.column_stack([10.0 * time, np.zeros(11), np.zeros(11)])
    return Trajectory(time, place, np.zeros((11, 3)))


def test_a_correction_of_another_time_says_both_spans():
    with pytest.raises(InputError, match=r"runs from 50\.0 to 60\.0 s, the reported one from 0\.0 to 10\.0 s"):
        correction_between(drive(0.0, 10.0), drive(50.0, 60.0))
    with pytest.raises(InputError, match=r"runs from 0\.0 to 10\.0 s, the reported one from 50\.0 to 60\.0 s"):
        correction_between(drive(50.0, 60.0), drive(0.0, 10.0))


def test_an_edge_counts_the_points_of_both_its_sides():
    rng = np.random.default_rng(3)
    a = np.concatenate([np.linspace(-0.5, -0.02, 60), np.linspace(0.02, 0.5, 40)])
    profile = fit_edge_profile(a, np.where(a > 0, 0.15, 0.0) + rng.normal(0, 0.002, len(a)))
    assert profile.height == pytest.approx(0.15, abs=0.005)
    assert 60 <= profile.points <= 100


@pytest.mark.parametrize("gap", [1, 2, 3, 50])
def test_empty_levels_are_shrunk_without_bringing_points_together(gap):
    """Two groups of three points: neighbours where they are one voxel apart, strangers beyond."""
    z = 2.0 + VOXEL * np.repeat([0.0, gap], 3)
    flat = np.full(6, 0.5)
    assert isolated(flat, flat, z, neighbours=3).all() == (gap > 1)
    assert not isolated(flat, flat, z, neighbours=2).any()


def test_ghosts_lie_below_ground_points_and_without_ground_there_are_none():
    rng = np.random.default_rng(5)
    place = np.column_stack([rng.uniform(0, 100, (400_000, 2)), np.zeros(400_000)])
    ground = np.arange(400_000) % 2 == 0
    rows, depth = ghost_rows(ground, place, np.random.default_rng(1))
    assert len(rows) == len(depth) > 0 and ground[rows].all() and (depth > 0.1).all() and (depth < 1.1).all()
    assert not len(ghost_rows(np.zeros(400_000, bool), place, np.random.default_rng(1))[0])


def test_lowered_kerbs_lie_within_the_city():
    size = 100.0
    kerbs = lowered_kerbs(make_scene(seed=1, size=size).ground, size)
    assert kerbs and all(-size / 2 < kerb.start < kerb.end < size / 2 for kerb in kerbs)
