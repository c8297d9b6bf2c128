"""What a run has read is kept for its length, and only while the file is the same."""

import os

import numpy as np

from urbanmap_qgis.io.files.read_once import once, read_once
from urbanmap_qgis.mobile.trajectory_files import read_trajectory


def test_nothing_is_kept_outside_a_block_nor_after_it():
    answers = iter(range(9))
    assert [once("a", lambda: next(answers)) for _ in range(2)] == [0, 1]
    with read_once():
        assert [once(key, lambda: next(answers)) for key in "aab"] == [2, 2, 3]
        with read_once():
            assert once("a", lambda: next(answers)) == 2
        assert once("a", lambda: next(answers)) == 2
    assert once("a", lambda: next(answers)) == 4


def test_a_trajectory_is_read_again_where_its_file_has_changed(tmp_path):
    path = tmp_path / "way.csv"

    def write(step):
        rows = "\n".join(f"{t},{step * t},0,0,0,0,90" for t in range(5))
        path.write_text(f"time,x,y,z,roll,pitch,heading\n{rows}\n", encoding="utf-8")

    write(1.0)
    with read_once():
        first = read_trajectory(path)
        assert read_trajectory(path) is first
        write(2.0)
        os.utime(path, ns=(1, 1))
        assert np.array_equal(read_trajectory(path).trajectory.place[:, 0], 2 * first.trajectory.place[:, 0])
    assert read_trajectory(path) is not read_trajectory(path)
