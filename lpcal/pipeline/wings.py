"""wings.yaml: every light as designed, seen from the camera."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.api.lights import AS_DRAWN, as_drawn, design_lights
from lpcal.chain.h_pd_markers import h_pd_from_markers
from lpcal.chain.h_pl_wings import behind_warning, camera_in_disc
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.formats.wings_yaml import KIND, write_wings
from lpcal.geometry.arrays import Array
from lpcal.pipeline.handeye_inputs import recording
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.calibration import Wings
from lpcal.records.digits import fine
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.rig import LightSection, PanelSection

FILE = "wings.yaml"
P_IS_D_SIGMA = (float(np.radians(3.0)), 0.005)
"""Without markers the tracked body's frame is taken for the disc's, within this (rad, m)."""


def wanted(workspace: Workspace) -> bool:
    """Whether the rig has wings."""
    rig = workspace.rig_file.rig
    return rig.panel is not None and any(light.is_wing for light in rig.lights.values())


def tracks_panel(workspace: Workspace) -> bool:
    """Whether a motion-capture system says where the panel's body is."""
    return workspace.rig_file.rig.mocap is not None


def inputs(workspace: Workspace) -> list[Path]:
    """Hand-eye, and the recording where marker tracks give H_PD."""
    if not tracks_panel(workspace):
        return []
    rig = workspace.rig_file.rig
    recording = [workspace.path(rig.mocap.file, "mocap.file")] if rig.mocap and rig.mocap.file and rig.panel and rig.panel.markers else []
    return [workspace.calib("handeye.yaml"), *recording]


def settings(workspace: Workspace) -> dict[str, Any]:
    """Panel and lights."""
    rig = workspace.rig_file.rig
    return {
        "panel": rig.panel.model_dump() if rig.panel else None,
        "lights": {name: light.model_dump() for name, light in rig.lights.items()},
    }


def run(workspace: Workspace, progress: Progress) -> Outcome:
    """Write wings.yaml."""
    panel: PanelSection = workspace.need("panel")
    lights: dict[str, LightSection] = workspace.need("lights")
    drawn = [name for name, light in lights.items() if light.is_wing]
    if not drawn:
        raise DegenerateError(
            "no light is a wing",
            where=workspace.rig_file.where("lights"),
            needed="azimuth, joint_angle, disc_spacer and blob_spacer",
            todo="state the wings' settings, or go on with lpcal refine",
        )
    progress("wings", 0, 1)
    H_CD, H_CD_covariance, source = disc_in_camera(workspace, panel)
    wings = design_lights(workspace.rig_file.rig, H_CD, H_CD_covariance=H_CD_covariance, source=source)
    write_wings(workspace.calib(FILE), wings, STAGE.provenance(workspace))
    progress("wings", 1, 1)
    return Outcome(
        summary=[f"{len(drawn)} wings; axes meet {1e3 * wings.d_object_m:.1f} mm before the disc; H_CD from {source}", *_lines(wings)],
        document={
            "file": str(workspace.calib(FILE)),
            "d_object_m": wings.d_object_m,
            "H_CL": dict(zip(drawn, wings.H_CL, strict=True)),
        },
        warnings=[behind] if (behind := behind_warning(wings)) else [],
        next_command="lpcal refine",
    )


def disc_in_camera(workspace: Workspace, panel: PanelSection) -> tuple[Array, Array, str]:
    """H_CD, its covariance, and where it comes from: hand-eye and markers, hand-eye alone, or the camera's mount as drawn."""
    mocap = workspace.rig_file.rig.mocap
    if mocap is None:
        return *as_drawn(panel), AS_DRAWN
    handeye = read_handeye(workspace.calib("handeye.yaml"))
    if handeye.carries == "board":
        raise DisagreementError(
            "the camera stands still in the room and the tracked body carries the board: no panel is tracked",
            where=str(workspace.calib("handeye.yaml")),
            needed="a camera on the tracked panel, or a rig without mocap, whose lights the spheres show in the camera's frame",
            todo="take panel: and lights: into a rig folder without mocap:",
        )
    H_PD, H_PD_covariance, source = disc_in_body(workspace, panel)
    return *camera_in_disc(handeye.H_PC, handeye.H_PC_covariance, H_PD, H_PD_covariance), f"hand-eye{source}"


def disc_in_body(workspace: Workspace, panel: PanelSection) -> tuple[Array, Array, str]:
    """H_PD, its covariance, and where it comes from: the markers' tracks, or the tracked body taken for the disc."""
    mocap = workspace.rig_file.rig.mocap
    if panel.markers and mocap is not None and mocap.file:
        H_PD, H_PD_covariance, _ = h_pd_from_markers(recording(workspace, mocap), panel.markers)
        return H_PD, H_PD_covariance, " and the markers' tracks"
    return np.eye(4), np.diag([P_IS_D_SIGMA[0] ** 2] * 3 + [P_IS_D_SIGMA[1] ** 2] * 3), ", the tracked body taken for the disc"


def _lines(wings: Wings) -> list[str]:
    lines = []
    for k, wing in enumerate(wings.wings):
        x, y, z = 1e3 * wings.H_CL[k, :3, 3]
        turn_deg = np.degrees(np.sqrt(np.trace(wings.covariance[6 * k : 6 * k + 3, 6 * k : 6 * k + 3]) / 3))
        lines.append(
            f"{wing.name:<6} g {np.degrees(wing.joint_angle_rad):5.1f} deg  at [{x:.1f} {y:.1f} {z:.1f}] mm, turned +- {fine(turn_deg)} deg"
        )
    return lines


STAGE = Stage("wings", {FILE: KIND}, wanted, inputs, settings, run)
