"""Places of the map on the earth, against PROJ and geometry."""

from __future__ import annotations

import numpy as np
import pyproj
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.orbits.earth_fixed import MapFrame, directions, elevation_azimuth

CASES = [("EPSG:6677", -6950.0, -34100.0), ("EPSG:32650", 209212.8, 2468743.1), ("EPSG:25833", 391000.0, 5819000.0),
         ("EPSG:2193", 1750000.0, 5427000.0), ("EPSG:31983", 333000.0, 7394000.0)]


@pytest.mark.parametrize("crs, east, north", CASES)
def test_earth_fixed_against_proj(crs, east, north):
    place = np.array([[east, north, 12.5], [east + 800.0, north - 650.0, 60.0]])
    found = MapFrame(crs, 36.6).places(place)
    lon, lat = pyproj.Transformer.from_crs(crs, "EPSG:4326", always_xy=True).transform(place[:, 0], place[:, 1])
    cart = pyproj.Transformer.from_pipeline("+proj=cart +ellps=WGS84")
    expected = np.column_stack(cart.transform(lon, lat, place[:, 2] + 36.6))
    assert np.abs(found.earth_fixed - expected).max() < 1e-4
    assert np.degrees(found.latitude) == pytest.approx(lat) and np.degrees(found.longitude) == pytest.approx(lon)


@pytest.mark.parametrize("crs, east, north", CASES)
def test_axes_are_the_maps(crs, east, north):
    """A step along the map's axes goes along the axes given, and the convergence is PROJ's."""
    frame = MapFrame(crs)
    here = np.array([[east, north, 50.0]])
    found = frame.places(here)
    assert found.axes[0] @ found.axes[0].T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(found.axes[0]) == pytest.approx(1.0)
    for k in range(3):
        step = frame.places(here + 5.0 * np.eye(3)[k]).earth_fixed - found.earth_fixed
        assert directions(found.axes, step)[0] == pytest.approx(np.eye(3)[k], abs=1e-4)
    factors = pyproj.Proj(crs).get_factors(np.degrees(found.longitude[0]), np.degrees(found.latitude[0]))
    # PROJ counts the convergence from grid to true north or back by its projections' habit: the size is certain.
    assert abs(np.degrees(found.convergence[0])) == pytest.approx(abs(factors.meridian_convergence), abs=1e-4)


def test_sign_of_the_convergence():
    """East of the central meridian on the northern half grid north points east of true north."""
    east, west = (MapFrame("EPSG:25833").places(np.array([[x, 5819000.0, 0.0]])).convergence[0] for x in (6e5, 4e5))
    assert east > 0.01 and west == pytest.approx(-east)


def test_directions_to_known_azimuths():
    frame = MapFrame("EPSG:25833")
    here = frame.places(np.array([[391000.0, 5819000.0, 50.0]]))
    for azimuth, height in ((0.0, 0.0), (90.0, 30.0), (215.0, 100.0), (300.0, 200.0)):
        angle = np.radians(azimuth)
        there = np.array([[391000.0 + 300 * np.sin(angle), 5819000.0 + 300 * np.cos(angle), 50.0 + height]])
        direction = directions(here.axes, frame.places(there).earth_fixed - here.earth_fixed)
        elevation, found = np.degrees(elevation_azimuth(direction))
        assert (found[0] - azimuth + 180) % 360 - 180 == pytest.approx(0.0, abs=0.01)
        assert elevation[0] == pytest.approx(np.degrees(np.arctan2(height, 300.0)), abs=0.03)


def test_compound_crs_and_wkt():
    place = np.array([[-6950.0, -34100.0, 12.5]])
    wkt = pyproj.CRS("EPSG:6677+6695").to_wkt()
    assert MapFrame(wkt).places(place).earth_fixed == pytest.approx(MapFrame("EPSG:6677").places(place).earth_fixed)


def test_another_datum_is_transformed():
    """The Tokyo datum lies some 450 m from the world's; the same numbers are another place."""
    place = np.array([[-6950.0, -34100.0, 12.5]])
    old, new = (MapFrame(crs).places(place).earth_fixed[0] for crs in ("EPSG:30169", "EPSG:6677"))
    assert 300 < np.linalg.norm(old - new) < 600


@pytest.mark.parametrize("crs, words", [("EPSG:4326", "in metres"), ("", "states no"), ("nonsense", "understood"),
                                        ("EPSG:2263", "in metres")])
def test_crs_that_cannot_be_used(crs, words):
    with pytest.raises(InputError, match=words):
        MapFrame(crs)


def test_places_outside_the_crs():
    with pytest.raises(InputError, match="outside the area"):
        MapFrame("EPSG:32650").places(np.array([[1e12, 1e12, 0.0]]))
