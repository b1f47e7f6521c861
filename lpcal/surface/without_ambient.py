"""A capture without an ambient image: the room's light is estimated, taken away, and counted as doubt.

The wall's room light first, so that the mask can be found; then the object's, at the working distance and again at the depth that this
gave. A last time with more of it shows how far normals, depth and distance hang on it: that is added to their standard deviations.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Calibration, Light
from lpcal.records.figures import AmbientFound
from lpcal.records.observations import Radiance
from lpcal.records.surface import Surface
from lpcal.surface import mask, room_light, sight
from lpcal.surface.room_light import PATCHY, Room

type Solve = Callable[[Radiance, Mask | None], Surface]
"""The surface of images without room light; a mask is kept, None leaves it to be found."""
ROUNDS = 2
UNDECIDED = "no ambient image, and the images show no light beside that of the lamps: none is taken away"


def reconstruct(
    radiance: Radiance,
    calibration: Calibration,
    given: Mask | None,
    focus_C: Array | None,
    begin_m: float,
    solve: Solve,
    hints: mask.Hints = mask.NO_HINTS,
) -> Surface:
    """The surface of a capture whose images hold an unknown room light.

    `given` is the user's mask; where `focus_C` is given all lights act as they do there; `begin_m` is where the object may be.
    """
    lights, near = sight.lights_of(calibration, radiance), focus_C is None
    maps, rays_C = sight.grey(radiance, lights), sight.ray_map(radiance.signal.shape[1:3], calibration.camera)
    wall = room_light.wall_of(maps, rays_C, lights, begin_m) if near else None
    room_map = np.zeros(maps.signal.shape[1:], np.float32) if wall is None else room_light.on_wall(wall, maps, rays_C, lights)
    object_mask = given
    if object_mask is None:
        lamps = sight.grey(without(radiance, room_map, lights), lights)
        object_mask = mask.automatic(lamps, rays_C, lights, begin_m if near else None, hints).mask
    depth = np.full(int(object_mask.sum()), begin_m if calibration.camera is not None else 1.0)
    surface, room = None, None
    rounds = ROUNDS if near else 1
    for k in range(rounds):
        seen = sight.look_at(maps, rays_C, object_mask, central=calibration.camera is not None)
        found = room_light.on_object(seen, lights, depth, wall, focus_C) if seen.pixels >= room_light.FEWEST else None
        if found is None:
            break
        room, room_map[object_mask] = found
        surface = solve(without(radiance, room_map, lights), given if k == rounds - 1 else object_mask)
        object_mask, depth = surface.mask, surface.depth[surface.mask].astype(float)
    del maps, seen  # the solves below hold their own
    if surface is None or room is None:
        plain = solve(radiance, given)
        return replace(plain, figures=replace(plain.figures, ambient=AmbientFound(estimated=False, note=UNDECIDED)))
    more = np.where(surface.mask, (1 + PATCHY) * room_map, room_map)
    return doubted(surface, solve(without(radiance, more, lights), surface.mask), room, float(_share(radiance, room_map, surface.mask)))


def without(radiance: Radiance, room_map: Image, lights: tuple[Light, ...]) -> Radiance:
    """The radiance with room light (H, W) taken away; of colours each in proportion to what the lamps bring back."""
    if radiance.signal.ndim == 3:
        ambient = np.asarray(room_map, np.float32)
    else:
        middle = np.median(radiance.signal, axis=0)
        grey = np.median(sight.grey(radiance, lights).signal, axis=0)
        ambient = np.asarray(room_map[..., None] * np.clip(middle / np.maximum(grey, 1e-12)[..., None], 0, 3), np.float32)
    return replace(radiance, signal=radiance.signal - ambient, ambient=ambient)


def doubted(surface: Surface, other: Surface, room: Room, share: float) -> Surface:
    """The surface with what PATCHY more of room light changes (`other`) added to its standard deviations."""
    both = surface.mask & other.mask
    turned = np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(surface.normals - other.normals, axis=-1) / 2, 0, 1))) / np.sqrt(2)
    normal_std = np.where(both, np.hypot(surface.normal_std_deg, np.nan_to_num(turned)), surface.normal_std_deg)
    central = bool(surface.rays_C[..., :2].any())
    depth_std, components = surface.depth_std.copy(), []
    anchored = surface.figures.shadow_anchors or {}
    for piece in surface.components:
        inside = both & (surface.component == piece.label)
        if not inside.any():
            components.append(piece)
            continue
        change = np.log(other.depth[inside] / surface.depth[inside]) if central else other.depth[inside] - surface.depth[inside]
        whole = float(np.median(change))
        scale = surface.depth[inside] if central else 1.0
        depth_std[inside] = np.hypot(depth_std[inside], np.abs(change - whole) * scale)
        held = not central or piece.label in anchored
        scale_std = piece.scale_std if held else float(np.hypot(piece.scale_std, whole * room.std / PATCHY))
        components.append(replace(piece, scale_std=scale_std))
    law = tuple(room.c.round(4).tolist())
    ambient = AmbientFound(estimated=True, share_of_signal=round(share, 3), relative_std=round(room.std, 3), law=law)
    return replace(
        surface,
        normal_std_deg=np.asarray(normal_std, np.float32),
        depth_std=np.asarray(depth_std, np.float32),
        components=tuple(components),
        figures=replace(surface.figures, ambient=ambient),
    )


def _share(radiance: Radiance, room_map: Image, inside: Mask) -> float:
    """Median share of the room's light in the images."""
    signal = radiance.signal if radiance.signal.ndim == 3 else radiance.signal.mean(axis=-1)
    return float(np.median(room_map[inside] / np.maximum(signal.mean(axis=0)[inside], 1e-12)))
