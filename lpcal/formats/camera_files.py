"""Cameras of whatever file: the format is recognised from what stands in it, not from its name."""

from __future__ import annotations

from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats.cameramodel import cameramodel_text, read_cameramodel
from lpcal.records.calibration import Camera


def read_camera_file(path: Path) -> Camera:
    """The camera of a file of mrcal.

    Raises
    ------
    InputError
        Not there, of no format known, or garbled.
    """
    if not path.is_file():
        raise InputError("no such camera file", where=str(path), needed="a camera file")
    return read_cameramodel(path)


__all__ = ["cameramodel_text", "read_camera_file"]
