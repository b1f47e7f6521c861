"""Photometric stereo: from a capture and a calibration to normals, depth and a mesh."""
