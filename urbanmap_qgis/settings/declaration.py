"""A setting is declared once, with the field that holds it: dialog, checks and documents are made of that.

These modules import the standard library alone, so that algorithms are listed while packages are missing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from math import inf

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


def declared(record: type) -> dict[str, Setting]:
    """What is said of the fields of a record that a user may give, by field."""
    return {item.name: item.metadata["setting"] for item in fields(record) if "setting" in item.metadata}


class Settings:
    """Base of records of settings: what no declaration allows is refused when one is made."""

    def __post_init__(self) -> None:
        for name, said in declared(type(self)).items():
            said.check(getattr(self, name))
