"""Which algorithms can be run over tiles, and how."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Cut:
    """How an algorithm is run over tiles.

    Attributes
    ----------
    owner : the layer whose features say whose a result is: a result is of the tile that its feature's middle lies in.
        Empty where results go by their place.
    extent : the raster that says where tiles are, where neither points nor `owner` do.
    joined : layers of polygons that may be longer than any buffer: cut at the tiles' edges and joined across them.
    along : the trajectory by which the survey is cut into stretches of its drive instead of areas.
    needed : parameters that must be given, because each tile would choose for itself.
    things : what the features of the main result are, "" where their status says nothing of success.
    good, missing : statuses of those that are as they should be, and of those that could not be made.
    """

    owner: str = ""
    extent: str = ""
    joined: tuple[str, ...] = ()
    needed: tuple[str, ...] = ()
    along: str = ""
    things: str = ""
    good: tuple[str, ...] = ("ok",)
    missing: tuple[str, ...] = ("not modelled",)


CUTTABLE = {
    "buildingsfromals": Cut("FOOTPRINTS", things="buildings"),
    "surfacefromals": Cut(),
    "roadmarkingsfromorthophoto": Cut(extent="INPUT", joined=("OUTPUT_POLYGONS",)),
    "groundfrommms": Cut(),
    "mesh25d": Cut("FOOTPRINTS", things="buildings"),
    "wallsfrommms": Cut("BUILDINGS", things="walls"),
    "orthorectifyframes": Cut(extent="GROUND", needed=("RESOLUTION",)),
    "aerialmarkings": Cut(joined=("OUTPUT_POLYGONS",), needed=("RESOLUTION",)),
    "roadmarkingsfrommms": Cut(along="TRAJECTORY"),
    "mergebuildingmodels": Cut("MODELS", things="buildings", good=("merged",), missing=("not merged",)),
}
"""Algorithms that can be run over tiles. New ones come last: the command line takes their numbers too."""

WHOLE = {
    "occlusionmap": "it works on one frame at a time",
    "filtervehicles": "its orthophotos are of the same ground; cut them, or run “Orthorectify frames” over tiles",
    "registermms": "the correction of a trajectory is one curve along the whole drive; its memory is bounded, and "
                   "WORKERS or SCHEDULER share its windows",
    "georeferencemms": "the correction of a trajectory is one curve along the whole drive; its memory is bounded, and "
                       "WORKERS or SCHEDULER share its windows",
    "adjustsurveys": "all drives are adjusted together",
    "calibratescanner": "one calibration is found of the whole survey",
    "applytrajectory": "it reads each point once, whatever the size of the survey",
    "facadetextures": "its result is one textured model; WORKERS or SCHEDULER share its facades",
    "markinglines": "lines run on through tiles; run road markings over tiles and give it their merged polygons",
    "vectormap": "lanes run on through tiles; it works on lines and needs little memory",
    "adjustwalls": "all observations of a drive are adjusted together",
    "buildingmodels": "it is a part of “Buildings from ALS”, which can be run over tiles",
    "roofpolygons": "it is a part of “Buildings from ALS”, which can be run over tiles",
    "segmentroofs": "it is a part of “Buildings from ALS”, which can be run over tiles",
    "buildingoutlines": "it works on one tile of the cloud after another by itself; WORKERS or SCHEDULER share them",
    "updatebuildings": "it works on one tile of the cloud after another by itself; WORKERS or SCHEDULER share them",
    "segmentbuildings": "it is a part of “Buildings from ALS”, which can be run over tiles",
}
"""Why others cannot: to be said to whoever asks for them."""
