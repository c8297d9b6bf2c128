"""The README's picture: QGIS's 3D engine really draws, in the right colours, right side out."""

import importlib.util
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "render_models.py"
SYSTEM_PYTHON = "/usr/bin/python3"

needs_screen = pytest.mark.skipif(
    not os.environ.get("DISPLAY") and shutil.which("xvfb-run") is None,
    reason="no screen and no xvfb-run (apt install xvfb)",
)


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("render_models", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


def box_surfaces(x0, y0, x1, y1, z0, z1):
    """Surfaces of a box, rings counter-clockwise seen from outside."""
    a, b, c, d = (x0, y0), (x1, y0), (x1, y1), (x0, y1)
    walls = [[(*p, z0), (*q, z0), (*q, z1), (*p, z1)] for p, q in ((a, b), (b, c), (c, d), (d, a))]
    return {
        "roof": [[(*p, z1) for p in (a, b, c, d)]],
        "outer wall": walls,
        "ground": [[(*p, z0) for p in (a, d, c, b)]],
    }


def write_models(path, *, surface_type=True):
    features = []
    for kind, rings in box_surfaces(84000, 447000, 84030, 447020, 1, 15).items():
        geometry = {"type": "MultiPolygon", "coordinates": [[[*ring, ring[0]]] for ring in rings]}
        properties = {"building_id": "a", **({"surface_type": kind} if surface_type else {})}
        features.append({"type": "Feature", "properties": properties, "geometry": geometry})
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::28992"}}
    path.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}))
    return path


def render(source, target, *arguments):
    command = [SYSTEM_PYTHON, str(SCRIPT), str(source), str(target), *arguments]
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "VIRTUAL_ENV")}
    return subprocess.run(command, capture_output=True, text=True, timeout=180, env=environment, check=False)


def share_of_colour(picture, *, red_over_blue, brightness):
    """Share of pixels whose red exceeds blue by a range and whose brightest channel lies in a range."""
    rgb = picture[..., :3].astype(int)
    difference, bright = rgb[..., 0] - rgb[..., 2], rgb.max(axis=2)
    hit = (difference >= red_over_blue[0]) & (difference <= red_over_blue[1])
    return float(np.mean(hit & (bright >= brightness[0]) & (bright <= brightness[1])))


def read_picture(path):
    import rasterio

    with rasterio.open(path) as source:
        return np.moveaxis(source.read(), 0, -1)


@pytest.mark.filterwarnings("ignore::rasterio.errors.NotGeoreferencedWarning")
@needs_screen
def test_box_shows_a_red_roof_over_pale_walls(tmp_path):
    target = tmp_path / "box.png"
    result = render(write_models(tmp_path / "box.geojson"), target, "--size", "320x200")
    assert result.returncode == 0, result.stderr
    picture = read_picture(target)
    assert picture.shape[:2] == (200, 320)
    roof = share_of_colour(picture, red_over_blue=(90, 255), brightness=(120, 255))
    wall = share_of_colour(picture, red_over_blue=(5, 60), brightness=(120, 255))
    black = share_of_colour(picture, red_over_blue=(-255, 255), brightness=(0, 20))
    assert roof > 0.1
    assert wall > 0.1
    assert black < 0.02
    rows = np.nonzero((picture[..., 0].astype(int) - picture[..., 2]) > 90)[0]
    assert rows.mean() < 100, "the roof lies in the upper half of the picture"


@pytest.mark.filterwarnings("ignore::rasterio.errors.NotGeoreferencedWarning")
@needs_screen
def test_layer_without_surface_type_is_drawn_in_one_colour(tmp_path):
    target = tmp_path / "box.png"
    source = write_models(tmp_path / "box.geojson", surface_type=False)
    result = render(source, target, "--size", "160x100", "--no-ground")
    assert result.returncode == 0, result.stderr
    picture = read_picture(target)
    assert share_of_colour(picture, red_over_blue=(90, 255), brightness=(0, 255)) == 0
    assert share_of_colour(picture, red_over_blue=(5, 60), brightness=(60, 255)) > 0.2


@needs_screen
def test_missing_layer_is_named_and_leaves_nothing(tmp_path):
    source = write_models(tmp_path / "box.geojson")
    result = render(source, tmp_path / "box.png", "--layer", "walls")
    assert result.returncode == 1
    assert "no layer 'walls' of 3D polygons" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["box.geojson"]


@pytest.mark.parametrize("size", ["1600", "0x100", "axb", "9000x100"])
def test_bad_size_is_refused(script, size):
    with pytest.raises(SystemExit):
        script.parse_arguments(["a.gpkg", "b.png", "--size", size])


@pytest.mark.parametrize("pitch", [0, 40, 75])
@pytest.mark.parametrize("heading", [0, 135, 330])
def test_fitted_view_touches_the_frame_and_shows_all(script, pitch, heading):
    vertices = np.random.default_rng(7).uniform((84000, 447000, 0), (84300, 447100, 40), (500, 3))
    options = SimpleNamespace(pitch=pitch, heading=heading, size=(1600, 1000), zoom=1)
    view = script.fit_view(vertices, options)
    ahead = script.view_direction(pitch, heading)
    camera = view.centre - ahead * view.distance
    azimuth = np.radians(heading)
    right = np.array([np.cos(azimuth), -np.sin(azimuth), 0])
    seen = vertices - camera
    depth = seen @ ahead
    half = np.tan(np.radians(script.FIELD_OF_VIEW / 2))
    x = seen @ right / depth / (half * 1.6)
    y = seen @ np.cross(right, ahead) / depth / half
    assert depth.min() > 0
    assert 0.9 < max(np.abs(x).max(), np.abs(y).max()) < 1, "filled but for the margin"
    assert abs(x.max() + x.min()) < 1e-6
    assert abs(y.max() + y.min()) < 1e-6
