"""Compact (Hatanaka) RINEX made plain: worked examples, and the official programs' own compact files."""

from __future__ import annotations

import bz2
import gzip
import re

import numpy as np
import pytest

from tests.core.test_rinex_observations import epoch_2, epoch_3, field, header_2, header_3, write
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.rinex.compact import plain_rinex
from urbanmap_qgis.gnss.rinex.observation_file import read_observations

TYPES = {"G": ["C1C", "L1C", "S1C"], "C": ["C2I", "S2I"]}


def plain(seed: int = 1, epochs: int = 40) -> str:
    """RINEX 3 with gaps, flags, negative numbers, and satellites that come and go."""
    rng = np.random.default_rng(seed)
    text = header_3(TYPES)
    for k in range(epochs):
        rows = []
        for name, count in (("G01", 3), ("G12", 3), ("C08", 2)):
            if rng.random() < 0.15:
                continue
            values = [None if rng.random() < 0.1 else 2.0e7 + 731.25 * k + 0.4 * k * k - 4.0e7 * (j == 1)
                      for j in range(count)]
            rows.append(name + "".join(field(value, f"{'1' if rng.random() < 0.1 else ' '}{rng.integers(1, 9)}")
                                       for value in values))
        text += epoch_3(30.0 * k, rows)
    return text


def plain_2(epochs: int = 25) -> str:
    """RINEX 2 with more than twelve satellites, so that an epoch's line goes on, and more than five types."""
    rng = np.random.default_rng(2)
    types, names = ["C1", "L1", "D1", "S1", "P2", "L2"], [f"G{k:02d}" for k in range(1, 15)]
    rows = [[[field(2.1e7 + 500.0 * k + 3.5 * j if rng.random() > 0.1 else None, " 5") for j in range(6)]
             for _ in names] for k in range(epochs)]
    return header_2(types) + "".join(epoch_2(30.0 * k, names, row) for k, row in enumerate(rows))


def lines(data: bytes) -> list[bytes]:
    """Lines without blanks at their ends, numbers below 1 with their 0."""
    return [re.sub(rb"(?<= )0\.|-0\.", lambda found: found[0].replace(b"0.", b"."), line.rstrip())
            for line in data.rstrip(b"\n").split(b"\n")]


@pytest.mark.parametrize("text", [plain(1), plain(2), plain_2()], ids=["3", "3 again", "2.11"])
def test_what_the_official_program_packs_comes_back(text):
    hatanaka = pytest.importorskip("hatanaka", reason="the official programs (PyPI hatanaka) are not installed")
    packed = hatanaka.rnx2crx(text.encode("ascii"))
    assert len(packed) < len(text)
    assert lines(plain_rinex(packed, "a.crx")) == lines(text.encode("ascii"))


EXAMPLE = """3.0                 COMPACT RINEX FORMAT                    CRINEX VERS   / TYPE
by hand                                                     CRINEX PROG / DATE
{header}> 2018 12 23 00 00  0.0000000  0  1      G01

3&20000000000 3&-5000 3&45000  5 6
                    1

1000 100   &
                    2

10 -5 3&500
                    3

0 0 -20 7
"""


def test_an_example_worked_by_hand():
    """Third-order differences: 1000, then +10 of the first difference, then +0 of the second."""
    text = EXAMPLE.format(header=header_3({"G": ["C1C", "L1C", "S1C"]}))
    body = plain_rinex(text.encode("ascii"), "a.crx").decode("ascii").split("END OF HEADER")[1].split("\n")
    epochs = [line for line in body if line.startswith(">")]
    rows = [line for line in body if line.startswith("G01")]
    assert [line[18:29].strip() for line in epochs] == ["0.0000000", "1.0000000", "2.0000000", "3.0000000"]
    assert [float(line[3:17]) for line in rows] == [20000000.0, 20000001.0, 20000002.01, 20000003.03]
    assert [line[19:33].strip() for line in rows[:2]] == ["-5.000", "-4.900"]


@pytest.mark.parametrize("pack", [gzip.compress, bz2.compress, bytes])
def test_packed_files_are_read_as_plain_ones(tmp_path, pack):
    hatanaka = pytest.importorskip("hatanaka", reason="the official programs (PyPI hatanaka) are not installed")
    text = plain().encode("ascii")
    (tmp_path / "a.obs").write_bytes(text)
    (tmp_path / "a.crx.x").write_bytes(pack(hatanaka.rnx2crx(text)))
    first, second = (read_observations(tmp_path / name) for name in ("a.obs", "a.crx.x"))
    assert np.array_equal(first.time, second.time)
    assert np.array_equal(first.code, second.code, equal_nan=True)
    assert np.array_equal(first.satellite, second.satellite)


def test_bzip_that_breaks_off_is_used_up_to_there(tmp_path):
    text = (plain(epochs=4000)).encode("ascii")
    packed = bz2.compress(text, 1)
    (tmp_path / "a.obs.bz2").write_bytes(packed[:len(packed) // 2])
    observed = read_observations(tmp_path / "a.obs.bz2")
    assert 10 < len(observed.time) < 4000
    assert any("breaks off" in note for note in observed.notes)


@pytest.mark.parametrize(("change", "said"), [
    (lambda text: text.replace("3&20000000000", "1000"), "line 9 changes a number"),
    (lambda text: text.replace("G01\n", "G  \n", 1), "does not name its satellites"),
    (lambda text: text.replace("3.0      ", "7.0      ", 1), "its version is 7"),
    (lambda text: text.replace("END OF HEADER", "END OF FILE"), "END OF HEADER"),
    (lambda text: text.replace("3&-5000", "3&far"), "damaged compact"),
])
def test_damaged_files_are_told_in_a_sentence(change, said):
    text = EXAMPLE.format(header=header_3({"G": ["C1C", "L1C", "S1C"]}))
    with pytest.raises(InputError, match=said):
        plain_rinex(change(text).encode("ascii"), "a.crx")


def test_strength_digits_behind_codes_that_stand_on_a_further_line(tmp_path):
    """Of RINEX 2 five values are on a line; of RINEX 3 all, the sixth too."""
    row = [field(float(number)) for number in range(1, 6)]
    old = header_2(["L1", "L2", "D1", "D2", "L5", "C1"]) + epoch_2(0.0, ["G01", "G02"], [
        [*row, field(2.0e7, " 5")], [*row, field(2.1e7, " 7")]])
    found = read_observations(write(tmp_path, old))
    assert found.code == pytest.approx([2.0e7, 2.1e7]) and found.cn0.tolist() == [33.0, 45.0]
    new = header_3({"G": ["L1C", "L2W", "D1C", "D2W", "L5X", "C1C"]}) + epoch_3(0.0, [
        "G01" + "".join(row) + field(2.0e7, " 5"), "G02" + "".join(row) + field(2.1e7, " 7")])
    assert read_observations(write(tmp_path, new)).cn0.tolist() == [33.0, 45.0]
