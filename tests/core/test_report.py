"""HTML reports and their drawings."""

import base64
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError, OutputError
from urbanmap_qgis.io.report import BAD, LOOK, Report, RunFacts, rounded, run_told
from urbanmap_qgis.io.svg import RAMP, UNKNOWN, bars, plan_map


def test_page_escapes_text_and_formats_numbers(tmp_path):
    report = Report("A & B")
    report.table(["n", "x"], [[1234567, 0.12345], [float("nan"), "<script>"], [True, None]])
    report.warning("mind <this>")
    report.histogram(np.array([1.0, 2.0, np.nan]), "m", "lengths")
    report.write(tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "A &amp; B" in page and "&lt;script&gt;" in page and "<script>" not in page
    assert "1,234,567" in page and "0.123" in page and page.count("–") == 2
    assert "lengths (1 without a value)" in page
    with pytest.raises(OutputError):
        report.write(tmp_path / "no" / "r.html")


def test_page_holds_its_pictures(tmp_path):
    data = b"\x89PNG\r\n\x1a\n" + bytes(range(256))
    (tmp_path / "p.png").write_bytes(data)
    (tmp_path / "p.txt").write_text("no picture")
    report = Report("pictures")
    report.picture(tmp_path / "p.png", "a < b")
    with pytest.raises(InputError, match="PNG or JPEG"):
        report.picture(tmp_path / "p.txt", "text")
    report.write(tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    (kept,) = re.findall(r'src="data:image/png;base64,([^"]+)"', page)
    assert base64.b64decode(kept) == data and "<figcaption>a &lt; b</figcaption>" in page


def test_bars_are_as_tall_as_their_counts():
    picture = ElementTree.fromstring(bars(np.array([1, 4, 2]), np.array([0.0, 1.0, 2.0, 3.0]), "m"))
    heights = [float(rect.get("height")) for rect in picture.iter() if rect.tag.endswith("rect")]
    assert np.array(heights) / max(heights) == pytest.approx([0.25, 1.0, 0.5], abs=0.01)


def test_map_draws_each_plan_in_its_colour_to_scale():
    plans = [shapely.box(0, 0, 10, 10), shapely.box(20, 0, 40, 10), None,
             shapely.Polygon(shapely.box(50, 0, 60, 10).exterior, [shapely.box(53, 3, 56, 6).exterior])]
    text = plan_map(plans, np.array([0.1, 2.0, 0.5, np.nan]), (0.15, 0.3, 0.6, 1.0), "m", {1: "<7>"}, width=620)
    picture = ElementTree.fromstring(text)
    paths = [item for item in picture.iter() if item.tag.endswith("path") and item.get("fill")]
    assert [item.get("fill") for item in paths] == [RAMP[0], RAMP[4], UNKNOWN]
    spans = [np.ptp([float(x) for x in re.findall(r"[ML]([\d.]+) ", item.get("d"))]) for item in paths]
    assert spans == pytest.approx([100, 200, 100], abs=0.2)
    assert paths[2].get("d").count("M") == 2 and "&lt;7&gt;" in text


def test_the_verdict_comes_first_and_the_run_last(tmp_path):
    outer = RunFacts("A chain", "1.2", "EPSG:6677", "JGD2011 (vertical) height", {"Outlines": "建物.gpkg"},
                     {"Ratio": "0.5"})
    with run_told(outer), run_told(RunFacts("A step")):
        report = Report("Page")
        report.paragraph("Body")
        report.verdict(BAD, "Do not use it.")
        report.verdict(LOOK, "Look at <it>.")
        report.write(tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    places = [page.index(text) for text in ("<h1>Page", "Look at &lt;it&gt;.", "Body", "UrbanMap 1.2, A chain",
                                            "EPSG:6677", "JGD2011 (vertical) height", "建物.gpkg", "Ratio")]
    assert places == sorted(places) and "Do not use it." not in page and "A step" not in page
    Report("Alone").write(tmp_path / "alone.html")
    assert "How this was made" not in (tmp_path / "alone.html").read_text(encoding="utf-8")


def test_pages_fit_a_narrow_screen(tmp_path):
    report = Report("Page")
    report.table(["a"] * 20, [[1] * 20])
    report.figure(bars(np.array([1, 4, 2]), np.array([0.0, 1.0, 2.0, 3.0]), "m"), "chart")
    report.write(tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert 'name="viewport"' in page and '<div class="wide"><table>' in page
    assert 'viewBox="0 0 460 200" width="460" height="200"' in page and "@media print" in page


@pytest.mark.parametrize(("value", "text"), [(0.0123, "0.012"), (1.2345, "1.23"), (123.45, "123.5"), (100.0, "100"),
                                             (123456.7, "123,457"), (0.0, "0"), (-0.5, "-0.500"), (1e-5, "1e-05")])
def test_numbers_have_the_decimals_that_they_mean(value, text):
    assert rounded(value) == text


def test_a_note_of_settings_is_a_table(tmp_path):
    for name, text in (("a", "Width: 3 m; Method: paper"), ("b", "Frames used: all. Nothing else.")):
        report = Report("Page")
        report.note(text)
        report.write(tmp_path / f"{name}.html")
    assert "<th>Width</th><td>3 m</td>" in (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "<p>Frames used: all. Nothing else.</p>" in (tmp_path / "b.html").read_text(encoding="utf-8")
