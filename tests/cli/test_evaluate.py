"""``lpcal evaluate``: a surface, or another method's normals, compared with the truth."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import lpcal as library

type Run = Callable[..., tuple[int, str, str]]
K = np.array([[150.0, 0, 40], [0, 150, 30], [0, 0, 1]])
CAMERA = library.Camera((80, 60), "opencv4", K, np.zeros(4))
RAYS = CAMERA.unproject(np.stack(np.meshgrid(np.arange(80.0), np.arange(60.0)), axis=-1))
B = 0.36 * RAYS[..., 2]
BALL = B**2 > 0.36**2 - 0.037**2  # without its rim, where no normals tell the depth
DEPTH = np.where(BALL, (B - np.sqrt(np.maximum(B**2 - 0.36**2 + 0.04**2, 0))) * RAYS[..., 2], np.nan)
NORMALS = np.where(BALL[..., None], (DEPTH[..., None] * RAYS / RAYS[..., 2:] - [0, 0, 0.36]) / 0.04, 0)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    library.write_surface(tmp_path / "ball", library.integrate(NORMALS, CAMERA, BALL, distance_m=float(np.nanmedian(DEPTH)), name="ball"))
    np.savez(tmp_path / "truth.npz", normals=NORMALS.astype(np.float32), depth=DEPTH.astype(np.float32), mask=BALL)
    return tmp_path


def test_a_surface_beside_its_truth(lpcal: Run, folder: Path) -> None:
    code, out, err = lpcal("evaluate", "ball", "--truth", "truth.npz", "--json", cwd=folder)
    assert code == 0, err
    found = json.loads(out)
    assert found["normal_mean_deg"] < 0.01
    assert found["pixels"] == int(BALL.sum())
    assert found["depth_rms_m"] < 2e-4
    assert found["scale"] == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize("turn_deg", [1.0, 4.0, 15.0])
def test_another_methods_normals_are_measured(lpcal: Run, folder: Path, turn_deg: float) -> None:
    a = np.radians(turn_deg)
    R = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    np.save(folder / "other.npy", (NORMALS @ R.T).astype(np.float32))
    code, out, err = lpcal("evaluate", "other.npy", "--truth", "truth.npz", "--json", cwd=folder)
    assert code == 0, err
    expected = np.degrees(np.arccos(np.clip(np.sum(NORMALS * (NORMALS @ R.T), axis=-1)[BALL], -1, 1)))
    assert json.loads(out)["normal_median_deg"] == pytest.approx(np.median(expected), abs=0.02)
    assert json.loads(out)["depth_rms_m"] is None


def test_a_summary_for_people(lpcal: Run, folder: Path) -> None:
    code, out, _ = lpcal("evaluate", "ball", "--truth", "ball", cwd=folder)
    assert code == 0
    assert out.startswith("Evaluation of ball\n")
    assert "0.000 deg mean" in out
    assert "100.0 % in common" in out


def cut(folder: Path) -> None:
    (folder / "truth.npz").write_bytes((folder / "truth.npz").read_bytes()[:200])


def smaller(folder: Path) -> None:
    np.savez(folder / "truth.npz", normals=NORMALS[:-1].astype(np.float32))


def elsewhere(folder: Path) -> None:
    np.savez(folder / "truth.npz", normals=np.where(BALL[..., None], 0, [0, 0, -1.0]).astype(np.float32))


def no_depth(folder: Path) -> None:
    np.savez(folder / "truth.npz", normals=NORMALS.astype(np.float32), depth=np.zeros(7))


@pytest.mark.parametrize(("plant", "code"), [(cut, 3), (smaller, 6), (elsewhere, 4), (no_depth, 3)])
def test_a_truth_that_cannot_be_is_refused(lpcal: Run, folder: Path, plant: Callable[[Path], None], code: int) -> None:
    plant(folder)
    found, out, err = lpcal("evaluate", "ball", "--truth", "truth.npz", cwd=folder)
    assert (found, out) == (code, "")
    assert "Traceback" not in err
    assert len(err) < 600
