r"""Tables that people have beside their images, as arrays: poses of a robot, times of images, corners of boards, a lamp's photometric file.

The commands read them where panel.yaml names them; here they are for a program of your own.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Literal

from lpcal.formats import corners_vnl, image_times, lobe_files, robot_poses
from lpcal.formats.robot_poses import ImagePoses
from lpcal.geometry.arrays import Array
from lpcal.records.lobes import Lobe

__all__ = ["ImagePoses", "read_corners", "read_image_times", "read_lobe", "read_robot_poses"]

type Rotation = Literal["rotation_vector", "rotation_vector_deg", "abc_deg", "xyz_deg", "zyz_deg", "rpy_deg", "rpy_rad"]


def read_robot_poses(
    path: str | os.PathLike[str],
    *,
    quaternion: Literal["xyzw", "wxyz"] | None = None,
    units: Literal["m", "cm", "mm"] | None = None,
    direction: Literal["H_OP", "H_PO"] = "H_OP",
    rotation: Rotation | None = None,
) -> ImagePoses:
    r"""Read one pose an image: a csv with a header, rows of 4x4 matrices, or rows of six numbers.

    Parameters
    ----------
    path : str or path
        The table.
    quaternion, units : str, optional
        The quaternion's order and the unit of length, where the header does not say.
    direction : {"H_OP", "H_PO"}
        What the table holds; H_PO is inverted.
    rotation : str, optional
        What three angles are, where the header does not say: ``rotation_vector`` (Universal Robots), ``abc_deg`` (KUKA), ``xyz_deg``,
        ``zyz_deg``, ``rpy_deg`` (Fanuc), ``rpy_rad``.

    Returns
    -------
    ImagePoses
        ``H`` (N, 4, 4), the body in the room in metres; ``files``, the images' names where the table has them; ``notes``.

    Raises
    ------
    InputError
        None of the layouts, or a matrix that is no rigid transform; with its line.
    DisagreementError
        Two rows for one image.
    DegenerateError
        No pose but the identity.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "robot.csv"
    >>> _ = path.write_text("file,x_mm,y_mm,z_mm,rx,ry,rz\na.png,500,0,300,0,0,0\nb.png,500,10,300,0,0,0.1\n")
    >>> found = lpcal.tables.read_robot_poses(path)
    >>> found.files, found.H[:, :3, 3].tolist()
    (('a.png', 'b.png'), [[0.5, 0.0, 0.3], [0.5, 0.01, 0.3]])
    """
    return robot_poses.read_robot_poses(Path(path), robot_poses.Stated(quaternion, units, direction, rotation))


def read_image_times(path: str | os.PathLike[str]) -> tuple[list[Path], list[float]]:
    r"""Read when images were taken: a csv of ``file`` and ``time_s`` (or ``time_ms``, ``time_us``, ``time_ns``), a row an image.

    Parameters
    ----------
    path : str or path
        The csv; image paths in it are relative to it.

    Returns
    -------
    list of Path, list of float
        The images, and their times in seconds on the camera's clock, in the order of the rows.

    Raises
    ------
    InputError
        No such columns, a time that is no finite number, or an image that is not there.
    DisagreementError
        One image stands twice.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> (folder / "a.png").touch()
    >>> _ = (folder / "times.csv").write_text("file,time_ms\na.png,1500\n")
    >>> images, times_s = lpcal.tables.read_image_times(folder / "times.csv")
    >>> images[0].name, times_s
    ('a.png', [1.5])
    """
    rows = image_times.read_image_times(Path(path))
    return [image for image, _ in rows], [time_s for _, time_s in rows]


def read_corners(path: str | os.PathLike[str], count: int) -> dict[str, Array | None]:
    r"""Read board corners as mrcal's tools keep them: a vnlog of ``filename x y level``, one line a corner, in the board's order.

    Parameters
    ----------
    path : str or path
        The vnlog.
    count : int
        Corners of a whole board, columns times rows.

    Returns
    -------
    dict of str to ndarray (count, 2) or None
        Pixels by image, NaN where a corner was not seen; None where no board was.

    Raises
    ------
    InputError
        Not there, no such columns, or numbers that are none; with its line.
    DisagreementError
        An image with another number of corners.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "corners.vnl"
    >>> _ = path.write_text("# filename x y level\na.png 10 20 0\na.png 30 20 0\nb.png - - -\n")
    >>> found = lpcal.tables.read_corners(path, 2)
    >>> found["a.png"].tolist(), found["b.png"]
    ([[10.0, 20.0], [30.0, 20.0]], None)
    """
    return corners_vnl.read_corners(Path(path), count)


def read_lobe(path: str | os.PathLike[str]) -> Lobe:
    r"""Read the lobe of a maker's photometric file: the mean over the half planes about the axis, 1 on the axis.

    Parameters
    ----------
    path : str or path
        An IES (LM-63, .ies) or EULUMDAT (.ldt) file.

    Returns
    -------
    Lobe
        A lobe of kind ``table``.

    Raises
    ------
    InputError
        Not there, cut off, another format or photometry, or dark on the axis.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "spot.ies"
    >>> head = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n"
    >>> _ = path.write_text(head + "0 45 90\n0\n400 200 0\n")
    >>> lpcal.tables.read_lobe(path).value.tolist()
    [1.0, 0.5, 0.0]
    """
    return lobe_files.read_lobe(Path(path))
