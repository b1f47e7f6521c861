"""A dome of lights of which nothing is known: a chrome ball tells their directions, and these the normals of an object."""

import numpy as np

import lpcal

# Your own images stand here, (L, H, W) each, or lpcal.read_capture(folder, names). These are drawn: a chrome ball, and a vase beside it.
azimuth, tilt = np.arange(12) * 2.4, np.radians(np.linspace(20, 50, 12))
S = np.stack([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)], axis=1)
row, column = np.mgrid[:160, :200].astype(float)
half = (S - [0, 0, 1]) / np.linalg.norm(S - [0, 0, 1], axis=1, keepdims=True)
disc = np.clip(60.5 - np.hypot(column - 100, row - 80), 0, 1)
spots = [np.exp(-((column - 100 - 60 * n[0]) ** 2 + (row - 80 - 60 * n[1]) ** 2) / 4.5) for n in half]
ball_images = 0.4 - 0.3 * disc + 0.5 * np.array(spots) + 0.002 * np.random.default_rng(0).standard_normal((12, 160, 200))
x, slope = (column - 100) / 60, 0.3 * np.cos(row / 25)
vase = np.abs(x) < 0.85
normals = np.stack([x, -slope * np.sqrt(1 - np.clip(x, -0.9, 0.9) ** 2), -np.sqrt(1 - np.clip(x, -0.9, 0.9) ** 2)], axis=-1)
normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
vase_images = 0.7 * vase * np.clip(np.einsum("lc,hwc->lhw", S, normals), 0, 1)

names = [f"L{k}" for k in range(12)]
dome = lpcal.assemble_calibration(lpcal.refine_lights([lpcal.find_sphere(ball_images, "chrome", lights=names)], names), name="dome")
surface = lpcal.reconstruct(vase_images, dome, ambient=np.zeros((160, 200)), mask=vase)
print(dome, surface, lpcal.evaluate(surface, normals * vase[..., None]), sep="\n")
