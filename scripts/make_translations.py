#!/usr/bin/env python3
"""Bring the translations, resources/translations/urbanmap_*.ts, up to date with what is said, and compile them.

    python3 scripts/make_translations.py [--check]

New texts are added as unfinished, those that are no longer said go. `--check` writes nothing and fails where a text has
no translation, a field is lost or a compiled file is old. Needs a Python that sees QGIS, and Qt's lrelease.
"""

from __future__ import annotations

import argparse
import ast
import os
import re
import shutil
import string
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree
from xml.sax.saxutils import escape

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from urbanmap_qgis.wording import read_catalogue  # noqa: E402

TRANSLATIONS = ROOT / "resources" / "translations"
STYLES = ROOT / "resources" / "styles"
CONTEXT = "UrbanMap"

SAYING = {"urbanmap_qgis": ("say", "mark"), "algorithms": ("tr", "mark")}
"""Functions whose first argument is said, by folder."""


def constants_said(folder: Path, functions: tuple[str, ...]) -> Iterator[str]:
    """Texts given to one of the functions in a folder's modules."""
    for path in sorted(folder.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if (isinstance(node, ast.Call) and node.args
                    and getattr(node.func, "id", getattr(node.func, "attr", "")) in functions
                    and isinstance(node.args[0], ast.Constant) and isinstance(node.args[0].value, str)):
                yield node.args[0].value


SHOWN = {"section", "paragraph", "warning", "verdict", "facts", "table", "histogram", "figure",
         "picture", "switcher", "Report", "Series", "ShadedInterval", "profile", "bars"}
"""Methods of reports, and what they draw: constants among their arguments are shown in the user's language."""

TABLES = re.compile(r"STATUS|NAMES|MEANING|METHOD|REASON|WORDS|SHADES|KINDS|CLASSES")
"""Names of constants whose texts are data, and are shown in the user's language in reports."""


def constants_shown(folder: Path) -> Iterator[str]:
    """Texts that reports show: constants given to them, and words that are data too."""
    for path in sorted(folder.rglob("*.py")):
        code = path.read_text(encoding="utf-8")
        tree = ast.parse(code)
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and getattr(node.func, "id", getattr(node.func, "attr", "")) in SHOWN:
                for argument in (*node.args, *(item.value for item in node.keywords)):
                    yield from _plain_texts(argument)
        for node in tree.body if "io.pages.report" in code or "STATUS" in code else ():
            targets = [item.id for item in getattr(node, "targets", []) if isinstance(item, ast.Name)]
            if targets and TABLES.search(targets[0]):
                yield from (text for text in _plain_texts(node.value) if " " in text or text.islower())


def _plain_texts(node: ast.AST) -> Iterator[str]:
    """Constants that are shown as they stand: not those that choose something, such as keys."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        if re.search("[A-Za-z]{2}", node.value):
            yield node.value
    elif isinstance(node, ast.IfExp):
        yield from (text for part in (node.body, node.orelse) for text in _plain_texts(part))
    elif isinstance(node, (ast.Tuple, ast.List)):
        yield from (text for part in node.elts for text in _plain_texts(part))
    elif isinstance(node, ast.Dict):
        yield from (text for part in (*node.keys, *node.values) if part is not None for text in _plain_texts(part))
    elif isinstance(node, (ast.ListComp, ast.GeneratorExp)):
        yield from _plain_texts(node.elt)
    elif isinstance(node, ast.BinOp):
        yield from (text for part in (node.left, node.right) for text in _plain_texts(part))


def declared() -> list[str]:
    """What the toolbox shows: names, help, labels of parameters and outputs, groups."""
    from qgis.core import QgsApplication
    from qgis.PyQt.QtCore import QCoreApplication, QTranslator

    class Recorder(QTranslator):
        """Notes everything that is asked for."""

        def __init__(self):
            super().__init__()
            self.asked: dict[str, None] = {}

        def isEmpty(self):
            return False

        def translate(self, context, source, disambiguation=None, n=-1):
            if context == CONTEXT and source:
                self.asked.setdefault(source)
            return source

    sys.path.insert(0, str(ROOT.parent))
    application = QgsApplication([], False)
    application.initQgis()
    recorder = Recorder()
    QCoreApplication.installTranslator(recorder)
    _ask_for_all()
    QCoreApplication.removeTranslator(recorder)
    application.exitQgis()
    return list(recorder.asked)


def _ask_for_all() -> None:
    """Make every algorithm say what it says before it runs."""
    import importlib

    package = importlib.import_module(f"{ROOT.name}.algorithms.provider")
    provider = package.UrbanMapProvider()
    provider.register()
    provider.name(), provider.longName()
    for algorithm in provider.algorithms():
        made = algorithm.create()
        made.displayName(), made.group(), made.tags(), made.shortHelpString(), made.shortDescription()


def legends() -> Iterator[str]:
    """Legends in the styles."""
    for path in sorted(STYLES.glob("*.qml")):
        for element in ElementTree.parse(path).getroot().iter():
            label = element.get("label", "")
            if element.tag in ("category", "range", "rule", "item", "paletteEntry") and re.search("[A-Za-z]{2}", label):
                yield label


def texts() -> list[str]:
    """All that is said, each once, in the order of the code."""
    said = dict.fromkeys(declared())
    for folder, functions in SAYING.items():
        said.update(dict.fromkeys(constants_said(ROOT / folder, functions)))
    said.update(dict.fromkeys(constants_shown(ROOT / "urbanmap_qgis")))
    said.update(dict.fromkeys(legends()))
    return list(said)


def finished(path: Path) -> dict[str, str]:
    """Finished translations of a file by their English text; none where there is no file yet."""
    return read_catalogue(path) if path.is_file() else {}


def write_source(path: Path, said: list[str], translations: dict[str, str]) -> None:
    """A Qt translation source of all texts, unfinished where there is no translation."""
    language = path.stem.rpartition("_")[2]
    lines = ['<?xml version="1.0" encoding="utf-8"?>', "<!DOCTYPE TS>",
             f'<TS version="2.1" language="{language}" sourcelanguage="en">', "<context>",
             f"    <name>{CONTEXT}</name>"]
    for text in said:
        told = translations.get(text)
        lines += ["    <message>", f"        <source>{escape(text)}</source>",
                  f"        <translation>{escape(told)}</translation>" if told else
                  '        <translation type="unfinished"></translation>', "    </message>"]
    path.write_text("\n".join([*lines, "</context>", "</TS>", ""]), encoding="utf-8")


def fields(text: str) -> set[str]:
    """Names of the fields that a format string fills."""
    try:
        return {name for _, name, _, _ in string.Formatter().parse(text) if name is not None}
    except ValueError:  # no format string: braces of a text
        return set()


def faults(path: Path, said: list[str]) -> list[str]:
    """What is wrong with a translation: texts without one, fields that the English text does not fill."""
    translations = finished(path)
    wrong = [f"{path.name} does not translate: {text!r}" for text in said if text not in translations]
    wrong += [f"{path.name} says more than: {text!r}" for text in set(translations) - set(said)]
    wrong += [f"{path.name} fills other fields than: {text!r}" for text, told in translations.items()
              if fields(told) - fields(text)]
    return wrong


def compiled(path: Path) -> bytes:
    """The translation as Qt reads it."""
    command = shutil.which("lrelease") or shutil.which("lrelease-qt5")
    if command is None:
        raise SystemExit("lrelease is missing: install Qt's translation tools (Debian: qttools5-dev-tools).")
    target = path.with_name(f"{path.stem.rpartition('_')[2]}.qm")
    subprocess.run([command, "-silent", "-removeidentical", str(path), "-qm", str(target)], check=True)
    return target.read_bytes()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing, fail on what is missing")
    parser.add_argument("--take", type=Path, help="JSON of English texts and translations to take over")
    arguments = parser.parse_args()
    said = texts()
    wrong = []
    for path in sorted(TRANSLATIONS.glob("urbanmap_*.ts")):
        if not arguments.check:
            known = finished(path)
            if arguments.take:
                import json

                known.update(json.loads(arguments.take.read_text(encoding="utf-8")))
            write_source(path, said, known)
            compiled(path)
        wrong += faults(path, said)
    print("\n".join(wrong) or f"{len(said)} texts, all translated")
    return 1 if wrong and arguments.check else 0


if __name__ == "__main__":
    sys.exit(main())
