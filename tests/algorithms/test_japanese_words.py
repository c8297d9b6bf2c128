"""In Japanese no English word is left but ids, formats, units, abbreviations: dialogs and help.

Messages and reports: test_every_algorithm.py.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

from tests.japanese import english

ROOT = Path(__file__).resolve().parents[2]
CATALOGUE = ROOT / "resources" / "translations" / "urbanmap_ja.ts"

OUTSIDE = set("""
    sudo apt pip python lasinfo repair Drape PatchJGD Rules withheld ca
""".split())  # noqa: SIM905
"""Words of commands, of other programs and of a page's title that help and messages name."""

SOURCES = {"et", "al", "eq", "and"}
"""Words between the authors of a method."""

SPEAKING = {"InputError", "OutputError", "UrbanMapError", "warn", "message", "pushInfo", "pushWarning", "reportError",
            "QgsProcessingException"}
"""Calls whose first argument the user reads."""


@pytest.fixture(scope="module")
def data_words():
    """Words that the code uses as data: columns, values, keys. Help names them as they are; reports do not."""
    found = set()
    for folder in ("urbanmap_qgis", "algorithms"):
        for path in (ROOT / folder).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Constant) and isinstance(node.value, str) and len(node.value) < 40:
                    found |= set(re.findall(r"[A-Za-z][A-Za-z_]+", node.value)) if is_data(node.value) else set()
                elif isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                    found.add(node.name)
    return found


def is_data(text: str) -> bool:
    """Whether a constant can be a column, a value or a key: at most three words without a capital or a full stop."""
    return re.fullmatch(r"[\w.:{}|%/-]+( [a-z_]+){0,2}", text) is not None


def test_translations_leave_no_english_but_ids(data_words):
    from urbanmap_qgis.wording import read_catalogue

    left = {text: words for text, told in read_catalogue(CATALOGUE).items()
            if (words := [word for word in english(told, data_words) if word not in OUTSIDE])}
    assert not left


def test_translations_are_not_the_english_text():
    """But those that are names, formats, units and abbreviations alone."""
    from urbanmap_qgis.wording import read_catalogue

    same = [text for text, told in read_catalogue(CATALOGUE).items() if text == told and english(text, set())]
    assert not same


SURVEYORS = {
    "登録済": "位置合わせ済み", "レジストレーション": "位置合わせ", "移動計測": "MMS計測", "標高系": "高さの基準",
    "キャリブレーション": "校正", "遮蔽マップ": "遮蔽図", "格子": "グリッド",
    "信頼不可": "信頼できない", "不健康": "使用不可",
    "塗装": "標示", "与えてください": "指定してください",
}
"""Words that no surveyor writes, or that stand beside another for the same thing, and the one that is used."""


@pytest.mark.parametrize("word", SURVEYORS)
def test_words_are_those_that_surveyors_write(word):
    from urbanmap_qgis.wording import read_catalogue

    pages = [ROOT / "README.ja.md", *sorted((ROOT / "docs" / "ja").glob("*.md"))]
    said = [*read_catalogue(CATALOGUE).values(), *(path.read_text(encoding="utf-8") for path in pages)]
    assert len(pages) > 4
    assert not [text[:80] for text in said if word in text], f"use {SURVEYORS[word]}"


def test_kinds_of_observations_and_statuses_of_drives_are_translated():
    from urbanmap_qgis.mobile.adjustment.network import KINDS
    from urbanmap_qgis.mobile.adjustment.records import STATUS_NAMES
    from urbanmap_qgis.wording import read_catalogue

    assert not {*KINDS, *STATUS_NAMES} - set(read_catalogue(CATALOGUE))


def test_no_sentence_goes_past_the_translation():
    raw = []
    for folder in ("urbanmap_qgis", "algorithms"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if (isinstance(node, ast.Call) and node.args and isinstance(node.args[0], (ast.Constant, ast.JoinedStr))
                        and getattr(node.func, "id", getattr(node.func, "attr", "")) in SPEAKING):
                    parts = node.args[0].values if isinstance(node.args[0], ast.JoinedStr) else [node.args[0]]
                    text = " ".join(str(part.value) for part in parts if isinstance(part, ast.Constant))
                    if re.search("[a-z]{2}", text):
                        raw.append(f"{path.relative_to(ROOT)}:{node.lineno}: {text}")
    assert not raw


@pytest.fixture(scope="module")
def speaking(qgis_app, plugin):
    """Japanese for the test; the words of choices and ids of parameters and algorithms."""
    from qgis.core import QgsApplication

    language = plugin("algorithms.framework.language.language")
    translator = language.speak_language("ja")
    provider = QgsApplication.processingRegistry().providerById("urbanmap")
    provider.refreshAlgorithms()  # models keep the words with which they were loaded
    yield provider
    language.stop_speaking(translator)
    provider.refreshAlgorithms()


def test_dialogs_are_in_japanese(speaking, data_words):
    """Names, groups, labels and words of choices hold no ids; help does. (Headings of models' help are QGIS's own.)"""
    left = {}
    for algorithm in (item.create() for item in speaking.algorithms()):
        labels = [algorithm.displayName(), algorithm.group(), *(
            item.description() for item in (*algorithm.parameterDefinitions(), *algorithm.outputDefinitions()))]
        labels += [word for item in algorithm.parameterDefinitions() if item.type() == "enum"
                   for word in item.metadata()["urbanmap_words"].values()]
        texts = [algorithm.shortHelpString(), *(item.help() for item in algorithm.parameterDefinitions())]
        words = [word for text in labels for word in english(text, set())]
        words += [word for text in texts for word in english(re.sub("<h2>.*?</h2>|<[^>]*>", " ", text), data_words)
                  if word not in OUTSIDE | SOURCES]
        if words:
            left[algorithm.name()] = words
    assert len(list(speaking.algorithms())) > 50 and left == {}
