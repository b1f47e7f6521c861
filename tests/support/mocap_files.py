"""Recordings as motion-capture systems write them, of poses that a test knows."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Literal

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array


def motive(
    path: Path,
    t: Array,
    H_OP: Array,
    *,
    version: str = "1.23",
    units: str = "Meters",
    rotation: Order | Literal["Quaternion"] = "Quaternion",
    bodies: tuple[str, ...] = ("Panel",),
    lost: Collection[int] = (),
    timecode: bool = False,
) -> Path:
    """A file in the manner of Motive: header rows of the version, a mean marker error, one marker, an unlabeled one."""
    scale = {"Meters": 1.0, "Centimeters": 100.0, "Millimeters": 1000.0}[units]
    turn = ["X", "Y", "Z", "W"] if rotation == "Quaternion" else list("XYZ")
    columns = []
    for body in bodies:
        columns += [("Rigid Body", body, "Rotation", axis) for axis in turn] + [("Rigid Body", body, "Position", axis) for axis in "XYZ"]
        columns += [("Rigid Body", body, "Mean Marker Error", "")]
        columns += [("Rigid Body Marker", f"{body}:Marker1", "Position", axis) for axis in "XYZ"]
        columns += [("Rigid Body Marker", f"{body}:Marker1", "Marker Quality", "")]
    columns += [("Marker", "Unlabeled 1005", "Position", axis) for axis in "XYZ"]
    lead = ["Frame", "Time (Seconds)", *(["TimeCode"] if timecode else [])]
    new = version in {"1.24", "1.25"}
    pad = [""] * (len(lead) - 2)
    labels = [
        ["", "Type" if new else "", *pad, *(c[0] for c in columns)],
        ["", "Name" if new else "", *pad, *(c[1] for c in columns)],
        ["", "ID" if new else "", *pad, *('"ABC"' for _ in columns)],
        *([["", "Parent", *pad, *("" for _ in columns)]] if version == "1.25" else []),
        ["", "", *pad, *(c[2] for c in columns)],
        [*lead, *(c[3] for c in columns)],
    ]
    head = f"Format Version,{version},Take Name,Take 1,Capture Frame Rate,240.0,Rotation Type,{rotation},Length Units,{units}"
    rows = [head, "", *(",".join(row) for row in labels)]
    marker_P = np.array([0.08, 0.01, 0.0])
    quaternions = se3.quaternion(H_OP[:, :3, :3])
    for k in range(len(t)):
        cells = [str(k), f"{t[k]:.6f}", *(["14:47:09:09.01"] if timecode else [])]
        for _ in bodies:
            if k in lost:
                cells += [""] * (len(turn) + 8)
                continue
            numbers = quaternions[k] if rotation == "Quaternion" else euler_deg(H_OP[k, :3, :3], rotation)
            marker = H_OP[k, :3, :3] @ marker_P + H_OP[k, :3, 3]
            cells += [f"{v:.9f}" for v in (*numbers, *(scale * H_OP[k, :3, 3]), scale * 1e-4, *(scale * marker))] + ["0.999"]
        cells += ["", "", ""] if k % 2 else ["1", "2", "3"]
        rows.append(",".join(cells))
    path.write_text("\r\n".join(rows) + "\r\n")
    return path


type Order = Literal["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"]
"""Moving axes in the order in which they turn."""


def euler_deg(R: Array, order: Order) -> list[float]:
    """Angles about X, Y, Z (in this order of columns) for moving axes in the given order."""
    from scipy.spatial.transform import Rotation

    angles = dict(zip(order, Rotation.from_matrix(R).as_euler(order, degrees=True), strict=True))
    return [angles[axis] for axis in "XYZ"]
