"""Objects from outlines on images: boards, kerbs and lamps of known place and size come back from their pixels."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.aerial.frames.camera import ExteriorOrientation, FrameCamera, project_to_frame
from urbanmap_qgis.aerial.frames.frame_images import AerialFrame
from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.imagery.objects.image_outlines import image_outlines
from urbanmap_qgis.imagery.objects.object_stage import measure_object
from urbanmap_qgis.imagery.objects.outline_points import outline_points
from urbanmap_qgis.imagery.views.views import FrameSource, strip_source
from urbanmap_qgis.mobile.calibration import MountedCamera
from urbanmap_qgis.mobile.lines.line_camera import LineCamera, StripImage, project_to_strip
from urbanmap_qgis.mobile.trajectory import Trajectory

PLACE = np.array([-7000.0, -34000.0, 10.0])
CAMERA = LineCamera(MountedCamera("1", np.array([-0.5, -0.6, -0.4]), np.array([0.0, 0.0, -90.0])), 2048, 900.0, 1023.5)


@pytest.fixture(scope="module")
def source():
    """A strip taken on a drive due east, 8 m south of `PLACE`."""
    time = 1000.0 + np.arange(0.0, 4.0, 0.01)
    way = 7.0 * (time - time[0])
    place = PLACE + np.column_stack([way - 14.0, np.full(len(time), -8.0), np.full(len(time), 2.0)])
    angles = np.column_stack([0.3 * np.sin(3 * time), 0.2 * np.cos(2 * time), 90 + 0.5 * np.sin(time)])
    trajectory = Trajectory(time, place, angles)
    return strip_source(0, "camera_1.png", StripImage(CAMERA, np.arange(1000.1, 1003.8, 0.0125)), trajectory)


def drawn(source, places, kind=shapely.Polygon):
    """What a user draws on the image over places (n, 3), in QGIS's coordinates."""
    found = project_to_strip(places, source.strip, source.trajectory)
    assert (found.point_index == np.arange(len(places))).all()
    return kind(np.column_stack([found.column + 0.5, -found.row - 0.5]))


def surface(rng, corner, right, up, noise=0.01, spacing=0.06):
    """Laser points on a rectangle."""
    across, high = np.linalg.norm(right), np.linalg.norm(up)
    count = int(across * high / spacing**2)
    at = rng.uniform(size=(count, 2))
    normal = np.cross(right, up) / (across * high)
    return corner + at[:, :1] * right + at[:, 1:] * up + noise * rng.standard_normal((count, 1)) * normal


def board(turn=0.0):
    """Corner and sides of a board 2.4 m wide and 1.1 m high, 3 m above `PLACE`, facing south turned by `turn`."""
    angle = np.radians(turn)
    right = 2.4 * np.array([np.cos(angle), np.sin(angle), 0.0])
    return PLACE + np.array([0.0, 0.0, 3.0]), right, np.array([0.0, 0.0, 1.1])


def wall(rng):
    return surface(rng, PLACE + np.array([-10.0, 4.0, 0.0]), np.array([25.0, 0, 0]), np.array([0, 0, 12.0]),
                   spacing=0.15)


@pytest.mark.paper("J 6.2, objects", "Z 4.2, objects")
@pytest.mark.parametrize("turn", [0.0, 25.0, -35.0])
def test_a_board_before_a_wall_has_its_place_size_and_orientation(source, turn):
    rng = np.random.default_rng(0)
    corner, right, up = board(turn)
    points = np.vstack([wall(rng), surface(rng, corner, right, up)])
    true = np.array([corner, corner + right, corner + right + up, corner + up])
    outlines = image_outlines([drawn(source, true)], None, [source])
    behind, = outline_points(outlines, [points[::2], points[1::2]], 40.0)
    made = measure_object(outlines[0], behind)
    assert made.status == "measured" and made.points > 300
    corners = shapely.get_coordinates(made.geometry, include_z=True)[:4]
    error = np.linalg.norm(corners - true, axis=1)
    assert error.max() < 0.03 and (error < 3 * made.sigma + 0.01).all()
    assert made.width == pytest.approx(2.4, abs=0.03) and made.height == pytest.approx(1.1, abs=0.02)
    assert (made.azimuth - 180.0 + turn + 180) % 360 - 180 == pytest.approx(0.0, abs=1.0)
    assert made.area == pytest.approx(2.64, abs=0.06) and made.z_low == pytest.approx(13.0, abs=0.02)
    assert 0.003 < made.sigma < 0.1 and made.rmse == pytest.approx(0.01, abs=0.004)


def test_sigma_grows_with_the_noise(source):
    sigmas = []
    for noise in (0.005, 0.03):
        corner, right, up = board()
        points = surface(np.random.default_rng(1), corner, right, up, noise)
        outline, = image_outlines([drawn(source, np.array([corner, corner + right, corner + right + up]))], None,
                                  [source])
        sigmas.append(measure_object(outline, outline_points([outline], [points], 40.0)[0]))
    assert sigmas[1].sigma > sigmas[0].sigma and sigmas[1].rmse == pytest.approx(0.03, rel=0.2)


def test_a_pole_is_taken_as_facing_the_camera(source):
    rng = np.random.default_rng(2)
    pole = PLACE + np.column_stack([rng.normal(1.0, 0.01, 300), rng.normal(0, 0.01, 300), rng.uniform(0.5, 4.5, 300)])
    true = PLACE + np.array([[0.92, 0, 0.5], [1.08, 0, 0.5], [1.08, 0, 4.5], [0.92, 0, 4.5]])
    outline, = image_outlines([drawn(source, true)], None, [source])
    made = measure_object(outline, outline_points([outline], [np.vstack([wall(rng), pole])], 40.0)[0])
    assert made.status == "faces the camera" and made.reason
    middle = np.asarray(made.geometry.centroid.coords[0])
    assert np.allclose(middle[:2] - PLACE[:2], [1.0, 0.0], atol=0.05)
    assert made.height == pytest.approx(4.0, abs=0.1)


def test_stray_points_before_the_board_are_passed_over(source):
    rng = np.random.default_rng(3)
    corner, right, up = board()
    stray = corner + right / 2 + [0.0, -3.0, 0.0] + 0.05 * rng.standard_normal((5, 3))
    outline, = image_outlines([drawn(source, np.array([corner, corner + right, corner + right + up, corner + up]))],
                              None, [source])
    made = measure_object(outline,
                          outline_points([outline], [np.vstack([stray, surface(rng, corner, right, up)])], 40.0)[0])
    assert made.geometry.centroid.y == pytest.approx(PLACE[1], abs=0.01)


def test_a_kerb_drawn_as_a_line_lies_on_the_kerb(source):
    rng = np.random.default_rng(4)
    ground = np.column_stack([rng.uniform(-12, 12, 60_000), rng.uniform(-6.5, 3, 60_000), np.zeros(60_000)])
    ground[:, 2] = np.where(ground[:, 1] > -3.0, 0.15, 0.0) + 0.005 * rng.standard_normal(len(ground))
    kerb = PLACE + np.column_stack([np.linspace(-8, 8, 9), np.full(9, -2.95), np.full(9, 0.15)])
    outline, = image_outlines([drawn(source, kerb, shapely.LineString)], None, [source])
    made = measure_object(outline, outline_points([outline], [PLACE + ground], 40.0)[0])
    off = shapely.get_coordinates(made.geometry, include_z=True) - PLACE
    assert made.status == "measured" and made.width == pytest.approx(16.0, abs=0.3)
    assert np.abs(off[:, 1] + 2.95).max() < 0.12 and np.percentile(np.abs(off[:, 2] - 0.15), 80) < 0.06


def test_a_lamp_drawn_as_a_point(source):
    rng = np.random.default_rng(5)
    lamp = PLACE + np.array([2.0, -1.0, 5.0])
    points = lamp + 0.02 * rng.standard_normal((200, 3))
    outline, = image_outlines([drawn(source, lamp[None], lambda xy: shapely.Point(xy[0]))], None, [source])
    made = measure_object(outline, outline_points([outline], [np.vstack([points, wall(rng)])], 40.0)[0])
    assert np.allclose(shapely.get_coordinates(made.geometry, include_z=True), lamp, atol=0.04)


def test_an_outline_without_points_says_so(source):
    corner, right, up = board()
    outline, = image_outlines([drawn(source, np.array([corner, corner + right, corner + right + up]))], None, [source])
    made = measure_object(outline, outline_points([outline], [np.empty((0, 3))], 40.0)[0])
    assert made.geometry is None and made.status == "not measured" and made.reason == "no laser points lie behind it"


def test_a_frame_gives_objects_too():
    rng = np.random.default_rng(6)
    camera = FrameCamera(80.0, 0.005, 4000, 3000)
    pose = ExteriorOrientation("f", *(PLACE + np.array([0, 0, 600.0])), 0.0, 0.0, 0.0)
    source = FrameSource(0, "f.tif", AerialFrame("f.tif", pose), camera)
    roof = surface(rng, PLACE, np.array([12.0, 0, 0]), np.array([0, 9.0, 0]), spacing=0.3)
    true = PLACE + np.array([[1.0, 1, 0], [11, 1, 0], [11, 8, 0], [1, 8, 0]])
    column, row, _ = project_to_frame(camera, pose, true)
    outlines = image_outlines([shapely.Polygon(np.column_stack([column + 0.5, -row - 0.5]))], ["f"], [source])
    made = measure_object(outlines[0], outline_points(outlines, [roof], 50.0)[0])
    assert np.allclose(shapely.get_coordinates(made.geometry, include_z=True)[:4], true, atol=0.02)
    assert np.isnan(made.azimuth) and made.area == pytest.approx(70.0, abs=0.3)


def test_bad_outlines_are_one_sentence(source):
    other = strip_source(1, "camera_2.png", source.strip, source.trajectory)
    inside = shapely.box(10, -60, 30, -50)
    with pytest.raises(InputError, match="does not say on which of the 2 images"):
        image_outlines([inside], [None], [source, other])
    with pytest.raises(InputError, match=r"drawn on c.png, which was not given \(images: camera_1.png"):
        image_outlines([inside], ["c.png"], [source, other])
    with pytest.raises(InputError, match=r"Outline 1 lies outside camera_1.png \(296 x 2048 pixels\)"):
        image_outlines([shapely.box(10, 50, 30, 60)], None, [source])
    with pytest.raises(InsufficientDataError, match="No outline was drawn"):
        image_outlines([None], None, [source])
    assert image_outlines([inside], ["images/Camera_2"], [source, other])[0].source is other
