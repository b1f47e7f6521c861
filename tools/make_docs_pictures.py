"""The drawings and the gallery's pictures in docs/pictures, by lpcal itself: ``python tools/make_docs_pictures.py``.

Frames and transforms are drawn from a bundled rig; each example of examples/ is run, and what it finds is drawn.
"""

from __future__ import annotations

import contextlib
import io
import runpy
import shutil
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt

import lpcal
from lpcal.geometry import led_cluster, se3

REPOSITORY = Path(__file__).resolve().parent.parent
TARGET = REPOSITORY / "docs" / "pictures"
INK, BLUE, AMBER, GREY = "#22272e", "#2c5f8a", "#c77f1a", "#9aa3ad"
XYZ = ("#b3372f", "#3c7d3c", "#2c5f8a")
"""Colours of the axes x, y, z."""


def save(figure: Any, name: str) -> None:
    figure.savefig(TARGET / f"{name}.png", dpi=100, metadata={"Software": "lpcal tools/make_docs_pictures.py"})
    plt.close(figure)


def example(name: str) -> dict[str, Any]:
    with contextlib.redirect_stdout(io.StringIO()):
        return runpy.run_path(str(REPOSITORY / "examples" / f"{name}.py"))


def side(x_C: Any) -> Any:
    """The drawing's plane: z of C to the right, y of C (down) turned up; (..., 2) of points (..., 3)."""
    x_C = np.asarray(x_C)
    return np.stack([x_C[..., 2], -x_C[..., 1]], axis=-1)


def triad(axes: Any, H_CA: Any, name: str, length: float = 0.05, at: tuple[float, float] = (0.008, 0.012)) -> None:
    origin = H_CA[:3, 3]
    for k in range(3):
        tip = origin + length * H_CA[:3, k]
        if np.linalg.norm(side(tip) - side(origin)) > 0.2 * length:
            axes.annotate("", side(tip), side(origin), arrowprops={"arrowstyle": "->", "color": XYZ[k], "lw": 1.8})
            axes.text(*(side(tip) + np.array([0.002, 0.003])), "xyz"[k], color=XYZ[k], fontsize=8)
    axes.plot(*side(origin), "o", color=INK, ms=4)
    axes.text(*(side(origin) + at), name, color=INK, fontsize=13, weight="bold")


def arrow(axes: Any, a: Any, b: Any, text: str, bend: float = 0.2, lift: float = 0.0) -> None:
    style = {"arrowstyle": "-|>", "color": AMBER, "lw": 1.4, "connectionstyle": f"arc3,rad={bend}", "shrinkA": 8, "shrinkB": 8}
    axes.annotate("", b, a, arrowprops=style)
    middle = (np.asarray(a) + b) / 2
    axes.text(middle[0], middle[1] + lift, text, color=AMBER, fontsize=11, ha="center")


def pose(x: float, y: float, z: float, turn_deg: float = 0.0) -> Any:
    """A frame in C, turned about x."""
    c, s = np.cos(np.radians(turn_deg)), np.sin(np.radians(turn_deg))
    return np.array([[1, 0, 0, x], [0, c, -s, y], [0, s, c, z], [0, 0, 0, 1.0]])


def frames() -> None:
    """O, P, D, C, B and a light L, from the side, with the chain of transforms."""
    wings = lpcal.design_lights(lpcal.read_rig("lightpanel-6"))
    up = int(np.argmin(wings.H_CL[:, 1, 3]))
    H_CL = wings.H_CL[up].copy()
    H_CL[0, 3] = 0
    figure, axes = plt.subplots(figsize=(8, 5.4), layout="constrained")
    C, D, P = np.eye(4), pose(0, 0, 0.028), pose(0, 0.095, -0.035, 20)
    B, O = pose(0, 0.01, 0.42, -12), pose(0, 0.2, 0.14, 90)  # noqa: E741 - the frame's letter
    axes.add_patch(plt.Polygon(side([[0, -0.018, -0.045], [0, -0.018, 0], [0, 0.018, 0], [0, 0.018, -0.045]]), fc="0.88", ec=GREY))
    axes.plot(*side([[0, y, 0.028] for y in (-0.09, 0.09)]).T, color=GREY, lw=3, zorder=0)
    axes.plot(*side([[0, -0.09, 0.028], H_CL[:3, 3]]).T, color=GREY, lw=2, zorder=0)
    axes.plot(*side([[0, y, 0] @ B[:3, :3].T + B[:3, 3] for y in (-0.09, 0.09)]).T, color=INK, lw=3, zorder=0)
    axes.plot(*side([H_CL[:3, 3], H_CL[:3, 3] + 0.36 * H_CL[:3, 2]]).T, ":", color=AMBER, lw=1)
    triad(axes, C, "C", at=(-0.026, 0.012))
    triad(axes, D, "D", at=(0.004, -0.026))
    triad(axes, P, "P", at=(-0.024, -0.004))
    triad(axes, B, "B", at=(0.012, 0.014))
    triad(axes, O, "O", at=(-0.022, -0.02))
    triad(axes, H_CL, "L", at=(-0.022, 0.004))
    arrow(axes, side(O[:3, 3]), side(P[:3, 3]), "$H_{OP}$: mocap", -0.25, -0.06)
    arrow(axes, side(P[:3, 3]), side(C[:3, 3]), "$H_{PC}$", -0.3, 0.0)
    arrow(axes, side(C[:3, 3]), side(B[:3, 3]), "$H_{CB}$: the board's corners", 0.12, -0.05)
    arrow(axes, side(C[:3, 3]), side(H_CL[:3, 3]), "$H_{CL}$", 0.3, 0.02)
    arrow(axes, side(O[:3, 3]), side(B[:3, 3]), "$H_{OB}$", 0.25, -0.07)
    axes.set(aspect="equal", xlim=(-0.1, 0.5), ylim=(-0.23, 0.22))
    axes.axis("off")
    save(figure, "frames")


def handeye() -> None:
    """Errors of H_PC's position over many sessions, in the stated sigmas."""
    names = example("handeye_from_arrays")
    session, truth = names["session"], names["truth"]
    rng, over = np.random.default_rng(1), []
    for _ in range(60):
        H_OP, H_CB = truth.H_OP.copy(), truth.H_CB.copy()
        for H, sigma in ((H_OP, 1e-4), (H_CB, 3e-4)):
            H[:, :3, 3] += sigma * rng.standard_normal((len(H), 3))
        found = lpcal.solve_handeye(H_OP, H_CB)
        over.append((found.H_PC[:3, 3] - session.H_PC[:3, 3]) / found.position_std_m)
    over = np.array(over).ravel()
    figure, axes = plt.subplots(figsize=(4.6, 2.4), layout="constrained")
    axes.hist(over, bins=np.linspace(-4, 4, 25), density=True, color="0.8")
    t = np.linspace(-4, 4, 100)
    axes.plot(t, np.exp(-(t**2) / 2) / np.sqrt(2 * np.pi), color=BLUE)
    axes.set(xlabel="error of $H_{PC}$'s place / stated sigma", yticks=[], title=f"60 sessions, rms {np.sqrt(np.mean(over**2)):.2f}")
    save(figure, "handeye_sigmas")


def boards_seen(reach: float) -> Any:
    """Corners (N, rows, columns, 2) of boards within a share of the picture, with a tenth of a pixel of noise."""
    rng = np.random.default_rng(2)
    x_B = np.stack([*np.meshgrid(0.025 * np.arange(9), 0.025 * np.arange(6)), np.zeros((6, 9))], axis=-1) - [0.1, 0.0625, 0]
    K = np.array([[620, 0, 319.5], [0, 620, 239.5], [0, 0, 1.0]])
    true = lpcal.Camera((640, 480), "opencv5", K, np.array([-0.25, 0.1, 0, 0, 0]))
    views: list[Any] = []
    while len(views) < 24:
        place = np.array([*rng.uniform(-reach, reach, 2) * [0.5, 0.38], 1.0]) * rng.uniform(0.35, 0.7)
        pixels = true.project(x_B @ se3.rotation(rng.normal(0, 0.4, 3)).T + place)
        if (np.abs(pixels - [319.5, 239.5]) < [320 * reach, 240 * reach]).all():
            views.append(pixels + rng.normal(0, 0.1, pixels.shape))
    return np.stack(views)


def camera() -> None:
    """Where a camera is sure: boards all over the picture, and boards in its middle alone."""
    figure, every = plt.subplots(1, 2, figsize=(7.2, 2.7), layout="constrained", sharey=True)
    board, shown = lpcal.Board((9, 6), (0.025, 0.025)), None
    for axes, (title, reach) in zip(every, (("boards all over the picture", 1.0), ("boards in its middle", 0.6)), strict=True):
        corners = boards_seen(reach)
        found = lpcal.calibrate_camera(corners, board, (640, 480), model="opencv5", solver="opencv").evidence.projection_uncertainty
        assert found is not None
        shown = axes.pcolormesh(
            found.columns_px, found.rows_px, found.worst_direction_std_px, vmin=0, vmax=0.3, cmap="viridis", shading="gouraud"
        )
        axes.plot(*corners.reshape(-1, 2).T, ".", color="w", ms=0.6, alpha=0.5)
        axes.set(title=title, aspect="equal", xlim=(0, 639), ylim=(479, 0), xticks=[], yticks=[])
    figure.colorbar(shown, ax=every, label="sigma of a projected point, px", shrink=0.9, extend="max")
    save(figure, "camera_sigmas")


def lobes() -> None:
    """Lobes by formula and of LED clusters."""
    angle = np.linspace(0, np.pi / 2, 200)
    figure, axes = plt.subplots(figsize=(4.6, 2.6), layout="constrained")
    for leds, colour in ((1, XYZ[0]), (7, XYZ[1]), (19, XYZ[2])):
        axes.plot(np.degrees(angle), led_cluster.mean_lobe(angle, leds), color=colour, label=f"{leds} LED{'s' * (leds > 1)}")
    axes.plot(np.degrees(angle), lpcal.extend.Lobe()(angle), color=GREY, label="isotropic")
    axes.set(xlabel="angle from the axis, deg", ylabel="relative intensity", ylim=(0, 1.05))
    axes.legend(frameon=False, fontsize="small")
    save(figure, "lobes")


def maps(name: str, panels: list[tuple[str, Any, str | None]]) -> None:
    figure, every = plt.subplots(1, len(panels), figsize=(2.6 * len(panels), 2.3), layout="constrained")
    for axes, (title, picture, bar) in zip(every, panels, strict=True):
        shown = axes.imshow(picture, cmap="gray" if picture.ndim == 2 and bar is None else None)
        axes.set_title(title, fontsize=9)
        axes.axis("off")
        if bar:
            figure.colorbar(shown, ax=axes, label=bar, shrink=0.8)
    save(figure, name)


def as_colours(normals: Any) -> Any:
    return np.nan_to_num((normals * [1, -1, -1] + 1) / 2, nan=1.0)


def surfaces() -> None:
    """What the two examples of surfaces see and find."""
    dome = example("dome_to_normals")
    angle = np.degrees(np.arccos(np.clip(np.sum(dome["surface"].normals * dome["normals"], axis=-1), -1, 1)))
    maps(
        "dome_to_normals",
        [
            ("the chrome ball, 1 of 12", dome["ball_images"][2], None),
            ("the object, 1 of 12", dome["vase_images"][2], None),
            ("normals", as_colours(dome["surface"].normals), None),
            ("error", angle, "deg"),
        ],
    )
    stack = example("reconstruct_a_stack")
    surface = stack["surface"]
    maps(
        "reconstruct_a_stack",
        [
            ("1 of 6 images", stack["images"][0], None),
            ("normals", as_colours(surface.normals), None),
            ("depth", 1e3 * surface.depth, "mm"),
            ("sigma of the normals", surface.normal_std_deg, "deg an axis"),
        ],
    )


def mocap() -> None:
    """The path of the added format's body."""
    names = example("add_a_mocap_format")
    stream = lpcal.read_mocap(names["path"])
    figure, axes = plt.subplots(figsize=(4.6, 2.4), layout="constrained")
    for k, colour in enumerate(XYZ):
        axes.plot(stream.t_s, stream.H_OP[:, k, 3], color=colour, label="xyz"[k])
    axes.set(xlabel="s", ylabel="m")
    axes.legend(frameon=False, fontsize="small")
    save(figure, "add_a_mocap_format")


def main() -> None:
    """Draw them all."""
    TARGET.mkdir(exist_ok=True)
    shutil.copy(REPOSITORY / "tools" / "readme" / "what_it_does.png", TARGET)
    frames()
    handeye()
    camera()
    lobes()
    surfaces()
    mocap()


if __name__ == "__main__":
    main()
