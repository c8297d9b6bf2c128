"""The faults of a sample city: each is there, is what it is said to be, and touches nothing else."""

from __future__ import annotations

import hashlib
from pathlib import Path

import laspy
import numpy as np
import pytest
import shapely

from tests.stored import stored
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity import write
from urbanmap_qgis.samplecity.faults import FAULTS, LASERS, checked_faults, ghost_rows, laser_of, surface_factor
from urbanmap_qgis.samplecity.scene.model import GROUND
from urbanmap_qgis.samplecity.scene.world import make_scene
from urbanmap_qgis.samplecity.truth.edges import true_kerbs, true_rails

SIZE, SEED = 60.0, 1


CITIES = {"none": (("mms", "als"), ()), "points": (("mms",), ("steps", "ghosts", "rings")),
          "road": (("mms",), ("stops", "surface")), "ground": (("als",), ("ground",))}
"""Sensors and faults of each city."""


@pytest.fixture(scope="module")
def cities():
    """Folders of the mobile surveys and airborne points without faults and with sets of them."""

    def make(folder):
        for name, (sensors, faults) in CITIES.items():
            (folder / name).mkdir()
            for sensor in sensors:
                write._run(sensor, folder / name, (SIZE, "canyon", SEED, faults), SILENT)

    folder = stored("faults", [Path(__file__), *Path(write.__file__).parent.rglob("*.py")], make)
    return {name: folder / name for name in CITIES}


def table(path):
    return np.loadtxt(path, delimiter=",", skiprows=1)


def survey(folder):
    points = laspy.read(folder / "mms/survey_01.laz")
    return points, np.load(folder / "truth/survey_01_labels.npz")


def test_an_unknown_fault_is_refused():
    with pytest.raises(InputError, match="no fault 'fog'.*ghosts"):
        make_scene(SIZE, faults=["fog"])
    assert checked_faults(["rings", "steps", "rings"]) == ("steps", "rings")


def test_the_trajectory_steps_and_nothing_else_of_it_changes(cities):
    plain, faulty = (table(cities[name] / "mms/survey_01_trajectory.csv") for name in ("none", "points"))
    off = faulty - plain
    assert np.array_equal(off[:, [0, 3, 4, 5, 6]], np.zeros((len(off), 5)))
    size = np.hypot(*off[:, 1:3].T)
    assert size[0] == 0 and size[-1] == pytest.approx(2.0, abs=1e-3)
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(plain[:, 1:3], axis=0).T))])
    rising = (size > 0.01) & (size < 1.99)
    assert np.ptp(way[rising]) == pytest.approx(20.0, abs=0.5)
    true = [hashlib.sha256((cities[name] / "truth/survey_01_trajectory.csv").read_bytes()).digest()
            for name in ("none", "points")]
    assert true[0] == true[1]


@pytest.mark.slow
def test_ghosts_lie_below_the_road_in_clusters(cities):
    (plain, _), (faulty, labels) = survey(cities["none"]), survey(cities["points"])
    ghost = labels["material"] == 0
    assert ghost.sum() == len(faulty) - len(plain) and 1e-4 < ghost.mean() < 2e-3 and not labels["ground"][ghost].any()
    ground = labels["ground"] == 1
    tree = shapely.STRtree(shapely.points(faulty.x[ground], faulty.y[ground]))
    _, near = tree.query_nearest(shapely.points(faulty.x[ghost], faulty.y[ghost]), all_matches=False)
    below = np.asarray(faulty.z)[ground][near] - np.asarray(faulty.z)[ghost]
    assert below.min() > 0.1 and below.max() < 1.1 and np.ptp(below) > 0.3
    assert np.all(np.diff(faulty.gps_time) >= 0)


def test_ghosts_need_ground():
    rows, depth = ghost_rows(np.zeros(5000, bool), np.zeros((5000, 3)), np.random.default_rng(1))
    assert not len(rows) and not len(depth)


def test_lasers_differ_and_are_numbered(cities):
    (plain, _), (faulty, labels) = survey(cities["none"]), survey(cities["points"])
    real = labels["material"] > 0
    laser = np.asarray(faulty.user_data)[real]
    assert set(laser.tolist()) == set(range(LASERS)) and not np.asarray(plain.user_data).any()
    ratio = np.asarray(faulty.intensity)[real] / np.maximum(np.asarray(plain.intensity, float), 1)
    strong = np.asarray(plain.intensity) > 1000
    answers = np.array([np.median(ratio[strong & (laser == number)]) for number in range(LASERS)])
    assert np.std(np.log(answers)) > 0.3
    assert laser_of(np.array([-90.0, -89.5, -74.0])).tolist() == [0, 1, 0]


def test_the_road_is_dark_and_bright_by_stretches(cities):
    (plain, a), (faulty, b) = survey(cities["none"]), survey(cities["road"])
    scene = make_scene(SIZE, "canyon", SEED)
    level = {}
    for name, points, labels in (("none", plain, a), ("road", faulty, b)):
        asphalt = (labels["material"] == 1) & (points.point_source_id == 1)
        factor = surface_factor(*scene.ground.to_local(np.asarray(points.x)[asphalt], np.asarray(points.y)[asphalt]))
        level[name] = [np.median(np.asarray(points.intensity)[asphalt][factor == kind]) for kind in (0.4, 1.0, 1.8)]
    dark, usual, bright = np.array(level["road"]) / np.array(level["none"])
    assert dark < 0.75 * usual and bright > 1.4 * usual


def test_paint_is_worn_and_patched_and_rails_stand():
    plain, faulty = make_scene(100.0, "canyon", SEED), make_scene(100.0, "canyon", SEED, ["paint", "rails"])
    painted = [sum(m.plan.area * (1 - m.wear) for m in scene.markings_at(GROUND)) for scene in (plain, faulty)]
    assert painted[1] < 0.85 * painted[0]
    assert any(m.aerial and not m.ground for m in faulty.markings)
    decks = [thing for thing in faulty.furniture[len(plain.furniture):] if thing.z_high - thing.z_low < 0.5]
    assert decks and len(faulty.furniture) > len(plain.furniture) + 2 * len(decks) - 1
    assert faulty.buildings == plain.buildings and faulty.trees == plain.trees and faulty.vehicles == plain.vehicles


def test_kerbs_come_down_at_driveways():
    plain, faulty = make_scene(140.0, "canyon", SEED), make_scene(140.0, "canyon", SEED, ["driveways"])
    assert faulty.ground.lowered and not plain.ground.lowered
    place = faulty.ground.lowered[0]
    street = next(s for s in faulty.ground.streets if s.name == place.street)
    along = np.array([0.5 * (place.start + place.end), place.start - 1.0])
    heights = []
    for scene in (plain, faulty):
        across = street.at + place.side * (street.half_width + np.array([[-0.001], [0.001], [2.0]]))
        u, v = np.meshgrid(along, across[:, 0])
        heights.append(scene.ground_height(*scene.ground.to_world(*((u, v) if street.along == "u" else (v, u)))))
    assert heights[0][1] - heights[0][0] == pytest.approx(0.15, abs=1e-3)
    assert (heights[1][1] - heights[1][0]).tolist() == pytest.approx([0.02, 0.15], abs=1e-3)
    assert heights[1][2].tolist() == pytest.approx(heights[0][2].tolist(), abs=1e-6)
    kerbs, rails = true_kerbs(faulty), true_rails(faulty)
    assert min(kerbs.fields["height"]) == pytest.approx(0.02, abs=0.002) and sum(kerbs.fields["lowered"]) > 8
    assert len(rails.geometries) and min(rails.fields["height"]) > 0.7


def test_gantries_stand_over_the_main_streets_and_change_nothing_else():
    plain, faulty = (make_scene(120.0, "canyon", SEED, faults) for faults in ((), ("gantries",)))
    more = faulty.furniture[len(plain.furniture):]
    assert len(more) == 10 and [box.z_high for box in faulty.furniture[:-10]] == [box.z_high for box in plain.furniture]
    boards = [box for box in more if box.z_high - box.z_low == pytest.approx(1.5)]
    assert len(boards) == 4
    for box in boards:
        x, y = box.plan.centroid.x, box.plan.centroid.y
        assert box.plan.area == pytest.approx(2.0 * 0.05) and 5.4 < box.z_low - float(faulty.ground_height(x, y)) < 5.7


@pytest.mark.parametrize("country, wide", [("japan", 1.2), ("germany", 0.36), ("us", 0.62)])
def test_street_furniture_of_a_country_has_the_sizes_of_its_standards(country, wide):
    furniture = make_scene(120.0, "canyon", SEED, (country,)).furniture
    posts = [box for box in furniture if box.standing]
    assert {box.standing for box in posts} == {"pole", "lamp post", "sign", "signal"}
    reach = [max(np.ptp(np.array(box.plan.minimum_rotated_rectangle.exterior.coords), axis=0)) for box in posts]
    assert max(reach) < 0.5 and len(posts) > 20
    widths = [np.hypot(*np.diff(np.array(box.plan.exterior.coords), axis=0).T).max() for box in furniture]
    assert any(abs(width - wide) < 1e-6 for width in widths)


def test_a_whole_city_says_its_faults(tmp_path):
    write._write_summary(_truth_folder(tmp_path), {"footprints": {"building_of": {}}}, SIZE, "canyon", SEED, ("rails",))
    assert FAULTS["rails"] in (tmp_path / "README.txt").read_text()


def _truth_folder(folder):
    (folder / "truth").mkdir()
    return folder
