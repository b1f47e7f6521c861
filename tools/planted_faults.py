"""Forty silent faults, planted: ``python tools/planted_faults.py [--count 40] [--first 0] [--only NAME,...] [--keep DIR]``.

Each case is a seed: it draws a kind of `planted_kinds.FAULTS` (every kind comes once before any comes twice), a rig, and the fault's size.
The fault is put into a copy of a small rig of lpcal's own simulator, lpcal's command line is run on it, and what it says is held against
what is true. A row each: exit code of `check` (where there is one) and of the stages, whether there was a warning, whether a warning or
error names the fault, and the error of each estimated quantity over its stated sigma:

K        of fx, fy, cx, cy together, and H_PC of its six: the number of sigmas of one Gaussian that would be as unlikely
lights   the worst light's direction at the focus, likewise
normals  median angle over the median that `normal_std_deg` lets expect (no sigma is stated of a normal map's surface: 9 where its likeness
         to the true one is below .99)

SILENT marks what must not be: every stage ended with 0, an error of more than 3, and no word that names the fault. ``--sound`` runs the
rigs without any fault, for what the errors are then. Rigs are made once and kept in the temporary folder.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np
import yaml
from scipy import stats

sys.path.insert(0, str(Path(__file__).resolve().parent))

from lpcal.errors import LpcalError
from lpcal.formats.camera_yaml import read_camera
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.formats.lights_yaml import read_lights
from lpcal.geometry import se3
from lpcal.simulate.captures import Conditions, capture, ring
from planted_kinds import FAULTS, Fault, Truth, true_H_PC

CACHE = Path(tempfile.gettempdir()) / "lpcal_planted_faults"
LIMIT = 3.0
MOST = 99.0
"""Errors are shown up to this many sigmas."""
LIKE = 0.99
BOARD = "camera: {images: stations/*.png, black_level: 0.8 %}\nboard: {kind: chessboard, corners: [9, 6], square: SQUARE}\n"
RIGS = {
    "robot": BOARD.replace("SQUARE", "25 mm") + "mocap: {poses: robot.csv}\n",
    "stretched": BOARD.replace("SQUARE", "[25.25 mm, 25 mm]") + "mocap: {poses: robot.csv}\n",
    "recording": BOARD.replace("SQUARE", "25 mm") + "mocap: {file: mocap.csv, body: LightPanel, images: [stations.csv, sweep.csv]}\n",
    "lights": """camera: {cameramodel: camera.cameramodel, black_level: 0.8 %}
panel:
  disc_radius: 60 mm
  joint: 15 mm
  blob: 30 mm
  camera: {position: [0 mm, 0 mm, 0 mm], tolerance: [30 mm, 3 deg]}
  tolerance: {azimuth: 0.5 deg, joint_angle: 1 deg, length: 0.5 mm, intensity: 10 %}
lights:
  L0: {azimuth: 0 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 7}
  L1: {azimuth: 72 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 7}
  L2: {azimuth: 144 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 7}
  L3: {azimuth: 216 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 7}
  L4: {azimuth: 288 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 7}
spheres:
  chrome_0: {kind: chrome, radius: 25 mm, images: spheres/chrome_0}
  chrome_1: {kind: chrome, radius: 25 mm, images: spheres/chrome_1}
  matte_0: {kind: matte, radius: 25 mm, images: spheres/matte_0}
""",
}
STAGES = {
    "robot": ["handeye"],
    "stretched": ["handeye"],
    "recording": ["handeye"],
    "lights": ["refine"],
    "surface": ["import dome.lp -o c.yaml", "reconstruct cap -c c.yaml -o out"],
    "map": ["integrate n.png -o out"],
}
RIGS_OF_A_KIND = 2


@dataclass
class Row:
    """How a case ended."""

    check: int | None = None
    codes: list[int] = field(default_factory=list)
    said: str = ""
    """Warnings, errors and notes of the stages."""
    errors: dict[str, float] = field(default_factory=dict)


def run(rig: Path, words: str) -> tuple[int, str]:
    """One command of lpcal's; its exit code, and all that it prints but its progress."""
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    ended = subprocess.run(
        [sys.executable, "-m", "lpcal", *words.split()], cwd=rig, env=environment, capture_output=True, text=True, check=False
    )
    lines = (ended.stdout + "\n" + ended.stderr).replace("\r", "\n").splitlines()
    return ended.returncode, "\n".join(line for line in lines if line.strip() and not re.search(r": \d+ of \d+$", line))


def base_rig(base: str, seed: int) -> Path:
    """A rig without a fault, its boards found."""
    folder = CACHE / f"{base}-{seed}"
    if folder.exists():
        return folder
    CACHE.mkdir(exist_ok=True)
    if base in ("surface", "map"):
        draft = CACHE / f"draft-{base}-{seed}"
        shutil.rmtree(draft, ignore_errors=True)
        draft.mkdir()
        write_sphere(draft, seed)
        draft.rename(folder)
        return folder
    (CACHE / f"{base}.yaml").write_text(f"lpcal: 1\nname: {base}\n{RIGS[base]}")
    size = "400x250"
    code, said = run(CACHE, f"simulate --rig {base}.yaml --seed {100 + seed} --size {size} --stations 20 {folder}")
    if code == 0 and base != "lights":
        code, said = run(folder, "intrinsics")
    if code:
        raise SystemExit(said)
    return folder


def write_sphere(folder: Path, seed: int) -> None:
    """A capture of a matte sphere under two rings of distant lights, their .lp, and the sphere's normal map."""
    (folder / "cap").mkdir()
    lines, truth, mask = [], np.zeros(0), np.zeros(0, dtype=bool)
    for ring_of, phase in enumerate((25.0, 45.0)):
        conditions = Conditions(phase_deg=phase, noise=0.004, ambient=0.05, peak=0.75, pixels=96)
        raw, truth, mask = capture(conditions, 2 * seed + ring_of)
        for k, (image, light) in enumerate(zip(raw.images, ring(conditions), strict=True)):
            name = f"L{6 * ring_of + k}.png"
            cv2.imwrite(str(folder / "cap" / name), np.rint(255 * image).astype(np.uint8))
            lines.append(f"{name} {light.direction_C[0]:.6f} {-light.direction_C[1]:.6f} {-light.direction_C[2]:.6f}")
        cv2.imwrite(str(folder / "cap" / "ambient.png"), np.rint(255 * raw.ambient[0]).astype(np.uint8))
    cv2.imwrite(str(folder / "cap" / "mask.png"), 255 * mask.astype(np.uint8))
    (folder / "dome.lp").write_text("\n".join([str(len(lines)), *lines]) + "\n")
    np.savez(folder / "truth.npz", normals=truth, mask=mask)
    up = np.where(mask[..., None], truth * [1, -1, -1], [0, 0, 1])
    cv2.imwrite(str(folder / "n.png"), np.rint((up[..., ::-1] + 1) / 2 * 65535).astype(np.uint16))


def sigmas(chi2: float, degrees: int) -> float:
    """Standard deviations of one Gaussian that are as unlikely as chi2 of so many degrees of freedom."""
    tail = stats.chi2.logsf(chi2, degrees)
    return float(stats.norm.isf(np.exp(tail) / 2)) if tail > -700 else MOST


def camera_error(rig: Path, truth: Truth) -> float:
    camera = read_camera(rig / "calib" / "camera.yaml")
    if camera.covariance is None:
        return float("nan")
    K = np.array(yaml.safe_load((rig / "truth" / "camera.yaml").read_text())["K"])
    values, real = (M[[0, 1, 0, 1], [0, 1, 2, 2]] for M in (camera.K, K))
    C = camera.covariance[:4, :4]
    errors = [values - real * [zoom, zoom, 1, 1] for zoom in truth.zoom]
    return min(sigmas(float(e @ np.linalg.solve(C, e)), 4) for e in errors)


def handeye_error(rig: Path, truth: Truth) -> float:
    found = read_handeye(rig / "calib" / "handeye.yaml")
    parts = truth.H_PC or (true_H_PC(rig),)
    errors = [se3.log(H @ se3.inv(found.H_PC)) for H in parts]
    return min(sigmas(float(e @ np.linalg.solve(found.H_PC_covariance, e)), 6) for e in errors)


def lights_error(rig: Path) -> float:
    found, leds = read_lights(rig / "calib" / "lights.yaml"), np.load(rig / "truth" / "leds.npz")
    worst = 0.0
    for light in found.lights:
        ray = leds[f"{light.name}_position"] - found.focus_C
        r = np.linalg.norm(ray, axis=1)
        d = ray / r[:, None]
        E = leds[f"{light.name}_power"] * np.maximum(-np.sum(d * leds[f"{light.name}_axis"], axis=1), 0) ** float(leds["exponent"]) / r**2
        true = E @ d / np.linalg.norm(E @ d)
        angle = np.arctan2(np.linalg.norm(np.cross(true, light.direction_C)), true @ light.direction_C)
        worst = max(worst, sigmas(float((angle / light.direction_std_rad) ** 2), 2))
    return worst


def normals_error(rig: Path) -> float:
    truth, found = np.load(rig / "truth.npz"), np.load(next((rig / "out").rglob("surface.npz")))
    both = truth["mask"] & found["mask"]
    angle = np.degrees(np.arccos(np.clip(np.sum(truth["normals"] * found["normals"], axis=-1)[both], -1, 1)))
    return float(np.median(angle) / (np.sqrt(2 * np.log(2)) * np.median(found["normal_std_deg"][both])))


def map_error(rig: Path) -> float:
    truth, found = np.load(rig / "truth.npz"), np.load(next((rig / "out").rglob("surface.npz")))
    both = truth["mask"] & np.isfinite(found["depth"])
    like = np.corrcoef(truth["normals"][..., 2][both], found["depth"][both])[0, 1]
    return 0.0 if like > LIKE else 9.0


def measured(base: str, rig: Path, truth: Truth) -> dict[str, float]:
    """Errors over sigmas of what the stages wrote."""
    if base == "lights":
        return {"lights": lights_error(rig)}
    if base == "surface":
        return {"normals": normals_error(rig)}
    if base == "map":
        return {"normals": map_error(rig)}
    return {"K": camera_error(rig, truth), "H_PC": handeye_error(rig, truth)}


def one(base: str, fault: Fault | None, seed: int, kept: Path | None, number: int) -> Row:
    """Plant, run, measure, on the rig of that number."""
    rng, row = np.random.default_rng([seed, 131]), Row()
    source = base_rig(base, number)
    with tempfile.TemporaryDirectory() as temporary:
        rig = (kept or Path(temporary)) / f"{seed:03d}"
        shutil.rmtree(rig, ignore_errors=True)
        shutil.copytree(source, rig)
        truth = (fault.plant(rig, rng) if fault else None) or Truth()
        stages = [*(["intrinsics"] if fault and fault.boards_again else []), *STAGES[base]]
        for words in stages:
            if words == "handeye":
                row.check, _ = run(rig, "check")
            code, said = run(rig, words)
            row.codes.append(code)
            row.said += said + "\n"
            if code:
                break
        if not any(row.codes):
            try:
                row.errors = measured(base, rig, truth)
            except (LpcalError, OSError) as error:
                row.errors = {"unread": MOST}
                row.said += str(error)
    return row


def named(fault: Fault, said: str) -> tuple[bool, str]:
    """Whether there is a warning or an error, and the first line of one, or of a note, that names the fault."""
    lines = said.splitlines()
    messages = [line for line in lines if re.match(r"(warning|lpcal|  needed|  do):|ends  |mocap file  |  without:|  green ", line)]
    naming = [line.strip() for line in messages if re.search(fault.named, line)]
    return any(line.startswith(("warning", "lpcal:")) for line in lines), naming[0] if naming else ""


def drawn(seed: int) -> str:
    """The kind of a seed: every kind once, in a drawn order, then every kind again."""
    names = sorted(FAULTS)
    return names[np.random.default_rng([seed // len(names), 130]).permutation(len(names))[seed % len(names)]]


def main() -> int:
    """Run the cases; 1 where one is silent."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--only", default="", help="kinds, separated by commas")
    parser.add_argument("--keep", type=Path, help="keep the cases' folders here")
    parser.add_argument("--sound", action="store_true", help="run the rigs without a fault")
    options = parser.parse_args()
    print(f"{'seed':>4} {'kind':26} {'check':>5} {'code':>5} {'sigmas':28} warn named        says")
    if options.sound:
        for k, (base, number) in enumerate((base, number) for number in range(RIGS_OF_A_KIND) for base in STAGES):
            print(f"{k:4} {f'none: {base}':26} {shown(one(base, None, number, options.keep, number))}", flush=True)
        return 0
    silent = 0
    for seed in range(options.first, options.first + options.count):
        kind = drawn(seed)
        if options.only and kind not in options.only.split(","):
            continue
        fault = FAULTS[kind]
        row = one(fault.base, fault, seed, options.keep, seed // 2 % RIGS_OF_A_KIND)
        warned, naming = named(fault, row.said)
        bad = not any(row.codes) and max((value for value in row.errors.values() if np.isfinite(value)), default=0.0) > LIMIT and not naming
        silent += bad
        words = f"{'yes' if warned else 'no':4} {'yes' if naming else 'no':5} {'SILENT' if bad else '':6}"
        print(f"{seed:4} {kind:26} {shown(row)} {words} {naming[:90]}", flush=True)
    print(f"{silent} ended with 0, an error over {LIMIT:.0f} sigmas and no word of it")
    return 1 if silent else 0


def shown(row: Row) -> str:
    errors = "  ".join(f"{name} {min(value, MOST):.1f}" for name, value in row.errors.items())
    return f"{'' if row.check is None else row.check:>5} {max(row.codes):>5} {errors:28}"


if __name__ == "__main__":
    sys.exit(main())
