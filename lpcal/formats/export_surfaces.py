"""A surface for other programs: meshes (PLY, GLB, OBJ with texture, STL), depth maps (EXR, TIFF) and a point cloud with sigma.

PLY, depth maps and points are in C (x right, y down, z forward), metres; GLB and OBJ have x right, y up, z to the camera, metres; STL the
same axes in millimetres, as printers take it. Without a camera the unit is the pixel. Sources: Wavefront OBJ and MTL; the STL
specification of 1989; OpenEXR's documentation, channel names.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal import __version__
from lpcal.errors import InputError
from lpcal.formats.surface_files import GLTF_FROM_C, normals_gl, write_meshes
from lpcal.integration.mesh import build, colours, points_C
from lpcal.records.exchange import ExchangeContent
from lpcal.records.surface import Surface

MM = 1e3
"""Millimetres in a metre."""
SAYS = f"written by lpcal {__version__}"
STL_HEAD = 80
"""Bytes of an STL's heading, by the format."""


def surface_of(content: ExchangeContent) -> Surface:
    """The surface, which a format's `needs` promises."""
    assert content.surface is not None
    return content.surface


def unit_of(surface: Surface) -> str:
    """The unit of a surface's lengths."""
    return "metres" if surface.metric else "pixels"


def write_ply(content: ExchangeContent, folder: Path) -> list[str]:
    """mesh.ply: vertices, measured normals, colours, faces."""
    surface = surface_of(content)
    return write_meshes(folder, surface, {"ply"})


def write_glb(content: ExchangeContent, folder: Path) -> list[str]:
    """mesh.glb: the same in glTF's axes."""
    surface = surface_of(content)
    return write_meshes(folder, surface, {"glb"})


def write_obj(content: ExchangeContent, folder: Path) -> list[str]:
    """obj/: mesh.obj with mesh.mtl and the albedo as albedo.png, a texel a pixel."""
    from lpcal.formats.export_images import write_png

    surface = surface_of(content)
    mesh = build(surface)
    target = folder / "obj"
    target.mkdir()
    height, width = surface.mask.shape
    uv = (mesh.pixels + 0.5) / [width, height]
    uv[:, 1] = 1 - uv[:, 1]
    corners = np.repeat(mesh.faces + 1, 3, axis=1)
    lines = [f"# {SAYS}; x right, y up, z to the camera; {unit_of(surface)}", "mtllib mesh.mtl", "o surface", "usemtl albedo"]
    lines += _rows("v %.9g %.9g %.9g", mesh.vertices_C * GLTF_FROM_C)
    lines += _rows("vt %.9g %.9g", uv)
    lines += _rows("vn %.7g %.7g %.7g", mesh.normals_C * GLTF_FROM_C)
    lines += _rows("f %d/%d/%d %d/%d/%d %d/%d/%d", corners)
    (target / "mesh.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")
    material = f"# {SAYS}\nnewmtl albedo\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd albedo.png\n"
    (target / "mesh.mtl").write_text(material, encoding="utf-8")
    write_png(target / "albedo.png", colours(surface))
    return []


def _rows(form: str, values: npt.NDArray[Any]) -> list[str]:
    return [form % tuple(row) for row in values.tolist()]


def write_stl(content: ExchangeContent, folder: Path) -> list[str]:
    """mesh.stl: the faces in millimetres, binary."""
    surface = surface_of(content)
    mesh = build(surface)
    unit = "mm" if surface.metric else "pixels"
    triangles = (mesh.vertices_C * GLTF_FROM_C * (MM if surface.metric else 1.0)).astype("<f4")[mesh.faces]
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    stored = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    stored["normal"] = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-30)
    stored["corners"] = triangles
    heading = f"{SAYS}; {unit}; x right, y up, z to the camera".encode()[:STL_HEAD].ljust(STL_HEAD)
    (folder / "mesh.stl").write_bytes(heading + np.array([len(stored)], "<u4").tobytes() + stored.tobytes())
    return ["an open surface, as it was seen: a printer needs it closed to a solid"]


def _described(surface: Surface) -> dict[str, Any]:
    """What a depth map says of itself."""
    scale = [piece.scale_std for piece in surface.components]
    return {
        "software": SAYS,
        "depth": f"along z of the camera, {unit_of(surface)}; NaN where nothing was measured",
        "depth_std": f"one standard deviation of the shape, {unit_of(surface)}, the distance of a whole piece apart",
        "scale_std": f"relative, of each piece's distance: {', '.join(f'{value:.3g}' for value in scale)}",
        "unit": "m" if surface.metric else "px",
    }


def write_depth_tiff(content: ExchangeContent, folder: Path) -> list[str]:
    """depth_m.tif: two pages of float32, the depth and its standard deviation; the description says the unit, in JSON."""
    import tifffile

    surface = surface_of(content)
    name = "depth_m.tif" if surface.metric else "depth_px.tif"
    said = _described(surface)
    with tifffile.TiffWriter(folder / name) as stream:
        for page in ("depth", "depth_std"):
            description = json.dumps({"page": page, **said}, ensure_ascii=True)
            pixels = getattr(surface, page).astype(np.float32)
            stream.write(pixels, compression="zlib", description=description, software=SAYS, metadata=None)
    return []


def write_depth_exr(content: ExchangeContent, folder: Path) -> list[str]:
    """depth_m.exr: float32 channels Z, Z_std, normals N.X N.Y N.Z (x right, y up, z to the camera), their sigma, albedo R G B.

    Raises
    ------
    InputError
        The package OpenEXR is not there.
    """
    try:
        import OpenEXR
    except ImportError as error:
        raise InputError("OpenEXR is not installed", where="--format depth-exr", needed="lpcal[exr]", todo="uv add 'lpcal[exr]'") from error
    surface = surface_of(content)
    normals = surface.normals * GLTF_FROM_C
    albedo = surface.albedo if surface.albedo.ndim == 3 else np.repeat(surface.albedo[..., None], 3, axis=2)
    channels = {"Z": surface.depth, "Z_std": surface.depth_std, "N_std_deg": surface.normal_std_deg}
    channels |= {f"N.{axis}": normals[..., k] for k, axis in enumerate("XYZ")}
    channels |= {channel: albedo[..., k] for k, channel in enumerate("RGB")}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, "comments": json.dumps(_described(surface))}
    stored = {name: np.ascontiguousarray(values, np.float32) for name, values in channels.items()}
    with OpenEXR.File(header, stored) as file:
        file.write(str(folder / ("depth_m.exr" if surface.metric else "depth_px.exr")))
    return []


def write_points(content: ExchangeContent, folder: Path) -> list[str]:
    """points.ply: a point a pixel, with its normal, colour and standard deviations."""
    surface = surface_of(content)
    inside = surface.mask & np.isfinite(surface.depth)
    spread = surface.depth_std * np.linalg.norm(surface.rays_C, axis=-1)
    columns: dict[str, npt.NDArray[Any]] = {
        **{axis: points_C(surface)[..., k] for k, axis in enumerate("xyz")},
        **{f"n{axis}": surface.normals[..., k] for k, axis in enumerate("xyz")},
        "sigma": spread,
        "sigma_normal_deg": surface.normal_std_deg,
    }
    fields: list[tuple[str, str]] = [
        *((name, "<f4") for name in columns),
        *((name, "u1") for name in ("red", "green", "blue")),
        ("piece", "u1"),
    ]
    stored = np.zeros(int(inside.sum()), dtype=fields)
    for name, values in columns.items():
        stored[name] = values[inside]
    shown = colours(surface)[inside]
    for k, name in enumerate(("red", "green", "blue")):
        stored[name] = shown[:, k]
    stored["piece"] = surface.component[inside]
    kinds = {"<f4": "float", "u1": "uchar"}
    heading = [
        "ply",
        "format binary_little_endian 1.0",
        f"comment {SAYS}; frame C: x right, y down, z forward, {unit_of(surface)}",
        "comment sigma: along the line of sight, of the shape, the distance of a whole piece apart",
        *(f"comment piece {piece.label}: relative sigma of its distance {piece.scale_std:.4g}" for piece in surface.components),
        f"element vertex {len(stored)}",
        *(f"property {kinds[kind]} {name}" for name, kind in fields),
        "end_header\n",
    ]
    (folder / "points.ply").write_bytes("\n".join(heading).encode() + stored.tobytes())
    return []


def write_normals(content: ExchangeContent, folder: Path) -> list[str]:
    """normals_gl.png, 16 bit (x right, y up, z to the camera), and normals_dx.png, the same with green turned over."""
    from lpcal.formats.export_images import write_png

    surface = surface_of(content)
    pixels = normals_gl(surface)
    write_png(folder / "normals_gl.png", pixels)
    turned = pixels.copy()
    turned[surface.mask, 1] = np.iinfo(np.uint16).max - turned[surface.mask, 1]
    write_png(folder / "normals_dx.png", turned)
    return []
