"""Records of settings: what is declared once gives defaults, refusals and what extends them."""

from __future__ import annotations

import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields, is_dataclass, replace

import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.settings.declaration import Settings, record, setting


def a_record():
    @record(frozen=True)
    class Rules(Settings):
        width: float = setting(0.5, "Width", "How wide.", "m", 0.1, 2.0)
        method: str = setting("full", "Method", "How.", choices=("full", "paper"))
        reach: float | None = setting(None, "Reach", "How far.", "m", 0.0)
        inner: int = 3

    return Rules


def test_a_record_is_a_frozen_dataclass_from_its_first_use():
    rules = a_record()
    assert not is_dataclass(rules) and list(rules.declared) == ["width", "method", "reach"]
    assert rules.defaults == {"width": 0.5, "method": "full", "reach": None} and rules.kinds["width"] == "float"
    made = rules(width=0.7)
    assert (made.width, made.method, made.reach, made.inner) == (0.7, "full", None, 3)
    assert made == replace(rules(), width=0.7) and made != rules() and hash(made) == hash(rules(0.7))
    with pytest.raises(AttributeError):
        made.width = 1.0
    assert [field.name for field in fields(rules)] == ["width", "method", "reach", "inner"]


def test_several_threads_may_use_it_first():
    rules = a_record()
    with ThreadPoolExecutor(8) as pool:
        assert len(set(pool.map(lambda _: rules(), range(64)))) == 1


@pytest.mark.parametrize("wrong, words", [({"width": 0.0}, "Width must be greater than 0"),
                                          ({"width": float("nan")}, "Width must be greater than 0"),
                                          ({"reach": -1.0}, "Reach must not be less than 0"),
                                          ({"method": "own"}, "own is none of full, paper")])
def test_what_no_declaration_allows_is_refused(wrong, words):
    with pytest.raises(InputError, match=words):
        a_record()(**wrong)


def test_a_record_of_the_core_extends_it():
    rules = a_record()

    @dataclass(frozen=True)
    class More(rules):
        scanner: str = "2D"

    assert More(method="paper", scanner="3D").width == 0.5 and list(More.declared) == ["width", "method", "reach"]
    with pytest.raises(InputError, match="Width"):
        More(width=-1.0)


def test_records_travel_to_worker_processes():
    from urbanmap_qgis.settings.terrain import SurfaceSettings

    given = SurfaceSettings(resolution=2.0)
    assert pickle.loads(pickle.dumps(given)) == given and given.cloth.iterations == 1000
