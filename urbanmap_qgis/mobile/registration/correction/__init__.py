"""One smooth correction of the trajectory from what all windows say, with its sigma.

In the order of the work:

- evidence: `normal_equations` of the windows, `point_observations` of the points themselves, `ground_errors` of the
  reference's heights, `held_observations` of walls;
- how the error goes: `gauss_markov` (drift of places), `error_model` (with the angles), `error_steps` (faster than
  drift);
- the fit: `chain` (nodes along the path), `robust_fit` (evidence weighed against itself, then onto the points);
- who is right: `disagreements` (sharp steps), `side_slip` (what the vehicle cannot have done),
  `fast_changes` (the drive's or the reference's), `second_witness` (the walls);
- what is told: `patch_status`, `patch_corrections`, `moved_markings`.

`adjustment` is the recipe, `settings` what a user may set, `patchwise` the paper's own way, without a model of drift.
"""
