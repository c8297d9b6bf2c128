"""The results of a network of drives as columns of layers."""

from __future__ import annotations

import numpy as np

from .network import KINDS, plan_residuals
from .records import STATUS_NAMES, AdjustedSurvey


def tie_columns(survey: AdjustedSurvey) -> tuple[dict[str, object], np.ndarray]:
    """One row an observation: kind, drives, residual (m), standard deviation in plan (m), weight; places (n, 3)."""
    seen, network = survey.observations, survey.network
    names = [drive.name for drive in survey.drives]
    residual = network.residual
    return {
        "kind": [KINDS[kind] for kind in seen.kind], "drive": [names[k] for k in seen.drive],
        "other": [names[k] if k >= 0 else None for k in seen.other],
        "time": [float(np.interp(parameter, survey.drives[k].chainage, survey.drives[k].time))
                 for k, parameter in zip(seen.drive, seen.parameter)],
        "chainage": seen.parameter, "east": residual[:, 0], "north": residual[:, 1], "up": residual[:, 2],
        "plan": plan_residuals(seen, residual),
        "sigma": np.sqrt(np.linalg.eigvalsh(seen.covariance[:, :2, :2])[:, -1]), "weight": network.weight,
    }, survey.place


def node_columns(survey: AdjustedSurvey) -> tuple[dict[str, object], np.ndarray]:
    """One row a node of all drives: correction (m, degrees), standard deviations, status; places (n, 3)."""
    drives = survey.drives
    value = np.concatenate([drive.correction for drive in drives])
    columns: dict[str, object] = {
        "drive": [drive.name for drive in drives for _ in drive.time],
        "status": [STATUS_NAMES[number] for drive in drives for number in drive.status],
        "time": np.concatenate([drive.time for drive in drives]),
        "chainage": np.concatenate([drive.chainage for drive in drives]),
        **{name: value[:, k] for k, name in enumerate(("east", "north", "up", "heading"))},
        "sigma": np.concatenate([drive.plan_sigma() for drive in drives]),
        "sigma_up": np.concatenate([np.sqrt(drive.covariance[:, 2, 2]) for drive in drives])}
    return columns, np.concatenate([drive.place for drive in drives])
