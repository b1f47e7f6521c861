"""Normals, albedo and gloss under known light: pixel by pixel, and as a regularised field over all pixels."""
