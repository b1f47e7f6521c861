"""What the rig's sensor does to light: from camera.yaml where there is one, else from panel.yaml's camera section."""

from __future__ import annotations

from pathlib import Path

from lpcal.detect.linearity import fit_sweep, refuse_contradiction
from lpcal.detect.radiometry import Sensor, fit_flat_field
from lpcal.formats.capture import read_sweep
from lpcal.formats.images import read_image
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Camera


def sensor_of_camera(camera: Camera | None) -> Sensor:
    """The sensor as a calibration states it."""
    return Sensor() if camera is None else Sensor(camera.black_level, camera.white_level, camera.gamma, camera.flat_field)


def sensor_of_panel(workspace: Workspace) -> Sensor:
    """The sensor as panel.yaml states it, its flat field fitted to the image that it names."""
    section = workspace.rig_file.rig.camera
    if section is None:
        return Sensor()
    levels = Sensor(section.black_level, section.white_level, section.gamma)
    path = flat_field_path(workspace)
    return (
        levels
        if path is None
        else Sensor(section.black_level, section.white_level, section.gamma, fit_flat_field(read_image(path).pixels, levels))
    )


def sweep_path(workspace: Workspace) -> Path | None:
    """The folder of the exposure sweep that panel.yaml names."""
    section = workspace.rig_file.rig.camera
    named = section.exposure_sweep if section is not None else None
    return workspace.path(named, "camera.exposure_sweep") if named else None


def check_sweep(workspace: Workspace, sensor: Sensor) -> dict[str, float] | None:
    """Hold the sensor as stated against the exposure sweep; what the sweep says, None where there is none.

    Raises
    ------
    DisagreementError
        Another gamma or black level, a tone curve, or auto-exposure.
    """
    folder = sweep_path(workspace)
    if folder is None:
        return None
    images, exposure_s, step = read_sweep(folder)
    found = fit_sweep(images, exposure_s, sensor, step)
    refuse_contradiction(found, sensor)
    read, shot = found.noise
    return {"black_level": found.black_level, "gamma": found.gamma, "misfit": found.misfit, "noise_read": read, "noise_shot": shot}


def flat_field_path(workspace: Workspace) -> Path | None:
    """The flat-field image that panel.yaml names."""
    section = workspace.rig_file.rig.camera
    return workspace.path(section.flat_field, "camera.flat_field") if section is not None and section.flat_field else None


def has_lens(workspace: Workspace) -> bool:
    """Whether the rig has a camera model to solve or to read; without one its images are orthographic."""
    section = workspace.rig_file.rig.camera
    return section is not None and bool(section.images or section.cameramodel)
