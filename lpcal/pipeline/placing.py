"""Where captures were taken: capture.yaml's time, pose or body, with the rig's recording or the capture's own."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from lpcal.errors import DegenerateError, InputError
from lpcal.formats.documents import plain, sha256
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Calibration
from lpcal.records.digits import fine
from lpcal.records.observations import PoseStream
from lpcal.records.placement import Placement, StatedPlace
from lpcal.records.rig import MocapSection

UNPLACED = "not placed in the room: {}"


@dataclass(frozen=True)
class Recorded:
    """The recording of a rig and how it is read; it is read once, and only where a capture needs it."""

    path: Path | None
    section: MocapSection
    markers: dict[str, tuple[float, float, float]] | None = None

    def stream(self, body: str | None, path: Path) -> PoseStream:
        """The poses of one of its bodies; of the panel where `body` is None."""
        stated = self.section.quaternion, self.section.units, self.section.direction
        places = tuple((self.markers or {}).items()) if body is None else ()
        return _stream(path, path.stat().st_mtime_ns if path.exists() else 0, body or self.section.body, stated, places)


NO_RIG = Recorded(None, MocapSection())
"""What is known of a recording where there is no rig: it is read as it says itself."""


def recorded_of(workspace: Workspace) -> Recorded:
    """The rig's recording."""
    section, panel = workspace.rig_file.rig.mocap, workspace.rig_file.rig.panel
    if section is None:
        return NO_RIG
    path = None if section.file is None else workspace.path(section.file, "mocap.file")
    return Recorded(path, section, panel.markers if panel else None)


def placed(stated: StatedPlace, calibration: Calibration, recorded: Recorded, capture: Path) -> tuple[Placement | None, tuple[str, ...]]:
    """Where a capture was taken, or None and why not, in words; nothing is said where capture.yaml says nothing.

    Raises
    ------
    InputError, DisagreementError
        A body without a time or without a recording, one that it does not hold, or a recording that cannot be read.
    """
    where = f"{capture / 'capture.yaml'}"
    if stated.H_OP is not None or stated.H_OC is not None:
        if stated.body is not None:
            raise InputError("body with a stated pose", where=where, needed="time and a recording that holds both bodies, or pose alone")
        from lpcal.api.placement import place

        at, tolerance = stated.t_camera_s, stated.tolerance
        found = place(calibration, t_camera_s=at, H_OP=stated.H_OP, H_OC=stated.H_OC, tolerance=tolerance)
        return found, found.notes
    if stated.t_camera_s is None and stated.body is None:
        return None, ()
    if stated.t_camera_s is None:
        raise InputError("body without time", where=where, needed="time: when it was taken, on the camera's clock", todo="add it")
    path = stated.recording or recorded.path
    fixed = calibration.carries == "board"
    if calibration.H_PC is None or (path is None and not fixed):
        lacking = (
            "the calibration holds no H_PC" if calibration.H_PC is None else "no recording: mocap.file of the rig, or mocap: beside time"
        )
        if stated.body is not None:
            raise InputError(lacking, where=where, needed="what says where the panel and the body were")
        return None, (UNPLACED.format(lacking),)
    from lpcal.api.placement import place

    try:
        found = place(
            calibration,
            None if fixed or path is None else recorded.stream(None, path),
            stated.t_camera_s,
            object_poses=None if stated.body is None or path is None else recorded.stream(stated.body, path),
            clock_offset_s=stated.clock_offset_s,
        )
    except DegenerateError as error:
        return None, (UNPLACED.format(f"{error.found}, {error.where}"),)
    return found, found.notes


def placed_said(document: dict[str, Any] | None) -> str:
    """Where a surface lies, of the placement in its summary.json; empty where it is not known."""
    if document is None:
        return ""
    document = plain(document)
    name = "H_MC" if "H_MC" in document else "H_OC"
    place = ", ".join(f"{1e3 * row[3]:.1f}" for row in document[name][:3])
    sigma = ", ".join(fine(1e3 * std) for std in document["position_std_m"])
    frame = "the room" if document["body"] is None else f"the body {document['body']}"
    return f"\n  placed: the camera at {place} mm in {frame}, +- {sigma} mm ({document['source']})"


def made_from(stated: StatedPlace, recorded: Recorded) -> list[object]:
    """What a capture's place is made from besides its own files and the calibration, for a digest."""
    path = stated.recording or recorded.path
    if stated.t_camera_s is None or path is None or not path.exists():
        return []
    content = _digest(path, path.stat().st_mtime_ns) if path.is_file() else path.name
    return [content, recorded.section.model_dump(mode="json"), list((recorded.markers or {}).items())]


@lru_cache(maxsize=4)
def _digest(path: Path, changed_ns: int) -> str:  # noqa: ARG001 - one that was changed is read again
    return sha256(path)


@lru_cache(maxsize=4)
def _stream(
    path: Path,
    changed_ns: int,  # noqa: ARG001 - one that was changed is read again
    body: str | None,
    stated: tuple[str | None, str | None, str],
    places: tuple[tuple[str, tuple[float, float, float]], ...],
) -> PoseStream:
    """A body's poses, read once for all captures of a recording."""
    from lpcal.chain.h_op_body import body_of
    from lpcal.formats.mocap import read_mocap

    found = read_mocap(path, body, quaternion=stated[0], units=stated[1], direction=stated[2])
    return found if isinstance(found, PoseStream) else body_of(found, dict(places) or None)
