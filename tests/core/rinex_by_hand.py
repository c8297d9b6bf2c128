"""RINEX files and broadcast orbits, read by formulas of the tests' own: judges of what the sample city writes."""

from __future__ import annotations

from collections import defaultdict
from datetime import datetime
from pathlib import Path

import numpy as np

from urbanmap_qgis.samplecity.gnss.passes import WEEK

C = 299792458.0
SYSTEM_GM = {"G": 3.986005e14, "E": 3.986004418e14, "J": 3.986005e14, "C": 3.986004418e14}
TURN = {"G": 7.2921151467e-5, "E": 7.2921151467e-5, "J": 7.2921151467e-5, "C": 7.292115e-5}


def gps_seconds(time: datetime) -> float:
    return (time - datetime(1980, 1, 6)).total_seconds() - WEEK * 604800


def split_header(path: Path) -> tuple[list[str], list[str]]:
    """Header and body lines; every header line has its label in columns 61 to 80."""
    lines = path.read_bytes().decode("ascii").split("\n")
    assert lines[-1] == ""
    end = next(i for i, line in enumerate(lines) if line[60:].strip() == "END OF HEADER")
    assert all(len(line) == 80 and line[60] != " " for line in lines[:end + 1])
    assert lines[0][:9] == "     3.04"
    return lines[:end + 1], lines[end + 1:-1]


def read_observations(path: Path) -> dict[tuple[float, str], tuple[float, float]]:
    """(time, satellite) -> code range and carrier to noise, by the fixed columns of RINEX 3.04."""
    header, body = split_header(path)
    types = {line[0]: line[6:60].split() for line in header if line[60:].strip() == "SYS / # / OBS TYPES"}
    assert all(int(line[3:6]) == len(types[line[0]]) for line in header if "OBS TYPES" in line)
    found, i = {}, 0
    while i < len(body):
        line = body[i]
        assert line[0] == ">" and line[31] == "0" and len(line) == 35
        time = datetime(*(int(line[a:b]) for a, b in ((2, 6), (7, 9), (10, 12), (13, 15), (16, 18))))
        seconds = gps_seconds(time) + float(line[18:29])
        count = int(line[32:35])
        for row in body[i + 1:i + 1 + count]:
            name = row[:3]
            assert types[name[0]][0][0] == "C" and types[name[0]][1][0] == "S"
            assert row[13] == "." and row[17] == " " and row[18] in "123456789"
            found[seconds, name] = (float(row[3:17]), float(row[19:33]))
        i += 1 + count
    return found


def read_navigation(path: Path) -> dict[str, list[dict]]:
    """Records of each satellite, by the fixed columns of RINEX 3.04."""
    header, body = split_header(path)
    assert sum(line[60:].strip() == "IONOSPHERIC CORR" for line in header) == 2
    records = defaultdict(list)
    assert len(body) % 8 == 0
    for i in range(0, len(body), 8):
        first, rest = body[i], body[i + 1:i + 8]
        value = [float(first[k:k + 19].replace("D", "E")) for k in (23, 42, 61)]
        orbit = [[float(row[k:k + 19].replace("D", "E")) for k in (4, 23, 42, 61) if row[k:k + 19].strip()]
                 for row in rest]
        assert all(row[:4] == "    " for row in rest) and all(len(row) == 4 for row in orbit[:4])
        system = first[0]
        toc = gps_seconds(datetime(*(int(first[a:b]) for a, b in ((4, 8), (9, 11), (12, 14), (15, 17), (18, 20),
                                                                 (21, 23)))))
        assert toc == orbit[2][0]
        assert orbit[4][2] == WEEK - (1356 if system == "C" else 0)
        records[first[:3]].append({"toe": toc + (14.0 if system == "C" else 0.0), "own": toc, "clock": value,
                                   "orbit": orbit, "delay": orbit[5][3] if system == "E" else orbit[5][2]})
    return records


def state(name: str, record: dict, time: float) -> tuple[np.ndarray, float]:
    """Place and clock of a satellite, written with turn matrices and Kepler's equation by bisection."""
    (_, crs, dn, m0), (cuc, e, cus, root), (_, cic, node0, cis), (i0, crc, peri, node_rate), (idot, *_), *_ = (
        record["orbit"])
    t = time - record["toe"]
    gm = SYSTEM_GM[name[0]]
    mean = m0 + (np.sqrt(gm) / root**3 + dn) * t
    low, high = mean - 1, mean + 1
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if middle - e * np.sin(middle) < mean else (low, middle)
    flat = np.array([np.cos(middle) - e, np.sqrt(1 - e * e) * np.sin(middle)])
    angle = np.arctan2(flat[1], flat[0]) + peri
    wave = np.array([np.cos(2 * angle), np.sin(2 * angle)])
    u = angle + wave @ [cuc, cus]
    r = root**2 * np.hypot(*flat) + wave @ [crc, crs]
    tilt = i0 + idot * t + wave @ [cic, cis]
    node = node0 + node_rate * t - TURN[name[0]] * (t + record["own"])
    place = turn_z(node) @ turn_x(tilt) @ turn_z(u) @ np.array([r, 0, 0])
    clock = record["clock"][0] + record["clock"][1] * t + record["clock"][2] * t * t
    return place, clock - 2 * np.sqrt(gm) * root * e * np.sin(middle) / C**2


def turn_z(a: float) -> np.ndarray:
    return np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])


def turn_x(a: float) -> np.ndarray:
    return np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
