"""RINEX navigation files of versions 2.11 and 3.x, written here by the published columns with numbers of our own."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.rinex.navigation import read_navigation_files

WEEK = 2033
SUNDAY = WEEK * 604800.0
"""2018-12-23 00:00 in seconds since 1980-01-06."""

ELEMENTS = {
    "af0": 1.25e-4, "af1": -3.5e-12, "af2": 0.0, "crs": -41.5, "delta_n": 4.5e-9, "m0": 1.125, "cuc": -2.5e-6,
    "e": 8.75e-3, "cus": 4.75e-6, "sqrt_a": 5153.75, "toe_own": 7200.0, "cic": -9.5e-8, "omega0": -2.25, "cis": 8.5e-8,
    "i0": 0.9625, "crc": 295.5, "omega": 0.6875, "omega_dot": -8.0e-9, "i_dot": 1.025e-10, "source": 517.0,
    "health": 0.0, "delay_a": 5.5e-9, "delay_b": -7.25e-9}
ORDER = (("age", "crs", "delta_n", "m0"), ("cuc", "e", "cus", "sqrt_a"), ("toe_own", "cic", "omega0", "cis"),
         ("i0", "crc", "omega", "omega_dot"), ("i_dot", "source", "week", "spare"),
         ("accuracy", "health", "delay_a", "delay_b"), ("sent",))


def number(value: float, letter: str = "D") -> str:
    return f"{value:19.12E}".replace("E", letter)


def head(content: str, label: str) -> str:
    return f"{content:<60}{label:<20}\n"


def header(version: float, kind: str, lines: str = "") -> str:
    return head(f"{version:9.2f}           {kind}", "RINEX VERSION / TYPE") + lines + head("", "END OF HEADER")


def kepler(name: str, version: int = 3, letter: str = "D", hour: int = 2, **changes: float) -> str:
    values = {**ELEMENTS, **changes}
    first = "".join(number(values[key], letter) for key in ("af0", "af1", "af2"))
    stamp = f"{name} 2018 12 23 {hour:02d} 00 00" if version == 3 else f"{int(name[1:]):2d} 18 12 23 {hour:2d}  0  0.0"
    lead = " " * (4 if version == 3 else 3)
    lines = [stamp + first]
    lines += [lead + "".join(number(values.get(key, 1.0), letter) for key in row) for row in ORDER]
    return "\n".join(lines) + "\n"


def glonass(name: str, version: int = 3) -> str:
    stamp = f"{name} 2018 12 23 00 15 00" if version == 3 else f"{int(name[1:]):2d} 18 12 23  0 15  0.0"
    lead = " " * (4 if version == 3 else 3)
    rows = [(8498.5, -1.125, 1.5e-9, 0.0), (19647.25, -1.5, 0.0, -4.0), (-13877.75, -2.875, 2.5e-9, 0.0)]
    text = stamp + "".join(number(value) for value in (6.25e-5, 1e-12, 900.0)) + "\n"
    return text + "".join(lead + "".join(number(value) for value in row) + "\n" for row in rows)


def write(folder: Path, text: str, name: str = "a.nav") -> Path:
    path = folder / name
    path.write_bytes(text.encode("ascii"))
    return path


KLOBUCHAR = (head("GPSA " + "".join(f"{v:12.4E}" for v in (1.1e-8, 2.2e-8, -6e-8, -1.2e-7)), "IONOSPHERIC CORR")
             + head("GPSB " + "".join(f"{v:12.4E}" for v in (9e4, 1e5, -6e4, -5e5)).replace("E", "D"),
                    "IONOSPHERIC CORR"))


def same_elements(records, row: int, **changes: float) -> None:
    for key, value in {**ELEMENTS, **changes}.items():
        assert getattr(records, key)[row] == pytest.approx(value, rel=1e-12, abs=0.0), key


@pytest.mark.parametrize("letter", ["D", "E"])
def test_version_3_mixed(tmp_path, letter):
    text = header(3.04, "N: GNSS NAV DATA    M: MIXED", KLOBUCHAR) + kepler("G05", letter=letter) + kepler(
        "E11", letter=letter) + glonass("R07") + kepler("C03", letter=letter) + kepler("J02", letter=letter)
    text += "S20 2018 12 23 00 00 00" + number(0.0) * 3 + "\n" + ("    " + number(0.0) * 4 + "\n") * 3
    records = read_navigation_files([write(tmp_path, text)])
    assert records.kepler.satellite.tolist() == ["G05", "E11", "C03", "J02"] and not records.notes
    for row in range(4):
        same_elements(records.kepler, row)
    # The reference time of BeiDou counts in its own time, 14 s behind.
    assert records.kepler.toe.tolist() == [SUNDAY + 7200.0, SUNDAY + 7200.0, SUNDAY + 7214.0, SUNDAY + 7200.0]
    assert records.kepler.toc.tolist() == records.kepler.toe.tolist()
    assert records.ionosphere[0].source == "GPS" and records.ionosphere[0].alpha == (1.1e-8, 2.2e-8, -6e-8, -1.2e-7)
    assert records.ionosphere[0].beta == (9e4, 1e5, -6e4, -5e5)
    moving = records.glonass
    assert moving.satellite.tolist() == ["R07"] and moving.toe[0] == SUNDAY + 900.0 + 18.0
    assert moving.place[0] == pytest.approx([8498.5e3, 19647.25e3, -13877.75e3])
    assert moving.velocity[0] == pytest.approx([-1125.0, -1500.0, -2875.0])
    assert moving.acceleration[0] == pytest.approx([1.5e-6, 0.0, 2.5e-6])
    assert (moving.clock[0], moving.drift[0], moving.channel[0]) == (6.25e-5, 1e-12, -4.0)


def test_version_2_of_gps_and_glonass(tmp_path):
    ion = head("  " + "".join(f"{v:12.4E}" for v in (1e-8, 2e-8, -6e-8, -1e-7)), "ION ALPHA") + head(
        "  " + "".join(f"{v:12.4E}" for v in (9e4, 1e5, -6e4, -5e5)), "ION BETA")
    gps = header(2.11, "N: GPS NAV DATA", ion) + kepler("G05", 2) + kepler("G31", 2, hour=4, toe_own=14400.0)
    records = read_navigation_files([write(tmp_path, gps, "a.18n"), write(tmp_path, header(
        2.01, "GLONASS NAV DATA") + glonass("R07", 2), "a.18g")])
    assert records.kepler.satellite.tolist() == ["G05", "G31"]
    same_elements(records.kepler, 0)
    same_elements(records.kepler, 1, toe_own=14400.0)
    assert records.kepler.toe.tolist() == [SUNDAY + 7200.0, SUNDAY + 14400.0]
    assert records.glonass.satellite.tolist() == ["R07"] and records.glonass.toe[0] == SUNDAY + 918.0
    assert records.ionosphere[0].alpha == (1e-8, 2e-8, -6e-8, -1e-7)


def test_reference_time_over_the_end_of_a_week(tmp_path):
    """The clock's time is on Sunday, the orbit's at the end of Saturday: the week before."""
    text = header(3.04, "N: GNSS NAV DATA    G") + kepler("G05", hour=0, toe_own=604784.0)
    records = read_navigation_files([write(tmp_path, text)])
    assert records.kepler.toe[0] == SUNDAY - 16.0 and records.kepler.toc[0] == SUNDAY


def test_gzip_and_line_ends(tmp_path):
    text = header(3.04, "N: GNSS NAV DATA    G") + kepler("G05")
    (tmp_path / "a.nav.gz").write_bytes(gzip.compress(text.replace("\n", "\r\n").encode()))
    same_elements(read_navigation_files([tmp_path / "a.nav.gz"]).kepler, 0)


def test_broken_records_are_left_out_and_told(tmp_path):
    text = header(3.04, "N: GNSS NAV DATA    M") + kepler("G01") + kepler("G02", sqrt_a=0.0) + kepler(
        "G03").replace("4.500000000000D-09", "4.50000x000000D-09") + kepler("G04")
    text += "".join(kepler("G06").splitlines(keepends=True)[:5])
    records = read_navigation_files([write(tmp_path, text)])
    assert records.kepler.satellite.tolist() == ["G01", "G04"]
    assert any("3 records" in note for note in records.notes)


def test_a_cut_file_keeps_only_whole_records(tmp_path):
    whole = header(3.04, "N: GNSS NAV DATA    M") + kepler("G01")
    text = whole + kepler("G02")
    for cut in range(len(whole), len(text) - 90, 13):
        records = read_navigation_files([write(tmp_path, text[:cut])])
        assert records.kepler.satellite.tolist() == ["G01"]


@pytest.mark.parametrize("text, words", [
    (header(3.04, "OBSERVATION DATA    M"), "holds observations"),
    (header(3.04, "METEOROLOGICAL DATA"), "no navigation file"),
    (header(2.11, "METEOROLOGICAL DATA"), "no navigation file"),
    (header(3.04, "N: GNSS NAV DATA    G"), "no record"),
    ("some text\n", "not a RINEX file")])
def test_files_that_cannot_be_used(tmp_path, text, words):
    with pytest.raises(InputError, match=words):
        read_navigation_files([write(tmp_path, text)])


def test_no_file_gives_empty_records():
    records = read_navigation_files([])
    assert len(records.kepler) == len(records.glonass) == 0 and np.shape(records.glonass.place) == (0, 3)


def message(kind: str, satellite: str, name: str) -> str:
    return f"> {kind} {satellite:<3} {name}\n"


def klobuchar(alpha: tuple[float, ...], beta: tuple[float, ...]) -> str:
    rows = ["    2018 12 23 00 00 00" + "".join(number(value) for value in alpha[:3]),
            "    " + "".join(number(value) for value in (alpha[3], *beta[:3])), "    " + number(beta[3])]
    return "\n".join(rows) + "\n"


def test_version_4_gives_what_version_3_gives(tmp_path):
    """Its newer messages stand in other columns: were they read as the old ones, orbits would be wrong."""
    alpha, beta = (1.1e-8, 7.4e-9, -5.9e-8, -1.1e-7), (90112.0, 16384.0, -196608.0, -65536.0)
    cnav = kepler("G07", sqrt_a=5153.7, m0=-2.0) + "    " + number(0.0) * 4 + "\n"
    four = write(tmp_path, header(4.01, "N") + message("STO", "G01", "LNAV") + "    2018 12 23 00 00 00 GPUT\n"
                 + message("ION", "G01", "LNAV") + klobuchar(alpha, beta) + message("ION", "E01", "IFNV")
                 + "    2018 12 23 00 00 00" + number(45.25) * 3 + "\n" + message("EPH", "G07", "LNAV") + kepler("G07")
                 + message("EPH", "G07", "CNAV") + cnav + message("EPH", "E11", "INAV") + kepler("E11")
                 + message("EPH", "R03", "FDMA") + glonass("R03") + message("EOP", "G01", "CNAV")
                 + "    2018 12 23 00 00 00" + number(0.1) * 3 + "\n", "four.rnx")
    three = write(tmp_path, header(3.05, "N") + kepler("G07") + kepler("E11") + glonass("R03"), "three.rnx")
    new, old = read_navigation_files([four]), read_navigation_files([three])
    for kind in ("kepler", "glonass"):
        for field, values in vars(getattr(old, kind)).items():
            assert np.array_equal(getattr(getattr(new, kind), field), values), field
    model, = new.ionosphere
    assert (model.source, model.alpha, model.beta) == ("GPS", alpha, beta)


def test_a_file_of_version_4_with_newer_messages_only_is_told(tmp_path):
    only = write(tmp_path, header(4.0, "N") + message("EPH", "G07", "CNAV") + kepler("G07"))
    with pytest.raises(InputError, match="no record of a satellite"):
        read_navigation_files([only])
