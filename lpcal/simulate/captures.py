r"""Captures of spheres and objects: where they stand, how they are exposed, the images of each light.

The lights' images in a chrome sphere, LED by LED.

Symbols: sphere of centre c and radius R, camera at the origin, LED at p; in the plane of camera, centre and LED the mirror point is
``P = c + R (cos h e_a + sin h e_b)`` with e_a towards the camera and the LED at the angle g from it (Alhazen's problem). Its two parts of
the angle are equal::

    (P - c) bisects the directions from P to the camera and to the LED

With s and t the distances from P to the LED and to the camera, i the angle of incidence, I the LED's intensity that way, the camera gets::

    E = I / [(s + t + 2 s t / (R cos i)) (s + t + 2 s t cos i / R)]

Source: Coddington's equations for a convex mirror.

The scene of the LightPanel paper's two studies: a unit sphere before an orthographic camera, distant lights on a ring.

Symbols: phase angle g between a light and the view axis, ambient level A (fraction of full scale on the sphere), peak p: what the brightest
sample would be stored at without ambient light. Each pixel is the mean of OVERSAMPLING squared rays; then noise, then the bits.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Light
from lpcal.records.observations import RawCapture
from lpcal.records.rig import Rig
from lpcal.simulate import shapes
from lpcal.simulate.built import Built
from lpcal.simulate.leds import LedLight
from lpcal.simulate.lens import Lens
from lpcal.simulate.picture import MIRROR, Rendered, render
from lpcal.simulate.recipe import Recipe
from lpcal.simulate.scene import DrawnScene, meet
from lpcal.simulate.sensor import Response, Stored, blur, splat

EXPOSURE_S = 0.020
BRIGHTEST = 0.60
"""Signal of a white surface at the focus that faces the strongest light, as a share of full scale."""
SHORT_PEAK = 0.6
DEFAULT_SPHERE_M = 0.025
SPHERE_WALL, OBJECT_WALL = 0.3, 0.32
WALL_BEHIND_SPHERE_M = 0.3
SCREEN_BEHIND_M = (0.25, 0.45)
"""How far behind an object of a session its screen stands: the room behind a robot's path is seldom near."""
CARD_HALF_RADII = 4.4
"""Half the side of the dark card behind a sphere, in its radii."""
ROD_M = 0.003


@dataclass(frozen=True)
class SphereTruth:
    """Where a sphere really is."""

    kind: str
    centre_C: Array
    radius_m: float


@dataclass(frozen=True)
class Capture:
    """The images of one folder by name, its stated exposures, and the truth a pixel."""

    images: dict[str, Stored]
    exposure_s: float
    exposures_s: dict[str, float]
    truth: Rendered
    note: str = ""
    distance_m: float | None = None
    """What the panel's distance sensor reads."""


@dataclass(frozen=True)
class Studio:
    """The rig at work on captures: exposure and room light are the same for all of them."""

    built: Built
    recipe: Recipe
    response: Response
    spheres: dict[str, SphereTruth] = field(default_factory=dict)

    @property
    def focus_irradiance(self) -> Array:
        """Irradiance of each light at the focus."""
        return np.array([np.linalg.norm(light.field(self.built.focus_C[None])) for light in self.built.lights])

    @property
    def gain(self) -> float:
        """Share of the full well a unit of radiance, at the long exposure."""
        return float(BRIGHTEST * np.pi / (0.75 * self.focus_irradiance.max() * (1 + self.recipe.ambient)))

    @property
    def ambient(self) -> float:
        """The room's radiance on white."""
        return float(self.recipe.ambient * self.focus_irradiance.mean() / np.pi * 0.75)

    def sphere(self, name: str, rng: np.random.Generator) -> Capture:
        """The capture of one sphere."""
        truth = self.spheres[name]
        chrome = truth.kind == "chrome"
        waves = shapes.grain(0.25 * truth.radius_m, rng)
        shape = shapes.sphere(truth.radius_m, None if chrome else waves)
        wall_m = float(truth.centre_C[2] + WALL_BEHIND_SPHERE_M)
        scene = self._scene(shape, se3.transform(np.eye(3), truth.centre_C), wall_m, rng, truth)
        rendered = render(self.built.lens, scene)
        if not chrome:
            return self._develop(rendered, rng, shape.note)
        spots = [self._spots(truth, k) for k in range(len(self.built.lights))]
        return self._develop(rendered, rng, "chrome", spots)

    def item(self, name: str, index: int, rng: np.random.Generator) -> Capture:
        """The capture of one object; its name picks the shape, or else its place in the list does."""
        makers = list(shapes.SHAPES.values())
        make = shapes.SHAPES.get(name, makers[index % 3])
        lens, focus_C = self.built.lens, self.built.focus_C
        half_m = focus_C[2] * min(lens.image_size[0] / lens.K[0, 0], lens.image_size[1] / lens.K[1, 1]) / 2
        shape = shapes.grained(make(0.56 * float(half_m)), rng)
        x_C = focus_C + rng.uniform(-0.03, 0.03, 3) * half_m
        H_CS = se3.transform(se3.rotation(rng.normal(0, [0.08, 0.25, 0.05])), x_C)
        wall_m = float(x_C[2] + 1.25 * shape.bound_m + rng.uniform(0.02, 0.05))
        scene = self._scene(shape, H_CS, wall_m, rng)
        found = self._develop(render(lens, scene), rng, shape.note)
        return replace(found, distance_m=self._read(scene, [self.recipe.seed, 12, index]))

    def _read(self, scene: DrawnScene, seed: list[int]) -> float | None:
        """What the distance sensor reads of a scene."""
        beam = self.built.beam
        if beam is None:
            return None
        met = meet(scene, beam.position_C, beam.direction_C[None])
        return float(beam.reads(np.linalg.norm(met.x_C - beam.position_C, axis=1), np.random.default_rng(seed))[0])

    def stop(self, shape: shapes.Shape, H_CS: Array, rng: np.random.Generator) -> Capture:
        """The capture of an object of a session, at H_CS (4, 4), a screen standing behind it."""
        wall_m = float(H_CS[2, 3] + shape.bound_m + rng.uniform(*SCREEN_BEHIND_M))
        scene = self._scene(shape, H_CS, wall_m, rng)
        return self._develop(render(self.built.lens, scene), rng, shape.note)

    def flat(self, rng: np.random.Generator) -> Stored:
        """The image of an evenly lit white card."""
        width, height = self.built.lens.image_size
        return self.response(np.full((height, width), 0.75), rng)

    def _scene(
        self, shape: shapes.Shape, H_CS: Array, wall_m: float, rng: np.random.Generator, sphere: SphereTruth | None = None
    ) -> DrawnScene:
        """An object before a light wall; a sphere on a rod, before a dark card on a darker wall."""
        n_C = np.array([*rng.normal(0, 0.04, 2), -1.0])
        panel_m = float(max((np.linalg.norm(light.H_CL[:2, 3]) for light in self.built.lights if light.H_DL is not None), default=0.05))
        bare = DrawnScene(
            shape,
            H_CS,
            np.array([0, 0, wall_m]),
            n_C / np.linalg.norm(n_C),
            SPHERE_WALL if sphere else OBJECT_WALL,
            self.built.lights,
            self.ambient,
        )
        if sphere is None:
            return bare
        card_m = CARD_HALF_RADII * sphere.radius_m
        return replace(bare, chrome=sphere.kind == "chrome", panel_radius_m=0.5 * panel_m, rod_m=ROD_M, card_half_m=card_m)

    def _spots(self, truth: SphereTruth, k: int) -> Array:
        """Light (H, W) of one light's mirror image, blurred."""
        lens, light, sigma = self.built.lens, self.built.lights[k], self.recipe.sensor.psf_sigma_px
        spots = np.zeros(lens.image_size[::-1])
        pixels, flux = highlight(lens, truth.centre_C, truth.radius_m, light, MIRROR)
        disc = led_image_sigma(lens, truth.centre_C, truth.radius_m, light, self.recipe.led_diameter_m)
        for pixel, one in zip(pixels, flux, strict=True):
            splat(spots, pixel, float(one), float(np.hypot(sigma, disc)))
        return spots

    def _develop(self, rendered: Rendered, rng: np.random.Generator, note: str, spots: list[Array] | None = None) -> Capture:
        """Blur, expose and store: long images, the room alone, and short images where there are highlights."""
        sigma, names = self.recipe.sensor.psf_sigma_px, [light.name for light in self.built.lights]
        room = blur(rendered.room, sigma)
        lit = [blur(light, sigma) + room for light in rendered.light]
        if spots is not None:
            lit = [light + spot for light, spot in zip(lit, spots, strict=True)]
        images = {name: self.response(self.gain * light, rng) for name, light in zip(names, lit, strict=True)}
        images["ambient"] = self.response(self.gain * room, rng)
        exposures = {}
        if spots is not None:
            peak = max(float((light * self.response.vignetting).max()) for light in lit) * self.gain
            short_s = float(f"{EXPOSURE_S * min(1.0, SHORT_PEAK / peak):.3g}")
            for name, light in zip(names, lit, strict=True):
                images[f"short_{name}"] = self.response(self.gain * short_s / EXPOSURE_S * light, rng)
                exposures[f"short_{name}"] = short_s
        return Capture(images, EXPOSURE_S, exposures, rendered, note)


def place_spheres(built: Built, rig: Rig, rng: np.random.Generator) -> dict[str, SphereTruth]:
    """Spheres all over the working volume, whole in the image, those of one kind apart from each other."""
    found: dict[str, SphereTruth] = {}
    scale = built.focus_C[2] / 0.35
    for name, section in rig.spheres.items():
        radius_m = section.radius or DEFAULT_SPHERE_M
        best: tuple[float, Array] | None = None
        for _ in range(60):
            centre_C = built.focus_C + scale * rng.uniform([-0.055, -0.045, -0.035], [0.055, 0.045, 0.035])
            around = centre_C + 1.35 * radius_m * np.concatenate([np.eye(3)[:2], -np.eye(3)[:2]])
            if not built.lens.inside(around, 4):
                continue
            apart = min(
                (float(np.linalg.norm(centre_C - other.centre_C)) for other in found.values() if other.kind == section.kind), default=1.0
            )
            if best is None or apart > best[0]:
                best = apart, centre_C
        found[name] = SphereTruth(section.kind, best[1] if best else built.focus_C, radius_m)
    return found


def sphere_captures(studio: Studio) -> Iterator[tuple[str, Capture]]:
    """All spheres by name."""
    for index, name in enumerate(studio.spheres):
        yield name, studio.sphere(name, np.random.default_rng([studio.recipe.seed, 4, index]))


def object_captures(studio: Studio, names: list[str]) -> Iterator[tuple[str, Capture]]:
    """All objects by name."""
    for index, name in enumerate(names):
        yield name, studio.item(name, index, np.random.default_rng([studio.recipe.seed, 5, index]))


BISECTIONS = 60


def mirror_point(centre_C: Array, radius_m: float, led_C: Array) -> Array:
    """Points (N, 3) of the sphere that mirror LEDs (N, 3) into the camera."""
    to_camera, to_led = -centre_C, led_C - centre_C
    b = np.linalg.norm(to_led, axis=1, keepdims=True)
    e_a = to_camera / np.linalg.norm(to_camera)
    cosine = np.clip(to_led @ e_a / b[:, 0], -1, 1)
    e_b = to_led - (to_led @ e_a)[:, None] * e_a
    e_b /= np.maximum(np.linalg.norm(e_b, axis=1, keepdims=True), 1e-15)
    low, high = np.zeros(len(led_C)), np.arccos(cosine)
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        n = np.cos(middle)[:, None] * e_a + np.sin(middle)[:, None] * e_b
        P = centre_C + radius_m * n
        incident = _angle(n, -P)
        mirrored = _angle(n, led_C - P)
        low, high = np.where(incident < mirrored, middle, low), np.where(incident < mirrored, high, middle)
    n = np.cos(low)[:, None] * e_a + np.sin(low)[:, None] * e_b
    return np.asarray(centre_C + radius_m * n)


def highlight(lens: Lens, centre_C: Array, radius_m: float, light: LedLight, reflectance: float) -> tuple[Array, Array]:
    """Pixels (n, 2) of a light's LEDs in the sphere and the flux (n,) of each, in radiance summed over pixels."""
    P = mirror_point(centre_C, radius_m, light.position_C)
    n = (P - centre_C) / radius_m
    to_led, to_camera = light.position_C - P, -P
    s, t = np.linalg.norm(to_led, axis=1), np.linalg.norm(to_camera, axis=1)
    cos_i = np.sum(n * to_camera, axis=1) / t
    emitted = light.power * np.maximum(-np.sum(to_led * light.axis_C, axis=1) / s, 0) ** light.exponent
    irradiance = reflectance * emitted / ((s + t + 2 * s * t / (radius_m * cos_i)) * (s + t + 2 * s * t * cos_i / radius_m))
    pixel_angle = (P[:, 2] / t) ** 3 / (lens.K[0, 0] * lens.K[1, 1])
    return lens.project(P), np.where(cos_i > 0, irradiance / pixel_angle, 0.0)


def led_image_sigma(lens: Lens, centre_C: Array, radius_m: float, light: LedLight, diameter_m: float) -> float:
    """Sigma in pixels of one LED's own disc in the sphere: a quarter of its diameter, demagnified by R / (2 s + R)."""
    s = float(np.linalg.norm(light.position_C[0] - centre_C))
    return float(diameter_m / 4 * radius_m / (2 * s + radius_m) * lens.K[0, 0] / centre_C[2])


def _angle(a: Array, b: Array) -> Array:
    return np.asarray(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.sum(a * b, axis=1)))


OVERSAMPLING = 3


@dataclass(frozen=True)
class Conditions:
    """What is varied in one trial."""

    phase_deg: float = 30.0
    lights: int = 6
    bits: int = 8
    noise: float = 0.0
    """One standard deviation, fraction of full scale."""
    ambient: float = 0.0
    peak: float = 0.98
    pixels: int = 64
    """Across the sphere."""
    rim: float = 0.95
    """Radius (of the sphere) within which pixels count: beyond it the normal turns by more than 6 degrees within one."""
    toe: float = 0.0
    """Fraction of full scale that the sensor needs before it shows anything."""


def ring(conditions: Conditions) -> tuple[Light, ...]:
    """Distant lights round the view axis, at the phase angle from it."""
    g = np.radians(conditions.phase_deg)
    turn = 2 * np.pi * np.arange(conditions.lights) / conditions.lights
    d = np.stack([np.sin(g) * np.cos(turn), np.sin(g) * np.sin(turn), np.full(len(turn), -np.cos(g))], axis=1)
    return tuple(Light(f"L{k}", one, np.ones(1)) for k, one in enumerate(d))


def capture(conditions: Conditions, seed: int) -> tuple[RawCapture, Array, Mask]:
    """Images of the sphere with an ambient image, its normals (H, W, 3) at the pixels' centres, and its mask."""
    rng = np.random.default_rng(seed)
    offsets = (np.arange(OVERSAMPLING) + 0.5) / OVERSAMPLING - 0.5
    lights = ring(conditions)
    room = np.zeros((conditions.pixels, conditions.pixels))
    lit, full = np.zeros((len(lights), *room.shape)), 2**conditions.bits - 1
    for dx in offsets:
        for dy in offsets:
            n, on = _normals(conditions.pixels, dx, dy)
            lit += np.stack([np.maximum(n @ light.direction_C, 0) * on for light in lights]) / OVERSAMPLING**2
            room += on / OVERSAMPLING**2

    def stored(linear: Array) -> Image:
        noisy = linear - conditions.toe + conditions.noise * rng.standard_normal(linear.shape)
        return (np.clip(np.rint(full * noisy), 0, full) / full).astype(np.float32)

    dark = conditions.ambient * room
    images = stored(conditions.peak * lit / lit.max() + dark)
    n, on = _normals(conditions.pixels, 0.0, 0.0)
    mask = on & (np.hypot(n[..., 0], n[..., 1]) < conditions.rim * (1 - 1.5 / conditions.pixels))
    names = tuple(light.name for light in lights)
    ones = np.ones(len(lights))
    return RawCapture("sphere", names, images, ones, stored(dark)[None], np.ones(1), mask=mask, step=1 / full), n, mask


def _normals(pixels: int, dx: float, dy: float) -> tuple[Array, Mask]:
    row, column = np.indices((pixels, pixels), dtype=float)
    x, y = ((axis - (pixels - 1) / 2) / (pixels / 2) for axis in (column + dx, row + dy))
    square = x**2 + y**2
    return np.stack([x, y, -np.sqrt(np.maximum(1 - square, 0))], axis=-1), np.asarray(square < 1)
