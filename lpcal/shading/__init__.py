"""Normals, albedo and gloss from samples in a light that is given: pixel by pixel, of all pixels together, and by search."""
