"""calibration.yaml, the product, from whatever the stages found."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from lpcal.api.lights import assemble_calibration
from lpcal.api.tracking import tracking_of
from lpcal.chain.refine_lights import as_designed
from lpcal.errors import InputError
from lpcal.formats.calibration_yaml import KIND, write_calibration
from lpcal.formats.camera_yaml import read_camera
from lpcal.formats.distance_files import read_distance
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.formats.lights_yaml import read_lights
from lpcal.formats.wings_yaml import read_wings
from lpcal.pipeline import distance as distance_stage
from lpcal.pipeline import refine as refine_stage
from lpcal.pipeline import wings as wings_stage
from lpcal.pipeline.refine import summary_of
from lpcal.pipeline.sensor import flat_field_path, has_lens, stated_in_panel
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.calibration import NAMES, Calibration, LightsSolution
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.sensor import StatedSensor

FILE = "calibration.yaml"


def lights_known(workspace: Workspace) -> bool:
    """Whether the rig's lights can be known."""
    return refine_stage.wanted(workspace) or wings_stage.wanted(workspace)


def wanted(workspace: Workspace) -> bool:
    """Whether the rig's lights can be known, or it states none and has a camera to be placed in a tracked body or the room."""
    return lights_known(workspace) or (not workspace.rig_file.rig.lights and wings_stage.tracks_panel(workspace))


def inputs(workspace: Workspace) -> list[Path]:
    """The stages' files."""
    found = [workspace.calib("camera.yaml")] if has_lens(workspace) else []
    found += [workspace.calib("handeye.yaml")] if wings_stage.tracks_panel(workspace) else []
    flat = None if has_lens(workspace) else flat_field_path(workspace)
    found += [flat] if flat is not None else []
    found += [workspace.calib(distance_stage.FILE)] if distance_stage.wanted(workspace) else []
    if lights_known(workspace):
        found.append(workspace.calib(refine_stage.FILE if refine_stage.wanted(workspace) else wings_stage.FILE))
    return found


def settings(workspace: Workspace) -> dict[str, Any]:
    """The rig's name, its lights, and the levels of a sensor that has no lens."""
    rig = workspace.rig_file.rig
    levels = rig.camera.model_dump(include={"black_level", "white_level", "gamma"}) if rig.camera and not has_lens(workspace) else {}
    return {"name": rig.name, "lights": list(rig.lights), "levels": levels}


def run(workspace: Workspace, progress: Progress) -> Outcome:
    """Write calibration.yaml."""
    progress("export", 0, 1)
    rig = workspace.rig_file.rig
    if not wanted(workspace):
        raise InputError(
            "nothing says where the lights are",
            where=str(workspace.rig_file.file),
            needed="lights: with spheres:, or lights: with their wings' settings and panel:",
            todo="add one of them to panel.yaml",
        )
    camera = read_camera(workspace.calib("camera.yaml")) if has_lens(workspace) else None
    handeye = read_handeye(workspace.calib("handeye.yaml")) if wings_stage.tracks_panel(workspace) else None
    H_PC = None if handeye is None else handeye.H_PC
    beam = read_distance(workspace.calib(distance_stage.FILE)) if distance_stage.wanted(workspace) else None
    if not lights_known(workspace):
        alone = Calibration(rig.name, (), camera, H_PC, carries="camera" if handeye is None else handeye.carries)
        alone = replace(alone, distance_sensor=None if beam is None else beam.sensor)
        alone = alone if handeye is None else replace(alone, tracking=tracking_of(handeye))
        write_calibration(workspace.calib(FILE), alone, STAGE.provenance(workspace))
        progress("export", 1, 1)
        said = f"{workspace.relative(workspace.calib(FILE))}: {NAMES[alone.carries][0]}{' and the camera' if camera else ''}, no lights"
        return Outcome([said], {"file": str(workspace.calib(FILE))}, next_command="lpcal export --format all")
    solution = _lights(workspace)
    sensor = StatedSensor() if camera is not None else stated_in_panel(workspace)
    calibration = assemble_calibration(solution, camera, H_PC=handeye, sensor=sensor, distance_sensor=beam, name=rig.name)
    write_calibration(workspace.calib(FILE), calibration, STAGE.provenance(workspace))
    progress("export", 1, 1)
    return Outcome(
        summary=[f"{workspace.relative(workspace.calib(FILE))}: {len(solution.lights)} lights", *summary_of(solution)[1:]],
        document={"file": str(workspace.calib(FILE))},
        warnings=[] if refine_stage.wanted(workspace) else list(solution.warnings),
        next_command="lpcal reconstruct",
    )


def _lights(workspace: Workspace) -> LightsSolution:
    if refine_stage.wanted(workspace):
        return read_lights(workspace.calib(refine_stage.FILE))
    panel = workspace.rig_file.rig.panel
    wings = read_wings(workspace.calib(wings_stage.FILE))
    return as_designed(wings, list(workspace.rig_file.rig.lights), panel.tolerance.intensity if panel else 0.1)


STAGE = Stage("export", {FILE: KIND}, wanted, inputs, settings, run)
