"""What stands before the fronts of a sample city: where it may stand, its truth, and that walls are not put on it."""

import laspy
import numpy as np
import pytest
import shapely

from urbanmap_qgis.facades.building_plans import building_plans
from urbanmap_qgis.facades.wall_stage import find_walls
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.trajectory import joined_trajectory, move_points
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity.drive.mms import write_mms
from urbanmap_qgis.samplecity.scene.fronts import KINDS
from urbanmap_qgis.samplecity.scene.model import GROUND, FaceKind
from urbanmap_qgis.samplecity.scene.world import make_scene
from urbanmap_qgis.samplecity.truth.edges import true_rails
from urbanmap_qgis.samplecity.truth.stage import write_truth


@pytest.fixture(scope="module")
def scene():
    return make_scene(120.0, "canyon", 7, ["fronts"])


def test_every_kind_stands_clear_before_its_own_front(scene):
    assert {thing.kind for thing in scene.before_fronts} == set(KINDS)
    outline = {building.id: building.outline for building in scene.buildings}
    everything = shapely.union_all(list(outline.values()))
    for thing in scene.before_fronts:
        assert 0.3 < thing.before < 3.01 and thing.z_high > thing.z_low
        places = shapely.get_coordinates(shapely.segmentize(thing.line, 1.0))
        away = shapely.distance(outline[thing.building], shapely.points(places))
        # In a corner of the building its other wing is nearer.
        assert away.max() == pytest.approx(thing.before, abs=1e-6) == np.median(away)
        for box in thing.boxes:
            assert shapely.area(shapely.intersection(box.plan, everything)) < 1e-6
        corners = np.concatenate([shapely.get_coordinates(box.plan) for box in thing.boxes])
        u, v = scene.ground.to_local(*corners.T)
        for street in scene.ground.streets:
            assert (np.abs((v if street.along == "u" else u) - street.at) > street.half_width).all()


def test_the_city_is_as_ever_but_for_them(scene):
    plain = make_scene(120.0, "canyon", 7)
    assert plain.before_fronts == () and plain.buildings == scene.buildings
    count = len(plain.furniture)
    assert scene.furniture[:count] == plain.furniture and len(scene.furniture) > count
    assert make_scene(120.0, "canyon", 7, ["fronts"]).before_fronts == scene.before_fronts
    # Garden walls are as narrow and long as rails, and are none.
    assert len(true_rails(scene).geometries) == len(true_rails(plain).geometries)


def test_a_canopy_has_an_underside(scene):
    faces = scene.static_faces(GROUND)
    front = faces.kind == FaceKind.FRONT
    low = [thing.z_low for thing in scene.before_fronts if thing.kind == "canopy"]
    under = front & (faces.normal[:, 2] < -0.99)
    assert low and all(np.isclose(faces.corners[under][:, 0, 2], z).any() for z in low)


def test_the_truth_tells_them(scene, tmp_path):
    import sqlite3

    write_truth(scene, tmp_path)
    with sqlite3.connect(tmp_path / "truth" / "fronts.gpkg") as table:
        rows = table.execute("select building, kind, before, z_low, z_high from fronts").fetchall()
    wanted = [(t.building, t.kind, t.before, t.z_low, t.z_high) for t in scene.before_fronts]
    assert [row[:2] for row in rows] == [one[:2] for one in wanted]
    assert np.array([row[2:] for row in rows]) == pytest.approx(np.array([one[2:] for one in wanted]))


@pytest.mark.slow
def test_walls_are_the_facades_and_not_what_stands_before_them(scene, tmp_path):
    """True places of both surveys; what the street's drives did not see is left out of the count."""
    write_mms(scene, tmp_path, np.random.SeedSequence([7, 102]), SILENT)
    files, drives = [], []
    for name in ("survey_01", "survey_02"):
        reported, true = (read_trajectory(tmp_path / folder / f"{name}_trajectory.csv").trajectory
                          for folder in ("mms", "truth"))
        las = laspy.read(tmp_path / "mms" / f"{name}.laz")
        las.x, las.y, las.z = move_points(np.asarray(las.xyz), np.asarray(las.gps_time), reported, true).T
        files.append(tmp_path / f"{name}.laz")
        las.write(files[-1])
        drives.append(true)
    plans = building_plans([building.outline for building in scene.buildings],
                           [building.id for building in scene.buildings])
    walls, _ = find_walls(open_cloud(files), plans, trajectory=joined_trajectory(drives))
    standing = [wall for wall in walls if wall.status == "before the facade"]
    assert len({wall.kind for wall in standing} & set(KINDS)) >= 4 and len(standing) > 12
    shown = {building.id: [shapely.boundary(building.outline)] for building in scene.buildings}
    pilotis = {thing.building for thing in scene.before_fronts if thing.kind == "pilotis"}
    for thing in scene.before_fronts:
        if thing.kind == "pilotis":  # the storeys over the columns are the facade, and their side walls
            shown[thing.building] += [shapely.boundary(shapely.force_2d(thing.boxes[0].plan))]
    found = set()
    for wall in walls:
        if wall.status in ("ok", "partly seen"):
            middle = shapely.centroid(shapely.force_2d(wall.contour.exterior))
            away = shapely.distance(shown[wall.building_id], middle)
            assert away.min() < 0.15
            found |= {wall.building_id} if away[0] > 0.5 else set()
    assert pilotis and found >= pilotis
