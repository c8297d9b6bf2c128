"""What the GNSS algorithms take: buildings with heights, trajectories, observation and navigation files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from qgis.core import QgsProcessingContext

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.progress import Progress
from ...urbanmap_qgis.settings.gnss import SignalSettings, TraceSettings
from ..framework.declaring.parameters import tr
from ..framework.layers.building_layers import read_buildings
from ..framework.layers.outlines import numbers
from ..framework.layers.trajectories import TrajectoryParameters

TOP_FIELDS, BASE_FIELDS = ("z_top", "top"), ("z_base", "base", "z_low")
BUILDING_FIELDS = ("building_id", "building", "building_i")  # the last as a shapefile cuts it


@dataclass(frozen=True)
class BuildingInput:
    """Buildings as they were read: the layer, which building a feature is part of (n,), heights (n,) or None, and the
    names of the buildings by row."""

    table: object
    building: object
    top: object
    base: object
    names: object


class GnssInputs(TrajectoryParameters):
    """Methods with which an algorithm declares and reads the inputs of the GNSS part."""

    def add_gnss_inputs(self) -> None:
        """BUILDINGS, TRAJECTORY, OBSERVATIONS, NAVIGATION and what goes with them."""
        self.add_gnss_buildings()
        self.add_files("TRAJECTORY", "Trajectories", "Where the receiver was, in the CRS of the buildings: one or "
                       "several files (CSV time,x,y,z,roll,pitch,heading, SBET, or point layers).")
        self.add_files("OBSERVATIONS", "Observations", "RINEX 2.11, 3.x or 4.x observation files, plain or compact "
                       "(Hatanaka), as they are or packed by gzip or bzip2; each file is a pass.")
        self.add_files("NAVIGATION", "Navigation", "RINEX navigation files or SP3 orbits of the same days.")
        self.add_number("GEOID_SEPARATION", "Geoid separation", "Ellipsoidal height minus the trajectory's height; 0 "
                        "where the trajectory has ellipsoidal heights. Left empty, it is estimated from the "
                        "satellites.",
                        None, -120.0, 120.0, unit="m", optional=True)
        self.add_settings(SignalSettings, "elevation_mask")
        self.add_antenna()
        self.add_settings(TraceSettings)
        self.add_text("SYSTEMS", "Satellite systems", "Letters of those that are used: G GPS, R GLONASS, E Galileo, C "
                      "BeiDou, J QZSS.", "GRECJ", advanced=True)
        self.add_settings(SignalSettings)

    def add_gnss_buildings(self) -> None:
        """BUILDINGS."""
        self.add_polygons("BUILDINGS", "Buildings", "Building models (MultiPolygonZ, such as those of “Building "
                          "models”) or outlines with heights, in a projected CRS in metres.")

    def add_antenna(self) -> None:
        """LEVER_ARM, and the fields of BUILDINGS that tell which building a feature is part of, and heights."""
        self.add_text("LEVER_ARM", "Lever arm of the antenna", "Antenna in the vehicle's body: forward, right, down, "
                      "in metres from the trajectory's origin.", "0, 0, 0", advanced=True)
        self.add_field("BUILDING_FIELD", "Field with the building", "Features with the same value are one building. "
                       "Left empty, building_id or building is taken where it exists.", "BUILDINGS", advanced=True)
        self.add_field("TOP_FIELD", "Field with the height of the top", "Height of the top of the walls, m, in the "
                       "trajectory's heights. Needed for outlines without heights; z_top is found by itself.",
                       "BUILDINGS", advanced=True)
        self.add_field("BASE_FIELD", "Field with the height of the foot", "Height of the foot of the walls, m; without "
                       "it the walls of outlines reach down without end. z_base is found by itself.", "BUILDINGS",
                       advanced=True)

    def check(self, parameters: Mapping, context: QgsProcessingContext) -> None:
        """Refuse a lever arm that is none."""
        self._lever_arm(parameters, context)

    def read_gnss_buildings(self, parameters: Mapping, context: QgsProcessingContext,
                            progress: Progress) -> BuildingInput:
        """The buildings with their heights."""
        import numpy as np

        table = read_buildings(self, parameters, "BUILDINGS", context, progress)
        name = self._field(parameters, "BUILDING_FIELD", context, table, BUILDING_FIELDS)
        keys = table.columns[name] if name else list(range(1, len(table) + 1))
        keys = [f"?{row}" if key is None else str(key) for row, key in enumerate(keys)]
        first = {key: number for number, key in enumerate(dict.fromkeys(keys))}
        building = np.array([first[key] for key in keys])
        heights = []
        for parameter, known in (("TOP_FIELD", TOP_FIELDS), ("BASE_FIELD", BASE_FIELDS)):
            field = self._field(parameters, parameter, context, table, known)
            heights.append(numbers(table, field) if field else None)
        return BuildingInput(table, building, *heights, np.array(list(first), object))

    def read_signals(self, parameters: Mapping, context: QgsProcessingContext, buildings: BuildingInput,
                     progress: Progress):
        """The core's `Signals` of all observation files."""
        from ...urbanmap_qgis.gnss.signals.passes import load_passes

        wkt = buildings.table.crs_wkt
        read = self.read_trajectories(parameters, context, wkt, progress, "BUILDINGS")
        names = [Path(text).name for text in self.files_of(parameters, "TRAJECTORY", context)]
        separation = (None if parameters.get("GEOID_SEPARATION") is None
                      else self.parameterAsDouble(parameters, "GEOID_SEPARATION", context))
        settings = self.settings(SignalSettings, parameters, context, lever_arm=self._lever_arm(parameters, context),
                                 systems=self.parameterAsString(parameters, "SYSTEMS", context).upper())
        signals = load_passes(self.files_of(parameters, "OBSERVATIONS", context),
                              self.files_of(parameters, "NAVIGATION", context), [item.trajectory for item in read],
                              names, wkt, separation, settings, progress)
        for reason, count in signals.left_out.items():
            progress.message(tr("{0} observations left out: {1}").format(count, reason))
        return signals

    def _field(self, parameters: Mapping, name: str, context: QgsProcessingContext, table, known) -> str:
        """The field chosen, or the first known one that the layer has; empty if neither."""
        chosen = self.parameterAsString(parameters, name, context)
        if chosen and chosen not in table.columns:
            raise InputError(tr("{0}: the layer has no field {1}.").format(self.label_of(name), chosen))
        return chosen or next((field for field in known if field in table.columns), "")

    def _lever_arm(self, parameters: Mapping, context: QgsProcessingContext) -> tuple[float, float, float]:
        text = self.parameterAsString(parameters, "LEVER_ARM", context)
        try:
            forward, right, down = (float(part) for part in text.replace(";", ",").split(","))
        except ValueError:
            raise InputError(tr("{0}: give three numbers, such as 0.5, 0, -1.8.").format(
                self.label_of("LEVER_ARM"))) from None
        return forward, right, down
