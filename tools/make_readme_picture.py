"""The picture at the top of the README, from a folder that ``lpcal demo`` made: ``python tools/make_readme_picture.py DEMO_FOLDER``."""

from __future__ import annotations

import sys
from pathlib import Path

import cv2
import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt

from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.documents import read_document
from lpcal.formats.surface_files import read_surface
from lpcal.geometry import se3
from lpcal.records.calibration import Calibration

TARGET = Path(__file__).parent / "readme" / "what_it_does.png"
TITLES = (
    "board, mocap: the camera",
    "wings: the lights as drawn",
    "spheres: the lights as they are",
    "normals, depth in metres",
    "its mesh, lit again",
)
INK, BLUE, AMBER = "#22272e", "#2c5f8a", "#c77f1a"


def main(folder: Path) -> None:
    """Draw the five steps side by side."""
    figure = plt.figure(figsize=(15, 3.5), dpi=110)
    grid = figure.add_gridspec(1, 5, wspace=0.06, left=0.005, right=0.995, top=0.86, bottom=0.02)
    calibration = read_calibration(folder / "calib" / "calibration.yaml")
    views = {view["image"]: view for view in read_document(folder / "calib" / "H_CB.yaml", "H_CB")["views"]}

    station = sorted((folder / "stations").glob("*.png"))[4]
    axes = figure.add_subplot(grid[0, 0])
    _grey(axes, station)
    corners = np.array(views[f"stations/{station.name}"]["corners_px"], dtype=float)
    axes.plot(*corners.T, ".", color=AMBER, markersize=4)
    middle = corners.mean(axis=0)
    axes.set(xlim=middle[0] + np.array([-130, 130]), ylim=middle[1] + np.array([130, -130]))

    _draw_rig(figure.add_subplot(grid[0, 1], projection="3d"), calibration)
    axes = figure.add_subplot(grid[0, 2])
    _grey(axes, folder / "spheres" / "chrome_0" / "L0.png", gain=3.0)
    axes.set(xlim=(200, 340), ylim=(150, 10))

    surface = read_surface(folder / "surfaces" / "bust")
    rows, columns = np.nonzero(surface.mask)
    box = (slice(rows.min() - 8, rows.max() + 8), slice(columns.min() - 50, columns.max() + 50))
    axes = figure.add_subplot(grid[0, 3])
    picture = np.where(surface.mask[..., None], 0.5 + 0.5 * surface.normals * [1, -1, -1], 1.0)
    axes.imshow(picture[box])
    axes = figure.add_subplot(grid[0, 4])
    light = np.array([-0.55, -0.55, -0.63])
    shade = np.clip(surface.normals @ light, 0, 1) * 0.95 + 0.05
    axes.imshow(np.where(surface.mask, shade, 1.0)[box], cmap="gray", vmin=0, vmax=1)
    for axes, title in zip(figure.axes, TITLES, strict=True):
        axes.set_axis_off()
        place = axes.get_position()
        figure.text(place.x0 + place.width / 2, 0.93, title, ha="center", color=INK, fontsize=11)
    TARGET.parent.mkdir(exist_ok=True)
    figure.savefig(TARGET, facecolor="white")
    print(TARGET)


def _grey(axes: plt.Axes, path: Path, gain: float = 1.0) -> None:
    image = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE).astype(float) * gain
    axes.imshow(np.clip(image / 255, 0, 1) ** 0.5, cmap="gray", vmin=0, vmax=1)


def _draw_rig(axes: plt.Axes, calibration: Calibration) -> None:
    """Camera, lights with their axes, and the point where they meet, seen from the side."""
    turn = se3.rotation(np.array([0.0, -np.radians(55), 0.0])) @ np.diag([1.0, -1.0, -1.0])
    assert calibration.focus_C is not None
    focus = turn @ calibration.focus_C
    for light in calibration.lights:
        assert light.source_C is not None
        place = turn @ light.source_C
        axes.plot(*np.stack([place, focus]).T, color=AMBER, linewidth=0.8, alpha=0.7)
        axes.plot(*place[:, None], "o", color=AMBER, markersize=8)
    corner = 0.06 * np.array([[-0.75, -0.5, 1], [0.75, -0.5, 1], [0.75, 0.5, 1], [-0.75, 0.5, 1], [-0.75, -0.5, 1]]) @ turn.T
    axes.plot(*corner.T, color=BLUE)
    for each in corner[:4]:
        axes.plot(*np.stack([np.zeros(3), each]).T, color=BLUE)
    axes.plot(*focus[:, None], "+", color=INK, markersize=12)
    axes.set_box_aspect([1, 1, 1], zoom=1.35)
    axes.set(xlim=(-0.1, 0.34), ylim=(-0.22, 0.22), zlim=(-0.3, 0.14))
    axes.view_init(elev=90, azim=-90)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
