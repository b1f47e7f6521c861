"""Rigs drawn by lpcal's own simulator for the bench of the lights: true lights, and what images of their spheres show.

`drawn`: images are rendered LED by LED, with texture, rod, card, mirrored room, blur, noise and 8 bits, only in a window about each sphere
(`margin` None: whole images), and go through the same detection as those of `lpcal refine`. Left out: the search for the sphere in a whole
image, the errors of camera and flat field's level; H_CD is off by `DISC_SIGMA`, as hand-eye leaves it.

`exact`: what the solver believes, and nothing else: highlights at the mean of the LEDs' light, outlines shifted and biased as the solver's
covariances say, blocks of constant albedo, white noise. Its errors are held against the solver's own standard deviations, which are then
the Bayesian Cramer-Rao bound.
"""

from __future__ import annotations

import hashlib
import pickle
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from lpcal.api.lights import wing_of
from lpcal.chain.h_pl_wings import design_lights
from lpcal.chain.refine_lights.geometry_fit import BIAS_PX
from lpcal.chain.refine_lights.measure import SCATTER_FACTOR, outline_errors
from lpcal.chain.refine_lights.residuals import DOME_M, POWER_SD, TILT_SD_RAD
from lpcal.chain.refine_lights.shading import MODEL_SD, TEXTURE_SD
from lpcal.detect.radiometry import Sensor, fit_flat_field, to_radiance
from lpcal.detect.spheres import Expected, observe_sphere
from lpcal.formats.panel_yaml import read_rig
from lpcal.geometry import se3, sphere
from lpcal.records.calibration import Camera, Wing, Wings
from lpcal.records.observations import Radiance, RawCapture, SphereView
from lpcal.records.rig import Rig, SphereSection
from lpcal.simulate.built import Built, build, working_distance
from lpcal.simulate.captures import Capture, Studio, place_spheres
from lpcal.simulate.leds import LedLight, ring_directions
from lpcal.simulate.lens import Lens
from lpcal.simulate.recipe import Recipe
from lpcal.simulate.sensor import Response

REPOSITORY = Path(__file__).resolve().parent.parent
CACHE = Path(tempfile.gettempdir()) / "lpcal_bench_lights"
DISC_SIGMA = np.array([np.radians(0.06)] * 3 + [0.0003] * 3)
BLACK = 0.008
MARGIN = 1.5
"""Half side of a window, in radii of the sphere."""
PIXEL_NOISE = 0.004
BLOCK_PX = 6
"""Of the solver's blocks: the exact rig's albedo is constant in each."""


@dataclass(frozen=True)
class Drawn:
    """A rig's truth, and what is given to the solver."""

    built: Built
    camera: Camera
    views: tuple[SphereView, ...]
    """Chrome first, then matte."""
    wings: Wings

    @property
    def names(self) -> list[str]:
        return [light.name for light in self.built.lights]

    def some(self, chrome: int, matte: int) -> list[SphereView]:
        """The first so many of each kind."""
        return first_of(self.views, chrome, matte)

    def misdrawn(self, row: int, clicks: int) -> Wings:
        """The wings as a drawing has them that states one joint so many clicks of 10 degrees off."""
        wing = self.wings.wings[row]
        changed = replace(wing, joint_angle_rad=wing.joint_angle_rad + clicks * np.radians(10))
        return _wings([*self.wings.wings[:row], changed, *self.wings.wings[row + 1 :]], self.wings.H_CD, self.wings.setting_sigma)


def first_of(views: Sequence[SphereView], chrome: int, matte: int) -> list[SphereView]:
    """The first so many views of spheres of each kind."""
    of = {kind: [view for view in views if view.kind == kind] for kind in ("chrome", "matte")}
    return of["chrome"][:chrome] + of["matte"][:matte]


def rig_of(name: str = "lightpanel-6", chrome: int = 4, matte: int = 4) -> tuple[Rig, list[Wing], np.ndarray]:
    """A bundled rig with so many spheres, its wings as drawn and their tolerance."""
    rig = read_rig(REPOSITORY / "rigs" / name / "panel.yaml").rig
    section = next(iter(rig.spheres.values()))
    spheres: dict[str, SphereSection] = {f"chrome_{k}": section.model_copy(update={"kind": "chrome"}) for k in range(chrome)}
    spheres |= {f"matte_{k}": section.model_copy(update={"kind": "matte"}) for k in range(matte)}
    rig = rig.model_copy(update={"spheres": spheres})
    assert rig.panel is not None
    sigma = rig.panel.tolerance
    wings = [wing_of(light, entry, rig.panel) for light, entry in rig.lights.items()]
    return rig, wings, np.array([sigma.azimuth, sigma.joint_angle, sigma.length, sigma.length])


def drawn(seed: int, name: str = "lightpanel-6", chrome: int = 4, matte: int = 4, margin: float | None = MARGIN) -> Drawn:
    """Rendered, then seen by lpcal's detection; kept in `CACHE` for the next time: delete it when the detection has changed."""
    code = hashlib.sha256(b"".join(path.read_bytes() for path in sources())).hexdigest()[:12]
    kept = CACHE / f"{name}_{seed}_{chrome}_{matte}_{'whole' if margin is None else margin}_{code}.pkl"
    if not kept.exists():
        CACHE.mkdir(exist_ok=True)
        found = _draw(seed, name, chrome, matte, margin)
        kept.with_suffix(".part").write_bytes(pickle.dumps(found))
        kept.with_suffix(".part").rename(kept)
    built, camera, windows, wings = pickle.loads(kept.read_bytes())
    return Drawn(built, camera, tuple(in_frame(view, corner, camera.image_size) for view, corner in windows), wings)


def sources() -> list[Path]:
    """The code that what is drawn depends on, but for the detection."""
    return [Path(__file__), *sorted((REPOSITORY / "lpcal" / "simulate").glob("*.py"))]


def _recipe(seed: int) -> Recipe:
    rng = np.random.default_rng([seed, 77])
    tilt_rad = np.radians(rng.uniform(0.2, 0.5))
    return Recipe(
        seed=seed, dome_radius_m=float(rng.uniform(0.023, 0.031)), led_tilt_rad=tilt_rad, led_power=float(rng.uniform(0.02, 0.05))
    )


def _draw(
    seed: int, name: str, chrome: int, matte: int, margin: float | None
) -> tuple[Built, Camera, list[tuple[SphereView, tuple[int, int]]], Wings]:
    rig, wings, sigma = rig_of(name, chrome, matte)
    return capture_rig(rig, wings, sigma, _recipe(seed), margin)


def capture_rig(
    rig: Rig,
    wings: list[Wing],
    sigma: np.ndarray,
    recipe: Recipe,
    margin: float | None = MARGIN,
    *,
    day: int = 0,
    moved: Callable[[Built], Built] = lambda built: built,
) -> tuple[Built, Camera, list[tuple[SphereView, tuple[int, int]]], Wings]:
    """A rig built, its spheres rendered and seen; each view with the first column and row of its window.

    On another `day` the same rig has its spheres elsewhere, and other noise; `moved` is what has happened to it before.
    """
    seed, of_day = recipe.seed, [day] if day else []
    built, rng = moved(build(rig, recipe)), np.random.default_rng([seed, 78, *of_day])
    lens, focus_m = built.lens, working_distance(rig)
    camera = Camera(lens.image_size, "opencv5", lens.K, lens.distortion)
    studio = Studio(built, recipe, Response(recipe.sensor, lens.vignetting(), BLACK), place_spheres(built, rig, rng))
    flat = np.asarray(studio.flat(rng) / 255, np.float32)
    response = fit_flat_field(flat, Sensor(BLACK)).response(flat.shape)
    seen = []
    for index, ball in enumerate(studio.spheres):
        corner, window = _window(lens, studio.spheres[ball].centre_C, studio.spheres[ball].radius_m, margin)
        small = replace(studio, built=replace(built, lens=window), response=Response(recipe.sensor, window.vignetting(), BLACK))
        capture = small.sphere(ball, np.random.default_rng([seed, 4, index, *of_day]))
        rows, columns = (slice(start, start + size) for start, size in zip(corner[::-1], window.image_size[::-1], strict=True))
        radiance = _flattened(to_radiance(_raw(ball, capture), Sensor(BLACK)), response[rows, columns])
        expected = Expected(studio.spheres[ball].kind, studio.spheres[ball].radius_m, None, (0.4 * focus_m, 2.5 * focus_m))
        seen.append((observe_sphere(radiance, expected, Camera(window.image_size, "opencv5", window.K, lens.distortion)), corner))
    H_CD_drawn = se3.exp(rng.normal(size=6) * DISC_SIGMA) @ se3.inv(built.H_DC)
    return built, camera, seen, _wings(wings, H_CD_drawn, sigma)


def _wings(wings: list[Wing], H_CD: np.ndarray, sigma: np.ndarray) -> Wings:
    return design_lights(wings, H_CD, np.diag(DISC_SIGMA**2), sigma, "drawn")


def _window(lens: Lens, centre_C: np.ndarray, radius_m: float, margin: float | None) -> tuple[tuple[int, int], Lens]:
    """First column and row of a window about a sphere, and the lens that sees only it."""
    width, height = lens.image_size
    if margin is None:
        return (0, 0), lens
    rim = lens.project(sphere.outline(centre_C, radius_m, np.linspace(0, 2 * np.pi, 60)))
    middle, half = (rim.min(axis=0) + rim.max(axis=0)) / 2, margin * np.ptp(rim, axis=0).max() / 2
    low = np.maximum(np.floor(middle - half), 0).astype(int)
    high = np.minimum(np.ceil(middle + half), [width - 1, height - 1]).astype(int)
    size = high - low + 1
    K = lens.K.copy()
    K[:2, 2] -= low
    corner2 = [((w / lens.K[0, 0]) ** 2 + (h / lens.K[1, 1]) ** 2) ** 2 for w, h in (lens.image_size, size)]
    centre = np.array(lens.vignetting_centre_px) + (np.array([width, height]) - size) / 2 - low
    small = Lens((int(size[0]), int(size[1])), K, lens.distortion, lens.vignetting_r4 * corner2[1] / corner2[0], (centre[0], centre[1]))
    return (int(low[0]), int(low[1])), small


def _raw(name: str, capture: Capture) -> RawCapture:
    lights = [light for light in capture.images if not light.startswith(("short_", "ambient"))]
    stored = {key: image.astype(np.float32) / np.float32(np.iinfo(image.dtype).max) for key, image in capture.images.items()}
    return RawCapture(
        name=name,
        lights=tuple(lights),
        images=np.stack([stored[light] for light in lights]),
        exposure_s=np.full(len(lights), capture.exposure_s),
        ambient=stored["ambient"][None],
        ambient_exposure_s=np.array([capture.exposure_s]),
        short={light: stored[f"short_{light}"] for light in lights if f"short_{light}" in stored},
        short_exposure_s={light: capture.exposures_s[f"short_{light}"] for light in lights if f"short_{light}" in capture.exposures_s},
    )


def _flattened(radiance: Radiance, response: np.ndarray) -> Radiance:
    short = {light: image / response for light, image in radiance.short.items()}
    signal, sigma = radiance.signal / response, radiance.sigma / response
    return replace(radiance, signal=signal, sigma=sigma, ambient=radiance.ambient / response, short=short)


def in_frame(view: SphereView, corner: tuple[int, int], image_size: tuple[int, int]) -> SphereView:
    """What was seen in a window, in the pixels of the whole image; nothing is known outside the window."""
    outline, highlights = view.outline_px + corner, {light: pixel + corner for light, pixel in view.highlights_px.items()}
    if view.shading is None:
        return replace(view, outline_px=outline, highlights_px=highlights)
    shading = view.shading
    height, width = shading.saturated.shape[1:]
    whole = (len(shading.lights), image_size[1], image_size[0])
    part = np.s_[:, corner[1] : corner[1] + height, corner[0] : corner[0] + width]
    signal, sigma, saturated = np.zeros(whole, np.float32), np.ones(whole, np.float32), np.ones(whole, bool)
    signal[part], sigma[part], saturated[part] = shading.signal, shading.sigma, shading.saturated
    shading = Radiance(shading.name, shading.lights, signal, sigma, saturated, np.zeros(whole[1:], np.float32))
    return replace(view, outline_px=outline, shading=shading)


def exact(seed: int, chrome: int = 4, matte: int = 4) -> Drawn:
    """Measurements drawn from the solver's own beliefs."""
    rig, wings, sigma = rig_of("lightpanel-6", chrome, matte)
    rng = np.random.default_rng([seed, 79])
    built = build(rig, _recipe(seed))
    H_CD = se3.inv(built.H_DC)
    settings = np.array([[w.azimuth_rad, w.joint_angle_rad, w.d1_m, w.d2_m] for w in wings])
    settings = settings + rng.normal(size=settings.shape) * sigma
    dome = DOME_M + rng.normal(size=2) * [0.003, 0.003]
    lights = tuple(_light(wing.name, H_CD, setting, dome, rng) for wing, setting in zip(wings, settings, strict=True))
    built = replace(built, lights=lights)
    camera = Camera(built.lens.image_size, "opencv5", built.lens.K, built.lens.distortion)
    bias = {kind: rng.normal(*BIAS_PX[kind]) for kind in BIAS_PX}
    views = []
    for name, ball in place_spheres(built, rig, rng).items():
        outline = _outline(camera, ball.kind, ball.centre_C, ball.radius_m, bias[ball.kind], rng)
        view = SphereView(name, ball.kind, ball.radius_m, outline, 0.05)
        if ball.kind == "chrome":
            places = {light.name: _highlight(camera, light, ball.centre_C, ball.radius_m) + rng.normal(size=2) * 0.015 for light in lights}
            views.append(replace(view, highlights_px=places, highlight_sigma_px=dict.fromkeys(places, 0.015)))
        else:
            views.append(replace(view, shading=_shading(camera, name, lights, ball.centre_C, ball.radius_m, outline, rng)))
    return Drawn(built, camera, tuple(views), _wings(wings, se3.exp(rng.normal(size=6) * DISC_SIGMA) @ H_CD, sigma))


def _light(name: str, H_CD: np.ndarray, setting: np.ndarray, dome: np.ndarray, rng: np.random.Generator) -> LedLight:
    """A blob as the solver believes it to be; the wing's frame is built from its parts, as the contract states them."""
    azimuth, g, d1, d2 = setting
    turn, lift = se3.rotation(np.array([0, 0, azimuth])), se3.rotation(np.array([0, -g, 0]))
    H_DL = se3.transform(turn @ lift, turn @ ([d1, 0, 0] + lift @ [d2, 0, 0]))
    H_CL = H_CD @ H_DL
    stands = ring_directions(19) @ se3.rotation(np.array([0, 0, rng.uniform(0, np.pi / 3)])).T
    across = np.cross(stands, rng.normal(size=3))
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    axis = stands + TILT_SD_RAD * (rng.normal(size=(19, 1)) * across + rng.normal(size=(19, 1)) * np.cross(stands, across))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    exponent, intensity = float(-np.log(2) / np.log(np.cos(np.radians(7.5)))), float(np.exp(rng.normal() * 0.1))
    power = np.exp(rng.normal(size=19) * POWER_SD) / np.sum(np.maximum(stands[:, 2], 0) ** exponent)
    place = np.array([0, 0, dome[0]]) + dome[1] * stands
    return LedLight(
        name,
        H_CL,
        se3.apply(H_CL, place),
        se3.rotate(H_CL, axis),
        power * intensity,
        exponent,
        intensity,
        H_CL[:3, 3] + dome[0] * H_CL[:3, 2],
    )


def _outline(camera: Camera, kind: str, centre_C: np.ndarray, radius_m: float, bias_px: float, rng: np.random.Generator) -> np.ndarray:
    points = camera.project(sphere.outline(centre_C, radius_m, np.linspace(0, 2 * np.pi, 360, endpoint=False)))
    outward = points - points.mean(axis=0)
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    errors = outline_errors(kind, float(np.linalg.norm(points - points.mean(axis=0), axis=1).mean()), 0.05)
    own = bias_px + errors.bias_px + rng.normal() * errors.bias_sd_px
    scatter = rng.normal(size=(360, 1)) * 0.05 * SCATTER_FACTOR
    return np.asarray(points + (own + scatter) * outward + rng.normal(size=2) * errors.shift_sd_px)


def _highlight(camera: Camera, light: LedLight, centre_C: np.ndarray, radius_m: float) -> np.ndarray:
    """The mirror image of the LEDs' mean place, as they shine at where the sphere mirrors the dome's centre."""
    ray = sphere.mirror_point(centre_C, radius_m, light.source_C) - light.position_C
    r = np.linalg.norm(ray, axis=1)
    weight = light.power * np.maximum(np.sum(ray * light.axis_C, axis=1) / r, 0) ** light.exponent / r**2
    source_C = np.average(light.position_C, axis=0, weights=weight)
    return np.asarray(camera.project(sphere.mirror_point(centre_C, radius_m, source_C)))


def _shading(
    camera: Camera,
    name: str,
    lights: tuple[LedLight, ...],
    centre_C: np.ndarray,
    radius_m: float,
    outline: np.ndarray,
    rng: np.random.Generator,
) -> Radiance:
    """Lambert's law at every pixel inside the outline, texture and model error constant in each of the solver's blocks."""
    width, height = camera.image_size
    low = np.maximum(np.floor(outline.min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(outline.max(axis=0)).astype(int), [width - 1, height - 1])
    columns, rows = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1))
    P_C, n_C = sphere.meet(camera.unproject(np.stack([columns, rows], axis=-1).astype(float)), centre_C, radius_m)
    hit = np.isfinite(P_C).all(axis=-1)
    block = np.s_[(rows - low[1]) // BLOCK_PX, (columns - low[0]) // BLOCK_PX]
    blocks = (int((high - low)[1]) // BLOCK_PX + 1, int((high - low)[0]) // BLOCK_PX + 1)
    albedo = 0.7 * np.exp(rng.normal(size=blocks) * TEXTURE_SD)[block]
    signal, sigma = np.zeros((len(lights), height, width), np.float32), np.ones((len(lights), height, width), np.float32)
    saturated = np.ones((len(lights), height, width), bool)
    for k, light in enumerate(lights):
        value = np.zeros(rows.shape)
        value[hit] = np.maximum(np.sum(light.field(P_C[hit]) * n_C[hit], axis=1), 0) * albedo[hit]
        value *= np.exp(rng.normal(size=blocks) * MODEL_SD)[block]
        noise = PIXEL_NOISE * value.max()
        signal[k, rows, columns], sigma[k, rows, columns] = value + noise * rng.normal(size=value.shape), noise
        saturated[k, rows, columns] = ~hit
    return Radiance(name, tuple(light.name for light in lights), signal, sigma, saturated, np.zeros((height, width), np.float32))
