"""A capture as the solvers use it: pixel lists, crops, binned images and bands of pixels, with their rays and the lights at them."""
