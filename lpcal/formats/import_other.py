"""Calibrations from other systems' files, whatever they hold: lights, a camera alone, or the camera's place alone.

Formats that others added are asked first; then those of `exchange` that know their files; then a file of a camera; then lights.
"""

from __future__ import annotations

from pathlib import Path

from lpcal.formats.camera_colmap import is_colmap
from lpcal.formats.exchange import ADDED, known_formats, of_packages
from lpcal.formats.export_cameras import read_camera_alone
from lpcal.formats.import_lights import Imported, import_lights
from lpcal.formats.reading import reading

HEAD_BYTES = 65536
"""Bytes at the beginning of a file by which it is known."""
CAMERA_ENDINGS = {".cameramodel", ".xml", ".json", ".yml", ".yaml", ".bin"}
"""What names of camera files end in; the text of COLMAP's is looked into."""
LIGHTS_ALONE = {"lp", "diligent", "luces", "near_ps"}
"""Formats that `import_lights` reads, with notes on them."""


def is_own(path: Path) -> bool:
    """Whether a YAML file is one of lpcal's calibrations, or is none of another system's."""
    try:
        head = path.read_bytes()[:HEAD_BYTES]
    except OSError:
        return True
    if b"kind: camera\n" in head[:200]:
        return False
    return head.lstrip().startswith(b"lpcal:") or not any(
        mark in head
        for mark in (
            b"camera_matrix",
            b"opencv-matrix",
            b"camera_model",
            b"child_frame_id",
            b"eye_on_hand",
            b"camera_info",
            b"distortion_model",
        )
    )


def import_other(path: Path, vectors: str | None = None) -> Imported:
    """What a file or folder of another system's holds.

    Raises
    ------
    InputError
        Not there, of no known format, or not what a file of its format holds.
    DisagreementError
        Parts of it contradict each other.
    """
    added = {one.name for one in (*of_packages(), *ADDED.values())}
    for one in sorted(known_formats().values(), key=lambda each: each.name not in added):
        if one.read is None or one.recognise is None or (one.name in LIGHTS_ALONE and one.name not in added):
            continue
        with reading(path, one.title):
            if one.recognise(path):
                return Imported(one.title, one.read(path))
    camera = _camera_file(path)
    if camera is not None:
        return Imported("a camera file", read_camera_alone(camera))
    return import_lights(path, vectors)


def _camera_file(path: Path) -> Path | None:
    """The file of a camera that a path is or, as COLMAP's folder, holds."""
    if path.is_dir():
        inside = path / "cameras.txt"
        return inside if inside.is_file() else None
    if not path.is_file():
        return None
    if path.suffix.lower() in CAMERA_ENDINGS:
        return path
    if path.suffix.lower() != ".txt":
        return None
    return path if is_colmap(path.read_bytes()[:HEAD_BYTES].decode("utf-8", "replace")) else None
