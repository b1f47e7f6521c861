"""Laws of what is written and read: units agree whatever they are called, and a rig survives its round through a file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import lpcal
from lpcal.geometry import se3
from lpcal.records import quantities

SAME = {
    "length": [("m", 1.0), ("cm", 1e2), ("mm", 1e3)],
    "angle": [("rad", 1.0), ("deg", 180 / np.pi)],
    "time": [("s", 1.0), ("ms", 1e3)],
}
"""Units of one kind, and how many of each make up one of the first."""


@given(st.sampled_from(sorted(SAME)), st.floats(1e-3, 1e3))
@settings(deadline=None, max_examples=60)
def test_a_quantity_is_the_same_in_every_unit(kind: str, value: float) -> None:
    found = [quantities.parse(f"{value * factor!r} {unit}", kind) for unit, factor in SAME[kind]]
    np.testing.assert_allclose(found, value, rtol=1e-12)


def rig(seed: int) -> lpcal.Calibration:
    """A rig whose every number is drawn."""
    rng = np.random.default_rng(seed)
    K = np.array([[rng.uniform(500, 900), 0, rng.uniform(300, 340)], [0, rng.uniform(500, 900), rng.uniform(220, 260)], [0, 0, 1.0]])
    camera = lpcal.Camera((640, 480), "opencv5", K, rng.normal(0, 0.05, 5) * [1, 1, 0.01, 0.01, 0.1])
    axes = rng.normal(0, 0.2, (5, 3)) + np.array([0, 0, 1.0])
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    power = rng.uniform(0.7, 1.3, 5)
    lights = tuple(
        lpcal.Light(
            f"L{k}",
            -axes[k],
            np.atleast_1d(power[k] / power.mean()),
            source_C=rng.normal(0, 0.1, 3),
            axis_C=axes[k],
            lobe=lpcal.extend.Lobe("cosine", exponent=float(rng.uniform(0.5, 5))),
        )
        for k in range(5)
    )
    return lpcal.Calibration("drawn", lights, camera, H_PC=se3.exp(rng.normal(0, 0.3, 6)), d_object_m=0.35, focus_C=np.array([0, 0, 0.35]))


@pytest.mark.parametrize("seed", range(4))
def test_a_calibration_is_read_as_it_was_written(tmp_path: Path, seed: int) -> None:
    made = rig(seed)
    lpcal.write_calibration(tmp_path / "calibration.yaml", made)
    found = lpcal.read_calibration(tmp_path / "calibration.yaml")
    assert made.camera is not None
    assert found.camera is not None
    assert found.H_PC is not None
    assert made.H_PC is not None
    np.testing.assert_allclose(found.camera.K, made.camera.K, rtol=1e-12)
    np.testing.assert_allclose(found.camera.distortion, made.camera.distortion, rtol=1e-12)
    np.testing.assert_allclose(found.H_PC, made.H_PC, atol=1e-12)
    x_C = np.random.default_rng(9).normal([0, 0, 0.35], 0.03, (20, 3))
    there, as_made = lpcal.light_field(found.lights, x_C), lpcal.light_field(made.lights, x_C)
    np.testing.assert_allclose(there.irradiance, as_made.irradiance, rtol=1e-9)
    np.testing.assert_allclose(there.direction_C, as_made.direction_C, atol=1e-9)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("name", ["opencv", "ros", "colmap", "mrcal"])
def test_a_camera_survives_another_systems_file(tmp_path: Path, seed: int, name: str) -> None:
    made = rig(seed)
    written = lpcal.export_calibration(tmp_path, made, name)
    (file,) = [path for path in tmp_path.rglob("*") if path.is_file() and path.name.startswith(("camera.", "cameras."))]
    assert written
    found = lpcal.read_camera(file)
    assert made.camera is not None
    x_C = np.random.default_rng(3).normal([0, 0, 0.4], 0.05, (30, 3))
    np.testing.assert_allclose(found.project(x_C), made.camera.project(x_C), atol=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_a_recording_is_read_alike_in_millimetres_by_wxyz_and_turned_round(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    H_OP = se3.exp(np.cumsum(rng.normal(0, 0.02, (40, 6)), axis=0))
    t_s = np.arange(40) / 100

    def written(name: str, H: np.ndarray, head: str, scale: float, order: list[int]) -> Path:
        q = se3.quaternion(H[:, :3, :3])[:, order]
        rows = np.column_stack([t_s, scale * H[:, :3, 3], q])
        text = "\n".join([head, *(",".join(f"{value:.12g}" for value in row) for row in rows)])
        (tmp_path / name).write_text(text, encoding="utf-8")
        return tmp_path / name

    plain = lpcal.read_mocap(written("a.csv", H_OP, "t_s,x_m,y_m,z_m,qx,qy,qz,qw", 1.0, [0, 1, 2, 3]))
    millimetres = lpcal.read_mocap(written("b.csv", H_OP, "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz", 1e3, [3, 0, 1, 2]))
    turned = lpcal.read_mocap(written("c.csv", se3.inv(H_OP), "t_s,x_m,y_m,z_m,qx,qy,qz,qw", 1.0, [0, 1, 2, 3]), direction="H_PO")
    for found in (plain, millimetres, turned):
        np.testing.assert_allclose(found.H_OP, H_OP, atol=1e-9)
        np.testing.assert_allclose(found.t_s, t_s, atol=1e-9)
