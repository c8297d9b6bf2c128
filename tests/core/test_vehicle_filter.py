"""Vehicles taken out of orthophotos that lie on the same ground."""

from __future__ import annotations

import numpy as np
import pytest
import rasterio
from rasterio.transform import Affine

from urbanmap_qgis.aerial.orthophotos.mosaic import PixelSelection
from urbanmap_qgis.aerial.orthophotos.vehicle_filter import filter_vehicles
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.progress import Progress

CELL = 0.2


def road(x, y):
    return 100 + 30 * np.sin(x / 3) * np.cos(y / 4)


def write(path, shape=(120, 150), left=0.0, top=0.0, cell=CELL, vehicle=None, gain=1.0, bands=3, **profile):
    """An orthophoto of the road with a white or dark vehicle of 3 x 2 m at (x, y, brightness)."""
    profile = {"crs": "EPSG:6677", "dtype": "uint8", "nodata": 0, **profile}
    x, y = np.meshgrid(left + (np.arange(shape[1]) + 0.5) * cell, top - (np.arange(shape[0]) + 0.5) * cell)
    image = road(x, y) * gain
    if vehicle:
        image[(np.abs(x - vehicle[0]) < 1.5) & (np.abs(y - vehicle[1]) < 1)] = vehicle[2]
    with rasterio.open(path, "w", driver="GTiff", height=shape[0], width=shape[1], count=bands,
                       transform=Affine(cell, 0, left, 0, -cell, top), **profile) as target:
        target.write(np.repeat(np.rint(image)[None], bands, 0).astype(profile["dtype"]))
    return path


def read(path):
    with rasterio.open(path) as source:
        place, values = source.transform, source.read().astype(float)
    rows, columns = values.shape[1:]
    x, y = np.meshgrid(place.c + (np.arange(columns) + 0.5) * place.a, place.f + (np.arange(rows) + 0.5) * place.e)
    return values, road(x, y)


@pytest.mark.parametrize("dark", [False, True])
def test_three_orthophotos_on_one_grid(tmp_path, dark):
    paths = [write(tmp_path / f"{k}.tif", vehicle=(6 + 7 * k, -10, 5 if dark else 250)) for k in range(3)]
    made = filter_vehicles(paths, tmp_path / "out.tif")
    values, truth = read(tmp_path / "out.tif")
    assert np.abs(values - truth).max() < 2 and made.pixels_shared == 120 * 150


@pytest.mark.paper("J 3.2.1.2")
def test_darkest_is_the_papers(tmp_path):
    paths = [write(tmp_path / f"{k}.tif", vehicle=(6 + 7 * k, -10, 250)) for k in range(2)]
    filter_vehicles(paths, tmp_path / "out.tif", PixelSelection("darkest"))
    values, truth = read(tmp_path / "out.tif")
    assert np.abs(values - truth).max() < 2


def test_other_grid_exposure_and_no_data(tmp_path):
    first = write(tmp_path / "a.tif", vehicle=(8, -10, 250))
    other = write(tmp_path / "b.tif", (90, 160), -3.07, -4.11, 0.17, gain=1.2)
    third = write(tmp_path / "c.tif", (200, 250), -5.03, 3.01, 0.19, gain=0.9)
    filter_vehicles([first, other, third], tmp_path / "out.tif")
    values, truth = read(tmp_path / "out.tif")
    error = (values / values.mean() * truth.mean() - truth)
    assert values.shape == (3, 120, 150) and (values > 0).all()
    assert np.abs(error).max() < 6 and error.std() < 1.5


def test_position_is_kept_when_resampled(tmp_path):
    first = write(tmp_path / "a.tif", vehicle=(15, -12, 250))
    with rasterio.open(first, "r+") as source:
        image = source.read()
        image[:, 20:100, 20:120] = 0
        source.write(image)
    filter_vehicles([first, write(tmp_path / "b.tif", (200, 250), -5.03, 3.01, 0.19)], tmp_path / "out.tif",
                    PixelSelection("vote", even=False))
    values, truth = read(tmp_path / "out.tif")
    assert np.abs(values - truth)[:, 20:100, 20:120].max() < 2


def test_orthophotos_of_different_places(tmp_path):
    warnings = []
    made = filter_vehicles([write(tmp_path / "a.tif"), write(tmp_path / "b.tif", left=500.0)], tmp_path / "out.tif",
                           progress=Progress(warn=warnings.append))
    assert made.pixels_shared == 0 and "same ground" in warnings[0]


def test_16_bit_grey(tmp_path):
    paths = [write(tmp_path / f"{k}.tif", vehicle=(6 + 7 * k, -10, 60000), gain=200, bands=1, dtype="uint16")
             for k in range(2)]
    filter_vehicles(paths, tmp_path / "out.tif")
    values, truth = read(tmp_path / "out.tif")
    assert np.abs(values / 200 - truth).max() < 1


def test_input_that_cannot_be_used(tmp_path):
    good = write(tmp_path / "a.tif")
    with pytest.raises(InputError, match="two or more"):
        filter_vehicles([good], tmp_path / "out.tif")
    with pytest.raises(InputError, match="one kind"):
        filter_vehicles([good, write(tmp_path / "grey.tif", bands=1)], tmp_path / "out.tif")
    with pytest.raises(InputError, match="coordinate reference system"):
        filter_vehicles([good, write(tmp_path / "lost.tif", crs=None)], tmp_path / "out.tif")
    (tmp_path / "text.tif").write_text("no image")
    with pytest.raises(InputError, match=r"text\.tif cannot be read"):
        filter_vehicles([good, tmp_path / "text.tif"], tmp_path / "out.tif")
    assert not (tmp_path / "out.tif").exists()
