"""Heights of pictures on printed pages, by arithmetic and by what a browser prints."""

import shutil
import subprocess

import numpy as np
import pytest

from tests.printed_pages import shares_filled
from urbanmap_qgis.acceptance.acceptance_report import write_acceptance_report
from urbanmap_qgis.acceptance.check_points import check_points_from_columns
from urbanmap_qgis.acceptance.criteria import criteria
from urbanmap_qgis.acceptance.job import Job
from urbanmap_qgis.acceptance.map_levels import MAP_LEVELS
from urbanmap_qgis.io.pages.print_plan import (
    PAGE_HEIGHT,
    Picture,
    PrintedBlock,
    fill_pages,
    page_map,
    place_picture,
    table_block,
    text_lines,
)
from urbanmap_qgis.io.pages.report import RunFacts, run_told

WIDE, TALL, SQUARE = (900, 120), (120, 900), (400, 400)
"""East and north extent of areas, m."""
CASES = [(3, WIDE, 2), (3, TALL, 2), (10, SQUARE, 2), (10, WIDE, 2), (25, WIDE, 2), (25, TALL, 3), (60, WIDE, 3),
         (60, SQUARE, 3), (200, WIDE, 6), (200, TALL, 6)]
"""Number of check points, their area, and pages."""


def test_blocks_run_down_the_pages():
    table = PrintedBlock((30.0, 10.0, 10.0), head=5.0)
    filling = fill_pages([PrintedBlock((60.0,)), PrintedBlock((50.0,)), table], 100.0)
    # 60 and a hole of 40; 50 + 30 + 10 + 10 = 100.
    assert (filling.pages, filling.empty, filling.last) == (2, 40.0, 100.0)
    assert fill_pages([PrintedBlock((95.0,)), PrintedBlock((4.0, 3.0), head=2.0)], 100.0) == fill_pages(
        [PrintedBlock((95.0,)), PrintedBlock((4.0,)), PrintedBlock((5.0,))], 100.0)


def test_a_heading_stays_with_what_follows():
    filling = fill_pages([PrintedBlock((80.0,)), PrintedBlock((15.0,), with_next=True), PrintedBlock((10.0,))], 100.0)
    assert (filling.pages, filling.empty, filling.last) == (2, 20.0, 25.0)


def test_a_picture_shrinks_before_it_needs_another_page():
    picture = Picture((PrintedBlock((10.0,), with_next=True), PrintedBlock((0.0,))), 60.0, 200.0, 150.0)
    blocks = [PrintedBlock((100.0,)), PrintedBlock((60.0,))]
    place, height = place_picture(blocks, [1], picture)
    assert place == 1 and 80.0 <= height <= PAGE_HEIGHT - 170.0
    # Alone with one line it is as high as wished for.
    assert place_picture([PrintedBlock((10.0,))], [1], picture) == (1, 150.0)


def test_a_picture_goes_behind_a_table_that_fills_the_hole_before_it():
    picture = Picture((PrintedBlock((0.0,)),), 80.0, 100.0, 90.0)
    place, _ = place_picture([PrintedBlock((200.0,)), PrintedBlock((5.0,) * 40)], [1, 2], picture)
    assert place == 2


def test_long_texts_take_lines_and_japanese_is_wide():
    assert text_lines("a" * 10, 182.0, 10.0) == 1
    assert text_lines("あ" * 60, 182.0, 10.0) == 2 and text_lines("a" * 60, 182.0, 10.0) == 1
    low, high = (sum(table_block([["name", text]], False).pieces) for text in ("a" * 20, "a b " * 100))
    assert high > 2 * low


def test_a_map_is_high_enough_for_its_points():
    wide, square = (page_map([PrintedBlock((0.0,))], shape, 180.0) for shape in (0.35, 1.0))
    assert wide.least < square.least and (wide.wished, square.wished) == (pytest.approx(63.0), 180.0)
    assert wide.most > wide.wished and square.most == square.wished


def report_of(path, count, area):
    """The report of `count` check points in an area."""
    draws = np.random.default_rng(count)
    true = np.column_stack([draws.uniform(0, area[0], count), draws.uniform(0, area[1], count), np.full(count, 5.0)])
    product = true + draws.normal(0.0, 0.05, (count, 3))
    points = check_points_from_columns({"id": [f"P{k}" for k in range(count)], **{
        f"{axis}{end}": list(table[:, k]) for end, table in (("", true), ("_product", product))
        for k, axis in enumerate("xyz")}})
    facts = RunFacts("Acceptance report", "0.2.0", "EPSG:6677", "JGD2011", {"Check points": "check.csv"},
                     {"Product": "survey", "Map level": "500"})
    with run_told(facts):
        write_acceptance_report(path, points, criteria(points, MAP_LEVELS[500]), MAP_LEVELS[500],
                                Job(job="第3工区", surveyor="測量"), 500)


@pytest.mark.slow
@pytest.mark.parametrize(("count", "area", "pages"), CASES)
def test_no_page_that_a_browser_prints_is_half_empty(tmp_path, count, area, pages):
    browser = shutil.which("chromium")
    if not browser or not shutil.which("pdftoppm"):
        pytest.skip("chromium and pdftoppm (poppler-utils), which print and measure pages, are not installed")
    report_of(tmp_path / "a.html", count, area)
    subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
                    f"--user-data-dir={tmp_path / 'profile'}", f"--print-to-pdf={tmp_path / 'a.pdf'}",
                    str(tmp_path / "a.html")], capture_output=True, check=True, timeout=120)
    shares = shares_filled(tmp_path / "a.pdf", 14.0, PAGE_HEIGHT)
    assert len(shares) == pages
    assert all(share > 0.75 for share in shares[:-1]) and shares[-1] > 0.4, shares


def test_a_table_that_stays_whole_goes_to_the_next_page():
    broken, whole = (table_block([["figure", "mean"], *[["a", "1"]] * 4], True, kept) for kept in (False, True))
    assert len(whole.pieces) == 1 and len(broken.pieces) == 4 and whole.pieces[0] == pytest.approx(sum(broken.pieces))
    above = PrintedBlock((PAGE_HEIGHT - 0.7 * whole.pieces[0],))
    assert fill_pages([above, broken]).last < fill_pages([above, whole]).last == pytest.approx(whole.pieces[0])
