"""Photometric stereo: from a capture and a calibration to normals, albedo and depth, each with how sure it is."""
