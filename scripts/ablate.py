#!/usr/bin/env python3
"""Switch the correcting mechanisms of scripts/ledger.toml off, one after another, and print which figures change.

    python3 scripts/ablate.py [ROOM or ROW ...]    (or: make ablate ROWS="lines edges")
    python3 scripts/ablate.py --list
    python3 scripts/ablate.py --figures SCENE      (the scene's figures alone, as JSON)

A scene of the ledger is a command line of a script that prints figures. It runs once as the program stands and once
for each row that names it, in a process of its own in which `old` of the row's file reads `new`; no file is changed.
Scenes whose data are absent (the demo city of `make demo`, ../shared/data) are left out and named. Seconds of CPU are
no figures.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib.abc
import importlib.machinery
import importlib.util
import io
import json
import os
import re
import runpy
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import tomllib

ROOT = Path(__file__).resolve().parents[1]
LEDGER = ROOT / "scripts" / "ledger.toml"

VERDICTS = ("earns", "mixed", "noise", "no change", "open")
"""What a row was found to be: "open" is not run yet."""

NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
SECONDS = re.compile(r"[\d.]+ s (?:of CPU|a kilometre)|^CPU.*$", re.MULTILINE)


@dataclass(frozen=True)
class Row:
    """A correcting mechanism: the text `old` of `file` that is replaced by `new` switches it off."""

    name: str
    room: str
    what: str
    file: str
    old: str
    new: str
    scenes: tuple[str, ...]
    verdict: str
    date: str = ""
    figure: str = ""
    on: str = ""
    off: str = ""


@dataclass(frozen=True)
class Ledger:
    """Scenes (name: command line), the mechanisms that are there, and those that went (name, room, figure, date)."""

    scenes: dict[str, str]
    rows: tuple[Row, ...]
    retired: tuple[dict[str, str], ...]


def read_ledger(path: Path = LEDGER) -> Ledger:
    """The ledger of a file."""
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    rows = tuple(Row(**{**row, "scenes": tuple(row["scenes"])}) for row in data["row"])
    return Ledger(data["scenes"], rows, tuple(data.get("retired", ())))


def absent(command: str) -> list[str]:
    """Paths of a scene's command line that there are not."""
    return [word for word in shlex.split(command) if "/" in word and not (ROOT / word).exists()]


class _Patch(importlib.abc.MetaPathFinder):
    """Import of one module with another text."""

    def __init__(self, row: Row) -> None:
        self.name = row.file[:-len(".py")].replace("/", ".")
        text = (ROOT / row.file).read_text(encoding="utf-8")
        if text.count(row.old) != 1:
            raise SystemExit(f"{row.name}: its text stands {text.count(row.old)} times in {row.file}")
        self.text = text.replace(row.old, row.new)

    def find_spec(self, fullname: str, path, target=None):
        if fullname != self.name:
            return None
        spec = importlib.machinery.PathFinder.find_spec(fullname, path)
        text = self.text

        class Loader(importlib.machinery.SourceFileLoader):
            def get_code(self, fullname: str):
                return compile(text, self.path, "exec", dont_inherit=True)

        return importlib.util.spec_from_file_location(fullname, spec.origin, loader=Loader(fullname, spec.origin))


def figures_of(printed: str) -> dict[str, list[float]]:
    """Numbers of a script's lines by the words around them; of equal lines the later ones have their number behind."""
    figures: dict[str, list[float]] = {}
    for line in SECONDS.sub("", printed).splitlines():
        words = " ".join(NUMBER.sub("#", line).split())
        numbers = [float(one) for one in NUMBER.findall(line)]
        if numbers:
            name, count = words, 1
            while name in figures:
                count += 1
                name = f"{words} ({count})"
            figures[name] = numbers
    return figures


def run_scene(command: str, row: Row | None) -> dict[str, list[float]]:
    """Figures of a scene in this process, with a row switched off."""
    sys.path[:0] = [str(ROOT), str(ROOT / "scripts")]
    if row is not None:
        sys.meta_path.insert(0, _Patch(row))
    os.chdir(ROOT)
    sys.argv = shlex.split(command)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        try:
            runpy.run_path(sys.argv[0], run_name="__main__")
        except SystemExit as stop:
            if stop.code:
                raise
    return figures_of(printed.getvalue())


def measured(ledger: Path, scene: str, row: Row | None = None) -> dict[str, list[float]] | str:
    """Figures of a scene from a process of its own, or the last line of what went wrong."""
    command = [sys.executable, __file__, "--ledger", str(ledger), "--figures", scene]
    done = subprocess.run([*command, *(["--without", row.name] if row else [])], capture_output=True, text=True,
                          check=False)
    if done.returncode:
        return (done.stderr.strip().splitlines() or ["ended without a word"])[-1]
    return json.loads(done.stdout)


def changes(before: dict[str, list[float]], after: dict[str, list[float]]) -> Iterator[str]:
    """A line for each figure that differs, is new or is gone."""
    for name in [*before, *(name for name in after if name not in before)]:
        old, new = before.get(name), after.get(name)
        if old != new:
            yield f"{name}: {_values(old)} -> {_values(new)}"


def _values(numbers: list[float] | None) -> str:
    return "none" if numbers is None else " ".join(f"{one:g}" for one in numbers)


def chosen(ledger: Ledger, names: list[str]) -> list[Row]:
    """Rows of the rooms and names given; all without any."""
    known = {row.room for row in ledger.rows} | {row.name for row in ledger.rows}
    if unknown := set(names) - known:
        raise SystemExit(f"no room or row: {', '.join(sorted(unknown))}")
    return [row for row in ledger.rows if not names or row.room in names or row.name in names]


def ablate(path: Path, names: list[str]) -> None:
    """Print what changes without each row of a ledger's file."""
    ledger = read_ledger(path)
    rows = chosen(ledger, names)
    for scene in sorted({scene for row in rows for scene in row.scenes}):
        command = ledger.scenes[scene]
        if gone := absent(command):
            print(f"== {scene}: left out, there is no {', '.join(gone)}")
            continue
        base = measured(path, scene)
        if isinstance(base, str):
            print(f"== {scene}: failed: {base}")
            continue
        print(f"== {scene}: {sum(map(len, base.values()))} figures of {command}", flush=True)
        for row in rows:
            if scene in row.scenes:
                made = measured(path, scene, row)
                lines = [f"fails: {made}"] if isinstance(made, str) else list(changes(base, made))
                print(f"{row.name} ({row.what}): {f'{len(lines)} lines change' if lines else 'no change'}")
                print("".join(f"    {line}\n" for line in lines), end="", flush=True)


def main() -> None:
    """Run what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", help="rooms and rows; all without any")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--figures", metavar="SCENE")
    parser.add_argument("--without", metavar="ROW")
    parser.add_argument("--ledger", type=Path, default=LEDGER)
    given = parser.parse_args()
    ledger = read_ledger(given.ledger)
    if given.list:
        for row in ledger.rows:
            print(f"{row.room:14s} {row.name:24s} {row.verdict:10s} {row.what}")
    elif given.figures:
        row = chosen(ledger, [given.without])[0] if given.without else None
        print(json.dumps(run_scene(ledger.scenes[given.figures], row)))
    else:
        ablate(given.ledger, given.names)


if __name__ == "__main__":
    main()
