"""The demo's stages on the smallest sample city, through `qgis_process`, checked against the truth as the demo does."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from scripts.demo import checks as demo_checks
from scripts.demo.stages import stages
from scripts.layers import read_raster

# Stage: what may be (figure begins with, lowest, greatest). Each bound is some times what is reached.
SANE = {
    "Sample city": [("mobile surveys as delivered, mean", 0.3, 2.0), ("the same, greatest", 0.5, 3.0)],
    "Load GSI buildings": [("outlines loaded", 1, 1), ("greatest distance", 0, 0.002)],
    "Surface and ground from ALS": [("ground outside", 0.001, 0.06), ("ground: share", 0.99, 1),
                                    ("surface on", 0.005, 0.5)],
    "Buildings from unclassified ALS": [("buildings modelled", 1, 1), ("true roofs", 0.97, 1),
                                        ("height of flat", 0.0001, 0.1), ("height of gabled", 0.05, 0.8),
                                        ("overlap", 0.88, 1)],
}
SANE["Mobile survey onto the markings"] = [
    ("control points before", 0.3, 3.0), ("control points after, mean distance in plan", 0.0, 0.03),
    ("control points after, greatest", 0.0, 0.10), ("control points after, mean in space", 0.0, 0.05)]
SANE["Lane map from markings and the drive"] = [
    ("lanes between", 1, 60), ("true lanes on", 0.05, 1), ("area of the lanes", 0, 0.1)]
SANE["Road model and street objects"] = [
    ("area of the road", 100, 5000), ("share of it", 0.98, 1), ("border near", 0, 0.1)]
SANE["Walls from the mobile survey"] = [("measured walls", 0.95, 1), ("their distance", 0.0, 0.05),
                                        ("share of them", 0.8, 1)]
SANE["Models merged with the walls"] = [("buildings with", 1, 1000), ("merged models", 1, 1), ("overlap", 0.9, 1)]
SANE["Rectified trajectory of the line scanners"] = [
    ("epochs before", 0.05, 3.0), ("epochs after, mean distance", 0.0, 0.1), ("epochs after, mean height", 0.0, 0.1)]
SANE["Facade textures"] = [("facades with", 1, 100), ("images that", 1, 1), ("share of these", 0.2, 1)]
SANE["Walls adjusted by GNSS reflections"] = [
    ("walls adjusted", 2, 100), ("their offset as delivered", 0.3, 2.0), ("their offset after", 0.0, 0.4)]
SANE["Road markings from frames"] = [("found paint", 0.5, 1), ("seen paint", 0.6, 1)]
SANE["City model for other programs"] = [
    ("buildings in CityGML", 1, 1), ("their overlap", 0.88, 1), ("their height", 0, 0.001),
    ("buildings in 3D Tiles", 1, 1)]
SANE["Buildings from classified ALS"] = SANE["Buildings from unclassified ALS"]


@pytest.fixture(scope="module")
def ran(run_algorithm, tmp_path_factory):
    """Folder with the results of all stages, and the figures of each."""
    folder = tmp_path_factory.mktemp("demo")
    figures = {}
    for stage in stages(60.0, 1):
        done = run_algorithm(stage.algorithm, **stage.parameters_in(folder))
        assert done.code == 0, done.err
        figures[stage.title] = stage.check(folder)
    return folder, figures


@pytest.mark.once
def test_every_stage_is_close_to_the_truth(ran):
    _, figures = ran
    assert set(figures) == set(SANE), "give every stage of the demo its bounds here"
    for title, found in figures.items():
        for figure in found:
            low, high = next((low, high) for start, low, high in SANE[title] if figure.what.startswith(start))
            assert low <= figure.value <= high, f"{title}: {figure.what} is {figure.text}"


@pytest.mark.once
def test_checks_find_what_is_wrong(ran, tmp_path):
    """A surface lifted by 0.3 m and models of other buildings do not pass for right."""
    from osgeo import gdal

    folder, _ = ran
    places = demo_checks.roof_places(folder / "city")
    raster = read_raster(folder / "dsm.tif")
    error = demo_checks.height_at(raster, places.x, places.y) - places.z
    lifted = tmp_path / "lifted.tif"
    gdal.GetDriverByName("GTiff").CreateCopy(str(lifted), gdal.Open(str(folder / "dsm.tif")))
    source = gdal.Open(str(lifted), gdal.GA_Update)
    source.GetRasterBand(1).WriteArray(source.GetRasterBand(1).ReadAsArray() + 0.3)
    del source
    other = demo_checks.height_at(read_raster(lifted), places.x, places.y) - places.z
    assert np.nanmedian(other - error) == pytest.approx(0.3, abs=1e-4)
    numbers = np.unique(places.building)
    roof = {number: [shapely.force_3d(plan, 10.0)] for number, plan in
            demo_checks.true_outlines(folder / "city").items() if number != numbers[0]}
    heights = demo_checks.model_heights(roof, places)
    own = places.building == numbers[0]
    assert np.isnan(heights[own]).all() and (heights[~own] == 10.0).all()


def test_gables_fall_from_the_ridge_to_the_eaves():
    plan = shapely.transform(shapely.box(0, 0, 10, 6), lambda p: p @ np.array([[0.8, 0.6], [-0.6, 0.8]]) + [100, 200])
    ridge, eaves = ([[2.0, 3.0], [9.0, 3.0]], [[5.0, 0.0], [5.0, 6.0], [5.0, 1.5]])
    x, y = (np.array(ridge + eaves) @ np.array([[0.8, 0.6], [-0.6, 0.8]]) + [100, 200]).T
    assert demo_checks.gable_height(plan, 5.0, 8.0, x, y) == pytest.approx([8, 8, 5, 5, 6.5])


def test_height_of_a_sloped_roof():
    roof = shapely.from_wkt("POLYGON Z ((0 0 5, 10 0 5, 10 4 8, 0 4 8, 0 0 5))")
    assert demo_checks.plane_height(roof, np.array([5.0, 0.0]), np.array([2.0, 4.0])) == pytest.approx([6.5, 8.0])
