"""What the core says, in English and by a catalogue."""

from __future__ import annotations

from pathlib import Path

import pytest

from urbanmap_qgis import wording
from urbanmap_qgis.wording import known, mark, read_catalogue, say

CATALOGUE = """<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="ja"><context><name>UrbanMap</name>
<message><source>{path} holds {count:,} points.</source><translation>{path} の点数：{count:,}</translation></message>
<message><source>roof &amp; wall</source><translation>屋根と壁</translation></message>
<message><source>not yet</source><translation type="unfinished">まだ</translation></message>
</context></TS>
"""


@pytest.fixture
def japanese(tmp_path):
    path = tmp_path / "urbanmap_ja.ts"
    path.write_text(CATALOGUE, encoding="utf-8")
    wording.use_catalogue(path)
    yield path
    wording.use_catalogue(None)


def test_english_is_said_as_it_is_written():
    assert say("{path} holds {count:,} points.", path="a.laz", count=12345) == "a.laz holds 12,345 points."
    assert known("roof & wall") == mark("roof & wall") == "roof & wall"
    assert wording.language() == "en" and wording.catalogue_path() is None


def test_a_catalogue_puts_the_fields_where_its_language_wants_them(japanese):
    assert say("{path} holds {count:,} points.", path="a.laz", count=12345) == "a.laz の点数：12,345"
    assert known("roof & wall") == "屋根と壁"
    assert wording.language() == "ja" and wording.catalogue_path() == japanese


def test_a_compiled_catalogue_says_what_its_source_says():
    source = Path(__file__).parents[2] / "resources" / "translations" / "urbanmap_ja.ts"
    told, compiled = read_catalogue(source), read_catalogue(source.with_name("ja.qm"))
    # A compiled one leaves out what is the same in both languages.
    assert {text: words for text, words in told.items() if words != text} == \
        {text: words for text, words in compiled.items() if words != text}
    assert len(compiled) > 2000


@pytest.mark.parametrize("data", [b"", b"<TS/>", b"\x3c\xb8\x64"])
def test_what_is_no_compiled_catalogue_is_refused(tmp_path, data):
    (tmp_path / "urbanmap_ja.qm").write_bytes(data)
    with pytest.raises(ValueError, match="no compiled"):
        read_catalogue(tmp_path / "urbanmap_ja.qm")


def test_what_is_not_or_not_finally_translated_stays_english(japanese):
    assert say("not yet") == "not yet"
    assert say("{0} of {n}".replace("{0}", "none"), n=3) == "none of 3"


def test_braces_in_values_are_not_fields():
    assert say("{text} is damaged.", text="{a}{0}") == "{a}{0} is damaged."
