"""Fusing hundreds of views of something large, by tiles of space.

``python tools/bench_many_views.py [VIEWS] [--size WxH] [--jobs N] [--on ENGINE]``. A carved wall, some metres long, under views that each
see a third of a metre of it: surfaces are made directly, with the errors of reconstructions (a scale of each, a slow bending, normals
off by a degree, poses off by a tracker's noise, one H_PC error and one scale for all). Prints processor time and peak memory of the
fusion, and how far the model is from the wall, compared with the single surfaces.
"""

from __future__ import annotations

import argparse
import json
import resource
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from scipy.ndimage import gaussian_filter

import lpcal
from lpcal.api.engines import engine_of
from lpcal.fusion.align import SHARED_SCALE_STD
from lpcal.geometry import se3
from lpcal.records.placement import Placement
from lpcal.records.surface import Component, Surface

DISTANCE_M, FOCAL_SHARE, OVERLAP = 0.35, 1.06, 0.5
SCALE_STD, BEND_STD = 0.005, 0.0008
H_PC_STD = np.array([np.radians(0.015)] * 3 + [0.00015] * 3)
NOISE = np.radians(0.03), 0.00015
"""Of the tracker: radians, metres, an axis."""
WAVES = np.random.default_rng(1).normal(size=(14, 2)) * np.array(
    [[40.0], [40], [60], [60], [80], [80], [100], [100], [140], [140], [180], [180], [220], [220]]
)
"""(K, 2) of the carving, 1 / m."""
HEIGHTS_M = 0.25 / np.linalg.norm(WAVES, axis=1).clip(20) / np.sqrt(len(WAVES)) * 2


def height(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Height z (N,) of the wall at (N, 2), and its slopes (N, 2)."""
    phase = x @ WAVES.T
    return np.sin(phase) @ HEIGHTS_M, (np.cos(phase) * HEIGHTS_M) @ WAVES


def views(count: int, size: tuple[int, int], seed: int = 2) -> Iterator[Surface]:
    """The surfaces of views in rows along the wall, turned by some degrees each."""
    rng = np.random.default_rng(seed)
    step = DISTANCE_M / FOCAL_SHARE * (1 - OVERLAP) * np.array([1, size[1] / size[0]])
    rows = max(int(np.sqrt(count / 4)), 1)
    columns = -(-count // rows)
    off, grown = H_PC_STD * rng.standard_normal(6), rng.normal(0, SHARED_SCALE_STD)
    for k in range(count):
        at = np.array([k % columns, k // columns]) * step
        turn = np.array([*rng.normal(0, 0.18, 2), rng.normal(0, 0.05)])
        R = se3.rotation(turn)
        H_OC = se3.transform(R, np.array([*at, 0.0]) - DISTANCE_M * R[:, 2])
        yield seen(f"view_{k:03d}", H_OC, placed(H_OC, off, rng), size, grown, np.random.default_rng([seed + 1, k]))


def placed(H_OC: np.ndarray, off: np.ndarray, rng: np.random.Generator) -> Placement:
    """A placement with the tracker's noise and the error of H_PC, here of a panel in the camera's frame."""
    T = np.linalg.inv(se3.turn_and_origin_jacobian(H_OC))
    noise = T @ np.diag([NOISE[0] ** 2] * 3 + [NOISE[1] ** 2] * 3) @ T.T
    by = se3.adjoint(H_OC)
    xi = np.linalg.cholesky(noise) @ rng.standard_normal(6) + by @ off
    return Placement(se3.exp(-xi) @ H_OC, noise + by @ np.diag(H_PC_STD**2) @ by.T, noise_covariance=noise, by_handeye=by)


def seen(name: str, H_OC: np.ndarray, placement: Placement, size: tuple[int, int], grown: float, rng: np.random.Generator) -> Surface:
    """What a view shows of the wall."""
    width, rows = size
    row, column = np.indices((rows, width), dtype=float)
    focal = FOCAL_SHARE * width
    rays = np.stack([(column - (width - 1) / 2) / focal, (row - (rows - 1) / 2) / focal, np.ones_like(row)], axis=-1)
    d_O, o_O = se3.rotate(H_OC, rays.reshape(-1, 3)), H_OC[:3, 3]
    depth = -o_O[2] / d_O[:, 2]
    for _ in range(8):
        x_O = o_O + depth[:, None] * d_O
        z, slope = height(x_O[:, :2])
        depth = depth + (z - x_O[:, 2]) / (d_O[:, 2] - np.einsum("ij,ij->i", slope, d_O[:, :2]))
    x_O = o_O + depth[:, None] * d_O
    z, slope = height(x_O[:, :2])
    n_O = np.column_stack([slope, -np.ones(len(slope))])
    n_C = se3.rotate(se3.inv(H_OC), n_O / np.linalg.norm(n_O, axis=1, keepdims=True))
    mask = (np.abs(x_O[:, 2] - z) < 1e-5).reshape(rows, width)
    breaks = np.zeros((2, rows, width), bool)
    breaks[0, :, :-1], breaks[1, :-1] = mask[:, :-1] != mask[:, 1:], mask[:-1] != mask[1:]
    breaks[0, :, -1], breaks[1, -1] = True, True
    albedo = 0.6 + 0.1 * np.sin(300 * x_O[:, 0]).reshape(mask.shape)
    return reconstructed(name, rays, (depth.reshape(mask.shape), n_C.reshape(rays.shape), albedo, mask, breaks), placement, grown, rng)


type Maps = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""True depth (H, W), normals in C (H, W, 3), albedo (H, W), mask (H, W) and breaks (2, H, W)."""


def reconstructed(name: str, rays: np.ndarray, maps: Maps, placement: Placement, grown: float, rng: np.random.Generator) -> Surface:
    """A surface with the errors of a reconstruction; `grown` is the log of a scale that all views share."""
    depth, n_C, albedo, mask, breaks = maps
    smooth = [gaussian_filter(rng.standard_normal(mask.shape), s, mode="wrap") for s in (mask.shape[1] / 8, 4, 4, 4)]
    smooth = [one / one.std() for one in smooth]
    scale = np.exp(grown + rng.normal(0, SCALE_STD) + BEND_STD * smooth[0] + 5e-5 * rng.standard_normal(mask.shape))
    normals = n_C + np.radians(0.8) * np.stack(smooth[1:], axis=-1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    single, nan = np.float32, np.float32(np.nan)
    where = lambda values: np.where(mask, values, nan).astype(single)  # noqa: E731
    return Surface(
        name=name,
        normals=np.where(mask[..., None], normals, nan).astype(single),
        depth=where(depth * scale),
        albedo=where(albedo),
        mask=mask,
        normal_std_deg=where(np.ones(mask.shape)),
        depth_std=where(np.full(mask.shape, BEND_STD * DISTANCE_M)),
        lights_used=np.where(mask, 6, 0).astype(np.uint8),
        component=mask.astype(np.uint8),
        rays_C=rays,
        components=(Component(1, int(mask.sum()), float(np.median(depth[mask])), SCALE_STD),),
        breaks=breaks,
        placement=placement,
    )


def off_m(x_O: np.ndarray) -> np.ndarray:
    """How far points (N, 3) are from the wall."""
    z, slope = height(x_O[:, :2])
    return (z - x_O[:, 2]) / np.sqrt(1 + (slope**2).sum(axis=1))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int, nargs="?", default=200)
    parser.add_argument("--size", default="376x240")
    parser.add_argument("--seed", type=int, default=2)
    parser.add_argument("--jobs", type=int)
    parser.add_argument("--on")
    options = parser.parse_args()
    width, rows = (int(n) for n in options.size.split("x"))
    single: list[float] = []

    def made() -> Iterator[Surface]:
        for surface in views(options.count, (width, rows), options.seed):
            points = (surface.rays_C * surface.depth[..., None])[surface.mask].astype(float)
            single.append(float(np.sqrt(np.mean(off_m(se3.apply(surface.placement.H_AC, points)) ** 2))))
            yield surface

    engine = engine_of(options.on or "processes", options.jobs, Path()) if options.on or options.jobs else None
    begun, clock, said = time.process_time(), time.perf_counter(), {}

    def progress(what: str, done: int, of: int) -> None:  # noqa: ARG001
        said[what] = round(time.process_time() - begun, 1)

    model = lpcal.fuse(made(), engine=engine, progress=progress)
    off = off_m(model.vertices_A)
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(
        json.dumps(
            {
                "views": len(model.views),
                "used": sum(view.used for view in model.views),
                "vertices": len(off),
                "area_m2": model.figures.area_m2,
                "processor_s": time.process_time() - begun + children.ru_utime + children.ru_stime,
                "clock_s": time.perf_counter() - clock,
                "until_s": said,
                "peak_gb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6,
                "worker_peak_gb": children.ru_maxrss / 1e6,
                "step_mm": 1e3 * model.figures.step_m,
                "rms_mm": 1e3 * float(np.sqrt(np.mean(off**2))),
                "single_rms_mm": 1e3 * float(np.median(single)),
                "within_2_sigma_percent": 100 * float(np.mean(np.abs(off) < 2 * model.sigma_m)),
                "sigma_mm": 1e3 * float(np.median(model.sigma_m)),
            },
            indent=1,
        )
    )


if __name__ == "__main__":
    main()
