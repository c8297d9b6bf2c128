"""Faulty and clean city models with the numbers that PLATEAU's own quality check expects of them."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.checks.city_check import check_city

CASES = Path(__file__).resolve().parents[3] / "shared" / "data" / "rules" / "plateau4"
RINGS = ("L09", "L13")
RULES = {
    "L01エラー": ("L01",), "L03エラー": ("L03",), "L04エラー": ("L04",), "不正なcodeSpace数": ("L04.list",),
    "L05CRS識別子": ("L05",), "L06エラー": ("L06",), "T03エラー": ("T03",), "xlink参照先なし": ("T03.missing",),
    "gml:id重複": ("C01",), "gml:id書式不正": ("D-gml-id",), "L-frn-01エラー": ("L-frn-01",),
    "C-bldg-01 エラー": ("C-bldg-01",), "不正な建物ID": ("D-building-id",), "市区町村コードエラー": ("D-city-code",),
    "L-bldg-04,05 エラー": ("L-bldg-04", "L-bldg-05"), "T-bldg-02エラー": ("T-bldg-02",),
    "C05_必須属性等の欠落_Error": ("C05",), "C07_品質属性": ("C07",), "C08_公共測量品質属性": ("C08",),
    "L-TRAN-02 隣接面重複": ("L-tran-02",), "面のエラー": RINGS, "立体のエラー": ("L14.boundary",),
    "非水密体": ("L14.closed",), "不正なジオメトリ型": ("L-frn-01", "L-frn-02"), "LOD0-1のBuildingPart": ("C04",)}
BY_LEVEL = {"面のエラー": RINGS, "境界面のエラー": RINGS, "非水密立体": ("L14.closed",),
            "立体のエラー": ("L14.boundary",),
            "立体の交差": ("L-bldg-01",)}


def expected(folder: Path) -> dict[str, int]:
    found = {}
    for path in folder.glob("summary*.json"):
        found |= {row["name"]: row["count"] for row in json.loads(path.read_text(encoding="utf-8"))}
    return found


def number(faults, column: str) -> int | None:
    """Faults that a column of the expected results counts; None for columns that have no rule here."""
    if column.startswith("LOD") and column[4:5] == " ":
        level, rules = int(column[3]), BY_LEVEL.get(column[5:])
        return None if rules is None else sum(one.rule in rules and one.lod == level for one in faults)
    rules = RULES.get(column)
    return None if rules is None else sum(one.rule in rules for one in faults)


def cases() -> list:
    """Cases with an input; those whose file is not there are left out."""
    folders = sorted({path.parent for path in CASES.rglob("summary*.json") if any(path.parent.rglob("*.gml"))})
    return [pytest.param(folder, id=folder.relative_to(CASES).as_posix()) for folder in folders]


@pytest.mark.skipif(not CASES.is_dir(), reason="no cases in ../shared/data/rules/plateau4")
@pytest.mark.parametrize("folder", cases() or [None])
def test_numbers_are_those_expected(folder):
    faults = check_city(folder, check_solid).faults
    wanted = {column: count for column, count in expected(folder).items() if number(faults, column) is not None}
    assert wanted
    assert {column: number(faults, column) for column in wanted} == wanted


def told(folder: Path, name: str) -> list[dict[str, str]]:
    """Rows of one of a case's tables of expected faults."""
    with open(folder / name, encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.skipif(not CASES.is_dir(), reason="no cases in ../shared/data/rules/plateau4")
@pytest.mark.parametrize(("case", "table", "rule"), [
    ("01-01-common/L01", "01_共通_L01エラー.csv", "L01"),
    ("03-tran/Z-TRAN-01-surface-orientation", "03_交通_面の向き不正.csv", "L10")])
def test_cases_without_a_summary_have_the_faults_of_their_table(case, table, rule):
    """Each row is a fault, at the object that it names; the case has no other one."""
    rows = told(CASES / case, table)
    faults = check_city(CASES / case, check_solid).faults
    assert rows and {one.rule for one in faults} == {rule} and len(faults) == len(rows)
    named = {(row["FeatureType"], row["LOD"]) for row in rows if "LOD" in row}
    assert not named or {(one.type, str(one.lod)) for one in faults} == named
