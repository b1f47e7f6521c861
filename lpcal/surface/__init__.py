"""Near-light photometric stereo: from a capture and a calibration to normals, albedo and depth with their uncertainties."""
