"""The tables of a mobile survey, column by column: trajectory, control points, image poses, tie points."""

from __future__ import annotations

from ..io.files.columns import EAST, HEADING, IMAGE_NAMES, NORTH, PITCH, ROLL, TIME, UP, Column

TRAJECTORY = (TIME, EAST, NORTH, UP, ROLL, PITCH, HEADING)

CONTROL = (
    Column("id", "", ("name", "point", "点名", "点番号", "測点名", "名称", "番号"), needed=False),
    EAST, NORTH, UP.optional(), TIME,
    Column("x_mms", "m", ("計測東", "eastmms")), Column("y_mms", "m", ("計測北", "northmms")),
    Column("z_mms", "m", ("計測標高", "計測高さ", "heightmms"), needed=False))

IMAGE_POSES = (
    Column("id", "", ("name", "image", "event", "eventname", "station", "stationname", "feature", *IMAGE_NAMES)),
    *TRAJECTORY)

TIE_POINTS = (
    Column("set", "", ("group", "pair", "組", "組番号", "番号", "セット")), TIME,
    Column("x_mms", "m", ("計測東", "eastmms")), Column("y_mms", "m", ("計測北", "northmms")),
    Column("x_ref", "m", ("基準東", "参照東", "eastref", "eastreference")),
    Column("y_ref", "m", ("基準北", "参照北", "northref", "northreference")))
