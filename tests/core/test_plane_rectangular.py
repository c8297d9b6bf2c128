"""Zones of the Japan Plane Rectangular CS: the law's zones, and EPSG's parameters of them."""

import numpy as np
import pytest
from pyproj import CRS

from urbanmap_qgis.io.reference.plane_rectangular import TOWNS, ZONE_NAMES, zone_epsg, zone_numbers

# Origins in the notification: latitude, longitude.
ORIGINS = [(33, 129.5), (33, 131), (36, 132 + 10 / 60), (33, 133.5), (36, 134 + 20 / 60), (36, 136),
           (36, 137 + 10 / 60), (36, 138.5), (36, 139 + 50 / 60), (40, 140 + 50 / 60), (44, 140.25), (44, 142.25),
           (44, 144.25), (26, 142), (26, 127.5), (26, 124), (26, 131), (20, 136), (26, 154)]

# Seats of municipalities, with the zone of their prefecture by law; none of them need be in the table of towns.
# Positions: localgovjp (CC0), github.com/code4fukui/localgovjp.
SEATS = {
    "Shikabe": (42.0266, 140.8317, 11), "Nakasatsunai": (42.6979, 143.1344, 13),
    "Hamanaka": (43.0763, 145.1310, 13), "Goshogawara": (40.8078, 140.4461, 10), "Nagai": (38.1061, 140.0339, 10),
    "Koori": (37.8547, 140.5209, 9), "Nishiaizu": (37.5874, 139.6493, 9), "Naganohara": (36.5443, 138.6498, 9),
    "Toshima": (35.7261, 139.7167, 9), "Hachijo": (33.1128, 139.7891, 9), "Kashiwazaki": (37.3649, 138.5578, 8),
    "Neba": (35.2553, 137.5818, 8), "Miyota": (36.3227, 138.5065, 8), "Tarui": (35.3663, 136.5379, 7),
    "Nomi": (36.4469, 136.5540, 7), "Shitara": (35.0973, 137.5712, 7), "Inabe": (35.1584, 136.5167, 6),
    "Takahama": (35.4879, 135.5460, 6), "Kyotamba": (35.1700, 135.4193, 6), "Nishiwaki": (34.9834, 134.9797, 5),
    "Kofu (Tottori)": (35.2760, 133.4790, 5), "Minamiawaji": (34.2944, 134.7800, 5),
    "Tsuwano": (34.5420, 131.8351, 3), "Nishinoshima": (36.0918, 133.0135, 3),
    "Jinsekikogen": (34.7036, 133.2517, 3), "Tonosho": (34.4867, 134.1886, 4), "Awa": (34.1021, 134.2975, 4),
    "Niyodogawa": (33.5753, 133.1710, 4), "Chikushino": (33.4874, 130.5260, 2), "Takeo": (33.1949, 130.0216, 2),
    "Shibushi": (31.4776, 131.0998, 2), "Yakushima": (30.3899, 130.6511, 2), "Amagi": (27.8117, 128.8977, 1),
    "Yoron": (27.0449, 128.4217, 1), "Naha": (26.2123, 127.6792, 15), "Ishigaki": (24.3444, 124.1852, 16),
    "Miyakojima": (24.7900, 125.2948, 16),
}
PLACES = {
    "Tokyo": (35.69, 139.76, 9), "Sapporo": (43.06, 141.35, 12), "Osaka": (34.69, 135.52, 6),
    "Nagoya": (35.17, 136.91, 7), "Fukuoka": (33.59, 130.42, 2), "Takamatsu": (34.35, 134.05, 4),
    "Fukuyama": (34.49, 133.37, 3), "Chichijima": (27.09, 142.19, 14), "Iwo To": (24.78, 141.32, 14),
    "Minamitorishima": (24.29, 153.98, 19), "Okinotorishima": (20.42, 136.08, 18), "Minamidaito": (25.83, 131.23, 17),
    "Iheya": (27.04, 127.97, 15), "Kikai": (28.32, 129.94, 1),
}


@pytest.mark.parametrize("zone", range(1, 20))
def test_epsg_code_of_each_zone_has_the_origin_of_the_law(zone):
    crs = CRS.from_epsg(zone_epsg(zone))
    values = {parameter.name: parameter.value for parameter in crs.coordinate_operation.params}
    # EPSG's databases from 2026 on call the same systems JGD2024.
    assert crs.name.replace("JGD2024", "JGD2011") == f"JGD2011 / Japan Plane Rectangular CS {ZONE_NAMES[zone - 1]}"
    assert (values["Latitude of natural origin"], values["Longitude of natural origin"]) == pytest.approx(
        ORIGINS[zone - 1])


@pytest.mark.parametrize(("latitude", "longitude", "zone"), [*SEATS.values(), *PLACES.values()],
                         ids=[*SEATS, *PLACES])
def test_place_lies_in_the_zone_of_the_law(latitude, longitude, zone):
    assert zone_numbers(longitude, latitude).tolist() == [zone]


@pytest.mark.parametrize("zone", sorted(TOWNS))
def test_towns_lie_within_epsgs_area_of_use(zone):
    area = CRS.from_epsg(zone_epsg(zone)).area_of_use
    # EPSG's boxes leave out Shodoshima (Kagawa), Cape Erimo and the northern islands, which the law names.
    beyond = {"Tonosho", "Uchinomi", "Erimo", "Etorofu", "Shikotan"}
    for name, (latitude, longitude) in TOWNS[zone].items():
        if name not in beyond:
            assert area.south - 0.02 <= latitude <= area.north + 0.02, name
            assert area.west - 0.02 <= longitude <= area.east + 0.02, name


def test_many_places_at_once():
    rows = np.array(list(PLACES.values()))
    assert zone_numbers(rows[:, 1], rows[:, 0]).tolist() == rows[:, 2].tolist()
