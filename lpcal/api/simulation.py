"""A synthetic rig with its truth: drawn at once, its images rendered when they are asked for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lpcal.api import stacks
from lpcal.api.boards import board_of
from lpcal.detect.radiometry import fit_flat_field
from lpcal.errors import InputError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records import screens
from lpcal.records.calibration import Calibration, Camera, LedCluster, Light, Lobe
from lpcal.records.observations import Board, PoseStream, RawCapture
from lpcal.records.rig import Rig, RigFile
from lpcal.records.sensor import Sensor
from lpcal.records.shown import Shown
from lpcal.records.surface import Component, Surface
from lpcal.simulate.boards import backdrop, make_scene
from lpcal.simulate.built import Built, build
from lpcal.simulate.captures import Capture, SphereTruth, Studio, object_captures, place_spheres, sphere_captures
from lpcal.simulate.leds import LedLight
from lpcal.simulate.motion import Session, plan
from lpcal.simulate.recipe import Recipe
from lpcal.simulate.sensor import Response, Stored
from lpcal.simulate.tracking import Recording, record
from lpcal.view.pixel_list import ray_map

FLAT_LEVEL = 0.6
"""Share of full scale at which an evenly lit target is taken for the true flat field, well under saturation."""
LEAST_PX = 120
"""Least width and height of simulated images, in pixels: below it boards and spheres cannot be seen."""


@dataclass(frozen=True, repr=False)
class BoardTruth(Shown):
    """Where panel and board really were in every board image; row k of the arrays is one image."""

    H_OP: Array
    """(N, 4, 4) metres."""
    H_CB: Array
    """(N, 4, 4) metres."""
    t_camera_s: Array
    """(N,) seconds on the camera's clock."""


@dataclass(frozen=True, repr=False)
class Simulation(Shown):
    """A simulated rig. The same rig and recipe give the same numbers; images are rendered when they are asked for."""

    rig: Rig
    recipe: Recipe
    built: Built

    @property
    def camera(self) -> Camera:
        """The true camera, with the flat field of its lens."""
        section, lens = self.rig.camera, self.built.lens
        flat = fit_flat_field((FLAT_LEVEL * lens.vignetting()).astype(np.float32), Sensor())
        bare = Camera(lens.image_size, "opencv5", lens.K, lens.distortion, flat_field=flat)
        if section is None:
            return bare
        return replace(bare, black_level=section.black_level, white_level=section.white_level, gamma=section.gamma)

    @property
    def H_PC(self) -> Array:
        """The true camera (4, 4) in the tracked body, metres."""
        return self.built.H_PC

    @property
    def H_OB(self) -> Array:
        """The true board (4, 4) in the room, metres."""
        return self.built.H_OB

    @property
    def clock_offset_s(self) -> float:
        """``t_camera = t_mocap + clock_offset_s``."""
        return self.built.clock_offset_s

    @cached_property
    def calibration(self) -> Calibration:
        """The true camera and lights, every LED of them."""
        lights = tuple(_true_light(light, self.built.focus_C) for light in self.built.lights)
        return Calibration(self.rig.name, lights, self.camera, self.H_PC, float(self.built.focus_C[2]), self.built.focus_C)

    @property
    def board(self) -> Board:
        """The board of the rig.

        Raises
        ------
        InputError
            The rig has none.
        """
        found = board_of(self.rig.board)
        if found is None:
            raise InputError("no section board:", where=self.rig.name, needed="board:", todo="simulate a rig that has one")
        return found

    @cached_property
    def motion(self) -> Session:
        """How the panel moves and when the camera looks, on the mocap's clock."""
        return plan(self.built, self.board.corners, self.board.square_m, self.board_recipe)

    @cached_property
    def recording(self) -> Recording:
        """What the mocap system makes of it, NaN where it lost the body."""
        return record(self.built, self.motion, self.board_recipe)

    @property
    def stream(self) -> PoseStream:
        """The tracked body as `read_mocap` would read it, lost samples left out."""
        found = self.recording
        seen = np.isfinite(found.error_m)
        markers_O = {name: track[seen] for name, track in found.markers_O.items()}
        return PoseStream(
            "LightPanel",
            found.t_s[seen],
            found.H_OP[seen],
            found.error_m[seen],
            markers_O,
            int((~seen).sum()),
            self.recipe.tracking.rate_hz,
        )

    @property
    def board_recipe(self) -> Recipe:
        """The recipe of the board images: no sweep without a second list of images; a robot's poses are neither swapped nor lost."""
        recipe = replace(self.recipe, stations=len(self.listed_images) or self.recipe.stations)
        mocap = self.rig.mocap
        if mocap is None or mocap.poses:
            tracking = replace(recipe.tracking, flipped_stations=0, lost_stations=0)
            return replace(recipe, sweep_frames=0, tracking=tracking)
        return recipe if len(mocap.images) > 1 else replace(recipe, sweep_frames=0)

    @property
    def listed_images(self) -> list[str]:
        """Images of the camera that the rig names one by one; empty where a pattern names them."""
        images = self.rig.camera.images if self.rig.camera else []
        return [] if any(sign in image for image in images for sign in "*?[") else images

    def board_truth(self) -> BoardTruth:
        """Where panel and board really were: at the stations first, then along the sweep."""
        H_OP = np.concatenate([self.motion.station_H_OP, self.motion.sweep_H_OP])
        H_CB = se3.inv(self.built.H_PC) @ se3.inv(H_OP) @ self.built.H_OB
        t_s = np.concatenate([self.motion.station_s, self.motion.sweep_s])
        return BoardTruth(H_OP, H_CB, t_s + self.built.clock_offset_s)

    def board_images(self) -> Iterator[Stored]:
        """The board images (H, W) of 8 bits, in the order of `board_truth`."""
        if self.rig.board is None:
            return
        scene = make_scene(self.built, self.rig.board, self.recipe.sensor.psf_sigma_px)
        rng = np.random.default_rng([self.recipe.seed, 6])
        room, lamp_B = backdrop(self.built.lens.image_size, rng), rng.uniform(-0.18, 0.18, 2)
        for k, H_CB in enumerate(self.board_truth().H_CB):
            yield self.response(scene.render(H_CB, lamp_B, room), np.random.default_rng([self.recipe.seed, 7, k]))

    @property
    def response(self) -> Response:
        """The sensor behind the lens."""
        return response_of(self.rig, self.built, self.recipe)

    @cached_property
    def studio(self) -> Studio:
        """The rig at work on spheres and objects."""
        spheres = place_spheres(self.built, self.rig, np.random.default_rng([self.recipe.seed, 8]))
        return Studio(self.built, self.recipe, self.response, spheres)

    def sphere(self, name: str) -> SphereTruth:
        """Where a sphere really is: kind, centre in C and radius in metres."""
        return self.studio.spheres[name]

    def sphere_captures(self) -> Iterator[tuple[str, RawCapture]]:
        """The spheres' captures by name, as `read_capture` would read them."""
        for name, capture in sphere_captures(self.studio):
            yield name, self._as_read(name, capture)

    def object_captures(self) -> Iterator[tuple[str, RawCapture, Surface]]:
        """The objects' captures by name, as `read_capture` would read them, each with its true surface."""
        for name, capture in object_captures(self.studio, list(self.rig.objects)):
            yield name, self._as_read(name, capture), self._true_surface(name, capture)

    def _as_read(self, name: str, capture: Capture) -> RawCapture:
        lights = [light.name for light in self.built.lights]
        images = np.stack([capture.images[light] for light in lights])
        exposure_s = np.full(len(lights), capture.exposure_s)
        raw = stacks.capture(images, lights, name=name, ambient=capture.images["ambient"], exposure_s=exposure_s)
        short = {light: stacks.fractions(capture.images[f"short_{light}"]) for light in lights if f"short_{light}" in capture.images}
        return replace(raw, short=short, short_exposure_s={light: capture.exposures_s[f"short_{light}"] for light in short})

    def _true_surface(self, name: str, capture: Capture) -> Surface:
        truth = capture.truth
        shape = truth.mask.shape
        depth = truth.depth.astype(np.float32)
        pieces = tuple(
            Component(int(label), int(inside.sum()), float(depth[inside].mean()), 0.0)
            for label in np.unique(truth.component[truth.mask])
            for inside in [truth.mask & (truth.component == label)]
        )
        nothing = np.where(truth.mask, np.float32(0), np.float32(np.nan))
        return Surface(
            name=name,
            normals=truth.normals.astype(np.float32),
            depth=depth,
            albedo=truth.albedo.astype(np.float32),
            mask=truth.mask,
            normal_std_deg=nothing,
            depth_std=nothing,
            lights_used=np.where(truth.mask, np.uint8(len(self.built.lights)), np.uint8(0)),
            component=truth.component,
            rays_C=ray_map(shape, self.camera),
            components=pieces,
            breaks=np.zeros((2, *shape), dtype=bool),
        )


def response_of(rig: Rig, built: Built, recipe: Recipe) -> Response:
    """The sensor behind the lens, as panel.yaml describes it."""
    camera = rig.camera
    black, white, gamma = (camera.black_level, camera.white_level, camera.gamma) if camera else (0.0, 1.0, 1.0)
    return Response(recipe.sensor, built.lens.vignetting(), black, white, gamma)


def _true_light(light: LedLight, focus_C: Array) -> Light:
    """A light with all its LEDs."""
    H_LC = se3.inv(light.H_CL)
    leds = LedCluster(se3.apply(H_LC, light.position_C), se3.rotate(H_LC, light.axis_C), light.power / light.intensity, light.exponent)
    towards_C = light.source_C - focus_C
    return Light(
        name=light.name,
        direction_C=towards_C / np.linalg.norm(towards_C),
        intensity=np.array([light.intensity]),
        H_CL=light.H_CL,
        source_C=light.source_C,
        axis_C=light.H_CL[:3, 2],
        lobe=Lobe("leds", exponent=light.exponent, leds=leds),
        position_std_m=0.0,
        direction_std_rad=0.0,
        intensity_std=0.0,
    )


def simulate_rig(rig: Rig | RigFile, *, seed: int = 1, image_size: tuple[int, int] = (640, 400), stations: int = 22) -> Simulation:
    """Simulate a rig with known truth: its board images, its recording, its captures of spheres and objects.

    Parameters
    ----------
    rig : Rig or RigFile
        The rig, of `read_rig`.
    seed : int
        Another number, another rig within the tolerances that the rig states.
    image_size : (int, int)
        Width and height of the camera's images in pixels, 120 at least each.
    stations : int
        Board views, 4 at least.

    Returns
    -------
    Simulation
        The truth at once (``camera``, ``calibration``, ``H_PC``, ``H_OB``, ``clock_offset_s``, ``stream``), in metres and seconds; images
        when they are asked for (``board_images()``, ``sphere_captures()``, ``object_captures()``).

    Raises
    ------
    InputError
        The images are too small, or there are too few stations.

    Examples
    --------
    >>> import lpcal
    >>> session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), image_size=(320, 200), stations=5)
    >>> next(session.board_images()).shape, session.H_PC.shape
    ((200, 320), (4, 4))
    >>> len(lpcal.simulate_rig(lpcal.read_rig("lightpanel-6")).calibration.lights)
    6
    """
    if min(image_size) < LEAST_PX or stations < 4 or seed < 0:
        raise InputError(
            f"image_size {image_size}, stations {stations}, seed {seed}",
            where="simulate_rig",
            needed=f"{LEAST_PX} pixels at least each way, 4 stations at least, a seed of 0 or more",
        )
    plain = rig.rig if isinstance(rig, RigFile) else rig
    recipe = Recipe(seed=seed, image_size=(int(image_size[0]), int(image_size[1])), stations=stations)
    return simulation_of(plain, recipe)


def simulation_of(rig: Rig, recipe: Recipe) -> Simulation:
    """A simulated rig by a whole recipe."""
    return Simulation(rig, recipe, build(rig, recipe))


@screens.screen_of.register
def _simulation_screen(found: Simulation) -> screens.RecordScreen:
    rig, (width, height) = found.rig, found.built.lens.image_size
    x_mm = 1e3 * found.H_PC[:3, 3]
    rows = [
        ("camera", f"{width} x {height} px, f {found.built.lens.K[0, 0]:.2f} px"),
        ("H_PC", f"at [{x_mm[0]:.2f} {x_mm[1]:.2f} {x_mm[2]:.2f}] mm"),
        ("clock", f"t_camera = t_mocap {1e3 * found.clock_offset_s:+.1f} ms"),
        ("lights", f"{len(rig.lights)}, {1e3 * float(found.built.focus_C[2]):.0f} mm to the object"),
        ("captures", f"{len(rig.spheres)} spheres, {len(rig.objects)} objects, rendered when they are asked for"),
    ]
    return screens.RecordScreen(f"Simulation of {rig.name}, seed {found.recipe.seed}", rows)


@screens.screen_of.register
def _truth_screen(found: BoardTruth) -> screens.RecordScreen:
    t_s = found.t_camera_s
    return screens.RecordScreen("BoardTruth", [("images", str(len(t_s))), ("time", f"{t_s.min():.3f} to {t_s.max():.3f} s")])
