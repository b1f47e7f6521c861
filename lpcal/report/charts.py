"""Charts as inline SVG: bars, histogram, curves, points over the image, a signed map of a grid, dots in rows.

Every chart is 480 units wide and takes its colours from the page's custom properties, so that it follows light, dark and print.
Data go to the drawing by ``u = left + (x - x0) / (x1 - x0) width``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from lpcal.geometry.arrays import Array, Mask
from lpcal.report.wording import shown

WIDTH = 480
LEFT, RIGHT, TOP, BOTTOM = 42, 10, 22, 32
NAME_ROOM = 12
"""Units of the drawing that a name under the axis takes across, turned by 60 degrees."""
LONGEST_NAME, MOST_BELOW = 14, 68
"""Letters of a name, and units under the axis that names may take."""
LEAST_SPAN = 1e-3
"""Length of the axis of dots that all lie at zero: nothing that a page shows, degrees or pixels, is known more finely."""
LETTER = 7.0
"""Units of the drawing that a letter takes across, at most, in the charts' type."""
LINE = 13.0
"""Units of the drawing from one line of type to the next."""
SEAM = 0.4
"""By how much a cell reaches over the next ones, which are drawn over it: edges that only touch show as lines."""
BAR = 12
"""Height of a colour bar."""


@dataclass(frozen=True)
class Drawing:
    """A chart, as SVG, and what stands over it."""

    svg: str
    note: str


@dataclass(frozen=True)
class Bar:
    """One bar: its height (None: nothing was measured), what it is, and the tone of its colour."""

    value: float | None
    label: str
    tone: str = "accent"
    name: str = ""
    """What stands under the axis."""


def bars(items: Sequence[Bar], *, unit: str, across: str, height: int = 190, gate: float | None = None) -> str:
    """Bars in the order given; an item without a value is a tick on the axis; `gate` is a dashed line.

    Where the items have names they stand under the axis, as many of them as there is room for.
    """
    measured = [item.value for item in items if item.value is not None]
    top = max([*measured, gate or 0.0, 1e-12]) * 1.06
    longest = max((len(item.name) for item in items), default=0)
    thick = (WIDTH - LEFT - RIGHT) / max(len(items), 1)
    level = longest * LETTER < thick
    below = 0 if not longest else 10 if level else min(10 + 5 * longest, MOST_BELOW)
    plot = _Plot(height + below, (0, max(len(items), 1)), (0, top), bottom=BOTTOM + below)
    parts = plot.y_axis("degrees" if unit == "°" else unit)
    for k, item in enumerate(items):
        u, tip = plot.u(k) + 0.1 * thick, f"<title>{escape(item.label)}</title>"
        v = plot.v(item.value) if item.value is not None else plot.v(0) - 5
        shape = f'x="{u:.1f}" y="{v:.1f}" width="{0.8 * thick:.2f}" height="{plot.v(0) - v:.1f}"'
        parts.append(f'<rect {shape} class="fill-{item.tone}">{tip}</rect>')
    if gate is not None:
        parts.append(plot.rule(gate))
    parts += _level_names(items, plot) if level else _turned_names(items, plot)
    return plot.svg([*parts, plot.x_line(), plot.x_title(across)], f"bars, {across}, {unit}")


def _level_names(items: Sequence[Bar], plot: _Plot) -> list[str]:
    """The bars' names under the axis, where each has room."""
    v = plot.v(0) + 13
    return [f'<text class="middle level" x="{plot.u(k + 0.5):.1f}" y="{v:.1f}">{escape(item.name)}</text>' for k, item in enumerate(items)]


def _turned_names(items: Sequence[Bar], plot: _Plot) -> list[str]:
    """The bars' names under the axis, on end, as many of them as there is room for."""
    every, drawn = max(1, math.ceil(len(items) * NAME_ROOM / plot.width)), []
    for k, item in enumerate(items):
        if item.name and k % every == 0:
            u, v = plot.u(k + 0.5) + 3, plot.v(0) + 9
            shown = item.name if len(item.name) <= LONGEST_NAME else f"…{item.name[1 - LONGEST_NAME :]}"
            drawn.append(f'<text class="end name" x="{u:.1f}" y="{v:.1f}" transform="rotate(-60 {u:.1f} {v:.1f})">{escape(shown)}</text>')
    return drawn


def histogram(values: Array, *, unit: str, sigma: float, height: int = 190) -> str:
    """How many of the values (N,) lie where, within 5 sigma of zero, and the normal curve of that sigma over it."""
    count, stop = 40, 5 * sigma
    heights, edges = np.histogram(values, bins=count, range=(-stop, stop))
    width = 2 * stop / count
    x = np.linspace(-stop, stop, 121)
    normal = values.size * width * np.exp(-0.5 * (x / sigma) ** 2) / (sigma * math.sqrt(2 * math.pi))
    plot = _Plot(height, (-stop, stop), (0, 1.06 * max(float(heights.max()), float(normal.max()), 1.0)))
    parts = plot.y_axis("count")
    for low, tall in zip(edges[:-1], heights.tolist(), strict=True):
        u, v = plot.u(low), plot.v(tall)
        shape = f'x="{u + 0.4:.1f}" y="{v:.1f}" width="{plot.u(low + width) - u - 0.8:.2f}" height="{plot.v(0) - v:.1f}"'
        parts.append(f'<rect {shape} class="fill-accent"><title>{tall} about {shown(low + width / 2)} {escape(unit)}</title></rect>')
    path = "L".join(f"{plot.u(u):.1f} {plot.v(v):.1f}" for u, v in zip(x, normal, strict=True))
    parts.append(f'<path d="M{path}" class="gate"/>')
    return plot.svg([*parts, plot.x_line(), *plot.x_ticks(unit)], f"histogram, {unit}")


@dataclass(frozen=True)
class Ring:
    """A closed line (K, 2) in an image, spots (M, 2) in it, what it is, and whether it is to be doubted."""

    points_px: Array
    spots_px: Array
    label: str
    doubted: bool = False


def rings(found: Sequence[Ring], image_size: tuple[int, int]) -> str:
    """Closed lines over the image's frame, each with its name and its spots."""
    w, h = image_size
    scale = (WIDTH - 4) / w
    height = round(h * scale) + 4
    parts = [f'<rect x="2" y="2" width="{w * scale:.1f}" height="{h * scale:.1f}" class="plate"/>']
    taken: list[tuple[float, float, float]] = []
    for ring in found:
        path = "L".join(f"{u:.1f} {v:.1f}" for u, v in ring.points_px * scale + 2)
        parts.append(f'<path class="{"gate" if ring.doubted else "curve"}" d="M{path}Z"><title>{escape(ring.label)}</title></path>')
        parts += [f'<circle class="fill-warm" cx="{u:.1f}" cy="{v:.1f}" r="1.5"/>' for u, v in ring.spots_px * scale + 2]
        u, v = _free_place(ring, scale, height, taken)
        parts.append(f'<text class="middle" x="{u:.1f}" y="{v:.1f}">{escape(ring.label)}</text>')
    return framed(height, parts, "where the spheres' outlines were found in the image")


def _free_place(ring: Ring, scale: float, height: int, taken: list[tuple[float, float, float]]) -> tuple[float, float]:
    """Where a ring's name stands, its middle and its foot: under the ring, else over it or further under it, clear of those `taken`."""
    u, half = float(ring.points_px[:, 0].mean()) * scale + 2, len(ring.label) * LETTER / 2
    top, foot = (float(edge) * scale for edge in (ring.points_px[:, 1].min(), ring.points_px[:, 1].max()))
    places = [min(foot + 15, height - 4), max(top - 5, 12), min(foot + 15 + LINE, height - 4), max(top - 5 - LINE, 12)]
    free = [v for v in places if all(abs(u - x) >= half + other or abs(v - y) >= LINE for x, y, other in taken)]
    v = free[0] if free else places[0]
    taken.append((u, v, half))
    return u, v


def over_image(points_px: Array, image_size: tuple[int, int], arrows_px: Array | None = None) -> str:
    """Points (N, 2) over the image's frame with a 6 by 4 grid; arrows (M, 4) start at x, y and go by dx, dy."""
    w, h = image_size
    scale = (WIDTH - 4) / w
    height = round(h * scale) + 4
    parts = [f'<rect x="2" y="2" width="{w * scale:.1f}" height="{h * scale:.1f}" class="plate"/>']
    parts += [f'<path d="M{2 + k * w * scale / 6:.1f} 2v{h * scale:.1f}" class="grid"/>' for k in range(1, 6)]
    parts += [f'<path d="M2 {2 + k * h * scale / 4:.1f}h{w * scale:.1f}" class="grid"/>' for k in range(1, 4)]
    inside = points_px[np.all((points_px > -1) & (points_px < [w, h]), axis=1)] * scale + 2
    over = [f'<path class="dots" d="{"".join(f"M{u:.1f} {v:.1f}h0" for u, v in inside)}"/>']
    for x, y, dx, dy in [] if arrows_px is None else arrows_px * scale:
        over.append(f'<path class="arrow" d="M{x + 2:.1f} {y + 2:.1f}l{dx:.1f} {dy:.1f}"/>')
        over.append(f'<circle class="fill-warm" cx="{x + 2:.1f}" cy="{y + 2:.1f}" r="2"/>')
    parts.append(_within(w * scale, h * scale, over))
    return framed(height, parts, "where the board's corners fell in the image")


def signed_grid(points: Array, value: Array, *, unit: str) -> str:
    """Values (N,) at points (N, 2) of a plane: warm above zero, cool below, the strongest opaque."""
    low, high = points.min(axis=0), points.max(axis=0)
    pitch = float(np.sqrt(np.prod(np.maximum(high - low, 1e-9)) / max(len(points), 1)))
    low, high = low - 0.6 * pitch, high + 0.6 * pitch
    scale = min(WIDTH / (high[0] - low[0]), 300 / (high[1] - low[1]))
    strongest = float(np.abs(value).max()) or 1.0
    shift = (WIDTH - scale * (high[0] - low[0])) / 2
    parts = []
    for (x, y), z in zip(points, value, strict=True):
        tone = "warm" if z >= 0 else "cool"
        where = f'cx="{shift + (x - low[0]) * scale:.1f}" cy="{(y - low[1]) * scale:.1f}" r="{0.42 * pitch * scale:.1f}"'
        shade = f'class="fill-{tone}" opacity="{0.08 + 0.92 * abs(z) / strongest:.2f}"'
        parts.append(f"<circle {where} {shade}><title>{shown(z)} {escape(unit)}</title></circle>")
    height = round((high[1] - low[1]) * scale)
    parts += _colour_bar(height + 8, (-strongest, strongest), unit, signed=True)
    return framed(height + 8 + BAR + 18, parts, f"map of a grid, {unit}, from {-strongest:.2g} to {strongest:.2g}")


def heat_map(value: Array, *, unit: str, aspect: float, outline: Mask | None = None, what: str = "map", low: float = 0.0) -> str:
    """Values (R, C) as cells over a frame of width over height `aspect`, darker where larger, NaN left empty, with a colour bar.

    `outline` (R, C) draws a line round the cells where it is true. The bar begins at `low`.
    """
    rows, columns = value.shape
    high = float(np.nanmax(value, initial=low + 1e-12))
    across, frame = (WIDTH - 4) / columns, (WIDTH - 4) / aspect
    down = frame / rows
    parts = [f'<rect x="2" y="2" width="{WIDTH - 4}" height="{frame:.1f}" class="plate"/><g class="cells">']
    for (r, c), one in np.ndenumerate(value):
        if np.isfinite(one):
            shade = 0.04 + 0.96 * min(max((one - low) / max(high - low, 1e-12), 0.0), 1.0)
            where = f'x="{2 + c * across:.1f}" y="{2 + r * down:.1f}" width="{across + SEAM:.1f}" height="{down + SEAM:.1f}"'
            parts.append(f'<rect {where} style="--share:{shade:.0%}"><title>{shown(one)} {escape(unit)}</title></rect>')
    parts.append("</g>")
    if outline is not None:
        parts.append(f'<path class="border" d="{_border(outline, across, down)}"/>')
    parts += _colour_bar(round(frame) + 12, (low, high), unit, signed=False)
    return framed(round(frame) + 12 + BAR + 18, parts, f"{what}, {unit}, from {low:.3g} to {high:.3g}")


def _border(inside: Mask, across: float, down: float) -> str:
    """The line between cells that are inside and those that are not, or the frame."""
    padded = np.pad(inside, 1)
    upright, level = np.argwhere(padded[:, 1:] != padded[:, :-1]), np.argwhere(padded[1:] != padded[:-1])
    steps = [f"M{2 + c * across:.1f} {2 + (r - 1) * down:.1f}v{down:.1f}" for r, c in upright]
    steps += [f"M{2 + (c - 1) * across:.1f} {2 + r * down:.1f}h{across:.1f}" for r, c in level]
    return "".join(steps)


def _colour_bar(top: float, span: tuple[float, float], unit: str, *, signed: bool) -> list[str]:
    """A bar from the least to the largest value with its numbers under it."""
    left, width, steps = 60, WIDTH - 120, 24
    parts = ['<g class="cells">']
    for k in range(steps):
        share = (k + 0.5) / steps
        tone = "accent" if not signed else ("warm" if share > 0.5 else "cool")
        shade = 0.04 + 0.96 * share if not signed else 0.08 + 0.92 * abs(2 * share - 1)
        where = f'x="{left + k * width / steps:.1f}" y="{top}" width="{width / steps + SEAM:.1f}" height="{BAR}"'
        parts.append(f'<rect {where} class="{tone}" style="--share:{shade:.0%}"/>')
    parts.append("</g>")
    for share, value in ((0.0, span[0]), (0.5, sum(span) / 2), (1.0, span[1])):
        end = f" {escape(unit)}" if share == 1.0 else ""
        parts.append(f'<text class="middle" x="{left + share * width:.1f}" y="{top + BAR + 14}">{shown(value)}{end}</text>')
    return parts


def vectors(points_px: Array, arrows_px: Array, image_size: tuple[int, int]) -> str:
    """A line from each point (N, 2) by its arrow (N, 2), over the image's frame."""
    w, h = image_size
    scale = (WIDTH - 4) / w
    height = round(h * scale) + 4
    lines = "".join(
        f"M{x:.1f} {y:.1f}l{dx:.1f} {dy:.1f}" for (x, y), (dx, dy) in zip(points_px * scale + 2, arrows_px * scale, strict=True)
    )
    frame = f'<rect x="2" y="2" width="{w * scale:.1f}" height="{h * scale:.1f}" class="plate"/>'
    drawn = _within(w * scale, h * scale, [f'<path class="vectors" d="{lines}"/>'])
    return framed(height, [frame, drawn], "residuals of the corners, as lines over the image")


def _within(width: float, height: float, parts: Iterable[str]) -> str:
    """Parts of a drawing cut off at the plate of an image, which begins at (2, 2)."""
    frame = f'x="2" y="2" width="{width:.1f}" height="{height:.1f}" viewBox="2 2 {width:.1f} {height:.1f}"'
    return f'<svg {frame} overflow="hidden">{"".join(parts)}</svg>'


def dot_rows(rows: Sequence[tuple[str, Sequence[tuple[float, str, str]]]], *, unit: str, gate: float | None = None) -> str:
    """One row a name; in it dots at values from zero, each with its label and tone."""
    height = TOP + BOTTOM + 24 * max(len(rows), 1)
    furthest = max([value for _, dots in rows for value, _, _ in dots] + [gate or 0.0, LEAST_SPAN])
    plot = _Plot(height, (0, furthest * 1.08), (len(rows), 0), left=64)
    parts = [] if gate is None else [f'<path d="M{plot.u(gate):.1f} {TOP}V{height - BOTTOM}" class="gate"/>']
    for k, (name, dots) in enumerate(rows):
        v = plot.v(k + 0.5)
        parts.append(f'<path d="M{plot.left} {v:.1f}h{plot.width}" class="grid"/>')
        parts.append(f'<text x="{plot.left - 8}" y="{v + 4:.1f}" class="end">{escape(name)}</text>')
        for value, label, tone in dots:
            shape = f'cx="{plot.u(value):.1f}" cy="{v:.1f}" r="4.5" class="fill-{tone}" opacity=".8"'
            parts.append(f"<circle {shape}><title>{escape(label)}</title></circle>")
    return plot.svg([*parts, *plot.x_ticks(unit)], f"dots in rows, {unit}")


def curves(lines: Sequence[tuple[str, Array, Array]], *, across: str, unit: str, height: int = 190) -> str:
    """Curves y (N,) over x (N,), each with its name."""
    stop = max(float(x.max(initial=1e-9)) for _, x, _ in lines)
    top = max(float(np.nanmax(y, initial=1e-9)) for _, _, y in lines)
    plot = _Plot(height, (0, stop), (0, 1.06 * top))
    parts = plot.y_axis(unit)
    for name, x, y in lines:
        path = "L".join(f"{plot.u(u):.1f} {plot.v(v):.1f}" for u, v in zip(x, y, strict=True))
        parts.append(f'<path d="M{path}" class="curve"><title>{escape(name)}</title></path>')
    return plot.svg([*parts, plot.x_line(), *plot.x_ticks(across)], f"curves, {across}, {unit}")


def ticks(low: float, high: float, about: int = 4) -> list[float]:
    """Round numbers from low to high, `about` of them."""
    raw = (high - low) / max(about, 1)
    power = 10 ** math.floor(math.log10(raw))
    step = next(step * power for step in (1, 2, 5, 10) if step * power >= raw * 0.999)
    return [k * step for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


class _Plot:
    """Axes of one chart: data to drawing, and the marks along both."""

    def __init__(self, height: int, x: tuple[float, float], y: tuple[float, float], left: int = LEFT, bottom: int = BOTTOM) -> None:
        self.height, self.x, self.y, self.left, self.bottom = height, x, y, left, bottom
        self.width = WIDTH - left - RIGHT

    def u(self, x: float) -> float:
        return self.left + (x - self.x[0]) / (self.x[1] - self.x[0]) * self.width

    def v(self, y: float) -> float:
        return self.height - self.bottom - (y - self.y[0]) / (self.y[1] - self.y[0]) * (self.height - TOP - self.bottom)

    def y_axis(self, unit: str) -> list[str]:
        parts = []
        marks = ticks(*self.y)
        for tick in marks:
            parts.append(f'<path d="M{self.left} {self.v(tick):.1f}h{self.width}" class="grid"/>')
            parts.append(f'<text x="{self.left - 6}" y="{self.v(tick) + 4:.1f}" class="end">{shown(tick, 4)}</text>')
        parts.append(f'<text x="2" y="{TOP - 14}" class="unit">{escape(unit)}</text>')
        return parts

    def x_ticks(self, unit: str) -> list[str]:
        v = self.height - BOTTOM + 14
        parts = [f'<text x="{self.u(tick):.1f}" y="{v}" class="middle">{shown(tick, 4)}</text>' for tick in ticks(*self.x, 5)]
        return [*parts, f'<text x="{WIDTH - RIGHT}" y="{self.height - 4}" class="end unit">{escape(unit)}</text>']

    def x_line(self) -> str:
        return f'<path d="M{self.left} {self.v(0):.1f}h{self.width}" class="axis"/>'

    def x_title(self, text: str) -> str:
        return f'<text x="{self.left}" y="{self.height - 10}" class="unit">{escape(text)}</text>'

    def rule(self, y: float) -> str:
        return f'<path d="M{self.left} {self.v(y):.1f}h{self.width}" class="gate"/>'

    def svg(self, parts: Iterable[str], what: str) -> str:
        return framed(self.height, parts, what)


def framed(height: int, parts: Iterable[str], what: str) -> str:
    """The parts of a drawing as one SVG of this height; `what` is said to those who cannot see it."""
    return f'<svg class="chart" viewBox="0 0 {WIDTH} {height}" role="img" aria-label="{escape(what)}">{"".join(parts)}</svg>'
