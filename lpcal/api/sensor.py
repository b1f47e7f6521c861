"""Which sensor a capture is made linear by: the first of those who say a thing counts.

The command or the caller speaks before capture.yaml, that before the calibration, that before panel.yaml; the images' own largest
number comes last.
"""

from __future__ import annotations

from collections.abc import Sequence

from lpcal.detect.radiometry import fit_flat_field, sensor_with
from lpcal.records.calibration import Calibration, Camera
from lpcal.records.observations import RawCapture
from lpcal.records.sensor import PLAIN, Sensor, SensorInUse, StatedSensor, worded_value

BY_CAPTURE, BY_LARGEST = "capture.yaml", "the images' largest number"
"""Who says what a capture itself says of its sensor."""
BY_COMMAND, BY_CALLER = "the command", "the caller"
"""Who says what is said for one call alone."""
FOR_ONCE = (BY_COMMAND, BY_CALLER, BY_CAPTURE)
"""Sources that concern one capture alone, set with the others in view."""


type Statements = Sequence[tuple[str, StatedSensor]]
"""What is said of a sensor and who says it, what counts more first."""


def sensor_in_use(saying: Statements, where: str) -> SensorInUse:
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


def contradictions(saying: Statements) -> tuple[str, ...]:
    """In words, where what counts is a calibration's and panel.yaml says otherwise: one was changed after the other."""
    found = []
    for key in ("gamma", "black_level", "white_level"):
        stated = [(name, one.said[key]) for name, one in saying if key in one.said]
        if not stated:
            continue
        (who, value), *others = stated
        found += [
            f"{other} says {worded_value(key, unlike)}, {who} {worded_value(key, value)}, which counts: "
            f"if {other} is right, calibrate or import again"
            for other, unlike in others
            if unlike != value and who not in FOR_ONCE
        ]
    return tuple(found)


def sensor_of_capture(raw: RawCapture, saying: Statements) -> SensorInUse:
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


def unlike_plain(levels: Sensor | Camera) -> StatedSensor:
    """What is not plain of a sensor."""
    keys = ("gamma", "black_level", "white_level", "flat_field")
    return StatedSensor(**{key: value for key in keys if (value := getattr(levels, key)) != getattr(PLAIN, key)})
