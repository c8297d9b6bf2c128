"""A setting is declared once, with the field that holds it: dialog, checks and documents are made of that.

These modules import the standard library alone, so that algorithms are listed while packages are missing.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import inf
from threading import RLock
from types import MappingProxyType
from typing import TYPE_CHECKING

from ..errors import InputError
from ..wording import known, say


@dataclass(frozen=True)
class Setting:
    """What is said of a setting.

    Attributes
    ----------
    label, help : for the user, in English.
    unit : such as "m2" or "points"; "m" makes it a distance.
    minimum, maximum : of a number, both included.
    choices : the words of which it is one; none of a number, or of yes or no.
    alias : name of the parameter where it is not that of the field in capitals.
    advanced : stands under "Advanced" in the dialog.
    """

    label: str
    help: str
    unit: str
    minimum: float
    maximum: float
    choices: tuple[str, ...]
    alias: str
    advanced: bool

    def check(self, value: object) -> None:
        """Raise `InputError` for a value that is none of the choices, or has the wrong sign.

        The range is what a dialog offers: steps of the work derive settings beyond it, such as twice a cell.
        """
        label = known(self.label)
        if self.choices and value not in self.choices:
            raise InputError(say("{label}: {value} is none of {choices}.", label=label, value=value,
                                 choices=", ".join(self.choices)))
        if isinstance(value, (int, float)) and self.minimum > 0 and not value > 0:
            raise InputError(say("{label} must be greater than 0.", label=label))
        if isinstance(value, (int, float)) and self.minimum == 0 and not value >= 0:
            raise InputError(say("{label} must not be less than 0.", label=label))


def setting(default: object, label: str, help: str, unit: str = "", minimum: float = -inf, maximum: float = inf, *,
            choices: Sequence[str] = (), alias: str = "", advanced: bool = False):
    """A field of a record of settings that a user may give, see `Setting`; None as default makes it optional."""
    said = Setting(label, help, unit, minimum, maximum, tuple(choices), alias, advanced)
    return field(default=default, metadata={"setting": said})


class Settings:
    """Base of records of settings: what no declaration allows is refused when one is made.

    Attributes
    ----------
    declared : what is said of the fields that a user may give, by field, those of its bases first.
    defaults, kinds : default and annotation of each of them.
    """

    declared: Mapping[str, Setting] = MappingProxyType({})
    defaults: Mapping[str, object] = MappingProxyType({})
    kinds: Mapping[str, str] = MappingProxyType({})

    def __init_subclass__(cls) -> None:
        for base in cls.__mro__[-2:0:-1]:
            completed(base)
        own = {name: value for name, value in vars(cls).items()
               if isinstance(value, dataclasses.Field) and "setting" in value.metadata}
        cls.declared = {**cls.declared, **{name: value.metadata["setting"] for name, value in own.items()}}
        cls.defaults = {**cls.defaults, **{name: value.default for name, value in own.items()}}
        cls.kinds = {**cls.kinds, **{name: cls.__annotations__[name] for name in own}}

    def __new__(cls, *_args: object, **_given: object):
        completed(cls)
        return super().__new__(cls)

    def __post_init__(self) -> None:
        for name, said in self.declared.items():
            said.check(getattr(self, name))


def completed(record: type) -> type:
    """A class marked by `record` as the frozen dataclass that it is."""
    if "is_open" in vars(record):
        with _LOCK:
            if "is_open" in vars(record):
                dataclass(frozen=True)(record)
                delattr(record, "is_open")
    return record


_LOCK = RLock()
"""Of the first use of a record, which several threads may make at once."""


if TYPE_CHECKING:
    from dataclasses import dataclass as record
else:
    def record(frozen: bool):
        """A frozen dataclass that is made one when it is first used: all of them at once would take QGIS 25 ms as it
        starts, which lists what they declare."""
        def mark(cls: type) -> type:
            cls.is_open = frozen
            return cls

        return mark
