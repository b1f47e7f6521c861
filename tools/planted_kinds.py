"""Silent faults as people make them, planted into rigs of lpcal's own simulator for ``planted_faults``.

A fault edits a copy of a rig folder and says what is true of it. Nothing that it does is written down in the folder: panel.yaml is what a
user who does not know of it would write. Where the body's poses are edited the images stay, for H_OP H_PC H_CB = H_OB holds of both.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import yaml

from lpcal.formats.mocap import read_mocap
from lpcal.geometry import se3

Rng = np.random.Generator


@dataclass(frozen=True)
class Truth:
    """What is true besides the simulator's truth: each part of a session that changed has its own."""

    H_PC: tuple[np.ndarray, ...] = ()
    zoom: tuple[float, ...] = (1.0,)
    """Focal lengths over the simulated ones."""


@dataclass(frozen=True)
class Fault:
    """A kind of mistake."""

    base: str
    """robot | stretched | recording | lights | surface | map."""
    plant: Callable[[Path, Rng], Truth | None]
    named: str
    """Words of which one stands in a message that names it."""
    boards_again: bool = False
    """Whether the images changed, so that the boards are to be found again."""


def true_H_PC(rig: Path) -> np.ndarray:
    return np.array(yaml.safe_load((rig / "truth" / "handeye.yaml").read_text())["H_PC"])


def edit(rig: Path, old: str, new: str) -> None:
    """Change panel.yaml."""
    text = (rig / "panel.yaml").read_text()
    if old not in text:
        raise ValueError(f"panel.yaml lacks {old}")
    (rig / "panel.yaml").write_text(text.replace(old, new))


def poses(rig: Path) -> tuple[list[str], np.ndarray]:
    rows = [line.split(",") for line in (rig / "robot.csv").read_text().splitlines()[1:]]
    values = np.array([row[1:] for row in rows], dtype=float)
    return [row[0] for row in rows], se3.transform(se3.rotation_from_quaternion(values[:, 3:]), values[:, :3])


def write_poses(rig: Path, names: list[str], values: np.ndarray, head: str = "x_m,y_m,z_m,qx,qy,qz,qw") -> None:
    lines = [f"{name}," + ",".join(f"{v:.7f}" for v in row) for name, row in zip(names, values, strict=True)]
    (rig / "robot.csv").write_text("\n".join([f"file,{head}", *lines]) + "\n")


def rows_of(H: np.ndarray) -> np.ndarray:
    return np.concatenate([H[:, :3, 3], se3.quaternion(H[:, :3, :3])], axis=1)


def small(rng: Rng, deg: float, mm: float) -> np.ndarray:
    """A twist of a random axis and direction."""
    turn, shift = rng.normal(size=(2, 3))
    return np.concatenate([np.radians(deg) * turn / np.linalg.norm(turn), 1e-3 * mm * shift / np.linalg.norm(shift)])


def _bodies(rig: Path, change: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> None:
    """Change H_OP (N, 4, 4) at the shares (N,) of the session, of poses one an image or of a recording."""
    if (rig / "robot.csv").exists():
        names, H = poses(rig)
        write_poses(rig, names, rows_of(change(H, np.linspace(0, 1, len(H)))))
        return
    stream = read_mocap(rig / "mocap.csv", "LightPanel")
    share = (stream.t_s - stream.t_s[0]) / np.ptp(stream.t_s)
    write_stream(rig, stream.t_s, rows_of(change(stream.H_OP, share)))


def write_stream(rig: Path, t_s: np.ndarray, rows: np.ndarray) -> None:
    lines = [f"{t:.6f}," + ",".join(f"{v:.8f}" for v in row) for t, row in zip(t_s, rows, strict=True)]
    (rig / "mocap.csv").write_text("\n".join(["t_s,x_m,y_m,z_m,qx,qy,qz,qw", *lines]) + "\n")
    edit(rig, "mocap.csv, body: LightPanel", "mocap.csv")


def board_moves(rig: Path, rng: Rng, *, slowly: bool) -> None:
    """H_OB becomes X H_OB: the poses become X^-1 H_OP."""
    xi, cut = small(rng, rng.uniform(0.5, 2), rng.uniform(8, 25)), rng.uniform(0.3, 0.7)

    def change(H: np.ndarray, share: np.ndarray) -> np.ndarray:
        return np.stack([se3.exp(-xi * (s if slowly else s > cut)) @ one for one, s in zip(H, share, strict=True)])

    _bodies(rig, change)


def mount_moves(rig: Path, rng: Rng, *, slowly: bool) -> Truth:
    """H_PC becomes H_PC X: the poses become H_OP H_PC (H_PC X)^-1."""
    xi, cut, H_PC = small(rng, rng.uniform(1, 3), rng.uniform(1, 3)), rng.uniform(0.3, 0.7), true_H_PC(rig)

    def change(H: np.ndarray, share: np.ndarray) -> np.ndarray:
        return np.stack([one @ H_PC @ se3.exp(-xi * (s if slowly else s > cut)) @ se3.inv(H_PC) for one, s in zip(H, share, strict=True)])

    _bodies(rig, change)
    return Truth(tuple(H_PC @ se3.exp(xi * s) for s in np.linspace(0, 1, 21 if slowly else 2)))


def board_turned(rig: Path, rng: Rng) -> None:
    """From somewhere on the board lies the other way round."""
    cut = rng.uniform(0.3, 0.7)
    H_OB = np.array(yaml.safe_load((rig / "truth" / "handeye.yaml").read_text())["H_OB"])
    middle = np.array([0.1, 0.0625, 0])
    T = se3.transform(se3.rotation(np.array([0, 0, np.pi])), middle - np.array([-1, -1, 1]) * middle)
    X = H_OB @ T @ se3.inv(H_OB)
    _bodies(rig, lambda H, share: np.where((share > cut)[:, None, None], se3.inv(X) @ H, H))


def lost(rig: Path, rng: Rng) -> None:
    """Lost poses as zeros, as the identity, or as the last pose."""
    written = rng.choice(["zeros", "identity", "last"])
    if (rig / "robot.csv").exists():
        names, H = poses(rig)
        rows, away = rows_of(H), rng.permutation(np.arange(1, len(H)))[: len(H) // 4]
        _lose(rows, np.sort(away), written)
        write_poses(rig, names, rows)
        return
    stream = read_mocap(rig / "mocap.csv", "LightPanel")
    rows, first = rows_of(stream.H_OP), rng.integers(0, len(stream.t_s) - 300, 4)
    _lose(rows, np.unique(np.concatenate([np.arange(k, k + 240) for k in first if k > 0])), written)
    write_stream(rig, stream.t_s, rows)


def _lose(rows: np.ndarray, away: np.ndarray, written: str) -> None:
    for k in away:
        rows[k] = {"zeros": np.zeros(7), "identity": np.array([0, 0, 0, 0, 0, 0, 1.0]), "last": rows[k - 1]}[written]


def euler_order(rig: Path, _: Rng) -> None:
    """A, B, C stand for turns about z, y', x''; what is in them are those about x, y', z''."""
    names, H = poses(rig)
    R = H[:, :3, :3]
    b = np.arcsin(np.clip(R[:, 0, 2], -1, 1))
    angles = np.degrees(np.stack([np.arctan2(-R[:, 1, 2], R[:, 2, 2]), b, np.arctan2(-R[:, 0, 1], R[:, 0, 0])], axis=1))
    write_poses(rig, names, np.concatenate([1e3 * H[:, :3, 3], angles], axis=1), "x_mm,y_mm,z_mm,a,b,c")


def quaternion_order(rig: Path, _: Rng) -> None:
    names, H = poses(rig)
    write_poses(rig, names, rows_of(H)[:, [0, 1, 2, 6, 3, 4, 5]])


def units(rig: Path, rng: Rng) -> None:
    """Metres by their name, and millimetres, centimetres, inches or feet in fact."""
    names, H = poses(rig)
    write_poses(rig, names, rows_of(H) * np.r_[np.full(3, rng.choice([1000, 100, 39.37, 3.281])), np.ones(4)])


def mocap_scale(rig: Path, rng: Rng) -> None:
    factor = 1 + rng.choice([-1, 1]) * rng.uniform(0.01, 0.02)
    _bodies(rig, lambda H, _: se3.transform(H[:, :3, :3], factor * H[:, :3, 3]))


def shifted_rows(rig: Path, _: Rng) -> None:
    """Each image has the next one's pose."""
    names, H = poses(rig)
    write_poses(rig, names, np.roll(rows_of(H), -1, axis=0))


def given_camera(rig: Path, _: Rng) -> None:
    """The calibration of another day, as true as it was."""
    shutil.copy(rig / "calib" / "camera.cameramodel", rig / "given.cameramodel")
    edit(rig, "camera: {", "camera: {cameramodel: given.cameramodel, ")


def _warp(rig: Path, change: Callable[[np.ndarray], np.ndarray], start: float = 0.0) -> None:
    paths = sorted((rig / "stations").glob("*.png"))
    for path in paths[int(start * len(paths)) :]:
        cv2.imwrite(str(path), change(cv2.imread(str(path), cv2.IMREAD_UNCHANGED)))


def _zoomed(rig: Path, factor: float) -> Callable[[np.ndarray], np.ndarray]:
    K = np.array(yaml.safe_load((rig / "truth" / "camera.yaml").read_text())["K"])
    A = np.hstack([factor * np.eye(2), (1 - factor) * K[:2, 2:]])
    return lambda image: cv2.warpAffine(image, A, image.shape[1::-1], flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)


def cropped(rig: Path, rng: Rng) -> Truth:
    """The camera's calibration is kept, its images are cut by a margin and enlarged to their old size, or only cut."""
    given_camera(rig, rng)
    if rng.random() < 0.5:
        factor = rng.uniform(1.02, 1.06)
        _warp(rig, _zoomed(rig, factor))
        return Truth(zoom=(factor,))
    _warp(rig, lambda image: image[8:-8, 12:-12])
    return Truth()


def refocused(rig: Path, rng: Rng) -> Truth:
    """The lens was touched midway."""
    factor = rng.uniform(1.01, 1.03)
    _warp(rig, _zoomed(rig, factor), 0.5)
    return Truth(zoom=(1.0, factor))


def clock_misstated(rig: Path, rng: Rng) -> None:
    true = float(yaml.safe_load((rig / "truth" / "handeye.yaml").read_text())["clock_offset_s"])
    edit(rig, "mocap: {", f"mocap: {{clock_offset: {1e3 * (true + rng.choice([-1, 1]) * rng.uniform(0.05, 0.4)):.1f} ms, ")


def stamps(rig: Path, change: Callable[[np.ndarray], np.ndarray]) -> None:
    for name in ("stations.csv", "sweep.csv"):
        rows = [line.rsplit(",", 1) for line in (rig / name).read_text().splitlines()[1:]]
        t = change(np.array([float(row[1]) for row in rows]))
        (rig / name).write_text("file,time_s\n" + "".join(f"{row[0]},{one:.6f}\n" for row, one in zip(rows, t, strict=True)))


def late_stamps(rig: Path, rng: Rng) -> None:
    """Every third image is stamped a frame late."""
    stamps(rig, lambda t: t + 0.0833 * (rng.random(len(t)) < 1 / 3))


def captures(rig: Path, change: Callable[[np.ndarray], np.ndarray], pattern: str) -> None:
    paths = sorted(rig.glob(pattern))
    if not paths:
        raise ValueError(f"no image {pattern}")
    for path in paths:
        image = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        full = np.iinfo(image.dtype).max
        cv2.imwrite(str(path), np.rint(np.clip(change(image / full), 0, 1) * full).astype(image.dtype))


def exchanged(rig: Path, pattern: str, one: str, other: str) -> None:
    for folder in sorted(rig.glob(pattern)):
        for start in ("", "short_"):
            a, b = (folder / f"{start}{name}.png" for name in (one, other))
            if a.exists():
                a.rename(folder / "kept.png")
                b.rename(a)
                (folder / "kept.png").rename(b)


def sphere_moved(rig: Path, rng: Rng) -> None:
    """Some of the lights were photographed after somebody had touched a sphere."""
    shift = np.rint(rng.choice([-1, 1], 2) * rng.uniform(1, 3, 2)).astype(int)
    for light in rng.permutation(5)[:2]:
        captures(rig, lambda image: np.roll(image, tuple(shift), axis=(0, 1)), f"spheres/chrome_0/*L{light}.png")


def listed_lights(rig: Path, change: Callable[[list[list[str]]], list[list[str]]]) -> None:
    head, *rows = [line.split() for line in (rig / "dome.lp").read_text().splitlines()]
    (rig / "dome.lp").write_text("\n".join(" ".join(row) for row in [head, *change(rows)]) + "\n")


def axes_flipped(rig: Path, rng: Rng) -> None:
    signs = ((1, -1, 1), (-1, 1, 1), (1, 1, -1))[rng.integers(3)]
    listed_lights(rig, lambda rows: [[row[0], *(f"{s * float(v):.6f}" for s, v in zip(signs, row[1:], strict=True))] for row in rows])


def list_shifted(rig: Path, _: Rng) -> None:
    listed_lights(rig, lambda rows: [[row[0], *other[1:]] for row, other in zip(rows, [*rows[1:], rows[0]], strict=True)])


def two_exchanged(rig: Path, rng: Rng) -> None:
    """Two of the twelve lights are listed in each other's place."""
    one, other = rng.choice(12, 2, replace=False)

    def change(rows: list[list[str]]) -> list[list[str]]:
        rows[one][1:], rows[other][1:] = rows[other][1:], rows[one][1:]
        return rows

    listed_lights(rig, change)


def rings_backwards(rig: Path, _: Rng) -> None:
    """Each ring of six is listed the other way round."""
    listed_lights(rig, lambda rows: [[row[0], *rows[6 * (k // 6) + (-k) % 6][1:]] for k, row in enumerate(rows)])


def intensities(rig: Path, rng: Rng) -> None:
    for k in range(12):
        factor = rng.uniform(0.6, 1.0)
        captures(rig, partial(np.multiply, factor), f"cap/L{k}.png")


def overexposed(rig: Path, rng: Rng) -> None:
    factor = rng.uniform(1.3, 1.8)
    captures(rig, lambda image: image * factor, "cap/*.png")


def clipped(rig: Path, rng: Rng, pattern: str) -> None:
    level = rng.uniform(0.4, 0.6)
    captures(rig, lambda image: np.minimum(image, level), pattern)


def no_black(rig: Path, rng: Rng) -> None:
    level = rng.uniform(0.04, 0.1)
    captures(rig, lambda image: level + (1 - level) * image, "cap/*.png")
    (rig / "cap" / "ambient.png").unlink()


def map_convention(rig: Path, rng: Rng) -> None:
    image = cv2.imread(str(rig / "n.png"), cv2.IMREAD_UNCHANGED)
    if rng.random() < 0.5:
        image = image[..., ::-1]
    else:
        image[..., 1] = np.iinfo(image.dtype).max - image[..., 1]
    cv2.imwrite(str(rig / "n.png"), image)


def gamma(rig: Path, _: Rng, pattern: str) -> None:
    captures(rig, lambda image: np.asarray(image ** (1 / 2.2)), pattern)


def glossy_gamma(rig: Path, rng: Rng, keep: int) -> None:
    """A broad gloss on the object, a photograph's gamma, and `keep` of the twelve lights."""
    rows = [line.split() for line in (rig / "dome.lp").read_text().splitlines()[1:]]
    truth = np.load(rig / "truth.npz")
    strength, power = rng.uniform(0.1, 0.3), rng.uniform(8, 20)
    for k, row in enumerate(rows):
        if k % 2 and k > 2 * (keep - 6):
            (rig / "cap" / row[0]).unlink()
            continue
        half = np.array([float(v) for v in row[1:]]) * [1, -1, -1] + [0, 0, -1]
        shine = np.maximum(truth["normals"] @ (half / np.linalg.norm(half)), 0) ** power
        shine = strength * np.nan_to_num(shine) * truth["mask"]
        captures(rig, lambda image, shine=shine: np.asarray(np.clip(image + shine, 0, 1)), f"cap/{row[0]}")
    kept = [row for row in rows if (rig / "cap" / row[0]).exists()]
    (rig / "dome.lp").write_text("\n".join(" ".join(row) for row in [[str(len(kept))], *kept]) + "\n")
    gamma(rig, rng, "cap/*.png")


def edited(rig: Path, _: Rng, old: str, new: str) -> None:
    edit(rig, old, new)


def mirrored(rig: Path, _: Rng) -> None:
    _warp(rig, lambda image: image[:, ::-1].copy())


def other_epoch(rig: Path, _: Rng) -> None:
    stamps(rig, lambda t: t + 1.7e9)


def other_rate(rig: Path, rng: Rng) -> None:
    rate = rng.choice([-1, 1]) * 1e-3
    stamps(rig, lambda t: t * (1 + rate))


def lights_exchanged(rig: Path, _: Rng) -> None:
    exchanged(rig, "spheres/*", "L1", "L2")


def light_twice(rig: Path, _: Rng) -> None:
    shutil.copy(rig / "cap" / "L3.png", rig / "cap" / "L4.png")


CHROME = "images: spheres/chrome_0"
MOVED = r"moved between|drift|moved|wander"
STEP, CREEP = partial(board_moves, slowly=False), partial(board_moves, slowly=True)
SLIP, SLOW_SLIP = partial(mount_moves, slowly=False), partial(mount_moves, slowly=True)
FAULTS: dict[str, Fault] = {
    "board moved": Fault("robot", STEP, MOVED),
    "board moved, recorded": Fault("recording", STEP, MOVED),
    "board drifts": Fault("robot", CREEP, MOVED),
    "mocap drifts, recorded": Fault("recording", CREEP, MOVED),
    "camera slipped": Fault("robot", SLIP, MOVED),
    "camera slipped, recorded": Fault("recording", SLIP, MOVED),
    "camera creeps": Fault("robot", SLOW_SLIP, MOVED),
    "board turned by 180 deg": Fault("robot", board_turned, MOVED + "|turned|other end"),
    "lost poses": Fault("robot", lost, "lost|repeat"),
    "lost poses, recorded": Fault("recording", lost, "lost|repeat"),
    "Euler order": Fault("robot", euler_order, "order|rotation|Euler|angles"),
    "quaternion order": Fault("robot", quaternion_order, "quaternion"),
    "units": Fault("robot", units, "unit"),
    "square 1.5 % small": Fault(
        "robot", partial(edited, old="square: 25 mm", new="square: 24.625 mm"), "its stated size", boards_again=True
    ),
    "mocap scale": Fault("recording", mocap_scale, "its stated size"),
    "images cropped": Fault("robot", cropped, "size|stated|focal|crop", boards_again=True),
    "corner count": Fault("robot", partial(edited, old="corners: [9, 6]", new="corners: [8, 6]"), "corners", boards_again=True),
    "images mirrored": Fault("robot", mirrored, "mirror", boards_again=True),
    "poses one row off": Fault("robot", shifted_rows, "shifted"),
    "lens refocused midway": Fault("robot", refocused, "focus|zoom|lens|moved between", boards_again=True),
    "board stretched 1 %": Fault(
        "stretched", partial(edited, old="[25.25 mm, 25 mm]", new="25 mm"), "longer along|its stated size", boards_again=True
    ),
    "clock offset misstated": Fault("recording", clock_misstated, "clock"),
    "clock epoch": Fault("recording", other_epoch, "epoch|clock"),
    "clock rate": Fault("recording", other_rate, "clock"),
    "stamps a frame late": Fault("recording", late_stamps, "clock|stamp|time"),
    "sphere gamma": Fault("lights", partial(gamma, pattern="spheres/*/*.png"), "gamma"),
    "sphere black level": Fault("lights", partial(edited, old="black_level: 0.8 %", new="black_level: 8 %"), "black"),
    "sphere white level": Fault("lights", partial(clipped, pattern="spheres/matte_0/*.png"), "white|saturat|clip|one level"),
    "lights exchanged": Fault("lights", lights_exchanged, "swapped"),
    "sphere radius 3 % small": Fault("lights", partial(edited, old=f"25 mm, {CHROME}", new=f"24.25 mm, {CHROME}"), "radius"),
    "sphere moved between": Fault("lights", sphere_moved, "moved|outline"),
    "gamma": Fault("surface", partial(gamma, pattern="cap/*.png"), "gamma"),
    "gamma, glossy": Fault("surface", partial(glossy_gamma, keep=12), "gamma"),
    "gamma, glossy, few lights": Fault("surface", partial(glossy_gamma, keep=8), "gamma"),
    "black level": Fault("surface", no_black, "black|ambient"),
    "white level": Fault("surface", partial(clipped, pattern="cap/*.png"), "white|saturat|clip|one level"),
    "lights' order": Fault("surface", list_shifted, "order|names"),
    "two of twelve exchanged": Fault("surface", two_exchanged, "order|names|stand for|exchanged"),
    "rings backwards": Fault("surface", rings_backwards, "order|names|turned|backwards"),
    "list's axes flipped": Fault("surface", axes_flipped, "axes|flip|behind"),
    "intensities": Fault("surface", intensities, "intensit"),
    "saturated": Fault("surface", overexposed, "saturat"),
    "a light twice": Fault("surface", light_twice, "same|twice|identical|copy"),
    "normal map convention": Fault("map", map_convention, "green|channel|convention"),
}
