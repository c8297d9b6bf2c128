"""Frames adjusted to control points: known errors come back, wrong and clustered points are told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.aerial.frames.camera import ExteriorOrientation, FrameCamera, project_places
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.aerial.orientation.bundle import errors_on_ground
from urbanmap_qgis.aerial.orientation.image_points import ImagePoints, read_image_points
from urbanmap_qgis.aerial.orientation.report import write_control_report
from urbanmap_qgis.aerial.orientation.stage import control_frames, write_exterior
from urbanmap_qgis.errors import InputError, InsufficientDataError

CAMERA = FrameCamera(100.5, 0.004, 14144, 15552, (0.02, -0.03))
TRUE = [ExteriorOrientation(f"写真{n}.tif", 1200.0 + 270.0 * n, 2000.0 + 30.0 * (n % 2), 1250.0, 0.3, -0.2, 1.0 + n)
        for n in range(6)]


def places(count, seed):
    rng = np.random.default_rng(seed)
    return np.column_stack([rng.uniform(900, 2850, count), rng.uniform(1750, 2280, count), rng.uniform(20, 60, count)])


def seen(place, poses=TRUE, noise=0.3, seed=0, check=None, known=None):
    """Points (k, 3) as the frames see them, to so many pixels."""
    rng, rows = np.random.default_rng(seed), []
    for image, pose in enumerate(poses):
        column, row, _ = project_places(CAMERA, pose, *place.T)
        inside = (column > 50) & (column < CAMERA.width - 50) & (row > 50) & (row < CAMERA.height - 50)
        rows += [(image, point, column[point], row[point]) for point in np.flatnonzero(inside)]
    image, point, *pixel = np.array(rows).T
    pixel = np.array(pixel).T + noise * rng.normal(size=(len(image), 2))
    none = np.zeros(len(place), bool)
    return ImagePoints(image.astype(int), point.astype(int), pixel, tuple(pose.image for pose in poses),
                       tuple(f"P{n}" for n in range(len(place))),
                       place if known is None else np.where(known[:, None], place, np.nan),
                       none if check is None else check)


def off(seed, position=0.3, angle=0.05, shared=True):
    """Orientations with errors, the same in all frames or each its own."""
    rng = np.random.default_rng(seed)
    size = np.repeat([position, angle], 3)
    common = size * rng.normal(size=6)
    made = []
    for pose in TRUE:
        x, y, z, omega, phi, kappa = common if shared else size * rng.normal(size=6)
        made.append(replace(pose, x=pose.x + x, y=pose.y + y, z=pose.z + z, omega=pose.omega + omega,
                            phi=pose.phi + phi, kappa=pose.kappa + kappa))
    return made


def errors(poses, ground):
    """(n,) m in plan, at places on the ground, of each frame that sees them."""
    found = []
    for pose, true in zip(poses, TRUE):
        a, b = (np.column_stack(project_places(CAMERA, item, *ground.T)[:2]) for item in (pose, true))
        inside = ((b > 0) & (b < [CAMERA.width, CAMERA.height])).all(axis=1)
        found.append(np.hypot(*(a - b)[inside].T) * CAMERA.ground_pixel(1210.0))
    return np.concatenate(found)


@pytest.mark.paper("J 6.1, step 3")
@pytest.mark.parametrize("seed", range(4))
def test_five_points_bring_frames_back_to_three_centimetres(seed):
    """Frames of one flight, 0.3 m and 0.05 degrees off; each point is seen in two or three of them."""
    given = off(seed)
    control = np.array([[950, 1800, 30], [2700, 1790, 25], [980, 2240, 50], [2750, 2250, 22], [1900, 2010, 40.0]])
    made = control_frames(CAMERA, given, seen(control, seed=seed))
    before, after = errors(given, places(60, 1)), errors(made.adjusted.poses, places(60, 1))
    assert np.sqrt((before**2).mean()) > 0.15
    assert np.sqrt((after**2).mean()) < 0.03
    assert made.left_out_rms() < 0.06 and not made.wrong.any()


def test_frames_with_errors_of_their_own_need_ties():
    given = off(5, shared=False)
    corners = np.array([[950, 1800, 30], [2700, 1790, 25], [980, 2240, 50], [2750, 2250, 22], [1900, 2010, 40.0]])
    place = np.vstack([corners, places(60, 3)])
    known = np.arange(len(place)) < 5
    made = control_frames(CAMERA, given, seen(place, known=known))
    alone = control_frames(CAMERA, given, seen(place[:5]))
    ties, without = (np.sqrt((errors(item.adjusted.poses, places(60, 1)) ** 2).mean()) for item in (made, alone))
    assert ties < 0.1 and ties < 0.5 * without


@pytest.mark.parametrize("seed", range(3))
def test_standard_deviations_hold(seed):
    given = off(seed, shared=False)
    place = places(40, 10 + seed)
    made = control_frames(CAMERA, given, seen(place, seed=seed, known=np.arange(40) < 15))
    true = np.array([[getattr(pose, name) for name in ("x", "y", "z", "omega", "phi", "kappa")] for pose in TRUE])
    found = np.array([[getattr(pose, name) for name in ("x", "y", "z", "omega", "phi", "kappa")]
                      for pose in made.adjusted.poses])
    assert (np.abs(found - true) < 3.5 * made.adjusted.sigma).all()
    assert 0.3 < np.sqrt(np.mean(((found - true) / made.adjusted.sigma) ** 2)) < 1.6


def test_a_wrong_point_is_told_and_not_followed():
    given = off(7)
    place = places(9, 4)
    wrong = place.copy()
    wrong[3] += [1.5, -1.0, 0.0]
    points = replace(seen(place), place=wrong)
    made = control_frames(CAMERA, given, points)
    assert made.wrong.tolist() == [number == 3 for number in range(9)]
    assert "P3" in " ".join(made.findings)
    assert made.followed.tolist() == [number != 3 for number in range(9)]
    others = made.rms(np.arange(9) != 3, before=True), made.rms(np.arange(9) != 3)
    assert (made.rms(made.followed, before=True), made.rms(made.followed)) == others and others[1] < 0.05
    assert made.rms(points.control) > 0.5
    assert np.sqrt((errors(made.adjusted.poses, places(60, 1)) ** 2).mean()) < 0.05


def test_few_and_clustered_points_are_told():
    place = places(6, 4)
    few = control_frames(CAMERA, off(1), seen(place[:2]))
    assert "not how it is tilted" in few.findings[0]
    near = np.array([[2000, 2000, 30], [2060, 2010, 30], [2020, 2080, 30], [2070, 2090, 40.0]])
    assert any("close together" in text for text in control_frames(CAMERA, off(1), seen(near)).findings)


def test_exact_orientations_stay():
    made = control_frames(CAMERA, TRUE, seen(places(8, 4), noise=0.0))
    for pose, true in zip(made.adjusted.poses, TRUE):
        assert pose.centre == pytest.approx(true.centre, abs=1e-4)
        assert (pose.omega, pose.phi, pose.kappa) == pytest.approx((true.omega, true.phi, true.kappa), abs=1e-5)


def test_errors_on_the_ground_are_those_of_the_orientation():
    """A frame 1.5 m too far east and 0.5 m too far south puts its pixels there, at any height; ties have none."""
    shifted = [replace(pose, x=pose.x + 1.5, y=pose.y - 0.5) for pose in TRUE]
    points = seen(places(8, 4), noise=0.0, known=np.arange(8) < 5)
    found, known = errors_on_ground(CAMERA, shifted, points), points.known[points.point]
    assert found[known] == pytest.approx(np.broadcast_to([1.5, -0.5], found[known].shape), abs=1e-6)
    assert np.isnan(found[~known]).all()
    assert control_frames(CAMERA, shifted, points).before[known] == pytest.approx(found[known], abs=0)


def test_corrections_are_corrected_less_given():
    given = off(3)
    adjusted = control_frames(CAMERA, given, seen(places(8, 4))).adjusted
    for pose, before, row in zip(adjusted.poses, given, adjusted.correction):
        names = ("x", "y", "z", "omega", "phi", "kappa")
        assert row == pytest.approx([getattr(pose, name) - getattr(before, name) for name in names], abs=1e-9)


def test_control_points_that_all_contradict_the_ties_are_refused():
    place = places(60, 3)
    points = seen(place, known=np.arange(60) < 5)
    rng = np.random.default_rng(0)
    moved = np.where(points.known[:, None], place + rng.choice([-80.0, 80.0], (60, 3)), np.nan)
    with pytest.raises(InsufficientDataError, match="All control points contradict"):
        control_frames(CAMERA, TRUE, replace(points, place=moved))


def test_check_points_only_check():
    check = np.arange(8) >= 5
    points = seen(places(8, 4), check=check)
    made = control_frames(CAMERA, off(2), points)
    moved = replace(points, place=np.where(check[:, None], points.place + 5.0, points.place))
    again = control_frames(CAMERA, off(2), moved)
    assert made.adjusted.poses == again.adjusted.poses
    assert made.rms(check) < 0.06 and again.rms(check) > 6.0


def table(path, points, text=""):
    rows = [f"{points.points[k]},{points.images[n]},{c:.3f},{r:.3f},"
            + ",".join("" if np.isnan(value) else f"{value:.4f}" for value in points.place[k])
            for n, k, (c, r) in zip(points.image, points.point, points.pixel)]
    path.write_text("点名,画像名,列,行,x,y,z\n" + "\n".join([*rows, text]) + "\n", encoding="cp932")
    return path


def test_files_go_in_and_out(tmp_path):
    points = seen(places(8, 4), known=np.arange(8) < 5)
    read = read_image_points(table(tmp_path / "点.csv", points))
    assert read.points == tuple(points.points[n] for n in dict.fromkeys(points.point.tolist()))
    assert read.known.sum() == 5 and read.pixel == pytest.approx(points.pixel, abs=1e-3)
    made = control_frames(CAMERA, off(2), read)
    write_exterior(tmp_path / "out.csv", made.adjusted)
    again = read_exterior(tmp_path / "out.csv")
    assert [pose.image for pose in again] == [pose.image for pose in TRUE]
    assert again[2].centre == pytest.approx(made.adjusted.poses[2].centre, abs=1e-4)
    write_control_report(tmp_path / "report.html", made)
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "P3" in text and text.index("Corrections of the frames") < text.index("Accuracy of the frames")


@pytest.mark.parametrize("row, message", [
    ("P9,写真1.tif,a,5,,,", "no number for column"), ("P9,写真1.tif,5,5,1.0,,", "all three or none"),
    ("{again},5,5,,,", "twice"), ("P9,other.tif,5,5,,,", "does not name"), ("P9,写真1.tif,-9,5,,,", "outside")])
def test_bad_rows_are_refused(tmp_path, row, message):
    points = seen(places(8, 4))
    row = row.format(again=f"{points.points[points.point[0]]},{points.images[points.image[0]]}")
    with pytest.raises(InputError, match=message):
        control_frames(CAMERA, TRUE, read_image_points(table(tmp_path / "p.csv", points, row)))


def test_without_control_points_there_is_nothing_to_do():
    with pytest.raises(InsufficientDataError, match="No control point"):
        control_frames(CAMERA, TRUE, seen(places(8, 4), known=np.zeros(8, bool)))
