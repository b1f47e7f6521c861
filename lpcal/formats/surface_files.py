"""The folder of a reconstructed surface: surface.npz, images, meshes, summary.json; whole or not there.

``surface.npz`` holds ``normals`` (H, W, 3) in C, turned towards the camera; ``depth`` (H, W) metres along z of C; ``albedo``
(H, W[, 3]); ``mask`` (H, W) bool; ``normal_std_deg`` (H, W) an axis; ``depth_std`` (H, W) metres, of the shape, the distance apart;
``lights_used`` (H, W); ``component`` (H, W), 0 outside, 1 and up a connected piece each; NaN outside the mask. ``summary.json``
holds a piece's ``label, pixels, mean_depth_m, scale_std`` and its ``alternatives`` under ``components``, and times, counts, residuals
and versions.

``normals_gl.png`` has x right, y up, z to the camera, each from -1..1 to 0..65535, black outside the mask. ``mesh.ply`` is in C;
``mesh.glb`` has glTF's axes (y up, z to the viewer). Of a capture that is placed both may be in the room's frame, or in that of the body
that the object rides on, with the axes of that frame as the tracking has them.
"""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable, Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal import __version__
from lpcal.errors import InputError
from lpcal.formats.document_numbers import number
from lpcal.formats.documents import plain
from lpcal.formats.mesh_files import Numbers, glb, glb_holds, ply
from lpcal.formats.outputs import summarised, whole
from lpcal.formats.placement_document import placement_document, placement_from_document
from lpcal.formats.reading import reading
from lpcal.formats.record_documents import document_of, record_of
from lpcal.geometry import se3
from lpcal.integration.mesh import DISPLAY_GAMMA, MeshBands
from lpcal.records.figures import SurfaceFigures
from lpcal.records.placement import Placement
from lpcal.records.surface import Component, Surface, SurfaceSummary
from lpcal.view import parallel

MAPS = ("normals", "depth", "albedo", "mask", "normal_std_deg", "depth_std", "lights_used", "component")
BAND_ROWS = 512
"""Rows of a picture that are made at once."""
GLTF_FROM_C = np.array([1.0, -1.0, -1.0], np.float32)
LINEAR = ((np.arange(256) / 255) ** DISPLAY_GAMMA).astype(np.float32)
"""Light, as a share of white, of each display number."""
SUMMARY = "summary.json"
PAGE = "relight.html"
MAPS_FILE = "surface.npz"
OUTPUTS = {
    "maps": MAPS_FILE,
    "normals": "normals_gl.png",
    "depth": "depth.tif",
    "albedo": "albedo.png",
    "mask": "mask.png",
    "ply": "mesh.ply",
    "glb": "mesh.glb",
    "page": PAGE,
}
"""The files of a surface besides summary.json, by the word that asks for each."""
FILES = {*OUTPUTS.values(), SUMMARY}


SURFACE = summarised("the folder of a surface", "surface", SUMMARY, FILES)
"""A surface's folder, as an output: one may replace another."""


def write_surface(
    folder: Path,
    surface: Surface,
    summary: Mapping[str, Any],
    page: Callable[[], str] | None = None,
    outputs: Collection[str] = frozenset(OUTPUTS),
    *,
    placed_mesh: bool = False,
) -> None:
    """Write the files of a surface that `outputs` names, and summary.json; `page` makes the relighting page.

    Cores share the files. With `placed_mesh` the meshes of a surface that is placed are in the room, or in the body that the object rides
    on.

    Raises
    ------
    UsageError, InputError
        As `whole`: something else than a surface stands there.
    """
    with whole(folder, SURFACE) as draft:
        draft.mkdir()

        def write_page() -> None:
            if page is not None and "page" in outputs:
                (draft / PAGE).write_text(page(), encoding="utf-8")

        said: list[str] = []
        works: list[Callable[[], None]] = [
            write_page,
            lambda: _write_maps(draft, surface, outputs),
            lambda: said.extend(write_meshes(draft, surface, outputs, surface.placement if placed_mesh else None)),
            lambda: _write_images(draft, surface, outputs),
        ]
        parallel.run_all(lambda work: work(), works)
        files = {path.name: path.stat().st_size for path in sorted(draft.iterdir())}
        notes = {"notes": [*summary["notes"], *said]} if said else {}
        (draft / SUMMARY).write_text(json.dumps(plain({**summary, **notes, "files": files}), indent=1) + "\n", encoding="utf-8")


def _write_maps(draft: Path, surface: Surface, outputs: Collection[str]) -> None:
    if "maps" not in outputs:
        return
    maps = {name: getattr(surface, name) for name in MAPS}
    layer = surface.layer if surface.layer.size else surface.mask.astype(np.uint8)
    _write_arrays(
        draft / MAPS_FILE, {**maps, "layer": layer, "breaks": surface.breaks}, {"rays": surface.rays_C.astype(np.float32, copy=False)}
    )


def _write_arrays(path: Path, arrays: Mapping[str, npt.NDArray[np.generic]], plain: Mapping[str, npt.NDArray[np.generic]]) -> None:
    """As `numpy.savez_compressed`, but with the quickest compression: the best takes three times as long for a tenth of the size.

    What is `plain` is stored as it is: of rays a compressor finds next to nothing.
    """
    with zipfile.ZipFile(path, "w", compresslevel=1) as archive:
        for name, values in {**arrays, **plain}.items():
            of = zipfile.ZipInfo(f"{name}.npy")
            of.compress_type = zipfile.ZIP_STORED if name in plain else zipfile.ZIP_DEFLATED
            with archive.open(of, "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.asanyarray(values), allow_pickle=False)


def summary_of(surface: Surface) -> dict[str, Any]:
    """What summary.json says of a surface itself; whoever made it adds times, inputs and options."""
    return {
        "lpcal": 1,
        "kind": "surface",
        "name": surface.name,
        "units": "metres" if surface.metric else "pixels",
        "components": [document_of(component) for component in surface.components],
        "counts_and_residuals": document_of(surface.figures),
        "mask_doubt": surface.figures.mask_doubt,
        "mask_doubt_why": surface.figures.mask_doubt_why,
        "versions": {"lpcal": __version__},
        "sensor": None if surface.sensor is None else surface.sensor.document(),
        "notes": list(surface.warnings),
        "placement": None if surface.placement is None else placement_document(surface.placement),
    }


def read_surface(folder: Path) -> Surface:
    """Read a surface back from its folder.

    Raises
    ------
    InputError
        surface.npz or summary.json is not there or lacks a part.
    """
    try:
        with np.load(folder / "surface.npz") as stored:
            maps = {name: stored[name] for name in (*MAPS, "layer", "rays", "breaks")}
        summary = json.loads((folder / SUMMARY).read_text(encoding="utf-8"))
        components = tuple(_component(entry) for entry in summary["components"])
        placement = placement_from_document(summary["placement"]) if summary.get("placement") else None
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise InputError(
            f"no whole surface ({error})", where=str(folder), needed="what lpcal reconstruct writes", todo="run lpcal reconstruct"
        ) from error
    said = tuple(str(note) for note in summary.get("notes") or ())
    name, rays_C = summary.get("name", folder.name), maps.pop("rays").astype(float)
    return Surface(name=name, rays_C=rays_C, components=components, warnings=said, placement=placement, **maps)


def is_placed(folder: Path) -> bool:
    """Whether a surface's folder says where it was taken; of one that cannot be read, that is found when it is."""
    try:
        return json.loads((folder / SUMMARY).read_text(encoding="utf-8")).get("placement") is not None
    except (OSError, ValueError, AttributeError):
        return True


def read_summary(path: Path) -> SurfaceSummary:
    """Read a summary.json.

    Raises
    ------
    InputError
        It cannot be read, or a value in it is something else.
    """
    with reading(path, "a summary that lpcal wrote"):
        return summary_from_document(json.loads(path.read_text(encoding="utf-8")))


def summary_from_document(document: dict[str, Any]) -> SurfaceSummary:
    """What summary.json holds, as it was written.

    Raises
    ------
    KeyError, TypeError, ValueError
        A key is lacking or holds something else.
    """
    return SurfaceSummary(
        metric=document.get("units") != "pixels",
        components=tuple(_component(entry) for entry in document.get("components") or ()),
        figures=record_of(SurfaceFigures, document.get("counts_and_residuals") or {}),
        notes=tuple(str(note) for note in document.get("notes") or ()),
        times_s={str(key): float(value) for key, value in (document.get("times_s") or {}).items()},
        peak_memory_mb=number(document, "peak_memory_mb"),
    )


def _component(entry: dict[str, Any]) -> Component:
    """A piece as summary.json has it."""
    return record_of(Component, entry)


def normals_gl(surface: Surface) -> npt.NDArray[np.uint16]:
    """Normals (H, W, 3) as 16 bit RGB: x right, y up, z to the camera."""
    found = np.zeros(surface.normals.shape, np.uint16)
    for rows in _bands(found):
        inside = surface.mask[rows]
        turned = np.nan_to_num(surface.normals[rows][inside]) * GLTF_FROM_C
        found[rows][inside] = np.rint((turned + 1) / 2 * 65535)
    return found


def albedo_16(surface: Surface) -> npt.NDArray[np.uint16]:
    """Albedo (H, W[, 3]) as 16 bit, linear; full scale is the 99.9th percentile."""
    inside = surface.albedo[surface.mask]
    top = float(np.nanpercentile(inside, 99.9)) if inside.size else 1.0
    found = np.empty(surface.albedo.shape, np.uint16)
    for rows in _bands(found):
        found[rows] = np.rint(65535 * np.clip(np.nan_to_num(surface.albedo[rows]) / max(top, 1e-12), 0, 1))
    return found


def _bands(image: npt.NDArray[Any]) -> list[slice]:
    """Rows of an image that are turned into numbers at once: what that takes is several times the image."""
    return [slice(first, first + BAND_ROWS) for first in range(0, len(image), BAND_ROWS)]


def _write_images(draft: Path, surface: Surface, outputs: Collection[str]) -> None:
    if "normals" in outputs:
        _write_image(draft / OUTPUTS["normals"], normals_gl(surface))
    if "albedo" in outputs:
        _write_image(draft / OUTPUTS["albedo"], albedo_16(surface))
    if "mask" in outputs:
        _write_image(draft / OUTPUTS["mask"], np.asarray(255 * surface.mask, np.uint8))
    if "depth" in outputs:
        _write_image(draft / OUTPUTS["depth"], surface.depth)


def _write_image(path: Path, pixels: npt.NDArray[Any]) -> None:
    """Write an image (H, W) or (H, W, 3) as PNG or TIFF; its colours are turned over in their place: a large one is not held twice."""
    import cv2

    for rows in _bands(pixels) if pixels.ndim == 3 else ():
        pixels[rows] = pixels[rows, :, ::-1].copy()
    deflated = [cv2.IMWRITE_TIFF_COMPRESSION, cv2.IMWRITE_TIFF_COMPRESSION_ADOBE_DEFLATE]
    plainly = [cv2.IMWRITE_TIFF_PREDICTOR, cv2.IMWRITE_TIFF_PREDICTOR_NONE]  # which every reader knows
    encoded, data = cv2.imencode(path.suffix, pixels, [*deflated, *plainly] if path.suffix == ".tif" else [])
    if not encoded:
        raise InputError("cannot be encoded", where=str(path))
    path.write_bytes(memoryview(data))


def write_meshes(draft: Path, surface: Surface, outputs: Collection[str], placement: Placement | None = None) -> list[str]:
    """mesh.ply in C with display colours, as its viewers take them; mesh.glb in glTF's axes, matte, with linear colours, as glTF asks.

    With a placement both are in its frame. Notes on what is left out.
    """
    if not {"ply", "glb"} & set(outputs):
        return []
    made, unit = MeshBands.of(surface), "metres" if surface.metric else "pixels"
    frame, origin = "glTF's axes of C: x right, y up, z to the camera", "the camera"
    ply_frame, turn = "C: x right, y down, z forward", GLTF_FROM_C
    if placement is not None:
        frame, origin = f"{placement.frame}, its axes as the tracking has them", placement.frame
        ply_frame = f"{placement.name[2]}: {_plain_words(placement.frame)}"
        turn = np.ones(3, np.float32)

    def points() -> Iterator[Numbers]:
        for band in made.points_C():
            yield band if placement is None else se3.apply(placement.H_AC, band.astype(float)).astype(np.float32)

    def normals() -> Iterator[Numbers]:
        for band in made.normals_C():
            yield band if placement is None else se3.rotate(placement.H_AC, band.astype(float)).astype(np.float32)

    sizes = made.vertices, sum(made.triangles)
    if "ply" in outputs:
        opaque = (np.pad(band, [(0, 0), (0, 1)], constant_values=255) for band in made.colours())
        with (draft / OUTPUTS["ply"]).open("wb") as stream:
            stream.writelines(ply(sizes, zip(points(), normals(), opaque, strict=True), made.faces(), [f"frame {ply_frame}, {unit}"]))
    if "glb" in outputs and not glb_holds(sizes):
        return [f"mesh.glb is left out: a GLB holds no more than 4 GB, and {sizes[0]} vertices take more; mesh.ply has them"]
    if "glb" in outputs:
        attributes = {
            "POSITION": lambda: (band * turn for band in points()),
            "NORMAL": lambda: (band * turn for band in normals()),
            "COLOR_0": lambda: (LINEAR[band] for band in made.colours()),
        }
        with (draft / OUTPUTS["glb"]).open("wb") as stream:
            stream.writelines(glb(sizes, attributes, made.faces, {"frame": f"{frame}, {unit}", "origin": origin}))
    return []


def _plain_words(text: str) -> str:
    """A text as a line of a PLY's head may hold it."""
    return " ".join(text.encode("ascii", "replace").decode().split())
