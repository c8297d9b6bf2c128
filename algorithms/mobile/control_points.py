"""Control points as a parameter: CSV or a layer with the columns id,x,y,z,time,x_mms,y_mms,z_mms."""

from __future__ import annotations

from ..framework.layers.layers import VectorTable

HELP = ("CSV or layer with the columns id,x,y,z (where a point truly lies, metres) and time,x_mms,y_mms,z_mms (when "
        "the survey measured it, GPS seconds, and where it lies in the survey). Heights may be missing.")

CRS_HELP = ("Coordinate reference system of the control points, where their layer does not say it (CSV). It is needed "
            "for SBET trajectories.")


def add_control(algorithm, optional: bool = False) -> None:
    """Declare CONTROL and CRS."""
    algorithm.add_table("CONTROL", "Control points", HELP, optional)
    algorithm.add_crs("CRS", "Coordinate reference system", CRS_HELP, optional=True, advanced=True)


def read_control(algorithm, parameters, context, progress):
    """The core's `ControlPoints` of CONTROL, and the WKT of their CRS ("" where none is known)."""
    from ...urbanmap_qgis.mobile.control import control_columns, control_from_columns

    table = algorithm.read_table(parameters, "CONTROL", context, control_columns, progress)
    return control_from_columns(table.columns, table.label), _crs_wkt(algorithm, parameters, context, table)


def read_check_points(algorithm, parameters, name, context, progress):
    """The same of a parameter, without points that the survey was adjusted to, how many of these there are, and the
    table."""
    from ...urbanmap_qgis.mobile.control import check_points_of, control_columns, control_from_columns

    table = algorithm.read_table(parameters, name, context, control_columns, progress)
    control, adjusted = check_points_of(control_from_columns(table.columns, table.label), table.columns, table.label)
    return control, _crs_wkt(algorithm, parameters, context, table, name), adjusted, table


def _crs_wkt(algorithm, parameters, context, table: VectorTable, name: str = "CONTROL") -> str:
    given = algorithm.parameterAsCrs(parameters, "CRS", context)
    if table.crs.isValid():
        if given.isValid():
            algorithm.same_crs(name, table.crs, "CRS", given)
        return table.crs_wkt
    return given.toWkt(given.WKT_PREFERRED) if given.isValid() else ""
