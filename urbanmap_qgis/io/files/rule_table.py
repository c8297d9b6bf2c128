"""Rules of a check as a table: code, severity, what it looks at, source and text in English and Japanese.

A table lies beside the rules' functions as ``rules.tsv``. A rule's function says only which elements break it, with
the fields of the text; codes, severities, sentences, the documentation's page and the list of rules that may be left
out all come from the table.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from ...errors import InputError
from ...wording import language, say

SEVERITIES = ("error", "warning", "info")


@dataclass(frozen=True)
class CheckRule:
    """One row.

    Attributes
    ----------
    code, severity : see there.
    primitive : kind of element that it looks at.
    source : who asks for it.
    text, japanese : sentence on an element that breaks it, with named fields.
    """

    code: str
    severity: str
    primitive: str
    source: str
    text: str
    japanese: str

    def sentence(self, fields: Mapping[str, object]) -> str:
        """The text in the user's language with its fields filled."""
        return (self.japanese if language() == "ja" else self.text).format(**fields)


RuleFunction = Callable[..., Iterator[Any]]


class RuleTable:
    """The rules of one check, by their codes in the order of the table, and the functions of those that have one."""

    def __init__(self, path: str | os.PathLike):
        self.path = Path(path)
        self.functions: dict[str, RuleFunction] = {}

    @cached_property
    def rules(self) -> Mapping[str, CheckRule]:
        """All rules by their codes."""
        with open(self.path, encoding="utf-8", newline="") as table:
            return {row["code"]: CheckRule(**row)
                    for row in csv.DictReader(table, delimiter="\t", quoting=csv.QUOTE_NONE)}

    def rule(self, *codes: str) -> Callable[[RuleFunction], RuleFunction]:
        """Register the function of one rule; of several that differ by a word, it takes the rule as an argument."""
        def registered(function: RuleFunction) -> RuleFunction:
            for code in codes:
                if code not in self.rules or code in self.functions:
                    raise KeyError(code)
                self.functions[code] = function
            return function
        return registered

    def chosen(self, excluded: Collection[str]) -> Mapping[str, CheckRule]:
        """The rules without those left out.

        Parameters
        ----------
        excluded : codes; the begin of a code stands for all that begin so.

        Raises
        ------
        InputError : an excluded code is the begin of none.
        """
        unknown = [code for code in excluded if not any(one.startswith(code) for one in self.rules)]
        if unknown:
            raise InputError(say("No rule has a code that begins with {code}; the documentation lists them.",
                                 code=unknown[0]))
        return {code: rule for code, rule in self.rules.items() if not any(map(code.startswith, excluded))}
