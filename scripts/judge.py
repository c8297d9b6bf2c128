#!/usr/bin/env python3
"""What the program reaches against a known truth: one judge for each question, its data as arguments.

    python3 scripts/judge.py                                   the judges, and what each compares
    python3 scripts/judge.py edges CITY SURVEY.laz DRIVE.csv   one of them; with --help, its arguments

A judge is the function `judge` of a module in scripts/judges. The command line's arguments are its parameters: by place
where they have no default, else by name. Judges that read layers need a Python that sees QGIS's GDAL.
"""

from __future__ import annotations

import argparse
import importlib
import inspect
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import get_args, get_origin, get_type_hints

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))


def judges() -> dict[str, str]:
    """First line of what each judge says of itself, by name."""
    texts = {path.stem: path.read_text(encoding="utf-8") for path in sorted((ROOT / "scripts/judges").glob("*.py"))}
    return {name: text.partition("\n")[0].strip('"') for name, text in texts.items() if "\ndef judge(" in text}


def parser_of(judge: Callable, name: str) -> argparse.ArgumentParser:
    """The command line that a judge's parameters make; a tuple takes several values, a truth is a switch."""
    parser = argparse.ArgumentParser(prog=f"judge.py {name}", formatter_class=argparse.RawDescriptionHelpFormatter,
                                     description=inspect.getmodule(judge).__doc__)
    hints = get_type_hints(judge)
    for key, parameter in inspect.signature(judge).parameters.items():
        needed = parameter.default is parameter.empty
        flag = key if needed else f"--{key.replace('_', '-')}"
        several = get_origin(hints[key]) is tuple
        kind = next(iter(get_args(hints[key])), hints[key])
        if kind is bool:
            parser.add_argument(flag, action="store_true")
        elif several:
            parser.add_argument(flag, type=kind, nargs="+" if needed else "*", default=parameter.default)
        else:
            parser.add_argument(flag, type=kind, default=parameter.default)
    return parser


def main(words: Sequence[str]) -> None:
    """Run the judge that is named, or list all."""
    if not words or words[0] not in judges():
        print("\n".join(f"{name:18s} {text}" for name, text in judges().items()))
        sys.exit(2 if words else 0)
    judge = importlib.import_module(f"scripts.judges.{words[0]}").judge
    judge(**vars(parser_of(judge, words[0]).parse_args(words[1:])))


if __name__ == "__main__":
    main(sys.argv[1:])
