"""What the steps of a chain say: without their inner results, whose files lie in scratch places."""

from __future__ import annotations

from qgis.core import QgsProcessingMultiStepFeedback
from qgis.PyQt.QtCore import QCoreApplication

from ....urbanmap_qgis.io.files.staging import final_text


class StepsMultiStepFeedback(QgsProcessingMultiStepFeedback):
    """Passes on what steps say, but for the list of results that QGIS adds to each step.

    Its name ends like that of QGIS's, by which runs within runs are known.
    """

    def pushInfo(self, info):
        if not info.startswith(QCoreApplication.translate("Processing", "Results: {}").partition("{")[0] + "{"):
            super().pushInfo(final_text(info))
