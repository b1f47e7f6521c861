"""Files to records and back: every format that the commands read.

Readers never solve, and what a file can cause is an error of `lpcal.errors` that names it. Writers write whole files or none, and replace
only what lpcal itself wrote.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Literal

import numpy as np

from lpcal.chain.h_op_body import body_of
from lpcal.formats import calibration_yaml, camera_yaml, capture, mocap, surface_files
from lpcal.formats.bundled import folder, rig_file
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.cameramodel import MARK, MODEL_FILE, cameramodel_text
from lpcal.formats.documents import document_kind
from lpcal.formats.import_lights import named_after
from lpcal.formats.import_other import import_other, is_own
from lpcal.formats.outputs import refuse_place, write_text
from lpcal.formats.panel_yaml import FILE_NAME
from lpcal.formats.panel_yaml import read_rig as read_panel
from lpcal.formats.zarr_files import write_surface_zarr
from lpcal.records import given_records
from lpcal.records.calibration import Calibration, Camera, CameraSolution
from lpcal.records.observations import MarkerStream, PoseStream, RawCapture
from lpcal.records.provenance import Provenance
from lpcal.records.rig import RigFile
from lpcal.records.surface import Surface
from lpcal.report.relight_page import render

type PathLike = str | os.PathLike[str]
type Vectors = Literal["directions", "positions"]

DEMO = "demo"
"""The name of the bundled rig that comes with images."""
NO_CORNERS = np.zeros((0, 3))
"""The board's corners of a camera that was not solved from any."""


def read_rig(path: PathLike) -> RigFile:
    """Read a rig: panel.yaml, or the folder in or above which it lies, or the name of a bundled rig.

    Parameters
    ----------
    path : str or path
        A panel.yaml, a folder, or one of ``lightpanel-6``, ``lightpanel-12``, ``dome``, ``robot-camera``; ``demo`` is the bundled rig with
        its images.

    Returns
    -------
    RigFile
        The rig (metres, radians, seconds), where it was read, and the line of each key.

    Raises
    ------
    InputError
        Not there, not YAML, an unknown key, or a bare number for a length; with file and line.

    Examples
    --------
    >>> import lpcal
    >>> lpcal.read_rig("lightpanel-6").rig.board.square
    (0.025, 0.025)
    """
    demo = os.fspath(path) == DEMO and not Path(path).exists()
    return read_panel(folder("calib_data") / "demo_rig" / FILE_NAME if demo else rig_file(os.fspath(path)))


def read_mocap(
    path: PathLike,
    body: str | None = None,
    *,
    quaternion: Literal["xyzw", "wxyz"] | None = None,
    units: Literal["m", "cm", "mm"] | None = None,
    direction: Literal["H_OP", "H_PO"] = "H_OP",
) -> PoseStream:
    r"""Read the poses of a tracked body from a motion-capture recording of whatever format.

    The format is found from the file itself: Motive, Vicon, Qualisys, TRC, C3D, ROS bags, TUM, EuRoC, a csv of poses, or one that was
    added with `register_mocap`. Bare markers are made a body.

    Parameters
    ----------
    path : str or path
        The recording.
    body : str, optional
        The body's name; it may be left out where the file holds one.
    quaternion, units : str, optional
        The quaternion's order and the unit of length, where the file does not say; an error for a format of `register_mocap`, which
        knows its own.
    direction : {"H_OP", "H_PO"}
        What the file holds; H_PO is inverted.

    Returns
    -------
    PoseStream
        H_OP (N, 4, 4) in metres at times (N,) in seconds, increasing; lost samples left out; markers; notes on what was repaired.

    Raises
    ------
    InputError
        Not there, of no known format, or a line that cannot be read; with its number.
    DisagreementError
        It does not hold the body.
    DegenerateError
        It holds no pose.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "track.csv"
    >>> rows = [f"{0.01 * k},{0.001 * k},0,1,0,0,0,1" for k in range(20)]
    >>> _ = path.write_text("t_s,x_m,y_m,z_m,qx,qy,qz,qw\n" + "\n".join(rows))
    >>> lpcal.read_mocap(path).H_OP.shape
    (20, 4, 4)
    """
    found = mocap.read_mocap(Path(path), body, quaternion=quaternion, units=units, direction=direction)
    return body_of(found, None) if isinstance(found, MarkerStream) else found


def read_capture(
    folder: PathLike, lights: Calibration | Sequence[str], *, name: str | None = None, use: Sequence[str] | None = None
) -> RawCapture:
    """Read a capture folder: one image a light, named after it.

    Parameters
    ----------
    folder : str or path
        A capture in Zarr v3, or a folder of ``<light>.png`` (or tif, jpg, ...), and where there are any ``ambient*.png``,
        ``short_<light>.png``, ``mask.png``, ``capture.yaml``.
    lights : Calibration, or sequence of str
        The calibrated lights, or their names.
    name : str, optional
        What it is called; by default as the folder.
    use : sequence of str, optional
        The lights to take; else those that capture.yaml names, else all.

    Returns
    -------
    RawCapture
        Images (L, H, W[, 3]) as fractions of full scale, exposures in seconds, ambient images, mask, and what the files say of the sensor.

    Raises
    ------
    InputError
        The folder or an image is not there or cannot be read.
    DisagreementError
        A light without an image, or images that differ in size or channels.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> from PIL import Image
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> for light in ("L0", "L1"):
    ...     Image.new("L", (32, 24), 100).save(folder / f"{light}.png")
    >>> lpcal.read_capture(folder, ["L0", "L1"]).images.shape
    (2, 24, 32)
    """
    names = [light.name for light in lights.lights] if isinstance(lights, Calibration) else list(lights)
    return capture.read_capture(Path(folder), names, name=name, use=use)


def read_calibration(path: PathLike, *, vectors: Vectors | None = None, images: PathLike | None = None) -> Calibration:
    r"""Read a calibration: calibration.yaml, or another system's lights.

    Parameters
    ----------
    path : str or path
        calibration.yaml; an .lp file; a folder of DiLiGenT; led_params of LUCES; light.mat of near_ps; a table of directions; RelightLab's
        dome; Meshroom's lights or SfMData; a glTF scene with lights; a camera file of OpenCV, ROS, Kalibr, COLMAP, mrcal, Metashape; tf,
        URDF, easy_handeye.
    vectors : str, optional
        What the vectors of an .lp file or a table are, "directions" or "positions", where their lengths do not show it.
    images : str or path, optional
        A folder of images, one a light, after which another system's lights are named, in natural order.

    Returns
    -------
    Calibration
        The camera, where there is one, and the lights, in C, metres; `origin` is the format, and what is to be known stands in `warnings`.

    Raises
    ------
    InputError
        Not there, of no known format, cut off, or a value that is lacking or no number; the light is named.
    DisagreementError
        Another number of images than of lights, or parts of the file that contradict each other.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "dome.lp"
    >>> _ = path.write_text("2\nL0 0.5 0 0.866\nL1 -0.5 0 0.866\n")
    >>> [light.name for light in lpcal.read_calibration(path).lights]
    ['L0', 'L1']
    """
    place = Path(path)
    if place.suffix.lower() in {".yaml", ".yml"} and is_own(place):
        return calibration_yaml.read_calibration(place)
    found = import_other(place, vectors)
    calibration = named_after(found.calibration, Path(images)) if images is not None else found.calibration
    return replace(calibration, origin=found.format, warnings=(*found.notes, *calibration.warnings, *_lacking(calibration)))


def _lacking(calibration: Calibration) -> list[str]:
    """What another system's calibration leaves open."""
    said = []
    if calibration.d_object_m is None and any(light.source_C is not None for light in calibration.lights):
        said.append("the lights' axes meet nowhere: no working distance; reconstruct finds it from the light, or takes --distance")
    if calibration.camera is not None and calibration.camera.size_guessed:
        width, height = calibration.camera.image_size
        said.append(
            f"no image beside it: its size is guessed as {width}x{height} from the principal point; reconstruct takes the capture's"
        )
    return said


def read_camera(path: PathLike) -> Camera:
    """Read a camera file of lpcal, mrcal, OpenCV, ROS, Kalibr or COLMAP; the format is found from the file itself.

    Parameters
    ----------
    path : str or path
        The file.

    Returns
    -------
    Camera
        Intrinsics in pixels (pixel centres at whole numbers), and the covariance of their parameters where the file holds it.

    Raises
    ------
    InputError
        Not there, of no format known, garbled, several cameras, or a lens that lpcal does not project with.

    Examples
    --------
    >>> import lpcal, numpy as np, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "camera.cameramodel"
    >>> camera = lpcal.Camera((640, 480), "opencv4", np.array([[600.0, 0, 320], [0, 600, 240], [0, 0, 1]]), np.zeros(4))
    >>> lpcal.write_camera(path, camera)
    >>> lpcal.read_camera(path).K[0].tolist()
    [600.0, 0.0, 320.0]
    """
    return read_camera_file(Path(path))


def read_surface(folder: PathLike) -> Surface:
    """Read a surface back from the folder that `lpcal reconstruct` or `write_surface` wrote.

    Parameters
    ----------
    folder : str or path
        Holds surface.npz and summary.json.

    Returns
    -------
    Surface
        Its maps (H, W), its pieces and warnings.

    Raises
    ------
    InputError
        surface.npz or summary.json is not there or lacks a part.

    Examples
    --------
    >>> import lpcal, numpy as np, pathlib, tempfile
    >>> folder = pathlib.Path(tempfile.mkdtemp()) / "flat"
    >>> lpcal.write_surface(folder, lpcal.integrate(np.zeros((12, 12, 3)) + [0, 0, -1.0], name="flat"))
    >>> lpcal.read_surface(folder).name
    'flat'
    """
    return surface_files.read_surface(Path(folder))


def write_calibration(path: PathLike, calibration: Calibration) -> None:
    """Write calibration.yaml.

    Parameters
    ----------
    path : str or path
        Where to; it replaces an earlier calibration.yaml, and nothing else.
    calibration : Calibration
        The camera and the lights.

    Raises
    ------
    UsageError, InputError
        Something stands there that lpcal did not write, or it cannot be written.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "calibration.yaml"
    >>> lpcal.write_calibration(path, lpcal.assemble_calibration(lpcal.design_lights(lpcal.read_rig("lightpanel-6"))))
    >>> len(lpcal.read_calibration(path).lights)
    6
    """
    place = Path(path)
    refuse_place(place, document_kind(calibration_yaml.KIND))
    calibration_yaml.write_calibration(place, given_records.calibration(calibration), Provenance())


def write_camera(path: PathLike, camera: Camera | CameraSolution) -> None:
    """Write a camera: ``.cameramodel`` for mrcal's tools, else lpcal's camera.yaml.

    Parameters
    ----------
    path : str or path
        Where to; it replaces an earlier file of the same kind, and nothing else.
    camera : Camera or CameraSolution
        The camera; of a solution camera.yaml holds also the views and the evidence.

    Raises
    ------
    UsageError, InputError
        Something stands there that lpcal did not write, or it cannot be written.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"))
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "camera.yaml"
    >>> lpcal.write_camera(path, session.camera)
    >>> lpcal.read_camera(path).image_size
    (640, 400)
    """
    place = Path(path)
    solution = (
        camera
        if isinstance(camera, CameraSolution)
        else CameraSolution(given_records.camera(camera), NO_CORNERS, (), "given", float("nan"))
    )
    if place.suffix == ".cameramodel":
        refuse_place(place, MODEL_FILE)
        write_text(place, MARK + (solution.cameramodel or cameramodel_text(solution.camera)), MODEL_FILE)
        return
    refuse_place(place, document_kind(camera_yaml.KIND))
    camera_yaml.write_camera(place, solution, Provenance())


def write_surface(
    folder: PathLike, surface: Surface, calibration: Calibration | None = None, *, mesh_frame: Literal["camera", "placed"] = "camera"
) -> None:
    """Write a surface: maps, images, meshes and summary.json, as `lpcal reconstruct` does.

    Parameters
    ----------
    folder : str or path
        Where to; it replaces an earlier surface, and nothing else. One that ends in ``.zarr`` becomes a Zarr v3 group of the maps.
    surface : Surface
        What `reconstruct` or `integrate` gives.
    calibration : Calibration, optional
        The lights, for the relighting page; without it there is none.
    mesh_frame : {"camera", "placed"}
        Whether the meshes are in C, or where the surface's placement puts it: in the room, or in the body that the object rides on.

    Raises
    ------
    UsageError, InputError
        Something stands there that lpcal did not write, or it cannot be written.

    Examples
    --------
    >>> import lpcal, numpy as np, pathlib, tempfile
    >>> folder = pathlib.Path(tempfile.mkdtemp()) / "flat"
    >>> lpcal.write_surface(folder, lpcal.integrate(np.zeros((12, 12, 3)) + [0, 0, -1.0]))
    >>> sorted(path.name for path in folder.glob("mesh.*"))
    ['mesh.glb', 'mesh.ply']
    """
    if Path(folder).suffix == ".zarr":
        write_surface_zarr(Path(folder), surface)
        return
    page = None if calibration is None else partial(render, surface, calibration)
    summary, placed = surface_files.summary_of(surface), mesh_frame == "placed" and surface.placement is not None
    surface_files.write_surface(Path(folder), surface, summary, page, placed_mesh=placed)
