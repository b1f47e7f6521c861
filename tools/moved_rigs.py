"""What ``lpcal diff`` sees: pairs of calibrations of one drawn rig, unmoved, and with one light moved between them.

``python tools/moved_rigs.py [--rigs 20] [--chrome 4 8 12] [--moves 0.3]``, ``python tools/moved_rigs.py --bound``

Each rig (lightpanel-6) is drawn by `light_rigs` on two days, its chrome spheres placed again: images are rendered LED by LED and go through
lpcal's detection. The camera is off by `CAMERA_PX`, as by an intrinsics, and the same on both days, as ``lpcal diff`` takes it unless it
has changed beyond chance. Each pair is held against each other as it is, then with one light moved along its arm, and sideways: a move
shifts the highlights by what the simulator's own LEDs make of it. ``--render`` draws the moved lights again instead, moved one way (slow).
Spheres are drawn once and kept in a folder of the system's temporary files; the first so many of each day are used.

``--bound`` draws nothing: highlights with `SCATTER_PX` and outlines as lpcal's own covariances have them, of spheres placed as each of
`DESIGNS` says; printed is the Cramer-Rao bound of one light's move, what all lights share being nothing, the share of moves by `MOVE_M`
along the arm or sideways that the best test can then name, and how many of those sigmas a joint turned by 0.1 deg is.

Printed otherwise: silent pairs; named lights of the moved, those named as one of two, and false names; the sigma that is stated, which is
the Cramer-Rao bound by the scatter of the highlights, and the errors of the found moves compared with it.
"""

from __future__ import annotations

import argparse
import hashlib
import pickle
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from scipy.stats import chi2, ncx2

sys.path.insert(0, str(Path(__file__).resolve().parent))

from light_rigs import CACHE, _outline, capture_rig, in_frame, rig_of, sources
from lpcal.chain.refine_lights.geometry_fit import BIAS_PX
from lpcal.chain.refine_lights.moved_lights import Day, MovedLights, moved_lights
from lpcal.geometry import se3, sphere
from lpcal.records.calibration import Camera, SphereFinding
from lpcal.records.comparison import UNLIKELY
from lpcal.records.observations import SphereView
from lpcal.simulate.built import Built, build
from lpcal.simulate.leds import LedLight
from lpcal.simulate.recipe import Recipe

CAMERA_PX = np.array([0.3, 0.3, 0.4, 0.4])
"""Errors of the focal lengths and the principal point, one standard deviation."""
OUTLINE_POINTS = 45
"""As many as lights.yaml holds."""


SCATTER_PX = 0.006
"""Of a drawn chrome sphere's highlights, as pairs of days show it."""
JOINT_RAD = np.radians(0.1)
"""The turn of a joint that is to be seen."""
MOVE_M = 3e-4
"""The move of a light that is to be seen."""
PLACES = 60
"""Places that are tried for a sphere, of which the one farthest from all others is taken."""


@dataclass(frozen=True)
class Design:
    """Chrome spheres of a day, all over a volume, and the camera that sees them."""

    words: str
    spheres: int
    radius_m: float = 0.025
    depth: tuple[float, float] = (0.9, 1.1)
    """Nearest and farthest, of the working distance."""
    finer: int = 1
    """By how much the camera's pixels are finer than 640x400."""


DEEP = (0.6, 1.5)
"""Depths at which spheres of 50 mm are whole in the picture and lit by all lights."""
DESIGNS = (
    Design("at the working distance", 4),
    Design("at the working distance", 6),
    Design("at the working distance", 8),
    Design("at the working distance", 12),
    Design("at the working distance", 24),
    Design("near and far", 12, depth=DEEP),
    Design("near and far", 24, depth=DEEP),
    Design("near and far, 80 mm across", 12, 0.04, (0.7, 1.6)),
    Design("near and far, camera of 2560x1600", 12, depth=DEEP, finer=4),
    Design("near and far, camera of 5120x3200", 24, depth=DEEP, finer=8),
)


@dataclass(frozen=True)
class Seen:
    """A day of a rig."""

    built: Built
    camera: Camera
    views: tuple[SphereView, ...]

    def day(self, count: int, camera: Camera, shifted: dict[str, np.ndarray] | None = None) -> Day:
        """The first so many spheres, as lights.yaml would hold them."""
        found = [
            _finding(view, {} if shifted is None else {name: shifted[name][k] for name in shifted}) for k, view in enumerate(self.views)
        ]
        return Day(found[:count], camera)


def _finding(view: SphereView, by_px: dict[str, np.ndarray]) -> SphereFinding:
    every = max(1, len(view.outline_px) // OUTLINE_POINTS)
    return SphereFinding(
        view.name,
        view.kind,
        None,
        view.radius_m,
        used=True,
        why=None,
        outline_px=view.outline_px[::every],
        highlights_px={name: pixel + by_px.get(name, 0.0) for name, pixel in view.highlights_px.items()},
        outline_sigma_px=view.outline_sigma_px,
        highlight_sigma_px=view.highlight_sigma_px,
    )


def moved_light(light: LedLight, by_C: np.ndarray) -> LedLight:
    """A light that stands elsewhere."""
    return replace(light, H_CL=_shift(by_C) @ light.H_CL, position_C=light.position_C + by_C, source_C=light.source_C + by_C)


def _shift(by_m: np.ndarray) -> np.ndarray:
    return se3.transform(np.eye(3), by_m)


def drawn(seed: int, day: int, chrome: int, moved: tuple[int, np.ndarray] | None = None) -> Seen:
    """A rig on a day, rendered and seen, or as kept from before; `moved` is a light and by how much (metres, C)."""

    def change(built: Built) -> Built:
        if moved is None:
            return built
        lights = list(built.lights)
        lights[moved[0]] = moved_light(lights[moved[0]], moved[1])
        return replace(built, lights=tuple(lights))

    code = hashlib.sha256(b"".join(path.read_bytes() for path in sources()) + repr(moved).encode()).hexdigest()[:12]
    kept = CACHE / f"moved_{seed}_{day}_{chrome}_{code}.pkl"
    if not kept.exists():
        CACHE.mkdir(exist_ok=True)
        rig, wings, sigma = rig_of("lightpanel-6", chrome, 0)
        found = capture_rig(rig, wings, sigma, recipe(seed), day=day, moved=change)
        kept.with_suffix(".part").write_bytes(pickle.dumps(found))
        kept.with_suffix(".part").rename(kept)
    built, camera, windows, _ = pickle.loads(kept.read_bytes())
    return Seen(built, camera, tuple(in_frame(view, corner, camera.image_size) for view, corner in windows))


def recipe(seed: int) -> Recipe:
    """Of a rig: its dome, tilts and powers drawn."""
    rng = np.random.default_rng([seed, 77])
    tilt_rad = np.radians(rng.uniform(0.2, 0.5))
    return Recipe(
        seed=seed, dome_radius_m=float(rng.uniform(0.023, 0.031)), led_tilt_rad=tilt_rad, led_power=float(rng.uniform(0.02, 0.05))
    )


def off_camera(camera: Camera, seed: int) -> Camera:
    """The camera as an intrinsics has it."""
    off = CAMERA_PX * np.random.default_rng([seed, 80]).normal(size=4)
    return replace(camera, K=camera.K + np.array([[off[0], 0, off[2]], [0, off[1], off[3]], [0, 0, 0]]))


def highlight_px(camera: Camera, light: LedLight, centre_C: np.ndarray, radius_m: float) -> np.ndarray:
    """The mirror image of the LEDs' mean place, as they shine at where the sphere mirrors the dome's centre."""
    ray = sphere.mirror_point(centre_C, radius_m, light.source_C) - light.position_C
    r = np.linalg.norm(ray, axis=1)
    weight = light.power * np.maximum(np.sum(ray * light.axis_C, axis=1) / r, 0) ** light.exponent / r**2
    return np.asarray(camera.project(sphere.mirror_point(centre_C, radius_m, np.average(light.position_C, axis=0, weights=weight))))


def shift_of(seen: Seen, k: int, by_C: np.ndarray) -> dict[str, np.ndarray]:
    """By how much (S, 2) the highlights of light k move where it does."""
    light, found = seen.built.lights[k], []
    for view in seen.views:
        assert view.radius_m is not None
        centre_C = sphere.from_outline(seen.camera.unproject(view.outline_px), view.radius_m)
        before, after = (highlight_px(seen.camera, one, centre_C, view.radius_m) for one in (light, moved_light(light, by_C)))
        found.append(after - before)
    return {light.name: np.array(found)}


def compared(one: Seen, two: Seen, count: int, camera: Camera, shifted: dict[str, np.ndarray] | None = None) -> MovedLights:
    """The lights of two days held against each other."""
    lights = one.built.lights
    sources_C = np.array([[light.source_C for light in lights]] * 2)
    axes_C = np.array([light.H_CL[:3, :3] for light in lights])
    found = moved_lights(
        one.day(count, camera), two.day(count, camera, shifted), sources_C, axes_C, [light.name for light in lights], UNLIKELY
    )
    assert found is not None
    return found


def placed(design: Design, built: Built, rng: np.random.Generator) -> list[np.ndarray]:
    """Centres of a design's spheres, each whole in the picture and far from the others."""
    lens, focus, found = built.lens, built.focus_C, []
    around = 1.35 * design.radius_m * np.concatenate([np.eye(3)[:2], -np.eye(3)[:2]])
    while len(found) < design.spheres:
        z = focus[2] * rng.uniform(*design.depth, PLACES)
        half = np.array(lens.image_size) / 2 / lens.K[0, 0] * z[:, None]
        tried = focus * (z / focus[2])[:, None] + np.column_stack([rng.uniform(-half, half), np.zeros(PLACES)])
        inside = [place for place in tried if lens.inside(place + around, 4)]
        found += [max(inside, key=lambda place: min((np.linalg.norm(place - other) for other in found), default=0.0))] if inside else []
    return found


def believed(design: Design, built: Built, camera: Camera, rng: np.random.Generator) -> Day:
    """A day of a design as the solver believes it to be: highlights and outlines with errors of their stated sizes."""
    found = []
    for number, centre_C in enumerate(placed(design, built, rng)):
        points = _outline(camera, "chrome", centre_C, design.radius_m, BIAS_PX["chrome"][0], rng)
        seen = {
            light.name: camera.project(sphere.mirror_point(centre_C, design.radius_m, light.source_C)) + SCATTER_PX * rng.normal(size=2)
            for light in built.lights
        }
        view = SphereView(f"chrome_{number}", "chrome", design.radius_m, points, 0.05, seen, dict.fromkeys(seen, SCATTER_PX))
        found.append(_finding(view, {}))
    return Day(found, camera)


def bound_of(design: Design, seeds: int) -> tuple[np.ndarray, float]:
    """Sigma of a light's move (3,) along its arm, sideways and along its emission, and of how many of them a joint's turn is."""
    rig, _, _ = rig_of("lightpanel-6", 4, 0)
    variances, sigmas = [], []
    for seed in range(seeds):
        built = build(rig, recipe(seed))
        lens, scale = built.lens, np.diag([design.finer, design.finer, 1.0])
        camera = Camera((lens.image_size[0] * design.finer, lens.image_size[1] * design.finer), "opencv5", scale @ lens.K, lens.distortion)
        rng = np.random.default_rng([seed, 81])
        days = [believed(design, built, camera, rng) for _ in range(2)]
        sources_C = np.array([[light.source_C for light in built.lights]] * 2)
        axes_C = np.array([light.H_CL[:3, :3] for light in built.lights])
        found = moved_lights(days[0], days[1], sources_C, axes_C, [light.name for light in built.lights], UNLIKELY)
        assert found is not None
        for light, R, covariance in zip(built.lights, axes_C, found.covariance, strict=True):
            own = R.T @ covariance @ R
            out_m = float((light.source_C - light.H_CL[:3, 3]) @ R[:, 2])
            by_m = JOINT_RAD * np.array([-out_m, 0.0, light.setting["d2_m"]])
            variances.append(np.diag(own))
            sigmas.append(np.sqrt(by_m @ np.linalg.solve(own, by_m)))
    return np.sqrt(np.mean(variances, axis=0)), float(np.median(sigmas))


def named_share(sigma_m: float, by_m: float = MOVE_M, lights: int = 6) -> float:
    """Share of moves by `by_m` that the best test names, where an axis is known to `sigma_m` and which light moved, and whither, is not.

    The estimate's squared length in its own sigmas is chi2 of 3 about ``(by_m / sigma_m)^2``, and of an unmoved light about 0; a name is
    given where that has odds under `UNLIKELY` over all lights.
    """
    return float(ncx2.sf(chi2.isf(UNLIKELY / lights, 3), 3, (by_m / sigma_m) ** 2))


def bounds(seeds: int) -> None:
    """Print the bound of each design."""
    print("spheres a day, where; sigma of a light's move along its arm, sideways, along its emission, mm;", end=" ")
    print(f"share of {1e3 * MOVE_M:.1f} mm named at best; a joint's 0.1 deg in sigmas")
    for design in DESIGNS:
        sigma, joint = bound_of(design, seeds)
        best = np.mean([named_share(one) for one in sigma[:2]])
        sigmas = "".join(f"{1e3 * one:8.3f}" for one in sigma)
        print(f"{design.spheres:4d} {design.words:40s} {sigmas}{best:8.2f}{joint:8.1f}", flush=True)


@dataclass
class Tally:
    """What many pairs showed with so many spheres a day."""

    silent: int = 0
    pairs: int = 0
    named: int = 0
    either: int = 0
    false: int = 0
    trials: int = 0

    def __post_init__(self) -> None:
        self.errors: list[np.ndarray] = []
        self.sigmas: list[np.ndarray] = []

    def unmoved(self, found: MovedLights) -> None:
        """Count a pair of days between which nothing was moved."""
        self.pairs += 1
        self.silent += bool((found.chance >= UNLIKELY).all()) and not found.either

    def trial(self, found: MovedLights, k: int, by_C: np.ndarray, R: np.ndarray) -> None:
        """Count a pair of days between which light k was moved."""
        names = np.flatnonzero(found.chance < UNLIKELY)
        self.trials += 1
        self.named += k in names
        self.either += k in found.either
        self.false += bool(set(names) - {k}) or bool(found.either and k not in found.either)
        self.errors.append(R.T @ (found.moved_C[k] - by_C))
        self.sigmas.append(np.sqrt(np.diag(R.T @ found.covariance[k] @ R)))

    def line(self, count: int) -> str:
        """For people."""
        sigma, error = (1e3 * np.sqrt(np.mean(np.square(each), axis=0)) for each in (self.sigmas, self.errors))
        return (
            f"{count:7d} {self.silent:4d} of {self.pairs:3d} {self.named:7d} of {self.trials:3d} {self.either:8d} {self.false:6d}"
            + "".join(f"{s:8.3f} ({e:.3f})" for s, e in zip(sigma, error, strict=True))
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rigs", type=int, default=20)
    parser.add_argument("--chrome", type=int, nargs="+", default=[4, 8, 12])
    parser.add_argument("--moves", type=float, nargs="+", default=[0.3], metavar="MM")
    parser.add_argument("--render", action="store_true", help="render the moved light, one of each rig, instead of shifting its highlights")
    parser.add_argument("--bound", action="store_true", help="the Cramer-Rao bound of designs, nothing drawn")
    asked = parser.parse_args()
    if asked.bound:
        bounds(min(asked.rigs, 2))
        return
    for millimetres in asked.moves:
        print(
            f"\n{millimetres} mm: spheres a day, silent pairs, moved and named, or other, false; sigma (error), mm: arm, sideways, emission"
        )
        for count in asked.chrome:
            print(tally(asked.rigs, max(asked.chrome), count, 1e-3 * millimetres, render=asked.render).line(count), flush=True)


def tally(rigs: int, most: int, count: int, by_m: float, *, render: bool) -> Tally:
    """All pairs and trials with so many spheres a day."""
    found = Tally()
    for seed in range(rigs):
        one, two = (drawn(seed, day, most) for day in (1, 2))
        camera = off_camera(two.camera, seed)
        found.unmoved(compared(one, two, count, camera))
        for k in [seed % len(one.built.lights)]:
            R = one.built.lights[k].H_CL[:3, :3]
            for axis in R.T[seed % 2 : seed % 2 + 1] if render else R.T[:2]:
                by_C = by_m * axis
                after, shifted = (drawn(seed, 2, most, (k, by_C)), None) if render else (two, shift_of(two, k, by_C))
                found.trial(compared(one, after, count, camera, shifted), k, by_C, R)
    return found


if __name__ == "__main__":
    main()
