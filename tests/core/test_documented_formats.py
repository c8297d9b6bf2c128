"""The page of file formats: its examples are read as they stand, and what it says of other programs' files holds."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.aerial.frames.camera import (
    ExteriorOrientation,
    angles_from_usual_order,
    project_to_frame,
    read_camera,
)
from urbanmap_qgis.aerial.frames.exterior_files import read_exterior
from urbanmap_qgis.aerial.orientation.cloud_points import read_cloud_points
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.control import read_control
from urbanmap_qgis.mobile.image_poses import read_image_poses
from urbanmap_qgis.mobile.lines.range_scans import read_scans
from urbanmap_qgis.mobile.lines.tie_points import read_tie_points
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "formats.md").read_text(encoding="utf-8")

READERS = {
    "Camera": (read_camera, lambda read: read.width, 11310),
    "Exterior orientation": (read_exterior, len, 2),
    "Control points of laser points": (read_cloud_points, len, 2),
    "Trajectory": (read_trajectory, lambda read: len(read.trajectory), 2),
    "Calibration": (read_calibration, lambda read: (len(read.scanners), len(read.cameras)), (2, 1)),
    "Image poses": (read_image_poses, lambda read: len(read.id), 2),
    "Control points": (read_control, len, 2),
    "Tie points": (read_tie_points, len, 2),
    "Range scans and line images": (lambda path: next(read_scans([path])), len, 2),
}


def section(title: str) -> str:
    return PAGE.split(f"\n### {title}\n", 1)[1].split("\n### ", 1)[0]


def example(title: str) -> tuple[str, str]:
    """Suffix and text of a section's example."""
    return re.search(r"^```(csv|json)\n(.*?)^```", section(title), re.M | re.S).groups()


def test_each_example_has_a_reader():
    titles = [part.split("\n", 1)[0] for part in PAGE.split("\n### ")[1:]]
    assert [title for title in titles if "```csv" in section(title) or "```json" in section(title)] == list(READERS)


@pytest.mark.parametrize("title", READERS)
def test_example_is_read(title, tmp_path):
    suffix, text = example(title)
    path = tmp_path / f"example.{suffix}"
    path.write_text(text, encoding="utf-8")
    reader, measure, expected = READERS[title]
    assert measure(reader(path)) == expected


def camera_of(tmp_path, point, p1, p2, radial):
    path = tmp_path / "camera.json"
    path.write_text(json.dumps({
        "focal_length_mm": 3000 * 0.005, "pixel_pitch_mm": 0.005, "image_width": 4000, "image_height": 3000,
        "principal_point_mm": point,
        "distortion": {"model": "brown", "units": "focal", "k1": radial[0], "k2": radial[1], "k3": radial[2],
                       "p1": p1, "p2": p2}}))
    return read_camera(path)


LEVEL = ExteriorOrientation("a", 0.0, 0.0, 100.0, 0.0, 0.0, 0.0)
RADIAL, FIRST, SECOND = (-0.2, 0.08, -0.01), 0.003, -0.002
PLACES = np.random.default_rng(1).uniform((-40, -30, 0), (40, 30, 10), (50, 3))


def plane_coordinates():
    """Ideal x right and y down of places that a level camera looks down at, divided by the focal length."""
    depth = 100.0 - PLACES[:, 2]
    return PLACES[:, 0] / depth, -PLACES[:, 1] / depth


def test_camera_of_metashape(tmp_path):
    x, y = plane_coordinates()
    r2, cx, cy = x**2 + y**2, 12.5, -7.25
    radial = 1 + RADIAL[0] * r2 + RADIAL[1] * r2**2 + RADIAL[2] * r2**3
    u = 4000 / 2 + cx + 3000 * (x * radial + FIRST * (r2 + 2 * x**2) + 2 * SECOND * x * y)
    v = 3000 / 2 + cy + 3000 * (y * radial + SECOND * (r2 + 2 * y**2) + 2 * FIRST * x * y)
    camera = camera_of(tmp_path, [cx * 0.005, -cy * 0.005], FIRST, -SECOND, RADIAL)
    column, row, _ = project_to_frame(camera, LEVEL, PLACES)
    # There the corner of the first pixel is 0, 0; here its middle is.
    assert np.allclose(column + 0.5, u, atol=1e-9) and np.allclose(row + 0.5, v, atol=1e-9)


def test_camera_of_opencv(tmp_path):
    x, y = plane_coordinates()
    r2, cx, cy = x**2 + y**2, 2010.0, 1490.5
    radial = 1 + RADIAL[0] * r2 + RADIAL[1] * r2**2 + RADIAL[2] * r2**3
    u = cx + 3000 * (x * radial + 2 * FIRST * x * y + SECOND * (r2 + 2 * x**2))
    v = cy + 3000 * (y * radial + FIRST * (r2 + 2 * y**2) + 2 * SECOND * x * y)
    point = [(cx - (4000 - 1) / 2) * 0.005, ((3000 - 1) / 2 - cy) * 0.005]
    column, row, _ = project_to_frame(camera_of(tmp_path, point, SECOND, -FIRST, RADIAL), LEVEL, PLACES)
    assert np.allclose(column, u, atol=1e-9) and np.allclose(row, v, atol=1e-9)


@pytest.mark.parametrize("text", [
    "# Cameras (1)\n# PhotoID, X, Y, Z, Omega, Phi, Kappa, r11\na.tif\t1.5\t2.5\t300\t0.5\t-0.25\t90\t0.999\n",
    "imageName X Y Z Omega Phi Kappa\na.tif 1.5 2.5 300  0.5 -0.25 90\n",
], ids=["Metashape", "Pix4D"])
def test_exterior_orientations_of_programs_need_nothing_done(text, tmp_path):
    (tmp_path / "exterior.txt").write_text(text, encoding="utf-8")
    pose, = read_exterior(tmp_path / "exterior.txt")
    assert (pose.image, pose.x, pose.y, pose.z) == ("a.tif", 1.5, 2.5, 300.0)
    assert np.allclose((pose.omega, pose.phi, pose.kappa), angles_from_usual_order(0.5, -0.25, 90.0))


def test_text_of_a_navigation_software_with_blanks(tmp_path):
    path = tmp_path / "export.txt"
    path.write_text("   GPSTime   Easting   Northing  Height   Roll  Pitch  Heading\n"
                    " 361400.00  -7010.05  -34112.47  12.77  -1.47   0.22  72.87\n"
                    " 361401.00  -7002.40  -34110.12  12.77  -1.47   0.22  72.87\n", encoding="utf-8")
    read = read_trajectory(path).trajectory
    assert np.allclose(read.place[1], [-7002.40, -34110.12, 12.77])
    assert np.allclose(read.angles[0], [-1.47, 0.22, 72.87])


def test_angles_of_opendronemap_are_in_the_usual_order(real_data):
    folder = real_data / "aerial" / "odm"
    ours = {pose.image[:-4]: pose for pose in read_exterior(folder / "exterior.csv")}
    lines = (folder / "xyz_opk_original.csv").read_text(encoding="utf-8").splitlines()[1:]
    for name, *numbers in ([part.strip("'") for part in line.split()[:7]] for line in lines):
        found = angles_from_usual_order(*map(float, numbers[3:]))
        assert np.allclose(found, (ours[name].omega, ours[name].phi, ours[name].kappa), atol=1e-3)
    assert len(lines) == 3
