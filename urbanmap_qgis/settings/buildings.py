"""Settings of buildings: from points and outlines to roofs, models and meshes."""

from __future__ import annotations

from .declaration import Settings, record, setting

FULL, PAPER = "full", "paper"
"""Methods: our own way, or the paper's alone."""

PARTITION, POINTS = "partition", "points"
"""Methods of roof polygons beside the paper's: the outline divided without gaps, the same with an outline drawn from
the points."""

PLANES, LEVELS = "planes", "levels"
"""What roofs are: planes, level or sloped (LoD2.2), or level pieces (LoD1.3, as in J 5.3)."""

ROBUST, MAXIMUM = "robust", "maximum"
"""Heights of level roofs: the median of their points, or the highest of them as in the paper."""


@record(frozen=True)
class SegmentationParameters(Settings):
    """How points are given to buildings (J 5.3.1)."""

    expansion: float = setting(1.0, "Expansion", "Distance in metres by which outlines are expanded before they take "
                               "their points.", "m", 0.0, 20.0)
    method: str = setting(
        FULL, "Method", "The full method adjusts the outlines and chooses the points that can be building. The "
        "paper's takes all points in the expanded outlines as they are given; a point in several is written once for "
        "each.", choices=(FULL, PAPER))
    maximum_displacement: float = setting(
        2.5, "Maximum displacement", "Distance in metres by which an outline may be moved to its points; 0 leaves all "
        "outlines in their places.", "m", 0.0, 5.0, alias="MAX_DISPLACEMENT", advanced=True)
    minimum_height: float = setting(
        2.0, "Minimum building height", "Height in metres above the ground from which points without a class can "
        "belong to a building.", "m", 0.5, 20.0, alias="MIN_HEIGHT", advanced=True)


@record(frozen=True)
class DetectionSettings(Settings):
    """How buildings are found without outlines."""

    min_area: float = setting(10.0, "Least area", "Area in square metres of the smallest building.", "m2", 1.0, 10000.0)
    regularity: float = setting(
        1.0, "Regularity", "How far walls may be moved to make an outline straight and square, in multiples of what "
        "the spacing of the points calls for. Less keeps small corners, more leaves them out.", "", 0.1, 5.0,
        advanced=True)


@record(frozen=True)
class UpdateSettings(Settings):
    """How an old model is held against a new cloud."""

    min_area: float = setting(
        10.0, "Least area", "Area in square metres of the smallest change and of the smallest new building; smaller "
        "ones, such as chimneys and dormers, leave a building the same.", "m2", 1.0, 10000.0)
    min_height_change: float = setting(
        0.5, "Least height change", "Change of a roof's height in metres from which it counts, where the data are "
        "exact enough: it has to be three standard deviations as well.", "m", 0.05, 20.0)
    sigma: float | None = setting(
        None, "Sigma of the heights", "Standard deviation in metres of the difference of both epochs' heights on an "
        "unchanged roof. Without it, it is found from all roofs.", "m", 0.01, 5.0, advanced=True)


@record(frozen=True)
class RoofParameters(Settings):
    """How roofs are segmented (J 5.3.2).

    Attributes
    ----------
    min_roof_width : m, narrower strips (parapets, wall hits) are part of their neighbour.
    distinct_step : m, parts with a step of this height between them are roofs of their own.
    max_parapet : m, highest parapet above its roof.
    """

    method: str = setting(
        FULL, "Method", "The full method segments roofs in the histogram and in plan. The paper's has the histogram "
        "alone: all points in the expanded outline, maxima of at least the minimum roof area times the density; it "
        "uses bin width, bin shift, minimum roof area and parapet threshold only.", choices=(FULL, PAPER))
    bin_width: float = setting(0.5, "Bin width", "Width of a histogram bin in metres.", "m", 0.05, 10.0)
    bin_shift: float = setting(0.1, "Bin shift", "Distance in metres from one bin to the next; smaller than the width, "
                               "so that bins overlap.", "m", 0.01, 10.0)
    min_roof_area: float = setting(
        50.0, "Minimum roof area", "Area in square metres that a maximum of the histogram must hold to be a roof "
        "(times the density: the paper's alpha).", "m2", 0.5, 100000.0)
    parapet_threshold: float | None = setting(
        None, "Parapet threshold", "Two maxima are one roof where the histogram between them stays above this number "
        "of points (the paper's beta). Without it, 0.3 of the smaller maximum; with the paper's method, 0.3 of alpha.",
        "points", 0.0)
    min_roof_share: float = setting(
        0.2, "Minimum roof share", "The minimum roof area is no more than this share of the outline's area, so that "
        "small buildings have roofs too; 1 asks for the minimum roof area everywhere but in buildings smaller than "
        "that.", "", 0.01, 1.0, advanced=True)
    small_roof_area: float = setting(
        4.0, "Minimum area of a small roof", "Area in square metres of the smallest part that stands out in height and "
        "becomes a roof of its own.", "m2", 0.5, 1000.0, advanced=True)
    height_rmse: float = setting(
        0.45, "Height error of sloped roofs", "Sloped roofs are cut into level ones until the building's root mean "
        "square height error in metres is below this; 0 keeps the roofs of the paper whole.", "m", 0.0, 10.0,
        advanced=True)
    min_height: float = setting(2.0, "Minimum roof height", "Height in metres above the ground below which nothing is "
                                "a roof.", "m", 0.0, 20.0, advanced=True)
    min_roof_width: float = 1.2
    distinct_step: float = 0.8
    max_parapet: float = 1.5


@record(frozen=True)
class PlaneParameters(Settings):
    """How roof planes are found.

    Attributes
    ----------
    """

    tolerance: float = setting(
        0.2, "Plane tolerance", "Largest distance in metres of a point from its roof plane; three to four times the "
        "noise of the heights.", "m", 0.02, 2.0, alias="PLANE_TOLERANCE", advanced=True)
    least_area: float = setting(1.5, "Minimum area of a plane", "Area in square metres of the smallest roof plane.",
                                "m2", 0.2, 1000.0, alias="MIN_PLANE_AREA", advanced=True)


@record(frozen=True)
class PolygonParameters(Settings):
    """How roof polygons are drawn (J 5.3.3); those of the paper's method are levels always."""

    method: str = setting(PARTITION, "Method", "How the polygons are drawn.",
                          choices=(PARTITION, POINTS, PAPER))
    roofs: str = setting(
        PLANES, "Roofs", "planes: polygons on the planes of their points, with edges where planes meet (LoD2.2); "
        "levels: level polygons (LoD1.3). The paper's method has levels always.", choices=(PLANES, LEVELS))
    height: str = setting(
        ROBUST, "Roof height", "Height of a level roof from its points: the median, or the highest point as in the "
        "paper (the top of the parapet). The paper's method always takes the highest point.",
        choices=(ROBUST, MAXIMUM))
    min_line_points: int = setting(5, "Minimum points of an edge", "Boundary points that a line must have to be an "
                                   "edge, in the paper's method (its n).", "points", 3, 1000, advanced=True)


@record(frozen=True)
class MeshSettings(Settings):
    """How 2.5D meshes are made."""

    max_error: float = setting(0.3, "Maximum error", "Distance in metres from the mesh within which at least 95 % of a "
                               "building's uppermost points shall lie.", "m", 0.01, 10.0)
    step: float = setting(0.5, "Height step", "Steps of the roof higher than this, in metres, become upright walls.",
                          "m", 0.05, 20.0, advanced=True)
    min_area: float = setting(2.0, "Minimum area of a surface", "Smaller pieces between steps become part of what is "
                              "beside them.", "m2", 0.0, 1000.0, advanced=True)


@record(frozen=True)
class MergeSettings(Settings):
    """Limits within which walls of models follow measured walls (J 5.7).

    Attributes
    ----------
    slab : height of the roof's edge over an overhang, m, where the top of the measured wall does not tell it.
    max_rmse : walls whose points scatter more are not used, m.
    """

    model_sigma: float = setting(
        1.0, "Sigma of the models' walls", "How well the models' own walls are known (standard deviation): walls by "
        "GNSS move them little where they are known better.", "m", 0.01, 10.0, advanced=True)
    height: float = setting(20.0, "Height", "Height in metres above the ground of each model up to which measured "
                            "walls are taken.", "m", 1.0, 500.0)
    max_offset: float = setting(2.0, "Maximum offset", "Maximum distance in metres by which a wall moves to the "
                                "measured one.", "m", 0.01, 10.0, advanced=True)
    max_rotation: float = setting(5.0, "Maximum rotation", "Maximum angle between a wall and the measured one.", "°",
                                  0.1, 20.0, alias="MAX_TURN", advanced=True)
    min_share: float = setting(
        0.3, "Minimum share measured", "Minimum share of a wall's length, 0 to 1, that must have been measured for it "
        "to move.", "", 0.05, 1.0, alias="LEAST_SHARE", advanced=True)
    overhang: float = setting(
        0.3, "Minimum overhang", "A roof that stands out further than this over the measured wall stays where it is, "
        "in metres; others follow the wall.", "m", 0.0, 5.0, advanced=True)
    slab: float = 0.3
    max_rmse: float = 0.1
