"""Surfaces of captures with known truth: a table, quantiles, and a picture sheet of the ten worst.

``python tools/bench_scenes.py SCENES... --out DIR [--jobs N] [--on ENGINE] [--shake N] [--sheet FILE.png] [-- WORDS...]``: a scene is a
folder with calibration.yaml, capture/ and truth/surface.npz (``mask``, ``normals``, ``depth``); WORDS go to ``lpcal reconstruct``. --shake
reconstructs each scene N times more, a tenth of its noise added to its images, and states the largest move in `scale_std`. --on takes the
engines of ``lpcal reconstruct``.

Figures: IoU of the masks; median and mean angle of the normals over both masks, degrees, and the share within two stated standard
deviations; the worst component's distance error over its `scale_std`, of the nearest of its alternatives with odds of 5 % or more; median
depth error after one scale a component, per cent of the distance; processor time of the whole process. In the sheet red is found and not
the object, blue the object and not found.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

import cv2
import numpy as np

from lpcal.api.engines import Lost, each, engine_of

GOOD = {"iou": 0.95, "normals_mean_deg": 6.0, "distance_sigmas": 3.0, "shape_percent": 1.0}
"""A scene is good when its IoU is no less and its other figures are no more: the bounds of the project's benchmark."""
LEAST_COMPONENT, LEAST_ODDS = 0.02, 0.05
"""Share of the pixels under which a component is not judged, and odds from which an alternative counts."""
WORST, ACROSS = 10, 5
"""Scenes in the sheet, and how many stand side by side."""
NOISE_SHARE, ELECTRONS, READ = 0.1, 15000.0, 1e-6
"""Of the shaken images: the share of their noise that is added, electrons at full scale, and the variance of reading, of full scale."""


def reconstructed(capture: Path, calibration: Path, target: Path, words: list[str]) -> tuple[str, float]:
    """Run the command: the last line of what it has to complain of, empty where it went well, and its processor time in seconds."""
    command = [sys.executable, "-m", "lpcal", "reconstruct", str(capture), "-c", str(calibration), "-o", str(target), *words]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        stderr = process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)  # its own processor time, whatever runs beside it
        process.returncode = os.waitstatus_to_exitcode(status)
    said = (stderr.strip().splitlines() or [f"exit code {process.returncode}"])[-1] if process.returncode else ""
    return said, used.ru_utime + used.ru_stime


def figures(scene: Path, target: Path) -> dict[str, float]:
    """The figures of a surface compared with its truth."""
    true, found = np.load(scene / "truth/surface.npz"), np.load(target / "surface.npz")
    both = found["mask"] & true["mask"]
    n, m = (one["normals"][both].astype(float) for one in (found, true))
    n, m = n / np.linalg.norm(n, axis=1, keepdims=True), m / np.linalg.norm(m, axis=1, keepdims=True)
    angle = np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(n - m, axis=1) / 2, 0, 1)))
    distance, shape = distances(true, found, both, json.loads((target / "summary.json").read_text())["components"])
    return {
        "iou": float(both.sum() / (found["mask"] | true["mask"]).sum()),
        "normals_median_deg": float(np.median(angle)),
        "normals_mean_deg": float(angle.mean()),
        "within_2_sigma_percent": float(100 * np.mean(angle <= 2 * found["normal_std_deg"][both])),
        "distance_sigmas": distance,
        "shape_percent": shape,
    }


def distances(true: np.lib.npyio.NpzFile, found: np.lib.npyio.NpzFile, both: np.ndarray, components: list[dict]) -> tuple[float, float]:
    """The worst component's distance error in its own standard deviations, and the median error of shape, per cent of the distance."""
    stated = {one["label"]: [one, *one.get("alternatives", [])] for one in components}
    z, z_true, label = found["depth"][both].astype(float), true["depth"][both].astype(float), found["component"][both]
    worst, errors = 0.0, []
    for one in np.unique(label):
        inside = (label == one) & (z_true > 0)
        if inside.sum() < LEAST_COMPONENT * len(z):
            continue
        scale = np.median(z_true[inside] / z[inside])
        right = scale * stated[one][0]["mean_depth_m"]
        answers = [other for other in stated[one] if other.get("odds", 1.0) >= LEAST_ODDS]
        worst = max(worst, min(abs(np.log(right / other["mean_depth_m"])) / other["scale_std"] for other in answers))
        errors.append(np.abs(scale * z[inside] / z_true[inside] - 1))
    return float(worst), float(100 * np.median(np.concatenate(errors))) if errors else float("nan")


def shaken(capture: Path, folder: Path, seed: int) -> None:
    """A copy of a capture with more noise, 16 bit."""
    rng = np.random.default_rng(seed)
    shutil.copytree(capture, folder)
    for path in folder.glob("*.png"):
        image = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        level = image / float(np.iinfo(image.dtype).max)
        if path.stem != "mask":
            level = level + NOISE_SHARE * np.sqrt(level / ELECTRONS + READ) * rng.standard_normal(level.shape)
        cv2.imwrite(str(path), np.rint(65535 * np.clip(level, 0, 1)).astype(np.uint16))


def moved(scene: Path, target: Path, words: list[str], times: int) -> float:
    """The largest move of the surface, in its scale_std, when the images are shaken; infinite where that fails."""
    here, most = np.load(target / "surface.npz"), 0.0
    sigma = json.loads((target / "summary.json").read_text())["components"][0]["scale_std"]
    for k in range(times):
        with tempfile.TemporaryDirectory() as folder:
            shaken(scene / "capture", Path(folder) / "capture", k)
            said, _ = reconstructed(Path(folder) / "capture", scene / "calibration.yaml", Path(folder) / "surface", words)
            if said:
                return float("inf")
            there = np.load(Path(folder) / "surface/surface.npz")
        common = here["mask"] & there["mask"]
        most = max(most, float(np.median(np.abs(np.log(there["depth"][common] / here["depth"][common]))) / sigma))
    return most


def row_of(scene: Path, out: Path, words: list[str], times: int) -> dict[str, float | str]:
    """Reconstruct and judge one scene."""
    target = out / scene.name
    said, seconds = reconstructed(scene / "capture", scene / "calibration.yaml", target, words)
    row: dict[str, float | str] = {"scene": scene.name, "said": said, "seconds": seconds}
    if not said:
        row |= figures(scene, target)
        row |= {"moved_sigmas": moved(scene, target, words, times)} if times else {}
    return row


def line_of(row: dict[str, float | str]) -> str:
    """A row for people."""
    numbers = "  ".join(f"{key} {value:.3g}" for key, value in row.items() if isinstance(value, float))
    return f"{row['scene']}  {row['said'] or numbers}{'' if is_good(row) else '  BAD'}"


def is_good(row: dict[str, float | str]) -> bool:
    """Whether a row's figures lie within GOOD."""
    return not row["said"] and all(float(row[key]) >= most if key == "iou" else float(row[key]) <= most for key, most in GOOD.items())


def sheet(rows: list[dict[str, float | str]], scenes: dict[str, Path], out: Path, path: Path) -> None:
    """The scenes of least IoU side by side, false and missed pixels in colour."""
    tiles = []
    for row in sorted((row for row in rows if not row["said"]), key=lambda row: float(row["iou"]))[:WORST]:
        scene = scenes[str(row["scene"])]
        true, found = (np.load(one)["mask"] for one in (scene / "truth/surface.npz", out / scene.name / "surface.npz"))
        images = [
            cv2.imread(str(one), cv2.IMREAD_GRAYSCALE) for one in sorted((scene / "capture").glob("*.png")) if "ambient" not in one.stem
        ]
        grey = np.mean(images, axis=0)
        tile = np.repeat((255 * np.sqrt(np.clip(grey / np.percentile(grey, 99), 0, 1)))[..., None], 3, axis=2)
        for where, colour in ((found & ~true, (0, 0, 255)), (true & ~found, (255, 80, 0))):
            tile[where] = 0.4 * tile[where] + 0.6 * np.array(colour)
        tile = cv2.resize(tile.astype(np.uint8), (400, 300), interpolation=cv2.INTER_AREA)
        tiles.append(cv2.putText(tile, f"{row['scene']} {row['iou']:.2f}", (6, 20), cv2.FONT_HERSHEY_SIMPLEX, 0.55, (0, 255, 255), 2))
    blank = [np.zeros((300, 400, 3), np.uint8)] * (-len(tiles) % ACROSS)
    tiles += blank
    cv2.imwrite(str(path), np.vstack([np.hstack(tiles[k : k + ACROSS]) for k in range(0, len(tiles), ACROSS)]))


def main(words: list[str]) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--on", default="processes")
    parser.add_argument("--shake", type=int, default=0)
    parser.add_argument("--sheet", type=Path)
    parser.add_argument("--json", type=Path)
    own, beyond = (words[: words.index("--")], words[words.index("--") + 1 :]) if "--" in words else (words, [])
    asked = parser.parse_args(own)
    folders = [one for path in asked.scenes for one in ([path] if (path / "calibration.yaml").exists() else sorted(path.iterdir()))]
    scenes = {one.name: one for one in folders if (one / "truth/surface.npz").exists()}
    asked.out.mkdir(parents=True, exist_ok=True)
    judge = partial(row_of, out=asked.out.resolve(), words=beyond, times=asked.shake)
    folders, found = [one.resolve() for one in scenes.values()], {}
    for number, row in each(judge, folders, engine_of(asked.on, asked.jobs, asked.out)):
        found[number] = {"scene": folders[number].name, "said": row.why, "seconds": 0.0} if isinstance(row, Lost) else row
        print(line_of(found[number]), flush=True)
    rows = [found[number] for number in range(len(folders))]
    known = [row for row in rows if not row["said"]]
    print(f"good {sum(map(is_good, rows))} of {len(rows)}; worst tenth, median, best tenth:")
    for key in [key for key, value in known[0].items() if isinstance(value, float)] if known else []:
        low, middle, high = np.percentile([float(row[key]) for row in known], (10, 50, 90))
        print(f"  {key:24s} {'  '.join(f'{one:8.3g}' for one in ((low, middle, high) if key == 'iou' else (high, middle, low)))}")
    if asked.json:
        asked.json.write_text(json.dumps(rows, indent=1))
    if asked.sheet and known:
        sheet(rows, scenes, asked.out, asked.sheet)


if __name__ == "__main__":
    main(sys.argv[1:])
