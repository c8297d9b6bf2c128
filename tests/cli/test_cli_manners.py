"""How a run behaves with missing packages, misspelt parameters, another Python, numbers of choices."""

from __future__ import annotations

import dataclasses
import os

import numpy as np
import pytest

SQUARE = """{"type": "FeatureCollection",
 "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::6677"}},
 "features": [{"type": "Feature", "properties": {"name": "one"}, "geometry": {"type": "Polygon",
  "coordinates": [[[10, 10], [90, 10], [90, 90], [10, 90], [10, 10]]]}}]}"""


@pytest.fixture
def outlines(tmp_path):
    path = tmp_path / "outlines.geojson"
    path.write_text(SQUARE, encoding="utf-8")
    return path


def test_missing_package_is_refused_by_name_with_the_command(linked_profile, tmp_path, outlines, make_cloud):
    """A Python that does not find shapely: the run says so before it starts."""
    hidden = tmp_path / "hidden"
    hidden.mkdir()
    (hidden / "sitecustomize.py").write_text("import sys\nsys.modules['shapely'] = None\n", encoding="utf-8")
    profile = linked_profile()
    path = os.pathsep.join([str(hidden), profile.environment()["PYTHONPATH"]])
    cloud = make_cloud(tmp_path / "cloud.laz", [0.0, 1.0], [0.0, 1.0], [0.0, 1.0])
    done = dataclasses.replace(profile, changes={"PYTHONPATH": path}).run_algorithm(
        "urbanmap:segmentbuildings", POINTS=cloud, FOOTPRINTS=outlines, OUTPUT=tmp_path / "out.laz",
        OUTPUT_BUILDINGS="TEMPORARY_OUTPUT")
    assert done.code == 1
    assert "Python packages missing: shapely" in done.err
    assert "-m pip install" in done.err and "shapely~=2.0" in done.err
    assert "Traceback" not in done.err
    assert not (tmp_path / "out.laz").exists()


def test_unknown_parameter_is_told(run_algorithm, tmp_path, outlines, make_cloud):
    axis = np.linspace(0.0, 100.0, 40)
    x, y = (grid.ravel() for grid in np.meshgrid(axis, axis))
    z = np.where((x > 10) & (x < 90) & (y > 10) & (y < 90), 20.0, 0.0)
    done = run_algorithm(
        "urbanmap:segmentbuildings", POINTS=[make_cloud(tmp_path / "雲 1.laz", x, y, z)], FOOTPRINTS=outlines,
        EXPANSON=2, OUTPUT=tmp_path / "出力.laz", OUTPUT_BUILDINGS=tmp_path / "建物.gpkg")
    assert done.code == 0, done.err
    assert "Unknown parameter EXPANSON is ignored; did you mean EXPANSION?" in str(done.log)
    assert (tmp_path / "出力.laz").is_file() and (tmp_path / "建物.gpkg").is_file()
    assert done.results["OUTPUT"] == str(tmp_path / "出力.laz")


def other_python():
    """Folder of an interpreter on the path that is another build of the same release as the system's; None without."""
    import shutil
    import subprocess

    def told(python):
        return subprocess.run([python, "-c", "import sys; print(sys.version_info[:2], sys.version)"],
                              capture_output=True, text=True, check=False).stdout

    system = told("/usr/bin/python3")
    for folder in os.environ.get("PATH", "").split(os.pathsep):
        python = shutil.which("python3", path=folder)
        found = told(python) if python else ""
        if found and found != system and found.split(")")[0] == system.split(")")[0]:
            return folder
    return None


def test_workers_where_another_python_stands_first_in_the_path(linked_profile, tmp_path, outlines, make_cloud):
    folder = other_python()
    if folder is None:
        pytest.skip("there is no second Python of the same release on the path")
    axis = np.linspace(0.0, 100.0, 60)
    x, y = (grid.ravel() for grid in np.meshgrid(axis, axis))
    z = np.where((x > 10) & (x < 90) & (y > 10) & (y < 90), 20.0, 0.0)
    cloud = make_cloud(tmp_path / "cloud.laz", x, y, z)
    path = os.pathsep.join([folder, os.environ["PATH"]])
    done = dataclasses.replace(linked_profile(), changes={"PATH": path}).run_algorithm(
        "urbanmap:segmentbuildings", POINTS=cloud, FOOTPRINTS=outlines, WORKERS=2, OUTPUT=tmp_path / "out.laz",
        OUTPUT_BUILDINGS=tmp_path / "out.gpkg")
    assert done.code == 0 and "Traceback" not in done.err, done.err
    assert (tmp_path / "out.laz").is_file()


def test_choice_by_its_number(run_algorithm, tmp_path):
    done = run_algorithm("urbanmap:samplecity", SIZE=1, SCENE=1, OUTPUT=tmp_path / "city")
    assert done.code == 1 and "60" in done.err  # the size is what is refused
    done = run_algorithm("urbanmap:samplecity", SIZE=60, SCENE=9, OUTPUT=tmp_path / "city")
    assert done.code == 1 and "is none of canyon, few markings" in done.err
