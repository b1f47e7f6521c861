"""Whether the sigmas of a model hold, over many draws of its errors.

    python tools/fuse_seeds.py RIG [--seeds 10] [--every 2]

Of a simulated session (`lpcal simulate --session`, run and reconstructed) the true maps, poses and placements are taken, every so many
pixels, and the errors are drawn anew: of the tracker's poses, of H_PC and of a scale, which all views share, by the covariances that the
placements state; of each view's distance, bending and normals as in `bench_many_views.py`. A vertex's error has a part that all share, one
motion and one growth of the whole: seven numbers, so the share of vertices within two sigmas is in one session nearly all or half, and only
over many draws that of a normal distribution. Prints a draw a line and all together: that share; rms of all errors in their sigmas; of the
shared part its chi squared over 7 and its rms, as found and as the alignment's covariance says; of the rest the same two rms.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import lpcal
from bench_fuse import Truth, rms
from bench_many_views import reconstructed
from lpcal.fusion.align import SHARED_SCALE_STD, Aligned
from lpcal.fusion.model import shared_covariance
from lpcal.fusion.registration import registered
from lpcal.fusion.vertices import Vertices, carried, on_the_views, shared
from lpcal.fusion.views import view_of
from lpcal.fusion.volume import surface_of
from lpcal.geometry import se3
from lpcal.records.placement import Placement
from lpcal.records.surface import Surface

SAMPLES = 400
"""Vertices at which shared and own errors are told apart."""


@dataclass(frozen=True)
class Session:
    """A session's truth and what its placements state."""

    truth: Truth
    surfaces: list[Surface]
    H_PC_covariance: np.ndarray
    every: int

    @classmethod
    def of(cls, rig: Path, every: int) -> Session:
        """Of a rig's folder."""
        surfaces = [lpcal.read_surface(folder) for folder in sorted((rig / "surfaces").glob("stop_*"))]
        views = [view_of(surface, surface.placement) for surface in surfaces]
        return cls(Truth.of(rig), surfaces, shared_covariance(views), every)

    def drawn(self, seed: int) -> list[Surface]:
        """The surfaces with errors anew."""
        rng = np.random.default_rng(seed)
        e, grown = np.linalg.cholesky(self.H_PC_covariance + 1e-18 * np.eye(6)) @ rng.standard_normal(6), rng.normal(0, SHARED_SCALE_STD)
        return [self._one(surface, e, grown, rng) for surface in self.surfaces]

    def _one(self, surface: Surface, e: np.ndarray, grown: float, rng: np.random.Generator) -> Surface:
        said, stored, thin = surface.placement, self.truth.maps(surface.name), np.s_[:: self.every, :: self.every]
        noise, by = said.noise_covariance, said.by_handeye
        xi = np.linalg.cholesky(noise + 1e-18 * np.eye(6)) @ rng.standard_normal(6) + by @ e
        H_AC = se3.exp(-xi) @ self.truth.H_OC[surface.name]
        placement = Placement(H_AC, noise + by @ self.H_PC_covariance @ by.T, noise_covariance=noise, by_handeye=by)
        mask, depth, normals = stored["mask"][thin].astype(bool), stored["depth"][thin].astype(float), stored["normals"][thin].astype(float)
        rays = surface.rays_C[thin]
        maps = depth, normals, stored["albedo"][thin], mask, breaks_of(rays * depth[..., None], normals, mask)
        return reconstructed(surface.name, rays, maps, placement, grown, rng)


def breaks_of(x_C: np.ndarray, n_C: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Where a true surface (H, W, 3) breaks towards the right and below: neighbours lie off each other's tangent planes by over a pixel."""
    breaks = np.ones((2, *mask.shape), bool)
    pixel_m = float(np.nanmedian(np.abs(np.diff(x_C[..., 0], axis=1))[mask[:, 1:] & mask[:, :-1]]))
    for k, (a, b) in enumerate(((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:]))):
        step, n = x_C[b] - x_C[a], n_C[a] + n_C[b]
        off = np.abs(np.einsum("ijk,ijk->ij", step, n)) / 2
        breaks[k][a] = ~(mask[a] & mask[b] & (off < pixel_m))
    return breaks


def judged(session: Session, seed: int) -> dict[str, float]:
    """The figures of one draw."""
    views = [view_of(surface, surface.placement) for surface in session.drawn(seed)]
    aligned = registered("session", views, shared_covariance(views)).aligned
    found = on_the_views(aligned, surface_of(aligned.placed))
    off, n_O = session.truth.along(found.triangles.vertices_A)
    within, z = np.abs(off) < 2 * found.sigma_m, off / found.sigma_m
    row = {"seed": seed, "used": len(aligned.placed), "rms_mm": 1e3 * rms(off), "sigma_mm": 1e3 * float(np.median(found.sigma_m))}
    row |= {"within_2_sigma_percent": 100 * float(within.mean()), "rms_in_sigmas": rms(z), "scale_found": float(aligned.parameters[6])}
    return row | split(aligned, found, off, n_O)


def split(aligned: Aligned, found: Vertices, off: np.ndarray, n_O: np.ndarray) -> dict[str, float]:
    """Shared and own part of the errors of some vertices that two views at least see, and what the covariance says of both."""
    some = np.flatnonzero(found.views >= 2)
    some = some[:: max(len(some) // SAMPLES, 1)]
    v, n = found.triangles.vertices_A[some], n_O[some]
    covariance = carried(aligned, v, found.triangles.normals_A[some])
    Q = shared(v, n)
    inner = Q.T @ covariance @ Q
    at = Q.T @ off[some]
    rest = np.maximum(found.sigma_m[some] ** 2 - np.diag(Q @ inner @ Q.T), 0)
    return {
        "shared_chi2": float(at @ np.linalg.solve(inner, at)) / len(at),
        "shared_mm": 1e3 * rms(Q @ at),
        "shared_said_mm": 1e3 * float(np.sqrt(np.trace(inner) / len(v))),
        "own_mm": 1e3 * rms(off[some] - Q @ at),
        "own_said_mm": 1e3 * float(np.sqrt(rest.mean())),
        "own_within_2_percent": 100 * float(np.mean(np.abs(off[some] - Q @ at) < 2 * np.sqrt(np.maximum(rest, 1e-12)))),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rig", type=Path)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--every", type=int, default=2)
    options = parser.parse_args()
    session = Session.of(options.rig, options.every)
    rows = []
    for seed in range(options.seeds):
        rows.append(judged(session, seed))
        print(json.dumps({key: round(value, 3) for key, value in rows[-1].items()}), flush=True)
    mean = {key: float(np.mean([row[key] for row in rows])) for key in rows[0] if key != "seed"}
    for key in ("rms_mm", "rms_in_sigmas", "shared_mm", "shared_said_mm", "own_mm", "own_said_mm"):
        mean[key] = rms(np.array([row[key] for row in rows]))
    print(json.dumps({"all": len(rows)} | {key: round(value, 3) for key, value in mean.items()}))


if __name__ == "__main__":
    main()
