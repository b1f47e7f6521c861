"""Other systems' formats that lpcal writes: one entry a format, lpcal's own and those that others add.

An entry point of the group ``lpcal.formats`` names an `ExchangeFormat`; a program registers one with `register`. A format that was added
stands for lpcal's own of the same name.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from lpcal.errors import UsageError
from lpcal.formats import (
    export_cameras,
    export_lights,
    export_matlab,
    export_poses,
    export_rig_glb,
    export_rti,
    export_surfaces,
    import_diligent,
    import_directions,
    import_luces,
    import_near_ps,
    import_rig_glb,
)
from lpcal.records.calibration import Calibration
from lpcal.records.exchange import ExchangeContent, Part
from lpcal.records.installed import installed

GROUP = "lpcal.formats"
"""The entry points of installed packages among which formats are looked for."""


@dataclass(frozen=True)
class ExchangeFormat:
    r"""A format of another system's.

    Parameters
    ----------
    name : str
        The word that asks for it: ``--format NAME``.
    title : str
        The system and its file.
    needs : tuple of str
        What there must be to write: ``camera``, ``hand-eye``, ``lights``, ``near lights``, ``surface``, ``metric surface``, ``capture``.
    keeps, loses : str
        What of a calibration a file holds, and what it has no place for.
    write : callable
        ``write(content: ExchangeContent, folder: Path) -> list[str]``: writes its files or folders into an empty folder; what it returns
        is said to the user: what was changed or lost of this very calibration.
    read : callable, optional
        ``read(path: Path) -> Calibration``: reads one back.
    recognise : callable, optional
        ``recognise(path: Path) -> bool``: whether a file or folder is one; never raises.

    Examples
    --------
    >>> import lpcal
    >>> def write(content, folder):
    ...     (folder / "lights.csv").write_text("".join(f"{light.name}\\n" for light in content.calibration.lights))
    ...     return []
    >>> lpcal.ExchangeFormat("names", "a list of the lights", ("lights",), "names", "all else", write).name
    'names'
    """

    name: str
    title: str
    needs: tuple[Part, ...]
    keeps: str
    loses: str
    write: Callable[[ExchangeContent, Path], list[str]]
    read: Callable[[Path], Calibration] | None = None
    recognise: Callable[[Path], bool] | None = None

    def lacking(self, content: ExchangeContent) -> list[Part]:
        """What there is not of all that it needs."""
        return [part for part in self.needs if content.lacks(part)]


SENSOR = "black and white level, gamma, flat field"
LENS = "lens model, image size, K and distortion to the last digit"
NO_LIGHT = f"lights, {SENSOR}, standard deviations"
DISTANT = f"places, lobes, camera, {SENSOR}, standard deviations"

CAMERAS = (
    ExchangeFormat(
        "opencv",
        "OpenCV FileStorage, camera.opencv.yml",
        ("camera",),
        LENS,
        f"{NO_LIGHT}, H_PC; a splined lens (fitted)",
        export_cameras.write_opencv,
        export_cameras.read_camera_alone,
    ),
    ExchangeFormat(
        "ros",
        "ROS camera_info, camera.ros.yaml",
        ("camera",),
        f"{LENS}; R = 1, P = [K 0]",
        f"{NO_LIGHT}, H_PC; a splined lens (fitted)",
        export_cameras.write_ros,
        export_cameras.read_camera_alone,
    ),
    ExchangeFormat(
        "kalibr",
        "Kalibr camchain.yaml, pinhole-radtan",
        ("camera",),
        "image size, K, k1 k2 p1 p2",
        f"{NO_LIGHT}, H_PC; k3 to k6 and a splined lens (fitted)",
        export_cameras.write_kalibr,
        export_cameras.read_camera_alone,
    ),
    ExchangeFormat(
        "colmap",
        "COLMAP model, colmap/cameras.txt, rigs.txt",
        ("camera",),
        f"{LENS}, half a pixel added",
        f"{NO_LIGHT}, H_PC; a splined lens (fitted)",
        export_cameras.write_colmap,
        export_cameras.read_camera_alone,
    ),
    ExchangeFormat(
        "mrcal",
        "mrcal camera.cameramodel",
        ("camera",),
        f"{LENS}, splined lenses too; H_PC as rt_cam_ref",
        NO_LIGHT,
        export_cameras.write_mrcal,
        export_cameras.read_mrcal,
        export_cameras.is_mrcal,
    ),
    ExchangeFormat(
        "metashape",
        "Metashape camera.metashape.xml",
        ("camera",),
        "image size, f cx cy b1 k1 k2 k3 p1 p2, half a pixel added",
        f"{NO_LIGHT}, H_PC; k4 to k6 and a splined lens (fitted)",
        export_cameras.write_metashape,
        export_cameras.read_metashape,
        export_cameras.is_metashape,
    ),
    ExchangeFormat(
        "meshroom",
        "Meshroom SfMData, meshroom.sfm",
        ("camera",),
        "image size, K, k1 k2 k3 p1 p2, a view a light",
        f"{NO_LIGHT}, H_PC; k4 to k6 and a splined lens (fitted)",
        export_cameras.write_meshroom,
        export_cameras.read_meshroom,
        export_cameras.is_meshroom,
    ),
)
POSES = (
    ExchangeFormat(
        "tf",
        "ROS tf, tf_static.sh and tf_static.yaml",
        ("hand-eye",),
        "H_PC",
        "camera, lights, the covariance",
        export_poses.write_tf,
        export_poses.read_tf,
        export_poses.is_tf,
    ),
    ExchangeFormat(
        "urdf",
        "URDF, rig.urdf",
        ("hand-eye",),
        "H_PC, H_CL of every light",
        "lens, sources, lobes, intensities, the covariance",
        export_poses.write_urdf,
        export_poses.read_urdf,
        export_poses.is_urdf,
    ),
    ExchangeFormat(
        "easy_handeye",
        "easy_handeye.yaml",
        ("hand-eye",),
        "H_PC",
        "camera, lights, the covariance",
        export_poses.write_handeye_yaml,
        export_poses.read_easy_handeye,
        export_poses.is_easy_handeye,
    ),
)
LIGHTS = (
    ExchangeFormat(
        "lp",
        "RTI light file, lights.lp: directions",
        ("lights",),
        "directions at the working point",
        f"{DISTANT}, intensities",
        export_lights.write_lp,
        lambda path: import_directions.read_lp(path)[0],
        import_directions.is_lp,
    ),
    ExchangeFormat(
        "lp-positions",
        "RTI light file, lights_positions.lp: mm",
        ("near lights",),
        "places about the working point, and that point in a comment",
        f"axes, lobes, intensities, camera, {SENSOR}, standard deviations",
        export_lights.write_lp_positions,
        lambda path: import_directions.read_lp(path, "positions")[0],
    ),
    ExchangeFormat(
        "dome",
        "RelightLab rig.dome",
        ("lights",),
        "places about the working point, that point in the notes; directions, colours",
        f"axes, lobes, camera, {SENSOR}, standard deviations",
        export_lights.write_dome,
        export_lights.read_dome,
        export_lights.is_dome,
    ),
    ExchangeFormat(
        "diligent",
        "DiLiGenT folder, diligent/",
        ("lights",),
        "directions, intensities as they arrive; images of a capture",
        DISTANT,
        export_lights.write_diligent,
        import_diligent.read,
        import_diligent.is_one,
    ),
    ExchangeFormat(
        "luces",
        "LUCES folder, luces/led_params.txt",
        ("camera", "near lights"),
        "places, axes, intensities, pinhole camera; images of a capture",
        f"lobes (a cosine fitted), fy, distortion (images are made free of it), {SENSOR}, standard deviations",
        export_lights.write_luces,
        import_luces.read,
        import_luces.is_one,
    ),
    ExchangeFormat(
        "near_ps",
        "near_ps folder, near_ps/light.mat, camera.mat",
        ("camera", "near lights"),
        "places, axes, intensities, K; images of a capture",
        f"lobes (a cosine fitted), image size, distortion (images are made free of it), {SENSOR}, standard deviations",
        export_lights.write_near_ps,
        import_near_ps.read,
        import_near_ps.is_one,
    ),
    ExchangeFormat(
        "meshroom-lights",
        "Meshroom lights, meshroom_lights.json",
        ("lights",),
        "directions at the working point, intensities",
        DISTANT,
        export_lights.write_meshroom_lights,
        export_lights.read_meshroom_lights,
        export_lights.is_meshroom_lights,
    ),
)
WHOLE = (
    ExchangeFormat(
        "matlab",
        "MATLAB, Octave, calibration.mat",
        (),
        "camera, H_PC, lights with frames, sources, lobes (over the angle), intensities, standard deviations",
        f"names of the lights, lobes that are not round, {SENSOR}, the covariance; a splined lens (fitted)",
        export_matlab.write_matlab,
        export_matlab.read_matlab,
        export_matlab.is_matlab,
    ),
    ExchangeFormat(
        "rig-glb",
        "glTF scene of the rig, rig.glb",
        ("camera",),
        "camera, H_PC, lights as spots (KHR_lights_punctual) with frame, place, axis, colour; lens and lobes whole, in extras",
        "in a viewer principal point, distortion and the lobe's form (a soft cone fitted); standard deviations",
        export_rig_glb.write_rig_glb,
        import_rig_glb.read_rig_glb,
        import_rig_glb.is_rig_glb,
    ),
)
RTI = "the images themselves, places and lobes, camera, normals, depth"
RELIGHTABLE = (
    ExchangeFormat(
        "ptm",
        "RTI as PTM 1.2, relight.ptm",
        ("lights", "capture"),
        "each pixel as a polynomial of the light's direction, 6 terms in 8 bit, display-encoded",
        RTI,
        export_rti.write_ptm,
    ),
    ExchangeFormat(
        "hsh",
        "RTI as hemispherical harmonics, relight.rti",
        ("lights", "capture"),
        "each pixel as 4, 9 or 16 harmonics of the light's direction, in 8 bit, display-encoded",
        RTI,
        export_rti.write_hsh,
    ),
    ExchangeFormat(
        "openlime",
        "RelightLab and OpenLIME folder, relight/info.json",
        ("lights", "capture"),
        "images interpolated over the light's direction, in 45 components, as JPEGs (under 12 lights 4 or 9 harmonics)",
        RTI,
        export_rti.write_openlime,
    ),
)
SURFACE_LOST = "standard deviations, pieces, alternatives"
SURFACES = (
    ExchangeFormat(
        "ply", "mesh.ply", ("surface",), "vertices, measured normals, colours, faces; C, m", SURFACE_LOST, export_surfaces.write_ply
    ),
    ExchangeFormat("glb", "glTF mesh, mesh.glb", ("surface",), "the same; y up, m", SURFACE_LOST, export_surfaces.write_glb),
    ExchangeFormat(
        "obj", "Wavefront OBJ, obj/mesh.obj", ("surface",), "the same, albedo as texture; y up, m", SURFACE_LOST, export_surfaces.write_obj
    ),
    ExchangeFormat(
        "stl", "STL, mesh.stl", ("surface",), "faces; y up, mm", f"measured normals, colours, {SURFACE_LOST}", export_surfaces.write_stl
    ),
    ExchangeFormat(
        "depth-tiff",
        "TIFF float32, depth_m.tif",
        ("surface",),
        "depth and its standard deviation, unit in the description",
        "normals, albedo, mask but for NaN",
        export_surfaces.write_depth_tiff,
    ),
    ExchangeFormat(
        "depth-exr",
        "OpenEXR float32, depth_m.exr",
        ("surface",),
        "depth, normals, albedo, standard deviations, unit in the comments",
        "pieces but for their sigma",
        export_surfaces.write_depth_exr,
    ),
    ExchangeFormat(
        "points",
        "point cloud, points.ply",
        ("surface",),
        "a point a pixel with normal, colour, sigma, piece; C, m",
        "faces",
        export_surfaces.write_points,
    ),
    ExchangeFormat(
        "normals",
        "normal maps, normals_gl.png, normals_dx.png",
        ("surface",),
        "normals in 16 bit, green up (glTF, Blender) and down (DirectX)",
        "all else",
        export_surfaces.write_normals,
    ),
)
OWN = (*CAMERAS, *POSES, *LIGHTS, *WHOLE, *RELIGHTABLE, *SURFACES)
"""lpcal's own formats, in the order of `lpcal export --list`."""

ADDED: dict[str, ExchangeFormat] = {}
"""Formats that this program has registered, by name."""


def register(added: ExchangeFormat) -> None:
    """Add a format, or another one under its name."""
    ADDED[added.name] = added


def known_formats() -> dict[str, ExchangeFormat]:
    """All formats by name: lpcal's own in their order, then those of installed packages, then the program's.

    Raises
    ------
    InputError
        An installed package names what is no format.
    """
    return {one.name: one for one in (*OWN, *of_packages())} | ADDED


def of_packages() -> tuple[ExchangeFormat, ...]:
    """The formats of installed packages."""
    return installed(GROUP, ExchangeFormat, "an ExchangeFormat")


def formats_of(names: list[str]) -> list[ExchangeFormat]:
    """The formats of these names, each once.

    Raises
    ------
    UsageError
        No format has a name; near ones are named.
    """
    from difflib import get_close_matches

    known = known_formats()
    for name in names:
        if name not in known:
            near = get_close_matches(name.lower(), known, n=3)
            todo = f"did you mean {' or '.join(near)}?" if near else "lpcal export --list names them"
            raise UsageError(f"no format is called {name}", needed=f"one of {', '.join(known)}", todo=todo)
    return [known[name] for name in dict.fromkeys(names)]
