"""The layer of shifts between overlapping frames, which several algorithms write."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr


class FrameShiftsOutput:
    """For algorithms that compare overlapping frames: declares and writes OUTPUT_SHIFTS."""

    def add_shifts_output(self):
        """Declare the layer and the number of the largest shift."""
        self.add_layer_output(
            "OUTPUT_SHIFTS", "Shifts between images", "Points on road markings that two overlapping images show, with "
            "the shift of the second against the first in metres (east, north; sigma of one place), and the median of "
            "the pair with its sigma. Pairs that lie more than half a pixel apart have the status “apart”; “height” "
            "where only the height of what stands there may displace them, as no surface (DSM) tells; “not alike” "
            "where they show different things, as a wrong orientation makes them.", optional=True)
        self.add_number_output("LARGEST_SHIFT", "Maximum shift", "Largest distance between the same road markings in "
                               "two overlapping images that no height of what they show explains, median over their "
                               "places; no value where none are seen.", "m")

    def write_shifts(self, parameters, context, shifts, pixel, crs, progress) -> dict:
        """Write the layer where it is wanted; the results to hand out."""
        alike = [shift.unexplained[0] for shift in shifts if shift.alike]
        results = {"LARGEST_SHIFT": max(alike)} if alike else {}
        if parameters.get("OUTPUT_SHIFTS"):
            import shapely

            from ...urbanmap_qgis.aerial.orthophotos.frame_shifts import shift_columns

            columns = shift_columns(shifts, pixel)
            points = shapely.points(columns.pop("x"), columns.pop("y"))
            results |= self.write_layer(
                parameters, "OUTPUT_SHIFTS", context, None, columns, crs, points, "Point",
                style="frame_shifts", progress=progress)
        return results


def read_pairs(algorithm, parameters, context):
    """Shifts by pairs of frames, from the points' layer; None where none was given."""
    from ...urbanmap_qgis.aerial.markings.marking_report import PairShift

    table = algorithm.read_vector(parameters, "SHIFTS", context)
    if table is None:
        return None
    names = ("first", "second", "pair_east", "pair_north", "pair_sigma", "patches", "status")
    missing = [name for name in names if name not in table.columns]
    if missing:
        raise InputError(tr("{0} has no field {1}; give the points of “Orthorectify frames”.").format(
            table.label, missing[0]))
    rows = dict.fromkeys(zip(*(table.columns[name] for name in names)))
    return [PairShift(*(float("nan") if value is None else value for value in row)) for row in rows]
