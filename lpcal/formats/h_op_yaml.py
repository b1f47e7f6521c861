"""H_OP.yaml: the tracked body at every image of ``mocap.images``.

- ``body``; ``clock_offset_s`` (t_camera = t_mocap + offset; null without clocks)
- ``views``, one an image: ``image, t_camera_s, used`` (whether the pose is to be trusted), ``why`` (null where it is), ``H_OP`` (4x4, null
  where there is none), ``steady`` (a mean over a dwell rather than an interpolation)
- ``recording``, null where the poses have no times of their own: at some moments ``t_mocap_s`` how far the body was from its median place
  (``moved_m``) and how far turned (``turned_deg``); ``lapses: [{start_s, end_s, tracked}]``, stretches without a pose to trust,
  ``tracked`` where the system gave poses there (flips, jumps), else the body was not seen
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.formats.document_numbers import number, numbers, rigid
from lpcal.formats.documents import read_record, write_document
from lpcal.geometry.arrays import Array
from lpcal.records.body_course import BodyCourse, Lapse
from lpcal.records.provenance import Provenance

KIND = "H_OP"


@dataclass(frozen=True)
class ImagePanelPoses:
    """The body's pose at each image. Row k is one image."""

    body: str
    images: tuple[str, ...]
    t_camera_s: Array | None
    H_OP: Array
    """(N, 4, 4), NaN where there is none to trust."""
    why: tuple[str | None, ...]
    steady: npt.NDArray[np.bool_]
    clock_offset_s: float | None
    course: BodyCourse | None = None
    """The body over the whole recording; None where poses came without one."""

    def by_image(self) -> dict[str, Array]:
        """The pose (4, 4) at each image that has one to trust."""
        return {image: H_OP for image, H_OP in zip(self.images, self.H_OP, strict=True) if np.isfinite(H_OP).all()}

    def times_by_image(self) -> dict[str, float]:
        """Seconds on the camera's clock of each image; none where the images have no times."""
        return {} if self.t_camera_s is None else dict(zip(self.images, self.t_camera_s.tolist(), strict=True))


def write_h_op(path: Path, poses: ImagePanelPoses, provenance: Provenance) -> None:
    """Write H_OP.yaml."""
    views = [
        {
            "image": image,
            "t_camera_s": None if poses.t_camera_s is None else float(poses.t_camera_s[k]),
            "used": poses.why[k] is None,
            "why": poses.why[k],
            "steady": bool(poses.steady[k]),
            "H_OP": poses.H_OP[k] if np.isfinite(poses.H_OP[k]).all() else None,
        }
        for k, image in enumerate(poses.images)
    ]
    body = {"body": poses.body, "clock_offset_s": poses.clock_offset_s, "views": views, "recording": _recording(poses.course)}
    write_document(path, KIND, body, provenance)


def _recording(course: BodyCourse | None) -> dict[str, Any] | None:
    """The body over the recording, to the digits that a drawing shows."""
    if course is None:
        return None
    return {
        "t_mocap_s": np.round(course.t_s, 3),
        "moved_m": np.round(course.moved_m, 5),
        "turned_deg": np.round(np.degrees(course.turned_rad), 3),
        "lapses": [{"start_s": round(one.start_s, 4), "end_s": round(one.end_s, 4), "tracked": one.tracked} for one in course.lapses],
    }


def _course(recording: dict[str, Any] | None) -> BodyCourse | None:
    if recording is None:
        return None
    t_s, moved_m, turned_deg = (numbers(recording, key, -1) for key in ("t_mocap_s", "moved_m", "turned_deg"))
    if not len(t_s) == len(moved_m) == len(turned_deg):
        raise ValueError("moved_m")
    lapses = tuple(Lapse(float(numbers(one, "start_s")), float(numbers(one, "end_s")), bool(one["tracked"])) for one in recording["lapses"])
    return BodyCourse(t_s, moved_m, np.radians(turned_deg), lapses)


def read_h_op(path: Path) -> ImagePanelPoses:
    """Read H_OP.yaml.

    Raises
    ------
    InputError
        Not there, cut off, of another kind, or a key that is lacking or holds no numbers.
    """
    return read_record(path, KIND, "lpcal handeye", h_op_from_document)


def h_op_from_document(document: dict[str, Any]) -> ImagePanelPoses:
    """Poses of the body as written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else; the message is the key's name.
    """
    views = document["views"]
    nothing = np.full((4, 4), np.nan)
    times = [number(view, "t_camera_s") for view in views]
    return ImagePanelPoses(
        body=document["body"],
        images=tuple(view["image"] for view in views),
        t_camera_s=None if any(time is None for time in times) else np.array(times, dtype=float),
        H_OP=np.array([nothing if view["H_OP"] is None else rigid(view, "H_OP") for view in views]).reshape(len(views), 4, 4),
        why=tuple(view["why"] for view in views),
        steady=np.array([view["steady"] for view in views], dtype=bool),
        clock_offset_s=number(document, "clock_offset_s"),
        course=_course(document.get("recording")),
    )
