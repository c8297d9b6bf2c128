"""Missing Python packages, as the algorithms and the plugin speak of them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from qgis.core import QgsApplication

from ....urbanmap_qgis.dependencies import activate, find_missing, missing_message, packages_folder


def profile_packages() -> Path:
    """Folder of the current QGIS profile that holds UrbanMap's packages."""
    return packages_folder(QgsApplication.qgisSettingsDirPath())


def activate_profile_packages() -> None:
    """Let Python find the packages that the plugin installed into the QGIS profile."""
    activate(profile_packages())


def refusal(import_names: Iterable[str]) -> str:
    """What is missing and how to install it; an empty text when all of `import_names` is there.

    Where one is missing, all that UrbanMap lacks is named, so that one command installs it for every algorithm.
    """
    needed = find_missing(import_names)
    if not needed:
        return ""
    more = [item for item in find_missing() if item not in needed]
    return missing_message([*needed, *more], profile_packages())
