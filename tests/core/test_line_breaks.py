"""Where lines of a text end."""

from urbanmap_qgis.io.pages.line_breaks import broken_lines


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
