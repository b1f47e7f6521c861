"""calibration.mat: the whole calibration as plain matrices for MATLAB, Octave and scipy.

``K``, ``distortion`` (k1 k2 p1 p2 k3 ...), ``image_size`` (width, height), ``H_PC``; a light a row: ``H_CL`` (4 L x 4, one under the
other), ``source_C`` and ``axis_C`` (L x 3, metres), ``direction_C``, ``intensity`` (L x 1 or L x 3), ``position_std_m``,
``direction_std_deg``; ``focus_C``, ``d_object_m``; of the distance sensor ``distance_position_C``, ``distance_direction_C`` (1 x 3) and
``distance_bias_scale_noise`` (1 x 3; a reading is bias + scale t at the point position + t direction); ``lobe_deg`` (A x 1) and ``lobe``
(A x L), each light's intensity over the angle from its axis. Pixel centres are at whole numbers from 0; ``K_matlab`` counts them from 1,
as MATLAB's `cameraParameters` does.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.camera_coefficients import central_camera
from lpcal.formats.export_lens import with_room_for
from lpcal.formats.export_lobe import round_lobe
from lpcal.formats.light_tables import sane_lights
from lpcal.formats.mat_file import read_matrices
from lpcal.formats.reading import reader
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Light, Lobe
from lpcal.records.exchange import ExchangeContent

FILE = "calibration.mat"
LOBE_DEG = np.arange(0.0, 90.5, 0.5)
"""Angles of the lobes' tables, degrees: what lies between is a straight line off by less than 1e-4 of the lobe."""


def write_matlab(content: ExchangeContent, folder: Path) -> list[str]:
    """Write calibration.mat."""
    from scipy.io import savemat

    calibration, said = content.calibration, list[str]()
    stored: dict[str, Array] = {}
    if calibration.camera is not None:
        wanted = 8 if calibration.camera.spline is not None else max(calibration.camera.distortion.size, 5)
        camera, said = with_room_for(calibration.camera, wanted)
        first = np.eye(3)
        first[:2, 2] = 1
        stored |= {"K": camera.K, "K_matlab": first @ camera.K, "distortion": camera.distortion[None]}
        stored |= {"image_size": np.array([camera.image_size], float)}
    if calibration.H_PC is not None:
        stored["H_OC" if calibration.carries == "board" else "H_PC"] = calibration.H_PC
    if calibration.lights:
        stored |= _lights(calibration.lights)
    if calibration.focus_C is not None:
        stored["focus_C"] = calibration.focus_C[None]
    if calibration.d_object_m is not None:
        stored["d_object_m"] = np.array([[calibration.d_object_m]])
    if calibration.distance_sensor is not None:
        beam = calibration.distance_sensor
        stored |= {"distance_position_C": beam.position_C[None], "distance_direction_C": beam.direction_C[None]}
        stored["distance_bias_scale_noise"] = np.array([[beam.bias_m, beam.scale, beam.noise_m]])
    if not stored:
        raise InputError("nothing of a calibration", where="--format matlab", needed="a camera, its place or lights")
    savemat(folder / FILE, stored, format="5")
    names = ", ".join(light.name for light in calibration.lights)
    return [*said, f"rows are the lights {names}"] if names else said


def _lights(lights: tuple[Light, ...]) -> dict[str, Array]:
    nothing = np.full(3, np.nan)
    colours = max(light.intensity.size for light in lights)
    stored = {
        "direction_C": np.array([light.direction_C for light in lights]),
        "intensity": np.array([np.broadcast_to(light.intensity, (colours,)) for light in lights]),
        "position_std_m": np.array([[light.position_std_m] for light in lights]),
        "direction_std_deg": np.degrees([[light.direction_std_rad] for light in lights]),
        "intensity_std": np.array([[light.intensity_std] for light in lights]),
    }
    if any(light.source_C is not None for light in lights):
        stored["source_C"] = np.array([nothing if light.source_C is None else light.source_C for light in lights])
        stored["axis_C"] = np.array([nothing if light.axis_C is None else light.axis_C for light in lights])
        stored["lobe_deg"] = LOBE_DEG[:, None]
        stored["lobe"] = np.stack([round_lobe(light, np.radians(LOBE_DEG)) for light in lights], axis=1)
    if all(light.H_CL is not None for light in lights):
        stored["H_CL"] = np.concatenate([light.H_CL for light in lights if light.H_CL is not None])
    return stored


def is_matlab(path: Path) -> bool:
    """Whether a file is one that lpcal wrote for MATLAB."""
    return path.is_file() and path.suffix.lower() == ".mat" and bool({"direction_C", "image_size", "H_PC", "H_OC"} & set(_held(path)))


def _held(path: Path) -> dict[str, Array]:
    try:
        return read_matrices(path)
    except Exception:  # noqa: BLE001 - whatever it is, it is none of ours
        return {}


@reader("a calibration.mat that lpcal wrote")
def read_matlab(path: Path) -> Calibration:
    """Read a calibration.mat; lights are named L0, L1, ..."""
    stored = read_matrices(path)
    camera = None
    if "image_size" in stored:
        width, height = stored["image_size"].ravel()
        K = stored["K"]
        camera = central_camera((width, height), (K[0, 0], K[1, 1], K[0, 2], K[1, 2]), list(stored["distortion"].ravel()), str(path))
    carried = "H_OC" in stored
    lights = tuple(_light(stored, k) for k in range(len(stored["direction_C"]))) if "direction_C" in stored else ()
    found = Calibration(
        path.stem,
        lights,
        camera,
        stored["H_OC" if carried else "H_PC"] if carried or "H_PC" in stored else None,
        float(stored["d_object_m"][0, 0]) if "d_object_m" in stored else None,
        stored["focus_C"].ravel() if "focus_C" in stored else None,
    )
    found = replace(found, carries="board") if carried else found
    return sane_lights(found, str(path)) if lights else found


def _light(stored: dict[str, Array], k: int) -> Light:
    near = "source_C" in stored and bool(np.isfinite(stored["source_C"][k]).all())
    light = Light(
        f"L{k}",
        stored["direction_C"][k],
        stored["intensity"][k],
        stored["H_CL"][4 * k : 4 * k + 4] if "H_CL" in stored else None,
        position_std_m=float(stored["position_std_m"][k, 0]),
        direction_std_rad=float(np.radians(stored["direction_std_deg"][k, 0])),
        intensity_std=float(stored["intensity_std"][k, 0]),
    )
    if not near:
        return light
    angles, value = np.radians(stored["lobe_deg"].ravel()), stored["lobe"][:, k]
    lobe = Lobe() if np.ptp(value) < 1e-12 else Lobe("table", angle_rad=angles, value=value)
    return replace(light, source_C=stored["source_C"][k], axis_C=stored["axis_C"][k], lobe=lobe)
