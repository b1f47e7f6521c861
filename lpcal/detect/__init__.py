"""Pixels to observations: linear radiance, boards, spheres."""
