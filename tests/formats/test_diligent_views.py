"""A small set in DiLiGenT-MV's layout: the camera and the place of every view, and surfaces of it that lie in one frame."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from scipy.io import savemat

import lpcal as library
from lpcal.cli.main import main
from lpcal.errors import InputError
from lpcal.formats.diligent_views import view_of_set
from lpcal.formats.import_lights import read_lights
from lpcal.geometry import se3

K = np.array([[1500.0, 0, 79.5], [0, 1500, 63.5], [0, 0, 1]])
SIZE = (160, 128)
RADIUS_M, CENTRE_O = 0.04, np.array([0.005, -0.004, 0.01])
UP = np.array([1.0, -1, -1])


def pose(k: int) -> np.ndarray:
    """H_CO of view k, 1.5 m away, the turntable turned by 40 degrees a view."""
    turn = se3.transform(se3.rotation(np.array([0, np.radians(40 * k), 0])), np.zeros(3))
    return se3.transform(se3.rotation(np.array([0.3, 0, 0])), np.array([0.002, 0.001, 1.5])) @ turn


def made(folder: Path, views: int = 2) -> Path:
    """A ball on a turntable: lights in each view's own axes, x right, y up, z to the camera; lengths in millimetres."""
    set_folder = folder / "ballPNG"
    stored = {"KK": K, "kc": np.zeros((5, 1)), "n_ima": float(views)}
    d_up = np.array([[0.4, 0.1, 0.9], [-0.3, 0.4, 0.85], [0.0, -0.5, 0.8], [0.1, 0.1, 1.0], [-0.4, -0.2, 0.9]])
    d_up /= np.linalg.norm(d_up, axis=1, keepdims=True)
    for k in range(1, views + 1):
        stored |= {f"Rc_{k}": pose(k)[:3, :3], f"Tc_{k}": 1e3 * pose(k)[:3, 3:]}
        view = set_folder / f"view_{k:02d}"
        view.mkdir(parents=True)
        n_C, mask = ball(se3.apply(pose(k), CENTRE_O[None])[0])
        for j, d_C in enumerate(d_up * UP):
            shade = np.where(mask, np.maximum(n_C @ d_C, 0), 0)
            image = np.rint(40000 * shade[..., None] * [1.0, 0.8, 0.6]).astype(np.uint16)
            cv2.imwrite(str(view / f"{j + 1:03d}.png"), image[..., ::-1])
        cv2.imwrite(str(view / "mask.png"), 255 * mask.astype(np.uint8))
        (view / "filenames.txt").write_text("".join(f"{j + 1:03d}.png\n" for j in range(len(d_up))))
        np.savetxt(view / "light_directions.txt", d_up)
        np.savetxt(view / "light_intensities.txt", np.ones((len(d_up), 3)))
    savemat(set_folder / "Calib_Results.mat", stored)
    return set_folder


def ball(centre_C: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Normals (H, W, 3) in C of the ball where pixels see it, and where they do."""
    row, column = np.indices(SIZE[::-1], dtype=float)
    rays = np.stack([(column - K[0, 2]) / K[0, 0], (row - K[1, 2]) / K[1, 1], np.ones_like(row)], axis=-1)
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    along = rays @ centre_C
    inside = along**2 - centre_C @ centre_C + RADIUS_M**2
    hit = (along - np.sqrt(np.maximum(inside, 0)))[..., None] * rays
    return (hit - centre_C) / RADIUS_M, inside > 0


def test_a_view_has_its_camera_and_place(tmp_path: Path) -> None:
    """KK with pixels counted from 0, millimetres as metres, the turntable's frame; a DiLiGenT folder by itself is no view."""
    folder = made(tmp_path)
    _, found = read_lights(folder / "view_02")
    assert found.camera is not None
    assert found.camera.image_size == SIZE
    np.testing.assert_allclose(found.camera.K, K)
    np.testing.assert_allclose(found.focus_C, pose(2)[:3, 3])
    np.testing.assert_allclose(found.lights[0].direction_C, np.array([0.4, 0.1, 0.9]) * UP / np.linalg.norm([0.4, 0.1, 0.9]), atol=1e-6)
    view = view_of_set(folder / "view_01")
    assert view is not None
    np.testing.assert_allclose(view.H_CO, pose(1), atol=1e-9)
    (folder / "view_01").rename(tmp_path / "view_01")
    assert view_of_set(tmp_path / "view_01") is None
    assert read_lights(tmp_path / "view_01")[1].camera is None


def test_what_is_lacking_is_named(tmp_path: Path) -> None:
    """A pose that is not there, and one that is no rotation."""
    folder = made(tmp_path)
    (folder / "view_02").rename(folder / "view_07")
    with pytest.raises(InputError, match="no Rc_7 of 3 by 3"):
        view_of_set(folder / "view_07")
    savemat(folder / "Calib_Results.mat", {"KK": K, "Rc_1": 2 * np.eye(3), "Tc_1": np.ones((3, 1))})
    with pytest.raises(InputError, match="Rc_1 is no rotation"):
        view_of_set(folder / "view_01")


def test_surfaces_of_it_lie_in_one_frame(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the commands: each view is placed where the set says, and shows the ball about where it stands on the turntable."""
    folder = made(tmp_path)
    monkeypatch.chdir(tmp_path)
    for k in (1, 2):
        view = f"view_{k:02d}"
        assert main(["import", str(folder / view), "-o", f"{view}.yaml"]) == 0
        assert main(["reconstruct", str(folder / view), "-c", f"{view}.yaml", "--no-pages", "-o", f"surfaces/{view}"]) == 0
        surface = library.read_surface(tmp_path / "surfaces" / view)
        assert surface.placement is not None
        np.testing.assert_allclose(surface.placement.H_AC, se3.inv(pose(k)), atol=1e-9)
        points_O = se3.apply(surface.placement.H_AC, (surface.rays_C * surface.depth[..., None])[surface.mask].astype(float))
        off = np.linalg.norm(points_O - CENTRE_O, axis=1) - RADIUS_M
        assert np.abs(np.median(off)) < 0.06  # the lights are far away: the turntable's middle stands for the distance
        normals_O = se3.rotate(surface.placement.H_AC, surface.normals[surface.mask].astype(float))
        assert float(np.median(normals_O @ (pose(k)[2, :3]))) < -0.5
