"""Lanes from lines and drives: sections, strips, assembly, junctions.

In the order of the work:

- roads: `road_sections` (lines side by side on one axis), cut before by `winding_roads` and `street_corners`;
- lanes: `lane_strips` between bounds, `bound_continuation` where paint is worn, `narrow_places` where a drive has less
  than a lane, `lane_assembly` (bounds and nodes that lanes share), `beyond_junctions` and `road_axes` (directions);
- junctions: `junctions` (ways that were driven), `movements` (ways that were not) with `movement_confidence`,
  `intersections` (their areas), `right_of_way`.
"""
