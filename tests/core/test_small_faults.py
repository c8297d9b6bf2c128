"""Faults that long use has shown, each one sentence that says what it is."""

from __future__ import annotations

import io
import json
import re
import zipfile
from xml.etree import ElementTree

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError, OutputError
from urbanmap_qgis.io.files.guard import reads
from urbanmap_qgis.io.files.staging import Staging
from urbanmap_qgis.io.official.gsi import read_gsi_buildings
from urbanmap_qgis.io.pages.report import GOOD, Report
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.gps_time import time_range


def test_a_damaged_zip_in_a_zip(tmp_path):
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w") as archive:
        archive.writestr("a.xml", "<a/>")
    for number, content in enumerate((b"PK\x03\x04 no zip at all", inner.getvalue()[:-9], b"")):
        with zipfile.ZipFile(tmp_path / f"{number}.zip", "w") as archive:
            archive.writestr("inner.zip", content)
        with pytest.raises(InputError, match=r"inner\.zip is damaged or not a zip file"):
            read_gsi_buildings(tmp_path / f"{number}.zip")


def test_one_point_without_a_time_is_counted(make_cloud, tmp_path):
    time = np.linspace(400_000, 400_060, 500)
    x, y = np.random.default_rng(1).uniform(0, 50, (2, 500))
    for zeros in (1, 3):
        time[:zeros] = 0.0
        cloud = open_cloud([make_cloud(tmp_path / f"{zeros}.laz", x, y, x, gps_time=time)])
        with pytest.raises(InputError, match=rf"{zeros} of 500 points in {zeros}\.laz have the GPS time 0"):
            time_range(cloud)
    late = np.linspace(0, 60, 500)  # a survey that begins with the week
    assert time_range(open_cloud([make_cloud(tmp_path / "w.laz", x, y, x, gps_time=late)])) == (0.0, 60.0)


def test_a_name_of_an_output_that_is_too_long_shows_no_inner_path(tmp_path):
    with Staging() as staging:
        for name in ("n" * 250 + ".gpkg", "町" * 82 + ".tif"):
            with pytest.raises(OutputError, match="at most 247 bytes") as told:
                staging.scratch_path(tmp_path / name)
            assert str(tmp_path) not in str(told.value)
        assert staging.scratch_path(tmp_path / ("町" * 60 + ".tif")).parent != tmp_path


def test_a_report_may_do_nothing_but_show_itself(tmp_path):
    report = Report("<script>alert(1)</script>")
    report.verdict(GOOD, '<img src="https://example.org/x">')
    report.table(("a",), [("<script>1</script>",)])
    report.write(tmp_path / "r.html")
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', text).group(1)
    assert text.index("Content-Security-Policy") < text.index("<title>")
    assert policy.split("; ") == ["default-src 'none'", "style-src 'unsafe-inline'", "img-src data:"]
    body = text.split("</style>", 1)[1]
    assert not re.search(r"<script|\son\w+=|javascript:|src=\"(?!data:)", body)


@pytest.mark.parametrize(("raised", "told"), [
    (lambda: {}["transform"], "“transform” is missing in it"), (lambda: float("12,5"), "“12,5” is no number"),
    (lambda: int("x7"), "“x7” is no number"), (lambda: np.array(["a1"]).astype(float), "“a1” is no number"),
    (lambda: json.loads('{"a":\n1 2}'), "line 2 is no JSON"),
    (lambda: ElementTree.fromstring("<a>\n<b>\n</a>"), "line 3 is no XML")])
def test_what_only_the_net_catches_is_named_as_far_as_python_says_it(raised, told):
    @reads("a thing")
    def read(path):
        raised()

    with pytest.raises(InputError, match=rf"a\.txt cannot be read as a thing \({told}\): it is damaged"):
        read("folder/a.txt")
