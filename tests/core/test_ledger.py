"""The ledger of correcting mechanisms: rows fit the program, the page is made from it, the runner finds changes."""

from collections import Counter
from pathlib import Path

import pytest

from scripts import ablate
from scripts.ablate import VERDICTS, Row, absent, changes, figures_of, read_ledger
from scripts.make_ledger_page import PAGE, ledger_page

pytestmark = pytest.mark.once

ROOT = Path(__file__).resolve().parents[2]
LEDGER = read_ledger()


def test_the_page_is_that_of_the_ledger():
    assert PAGE.read_text(encoding="utf-8") == ledger_page(LEDGER), "run scripts/make_ledger_page.py"


def test_rows_have_names_of_their_own_and_known_scenes():
    assert max(Counter(row.name for row in LEDGER.rows).values()) == 1
    assert not {row.name for row in LEDGER.rows} & {row.room for row in LEDGER.rows}
    assert {scene for row in LEDGER.rows for scene in row.scenes} <= set(LEDGER.scenes)
    assert {row.verdict for row in LEDGER.rows} <= set(VERDICTS)
    for command in LEDGER.scenes.values():
        assert (ROOT / command.split()[0]).is_file(), command


@pytest.mark.parametrize("row", LEDGER.rows, ids=lambda row: row.name)
def test_a_row_switches_off_what_is_there(row: Row):
    text = (ROOT / row.file).read_text(encoding="utf-8")
    assert text.count(row.old) == 1, "the row is out of date: mend it, or retire it with its mechanism"
    assert row.old != row.new
    compile(text.replace(row.old, row.new), row.file, "exec")


@pytest.mark.parametrize("row", [row for row in LEDGER.rows if row.verdict != "open"], ids=lambda row: row.name)
def test_a_row_that_was_run_tells_its_figure_and_date(row: Row):
    assert row.date and row.figure
    assert row.verdict == "no change" or row.on != row.off


def test_figures_are_the_numbers_of_lines_by_their_words():
    printed = ("lines, complete     0.912", "12.5 s of CPU, 3 posts", "CPU s 4.5", "missed [1.0, -2.0]",
               "missed [3.0, 4.5]", "none")
    assert figures_of("\n".join(printed)) == {
        "lines, complete #": [0.912], ", # posts": [3.0], "missed [#, #]": [1.0, -2.0], "missed [#, #] (2)": [3.0, 4.5]}


def test_what_changes_is_told():
    assert list(changes({"a": [1.0], "b": [2.0], "c": [3.0, 4.0]}, {"a": [1.0], "c": [3.0, 4.5], "d": [0.0]})) == [
        "b: 2 -> none", "c: 3 4 -> 3 4.5", "d: none -> 0"]


def test_data_that_are_absent_are_named():
    assert absent("scripts/ablate.py no/such/city 0.5") == ["no/such/city"]


SMALL = """
[scenes]
mesh = "{scene} 139.8"
absent = "{scene} no/such/city"

[[row]]
name = "west"
room = "meshes"
what = "Columns begin at 100 degrees"
file = "urbanmap_qgis/geometry/mesh_code.py"
old = "WEST = 100.0"
new = "WEST = 101.0"
scenes = ["mesh", "absent"]
verdict = "open"

[[row]]
name = "range"
room = "meshes"
what = "Places in the south are refused"
file = "urbanmap_qgis/geometry/mesh_code.py"
old = "(0.0, 66.66)"
new = "(1.0, 66.66)"
scenes = ["mesh"]
verdict = "open"
"""

SCENE = """
import sys
from urbanmap_qgis.geometry.mesh_code import third_mesh_code
print("code", third_mesh_code(float(sys.argv[1]), 35.7))
"""


def test_the_runner_tells_which_figures_a_row_changes(tmp_path, capsys):
    (tmp_path / "scene.py").write_text(SCENE, encoding="utf-8")
    path = tmp_path / "ledger.toml"
    path.write_text(SMALL.format(scene=tmp_path / "scene.py"), encoding="utf-8")
    ablate.ablate(path, [])
    told = capsys.readouterr().out
    assert "absent: left out, there is no no/such/city" in told
    assert "west (Columns begin at 100 degrees): 1 lines change\n    code #: 5.33946e+07 -> 5.33846e+07" in told
    assert "range (Places in the south are refused): no change" in told
    with pytest.raises(SystemExit, match="no room or row: south"):
        ablate.ablate(path, ["south"])
