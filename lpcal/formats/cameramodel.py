"""mrcal's .cameramodel: a Python literal of lensmodel, intrinsics, imagersize (and what it was solved from, which stays with mrcal).

Only the lens models that lpcal projects with are read: LENSMODEL_PINHOLE, OPENCV4, OPENCV5, OPENCV8 and SPLINED_STEREOGRAPHIC.
Source: mrcal's documentation, "cameramodel".
"""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.guarded_yaml import refuse_bombs
from lpcal.formats.outputs import marked
from lpcal.formats.reading import reader
from lpcal.records.calibration import Camera

PLAIN = {"LENSMODEL_PINHOLE": "opencv4", "LENSMODEL_OPENCV4": "opencv4", "LENSMODEL_OPENCV5": "opencv5", "LENSMODEL_OPENCV8": "opencv8"}
MARK = "# written by lpcal\n"
OPAQUE = re.compile(r"""#[^\n]*|'[^'\\\n]*(?:\\.[^'\\\n]*)*'|"[^"\\\n]*(?:\\.[^"\\\n]*)*\"""")
"""Comments and strings: mrcal writes what it solved from as one string of 85 signs, brackets among them."""
MODEL_FILE = marked("a cameramodel", MARK)
"""A .cameramodel, as an output: only one that lpcal wrote is replaced, never a user's own."""


@reader("a cameramodel of mrcal's")
def read_cameramodel(path: Path) -> Camera:
    """Read a .cameramodel.

    Raises
    ------
    InputError
        No literal, a key is lacking, or a lens model that lpcal does not project with.
    """
    try:
        text = path.read_text(encoding="utf-8")
        refuse_bombs(text, path, OPAQUE)
        document: dict[str, Any] = ast.literal_eval(text)
        lensmodel = str(document["lensmodel"])
        vector = np.array(document["intrinsics"], dtype=float)
        width, height = (int(side) for side in document["imagersize"])
    except (OSError, UnicodeDecodeError, SyntaxError, ValueError, KeyError, TypeError, OverflowError) as error:
        raise InputError(
            f"cannot be read as a cameramodel: {error}",
            where=str(path),
            needed="lensmodel, intrinsics, imagersize",
            todo="is the file cut off?",
        ) from error
    wanted = {"LENSMODEL_PINHOLE": 4, "LENSMODEL_OPENCV4": 8, "LENSMODEL_OPENCV5": 9, "LENSMODEL_OPENCV8": 12}.get(lensmodel)
    if vector.ndim != 1 or vector.size < 4 or (wanted and vector.size != wanted):
        raise InputError(f"{vector.size} intrinsics of {lensmodel}", where=str(path), needed=f"{wanted or 'more'}", todo="is it cut off?")
    K = np.array([[vector[0], 0, vector[2]], [0, vector[1], vector[3]], [0, 0, 1.0]])
    if lensmodel in PLAIN:
        distortion = vector[4:] if vector.size > 4 else np.zeros(4)
        return Camera((width, height), PLAIN[lensmodel], K, distortion)
    if lensmodel.startswith("LENSMODEL_SPLINED_STEREOGRAPHIC"):
        return Camera((width, height), "splined", K, np.zeros(0), lensmodel=lensmodel, spline=vector)
    raise InputError(
        f"lens model {lensmodel}",
        where=str(path),
        needed=f"one of {', '.join(PLAIN)}, LENSMODEL_SPLINED_STEREOGRAPHIC",
        todo="mrcal-convert-lensmodel",
    )


def cameramodel_text(camera: Camera) -> str:
    """A camera as a .cameramodel, without what it was solved from."""
    lensmodel = camera.lensmodel if camera.spline is not None else f"LENSMODEL_{camera.model.upper()}"
    core = [camera.K[0, 0], camera.K[1, 1], camera.K[0, 2], camera.K[1, 2]]
    vector = camera.spline if camera.spline is not None else [*core, *camera.distortion]
    lines = [
        "{",
        f"    'lensmodel':  {lensmodel!r},",
        f"    'intrinsics': [ {', '.join(repr(float(number)) for number in vector)} ],",
        "    'extrinsics': [ 0, 0, 0, 0, 0, 0 ],",
        f"    'imagersize': [ {camera.image_size[0]}, {camera.image_size[1]} ]",
        "}",
    ]
    return "\n".join(lines) + "\n"
