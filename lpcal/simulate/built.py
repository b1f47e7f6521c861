"""The rig as really built: everything that a calibration looks for, drawn within the tolerances that panel.yaml states.

Frames: O room, P tracked body, D disc, C camera, B board, L light.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.rig import LightSection, PanelSection, Rig, Tolerance
from lpcal.simulate.beam import TrueBeam, draw_beam
from lpcal.simulate.leds import Blob, LedLight, apparent_source, build_blob
from lpcal.simulate.lens import Lens
from lpcal.simulate.recipe import Recipe

DOME_RADIUS_M = 0.42
DOME_EXPONENT = 4.0
DOME_DISTANCE_M = 0.40
FREE_MARKERS_D = np.array([[0.081, 0, 0.004], [0.024, 0.079, 0.012], [-0.074, 0.041, 0.004], [-0.058, -0.062, 0.02], [0.035, -0.08, 0.007]])


@dataclass(frozen=True)
class Built:
    """The truth of a simulated rig."""

    lens: Lens
    H_PC: Array
    H_PD: Array
    H_DC: Array
    H_OB: Array
    clock_offset_s: float
    markers_P: dict[str, Array]
    lights: tuple[LedLight, ...]
    focus_C: Array
    points_C: Array
    """Points (N, 3) of the working volume."""
    bow_m: float
    twist: float
    beam: TrueBeam | None = None
    """The panel's distance sensor."""


def build(rig: Rig, recipe: Recipe) -> Built:
    """Draw a rig. The same panel.yaml and recipe give the same rig."""
    rng = np.random.default_rng([recipe.seed, 1])
    lens = _lens(recipe, rng)
    H_PD, H_DC = _frames(rig, rng)
    H_CD = se3.inv(H_DC)
    distance_m = working_distance(rig)
    focus_C = se3.apply(np.eye(4) if rig.panel is None else H_CD, np.array([[0, 0, distance_m]]))[0]
    points_C = _working_points(lens, focus_C, recipe.working_points, rng)
    gains = 1 + (rig.panel.tolerance if rig.panel else Tolerance()).intensity * np.clip(rng.standard_normal(max(len(rig.lights), 1)), -2, 2)
    gains /= gains.mean()
    free = _dome_frames(focus_C, len(rig.lights), rng)
    lights = [
        _light(name, light, rig.panel, recipe, H_CD, float(gain), H_CL, points_C, rng)
        for (name, light), gain, H_CL in zip(rig.lights.items(), gains, free, strict=False)
    ]
    roughly_upright = se3.rotation(np.array([np.pi, 0, 0])) @ se3.rotation(rng.normal(0, 0.15, 3))
    H_OB = se3.transform(roughly_upright, np.array([0.4, 1.2, -0.6]) + rng.normal(0, 0.2, 3))
    return Built(
        lens=lens,
        H_PC=H_PD @ H_DC,
        H_PD=H_PD,
        H_DC=H_DC,
        H_OB=H_OB,
        clock_offset_s=float(np.round(rng.uniform(-0.25, 0.25), 4)),
        markers_P=_markers(rig.panel, H_PD, rng),
        lights=tuple(lights),
        focus_C=focus_C,
        points_C=points_C,
        bow_m=0.0 if rig.board and rig.board.warp == "none" else recipe.bow_m,
        twist=recipe.twist,
        beam=draw_beam(rig, H_CD, recipe.seed),
    )


def working_distance(rig: Rig) -> float:
    """Metres from the disc to where the wings' axes meet it, as designed: the mean of d1 / tan g + d2 / sin g."""
    if rig.panel is None:
        return DOME_DISTANCE_M
    found = [
        d1 / np.tan(g) + d2 / np.sin(g)
        for light in rig.lights.values()
        if light.is_wing
        for _, g, d1, d2 in [_setting(light, rig.panel)]
        if g > 0
    ]
    return float(np.mean(found)) if found else DOME_DISTANCE_M


def _setting(light: LightSection, panel: PanelSection) -> tuple[float, float, float, float]:
    azimuth, g, disc_spacer, blob_spacer = (
        value or 0.0 for value in (light.azimuth, light.joint_angle, light.disc_spacer, light.blob_spacer)
    )
    return azimuth, g, panel.disc_radius + disc_spacer + panel.joint, panel.joint + blob_spacer + panel.blob


def _lens(recipe: Recipe, rng: np.random.Generator) -> Lens:
    width, height = recipe.image_size
    f = recipe.focal_share * width * rng.uniform(0.98, 1.02)
    K = np.array(
        [[f, 0, (width - 1) / 2 + rng.normal(0, 0.01 * width)], [0, f * 1.001, (height - 1) / 2 + rng.normal(0, 0.01 * width)], [0, 0, 1]]
    )
    distortion = np.array([rng.uniform(-0.3, -0.2), rng.uniform(0.06, 0.12), *rng.normal(0, 0.0006, 2), rng.normal(0, 0.005)])
    return Lens(recipe.image_size, np.round(K, 3), np.round(distortion, 5), 0.1, (float(rng.normal(0, 8)), float(rng.normal(0, 8))))


def _frames(rig: Rig, rng: np.random.Generator) -> tuple[Array, Array]:
    """H_PD and H_DC. Without a panel D is the tracked body itself and the camera sits anywhere on it."""
    turn, shift = (np.clip(rng.standard_normal((2, 3)), -1.8, 1.8) for _ in range(2))
    if rig.panel is None:
        return np.eye(4), se3.transform(se3.rotation(0.25 * turn[0]), 0.04 * shift[0])
    length_m, angle_rad = rig.panel.camera.tolerance
    H_DC = se3.transform(se3.rotation(0.6 * angle_rad * turn[1]), np.array(rig.panel.camera.position) + 0.8 * length_m * shift[1])
    size = 0.7 if rig.panel.markers is None else 0.5
    return se3.transform(se3.rotation(size * np.radians(3.0) * turn[0]), size * 0.005 * shift[0]), H_DC


def _markers(panel: PanelSection | None, H_PD: Array, rng: np.random.Generator) -> dict[str, Array]:
    """Markers in P as really stuck on: 0.25 mm off where the calipers found them."""
    known = panel.markers if panel else None
    named = {name: np.array(x_D) for name, x_D in known.items()} if known else {f"Marker{i + 1}": x for i, x in enumerate(FREE_MARKERS_D)}
    return {name: se3.apply(H_PD, (x_D + rng.normal(0, 0.00025, 3))[None])[0] for name, x_D in named.items()}


def _working_points(lens: Lens, focus_C: Array, count: int, rng: np.random.Generator) -> Array:
    """Points (count, 3) about the focus, all of them in view."""
    scale = focus_C[2] / 0.35
    found: list[Array] = []
    while len(found) < count:
        x_C = focus_C + scale * rng.uniform([-0.05, -0.05, -0.06], [0.05, 0.05, 0.05])
        if lens.inside(x_C[None], 0):
            found.append(x_C)
    return np.round(np.array(found), 6)


def _dome_frames(focus_C: Array, count: int, rng: np.random.Generator) -> Array:
    """H_CL (count, 4, 4) of lights on a dome on the camera's side of the focus, each aimed at it within some degrees."""
    frames = np.zeros((max(count, 1), 4, 4))
    for index in range(len(frames)):
        azimuth, polar = index * 2.39996, np.radians(22 + 38 * (index + 0.5) / len(frames))
        outward = np.array([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), -np.cos(polar)])
        z = -outward + rng.normal(0, 0.04, 3)
        z /= np.linalg.norm(z)
        x = np.cross([0.0, 1.0, 0.0], z)
        x /= np.linalg.norm(x)
        frames[index] = se3.transform(np.stack([x, np.cross(z, x), z], axis=1), focus_C + DOME_RADIUS_M * outward * rng.uniform(0.97, 1.03))
    return frames


def _light(
    name: str,
    light: LightSection,
    panel: PanelSection | None,
    recipe: Recipe,
    H_CD: Array,
    intensity: float,
    H_CL: Array,
    points_C: Array,
    rng: np.random.Generator,
) -> LedLight:
    H_DL, setting = None, None
    if panel is not None and light.is_wing:
        off = np.clip(rng.standard_normal(4), -2, 2)
        tolerance = panel.tolerance
        azimuth, g, d1, d2 = np.array(_setting(light, panel)) + off * [
            tolerance.azimuth,
            tolerance.joint_angle,
            tolerance.length,
            tolerance.length,
        ]
        H_DL = wing_frame(azimuth, g, d1, d2)
        H_CL = H_CD @ H_DL
        setting = {"azimuth_deg": float(np.degrees(azimuth)), "joint_angle_deg": float(np.degrees(g)), "d1_m": float(d1), "d2_m": float(d2)}
    leds, exponent = (light.leds or 1, DOME_EXPONENT) if panel is None else (light.leds or 19, recipe.led_exponent)
    blob = Blob(leds, recipe.dome_radius_m, exponent, recipe.led_tilt_rad, recipe.led_power)
    position_L, axis_L, power = build_blob(blob, intensity, rng)
    bare = LedLight(
        name, H_CL, se3.apply(H_CL, position_L), se3.rotate(H_CL, axis_L), power, exponent, intensity, np.zeros(3), H_DL, setting
    )
    field = bare.field(points_C)
    source_C = apparent_source(points_C, field / np.linalg.norm(field, axis=1, keepdims=True))
    return LedLight(name, H_CL, bare.position_C, bare.axis_C, power, exponent, intensity, source_C, H_DL, setting)


def wing_frame(azimuth_rad: float, joint_angle_rad: float, d1_m: float, d2_m: float) -> Array:
    """H_DL (4, 4): the blob at Rz(azimuth) [d1 + d2 cos g, 0, d2 sin g], its z axis along Rz(azimuth) [-sin g, 0, cos g]."""
    ca, sa, cg, sg = np.cos(azimuth_rad), np.sin(azimuth_rad), np.cos(joint_angle_rad), np.sin(joint_angle_rad)
    Rz = np.array([[ca, -sa, 0], [sa, ca, 0], [0, 0, 1]])
    x, y, z = Rz @ [cg, 0, sg], Rz @ [0, 1, 0], Rz @ [-sg, 0, cg]
    return se3.transform(np.stack([x, y, z], axis=1), Rz @ [d1_m + d2_m * cg, 0, d2_m * sg])
