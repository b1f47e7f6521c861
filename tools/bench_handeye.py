"""Seeded Monte Carlo of the hand-eye solve against the Cramer-Rao bound and the closed forms: ``python tools/bench_handeye.py [TRIALS]``.

A scenario a row: rms error of H_PC over the trials, degrees and millimetres (rms of the length), of the closed form (RANSAC + Park, for
moving sessions with the offset of least residual), of lpcal, and the bound: the covariance of the likelihood at the truth with the true
noise. NEES is 6 where the covariance is honest. The scenes are those of tests/handeye_scene.py.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import clock
from lpcal.chain.h_pc_handeye.camera_part import camera_prior
from lpcal.chain.h_pc_handeye.likelihood import Sigmas, Views, estimate
from lpcal.chain.h_pc_handeye.solve import Options, solve_moving, solve_paired
from lpcal.errors import LpcalError
from lpcal.geometry import park, se3
from lpcal.geometry.pose_track import poses_at

from handeye_scene import TYPICAL, Noise, Session, moving_session, static_session

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
    """RANSAC + Park; moving: with the offset from angles, and with that of least residual near it."""
    H_CB = session.boards.H_CB
    if session.stream is None:
        return [park.consensus(session.H_OP, H_CB).H_PC]
    track, t = track_of(session.stream), session.boards.t_camera_s
    start = clock.offset_candidates(track, t, H_CB)[0].offset_s
    found = []
    for offset in np.concatenate([[start], start + np.linspace(-0.012, 0.012, 49)]):
        panel = poses_at(track, t - offset)
        agreed = park.consensus(panel.H[panel.trusted], H_CB[panel.trusted])
        found.append((agreed.scatter_m, agreed.H_PC))
    return [min(found[1:], key=lambda each: each[0])[1], found[0][1]]


def bound(session: Session, noise: Noise = TYPICAL) -> np.ndarray:
    """Covariance (6, 6) of H_PC at the truth with the true noise, views that were flipped left out."""
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
    return estimate(views, prior, sigmas, (session.H_PC, session.H_OB), clock=session.stream is not None).covariance()[:6, :6]


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


def main() -> None:
    """All scenarios."""
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    print(f"{'':38s}closed form      lpcal            bound            ratio       NEES  offset ms  failed  s/solve   ({trials} trials)")
    for name, make in SCENARIOS.items():
        closed, ours, bounds, nees, offsets, failed, seconds = [], [], [], [], [], 0, 0.0
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
            closed.append(spread(error_of(closed_forms(session)[0], session)))
            ours.append(spread(error_of(found.H_PC, session)))
            bounds.append(spread(bound(session)))
            xi = se3.log(session.H_PC @ se3.inv(found.H_PC))
            nees.append(xi @ np.linalg.solve(found.H_PC_covariance, xi))
            if found.clock_offset_s is not None:
                offsets.append(1e3 * (found.clock_offset_s - session.offset_s))
        rms = [np.sqrt(np.mean(each, axis=0)) for each in (closed, ours, bounds)]
        columns = "  ".join(f"{deg:.4f} / {mm:.3f}" for deg, mm in rms)
        ratio = rms[1] / rms[2]
        offset = f"{np.sqrt(np.mean(np.square(offsets))):9.3f}" if offsets else " " * 9
        print(
            f"{name:38s}{columns}  {ratio[0]:.2f} / {ratio[1]:.2f}  {np.mean(nees):5.2f}  {offset}  {failed:6d}  "
            f"{seconds / max(len(ours), 1):7.2f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
