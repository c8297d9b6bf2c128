"""Several drives as parameters: their trajectories, each with the points measured along it."""

from __future__ import annotations

from qgis.core import QgsProcessing, QgsProcessingParameterMultipleLayers

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr
from ..framework.layers.trajectories import TrajectoryParameters, tell_of, trajectory_exists, trajectory_of


class DriveInputs(TrajectoryParameters):
    """Methods with which an algorithm declares and reads the trajectories of several drives."""

    def add_trajectories(self, help: str = "", optional: bool = False) -> None:
        """Declare TRAJECTORY and how all of them are read."""
        self.declare_parameter(QgsProcessingParameterMultipleLayers(
            "TRAJECTORY", tr("Trajectories"), QgsProcessing.SourceType.TypeFile, None, optional),
            help or "The trajectory of each drive, with which its points were placed: CSV "
            "time,x,y,z,roll,pitch,heading, SBET, or point layers.")
        self.add_trajectory_reading()

    def trajectory_texts(self, parameters, context) -> list[str]:
        """What TRAJECTORY names, each once.

        Raises
        ------
        InputError : nothing was given, or a file or layer does not exist.
        """
        label = self.label_of("TRAJECTORY")
        texts = list(dict.fromkeys(t for t in self.parameterAsFileList(parameters, "TRAJECTORY", context) if t))
        if not texts:
            raise InputError(tr("{0}: no file was given.").format(label))
        for text in texts:
            if not trajectory_exists(text, context):
                raise InputError(tr("{0}: {1} does not exist; check its name.").format(label, text))
        return texts

    def read_trajectories(self, parameters, context, crs, progress) -> list:
        """The core's `TrajectoryFile` of each one that was given."""
        reading = self.trajectory_reading(parameters, context)
        read = [trajectory_of(text, self.label_of("TRAJECTORY"), context, crs, reading)
                for text in self.trajectory_texts(parameters, context)]
        for item in read:
            tell_of(item, progress)
        return read
