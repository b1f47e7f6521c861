"""The hand-eye solve against Cramer-Rao and the closed forms, and how long it takes.

``python tools/bench_handeye.py [TRIALS [NAME]]`` is a seeded Monte Carlo; ``python tools/bench_handeye.py speed [FOLDER]`` times the whole
command on 60 images and ten minutes of recording at 240 Hz.

A scenario a row, trial n from the seed n: rms error of H_PC over the trials, degrees and millimetres (rms of the length), of

- the weaker closed form: RANSAC + Park, for moving sessions at the offset that the relative angles correlate best at;
- the closed form: RANSAC + Park, for moving sessions with a search for the offset of least residual, 0.25 ms fine;
- lpcal, and the bound: the covariance of the likelihood at the truth with the true noise.

NEES is 6 where a covariance is honest: of lpcal, which estimates the noise, and of the likelihood given the true noise; behind them the
95 % band of a mean over so many trials. The scenes are those of tests/support/handeye_scene.py.

``python tools/bench_handeye.py robot [TRIALS]``: a robot whose poses are off by a smooth function of the pose, as joint offsets and link
lengths make them, on top of the white noise: errors of lpcal, of Park's closed form, and of a robust fit of every pose's misplacement in
the room at three weightings of turn against shift; what lpcal states; and its NEES.

``speed`` prints processor seconds of `lpcal handeye` on a fresh rig folder (boards found, camera solved, hand-eye solved), of reading the
recording and detecting the boards alone, and of their parts.
"""

from __future__ import annotations

import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import scipy.optimize

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "support"))

from handeye_scene import K_TRUE, LENS_TRUE, TYPICAL, Noise, Session, moving_session, robot_session, static_session, stop_and_shoot
from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import HandEyeOptions, clock, solve_moving, solve_paired
from lpcal.chain.h_pc_handeye.camera_part import camera_prior
from lpcal.chain.h_pc_handeye.likelihood import Sigmas, Views, estimate
from lpcal.errors import LpcalError
from lpcal.geometry import park, se3
from lpcal.geometry.pose_track import poses_at
from lpcal.records.calibration import HandEye

SCENARIOS = {
    "30 static, +-25 deg": lambda rng: static_session(rng, 30, 25.0),
    "30 static, +-10 deg": lambda rng: static_session(rng, 30, 10.0),
    "30 static, 5 % flips": lambda rng: static_session(rng, 30, 25.0, flips=0.05),
    "30 moving": lambda rng: moving_session(rng, 30),
    "30 moving, 5 % flips": lambda rng: moving_session(rng, 30, flips=0.05),
    "150 moving": lambda rng: moving_session(rng, 150),
    "150 moving, half of the noise drifts": lambda rng: moving_session(rng, 150, Noise(drift=0.5)),
}


def solve(session: Session) -> HandEye:
    """Lpcal's own."""
    if session.stream is None:
        return solve_paired(session.boards, session.H_OP, session.camera, HandEyeOptions()).handeye
    return solve_moving(session.boards, track_of(session.stream), session.camera, HandEyeOptions()).handeye


def closed_forms(session: Session) -> list[np.ndarray]:
    """RANSAC + Park with the offset of least residual, and with that from angles alone; the same where there is no clock."""
    H_CB = session.boards.H_CB
    if session.stream is None:
        return [park.consensus(session.H_OP, H_CB).H_PC] * 2
    track, t = track_of(session.stream), session.boards.t_camera_s
    start = clock.offset_candidates(track, t, H_CB)[0].offset_s
    panel = poses_at(track, t - start)
    first = park.consensus(panel.H[panel.trusted], H_CB[panel.trusted])
    agreed = np.flatnonzero(panel.trusted)[first.inliers]
    lever = 0.5 * np.median(np.linalg.norm(H_CB[:, :3, 3], axis=1))

    def at(offset: float) -> tuple[float, float, np.ndarray]:
        panel = poses_at(track, t - offset)
        rows = agreed[panel.trusted[agreed]]
        H_PC, H_OB = park.park(panel.H[rows], H_CB[rows])
        angle, distance = park.residuals(panel.H[rows], H_CB[rows], H_PC, H_OB)
        return float(np.sqrt(np.mean(distance**2 + (lever * angle) ** 2))), offset, H_PC

    coarse = min((at(start + d) for d in np.arange(-12e-3, 12.5e-3, 1e-3)), key=lambda each: each[0])
    fine = min((at(coarse[1] + d) for d in np.arange(-1e-3, 1.1e-3, 0.25e-3)), key=lambda each: each[0])
    return [fine[2], first.H_PC]


def at_the_truth(session: Session, noise: Noise = TYPICAL) -> tuple[np.ndarray, np.ndarray]:
    """H_PC with the true noise and the truth as start, views that were flipped left out, and its covariance (6, 6): the bound."""
    boards, factor = session.boards, np.ones(len(session.boards.images))
    if session.stream is None:
        rows = np.flatnonzero(~session.flipped)
        H_OP, velocity = session.H_OP, np.zeros((len(factor), 6))
    else:
        track, t = track_of(session.stream), boards.t_camera_s - session.offset_s
        panel = poses_at(track, t)
        share = (t * track_rate(session)) % 1
        rows, H_OP, velocity, factor = np.flatnonzero(panel.trusted), panel.H, panel.velocity, (1 - share) ** 2 + share**2
    views = Views(boards.H_CB, H_OP, velocity, np.zeros(len(factor), dtype=int), factor, boards.corners_px, boards.points_B).of(rows)
    sigmas = Sigmas(px=noise.px, mocap_rad=(noise.mocap_rad,), mocap_m=(noise.mocap_m,))
    prior = camera_prior(session.camera)
    found = estimate(views, prior, sigmas, (session.H_PC, session.H_OB), clock=session.stream is not None)
    return found.H_PC, found.covariance()[:6, :6]


def track_rate(session: Session) -> float:
    """Samples a second."""
    return session.stream.rate_hz


def spread(covariance_or_error: np.ndarray) -> tuple[float, float]:
    """Squared length of rotation (deg^2) and translation (mm^2) of a covariance or an error."""
    square = np.diag(covariance_or_error) if covariance_or_error.ndim == 2 else covariance_or_error**2
    return float(np.degrees(1) ** 2 * square[:3].sum()), float(1e6 * square[3:].sum())


def error_of(H_PC: np.ndarray, session: Session) -> np.ndarray:
    """Rotation vector and difference of the origins."""
    return np.concatenate([se3.rotation_vector(session.H_PC[:3, :3] @ H_PC[:3, :3].T), session.H_PC[:3, 3] - H_PC[:3, 3]])


def nees(H_PC: np.ndarray, covariance: np.ndarray, session: Session) -> float:
    """Squared error over its covariance."""
    xi = se3.log(session.H_PC @ se3.inv(H_PC))
    return float(xi @ np.linalg.solve(covariance, xi))


def row(name: str, make: Callable[[np.random.Generator], Session], trials: int) -> str:
    """One scenario."""
    closed, weak, ours, bounds, honest, known, offsets, failed, seconds = [], [], [], [], [], [], [], 0, 0.0
    for seed in range(trials):
        session = make(np.random.default_rng(seed))
        start = time.perf_counter()
        try:
            found = solve(session)
        except LpcalError as error:
            failed += 1
            print(f"   seed {seed}: {error.found}")
            continue
        seconds += time.perf_counter() - start
        for H_PC, into in zip(closed_forms(session), (closed, weak), strict=True):
            into.append(spread(error_of(H_PC, session)))
        ours.append(spread(error_of(found.H_PC, session)))
        H_PC, covariance = at_the_truth(session)
        bounds.append(spread(covariance))
        honest.append(nees(found.H_PC, found.H_PC_covariance, session))
        known.append(nees(H_PC, covariance, session))
        if found.clock_offset_s is not None:
            offsets.append(1e3 * (found.clock_offset_s - session.offset_s))
    rms = [np.sqrt(np.mean(each, axis=0)) for each in (weak, closed, ours, bounds)]
    over_bound, gain, done = rms[2] / rms[3], rms[1] / rms[2], len(ours)
    band = 1.96 * np.sqrt(12 / done)
    offset = f"{np.sqrt(np.mean(np.square(offsets))):.3f}" if offsets else "-"
    return (
        f"{name:38s}{'  '.join(f'{deg:.4f} / {mm:.3f}' for deg, mm in rms)}  {over_bound[0]:.2f} / {over_bound[1]:.2f}  "
        f"{gain[0]:5.2f} / {gain[1]:.2f}  {np.mean(honest):5.2f} {np.mean(known):5.2f}  6 +- {band:.2f}  {offset:>6s}  "
        f"{failed:3d}/{trials}  {seconds / max(done, 1):5.2f}"
    )


WEIGHTINGS = ((0.05, 0.3), (0.1, 0.1), (0.02, 1.0))
"""Degrees and millimetres at which the robust fits weigh turns against shifts."""


def robust_fit(session: Session, turn_deg: float, shift_mm: float) -> np.ndarray:
    """H_PC of least Huber cost of the board's misplacement in the room, every pose counted alike."""
    A, B = session.H_OP, session.boards.H_CB
    X, Y = park.park(A, B)

    def misplacement(p: np.ndarray) -> np.ndarray:
        E = se3.inv(se3.exp(p[6:]) @ Y) @ A @ (se3.exp(p[:6]) @ X) @ B
        return np.hstack([se3.rotation_vector(E[:, :3, :3]) / np.radians(turn_deg), E[:, :3, 3] / (1e-3 * shift_mm)]).ravel()

    found = scipy.optimize.least_squares(misplacement, np.zeros(12), loss="huber", x_scale=1e-3)
    return np.asarray(se3.exp(found.x[:6]) @ X)


def robot(trials: int) -> None:
    """The table of a robot with errors that hang on its pose."""
    for turn_deg, shift_mm in ((0.0, 0.0), (0.03, 0.3), (0.1, 0.5)):
        errors: dict[str, list[tuple[float, float]]] = {}
        stated, honest = [], []
        for seed in range(trials):
            session = robot_session(np.random.default_rng(seed), turn_deg, shift_mm)
            found = solve(session)
            errors.setdefault("lpcal", []).append(spread(error_of(found.H_PC, session)))
            errors.setdefault("Park", []).append(spread(error_of(closed_forms(session)[0], session)))
            for weights in WEIGHTINGS:
                name = f"robust, {weights[0]} deg to {weights[1]} mm"
                errors.setdefault(name, []).append(spread(error_of(robust_fit(session, *weights), session)))
            J = se3.turn_and_origin_jacobian(found.H_PC)
            stated.append(spread(J @ found.H_PC_covariance @ J.T))
            honest.append(nees(found.H_PC, found.H_PC_covariance, session))
        print(f"{turn_deg} deg, {shift_mm} mm by the pose: lpcal's NEES {np.mean(honest):.2f} of 6, median {np.median(honest):.2f}")
        for name, each in (*errors.items(), ("lpcal states", stated)):
            deg, mm = np.sqrt(np.mean(each, axis=0))
            print(f"  {name:28s} {deg:.4f} deg {mm:.3f} mm")


FINER = 3
"""Samples of a pixel, a side."""
PANEL_YAML = """lpcal: 1
camera: {images: view_*.png}
board: {kind: chessboard, corners: [9, 6], square: 25 mm}
mocap: {file: mocap.csv, body: Panel, images: times.csv}
"""
READ_AND_DETECT = """
from pathlib import Path
from lpcal.formats.mocap import read_mocap
from lpcal.formats.panel_yaml import read_rig
from lpcal.pipeline.intrinsics import search
from lpcal.pipeline.intrinsics import board_of, camera_images
from lpcal.pipeline.workspace import Workspace
from lpcal.records.outcome import silent
workspace = Workspace(read_rig(Path("panel.yaml")))
"""
READ = 'read_mocap(Path("mocap.csv"), "Panel")\n'
DETECT = "search(workspace, camera_images(workspace), board_of(workspace.rig_file.rig.board), silent, {})\n"


def speed(folder: Path) -> None:
    """Processor time of the whole command and of its parts."""
    if not (folder / "panel.yaml").exists():
        write_rig(folder)
    python, lpcal = [sys.executable, "-c"], [sys.executable, "-m", "lpcal"]
    parts = {
        "start of Python and of lpcal": [*python, READ_AND_DETECT],
        "and the recording read": [*python, READ_AND_DETECT + READ],
        "and the boards detected": [*python, READ_AND_DETECT + READ + DETECT],
        "lpcal handeye, from nothing": [*lpcal, "handeye"],
        "lpcal handeye, boards and camera there": [*lpcal, "handeye"],
        "lpcal check, boards and camera there": [*lpcal, "check"],
    }
    for what, words in parts.items():
        if not what.endswith("there"):
            shutil.rmtree(folder / "calib", ignore_errors=True)
        print(f"{what:42s}{processor_seconds(words, folder):6.2f} s", flush=True)


def processor_seconds(words: list[str], folder: Path) -> float:
    """User and system time of a process."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, cwd=folder, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def write_rig(folder: Path) -> None:
    """Sixty images of a board, and the recording of ten minutes that they were taken in."""
    import cv2

    from lpcal.formats.mocap_motive import write_motive

    folder.mkdir(parents=True, exist_ok=True)
    session, _ = stop_and_shoot(np.random.default_rng(1), 60, dwell_s=4.0, move_s=6.0, hz=240.0)
    stream, boards = session.stream, session.boards
    markers = {f"Marker{k}": np.random.default_rng(k).normal(0, 0.05, 3) for k in range(1, 6)}
    tracks = {name: se3.apply(stream.H_OP, at[None, None])[:, 0] for name, at in markers.items()}
    write_motive(folder / "mocap.csv", "Panel", stream.t_s, stream.H_OP, np.full(len(stream.t_s), 1e-4), tracks, stream.rate_hz)
    v, u = np.mgrid[: 480 * FINER, : 752 * FINER]
    pixel = np.stack([u, v], axis=-1).reshape(-1, 1, 2).astype(np.float64) / FINER - 0.5 + 0.5 / FINER
    ray_C = np.concatenate([cv2.undistortPoints(pixel, K_TRUE, LENS_TRUE)[:, 0], np.ones((pixel.shape[0], 1))], axis=1)
    for k, (name, H_CB) in enumerate(zip(boards.images, boards.H_CB, strict=True)):
        x, y, w = (ray_C @ np.linalg.inv(H_CB[:3, [0, 1, 3]]).T).T
        i, j = x / w / 0.025, y / w / 0.025
        from_edge = np.maximum(np.abs(i - 4) - 5, np.abs(j - 2.5) - 3.5)
        printed = np.where((np.floor(i) + np.floor(j)) % 2 == 0, 25.0, 200.0)
        light = np.where(from_edge < 0, printed, np.where(from_edge < 0.5, 200.0, 90.0))
        image = light.reshape(480, FINER, 752, FINER).mean(axis=(1, 3))
        noise = np.random.default_rng(k).normal(0, 1, image.shape)
        cv2.imwrite(str(folder / name), np.clip(cv2.GaussianBlur(image, (0, 0), 0.8) + noise, 0, 255).astype(np.uint8))
    times = "".join(f"{name},{t:.6f}\n" for name, t in zip(boards.images, boards.t_camera_s, strict=True))
    (folder / "times.csv").write_text("file,time_s\n" + times)
    (folder / "panel.yaml").write_text(PANEL_YAML)


def main() -> None:
    """All scenarios, or the speed."""
    if sys.argv[1:2] == ["speed"]:
        with tempfile.TemporaryDirectory() as scratch:
            speed(Path(sys.argv[2] if len(sys.argv) > 2 else scratch))
        return
    if sys.argv[1:2] == ["robot"]:
        robot(int(sys.argv[2]) if len(sys.argv) > 2 else 40)
        return
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    print(
        f"{'rms deg / mm':38s}angles + Park    search + Park   lpcal           bound           over bound   search/ours   NEES  known  "
        "95 % band  ms      failed   s/solve"
    )
    wanted = sys.argv[2] if len(sys.argv) > 2 else ""
    chosen = {wanted: SCENARIOS[wanted]} if wanted in SCENARIOS else {name: make for name, make in SCENARIOS.items() if wanted in name}
    for name, make in chosen.items():
        print(row(name, make, trials), flush=True)


if __name__ == "__main__":
    main()
