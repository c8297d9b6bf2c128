"""How a survey is registered: the settings of its three steps."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..markings.extraction import ExtractionSettings
from .correction.settings import CorrectionSettings
from .records import RegistrationSettings


@dataclass(frozen=True)
class RegistrationRun:
    """How a survey is registered.

    Attributes
    ----------
    windows : of the windows.
    correction : of the adjustment.
    extraction : of markings, where a survey is given.
    """

    windows: RegistrationSettings = field(default_factory=RegistrationSettings)
    correction: CorrectionSettings = field(default_factory=CorrectionSettings)
    extraction: ExtractionSettings = field(default_factory=ExtractionSettings)
