"""Posts, lamps, signals, signs and trees of a made-up street of known geometry."""

from __future__ import annotations

import laspy
import numpy as np
import pytest

from tests.core import object_scene as scene
from tests.core.road_scene import Street, to_local, write_drive
from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.roadmap.objects.axis_fit import fit_axis
from urbanmap_qgis.roadmap.objects.object_pictures import object_map
from urbanmap_qgis.roadmap.objects.street_objects import street_objects
from urbanmap_qgis.settings.roadmap import ObjectSettings

SETTINGS = ObjectSettings(survey_sigma=0.0)
FLAT = Street(kerb=0.0, length=30.0)


def found_of(tmp_path, *makers, angle=0.0, street=FLAT, passes=1, settings=SETTINGS):
    trajectory = write_drive(tmp_path / "drive.las", street, angle, passes,
                             more=lambda rng: np.concatenate([make(rng) for make in makers]))
    return street_objects([tmp_path / "drive.las"], trajectory, settings)


def placed(thing, angle=0.0):
    return to_local(thing.foot[None], angle)[0]


@pytest.mark.paper("J 6.2, objects")
@pytest.mark.parametrize("angle", [0.0, 37.0, 160.0])
def test_each_thing_is_what_it_is_where_it_stands(tmp_path, angle):
    found = found_of(tmp_path, lambda rng: scene.lamp(rng, 4.0, 5.0), lambda rng: scene.signal(rng, 10.0, -6.0),
                     lambda rng: scene.sign(rng, 16.0, 5.0), lambda rng: scene.tree(rng, 21.0, -6.0),
                     lambda rng: scene.post(rng, 26.0, 4.5, 3.0), angle=angle)
    things = sorted(found.objects, key=lambda thing: placed(thing, angle)[0])
    assert [thing.kind for thing in things] == ["lamp post", "signal", "sign", "tree", "pole"]
    assert {thing.status for thing in things} == {"measured"}
    true = np.array([[4.0, 5.0], [10.0, -6.0], [16.0, 5.0], [21.0, -6.0], [26.0, 4.5]])
    feet = np.array([placed(thing, angle) for thing in things])
    assert np.abs(feet[:, :2] - true).max() < 0.03
    assert np.abs(feet[:, 2] + 0.01 * np.abs(true[:, 1])).max() < 0.03
    assert [thing.height for thing in things] == pytest.approx([8.0, 6.0, 2.7, 5.4, 3.0], abs=0.25)
    assert [thing.diameter for thing in things] == pytest.approx([0.16, 0.2, 0.08, 0.25, 0.12], abs=0.04)
    assert things[3].crown == pytest.approx(3.2, abs=0.6) and things[0].crown is None
    assert found.number("lamp post") == 1 and found.path_length > 29.0
    # The arms reach to the path: to the left of the drive from the right side of it, and the other way round.
    course = 90.0 - angle
    assert turned_by(things[0].azimuth, course - 90.0) < 8.0 and turned_by(things[1].azimuth, course + 90.0) < 8.0


def turned_by(one, other):
    return abs((one - other + 180.0) % 360.0 - 180.0)


@pytest.mark.parametrize("turned", [0.0, 20.0, -30.0])
def test_a_board_has_its_size_place_and_direction(tmp_path, turned):
    sign, = found_of(tmp_path, lambda rng: scene.sign(rng, 15.0, 5.0, 0.9, 0.7, turned)).objects
    assert sign.kind == "sign" and (sign.board.width, sign.board.height) == pytest.approx((0.9, 0.7), abs=0.08)
    assert np.abs(to_local(sign.board.centre[None], 0.0)[0] - [14.95, 5.0, 2.4]).max() < 0.05
    # Across the street it faces west or east, whichever side the survey sees; turned, it looks aside by as much.
    assert min(turned_by(sign.azimuth, 90.0 - turned), turned_by(sign.azimuth, 270.0 - turned)) < 5.0


@pytest.mark.parametrize("kind, height, reach, middle, sides", [
    ("signal", 6.5, 4.2, 5.4, (0.24, 1.2, 0.45)), ("signal", 6.5, 3.0, 5.5, (0.3, 0.36, 1.06)),
    ("signal", 3.6, 0.45, 3.0, (0.2, 0.38, 0.82)), ("signal", 3.4, 0.25, 2.5, (0.25, 0.28, 0.85)),
    ("lamp post", 9.0, 2.0, 8.9, (0.35, 0.75, 0.14))],
    ids=["Japan, over the road", "Germany, over the road", "Japan, walkers", "Germany, beside the road", "Japan, lamp"])
def test_heads_of_the_sizes_of_standards_tell_the_kind(tmp_path, kind, height, reach, middle, sides):
    thing, = found_of(tmp_path, lambda rng: np.concatenate([
        scene.post(rng, 15.0, 5.5, height, 0.15), scene.bar(rng, 15.0, 5.5, middle, reach),
        scene.box(rng, 15.0, 5.5 - reach, middle, sides)])).objects
    assert thing.kind == kind and thing.confidence > 0.5 and thing.second != kind


@pytest.mark.parametrize("angle", [0.0, 37.0])
def test_a_board_of_a_gantry_hangs_over_the_road(tmp_path, angle):
    """It is its post's, 3 m aside of that, with its own size, and the post stands where it does."""
    sign, = found_of(tmp_path, lambda rng: scene.gantry(rng, 15.0, 5.0), angle=angle).objects
    assert (sign.kind, sign.status) == ("sign", "measured")
    assert np.abs(placed(sign, angle)[:2] - [15.0, 5.0]).max() < 0.03
    assert np.abs(to_local(sign.board.centre[None], angle)[0] - [14.85, 2.0, 6.1]).max() < 0.06
    assert (sign.board.width, sign.board.height) == pytest.approx((1.8, 1.4), abs=0.08)


def test_a_front_that_goes_on_is_no_board_over_the_road(tmp_path):
    thing, = found_of(tmp_path, lambda rng: np.concatenate([
        scene.post(rng, 24.0, 5.0, 7.0, 0.25), scene.board(rng, 23.85, 1.5, 6.0, 7.0, 2.0, 0.0)])).objects
    assert thing.board is None and abs(placed(thing)[1] - 5.0) < 0.05


def test_a_post_of_which_few_beams_meet_the_upper_half_is_found(tmp_path):
    """Rows of a scanner's upper beams, 0.9 m and more apart, do not take the post below them away."""
    def makers(rng):
        points = scene.post(rng, 15.0, 5.0, 6.5, 0.2)
        z = points[:, 2]
        return points[(z < 2.1) | np.any(np.abs(z[:, None] - [3.0, 4.35, 5.85]) < 0.06, axis=1)]

    pole, = found_of(tmp_path, makers).objects
    assert pole.kind == "pole" and np.abs(placed(pole)[:2] - [15.0, 5.0]).max() < 0.03


@pytest.mark.parametrize("lean", [(0.06, 0.0), (0.0, -0.08)])
def test_a_leaning_post_stands_where_its_foot_is(tmp_path, lean):
    pole, = found_of(tmp_path, lambda rng: scene.post(rng, 15.0, 5.0, 4.0, lean=lean)).objects
    assert np.abs(placed(pole)[:2] - [15.0, 5.0]).max() < 0.04
    assert pole.lean == pytest.approx(np.degrees(np.arctan(np.hypot(*lean))), abs=0.6)


def test_sigma_holds_the_error(tmp_path):
    off, sigma = [], []
    for number in range(4):
        along = np.arange(3.0, 28.0, 4.0) + 0.13 * number
        across = np.where(np.arange(len(along)) % 2, 5.0, -7.0 - 0.3 * number)
        found = found_of(tmp_path, *[lambda rng, a=a, c=c, d=0.1 + 0.02 * number: scene.post(rng, a, c, 3.5, d)
                                     for a, c in zip(along, across)])
        for thing in found.objects:
            place = placed(thing)[:2]
            nearest = np.argmin(np.hypot(along - place[0], across - place[1]))
            off += (place - [along[nearest], across[nearest]]).tolist()
            sigma += [thing.sigma] * 2
    ratio = np.abs(off) / sigma
    assert len(off) == 4 * 7 * 2 and np.mean(ratio < 2.0) > 0.93 and np.sqrt(np.mean(np.square(off))) < 0.02


def test_the_sigma_of_the_survey_is_in_that_of_its_objects(tmp_path):
    make = lambda rng: scene.post(rng, 15.0, 5.0, 3.0)  # noqa: E731
    exact, = found_of(tmp_path, make).objects
    rough, = found_of(tmp_path, make, settings=ObjectSettings(survey_sigma=0.05)).objects
    assert rough.sigma == pytest.approx(np.hypot(exact.sigma, 0.05))


def test_two_passes_see_one_post(tmp_path):
    pole, = found_of(tmp_path, lambda rng: scene.post(rng, 15.0, 5.0, 3.0), passes=2).objects
    assert pole.passes == 2 and np.abs(placed(pole)[:2] - [15.0, 5.0]).max() < 0.03


def test_walls_vehicles_and_lower_things_are_no_objects(tmp_path):
    found = found_of(tmp_path, lambda rng: scene.wall(rng, 2.0, 7.0, 20.0), lambda rng: scene.post(rng, 8.0, 5.0, 0.45),
                     lambda rng: scene.box(rng, 16.0, -5.0, 0.8, (4.4, 1.8, 1.5)))
    assert not found.objects


def test_a_post_beside_a_wall_is_found(tmp_path):
    pole, = found_of(tmp_path, lambda rng: scene.wall(rng, 2.0, 6.0, 26.0), lambda rng: scene.post(
        rng, 15.0, 5.4, 3.0)).objects
    assert np.abs(placed(pole)[:2] - [15.0, 5.4]).max() < 0.03


def test_a_hidden_foot_is_told(tmp_path):
    pole, = found_of(tmp_path, lambda rng: scene.post(rng, 15.0, 5.0, 4.0, low=1.7)).objects
    assert (pole.status, pole.reason) == ("doubtful", "its foot is hidden")
    assert np.abs(placed(pole)[:2] - [15.0, 5.0]).max() < 0.03


def test_a_sign_is_found_whose_post_shows_only_over_a_parked_car(tmp_path):
    """Under the board 0.9 m of the post are bare; without a board so short a piece is no post."""
    def half(rng):
        return scene.post(rng, 15.0, 5.0, 2.1, 0.08, low=1.2)

    sign, = found_of(tmp_path, lambda rng: np.concatenate([
        half(rng), scene.board(rng, 14.95, 5.0, 2.4, 0.8, 0.6, 0.0)])).objects
    assert sign.kind == "sign" and np.abs(placed(sign)[:2] - [15.0, 5.0]).max() < 0.03
    assert not found_of(tmp_path, half).objects


def test_few_points_are_told(tmp_path):
    thin = lambda rng: scene.post(rng, 15.0, 5.0, 3.0, 0.1)[::10]  # noqa: E731
    pole, = found_of(tmp_path, thin).objects  # 19 points
    assert (pole.status, pole.reason) == ("doubtful", "few points")


def test_settings_leave_out(tmp_path):
    make = lambda rng: scene.post(rng, 15.0, 5.0, 3.0, 0.3)  # noqa: E731
    for settings in (ObjectSettings(width=4.0), ObjectSettings(min_height=3.5), ObjectSettings(max_diameter=0.2)):
        assert not found_of(tmp_path, make, settings=settings).objects


def test_heights_of_the_ground_can_be_given(tmp_path):
    trajectory = write_drive(tmp_path / "drive.las", FLAT, more=lambda rng: scene.post(rng, 15.0, 5.0, 3.0))
    ground = lambda x, y: np.where(x > -7010.0, 9.9, np.nan)  # noqa: E731
    pole, = street_objects([tmp_path / "drive.las"], trajectory, SETTINGS, ground).objects
    assert pole.foot[2] == pytest.approx(9.9) and pole.height == pytest.approx(3.1, abs=0.15)
    unknown = lambda x, y: np.full(len(x), np.nan)  # noqa: E731
    assert not street_objects([tmp_path / "drive.las"], trajectory, SETTINGS, unknown).objects


def test_points_of_another_place_are_refused(tmp_path):
    trajectory = write_drive(tmp_path / "drive.las", FLAT)
    away = Trajectory(trajectory.time, trajectory.place + np.array([5000.0, 0.0, 0.0]), trajectory.angles)
    with pytest.raises(InsufficientDataError, match="beside the path"):
        street_objects([tmp_path / "drive.las"], away)


def test_the_axis_of_a_round_post_seen_from_two_sides():
    rng = np.random.default_rng(3)
    angle = np.concatenate([rng.uniform(-0.5, 0.5, 300), 0.5 + rng.uniform(-0.5, 0.5, 200)]) * np.pi
    place = np.column_stack([50.0 + 0.2 * np.cos(angle), 20.0 + 0.2 * np.sin(angle), rng.uniform(0.0, 3.0, 500)])
    from_where = np.repeat([[60.0, 20.0], [50.0, 30.0]], [300, 200], axis=0)
    axis = fit_axis(place + 0.005 * rng.standard_normal(place.shape), from_where)
    assert np.abs(axis.middle[:2] - [50.0, 20.0]).max() < 0.02 and axis.diameter == pytest.approx(0.4, abs=0.03)
    assert np.all(axis.lean == 0.0) and np.all(axis.sigma < 0.025)


def test_what_stands_low_against_a_post_does_not_move_it(tmp_path):
    """A hedge or a box within 0.15 m hangs together with the post: where it ends, the post shows alone."""
    found = found_of(tmp_path, lambda rng: scene.post(rng, 15.0, 5.0, 6.0, 0.18),
                     lambda rng: scene.box(rng, 15.25, 5.0, 0.5, (0.25, 0.12, 1.0)))
    thing, = found.objects
    assert np.abs(placed(thing)[:2] - [15.0, 5.0]).max() < 0.02 and thing.diameter == pytest.approx(0.18, abs=0.03)


def half_seen(rng, turn, lean):
    """A round trunk of 0.4 m, whose seen half turns about it with height, by `turn` radians for each m."""
    z = rng.uniform(0.0, 3.0, 900)
    angle = turn * (z - 1.5) + rng.uniform(-np.pi / 2, np.pi / 2, len(z))
    place = np.column_stack([50.0 + 0.2 * np.cos(angle), 20.0 + 0.2 * np.sin(angle) + lean * z, z])
    return place + 0.005 * rng.standard_normal(place.shape), np.tile([60.0, 20.0], (len(z), 1))


def test_other_sides_at_other_heights_are_no_lean():
    rng = np.random.default_rng(5)
    assert np.all(fit_axis(*half_seen(rng, 0.3, 0.0)).lean == 0.0)
    assert fit_axis(*half_seen(rng, 0.0, 0.05)).lean == pytest.approx([0.0, 0.05], abs=0.01)


def test_the_map_shows_every_object(tmp_path):
    found = found_of(tmp_path, lambda rng: scene.lamp(rng, 4.0, 5.0),
                     lambda rng: scene.post(rng, 15.0, 5.0, 4.0, low=1.7))
    picture = object_map(found.objects, np.array([[-7000.0, -34000.0], [-6970.0, -34000.0]]))
    assert picture.count("<circle") == 2 and picture.count('fill="#ffffff" stroke="#222222"') == 1


@pytest.mark.parametrize("aside, width", [(-0.12, 0.36), (-0.15, 0.45)])
def test_a_narrow_board_does_not_move_its_thin_post(tmp_path, aside, width):
    """Points of a board that reaches to one side pass for the post's where they are near it."""
    found = found_of(tmp_path, lambda rng: np.concatenate([
        scene.post(rng, 15.0, 5.0, 2.9, 0.08), scene.board(rng, 14.95, 5.0 + aside, 2.2, width, 1.0, 0.0)]))
    thing, = found.objects
    off = np.abs(placed(thing)[:2] - [15.0, 5.0])
    assert off.max() < 0.02 and (off < 3 * thing.sigma).all()


@pytest.mark.parametrize("half, middle, width", [(-1.0, 5.0, 0.8), (1.0, 5.2, 0.4)],
                         ids=["the half towards the drive", "the half away from it"])
def test_what_its_post_hides_of_a_board_is_as_wide_as_what_shows(tmp_path, half, middle, width):
    """Seen along its face a post hides the half behind it; a board that shows there alone reaches to that side."""
    def sign(rng):
        face = scene.board(rng, 14.95, 5.0, 2.4, 0.8, 0.6, 0.0)
        return np.concatenate([scene.post(rng, 15.0, 5.0, 2.7, 0.08), face[half * (face[:, 1] - 5.0) > 0.0]])

    thing, = found_of(tmp_path, sign).objects
    assert np.abs(to_local(thing.board.centre[None], 0.0)[0] - [14.95, middle, 2.4]).max() < 0.06
    assert thing.board.width == pytest.approx(width, abs=0.12)
    assert (thing.kind, thing.status) == ("sign", "doubtful")


def test_a_sign_behind_a_parked_car_where_no_ground_shows_is_found(tmp_path):
    """The car hides the ground about the post; leaves over it are the lowest things there."""
    def behind(rng):
        whole = scene.sign(rng, 15.0, 6.5)
        high = whole[whole[:, 2] > 0.9]
        return np.concatenate([high,
                               scene.leaves(rng, 15.5, 7.0, 6.6, 3.2, 40.0)])

    trajectory = write_drive(tmp_path / "drive.las", FLAT, more=behind)
    cloud = laspy.read(tmp_path / "drive.las")
    place = to_local(np.column_stack([cloud.x, cloud.y, cloud.z]), 0.0)
    hidden = (np.abs(place[:, 0] - 15.5) < 2.8) & (place[:, 1] > 3.5) & (place[:, 2] < 0.85)
    cloud.points = cloud.points[~hidden]
    cloud.write(tmp_path / "drive.las")
    things = street_objects([tmp_path / "drive.las"], trajectory, SETTINGS).objects
    sign, = [thing for thing in things if thing.kind == "sign"]
    assert np.abs(placed(sign)[:2] - [15.0, 6.5]).max() < 0.05 and abs(placed(sign)[2] + 0.065) < 0.1
