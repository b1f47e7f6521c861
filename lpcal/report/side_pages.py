"""The pages beside the report, each one file that opens offline, and the plot of a study.

`lpcal diff`: two rigs drawn over each other, and the table of what has changed. Many surfaces: surfaces.html, worst first, beside the
surfaces' folders. `lpcal watch`: what was judged and what comes next; it asks for the state once a second. `lpcal mark`: a capture's
images, on which a sphere, a board or a mask is marked. `lpcal study`: the error of the normals against what was varied.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal import __version__
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration
from lpcal.records.comparison import SEEN_SIGMAS, CalibrationChange, LightChange
from lpcal.report.page_data import MarkData, WatchData
from lpcal.report.rig_report import RigReport
from lpcal.report.scene import rig_scene
from lpcal.report.scene_items import LineItem, LineScene
from lpcal.report.templates import environment, packed_three, script_json
from lpcal.report.wording import fixed, grouped

DIFF_MARK = '<meta name="lpcal-page" content="diff">'
"""What marks the page as lpcal's."""

ROOM = 1.2
"""By how much the drawing of two rigs is wider than the one rig, so that arrows, drawn longer than they are, stay in it."""


def diff_html(
    names: tuple[str, str], rigs: tuple[Calibration, Calibration], change: CalibrationChange, remarks: Sequence[str], verdict: str
) -> str:
    """The page: the verdict where nothing has changed, the table, the `remarks` beside it, and the rigs over each other."""
    scene = scene_of(rigs, change)
    return (
        environment()
        .get_template("diff.html")
        .render(
            mark=DIFF_MARK,
            names=names,
            change=change,
            table=change_table(change),
            remarks=remarks,
            verdict=verdict,
            scene=None if scene is None else script_json(scene.document()),
            three=packed_three(),
            version=__version__,
        )
    )


@dataclass(frozen=True)
class ChangeRow:
    """A light: what it is called, its figures, and what has changed beyond chance."""

    name: str
    found: Sequence[str]
    least: Sequence[str]
    says: str


@dataclass(frozen=True)
class ChangeTable:
    """Heads of the columns, what was found and what would have shown, and a row a light."""

    found: Sequence[str]
    least: Sequence[str]
    sigmas: int
    rows: Sequence[ChangeRow]


def change_table(change: CalibrationChange) -> ChangeTable:
    """The table of a comparison; a dash stands where it does not see that kind of change."""
    own_frames = any(np.isfinite(light.moved_L_std).all() for light in change.lights)
    moved = "direction, °" if change.distant else "moved, mm"
    first = ("along its arm, mm", "sideways, mm (azimuth, °)", "along its emission, mm (joint, °)") if own_frames else (moved,)
    rows = [ChangeRow(light.name, _found(light, change.distant), _least(light, change.distant, own_frames), ", ".join(light.says))
            for light in change.lights]  # fmt: skip
    return ChangeTable((moved, "axis turned, °", "power, %"), (*first, "axis turned, °", "power, %"), round(SEEN_SIGMAS), rows)


def _length(moved: float, distant: bool) -> float:
    """A move in mm; of a distant light's direction, in degrees."""
    return float(np.degrees(moved)) if distant else 1e3 * moved


def _found(light: LightChange, distant: bool) -> list[str]:
    pairs = (
        (_length(light.moved, distant), _length(light.moved_std, distant)),
        (float(np.degrees(light.turned_rad)), float(np.degrees(light.turned_std_rad))),
        (100 * light.power, 100 * light.power_std),
    )
    return [f"{fixed(value, 2)} ({fixed(std, 2)})" if np.isfinite(value) else fixed(value, 2) for value, std in pairs]


def _least(light: LightChange, distant: bool, own_frames: bool) -> list[str]:
    least = light.least
    ends = [fixed(float(np.degrees(least.turned_rad)), 2), fixed(100 * least.power, 2)]
    if not own_frames:
        return [fixed(_length(least.moved, distant), 2), *ends]
    turns = (float("nan"), least.azimuth_rad, least.joint_rad)
    by = [
        fixed(1e3 * float(moved), 2) + (f" ({fixed(float(np.degrees(turn)), 2)})" if np.isfinite(turn) else "")
        for moved, turn in zip(least.moved_L, turns, strict=True)
    ]
    return [*by, *ends]


def scene_of(rigs: tuple[Calibration, Calibration], change: CalibrationChange) -> LineScene | None:
    """The later rig, where each light stood before, and the arrow of its own change, what all share taken out."""
    own, scene = (rig_scene(RigReport(one.name, calibration=one)) for one in rigs)
    if scene is None or own is None:
        return None
    ghosts = [replace(item, tone="designed", layer="designed", thin=True) for item in own.items if item.kind in {"line", "point"}]
    sources = {light.name: light.source_C for light in rigs[1].lights if light.source_C is not None}
    arrows = [
        LineItem(
            kind="arrow",
            points=(sources[light.name] - light.moved_C)[None],
            by=light.moved_C,
            tone="poor" if light.says else "designed",
            layer="wings",
        )
        for light in change.lights
        if light.name in sources
    ]
    return replace(scene, items=(*ghosts, *scene.items, *arrows), radius=ROOM * scene.radius)


SOFTWARE = "lpcal study"
"""What the PNG says made it; it distinguishes a plot of lpcal's from any other picture."""


@dataclass(frozen=True)
class PlotLine:
    """One line of the plot."""

    name: str
    x: Array
    y: Array
    """Mean relative error, per cent."""


def plot_png(curves: Sequence[PlotLine], across: str) -> bytes:
    """The curves as a PNG, error on a logarithmic axis."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 4.2), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    for curve in curves:
        axes.semilogy(curve.x, curve.y, marker=".", label=curve.name)
    axes.set_xlabel(across)
    axes.set_ylabel("mean relative error of the normals, %")
    axes.grid(visible=True, which="both", alpha=0.25)
    figure.legend(frameon=False, fontsize="small", loc="outside right center")
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=130, metadata={"Software": SOFTWARE})
    return data.getvalue()


COLLECTION_MARK = '<meta name="lpcal-page" content="surfaces">'
"""What marks the page as lpcal's."""
FAIR = 0.2
"""Odds of being wrong from which a surface is marked: one in five is looked at."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One capture: what stands in the table, by column, and a small picture; None where a figure does not apply."""

    name: str
    state: str
    """done | up to date | failed | lost."""
    doubt: float
    """Odds (0..1) that it is wrong; 1 where there is no surface."""
    pixels: int | None = None
    pieces: int | None = None
    distance_mm: float | None = None
    distance_std_mm: float | None = None
    other_distance_odds: float | None = None
    mask_doubt: float | None = None
    normal_std_deg: float | None = None
    residual_sigmas: float | None = None
    solving_s: float | None = None
    peak_memory_mb: float | None = None
    folder: str = ""
    notes: str = ""
    error: str = ""
    picture: str | None = None
    """As a data: URI, where there is a surface; not in the table."""

    @property
    def tone(self) -> str:
        """How it is marked."""
        return "poor" if self.picture is None and self.error else "fair" if self.doubt >= FAIR else "good"


def collection_html(name: str, rows: Sequence[Row]) -> str:
    """The page."""
    counts = {state: sum(row.state == state for row in rows) for state in ("done", "up to date", "failed", "lost")}
    said = ", ".join(f"{count} {state}" for state, count in counts.items() if count)
    doubtful = sum(row.tone == "fair" for row in rows)
    return (
        environment()
        .get_template("collection.html")
        .render(mark=COLLECTION_MARK, name=name, rows=rows, said=said, doubtful=doubtful, grouped=grouped)
    )


def watch_html(state: WatchData) -> str:
    """The page."""
    return environment().get_template("watch.html").render(state=script_json(state))


def mark_html(document: MarkData, token: str) -> str:
    """The page on which the images of a capture are marked; it sends `token` with each message."""
    template = environment().get_template("mark.html")
    return template.render(document=script_json({**document, "token": token}), about=document, version=__version__)
