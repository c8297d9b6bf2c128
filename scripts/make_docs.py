#!/usr/bin/env python3
"""Write the documentation's page of each algorithm, docs/algorithms/*.md, from the algorithm's own help.

    python3 scripts/make_docs.py [--check]

`--check` writes nothing and fails where a page is missing, too much or not up to date. Needs a Python that sees QGIS.
`make docs` then builds all pages as a website into build/site, which needs no network to be read.
"""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ["LC_ALL"] = "C.UTF-8"  # the pages are in English

ROOT = Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs" / "algorithms"


def pages() -> dict[str, str]:
    """Text of each page by its file name, with an index."""
    from qgis.core import QgsApplication

    sys.path.insert(0, str(ROOT.parent))
    application = QgsApplication([], False)
    application.initQgis()
    provider = importlib.import_module(f"{ROOT.name}.algorithms.provider").UrbanMapProvider()
    provider.register()
    made = pages_of([item.create() for item in provider.algorithms()
                     if getattr(item, "HELP", "") and not item.SUCCESSOR])
    application.exitQgis()
    return made


def pages_of(algorithms: list) -> dict[str, str]:
    """Text of each page by its file name, with an index by group."""
    package = algorithms[0].__class__.__module__.rpartition(".algorithms.")[0]
    page_markdown = importlib.import_module(f"{package}.algorithms.framework.language.help_page").page_markdown
    groups = importlib.import_module(f"{package}.algorithms.framework.base").GROUPS
    made = {f"{item.name()}.md": page_markdown(item) for item in algorithms}
    lines = ["# Algorithms", "", "Made from the algorithms' own help.", ""]
    for key, title in groups.items():
        lines += [f"## {title}", ""]
        lines += [f"- [{item.displayName()}]({item.name()}.md), `urbanmap:{item.name()}`: {item.shortDescription()}"
                  for item in algorithms if item.groupId() == key] + [""]
    made["index.md"] = "\n".join(lines)
    return made


def differences(made: dict[str, str], folder: Path) -> list[str]:
    """What a folder's pages lack, have too much, or tell otherwise."""
    there = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.md")}
    return [f"{name}: {'missing' if name not in there else 'no algorithm' if name not in made else 'not up to date'}"
            for name in sorted(set(made) | set(there)) if made.get(name) != there.get(name)]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing, fail on differences")
    check = parser.parse_args().check
    made = pages()
    wrong = differences(made, PAGES)
    if check:
        print("\n".join(wrong) or f"{len(made)} pages are up to date")
        return 1 if wrong else 0
    PAGES.mkdir(parents=True, exist_ok=True)
    for path in PAGES.glob("*.md"):
        if path.name not in made:
            path.unlink()
    for name, text in made.items():
        (PAGES / name).write_text(text, encoding="utf-8")
    print(f"{len(made)} pages, {len(wrong)} of them new or changed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
