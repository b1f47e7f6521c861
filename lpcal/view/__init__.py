"""A capture as solvers see it: its pixels in a list, in part, in coarse pixels, in bands; their rays, and the lights at them."""
