"""A simulated capture as a folder: its images, as small as PNG makes them, and its capture.yaml."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats.outputs import write_text
from lpcal.simulate.captures import Capture
from lpcal.simulate.sensor import Stored


def write_capture(folder: Path, capture: Capture, more: Sequence[str] = ()) -> None:
    """A capture folder; `more` are further lines of its capture.yaml."""
    for name, image in capture.images.items():
        write_image(folder / f"{name}.png", image)
    lines = [*more, f"exposure: {1e3 * capture.exposure_s:g} ms", "gain: 1.0"]
    if capture.distance_m is not None:
        lines.append(f"distance: {1e3 * capture.distance_m:.1f} mm")
    if capture.exposures_s:
        lines.append("exposures: {" + ", ".join(f"{name}: {1e3 * seconds:g} ms" for name, seconds in capture.exposures_s.items()) + "}")
    write_text(folder / "capture.yaml", "\n".join(lines) + "\n")


def write_image(path: Path, image: Stored) -> None:
    """A noisy image packs best without a search for repeats, a dark one with runs: the smaller of the two is kept."""
    import cv2

    path.parent.mkdir(parents=True, exist_ok=True)
    ways = [cv2.IMWRITE_PNG_STRATEGY_HUFFMAN_ONLY, cv2.IMWRITE_PNG_STRATEGY_RLE] if path.suffix.lower() == ".png" else [None]
    if not cv2.haveImageWriter(path.name):
        raise InputError(
            "cannot be written as an image", where=str(path), needed="a name that ends in .png or .tif", todo="change the pattern"
        )
    packed = [cv2.imencode(path.suffix, image, [] if way is None else [cv2.IMWRITE_PNG_STRATEGY, way])[1].tobytes() for way in ways]
    path.write_bytes(min(packed, key=len))
