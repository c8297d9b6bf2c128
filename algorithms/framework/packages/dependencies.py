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
    """What is missing of `import_names` and how to install it, or an empty text when all is there."""
    missing = find_missing(import_names)
    return missing_message(missing, profile_packages()) if missing else ""
