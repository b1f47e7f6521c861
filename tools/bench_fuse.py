"""How near a model is to the truth of its simulated session.

    lpcal simulate --session 16 --object stone rig
    cd rig && lpcal run && lpcal reconstruct session/stop_* && lpcal fuse session/stop_* -o model
    python tools/bench_fuse.py rig model

Prints, of the model: rms and quantiles of the distance along the true normal, the part of the true surface that two views see and the model
has within a millimetre, angles of the normals, how many vertices lie within two of their sigmas; of the single surfaces as they were
placed: the same rms; and how far each camera is from where it was, as placed and as aligned.
"""

from __future__ import annotations

import argparse
import csv
import json
from pathlib import Path

import numpy as np
import trimesh
from scipy.spatial import cKDTree

import lpcal
from lpcal.formats.model_files import read_model
from lpcal.geometry import se3

NEAR_M = 0.001
"""How near the model must be to a place to have it, metres."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rig", type=Path)
    parser.add_argument("model", type=Path)
    options = parser.parse_args()
    truth = options.rig / "truth" / "session"
    mesh = trimesh.load(truth / "mesh.ply", process=False)
    true_O, n_O = np.asarray(mesh.vertices), np.asarray(mesh.vertex_normals)
    tree, model = cKDTree(true_O), read_model(options.model)
    cameras = {row["image"]: pose(row) for row in csv.DictReader((truth / "H_OC.csv").open(encoding="utf-8"))}
    off, normals = along(tree, true_O, n_O, model.vertices_A)
    angle = np.degrees(np.arccos(np.clip((normals * model.normals_A).sum(axis=1), -1, 1)))
    said = {
        "vertices": len(off),
        "rms_mm": 1e3 * rms(off),
        "median_mm": 1e3 * float(np.median(np.abs(off))),
        "p95_mm": 1e3 * float(np.percentile(np.abs(off), 95)),
        "mean_mm": 1e3 * float(off.mean()),
        "normals_median_deg": float(np.median(angle)),
        "within_2_sigma_percent": 100 * float(np.mean(np.abs(off) < 2 * model.sigma_m)),
    }
    surfaces = [lpcal.read_surface(Path(folder)) for folder in inputs(options.model)]
    seen, single = np.zeros(len(true_O), int), []
    for surface in surfaces:
        stored = np.load(truth / f"{surface.name}.npz")
        points = se3.apply(surface.placement.H_AC, (surface.rays_C * surface.depth[..., None])[surface.mask].astype(float))
        single.append(rms(along(tree, true_O, n_O, points)[0]))
        both = stored["mask"] & surface.mask
        there = se3.apply(cameras[surface.name], (surface.rays_C * stored["depth"][..., None])[both].astype(float))
        seen[np.unique(tree.query(there)[1])] += 1
    twice = true_O[seen >= 2]
    gap, _ = cKDTree(model.vertices_A).query(twice)
    step = model.figures.step_m
    said |= {
        "completeness_percent": 100 * float(np.mean(gap < max(NEAR_M, 1.5 * step))),
        "singles_rms_mm": [round(1e3 * one, 3) for one in single],
        "singles_median_rms_mm": 1e3 * float(np.median(single)),
        "gain": float(np.median(single)) / rms(off),
        "cameras_mm": {
            view.name: round(1e3 * float(np.linalg.norm(view.H_AC[:3, 3] - cameras[view.name][:3, 3])), 3)
            for view in model.views
            if view.used
        },
        "left_out": [view.name for view in model.views if not view.used],
        "before_mm": 1e3 * model.figures.before_m,
        "after_mm": 1e3 * model.figures.after_m,
    }
    print(json.dumps(said, indent=1))


def along(tree: cKDTree, true_O: np.ndarray, n_O: np.ndarray, x_O: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How far points are outside the true surface, and its normals there."""
    _, nearest = tree.query(x_O)
    return ((x_O - true_O[nearest]) * n_O[nearest]).sum(axis=1), n_O[nearest]


def pose(row: dict[str, str]) -> np.ndarray:
    """H_OC of a line of H_OC.csv."""
    q = np.array([float(row[key]) for key in ("qx", "qy", "qz", "qw")])
    return se3.transform(se3.rotation_from_quaternion(q), np.array([float(row[key]) for key in "xyz"]))


def inputs(model: Path) -> list[str]:
    """The surfaces that a model was made of."""
    return json.loads((model / "summary.json").read_text(encoding="utf-8"))["inputs"]


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


if __name__ == "__main__":
    main()
