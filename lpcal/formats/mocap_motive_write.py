"""Motive's CSV export, version 1.23, written: one rigid body with its markers. For simulated recordings."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lpcal.formats.outputs import whole
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

TAKE = "2026-01-05 10.00.00.000 AM"


def write_motive(path: Path, body: str, t_s: Array, H_OP: Array, error_m: Array, markers_O: dict[str, Array], rate_hz: float) -> None:
    """Write poses H_OP (N, 4, 4) at t_s (N,), the mean marker error (N,) and the markers (N, 3) by name; NaN rows become empty cells."""
    head = {
        "Format Version": "1.23",
        "Take Name": "Take 2026-01-05 10.00.00 AM",
        "Take Notes": "",
        "Capture Frame Rate": f"{rate_hz:.6f}",
        "Export Frame Rate": f"{rate_hz:.6f}",
        "Capture Start Time": TAKE,
        "Capture Start Frame": "0",
        "Total Frames in Take": str(len(t_s)),
        "Total Exported Frames": str(len(t_s)),
        "Rotation Type": "Quaternion",
        "Length Units": "Meters",
        "Coordinate Space": "Global",
    }
    names = list(markers_O)
    kinds = ["Rigid Body"] * 8 + ["Rigid Body Marker"] * 4 * len(names)
    bodies = [body] * 8 + [f"{body}:{name}" for name in names for _ in range(4)]
    identities = [f'"{1:032X}"'] * 8 + [f'"{k + 2:032X}"' for k in range(len(names)) for _ in range(4)]
    quantities = ["Rotation"] * 4 + ["Position"] * 3 + ["Mean Marker Error"] + (["Position"] * 3 + ["Marker Quality"]) * len(names)
    axes = ["X", "Y", "Z", "W", "X", "Y", "Z", ""] + ["X", "Y", "Z", ""] * len(names)
    lines = [",".join(f"{key},{value}" for key, value in head.items()), ""]
    lines += [",".join(["", "", *row]) for row in (kinds, bodies, identities, quantities)]
    lines.append(",".join(["Frame", "Time (Seconds)", *axes]))
    seen = np.isfinite(error_m)
    quaternion = np.full((len(t_s), 4), np.nan)
    quaternion[seen] = se3.quaternion(H_OP[seen, :3, :3])
    quality = np.clip(1 - 40 * error_m, 0.1, 0.999)
    table = np.column_stack([quaternion, H_OP[:, :3, 3], error_m, *(column for m in markers_O.values() for column in (m, quality))])
    cells = ["%.6f"] * 8 + ["%.6f", "%.6f", "%.6f", "%.3f"] * len(names)
    form, empty = ",".join(cells), "," * (len(cells) - 1)
    for frame, (time, row) in enumerate(zip(t_s, table, strict=True)):
        lines.append(f"{frame},{time:.6f}," + (form % tuple(row) if seen[frame] else empty))
    with whole(path) as draft:
        draft.write_text("\r\n".join(lines) + "\r\n", encoding="utf-8", newline="")
