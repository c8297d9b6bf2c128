"""The help of an algorithm, made from what it declares: in the dialog, behind its Help button, in the documentation."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from html import escape as html_escape
from pathlib import Path

from qgis.core import QgsApplication

from ....urbanmap_qgis.wording import language
from ..declaring.parameters import tr

ROOT = Path(__file__).resolve().parents[3]
DOCS = ROOT / "docs"
SITES = (ROOT / "site", ROOT / "build" / "site")
"""Where the documentation is as a website: in an installed plugin, and in a checkout after `make docs`."""

GUIDES = {"start": "sample_city.md", "aerial": "aerial.md", "mobile": "mobile.md", "lines": "lines.md",
          "buildings": "buildings.md", "gnss": "gnss.md", "roadmap": "roadmap.md", "workflows": "architecture.md",
          "delivery": "acceptance.md"}
"""Page on the methods of each group, in docs/."""

TUTORIALS = {"buildingsfromals": "tutorial_buildings.html", "aerialmarkings": "tutorial_reference.html",
             "georeferencemms": "tutorial_survey.html", "acceptance": "tutorial_survey.html",
             "lanemap": "tutorial_lanemap.html", "roadspace": "tutorial_roadspace.html"}
"""Tutorial that leads through an algorithm, on the website."""

escape = partial(html_escape, quote=False)
"""Between tags: quotes stay as they are, since `qgis_process help` shows the text without reading it as HTML."""

PICTURES = {
    "samplecity": "sample_city.jpg", "buildingmodels": "models_city.jpg", "buildingsfromals": "models_sloped.jpg",
    "wallsfrommms": "facades.jpg", "mergebuildingmodels": "facades.jpg", "facadetextures": "facade_texture.jpg",
    "registermms": "survey.jpg", "georeferencemms": "survey.jpg", "exportcitymodel": "tiles_cesium.jpg",
    "overlayonimages": "overlay.jpg",
}
"""A picture of what an algorithm makes, in docs/images."""

_STYLE = """
body { font-family: sans-serif; color: #222; max-width: 56em; margin: 1.5em auto; padding: 0 1em; line-height: 1.45; }
h1 { font-size: 1.5em; border-bottom: 3px solid #2f6f8f; } h2 { font-size: 1.15em; color: #2f6f8f; }
table { border-collapse: collapse; } th, td { border-bottom: 1px solid #ddd; padding: .3em .7em; text-align: left;
  vertical-align: top; } code { background: #eef1f3; padding: 0 .2em; } img { max-width: 100%; }
""".strip()


def entries(algorithm) -> tuple[list[tuple[str, str, str, str]], list[tuple[str, str, str, str]]]:
    """Inputs and outputs of an algorithm: name, label, help, default (of outputs: empty)."""
    definitions = algorithm.parameterDefinitions()
    inputs = [(item.name(), item.description(), item.help(), _default(item)) for item in definitions
              if not item.isDestination()]
    helps = {item.name(): item.help() for item in definitions if item.isDestination()}
    labels = {item.name(): item.description() for item in definitions if item.isDestination()}
    helps.update(algorithm.output_helps())
    outputs = [(item.name(), labels.get(item.name(), item.description()), helps.get(item.name(), ""), "")
               for item in algorithm.outputDefinitions()]
    return inputs, outputs


def panel_html(algorithm) -> str:
    """The help of the dialog's panel: what it does, then each parameter and output with its own help.

    QGIS makes a paragraph of every line.
    """
    inputs, outputs = entries(algorithm)
    lines = [escape(line) for line in tr(algorithm.HELP).strip().splitlines()]
    for title, rows in ((tr("Input"), inputs), (tr("Output"), outputs)):
        lines += [f"<h3>{escape(title)}</h3>"] if rows else []
        lines += [f"<b>{escape(label)}</b>: {escape(' '.join(text.split()))}{escape(default)}"
                  for _, label, text, default in rows]
    if algorithm.SOURCE:
        lines.append(f"<i>{escape(tr('Method'))}: {escape(tr(algorithm.SOURCE))}</i>")
    return "\n".join(lines)


def page_markdown(algorithm) -> str:
    """The page as Markdown, for docs/algorithms."""
    inputs, outputs = entries(algorithm)
    lines = [f"# {algorithm.displayName()}", "", f"`urbanmap:{algorithm.name()}`, {algorithm.group()}", ""]
    for paragraph in tr(algorithm.HELP).strip().splitlines():
        lines += [paragraph.strip(), ""]
    if algorithm.name() in PICTURES:
        lines += [f"![{algorithm.displayName()}](../images/{PICTURES[algorithm.name()]})", ""]
    for title, rows in ((tr("Input"), inputs), (tr("Output"), outputs)):
        lines += [f"## {title}", "", f"| {tr('Name')} | {tr('What')} | |", "|---|---|---|"]
        lines += [f"| `{name}` | {_cell(label)} | {_cell(text)}{_cell(default)} |"
                  for name, label, text, default in rows]
        lines.append("")
    source = tr(algorithm.SOURCE) if algorithm.SOURCE else tr("own")
    lines.append(f"{tr('Method')}: {source}; [{GUIDES[algorithm.groupId()]}](../{GUIDES[algorithm.groupId()]}).")
    return "\n".join([*lines, ""])


def page_html(algorithm) -> str:
    """The page as HTML, in the user's language."""
    inputs, outputs = entries(algorithm)
    title = escape(algorithm.displayName())
    parts = [f"<h1>{title}</h1>", f"<p><code>urbanmap:{algorithm.name()}</code>, {escape(algorithm.group())}</p>"]
    parts += [f"<p>{escape(text.strip())}</p>" for text in tr(algorithm.HELP).strip().splitlines()]
    for picture in found("images/" + PICTURES.get(algorithm.name(), "none")):
        parts.append(f'<p><img src="{picture.as_uri()}" alt="{title}"></p>')
    for heading, rows in ((tr("Input"), inputs), (tr("Output"), outputs)):
        parts += [f"<h2>{escape(heading)}</h2>", "<table>", *_rows(rows), "</table>"]
    source = tr(algorithm.SOURCE) if algorithm.SOURCE else tr("own")
    parts.append(f"<p>{escape(tr('Method'))}: {escape(source)}</p>")
    for tutorial in found(TUTORIALS.get(algorithm.name(), "none")):
        parts.append(f'<p><a href="{tutorial.as_uri()}">{escape(tr("Step by step, with pictures"))}</a></p>')
    for guide in found(GUIDES[algorithm.groupId()].replace(".md", ".html")):
        parts.append(f'<p><a href="{guide.as_uri()}">{escape(tr("How it works"))}</a></p>')
    return _page(title, parts)


def found(name: str) -> list[Path]:
    """The first file of this name in the documentation, in the user's language where there is one, or none."""
    places = (folder / part / name for folder in (*SITES, DOCS) for part in (language(), ""))
    return [path for path in places if path.is_file()][:1]


def _page(title: str, parts: Iterable[str]) -> str:
    return (f'<!DOCTYPE html>\n<html lang="{language()}">\n<head><meta charset="utf-8">\n<title>{title}</title>\n'
            f"<style>{_STYLE}</style></head>\n<body>\n" + "\n".join(parts) + "\n</body>\n</html>\n")


def index_file(algorithms: Iterable) -> Path:
    """The documentation's first page: that of the website, or else a list of all algorithms with their pages."""
    for path in found("index.html"):
        return path
    rows = (f'<li><a href="{page_file(item).as_uri()}">{escape(item.displayName())}</a>: '
            f"{escape(item.shortDescription())}</li>" for item in algorithms)
    return _written("index", _page("UrbanMap", ["<h1>UrbanMap</h1>", "<ul>", *rows, "</ul>"]))


def page_file(algorithm) -> Path:
    """The page's file in the user's profile, written anew where it is not up to date."""
    return _written(algorithm.name(), page_html(algorithm))


def _written(name: str, text: str) -> Path:
    path = Path(QgsApplication.qgisSettingsDirPath()) / "urbanmap" / "help" / f"{name}.html"
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return path


def _rows(rows: Iterable[tuple[str, str, str, str]]) -> Iterable[str]:
    for name, label, text, default in rows:
        yield (f"<tr><th>{escape(label)}<br><code>{name}</code></th>"
               f"<td>{escape(' '.join(text.split()))}{escape(default)}</td></tr>")


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|") if text.strip() == text else " " + _cell(text.strip())


def _default(definition) -> str:
    value = definition.defaultValue()
    if isinstance(value, bool):
        value = tr("yes") if value else tr("no")
    return tr(" Default: {0}.").format(value) if isinstance(value, (int, float, str)) and value != "" else ""
