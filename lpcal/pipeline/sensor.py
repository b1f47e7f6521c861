"""What the sensor does to light: as the command, the capture, the calibration, panel.yaml or the images themselves say it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from lpcal.detect.linearity import fit_sweep, refuse_contradiction
from lpcal.detect.radiometry import Sensor, fit_flat_field, sensor_with
from lpcal.formats.capture import read_sweep
from lpcal.formats.images import read_image
from lpcal.geometry.tone_curve import worded
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Calibration, Camera
from lpcal.records.observations import RawCapture
from lpcal.records.sensor import StatedSensor

PLAIN = Sensor()
"""A linear sensor that is black at 0 and white at full scale."""


BY_CAPTURE, BY_LARGEST = "capture.yaml", "the images' largest number"
"""Who says what a capture itself says of its sensor."""
BY_COMMAND = "the command"
FOR_ONCE = (BY_COMMAND, BY_CAPTURE)
"""Who speaks of one capture alone, knowing what else is said."""


@dataclass(frozen=True)
class SensorInUse:
    """A sensor and where each thing that is not plain comes from."""

    sensor: Sensor
    said_by: dict[str, str] = field(default_factory=dict)
    """Of gamma, black_level, white_level, flat_field: who says it."""

    def document(self) -> dict[str, Any]:
        """What summary.json says, and in words what is not plain."""
        levels: dict[str, Any] = {key: getattr(self.sensor, key) for key in ("gamma", "black_level", "white_level")}
        found = [f"{text} ({who})" for key, who in self.said_by.items() if (text := self._worded(key))]
        return levels | {"flat_field": self.sensor.flat_field is not None, "said_by": self.said_by, "in_words": ", ".join(found)}

    def _worded(self, key: str) -> str:
        if key == "flat_field":
            return "flat field divided out"
        value = getattr(self.sensor, key)
        return "" if value == getattr(PLAIN, key) else _told(key, value)


def sensor_in_use(saying: Sequence[tuple[str, StatedSensor]], where: str) -> SensorInUse:
    """The sensor of what is said in several places, the first that says a thing counting.

    Raises
    ------
    DisagreementError
        Black is not below white.
    """
    stated, said_by = StatedSensor(), dict[str, str]()
    for who, one in saying:
        said_by |= {key: who for key in one.said if key not in said_by}
        stated = stated.over(one)
    return SensorInUse(sensor_with(PLAIN, stated, where), said_by)


def contradictions(saying: Sequence[tuple[str, StatedSensor]]) -> tuple[str, ...]:
    """In words, where what counts is a calibration's and panel.yaml says otherwise: one was changed after the other."""
    found = []
    for key in ("gamma", "black_level", "white_level"):
        (who, value), *others = [(name, one.said[key]) for name, one in saying if key in one.said] or [("", None)]
        found += [
            f"{other} says {_told(key, unlike)}, {who} {_told(key, value)}, which counts: if {other} is right, calibrate or import anew"
            for other, unlike in others
            if unlike != value and who not in FOR_ONCE
        ]
    return tuple(found)


def _told(key: str, value: Any) -> str:
    return f"gamma {worded(value)}" if key == "gamma" else f"{key.replace('_', ' ')} {100 * value:.4g} %"


def sensor_of_capture(raw: RawCapture, saying: Sequence[tuple[str, StatedSensor]]) -> SensorInUse:
    """The sensor of a capture by what is said of it, what counts more first, by capture.yaml's flat field and by what its numbers show.

    Raises
    ------
    DisagreementError
        Black is not below white.
    DegenerateError
        The flat field is dark or saturated.
    """
    saying = [*saying, (BY_LARGEST, StatedSensor(white_level=raw.white_level))]
    used = sensor_in_use(saying, f"{raw.name}, sensor")
    if raw.flat is None:
        return used
    flat = StatedSensor(flat_field=fit_flat_field(raw.flat, used.sensor))
    return sensor_in_use([(BY_CAPTURE, flat), *saying], f"{raw.name}, sensor")


def stated_in(calibration: Calibration) -> StatedSensor:
    """What a calibration says of the sensor: of its camera what is not plain, without one what is stated beside the lights."""
    camera = calibration.camera
    return calibration.sensor if camera is None else unlike_plain(camera)


def sensor_of_camera(camera: Camera) -> Sensor:
    """The sensor as a camera file states it."""
    return Sensor(camera.black_level, camera.white_level, camera.gamma, camera.flat_field)


def stated_in_panel(workspace: Workspace) -> StatedSensor:
    """What panel.yaml says of the sensor that is not plain, its flat field fitted to the image that it names."""
    section = workspace.rig_file.rig.camera
    if section is None:
        return StatedSensor()
    levels = Sensor(section.black_level, section.white_level, section.gamma)
    path = flat_field_path(workspace)
    return unlike_plain(levels if path is None else replace(levels, flat_field=fit_flat_field(read_image(path).pixels, levels)))


def sensor_of_panel(workspace: Workspace) -> Sensor:
    """The sensor as panel.yaml states it."""
    return replace(PLAIN, **stated_in_panel(workspace).said)


def unlike_plain(levels: Sensor | Camera) -> StatedSensor:
    """What is not plain of a sensor."""
    keys = ("gamma", "black_level", "white_level", "flat_field")
    return StatedSensor(**{key: value for key in keys if (value := getattr(levels, key)) != getattr(PLAIN, key)})


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
