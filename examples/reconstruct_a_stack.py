"""A numpy stack of images to a surface: its normals, its depth with sigmas, its mesh."""

import numpy as np

import lpcal

# Six near lights in a ring about a calibrated camera; a ball before it, drawn by the light field itself.
camera = lpcal.Camera((120, 90), "opencv4", np.array([[150.0, 0, 60], [0, 150, 45], [0, 0, 1]]), np.zeros(4))
places = [np.array([0.15 * np.cos(a), 0.15 * np.sin(a), 0.03]) for a in np.arange(6) * np.pi / 3]
aims = [(np.array([0, 0, 0.35]) - x) / np.linalg.norm(np.array([0, 0, 0.35]) - x) for x in places]
lights = tuple(lpcal.Light(f"L{k}", -d, np.ones(1), source_C=x, axis_C=d) for k, (x, d) in enumerate(zip(places, aims, strict=True)))
rig = lpcal.Calibration("ring", lights, camera, d_object_m=0.35, focus_C=np.array([0, 0, 0.35]))
rays = camera.unproject(np.stack(np.meshgrid(np.arange(120.0), np.arange(90.0)), axis=-1))
b, c = rays[..., 2] * 0.36, 0.36**2 - 0.04**2
ball = b**2 > c
points = (b - np.sqrt(np.maximum(b**2 - c, 0)))[..., None] * rays
normals = (points - [0, 0, 0.36]) / 0.04
field = lpcal.light_field(rig, points)
images = 0.02 * field.irradiance[..., 0] * np.clip(np.sum(field.direction_C * normals, axis=-1), 0, 1) * ball

surface = lpcal.reconstruct(images, rig, ambient=np.zeros_like(images[0]), mask=ball)
print(surface, lpcal.evaluate(surface, normals * ball[..., None], depth=points[..., 2]), sep="\n")
print(f"{len(lpcal.mesh(surface).faces)} triangles")
