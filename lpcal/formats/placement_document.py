"""A placement as summary.json holds it, and what capture.yaml says of one.

``placement``: ``H_OC`` (or ``H_MC`` and ``body``, the tracked body M that the object rides on), ``covariance`` (6x6, rotation in rad then
translation in m, of the left perturbation), its parts ``noise_covariance`` (this capture's alone), ``by_handeye`` (6x6) and ``by_clock``
(6,) by which the errors of H_PC (left perturbation) and of the clock offset (s) act, which captures of one calibration share;
``position_std_m``, ``rotation_std_deg`` (3,), ``t_camera_s``, ``source``, ``notes``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.diligent_views import view_of_set
from lpcal.formats.document_numbers import covariance, number, numbers, rigid
from lpcal.formats.panel_yaml import read_capture_section
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.placement import Placement, StatedPlace
from lpcal.records.rig import CaptureSection, WrittenTransform


def placement_document(placement: Placement) -> dict[str, Any]:
    """A placement as it is written."""
    return {
        placement.name: placement.H_AC,
        "body": placement.body,
        "covariance": placement.covariance,
        "noise_covariance": placement.noise_covariance,
        "by_handeye": placement.by_handeye,
        "by_clock": placement.by_clock,
        "position_std_m": placement.position_std_m,
        "rotation_std_deg": np.degrees(placement.rotation_std_rad),
        "t_camera_s": placement.t_camera_s,
        "source": placement.source,
        "notes": list(placement.notes),
    }


def placement_from_document(document: dict[str, Any]) -> Placement:
    """A placement as it was written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else; the message is the key's name.
    """
    return Placement(
        H_AC=rigid(document, "H_MC" if "H_MC" in document else "H_OC"),
        covariance=covariance(document, "covariance", 6),
        body=None if document["body"] is None else str(document["body"]),
        noise_covariance=covariance(document, "noise_covariance", 6),
        by_handeye=numbers(document, "by_handeye", 6, 6),
        by_clock=numbers(document, "by_clock", 6),
        t_camera_s=number(document, "t_camera_s"),
        source=str(document["source"]),
        notes=tuple(str(note) for note in document["notes"]),
    )


def stated_place(section: CaptureSection, folder: Path) -> StatedPlace:
    """What the capture.yaml of a folder says of its place; where it says nothing, what the data set says of which the folder is a view.

    Raises
    ------
    InputError
        The data set's file of poses cannot be read or lacks this one.
    """
    pose = section.pose
    view = view_of_set(folder) if pose is None and section.time is None else None
    if view is not None:
        return StatedPlace(H_OC=se3.inv(view.H_CO))
    return StatedPlace(
        t_camera_s=section.time,
        H_OP=None if pose is None or pose.H_OP is None else _matrix(pose.H_OP),
        H_OC=None if pose is None or pose.H_OC is None else _matrix(pose.H_OC),
        tolerance=None if pose is None else pose.tolerance,
        body=section.body,
        recording=None if section.mocap is None else folder / section.mocap,
        clock_offset_s=section.clock_offset,
    )


def stated_place_of(capture: Path) -> StatedPlace:
    """What the capture.yaml in a folder says of its place."""
    return stated_place(read_capture_section(capture / "capture.yaml"), capture)


def _matrix(written: WrittenTransform) -> Array:
    R = (
        se3.rotation(np.array(written.rotation_vector))
        if written.rotation_vector is not None
        else se3.rotation_from_quaternion(np.array(written.quaternion))
    )
    return se3.transform(R, np.array(written.position))
