"""calib/report.html: what was found, how sure it is, and what it rests on, in one file that opens offline.

Nothing is loaded from anywhere: style, script, charts and pictures stand in the file.
"""

from __future__ import annotations

import base64
import json
from dataclasses import dataclass, fields
from typing import Any

from lpcal import __version__
from lpcal.records.provenance import Provenance
from lpcal.records.surface import Component
from lpcal.report.chain_sections import camera_section, handeye_section
from lpcal.report.light_sections import lights_section, spheres_section
from lpcal.report.rig_report import KINDS, RigReport, SurfaceReport
from lpcal.report.scene import LineScene, layers_of, rig_caption, rig_scene, room_scene
from lpcal.report.templates import environment
from lpcal.report.verdict import headline, verdicts
from lpcal.report.wording import with_sigma

FIGURES_SHOWN = 16

__all__ = ["RigReport", "SurfaceReport", "render"]


def render(report: RigReport, stamp: str = "") -> str:
    """The page, whole; a stage that is not there is said to be so. `stamp` stands in it and tells later what it was made from."""
    lines = verdicts(report)
    tone, sentence = headline(lines)
    rig = rig_scene(report)
    return (
        environment()
        .get_template("report.html")
        .render(
            name=report.name,
            stamp=stamp,
            version=__version__,
            made=_latest(report),
            tone=tone,
            sentence=sentence,
            verdicts=lines,
            camera=camera_section(report),
            handeye=handeye_section(report),
            lights=lights_section(report),
            spheres=spheres_section(report),
            rig=_script(rig),
            rig_layers=layers_of(rig),
            rig_caption=rig_caption(report),
            room=_script(room_scene(report)),
            surfaces=[_surface(surface) for surface in report.surfaces],
            provenance=[_provenance(kind, report.provenance[kind]) for kind in KINDS if kind in report.provenance],
            missing=[kind for kind in KINDS if kind not in report.provenance],
        )
    )


def data_uri(content: bytes, media: str = "image/png") -> str:
    """Content as a data: URI."""
    return f"data:{media};base64,{base64.b64encode(content).decode('ascii')}"


def script_json(value: Any) -> str:
    """JSON that may stand inside a script element."""
    return json.dumps(value, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def _script(scene: LineScene | None) -> str | None:
    return None if scene is None else script_json(scene.document())


def _latest(report: RigReport) -> str:
    return _shown_time(max((one.time for one in report.provenance.values()), default=""))


def _shown_time(iso: str) -> str:
    return iso.replace("T", " ").replace("+00:00", " UTC")


@dataclass(frozen=True)
class SurfaceSection:
    """A surface: its pictures as data: URIs, its pieces' distances, its figures and what is to be said of it."""

    name: str
    relight: str | None
    pictures: list[tuple[str, str]]
    pieces: list[tuple[str, str]]
    notes: tuple[str, ...]
    figures: list[tuple[str, str]]


@dataclass(frozen=True)
class ProvenanceSection:
    """What a document was made from."""

    file: str
    version: str
    time: str
    inputs: list[tuple[str, str]]
    options: str


def _surface(surface: SurfaceReport) -> SurfaceSection:
    summary = surface.summary
    figures = [
        *((field.name, getattr(summary.figures, field.name)) for field in fields(summary.figures)),
        *((f"{part}, s", seconds) for part, seconds in summary.times_s.items()),
        ("peak memory, MB", summary.peak_memory_mb),
    ]
    return SurfaceSection(
        name=surface.name,
        relight=surface.relight,
        pictures=[(what, data_uri(content)) for what, content in surface.pictures.items()],
        pieces=[_piece(piece, metric=summary.metric) for piece in summary.components],
        notes=summary.notes,
        figures=[(label.replace("_", " "), _figure(value)) for label, value in figures if _is_figure(value)][:FIGURES_SHOWN],
    )


def _piece(piece: Component, *, metric: bool) -> tuple[str, str]:
    label = f"piece {piece.label}, {piece.pixels} pixels"
    if not metric:
        return label, "relative depth"
    return label, with_sigma(1000 * piece.mean_depth_m, 1000 * piece.mean_depth_m * piece.scale_std, "mm")


def _is_figure(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _figure(value: float) -> str:
    return str(int(value)) if float(value).is_integer() else f"{value:.4g}"


def _provenance(kind: str, stated: Provenance) -> ProvenanceSection:
    return ProvenanceSection(
        f"{kind}.yaml", stated.lpcal_version, _shown_time(stated.time), [*stated.inputs.items()], script_json(stated.options)
    )
