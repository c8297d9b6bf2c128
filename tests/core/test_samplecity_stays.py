"""The city of a seed stays as it is: the figures that the documentation states are measured on it."""

from __future__ import annotations

import pytest

from tests.figures import stays
from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity import write
from urbanmap_qgis.samplecity.truth import geotiff
from urbanmap_qgis.samplecity.truth.stage import write_truth

SIZE, SEED = 60.0, 1


@pytest.fixture(autouse=True)
def scene_made_anew():
    """Each test alone notices what changes the scene."""
    write._scene.cache_clear()


@pytest.mark.slow
@pytest.mark.parametrize("name", list(write.SENSORS))
def test_what_a_sensor_measures_stays(name, tmp_path, monkeypatch):
    lossless = {"compress": "deflate"}  # what JPEG loses is the affair of GDAL's release
    write_tiff = geotiff._write
    monkeypatch.setattr(geotiff, "_write", lambda path, bands, place, _: write_tiff(path, bands, place, lossless))
    summary = write._run(name, tmp_path, (SIZE, "canyon", SEED), SILENT)
    stays(f"samplecity_{name}", {"files": tmp_path, "summary": summary})


@pytest.mark.slow
@pytest.mark.parametrize("scene, size", [("canyon", SIZE), ("few markings", SIZE), ("repainted", SIZE),
                                         ("elevated road", SIZE), ("canyon", 240.0)])
def test_the_truth_stays(scene, size, tmp_path):
    summary = write_truth(write._scene(size, scene, SEED), tmp_path)
    name = f"samplecity_truth_{scene.replace(' ', '_')}{'_large' if size > SIZE else ''}"
    stays(name, {"files": tmp_path, "summary": summary})
