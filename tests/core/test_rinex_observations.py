"""RINEX observation files: written here by the published columns, read by the reader."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError
from urbanmap_qgis.gnss.rinex.observation_file import read_observations
from urbanmap_qgis.progress import Progress

DAY = 14231 * 86400.0
"""2018-12-23 in seconds since 1980-01-06."""

TYPES_2 = ["C1", "L1", "D1", "S1", "P2", "L2", "S2"]


def head(content: str, label: str) -> str:
    return f"{content:<60}{label:<20}\n"


def field(value: float | None, flags: str = "  ") -> str:
    return " " * 16 if value is None else f"{value:14.3f}{flags}"


def header_3(types: dict[str, list[str]], version: float = 3.03, scale: str = "GPS") -> str:
    lines = head(f"{version:9.2f}           OBSERVATION DATA    M", "RINEX VERSION / TYPE")
    for system, kinds in types.items():
        for first in range(0, len(kinds), 13):
            lead = f"{system}  {len(kinds):3d}" if first == 0 else " " * 6
            lines += head(lead + "".join(f" {kind}" for kind in kinds[first:first + 13]), "SYS / # / OBS TYPES")
    return lines + head(f"{'  2018    12    23     0     0    0.0000000':<48}{scale}", "TIME OF FIRST OBS") + head(
        "", "END OF HEADER")


def epoch_3(second: float, rows: list[str], flag: int = 0) -> str:
    minutes, rest = divmod(second, 60.0)
    hour, minute = divmod(int(minutes), 60)
    return f"> 2018 12 23 {hour:02d} {minute:02d} {rest:10.7f}  {flag}{len(rows):3d}\n" + "".join(
        row.rstrip() + "\n" for row in rows)


def header_2(types: list[str], system: str = "M") -> str:
    lines = head(f"     2.11           OBSERVATION DATA    {system}", "RINEX VERSION / TYPE")
    for first in range(0, len(types), 9):
        lead = f"{len(types):6d}" if first == 0 else " " * 6
        lines += head(lead + "".join(f"{kind:>6}" for kind in types[first:first + 9]), "# / TYPES OF OBSERV")
    return lines + head("  2018    12    23     0     0    0.0000000     GPS", "TIME OF FIRST OBS") + head(
        "", "END OF HEADER")


def epoch_2(second: float, satellites: list[str], rows: list[list[str]], flag: int = 0) -> str:
    minutes, rest = divmod(second, 60.0)
    hour, minute = divmod(int(minutes), 60)
    lines = f" 18 12 23 {hour:2d} {minute:2d}{rest:11.7f}  {flag}{len(satellites):3d}"
    for first in range(0, len(satellites), 12):
        lines += ("\n" + " " * 32 if first else "") + "".join(satellites[first:first + 12])
    lines += "\n"
    for fields in rows:
        for first in range(0, len(fields), 5):
            lines += "".join(fields[first:first + 5]).rstrip() + "\n"
    return lines


def write(folder: Path, text: str, name: str = "a.obs", lead: bytes = b"") -> Path:
    path = folder / name
    path.write_bytes(lead + text.encode("ascii"))
    return path


def rows_of(found) -> dict[tuple[float, str], tuple[float, float]]:
    return {(round(float(found.time[e]) - DAY, 6), str(name)): (float(code), float(cn0)) for e, name, code, cn0 in zip(
        found.epoch, found.satellite, found.code, found.cn0)}


def test_version_3_all_systems_flags_and_blanks(tmp_path):
    types = {"G": ["C1C", "L1C", "S1C"], "R": ["C1C", "S1C"], "E": ["L1C", "C1C", "S1C"], "J": ["C1C", "S1C"],
             "C": ["C2I", "S2I"], "S": ["C1C"]}
    text = header_3(types) + epoch_3(0.5, [
        "G05" + field(21234567.891, "13") + field(-98765432.123, " 4") + field(45.25),
        "R 7" + field(20000000.001) + field(38.0), "E12" + field(None) + field(24999999.999) + field(None),
        "J02" + field(38000000.5) + field(41.5), "C03" + field(39876543.211) + field(36.75),
        "S20" + field(38000000.0), "G06" + field(None) + field(111.0) + field(30.0)])
    found = read_observations(write(tmp_path, text))
    rows = rows_of(found)
    assert set(rows) == {(0.5, name) for name in ("G05", "R07", "E12", "J02", "C03")}
    assert rows[0.5, "G05"] == pytest.approx((21234567.891, 45.25), abs=1e-6)
    assert rows[0.5, "R07"] == pytest.approx((20000000.001, 38.0), abs=1e-6)
    assert rows[0.5, "E12"][0] == pytest.approx(24999999.999, abs=1e-6) and np.isnan(rows[0.5, "E12"][1])
    assert rows[0.5, "C03"] == pytest.approx((39876543.211, 36.75), abs=1e-6)
    assert found.bands == {"G": "1", "R": "1", "E": "1", "J": "1", "C": "2"} and not found.notes
    assert {str(name) for name in read_observations(tmp_path / "a.obs", "RE").satellite} == {"R07", "E12"}


def test_strength_by_its_digit_where_there_is_no_other(tmp_path):
    text = header_3({"G": ["C1C", "L1C"], "E": ["C1X", "S1X"]}) + epoch_3(0.0, [
        "G05" + field(2.1e7, " 7") + field(1.0, " 9"), "G06" + field(2.2e7), "G07" + field(2.3e7, "40"),
        "E11" + field(2.4e7, " 7") + field(33.0)])
    rows = rows_of(read_observations(write(tmp_path, text)))
    assert rows[0.0, "G05"][1] == 45.0 and rows[0.0, "E11"][1] == 33.0
    assert np.isnan([rows[0.0, "G06"][1], rows[0.0, "G07"][1]]).all()
    old = header_2(["L1", "C1"]) + epoch_2(0.0, ["G01"], [[field(1.0, " 3"), field(2.0e7, " 5")]])
    assert read_observations(write(tmp_path, old)).cn0.tolist() == [33.0]


def test_many_types_run_over_header_lines_and_columns(tmp_path):
    phases = [f"L{band}{letter}" for band in "125" for letter in "CWXSL"][:14]
    kinds = [*phases, "C1W", "S1W", "C1C", "S1C"]
    row = "G31" + "".join(field(value) for value in [*(100.0 + np.arange(14)), 2.2e7, 20.0, 2.3e7, 50.0])
    found = read_observations(write(tmp_path, header_3({"G": kinds}) + epoch_3(1.0, [row])))
    # Of two codes on one band the civil one comes first.
    assert rows_of(found) == {(1.0, "G31"): (2.3e7, 50.0)}


def test_scaled_numbers(tmp_path):
    """Factor 10 for one type of GPS, 100 for all of Galileo."""
    text = header_3({"G": ["C1C", "S1C"], "E": ["C1C", "S1C"], "R": ["C1C", "S1C"]})
    factors = head("G   10   1 C1C", "SYS / SCALE FACTOR") + head("E  100", "SYS / SCALE FACTOR")
    text = text.replace(head("", "END OF HEADER"), factors + head("", "END OF HEADER"))
    text += epoch_3(0.0, ["G01" + field(2.1e8) + field(40.0), "E01" + field(2.3e9) + field(4100.0),
                          "R01" + field(2.0e7) + field(42.0)])
    rows = rows_of(read_observations(write(tmp_path, text)))
    assert rows == {(0.0, "G01"): (2.1e7, 40.0), (0.0, "E01"): (2.3e7, 41.0), (0.0, "R01"): (2.0e7, 42.0)}
    with pytest.raises(InputError, match="scale factor"):
        read_observations(write(tmp_path, text.replace("G   10   1", "G   x0   1")))


def test_the_better_served_band_is_taken(tmp_path):
    types = {"G": ["C1C", "S1C", "C2W", "S2W"]}
    rows = [f"G{i:02d}" + (field(2.1e7) + field(40.0) if i == 1 else field(None) * 2) + field(2.2e7 + i) + field(30.0)
            for i in range(1, 6)]
    found = read_observations(write(tmp_path, header_3(types) + epoch_3(1.0, rows)))
    assert found.bands == {"G": "2"} and np.array_equal(found.code, 2.2e7 + np.arange(1, 6))


@pytest.mark.parametrize("version, kind, used", [(3.02, "C1I", True), (3.04, "C1P", False), (3.04, "C2I", True)])
def test_beidous_first_band_changed_its_name(tmp_path, version, kind, used):
    text = header_3({"C": [kind], "G": ["C1C"]}, version) + epoch_3(1.0, ["C06" + field(3.7e7), "G01" + field(2.1e7)])
    found = read_observations(write(tmp_path, text))
    assert ("C06" in found.satellite) == used


def test_events_comments_and_changed_types_in_the_body(tmp_path):
    text = header_3({"G": ["C1C", "S1C"]}) + epoch_3(0.0, ["G01" + field(2.1e7) + field(40.0)])
    text += head("a word in between", "COMMENT")
    text += "> 2018 12 23 00 00  0.5000000  3  1\n" + head("new marker", "MARKER NAME")
    text += "> 2018 12 23 00 00  0.7000000  4  2\n" + head("note", "COMMENT")
    text += head("G    3 D1C S1C C1C", "SYS / # / OBS TYPES")
    text += "> 2018 12 23 00 00  1.0000000  0  2\n" + head("between satellites", "COMMENT")
    text += "G01" + field(-500.0) + field(41.0) + field(2.2e7) + "\n"
    text += "G02" + field(7.0) + field(42.0) + field(2.3e7) + "\n"
    text += epoch_3(2.0, ["G01" + field(999.0) * 3], flag=6)
    text += epoch_3(3.0, ["G03" + field(1.0) + field(43.0) + field(2.4e7)], flag=1)
    found = read_observations(write(tmp_path, text))
    assert rows_of(found) == {(0.0, "G01"): (2.1e7, 40.0), (1.0, "G01"): (2.2e7, 41.0), (1.0, "G02"): (2.3e7, 42.0),
                              (3.0, "G03"): (2.4e7, 43.0)}
    assert not found.notes


def test_version_2_many_satellites_and_types(tmp_path):
    satellites = [f"G{i:2d}" for i in range(1, 15)] + ["R 3", "E11", "   "[:1] + "31"]
    rows = [[field(2e7 + i, "19"), field(1.0), field(None), field(30.0 + i), field(2.1e7 + i), field(5.0), field(20.0)]
            for i in range(len(satellites))]
    text = header_2(TYPES_2) + epoch_2(30.0, satellites, rows)
    text += " " * 28 + "4  1\n" + head("moved", "COMMENT")
    text += epoch_2(60.25, satellites[:2], rows[:2])
    found = read_observations(write(tmp_path, text))
    got = rows_of(found)
    names = [name.replace(" ", "0") for name in satellites[:-1]] + ["G31"]
    expected = {(30.0, name): (2e7 + i, 30.0 + i) for i, name in enumerate(names)}
    expected |= {(60.25, name): (2e7 + i, 30.0 + i) for i, name in enumerate(names[:2])}
    assert got == expected and not found.notes


def test_version_2_of_glonass_alone_counts_in_utc(tmp_path):
    text = header_2(["C1"], "R").replace("     GPS", "        ")
    found = read_observations(write(tmp_path, text + epoch_2(10.0, ["  4"], [[field(2.0e7)]])))
    assert found.satellite.tolist() == ["R04"] and found.time[0] == DAY + 10.0 + 18.0


def test_version_2_types_change(tmp_path):
    text = header_2(["C1", "S1"]) + epoch_2(1.0, ["G01"], [[field(2.1e7), field(40.0)]])
    text += " " * 28 + "4  1\n" + head("     3    S1    P1    C1", "# / TYPES OF OBSERV")
    text += epoch_2(2.0, ["G01"], [[field(44.0), field(2.3e7), field(2.2e7)]])
    found = read_observations(write(tmp_path, text))
    assert rows_of(found) == {(1.0, "G01"): (2.1e7, 40.0), (2.0, "G01"): (2.2e7, 44.0)}


def sample(version: int, epochs: int = 40) -> tuple[str, dict]:
    rng = np.random.default_rng(version)
    text = header_3({"G": ["C1C", "S1C"]}) if version == 3 else header_2(["C1", "S1"])
    expected = {}
    for second in range(epochs):
        names = [f"G{i:02d}" for i in rng.choice(np.arange(1, 33), 9, replace=False)]
        values = rng.uniform(2e7, 2.6e7, 9).round(3), rng.uniform(20, 50, 9).round(3)
        for name, code, cn0 in zip(names, *values):
            expected[float(second), name] = (code, cn0)
        rows = [[field(code), field(cn0)] for code, cn0 in zip(*values)]
        text += (epoch_3(second, [name + "".join(row) for name, row in zip(names, rows)]) if version == 3 else
                 epoch_2(second, names, rows))
    return text, expected


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
def test_all_values_arrive(tmp_path, version, line_end):
    text, expected = sample(version)
    path = tmp_path / "a.obs"
    path.write_bytes(text.replace("\n", line_end).encode())
    got = rows_of(read_observations(path))
    assert got.keys() == expected.keys()
    assert np.abs(np.array([got[key] for key in expected]) - np.array(list(expected.values()))).max() < 1e-6


@pytest.mark.parametrize("version", [2, 3])
def test_a_file_cut_anywhere_gives_nothing_wrong(tmp_path, version):
    text, expected = sample(version, 6)
    body = text.index("END OF HEADER") + 22
    counts = []
    for cut in range(body + 240, len(text), 7):
        got = rows_of(read_observations(write(tmp_path, text[:cut])))
        for key, (code, cn0) in got.items():
            assert code == pytest.approx(expected[key][0], abs=1e-6)
            assert np.isnan(cn0) or cn0 == pytest.approx(expected[key][1], abs=1e-6)
        counts.append(len(got))
    assert counts == sorted(counts) and counts[-1] >= len(expected) - 1


def test_a_file_cut_in_an_epoch_says_so(tmp_path):
    text, expected = sample(3, 6)
    lines = text.splitlines(keepends=True)
    found = read_observations(write(tmp_path, "".join(lines[:-4])))
    assert len(found.code) == len(expected) - 4 and any("not whole" in note for note in found.notes)


def test_gzip_whole_and_cut(tmp_path):
    text, expected = sample(3, 400)
    packed = gzip.compress(text.encode())
    (tmp_path / "a.obs.gz").write_bytes(packed)
    assert len(read_observations(tmp_path / "a.obs.gz").code) == len(expected)
    (tmp_path / "b.obs.gz").write_bytes(packed[:len(packed) // 2])
    found = read_observations(tmp_path / "b.obs.gz")
    got = rows_of(found)
    assert 0 < len(got) < len(expected) and any("breaks off" in note for note in found.notes)
    assert all(abs(got[key][0] - expected[key][0]) < 1e-6 for key in got)


def test_damaged_lines_are_left_out_and_told(tmp_path):
    text = header_3({"G": ["C1C", "S1C"]}) + epoch_3(0.0, ["G01" + "  21x34567.891  " + field(40.0)])
    text += "> 20b8 12 23 00 00  1.0000000  0  1\nG01" + field(2.1e7) + field(40.0) + "\n"
    text += epoch_3(2.0, ["G01" + field(2.2e7) + field(40.0), "G02" + field(2.3e7) + field(40.0)])
    text += "G09 a line too many\n" + epoch_3(3.0, ["G01" + field(2.4e7) + field(40.0)])
    found = read_observations(write(tmp_path, text))
    assert rows_of(found).keys() == {(2.0, "G01"), (2.0, "G02"), (3.0, "G01")}
    assert any("1 numbers" in note for note in found.notes) and any("3 lines" in note for note in found.notes)


def test_epochs_out_of_order_and_twice(tmp_path):
    one = epoch_3(5.0, ["G02" + field(2.2e7) + field(40.0)])
    text = header_3({"G": ["C1C", "S1C"]}) + one + epoch_3(4.0, ["G01" + field(2.1e7) + field(41.0)]) + one
    found = read_observations(write(tmp_path, text))
    assert rows_of(found) == {(4.0, "G01"): (2.1e7, 41.0), (5.0, "G02"): (2.2e7, 40.0)}
    assert np.all(np.diff(found.epoch) >= 0) and np.all(np.diff(found.time) > 0)
    assert any("twice" in note for note in found.notes)


@pytest.mark.parametrize("text, words", [
    ("", "is empty"), ("no rinex at all\n" * 5, "not a RINEX file"),
    (head("     3.04           N: GNSS NAV DATA    G", "RINEX VERSION / TYPE") + head("", "END OF HEADER"),
     "holds no observations"),
    (head("     5.00           OBSERVATION DATA    M", "RINEX VERSION / TYPE") + head("", "END OF HEADER"),
     "RINEX 5.00"),
    (head("1.0                 COMPACT RINEX FORMAT", "CRINEX VERS   / TYPE"), "Hatanaka"),
    (head("     3.04           OBSERVATION DATA    M", "RINEX VERSION / TYPE"), "END OF HEADER"),
    (header_3({}), "types of observations"), (header_3({"G": ["C1C"]}, scale="XYZ") + epoch_3(0.0, [
        "G01" + field(2e7)]), "counts time in"),
])
def test_files_that_cannot_be_used(tmp_path, text, words):
    with pytest.raises(InputError, match=words):
        read_observations(write(tmp_path, text))


def test_files_without_what_is_needed(tmp_path):
    with pytest.raises(InsufficientDataError, match="no epoch"):
        read_observations(write(tmp_path, header_3({"G": ["C1C"]})))
    text = header_3({"G": ["L1C", "S1C"]}) + epoch_3(0.0, ["G01" + field(1e8) + field(40.0)])
    with pytest.raises(InsufficientDataError, match="no code observation"):
        read_observations(write(tmp_path, text))
    with pytest.raises(InputError, match="cannot be read"):
        read_observations(tmp_path / "nowhere.obs")
    (tmp_path / "a.Z").write_bytes(b"\x1f\x9d\x90rest")
    with pytest.raises(InputError, match="unpack"):
        read_observations(tmp_path / "a.Z")


def test_a_byte_order_mark_is_passed_over(tmp_path):
    text, _ = sample(3, 3)
    assert len(read_observations(write(tmp_path, text, lead=b"\xef\xbb\xbf")).code) == len(
        read_observations(write(tmp_path, text)).code)


@pytest.mark.parametrize("version", [2, 3])
def test_a_second_header_in_the_file_is_obeyed_or_named(tmp_path, version):
    """Two files in one, the second with its columns exchanged; then the second by another clock."""
    kinds = ["C1C", "S1C"] if version == 3 else ["C1", "S1"]

    def part(kinds, second):
        row = [field(2.1e7 + second if kind[0] == "C" else 41.0) for kind in kinds]
        return (header_3({"G": kinds}) + epoch_3(second, ["G01" + "".join(row)]) if version == 3
                else header_2(kinds) + epoch_2(second, ["G01"], [row]))

    first, second = part(kinds, 0.0), part(kinds[::-1], 30.0)
    found = read_observations(write(tmp_path, first + second))
    assert rows_of(found) == {(0.0, "G01"): (2.1e7, 41.0), (30.0, "G01"): (2.1e7 + 30.0, 41.0)} and not found.notes
    found = read_observations(write(tmp_path, first + second.replace("GPS", "GLO")))
    assert rows_of(found) == {(0.0, "G01"): (2.1e7, 41.0)} and "made of several files" in found.notes[0]


def test_observations_on_a_band_that_cannot_serve_are_told(tmp_path):
    text = header_3({"G": ["C5Q", "S5Q"], "E": ["C1C", "S1C"]}) + epoch_3(0.0, [
        name + field(2.1e7) + field(40.0) for name in ("G01", "G02", "E03")])
    found = read_observations(write(tmp_path, text))
    assert set(found.satellite) == {"E03"}
    assert len(found.notes) == 1 and "2 of 2 observations of system G" in found.notes[0] and "C5Q" in found.notes[0]


def test_cancel(tmp_path):
    text, _ = sample(3, 3)
    with pytest.raises(Cancelled):
        read_observations(write(tmp_path, text), progress=Progress(cancelled=lambda: True))


def test_version_4_is_read_as_version_3(tmp_path):
    body = epoch_3(1.0, ["G01" + field(2.1e7) + field(41.0), "E05" + field(2.3e7) + field(39.0)])
    types = {"G": ["C1C", "S1C"], "E": ["C1C", "S1C"]}
    three, four = (read_observations(write(tmp_path, header_3(types, version) + body, f"{version}.rnx"))
                   for version in (3.05, 4.02))
    assert rows_of(four) == rows_of(three)
