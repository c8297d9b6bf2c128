"""A small map of where files lie: a box each, in degrees, coloured by kind."""

from __future__ import annotations

import math
from collections.abc import Sequence

from qgis.PyQt.QtCore import QRectF, Qt
from qgis.PyQt.QtGui import QColor, QPainter, QPalette, QPen
from qgis.PyQt.QtWidgets import QToolTip, QWidget

from ..declaring.parameters import tr

COLOURS = {"points": "#2f6f8f", "trajectory": "#d7263d", "outlines": "#8a5a2b", "gsi_outlines": "#8a5a2b",
           "orthophoto": "#4a8f4a", "elevation": "#7f9f5f", "exterior": "#6a4c93", "markings": "#e09a2b",
           "marking_mask": "#e09a2b", "observations": "#009a9a", "city_model": "#5b5b5b"}
_OTHER = "#7b8b95"
_MARGIN = 12.0
_SMALLEST = 6.0  # pixels; smaller boxes are drawn as points of this size


class ExtentMap(QWidget):
    """Draws boxes (label, kind, west, south, east, north); the one that is chosen stands out."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.boxes: list[tuple[str, str, tuple[float, float, float, float]]] = []
        self.chosen = ""
        self.setMinimumHeight(150)
        self.setMouseTracking(True)
        self.setAccessibleName(tr("Map of the files' extents"))

    def show_boxes(self, boxes: Sequence[tuple[str, str, tuple[float, float, float, float]]]) -> None:
        """Draw these, the largest first."""
        self.boxes = sorted(boxes, key=lambda box: -(box[2][2] - box[2][0]) * (box[2][3] - box[2][1]))
        self.update()

    def choose(self, label: str) -> None:
        """Let one stand out."""
        self.chosen = label
        self.update()

    def _scale(self) -> tuple[float, float, float, float]:
        """Pixels a degree of longitude and of latitude, and the middle, longitude and latitude."""
        west, south = (min(box[2][axis] for box in self.boxes) for axis in (0, 1))
        east, north = (max(box[2][axis] for box in self.boxes) for axis in (2, 3))
        narrow = math.cos(math.radians(0.5 * (south + north)))
        wide, high = max((east - west) * narrow, 1e-7), max(north - south, 1e-7)
        scale = min((self.width() - 2 * _MARGIN) / wide, (self.height() - 2 * _MARGIN) / high)
        return scale * narrow, scale, 0.5 * (west + east), 0.5 * (south + north)

    def placed(self) -> list[tuple[str, str, QRectF]]:
        """Boxes on the widget."""
        if not self.boxes:
            return []
        across, along, longitude, latitude = self._scale()
        found = []
        for label, kind, (west, south, east, north) in self.boxes:
            box = QRectF(0.5 * self.width() + (west - longitude) * across,
                         0.5 * self.height() - (north - latitude) * along,
                         (east - west) * across, (north - south) * along)
            missing = max(_SMALLEST - box.width(), 0.0), max(_SMALLEST - box.height(), 0.0)
            found.append((label, kind, box.adjusted(-0.5 * missing[0], -0.5 * missing[1], 0.5 * missing[0],
                                                    0.5 * missing[1])))
        return found

    def paintEvent(self, _event):
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), self.palette().color(QPalette.ColorRole.Base))
        boxes = self.placed()
        if not boxes:
            painter.setPen(self.palette().color(QPalette.ColorRole.Mid))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, tr("No file with a place yet"))
        for label, kind, box in sorted(boxes, key=lambda item: item[0] == self.chosen):
            colour, stands_out = QColor(COLOURS.get(kind, _OTHER)), label == self.chosen
            painter.setPen(QPen(colour, 3.0 if stands_out else 1.2))
            colour.setAlpha(90 if stands_out else 0)
            painter.setBrush(colour)
            painter.drawRect(box)
        if boxes:
            self._draw_bar(painter)
        painter.end()

    def _draw_bar(self, painter: QPainter) -> None:
        """A scale bar of a round length."""
        metres = 111_320.0 / self._scale()[1]  # a pixel
        length = 10.0 ** math.floor(math.log10(max(0.35 * self.width() * metres, 1e-3)))
        label = f"{length / 1000:g} km" if length >= 1000 else f"{length:g} m"
        y = self.height() - 8.0
        painter.setPen(QPen(self.palette().color(QPalette.ColorRole.Text), 1.5))
        painter.drawLine(QRectF(8.0, y, length / metres, 0.0).bottomLeft(),
                         QRectF(8.0, y, length / metres, 0.0).bottomRight())
        painter.drawText(QRectF(8.0, y - 18.0, 120.0, 16.0), Qt.AlignmentFlag.AlignLeft, label)

    def mouseMoveEvent(self, event):
        place = event.position() if hasattr(event, "position") else event.localPos()
        under = [label for label, _, box in self.placed() if box.contains(place)]
        told = under[:8] + (["…"] if len(under) > 8 else [])
        spot = event.globalPosition().toPoint() if hasattr(event, "globalPosition") else event.globalPos()
        QToolTip.showText(spot, "\n".join(told), self)
