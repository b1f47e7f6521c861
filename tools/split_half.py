"""Whether the hand-eye covariance is honest on real data: ``python tools/split_half.py RIG [SPLITS]`` solves halves of the views apart.

Halves are made of stretches of views next to each other, each stretch to one half by lot, so that errors that neighbours share do not
hide in both. Printed: sqrt of the mean over splits of ``d^T (C_a + C_b)^-1 d / 6``, d the difference of both H_PC, which is 1 where the
covariances are honest; and the rms differences against what the covariances expect.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import HandEyeOptions, solve_moving, solve_paired
from lpcal.errors import LpcalError
from lpcal.formats.panel_yaml import read_rig
from lpcal.geometry import se3
from lpcal.pipeline.handeye_inputs import HandEyeInputs, gather
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import HandEye

STRETCHES = 14


def solved(given: HandEyeInputs, rows: np.ndarray) -> HandEye:
    """The hand-eye of some of the views."""
    boards = given.boards.of(rows)
    if given.stream is not None:
        return solve_moving(boards, track_of(given.stream), given.camera, HandEyeOptions(camera_share=given.camera_share)).handeye
    return solve_paired(boards, given.H_OP[rows], given.camera, HandEyeOptions(camera_share=given.camera_share)).handeye


def main() -> None:
    """All splits."""
    splits = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    path = Path(sys.argv[1])
    workspace = Workspace(read_rig(path / "panel.yaml" if path.is_dir() else path))
    given = gather(workspace, lambda *_: None)
    whole = solved(given, np.arange(len(given.boards.images)))
    used = np.flatnonzero([view.used for view in whole.views])
    stretch = np.arange(len(used)) * STRETCHES // len(used)
    found = []
    for seed in range(splits):
        half = np.random.default_rng(seed).permutation(np.arange(STRETCHES) % 2)[stretch] == 0
        try:
            a, b = (solved(given, used[side]) for side in (half, ~half))
        except LpcalError as error:
            print(f"   split {seed}: {error.found}")
            continue
        d = se3.log(a.H_PC @ se3.inv(b.H_PC))
        d[3:] = a.H_PC[:3, 3] - b.H_PC[:3, 3]
        T = np.eye(6)
        T[3:, :3] = -se3.hat(a.H_PC[:3, 3])
        C = T @ (a.H_PC_covariance + b.H_PC_covariance) @ T.T
        found.append([d @ np.linalg.solve(C, d) / 6, np.sum(d[:3] ** 2), np.sum(d[3:] ** 2), np.trace(C[:3, :3]), np.trace(C[3:, 3:])])
    ratio, turn, shift, expected_turn, expected_shift = np.sqrt(np.mean(found, axis=0))
    print(
        f"{path}: {len(used)} views, {len(found)} splits: spread over covariance {ratio:.2f}; halves differ by {np.degrees(turn):.3f} deg "
        f"(expected {np.degrees(expected_turn):.3f}), {1e3 * shift:.2f} mm (expected {1e3 * expected_shift:.2f})"
    )


if __name__ == "__main__":
    main()
