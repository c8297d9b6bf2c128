"""A process for tiles: a QGIS without a window, started before libraries of others are imported."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Sequence

from qgis.core import QgsApplication

from ....urbanmap_qgis.execution import start_worker
from ..language.language import speak_language
from ..running.cluster import cluster_of_process
from ..running.native_libraries import PACKAGES_WITH_LIBRARIES, import_apart


def start_application(prefix: str, plugins: str, packages: str, package: str, address: str = "",
                      folders: Sequence[str] = ()) -> None:
    """Called in a worker process when it starts: a QGIS without a window, with Processing and this provider.

    prefix : QGIS's prefix path. plugins : its folder of Python plugins. packages : see `start_worker`.
    package : name under which this plugin is imported. address, folders : see `cluster.scheduler`.
    """
    start_worker(packages)
    import_apart(PACKAGES_WITH_LIBRARIES)
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    # A tile is on the disk when it is published: GDAL need not wait for the disk at every step before.
    os.environ.setdefault("OGR_SQLITE_SYNCHRONOUS", "OFF")
    application = QgsApplication([], False)
    application.setPrefixPath(prefix, True)
    application.initQgis()
    start_application.running = application  # QGIS ends with the object
    start_application.translator = speak_language()
    if plugins not in sys.path:
        sys.path.append(plugins)
    from processing.core.Processing import Processing

    Processing.initialize()
    cluster_of_process(address, folders)
    provider = importlib.import_module(f"{package}.algorithms.provider").UrbanMapProvider()
    provider.register()
    start_application.provider = provider
