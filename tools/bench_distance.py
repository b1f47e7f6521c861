"""The distance sensor on simulated rigs, as a table: ``python tools/bench_distance.py [--rigs 100] [--readings 30] [--planted 10]``.

Each rig is built within the tolerances of rigs/lightpanel-6 with a sensor of 3 mm; its panel stops before the board with the spot on it,
but for a tenth of the stops, where the beam goes beside it and reads the wall. Board poses err as corners of 0.1 px make them. The bound is
Van Trees's of the right readings with the drawing as prior, by differences of a ray against a plane that is written here. Beside the ratio
to the bound stands that to an estimate which knows which readings are right and steps once from the truth: its errors are the bound's, on
the very same draws, so that ratio has a far smaller standard error. Standard errors are by leaving out one rig after the other.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from functools import cache

import numpy as np
from scipy.spatial.transform import Rotation

import lpcal
from lpcal.api.simulation import simulation_of
from lpcal.chain.distance_beam.findings import calibrate, off_drawing
from lpcal.chain.distance_beam.fit import Beam, drawn_in_camera, meet, solve, whole_covariance
from lpcal.errors import LpcalError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.pipeline.distance import drawn_of
from lpcal.records.distance import BIAS_STD_M, SCALE_STD, BoardReadings
from lpcal.records.rig import DistanceSensorSection, Rig
from lpcal.simulate.beam import TrueBeam, board_distances
from lpcal.simulate.recipe import Recipe

SENSOR = DistanceSensorSection.model_validate({"position": ["35 mm", "0 mm", "5 mm"], "noise": "3 mm"})
POSE = np.array([3e-4, 3e-4, 1e-4, 3e-5, 3e-5, 2e-4])
"""One sigma of a board pose's turn (rad) and place (m) along the camera's axes: what corners of 0.1 px make at 0.4 m."""
BESIDE = 0.1
"""Share of the readings at which the beam goes beside the board."""
WORKING_M = 0.35
NAMES = ("x mm", "y mm", "z mm", "turn a deg", "turn b deg", "bias mm", "scale %")
UNITS = np.array([1e3, 1e3, 1e3, 180 / np.pi, 180 / np.pi, 1e3, 100.0])


def rig_of() -> Rig:
    """rigs/lightpanel-6 with a sensor, without its lights, which no reading asks for."""
    rig = lpcal.read_rig("lightpanel-6").rig
    assert rig.panel is not None
    return rig.model_copy(update={"panel": rig.panel.model_copy(update={"distance_sensor": SENSOR}), "lights": {}})


@cache
def session(seed: int, count: int) -> tuple[TrueBeam, BoardReadings, Array, Array, Array]:
    """A rig's session, made once."""
    return made_session(rig_of(), seed, count)


def made_session(rig: Rig, seed: int, count: int) -> tuple[TrueBeam, BoardReadings, Array, Array, Array]:
    """A rig's beam, its readings with poses as measured, the right poses, whether each reading is of the board, and H_CD as drawn."""
    made = simulation_of(rig, Recipe(seed=seed, stations=max(5 * count // 2, 60), sweep_frames=0))
    built, board = made.built, rig.board
    assert built.beam is not None
    assert board is not None
    rng = np.random.default_rng([seed, 77])
    # zero and scale as little known as the solve takes them to be; the drawing's errors as the tolerance states
    x_C = se3.apply(se3.inv(built.H_DC), (np.array(SENSOR.position) + SENSOR.tolerance[0] * rng.standard_normal(3))[None])[0]
    a, b = SENSOR.tolerance[1] * rng.standard_normal(2)
    u_C = se3.rotate(se3.inv(built.H_DC), np.array([[a, b, 1.0]]))[0]
    beam = TrueBeam(
        x_C,
        u_C / np.linalg.norm(u_C),
        BIAS_STD_M * rng.standard_normal(),
        1 + SCALE_STD * rng.standard_normal(),
        SENSOR.noise,
    )
    H_CB = made.board_truth().H_CB
    x_B, _ = hit(beam.position_C, beam.direction_C, H_CB)
    size = np.array(board.square) * (np.array(board.corners) - 1)
    square = board.square[0]
    on = ((x_B[:, :2] > -0.7 * square) & (x_B[:, :2] < size + 0.7 * square)).all(axis=1)
    off = ((x_B[:, :2] < -1.8 * square) | (x_B[:, :2] > size + 1.8 * square)).any(axis=1)
    beside = round(BESIDE * count)
    rows = np.concatenate([np.flatnonzero(on)[: count - beside], np.flatnonzero(off)[:beside]])
    rows = rows[rng.permutation(len(rows))]
    H_CB = H_CB[rows]
    reading_m = beam.reads(board_distances(beam, board, built.bow_m, built.twist, H_CB), rng)
    seen = np.array([turned(POSE * rng.standard_normal(6)) @ H for H in H_CB])
    points_B = made.board.points_B()
    names = [str(k) for k in range(len(rows))]
    readings = BoardReadings.of_images(names, reading_m, seen, np.tile(np.diag(POSE**2), (len(rows), 1, 1)), points_B, square)
    return beam, readings, H_CB, on[rows], se3.inv(built.H_DC)


def turned(xi: Array) -> Array:
    """A small transform by scipy's rotation: turn, then shift."""
    H = np.eye(4)
    H[:3, :3], H[:3, 3] = Rotation.from_rotvec(xi[:3]).as_matrix(), xi[3:]
    return H


def hit(o: Array, u: Array, H_CB: Array) -> tuple[Array, Array]:
    """Where a ray meets planes: points (N, 3) in each board's frame and distances (N,)."""
    n, p = H_CB[:, :3, 2], H_CB[:, :3, 3]
    t = np.sum(n * (p - o), axis=1) / (n @ u)
    return np.einsum("nji,nj->ni", H_CB[:, :3, :3], o + t[:, None] * u - p), t


def bound(beam: TrueBeam, H_CB: Array, prior: Array, across: Array) -> tuple[Array, Array]:
    """Van Trees's bound (7, 7) by central differences: of readings of the board at right poses, each with its pose's error.

    With it the matrix (7, N) that takes what readings are off from the truth to the step of an estimate that reaches it.
    """

    def read(step: Array, poses: Array) -> Array:
        u = beam.direction_C + across @ step[3:5]
        t = hit(beam.position_C + step[:3], u / np.linalg.norm(u), poses)[1]
        return (beam.bias_m + step[5]) + (beam.scale + step[6]) * t

    h = 1e-6
    J = np.stack([(read(h * e, H_CB) - read(-h * e, H_CB)) / (2 * h) for e in np.eye(7)], axis=1)
    zero = np.zeros(7)
    by_pose = [
        (read(zero, np.array([turned(h * e) @ H for H in H_CB])) - read(zero, np.array([turned(-h * e) @ H for H in H_CB]))) / (2 * h)
        for e in np.eye(6)
    ]
    variance = beam.noise_m**2 + np.sum((np.stack(by_pose, axis=1) * POSE) ** 2, axis=1)
    covariance = np.linalg.inv(J.T @ (J / variance[:, None]) + np.linalg.inv(prior))
    return covariance, covariance @ (J / variance[:, None]).T


def oracle(beam: TrueBeam, readings: BoardReadings, on: Array, start: Beam, prior: Array, found: tuple[Array, Array]) -> Array:
    """The error (7,) of one step from the truth by the right readings: `found` is what `bound` gives."""
    covariance, gain = found
    true = Beam.along(beam.position_C, beam.direction_C)
    off = readings.distance_m - (beam.bias_m + beam.scale * meet(true, readings, readings.H_CB).t_m)
    drawn = np.concatenate(
        [
            start.origin_C - beam.position_C,
            start.across_C.T @ (start.direction_C - beam.direction_C),
            [start.bias_m - beam.bias_m, start.scale - beam.scale],
        ]
    )
    return -(gain @ off[on] + covariance @ np.linalg.solve(prior, drawn))


def compared(error: Array, other: Array) -> tuple[float, float]:
    """Ratio of the rms of errors (rigs,) to that of others, and its standard error by leaving out one rig after the other."""
    a, b, n = error**2, other**2, len(error)
    ratios = np.sqrt((a.sum() - a) / (b.sum() - b))
    return float(np.sqrt(a.sum() / b.sum())), float(np.sqrt((n - 1) * ratios.var()))


def accuracy(rigs: int, count: int) -> list[str]:
    """Errors against the bound, and NEES."""
    errors, bounds, nees, points, kept, false_alarms, reached = [], [], [], [], [], 0, []
    begun = time.process_time()
    for seed in range(1, rigs + 1):
        beam, readings, H_CB, on, H_CD = session(seed, count)
        start, prior = drawn_in_camera(drawn_of(SENSOR), H_CD, np.zeros((6, 6)))
        fit = solve(readings, start, prior, SENSOR.noise)
        found = fit.beam
        error = np.concatenate(
            [
                beam.position_C - found.origin_C,
                found.across_C.T @ (beam.direction_C - found.direction_C),
                [beam.bias_m - found.bias_m, beam.scale - found.scale],
            ]
        )
        limit, gain = bound(beam, H_CB[on], prior, found.across_C)
        reached.append(oracle(beam, readings, on, start, prior, (limit, gain)))
        errors.append(error)
        bounds.append(limit)
        nees.append(error @ np.linalg.solve(fit.covariance, error))
        points.append(point_errors(beam, found, fit.covariance, limit))
        kept.append((fit.inlier & on).sum() - (fit.inlier & ~on).sum())
        solution = calibrate(readings, start, prior, SENSOR.noise)
        false_alarms += bool(off_drawing(solution) and np.degrees(np.arccos(start.direction_C @ beam.direction_C)) < 5)
    rms = np.sqrt(np.mean(np.square(errors), axis=0)) * UNITS
    limit = np.sqrt(np.mean([np.diag(one) for one in bounds], axis=0)) * UNITS
    lines = [f"{rigs} rigs, {count} readings each, {np.mean(kept):.1f} kept of them; {(time.process_time() - begun) / rigs:.3f} s a rig"]
    lines += ["| | rms error | Cramer-Rao | ratio, standard error | to the oracle's on the same draws |", "|---|---|---|---|---|"]
    for k, (name, a, b) in enumerate(zip(NAMES, rms, limit, strict=True)):
        own, expected = np.array(errors)[:, k], np.sqrt(np.array([one[k, k] for one in bounds]))
        said = [f"{ratio:.3f} +- {error:.3f}" for ratio, error in (compared(own, expected), compared(own, np.array(reached)[:, k]))]
        lines.append(f"| {name} | {a:.3f} | {b:.3f} | {' | '.join(said)} |")
    whole = np.mean([e @ np.linalg.solve(b, e) for e, b in zip(errors, bounds, strict=True)]) / 7
    lines.append(f"| all seven, by the bound's metric | | | {np.sqrt(whole):.3f} | |")
    for k, name in enumerate((f"point read at {WORKING_M:g} m: along mm", "the same across mm")):
        a, b, z = (np.array([point[k][part] for point in points]) for part in range(3))
        ratio = np.sqrt(np.mean(a**2)) / np.sqrt(np.mean(b**2))
        lines.append(f"| {name} | {1e3 * np.sqrt(np.mean(a**2)):.3f} | {1e3 * np.sqrt(np.mean(b**2)):.3f} | {ratio:.3f} | |")
        assert np.isfinite(z).all()
    band = np.sqrt(2 * 7 / rigs) * 1.96
    lines.append(
        f"NEES {np.mean(nees):.2f} for 7 (95 % band {7 - band:.2f} to {7 + band:.2f}); said to be off the drawing wrongly: {false_alarms}"
    )
    return lines


def point_errors(beam: TrueBeam, found: Beam, covariance: Array, limit: Array) -> list[tuple[float, float, float]]:
    """Error, bound and stated sigma, along and across the beam, of the point that the working distance's reading means, noise apart."""
    reading = beam.bias_m + beam.scale * WORKING_M
    t = (reading - found.bias_m) / found.scale
    off = beam.position_C + WORKING_M * beam.direction_C - found.origin_C - t * found.direction_C
    u = found.direction_C
    along = np.concatenate([u, np.zeros(3), [-1 / found.scale, -t / found.scale]])
    across = np.concatenate([np.eye(3), t * np.eye(3), np.zeros((3, 2))], axis=1) - np.outer(u, np.concatenate([u, t * u, [0, 0]]))
    made = []
    for C in (limit, covariance):
        whole = whole_covariance(found, C)
        made.append((float(np.sqrt(along @ whole @ along)), float(np.sqrt(np.trace(across @ whole @ across.T)))))
    beside = off - u * (off @ u)
    return [(float(off @ u), made[0][0], made[1][0]), (float(np.linalg.norm(beside)), made[0][1], made[1][1])]


def planted(rigs: int, count: int) -> list[str]:
    """What is said of readings that are wrong on purpose."""

    def in_mm(readings: BoardReadings, _: TrueBeam) -> Array:
        return 1e3 * readings.distance_m

    def stuck(readings: BoardReadings, _: TrueBeam) -> Array:
        return np.where(np.arange(len(readings.distance_m)) < 2, readings.distance_m, 0.352)

    def wall(readings: BoardReadings, beam: TrueBeam) -> Array:
        rng = np.random.default_rng(len(readings.names))
        return 1.1 + 0.1 * rng.standard_normal(len(readings.distance_m)) + 0 * beam.bias_m

    def other_order(readings: BoardReadings, _: TrueBeam) -> Array:
        return np.roll(readings.distance_m, 5)

    kinds: dict[str, tuple[Callable[[BoardReadings, TrueBeam], Array] | None, str]] = {
        "readings in mm": (in_mm, "millimetres"),
        "a value that is stuck": (stuck, "stuck"),
        "the sensor reads the wall": (wall, "wall"),
        "readings of other images": (other_order, "follow no beam"),
        "the beam 5 deg off": (None, "off its drawing"),
    }
    lines = ["| planted | named | the message of rig 1 |", "|---|---|---|"]
    for name, (change, word) in kinds.items():
        named, first = 0, ""
        for seed in range(1, rigs + 1):
            _, readings, H_CB, _, H_CD = session(seed, count)
            start, prior = drawn_in_camera(drawn_of(SENSOR), H_CD, np.zeros((6, 6)))
            beam = TrueBeam(start.origin_C, start.direction_C, 0.0, 1.0, SENSOR.noise)
            if change is None:
                rng = np.random.default_rng([seed, 78])
                u = start.direction_C + np.tan(np.radians(5)) * (start.across_C @ direction(rng))
                beam = TrueBeam(start.origin_C, u / np.linalg.norm(u), 0.0, 1.0, SENSOR.noise)
                board = rig_of().board
                assert board is not None
                reading = beam.reads(board_distances(beam, board, 0.0, 0.0, H_CB), rng)
                prior = prior.copy()
                prior[3:5, 3:5] = np.eye(2) * np.radians(1.0) ** 2  # a drawing that is kept to one degree
            else:
                reading = change(readings, beam)
            said = message(BoardReadings(**(vars(readings) | {"distance_m": reading})), start, prior)
            named += word in said
            first = first or said
        lines.append(f"| {name} | {named} of {rigs} | {' '.join(first.split())} |")
    return lines


def direction(rng: np.random.Generator) -> Array:
    """A unit vector (2,)."""
    angle = rng.uniform(0, 2 * np.pi)
    return np.array([np.cos(angle), np.sin(angle)])


def message(readings: BoardReadings, start: Beam, prior: Array) -> str:
    """What is said of readings."""
    try:
        return "; ".join(calibrate(readings, start, prior, SENSOR.noise).warnings)
    except LpcalError as error:
        return str(error)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rigs", type=int, default=100)
    parser.add_argument("--readings", type=int, default=30)
    parser.add_argument("--planted", type=int, default=10)
    options = parser.parse_args()
    print("\n".join(accuracy(options.rigs, options.readings)), flush=True)
    print("\n".join(planted(options.planted, options.readings)))


if __name__ == "__main__":
    main()
