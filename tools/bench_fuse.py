"""How near a model is to the truth of its simulated session.

    lpcal simulate --session 16 --object stone rig
    cd rig && lpcal run && lpcal reconstruct session/stop_* && lpcal fuse session/stop_* -o model
    python tools/bench_fuse.py rig model

Prints, of the model: rms and quantiles of the distance along the true normal, the part of the true surface that two views see and the model
has within a millimetre, angles of the normals, as it stands and once it is put where it belongs (a thin body half a millimetre off has the
normals of another place), the latter also in their sigmas, how many vertices lie within two of their sigmas, and the errors in sigmas, the
part that all vertices share apart; of the single surfaces as they were placed: the same rms, and how far their distances are off, before
and after; and how far each camera is from where it was, as placed and as aligned.
"""

from __future__ import annotations

import argparse
import csv
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
from scipy.spatial import cKDTree

import lpcal
from lpcal.formats.model_files import read_model
from lpcal.geometry import se3
from lpcal.records.model import ObjectModel
from lpcal.records.surface import Surface

NEAR_M = 0.001
"""How near the model must be to a place to have it, metres."""
AROUND = 12
"""Vertices of the true mesh through which its normals are taken: those round one and next to these."""


@dataclass(frozen=True)
class Truth:
    """What a simulated session was made of."""

    folder: Path
    vertices_O: np.ndarray
    normals_O: np.ndarray
    tree: cKDTree
    H_OC: dict[str, np.ndarray]

    @classmethod
    def of(cls, rig: Path) -> Truth:
        """The truth of a rig's session."""
        folder = rig / "truth" / "session"
        mesh = trimesh.load(folder / "mesh.ply", process=False)
        vertices_O = np.asarray(mesh.vertices)
        cameras = {row["image"]: pose(row) for row in csv.DictReader((folder / "H_OC.csv").open(encoding="utf-8"))}
        return cls(folder, vertices_O, np.asarray(mesh.vertex_normals), cKDTree(vertices_O), cameras)

    def along(self, x_O: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How far points are outside the true surface, and its normals there: linear between vertices, an edge turns by 2 degrees and more.

        Of points on a vase these normals are right to 0.08 degrees, median; means over six vertices by their distances are to 0.18.
        """
        gap_m, near = self.tree.query(x_O, k=AROUND)
        away = (self.vertices_O[near] - x_O[:, None]) / gap_m[:, -1:, None]
        normals = self.normals_O[near]
        weight = np.exp(-2 * (away**2).sum(axis=2)) * ((normals * normals[:, :1]).sum(axis=2) > 0.5)
        flat = away - (away * normals[:, :1]).sum(axis=2, keepdims=True) * normals[:, :1]
        A = np.concatenate([np.ones_like(away[..., :1]), flat], axis=2)
        left = np.einsum("nk,nki,nkj->nij", weight, A, A) + 1e-6 * np.eye(4)
        found = np.linalg.solve(left, np.einsum("nk,nki,nkj->nij", weight, A, normals))[:, 0]
        found /= np.linalg.norm(found, axis=1, keepdims=True)
        return ((x_O - self.vertices_O[near[:, 0]]) * normals[:, 0]).sum(axis=1), found

    def maps(self, name: str) -> np.lib.npyio.NpzFile:
        """The true maps of a stop."""
        return np.load(self.folder / f"{name}.npz")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rig", type=Path)
    parser.add_argument("model", type=Path)
    options = parser.parse_args()
    truth, model = Truth.of(options.rig), read_model(options.model)
    surfaces = [lpcal.read_surface(Path(folder)) for folder in inputs(options.model)]
    said = of_model(truth, model)
    said |= of_mesh(truth, model.vertices_A, twice_seen(truth, surfaces), model.figures.step_m)
    print(json.dumps(said | of_views(truth, model, surfaces), indent=1))


def of_model(truth: Truth, model: ObjectModel) -> dict:
    """Errors of the normals, and all errors in their sigmas: what all vertices share, drawn once a session, and the rest."""
    off, normals = truth.along(model.vertices_A)
    angle = np.degrees(np.arccos(np.clip((normals * model.normals_A).sum(axis=1), -1, 1)))
    common, back_O = shared_part(model.vertices_A, normals, off)
    own = np.degrees(np.arccos(np.clip((truth.along(back_O)[1] * model.normals_A).sum(axis=1), -1, 1)))
    own_in_sigmas = own / np.degrees(model.normal_sigma_rad)
    few = model.seen_by <= 2
    return {
        "normals_median_deg": float(np.median(angle)),
        "normals_own_median_deg": float(np.median(own)),
        "normals_sigma_median_deg": float(np.degrees(np.median(model.normal_sigma_rad))),
        "normals_own_rms_in_sigmas": rms(own_in_sigmas) / np.sqrt(2),
        "normals_of_one_or_two_median_deg": float(np.median(own[few])) if few.any() else float("nan"),
        "seen_by_one_or_two_percent": 100 * float(few.mean()),
        "lone_within_2_sigma_percent": within(off, model.sigma_m, model.seen_by < 2),
        "within_2_sigma_percent": 100 * float(np.mean(np.abs(off) < 2 * model.sigma_m)),
        "sigma_median_mm": 1e3 * float(np.median(model.sigma_m)),
        "rms_in_sigmas": rms(off / model.sigma_m),
        "shared_rms_mm": 1e3 * rms(common),
        "shared_sigma_mm": 1e3 * model.figures.shared_sigma_m,
        "own_rms_mm": 1e3 * rms(off - common),
        "own_median_mm": 1e3 * float(np.median(np.abs(off - common))),
        "left_out": [view.name for view in model.views if not view.used],
        "before_mm": 1e3 * model.figures.before_m,
        "after_mm": 1e3 * model.figures.after_m,
    }


def of_mesh(truth: Truth, x_O: np.ndarray, twice_O: np.ndarray, step_m: float = NEAR_M) -> dict:
    """Errors of points (N, 3), and how much of what two views see (M, 3) they have."""
    off, _ = truth.along(x_O)
    gap, _ = cKDTree(x_O).query(twice_O)
    return {
        "vertices": len(off),
        "rms_mm": 1e3 * rms(off),
        "median_mm": 1e3 * float(np.median(np.abs(off))),
        "p95_mm": 1e3 * float(np.percentile(np.abs(off), 95)),
        "mean_mm": 1e3 * float(off.mean()),
        "completeness_percent": 100 * float(np.mean(gap < max(NEAR_M, 1.5 * step_m))),
    }


def of_views(truth: Truth, model: ObjectModel, surfaces: list[Surface]) -> dict:
    """The single surfaces as placed, and what became of their distances and cameras."""
    single, before, after = [], [], []
    for surface, view in zip(surfaces, model.views, strict=True):
        points = se3.apply(surface.placement.H_AC, (surface.rays_C * surface.depth[..., None])[surface.mask].astype(float))
        single.append(rms(truth.along(points)[0]))
        stored = truth.maps(surface.name)
        both = stored["mask"] & surface.mask
        off = surface.depth[both].astype(float) - stored["depth"][both]
        before.append(float(np.median(off)))
        after.append(before[-1] + (view.distance_change_m or 0.0))
    used = [k for k, view in enumerate(model.views) if view.used]
    off, _ = truth.along(model.vertices_A)
    return {
        "singles_rms_mm": [round(1e3 * one, 3) for one in single],
        "singles_median_rms_mm": 1e3 * float(np.median(single)),
        "gain": float(np.median(single)) / rms(off),
        "distances_rms_mm": 1e3 * rms(np.array(before)[used]),
        "fused_distances_rms_mm": 1e3 * rms(np.array(after)[used]),
        "cameras_mm": {
            view.name: round(1e3 * float(np.linalg.norm(view.H_AC[:3, 3] - truth.H_OC[view.name][:3, 3])), 3)
            for view in model.views
            if view.used
        },
    }


def within(off: np.ndarray, sigma_m: np.ndarray, some: np.ndarray) -> float:
    """Per cent of some errors that are within two sigmas; NaN where there are none."""
    return 100 * float(np.mean(np.abs(off[some]) < 2 * sigma_m[some])) if some.any() else float("nan")


def shared_part(x_O: np.ndarray, n_O: np.ndarray, off: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The part (N,) of errors along normals that one motion and one growth of the whole explain, and the points (N, 3) without these."""
    away = x_O - x_O.mean(axis=0)
    A = np.column_stack([n_O, np.cross(away, n_O), (away * n_O).sum(axis=1)])
    found, *_ = np.linalg.lstsq(A, off, rcond=None)
    return A @ found, x_O - found[:3] - np.cross(found[3:6], away) - found[6] * away


def twice_seen(truth: Truth, surfaces: list[Surface]) -> np.ndarray:
    """Places (M, 3) of the true surface that two surfaces at least show."""
    seen = np.zeros(len(truth.vertices_O), int)
    for surface in surfaces:
        stored = truth.maps(surface.name)
        both = stored["mask"] & surface.mask
        there = se3.apply(truth.H_OC[surface.name], (surface.rays_C * stored["depth"][..., None])[both].astype(float))
        seen[np.unique(truth.tree.query(there)[1])] += 1
    return truth.vertices_O[seen >= 2]


def pose(row: dict[str, str]) -> np.ndarray:
    """H_OC of a line of H_OC.csv."""
    q = np.array([float(row[key]) for key in ("qx", "qy", "qz", "qw")])
    return se3.transform(se3.rotation_from_quaternion(q), np.array([float(row[key]) for key in "xyz"]))


def inputs(model: Path) -> list[str]:
    """The surfaces that a model was made of."""
    return json.loads((model / "summary.json").read_text(encoding="utf-8"))["inputs"]


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.asarray(values) ** 2)))


if __name__ == "__main__":
    main()
