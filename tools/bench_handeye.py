"""Seeded Monte Carlo of the hand-eye solve against Cramer-Rao and the closed forms: ``python tools/bench_handeye.py [TRIALS [NAME]]``.

A scenario a row, trial n from the seed n: rms error of H_PC over the trials, degrees and millimetres (rms of the length), of

- the weaker closed form: RANSAC + Park, for moving sessions at the offset that the relative angles correlate best at;
- the closed form: RANSAC + Park, for moving sessions with a search for the offset of least residual, 0.25 ms fine;
- lpcal, and the bound: the covariance of the likelihood at the truth with the true noise.

NEES is 6 where a covariance is honest: of lpcal, which estimates the noise, and of the likelihood given the true noise; behind them the
95 % band of a mean over so many trials. The scenes are those of tests/handeye_scene.py.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

from handeye_scene import TYPICAL, Noise, Session, moving_session, static_session
from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import clock
from lpcal.chain.h_pc_handeye.camera_part import camera_prior
from lpcal.chain.h_pc_handeye.likelihood import Sigmas, Views, estimate
from lpcal.chain.h_pc_handeye.solve import Options, solve_moving, solve_paired
from lpcal.errors import LpcalError
from lpcal.geometry import park, se3
from lpcal.geometry.pose_track import poses_at

SCENARIOS = {
    "30 static, +-25 deg": lambda rng: static_session(rng, 30, 25.0),
    "30 static, +-10 deg": lambda rng: static_session(rng, 30, 10.0),
    "30 static, 5 % flips": lambda rng: static_session(rng, 30, 25.0, flips=0.05),
    "30 moving": lambda rng: moving_session(rng, 30),
    "30 moving, 5 % flips": lambda rng: moving_session(rng, 30, flips=0.05),
    "150 moving": lambda rng: moving_session(rng, 150),
    "150 moving, half of the noise drifts": lambda rng: moving_session(rng, 150, Noise(drift=0.5)),
}


def solve(session: Session):
    """Lpcal's own."""
    if session.stream is None:
        return solve_paired(session.boards, session.H_OP, session.camera, Options()).handeye
    return solve_moving(session.boards, track_of(session.stream), session.camera, Options()).handeye


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


def row(name: str, make, trials: int) -> str:
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


def main() -> None:
    """All scenarios."""
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    print(
        f"{'rms deg / mm':38s}angles + Park    search + Park   lpcal           bound           over bound   search/ours   NEES  known  "
        "95 % band  ms      failed   s/solve"
    )
    chosen = {name: make for name, make in SCENARIOS.items() if len(sys.argv) < 3 or sys.argv[2] in name}
    for name, make in chosen.items():
        print(row(name, make, trials), flush=True)


if __name__ == "__main__":
    main()
