"""Pages refer to what there is: the two papers, as scripts/paper_steps.toml has them, and scripts."""

import re

import pytest

from scripts.make_paper_page import ROOT, references

pytestmark = pytest.mark.once

WRONG = re.compile(r"E\. ?Javanmardi|Toward precision|(Javanmardi|Shibasaki),? \(?20\d\d|urban mapping \(20", re.I)
IN_FULL = ("metadata.txt", "README.md", "README.ja.md", "docs/papers.md", "docs/paper_steps.md")
FOLDERS = ("docs", "algorithms", "urbanmap_qgis", "scripts", "resources")


def plain(text: str) -> str:
    """Words without line ends and Markdown's marks of titles."""
    return " ".join(text.replace("*", "").split())


@pytest.mark.parametrize("page", IN_FULL)
def test_pages_that_cite_in_full_agree(page):
    text = plain((ROOT / page).read_text(encoding="utf-8"))
    assert [author for author, reference in references().values() if plain(reference) not in text] == []


def test_the_citation_file_names_the_same_works():
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    titles = [re.search(r"\*(.+?)\*", reference)[1] for _, reference in references().values()]
    assert re.findall(r"^    title: (.+)$", text, re.M) == titles
    version = re.search(r"^version=(.+)$", (ROOT / "metadata.txt").read_text(encoding="utf-8"), re.M)[1]
    assert f"\nversion: {version}\n" in text


def test_no_other_words_for_them():
    files = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*")
             if path.suffix in (".md", ".py", ".toml", ".ts")]
    files += [*(ROOT / name for name in IN_FULL), *ROOT.glob("*.cff")]
    texts = {path: plain(path.read_text(encoding="utf-8")) for path in files}
    assert sum("Javanmardi" in text for text in texts.values()) > 60
    assert {path.name: found[0] for path, text in texts.items() if (found := WRONG.search(text))} == {}


def test_scripts_that_pages_name_are_there():
    pages = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), ROOT / "Makefile"]
    named = {script for page in pages for script in re.findall(r"scripts/[\w/]+\.(?:py|sh|toml)",
                                                               page.read_text(encoding="utf-8"))}
    assert len(named) > 20 and not [script for script in named if not (ROOT / script).is_file()]
