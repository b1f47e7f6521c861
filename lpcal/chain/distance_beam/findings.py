"""What a session shows of the beam, in words: what its poses lack, what mistakes in the data look like, what became of each reading."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.distance_beam.fit import FEWEST, LIMIT, Beam, Fit, meet, off_board_m, solve, whole_covariance
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry.arrays import Array
from lpcal.records.distance import BoardReadings, DistanceSensor, ReadingVerdict, SensorEvidence, SensorSolution

UNITS = {1000.0: "millimetres", 100.0: "centimetres", 1 / 0.0254: "inches", 0.001: "kilometres"}
"""How many times too large readings are whose unit is another than the stated metre."""
UNIT_FACTOR = 1.5
"""By what factor the ratio of readings to the board's distance may miss that of a unit."""
STUCK_SHARE = 0.8
"""Share of the readings at one value from which the sensor is stuck."""
STUCK_SPAN = 6.0
"""Standard deviations of a reading by which the board must have moved for that to be no board held still."""
FOLLOWING = 0.5
"""Share of the readings that must agree on a beam."""
BEHIND_SHARE = 0.6
"""Share of the others that are beyond the board from which the beam goes beside it."""
OFF_SIGMAS = 3.0
"""Standard deviations, tolerance and fit together, from which a beam is off its drawing."""
TILT_DEG = 8.0
"""Rms tilt of the boards about the axis of the lesser one under which the beam's line shows ill: at 20 deg it is known twice as well."""
SPAN_SHARE = 0.2
"""Distance from the nearest to the farthest board, of their mean, under which direction and scale show ill."""
NOISE_SIGMAS = 3.0
"""Standard errors by which the residuals must exceed the noise as stated to be believed."""


def calibrate(readings: BoardReadings, start: Beam, prior: Array, noise_m: float) -> SensorSolution:
    """The sensor of its readings on the board, from the drawing's beam with its covariance (7, 7).

    Raises
    ------
    DegenerateError
        Too few readings on the board.
    DisagreementError
        Readings in another unit, of a stuck sensor, of what is behind the board, or that follow no beam of this panel.
    """
    refuse_mistakes(readings, start, noise_m)
    try:
        fit = solve(readings, start, prior, noise_m)
    except DegenerateError:
        refuse_strangers(readings, start, noise_m)
        raise
    refuse_strangers(readings, fit.beam, noise_m)
    return _solution(readings, fit, noise_m)


def refuse_mistakes(readings: BoardReadings, drawn: Beam, noise_m: float) -> None:
    """Refuse readings that are plainly none in metres of this board.

    Raises
    ------
    DegenerateError
        Fewer than a beam takes.
    DisagreementError
        Another unit, or a value that is stuck.
    """
    count = len(readings.distance_m)
    if count < FEWEST:
        raise DegenerateError(
            f"{count} readings of the distance sensor with the board's pose",
            needed=f"{FEWEST} at least, 20 or more with the board tilted to all sides",
            todo="write distance_m beside each image",
        )
    expected_m = np.abs(meet(drawn, readings, readings.H_CB).t_m)
    ratio = float(np.median(readings.distance_m) / np.median(expected_m))
    for factor, unit in UNITS.items():
        if 1 / UNIT_FACTOR < ratio / factor < UNIT_FACTOR:
            raise DisagreementError(
                f"distance_m reads {np.median(readings.distance_m):.4g} where the board is {np.median(expected_m):.3f} m away: {unit}",
                needed="metres",
                todo=f"divide the column by {factor:.6g}, or state the unit in the readings' file",
            )
    values, counts = np.unique(np.round(readings.distance_m, 6), return_counts=True)
    if counts.max() >= STUCK_SHARE * count and np.std(expected_m) > STUCK_SPAN * noise_m:
        raise DisagreementError(
            f"the distance sensor is stuck: {counts.max()} of {count} readings are {values[np.argmax(counts)]:.4g} m "
            f"while the board was {expected_m.min():.2f} to {expected_m.max():.2f} m away",
            needed="readings that follow the board",
            todo="look at the sensor and what logs it",
        )


def refuse_strangers(readings: BoardReadings, beam: Beam, noise_m: float) -> None:
    """Refuse readings most of which a beam does not explain.

    Raises
    ------
    DisagreementError
        They are of what is behind the board, or follow no beam of this panel.
    """
    met = meet(beam, readings, readings.H_CB)
    residual_m = readings.distance_m - beam.bias_m - beam.scale * met.t_m
    beside = off_board_m(met, readings) > 0
    strange = (np.abs(residual_m) > LIMIT * max(noise_m, 1e-4) * 2) | beside
    count = len(residual_m)
    if strange.sum() <= (1 - FOLLOWING) * count:
        return
    behind = int(np.sum(strange & (residual_m > LIMIT * noise_m)))
    if behind >= BEHIND_SHARE * strange.sum():
        raise DisagreementError(
            f"{behind} of {count} readings are beyond the board, by {1e3 * np.median(residual_m[strange]):.0f} mm (median): the beam goes "
            "beside it, and reads the wall",
            needed="the sensor's spot on the board",
            todo="aim it at the board's middle; is panel.distance_sensor as mounted?",
        )
    raise DisagreementError(
        f"{int(strange.sum())} of {count} readings follow no beam of this panel: they miss the board's plane by "
        f"{1e3 * np.median(np.abs(residual_m[strange])):.0f} mm (median)",
        needed="a sensor fixed to the panel, each reading at its own image",
        todo="are the readings in the images' order, and does the sensor ride on the panel?",
    )


def _solution(readings: BoardReadings, fit: Fit, noise_m: float) -> SensorSolution:
    used = fit.inlier
    z = fit.residual_m[used] / fit.sigma_m[used]
    freedom = max(int(used.sum()) - 6, 1)
    excess = float(np.sum(z**2) / freedom)
    more_noise = excess > 1 + NOISE_SIGMAS * np.sqrt(2 / freedom)
    factor = excess if more_noise else 1.0
    beam = fit.beam
    sensor = DistanceSensor(
        beam.origin_C,
        beam.direction_C,
        beam.bias_m,
        beam.scale,
        noise_m * float(np.sqrt(factor)),
        factor * whole_covariance(beam, fit.covariance),
    )
    evidence = _evidence(fit, freedom)
    warnings = [evidence.weakest] if evidence.weakest else []
    if more_noise:
        rms_mm, stated_mm = 1e3 * evidence.residual_rms_m, 1e3 * evidence.expected_rms_m
        warnings.append(f"the readings scatter by {rms_mm:.2f} mm where their noise as stated makes {stated_mm:.2f} mm: sigmas are grown")
    left = int(np.sum(~used))
    if left > 0.1 * len(used):
        warnings.append(f"{left} of {len(used)} readings were left out: off the board, on its rim, or off its plane")
    found = SensorSolution(sensor, _verdicts(readings, fit), evidence, tuple(warnings))
    said = off_drawing(found)
    return replace(found, warnings=(said, *warnings)) if said else found


def _verdicts(readings: BoardReadings, fit: Fit) -> tuple[ReadingVerdict, ...]:
    off = off_board_m(fit.met, readings)
    found = []
    for k, name in enumerate(readings.names):
        why = None
        if fit.on_rim[k]:
            why = "the spot is on the board's rim"
        elif not fit.on_board[k]:
            why = f"the beam goes beside the board, by {1e3 * off[k]:.0f} mm"
        elif not fit.inlier[k]:
            why = f"off the board's plane by {1e3 * fit.residual_m[k]:+.1f} mm, {abs(fit.residual_m[k]) / fit.sigma_m[k]:.0f} sigma"
        at = (float(fit.met.x_B[k, 0]), float(fit.met.x_B[k, 1]))
        reading_m, residual_m = float(readings.distance_m[k]), float(fit.residual_m[k])
        found.append(ReadingVerdict(name, bool(fit.inlier[k]), why, reading_m, residual_m, at))
    return tuple(found)


def _evidence(fit: Fit, freedom: int) -> SensorEvidence:
    used, beam, met = fit.inlier, fit.beam, fit.met
    count = int(used.sum())
    tilt = met.normal_C[used] @ beam.across_C / met.cosine[used, None]
    axes, sizes, _ = np.linalg.svd(tilt.T @ tilt / count)
    tilts = np.degrees(np.arctan(np.sqrt(sizes)))
    span = float(met.t_m[used].min()), float(met.t_m[used].max())
    start = fit.start
    angle = float(np.arctan2(np.linalg.norm(np.cross(beam.direction_C, start.direction_C)), beam.direction_C @ start.direction_C))
    middle = float(np.mean(met.t_m[used]))
    apart = beam.origin_C + middle * beam.direction_C - start.origin_C - middle * start.direction_C
    apart = apart - beam.direction_C * (apart @ beam.direction_C)
    turn = np.sqrt(np.trace(fit.prior[3:5, 3:5] + fit.covariance[3:5, 3:5]) / 2)
    rms, expected = (float(np.sqrt(np.mean(values[used] ** 2))) for values in (fit.residual_m, fit.sigma_m))
    return SensorEvidence(
        readings_used=count,
        residual_rms_m=rms,
        expected_rms_m=expected * float(np.sqrt(freedom / count)),
        off_drawing_deg=float(np.degrees(angle)),
        off_drawing_m=float(np.linalg.norm(apart)),
        off_drawing_sigmas=angle / float(turn),
        tilt_about_two_axes_deg=(float(tilts[0]), float(tilts[1])),
        span_m=span,
        weakest=_lacking(beam, axes[:, 1], tilts, span, middle),
    )


def _lacking(beam: Beam, lesser: Array, tilts: Array, span: tuple[float, float], middle_m: float) -> str:
    """What the poses determine least, and what would improve it."""
    said = []
    if tilts[1] < TILT_DEG:
        axis_C = np.cross(beam.direction_C, beam.across_C @ lesser)
        about = "xyz"[int(np.argmax(np.abs(axis_C)))]
        said.append(
            f"the boards were tilted by {tilts[1]:.0f} deg only about an axis near the camera's {about}, so that the beam's place across "
            "it is the drawing's: tilt the board by 20 to 30 deg about it, both ways"
        )
    if span[1] - span[0] < SPAN_SHARE * middle_m:
        said.append(
            f"the boards stood {span[0]:.2f} to {span[1]:.2f} m away only, which tells neither the beam's direction from its place nor the "
            "scale from the bias: hold the tilted board at half and at one and a half times the working distance too"
        )
    return "; ".join(said)


def off_drawing(found: SensorSolution) -> str:
    """Whether the beam is off its drawing by more than the tolerance allows, in words; empty where it is not."""
    evidence = found.evidence
    if evidence.off_drawing_sigmas < OFF_SIGMAS:
        return ""
    std_deg = float(np.degrees(np.sqrt(np.trace(found.sensor.covariance[3:6, 3:6]) / 2)))
    return (
        f"the beam is {evidence.off_drawing_deg:.1f} +- {std_deg:.1f} deg off its drawing, more than the tolerance: is "
        "panel.distance_sensor.direction as the sensor is mounted?"
    )
