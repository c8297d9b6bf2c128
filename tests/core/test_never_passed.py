"""Nothing is called passed for which there were no check points, in English or in Japanese."""

import re
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.acceptance.acceptance_report import pdf_content, verdict, write_acceptance_report
from urbanmap_qgis.acceptance.check_points import ADJUSTED, CHECK, check_points_from_columns
from urbanmap_qgis.acceptance.criteria import NOT_CHECKED, PASSED, criteria, outcome
from urbanmap_qgis.acceptance.job import Job
from urbanmap_qgis.acceptance.map_levels import MAP_LEVELS
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.accuracy_report import write_accuracy_report
from urbanmap_qgis.mobile.control import ControlPoints, check_points_of, in_survey_time
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.wording import use_catalogue

CATALOGUE = Path(__file__).resolve().parents[2] / "resources" / "translations" / "urbanmap_ja.ts"
SAID = re.compile(r"\b[Pp]assed\b|\bAccepted\b|(?<!不)合格")


@pytest.fixture(params=["en", "ja"])
def words(request):
    use_catalogue(CATALOGUE if request.param == "ja" else None)
    yield request.param
    use_catalogue(None)


def drawn_table(generator):
    """A table of check points as it could come: some adjusted to, some not measured, in one or several units."""
    count = int(generator.integers(1, 50))
    true = generator.uniform(0, 1000, (count, 3))
    off = generator.normal(0, 0.01, (count, 3))
    off[generator.random(count) < generator.choice([0.0, 0.5, 1.0])] = np.nan
    off[generator.random(count) < generator.choice([0.0, 0.5, 1.0]), 2] = np.nan
    roles = generator.choice([CHECK, ADJUSTED], count, p=[share := generator.choice([0.0, 0.5, 1.0]), 1 - share])
    product = true + off
    return {"id": list(map(str, range(count))), "role": list(roles), "mesh": list(generator.choice(["a", "b"], count)),
            **{name: list(true[:, k]) for k, name in enumerate("xyz")},
            **{f"{name}_product": [None if value != value else value for value in product[:, k]]
               for k, name in enumerate("xyz")}}


def usable(table, unit):
    """Check points of a unit that were measured, in plan and in height."""
    rows = [k for k in range(len(table["id"])) if table["role"][k] == CHECK and unit in ("", table["mesh"][k])
            and table["x_product"][k] is not None and table["y_product"][k] is not None]
    return len(rows), sum(table["z_product"][k] is not None for k in rows)


@pytest.mark.parametrize("seed", range(60))
def test_passed_means_enough_check_points_of_every_component(tmp_path, words, seed):
    generator = np.random.default_rng(seed)
    table, field = drawn_table(generator), str(generator.choice(["", "mesh"]))
    needed = int(generator.choice([1, 5, 42]))
    try:
        points = check_points_from_columns(table, unit_field=field)
    except InputError as error:
        assert not SAID.search(str(error)) and usable(table, "")[0] == 0
        return
    found = criteria(points, MAP_LEVELS[500], needed)
    for item in found:
        plan, height = usable(table, item.unit)
        enough = (plan if item.component == found[0].component else height) >= needed
        assert item.figures.count == (plan if item.component == found[0].component else height)
        assert (item.outcome == NOT_CHECKED) == (not enough)
    write_acceptance_report(tmp_path / "a.html", points, found, MAP_LEVELS[500], Job(), 500)
    content = pdf_content(points, found, MAP_LEVELS[500], 500)
    texts = ((tmp_path / "a.html").read_text(encoding="utf-8"), str(content.labels), str(content.tables),
             verdict(points, found, 500)[1])
    if not any(item.outcome == PASSED for item in found):
        assert not any(SAID.search(text) for text in texts)
    if outcome(found) != PASSED:
        assert not SAID.search(verdict(points, found, 500)[1])
    # The table says it once for each criterion that was passed, and nowhere else.
    number = sum(item.outcome == PASSED for item in found)
    assert len(SAID.findall(str(content.tables))) == number


def survey(count=9):
    time = np.arange(100.0, 100.0 + count)
    return Trajectory(time, np.column_stack([time, time, time]), np.zeros((count, 3)))


def control(times):
    true = np.column_stack([times, times, times])
    return ControlPoints(tuple(map(str, range(len(times)))), true, np.asarray(times, float), true + 0.001)


def test_the_accuracy_of_a_survey_is_told_and_never_judged(tmp_path, words):
    for times in ([101.0], [101.0, 102.5, 104.0, 106.0]):
        points = control(times)
        write_accuracy_report(tmp_path / "a.html", points, {"as reported": points.surveyed - points.true}, 0, 2)
        assert not SAID.search((tmp_path / "a.html").read_text(encoding="utf-8"))


def test_points_outside_of_the_survey_and_adjusted_ones_check_nothing(words):
    with pytest.raises(InputError) as refused:
        in_survey_time(control([900.0, 901.0]), survey())
    assert not SAID.search(str(refused.value))
    every = control([101.0, 102.0, 103.0])
    kept, adjusted = check_points_of(every, {"Role": [CHECK, ADJUSTED, "標定点"]}, "a.csv")
    assert kept.id == ("0",) and adjusted == 2
    assert check_points_of(every, {"id": "abc"}, "a.csv") == (every, 0)
    with pytest.raises(InputError) as refused:
        check_points_of(every, {"role": [ADJUSTED] * 3}, "a.csv")
    assert not SAID.search(str(refused.value))
