"""Pictures as PNG and data: URIs; in notebooks maps are PNG, lights and corners SVG, each one HTML element that needs nothing else."""

from __future__ import annotations

import base64
import html
import struct
import zlib
from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array, Image
from lpcal.records.surface import Surface

PNG, ABOVE = b"\x89PNG\r\n\x1a\n", 2
"""How a PNG begins, and its name for rows that are stored as what they differ by from the one above."""
WIDTH_PX = 320
"""Width of a picture on a notebook's page, in its pixels: two stand side by side."""
MARGIN = 0.15
"""Share of a drawing's size that is left free at each side for names."""


def png(pixels: npt.NDArray[np.uint8]) -> bytes:
    """Pixels (H, W), (H, W, 3) or (H, W, 4) as a PNG file's content: each row as what it differs by from the one above it."""
    height, width = pixels.shape[:2]
    colours = {1: 0, 3: 2, 4: 6}[pixels[0, :1].size]
    rows = pixels.reshape(height, -1)
    stored = np.full((height, rows.shape[1] + 1), ABOVE, np.uint8)
    stored[:, 1:] = np.diff(rows, axis=0, prepend=np.uint8(0))
    head = struct.pack(">IIBBBBB", width, height, 8, colours, 0, 0, 0)
    chunks = (b"IHDR" + head, b"IDAT" + zlib.compress(stored.tobytes()), b"IEND")
    return PNG + b"".join(struct.pack(">I", len(one) - 4) + one + struct.pack(">I", zlib.crc32(one)) for one in chunks)


def data_uri(content: bytes, media: str = "image/png") -> str:
    """Content as a data: URI."""
    return f"data:{media};base64,{base64.b64encode(content).decode('ascii')}"


def surface(found: Surface) -> str:
    """The normals, x to red, y (up) to green, z (to the camera) to blue, beside the depth."""
    facing = np.nan_to_num(found.normals) * np.array([1.0, -1.0, -1.0])
    rgb = np.where(found.mask[..., None], np.rint(127.5 * (facing + 1)), 255).astype(np.uint8)
    return _png(rgb, "normals") + heat(np.where(found.mask, found.depth, np.nan).astype(np.float32), "depth, near is bright", turn=True)


def heat(values: Image, title: str, *, turn: bool = False) -> str:
    """A map (H, W) from its 1st to its 99th percentile, dark to bright (`turn`: bright to dark), white where it is NaN."""
    known = np.isfinite(values)
    low, high = np.percentile(values[known], [1, 99]) if known.any() else (0.0, 1.0)
    share = np.clip((np.nan_to_num(values) - low) / max(high - low, 1e-12), 0, 1)
    shade = 1 - share if turn else share
    return _png(np.where(known, np.rint(30 + 200 * shade), 255).astype(np.uint8), title)


def grey(image: Image) -> str:
    """An image (H, W[, 3]) whose brightest hundredth is white."""
    top = float(np.percentile(image, 99)) or 1.0
    return _png(np.rint(255 * np.clip(image / top, 0, 1) ** (1 / 2.2)).astype(np.uint8), "mean over the lights")


def lights(places_C: Mapping[str, Array]) -> str:
    """Lights about the optical axis as the camera sees them: x right, y down."""
    x = np.array([place[:2] for place in places_C.values()]).reshape(-1, 2)
    reach = max(float(np.abs(x).max(initial=0.0)), 1e-9)
    places = WIDTH_PX * (0.5 + (0.5 - MARGIN) * x / reach)
    dots = "".join(
        f"<circle cx='{u:.1f}' cy='{v:.1f}' r='5' fill='#e0a000'/>"
        f"<text x='{u + 7:.1f}' y='{v + 4:.1f}' font-size='11'>{html.escape(name)}</text>"
        for name, (u, v) in zip(places_C, places, strict=True)
    )
    middle = WIDTH_PX / 2
    return _svg(f"<circle cx='{middle}' cy='{middle}' r='3'/>{dots}", WIDTH_PX, "lights about the camera: x right, y down")


def points(corners_px: Sequence[Array], image_size: tuple[int, int]) -> str:
    """Corners of all views in the image."""
    scale = WIDTH_PX / image_size[0]
    seen = [corners[np.isfinite(corners).all(axis=1)] * scale for corners in corners_px]
    dots = "".join(f"<circle cx='{u:.1f}' cy='{v:.1f}' r='1' fill='#2060c0'/>" for view in seen for u, v in view)
    return _svg(dots, image_size[1] * scale, "corners of all views")


def _svg(inside: str, height: float, title: str) -> str:
    frame = f"<rect width='{WIDTH_PX}' height='{height:.0f}' fill='none' stroke='#aaa'/>"
    return f"<svg width='{WIDTH_PX}' height='{height:.0f}' role='img'><title>{html.escape(title)}</title>{frame}{inside}</svg>"


def _png(pixels: npt.NDArray[np.uint8], title: str) -> str:
    from PIL import Image as Pillow

    small = Pillow.fromarray(pixels)
    small.thumbnail((2 * WIDTH_PX, 2 * WIDTH_PX))
    return f"<img width='{WIDTH_PX}' alt='{html.escape(title)}' title='{html.escape(title)}' src='{data_uri(png(np.asarray(small)))}'/>"
