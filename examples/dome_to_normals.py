"""A dome of lights of which nothing is known: one chrome ball tells their directions, and these the normals of an object."""

import numpy as np

import lpcal

rig = lpcal.read_rig("demo")  # the bundled rig, of which only the names of the lights and the images are used here
names = list(rig.rig.lights)

ball = lpcal.find_sphere(lpcal.read_capture(rig.folder / "spheres/chrome_0", names), "chrome")
lights = lpcal.refine_lights([ball], names)
dome = lpcal.assemble_calibration(lights, name="dome")
print(dome)

images = lpcal.read_capture(rig.folder / "objects/relief", dome)
mask = np.zeros(images.images.shape[1:3], dtype=bool)
mask[120:200, 180:300] = True
surface = lpcal.reconstruct(images, dome, mask=mask, sensor=lpcal.StatedSensor(black_level=0.008))
print(surface)
