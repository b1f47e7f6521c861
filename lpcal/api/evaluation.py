"""A surface compared with the truth: angles of the normals, differences of the depths, and whether the surface's own sigmas hold."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lpcal.api import stacks
from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.geometry.arrays import Array, Mask
from lpcal.records import given
from lpcal.records.evaluation import Evaluation
from lpcal.records.surface import Surface

HALF = 0.5
"""Least length of a vector of the truth that counts as a normal: maps hold zeros where there is none."""


@dataclass(frozen=True)
class _Truth:
    normals_C: Array
    depth: Array | None
    mask: Mask | None


def evaluate(
    surface: Surface,
    truth: Surface | npt.ArrayLike,
    *,
    depth: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
) -> Evaluation:
    """Compare a surface with the truth.

    Parameters
    ----------
    surface : Surface
        What `reconstruct`, `integrate` or `read_surface` gives.
    truth : Surface, or ndarray (H, W, 3)
        The true surface; or true normals in C, turned towards the camera, zeros or NaN where there is none.
    depth : ndarray (H, W), optional
        The true depth along z of C, metres (pixels where the surface has no camera), where `truth` holds normals alone.
    mask : ndarray (H, W), optional
        The pixels to compare, not zero there; by default all that both hold.

    Returns
    -------
    Evaluation
        Angles of the normals in degrees, rms differences of the depths (of the shape, and with nothing scaled), the share of the masks
        that both hold, and the rms of the angles over what the surface's own sigmas predict.

    Raises
    ------
    DisagreementError
        The two are of different sizes.
    DegenerateError
        They have no pixel in common.
    InputError
        The truth is no map of normals.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> y, x = np.mgrid[-20:21, -20:21] / 40.0
    >>> n = np.stack([x, y, -np.sqrt(1 - x**2 - y**2)], axis=-1)
    >>> found = lpcal.evaluate(lpcal.integrate(n), n, depth=-40 * n[..., 2] * -1)
    >>> found.pixels, round(found.normal_mean_deg, 3)
    (1681, 0.0)
    """
    true = _truth_of(truth, depth)
    shape = surface.mask.shape
    if true.normals_C.shape != (*shape, 3):
        raise DisagreementError(f"an array of {true.normals_C.shape}", where="truth", needed=f"{(*shape, 3)}, the surface's size")
    length = np.linalg.norm(true.normals_C, axis=-1)
    both = surface.mask & np.isfinite(length) & (length > HALF) & np.isfinite(surface.normals).all(axis=-1)
    both &= True if mask is None else stacks.of_image_size(mask, shape, "mask")
    if not both.any():
        raise DegenerateError("no pixel in common", where=surface.name, needed="a surface and a truth of one object")
    n, m = surface.normals[both].astype(float), true.normals_C[both] / length[both][:, None]
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    angle = np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(n - m, axis=1) / 2, 0, 1)))
    shape_m, absolute_m, scale = _depths(surface, true.depth, both)
    angle_deg = np.full(shape, np.nan, np.float32)
    angle_deg[both] = angle
    return Evaluation(
        name=surface.name,
        pixels=int(both.sum()),
        normal_mean_deg=float(angle.mean()),
        normal_median_deg=float(np.median(angle)),
        normal_p95_deg=float(np.percentile(angle, 95)),
        depth_rms_m=shape_m,
        depth_absolute_rms_m=absolute_m,
        scale=scale,
        mask_iou=float("nan") if true.mask is None else float((surface.mask & true.mask).sum() / (surface.mask | true.mask).sum()),
        angle_deg=angle_deg,
        metric=surface.metric,
        normal_z_rms=_z_rms(angle, surface.normal_std_deg[both].astype(float)),
    )


def _truth_of(truth: Surface | npt.ArrayLike, depth: npt.ArrayLike | None) -> _Truth:
    if isinstance(truth, Surface):
        return _Truth(truth.normals.astype(float), truth.depth.astype(float), truth.mask)
    normals_C = given.numbers(truth, "truth", finite=False)
    if normals_C.ndim != 3 or normals_C.shape[2] != 3:
        raise InputError(f"an array of {normals_C.shape}", where="truth", needed="normals (H, W, 3)")
    if depth is None:
        return _Truth(normals_C, None, None)
    map_m = given.numbers(depth, "depth", finite=False)
    if map_m.shape != normals_C.shape[:2]:
        raise DisagreementError(f"an array of {map_m.shape}", where="depth", needed=f"{normals_C.shape[:2]}, as the normals")
    return _Truth(normals_C, map_m, None)


def _depths(surface: Surface, true_depth: Array | None, both: Mask) -> tuple[float, float, float]:
    """Rms difference of the shape and of the depths as they are, and the largest piece's scale."""
    if true_depth is None:
        return float("nan"), float("nan"), float("nan")
    asked = both & np.isfinite(true_depth) & np.isfinite(surface.depth)
    if not asked.any():
        return float("nan"), float("nan"), float("nan")
    z, true_z, label = surface.depth[asked].astype(float), true_depth[asked], surface.component[asked]
    moved, scale = np.empty_like(z), float("nan")
    for one in np.unique(label):
        inside = label == one
        factor = float(np.median(true_z[inside] / z[inside])) if surface.metric else float("nan")
        moved[inside] = z[inside] * factor if surface.metric else z[inside] + np.median(true_z[inside] - z[inside])
        scale = factor if one == label[np.argmax(np.bincount(label)[label])] else scale
    return float(np.sqrt(np.mean((moved - true_z) ** 2))), float(np.sqrt(np.mean((z - true_z) ** 2))), scale


def _z_rms(angle_deg: Array, sigma_deg: Array) -> float:
    """Rms of angles over their sigmas, two axes each."""
    known = np.isfinite(sigma_deg) & (sigma_deg > 0)
    return float(np.sqrt(np.mean((angle_deg[known] / sigma_deg[known]) ** 2) / 2)) if known.any() else float("nan")
