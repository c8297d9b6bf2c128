"""The documentation: a page for each algorithm, links that lead somewhere, a page behind the Help button."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.once

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def make_docs():
    spec = importlib.util.spec_from_file_location("make_docs", ROOT / "scripts" / "make_docs.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def algorithms(qgis_app):
    from qgis.core import QgsApplication

    provider = QgsApplication.processingRegistry().providerById("urbanmap")
    return [item.create() for item in provider.algorithms() if getattr(item, "HELP", "") and not item.SUCCESSOR]


def test_each_algorithm_has_its_page_and_no_page_is_left_over(make_docs, algorithms):
    assert not make_docs.differences(make_docs.pages_of(algorithms), ROOT / "docs" / "algorithms"), (
        "run scripts/make_docs.py")


def test_links_lead_to_files():
    lost = []
    for page in [*(ROOT / "docs").rglob("*.md"), *ROOT.glob("*.md")]:
        text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.S)
        for target in re.findall(r"\]\(([^)#\s]+)", text):
            if "://" not in target and not (page.parent / target).exists():
                lost.append(f"{page.relative_to(ROOT)}: {target}")
    assert not lost


def test_every_page_is_in_the_website():
    named = set(re.findall(r"[\w/]+\.md", (ROOT / "mkdocs.yml").read_text(encoding="utf-8")))
    pages = {path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").glob("*.md")}
    assert pages <= named and all((ROOT / "docs" / name).is_file() for name in named)


def test_the_japanese_readme_has_the_commands_algorithms_and_pictures_of_the_english_one():
    def said(name):
        text = (ROOT / name).read_text(encoding="utf-8")
        blocks = "".join(re.findall(r"^```\n(.*?)^```", text, re.M | re.S))
        return (re.sub(r" *#.*", "", blocks), re.findall(r"^\| `(urbanmap:\w+)`", text, re.M),
                re.findall(r"!\[[^]]*\]\((docs/images/\w+\.\w+)\)", text))

    commands, algorithms, pictures = said("README.md")
    assert len(algorithms) > 40 and len(pictures) == 3 and commands.count("scripts/urbanmap") >= 6
    assert said("README.ja.md") == (commands, algorithms, pictures)


@pytest.mark.parametrize("page", sorted((ROOT / "docs/ja").glob("tutorial_*.md")), ids=lambda page: page.stem)
def test_japanese_tutorials_have_the_commands_and_pictures_of_the_english_ones(page):
    def said(place):
        text = place.read_text(encoding="utf-8")
        pictures = re.findall(r"images/(?:tutorials/)?(\w+\.jpg)", text)
        return re.findall(r"^```\n(.*?)^```", text, re.M | re.S), [name.replace("_ja.", ".") for name in pictures]

    commands, pictures = said(ROOT / "docs" / page.name)
    assert commands and pictures and said(page) == (commands, pictures)


def test_every_tutorial_and_the_start_page_are_there_in_japanese():
    wanted = {"index.md", *(path.name for path in (ROOT / "docs").glob("tutorial_*.md"))}
    assert {path.name for path in (ROOT / "docs/ja").glob("*.md")} == wanted and len(wanted) == 6


def test_help_in_japanese_opens_japanese_pages(plugin, tmp_path, monkeypatch, algorithms):
    pages, speaking = (plugin(f"algorithms.framework.language.{name}") for name in ("help_page", "language"))
    for name in ("index.html", "tutorial_survey.html", "acceptance.html"):
        for folder in (tmp_path, tmp_path / "ja"):
            if folder == tmp_path or name != "acceptance.html":
                folder.mkdir(exist_ok=True)
                (folder / name).write_text(name, encoding="utf-8")
    monkeypatch.setattr(pages, "SITES", (tmp_path,))
    assert pages.index_file(()) == tmp_path / "index.html"
    translator = speaking.speak_language("ja")
    try:
        assert pages.index_file(()) == tmp_path / "ja" / "index.html"
        text = pages.page_html(next(item for item in algorithms if item.name() == "acceptance"))
    finally:
        speaking.stop_speaking(translator)
    for name in ("ja/tutorial_survey.html", "acceptance.html"):
        assert (tmp_path / name).as_uri() in text


def test_pictures_of_tutorials_are_those_that_the_script_makes():
    spec = importlib.util.spec_from_file_location("make_tutorial_pictures", ROOT / "scripts/make_tutorial_pictures.py")
    script = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = script
    spec.loader.exec_module(script)
    pages = "".join(path.read_text(encoding="utf-8")
                    for path in [*(ROOT / "docs").glob("*.md"), *(ROOT / "docs/ja").glob("*.md"), *ROOT.glob("*.md")])
    shown = set(re.findall(r"images/tutorials/([\w.]+)", pages))
    there = {path.name: path.stat().st_size for path in (ROOT / "docs/images/tutorials").iterdir()}
    assert shown == set(script.PICTURES) == set(there)
    assert max(there.values()) < 120_000
    dialogs = [kind for kind in script.PICTURES.values() if isinstance(kind, script.Dialog)]
    assert dialogs and all(f" {kind.algorithm} " in script.dialog_command(kind) for kind in dialogs)


def test_the_help_button_opens_the_algorithms_own_page(algorithms):
    from urllib.parse import unquote, urlparse

    chosen = next(item for item in algorithms if item.name() == "buildingmodels")
    text = Path(unquote(urlparse(chosen.helpUrl()).path)).read_text(encoding="utf-8")
    assert f"<h1>{chosen.displayName()}</h1>" in text and "<code>OUTPUT_CITYJSON</code>" in text and "<img" in text


def test_the_messages_explained_are_those_that_are_said():
    source = "\n".join(path.read_text(encoding="utf-8") for folder in ("urbanmap_qgis", "algorithms")
                       for path in (ROOT / folder).rglob("*.py"))
    said = re.sub(r'"\s*\n\s*f?"|\{[^{}]*\}', "", source)
    page = (ROOT / "docs" / "problems.md").read_text(encoding="utf-8")
    rows = "\n".join(line.split("|")[1] for line in page.splitlines() if line.startswith("| "))
    told = re.findall(r"`([^`]+)`", rows)
    assert len(told) > 20
    assert not [text for text in told if text not in said and text not in source]


def test_the_website_builds_offline(tmp_path):
    pytest.importorskip("mkdocs")
    done = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "--site-dir", str(tmp_path)],
                          cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    pages = list(tmp_path.rglob("*.html"))
    assert len(pages) > 50
    loaded = re.findall(r'(?:src|href)="(https?://[^"]+\.(?:js|css|woff2?))"', "".join(
        page.read_text(encoding="utf-8") for page in pages))
    assert not loaded
