"""The distance sensor's beam: found within its sigma, what is not the board's left out and named, mistakes named, gaps said in words.

The readings are made here, by a ray against a plane and scipy's rotations.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from lpcal.chain.distance_beam.findings import calibrate, off_drawing
from lpcal.chain.distance_beam.fit import boards_through_room, drawn_in_camera, room_covariance, solve
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.formats.distance_files import beam_document, beam_from_document
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import HandEye
from lpcal.records.distance import BeamDrawn, BoardReadings

SQUARE, NX, NY = 0.025, 9, 6
POINTS_B = np.array([[i * SQUARE, j * SQUARE, 0.0] for j in range(NY) for i in range(NX)])
MIDDLE_B = np.array([0.1, 0.0625, 0.0])
NOISE = 0.003
DRAWN = BeamDrawn(np.array([0.03, 0.0, 0.005]), np.array([0.0, 0.0, 1.0]), NOISE, (0.005, np.radians(2.0)))
START, PRIOR = drawn_in_camera(DRAWN, np.eye(4), np.zeros((6, 6)))


def truth(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, float, float]:
    """Origin, direction, bias and scale within the drawing's tolerance."""
    turn = np.radians(2.0) * rng.standard_normal(2)
    u = np.array([*turn, 1.0])
    o = DRAWN.position_D + 0.005 * rng.standard_normal(3)
    return o, u / np.linalg.norm(u), 0.01 * rng.standard_normal(), 1 + 0.02 * rng.standard_normal()


def boards(
    rng: np.random.Generator,
    o: Array,
    u: Array,
    count: int = 30,
    tilt_deg: float = 30.0,
    near: float = 0.25,
    far: float = 0.6,
    about: float = 0.05,
) -> np.ndarray:
    """H_CB with the spot within some centimetres of the board's middle."""
    H = np.tile(np.eye(4), (count, 1, 1))
    H[:, :3, :3] = Rotation.from_rotvec(np.radians(tilt_deg) * rng.uniform(-1, 1, (count, 3)) * [1, 1, 0.3]).as_matrix()
    spot_B = MIDDLE_B + about * rng.uniform(-1, 1, (count, 3)) * [1, 1, 0]
    H[:, :3, 3] = o + rng.uniform(near, far, count)[:, None] * u - np.einsum("nij,nj->ni", H[:, :3, :3], spot_B)
    return H


def distances(H: Array, o: Array, u: Array) -> np.ndarray:
    n, p = H[:, :3, 2], H[:, :3, 3]
    return np.sum(n * (p - o), axis=1) / (n @ u)


def readings(rng: np.random.Generator, H: Array, beam: tuple[Array, Array, float, float]) -> BoardReadings:
    o, u, bias, scale = beam
    r = bias + scale * distances(H, o, u) + NOISE * rng.standard_normal(len(H))
    names = [f"{k:02d}.png" for k in range(len(H))]
    return BoardReadings.of_images(names, r, H, np.tile(1e-12 * np.eye(6), (len(H), 1, 1)), POINTS_B, SQUARE)


def session(seed: int, **how: Any) -> tuple[tuple[Any, ...], BoardReadings]:
    rng = np.random.default_rng(seed)
    beam = truth(rng)
    return beam, readings(rng, boards(rng, *beam[:2], **how), beam)


def test_beams_lie_within_their_sigma() -> None:
    """Forty rigs: NEES of seven numbers within its band."""
    nees = []
    for seed in range(40):
        (o, u, bias, scale), given = session(seed)
        fit = solve(given, START, PRIOR, NOISE)
        found = fit.beam
        error = np.concatenate([o - found.origin_C, found.across_C.T @ u, [bias - found.bias_m, scale - found.scale]])
        nees.append(error @ np.linalg.solve(fit.covariance, error))
    assert 6.0 < np.mean(nees) < 8.0


def test_the_point_that_a_reading_means_is_known_better_than_where_the_beam_begins() -> None:
    (o, u, bias, scale), given = session(3)
    sensor = calibrate(given, START, PRIOR, NOISE).sensor
    reading = bias + scale * 0.35
    off = sensor.hit(reading) - (o + 0.35 * u)
    calibrated = np.sqrt(sensor.std_m(reading) ** 2 - NOISE**2)
    assert abs(off @ u) < 3 * calibrated
    assert calibrated < 0.0015
    assert np.linalg.norm(off) < 4 * sensor.across_std_m(reading)
    assert np.sqrt(sensor.covariance[2, 2]) > 0.003  # along the beam its origin and the bias are one number
    again = beam_from_document({key: value.tolist() if hasattr(value, "tolist") else value for key, value in beam_document(sensor).items()})
    assert np.allclose(again.covariance, sensor.covariance)
    assert np.allclose(again.hit(0.4), sensor.hit(0.4))


def test_readings_beside_the_board_on_its_rim_and_of_a_hand_are_left_out_and_said() -> None:
    rng = np.random.default_rng(8)
    beam = truth(rng)
    H = boards(rng, *beam[:2], count=40)
    for k, shift in ((0, 0.2), (1, -0.25), (2, 0.3)):  # the spot beside the board
        H[k, :3, 3] += H[k, :3, 0] * shift
    edge = POINTS_B[:, 0].max() + SQUARE
    x_B = np.einsum("ji,j->i", H[3, :3, :3], beam[0] + distances(H[3:4], *beam[:2])[0] * beam[1] - H[3, :3, 3])
    H[3, :3, 3] += H[3, :3, 0] * (x_B[0] - edge)  # on its rim
    given = readings(rng, H, beam)
    given.distance_m[:3] += 0.5
    given.distance_m[3] += 0.2
    given.distance_m[4] -= 0.08  # a hand before it
    found = calibrate(given, START, PRIOR, NOISE)
    why = {one.name: one.why or "" for one in found.readings if not one.used}
    assert {"00.png", "01.png", "02.png", "03.png", "04.png"} <= set(why)
    assert len(why) <= 6
    assert all("beside the board" in why[name] for name in ("00.png", "01.png", "02.png"))
    assert "rim" in why["03.png"] or "beside the board" in why["03.png"]
    assert "off the board's plane" in why["04.png"]
    o, u, bias, scale = beam
    assert np.linalg.norm(found.sensor.hit(bias + scale * 0.4) - (o + 0.4 * u)) < 4 * found.sensor.across_std_m(0.4)


def test_boards_that_are_not_tilted_and_stand_at_one_distance_are_said_to_be() -> None:
    _, flat = session(5, tilt_deg=4.0)
    said = " ".join(calibrate(flat, START, PRIOR, NOISE).warnings)
    assert "tilt the board by 20 to 30 deg" in said
    _, near = session(6, near=0.34, far=0.37)
    assert "half and at one and a half times the working distance" in " ".join(calibrate(near, START, PRIOR, NOISE).warnings)
    _, good = session(7)
    assert calibrate(good, START, PRIOR, NOISE).warnings == ()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda r: 1e3 * r, "millimetres"),
        (lambda r: 100 * r, "centimetres"),
        (lambda r: np.where(np.arange(r.size) < 2, r, 0.352), "stuck: 28 of 30"),
        (lambda r: 1.4 + 0.05 * np.sin(np.arange(r.size)), "reads the wall"),
        (lambda r: np.roll(r, 7), "follow no beam"),
    ],
)
def test_planted_mistakes_are_named(change: Callable[..., Any], words: str) -> None:
    _, given = session(11)
    with pytest.raises(DisagreementError, match=words) as found:
        calibrate(replace(given, distance_m=change(given.distance_m)), START, PRIOR, NOISE)
    assert len(str(found.value)) < 400


def test_a_beam_five_degrees_off_its_drawing_is_found_and_said() -> None:
    rng = np.random.default_rng(12)
    u = np.array([0.0, np.tan(np.radians(5.0)), 1.0])
    beam = (DRAWN.position_D, u / np.linalg.norm(u), 0.0, 1.0)
    start, prior = drawn_in_camera(replace(DRAWN, tolerance=(0.002, np.radians(1.0))), np.eye(4), np.zeros((6, 6)))
    found = calibrate(readings(rng, boards(rng, *beam[:2]), beam), start, prior, NOISE)
    assert "deg off its drawing" in off_drawing(found)
    assert found.warnings[0] == off_drawing(found)
    assert abs(found.evidence.off_drawing_deg - 5.0) < 1.5


def test_too_few_readings_are_refused() -> None:
    _, given = session(1, count=6)
    with pytest.raises(DegenerateError, match="6 readings"):
        calibrate(given, START, PRIOR, NOISE)


def test_boards_known_through_the_room_serve_and_their_shared_errors_are_counted() -> None:
    """The board as hand-eye and mocap have it, both off within their sigma; the clock off too, with the panel moving."""
    nees = []
    for seed in range(16):
        rng = np.random.default_rng(seed)
        beam = truth(rng)
        H = boards(rng, *beam[:2], count=60)
        right_PC, right_OB = small(rng.normal(0, 0.3, 6)), small(rng.normal(0, 0.5, 6))
        H_OP = right_OB @ np.linalg.inv(right_PC @ H)
        sigma = np.array([1e-3, 1e-3, 1e-3, 5e-4, 5e-4, 5e-4])
        handeye = HandEye(
            small(sigma * rng.standard_normal(6)) @ right_PC,
            np.diag(sigma**2),
            small(sigma * rng.standard_normal(6)) @ right_OB,
            np.diag(sigma**2),
            0.0,
            1e-3,
            (),
        )
        variance = np.tile([4e-8] * 3 + [4e-8] * 3, (60, 1))
        late = 1e-3 * rng.standard_normal()
        velocity = np.concatenate([rng.uniform(-0.3, 0.3, (60, 3)), rng.uniform(-0.2, 0.2, (60, 3))], axis=1)
        seen = np.array([moved(H_OP[k], np.sqrt(variance[k]) * rng.standard_normal(6) + late * velocity[k]) for k in range(60)])
        H_CB, own, by_room = boards_through_room(handeye, seen, variance, velocity)
        given = replace(
            readings(rng, H, beam), H_CB=H_CB, covariance=own, by_room=by_room, room_covariance=room_covariance(handeye)
        )  # fmt: skip
        fit = solve(given, START, PRIOR, NOISE)
        o, u, bias, scale = beam
        found = fit.beam
        error = np.concatenate([o - found.origin_C, found.across_C.T @ u, [bias - found.bias_m, scale - found.scale]])
        nees.append(error @ np.linalg.solve(fit.covariance, error))
    assert 5.2 < np.mean(nees) < 9.0


def small(xi: np.ndarray) -> np.ndarray:
    """A turn, then a shift: the left perturbation to first order."""
    H = np.eye(4)
    H[:3, :3], H[:3, 3] = Rotation.from_rotvec(xi[:3]).as_matrix(), xi[3:]
    return H


def moved(H: np.ndarray, change: np.ndarray) -> np.ndarray:
    """A pose whose turn and origin are off."""
    found = H.copy()
    found[:3, :3] = Rotation.from_rotvec(change[:3]).as_matrix() @ H[:3, :3]
    found[:3, 3] += change[3:]
    return found
