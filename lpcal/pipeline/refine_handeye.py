"""What the spheres say back to the stages before: the disc in the tracked body, and with ``joint_solve`` camera and hand-eye too."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.h_pl_wings import share_correction
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.geometry import se3
from lpcal.pipeline.wings import disc_in_body, tracks_panel, wanted
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import LightsSolution
from lpcal.records.digits import fine


def with_handeye(workspace: Workspace, solution: LightsSolution) -> LightsSolution:
    """The solution with H_PD, where the panel is tracked and no markers say it; with ``joint_solve`` always, and H_PC too.

    Each has moved by its share of what H_CD has moved.
    """
    rig = workspace.rig_file.rig
    if rig.panel is None or (rig.panel.markers and not rig.joint_solve) or not (wanted(workspace) and tracks_panel(workspace)):
        return solution
    if solution.H_CD is None or solution.H_CD_covariance is None:
        return solution
    handeye = read_handeye(workspace.calib("handeye.yaml"))
    H_PD, H_PD_covariance, _ = disc_in_body(workspace, rig.panel)
    (H_PC, H_PC_covariance), (H_PD, H_PD_covariance) = share_correction(
        handeye.H_PC, handeye.H_PC_covariance, H_PD, H_PD_covariance, solution.H_CD, solution.H_CD_covariance
    )
    found = replace(solution, H_PD=H_PD, H_PD_covariance=H_PD_covariance)
    return replace(found, H_PC=H_PC, H_PC_covariance=H_PC_covariance) if rig.joint_solve else found


def summary_of_handeye(workspace: Workspace, solution: LightsSolution) -> list[str]:
    """Lines on H_PD where no markers say it, and on what the joint solve has moved."""
    lines = []
    panel = workspace.rig_file.rig.panel
    if solution.H_PD is not None and solution.H_PD_covariance is not None and panel is not None and not panel.markers:
        lines.append(f"H_PD   from the spheres: disc at {_place(solution.H_PD, solution.H_PD_covariance)} in the tracked body")
    if solution.camera is not None:
        K = solution.camera.K
        lines.append(f"joint  f {K[0, 0]:.3f}, {K[1, 1]:.3f} px  c {K[0, 2]:.3f}, {K[1, 2]:.3f} px with the spheres")
    if solution.H_PC is not None and solution.H_PC_covariance is not None:
        lines.append(f"joint  H_PC {_place(solution.H_PC, solution.H_PC_covariance)} with the spheres")
    return lines


def _place(H_AB: np.ndarray, covariance: np.ndarray) -> str:
    """Origin and turn of a transform, and how sure: the place's covariance is that of the left perturbation carried to the origin."""
    x_A = H_AB[:3, 3]
    spread_mm = 1e3 * np.linalg.norm(se3.origin_sigmas(H_AB, covariance)) / np.sqrt(3)
    turn_deg = np.degrees(np.linalg.norm(se3.log(H_AB)[:3]))
    spread_deg = np.degrees(np.sqrt(np.trace(covariance[:3, :3]) / 3))
    x, y, z = 1e3 * x_A
    return f"[{x:.2f} {y:.2f} {z:.2f}] mm +- {fine(spread_mm)}, turned {turn_deg:.3f} deg +- {fine(spread_deg, 3)}"
