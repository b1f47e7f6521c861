"""Figures of the camera stage: ``python tools/bench_camera.py [WHAT...]``, some of the following, or all.

rigs     rendered rigs with a truth: rig_a of the recordings and calib_data/demo_rig: projection difference, errors in sigmas
drawn    corners of boards drawn by ray casting: rms against where the pattern's edges cross
spread   100 seeded calibrations: predicted projection uncertainty against the spread; NEES of the intrinsics
bouguet  Bouguet's example 1 by opencv4 and a flat board, and by what is chosen
boards   boards found on real sets, compared with OpenCV's detectors alone
frames   1920x1080 frames without a board: seconds of processor time an image, compared with OpenCV's classic and sector detectors
count    28x17 boards asked for as 24x17, thirty images: what ``lpcal intrinsics`` says and the seconds of processor time that it takes
speed    bouguet_ex1: ``lpcal intrinsics`` compared with mrcal-calibrate-cameras fed the same corners plus OpenCV's detection
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "support"))

from board_pictures import LENS, K, Pattern, Studio, exposed, poses
from board_sheets import BOARDLESS, seen, sheet
from lpcal.chain.k_camera import solve_camera
from lpcal.chain.k_camera.assess import assess, information, ray_slope
from lpcal.chain.k_camera.bundle import refit
from lpcal.chain.k_camera.problem import CornerProblem
from lpcal.detect.board import find_board
from lpcal.formats.images import read_image
from lpcal.geometry import camera as central
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.records.calibration import Camera
from lpcal.records.observations import Board, BoardViews

REPOSITORY = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("LPCAL_DATA", REPOSITORY.parent / "shared" / "data"))
PUBLISHED, SIGMA = np.array([657.644, 658.041, 303.192, 242.556]), np.array([0.40, 0.43, 0.82, 0.75]) / 3
CORE = [0, 1, 0, 1], [0, 1, 2, 2]
TRIALS, VIEWS = 100, 20


def grey(path: str | Path) -> np.ndarray:
    pixels = read_image(Path(path)).pixels
    return pixels if pixels.ndim == 2 else pixels @ np.array([0.299, 0.587, 0.114], np.float32)


def found(paths: list[str], board: Board) -> BoardViews:
    images = [grey(path) for path in paths]
    views = tuple(find_board(image, board, Path(path).name) for image, path in zip(images, paths, strict=True))
    return BoardViews((images[0].shape[1], images[0].shape[0]), views)


def rigs() -> None:
    for folder in (DATA / "rig_a", REPOSITORY / "calib_data" / "demo_rig"):
        panel, truth = (yaml.safe_load((folder / name).read_text()) for name in ("panel.yaml", "truth/camera.yaml"))
        board = Board(tuple(panel["board"]["corners"]), (0.025, 0.025))
        seen = found([str(path) for path in sorted((folder / "stations").glob("*.png"))], board)
        solution = solve_camera(seen, board)
        camera, K_true, lens = solution.camera, np.array(truth["K"]), np.array(truth["distortion"])
        pixels = pixel_grid(camera.image_size)
        apart = np.linalg.norm(projection_difference(pixels, central.unproject(pixels, K_true, lens), camera.project)[0], axis=1)
        error = np.r_[camera.K[CORE] - K_true[CORE], camera.distortion - np.r_[lens, np.zeros(8)][: camera.distortion.size]]
        pulls = error / np.sqrt(np.diag(camera.covariance))
        views = sum(view.corners_px is not None for view in seen.views)
        print(
            f"{folder.name}: {views} boards, {camera.model}, {solution.evidence.chosen.board}; "
            f"truth {np.sqrt(np.mean(apart**2)):.4f} px rms, "
            f"{apart.max():.4f} worst; residual {camera.rms_px:.4f} px; largest pull {np.abs(pulls).max():.1f}, "
            f"NEES {error @ np.linalg.solve(camera.covariance, error):.1f} of {len(error)}"
        )


def drawn() -> None:
    for lens, name in ((LENS, "distorted"), (np.zeros(5), "straight")):
        studio = Studio(lens=lens)
        rays = studio.rays()
        for blur, noise in ((0.0, 2.0), (0.7, 2.0), (0.7, 6.0), (1.5, 3.0), (2.5, 4.0), (2.5, 6.0)):
            errors, boards = [], 0
            for k, H_CB in enumerate(poses(10, 41, Pattern(), studio)):
                view = find_board(
                    exposed(studio.picture(H_CB, Pattern(), blur=blur, rays=rays), k, noise=noise), Board((9, 6), (0.025, 0.025))
                )
                if view.corners_px is not None:
                    boards += 1
                    errors.append(view.corners_px - studio.project(H_CB, Pattern().points()))
            print(
                f"{name}, blur {blur} px, noise {noise}: {boards} of 10 boards, corners {np.sqrt(np.nanmean(np.square(errors))):.4f} px rms"
            )


def spread() -> None:
    """Boards with a bow, a twist and a ripple that no term of lpcal's has."""
    studio, board, places = Studio(), Board((9, 6), (0.025, 0.025)), poses(VIEWS, 17)
    points = Pattern(bow_m=(3e-4, 1e-4), twist_m=1e-4).points()
    points[:, 2] += 3e-5 * np.sin(11 * points[:, 0] + 10 * points[:, 1])
    seen = np.stack([studio.project(H_CB, points) for H_CB in places])
    truth = np.r_[K[CORE], LENS]
    pixels = pixel_grid(studio.size, 12, 8)
    rays_C = central.unproject(pixels, K, LENS)
    squares, said, nees = [], [], []
    for seed in range(TRIALS):
        corners_px = seen + 0.05 * np.random.default_rng(seed).standard_normal(seen.shape)
        problem = CornerProblem(board, studio.size, corners_px, Camera(studio.size, "opencv5", K, LENS), places)
        fit = refit(problem, "opencv5", "shaped")
        known = information(problem, fit)
        slope = ray_slope(known, pixels, fit)
        covered = assess(known, fit).covered.ravel()
        said.append(np.trace(slope @ fit.camera.covariance @ np.swapaxes(slope, 1, 2), axis1=1, axis2=2)[covered].mean())
        squares.append(np.sum(projection_difference(pixels, rays_C, fit.camera.project)[0][covered] ** 2, axis=1).mean())
        error = np.r_[fit.camera.K[CORE], fit.camera.distortion] - truth
        nees.append(error @ np.linalg.solve(fit.camera.covariance, error))
    band = 9 + np.array([-1.96, 1.96]) * np.sqrt(18 / TRIALS)
    print(
        f"spread over predicted projection uncertainty {np.sqrt(np.mean(squares) / np.mean(said)):.3f} ({TRIALS} calibrations); "
        f"NEES {np.mean(nees):.2f}, 95 % band {band[0]:.2f} to {band[1]:.2f}"
    )


def bouguet() -> None:
    paths = [str(DATA / "intrinsics" / "bouguet_ex1" / f"Image{k}.tif") for k in range(1, 21)]
    flat, opencv = (Board((13, 12), (0.03, 0.03), warp=False, corner_fit=fit) for fit in ("edges", "opencv"))
    for board, model in ((flat, "opencv4"), (opencv, "opencv4"), (Board((13, 12), (0.03, 0.03)), "auto")):
        solution = solve_camera(found(paths, board), board, model=model)
        core = solution.camera.K[CORE]
        apart = np.round((core - PUBLISHED) / SIGMA, 1)
        print(f"bouguet, {model}, corners by {board.corner_fit}: {np.round(core, 2)}, {apart} published sigmas")
        print(f"  {solution.evidence.chosen}; {solution.evidence.free_board_check}")


def boards() -> None:
    sets = {
        "bouguet_ex1": ("intrinsics/bouguet_ex1/*.tif", (13, 12)),
        "boofcv_sony": ("intrinsics/boofcv_sony/*.jpg", (6, 4)),
        "boofcv_bumblebee2": ("intrinsics/boofcv_bumblebee2/*.jpg", (6, 4)),
        "kuka_2": ("handeye/kuka_2/*.png", (24, 17)),
        "rig_a": ("rig_a/stations/*.png", (9, 6)),
    }
    for name, (pattern, corners) in sets.items():
        paths = [str(path) for path in sorted(DATA.glob(pattern))]
        images = [np.clip(255 * grey(path), 0, 255).astype(np.uint8) for path in paths]
        own = sum(view.corners_px is not None for view in found(paths, Board(corners, (0.03, 0.03))).views)
        classic = sum(cv2.findChessboardCorners(image, corners)[0] for image in images)
        sector = sum(cv2.findChessboardCornersSB(image, corners)[0] for image in images)
        print(f"{name}: {own} of {len(paths)} boards; OpenCV classic {classic}, SB {sector}")


def timed(run: Callable[[], object]) -> tuple[float, float]:
    """Wall-clock and processor seconds, child processes counted."""

    def now() -> tuple[float, float]:
        both = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
        return time.perf_counter(), sum(one.ru_utime + one.ru_stime for one in both)

    before = now()
    run()
    after = now()
    return after[0] - before[0], after[1] - before[1]


def frames() -> None:
    for draw in BOARDLESS:
        image = np.clip(np.rint(draw(np.random.default_rng(7), 1080, 1920)), 0, 255).astype(np.uint8)
        for corners in ((9, 6), (26, 16)):
            board = Board(corners, (0.025, 0.025))
            find_board(image[:200, :200], board)
            own = timed(lambda image=image, board=board: find_board(image, board))[1]
            classic = timed(lambda image=image, corners=corners: cv2.findChessboardCorners(image, corners))[1]
            sector = timed(lambda image=image, corners=corners: cv2.findChessboardCornersSB(image, corners))[1]
            print(
                f"{draw.__name__}, {corners[0]}x{corners[1]}: {own:.2f} s of processor time; OpenCV classic {classic:.2f}, SB {sector:.2f}"
            )


def count() -> None:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "boards").mkdir()
        for seed in range(30):
            cv2.imwrite(f"{folder}/boards/{seed:02d}.png", seen(sheet((28, 17)), seed, size=(1280, 960)))
        board = "{kind: chessboard, corners: [24, 17], square: 25 mm}"
        (Path(folder) / "panel.yaml").write_text(f"lpcal: 1\ncamera: {{images: boards/*.png}}\nboard: {board}\n")
        said: list[subprocess.CompletedProcess[str]] = []
        command = [sys.executable, "-m", "lpcal.cli.main", "intrinsics", "--rig", folder]
        took = timed(lambda: said.append(subprocess.run(command, capture_output=True, check=False, text=True)))
        ended = f"exit code {said[0].returncode}: {said[0].stderr.strip()}"
        print(f"28x17 asked for as 24x17, 30 images: {took[1]:.1f} s of processor time, {ended}")


def speed() -> None:
    paths = [str(DATA / "intrinsics" / "bouguet_ex1" / f"Image{k}.tif") for k in range(1, 21)]

    def detect() -> None:
        for path in paths:
            image = cv2.imread(path, cv2.IMREAD_GRAYSCALE)
            ok, corners = cv2.findChessboardCorners(image, (13, 12))
            if ok:
                cv2.cornerSubPix(image, corners, (5, 5), (-1, -1), (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 60, 1e-4))

    with tempfile.TemporaryDirectory() as folder:
        cache = str(Path(folder) / "corners.vnl")
        own = [sys.executable, "-m", "lpcal.cli.main", "intrinsics", "--rig", folder, "--corners-cache", cache]
        grid = ["--object-spacing", "0.03", "--object-width-n", "13", "--object-height-n", "12"]
        lens = ["--lensmodel", "LENSMODEL_OPENCV4", "--focal", "650", "--imagersize", "640", "480", "--skip-calobject-warp-solve"]
        tool = [
            str(Path(sys.executable).parent / "mrcal-calibrate-cameras"),
            "--corners-cache",
            cache,
            *lens,
            *grid,
            "--outdir",
            folder,
            "*",
        ]
        flat = Board((13, 12), (0.03, 0.03), warp=False)
        took = timed(lambda: solve_camera(found(paths, flat), flat, model="opencv4"))
        print(f"lpcal's detection + solve, one thread, opencv4 on a flat board: {took[0]:.2f} s, {took[1]:.2f} s of processor time")
        peer = [timed(detect)]
        for model in ("opencv4", "auto"):
            camera = f"{{images: [{', '.join(paths)}], model: {model}}}"
            warp = "none" if model == "opencv4" else "auto"
            sheet = f"{{corners: [13, 12], square: 30 mm, warp: {warp}}}"
            (Path(folder) / "panel.yaml").write_text(f"lpcal: 1\ncamera: {camera}\nboard: {sheet}\n")
            for left in (Path(cache), Path(folder) / "calib" / ".cache" / "corners.json"):
                left.unlink(missing_ok=True)
            took = timed(lambda: subprocess.run(own, capture_output=True, check=True))
            print(f"lpcal intrinsics, the whole command, model {model}, warp {warp}: {took[0]:.2f} s, {took[1]:.2f} s of processor time")
        peer.append(timed(lambda: subprocess.run(tool, capture_output=True, check=True)))
        wall, work = (sum(one[k] for one in peer) for k in (0, 1))
        parts = f"OpenCV's detection {peer[0][0]:.2f} s + mrcal-calibrate-cameras {peer[1][0]:.2f} s"
        print(f"{parts}: {wall:.2f} s, {work:.2f} s of processor time")


BENCHES = {
    "rigs": rigs,
    "drawn": drawn,
    "spread": spread,
    "bouguet": bouguet,
    "boards": boards,
    "frames": frames,
    "count": count,
    "speed": speed,
}

if __name__ == "__main__":
    for what in sys.argv[1:] or BENCHES:
        BENCHES[what]()
