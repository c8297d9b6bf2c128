"""Observations by a reference that steps where no drive does are left out, and the steps are told."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...errors import InsufficientDataError
from ...progress import Progress
from ...wording import say
from ..trajectory import path_chainage
from .network import NetworkObservations
from .records import AdjustmentRun
from .reference_steps import ReferenceStep, reference_steps, undisputed
from .ties import Drive


def without_reference_steps(drives: Sequence[Drive], observations: NetworkObservations, run: AdjustmentRun,
                            progress: Progress) -> tuple[NetworkObservations, tuple[ReferenceStep, ...]]:
    """The observations without those by a reference that steps where no drive does, and these steps.

    Raises
    ------
    InsufficientDataError : no other observation is left.
    """
    chainage, other_chainage = np.zeros((2, len(observations)))
    for number, drive in enumerate(drives):
        parameter, way = run.path_parameters(drive.trajectory), path_chainage(drive.trajectory)
        for of, at, found in ((observations.drive, observations.parameter, chainage),
                              (observations.other, observations.other_parameter, other_chainage)):
            found[of == number] = np.interp(at[of == number], parameter, way)
    steps = tuple(reference_steps(observations, chainage, other_chainage))
    for step in steps:
        progress.warn(step.sentence(drives[step.drive].name))
    left = observations.select(undisputed(observations, chainage, steps))
    if len(observations) and not len(left):
        raise InsufficientDataError(say("The reference steps where the drives do not, and nothing else ties them: "
                                        "nothing can be adjusted."))
    return left, steps
