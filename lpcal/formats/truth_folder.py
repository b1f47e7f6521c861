"""``truth/`` beside a simulated rig: what a calibration of it should find. Written only; nothing of lpcal reads it but its demo.

camera.yaml, handeye.yaml, lights.yaml, spheres.yaml, objects.yaml, H_OP.csv and H_CB.csv (a pose an image), leds.npz, points.csv,
field.csv, objects/NAME.npz. Metres and radians unless a key says otherwise; transforms H_AB take B to A.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from lpcal.formats.documents import plain
from lpcal.formats.outputs import write_text
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index

README = """# Truth of a simulated rig

Frames and transform names as in lpcal's README; metres, radians unless the key says otherwise.

    camera.yaml      image_size, model, K, distortion (k1 k2 p1 p2 k3), black_level_percent, gamma, noise, vignetting
    handeye.yaml     H_PC, H_PD, H_DC, H_OB, clock_offset_s (t_camera = t_mocap + offset), bad_stations, marker_in_P_m, board
    H_OP.csv         image,t_camera_s,x,y,z,qx,qy,qz,qw      true panel pose at every board image
    H_CB.csv         image,x,y,z,qx,qy,qz,qw                 true board pose of every board image
    lights.yaml      H_CL, H_DL, setting as really built, intensity (relative), lit (LEDs), source_m
    leds.npz         NAME_position (n,3), NAME_axis (n,3), NAME_power (n,) in C, exponent: power max(cos,0)^exponent / r^2 summed
    points.csv       points of the working volume, in C
    field.csv        light,x_m,y_m,z_m,dx,dy,dz,irradiance at them
    distance_sensor.yaml  position_C, direction_C (of the beam, m), bias_m, scale, noise_m: reading = bias + scale t + noise
    spheres.yaml     kind, centre_m (C), radius_m
    objects/NAME.npz normals, depth, albedo (the reflectance, 0 to 1), mask, component a pixel
    objects.yaml     material, note
"""


def write_yaml(path: Path, body: Any) -> None:
    """A plain YAML file."""
    write_text(path, yaml.safe_dump(plain(body), sort_keys=False, width=140, default_flow_style=None))


def write_poses(path: Path, images: Sequence[str], H_AB: Array, t_s: Array | None = None) -> None:
    """A pose an image: image[,t_camera_s],x,y,z,qx,qy,qz,qw."""
    q = se3.quaternion(H_AB[:, :3, :3])
    lines = ["image," + ("t_camera_s," if t_s is not None else "") + "x,y,z,qx,qy,qz,qw"]
    for k, image in enumerate(images):
        time = f"{t_s[k]:.6f}," if t_s is not None else ""
        lines.append(f"{image},{time}" + ",".join(f"{value:.9f}" for value in (*H_AB[k, :3, 3], *q[k])))
    write_text(path, "\n".join(lines) + "\n")


def write_field(folder: Path, points_C: Array, fields: Mapping[str, Array]) -> None:
    """points.csv and field.csv of irradiance vectors (N, 3) by light."""
    write_text(folder / "points.csv", "x_m,y_m,z_m\n" + "".join(f"{x:.6f},{y:.6f},{z:.6f}\n" for x, y, z in points_C))
    lines = ["light,x_m,y_m,z_m,dx,dy,dz,irradiance"]
    for name, E in fields.items():
        size = np.linalg.norm(E, axis=1)
        d = E / size[:, None]
        lines += [
            f"{name},{x[0]:.6f},{x[1]:.6f},{x[2]:.6f},{u[0]:.8f},{u[1]:.8f},{u[2]:.8f},{e:.8g}"
            for x, u, e in zip(points_C, d, size, strict=True)
        ]
    write_text(folder / "field.csv", "\n".join(lines) + "\n")


def write_leds(path: Path, lights: Mapping[str, tuple[Array, Array, Array]], exponent: float) -> None:
    """leds.npz of (position, axis, power) by light."""
    arrays = {
        f"{name}_{part}": value
        for name, values in lights.items()
        for part, value in zip(("position", "axis", "power"), values, strict=True)
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savez(path, allow_pickle=False, exponent=np.array(exponent), **arrays)


def write_surface(path: Path, arrays: Mapping[str, Array]) -> None:
    """objects/NAME.npz of the maps, at single precision."""
    path.parent.mkdir(parents=True, exist_ok=True)
    single = {name: np.asarray(value, np.float32) if np.issubdtype(value.dtype, np.floating) else value for name, value in arrays.items()}
    np.savez_compressed(path, allow_pickle=False, **single)


def write_solid(path: Path, vertices: Array, normals: Array, faces: Index) -> None:
    """A mesh (V, 3), (V, 3), (F, 3) as PLY, in metres, at double precision: a room is large, what is compared with it is not."""
    import trimesh

    path.parent.mkdir(parents=True, exist_ok=True)
    mesh = trimesh.Trimesh(vertices=vertices, faces=faces, vertex_normals=normals, process=False)
    path.write_bytes(mesh.export(file_type="ply", vertex_normal=True))
