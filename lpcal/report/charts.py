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

from lpcal.geometry.arrays import Array

WIDTH = 480
LEFT, RIGHT, TOP, BOTTOM = 42, 10, 22, 32


@dataclass(frozen=True)
class Bar:
    """One bar: its height (None: nothing was measured), what it is, and the tone of its colour."""

    value: float | None
    label: str
    tone: str = "accent"


def bars(items: Sequence[Bar], *, unit: str, across: str, height: int = 190, gate: float | None = None) -> str:
    """Bars in the order given; an item without a value is a tick on the axis; `gate` is a dashed line."""
    measured = [item.value for item in items if item.value is not None]
    top = max([*measured, gate or 0.0, 1e-12]) * 1.06
    plot = _Plot(height, (0, max(len(items), 1)), (0, top))
    thick = plot.width / max(len(items), 1)
    parts = plot.y_axis("deg" if unit == "°" else unit)
    for k, item in enumerate(items):
        u, tip = plot.u(k) + 0.1 * thick, f"<title>{escape(item.label)}</title>"
        v = plot.v(item.value) if item.value is not None else plot.v(0) - 5
        shape = f'x="{u:.1f}" y="{v:.1f}" width="{0.8 * thick:.2f}" height="{plot.v(0) - v:.1f}"'
        parts.append(f'<rect {shape} class="fill-{item.tone}">{tip}</rect>')
    if gate is not None:
        parts.append(plot.rule(gate))
    return plot.svg([*parts, plot.x_line(), plot.x_title(across)], f"bars, {across}, {unit}")


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
        parts.append(f'<rect {shape} class="fill-accent"><title>{tall} about {low + width / 2:.3g} {escape(unit)}</title></rect>')
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
    for ring in found:
        path = "L".join(f"{u:.1f} {v:.1f}" for u, v in ring.points_px * scale + 2)
        parts.append(f'<path class="{"gate" if ring.doubted else "curve"}" d="M{path}Z"><title>{escape(ring.label)}</title></path>')
        parts += [f'<circle class="fill-warm" cx="{u:.1f}" cy="{v:.1f}" r="1.5"/>' for u, v in ring.spots_px * scale + 2]
        u, v = ring.points_px.mean(axis=0)[0] * scale + 2, ring.points_px[:, 1].max() * scale + 15
        parts.append(f'<text class="middle" x="{u:.1f}" y="{min(v, height - 4):.1f}">{escape(ring.label)}</text>')
    return _svg(height, parts, "where the spheres' outlines were found in the image")


def over_image(points_px: Array, image_size: tuple[int, int], arrows_px: Array | None = None) -> str:
    """Points (N, 2) over the image's frame with a 6 by 4 grid; arrows (M, 4) start at x, y and go by dx, dy."""
    w, h = image_size
    scale = (WIDTH - 4) / w
    height = round(h * scale) + 4
    parts = [f'<rect x="2" y="2" width="{w * scale:.1f}" height="{h * scale:.1f}" class="plate"/>']
    parts += [f'<path d="M{2 + k * w * scale / 6:.1f} 2v{h * scale:.1f}" class="grid"/>' for k in range(1, 6)]
    parts += [f'<path d="M2 {2 + k * h * scale / 4:.1f}h{w * scale:.1f}" class="grid"/>' for k in range(1, 4)]
    inside = points_px[np.all((points_px > -1) & (points_px < [w, h]), axis=1)] * scale + 2
    parts.append(f'<path class="dots" d="{"".join(f"M{u:.1f} {v:.1f}h0" for u, v in inside)}"/>')
    for x, y, dx, dy in [] if arrows_px is None else arrows_px * scale:
        parts.append(f'<path class="arrow" d="M{x + 2:.1f} {y + 2:.1f}l{dx:.1f} {dy:.1f}"/>')
        parts.append(f'<circle class="fill-warm" cx="{x + 2:.1f}" cy="{y + 2:.1f}" r="2"/>')
    return _svg(height, parts, "where the board's corners fell in the image")


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
        parts.append(f"<circle {where} {shade}><title>{z:.3f} {escape(unit)}</title></circle>")
    return _svg(round((high[1] - low[1]) * scale), parts, f"map of a grid, {unit}")


def dot_rows(rows: Sequence[tuple[str, Sequence[tuple[float, str, str]]]], *, unit: str, gate: float | None = None) -> str:
    """One row a name; in it dots at values from zero, each with its label and tone."""
    height = TOP + BOTTOM + 24 * max(len(rows), 1)
    furthest = max([value for _, dots in rows for value, _, _ in dots] + [gate or 0.0, 1e-9])
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

    def __init__(self, height: int, x: tuple[float, float], y: tuple[float, float], left: int = LEFT) -> None:
        self.height, self.x, self.y, self.left = height, x, y, left
        self.width = WIDTH - left - RIGHT

    def u(self, x: float) -> float:
        return self.left + (x - self.x[0]) / (self.x[1] - self.x[0]) * self.width

    def v(self, y: float) -> float:
        return self.height - BOTTOM - (y - self.y[0]) / (self.y[1] - self.y[0]) * (self.height - TOP - BOTTOM)

    def y_axis(self, unit: str) -> list[str]:
        parts = []
        marks = ticks(*self.y)
        for tick in marks:
            parts.append(f'<path d="M{self.left} {self.v(tick):.1f}h{self.width}" class="grid"/>')
            parts.append(f'<text x="{self.left - 6}" y="{self.v(tick) + 4:.1f}" class="end">{tick:.4g}</text>')
        parts.append(f'<text x="{self.left - 6}" y="{TOP - 10}" class="end unit">{escape(unit)}</text>')
        return parts

    def x_ticks(self, unit: str) -> list[str]:
        v = self.height - BOTTOM + 14
        parts = [f'<text x="{self.u(tick):.1f}" y="{v}" class="middle">{tick:.4g}</text>' for tick in ticks(*self.x, 5)]
        return [*parts, f'<text x="{WIDTH - RIGHT}" y="{self.height - 4}" class="end unit">{escape(unit)}</text>']

    def x_line(self) -> str:
        return f'<path d="M{self.left} {self.v(0):.1f}h{self.width}" class="axis"/>'

    def x_title(self, text: str) -> str:
        return f'<text x="{self.left}" y="{self.height - 10}" class="unit">{escape(text)}</text>'

    def rule(self, y: float) -> str:
        return f'<path d="M{self.left} {self.v(y):.1f}h{self.width}" class="gate"/>'

    def svg(self, parts: Iterable[str], what: str) -> str:
        return _svg(self.height, parts, what)


def _svg(height: int, parts: Iterable[str], what: str) -> str:
    return f'<svg class="chart" viewBox="0 0 {WIDTH} {height}" role="img" aria-label="{escape(what)}">{"".join(parts)}</svg>'
