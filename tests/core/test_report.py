"""Reports: pages, tables, maps and lines of text."""

from __future__ import annotations

import ast
import base64
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError, OutputError
from urbanmap_qgis.io.pages.line_breaks import broken_lines
from urbanmap_qgis.io.pages.report import BAD, LOOK, Fixed, Report, RunFacts, rounded, run_told
from urbanmap_qgis.io.pages.svg import RAMP, UNKNOWN, bars, plan_map
from urbanmap_qgis.io.pages.svg_profile import Series, profile

ROOT = Path(__file__).resolve().parents[2]


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
                                             (123456.7, "123,457"), (0.0, "0"), (-0.5, "-0.500"),
                                             (-0.0006, "-0.0006"), (-3.5e-18, "0")])
def test_numbers_have_the_decimals_that_they_mean(value, text):
    assert rounded(value) == text


def test_a_note_of_settings_is_a_table(tmp_path):
    for name, text in (("a", "Width: 3 m; Method: paper"), ("b", "Frames used: all. Nothing else.")):
        report = Report("Page")
        report.note(text)
        report.write(tmp_path / f"{name}.html")
    assert "<th>Width</th><td>3 m</td>" in (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "<p>Frames used: all. Nothing else.</p>" in (tmp_path / "b.html").read_text(encoding="utf-8")


def test_seconds_and_coordinates_keep_their_decimals(tmp_path):
    report = Report("Page")
    report.table(["time (s)", "x"], [[Fixed.of(361416.254), Fixed.of(float("nan"))]])
    report.write(tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert '<td class="number">361416.25</td><td class="number">–</td>' in page


def test_ticks_are_round_numbers():
    drawn = bars(np.array([3, 0, 1]), np.array([0.0, 2.1, 4.2, 6.3]), "% of the points")
    assert re.findall(r'text-anchor="middle">([^<]*)</text>', drawn)[:-1] == ["0", "2", "4", "6"]


def test_a_broad_picture_scrolls_on_a_phone_and_a_small_one_shrinks(tmp_path):
    report = Report("Page")
    for width in (460, 900):
        report.figure(f'<svg xmlns="" width="{width}" height="20"></svg>', "c")
    report.write(tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert page.count("<figure><svg") == 1 and page.count('<figure class="broad"><svg') == 1


def modules_with_reports():
    return [path for folder in ("urbanmap_qgis", "algorithms") for path in sorted((ROOT / folder).rglob("*.py"))
            if re.search(r"\bReport\(", path.read_text(encoding="utf-8"))]


@pytest.mark.parametrize("path", modules_with_reports(), ids=lambda path: str(path.relative_to(ROOT)))
def test_every_report_gives_a_verdict(path):
    """As often as the module begins a report, unless a helper gives it for all."""
    calls = [node.func for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
             if isinstance(node, ast.Call)]
    made = sum(getattr(item, "id", "") == "Report" for item in calls)
    given = sum(getattr(item, "attr", "") == "verdict" for item in calls)
    assert made and given >= made, f"{made} reports, {given} verdicts"


def test_a_note_of_settings_is_a_table_and_another_a_paragraph(tmp_path):
    for text, table in (("cell: 0.5 m; method: planes", True), ("looked at: by hand", False), ("a; b", False)):
        report = Report("Title")
        report.note(text)
        report.write(tmp_path / "a.html")
        assert ("<td" in (tmp_path / "a.html").read_text(encoding="utf-8")) == table


def test_the_band_of_a_chart_lies_a_sigma_to_either_side_of_its_curve():
    x, values = np.linspace(0.0, 9.0, 10), np.linspace(1.0, 3.0, 10)
    page = profile(x, [Series("a", values)], "s", "m", (values, np.full(10, 0.5)))
    band = np.array([pair.split(",") for pair in re.search(r'<polygon points="([^"]*)"', page)[1].split()], float)
    upper, lower = band[:10], band[10:][::-1]
    slope = (upper[0, 1] - upper[-1, 1]) / 2.0  # of the picture, for a metre
    assert slope > 0 and lower[:, 1] - upper[:, 1] == pytest.approx(slope * 1.0, abs=0.2)


def test_values_fill_the_height_of_a_chart():
    """From 0 at the foot to the largest, above which a twentieth of the height is left; 12 px above, 40 px below."""
    page = profile(np.array([0.0, 1.0]), [Series("a", np.array([0.0, 2.0]), dots=True)], "s", "m", height=240)
    foot, top = (float(place) for place in re.findall(r'<circle cx="[^"]*" cy="([^"]*)"', page))
    assert foot == pytest.approx(200.0, abs=0.1) and top == pytest.approx(200.0 - 188.0 / 1.05, abs=0.1)


def of_at_most(count):
    return lambda text: len(text) <= count


def test_lines_end_between_words_and_between_japanese_letters():
    assert broken_lines("道路台帳附図更新", of_at_most(3)) == ["道路台", "帳附図", "更新"]
    assert broken_lines("計測MX-9型", of_at_most(4)) == ["計測", "MX-9", "型"]
    assert broken_lines("one two three", of_at_most(7)) == ["one two", "three"]


def test_no_line_begins_with_the_end_of_a_bracket_or_a_sentence():
    assert broken_lines("あい（うえ）お", of_at_most(5)) == ["あい（う", "え）お"]
    assert broken_lines("あいうえ。", of_at_most(4)) == ["あいう", "え。"]


def test_a_word_wider_than_the_column_is_broken():
    assert broken_lines("abcdefgh", of_at_most(3)) == ["abc", "def", "gh"] and broken_lines("", of_at_most(3)) == [""]
