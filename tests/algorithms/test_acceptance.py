"""The acceptance report through Processing."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from tests.printed_pages import shares_filled

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def checks(tmp_path):
    """Five check points that are 3 cm off in plan and 1 cm in height, and one that was adjusted to."""
    rows = ["id,x,y,z,x_product,y_product,z_product,role,mesh"]
    rows += [f"検{k},{10 * k},{20 * k},5.0,{10 * k + 0.03},{20 * k},5.01,check,{'a' if k < 3 else 'b'}"
             for k in range(5)]
    (tmp_path / "検証点.csv").write_text("\n".join([*rows, "G1,0,0,5,0,0,5,adjusted,a"]), encoding="utf-8")
    return str(tmp_path / "検証点.csv")


def test_points_within_the_limits_are_accepted(run, checks, tmp_path):
    result = run("urbanmap:acceptance", {
        "INPUT": checks, "MAP_LEVEL": "250", "JOB": "第3工区", "OUTPUT_REPORT": str(tmp_path / "報告.html"),
        "OUTPUT_PDF": str(tmp_path / "報告.pdf"), "OUTPUT_CSV": str(tmp_path / "all.csv")})
    assert result["OUTCOME"] == "passed" and result["POINTS"] == 5
    assert result["RMSE_PLAN"] == pytest.approx(0.03, abs=1e-6)
    assert result["RMSE_HEIGHT"] == pytest.approx(0.01, abs=1e-6)
    page = (tmp_path / "報告.html").read_text(encoding="utf-8")
    assert "第3工区" in page and "Accepted for map level 250" in page and "adjusted to them: 1 points" in page
    pdf = (tmp_path / "報告.pdf").read_bytes()
    assert pdf.startswith(b"%PDF") and pdf.count(b"/Type /Page\n") == 2
    assert len((tmp_path / "all.csv").read_text(encoding="utf-8-sig").splitlines()) == 6


def pages(path) -> list[str]:
    """The text of each page of a PDF."""
    if shutil.which("pdftotext") is None:
        pytest.skip("pdftotext, which reads the pages, is not installed (poppler-utils)")
    told = subprocess.run(["pdftotext", "-layout", str(path), "-"], capture_output=True, check=True)
    return told.stdout.decode("utf-8").split("\f")[:-1]


@pytest.mark.parametrize(("count", "sheets"), [(10, 2), (60, 3), (200, 5)])
def test_points_go_on_over_pages_with_their_head(run, tmp_path, count, sheets):
    rows = ["id,x,y,z,x_product,y_product,z_product", *(f"P{k},{k},{k},1,{k},{k},1" for k in range(count))]
    (tmp_path / "many.csv").write_text("\n".join(rows), encoding="utf-8")
    run("urbanmap:acceptance", {"INPUT": str(tmp_path / "many.csv"), "OUTPUT_PDF": str(tmp_path / "many.pdf")})
    assert (tmp_path / "many.pdf").read_bytes().count(b"/Type /Page\n") == sheets
    texts = pages(tmp_path / "many.pdf")
    assert all(f"P{k} " in "".join(texts) for k in range(count))
    assert all("north (m)" in text for text in texts[1:])


@pytest.mark.parametrize(("count", "area", "sheets"), [
    (3, (900, 120), 2), (3, (120, 900), 2), (10, (400, 400), 2), (10, (900, 120), 2), (25, (900, 120), 2),
    (41, (60, 70), 3), (60, (900, 120), 3), (60, (120, 900), 3), (200, (900, 120), 5)])
def test_no_page_of_the_pdf_is_half_empty(run, tmp_path, count, area, sheets):
    draws = np.random.default_rng(count)
    true = np.column_stack([draws.uniform(0, area[0], count), draws.uniform(0, area[1], count), np.full(count, 5.0)])
    both = np.hstack([true, true + draws.normal(0.0, 0.05, (count, 3))])
    rows = [f"P{number}," + ",".join(f"{value:.3f}" for value in row) for number, row in enumerate(both)]
    (tmp_path / "a.csv").write_text("\n".join(["id,x,y,z,x_product,y_product,z_product", *rows]), encoding="utf-8")
    run("urbanmap:acceptance", {"INPUT": str(tmp_path / "a.csv"), "OUTPUT_PDF": str(tmp_path / "a.pdf")})
    shares = shares_filled(tmp_path / "a.pdf", 15.0, 267.0)
    assert len(shares) == sheets
    assert all(share > 0.9 for share in shares[:-1]) and shares[-1] > 0.2, shares
    told = "".join(pages(tmp_path / "a.pdf"))
    assert all(f"P{number} " in told for number in range(count))


def test_an_office_prints_on_its_own_layout(run, checks, tmp_path):
    shipped = (ROOT / "resources" / "layouts" / "acceptance.qpt").read_text(encoding="utf-8")
    own = tmp_path / "own.qpt"
    own.write_text(shipped.replace('id="map"', 'id="logo"'), encoding="utf-8")
    sizes = []
    for number, template in enumerate((None, str(own))):
        pdf = tmp_path / f"{number}.pdf"
        run("urbanmap:acceptance", {"INPUT": checks, "OUTPUT_PDF": str(pdf), "TEMPLATE": template})
        sizes.append(pdf.stat().st_size)
        assert pdf.read_bytes().count(b"/Type /Page\n") == 2
    assert sizes[1] < sizes[0]  # without the map
    own.write_text("<Layout>", encoding="utf-8")
    with pytest.raises(Exception, match="is no layout for this report"):
        run("urbanmap:acceptance", {"INPUT": checks, "OUTPUT_PDF": str(tmp_path / "a.pdf"), "TEMPLATE": str(own)})


def test_limits_units_and_numbers_of_points_decide(run, checks):
    def outcome(**settings):
        return run("urbanmap:acceptance", {"INPUT": checks, **settings})["OUTCOME"]

    assert outcome(MAP_LEVEL="given", LIMIT_PLAN=0.02) == "failed"
    assert outcome(PRODUCT="buildings") == "not checked"
    assert outcome(UNIT="mesh", MINIMUM_POINTS=3) == "not checked"
    assert outcome(UNIT="mesh", MINIMUM_POINTS=2) == "passed"


def test_given_limits_must_be_given(run, checks):
    with pytest.raises(Exception, match="needs a limit in plan or in height"):
        run("urbanmap:acceptance", {"INPUT": checks, "MAP_LEVEL": "given"})


def test_edges_are_drawn_from_models_only(run, checks, tmp_path):
    with pytest.raises(Exception, match="drawn from building models: give these too"):
        run("urbanmap:acceptance", {"INPUT": checks, "OUTPUT_EDGES": str(tmp_path / "edges.csv")})


def test_registration_stands_in_the_pdf(run, checks, tmp_path):
    rows = ["correction,sigma,residual", *["0.111,0.02,0.03"] * 2]
    (tmp_path / "patches.csv").write_text("\n".join(rows), encoding="utf-8")
    run("urbanmap:acceptance", {"INPUT": checks, "PATCHES": str(tmp_path / "patches.csv"),
                                "OUTPUT_PDF": str(tmp_path / "a.pdf")})
    assert "0.111" in pages(tmp_path / "a.pdf")[0]


def test_long_names_stand_whole_in_the_form(run, checks, tmp_path):
    if not (shutil.which("fc-list") and subprocess.run(["fc-list", ":lang=ja"], capture_output=True).stdout):
        pytest.skip("no font of this system has Japanese letters")
    name = "".join(f"第{number}地区道路台帳附図更新（その{number}）、" for number in range(1, 9))
    run("urbanmap:acceptance", {"INPUT": checks, "OUTPUT_PDF": str(tmp_path / "a.pdf"), "JOB": name,
                                "OUTPUT_REPORT": str(tmp_path / "a.html"), "INSTRUMENT": "GNSS/IMU AP60"})
    form = "".join(pages(tmp_path / "a.pdf")[0].split())
    assert all(f"（その{number}）" in form for number in range(1, 9))
    assert (tmp_path / "a.html").read_text(encoding="utf-8").count("<td>GNSS/IMU AP60</td>") == 2  # form and settings


def test_no_point_is_lost_where_units_take_two_lines(run, tmp_path):
    rows = [f"P{k},{k},{k},5,{k}.01,{k},5.01,第{k % 2}工区道路台帳附図更新業務" for k in range(200)]
    (tmp_path / "a.csv").write_text("\n".join(["id,x,y,z,x_product,y_product,z_product,unit", *rows]), encoding="utf-8")
    run("urbanmap:acceptance", {"INPUT": str(tmp_path / "a.csv"), "UNIT": "unit",
                                "OUTPUT_PDF": str(tmp_path / "a.pdf")})
    words = " ".join(pages(tmp_path / "a.pdf")[1:]).split()
    assert [f"P{k}" for k in range(200) if f"P{k}" not in words] == []


def test_patches_must_be_those_of_a_registration(run, checks):
    with pytest.raises(Exception, match="stand in a report on check points"):
        run("urbanmap:acceptance", {"BUILDINGS": checks, "PATCHES": checks})
    with pytest.raises(Exception, match="has no field correction, sigma, residual"):
        run("urbanmap:acceptance", {"INPUT": checks, "PATCHES": checks})


def test_edges_are_drawn_where_there_are_no_check_points(run, small_city, tmp_path):
    models = run("urbanmap:loadcitymodel", {"INPUT": str(small_city / "models" / "buildings.city.json"),
                                            "OUTPUT": str(tmp_path / "outlines.gpkg"),
                                            "OUTPUT_MODELS": str(tmp_path / "models.gpkg")})["OUTPUT_MODELS"]
    result = run("urbanmap:acceptance", {"BUILDINGS": models, "PRODUCT": "buildings", "AREA": "第3工区",
                                         "OUTPUT_EDGES": str(tmp_path / "edges.csv"),
                                         "OUTPUT_PDF": str(tmp_path / "edges.pdf"),
                                         "OUTPUT_REPORT": str(tmp_path / "edges.html")})
    assert result["OUTCOME"] == "not checked" and "POINTS" not in result
    rows = (tmp_path / "edges.csv").read_text(encoding="utf-8-sig").splitlines()
    assert len(rows) > 40 and all(row.endswith(",,") for row in rows[1:])
    page = (tmp_path / "edges.html").read_text(encoding="utf-8")
    assert "Nothing was checked" in page and "第3工区" in page and "Accepted" not in page
    pdf = (tmp_path / "edges.pdf").read_bytes()
    assert pdf.startswith(b"%PDF") and pdf.count(b"/Type /Page\n") >= 2
    if shutil.which("pdftotext"):
        printed = " ".join(pages(tmp_path / "edges.pdf")).split()
        assert [row for row in rows[1:] if row.partition(",")[0] not in printed] == []
        assert rows[1].split(",")[3] in printed  # the unit's code in one line
    with pytest.raises(Exception, match="no errors to list: leave “All points” out"):
        run("urbanmap:acceptance", {"BUILDINGS": models, "OUTPUT_CSV": str(tmp_path / "all.csv")})
    # The table that nobody filled in is no check either.
    with pytest.raises(Exception, match="no check point"):
        run("urbanmap:acceptance", {"INPUT": str(tmp_path / "edges.csv"), "PRODUCT": "buildings"})


def test_something_must_be_given(run):
    with pytest.raises(Exception, match="Give check points, or building models"):
        run("urbanmap:acceptance", {})


@pytest.fixture
def models(run, small_city, tmp_path):
    """The models of the small city, whose walls are displaced by about 1 m."""
    return run("urbanmap:loadcitymodel", {"INPUT": str(small_city / "models" / "buildings.city.json"),
                                          "OUTPUT": str(tmp_path / "outlines.gpkg"),
                                          "OUTPUT_MODELS": str(tmp_path / "models.gpkg")})["OUTPUT_MODELS"]


def test_edges_are_looked_for_in_laser_points(run, small_city, models, tmp_path):
    settings = {"BUILDINGS": models, "POINTS": [str(small_city / "als" / "als.laz")], "MAP_LEVEL": "1000"}
    result = run("urbanmap:acceptance", {**settings, "OUTPUT_REPORT": str(tmp_path / "a.html"),
                                         "OUTPUT_CSV": str(tmp_path / "a.csv"), "OUTPUT_PDF": str(tmp_path / "a.pdf")})
    assert result["OUTCOME"] == "not checked" and result["POINTS"] > 20
    assert 0.7 < result["RMSE_PLAN"] < 2.0 and result["RMSE_HEIGHT"] > 0.0
    assert "a check of the modelling, not of accuracy" in (tmp_path / "a.html").read_text(encoding="utf-8")
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
    assert len((tmp_path / "a.csv").read_text(encoding="utf-8-sig").splitlines()) > result["POINTS"]
    assert run("urbanmap:acceptance", {**settings, "INDEPENDENT": True})["OUTCOME"] == "failed"
    walls = run("urbanmap:acceptance", {**settings, "INDEPENDENT": True, "EDGES_SHOWN_BY": "walls"})
    assert walls["OUTCOME"] != "passed" and "RMSE_HEIGHT" not in walls


def test_laser_points_stand_for_check_points_and_need_models(run, small_city, checks, models):
    points = [str(small_city / "als" / "als.laz")]
    with pytest.raises(Exception, match="give these too"):
        run("urbanmap:acceptance", {"INPUT": checks, "POINTS": points})
    with pytest.raises(Exception, match="not both"):
        run("urbanmap:acceptance", {"INPUT": checks, "BUILDINGS": models, "POINTS": points})
