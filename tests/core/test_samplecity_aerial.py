"""The aerial part of the sample city, against formulas written here on their own."""

from __future__ import annotations

import json
from dataclasses import replace

import cv2
import numpy as np
import pytest
import rasterio
import shapely

from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity.aerial.camera import Camera, Exposure, ray_matrix
from urbanmap_qgis.samplecity.aerial.depth_image import DepthImage
from urbanmap_qgis.samplecity.aerial.flight import plan_flight
from urbanmap_qgis.samplecity.aerial.orthophoto import Orthophoto
from urbanmap_qgis.samplecity.aerial.render import BUILDING, VEGETATION, VEHICLE, render_frame
from urbanmap_qgis.samplecity.aerial.stage import make_stage, write_aerial
from urbanmap_qgis.samplecity.aerial.sunlight import Sun
from urbanmap_qgis.samplecity.scene.model import AERIAL, Building, FaceKind, Marking, RoofPart
from urbanmap_qgis.samplecity.scene.world import make_scene

pytestmark = pytest.mark.filterwarnings("ignore::rasterio.errors.NotGeoreferencedWarning")

SUN = Sun(180.0, 60.0)


def pixels_of(camera, exposure, points):
    """Columns and rows of points (n, 3): J eq. 1 to 3 written out term by term."""
    o, p, k = np.radians([exposure.omega, exposure.phi, exposure.kappa])
    gx, gy, gz = (np.asarray(points, float) - [exposure.x, exposure.y, exposure.z]).T
    ax, ay, az = np.cos(k) * gx + np.sin(k) * gy, -np.sin(k) * gx + np.cos(k) * gy, gz
    bx, by, bz = np.cos(p) * ax - np.sin(p) * az, ay, np.sin(p) * ax + np.cos(p) * az
    dx, dy, dz = bx, np.cos(o) * by + np.sin(o) * bz, -np.sin(o) * by + np.cos(o) * bz
    x = camera.principal_point[0] - camera.focal_length / dz * dx
    y = camera.principal_point[1] - camera.focal_length / dz * dy
    return np.column_stack([(camera.width - 1) / 2 + x / camera.pixel_pitch,
                            (camera.height - 1) / 2 - y / camera.pixel_pitch])


def bare_scene(**things):
    """The ground and streets of a small city, with only the things given."""
    nothing = {"buildings": (), "markings": (), "trees": (), "furniture": (), "vehicles": (), "lanes": ()}
    return replace(make_scene(60.0, "canyon", 3), **{**nothing, **things})


def small_flight(scene, tilt=(0.0, 0.0, 0.0), shift=(0.0, 0.0), size=(600, 500)):
    camera = Camera(38.0, 0.006, *size, (0.021, -0.013))
    x, y = np.add(scene.ground.origin, shift)
    z = float(scene.ground_height(x, y)) + 760.0
    return camera, Exposure("frame_01.tif", float(x), float(y), z, *tilt, 181200.0)


def render(scene, camera, exposure, sun=SUN):
    stage = make_stage(scene, camera, [exposure], sun, np.random.SeedSequence(1), SILENT)
    return render_frame(stage, camera, exposure, 1.0, None)


@pytest.fixture(scope="module")
def city():
    return make_scene(60.0, "canyon", 2)


@pytest.fixture(scope="module")
def written(city, tmp_path_factory):
    folder = tmp_path_factory.mktemp("city")
    return folder, write_aerial(city, folder, np.random.SeedSequence(7), SILENT)


def read(path):
    with rasterio.open(path) as source:
        return source.read(), source.profile


def exposures_of(folder):
    camera = json.loads((folder / "aerial" / "camera.json").read_text())
    camera = Camera(camera["focal_length_mm"], camera["pixel_pitch_mm"], camera["image_width"],
                    camera["image_height"], tuple(camera["principal_point_mm"]))
    lines = (folder / "aerial" / "exterior.csv").read_text().splitlines()
    assert lines[0] == "image,x,y,z,omega,phi,kappa"
    return camera, [Exposure(name, *map(float, values), 0.0) for name, *values in (s.split(",") for s in lines[1:])]


def test_rays_run_through_the_points_of_their_pixels():
    camera = Camera(38.0, 0.006, 2400, 2000, (0.02, -0.03))
    exposure = Exposure("f", 10.0, 20.0, 800.0, 0.5, -0.4, 181.2, 0.0)
    points = np.random.default_rng(1).uniform([-100, -100, 10], [120, 140, 90], (50, 3))
    pixels = np.column_stack([pixels_of(camera, exposure, points), np.ones(50)])
    rays = pixels @ ray_matrix(camera, exposure, 700.0).T
    across = np.cross(points - exposure.centre, rays / np.linalg.norm(rays, axis=1, keepdims=True))
    assert np.abs(across).max() < 1e-8


@pytest.mark.parametrize("size", [60.0, 100.0, 149.0, 150.0, 200.0, 300.0, 600.0])
def test_every_place_lies_in_three_frames_or_more(size):
    scene = make_scene(size, "canyon", 4)
    for seed in range(3):
        camera, exposures = plan_flight(scene, np.random.default_rng(seed))
        x, y = shapely.get_coordinates(shapely.segmentize(scene.extent.exterior, size / 10)).T
        x, y = np.append(x, scene.ground.origin[0]), np.append(y, scene.ground.origin[1])
        places = np.column_stack([x, y, scene.ground_height(x, y)])
        seen = sum(((pixels := pixels_of(camera, e, places)) > 0).all(1)
                   & (pixels < [camera.width - 1, camera.height - 1]).all(1) for e in exposures)
        assert seen.min() >= 3
        step = pixels_of(camera, exposures[0], places[:1] + np.array([[0, 0, 0], [1.0, 0, 0]]))
        assert 0.118 < 1 / np.hypot(*(step[1] - step[0])) < 0.122


def test_polygons_cover_the_pixels_whose_centres_they_hold_and_the_nearest_wins():
    rng = np.random.default_rng(5)
    column, row = np.meshgrid(np.arange(60), np.arange(50))
    image, expected = DepthImage(np.full((50, 60), -np.inf, np.float32)), np.full((50, 60), -np.inf)
    label = np.full((50, 60), -1)
    for number in range(40):
        hull = shapely.convex_hull(shapely.multipoints(rng.uniform(-15, 70, (4, 2))))
        plane = rng.normal(size=3)
        image.draw_polygon(shapely.get_coordinates(hull)[:-1], plane, number)
        near = plane[0] * column + plane[1] * row + plane[2]
        here = shapely.contains_xy(hull, column, row) & (near > expected)
        expected[here], label[here] = near[here], number
    assert np.array_equal(image.label, label)
    assert np.allclose(image.nearness[label >= 0], expected[label >= 0], atol=1e-4)


def painted_edge(image, start, end):
    """Place of the edge (0 to 1) along a line from asphalt into paint: where the brightness is halfway."""
    share = np.linspace(0.0, 1.0, 161)
    line = (np.asarray(start) + share[:, None] * np.subtract(end, start)).astype(np.float32)
    values = cv2.remap(image, line[:, :1], line[:, 1:], cv2.INTER_LINEAR).ravel()
    half = (np.median(values[:40]) + np.median(values[-40:])) / 2
    return share[np.flatnonzero(values < half).max()]


def edge_errors(grey, rings):
    """Errors (pixels) of the sides of painted squares, each found at seven places along it, from where they should be.

    Parameters
    ----------
    rings : (n, 4, 2) pixels of the squares' corners.
    """
    errors = []
    for ring in rings:
        centre = ring.mean(axis=0)
        for a, b in zip(ring, np.roll(ring, -1, axis=0)):
            normal = np.array([b[1] - a[1], a[0] - b[0]]) / np.hypot(*(b - a))
            normal *= np.sign(normal @ (centre - a))
            places = a + np.linspace(0.2, 0.8, 7)[:, None] * (b - a)
            found = [painted_edge(grey, p - 4 * normal, p + 4 * normal) for p in places]
            errors.append(8 * (np.mean(found) - 0.5))
    return np.array(errors)


def squares(scene):
    """Unworn white squares of 1.8 m on the carriageways."""
    places = [(u, v) for u in (-22.0, -14.0, 14.0, 22.0) for v in (-4.0, 3.0)] + [(-2.0, 19.0), (3.0, -17.0)]
    plans = [scene.ground.plan_to_world(shapely.box(u - 0.9, v - 0.9, u + 0.9, v + 0.9)) for u, v in places]
    return tuple(Marking(plan, "stop") for plan in plans)


def corners_of(markings, scene):
    x, y = np.moveaxis(np.array([shapely.get_coordinates(m.plan)[:4] for m in markings]), 2, 0)
    return np.stack([x, y, scene.ground_height(x, y)], axis=2)


@pytest.mark.parametrize("tilt", [(0.0, 0.0, 0.0), (0.6, -0.5, 1.4), (-0.4, 0.6, 181.2)])
def test_markings_lie_where_collinearity_puts_them(tilt):
    scene = bare_scene()
    scene = replace(scene, markings=squares(scene))
    camera, exposure = small_flight(scene, tilt, (3.0, -2.0))
    grey = render(scene, camera, exposure).image.astype(np.float32).mean(axis=2)
    corners = corners_of(scene.markings, scene)
    errors = edge_errors(grey, pixels_of(camera, exposure, corners.reshape(-1, 3)).reshape(-1, 4, 2))
    assert np.abs(errors).max() < 0.25
    assert abs(errors.mean()) < 0.05


def test_paint_of_other_epochs_and_worn_off_paint_is_not_seen():
    scene = bare_scene()
    camera, exposure = small_flight(scene, size=(400, 300))
    gone = tuple(replace(m, aerial=False) for m in squares(scene)[:4]) + tuple(
        replace(m, wear=1.0) for m in squares(scene)[4:6])
    half = (replace(squares(scene)[6], wear=0.5),)
    bare, unseen, worn = (render(replace(scene, markings=markings), camera, exposure).image.astype(float)
                          for markings in ((), gone, half))
    assert np.abs(unseen - bare).mean() < 0.02 and np.abs(unseen - bare).max() < 60
    full = render(replace(scene, markings=squares(scene)[6:7]), camera, exposure).image.astype(float)
    assert 0.35 < (worn - bare).sum() / (full - bare).sum() < 0.65


def test_markings_lie_at_their_true_place_in_the_orthophoto():
    scene = bare_scene()
    scene = replace(scene, markings=squares(scene))
    camera, exposure = small_flight(scene, (0.4, -0.5, 0.7))
    frame = render(scene, camera, exposure)
    west, north = np.floor(scene.ground.origin[0] - 30), np.ceil(scene.ground.origin[1] + 26)
    orthophoto = Orthophoto(scene, camera, [exposure], (west, north), (430, 500))
    orthophoto.add(0, frame)
    corners = corners_of(scene.markings, scene)[..., :2]
    rings = np.stack([(corners[..., 0] - west) / 0.12 - 0.5, (north - corners[..., 1]) / 0.12 - 0.5], axis=2)
    assert np.abs(edge_errors(orthophoto.image.astype(np.float32).mean(axis=2), rings)).max() < 0.3
    assert not orthophoto.mask.any()


def tower(scene, height):
    """A block of 12 x 10 m (u, v) to the north-east of the crossing, and the corners of its plan."""
    plan = scene.ground.plan_to_world(shapely.box(12.0, 14.0, 24.0, 24.0))
    base = float(scene.ground_height(plan.centroid.x, plan.centroid.y)) - 0.5
    part = RoofPart(plan, base + height, 0.4, 0.6)
    return Building(1, "rectangle", base, (part,), (160, 150, 140), (120, 120, 120)), part


@pytest.mark.slow
def test_roofs_are_displaced_as_their_height_says():
    scene = bare_scene()
    building, part = tower(scene, 45.0)
    scene = replace(scene, buildings=(building,))
    camera, exposure = small_flight(scene, size=(900, 800))
    mask = render(scene, camera, exposure).mask
    plan = shapely.get_coordinates(part.plan)[:4]
    roof = pixels_of(camera, exposure, np.column_stack([plan, np.full(4, part.z_top)]))
    foot = pixels_of(camera, exposure, np.column_stack([plan, scene.ground_height(*plan.T)]))
    # In a vertical photo the top lies further from the nadir by h / (H - h) of the foot's distance from it.
    nadir = pixels_of(camera, exposure, [[exposure.x, exposure.y, 0.0]])
    rise = part.z_top - scene.ground_height(*plan.T)
    expected = (foot - nadir) * (rise / (exposure.z - part.z_top))[:, None]
    assert np.abs(roof - foot - expected).max() < 1e-6
    outline = shapely.convex_hull(shapely.multipoints(np.concatenate([roof, foot])))
    column, row = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    distance = shapely.distance(outline.exterior, shapely.points(column, row))
    inside = shapely.contains_xy(outline, column, row)
    clear = distance > 0.75
    assert np.array_equal((mask == BUILDING)[clear], inside[clear])
    # Pixels of which half or more shows the building count: a rim of an eighth of a pixel, give or take.
    assert (mask == BUILDING).sum() - outline.area < 0.25 * outline.length


def test_shadows_fall_as_far_as_the_sun_says():
    scene = bare_scene()
    building, part = tower(scene, 20.0)
    scene = replace(scene, buildings=(building,))
    camera, exposure = small_flight(scene, size=(900, 800))
    sun = Sun(215.0, 50.0)
    frame = render(scene, camera, exposure, sun)
    away, reach = np.radians(sun.azimuth + 180.0), 1 / np.tan(np.radians(sun.elevation))
    top, lit = np.array(part.plan.centroid.coords[0]), []
    for share in (0.6, 0.9, 1.3, 1.7):
        # Past the block's middle the shadow ends where its far parapet throws it: 5 to 8 m further.
        place = top + share * (part.z_top - scene.ground_height(*top)) * reach * np.array([np.sin(away), np.cos(away)])
        pixel = np.rint(pixels_of(camera, exposure, [[*place, float(scene.ground_height(*place))]])[0]).astype(int)
        patch = frame.image[pixel[1] - 4:pixel[1] + 5, pixel[0] - 4:pixel[0] + 5].astype(float)
        lit.append(patch.mean() if not frame.mask[pixel[1], pixel[0]] else np.nan)
    shade, light = np.nanmean(lit[:2]), np.mean(lit[2:])
    assert shade < 0.6 * light


def hit_classes(camera, exposure, faces, pixels):
    """Mask value of what the rays of pixels (n, 2) meet first: ray against each face's two triangles."""
    rays = np.column_stack([pixels, np.ones(len(pixels))]) @ ray_matrix(camera, exposure, 700.0).T
    nearest, hit = np.full(len(pixels), np.inf), np.full(len(pixels), -1)
    for number, corners in enumerate(faces.corners):
        for a, b, c in ((corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])):
            normal = np.cross(b - a, c - a)
            with np.errstate(divide="ignore", invalid="ignore"):
                t = normal @ (a - exposure.centre) / (rays @ normal)
                at = exposure.centre + t[:, None] * rays
                inside = np.ones(len(pixels), bool)
                for p, q in ((a, b), (b, c), (c, a)):
                    inside &= np.cross(q - p, at - p) @ normal >= 0
            closer = inside & (t > 0) & (t < nearest)
            nearest[closer], hit[closer] = t[closer], number
    return nearest, hit


@pytest.mark.slow
def test_masks_equal_ray_casting(city, written):
    folder, made = written
    camera, exposures = exposures_of(folder)
    mask = read(folder / "truth" / "occlusion" / exposures[1].image)[0][0]
    rng = np.random.default_rng(3)
    even = (cv2.dilate(mask, np.ones((3, 3), np.uint8)) == cv2.erode(mask, np.ones((3, 3), np.uint8)))
    row, column = np.nonzero(even & (mask != VEGETATION))
    chosen = rng.choice(len(row), 1500, replace=False)
    vehicles = np.flatnonzero(mask[row, column] == VEHICLE)
    chosen = np.concatenate([chosen, rng.choice(vehicles, 300)])
    pixels = np.column_stack([column[chosen], row[chosen]])
    faces = city.faces_at(made["times"][1], AERIAL)
    nearest, hit = hit_classes(camera, exposures[1], faces, pixels)
    rays = np.column_stack([pixels, np.ones(len(pixels))]) @ ray_matrix(camera, exposures[1], 700.0).T
    x, y, z = (exposures[1].centre + np.where(np.isfinite(nearest), nearest, 0.0)[:, None] * rays).T
    hit[(z < city.ground_height(x, y)) | ~np.isfinite(nearest)] = -1
    value = np.where(faces.building > 0, BUILDING, np.where(faces.kind == FaceKind.VEHICLE, VEHICLE, 0))
    expected = np.where(hit < 0, 0, value[hit])
    trunk = (hit >= 0) & (value[hit] == 0)
    assert {0, BUILDING, VEHICLE} <= set(expected)
    assert (expected != mask[row[chosen], column[chosen]])[~trunk].mean() <= 0.002


def test_vehicles_are_where_they_are_at_each_exposure(city, written):
    folder, made = written
    camera, exposures = exposures_of(folder)
    moved = seen = 0
    for exposure, time in zip(exposures, made["times"]):
        mask = read(folder / "truth" / "occlusion" / exposure.image)[0][0]
        for vehicle in city.moving(AERIAL):
            x, y = vehicle.position(time)
            z = float(city.ground_height(x, y)) + vehicle.height
            column, row = np.rint(pixels_of(camera, exposure, [[float(x), float(y), z]])[0]).astype(int)
            if 0 <= column < camera.width and 0 <= row < camera.height:
                seen += mask[row, column] == VEHICLE
                assert mask[row, column] != 0
            x_1, y_1 = vehicle.position(made["times"][0])
            moved = max(moved, float(np.hypot(x - x_1, y - y_1)))
    assert seen >= len(exposures)
    assert moved > 5.0


def test_files_are_of_the_right_kind(city, written):
    folder, made = written
    camera, exposures = exposures_of(folder)
    assert made["frames"] == len(exposures) >= 3
    for exposure in exposures:
        image, profile = read(folder / "aerial" / exposure.image)
        mask, _ = read(folder / "truth" / "occlusion" / exposure.image)
        assert image.shape == (3, camera.height, camera.width) and image.dtype == np.uint8
        assert profile["compress"] == "jpeg" and profile["photometric"] == "ycbcr"
        assert mask.shape == (1, camera.height, camera.width)
        assert set(np.unique(mask)) <= {0, VEHICLE, VEGETATION, BUILDING}
        assert 60 < image[:, mask[0] == 0].mean() < 160
    image, profile = read(folder / "aerial" / "ortho.tif")
    mask, mask_profile = read(folder / "truth" / "occlusion" / "ortho.tif")
    assert profile["crs"].to_epsg() == 6677 and profile["transform"] == mask_profile["transform"]
    assert profile["transform"].a == pytest.approx(0.12) and mask.shape[1:] == image.shape[1:]
    west, north = profile["transform"].c, profile["transform"].f
    x_min, y_min, x_max, y_max = city.extent.bounds
    assert west < x_min and north > y_max
    assert west + 0.12 * image.shape[2] > x_max and north - 0.12 * image.shape[1] < y_min
    assert (image.max(axis=0) > 0).all()
