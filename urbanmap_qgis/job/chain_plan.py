"""From a wish and the files at hand to the steps of the chain, and what is missing for it and where to get it."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping
from dataclasses import dataclass, field

from ..wording import known, mark, say
from . import roles
from .roles import Parts

REFERENCE, SURVEY, BUILDINGS, WALLS = "reference", "survey", "buildings", "walls"
LANES, ACCURACY, ROADS, OBJECTS = "lanemap", "accuracymap", "roadmodel", "streetobjects"
MEASURED_ROADS, ROAD_SPACE = "measuredroads", "roadspace"

WISHES = {
    REFERENCE: mark("Aerial reference: road markings and ground"), SURVEY: mark("Mobile survey laid on the reference"),
    BUILDINGS: mark("Building models"), WALLS: mark("Building models with measured walls"),
    LANES: mark("Lane map"), ACCURACY: mark("Map of the accuracy of localisation"),
    ROADS: mark("Road model"), OBJECTS: mark("Street objects: poles, signals, signs, trees"),
    MEASURED_ROADS: mark("Road model of edges that the survey measured, step by step"),
    ROAD_SPACE: mark("Road space in one run: measured road model and street objects"),
}
"""What can be wished for, with its English name."""

_NEEDS = {ROADS: "roadmodel", MEASURED_ROADS: "roadmodel", OBJECTS: "streetobjects", ROAD_SPACE: "roadspace"}
"""Algorithm without which a wish cannot be had."""

_MISSING = {
    roles.ALS: mark("Airborne laser points (LAS, LAZ) are missing: the surveying authority of the area has them; in "
                    "Japan those of GSI and of the prefectures are at the G-Spatial Information Centre."),
    roles.FOOTPRINTS: mark("Building outlines are missing: in Japan download “outlines of buildings” (BldA) of GSI's "
                           "Fundamental Geospatial Data; elsewhere take those of the cadastre or of OpenStreetMap."),
    roles.FRAMES: mark("Aerial frames with camera and exterior orientation, or an orthophoto, are missing: ask who "
                       "flew them for the frames as the camera took them (TIFF or JPEG)."),
    roles.CAMERA_ROLE: mark("The camera file (JSON) of the frames is missing: write it from the camera's calibration "
                            "certificate; the page on file formats has an example."),
    roles.EXTERIOR_ROLE: mark("The exterior orientation of the frames is missing: export it from the aerial "
                              "triangulation as a table with image, x, y, z, omega, phi, kappa."),
    "survey": mark("A mobile survey with its trajectory is missing: export the points with GPS times (LAS, LAZ) and "
                   "the trajectory of the same drive from the navigation software."),
    "calibration": mark("The calibration of the scanners (JSON) is missing: write it from the certificate of the "
                        "vehicle; without it intensities are not made even over ranges."),
    roles.NAVIGATION_ROLE: mark("No GNSS navigation file: accuracy is predicted from walls and markings alone; data "
                                "centres of the IGS and GSI's GEONET have them by day."),
    roles.ROADS_ROLE: mark("Edges or surfaces of roads are missing: give lines along both edges (in Japan RdEdg of "
                           "GSI's Fundamental Geospatial Data, opened in QGIS and saved in a projected system), or "
                           "the surfaces of an older road model."),
}

_FINEST = "3.3"
"""Level of detail of measured roads: what was not seen is left out and told at every level."""

_POINTS_CRS = mark("CRS of the point clouds")
_SURVEY_SIGMA = mark("Standard deviation of the survey")

_REFERENCES = (roles.MASK, roles.MARKING_POLYGONS, roles.ORTHOPHOTO_ROLE, roles.FRAMES, roles.CAMERA_ROLE,
               roles.EXTERIOR_ROLE)
"""Parts of which each tells that there is, or is meant to be, something to lay a survey on."""

Value = object
"""A parameter: a plain value, {"input": role}, {"step": id, "output": name}, `WANTED`, or a list of these."""

WANTED = {"wanted": True}
"""Of a result that an algorithm makes only when it is asked for: to be made, at its place among the results."""


@dataclass(frozen=True)
class PlannedStep:
    """One step: its name in the job, the algorithm's id without provider, and its parameters (see `Value`)."""

    id: str
    algorithm: str
    parameters: dict[str, Value]


@dataclass
class ChainPlan:
    """Steps in order, sentences on what is missing (the chain cannot run) and notes on what is not needed but helps."""

    steps: list[PlannedStep] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def wishes(available: Container[str]) -> list[str]:
    """What can be wished for with the algorithms that are there."""
    return [wish for wish in WISHES if _NEEDS.get(wish) is None or _NEEDS[wish] in available]


def wish_name(wish: str) -> str:
    """Name of a wish in the user's language."""
    return known(WISHES[wish])


def roles_taken(steps: Iterable[PlannedStep]) -> set[str]:
    """Roles of the inputs that steps take."""
    def of(value: object) -> set[str]:
        if isinstance(value, (list, tuple)):
            return set().union(*map(of, value))
        return {str(value["input"])} if isinstance(value, Mapping) and "input" in value else set()

    return set().union(*(of(value) for step in steps for value in step.parameters.values()))


def plan_chain(wish: str, parts: Parts, crs: str = "") -> ChainPlan:
    """The chain for a wish with the parts at hand; steps stand in it also where something is missing for them.

    Parameters
    ----------
    crs : the system of the results where files are in degrees (a code or WKT); "" leaves it to the algorithm.
    """
    work = _Planning(parts, crs)
    _WORK[wish](work)
    work.plan.missing = list(dict.fromkeys(work.plan.missing))
    return work.plan


def _given(role: str) -> Value:
    return {"input": role}


def _result(step: str, output: str = "OUTPUT") -> Value:
    return {"step": step, "output": output}


class _Planning:
    """The plan as it grows; each method gives the parameter that its result is, None where it cannot be had."""

    def __init__(self, parts: Parts, crs: str):
        self.parts, self.crs, self.plan = parts, crs, ChainPlan()
        self.made: dict[str, dict[str, Value]] = {}

    def has(self, role: str) -> bool:
        return role in self.parts.inputs

    def lacks(self, role: str) -> None:
        self.plan.missing.append(known(_MISSING[role]))

    def add(self, identifier: str, algorithm: str, **parameters: Value) -> None:
        set_values = {name: value for name, value in parameters.items() if value not in (None, [])}
        self.plan.steps.append(PlannedStep(identifier, algorithm, set_values))

    def footprints(self, needed: bool) -> Value | None:
        if self.has(roles.FOOTPRINTS):
            self.require_plane(roles.FOOTPRINTS)
            return _given(roles.FOOTPRINTS)
        if self.has(roles.GSI_FOOTPRINTS):
            if "outlines" not in self.made:
                self.add("outlines", "loadgsi", INPUT=_given(roles.GSI_FOOTPRINTS), CRS=self.crs or None,
                         OUTPUT_BUILDINGS=WANTED, OUTPUT_GROUND="")
                self.made["outlines"] = {"OUTPUT": _result("outlines", "OUTPUT_BUILDINGS")}
            return self.made["outlines"]["OUTPUT"]
        if needed:
            self.lacks(roles.FOOTPRINTS)
        return None

    def reference(self) -> dict[str, Value]:
        """Mask, polygons and ground of the road markings: given, or made from frames or an orthophoto."""
        if "reference" not in self.made:
            self.made["reference"] = self._given_reference() or self._made_reference()
        return self.made["reference"]

    def _given_reference(self) -> dict[str, Value]:
        polygons = _given(roles.MARKING_POLYGONS) if self.has(roles.MARKING_POLYGONS) else None
        if polygons is not None:
            self.require_plane(roles.MARKING_POLYGONS)
        mask = _given(roles.MASK) if self.has(roles.MASK) else polygons
        if mask is None:
            return {}
        self.plan.notes.append(say("The markings given are the reference; leave them out to make it from the images."))
        return {"mask": mask, "polygons": polygons, "ground": self._ground(), "image": None}

    def _ground(self) -> Value | None:
        """Heights of the ground: given, of the airborne points, or of the official elevation model."""
        if self.has(roles.GROUND):
            return _given(roles.GROUND)
        if self.has(roles.ALS):
            self.add("surface", "surfacefromals", POINTS=self.als(), POINTS_CRS=self.crs_for(roles.ALS))
            return _result("surface", "OUTPUT_GROUND")
        if self.has(roles.GSI_GROUND):
            self.add("elevation", "loadgsi", INPUT=_given(roles.GSI_GROUND), CRS=self.crs or None,
                     OUTPUT_BUILDINGS="", OUTPUT_GROUND=WANTED)
            return _result("elevation", "OUTPUT_GROUND")
        return None

    def als(self) -> Value:
        """The airborne points, shifted to control points where such are given."""
        if not self.has(roles.ALS) or not self.has(roles.CLOUD_CONTROL_ROLE):
            return _given(roles.ALS)
        if "als" not in self.made:
            self.add("adjusted_als", "adjustals", POINTS=_given(roles.ALS), CONTROL=_given(roles.CLOUD_CONTROL_ROLE),
                     POINTS_CRS=self.crs_for(roles.ALS), OUTPUT_REPORT=WANTED)
            self.made["als"] = {"OUTPUT": _result("adjusted_als")}
            self.plan.notes.append(say("The airborne points are shifted to the control points given for them; leave "
                                       "these out to take the points as they are."))
        return self.made["als"]["OUTPUT"]

    def exterior(self) -> Value:
        """The exterior orientation, corrected by points measured in the frames where such are given."""
        if not self.has(roles.FRAME_CONTROL_ROLE):
            return _given(roles.EXTERIOR_ROLE)
        self.add("adjusted_frames", "adjustframes", CAMERA=_given(roles.CAMERA_ROLE),
                 EXTERIOR=_given(roles.EXTERIOR_ROLE), CONTROL=_given(roles.FRAME_CONTROL_ROLE), CRS=self.crs or None,
                 OUTPUT_REPORT=WANTED)
        self.plan.notes.append(say("The frames are corrected by the points measured in them; leave these out to take "
                                   "the orientation as it is."))
        return _result("adjusted_frames")

    def require_plane(self, role: str) -> None:
        """Say what to do with a layer that counts in degrees."""
        if role in self.parts.in_degrees:
            self.plan.missing.append(say(
                "{part} count in degrees: open the layer in QGIS, save it with “Export” in {crs}, and add that file.",
                part=roles.use_name(role), crs=self.crs or say("the plane reference system of the points")))

    def crs_for(self, role: str) -> Value | None:
        """The common system for clouds that state none; None where all do, or no file says one."""
        if role not in self.parts.unplaced:
            return None
        if not self.crs:
            self.plan.notes.append(say("No file states the reference system of the points: say it in the settings of "
                                       "the step (“{label}”).", label=known(_POINTS_CRS)))
        return self.crs or None

    def _made_reference(self) -> dict[str, Value]:
        if (self.has(roles.FRAMES) and self.has(roles.EXTERIOR_ROLE)) or not self.has(roles.ORTHOPHOTO_ROLE):
            for role in (roles.FRAMES, roles.CAMERA_ROLE, roles.EXTERIOR_ROLE, roles.ALS):
                if not self.has(role):
                    self.lacks(role)
            footprints, exterior, als = self.footprints(False), self.exterior(), self.als()
            self.add("reference", "aerialmarkings", FRAMES=_given(roles.FRAMES), CAMERA=_given(roles.CAMERA_ROLE),
                     EXTERIOR=exterior, ALS=als, FOOTPRINTS=footprints,
                     POINTS_CRS=self.crs_for(roles.ALS), OUTPUT_REPORT=WANTED)
            return {"mask": _result("reference"), "polygons": _result("reference", "OUTPUT_POLYGONS"),
                    "ground": _result("reference", "OUTPUT_GROUND"),
                    "image": _result("reference", "OUTPUT_ORTHOPHOTO")}
        ground = self._ground()
        self.add("reference", "roadmarkingsfromorthophoto", INPUT=_given(roles.ORTHOPHOTO_ROLE),
                 BUILDINGS=self.footprints(False), GROUND=ground, OUTPUT_REPORT=WANTED)
        return {"mask": _result("reference"), "polygons": _result("reference", "OUTPUT_POLYGONS"), "ground": ground,
                "image": _given(roles.ORTHOPHOTO_ROLE)}

    def surveys(self) -> list[str]:
        """Ids of the steps that lay each survey on the reference."""
        if "surveys" not in self.made:
            if not self.parts.surveys:
                self.lacks("survey")
            reference = self.reference()
            self.made["surveys"] = {f"survey_{number}": self._survey(number, reference)
                                    for number in self.parts.surveys or (1,)}
        return list(self.made["surveys"])

    def _survey(self, number: int, reference: dict[str, Value]) -> Value:
        def optional(role: str) -> Value | None:
            return _given(f"{role}_{number}") if self.has(f"{role}_{number}") else None

        if self.parts.surveys and not self.has(f"calibration_{number}"):
            self.plan.notes.append(known(_MISSING["calibration"]))
        self.add(f"survey_{number}", "georeferencemms", POINTS=_given(f"survey_{number}"),
                 TRAJECTORY=_given(f"trajectory_{number}"), CALIBRATION=optional("calibration"),
                 MARKINGS=reference["mask"], GROUND=reference["ground"], IMAGE=reference["image"],
                 IMAGES=optional("poses"), OUTPUT_IMAGES=WANTED if optional("poses") else None,
                 POINTS_CRS=self.crs_for(f"survey_{number}"))
        if self.has(f"control_{number}"):
            self.add(f"acceptance_{number}", "acceptance", INPUT=_given(f"control_{number}"),
                     TRAJECTORY=_given(f"trajectory_{number}"),
                     CORRECTED=_result(f"survey_{number}", "OUTPUT_TRAJECTORY"), CRS=self.crs or None,
                     PATCHES=_result(f"survey_{number}", "OUTPUT_PATCHES"), OUTPUT=WANTED, OUTPUT_ERRORS=WANTED)
        elif self.parts.surveys:
            self.plan.notes.append(say("Survey {number}: no control points measured in its times are given, so that "
                                       "its accuracy is not checked independently.", number=number))
        return _result(f"survey_{number}")

    def buildings(self) -> Value:
        if "buildings" not in self.made:
            if not self.has(roles.ALS):
                self.lacks(roles.ALS)
            als = self.als()
            self.add("buildings", "buildingsfromals", POINTS=als,
                     FOOTPRINTS=self.footprints(True) or _given(roles.FOOTPRINTS))
            self.made["buildings"] = {"OUTPUT": _result("buildings")}
        return self.made["buildings"]["OUTPUT"]

    def walls(self) -> None:
        models = self.buildings()
        surveys = [_result(step) for step in self.surveys()]
        drives = [_result(step, "OUTPUT_TRAJECTORY") for step in self.surveys()]
        self.add("walls", "wallsfrommms", POINTS=surveys, BUILDINGS=models, GROUND=self.reference()["ground"],
                 TRAJECTORY=drives)
        self.add("merged", "mergebuildingmodels", MODELS=models, WALLS=_result("walls"), OUTPUT_REPORT=WANTED,
                 OUTPUT_CITYJSON=WANTED)

    def polygons(self) -> Value | None:
        """The markings of the reference as polygons."""
        found = self.reference()["polygons"]
        if found is None:
            self.plan.missing.append(say("Markings as polygons are missing: a mask alone makes no lane map; leave it "
                                         "out to make both from the images."))
        return found

    def lanes(self) -> None:
        drives = [_result(step, "OUTPUT_TRAJECTORY") for step in self.surveys()]
        self.add("lanes", "lanemap", MARKINGS=self.polygons(), GROUND=self.reference()["ground"], TRAJECTORY=drives,
                 OUTPUT_LANELET2=WANTED, OUTPUT_OPENDRIVE=WANTED, OUTPUT_REPORT=WANTED)

    def accuracy(self) -> None:
        buildings = self.buildings()
        self.lanes()
        if not self.has(roles.NAVIGATION_ROLE):
            self.plan.notes.append(known(_MISSING[roles.NAVIGATION_ROLE]))
        self.add("localisation", "localisationaccuracy", BUILDINGS=buildings,
                 MARKINGS=_result("lanes", "OUTPUT_BOUNDS"), ROADS=_result("lanes", "OUTPUT_CENTRES"),
                 GROUND=self.reference()["ground"],
                 NAVIGATION=_given(roles.NAVIGATION_ROLE) if self.has(roles.NAVIGATION_ROLE) else None)

    def roads(self) -> None:
        if not self.has(roles.ROADS_ROLE):
            self.lacks(roles.ROADS_ROLE)
        self.require_plane(roles.ROADS_ROLE)
        self.add("roads", "roadmodel", ROADS=_given(roles.ROADS_ROLE), OUTPUT_CITYGML=WANTED, OUTPUT_REPORT=WANTED)

    def official_roads(self) -> Value | None:
        """Roads that are given beside measured edges."""
        if not self.has(roles.ROADS_ROLE):
            return None
        self.require_plane(roles.ROADS_ROLE)
        return _given(roles.ROADS_ROLE)

    def measured_roads(self) -> None:
        """Of each survey its edges, lanes between them and lines of the reference, and the road model of these."""
        surveys, ground = self.surveys(), self.reference()["ground"]
        self.add("lines", "markinglines", MARKINGS=self.polygons(), GROUND=ground, OUTPUT_AREAS=WANTED)
        for step in surveys:
            number = step.rpartition("_")[2]
            edges, lanes, drive = f"edges_{number}", f"lanes_{number}", _result(step, "OUTPUT_TRAJECTORY")
            self.add(edges, "roadedges", POINTS=_result(step), TRAJECTORY=drive, SIGMA=_result(step, "MEDIAN_SIGMA"),
                     OUTPUT_TOPS=WANTED)
            self.add(lanes, "vectormap", LINES=_result("lines"), AREAS=_result("lines", "OUTPUT_AREAS"),
                     EDGES=_result(edges), TRAJECTORY=[drive], OUTPUT_REPORT=WANTED)
            self.add(f"roads_{number}", "roadmodel", LOD=_FINEST, EDGES=_result(edges),
                     TOPS=_result(edges, "OUTPUT_TOPS"), LANES=_result(lanes, "OUTPUT_LANES"),
                     STOP_LINES=_result("lines"), GROUND=ground, ROADS=self.official_roads(), OUTPUT_CITYGML=WANTED,
                     OUTPUT_REPORT=WANTED)

    def road_space(self) -> None:
        """The same of each survey in one step, with what stands beside the road."""
        surveys, ground = self.surveys(), self.reference()["ground"]
        for step in surveys:
            self.add(f"space_{step.rpartition('_')[2]}", "roadspace", POINTS=_result(step),
                     TRAJECTORY=_result(step, "OUTPUT_TRAJECTORY"), SIGMA=_result(step, "MEDIAN_SIGMA"),
                     MARKINGS=self.polygons(), GROUND=ground, ROADS=self.official_roads(), OUTPUT_CITYGML=WANTED,
                     OUTPUT_REPORT=WANTED, OUTPUT_FURNITURE=WANTED, OUTPUT_OBJECT_REPORT=WANTED)

    def objects(self) -> None:
        """Objects of each survey laid on the reference; of the survey as it is where there is no reference at all."""
        numbers = self.parts.surveys or (1,)
        if self.parts.surveys and not any(self.has(role) for role in _REFERENCES):
            self.plan.notes.append(say(
                "There is nothing to lay the survey on, so that it is taken as it is, and objects are as wrong as it "
                "is: say how well it is placed in the settings of the step (“{label}”).", label=known(_SURVEY_SIGMA)))
            drives: list[tuple] = [(_given(f"survey_{number}"), _given(f"trajectory_{number}"), None,
                                    self.crs_for(f"survey_{number}")) for number in numbers]
        else:
            drives = [(_result(step), _result(step, "OUTPUT_TRAJECTORY"), _result(step, "MEDIAN_SIGMA"), None)
                      for step in self.surveys()]
        for number, (points, trajectory, sigma, crs) in zip(numbers, drives):
            self.add(f"objects_{number}", "streetobjects", POINTS=points, TRAJECTORY=trajectory, SIGMA=sigma,
                     POINTS_CRS=crs, OUTPUT_RAILS=WANTED, OUTPUT_CITYGML=WANTED, OUTPUT_REPORT=WANTED)


_WORK: dict[str, Callable[[_Planning], object]] = {
    REFERENCE: _Planning.reference, SURVEY: _Planning.surveys, BUILDINGS: _Planning.buildings, WALLS: _Planning.walls,
    LANES: _Planning.lanes, ACCURACY: _Planning.accuracy, ROADS: _Planning.roads,
    MEASURED_ROADS: _Planning.measured_roads, ROAD_SPACE: _Planning.road_space, OBJECTS: _Planning.objects}
