"""What panel.yaml says of the sensor, and the exposure sweep that holds it to account."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from lpcal.api.sensor import unlike_plain
from lpcal.detect.exposures import fit_sweep, refuse_contradiction
from lpcal.detect.radiometry import fit_flat_field
from lpcal.formats.capture import read_sweep
from lpcal.formats.images import read_image
from lpcal.pipeline.workspace import Workspace
from lpcal.records.evidence import ExposureSweep
from lpcal.records.sensor import PLAIN, FlatField, Sensor, StatedSensor


def stated_in_panel(workspace: Workspace) -> StatedSensor:
    """What panel.yaml says of the sensor that is not plain, its flat field fitted to the image that it names."""
    section = workspace.rig_file.rig.camera
    if section is None:
        return StatedSensor()
    levels = Sensor(section.black_level, section.white_level, section.gamma)
    path = flat_field_path(workspace)
    return unlike_plain(levels if path is None else replace(levels, flat_field=_flat_field(path, path.stat().st_mtime_ns, levels)))


@lru_cache(maxsize=2)
def _flat_field(path: Path, changed_ns: int, levels: Sensor) -> FlatField:  # noqa: ARG001 - one that was changed is fitted again
    """The response that an image of even light shows, which is fitted once for all objects of a rig."""
    return fit_flat_field(read_image(path).pixels, levels)


def sensor_of_panel(workspace: Workspace) -> Sensor:
    """The sensor as panel.yaml states it."""
    return stated_in_panel(workspace).onto(PLAIN)


def sweep_path(workspace: Workspace) -> Path | None:
    """The folder of the exposure sweep that panel.yaml names."""
    section = workspace.rig_file.rig.camera
    named = section.exposure_sweep if section is not None else None
    return workspace.path(named, "camera.exposure_sweep") if named else None


def check_sweep(workspace: Workspace, sensor: Sensor) -> ExposureSweep | None:
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
    return ExposureSweep(black_level=found.black_level, gamma=found.gamma, misfit=found.misfit, noise_read=read, noise_shot=shot)


def flat_field_path(workspace: Workspace) -> Path | None:
    """The flat-field image that panel.yaml names."""
    section = workspace.rig_file.rig.camera
    return workspace.path(section.flat_field, "camera.flat_field") if section is not None and section.flat_field else None


def has_lens(workspace: Workspace) -> bool:
    """Whether the rig has a camera model to solve or to read; without one its images are orthographic."""
    section = workspace.rig_file.rig.camera
    return section is not None and bool(section.images or section.cameramodel)
