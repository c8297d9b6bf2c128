"""Rules on a file as a whole: its XML, its name, its reference system."""

from __future__ import annotations

from collections.abc import Iterator

from ...io.files.rule_table import CheckRule
from .checked_file import CheckedFile
from .city_rule_table import Violation, city_rule, violation

SYSTEM = "http://www.opengis.net/def/crs/EPSG/0/6697"
"""The reference system of all city models of the specification (4.1, B.2): JGD2011, heights of Tokyo Bay."""

LARGEST_FILE = 2**30
"""Bytes that a file may have (specification, 7.2.1.2)."""


@city_rule("L01")
def _not_well_formed(file: CheckedFile, rule: CheckRule) -> Iterator[Violation]:
    if file.broken:
        yield violation(None, why=file.broken)


@city_rule("L02.root")
def _no_city_model(file: CheckedFile, rule: CheckRule) -> Iterator[Violation]:
    if file.root_name not in ("", "CityModel"):
        yield violation(None, root=file.root_name)


@city_rule("L05")
def _other_system(file: CheckedFile, rule: CheckRule) -> Iterator[Violation]:
    if file.root_name == "CityModel" and file.system != SYSTEM:
        yield violation(None, system=file.system or "-")


@city_rule("D-7.2.1.2")
def _too_large(file: CheckedFile, rule: CheckRule) -> Iterator[Violation]:
    if file.source.size > LARGEST_FILE:
        yield violation(None, size=f"{file.source.size / 2**30:.2f}")


@city_rule("D-7.2.3")
def _name_of_another_form(file: CheckedFile, rule: CheckRule) -> Iterator[Violation]:
    if file.delivery and (file.parts is None or file.parts[2] != "6697" or file.parts[1] != file.folder):
        yield violation(None, name=file.name)
