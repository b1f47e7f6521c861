"""RTI: a capture that museums' viewers relight. PTM 1.2 (relight.ptm), HSH (relight.rti), and OpenLIME's folder (relight/).

Images are display-encoded (gamma 2.2), as viewers show what they compute; each is divided by the light that arrives at the working point,
so that unlike LEDs count alike. Light directions are those from the working point: u right, v up, w to the camera.

- PTM: text heading, 6 scales, 6 biases, then for red, green and blue each a byte a coefficient of u^2, v^2, uv, u, v, 1, bottom row first;
  a coefficient is ``(byte - bias) scale``, light of 255 the full scale
- HSH: text heading, float scales and biases of the terms, then a pixel's red, green and blue terms, top row first; a coefficient is
  ``byte / 255 scale + bias``, light of 1 the full scale
- OpenLIME: info.json and plane_<k>.jpg. A table over the light's direction: three components' planes a JPEG, a plane's value is
  ``(byte / 255 - bias) scale``; the basis (also in materials.bin) is a byte a node and channel, the mean first, ``byte / 255``, then the
  components, ``(byte - 127) / range``. With few lights harmonics of 4 or 9 terms, a JPEG each, instead

Sources: Malzbender et al. 2001 with the PTM format of its authors; RTIViewer's and RelightLab's readers of both.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.errors import DegenerateError
from lpcal.formats.export_images import capture_of
from lpcal.formats.export_lights import arriving, directions_up
from lpcal.geometry import relight_table, relightable
from lpcal.geometry.arrays import Array, Image
from lpcal.geometry.relight_table import RelightTable
from lpcal.geometry.relightable import RelightFit
from lpcal.integration.mesh import DISPLAY_GAMMA
from lpcal.records.exchange import ExchangeContent

OUTERMOST = 0.02
"""Percent of the coefficients at either end that are cut off before they become bytes: highlights would take all the steps."""
WHITE_PERCENTILE = 99.8
"""Percentile of the brightest image that becomes white."""
SPARE_LIGHTS = 2
"""Lights beyond the number of terms that a fit needs, lest it only repeats its images."""
COMPONENTS = 45
"""Components of a table, a multiple of three: fifteen pictures of the sixteen that every WebGL takes, one left for a viewer's normals."""
JPEG_QUALITY = 97
"""At which a plane's errors stay below one step of 8 bit on the mean."""


def write_ptm(content: ExchangeContent, folder: Path) -> list[str]:
    """relight.ptm."""
    directions, images, said = _given(content, relightable.PTM_TERMS)
    found = relightable.fit(relightable.ptm_basis(directions), images, capture_of(content).mask)
    _, scale, least = _bytes(found.coefficients)
    height, width = images.shape[1:3]
    bias = np.rint(-255 * least / scale).astype(int)
    heading = ["PTM_1.2", "PTM_FORMAT_RGB", str(width), str(height)]
    heading += [" ".join(f"{value:.9g}" for value in scale), " ".join(str(value) for value in bias)]
    stored = _with_bias(found.coefficients, scale, bias)
    body = np.moveaxis(stored[:, ::-1], 0, -1)  # bottom row first, coefficients of a pixel side by side
    blocks = b"".join(np.ascontiguousarray(body[:, :, channel]).tobytes() for channel in range(3))
    (folder / "relight.ptm").write_bytes("\n".join(heading).encode() + b"\n" + blocks)
    return [*said, _predicted(found)]


def write_hsh(content: ExchangeContent, folder: Path) -> list[str]:
    """relight.rti."""
    found, said = _harmonics(content)
    terms, height, width = found.coefficients.shape[:3]
    stored, scale, least = _bytes(found.coefficients)
    heading = f"#HSH1.2\n3\n{width} {height} 3\n{terms} 2 1\n".encode()
    numbers = np.concatenate([scale, least]).astype("<f4")
    body = np.ascontiguousarray(stored.transpose(1, 2, 3, 0))
    (folder / "relight.rti").write_bytes(heading + numbers.tobytes() + body.tobytes())
    return [*said, _predicted(found)]


def write_openlime(content: ExchangeContent, folder: Path) -> list[str]:
    """relight/: info.json, and a JPEG for every three components or for each term."""
    target = folder / "relight"
    directions, images, said = _given(content, relightable.HSH_TERMS[0])
    if len(images) < relight_table.FEWEST_LIGHTS:
        found, said = _harmonics(content, most=relightable.HSH_TERMS[1])
        stored, scale, least = _bytes(found.coefficients)
        information: dict[str, Any] = {"type": "hsh", "colorspace": "rgb", "nplanes": 3 * len(stored)}
        material = {"scale": _thrice(scale), "bias": _thrice(-least / scale)}
        said = [*said, _predicted(found)]
    else:
        tabled = relight_table.table(directions, images, DISPLAY_GAMMA, COMPONENTS, capture_of(content).mask)
        stored, information, material = _table(tabled)
        said = [*said, _told(tabled)]
    target.mkdir()
    for k, plane in enumerate(stored):
        (target / f"plane_{k}.jpg").write_bytes(_jpeg(plane))
    height, width = images.shape[1:3]
    lights = [round(float(value), 6) for value in directions.ravel()]
    information = {
        "width": width,
        "height": height,
        "format": "jpg",
        "quality": JPEG_QUALITY,
        "lights": lights,
        **information,
        "materials": [material],
    }
    (target / "info.json").write_text(json.dumps(information) + "\n", encoding="utf-8")
    if "basis" in information:
        (target / "materials.bin").write_bytes(bytes(information["basis"]))
    return said


def _table(found: RelightTable) -> tuple[npt.NDArray[np.uint8], dict[str, Any], dict[str, list[float]]]:
    """A table's planes as pictures of three (P / 3, H, W, 3), what info.json says of it, and its material."""
    planes, scale, least = _bytes(found.planes)
    reach = 127 / np.maximum(np.abs(found.basis[1:]).max(axis=(1, 2)), 1e-12)
    mean = np.rint(255 * np.clip(found.basis[:1], 0, 1))
    steps = np.rint(127 + found.basis[1:] * reach[:, None, None])
    basis = np.concatenate([mean, steps]).astype(np.uint8).ravel().tolist()
    information = {"type": "bilinear", "colorspace": "mrgb", "nplanes": len(planes), "resolution": relight_table.RESOLUTION, "basis": basis}
    material = {"scale": scale.tolist(), "bias": (-least / scale).tolist(), "range": reach.tolist()}
    return np.moveaxis(planes.reshape(-1, 3, *planes.shape[1:]), 1, -1), information, material


def _jpeg(plane: npt.NDArray[np.uint8]) -> bytes:
    """Three channels (H, W, 3) as a JPEG that keeps each at full size."""
    import cv2

    settings = [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY, cv2.IMWRITE_JPEG_SAMPLING_FACTOR, cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444]
    return bytes(cv2.imencode(".jpg", np.ascontiguousarray(plane[..., ::-1]), settings)[1].tobytes())


def _thrice(values: Array) -> list[float]:
    return [float(value) for value in np.repeat(values, 3)]


def _harmonics(content: ExchangeContent, most: int = relightable.HSH_TERMS[-1]) -> tuple[RelightFit, list[str]]:
    """The fit of the order that predicts held-out images best, of those of `most` terms that there are lights enough for."""
    directions, images, said = _given(content, relightable.HSH_TERMS[0])
    enough = [terms for terms in relightable.HSH_TERMS if terms <= most and terms + SPARE_LIGHTS <= len(images)]
    fits = [relightable.fit(relightable.hsh_basis(directions, terms), images, capture_of(content).mask) for terms in enough]
    best = min(fits, key=lambda one: float(np.mean(one.held_out)))
    return best, said


def _given(content: ExchangeContent, terms: int) -> tuple[Array, Image, list[str]]:
    """Directions (L, 3), display-encoded images (L, H, W, 3), and notes.

    Raises
    ------
    DegenerateError
        Fewer lights than a fit of so many terms needs.
    """
    capture, lights = capture_of(content), content.calibration.lights
    names = [light.name for light in lights]
    rows = [names.index(name) for name in capture.lights]
    if len(rows) < terms + SPARE_LIGHTS:
        raise DegenerateError(
            f"{len(rows)} lights", where=capture.name, needed=f"{terms + SPARE_LIGHTS} at least for {terms} terms", todo="take more lights"
        )
    vectors, said = directions_up(content)
    images = capture.images if capture.images.ndim == 4 else np.repeat(capture.images[..., None], 3, axis=3)
    images = np.nan_to_num(images) / arriving(content)[rows].astype(np.float32)[:, None, None, None]
    white = max(float(np.percentile(image, WHITE_PERCENTILE)) for image in images)
    shown = np.clip(images / max(white, 1e-12), 0, 1) ** np.float32(1 / DISPLAY_GAMMA)
    return vectors[rows], np.asarray(shown, np.float32), said


def _bytes(coefficients: Image) -> tuple[npt.NDArray[np.uint8], Array, Array]:
    """Coefficients (K, ...) as bytes, with scale (K,) and least value (K,): coefficient = byte / 255 scale + least."""
    flat = coefficients.reshape(len(coefficients), -1)
    least, most = np.percentile(flat, [OUTERMOST, 100 - OUTERMOST], axis=1)
    scale = np.maximum(most - least, 1e-6)
    steps = (flat - least[:, None]) / scale[:, None]
    stored = np.asarray(np.rint(255 * np.clip(steps, 0, 1)), np.uint8)
    return stored.reshape(coefficients.shape), scale, np.asarray(least)


def _with_bias(coefficients: Image, scale: Array, bias: npt.NDArray[np.int64]) -> npt.NDArray[np.uint8]:
    """Coefficients (K, H, W, 3) as bytes of PTM: coefficient = (byte - bias) scale / 255."""
    steps = 255 * coefficients / scale[:, None, None, None] + bias[:, None, None, None]
    return np.asarray(np.rint(np.clip(steps, 0, 255)), np.uint8)


def _told(found: RelightTable) -> str:
    missed = 100 * np.hypot(found.held_out, found.cut_off)
    mean, worst = float(np.sqrt(np.mean(missed**2))), float(missed.max())
    kept = f"{len(found.planes)} components, which leave out {100 * found.cut_off:.2g} %"
    return f"{kept}, predict an image that is held out to {mean:.2g} % of full scale (rms; {worst:.2g} % the worst light)"


def _predicted(found: RelightFit) -> str:
    mean, worst = 100 * float(np.sqrt(np.mean(found.held_out**2))), 100 * float(found.held_out.max())
    terms = len(found.coefficients)
    return f"{terms} terms predict an image that is held out to {mean:.2g} % of full scale (rms; {worst:.2g} % the worst light)"
