"""The recording over time: how far the body went and turned, where it was lost or jumped, and each view's residual at its moment.

Time is the mocap's clock, from the recording's first moment; a view taken at ``t`` on the camera's clock stands at the time that
`HandEye.mocap_times` gives it. A clock that drifts shows as residuals that grow with time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.records.body_course import BodyCourse, Lapse
from lpcal.records.calibration import HandEye
from lpcal.report.charts import LEFT, RIGHT, WIDTH, Drawing, framed, ticks
from lpcal.report.wording import fixed, number, plural, shown

STRIP, BETWEEN, HEAD, FOOT = 76, 26, 22, 32
"""Height of a strip, what is free between two, over the first and under the last, in the drawing's units."""
GAP_S = 3.0
"""A curve is broken where its moments lie further apart than so many times the usual."""


def time_lines(course: BodyCourse, found: HandEye, image_times_s: Mapping[str, float]) -> Drawing | None:
    """Three strips over one axis of time; None where the recording has no moment to trust."""
    if len(course.t_s) < 2:
        return None
    views = [view for view in found.views if view.image in image_times_s]
    at_s = found.mocap_times(np.array([image_times_s[view.image] for view in views], dtype=float)) if views else np.zeros(0)
    ends = [one for lapse in course.lapses for one in (lapse.start_s, lapse.end_s)]
    zero = min([float(course.t_s[0]), *ends])
    stop = max([float(course.t_s[-1]), *ends]) - zero
    left_over = [None if view.residual_m is None else 1000 * view.residual_m for view in views]
    axis = _Axis(zero, max(stop, 1e-9))
    strips = [
        ("mm from its usual place", 1000 * course.moved_m),
        ("° turned", np.degrees(course.turned_rad)),
    ]
    parts = [*_shades(course.lapses, axis)]
    for k, (unit, value) in enumerate(strips):
        scale = _Scale(k, float(value.max(initial=1e-9)))
        parts += [*scale.marks(unit), *(f'<path class="curve" d="{path}"/>' for path in _curves(axis, scale, course.t_s, value))]
    scale = _Scale(2, max([one for one in left_over if one is not None], default=1.0))
    parts += scale.marks("mm, a view's residual")
    for view, t, one in zip(views, at_s.tolist(), left_over, strict=True):
        u, v = axis.u(t), scale.v(one or 0.0)
        label = f"{view.image}: {number(one, 3, 'mm')}" + ("" if view.used else f", left out: {view.why or 'no reason given'}")
        tone = "accent" if view.used else "fair"
        parts.append(f'<circle class="fill-{tone}" cx="{u:.1f}" cy="{v:.1f}" r="3" opacity=".8"><title>{escape(label)}</title></circle>')
    parts += axis.marks()
    return Drawing(framed(HEIGHT, parts, "the body and the views over the recording"), _note(course.lapses, found, stop))


HEIGHT = HEAD + 3 * STRIP + 2 * BETWEEN + FOOT
"""Height of the whole drawing, in its units."""


class _Axis:
    """Time, in seconds from the recording's first moment, along the drawing."""

    def __init__(self, zero: float, stop: float) -> None:
        self.zero, self.stop = zero, stop

    def u(self, t_s: float) -> float:
        return LEFT + (t_s - self.zero) / self.stop * (WIDTH - LEFT - RIGHT)

    def marks(self) -> list[str]:
        v = HEIGHT - FOOT + 14
        drawn = [
            f'<text x="{self.u(self.zero + tick):.1f}" y="{v}" class="middle">{shown(tick, 4)}</text>' for tick in ticks(0, self.stop, 6)
        ]
        return [*drawn, f'<text x="{WIDTH - RIGHT}" y="{HEIGHT - 4}" class="end unit">s of the recording</text>']


class _Scale:
    """The k-th strip: values from zero to its largest, upwards."""

    def __init__(self, k: int, top: float) -> None:
        self.foot, self.top = HEAD + k * (STRIP + BETWEEN) + STRIP, 1.08 * max(top, 1e-9)

    def v(self, value: float) -> float:
        return self.foot - value / self.top * STRIP

    def marks(self, unit: str) -> list[str]:
        across = WIDTH - LEFT - RIGHT
        drawn = [f'<text x="{LEFT}" y="{self.foot - STRIP - 6}" class="unit">{escape(unit)}</text>']
        for tick in ticks(0, self.top, 3):
            line = "axis" if tick == 0 else "grid"
            drawn.append(f'<path d="M{LEFT} {self.v(tick):.1f}h{across}" class="{line}"/>')
            drawn.append(f'<text x="{LEFT - 6}" y="{self.v(tick) + 4:.1f}" class="end">{shown(tick, 4)}</text>')
        return drawn


def _shades(lapses: Sequence[Lapse], axis: _Axis) -> list[str]:
    """A band over all strips for each stretch without a pose to trust."""
    drawn = []
    for one in lapses:
        u, width = axis.u(one.start_s), max(axis.u(one.end_s) - axis.u(one.start_s), 1.0)
        label = f"{'flipped or jumped' if one.tracked else 'not seen'}: {one.end_s - one.start_s:.2f} s"
        where = f'x="{u:.1f}" y="{HEAD - 4}" width="{width:.1f}" height="{HEIGHT - HEAD - FOOT + 4}"'
        drawn.append(f'<rect {where} class="fill-{"poor" if one.tracked else "fair"}" opacity=".28"><title>{label}</title></rect>')
    return drawn


def _curves(axis: _Axis, scale: _Scale, t_s: Array, value: Array) -> list[str]:
    """The curve of a strip, broken where moments are lacking."""
    usual = float(np.median(np.diff(t_s)))
    pieces = np.split(np.arange(len(t_s)), np.flatnonzero(np.diff(t_s) > GAP_S * usual) + 1)
    return ["M" + "L".join(f"{axis.u(t_s[k]):.1f} {scale.v(value[k]):.1f}" for k in piece.tolist()) for piece in pieces if len(piece) > 1]


def _note(lapses: Sequence[Lapse], found: HandEye, stop_s: float) -> str:
    """What the drawing says, in words, and what to do about it."""
    flips, gaps = [one for one in lapses if one.tracked], [one for one in lapses if not one.tracked]

    def label(some: Sequence[Lapse], what: str) -> str:
        longest = max((one.end_s - one.start_s for one in some), default=0.0)
        return f"{what} {plural(len(some), 'time')}, {longest:.1f} s at most" if some else ""

    parts = [part for part in (label(gaps, "not seen (amber)"), label(flips, "flipped or jumped (red)")) if part]
    note = (
        f"{fixed(stop_s, 0, 's')} of the recording; the body was " + (" and ".join(parts) if parts else "seen and steady all along") + ". "
    )
    note += "Hidden markers make gaps: turn the body towards the cameras. " if gaps else ""
    note += "Markers that fit in two ways make flips: move one of them. " if flips else ""
    drift_ms = 1000 * found.clock_drift * stop_s
    if abs(drift_ms) > 0:
        note += f"The clocks drift apart by {fixed(abs(drift_ms), 2, 'ms')} over it, which is taken into account. "
    return note + "Dots: each view's residual; amber: left out. Dots that rise with time are a clock that drifts."
