"""The zip that users install: built, unpacked into a clean profile, and listed by QGIS."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    if not (ROOT / ".git").exists():
        pytest.skip("the zip is built from the files that git tracks, and this is no git checkout")
    folder = tmp_path_factory.mktemp("build")
    target = folder / "urbanmap_qgis.zip"
    subprocess.run([sys.executable, "-m", "mkdocs", "build", "--quiet", "--site-dir", str(folder / "site")], cwd=ROOT,
                   check=True)
    subprocess.run([*script(folder), "--output", str(target)], check=True)
    return target


def script(folder: Path) -> list[str]:
    return [sys.executable, str(ROOT / "scripts" / "package.py"), "--site", str(folder / "site")]


@pytest.fixture(scope="module")
def unpacked(package, tmp_path_factory):
    folder = tmp_path_factory.mktemp("unpacked")
    with zipfile.ZipFile(package) as archive:
        archive.extractall(folder)
    return folder / "urbanmap_qgis"


@pytest.mark.once
def test_plugin_repository_finds_nothing_unsafe(unpacked):
    """Its scan: any finding of Bandit's rules keeps an upload back. A waived one has its reason beside it."""
    done = subprocess.run([sys.executable, "-m", "bandit", "-q", "-r", "-f", "json", str(unpacked)],
                          capture_output=True, text=True, check=False)
    told = json.loads(done.stdout)
    assert not told["results"] and not told["errors"] and done.returncode == 0
    assert told["metrics"]["_totals"]["loc"] > 40000
    lines = [line for path in unpacked.rglob("*.py") for line in path.read_text(encoding="utf-8").splitlines()]
    assert not [line for line in lines if re.search(r"#\s*nosec\b(?! B\d{3})", line)]


@pytest.mark.once
def test_plugin_repository_finds_no_secret(unpacked):
    """Any finding keeps an upload back."""
    assert secrets(unpacked) == {}


@pytest.mark.once
def test_a_secret_would_be_found(tmp_path):
    # In two parts, so that this file holds none.
    (tmp_path / "a.py").write_text('key = "AKIA' + 'QWERTYUIOPASDFGH"\n', encoding="utf-8")
    assert list(secrets(tmp_path)) == ["a.py"]


def secrets(folder: Path) -> dict:
    """What is found by file. From another folder than the one it stands in, the tool finds nothing and says so too."""
    done = subprocess.run([sys.executable, "-m", "detect_secrets", "scan", "--all-files", "."], cwd=folder,
                          capture_output=True, text=True, check=True)
    return json.loads(done.stdout)["results"]


@pytest.mark.once
def test_style_is_clean_too(unpacked):
    done = subprocess.run([sys.executable, "-m", "flake8", "--config", str(ROOT / ".flake8"), str(unpacked)],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-3000:]


def test_zip_is_small_and_holds_one_copy_of_the_help(package):
    names = zipfile.ZipFile(package).namelist()
    assert package.stat().st_size < 4_000_000
    assert "urbanmap_qgis/site/index.html" in names and "urbanmap_qgis/site/algorithms/registermms.html" in names
    assert not [name for name in names if name.endswith((".ts", ".map")) or "/docs/" in name]


def test_help_in_the_zip_leaves_out_what_is_for_programmers(unpacked):
    page = (unpacked / "site" / "algorithms" / "registermms.html").read_text(encoding="utf-8")
    assert "Glossary" in page and "The core" not in page and "Developers" not in page
    assert not (unpacked / "site" / "developer.html").exists()


def test_script_of_the_help_asks_for_nothing_that_pages_lack(unpacked):
    page = (unpacked / "site" / "algorithms" / "registermms.html").read_text(encoding="utf-8")
    script = (unpacked / "site" / "js" / "base.js").read_text(encoding="utf-8")
    assert not [name for name in re.findall(r'getElementById\(["\']([^"\']+)', script) if f'id="{name}"' not in page]
    classes = [name for query in re.findall(r'querySelector(?:All)?\("([^"]+)', script)
               for name in re.findall(r"\.([a-z-]+)", query)]
    assert classes and not [name for name in classes if not re.search(rf'class="[^"]*\b{name}\b', page)]


def test_styles_of_the_help_are_those_that_its_pages_can_need():
    from scripts.package import used_styles

    styles = ('@charset "UTF-8";/*! of others */:root{--a:1}.dark,.row>*{width:100%}.row .tooltip,a.nav{color:red}'
              '.tooltip{margin:0}p:not(.tooltip){top:0}a[href$=".pdf"]{left:0}'
              "@media print{.row{float:none}.card{top:1px}}@media screen{.card{top:2px}}@font-face{font-family:x}")
    assert used_styles(styles, {"row", "nav"}) == (
        '@charset "UTF-8";:root{--a:1}.row>*{width:100%}a.nav{color:red}p:not(.tooltip){top:0}a[href$=".pdf"]{left:0}'
        "@media print{.row{float:none}}@font-face{font-family:x}")


@pytest.mark.parametrize("page", ["README.md", "README.ja.md"])
def test_links_of_the_readme_lead_to_files_of_the_zip(unpacked, page):
    links = re.findall(r"\]\(([^)\s]+)\)", (unpacked / page).read_text(encoding="utf-8"))
    inside = [link for link in links if "://" not in link]
    assert len(inside) >= 9
    assert not [link for link in inside if not (unpacked / link.partition("#")[0]).is_file()]


def test_pages_of_the_help_have_all_that_they_show_and_link_to(unpacked):
    for page in (unpacked / "site").rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        named = re.findall(r'<img[^>]* src="([^"]+)"', text) + re.findall(r'<a [^>]*href="([^":]+)"', text)
        files = [name.partition("#")[0] for name in named if name[0] not in "#/"]
        missing = [name for name in files if not (page.parent / name).exists()]
        assert not missing, page


def test_zip_holds_what_is_needed_and_nothing_else(package):
    names = zipfile.ZipFile(package).namelist()
    assert {"urbanmap_qgis/metadata.txt", "urbanmap_qgis/LICENSE", "urbanmap_qgis/__init__.py",
            "urbanmap_qgis/algorithms/provider.py", "urbanmap_qgis/urbanmap_qgis/errors.py",
            "urbanmap_qgis/resources/icons/urbanmap.svg"} <= set(names)
    assert all(name.startswith("urbanmap_qgis/") for name in names)
    inside = {name.split("/")[1] for name in names}
    assert inside <= {"metadata.txt", "LICENSE", "README.md", "README.ja.md", "CHANGELOG.md", "__init__.py",
                      "algorithms", "urbanmap_qgis", "resources", "site"}
    assert not [name for name in names if "__pycache__" in name or "/." in name or "/tests/" in name]


@pytest.mark.once
def test_zip_is_the_same_each_time(package, tmp_path):
    again = tmp_path / "again.zip"
    subprocess.run([*script(package.parent), "--output", str(again)], check=True)
    assert again.read_bytes() == package.read_bytes()


def test_metadata_for_the_plugin_repository(package, tmp_path):
    """What is asked there is in the zip where it was given, and nothing that is made up where it was not."""
    import configparser

    def told(path):
        read = configparser.ConfigParser(interpolation=None)
        read.read_string(zipfile.ZipFile(path).read("urbanmap_qgis/metadata.txt").decode("utf-8"))
        return read["general"]

    assert not {"repository", "tracker", "homepage", "email"} & set(told(package))
    made_by = [*script(package.parent), "--output", str(tmp_path / "p.zip")]
    subprocess.run([*made_by, "--repository", "https://code.example.org/survey/urbanmap/", "--email", "a@example.org"],
                   check=True)
    made = told(tmp_path / "p.zip")
    assert made["tracker"] == "https://code.example.org/survey/urbanmap/issues" and made["email"] == "a@example.org"
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").splitlines()
    latest = next(line for line in changes if line.startswith("- "))
    assert made["repository"] == made["homepage"] and latest[2:] in made["changelog"]
    assert subprocess.run([*made_by, "--repository", "urbanmap"], check=False, capture_output=True).returncode == 1


def test_unpacked_zip_lists_the_algorithms(package, new_profile, linked_profile):
    profile = new_profile()
    with zipfile.ZipFile(package) as archive:
        archive.extractall(profile.plugins)
    enabled = profile.call("plugins", "enable", "urbanmap_qgis")
    assert enabled.code == 0, enabled.err
    found = own_lines(profile.call("list").out)
    assert any("urbanmap:loadgsi\t" in line for line in found)
    assert found == own_lines(linked_profile().call("list").out)


def own_lines(listing: str) -> list[str]:
    return [line.strip() for line in listing.splitlines() if "urbanmap:" in line]
