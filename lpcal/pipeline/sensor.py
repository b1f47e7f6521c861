"""What the rig's sensor does to light: from camera.yaml where there is one, else from panel.yaml's camera section."""

from __future__ import annotations

from pathlib import Path

from lpcal.detect.radiometry import Sensor, fit_flat_field
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


def flat_field_path(workspace: Workspace) -> Path | None:
    """The flat-field image that panel.yaml names."""
    section = workspace.rig_file.rig.camera
    return workspace.path(section.flat_field, "camera.flat_field") if section is not None and section.flat_field else None


def has_lens(workspace: Workspace) -> bool:
    """Whether the rig has a camera model to solve or to read; without one its images are orthographic."""
    section = workspace.rig_file.rig.camera
    return section is not None and bool(section.images or section.cameramodel)
