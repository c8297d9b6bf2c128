"""Facade textures: a wall photographed by a line camera comes back undistorted; hiding, evening, packing."""

import cv2
import numpy as np
import pytest
import shapely

from urbanmap_qgis.aerial.frames.camera import ExteriorOrientation, FrameCamera, frame_rays
from urbanmap_qgis.aerial.frames.frame_images import AerialFrame
from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.geometry.solid_faces import solids_of
from urbanmap_qgis.imagery.textures.atlas import LARGEST, coarsest_step, draw_atlas, pack_textures
from urbanmap_qgis.imagery.textures.facade_texture import HIDDEN, NOT_FACED, compensation_gains
from urbanmap_qgis.imagery.textures.facades import facades_of, on_facade, texel_grid
from urbanmap_qgis.imagery.textures.texture_stage import BuildingSolids, buildings_of, summary, texture_buildings
from urbanmap_qgis.imagery.views.obstacles import OccupiedVoxels, obstacles_within, voxels_of
from urbanmap_qgis.imagery.views.views import FrameSource, strip_source
from urbanmap_qgis.mobile.calibration import MountedCamera
from urbanmap_qgis.mobile.lines.line_camera import LineCamera, StripImage, pixel_rays
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.settings.lines import TextureSettings

WIDTH, HEIGHT = 16.0, 9.0
CORNER = np.array([-7000.0, -34000.0, 10.0])


def box(corner, width, depth, height):
    """Faces of a box, counterclockwise seen from outside."""
    steps = np.array([[i * width, j * depth, k * height] for k in (0, 1) for j in (0, 1) for i in (0, 1)])
    rings = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    return shapely.MultiPolygon([shapely.Polygon((corner + steps)[list(ring)]) for ring in rings])


HOUSE = solids_of(box(CORNER, WIDTH, 10.0, HEIGHT))


def drive(speed=8.0, seconds=6.0):
    """Due east, 12 m south of the house, with a shaking body."""
    time = 1000.0 + np.arange(0.0, seconds + 0.005, 0.01)
    way = speed * (time - time[0])
    place = np.column_stack([CORNER[0] - 16.0 + way, np.full(len(time), CORNER[1] - 12.0),
                             np.full(len(time), CORNER[2] + 2.0)])
    shake = np.sin(5.0 * time)
    angles = np.column_stack([0.4 * shake, 0.2 * shake, 90.0 + 0.3 * np.cos(4.0 * time)])
    return Trajectory(time, place, angles)


CAMERA = LineCamera(MountedCamera("1", np.array([-0.5, -0.6, -0.4]), np.array([0.0, 0.0, -90.0])), 640, 270.0, 319.5)


def wall_colour(right, high):
    """A colour that tells the place on the south wall, grey off it."""
    on = (right >= 0) & (right <= WIDTH) & (high >= 0) & (high <= HEIGHT)
    colour = np.column_stack([20 + 200 * right / WIDTH, 20 + 200 * high / HEIGHT, np.full(len(right), 128.0)])
    return np.where(on[:, None], colour, 0.0)


def met(origin, direction):
    """Place right and high on the plane of the south wall where rays meet it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        length = (CORNER[1] - origin[:, 1]) / direction[:, 1]
    at = origin + np.where(length > 0, length, np.nan)[:, None] * direction
    return at[:, 0] - CORNER[0], at[:, 2] - CORNER[2]


def photographed(folder, trajectory, rate=50.0, name="strip.png", factor=1.0):
    """A strip image of the south wall, rendered ray by ray."""
    times = np.arange(trajectory.time[0] + 0.1, trajectory.time[-1] - 0.1, 1.0 / rate)
    strip = StripImage(CAMERA, times, folder / name)
    column, row = (values.ravel() for values in np.meshgrid(np.arange(len(times)), np.arange(CAMERA.rows),
                                                           indexing="ij"))
    colour = wall_colour(*met(*pixel_rays(strip, trajectory, column, row)))
    image = np.nan_to_num(colour).reshape(len(times), CAMERA.rows, 3).swapaxes(0, 1) * factor
    cv2.imwrite(str(folder / name), np.rint(image[:, :, ::-1]).astype(np.uint8))
    return strip


def south_texture(made, house=HOUSE):
    """Texture of the south facade cut out of its image, and its texel's size."""
    face = next(number for number, facade in enumerate(facades_of(house)) if facade.normal[1] < -0.9)
    facade = facades_of(house)[face]
    texture = made.city.shapes[facade.solid].surfaces[facade.face].texture
    image = cv2.imdecode(np.frombuffer(made.images[texture.image], np.uint8), cv2.IMREAD_COLOR)[:, :, ::-1]
    corners = texture.uv[0] * [image.shape[1], image.shape[0]]
    left, low = corners.min(axis=0)
    right, high = corners.max(axis=0)
    top, bottom = round(image.shape[0] - high), round(image.shape[0] - low)
    return image[top:bottom, round(left):round(right)], made.records[face]


def place_errors(image):
    """Errors of the places that the colours tell, m, away from the border; a JPEG's noise is taken out."""
    image = cv2.blur(image.astype(np.float32), (9, 9))
    rows, columns = image.shape[:2]
    right = (np.arange(columns) + 0.5) * WIDTH / columns
    high = (rows - np.arange(rows) - 0.5) * HEIGHT / rows
    told_right = (image[:, :, 0] - 20.0) * WIDTH / 200.0
    told_high = (image[:, :, 1] - 20.0) * HEIGHT / 200.0
    inner = (slice(6, -6), slice(6, -6))
    return (told_right - right)[inner], (told_high - high[:, None])[inner]


@pytest.mark.paper("Z 4.2, textures")
def test_a_wall_comes_back_undistorted_from_a_shaking_camera(tmp_path):
    trajectory = drive()
    source = strip_source(0, "strip.png", photographed(tmp_path, trajectory), trajectory)
    made, = texture_buildings([BuildingSolids(7, HOUSE)], [source], TextureSettings(resolution=0.05))
    image, record = south_texture(made)
    off_right, off_high = place_errors(image)
    # A column of the strip is 16 cm here, a grey value 8 cm.
    assert np.abs(np.median(off_right)) < 0.02 and np.percentile(np.abs(off_right), 99) < 0.08
    assert np.abs(np.median(off_high)) < 0.02 and np.percentile(np.abs(off_high), 99) < 0.05
    assert record.status == "textured" and record.seen > 0.99 and record.images == "strip.png"
    assert record.azimuth == pytest.approx(180.0) and record.detail == pytest.approx(0.16, abs=0.02)
    others = [other for other in made.records if other is not record]
    assert {other.reason for other in others} == {NOT_FACED} and {other.status for other in others} == {"not seen"}
    numbers = summary(made.records)
    assert (numbers["facades"], numbers["textured"], numbers["not_faced"]) == (4, 1, 3)
    assert made.city.attributes["facade_seen"] == pytest.approx(record.seen * WIDTH * HEIGHT / (52 * HEIGHT))


def test_a_frame_textures_a_wall_too(tmp_path):
    camera = FrameCamera(50.0, 0.02, 1200, 900)
    # The camera looks due north, 40 m off: its y axis is up, its -z axis north (J eq. 1).
    pose = ExteriorOrientation("f.png", CORNER[0] + 8, CORNER[1] - 40, CORNER[2] + 5, 90.0, 0.0, 0.0)
    ahead = frame_rays(camera, pose, np.array([599.5]), np.array([449.5]))[0]
    assert np.allclose(ahead, [0, 1, 0], atol=1e-9), "the test's own geometry"
    column, row = np.meshgrid(np.arange(1200.0), np.arange(900.0))
    direction = frame_rays(camera, pose, column.ravel(), row.ravel())
    colour = np.nan_to_num(wall_colour(*met(np.tile(pose.centre, (len(direction), 1)), direction)))
    cv2.imwrite(str(tmp_path / "f.png"), np.rint(colour.reshape(900, 1200, 3)[:, :, ::-1]).astype(np.uint8))
    source = FrameSource(0, "f.png", AerialFrame(tmp_path / "f.png", pose), camera)
    made, = texture_buildings([BuildingSolids(1, HOUSE)], [source])
    image, record = south_texture(made)
    off_right, off_high = place_errors(image)
    assert np.percentile(np.abs(off_right), 99) < 0.08 and np.percentile(np.abs(off_high), 99) < 0.05
    assert record.seen == 1.0


def test_a_building_in_between_hides_the_wall(tmp_path):
    trajectory = drive()
    source = strip_source(0, "s", photographed(tmp_path, trajectory), trajectory)
    wall = BuildingSolids(2, solids_of(box(CORNER - np.array([20.0, 6.0, 0.0]), 60.0, 2.0, 30.0)))
    made = list(texture_buildings([BuildingSolids(1, HOUSE), wall], [source]))
    assert {(record.status, record.reason) for record in made[0].records} == {
        ("not seen", HIDDEN), ("not seen", NOT_FACED)}
    low = BuildingSolids(2, solids_of(box(CORNER - np.array([20.0, 6.0, 0.0]), 60.0, 2.0, 4.0)))
    made = list(texture_buildings([BuildingSolids(1, HOUSE), low], [source]))
    south = next(record for record in made[0].records if record.status == "partly seen")
    # From 2.4 m over 4 m, 4 m off the far edge of a wall 4 m high: the lowest 5.6 m are hidden (similar triangles).
    top = 2.4 + (4.0 - 2.4) * 11.4 / 5.4
    assert south.seen == pytest.approx(1 - top / HEIGHT, abs=0.05)


def test_laser_points_of_a_tree_hide_what_is_behind_it(tmp_path):
    trajectory = drive()
    source = strip_source(0, "s", photographed(tmp_path, trajectory), trajectory)
    rng = np.random.default_rng(0)
    crown = CORNER + np.array([8.0, -5.0, 3.0]) + rng.normal(size=(20_000, 3)) * [0.8, 0.4, 0.8]
    wall = CORNER + np.column_stack([rng.uniform(0, WIDTH, 20_000), rng.normal(0, 0.02, 20_000),
                                     rng.uniform(0, HEIGHT, 20_000)])
    made, = texture_buildings([BuildingSolids(1, HOUSE)], [source],
                              voxels=voxels_of([crown[:9000], crown[9000:], wall]))
    south = next(record for record in made.records if record.status != "not seen")
    assert 0.70 < south.seen < 0.95
    image, _ = south_texture(made)
    assert (image[60:80, 0:100, 2] < 160).all(), "the wall's own points do not hide it"


def test_a_facade_that_no_image_reaches_says_so(tmp_path):
    trajectory = drive()
    source = strip_source(0, "s", photographed(tmp_path, trajectory), trajectory)
    made, = texture_buildings([BuildingSolids(1, HOUSE)], [source], TextureSettings(max_range=8.0))
    assert not made.images and all(record.reason == NOT_FACED for record in made.records)


def test_strip_outside_the_trajectory_is_refused(tmp_path):
    strip = photographed(tmp_path, drive())
    later = drive()
    later = Trajectory(later.time + 500.0, later.place, later.angles)
    with pytest.raises(InputError, match="give those of one survey"):
        strip_source(0, "strip.png", strip, later)


def test_two_strips_of_different_brightness_are_evened(tmp_path):
    trajectory = drive()
    bright = strip_source(0, "a", photographed(tmp_path, trajectory, name="a.png"), trajectory)
    half = Trajectory(trajectory.time, trajectory.place - [0.0, 2.0, 0.0], trajectory.angles)
    cut = photographed(tmp_path, half, name="b.png", factor=0.6)
    # The darker strip shows the eastern half only, and in more detail, because the image is taken more often.
    dark = strip_source(1, "b", cut, half)
    made, = texture_buildings([BuildingSolids(1, HOUSE)], [bright, dark])
    image, _ = south_texture(made)
    ratio = image[60, 20:-20, 2].astype(float)
    assert ratio.max() - ratio.min() < 4.0


def test_gains_are_the_inverse_of_what_was_put_in():
    rng = np.random.default_rng(1)
    truth = rng.uniform(60, 150, (4000, 3))
    factors = np.array([[1.0, 1.0, 1.0], [0.7, 0.8, 0.9], [1.2, 1.1, 1.0]])
    visible = np.zeros((3, 4000), bool)
    visible[0, :2000], visible[1, 1000:3000], visible[2, 2500:] = True, True, True
    gains = compensation_gains((truth * factors[:, None]).astype(np.float32), visible)
    products = gains * factors
    assert np.allclose(products / products[0], 1.0, atol=1e-3)
    alone = compensation_gains(np.ones((2, 50, 3), np.float32), np.ones((2, 50), bool))
    assert (alone == 1.0).all(), "too few texels in common to compare"


def test_obstacles_hide_by_height_and_cells():
    block = shapely.box(0, 0, 10, 10)
    low, high = np.array([-20.0, -20.0, 0.0]), np.array([30.0, 30.0, 40.0])
    around = obstacles_within(low, high, [block], np.array([8.0]))
    places, normal = np.array([[5.0, 20.0, 2.0], [5.0, 20.0, 20.0]]), np.array([0.0, -1.0, 0.0])
    cameras = np.array([[5.0, -10.0, 2.0], [5.0, -10.0, 2.0]])
    assert around.hidden(places, cameras, normal).tolist() == [True, False]
    cells = np.unique(np.floor(np.random.default_rng(0).uniform([4, 14, 0], [6, 15, 12], (5000, 3)) / 0.25), axis=0)
    leaves = obstacles_within(low, high, [], np.empty(0), OccupiedVoxels(cells.astype(np.int32)))
    assert leaves.hidden(places, cameras, normal).tolist() == [True, False]


def test_facade_frames_have_their_corner_below_left_seen_from_outside():
    found = facades_of(HOUSE)
    assert len(found) == 4
    for facade in found:
        assert np.allclose(np.cross(facade.along, facade.up), facade.normal, atol=1e-9)
        assert np.allclose(facade.up, [0, 0, 1])
        assert facade.origin[2] == pytest.approx(CORNER[2]) and facade.height == pytest.approx(HEIGHT)
        corners = facade.places(np.array([0.0, facade.width]), np.array([0.0, facade.height]))
        assert np.allclose(corners.min(axis=0), np.maximum(corners.min(axis=0), CORNER))
        grid = texel_grid(facade, 0.1)
        assert on_facade(facade, grid).all()


def test_textures_are_packed_without_overlap():
    rng = np.random.default_rng(3)
    shapes = [(int(r), int(c)) for r, c in rng.integers(5, 900, (120, 2))]
    placed = pack_textures(shapes)
    pages = draw_atlas([np.full((*shape, 3), 1 + number, np.uint8) for number, shape in enumerate(shapes)], placed)
    for number, (shape, place) in enumerate(zip(shapes, placed)):
        part = pages[place.page][place.row:place.row + shape[0], place.column:place.column + shape[1]]
        assert part.shape[:2] == shape and (part == 1 + number).all()
    assert max(side for page in pages for side in page.shape[:2]) <= LARGEST


def test_a_very_large_facade_gets_larger_texels():
    step = coarsest_step(500.0, 30.0, 0.05)
    assert 0.1 < step < 0.13 and np.ceil(500.0 / step) + 4 <= LARGEST
    assert coarsest_step(20.0, 30.0, 0.05) == 0.05


def test_buildings_without_heights_or_faces_are_refused():
    with pytest.raises(InputError, match="Building 3 has no heights"):
        buildings_of([3], [shapely.MultiPolygon([shapely.box(0, 0, 1, 1)])])
    with pytest.raises(InsufficientDataError, match="no building model to texture"):
        buildings_of([1, 2], [None, shapely.MultiPolygon()])
