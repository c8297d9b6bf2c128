"""Which algorithms can be run over tiles."""

from __future__ import annotations

CUTTABLE = {"buildingsfromals": "FOOTPRINTS", "surfacefromals": "", "roadmarkingsfromorthophoto": "",
            "groundfrommms": "", "mesh25d": "FOOTPRINTS", "wallsfrommms": "BUILDINGS"}
"""Algorithms that can be run over tiles, and the layer whose features say whose a result is; by place where none."""
