"""Before any hand-eye solve: what is wrong with a body's poses and a board's views, in words, with what corrects it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.api.handeye import boards_of, refuse_unpaired, stream_of
from lpcal.api.staged import staged
from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import clock, congruence, observability, set_up
from lpcal.chain.h_pc_handeye.advice import advise
from lpcal.chain.h_pc_handeye.ends import all_ends
from lpcal.chain.h_pc_handeye.moved import find_step
from lpcal.chain.h_pc_handeye.state import HandEyeOptions
from lpcal.errors import DegenerateError, DisagreementError, InputError, LpcalError
from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.pose_track import PoseTrack, TrackPoses, poses_at
from lpcal.records import given, screens
from lpcal.records.calibration import Carries
from lpcal.records.observations import BoardPoses, MarkerStream, PoseStream
from lpcal.records.shown import Shown


@dataclass(frozen=True, kw_only=True)
class CheckFigures:
    """The figures that could be had before something turned out to be wrong; None for the others."""

    mocap_samples: int | None = None
    """Samples of the recording with the body."""
    mocap_lost: int | None = None
    """Samples of the recording without the body."""
    mocap_rate_hz: float | None = None
    """Samples a second."""
    dropped: dict[str, int] | None = None
    """Samples that were left out, by the reason."""
    clock_offset_s: float | None = None
    """``t_camera = t_mocap + offset``, as the relative angles show it."""
    clock_offset_width_s: float | None = None
    """Over how many seconds offsets are as good."""
    rotation_spread_deg: Array | None = None
    """(3,) by how much the body turned, rms about three axes."""
    misplaced_m: float | None = None
    """Median distance by which the board misses its place, by the closed form."""
    views_off: tuple[str, ...] | None = None
    """Images whose board contradicts the others."""
    carries: Carries | None = None
    """What rides on the tracked body, the camera or the board."""
    expected_sigma_m: float | None = None
    """The position's expected standard deviation in its worst direction."""


@dataclass(frozen=True, repr=False)
class HandEyeCheck(Shown):
    """What was found, what is wrong, and the figures.

    Parameters
    ----------
    notes : tuple of (str, str)
        A topic and notes on it.
    wrong : tuple of LpcalError
        What makes a solve fail or err, each with what to do; empty where nothing is wrong.
    warnings : tuple of str
        What is worth knowing.
    figures : CheckFigures
        The figures.
    """

    notes: tuple[tuple[str, str], ...]
    wrong: tuple[LpcalError, ...] = ()
    warnings: tuple[str, ...] = ()
    figures: CheckFigures = field(default_factory=CheckFigures)


NAMED = 6
"""Images that are named before the rest is counted."""
STEP_SHARE = 0.2
"""Share of the misplacement that two parts leave, up to which a step is what is wrong where the whole is no rigid motion."""
WIDE_S = 0.2
"""A clock offset that shows no better than this is said to be vague."""
CLOCK_OFFSET = "clock_offset_s"
"""The argument that states the clock offset."""


@dataclass
class _Findings:
    """What is said as it comes, what is wrong, and the figures."""

    notes: list[tuple[str, str]] = field(default_factory=list)
    wrong: list[LpcalError] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    figures: CheckFigures = field(default_factory=CheckFigures)

    def say(self, topic: str, text: str) -> None:
        self.notes.append((topic, text))

    def know(self, **figures: Any) -> None:
        self.figures = replace(self.figures, **figures)


@staged("check")
def check_handeye(
    H_OP: PoseStream | MarkerStream | npt.ArrayLike,
    H_CB: BoardPoses | npt.ArrayLike,
    *,
    t_mocap_s: npt.ArrayLike | None = None,
    t_camera_s: npt.ArrayLike | None = None,
    clock_offset_s: float | None = None,
    carries: Carries | None = None,
    inverted: bool = False,
) -> HandEyeCheck:
    """Look at hand-eye data before any solve: what is wrong with them, and what they will show.

    Parameters
    ----------
    H_OP : PoseStream, MarkerStream, or ndarray (N, 4, 4)
        The body (P) in the room (O), metres, as `solve_handeye` takes it.
    H_CB : BoardPoses, or ndarray (M, 4, 4)
        The static board (B) in the camera (C), metres.
    t_mocap_s : ndarray (N,), optional
        Seconds on the mocap's clock, where `H_OP` is an array with times of its own.
    t_camera_s : ndarray (M,), optional
        Seconds on the camera's clock, of the views; needed wherever the body's poses have times.
    clock_offset_s : float, optional
        ``t_camera = t_mocap + clock_offset_s``, where it is stated: it is held against the angles.
    carries : str, optional
        What rides on the tracked body, "camera" or "board"; by default what the data say.
    inverted : bool
        Whether the poses came as H_PO and were inverted for this call.

    Returns
    -------
    HandEyeCheck
        Notes by topic, what is wrong (errors that are not raised), warnings, and figures: clock offset, spread of the turns in degrees,
        by how many metres the board misses its place, the expected standard deviation.

    Raises
    ------
    InputError, DisagreementError
        Arrays of another shape, transforms that are not rigid, times that are lacking.

    Examples
    --------
    >>> import lpcal
    >>> truth = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), seed=3).board_truth()
    >>> found = lpcal.check_handeye(truth.H_OP, truth.H_CB)
    >>> len(found.wrong), found.figures.carries
    (0, 'camera')
    """
    boards, options = boards_of(H_CB, t_camera_s), HandEyeOptions(inverted=inverted, carries=carries)
    stream = stream_of(H_OP, t_mocap_s)
    if stream is not None:
        findings = _of_stream(stream, boards, clock_offset_s, options)
    else:
        assert not isinstance(H_OP, PoseStream | MarkerStream)
        findings, poses = _Findings(), given.transforms(H_OP, "H_OP")
        refuse_unpaired(poses, boards)
        findings.say("poses", f"{len(poses)}, one a view, no clock")
        _motion(boards, poses, np.ones(len(poses), dtype=bool), findings, options)
    return HandEyeCheck(tuple(findings.notes), tuple(findings.wrong), tuple(findings.warnings), findings.figures)


def _of_stream(stream: PoseStream, boards: BoardPoses, clock_offset_s: float | None, options: HandEyeOptions) -> _Findings:
    """The findings on a recording; where its rate is misread that is said first, and the others are those of the corrected times."""
    if boards.t_camera_s is None:
        raise InputError("none are given", where="t_camera_s", needed="the views' times: the body's poses have times")
    findings = _Findings()
    pairs = _of_recording(stream, boards, clock_offset_s, findings)
    if pairs is not None:
        _motion(boards, *pairs, findings, options)
    misread = clock.misread_rate(track_of(stream), boards.t_camera_s, boards.H_CB) if findings.wrong else None
    if misread is None:
        return findings
    corrected = _of_stream(replace(stream, t_s=misread.factor * stream.t_s), boards, clock_offset_s, options)
    corrected.wrong.insert(0, misread.error)
    return corrected


@screens.screen_of.register
def _check_screen(found: HandEyeCheck) -> screens.RecordScreen:
    rows = [*found.notes, *(("WRONG", error.message().partition("\n")[0]) for error in found.wrong)]
    title = f"HandEyeCheck  {len(found.wrong)} wrong" if found.wrong else "HandEyeCheck  nothing wrong found"
    return screens.RecordScreen(title, rows, found.warnings)


def _of_recording(stream: PoseStream, boards: BoardPoses, stated_s: float | None, findings: _Findings) -> tuple[Array, Mask] | None:
    """The body's pose at each board view, and whether it is to be trusted; None where the clocks do not meet."""
    assert boards.t_camera_s is not None
    track = track_of(stream)
    _stream(stream, track, findings)
    t_camera_s, rate = clock.without_rate(track, boards.t_camera_s, boards.H_CB)
    if rate:
        findings.warnings.append(
            f"the clocks' rates differ by about {1e6 * rate:+.0f} ppm{_ntsc(rate)}: hand-eye finds the rate and uses it"
        )
    try:
        offset = _clock(track, t_camera_s, boards.H_CB, stated_s, findings)
    except LpcalError as error:
        findings.wrong.append(error)
        return None
    panel = poses_at(track, t_camera_s - offset)
    _lost_views(boards, panel, findings)
    return panel.H, panel.trusted


def _ntsc(rate: float) -> str:
    return " (29.97 frames a second counted as 30?)" if abs(abs(rate) - 1e-3) < 2e-4 else ""


def _stream(stream: PoseStream, track: PoseTrack, findings: _Findings) -> None:
    name = f"{stream.body}: " if stream.body else ""
    length = float(np.ptp(stream.t_s))
    rate = f", {stream.rate_hz:.1f} Hz" if len(stream.t_s) > 1 else ""
    findings.say("mocap", f"{name}{len(stream.t_s)} poses in {length:.1f} s{rate}; the body lost in {stream.lost} samples")
    for why, count in track.dropped.items():
        if count:
            findings.say("", f"{count} samples {why}: left out")
    for note in stream.notes:
        findings.say("", note)
    findings.know(mocap_samples=len(stream.t_s), mocap_lost=stream.lost, mocap_rate_hz=stream.rate_hz, dropped=dict(track.dropped))


def _clock(track: PoseTrack, t_camera_s: Array, H_CB: Array, stated_s: float | None, findings: _Findings) -> float:
    known_s = stated_s or 0.0
    candidates = [replace(each, offset_s=each.offset_s + known_s) for each in clock.offset_candidates(track, t_camera_s - known_s, H_CB)]
    apart = clock.epochs(track, t_camera_s - known_s)
    if apart:
        findings.say("", apart)
    if not candidates:
        raise DegenerateError(
            "no clock offset at which a third of the views fall into the recording", needed="recordings of the same minutes"
        )
    best = candidates[0]
    precision = f", no better than +- {0.5 * best.width_s:.2f} s: the panel stood still" if best.width_s > WIDE_S else ""
    if rests := _rests(track, t_camera_s, H_CB, best):
        low, high = rests
        precision = (
            f", anywhere from {1e3 * low:+.0f} to {1e3 * high:+.0f} ms: the panel stood still in every view, the offset does not show"
        )
        best = replace(best, offset_s=(low + high) / 2, width_s=max(best.width_s, high - low))
    findings.say("clock", f"t_camera = t_mocap {1e3 * best.offset_s:+.0f} ms by relative angles{precision}")
    findings.know(clock_offset_s=best.offset_s, clock_offset_width_s=best.width_s)
    if stated_s is None:
        return best.offset_s
    alike = clock.fits_as_well(track, t_camera_s, H_CB, known_s, best)
    if not alike and abs(best.offset_s - known_s) > max(WIDE_S, best.width_s):
        findings.wrong.append(
            DisagreementError(
                f"the stated clock offset is {1e3 * stated_s:.0f} ms, the angles say {1e3 * best.offset_s:.0f} ms",
                where=CLOCK_OFFSET,
                needed="t_camera = t_mocap + offset",
                todo="leave it out: it is estimated",
            )
        )
        return best.offset_s
    return stated_s


def _rests(track: PoseTrack, t_camera_s: Array, H_CB: Array, best: clock.OffsetCandidate) -> tuple[float, float] | None:
    """The offsets between which all views fall into rests of the panel, so that none is better than another; None where it moved."""
    low, high = clock.as_good(track, t_camera_s, H_CB, best)
    panel = poses_at(track, t_camera_s - (low + high) / 2)
    return (low, high) if panel.trusted.any() and panel.steady[panel.trusted].all() else None


def _lost_views(boards: BoardPoses, panel: TrackPoses, findings: _Findings) -> None:
    for why in dict.fromkeys(each for each in panel.why if each is not None):
        images = [image for image, each in zip(boards.images, panel.why, strict=True) if each == why]
        more = f" and {len(images) - NAMED} more" if len(images) > NAMED else ""
        findings.say("", f"{len(images)} views without a pose, {why}: {', '.join(images[:NAMED])}{more}")


def _exchanged(pairs: Sequence[tuple[str, str]]) -> list[str]:
    """What is to be said of views with each other's poses."""
    if not pairs:
        return []
    more = f" and {len(pairs) - NAMED} more pairs" if len(pairs) > NAMED else ""
    said = "; ".join(f"{one} and {other}" for one, other in pairs[:NAMED])
    return [f"{said}{more}: each fits the pose of the other, their poses are exchanged"]


def _motion(boards: BoardPoses, H_OP: Array, trusted: Mask, findings: _Findings, options: HandEyeOptions) -> None:
    found = set_up.of_pairs(H_OP[trusted], boards.H_CB[trusted], options, from_images=boards.corners_px is not None)
    if found.board_carried:
        findings.say("set-up", "the camera stands still in the room, the tracked body carries the board")
    findings.warnings += found.warnings()
    H_OP = found.mover(H_OP)
    boards, turned = all_ends(boards, H_OP, trusted)
    if turned.any():
        images = [image for image, other in zip(boards.images, turned, strict=True) if other]
        more_images = f" and {len(images) - NAMED} more" if len(images) > NAMED else ""
        findings.say(
            "ends", f"{len(images)} boards were found by their other end, and are turned: {', '.join(images[:NAMED])}{more_images}"
        )
    H_OP, H_CB = H_OP[trusted], boards.H_CB[trusted]
    names = [image for image, ok in zip(boards.images, trusted, strict=True) if ok]
    agreed = None
    try:
        measured = se3.inv(H_OP) if found.board_carried else H_OP
        spread, more = observability.refuse_what_cannot_show_it(measured)
        agreed = park.consensus(H_OP, H_CB)
        spread, more = observability.refuse_what_cannot_show_it(measured[agreed.inliers])
    except DegenerateError as error:
        off = [] if agreed is None else [name for name, inlier in zip(names, agreed.inliers, strict=True) if not inlier]
        if off:
            findings.say("", f"{len(off)} views off, their poses lost or flipped: {', '.join(off[:NAMED])}")
        findings.wrong.append(error)
        return
    findings.say("motion", f"the panel's turns spread by {spread.words()} about its principal axes")
    findings.know(rotation_spread_deg=np.degrees(spread.sigma_rad))
    findings.warnings += more
    step = find_step(H_OP, H_CB, names, board_carried=found.board_carried)
    try:
        congruence.refuse(H_OP, H_CB, agreed, from_images=boards.corners_px is not None)
    except DisagreementError as error:
        findings.wrong.append(step.refusal() if step is not None and step.parted_m < STEP_SHARE * step.misplaced_m else error)
        return
    if step is not None:
        findings.wrong.append(step.refusal())
    off = [name for name, inlier in zip(names, agreed.inliers, strict=True) if not inlier]
    findings.say("rigid", f"body and camera move as one; the board is misplaced by {1e3 * agreed.scatter_m:.1f} mm (median, closed form)")
    if off:
        more_text = f" and {len(off) - NAMED} more" if len(off) > NAMED else ""
        findings.say("", f"{len(off)} views off, flipped or blurred: {', '.join(off[:NAMED])}{more_text}")
    findings.warnings += _exchanged([(names[one], names[other]) for one, other in congruence.exchanged(H_OP, H_CB, agreed)])
    carries: Carries = "board" if found.board_carried else "camera"
    findings.know(misplaced_m=agreed.scatter_m, views_off=tuple(off), carries=carries)
    size = congruence.closed_form_size_warning(H_OP[agreed.inliers], H_CB[agreed.inliers], agreed.H_PC, carries)
    behind = congruence.behind_warning(H_CB[agreed.inliers])
    findings.warnings += [words for words in (size, behind) if words]
    if carries == "camera":
        roles = congruence.swapped_roles_warning(agreed.H_PC, agreed.H_OB)
        findings.warnings += [roles] if roles else []
        advised = advise(H_OP[agreed.inliers], H_CB[agreed.inliers], agreed.H_PC, agreed.H_OB)
        findings.say("expected", f"by the scatter of these views H_PC is known {advised.words()}")
        findings.know(expected_sigma_m=advised.sigma_m)
