"""Normals, albedo and gloss from samples in a light that is given: pixel by pixel, and of all pixels together."""
