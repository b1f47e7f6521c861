"""wings.yaml: every light as designed, and the frame and tolerances it comes from.

``lights`` in the panel's order: ``name, setting (azimuth_deg, joint_angle_deg, d1_m, d2_m), leds, H_DL, H_CL, position_std_m,
axis_std_deg``; ``covariance`` (6L, 6L) joint over the lights, rotation then translation each.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.document_numbers import covariance, number, numbers, rigid
from lpcal.formats.documents import read_record, write_document
from lpcal.records.calibration import Wing, Wings
from lpcal.records.provenance import Provenance

KIND = "wings"


def write_wings(path: Path, wings: Wings, provenance: Provenance) -> None:
    """Write wings.yaml."""
    body: dict[str, Any] = {
        "d_object_m": wings.d_object_m,
        "H_CD": wings.H_CD,
        "H_CD_covariance": wings.H_CD_covariance,
        "H_CD_from": wings.source_of_H_CD,
        "setting_std": {
            "azimuth_deg": np.degrees(wings.setting_sigma[0]),
            "joint_angle_deg": np.degrees(wings.setting_sigma[1]),
            "d1_m": wings.setting_sigma[2],
            "d2_m": wings.setting_sigma[3],
        },
        "lights": [_light(wings, k) for k in range(len(wings.wings))],
        "covariance": wings.covariance,
    }
    write_document(path, KIND, body, provenance)


def read_wings(path: Path) -> Wings:
    """Read wings.yaml.

    Raises
    ------
    InputError
        Not there, cut off, of another kind, or garbled.
    """
    return read_record(path, KIND, "lpcal wings", wings_from_document)


def wings_from_document(document: dict[str, Any]) -> Wings:
    """The lights as designed, as written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else; the message is the key's name.
    """
    lights, std = document["lights"], document["setting_std"]
    return Wings(
        wings=tuple(
            Wing(
                light["name"],
                float(np.radians(numbers(light["setting"], "azimuth_deg"))),
                _joint_angle(light["setting"]),
                float(numbers(light["setting"], "d1_m")),
                float(numbers(light["setting"], "d2_m")),
                light["leds"],
            )
            for light in lights
        ),
        H_CD=rigid(document, "H_CD"),
        H_CD_covariance=covariance(document, "H_CD_covariance", 6),
        setting_sigma=np.array(
            [*np.radians([numbers(std, "azimuth_deg"), numbers(std, "joint_angle_deg")]), numbers(std, "d1_m"), numbers(std, "d2_m")]
        ),
        H_DL=np.array([rigid(light, "H_DL") for light in lights]),
        H_CL=np.array([rigid(light, "H_CL") for light in lights]),
        covariance=covariance(document, "covariance", 6 * len(lights)),
        source_of_H_CD=document["H_CD_from"],
        d_object_m=float("inf") if (distance_m := number(document, "d_object_m")) is None else distance_m,
    )


def _joint_angle(setting: dict[str, Any]) -> float:
    angle_deg = float(numbers(setting, "joint_angle_deg"))
    if abs(angle_deg) > 90:
        raise ValueError("joint_angle_deg")
    return float(np.radians(angle_deg))


def _light(wings: Wings, k: int) -> dict[str, Any]:
    wing = wings.wings[k]
    return {
        "name": wing.name,
        "setting": {
            "azimuth_deg": np.degrees(wing.azimuth_rad),
            "joint_angle_deg": np.degrees(wing.joint_angle_rad),
            "d1_m": wing.d1_m,
            "d2_m": wing.d2_m,
        },
        "leds": wing.leds,
        "H_DL": wings.H_DL[k],
        "H_CL": wings.H_CL[k],
        "position_std_m": wings.position_std_m[k],
        "axis_std_deg": np.degrees(wings.axis_std_rad[k]),
    }
