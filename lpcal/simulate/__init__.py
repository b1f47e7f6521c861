"""A rig with known truth, rendered with more detail than the solvers model."""
