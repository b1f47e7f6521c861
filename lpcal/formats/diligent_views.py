"""The views of a DiLiGenT-MV object: one folder a view in DiLiGenT's layout, and one file with the camera and where it stood for each.

``bearPNG/view_01 ... view_20`` hold images, mask.png and the three files of lights, in each view's own axes. ``bearPNG/Calib_Results.mat``
is of the Camera Calibration Toolbox for Matlab: ``KK`` (3, 3), and for view k ``Rc_k`` (3, 3), ``Tc_k`` (3, 1) in millimetres with
``x_C = Rc_k x_O + Tc_k``: O is the frame of the turntable on which the object stands. Pixels count from 0; images are free of distortion.
Source: Li et al. 2020, Multi-view photometric stereo: a robust solution and benchmark dataset for spatially varying isotropic materials.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.mat_file import read_matrices
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

FILE = "Calib_Results.mat"
NAME = re.compile(r"view_0*([1-9]\d*)")
"""A view's folder."""
M_FROM_MM = 1e-3
NOT_A_ROTATION = 1e-4
"""How far R R^T may be from 1: single precision and four decimals leave less."""


@dataclass(frozen=True)
class DiligentView:
    """What a view's camera was."""

    K: Array
    """(3, 3) pixels."""
    H_CO: Array
    """(4, 4) the turntable in the camera, metres."""


def view_of_set(folder: Path) -> DiligentView | None:
    """The camera of a view's folder; None where it is no view of such a set.

    Raises
    ------
    InputError
        The set's file cannot be read, or has no camera or no pose of this view.
    """
    number = NAME.fullmatch(folder.name or folder.resolve().name)
    file = folder.resolve().parent / FILE
    if number is None or not file.is_file():
        return None
    found = read_matrices(file)
    k = number.group(1)
    shapes = {"KK": (3, 3), f"Rc_{k}": (3, 3), f"Tc_{k}": (3, 1)}
    for name, shape in shapes.items():
        held = found.get(name)
        if held is None or held.shape not in {shape, shape[::-1]} or not np.isfinite(held).all():
            raise InputError(
                f"no {name} of {shape[0]} by {shape[1]} finite numbers",
                where=str(file),
                needed=f"KK, Rc_{k}, Tc_{k} for {folder.name}",
                todo="copy the file of the data set anew",
            )
    K, R, t = (found[name] for name in shapes)
    if np.abs(R @ R.T - np.eye(3)).max() > NOT_A_ROTATION or np.linalg.det(R) < 0:
        raise InputError(f"Rc_{k} is no rotation", where=str(file), needed="a rotation matrix", todo="copy the file of the data set anew")
    u, _, vt = np.linalg.svd(R)
    return DiligentView(K, se3.transform(u @ vt, M_FROM_MM * t.ravel()))
